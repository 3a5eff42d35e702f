//! The rims in the pictures of a session, either kept from an earlier run or searched for.

use model::Stage;

use super::plan::SessionPlan;
use super::worker::{Interruption, Worker};
use crate::session::{AutoMarks, Prepared, Recording, Search, SearchError, SessionOutput};

impl Worker<'_> {
    /// The rims in the pictures of the recording, if the study asks for them. What the last run found in the same pictures
    /// under the same settings is used again, so that a changed name or true size costs no search. A damaged recording is
    /// made again, once. `key` is that of the search.
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
        // An output that cannot be read was kept by another version.
        let output = kept.and_then(|text| serde_json::from_str::<SessionOutput>(&text).ok());
        let found = output.and_then(|output| {
            let searched = output.searched.filter(|searched| searched.key == key)?;
            Some(AutoMarks { by_image: output.auto, problems: searched.problems, searched: true })
        });
        Ok(found)
    }
}
