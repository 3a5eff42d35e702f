//! What an ingest hears from a session at work.

use ingest::{ByteBudget, IngestProgress};

use crate::reporter::Reporter;
use crate::stop::Stop;

/// Tells a session's reporter; passes on a wish to stop, and the bound of images in memory.
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
