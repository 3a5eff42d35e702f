//! Assumptions of methods that may not hold.

use crate::codes::coded_enum;
use crate::container::{Container, Method, Quantity, Wall};
use crate::marks::ObjectMarks;
use crate::measure::sizes;
use crate::view::View;

coded_enum! {
    /// An assumption of a method that is broken, or that nobody knows to hold. The stated uncertainty leaves it out.
    Doubt {
        PaperApproximation = "paper_approximation": "the paper's equations leave out the roll and the rays off the axis, and differ from the exact ones by more than 0.3 of the uncertainty",
        WallSloped = "wall_sloped": "the method takes the wall as vertical, and it is not",
        WallAssumedVertical = "wall_assumed_vertical": "the method takes the wall as vertical, and nobody said how it stands",
    }
}

/// A wall that gains more radius than this per height is sloped.
const SLOPED: f64 = 0.05;

/// Whether the method needs to be told how the wall stands.
pub(crate) fn assumes_vertical_wall(method: Method) -> bool {
    matches!(method, Method::Paper | Method::Ray)
}

/// How the wall stands as far as outlines of rim and base show it.
pub(crate) fn wall_slope(view: &View, container: &Container, marks: &ObjectMarks) -> Option<f64> {
    let found = sizes(view, Method::Coaxial, container, marks);
    found.into_iter().find_map(|(_, size)| size.ok()?.wall_slope)
}

pub(crate) fn wall_doubt(
    method: Method,
    container: &Container,
    quantity: Quantity,
    slope: Option<f64>,
) -> Option<Doubt> {
    let needs_wall = quantity == Quantity::Height || container.rim_plane_is_measured();
    if !assumes_vertical_wall(method) || !needs_wall {
        return None;
    }
    match (container.known_wall(), slope) {
        (Some(Wall::Vertical), _) => None,
        (Some(Wall::Sloped), _) => Some(Doubt::WallSloped),
        (None, Some(slope)) if slope.abs() > SLOPED => Some(Doubt::WallSloped),
        (None, _) => Some(Doubt::WallAssumedVertical),
    }
}
