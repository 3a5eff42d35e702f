//! Topics that an annotated recording has besides the recording's own.

use model::ResultRow;

/// Pitch, roll, range, stillness of every image.
pub(super) const FRAME: &str = "/frame";
/// Marks and sizes over `/camera/image`.
pub(super) const OVERLAY: &str = "/camera/annotations";
/// The pictures with marks and sizes drawn on them.
pub(super) const DRAWN: &str = "/camera/drawn";
/// From the table to the camera.
pub(super) const TRANSFORM: &str = "/tf";
/// The table, and what was marked on it.
pub(super) const SCENE: &str = "/scene";
/// The fate of every image, and of the session.
pub(super) const LOG: &str = "/log";

/// One for each thing that can be plotted as one line: `/sizes/RATER/OBJECT/QUANTITY`.
pub(super) fn of_size(row: &ResultRow) -> String {
    format!("/sizes/{}/{}/{}", part(&row.rater), part(&row.object), row.quantity)
}

/// Letters, digits, `-` and `_` stay; viewers read other characters in other ways.
fn part(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() || c == '-' { c } else { '_' }).collect()
}

#[cfg(test)]
mod tests {
    use super::part;

    #[test]
    fn names_are_one_part_of_a_topic() {
        assert_eq!(part("circular plate (small)/2"), "circular_plate__small__2");
        assert_eq!(part("Schüssel-3"), "Schüssel-3");
    }
}
