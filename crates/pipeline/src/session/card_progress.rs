//! The link between a session at work and the ingest of its card.

use ingest::{ByteBudget, IngestProgress};

use crate::reporter::Reporter;
use crate::stop::Stop;

/// Passes the progress of an ingest on to the reporter, and to the ingest the wish to stop and the bound of images in
/// memory.
pub(crate) struct CardProgress<'a> {
    pub session: &'a str,
    pub reporter: &'a dyn Reporter,
    pub stop: &'a Stop,
    pub budget: Option<&'a ByteBudget>,
}

impl IngestProgress for CardProgress<'_> {
    fn begin(&self, bytes: u64) {
        self.reporter.bytes_to_read(self.session, bytes);
    }

    fn advance(&self, bytes: u64) {
        self.reporter.bytes_read(self.session, bytes);
    }

    fn is_stopped(&self) -> bool {
        self.stop.is_set()
    }

    fn image_budget(&self) -> Option<&ByteBudget> {
        self.budget
    }
}
