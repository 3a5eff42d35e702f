//! The eight ways in which EXIF tells viewers to turn or mirror a picture (tag Orientation, 0x0112).
//!
//! A picture has two frames: the *stored* one is the raster in the file, in which the sensor wrote it and to which a calibration
//! belongs; the *shown* one is what a viewer that follows the tag shows.

use serde::{Deserialize, Serialize};

/// How a stored picture is turned and mirrored before it is shown.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Orientation {
    /// 1: shown as it is stored.
    #[default]
    Upright,
    /// 2: left and right are exchanged.
    Mirrored,
    /// 3: turned by 180 degrees.
    HalfTurn,
    /// 4: top and bottom are exchanged.
    Flipped,
    /// 5: rows become columns.
    Transposed,
    /// 6: turned clockwise by 90 degrees.
    Clockwise,
    /// 7: mirrored at the other diagonal.
    Transverse,
    /// 8: turned counter-clockwise by 90 degrees.
    CounterClockwise,
}

impl Orientation {
    /// All orientations, in the order of their EXIF numbers from 1.
    pub const ALL: [Self; 8] = [
        Self::Upright,
        Self::Mirrored,
        Self::HalfTurn,
        Self::Flipped,
        Self::Transposed,
        Self::Clockwise,
        Self::Transverse,
        Self::CounterClockwise,
    ];

    /// The orientation of an EXIF number; none for a number that EXIF does not define, which viewers ignore.
    #[must_use]
    pub fn from_exif(number: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|orientation| orientation.exif() == number)
    }

    /// The EXIF number, 1 to 8.
    #[must_use]
    pub fn exif(self) -> u32 {
        self as u32 + 1
    }

    /// Whether width and height change places.
    #[must_use]
    pub fn swaps_sides(self) -> bool {
        self.exif() > 4
    }

    /// The width and height of the shown picture.
    #[must_use]
    pub fn shown_size_px(self, [width, height]: [u32; 2]) -> [u32; 2] {
        if self.swaps_sides() { [height, width] } else { [width, height] }
    }

    /// The place in the shown picture of a point of the stored one, whose size is given. Both count from the outer corner of the
    /// first pixel, as annotation tools do; pixel (i, j) has its centre at (i + 0.5, j + 0.5).
    #[must_use]
    pub fn shown_from_stored(self, [x, y]: [f64; 2], stored_px: [u32; 2]) -> [f64; 2] {
        let [width, height] = stored_px.map(f64::from);
        match self {
            Self::Upright => [x, y],
            Self::Mirrored => [width - x, y],
            Self::HalfTurn => [width - x, height - y],
            Self::Flipped => [x, height - y],
            Self::Transposed => [y, x],
            Self::Clockwise => [height - y, x],
            Self::Transverse => [height - y, width - x],
            Self::CounterClockwise => [y, width - x],
        }
    }

    /// The inverse of [`Self::shown_from_stored`]; the size is still the stored picture's.
    #[must_use]
    pub fn stored_from_shown(self, point: [f64; 2], stored_px: [u32; 2]) -> [f64; 2] {
        let inverse = match self {
            Self::Clockwise => Self::CounterClockwise,
            Self::CounterClockwise => Self::Clockwise,
            own_inverse => own_inverse,
        };
        inverse.shown_from_stored(point, self.shown_size_px(stored_px))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    /// A picture of 3 x 2 pixels with the values 0 to 5 by row, as PIL.ImageOps.exif_transpose (Pillow 13.0.0) shows it: width, and
    /// the values by row.
    const SHOWN_BY_PIL: [(u32, [usize; 6]); 8] = [
        (3, [0, 1, 2, 3, 4, 5]),
        (3, [2, 1, 0, 5, 4, 3]),
        (3, [5, 4, 3, 2, 1, 0]),
        (3, [3, 4, 5, 0, 1, 2]),
        (2, [0, 3, 1, 4, 2, 5]),
        (2, [3, 0, 4, 1, 5, 2]),
        (2, [5, 2, 4, 1, 3, 0]),
        (2, [2, 5, 1, 4, 0, 3]),
    ];

    #[test]
    #[expect(clippy::float_cmp, reason = "halves are exact")]
    fn pixels_go_where_pil_puts_them() {
        for (orientation, (width, shown)) in Orientation::ALL.into_iter().zip(SHOWN_BY_PIL) {
            assert_eq!(orientation.shown_size_px([3, 2])[0], width, "{orientation:?}");
            let width = width as usize;
            for (at, value) in shown.into_iter().enumerate() {
                let centre = |index: usize, width: usize| [index % width, index / width].map(|side| side as f64 + 0.5);
                let (stored, shown) = (centre(value, 3), centre(at, width));
                assert_eq!(orientation.shown_from_stored(stored, [3, 2]), shown, "{orientation:?}");
                assert_eq!(orientation.stored_from_shown(shown, [3, 2]), stored, "{orientation:?}");
            }
        }
    }

    #[test]
    fn numbers_of_exif() {
        assert_eq!(Orientation::from_exif(6), Some(Orientation::Clockwise));
        assert_eq!([0, 9].map(Orientation::from_exif), [None, None]);
    }
}
