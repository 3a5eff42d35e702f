//! Whether the values of a profile make sense together.

use super::check_sensors as sensors;
use super::{ImageTime, Images, PROFILE_SCHEMA_VERSION, Profile};
use crate::card::Patterns;
use crate::parse::image_time;

pub(super) struct Wrong {
    pub key: String,
    pub fact: String,
    pub remedy: &'static str,
}

pub(super) fn wrong<T>(key: impl Into<String>, fact: impl Into<String>, remedy: &'static str) -> Result<T, Wrong> {
    Err(Wrong { key: key.into(), fact: fact.into(), remedy })
}

pub(super) fn check(profile: &Profile) -> Result<(), Wrong> {
    if profile.schema_version != PROFILE_SCHEMA_VERSION {
        let fact = format!("version {} of another program", profile.schema_version);
        return wrong("schema_version", fact, "this program reads schema_version = 1");
    }
    if !profile.mount_pitch_deg.is_finite() {
        return wrong("mount_pitch_deg", "not a finite number", "give the angle in degrees");
    }
    sensors::check(profile)?;
    if let Some(images) = &profile.images {
        check_images(images)?;
    }
    if profile.acceleration.is_none() && profile.range.is_none() && profile.images.is_none() {
        let remedy = "declare at least one of [acceleration], [range] and [images]";
        return wrong("acceleration", "the profile declares no files at all", remedy);
    }
    Ok(())
}

fn check_images(images: &Images) -> Result<(), Wrong> {
    check_files("images.files", &images.files)?;
    if let Some(Err(fact)) = images.time.pattern().map(image_time::check_pattern) {
        return wrong("images.time.pattern", fact, "use strptime directives; docs/devices.md has examples");
    }
    match images.time {
        ImageTime::Both { tolerance_s, .. } if !(tolerance_s.is_finite() && tolerance_s >= 0.0) => {
            let fact = format!("{tolerance_s} is not a time in seconds");
            wrong("images.time.tolerance_s", fact, "give how far name and EXIF may be apart: 0 or more seconds")
        }
        _ => Ok(()),
    }
}

pub(super) fn check_files(key: &str, files: &[String]) -> Result<(), Wrong> {
    if files.is_empty() {
        return wrong(key, "no patterns", "give at least one pattern, such as \"SENSORS/*.BIN\"");
    }
    match Patterns::new(files) {
        Ok(_) => Ok(()),
        Err(error) => wrong(key, error.to_string(), "correct the pattern; * stays within a folder, ** does not"),
    }
}

pub(super) fn check_positive(key: &str, value: f64) -> Result<(), Wrong> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    wrong(key, format!("{value} is not a positive number"), "give a positive number; signs belong in axes")
}
