//! Problems of a session as a whole.

use std::path::Path;

use model::{Problem, ProblemCode, Severity, Stage};

use crate::study::{SessionDir, Study};

/// The text without the paths of this machine. Errors of files carry whole paths, but nothing in the results may depend on
/// where the study lies.
pub(crate) fn without_host(fact: &str, study: &Study, mcap_dir: &Path) -> String {
    let inside = |folder: &Path| format!("{}{}", folder.display(), std::path::MAIN_SEPARATOR);
    // The work folder may lie inside the study, so its name is replaced first.
    fact.replace(&inside(mcap_dir), "mcap/").replace(&inside(&study.dir), "")
}

/// The fact of the problem of a link that leaves the study.
pub(super) const LINK_FACT: &str = "this is a link to a place outside the study";

/// The fact of the problem of a session with a camera of its own, in a study whose marked pictures are of another camera.
pub(super) const MARKS_CAMERA_FACT: &str = "the session has its own camera, but [marks] camera of study.toml is of the study's; expected marks_camera here too";

pub(super) fn bad_camera(dir: &SessionDir, fact: String) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Study,
        code: ProblemCode::BadCamera,
        place: format!("cards/{}/session.toml", dir.name),
        fact,
        remedy: "name built-in cameras or ones in devices/ (docs/study.md)".to_owned(),
    }
}

pub(super) fn link_out_of_study(dir: &SessionDir) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Ingest,
        code: ProblemCode::LinkOutOfStudy,
        place: format!("cards/{}", dir.name),
        fact: LINK_FACT.to_owned(),
        remedy: "copy the card into the study, or put the whole study where the cards are".to_owned(),
    }
}

/// The problem of a link that leads nowhere, or of a folder that the system does not show.
pub(super) fn card_out_of_reach(dir: &SessionDir, error: &std::io::Error) -> Problem {
    Problem {
        severity: Severity::Loss,
        stage: Stage::Ingest,
        code: ProblemCode::MissingCard,
        place: format!("cards/{}", dir.name),
        fact: format!("the card's folder cannot be reached: {error}"),
        remedy: "if it is a link, connect the disk that it leads to, or correct it; check permissions".to_owned(),
    }
}

pub(super) fn missing_card(dir: &SessionDir) -> Problem {
    let raters: Vec<_> = dir.marks.keys().map(String::as_str).collect();
    let by = if raters.is_empty() { String::new() } else { format!(" by {}", raters.join(", ")) };
    Problem {
        severity: Severity::Loss,
        stage: Stage::Ingest,
        code: ProblemCode::MissingCard,
        place: format!("cards/{}", dir.name),
        fact: format!("there are marks{by}, but no card"),
        remedy: "copy the SD card there, or move this session's marks out of the study".to_owned(),
    }
}
