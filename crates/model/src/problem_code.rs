//! The codes of problems: stable names of what can be wrong with a session, each with its meaning and its remedy.

use std::fmt::Write as _;

use crate::codes::coded_enum;
use crate::frame_log::FrameReason;

coded_enum! {
    /// The kind of a [`Problem`](crate::Problem). Programs may rely on the code: it keeps its meaning.
    ProblemCode {
        MissingCard = "missing_card": "a session has no folder on a card, or its card cannot be reached",
        LinkOutOfStudy = "link_out_of_study": "a link leads to a place outside the study, and is not followed",
        BadSessionToml = "bad_session_toml": "session.toml cannot be read, or holds an unknown key or value",
        BadCamera = "bad_camera": "the session's camera cannot be used, or does not fit the camera of the marked pictures",
        BadProfile = "bad_profile": "the device profile contradicts itself, or cannot be applied",
        CardDoesNotFitProfile = "card_does_not_fit_profile": "no file of the card fits a pattern of the device profile",
        ObjectNeverMeasured = "object_never_measured": "`check`: no mark in the study gives a size of an object of objects.csv",
        TableStaysEmpty = "table_stays_empty": "`check`: no size that the study gives fits a table of study.toml",
        SameCard = "same_card": "the card of a session holds files of that of another session, byte for byte",
        FoldersAlike = "folders_alike": "two folders of sessions or marks have one name in two Unicode forms",
        NoFiles = "no_files": "a stream that the profile declares has no file on the card",
        NotDeclared = "not_declared": "the profile declares no images, accelerometer or range sensor; sizes need all three",
        NotAFile = "not_a_file": "a pipe, socket or device lies on the card; it is not opened",
        LinkLeavesCard = "link_leaves_card": "a link on the card leads out of it, and is not followed",
        UnreadableFile = "unreadable_file": "the file system refuses a file or folder, or gives an error while it is read",
        UnreadFiles = "unread_files": "files on the card fit no pattern of the profile, and stay unread",
        NameNotUtf8 = "name_not_utf8": "the name of a file is not UTF-8; it is read, and named as far as possible",
        NamesDifferInCase = "names_differ_in_case": "names of files differ in upper and lower case alone",
        DuplicateFile = "duplicate_file": "a file is the same as another one, byte for byte; it is used once",
        CardChanged = "card_changed": "the card was changed while it was read",
        NamesDifferInForm = "names_differ_in_form": "names on the card are the same but for their Unicode form, as where macOS stored one of them",
        TruncatedPacket = "truncated_packet": "a file ends inside a packet; the packet is lost",
        ZeroBlocks = "zero_blocks": "blocks of zeros stand where packets should be; they are lost",
        LostAlignment = "lost_alignment": "bytes are missing or too many inside a packet; reading went on at the next one that fits",
        SequenceJumps = "sequence_jumps": "the numbers of blocks are not consecutive: blocks are missing or repeated",
        MissingHeader = "missing_header": "the file does not begin with a header; its blocks are used",
        BadBlocks = "bad_blocks": "blocks of the file are damaged; they are lost",
        BadStamp = "bad_stamp": "the time stamp of a packet is impossible; the packet is lost",
        MissingColumn = "missing_column": "a column that the profile names is not in the header of the file",
        RepeatedColumn = "repeated_column": "the header of the file has a column that the profile names twice; the file is not read",
        BadRows = "bad_rows": "rows of the file cannot be read; they are lost",
        LongLine = "long_line": "a line is too long for a table of numbers, such as a block of zeros; the rest of the file is not used",
        SamplesWithoutTime = "samples_without_time": "samples have no time that can be told; they are lost",
        NoSamples = "no_samples": "the file holds no sample",
        TextEncoding = "text_encoding": "a log is UTF-16 text, and is not read",
        ImpossibleAcceleration = "impossible_acceleration": "samples are accelerations that the sensor cannot give; they are left out, and what is around them is used",
        Gaps = "gaps": "there are holes between packets; nothing is bridged",
        DuplicatePackets = "duplicate_packets": "packets are there twice, and are used once",
        PacketsOutOfOrder = "packets_out_of_order": "packets stand in another order than their times; they are put in order",
        MisplacedPackets = "misplaced_packets": "the times of packets fit nothing around them; the packets are left out",
        RateNotNominal = "rate_not_nominal": "the rate by the stamps is not that of the profile; the stamps are used",
        ClockSet = "clock_set": "the device's clock was set during the session",
        AmbiguousTime = "ambiguous_time": "the clock was set back, and some times exist twice; what lies there is not used",
        TwoRecordings = "two_recordings": "more than 6 h lie between images: the card may hold several recordings, or the device's clock was reset",
        ImageLagEstimated = "image_lag_estimated": "the lag between images and sensors was worked out; it is told, and not applied",
        ImageLagUnknown = "image_lag_unknown": "the lag between images and sensors cannot be told from this session",
        StampsShared = "stamps_shared": "rows of a log share stamps; they are spread evenly where their number shows the rate, else left out",
        NoCommonTime = "no_common_time": "sensors, images or marks have no time in common, or hardly any: a zone or an epoch is likely wrong",
        EmptyImage = "empty_image": "the file of an image has no bytes",
        NotAnImage = "not_an_image": "the file does not begin like a JPEG or PNG picture, or its header is damaged",
        DamagedImage = "damaged_image": "the data of a picture end before their end marker, or hold a block of zeros",
        WrongSize = "wrong_size": "the width and height of a picture are not the camera's",
        NoTime = "no_time": "neither the name of a file nor its EXIF data give its time as the profile declares it",
        TimesDisagree = "times_disagree": "name and EXIF data of a file give different times",
        BytesAfterImage = "bytes_after_image": "bytes stand behind the end marker of a picture; the picture is used",
        StrayBytesInImage = "stray_bytes_in_image": "bytes that belong to nothing stand before a marker of a JPEG picture; the picture is used",
        WrongExtension = "wrong_extension": "the extension of a file is that of another encoding; the first bytes count",
        TimeFromOneSource = "time_from_one_source": "only the name or only the EXIF data give the time of an image, so nothing checks it",
        TurnedImages = "turned_images": "EXIF tells viewers to turn or mirror images; they are measured as they are stored",
        GravityCalibrationApplied = "gravity_calibration_applied": "offsets and scales of the accelerometer were worked out and applied",
        GravityCalibrationRefused = "gravity_calibration_refused": "the accelerometer could not be calibrated from this recording; samples are used as recorded",
        NoImageWithPose = "no_image_with_pose": "no image of the session has a pose, so nothing can be measured",
        NoImageSelected = "no_image_selected": "no image of the session lies in the window of pitch, so there are no fused sizes",
        ImplausiblePose = "implausible_pose": "the session's median pitch or roll is one that no wearer has, or not that of its bench",
        ImplausibleRange = "implausible_range": "the session's median range is not that from a face to a table",
        ImplausibleGravity = "implausible_gravity": "gravity's median length is not 1 g",
        ImplausibleCamera = "implausible_camera": "the camera's focal length, principal point or lens can hardly be",
        MarksUnreadable = "marks_unreadable": "the file system does not let a file or folder of marks be read",
        MarksTooLarge = "marks_too_large": "a file of marks is larger than any can be",
        MarksMalformed = "marks_malformed": "a file of marks is no LabelMe JSON",
        MarksOfOtherPicture = "marks_of_other_picture": "a file of marks is of a picture of another size",
        MarksFrameUnknown = "marks_frame_unknown": "a picture is shown otherwise than it is stored, and nothing says in which of the two it was marked",
        BadMark = "bad_mark": "a shape cannot be a mark: its label, its kind or its number of points is wrong",
        MarksTwice = "marks_twice": "two files of one rater are of the same image",
        MarksWithoutImage = "marks_without_image": "the card has no image with the name of a file of marks",
        MarkedImageDropped = "marked_image_dropped": "the image that was marked could not be used",
        AmbiguousMarks = "ambiguous_marks": "several images have the name of a file of marks",
        UnknownObject = "unknown_object": "marks name an object that is not in objects.csv",
        MarkedImageWithoutPose = "marked_image_without_pose": "a marked image has no pose, so its marks give no size",
        NamedTwice = "named_twice": "names.csv gives one name to two containers of one image; one is left out",
        NameNotFound = "name_not_found": "a line of names.csv names nothing that was found",
        PictureNotSearched = "picture_not_searched": "a picture could not be searched for rims",
        MarksMisplaced = "marks_misplaced": "files of marks lie where none are read: beside the pictures, or without a folder of a rater or session",
        NothingToMeasure = "nothing_to_measure": "the marks of an object give no size of its shape",
        MarkOffPlane = "mark_off_plane": "a mark does not meet the plane that it is measured on",
        NoCircle = "no_circle": "the points of a rim or base fix no circle",
        NoHeight = "no_height": "the height of a bowl is neither marked nor given",
        RimBelowFoot = "rim_below_foot": "the marks put the rim of a bowl below its foot",
        RimAboveCamera = "rim_above_camera": "the marks put the rim of a container above the camera",
        BaseUnderCamera = "base_under_camera": "the base lies under the camera, where a height cannot be told",
        NoLength = "no_length": "two marked ends are the same point",
        NotFourCorners = "not_four_corners": "a rectangle's outline does not have four corners",
        MarksDisagree = "marks_disagree": "several marks of one size on one picture contradict each other; none of them is used",
        MarkLeftOut = "mark_left_out": "a mark contradicts others of the same size, or points lie far off their outline; they are not used",
        OutlineNotRound = "outline_not_round": "an outline that should be a circle is none",
        SizesDisagree = "sizes_disagree": "the sizes of one thing by several images or raters differ by more than their uncertainties allow",
        BadMcap = "bad_mcap": "the recording in the work folder is not what was written there",
        McapNotWritten = "mcap_not_written": "a recording could not be written to the work folder",
        NoThread = "no_thread": "the system gave the program no thread",
        Stopped = "stopped": "the run was stopped before the card was read to its end",
        UnknownCode = "unknown_code": "the results were written by a later version, which knows more codes; place, fact and remedy are its own",
        InternalError = "internal_error": "a defect of the program; the other sessions are complete",
    }
}

impl ProblemCode {
    /// The remedy: what a person can do about a problem of this kind. A problem's own remedy is about the case at hand.
    #[must_use]
    pub const fn remedy(self) -> &'static str {
        match self {
            Self::MissingCard => "copy the card into cards/SESSION, or take the session's marks away",
            Self::LinkOutOfStudy => "copy what it leads to into the study",
            Self::BadSessionToml => "correct the file at the line that is named (docs/study.md)",
            Self::BadCamera => "name a built-in camera, or one in devices/ (docs/devices.md)",
            Self::BadProfile => "correct the profile (docs/devices.md)",
            Self::CardDoesNotFitProfile => {
                "check that the folder is the card's root and that device_profile names the right device"
            }
            Self::ObjectNeverMeasured => {
                "mark the object in at least one picture with a pose, or take it out of objects.csv"
            }
            Self::TableStaysEmpty => "mark what the table asks for, or change or remove the table",
            Self::FoldersAlike => "rename one of them, or put the content of both into one",
            Self::NoFiles => "copy the card again; if the device does not write the stream, take it out of the profile",
            Self::NotDeclared => "add the table to the profile, if the device writes such files",
            Self::NotAFile => "copy the card again",
            Self::LinkLeavesCard => "copy what it leads to onto the card",
            Self::UnreadableFile => "check permissions and the medium, and copy the card again",
            Self::UnreadFiles => "nothing, if they are not recordings; else add a pattern to the profile",
            Self::NameNotUtf8 => "rename the file if another program must read it",
            Self::NamesDifferInCase => "rename one of them: other systems take them for one file",
            Self::DuplicateFile => "remove one of the two",
            Self::CardChanged => "run again when the card is complete",
            Self::NamesDifferInForm => "rename one of them: to people they look the same",
            Self::TruncatedPacket => "copy the file again; if it stays so, the recording broke off there",
            Self::ZeroBlocks => "copy the card again; if it stays so, the medium is damaged",
            Self::LostAlignment => "copy the file again",
            Self::SequenceJumps => "copy the file again; if it stays so, the device lost them",
            Self::MissingHeader => "copy the file again; check the times of the session",
            Self::BadBlocks => "copy the file again",
            Self::BadStamp => "copy the file again; check the clock that the profile declares",
            Self::MissingColumn => "correct the name of the column in the profile",
            Self::RepeatedColumn => "rename one of them in the file, or name the columns by number in the profile",
            Self::BadRows => "look at the line that is named; correct the profile's columns, separator or time",
            Self::LongLine => "check that the file is text with line ends",
            Self::SamplesWithoutTime => "correct the time that the profile declares",
            Self::NoSamples => "nothing, if the device recorded nothing; else copy the file again",
            Self::TextEncoding => "save the file as UTF-8",
            Self::ImpossibleAcceleration => {
                "none needed if the logger writes them for 'no value'; else correct g_per_count or full_scale_g in the profile"
            }
            Self::Gaps => "none needed: images in a gap have no pose",
            Self::DuplicatePackets => "none needed",
            Self::PacketsOutOfOrder => "none needed",
            Self::MisplacedPackets => "copy the card again; if it stays so, the stamps are damaged",
            Self::RateNotNominal => "correct rate_hz in the device profile",
            Self::ClockSet => "check the times of the images against the sensors'",
            Self::AmbiguousTime => "split the card's files where the clock was set, if that is known",
            Self::TwoRecordings => {
                "if they are sessions of two wearers, give each a card folder of its own; if the clock was reset, correct it"
            }
            Self::ImageLagEstimated => {
                "if it differs from the declared one and is alike in other sessions, set [time] image_lag_s to it"
            }
            Self::ImageLagUnknown => "none needed: a session with more motion tells more",
            Self::StampsShared => "let the logger write times with decimals",
            Self::NoCommonTime => {
                "correct time_zone in study.toml, the epoch in the device profile, or clock_zero_utc in session.toml"
            }
            Self::EmptyImage => "copy the file from the card again; if it stays so, the image is lost",
            Self::NotAnImage => "copy the file from the card again; if it stays so, the image is lost",
            Self::DamagedImage => "copy the file from the card again; check the card for bad blocks",
            Self::WrongSize => "give the camera that took these pictures: camera in study.toml or session.toml",
            Self::NoTime => "correct images.time in the device profile, or the file's name",
            Self::TimesDisagree => {
                "find out which is right and take images.time from that one alone, or widen its tolerance_s"
            }
            Self::BytesAfterImage => {
                "look at the picture: a device may write its own data there, a damaged card garbage"
            }
            Self::StrayBytesInImage => "look at the picture: a camera may write so, a damaged card as well",
            Self::WrongExtension => "rename the file if another program must read it",
            Self::TimeFromOneSource => {
                "declare images.time from the one that all images have, if that is how the device writes them"
            }
            Self::TurnedImages => {
                "none needed; where marks are refused for it, say in which frame they are: [marks] frame"
            }
            Self::GravityCalibrationApplied => {
                "none needed; gravity_calibration = \"report\" leaves samples as they are"
            }
            Self::GravityCalibrationRefused => "lay the device still for 20 s on each side before or after wearing",
            Self::NoImageWithPose => "see frames.parquet for the reason of each image",
            Self::NoImageSelected => {
                "check mount offset, axes, and target_pitch_deg; the problem names the likely cause"
            }
            Self::ImplausiblePose => "correct axes or mount offset as the problem says",
            Self::ImplausibleRange => "correct mm_per_count in the device profile",
            Self::ImplausibleGravity => "correct g_per_count in the device profile",
            Self::ImplausibleCamera => "correct the camera file as the problem says (docs/devices.md)",
            Self::MarksUnreadable => "check its permissions",
            Self::MarksTooLarge => "check that it is a LabelMe file",
            Self::MarksMalformed => "save it from LabelMe again",
            Self::MarksFrameUnknown => {
                "set [marks] frame to stored or shown, as the tool that made the marks shows pictures"
            }
            Self::MarksOfOtherPicture => "mark the picture of the card, or declare [marks] camera",
            Self::BadMark => "correct the shape in LabelMe (docs/study.md)",
            Self::MarksTwice => "keep one of them",
            Self::MarksWithoutImage => "give the file the image's name, or move it out of the marks",
            Self::MarkedImageDropped => "see the problem of the image itself",
            Self::AmbiguousMarks => "rename all but one in the copy of the card, and its marks",
            Self::UnknownObject => "add it to objects.csv, or correct the label in LabelMe",
            Self::MarkedImageWithoutPose => "see frames.parquet for the reason",
            Self::NamedTwice => "take the wrong one out of names.csv, or name it as another object",
            Self::NameNotFound => {
                "look up the names in the results, which change with the settings, or take the line out"
            }
            Self::PictureNotSearched => "look at the picture; mark it by hand, or copy it from the card again",
            Self::MarksMisplaced => "move them to marks/RATER/SESSION by the command that is given",
            Self::MarksDisagree | Self::MarkLeftOut => "correct the mark or the points that slipped, and run again",
            Self::OutlineNotRound => {
                "correct the points; outline one edge only, and name objects that are not round so in objects.csv"
            }
            Self::SameCard => "keep each file in one session, and move the other copy of the card out of cards/",
            Self::SizesDisagree => {
                "look at the marks that `flags` names as outliers; without one, at all of them, or at [uncertainty]"
            }
            Self::NothingToMeasure => "mark a diameter, width, length, height or the rim (docs/study.md)",
            Self::MarkOffPlane => "correct the mark, or check pitch and range of the image",
            Self::NoCircle => "mark more of the outline",
            Self::NoHeight => "mark its height, or give rim_height_mm in objects.csv",
            Self::RimBelowFoot => "correct the marks of the height",
            Self::RimAboveCamera => "correct the marks, or check pitch and range of the image",
            Self::BaseUnderCamera => "use another picture",
            Self::NoLength => "mark both ends",
            Self::NotFourCorners => "mark the four corners of the rim",
            Self::BadMcap => "run again with --force to ingest the card anew",
            Self::McapNotWritten => "check space and permissions of the work folder",
            Self::NoThread => "run again when the machine has less to do, or with fewer --jobs",
            Self::Stopped => "run again: what was done is kept",
            Self::UnknownCode => "read the results with the version that wrote them",
            Self::InternalError => "report it with the message",
        }
    }
}

impl FrameReason {
    /// The code of the problem of an image that ingest drops for this reason; none for reasons that later stages give.
    #[must_use]
    pub const fn problem_code(self) -> Option<ProblemCode> {
        match self {
            Self::EmptyImage => Some(ProblemCode::EmptyImage),
            Self::NotAnImage => Some(ProblemCode::NotAnImage),
            Self::DamagedImage => Some(ProblemCode::DamagedImage),
            Self::WrongSize => Some(ProblemCode::WrongSize),
            Self::NoTime => Some(ProblemCode::NoTime),
            Self::TimesDisagree => Some(ProblemCode::TimesDisagree),
            Self::AmbiguousTime => Some(ProblemCode::AmbiguousTime),
            Self::SessionFailed
            | Self::NoAcceleration
            | Self::BadGravity
            | Self::NoRange
            | Self::NotBelowHorizon
            | Self::Moving
            | Self::PitchOutsideTarget
            | Self::Selected => None,
        }
    }
}

/// The codes under the headings of docs/problems.md: each begins with the code that is named here.
const HEADINGS: &[(ProblemCode, &str)] = &[
    (ProblemCode::MissingCard, "Study and settings"),
    (ProblemCode::NoFiles, "The card"),
    (ProblemCode::TruncatedPacket, "Samples"),
    (ProblemCode::Gaps, "Clocks"),
    (ProblemCode::EmptyImage, "Images"),
    (ProblemCode::GravityCalibrationApplied, "Signals"),
    (ProblemCode::MarksUnreadable, "Marks"),
    (ProblemCode::NothingToMeasure, "Sizes"),
    (ProblemCode::BadMcap, "The program and its work folder"),
];

/// The Markdown of docs/problems.md. A test compares the file with it.
#[must_use]
pub fn problems_markdown() -> String {
    let mut text = "# Problems: what can be wrong with a session\n\n\
                    A run never stops at a bad file. What is lost, or worth knowing, becomes a problem in the status of its session: \
                    on the terminal, in the report, in `run.json` and in the metadata of the results. Each has a severity (`loss` \
                    or `note`), a stage, a code, the place, the fact and a remedy. The code is stable: programs may rely on it.\n\n\
                    Made from `ProblemCode` in `crates/model/src/problem_code.rs`; `cargo test` compares, \
                    `AIM_BATCH_UPDATE=1 cargo test -p aim-batch-model --test dictionary` rewrites it.\n"
        .to_owned();
    for code in ProblemCode::ALL {
        if let Some((_, heading)) = HEADINGS.iter().find(|(first, _)| first == code) {
            let _ = write!(text, "\n## {heading}\n\n| code | meaning | remedy |\n|---|---|---|\n");
        }
        let _ = writeln!(text, "| `{code}` | {} | {} |", code.meaning(), code.remedy());
    }
    text
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{HEADINGS, ProblemCode, problems_markdown};
    use crate::status::Problem;

    #[test]
    fn codes_are_snake_case_and_each_has_a_meaning_and_a_remedy_of_its_own_line() {
        let codes: BTreeSet<&str> = ProblemCode::ALL.iter().map(|code| code.code()).collect();
        assert_eq!(codes.len(), ProblemCode::ALL.len());
        for code in ProblemCode::ALL {
            assert!(
                code.code().bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_'),
                "{code}"
            );
            assert!(!code.meaning().is_empty() && !code.remedy().is_empty(), "{code}");
            assert!(![code.meaning(), code.remedy()].concat().contains(['|', '\n']), "{code}: it stands in a table");
        }
    }

    /// A code that is not known yet loses neither the file that holds it nor what is said of the case.
    #[test]
    fn a_code_of_a_later_version_is_read_with_its_fact() {
        let json =
            r#"{"severity": "loss", "stage": "ingest", "code": "too_dark", "place": "p", "fact": "f", "remedy": "r"}"#;
        let problem: Problem = serde_json::from_str(json).unwrap();
        assert_eq!((problem.code, problem.fact.as_str()), (ProblemCode::UnknownCode, "f"));
        let known: Problem = serde_json::from_str(&json.replace("too_dark", "gaps")).unwrap();
        assert_eq!(known.code, ProblemCode::Gaps);
    }

    #[test]
    fn every_code_stands_once_in_the_document_below_a_heading() {
        let text = problems_markdown();
        assert_eq!(text.matches("\n## ").count(), HEADINGS.len());
        assert_eq!(HEADINGS.first().map(|(code, _)| code), ProblemCode::ALL.first());
        for code in ProblemCode::ALL {
            assert_eq!(text.matches(&format!("\n| `{code}` |")).count(), 1, "{code}");
        }
    }
}
