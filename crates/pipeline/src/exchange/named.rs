//! Points with names, of CVAT's skeletons and COCO's keypoints: which of them are a line, and which an outline.

use std::collections::BTreeMap;

use model::Quantity;

use super::foreign::{NamedPoint, Sight, short};
use super::label::{What, all_codes};

/// Points that are one mark.
pub(super) struct Group {
    pub what: What,
    /// The points that are there, in order.
    points: Vec<([f64; 2], Sight)>,
}

impl Group {
    /// The points of the mark, and how many hidden ones were left out.
    ///
    /// # Errors
    /// A text, where an end of a line is missing or hidden, or a line has more ends than two.
    pub fn taken(&self, with_hidden: bool) -> Result<(Vec<[f64; 2]>, usize), String> {
        let is_taken = |sight: Sight| with_hidden || sight == Sight::Seen;
        let taken: Vec<_> = self.points.iter().filter(|(_, sight)| is_taken(*sight)).map(|(point, _)| *point).collect();
        let hidden = self.points.len() - taken.len();
        if let What::Line(quantity) = self.what {
            match self.points.len() {
                2 if hidden > 0 => {
                    return Err(format!("an end of {quantity} is marked as hidden, a guess (--with-hidden takes it)"));
                }
                2 => {}
                count => return Err(format!("expected 2 points for {quantity}, got {count}")),
            }
        }
        Ok((taken, hidden))
    }
}

/// The parts of a point's name.
struct Name<'a> {
    what: Option<What>,
    /// The text that follows: a number, or an end.
    rest: &'a str,
}

impl<'a> Name<'a> {
    /// The parts of `WHAT`, `WHAT_REST` (or with `-`, `.`, a space), or REST alone.
    fn parse(name: &'a str) -> Self {
        for what in What::all() {
            if let Some(rest) = name.strip_prefix(what.code()) {
                let separators = ['_', '-', '.', ' '];
                if rest.is_empty() || rest.starts_with(separators) {
                    return Self { what: Some(what), rest: rest.trim_start_matches(separators) };
                }
            }
        }
        Self { what: None, rest: name }
    }
}

/// The points of a skeleton by what they mark; `of_label` is what the label says that they are.
///
/// # Errors
/// A text on a name that is unclear, with what was expected.
pub(super) fn groups(points: &[NamedPoint], of_label: Option<What>) -> Result<Vec<Group>, String> {
    let mut by_what: BTreeMap<What, Vec<(&str, &NamedPoint)>> = BTreeMap::new();
    for point in points.iter().filter(|point| point.sight != Sight::Absent) {
        let mut name = Name::parse(&point.name);
        if name.what != of_label && matches!(of_label, Some(What::Line(_))) {
            name = Name { what: None, rest: &point.name }; // "foot" and "rim" are the ends of a line
        }
        let what = match (name.what, of_label) {
            (Some(own), Some(label)) if own != label => {
                let (name, label) = (short(&point.name), label.code());
                return Err(format!("point '{name}' in a skeleton of {label}"));
            }
            (Some(what), _) | (None, Some(what)) => what,
            (None, None) => return Err(unclear(&point.name)),
        };
        by_what.entry(what).or_default().push((name.rest, point));
    }
    let group = |(what, points)| Ok(Group { what, points: in_order(what, points)? });
    by_what.into_iter().map(group).collect()
}

fn unclear(name: &str) -> String {
    let (name, codes) = (short(name), all_codes());
    format!(
        "point '{name}' of the skeleton is unclear; expected WHAT_1, WHAT_2 and so on (height_foot, height_rim); WHAT is one of: {codes}"
    )
}

/// The points in order: by number where all have one, heights by their ends, else as they stand.
fn in_order(what: What, mut points: Vec<(&str, &NamedPoint)>) -> Result<Vec<([f64; 2], Sight)>, String> {
    let numbers: Option<Vec<u64>> = points.iter().map(|(rest, _)| rest.parse().ok()).collect();
    if let Some(numbers) = numbers {
        let mut numbered: Vec<_> = numbers.into_iter().zip(points).collect();
        numbered.sort_by_key(|(number, _)| *number);
        if numbered.windows(2).any(|pair| matches!(pair, [a, b] if a.0 == b.0)) {
            return Err(format!("two points of {} with the same number", what.code()));
        }
        points = numbered.into_iter().map(|(_, point)| point).collect();
    } else if what == What::Line(Quantity::Height) {
        let end = |rest: &str| ["foot", "rim"].iter().position(|end| rest.eq_ignore_ascii_case(end));
        if points.iter().any(|(rest, _)| end(rest).is_none()) {
            let expected =
                "expected height_foot and height_rim, or height_1 (the foot) and height_2 (the rim above it)";
            let names: Vec<_> = points.iter().map(|(_, point)| short(&point.name)).take(4).collect();
            return Err(format!("which end is the foot? {expected}, got: {}", names.join(", ")));
        }
        points.sort_by_key(|(rest, _)| end(rest));
        if points.windows(2).any(|pair| matches!(pair, [a, b] if end(a.0) == end(b.0))) {
            return Err("two points for the same end of height".to_owned());
        }
    }
    Ok(points.into_iter().map(|(_, point)| (point.point_px, point.sight)).collect())
}
