//! The ledger's reasons why an image was kept or dropped, and the flags of its signals.

use crate::codes::coded_enum;

coded_enum! {
    /// The one reason that the ledger gives for every image of a study: the first that applies, in this order.
    FrameReason {
        SessionFailed = "session_failed": "nothing of its session could be used: the session's status says why",
        EmptyImage = "empty_image": "the file has no bytes",
        NotAnImage = "not_an_image": "the file does not begin like a JPEG or PNG picture, or its header is damaged",
        DamagedImage = "damaged_image": "the picture's data end before their end marker, or hold a block of zeros",
        WrongSize = "wrong_size": "the picture's width and height are not the camera's",
        NoTime = "no_time": "neither the file name nor EXIF gives the image's time as the profile declares it",
        TimesDisagree = "times_disagree": "file name and EXIF give different times",
        AmbiguousTime = "ambiguous_time": "the clock was set during the session, and the image's time exists twice",
        NoAcceleration = "no_acceleration": "too few accelerometer samples around the image's time to tell gravity",
        BadGravity = "bad_gravity": "the length of gravity is too far from 1 g: the accelerometer or its scale is wrong",
        NoRange = "no_range": "too few valid range samples around the image's time",
        NotBelowHorizon = "not_below_horizon": "the camera looks level or upwards: its axis never meets the table",
        Moving = "moving": "the head moved more than the stillness threshold allows",
        PitchOutsideTarget = "pitch_outside_target": "the pitch is outside the target window",
        Selected = "selected": "still, pitch within the target window: used for fused sizes",
    }
}

coded_enum! {
    /// A warning about an image's signals. A flag drops nothing: it goes with the image and with the sizes measured on it.
    FrameFlag {
        GravityEdge = "gravity_edge": "gravity comes from acceleration on one side of the image's time only: the recording, or a gap in it, begins or ends there",
        RangeHeld = "range_held": "the range sensor gave a single value for far longer than its noise allows: it may have been stuck",
        RangeStep = "range_step": "the range window holds two distances (a hand, a fork, the edge of a plate): the one that most readings give is used, if the majority is clear",
        RangeConeSkipped = "range_cone_skipped": "the pitch is too shallow for the range sensor's cone to meet the table: the range was not corrected for it",
    }
}

impl FrameReason {
    /// Whether the image has a pose, so that marks on it can be measured.
    #[must_use]
    pub fn has_pose(self) -> bool {
        matches!(self, Self::Moving | Self::PitchOutsideTarget | Self::Selected)
    }
}
