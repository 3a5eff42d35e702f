//! Rims in the pictures of a session: those that were found before, or searched for.

use model::Stage;

use super::plan::SessionPlan;
use super::worker::{Interruption, Worker};
use crate::session::{AutoMarks, Prepared, Recording, Search, SearchError, SessionOutput};

impl Worker<'_> {
    /// Rims in the pictures of the recording, if they are to be found: what the last run found in the same pictures under the same
    /// settings stays, so that a name or a true size that changed costs no search. A recording that is damaged is made again,
    /// once. `key`: of the search.
    pub(super) fn search(
        &self,
        plan: &SessionPlan<'_>,
        prepared: &Prepared,
        recording: &Recording,
        key: Option<&str>,
    ) -> Result<AutoMarks, Interruption> {
        if let Some(found) = self.found_before(plan, key)? {
            return Ok(found);
        }
        let mcap = self.mcap(plan);
        let (study, dir, budget, stop) = (self.context.study, plan.dir, self.budget, self.stop);
        let search = Search { study, dir, prepared, mcap: &mcap, budget, stop };
        match search.run(recording) {
            Err(SearchError::Recording(problem)) => {
                self.ingest_again(plan, prepared, &problem)?;
                Ok(search.run(recording)?)
            }
            other => Ok(other?),
        }
    }

    fn found_before(&self, plan: &SessionPlan<'_>, key: Option<&str>) -> Result<Option<AutoMarks>, Interruption> {
        let (Some(key), false) = (key, self.force) else { return Ok(None) };
        let kept = self.work.state.output(&plan.dir.name, Stage::Measure)?;
        // What cannot be read was kept by another version.
        let output = kept.and_then(|text| serde_json::from_str::<SessionOutput>(&text).ok());
        let found = output.and_then(|output| {
            let searched = output.searched.filter(|searched| searched.key == key)?;
            Some(AutoMarks { by_image: output.auto, problems: searched.problems, searched: true })
        });
        Ok(found)
    }
}
