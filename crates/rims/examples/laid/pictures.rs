//! Pictures that are kept from run to run.

use model::View;
use simulate::laid::Frame;

/// The picture, from the folder where it is kept, or taken.
pub fn jpeg(frame: &Frame, view: &View, name: &str) -> Result<Vec<u8>, String> {
    let taken = || frame.photograph(view).to_jpeg(name).map_err(|e| e.to_string());
    let Ok(folder) = std::env::var("AIM_BATCH_LAID_PICTURES") else { return taken() };
    let file = format!("{folder}/{name}.jpg");
    match std::fs::read(&file) {
        Ok(jpeg) => Ok(jpeg),
        Err(_) => {
            let jpeg = taken()?;
            std::fs::write(&file, &jpeg).map_err(|e| e.to_string())?;
            Ok(jpeg)
        }
    }
}
