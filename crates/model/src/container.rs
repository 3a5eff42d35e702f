//! Containers: their kinds and shapes, their sizes, and the methods that measure these.

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
    /// The shape of a container's wall.
    Wall {
        Vertical = "vertical": "upright: the rim lies above the foot",
        Sloped = "sloped": "the rim is wider or narrower than the foot",
    }
}

coded_enum! {
    /// A method by which marks become sizes.
    Method {
        Paper = "paper": "the paper's equations 10-15: roll taken as zero, wall height H = tan(pitch) H'",
        Ray = "ray": "measured roll, and the wall height from the rim point's own ray: exact for a vertical wall",
        Coaxial = "coaxial": "for round bowls with rim and base outlined: two circles about one vertical axis, whatever the shape of the wall",
        Joint = "joint": "two or more images of one bowl at different pitches give height and wall slope together; for fused rows only",
        Best = "best": "the one of the other methods with the smallest uncertainty among those whose assumptions hold",
    }
}

/// The facts about a container that are known before it is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Container {
    /// The kind: plate, bowl or box.
    pub kind: Kind,
    /// The outline as seen from above.
    pub shape: Shape,
    /// Height of the rim above the table, where it is known (from a catalogue or a ruler) and need not be measured.
    pub rim_height_mm: Option<f64>,
    /// The shape of the wall, where it is stated; that of a box is vertical.
    pub wall: Option<Wall>,
}

impl Container {
    /// The shape of the wall: the stated one, or else vertical for a box; `None` where it is not known.
    #[must_use]
    pub fn known_wall(&self) -> Option<Wall> {
        self.wall.or((self.kind == Kind::Box).then_some(Wall::Vertical))
    }

    /// Whether the mouth is measured on a plane whose height comes from marks on the same picture.
    #[must_use]
    pub fn rim_plane_is_measured(&self) -> bool {
        self.rim_height_mm.is_none() && self.kind != Kind::Plate
    }
}
