//! Corners of the table's texture.

use crate::ground::Ground;

/// A pixel is a corner where 9 neighbours in a row on the circle about it are all this much brighter, or all this much darker.
const THRESHOLD: i16 = 8;
const IN_A_ROW: u32 = 9;
/// The circle of 16 pixels, from above, clockwise.
const CIRCLE: [(isize, isize); 16] = [
    (0, -3),
    (1, -3),
    (2, -2),
    (3, -1),
    (3, 0),
    (3, 1),
    (2, 2),
    (1, 3),
    (0, 3),
    (-1, 3),
    (-2, 2),
    (-3, 1),
    (-3, 0),
    (-3, -1),
    (-2, -2),
    (-1, -3),
];
/// Harris' measure is taken over a window of so many pixels to each side, with his usual constant.
const WINDOW: usize = 3;
const HARRIS_K: f32 = 0.04;
/// No more corners than this are kept in a cell of so many pixels: a rich part of the table must not take the room of all others.
const CELL_PX: usize = 60;
const MOST_IN_CELL: usize = 14;

/// A corner, in pixels of the raster.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Corner {
    pub column: usize,
    pub row: usize,
    /// Its place, to a fraction of a pixel.
    pub place: [f64; 2],
    pub strength: f32,
}

/// The corners about which `margin` pixels are seen, the strongest first.
pub(crate) fn corners(ground: &Ground, margin: usize, most: usize) -> Vec<Corner> {
    let margin = margin.max(WINDOW + 2);
    let mut strengths = vec![0.0_f32; ground.luma.len()];
    let mut candidates = Vec::new();
    let circle = CIRCLE.map(|(x, y)| y * ground.width.cast_signed() + x);
    for row in margin..ground.height.saturating_sub(margin) {
        for column in margin..ground.width.saturating_sub(margin) {
            if is_fast(&ground.luma, row * ground.width + column, &circle) && ground.is_clear(column, row, margin) {
                strengths[row * ground.width + column] = harris(ground, column, row);
                candidates.push((column, row));
            }
        }
    }
    let mut corners: Vec<Corner> =
        candidates.into_iter().filter_map(|at| strongest_here(ground, &strengths, at)).collect();
    corners.sort_by(|a, b| b.strength.total_cmp(&a.strength).then((a.row, a.column).cmp(&(b.row, b.column))));
    let columns = ground.width / CELL_PX + 1;
    let mut in_cell = vec![0; columns * (ground.height / CELL_PX + 1)];
    corners.retain(|corner| {
        let count = &mut in_cell[corner.row / CELL_PX * columns + corner.column / CELL_PX];
        *count += 1;
        *count <= MOST_IN_CELL
    });
    corners.truncate(most);
    corners
}

fn is_fast(luma: &[u8], at: usize, circle: &[isize; 16]) -> bool {
    let middle = i16::from(luma[at]);
    let difference = |i: usize| i16::from(luma[at.wrapping_add_signed(circle[i])]) - middle;
    // Of 9 in a row, one of any two that are opposite is among them.
    let differs = |i: usize| difference(i).abs() > THRESHOLD;
    if !(differs(0) || differs(8)) || !(differs(4) || differs(12)) {
        return false;
    }
    let (mut brighter, mut darker) = (0_u32, 0_u32);
    for i in 0..16 {
        let difference = difference(i);
        brighter |= u32::from(difference > THRESHOLD) << i;
        darker |= u32::from(difference < -THRESHOLD) << i;
    }
    has_run(brighter) || has_run(darker)
}

/// Whether so many bits follow each other around the circle.
fn has_run(bits: u32) -> bool {
    let mut run = bits | bits << 16;
    for _ in 1..IN_A_ROW {
        run &= run >> 1;
    }
    run != 0
}

fn harris(ground: &Ground, column: usize, row: usize) -> f32 {
    let at = |x: usize, y: usize| f32::from(ground.luma[y * ground.width + x]);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for y in row - WINDOW..=row + WINDOW {
        for x in column - WINDOW..=column + WINDOW {
            let dx = at(x + 1, y - 1) + 2.0 * at(x + 1, y) + at(x + 1, y + 1)
                - at(x - 1, y - 1)
                - 2.0 * at(x - 1, y)
                - at(x - 1, y + 1);
            let dy = at(x - 1, y + 1) + 2.0 * at(x, y + 1) + at(x + 1, y + 1)
                - at(x - 1, y - 1)
                - 2.0 * at(x, y - 1)
                - at(x + 1, y - 1);
            xx += dx * dx;
            xy += dx * dy;
            yy += dy * dy;
        }
    }
    xx * yy - xy * xy - HARRIS_K * (xx + yy) * (xx + yy)
}

/// The corner at a place that is no weaker than its neighbours.
fn strongest_here(ground: &Ground, strengths: &[f32], (column, row): (usize, usize)) -> Option<Corner> {
    let at = |x: isize, y: isize| strengths[row.wrapping_add_signed(y) * ground.width + column.wrapping_add_signed(x)];
    let strength = at(0, 0);
    let neighbours = (-1..=1).flat_map(|y| (-1..=1).map(move |x| (x, y))).filter(|at| *at != (0, 0));
    // Of two that are equal the one that comes later is kept.
    let is_strongest =
        neighbours.clone().all(|(x, y)| if (y, x) > (0, 0) { strength > at(x, y) } else { strength >= at(x, y) });
    if !(strength > 0.0 && is_strongest) {
        return None;
    }
    let peak = |before: f32, after: f32| {
        let bend = before - 2.0 * strength + after;
        if bend < 0.0 { f64::from((0.5 * (before - after) / bend).clamp(-0.5, 0.5)) } else { 0.0 }
    };
    // Where a neighbour is no corner itself, its measure was not taken.
    let whole = |before: f32, after: f32| if before > 0.0 && after > 0.0 { peak(before, after) } else { 0.0 };
    #[expect(clippy::cast_precision_loss, reason = "some hundreds")]
    let place = [column as f64 + whole(at(-1, 0), at(1, 0)), row as f64 + whole(at(0, -1), at(0, 1))];
    Some(Corner { column, row, place, strength })
}
