//! docs/results.md is made from the schema. `AIM_BATCH_UPDATE=1` rewrites it.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_model::results::dictionary_markdown;

#[test]
fn the_document_is_that_of_the_schema() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/results.md");
    let expected = dictionary_markdown();
    if std::env::var_os("AIM_BATCH_UPDATE").is_some_and(|value| value == "1") {
        std::fs::write(path, &expected).unwrap();
    }
    let found = std::fs::read_to_string(path).unwrap_or_default().replace("\r\n", "\n");
    assert!(
        found == expected,
        "docs/results.md is not what the schema says; \
         run AIM_BATCH_UPDATE=1 cargo test -p aim-batch-model --test dictionary, and read the difference"
    );
}
