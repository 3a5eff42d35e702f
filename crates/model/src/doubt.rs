//! Doubts: assumptions of methods that may not hold.

use crate::codes::coded_enum;
use crate::container::{Container, Method, Quantity, Wall};
use crate::marks::ObjectMarks;
use crate::measure::sizes;
use crate::view::View;

coded_enum! {
    /// An assumption of a method that is broken or not known to hold. The stated uncertainty does not cover it.
    Doubt {
        PaperApproximation = "paper_approximation": "the paper's equations leave out the roll and the rays off the axis, and differ from the exact ones by more than 0.3 of the uncertainty",
        WallSloped = "wall_sloped": "the method takes the wall as vertical, and it is not",
        WallAssumedVertical = "wall_assumed_vertical": "the method takes the wall as vertical, and its shape is not known",
    }
}

/// A wall counts as sloped when its radius changes by more than this per height.
const SLOPED: f64 = 0.05;

/// Whether the method takes the wall of a container as vertical.
pub(crate) fn assumes_vertical_wall(method: Method) -> bool {
    matches!(method, Method::Paper | Method::Ray)
}

/// The slope of the wall, in radius per height, where outlines of rim and base show it.
pub(crate) fn wall_slope(view: &View, container: &Container, marks: &ObjectMarks) -> Option<f64> {
    let sizes = sizes(view, Method::Coaxial, container, marks);
    sizes.into_iter().find_map(|(_, size)| size.ok()?.wall_slope)
}

/// The doubt that the wall of a container casts on one of its sizes; `slope` is that of [`wall_slope`].
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
