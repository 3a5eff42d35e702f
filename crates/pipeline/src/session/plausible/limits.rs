//! The limits of what is plausible, each with its reason. Every study that ships with the program, and every one that it simulates, lies
//! within them.

use std::ops::RangeInclusive;

/// Fewer images than this say nothing about a session as a whole.
pub(super) const LEAST_IMAGES: usize = 3;
/// The median pitch of a session, degrees. A wearer who eats looks 30 to 65 degrees down with the camera of the glasses; benches of the
/// paper reach from 38 to 72 degrees. At 10 degrees the table is met at its far end, at 80 the wearer looks at his own feet.
pub(super) const MEDIAN_PITCH_DEG: RangeInclusive<f64> = 10.0..=80.0;
/// The largest median roll of a session, degrees, to either side. A head that is held aslant for long is so by 10 to 15 degrees.
pub(super) const MOST_MEDIAN_ROLL_DEG: f64 = 30.0;
/// The largest difference between a bench's nominal pitch and the measured median, degrees: people set protractors to about 2 degrees.
pub(super) const MOST_OFF_SETUP_DEG: f64 = 10.0;
/// The median range of a session, mm: a face is more than 150 mm from a plate, and less than 1500 mm from the table or floor before it.
pub(super) const MEDIAN_RANGE_MM: RangeInclusive<f64> = 150.0..=1500.0;
/// The median length of gravity, g. A sensor that is out by more than an offset and a scale of its data sheet has another unit.
pub(super) const MEDIAN_GRAVITY_G: RangeInclusive<f64> = 0.7..=1.4;
/// The largest distance of the principal point from the middle of the picture, as a part of its width and height. Lenses are centred to 2 or
/// 3 %; swapped coordinates of a 4:3 picture are out by 12 and 17 %.
pub(super) const MOST_OFF_CENTRE: f64 = 0.1;
/// The field of view across the picture, degrees. A camera on glasses sees a whole table; no lens of this kind sees behind itself.
pub(super) const FIELD_OF_VIEW_DEG: RangeInclusive<f64> = 20.0..=180.0;
/// The largest field of view of a lens model that maps a plane to a plane, degrees: beyond, the picture's edge would be at 5.7 focal
/// lengths.
pub(super) const MOST_RECTILINEAR_DEG: f64 = 160.0;
/// The largest ratio of the two focal lengths in pixels: pixels are square, and the paper's corrected pictures stretch one side by 7 %.
pub(super) const MOST_FOCAL_RATIO: f64 = 1.25;
