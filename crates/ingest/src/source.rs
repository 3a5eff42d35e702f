//! The source of one session's recording.

use std::path::PathBuf;

use jiff::Timestamp;
use jiff::tz::TimeZone;
use model::CameraSpec;

use crate::card::Card;
use crate::error::IngestError;
use crate::profile::Profile;

/// The source of one session's recording: its card, and the settings by which it is read.
#[derive(Debug, Clone)]
pub struct SessionSource {
    /// Name of the session.
    pub session: String,
    /// The card as it was copied.
    pub card_dir: PathBuf,
    /// The profile of the device.
    pub profile: Profile,
    /// The camera of this session.
    pub camera_spec: CameraSpec,
    /// For image times that name no zone.
    pub time_zone: TimeZone,
    /// When a boot-relative clock was zero, where the profile says that the session tells.
    pub clock_zero_utc: Option<Timestamp>,
    /// Program and version, for the file's metadata.
    pub program: String,
}

impl SessionSource {
    pub(crate) fn list_card(&self) -> Result<Card, IngestError> {
        Card::list(&self.card_dir).map_err(|source| IngestError::NoCard {
            session: self.session.clone(),
            card_dir: self.card_dir.clone(),
            source,
        })
    }
}
