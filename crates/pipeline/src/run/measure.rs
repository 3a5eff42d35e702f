//! Stage measure of one session: finds rims where that is asked for, measures, and keeps the output at once.

use std::time::Instant;

use model::{Problem, ProblemCode, SessionLog, SessionStatus, Stage};

use super::plan::SessionPlan;
use super::worker::{Interruption, Worker};
use crate::session::{Measuring, Prepared, Recording, Searched, finish_status};
use crate::work::StageOutput;

/// The keys of everything that stage measure depends on.
pub(super) struct MeasureKeys {
    /// The fingerprint of the settings and the files of marks; none when the files may change unseen.
    pub fingerprint: Option<String>,
    /// The key of measuring.
    pub measure: String,
    /// The key of the search for rims; none where there is no search.
    pub search: Option<String>,
}

impl Worker<'_> {
    /// Measures a session from its recording and keeps the output. `changed` is the problem of a card that changed while it
    /// was read: what is kept of it then is made again the next time.
    pub(super) fn measure(
        &self,
        plan: &SessionPlan<'_>,
        prepared: &Prepared,
        recording: Recording,
        keys: MeasureKeys,
        changed: Option<Problem>,
        log: &mut SessionLog,
    ) -> Result<SessionStatus, Interruption> {
        let is_whole = recording.is_whole() && changed.is_none();
        if !is_whole {
            self.work.state.touch(&plan.dir.name, Stage::Ingest, None)?;
        }
        let start = Instant::now();
        let auto = self.search(plan, prepared, &recording, keys.search.as_deref())?;
        let searched = keys.search.filter(|_| is_whole).map(|key| Searched { key, problems: auto.problems.clone() });
        let (study, reporter) = (self.context.study, self.reporter);
        let measuring = Measuring { study, dir: plan.dir, prepared, is_bench: false, reporter };
        let mut output = measuring.measure(recording, auto);
        output.searched = searched;
        output.status.problems.extend(changed);
        finish_status(&mut output, study, &self.work.mcap_dir);
        log.measure_s = Some(start.elapsed().as_secs_f64());
        let kept = StageOutput {
            key: if is_whole && !has_unread_marks(&output.status) { &keys.measure } else { "" },
            fingerprint: keys.fingerprint,
            seconds: start.elapsed().as_secs_f64(),
            output: &serde_json::to_string(&output)?,
            status: Some(&output.status),
        };
        self.work.state.keep(&plan.dir.name, Stage::Measure, &kept)?;
        Ok(output.status)
    }
}

/// Whether marks could not be read. They may be readable the next time, and nothing would tell them from those of now.
fn has_unread_marks(status: &SessionStatus) -> bool {
    status.problems.iter().any(|problem| problem.code == ProblemCode::MarksUnreadable)
}
