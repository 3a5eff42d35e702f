//! The result of a check, for programs.

use std::collections::BTreeMap;

use model::{Flow, FlowStep, FrameReason, Problem, SessionStatus};
use pipeline::{Checked, Study};
use serde::Serialize;

use super::Verdict;
use crate::commands::PROGRAM;

/// Version of the JSON. It rises when a key is removed, renamed, or changes its meaning.
const SCHEMA_VERSION: u32 = 1;

#[derive(Serialize)]
struct Document<'a> {
    schema_version: u32,
    program: &'a str,
    study: &'a str,
    verdict: Verdicts,
    sessions: Vec<Session<'a>>,
    study_problems: &'a [Problem],
    flow: Steps,
}

/// Numbers of sessions: all, and those of each verdict.
#[derive(Serialize)]
struct Verdicts {
    sessions: usize,
    whole: usize,
    loses_data: usize,
    fails: usize,
}

#[derive(Serialize)]
struct Session<'a> {
    verdict: Verdict,
    #[serde(flatten)]
    status: &'a SessionStatus,
    flow: Option<Steps>,
}

/// Numbers of images: those that reach each step of the flow, and those that each reason leaves out.
#[derive(Serialize)]
struct Steps {
    steps: BTreeMap<&'static str, usize>,
    left_out: BTreeMap<&'static str, usize>,
}

impl Steps {
    fn from_flow(flow: &Flow) -> Self {
        let left_out = FrameReason::ALL.iter().filter(|reason| reason.ends().is_some());
        Self {
            steps: FlowStep::ALL.iter().map(|step| (step.code(), flow.images_at(*step))).collect(),
            left_out: left_out
                .map(|reason| (reason.code(), flow.with_reason(*reason).images))
                .filter(|(_, images)| *images > 0)
                .collect(),
        }
    }
}

/// The result of a check as a JSON document.
pub fn text(study: &Study, checked: &Checked) -> serde_json::Result<String> {
    let flows: BTreeMap<&str, &Flow> = checked.flow.sessions().collect();
    let session = |status| Session {
        verdict: Verdict::from_status(status),
        status,
        flow: flows.get(status.session.as_str()).map(|flow| Steps::from_flow(flow)),
    };
    serde_json::to_string_pretty(&Document {
        schema_version: SCHEMA_VERSION,
        program: PROGRAM,
        study: &study.spec.name,
        verdict: Verdicts {
            sessions: checked.sessions.len(),
            whole: Verdict::Whole.count(&checked.sessions),
            loses_data: Verdict::LosesData.count(&checked.sessions),
            fails: Verdict::Fails.count(&checked.sessions),
        },
        sessions: checked.sessions.iter().map(session).collect(),
        study_problems: &checked.study,
        flow: Steps::from_flow(&checked.flow.total()),
    })
}
