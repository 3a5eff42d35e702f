//! Printed boards: their outer corners are two sizes of a rectangle on the table.

use serde_json::Value;

use super::{Photo, camera_file, cases, number, point, summary};
use crate::support::{line, real_data};

/// Photographs of one board, with the lens that `lens` makes of the set's model; and its true width and length.
pub struct Board {
    pub photos: Vec<Photo>,
    pub length_mm: f64,
    pub width_mm: f64,
}

/// Some sets count in squares; their square is then taken as 100 mm.
fn mm_per_unit(cases: &Value) -> f64 {
    if cases["unit"].as_str().unwrap().starts_with("squares") { 100.0 } else { 1.0 }
}

/// Reads a set. `lens`: from the set's `model`, focal length, principal point and `[lens]` lines.
pub fn board(set: &str, lens: impl Fn(&Value) -> (f64, [f64; 2], String)) -> Option<Board> {
    let folder = real_data(set)?;
    let cases = cases(folder.join("cases.json"));
    let mm = mm_per_unit(&cases);
    let columns = usize::try_from(cases["pattern_inner_corners"][0].as_u64().unwrap()).unwrap();
    let rows = usize::try_from(cases["pattern_inner_corners"][1].as_u64().unwrap()).unwrap();
    let size = [0, 1].map(|i| cases["image_size"][i].as_u64().unwrap());
    let (focal_px, principal_px, lens) = lens(&cases["model"]);
    let photos = cases["images"].as_array().unwrap().iter().map(|image| {
        let corner = |i: usize| point(&image["corners_px_original"][i]);
        Photo {
            path: folder.join(image["file"].as_str().unwrap()),
            camera: camera_file(size, [focal_px; 2], principal_px, &lens),
            pitch_deg: number(&image["pitch_deg"]),
            roll_deg: -number(&image["roll_deg"]), // these files count roll the other way round
            range_mm: mm * number(&image["distance_along_axis"]),
            kind: "plate",
            shape: "rectangle",
            rim_height_mm: None,
            shapes: vec![
                line("board/length", [corner(0), corner(columns - 1)]),
                line("board/width", [corner(0), corner(columns * (rows - 1))]),
            ],
        }
    });
    let extent = |i: usize| mm * number(&cases["true_extent"][i]);
    Some(Board { photos: photos.collect(), length_mm: extent(0), width_mm: extent(1) })
}

pub fn radial(model: &Value) -> (f64, [f64; 2], String) {
    let lens = format!("model = \"radial\"\nk1 = {}", number(&model["k1"]));
    (number(&model["f"]), [number(&model["cx"]), number(&model["cy"])], lens)
}

pub fn division(model: &Value) -> (f64, [f64; 2], String) {
    let lens = format!("model = \"division\"\nlambda = {}", number(&model["lam"]));
    (number(&model["f"]), [number(&model["cx"]), number(&model["cy"])], lens)
}

impl Board {
    /// Errors of all photographs; every mark must have an answer.
    pub fn errors_pct(&self) -> Vec<f64> {
        self.photos.iter().flat_map(|photo| self.errors_of(photo)).map(Option::unwrap).collect()
    }

    /// Errors of length and width of one photograph, none where the lens does not show a mark.
    fn errors_of(&self, photo: &Photo) -> Vec<Option<f64>> {
        let error = |(quantity, mm): (String, Option<f64>)| {
            let truth_mm = if quantity == "length" { self.length_mm } else { self.width_mm };
            Some(100.0 * (mm? / truth_mm - 1.0))
        };
        photo.measure_where_possible().into_iter().map(|(_, quantity, mm)| error((quantity, mm))).collect()
    }
}

#[test]
fn stereo_camera_boards_within_0_6_pct() {
    let Some(board) = board("boofcv_chess/bumblebee_left", radial) else { return };
    let stats = summary("BoofCV, Bumblebee2 boards, radial", &board.errors_pct());
    assert!(stats.n == 22 && stats.median_absolute < 0.6);
}

#[test]
fn opencv_boards_within_0_6_pct() {
    let Some(board) = board("opencv_chess/left", radial) else { return };
    let stats = summary("OpenCV sample boards, radial", &board.errors_pct());
    assert!(stats.n == 26 && stats.median_absolute < 0.6);
}

/// The paper's lens model does not fit such a lens: whole boards come out wrong, and marks near the border have no ray.
#[test]
fn a_121_degree_lens_needs_the_division_model() {
    let by_division = board("udacity_gopro_121deg", division);
    let by_radial = board("udacity_gopro_121deg", |model| radial(&model["best_brown_k1"]));
    let (Some(by_division), Some(by_radial)) = (by_division, by_radial) else { return };
    let division = summary("Udacity, 121 degrees, division", &by_division.errors_pct());
    assert!(division.n == 16 && division.worst.abs() < 0.6);
    let answered: Vec<f64> = by_radial.photos.iter().flat_map(|photo| by_radial.errors_of(photo)).flatten().collect();
    let radial = summary("Udacity, 121 degrees, radial, where it has an answer", &answered);
    println!("Udacity, 121 degrees, radial: no answer for {} of 16 sizes", 16 - radial.n);
    assert!(radial.n < 16 && radial.median_absolute > 3.0 * division.median_absolute);
}
