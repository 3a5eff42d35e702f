//! The doubts that the wall of a container casts on methods which take it as vertical.

use crate::container::{Container, Method, Quantity, Wall};
use crate::doubt::Doubt;
use crate::marks::ObjectMarks;
use crate::measure::{Judge, sizes};
use crate::view::View;

/// A wall counts as sloped when its radius changes by more than this per height.
const SLOPED: f64 = 0.05;

/// Whether the method takes the wall of a container as vertical.
pub(crate) fn assumes_vertical_wall(method: Method) -> bool {
    matches!(method, Method::Paper | Method::Ray)
}

/// The slope of the wall, in radius per height, where outlines of rim and base show it.
pub(crate) fn wall_slope(view: &View, container: &Container, marks: &ObjectMarks, judge: &Judge) -> Option<f64> {
    let sizes = sizes(view, Method::Coaxial, container, marks, judge);
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
