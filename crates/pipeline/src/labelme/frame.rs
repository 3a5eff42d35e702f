//! The frame in which a picture was marked: as it is stored, or as EXIF tells viewers to show it.

use std::fmt::{Display, Formatter};
use std::str::FromStr;

use model::Orientation;
use serde::{Deserialize, Serialize};

/// A frame of a picture. Sizes are measured in the stored one, to which the camera's calibration belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MarksFrame {
    /// The picture as it is stored in its file.
    Stored,
    /// The picture as viewers show it that follow its EXIF orientation.
    Shown,
}

impl Display for MarksFrame {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            Self::Stored => "stored",
            Self::Shown => "shown",
        })
    }
}

impl FromStr for MarksFrame {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let named = [Self::Stored, Self::Shown].into_iter().find(|frame| frame.to_string() == text);
        named.ok_or_else(|| format!("'{text}' is not one of: stored, shown"))
    }
}

/// A picture that somebody marked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MarkedPicture {
    /// The width and height as the picture is stored.
    pub size_px: [u32; 2],
    /// The EXIF orientation of the picture on the card.
    pub orientation: Orientation,
    /// The frame of all marks, where the user says so.
    pub frame: Option<MarksFrame>,
    /// Whether a copy of another camera was marked, which may have kept its EXIF data or not.
    pub is_copy: bool,
}

impl From<[u32; 2]> for MarkedPicture {
    fn from(size_px: [u32; 2]) -> Self {
        Self { size_px, orientation: Orientation::Upright, frame: None, is_copy: false }
    }
}

/// The reason why the frame of marks is not known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrameFault {
    /// The stated size is that of another picture.
    OtherSize,
    /// Both frames fit, and the tool that made the marks is not known to use one of them.
    Unknown,
}

impl MarkedPicture {
    /// The width and height in a frame.
    #[must_use]
    pub fn size_in(&self, frame: MarksFrame) -> [u32; 2] {
        match frame {
            MarksFrame::Stored => self.size_px,
            MarksFrame::Shown => self.orientation.shown_size_px(self.size_px),
        }
    }

    /// The frame of marks whose file states this size of the picture, if any. The size decides where it can, then the user, then
    /// `tool`, the frame that the tool is known to mark in.
    ///
    /// # Errors
    /// [`FrameFault`] where no frame fits, or both do.
    pub fn frame_of(&self, stated_px: Option<[u32; 2]>, tool: Option<MarksFrame>) -> Result<MarksFrame, FrameFault> {
        let fits = |frame: MarksFrame| stated_px.is_none_or(|stated_px| stated_px == self.size_in(frame));
        match (fits(MarksFrame::Stored), fits(MarksFrame::Shown)) {
            (false, false) => Err(FrameFault::OtherSize),
            (true, false) => Ok(MarksFrame::Stored),
            (false, true) => Ok(MarksFrame::Shown),
            (true, true) if self.orientation == Orientation::Upright => Ok(MarksFrame::Stored),
            (true, true) => self.frame.or(tool.filter(|_| !self.is_copy)).ok_or(FrameFault::Unknown),
        }
    }

    /// The point of the stored picture that a point in a frame is. Both count from the corner of the first pixel.
    #[must_use]
    pub fn to_stored(&self, frame: MarksFrame, point_px: [f64; 2]) -> [f64; 2] {
        match frame {
            MarksFrame::Stored => point_px,
            MarksFrame::Shown => self.orientation.stored_from_shown(point_px, self.size_px),
        }
    }

    /// The inverse of [`Self::to_stored`].
    #[must_use]
    pub fn from_stored(&self, frame: MarksFrame, point_px: [f64; 2]) -> [f64; 2] {
        match frame {
            MarksFrame::Stored => point_px,
            MarksFrame::Shown => self.orientation.shown_from_stored(point_px, self.size_px),
        }
    }

    /// The frame in which files of marks are written: LabelMe's, unless the user says otherwise where the size does not show it.
    #[must_use]
    pub fn written_frame(&self) -> MarksFrame {
        if self.is_copy {
            return self.frame.unwrap_or(MarksFrame::Stored);
        }
        let shows_frame = self.orientation.swaps_sides() && self.size_px[0] != self.size_px[1];
        self.frame.filter(|_| !shows_frame).unwrap_or(MarksFrame::Shown)
    }

    /// The reason for a refusal with [`FrameFault::Unknown`], with what to do.
    #[must_use]
    pub fn unknown_frame_text(&self) -> String {
        format!(
            "the picture has EXIF orientation {}, and nothing says whether the marks are on it as stored or as shown: give \
             frame = \"stored\" or \"shown\" in [marks] of study.toml, or --frame",
            self.orientation.exif()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE_PX: [u32; 2] = [640, 480];

    fn picture(exif: u32) -> MarkedPicture {
        let orientation = Orientation::from_exif(exif).unwrap_or_default();
        MarkedPicture { orientation, ..SIZE_PX.into() }
    }

    #[test]
    fn the_size_decides_then_the_user_then_the_tool() {
        use MarksFrame::{Shown, Stored};
        let (stored, turned) = (Some(SIZE_PX), Some([480, 640]));
        assert_eq!(picture(6).frame_of(stored, Some(Shown)), Ok(Stored));
        assert_eq!(picture(6).frame_of(turned, None), Ok(Shown));
        assert_eq!(picture(6).frame_of(None, None), Err(FrameFault::Unknown));
        assert_eq!(picture(3).frame_of(turned, None), Err(FrameFault::OtherSize));
        assert_eq!(picture(3).frame_of(stored, None), Err(FrameFault::Unknown));
        assert_eq!(picture(3).frame_of(stored, Some(Shown)), Ok(Shown));
        assert_eq!(MarkedPicture { frame: Some(Stored), ..picture(3) }.frame_of(stored, Some(Shown)), Ok(Stored));
        assert_eq!(
            MarkedPicture { is_copy: true, ..picture(3) }.frame_of(stored, Some(Shown)),
            Err(FrameFault::Unknown)
        );
        assert_eq!(picture(1).frame_of(stored, Some(Shown)), Ok(Stored));
    }
}
