//! Faults on purpose, for tests of whole programs. Builds without debug assertions, as releases are, do not contain this.
//!
//! `AIM_BATCH_TEST_PANIC=SESSION:STAGE` makes that stage of that session panic; `AIM_BATCH_TEST_PAUSE_MS=N` makes every stage of
//! every session wait.

use std::time::Duration;

use model::Stage;

/// Called at the beginning of a stage: panics or waits where the environment asks for it.
pub(crate) fn inject(session: &str, stage: Stage) {
    let asked = std::env::var("AIM_BATCH_TEST_PANIC").unwrap_or_default();
    assert!(asked != format!("{session}:{stage}"), "a fault on purpose in stage {stage}");
    let pause_ms = std::env::var("AIM_BATCH_TEST_PAUSE_MS").ok().and_then(|text| text.parse().ok());
    if let Some(pause_ms) = pause_ms {
        std::thread::sleep(Duration::from_millis(pause_ms));
    }
}
