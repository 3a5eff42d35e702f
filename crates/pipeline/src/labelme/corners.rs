//! Shapes with four corners, as the rims of squares and rectangles: LabelMe's `oriented_rectangle`, and `rotation` and
//! `quadrilateral` of X-AnyLabeling.

use nalgebra::Point2;

use super::{Marks, MarksError, Shape};

/// A mark whose shape has four corners, which must not be taken for the rim of a round object: a circle goes through the corners of
/// every rectangle.
#[derive(Debug)]
pub(super) struct FourCorners {
    object: String,
    /// The number of the mark among those of its object.
    mark: usize,
    /// The reason for which it is refused if the object is round.
    if_round: MarksError,
}

impl FourCorners {
    /// The mark of a shape, where that has four corners. It is the `mark`-th of `object`, from 0.
    pub fn new(shape: &Shape, object: &str, mark: usize, refuse: impl Fn(String) -> MarksError) -> Option<Self> {
        let shape_type = shape.shape_type.as_deref().filter(|shape_type| is_four_cornered(shape_type))?;
        let fact = format!(
            "a shape of type {shape_type} marks the corners of a square or rectangle, but '{object}' is round: mark its rim by a \
             polygon or points along it"
        );
        Some(Self { object: object.to_owned(), mark, if_round: refuse(fact) })
    }
}

impl Marks {
    /// Moves the marks whose shape has four corners, of objects that are round, to [`Marks::refused`].
    pub fn refuse_four_corners(&mut self, is_round: impl Fn(&str) -> bool) {
        let all = std::mem::take(&mut self.four_corners);
        let (of_round, kept): (Vec<_>, Vec<_>) = all.into_iter().partition(|mark| is_round(&mark.object));
        self.four_corners = kept;
        for FourCorners { object, mark, if_round } in of_round.into_iter().rev() {
            let of_object = self.objects.iter_mut().find(|marks| marks.object == object);
            if let Some(of_object) = of_object.filter(|marks| mark < marks.marks.len()) {
                of_object.marks.remove(mark);
            }
            self.refused.push(if_round);
        }
        self.objects.retain(|marks| !marks.marks.is_empty());
        self.refused.sort_by_key(|error| if let MarksError::Shape { number, .. } = error { *number } else { 0 });
    }
}

/// Whether the type of a shape is one of four corners.
pub(super) fn is_four_cornered(shape_type: &str) -> bool {
    matches!(shape_type, "oriented_rectangle" | "rotation" | "quadrilateral")
}

/// The corners in order around the quadrilateral, in whatever order they were drawn; the first stays the first.
///
/// # Errors
/// A text, where they are not four, or one of them lies between or within the others.
pub(super) fn in_order(points_px: &[Point2<f64>]) -> Result<[Point2<f64>; 4], String> {
    let &[a, b, c, d] = points_px else { return Err(format!("expected 4 corners, got {} points", points_px.len())) };
    let orders = [[a, b, c, d], [a, b, d, c], [a, c, b, d]];
    orders.into_iter().find(is_convex).ok_or_else(|| {
        "its 4 points are the corners of no quadrilateral: one lies between or within the others".to_owned()
    })
}

/// Whether the way around four points turns to the same side at each of them.
fn is_convex(corners: &[Point2<f64>; 4]) -> bool {
    let turn = |at: usize| {
        let [before, corner, after] = [0, 1, 2].map(|step| corners[(at + step) % 4]);
        (corner - before).perp(&(after - corner))
    };
    let turns = [0, 1, 2, 3].map(turn);
    turns.iter().all(|turn| *turn > 0.0) || turns.iter().all(|turn| *turn < 0.0)
}
