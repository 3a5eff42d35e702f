//! Containers: their kinds and outlines, which of their sizes are measured, and by which methods.

use crate::codes::coded_enum;

coded_enum! {
    /// The kind of a container, which decides the plane its sizes are measured on.
    Kind {
        Plate = "plate": "flat: measured on the table plane Z = 0",
        Bowl = "bowl": "has a height; its mouth is measured on the rim plane Z = H",
        Box = "box": "rectangular with a height; its mouth is measured on the rim plane Z = H",
    }
}

coded_enum! {
    /// The outline of a container as seen from above.
    Shape {
        Circle = "circle": "round: one diameter",
        Square = "square": "four equal sides: a width",
        Rectangle = "rectangle": "a width (short side) and a length (long side)",
    }
}

coded_enum! {
    /// A size of a container.
    Quantity {
        Diameter = "diameter": "diameter of a round rim",
        Width = "width": "side of a square, short side of a rectangle",
        Length = "length": "long side of a rectangle",
        Height = "height": "height of the rim above the table",
    }
}

coded_enum! {
    /// How the wall of a container stands.
    Wall {
        Vertical = "vertical": "upright: the rim lies above the foot",
        Sloped = "sloped": "the rim is wider or narrower than the foot",
    }
}

coded_enum! {
    /// How marks become sizes.
    Method {
        Paper = "paper": "the paper's equations 10-15: roll taken as zero, wall height H = tan(pitch) H'",
        Ray = "ray": "measured roll, and the wall height from the rim point's own ray: exact for a vertical wall",
        Coaxial = "coaxial": "round bowls with rim and base outlined: two circles about one vertical axis, whatever the wall",
        Joint = "joint": "two or more images of one bowl at different pitches: height and wall slope together, fused rows only",
        Best = "best": "of the others the one with the smallest uncertainty whose assumptions hold",
    }
}

/// What is known of a container before it is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Container {
    /// Plate, bowl or box.
    pub kind: Kind,
    /// Its outline.
    pub shape: Shape,
    /// Height of the rim above the table where it is known (a catalogue, a ruler) and need not be measured.
    pub rim_height_mm: Option<f64>,
    /// How its wall stands, where it is known; a box's is vertical.
    pub wall: Option<Wall>,
}

impl Container {
    /// How its wall stands; none where nobody knows.
    #[must_use]
    pub fn known_wall(&self) -> Option<Wall> {
        self.wall.or((self.kind == Kind::Box).then_some(Wall::Vertical))
    }

    /// Whether its mouth is measured on a plane whose height comes from the same picture.
    #[must_use]
    pub fn rim_plane_is_measured(&self) -> bool {
        self.rim_height_mm.is_none() && self.kind != Kind::Plate
    }
}
