//! The change between two pictures.

use ingest::Thumbnail;

/// The mean absolute difference of two small grey pictures, each brought to mean 0 and SD 1, so that exposure does not count
/// as motion: 0 for the same picture, about 1.1 for two that have nothing in common. None where the sizes differ, or a
/// picture is of a single grey.
#[must_use]
pub fn change(a: &Thumbnail, b: &Thumbnail) -> Option<f64> {
    if (a.width_px, a.height_px) != (b.width_px, b.height_px) {
        return None;
    }
    let (a, b) = (normalised(&a.grey)?, normalised(&b.grey)?);
    let sum: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).sum();
    Some(sum / count(a.len()))
}

fn normalised(grey: &[u8]) -> Option<Vec<f64>> {
    let n = count(grey.len());
    let mean = grey.iter().map(|g| f64::from(*g)).sum::<f64>() / n;
    let sd = (grey.iter().map(|g| (f64::from(*g) - mean).powi(2)).sum::<f64>() / n).sqrt();
    (sd >= 1.0).then(|| grey.iter().map(|g| (f64::from(*g) - mean) / sd).collect())
}

#[expect(clippy::cast_precision_loss, reason = "a count of pixels of a small picture")]
fn count(n: usize) -> f64 {
    n as f64
}
