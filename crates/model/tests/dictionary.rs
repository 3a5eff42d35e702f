//! docs/results.md is made from the schema, docs/ledger.md from the reasons and docs/problems.md from the codes.
//! `AIM_BATCH_UPDATE=1` rewrites them.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_model::problems_markdown;
use aim_batch_model::results::{dictionary_markdown, ledger_markdown};

#[test]
fn the_documents_are_those_of_the_code() {
    for (file, expected) in
        [("results.md", dictionary_markdown()), ("ledger.md", ledger_markdown()), ("problems.md", problems_markdown())]
    {
        let path = format!("{}/../../docs/{file}", env!("CARGO_MANIFEST_DIR"));
        if std::env::var_os("AIM_BATCH_UPDATE").is_some_and(|value| value == "1") {
            std::fs::write(&path, &expected).unwrap();
        }
        let written = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
        assert!(
            written == expected,
            "docs/{file} is not what the code says; \
             run AIM_BATCH_UPDATE=1 cargo test -p aim-batch-model --test dictionary, and read the difference"
        );
    }
}
