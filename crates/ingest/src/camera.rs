//! Camera files: TOML with the fields of [`CameraSpec`], unknown keys refused.

use std::path::Path;

use model::CameraSpec;

use crate::config::{self, ConfigError};
use crate::devices::{self, Shelf};

const SHELF: Shelf = Shelf {
    kind: "camera",
    built_in: &[
        ("aim2-raw", include_str!("../cameras/aim2-raw.toml")),
        ("aim2-corrected", include_str!("../cameras/aim2-corrected.toml")),
    ],
    marks: &["lens"],
};

/// The camera of that name: `devices_dir/NAME.toml` if there is one, else the built-in one. A name that ends in `.toml`
/// is a path, relative to `devices_dir`. The folder need not exist. [`CameraSpec::camera`] of the result succeeds.
///
/// # Errors
/// [`ConfigError`]: [`UnknownName`](ConfigError::UnknownName) lists the names that exist; the others say what is wrong
/// with the file.
pub fn load(name_or_path: &str, devices_dir: &Path) -> Result<CameraSpec, ConfigError> {
    let (path, spec) = devices::find(&SHELF, name_or_path, devices_dir)?;
    checked(spec, &path)
}

/// The camera in a file. [`CameraSpec::camera`] of the result succeeds.
///
/// # Errors
/// [`ConfigError`] when the file cannot be read or does not describe a camera.
pub fn read_file(path: &Path) -> Result<CameraSpec, ConfigError> {
    checked(config::read_toml(path)?, path)
}

fn checked(spec: CameraSpec, path: &Path) -> Result<CameraSpec, ConfigError> {
    match spec.camera() {
        Ok(_) => Ok(spec),
        Err(error) => Err(ConfigError::Invalid {
            path: path.to_owned(),
            key: "camera".to_owned(),
            fact: error.to_string(),
            remedy: "correct the camera file; docs/devices.md lists its keys".to_owned(),
        }),
    }
}
