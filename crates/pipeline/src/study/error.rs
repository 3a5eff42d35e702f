//! Errors of a study as a whole, and the check of study.toml.

use std::path::PathBuf;

use super::spec::{STUDY_SCHEMA_VERSION, StudySpec};

/// The reason why a study cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// There is no such folder.
    #[error("no folder here: expected a study with study.toml, objects.csv and cards/ (docs/study.md): {}", .0.display())]
    NoFolder(PathBuf),
    /// A TOML file cannot be read.
    #[error(transparent)]
    Config(#[from] ingest::ConfigError),
    /// study.toml has a version that this program does not read.
    #[error("study.toml: schema_version = {0}: this program reads version {STUDY_SCHEMA_VERSION}")]
    Version(u32),
    /// A number is outside its range.
    #[error("study.toml: {key} = {got}: expected {expected}")]
    Setting {
        /// The key, with its section.
        key: &'static str,
        /// The value in the file.
        got: f64,
        /// The values that are allowed.
        expected: &'static str,
    },
    /// A name cannot name a file, or is missing where there must be one.
    #[error("study.toml: {key} = '{got}': expected {expected}")]
    Name {
        /// The key, with its section.
        key: &'static str,
        /// The value in the file.
        got: String,
        /// The values that are allowed.
        expected: &'static str,
    },
    /// The time zone is not known.
    #[error("study.toml: time_zone = '{name}': expected an IANA name such as America/Chicago: {source}")]
    TimeZone {
        /// The value in the file.
        name: String,
        /// The reason why it is refused.
        source: jiff::Error,
    },
    /// A camera is refused.
    #[error("camera '{name}': {source}")]
    Camera {
        /// The name of the camera.
        name: String,
        /// The reason why it is refused.
        source: model::CameraSpecError,
    },
    /// A file cannot be read.
    #[error("cannot read the file: {source}: {}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// A line of a CSV file is refused.
    #[error("line {line}: {fact}: {}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// The fault: what was expected, and what was there.
        fact: String,
    },
    /// A table names an object that is not in objects.csv.
    #[error("study.toml: table '{table}' names the object '{object}', which is not in objects.csv")]
    TableObject {
        /// The table.
        table: String,
        /// The object.
        object: String,
    },
    /// The folder of the cards or the marks cannot be listed.
    #[error("cannot list the folder: {source}: {}", path.display())]
    List {
        /// The folder.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// There is no session at all.
    #[error("no session: expected one folder per SD card in {}", .0.display())]
    NoSessions(PathBuf),
}

impl StudySpec {
    /// Checks every number of study.toml.
    pub(super) fn check(&self) -> Result<(), StudyError> {
        if self.schema_version != STUDY_SCHEMA_VERSION {
            return Err(StudyError::Version(self.schema_version));
        }
        let positive = "a positive number";
        let not_negative = "zero or a positive number";
        let (signals, select) = (&self.signals, &self.select);
        for (key, got, least, expected) in [
            ("signals.gravity_tolerance_mg", signals.gravity_tolerance_mg, f64::MIN_POSITIVE, positive),
            ("signals.stillness_max_mg", signals.stillness_max_mg, f64::MIN_POSITIVE, positive),
            ("signals.range_min_mm", signals.range_min_mm, 0.0, not_negative),
            ("select.pitch_tolerance_deg", select.pitch_tolerance_deg, 0.0, not_negative),
        ] {
            in_range(key, got, least, f64::MAX, expected)?;
        }
        for (key, got) in self.uncertainty.keys() {
            in_range(key, got, 0.0, f64::MAX, not_negative)?;
        }
        in_range(
            "signals.range_max_mm",
            signals.range_max_mm,
            signals.range_min_mm,
            f64::MAX,
            "at least range_min_mm",
        )?;
        in_range("signals.gravity_cutoff_hz", signals.gravity_cutoff_hz, 0.01, 20.0, "0.01 to 20 Hz")?;
        in_range("signals.range_window_s", signals.range_window_s, 0.01, 60.0, "0.01 to 60 s")?;
        in_range("signals.range_update_s", signals.range_update_s, 0.001, 1.0, "0.001 to 1 s")?;
        in_range("time.image_lag_s", self.time.image_lag_s, -86_400.0, 86_400.0, "-86400 to 86400 s (a day)")?;
        in_range("marks.min_confidence", self.marks.min_confidence, 0.0, 1.0, "0 to 1")?;
        in_range("marks.min_diameter_mm", self.marks.min_diameter_mm, 0.0, 1000.0, "0 to 1000 mm")?;
        in_range("select.target_pitch_deg", select.target_pitch_deg, 0.0, 90.0, "0 to 90 degrees")?;
        if let Some(offset) = self.mount.pitch_offset_deg {
            in_range("mount.pitch_offset_deg", offset, -90.0, 90.0, "-90 to 90 degrees")?;
        }
        self.check_names()
    }

    fn check_names(&self) -> Result<(), StudyError> {
        let refuse = |key, got: &str, expected| Err(StudyError::Name { key, got: got.to_owned(), expected });
        if self.name.trim().is_empty() {
            return refuse("name", &self.name, "a name");
        }
        if self.marks.shapes.is_empty() {
            return refuse("marks.shapes", "[]", "circle, rectangle, or both");
        }
        if self.measure.methods.is_empty() {
            return refuse("measure.methods", "[]", "at least one of paper, ray");
        }
        let methods = &self.measure.methods;
        if let Some((_, twice)) = methods.iter().enumerate().find(|(i, method)| methods[..*i].contains(method)) {
            return refuse("measure.methods", twice.code(), "each method once"); // else every frame would count twice
        }
        for (i, table) in self.tables.iter().enumerate() {
            let is_file_name =
                !table.id.is_empty() && table.id.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c));
            if !is_file_name {
                return refuse("tables.id", &table.id, "letters, digits, '-', '_' and '.' (it becomes a file name)");
            }
            if self.tables[..i].iter().any(|other| other.id.eq_ignore_ascii_case(&table.id)) {
                return refuse(
                    "tables.id",
                    &table.id,
                    "an id of its own for each table (upper and lower case are one)",
                );
            }
            if table.quantities.is_empty() {
                return refuse("tables.quantities", "[]", "at least one quantity");
            }
        }
        Ok(())
    }
}

fn in_range(key: &'static str, got: f64, least: f64, most: f64, expected: &'static str) -> Result<(), StudyError> {
    if got >= least && got <= most { Ok(()) } else { Err(StudyError::Setting { key, got, expected }) }
}
