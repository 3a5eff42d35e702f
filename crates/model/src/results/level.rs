//! The level of a row of the results.

use crate::codes::coded_enum;

coded_enum! {
    /// The level of a row of the results: the images and raters that it stands for.
    Level {
        Frame = "frame": "one image",
        Fused = "fused": "the selected images of a session together",
        Consensus = "consensus": "the selected images of a session and all their raters together",
    }
}
