//! A session before its card is read: its settings and cameras.

use std::path::Path;

use ingest::SessionSource;
use model::{Camera, CameraSpec, Problem, ProblemCode, Severity, Stage};

use super::problems::{MARKS_CAMERA_FACT, bad_camera, card_out_of_reach, link_out_of_study, missing_card};
use crate::inputs::sha256_of_file;
use crate::signals::PoseSettings;
use crate::study::{SessionDir, SessionSpec, Study};

/// Everything that a session is made from but its files, with all settings resolved.
pub(crate) struct Prepared {
    /// The settings of session.toml.
    pub spec: SessionSpec,
    /// The input of its ingest: the card with profile, camera and clock.
    pub source: SessionSource,
    /// The camera of the recorded pictures.
    pub camera: Camera,
    /// The camera of the pictures that people marked.
    pub marks_camera: (CameraSpec, Camera),
    /// The path and SHA-256 of session.toml, if there is one.
    pub session_toml_sha256: Option<(String, String)>,
}

impl Prepared {
    pub fn new(study: &Study, dir: &SessionDir, program: &str) -> Result<Self, Problem> {
        let card = dir.card.as_deref().ok_or_else(|| missing_card(dir))?;
        if let Err(error) = card.canonicalize() {
            return Err(card_out_of_reach(dir, &error));
        }
        if !study.holds(card) {
            return Err(link_out_of_study(dir));
        }
        let (spec, session_toml_sha256) = session_spec(study, card)?;
        let camera = study.camera_of_session(&spec).map_err(|error| bad_camera(dir, error.to_string()))?;
        let marks_camera = study.marks_camera_of_session(&spec, &camera);
        let marks_camera = marks_camera.map_err(|error| bad_camera(dir, error.to_string()))?;
        let marks_camera = marks_camera.ok_or_else(|| bad_camera(dir, MARKS_CAMERA_FACT.to_owned()))?;
        let source = SessionSource {
            session: dir.name.clone(),
            card_dir: card.to_owned(),
            profile: study.profile.clone(),
            camera_spec: camera.0,
            time_zone: study.time_zone.clone(),
            clock_zero_utc: spec.clock_zero_utc,
            program: program.to_owned(),
        };
        Ok(Self { spec, source, camera: camera.1, marks_camera, session_toml_sha256 })
    }

    /// The settings by which readings become a pose and a choice; `mount_pitch_deg` is the device profile's.
    pub fn pose_settings(&self, study: &Study, mount_pitch_deg: f64) -> PoseSettings {
        let mount_pitch_deg = study.spec.mount.pitch_offset_deg.unwrap_or(mount_pitch_deg);
        study.spec.signals.pose_settings(&study.spec.select, mount_pitch_deg.to_radians())
    }
}

fn session_spec(study: &Study, card: &Path) -> Result<(SessionSpec, Option<(String, String)>), Problem> {
    let path = card.join("session.toml");
    if !path.is_file() {
        return Ok((SessionSpec::default(), None));
    }
    let place = study.relative(&path);
    let refuse = |fact: String| Problem {
        severity: Severity::Loss,
        stage: Stage::Study,
        code: ProblemCode::BadSessionToml,
        place: place.clone(),
        fact,
        remedy: "correct the file (docs/study.md)".to_owned(),
    };
    let hash = sha256_of_file(&path).map_err(|error| refuse(error.to_string()))?;
    let mut spec: SessionSpec = ingest::config::read_toml(&path).map_err(|error| refuse(error.to_string()))?;
    spec.participant = spec.participant.map(ingest::nfc);
    Ok((spec, Some((place, hash))))
}
