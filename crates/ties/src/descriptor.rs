//! Binary descriptors of corners, turned with what they show.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use crate::ground::Ground;

/// The number of comparisons, a bit each.
const BITS: usize = 256;
/// Test points lie within this many pixels of the corner, to each side; their standard deviation is about two fifths of it.
const REACH: i32 = 13;
/// The brightness within this many pixels gives the direction of a corner.
const DIRECTION_PX: isize = 15;
/// Directions are rounded to one of so many.
const DIRECTIONS: usize = 30;
/// Corners nearer to what is not seen have no descriptor: test points turned by any angle lie within.
pub(crate) const MARGIN: usize = 20;

/// A descriptor; two that differ in few bits show the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Descriptor([u64; BITS / 64]);

impl Descriptor {
    /// The number of bits in which two differ.
    pub fn distance(&self, other: &Self) -> u32 {
        self.0.iter().zip(other.0).map(|(a, b)| (a ^ b).count_ones()).sum()
    }
}

/// The raster, with the blurred one whose pixels are compared.
pub(crate) struct Describer<'a> {
    ground: &'a Ground,
    blurred: Vec<u16>,
}

type Offset = (isize, isize);

/// For each direction the pairs of test points, as offsets of columns and rows.
static PATTERNS: LazyLock<Vec<[[Offset; 2]; BITS]>> = LazyLock::new(|| {
    let pattern = pattern();
    #[expect(clippy::cast_precision_loss, reason = "a small number")]
    let turned = |direction: usize| {
        let (sin, cos) = (TAU * direction as f64 / DIRECTIONS as f64).sin_cos();
        #[expect(clippy::cast_possible_truncation, reason = "some pixels")]
        let turn = |[x, y]: [i32; 2]| {
            let (x, y) = (f64::from(x), f64::from(y));
            ((cos * x - sin * y).round() as isize, (sin * x + cos * y).round() as isize)
        };
        pattern.map(|pair| pair.map(turn))
    };
    (0..DIRECTIONS).map(turned).collect()
});

/// Pairs of points about the corner, drawn as sums of even numbers, which are nearly normal; without floating point, so that every
/// machine has the same.
fn pattern() -> [[[i32; 2]; 2]; BITS] {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut draw = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        i32::try_from(state >> 33 & 0xff).unwrap_or(0) - 128
    };
    let mut coordinate = || ((0..4).map(|_| draw()).sum::<i32>() / 27).clamp(-REACH, REACH);
    [(); BITS].map(|()| [[coordinate(), coordinate()], [coordinate(), coordinate()]])
}

impl<'a> Describer<'a> {
    pub fn new(ground: &'a Ground) -> Self {
        Self { ground, blurred: blurred(ground) }
    }

    /// The descriptor of a corner at least [`MARGIN`] from the border.
    pub fn describe(&self, column: usize, row: usize) -> Descriptor {
        let width = self.ground.width;
        let at = |(x, y): Offset| self.blurred[row.wrapping_add_signed(y) * width + column.wrapping_add_signed(x)];
        let mut bits = [0_u64; BITS / 64];
        for (i, [a, b]) in PATTERNS[self.direction(column, row)].iter().enumerate() {
            bits[i / 64] |= u64::from(at(*a) < at(*b)) << (i % 64);
        }
        Descriptor(bits)
    }

    /// The direction from the corner to the centroid of brightness about it.
    #[expect(clippy::cast_precision_loss, reason = "a sum of bytes over some hundred pixels")]
    #[expect(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "a small positive number")]
    fn direction(&self, column: usize, row: usize) -> usize {
        let (mut along_x, mut along_y) = (0_i64, 0_i64);
        for y in -DIRECTION_PX..=DIRECTION_PX {
            let line = row.wrapping_add_signed(y) * self.ground.width + column;
            for x in -DIRECTION_PX..=DIRECTION_PX {
                if x * x + y * y <= DIRECTION_PX * DIRECTION_PX {
                    let value = i64::from(self.ground.luma[line.wrapping_add_signed(x)]);
                    along_x += value * x as i64;
                    along_y += value * y as i64;
                }
            }
        }
        let turns = (along_y as f64).atan2(along_x as f64) / TAU;
        ((turns + 1.0) * DIRECTIONS as f64).round() as usize % DIRECTIONS
    }
}

/// Sums of three pixels, twice along each axis: nearly a normal blur of 1.2 pixels. The largest, 81 times 255, fits.
fn blurred(ground: &Ground) -> Vec<u16> {
    let mut values: Vec<u16> = ground.luma.iter().map(|value| u16::from(*value)).collect();
    for step in [1, ground.width, 1, ground.width] {
        let before = values.clone();
        for (i, value) in values.iter_mut().enumerate().skip(step).take(before.len().saturating_sub(2 * step)) {
            *value = before[i - step] + before[i] + before[i + step];
        }
    }
    values
}
