//! Which rims of a session are one container.
//!
//! The camera sees where a rim is from itself. Where the wearer is, and which way he faces, nobody knows, so the place on the
//! table is comparable only between images near in time, and roughly. Two containers of one kind and size that are never in one
//! image together cannot be told apart. Of two that are, a link that is not clear is not made: a container then has two names
//! rather than two containers one.

use std::collections::BTreeSet;

use model::{Kind, UtcNs};

/// A rim as far as it can be recognised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sighting {
    /// Number of its image in the session.
    pub image: usize,
    pub time: UtcNs,
    pub kind: Kind,
    /// Diameter, or length of a rectangle.
    pub diameter_mm: f64,
    /// Width of a rectangle; none of a round one.
    pub width_mm: Option<f64>,
    /// Its standard uncertainty against other images of the session: without most of what all of them share.
    pub sigma_mm: f64,
    /// Its centre: world X, Y, from the point of the table under the camera.
    pub at_mm: [f64; 2],
}

/// Diameters that differ by more than this many of their joint standard uncertainties are two containers'.
const SAME_SIZE: f64 = 2.0;
/// Within this time a head stays about where it is.
const NEAR_S: f64 = 30.0;
/// Standard deviation of a container's place between two such images, from turning and leaning.
const PLACE_MM: f64 = 100.0;
/// A turn about the vertical keeps the distance; leaning changes it by less than this between such images.
const LEAN_MM: f64 = 250.0;
/// Squared standard deviations that stand for a place that tells nothing.
const NO_PLACE: f64 = 9.0;
/// A link is clear when no other is within this of it, in squared standard deviations.
const CLEAR: f64 = 4.0;

/// A container that has been seen.
struct Track {
    number: u32,
    /// The sighting with the surest size, and the last one.
    surest: Sighting,
    last: Sighting,
    /// Tracks that were in one image with it, and are another container for sure.
    beside: BTreeSet<usize>,
}

/// Numbers of the containers, from 1 in the order in which they are first seen; `taken` are left out. `seen` is in the order
/// of time; sightings in one image are of as many containers.
pub(super) fn names(seen: &[Sighting], taken: &BTreeSet<u32>) -> Vec<u32> {
    let mut tracks: Vec<Track> = Vec::new();
    let mut free = (1..).filter(|number| !taken.contains(number));
    let mut numbers = Vec::with_capacity(seen.len());
    for image in seen.chunk_by(|a, b| a.image == b.image) {
        let links = links(image, &tracks);
        let mut here = BTreeSet::new();
        for (sighting, link) in image.iter().zip(links) {
            let at = link.unwrap_or(tracks.len());
            if link.is_none() {
                let number = free.next().unwrap_or(u32::MAX);
                tracks.push(Track { number, surest: *sighting, last: *sighting, beside: BTreeSet::new() });
            }
            let track = &mut tracks[at];
            track.last = *sighting;
            if sighting.sigma_mm < track.surest.sigma_mm {
                track.surest = *sighting;
            }
            numbers.push(track.number);
            here.insert(at);
        }
        for &at in &here {
            tracks[at].beside.extend(here.iter().filter(|&&other| other != at));
        }
    }
    numbers
}

/// The track of every sighting of one image, where that is clear. The cheapest link is made first.
fn links(image: &[Sighting], tracks: &[Track]) -> Vec<Option<usize>> {
    let mut costs: Vec<(f64, usize, usize)> = Vec::new();
    for (i, sighting) in image.iter().enumerate() {
        costs.extend(tracks.iter().enumerate().filter_map(|(t, track)| Some((cost(sighting, track)?, i, t))));
    }
    costs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut links = vec![None; image.len()];
    let mut used = BTreeSet::new();
    for &(least, i, t) in &costs {
        if links[i].is_some() || used.contains(&t) {
            continue;
        }
        // Another track for this rim (two that were never seen together may be one), or another rim for this track.
        let rival = costs.iter().take_while(|(cost, ..)| *cost < least + CLEAR).any(|&(_, other_i, other_t)| {
            let is_other = if other_i == i { tracks[t].beside.contains(&other_t) } else { other_t == t };
            is_other && links[other_i].is_none() && !used.contains(&other_t)
        });
        if !rival {
            links[i] = Some(t);
            used.insert(t);
        }
    }
    links
}

/// How unlikely it is that both are one container; none when they are not.
fn cost(sighting: &Sighting, track: &Track) -> Option<f64> {
    let sigma_mm = sighting.sigma_mm.hypot(track.surest.sigma_mm).max(f64::MIN_POSITIVE);
    let size = (sighting.diameter_mm - track.surest.diameter_mm) / sigma_mm;
    if sighting.kind != track.surest.kind || size.is_nan() || size.abs() > SAME_SIZE {
        return None;
    }
    let is_as_wide = match (sighting.width_mm, track.surest.width_mm) {
        (None, None) => true,
        (Some(one), Some(other)) => (one - other).abs() <= SAME_SIZE * sigma_mm,
        (None, Some(_)) | (Some(_), None) => false,
    };
    if !is_as_wide {
        return None;
    }
    let [a, b] = [sighting.at_mm, track.last.at_mm];
    let apart_s = sighting.time.seconds_since(track.last.time).abs();
    let place = if apart_s > NEAR_S {
        NO_PLACE
    } else if (a[0].hypot(a[1]) - b[0].hypot(b[1])).abs() > LEAN_MM {
        return None;
    } else {
        ((a[0] - b[0]).hypot(a[1] - b[1]) / PLACE_MM).powi(2).min(NO_PLACE)
    };
    Some(size * size + place)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bowl(at_s: i64, diameter_mm: f64, at_mm: [f64; 2]) -> Sighting {
        let time = UtcNs(at_s * 1_000_000_000);
        Sighting {
            image: usize::try_from(at_s).unwrap_or(0),
            time,
            kind: Kind::Bowl,
            diameter_mm,
            width_mm: None,
            sigma_mm: 0.03 * diameter_mm,
            at_mm,
        }
    }

    fn named(seen: &[Sighting]) -> Vec<u32> {
        names(seen, &BTreeSet::new())
    }

    #[test]
    fn one_container_keeps_its_name_however_the_head_turns() {
        let seen: Vec<Sighting> = (0..20)
            .map(|i| {
                let yaw = 0.4 * f64::from(i).sin();
                bowl(10 * i64::from(i), 150.0 + f64::from(i % 3), [400.0 * yaw.sin(), 400.0 * yaw.cos()])
            })
            .collect();
        assert_eq!(named(&seen), vec![1; 20]);
        let late = bowl(10_000, 151.0, [-300.0, 100.0]);
        assert_eq!(named(&[seen[0], late]), [1, 1], "long after, its size is enough");
    }

    #[test]
    fn other_sizes_and_kinds_are_others() {
        let plate = Sighting { kind: Kind::Plate, ..bowl(10, 150.0, [0.0, 300.0]) };
        assert_eq!(named(&[bowl(0, 150.0, [0.0, 300.0]), plate, bowl(20, 190.0, [0.0, 300.0])]), [1, 2, 3]);
    }

    #[test]
    fn rectangles_are_told_apart_by_both_sides_and_from_what_is_round() {
        let plate = |at_s, width_mm| Sighting { width_mm, ..bowl(at_s, 200.0, [0.0, 300.0]) };
        let seen = [plate(0, Some(150.0)), plate(10, Some(152.0)), plate(20, Some(190.0)), plate(30, None)];
        assert_eq!(named(&seen), [1, 1, 2, 3]);
    }

    #[test]
    fn equal_bowls_are_told_apart_by_their_places() {
        let pair =
            |at_s, shift: f64| [bowl(at_s, 150.0, [-200.0 + shift, 350.0]), bowl(at_s, 150.0, [200.0 + shift, 350.0])];
        let [a, b] = pair(0, 0.0);
        let [c, d] = pair(10, 60.0);
        assert_eq!(named(&[a, b, d, c]), [1, 2, 2, 1], "whatever their order");
    }

    #[test]
    fn what_is_not_clear_is_not_linked() {
        let first = [bowl(0, 150.0, [-200.0, 350.0]), bowl(0, 150.0, [200.0, 350.0])];
        let later = bowl(3_600, 150.0, [0.0, 350.0]);
        let then = bowl(3_610, 150.0, [20.0, 350.0]);
        assert_eq!(named(&[first[0], first[1], later, then]), [1, 2, 3, 3]);
        let two = [bowl(3_600, 150.0, [-50.0, 350.0]), bowl(3_600, 151.0, [50.0, 350.0])];
        assert_eq!(named(&[first[0], two[0], two[1]]), [1, 2, 3]);
    }

    #[test]
    fn tracks_that_were_never_seen_together_do_not_split_for_ever() {
        let far = bowl(10, 150.0, [0.0, 900.0]); // nobody leans so far in 10 s
        let later = [bowl(600, 150.0, [0.0, 300.0]), bowl(1_200, 150.0, [0.0, 300.0])];
        let numbers = named(&[bowl(0, 150.0, [0.0, 300.0]), far, later[0], later[1]]);
        assert_eq!((&numbers[..2], numbers[2] == numbers[3]), (&[1, 2][..], true), "{numbers:?}");
    }

    #[test]
    fn taken_numbers_are_left_out() {
        let seen = [bowl(0, 100.0, [0.0, 300.0]), bowl(0, 200.0, [200.0, 300.0])];
        assert_eq!(names(&seen, &BTreeSet::from([1, 3])), [2, 4]);
    }

    #[test]
    fn odd_numbers_are_no_trouble() {
        let odd = |diameter_mm, sigma_mm| Sighting { sigma_mm, ..bowl(0, diameter_mm, [f64::NAN, 0.0]) };
        let seen = [odd(f64::NAN, 1.0), odd(150.0, 0.0), odd(150.0, f64::INFINITY)];
        assert_eq!(named(&seen), [1, 2, 3]);
    }
}
