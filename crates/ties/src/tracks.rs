//! Tie points of several pictures, and the frame that they have in common.

use nalgebra::{Point2, Rotation2, Vector2};

use crate::features::Feature;
use crate::registration::{Registration, register};

/// A registration that differs from what the surer ones say by more than this is of something else.
const MOST_APART_MM: f64 = 40.0;
const MOST_APART_RAD: f64 = 0.1;
/// A session keeps no more tie points: more say little more, and take time to solve.
const MOST_TRACKS: usize = 90;
/// Tie points are spread over cells of the table of this side, in mm.
const CELL_MM: f64 = 60.0;

/// A feature of the table as one picture shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TiePoint {
    /// The number of the picture.
    pub picture: usize,
    /// The number of the feature; the same feature has the same number in all pictures.
    pub feature: usize,
    /// The pixel that shows it.
    pub pixel: Point2<f64>,
}

/// The place of a picture in the common frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// The turn of its own world frame, in radians, counter-clockwise from above.
    pub turn_rad: f64,
    /// The point under the camera, in mm.
    pub foot_mm: Point2<f64>,
}

/// The ties of a session's pictures.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Ties {
    /// The tie points, by feature, then by picture.
    pub points: Vec<TiePoint>,
    /// For each picture its first place; none where nothing ties it to the others. The first picture that has one defines the frame.
    pub placed: Vec<Option<Placed>>,
    /// The pairs of pictures that were registered, with the number of matches.
    pub registered: Vec<(usize, usize, usize)>,
}

/// Ties pictures by their features. The largest group of pictures that hang together has places; others have none.
#[must_use]
pub fn tie(pictures: &[Vec<Feature>]) -> Ties {
    let pairs = (0..pictures.len()).flat_map(|a| (a + 1..pictures.len()).map(move |b| (a, b)));
    let mut links: Vec<(usize, usize, Registration)> =
        pairs.filter_map(|(a, b)| Some((a, b, register(&pictures[a], &pictures[b])?))).collect();
    // The surest first, so that it decides where two contradict each other.
    links.sort_by(|x, y| y.2.inliers.len().cmp(&x.2.inliers.len()).then((x.0, x.1).cmp(&(y.0, y.1))));
    let groups = Groups::from_links(pictures.len(), &links);
    let placed = groups.placed();
    links.retain(|(a, b, link)| is_consistent(&placed, (*a, *b), link));
    let points = tracks(pictures, &links);
    let registered = links.iter().map(|(a, b, link)| (*a, *b, link.inliers.len())).collect();
    Ties { points, placed, registered }
}

/// Pictures that hang together by a tree of their surest links: for each the group, and its place in the frame of the group.
struct Groups {
    of: Vec<usize>,
    placed: Vec<Placed>,
}

impl Groups {
    fn from_links(count: usize, links: &[(usize, usize, Registration)]) -> Self {
        let alone = Placed { turn_rad: 0.0, foot_mm: Point2::origin() };
        let mut groups = Self { of: (0..count).collect(), placed: vec![alone; count] };
        for (a, b, link) in links {
            let (into, from) = (groups.of[*a], groups.of[*b]);
            if into == from {
                continue;
            }
            // Where b's own frame lies in the group of a, and so where the group of b lies.
            let there = link.placed().in_frame(&groups.placed[*a]);
            let moved = there.after_inverse(&groups.placed[*b]);
            for i in (0..count).filter(|i| groups.of[*i] == from).collect::<Vec<_>>() {
                groups.placed[i] = groups.placed[i].in_frame(&moved);
                groups.of[i] = into;
            }
        }
        groups
    }

    /// The places of the largest group, in the frame of its first picture.
    fn placed(&self) -> Vec<Option<Placed>> {
        let size = |group: usize| self.of.iter().filter(|of| **of == group).count();
        let largest = (0..self.of.len())
            .map(|i| self.of[i])
            .reduce(|best, group| if size(group) > size(best) { group } else { best });
        let Some(group) = largest.filter(|group| size(*group) > 1) else { return vec![None; self.of.len()] };
        let Some(root) = self.of.iter().position(|of| *of == group).map(|first| self.placed[first]) else {
            return vec![None; self.of.len()];
        };
        let back = Placed { turn_rad: 0.0, foot_mm: Point2::origin() }.after_inverse(&root);
        self.of.iter().zip(&self.placed).map(|(of, placed)| (*of == group).then(|| placed.in_frame(&back))).collect()
    }
}

impl Registration {
    fn placed(&self) -> Placed {
        Placed { turn_rad: self.turn_rad, foot_mm: Point2::from(self.shift_mm) }
    }
}

impl Placed {
    /// This place, which is given in a frame that lies at `frame`, in the frame in which that is given.
    fn in_frame(&self, frame: &Self) -> Self {
        let foot_mm = frame.foot_mm + Rotation2::new(frame.turn_rad) * self.foot_mm.coords;
        Self { turn_rad: self.turn_rad + frame.turn_rad, foot_mm }
    }

    /// The frame in which `other` would have to be given to lie here.
    fn after_inverse(&self, other: &Self) -> Self {
        let turn_rad = self.turn_rad - other.turn_rad;
        Self { turn_rad, foot_mm: self.foot_mm - Rotation2::new(turn_rad) * other.foot_mm.coords }
    }

    /// A point of the picture's own world frame in the common frame.
    #[must_use]
    pub fn common_mm(&self, own_mm: Point2<f64>) -> Point2<f64> {
        self.foot_mm + Rotation2::new(self.turn_rad) * own_mm.coords
    }
}

/// Whether a registration says about what the places say.
fn is_consistent(placed: &[Option<Placed>], (a, b): (usize, usize), link: &Registration) -> bool {
    let (Some(a), Some(b)) = (placed[a], placed[b]) else { return false };
    let there = link.placed().in_frame(&a);
    let turned = Rotation2::new(there.turn_rad - b.turn_rad).angle().abs();
    // Errors of range and pitch make shifts along a chain of pictures differ by a share of their length.
    let apart: Vector2<f64> = there.foot_mm - b.foot_mm;
    turned <= MOST_APART_RAD && apart.norm() <= MOST_APART_MM
}

/// The features that hang together by matches, those with a picture twice left out; the longest first in each part of the table.
fn tracks(pictures: &[Vec<Feature>], links: &[(usize, usize, Registration)]) -> Vec<TiePoint> {
    let starts: Vec<usize> = pictures
        .iter()
        .scan(0, |start, features| {
            let this = *start;
            *start += features.len();
            Some(this)
        })
        .collect();
    let mut parent: Vec<usize> = (0..pictures.iter().map(Vec::len).sum()).collect();
    for (a, b, link) in links {
        for (i, j) in &link.inliers {
            let (i, j) = (root(&mut parent, starts[*a] + i), root(&mut parent, starts[*b] + j));
            parent[i.max(j)] = i.min(j);
        }
    }
    let mut by_root: std::collections::BTreeMap<usize, Vec<(usize, usize)>> = std::collections::BTreeMap::new();
    for (picture, features) in pictures.iter().enumerate() {
        for feature in 0..features.len() {
            by_root.entry(root(&mut parent, starts[picture] + feature)).or_default().push((picture, feature));
        }
    }
    let is_track =
        |members: &&Vec<(usize, usize)>| members.len() > 1 && members.windows(2).all(|two| two[0].0 < two[1].0);
    let mut all: Vec<&Vec<(usize, usize)>> = by_root.values().filter(is_track).collect();
    all.sort_by_key(|members| std::cmp::Reverse(members.len()));
    spread(pictures, &all)
        .into_iter()
        .enumerate()
        .flat_map(|(feature, members)| members.iter().map(move |(picture, number)| (feature, *picture, *number)))
        .map(|(feature, picture, number)| TiePoint { picture, feature, pixel: pictures[picture][number].pixel })
        .collect()
}

/// As many tracks as are kept, taken in turn from all parts of the table.
fn spread<'a>(pictures: &[Vec<Feature>], all: &[&'a Vec<(usize, usize)>]) -> Vec<&'a Vec<(usize, usize)>> {
    let mut in_cell: std::collections::BTreeMap<(usize, i64, i64), usize> = std::collections::BTreeMap::new();
    let mut ranked: Vec<(usize, usize)> = all
        .iter()
        .enumerate()
        .map(|(i, members)| {
            let (picture, number) = members[0];
            let at_mm = pictures[picture][number].at_mm;
            #[expect(clippy::cast_possible_truncation, reason = "some cells")]
            let cell = (picture, (at_mm.x / CELL_MM).floor() as i64, (at_mm.y / CELL_MM).floor() as i64);
            let rank = in_cell.entry(cell).or_default();
            *rank += 1;
            (*rank, i)
        })
        .collect();
    ranked.sort_unstable();
    ranked.into_iter().take(MOST_TRACKS).map(|(_, i)| all[i]).collect()
}

fn root(parent: &mut [usize], mut at: usize) -> usize {
    while parent[at] != at {
        parent[at] = parent[parent[at]];
        at = parent[at];
    }
    at
}
