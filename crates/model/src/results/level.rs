//! What a row of the results stands for.

use crate::codes::coded_enum;

coded_enum! {
    /// What a row of the results stands for.
    Level {
        Frame = "frame": "one image",
        Fused = "fused": "the selected images of a session together",
        Consensus = "consensus": "the selected images of a session and all their raters together",
    }
}
