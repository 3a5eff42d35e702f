//! Doubts: assumptions of methods that may not hold.

use crate::codes::coded_enum;

coded_enum! {
    /// An assumption of a method that is broken or not known to hold. The stated uncertainty does not cover it.
    Doubt {
        PaperApproximation = "paper_approximation": "the paper's equations leave out the roll and the rays off the axis, and differ from the exact ones by more than 0.3 of the uncertainty",
        WallSloped = "wall_sloped": "the method takes the wall as vertical, and it is not",
        WallAssumedVertical = "wall_assumed_vertical": "the method takes the wall as vertical, and its shape is not known",
        OutlineNotRound = "outline_not_round": "the points of an outline lie further off the circle than marks and pose explain",
        OutlineNotRight = "outline_not_right": "the corners of a square or rectangle are further from right angles and equal sides than marks and pose explain",
        FewOutlinePoints = "few_outline_points": "an outline of fewer than 6 points does not show whether it is a circle: the corners of a square lie on one as well",
    }
}
