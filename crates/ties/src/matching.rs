//! Features of two pictures that look alike.

use crate::features::Feature;

/// The best match counts if its distance is below this share of that of the next best one elsewhere.
const RATIO: f64 = 0.9;
/// Features this close, in mm, are the same one at another scale.
const SAME_MM: f64 = 4.0;
/// Descriptors that differ in more bits show different things.
const MOST_BITS: u32 = 80;

/// Pairs of the numbers of features that look most alike, each feature in one pair at most.
pub(crate) fn matches(a: &[Feature], b: &[Feature]) -> Vec<(usize, usize)> {
    let forward = nearest(a, b);
    let backward = nearest(b, a);
    let pairs = forward.into_iter().enumerate().filter_map(|(i, j)| Some((i, j?)));
    pairs.filter(|(i, j)| is_same(backward[*j].map(|back| &a[back]), &a[*i])).collect()
}

fn is_same(one: Option<&Feature>, other: &Feature) -> bool {
    one.is_some_and(|one| (one.at_mm - other.at_mm).norm() < SAME_MM)
}

/// For each feature the one of the others that looks most like it, if no other one elsewhere looks about as much like it.
fn nearest(of: &[Feature], among: &[Feature]) -> Vec<Option<usize>> {
    let nearest_of = |feature: &Feature| {
        let mut best: Option<(u32, usize)> = None;
        let mut second = u32::MAX;
        for (j, other) in among.iter().enumerate() {
            let distance = feature.descriptor.distance(&other.descriptor);
            match best {
                Some((least, _)) if distance >= least => {
                    if distance < second && !is_same(best.map(|(_, at)| &among[at]), other) {
                        second = distance;
                    }
                }
                _ => {
                    if let Some((least, at)) = best
                        && !is_same(Some(&among[at]), other)
                    {
                        second = least;
                    }
                    best = Some((distance, j));
                }
            }
        }
        let (least, at) = best?;
        (least <= MOST_BITS && f64::from(least) < RATIO * f64::from(second)).then_some(at)
    };
    of.iter().map(nearest_of).collect()
}
