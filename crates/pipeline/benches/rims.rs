//! Rims found in one picture, against libjpeg-turbo that only decodes it.

use std::path::Path;

use ingest::Picture;
use model::{Kind, View};
use rims::find_rims;
use simulate::laid::{self, Frame};

use crate::python::Python;
use crate::turns;

/// Pixels along a picture of 5 MP.
const WIDTH_PX: u32 = 2592;
const HEIGHT_PX: u32 = 1944;
/// Pictures per turn.
const TIMES: usize = 5;
/// Of the scenes' random numbers.
const SEED: u64 = 7;

/// Decoding, and decoding with finding rims, of three rendered tables: crowded, with one plate, and with nothing on it.
pub fn run() {
    let Some(mut python) = Python::start("decoder.py", "OpenCV with libjpeg-turbo") else { return };
    let folder = tempfile::tempdir().unwrap();
    for (name, frame) in scenes() {
        let view = frame.view(&laid::camera([WIDTH_PX, HEIGHT_PX]).unwrap()).unwrap();
        let jpeg = frame.photograph(&view).to_jpeg(name).unwrap();
        let file = folder.path().join(format!("{}.jpg", name.replace(' ', "-")));
        std::fs::write(&file, &jpeg).unwrap();
        compare(&mut python, name, &file, &jpeg, &view);
    }
}

fn compare(python: &mut Python, name: &str, file: &Path, jpeg: &[u8], view: &View) {
    let bytes = i64::from(3 * WIDTH_PX * HEIGHT_PX);
    let found = find_rims(&Picture::decode(jpeg).unwrap(), view).unwrap();
    let title = format!(
        "{name}: {TIMES} times a picture of 5 MP, {} kB, {} rims, seconds (least, median, most)",
        jpeg.len() / 1000,
        found.len()
    );
    let mut decode = || {
        for _ in 0..TIMES {
            assert_eq!(Picture::decode(jpeg).unwrap().width_px, WIDTH_PX);
        }
    };
    let mut find = || {
        for _ in 0..TIMES {
            assert_eq!(find_rims(&Picture::decode(jpeg).unwrap(), view).unwrap().len(), found.len());
        }
    };
    let peer_name = python.says.clone();
    let mut peer = || assert_eq!(python.ask(&TIMES.to_string(), file), bytes);
    turns::compare(&title, ("decoded", &mut decode), (&peer_name, &mut peer));
    turns::compare(&title, ("decoded, rims found", &mut find), (&peer_name, &mut peer));
}

/// Of the rendered tables, the one with most on it, one with a plate alone, and one with nothing.
fn scenes() -> [(&'static str, Frame); 3] {
    let worn = || laid::worn(SEED, WIDTH_PX, 12, 8).into_iter().flat_map(|plan| plan.frames);
    let mut bench = laid::bench(SEED, WIDTH_PX).into_iter().flat_map(|plan| plan.frames);
    // The selection's window of pitch.
    let is_selected = |frame: &Frame| (47.5..62.5).contains(&frame.head.pitch_deg);
    let crowded = worn()
        .filter(is_selected)
        .max_by_key(|frame| (frame.placed.len() + frame.vessels.len(), frame.world.bodies.len()));
    let plate = bench.find(|f| f.placed[0].ware.kind == Kind::Plate && f.vessels.is_empty() && is_selected(f));
    let empty = worn().find(|frame| frame.placed.is_empty() && is_selected(frame));
    [("crowded table", crowded.unwrap()), ("plain plate", plate.unwrap()), ("empty table", empty.unwrap())]
}
