//! A study on disk (docs/study.md), read and checked once.

mod csv_file;
mod error;
mod marks_source;
mod misplaced;
mod names;
mod objects;
mod printed;
mod sessions;
mod spec;
mod uncertainty;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ingest::Profile;
use model::{Camera, CameraSpec, Shape, TableSpec};

use crate::calibration::CalibrationFile;
pub use error::StudyError;
pub use marks_source::{MarksSource, UnknownMarksSource};
pub(crate) use misplaced::{misplaced, move_command};
pub(crate) use names::{AUTO, FOUND, NAMES_FILE, number_of_found};
pub use names::{Named, Names};
pub use objects::Object;
pub use sessions::{SessionDir, SessionSpec};
pub(crate) use sessions::{marks_in, stem_of};
pub use spec::{
    MarksSpec, MeasureSpec, MountSpec, PrintedFiles, SelectSpec, SignalsSpec, StudySpec, TableEntry, TimeSpec,
};
pub use uncertainty::UncertaintySpec;

/// A study whose settings have been read and checked.
#[derive(Debug, Clone)]
pub struct Study {
    /// The folder, with links resolved.
    pub dir: PathBuf,
    /// The settings of study.toml, with overrides applied.
    pub spec: StudySpec,
    /// The objects of objects.csv, by name.
    pub objects: BTreeMap<String, Object>,
    /// The objects that found containers are, by names.csv.
    pub names: Names,
    /// The device profile.
    pub profile: Profile,
    /// The study's camera.
    pub camera_spec: CameraSpec,
    /// The camera of the pictures that people marked, where it is another one.
    pub marks_camera: Option<(CameraSpec, Camera)>,
    /// The error tables, with printed numbers.
    pub tables: Vec<TableSpec>,
    /// The time zone of image times that name none.
    pub time_zone: jiff::tz::TimeZone,
    /// The sessions by name: those with a card, and those that are only marked.
    pub sessions: Vec<SessionDir>,
    /// The calibration of the device by a bench, where a run is given it.
    pub calibration: Option<CalibrationFile>,
}

impl Study {
    /// Reads the study in `dir`. `adjust` may change the settings after they are read (command line, environment).
    ///
    /// # Errors
    /// [`StudyError`] for what concerns the whole study. A fault of one session shows when that session is run.
    pub fn load(dir: &Path, adjust: impl FnOnce(&mut StudySpec)) -> Result<Self, StudyError> {
        let refuse = || StudyError::NoFolder(dir.to_owned());
        let dir = &dir.canonicalize().ok().filter(|dir| dir.is_dir()).ok_or_else(refuse)?;
        let mut spec: StudySpec = ingest::config::read_toml(&dir.join("study.toml"))?;
        adjust(&mut spec);
        spec.check()?;
        let devices = dir.join("devices");
        let marks_camera = spec.marks.camera.as_deref().map(|name| load_camera(name, &devices)).transpose()?;
        let time_zone = jiff::tz::TimeZone::get(&spec.time_zone)
            .map_err(|source| StudyError::TimeZone { name: spec.time_zone.clone(), source })?;
        let objects = objects::read_objects(&dir.join("objects.csv"))?;
        let sessions = sessions::find(dir, spec.marks.source.reads_all())?;
        let study = Self {
            names: names::read_names(&dir.join(NAMES_FILE), &objects, &sessions)?,
            objects,
            sessions,
            profile: Profile::load(&spec.device_profile, &devices)?,
            camera_spec: ingest::camera::load(&spec.camera, &devices)?,
            marks_camera,
            tables: spec.tables.iter().map(|entry| printed::resolve(entry, dir)).collect::<Result<_, _>>()?,
            time_zone,
            dir: dir.to_owned(),
            spec,
            calibration: None,
        };
        camera_of(&study.spec.camera, &study.camera_spec)?;
        study.check_tables()?;
        Ok(study)
    }

    /// The study with a calibration, whose range cone it takes over.
    #[must_use]
    pub fn calibrated(mut self, calibration: CalibrationFile) -> Self {
        if let Some(physical) = &calibration.physical {
            self.spec.signals.range_cone = physical.range_cone;
        }
        self.calibration = Some(calibration);
        self
    }

    /// The camera of a session: its own, or the study's.
    ///
    /// # Errors
    /// [`StudyError`] when the session names a camera that cannot be read.
    pub fn camera_of_session(&self, session: &SessionSpec) -> Result<(CameraSpec, Camera), StudyError> {
        match &session.camera {
            Some(name) => load_camera(name, &self.dir.join("devices")),
            None => Ok((self.camera_spec.clone(), camera_of(&self.spec.camera, &self.camera_spec)?)),
        }
    }

    /// Whether objects.csv has this object as a round one.
    pub(crate) fn is_round(&self, object: &str) -> bool {
        self.objects.get(object).is_some_and(|object| object.container.shape == Shape::Circle)
    }

    /// Whether `path` lies in the study, links followed.
    #[must_use]
    pub fn holds(&self, path: &Path) -> bool {
        path.canonicalize().is_ok_and(|path| path.starts_with(&self.dir))
    }

    /// A path relative to the study, with `/` between its parts; unchanged where it lies outside.
    pub(crate) fn relative(&self, path: &Path) -> String {
        path.strip_prefix(&self.dir).unwrap_or(path).to_string_lossy().replace('\\', "/")
    }

    /// The camera of the pictures of a session that people marked: the session's own, else the study's, else `camera`,
    /// which is the session's. None where the session has its own camera and the study's marks camera is another's.
    ///
    /// # Errors
    /// [`StudyError`] when the session names a camera that cannot be read.
    pub fn marks_camera_of_session(
        &self,
        session: &SessionSpec,
        camera: &(CameraSpec, Camera),
    ) -> Result<Option<(CameraSpec, Camera)>, StudyError> {
        match (&session.marks_camera, &self.marks_camera) {
            (Some(name), _) => load_camera(name, &self.dir.join("devices")).map(Some),
            (None, Some(_)) if session.camera.is_some() => Ok(None),
            (None, Some(of_study)) => Ok(Some(of_study.clone())),
            (None, None) => Ok(Some(camera.clone())),
        }
    }

    fn check_tables(&self) -> Result<(), StudyError> {
        for table in &self.tables {
            if let Some(unknown) = table.objects.iter().find(|object| !self.objects.contains_key(*object)) {
                return Err(StudyError::TableObject { table: table.id.clone(), object: unknown.clone() });
            }
        }
        Ok(())
    }
}

fn load_camera(name: &str, devices: &Path) -> Result<(CameraSpec, Camera), StudyError> {
    let spec = ingest::camera::load(name, devices)?;
    let camera = camera_of(name, &spec)?;
    Ok((spec, camera))
}

fn camera_of(name: &str, spec: &CameraSpec) -> Result<Camera, StudyError> {
    spec.camera().map_err(|source| StudyError::Camera { name: name.to_owned(), source })
}
