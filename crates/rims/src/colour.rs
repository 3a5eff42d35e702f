//! The colour of a picture at a place between pixels.

use ingest::Picture;
use nalgebra::Point2;

/// Colour at a place between pixels.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside the picture")]
pub(crate) fn colour(picture: &Picture, at: Point2<f64>) -> Option<[f64; 3]> {
    let (width, height) = (picture.width_px as usize, picture.height_px as usize);
    if !(at.x >= 0.0 && at.y >= 0.0) {
        return None;
    }
    // By way of i32, which is quicker.
    let (left, above) = (at.x as i32, at.y as i32);
    let (column, row) = (left as usize, above as usize);
    if column + 1 >= width || row + 1 >= height {
        return None;
    }
    let (u, v) = (at.x - f64::from(left), at.y - f64::from(above));
    let first = 3 * (row * width + column);
    let top = picture.rgb.get(first..)?.first_chunk::<6>()?;
    let bottom = picture.rgb.get(first + 3 * width..)?.first_chunk::<6>()?;
    Some([0, 1, 2].map(|c| {
        let between = |line: &[u8; 6]| f64::from(line[c]) * (1.0 - u) + f64::from(line[c + 3]) * u;
        between(top) * (1.0 - v) + between(bottom) * v
    }))
}
