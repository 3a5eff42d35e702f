//! Edges linked to chains.

use super::edge::{Edges, NONE};

/// Chains of fewer edges are taken for texture and left out.
const SHORTEST: usize = 8;
/// Gradients of neighbours on a chain differ by less than 40 degrees.
const LEAST_COSINE: f32 = 0.77;

/// Links every edge with the best neighbour before and after it; what links agree on is a chain. Along a chain, brighter
/// lies to the right in the picture (y down): the tangent is the gradient turned by a quarter.
pub(super) fn chains(found: &Edges) -> Vec<Vec<u32>> {
    let count = found.edges.len();
    let (mut next, mut previous) = (vec![NONE; count], vec![NONE; count]);
    for y in 1..found.height - 1 {
        for x in 1..found.width - 1 {
            let index = found.at[y * found.width + x];
            if index != NONE {
                (previous[index as usize], next[index as usize]) = best_neighbours(found, x, y, index);
            }
        }
    }
    let agreed = |a: u32, b: u32| b != NONE && previous[b as usize] == a;
    let mut used = vec![false; count];
    let mut chains = Vec::new();
    #[expect(clippy::cast_possible_truncation, reason = "indices of edges are u32")]
    for start in 0..count as u32 {
        if used[start as usize] {
            continue;
        }
        let mut first = start;
        loop {
            let before = previous[first as usize];
            if before == NONE || next[before as usize] != first || used[before as usize] || before == start {
                break;
            }
            first = before;
        }
        let mut chain = vec![first];
        used[first as usize] = true;
        let mut last = first;
        while agreed(last, next[last as usize]) && !used[next[last as usize] as usize] {
            last = next[last as usize];
            used[last as usize] = true;
            chain.push(last);
        }
        if chain.len() >= SHORTEST {
            chains.push(chain);
        }
    }
    chains
}

/// The nearest edges among the eight neighbours whose gradients point alike: one behind and one ahead.
fn best_neighbours(found: &Edges, x: usize, y: usize, index: u32) -> (u32, u32) {
    let e = found.edges[index as usize];
    let size = (e.gx * e.gx + e.gy * e.gy).sqrt();
    let (tx, ty) = (e.gy / size, -e.gx / size);
    let (mut before, mut before_cost) = (NONE, f32::INFINITY);
    let (mut after, mut after_cost) = (NONE, f32::INFINITY);
    for row in y - 1..=y + 1 {
        let first = row * found.width + x - 1;
        for other in &found.at[first..first + 3] {
            if *other == NONE || *other == index {
                continue;
            }
            let o = found.edges[*other as usize];
            let (dx, dy) = (o.x - e.x, o.y - e.y);
            let ahead = dx * tx + dy * ty;
            let cost = (dx * ty - dy * tx).abs() + 0.3 * ahead.abs();
            let alike = e.gx * o.gx + e.gy * o.gy;
            if alike < LEAST_COSINE * size * (o.gx * o.gx + o.gy * o.gy).sqrt() {
                continue;
            }
            if ahead > 0.0 && cost < after_cost {
                (after, after_cost) = (*other, cost);
            } else if ahead < 0.0 && cost < before_cost {
                (before, before_cost) = (*other, cost);
            }
        }
    }
    (before, after)
}
