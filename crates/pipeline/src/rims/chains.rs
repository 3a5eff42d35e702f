//! Edges linked to chains.

use super::edges::{Edges, NONE};

/// Shorter chains are texture.
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
                next[index as usize] = best_neighbour(found, x, y, index, 1.0);
                previous[index as usize] = best_neighbour(found, x, y, index, -1.0);
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

/// The nearest edge among the eight neighbours ahead (`sense` 1) or behind (-1) whose gradient points alike.
fn best_neighbour(found: &Edges, x: usize, y: usize, index: u32, sense: f32) -> u32 {
    let e = found.edges[index as usize];
    let size = e.gx.hypot(e.gy);
    let (tx, ty) = (sense * e.gy / size, -sense * e.gx / size);
    let (mut best, mut best_cost) = (NONE, f32::INFINITY);
    for row in y - 1..=y + 1 {
        for column in x - 1..=x + 1 {
            let other = found.at[row * found.width + column];
            if other == NONE || other == index {
                continue;
            }
            let o = found.edges[other as usize];
            let (dx, dy) = (o.x - e.x, o.y - e.y);
            let ahead = dx * tx + dy * ty;
            let alike = (e.gx * o.gx + e.gy * o.gy) / (size * o.gx.hypot(o.gy));
            if ahead <= 0.0 || alike < LEAST_COSINE {
                continue;
            }
            let cost = (dx * ty - dy * tx).abs() + 0.3 * ahead;
            if cost < best_cost {
                (best, best_cost) = (other, cost);
            }
        }
    }
    best
}
