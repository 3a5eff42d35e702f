//! Decides which rims of a session belong to one container.
//!
//! The camera sees where a rim lies relative to itself. Where the wearer is, and which way he faces, is not known, so places
//! on the table are comparable only between images near in time, and roughly. Two containers of one size that are never in
//! one image together cannot be told apart. Where they are, a link that is not clear is not made: it is better that one
//! container has two names than that two containers share one.

use std::collections::BTreeSet;

use super::table::OnTable;
use super::track::{Sighting, Track};

/// Diameters that differ by more than this many of their joint standard uncertainties belong to two containers.
const SAME_SIZE: f64 = 2.0;
/// The same limit where place and time say that it is one thing.
const SAME_PLACE_SIZE: f64 = 3.0;
/// Within this time a head stays in about the same place.
const NEAR_S: f64 = 30.0;
/// The standard deviation of a container's place between two such images, from turning and leaning.
const PLACE_MM: f64 = 100.0;
/// A turn about the vertical keeps the distance; leaning changes it by less than this between two such images.
const LEAN_MM: f64 = 250.0;
/// Places closer than this are the same, in squared standard deviations.
const SAME_PLACE: f64 = 2.25;
/// The squared standard deviations that stand for a place that says nothing.
const NO_PLACE: f64 = 9.0;
/// A link is clear when no other one comes within this of it, in squared standard deviations.
const CLEAR: f64 = 4.0;

/// The containers, in the order in which they are first seen. `seen` must be in the order of time; sightings in one image
/// are of as many containers. Where places on one table are known, they decide before sizes do.
pub(super) fn containers(seen: &[Sighting], on_table: &[OnTable]) -> Vec<Track> {
    let mut tracks: Vec<Track> = Vec::new();
    let mut first = 0;
    for image in seen.chunk_by(|a, b| a.image == b.image) {
        for ((sighting, link), number) in image.iter().zip(links(image, &tracks, seen)).zip(first..) {
            match link {
                Some(at) => tracks[at].add(number, sighting),
                None => tracks.push(Track::from_sighting(number, sighting)),
            }
        }
        first += image.len();
    }
    joined(placed(tracks, seen, on_table), seen)
}

/// The tracks after what lies at one place has been put together, and what lies at several has been taken apart.
fn placed(tracks: Vec<Track>, seen: &[Sighting], on_table: &[OnTable]) -> Vec<Track> {
    let place_of = |member: usize| on_table.iter().position(|one| one.members.contains(&member));
    let mut at_places: Vec<Vec<usize>> = on_table.iter().map(|one| one.members.clone()).collect();
    let mut elsewhere: Vec<Vec<usize>> = Vec::new();
    for track in &tracks {
        let image = |member: usize| seen[member].image;
        let (known, unknown): (Vec<usize>, Vec<usize>) =
            track.members.iter().partition(|member| place_of(**member).is_some());
        // Images that are not tied say nothing of a place: they go with the place of most of their track, unless that is in one of
        // these images as well.
        let most =
            (0..on_table.len()).max_by_key(|place| known.iter().filter(|m| place_of(**m) == Some(*place)).count());
        let joins = most.filter(|place| {
            !known.is_empty() && unknown.iter().all(|u| at_places[*place].iter().all(|m| image(*m) != image(*u)))
        });
        match joins {
            Some(place) => at_places[place].extend(unknown),
            None => elsewhere.push(unknown),
        }
    }
    let of_members = |mut members: Vec<usize>| {
        members.sort_unstable();
        let (first, others) = members.split_first()?;
        let mut track = Track::from_sighting(*first, &seen[*first]);
        others.iter().for_each(|member| track.add(*member, &seen[*member]));
        Some(track)
    };
    let mut tracks: Vec<Track> = at_places.into_iter().chain(elsewhere).filter_map(of_members).collect();
    tracks.sort_by_key(|track| track.members.first().copied());
    tracks
}

/// The number of the track that each sighting of one image belongs to, where that is clear. The cheapest link is made first.
fn links(image: &[Sighting], tracks: &[Track], seen: &[Sighting]) -> Vec<Option<usize>> {
    let mut costs: Vec<(f64, usize, usize)> = Vec::new();
    for (i, sighting) in image.iter().enumerate() {
        let alone = Track::from_sighting(i, sighting);
        costs.extend(tracks.iter().enumerate().filter_map(|(t, track)| {
            let last = seen.get(*track.members.last()?)?;
            let far = far(sighting, last)?;
            let most = if far <= SAME_PLACE { SAME_PLACE_SIZE } else { SAME_SIZE };
            Some((alone.unlike(track, most)? + far, i, t))
        }));
    }
    costs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut links = vec![None; image.len()];
    let mut used = BTreeSet::new();
    for &(least, i, t) in &costs {
        if links[i].is_some() || used.contains(&t) {
            continue;
        }
        // The rival is another track for this rim (two tracks that were never seen together may be one), or another rim for
        // this track.
        let rival = costs.iter().take_while(|(cost, ..)| *cost < least + CLEAR).any(|&(_, other_i, other_t)| {
            let is_other = if other_i == i { are_two(&tracks[t], &tracks[other_t]) } else { other_t == t };
            is_other && links[other_i].is_none() && !used.contains(&other_t)
        });
        if !rival {
            links[i] = Some(t);
            used.insert(t);
        }
    }
    links
}

/// Whether two tracks are two containers for sure, because one image shows both.
fn are_two(a: &Track, b: &Track) -> bool {
    a.members.first() != b.members.first() && !a.images.is_disjoint(&b.images)
}

/// How unlikely it is, by their places, that two sightings are of one container (squared standard deviations); none where
/// they cannot be.
fn far(a: &Sighting, b: &Sighting) -> Option<f64> {
    if a.time.seconds_since(b.time).abs() > NEAR_S {
        return Some(NO_PLACE);
    }
    let ([ax, ay], [bx, by]) = (a.at_mm, b.at_mm);
    let far = ((ax - bx).hypot(ay - by) / PLACE_MM).powi(2).min(NO_PLACE);
    ((ax.hypot(ay) - bx.hypot(by)).abs() <= LEAN_MM).then_some(far)
}

/// The tracks after those have been joined that turn out to be of one container once all images are known: a second track
/// begins where one image showed an odd size, or where a link was not clear then. The likeliest pair is joined first.
fn joined(mut tracks: Vec<Track>, seen: &[Sighting]) -> Vec<Track> {
    while tracks.len() <= MOST_TO_JOIN {
        let pairs = Pairs::between(&tracks);
        let is_join = |&&(least, a, b): &&(f64, usize, usize)| {
            !pairs.are_two[a][b] && pairs.is_clear(least, a, b) && !is_leap(&tracks[a], &tracks[b], seen)
        };
        let Some(&(_, a, b)) = pairs.by_cost.iter().find(is_join) else { break };
        let other = tracks.remove(b);
        tracks[a].append(other);
    }
    tracks
}

/// No table has so many containers. With more tracks the rims must be of something else, and comparing every pair with every
/// track would take too long.
const MOST_TO_JOIN: usize = 200;

/// For any two tracks, how unlikely they are to be one, and whether they are two for sure.
struct Pairs {
    unlike: Vec<Vec<Option<f64>>>,
    are_two: Vec<Vec<bool>>,
    /// Pairs with the number of the first below that of the second, the likeliest pair first.
    by_cost: Vec<(f64, usize, usize)>,
}

impl Pairs {
    fn between(tracks: &[Track]) -> Self {
        let unlike = tracks.iter().map(|a| tracks.iter().map(|b| a.unlike(b, SAME_SIZE)).collect()).collect();
        let are_two = tracks.iter().map(|a| tracks.iter().map(|b| are_two(a, b)).collect()).collect();
        let mut pairs = Self { unlike, are_two, by_cost: Vec::new() };
        for (a, costs) in pairs.unlike.iter().enumerate() {
            let after = costs.iter().enumerate().skip(a + 1);
            pairs.by_cost.extend(after.filter_map(|(b, cost)| Some(((*cost)?, a, b))));
        }
        pairs.by_cost.sort_by(|x, y| x.0.total_cmp(&y.0).then((x.1, x.2).cmp(&(y.1, y.2))));
        pairs
    }

    /// Whether the pair is clear: no third track is about as likely to be one with either of the two while it is another
    /// than the other for sure.
    fn is_clear(&self, least: f64, a: usize, b: usize) -> bool {
        let is_rival = |third: usize, mine: usize, other: usize| {
            let is_near = self.unlike[third][mine].is_some_and(|cost| cost < least + CLEAR);
            is_near && !self.are_two[third][mine] && self.are_two[third][other]
        };
        let mut others = (0..self.unlike.len()).filter(|third| ![a, b].contains(third));
        !others.any(|third| is_rival(third, a, b) || is_rival(third, b, a))
    }
}

/// Whether the container would have had to move, between two images near in time, further than a head can make it seem to.
fn is_leap(a: &Track, b: &Track, seen: &[Sighting]) -> bool {
    let mut begin = 0;
    for one in a.members.iter().filter_map(|&number| seen.get(number)) {
        let others = || b.members.iter().filter_map(|&number| seen.get(number));
        begin += others().skip(begin).take_while(|other| one.time.seconds_since(other.time) > NEAR_S).count();
        let near = others().skip(begin).take_while(|other| other.time.seconds_since(one.time) <= NEAR_S);
        if near.map(|other| far(one, other)).any(|far| far.is_none()) {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests;
