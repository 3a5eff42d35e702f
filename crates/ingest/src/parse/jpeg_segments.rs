//! The segments in front of a JPEG picture's first scan.

use std::ops::Range;

/// The marker codes of the segments, each with the place of its content, up to the first scan or as far as they can be read. As
/// libjpeg does, it passes over stray bytes before a marker, and over any number of 0xff before its code.
pub(super) struct JpegSegments<'a> {
    picture: &'a [u8],
    at: usize,
}

impl<'a> JpegSegments<'a> {
    pub fn new(picture: &'a [u8]) -> Self {
        Self { picture, at: 2 }
    }
}

impl Iterator for JpegSegments<'_> {
    type Item = (u8, Range<usize>);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            self.at += memchr::memchr(0xff, self.picture.get(self.at..)?)?;
            self.at += self.picture.get(self.at..)?.iter().take_while(|byte| **byte == 0xff).count();
            let code = *self.picture.get(self.at)?;
            self.at += 1;
            match code {
                0x00 | 0x01 | 0xd0..=0xd8 => {}
                0xd9 | 0xda => return None,
                _ => {
                    let length = [*self.picture.get(self.at)?, *self.picture.get(self.at + 1)?];
                    let content = self.at + 2..self.at + usize::from(u16::from_be_bytes(length)).max(2);
                    self.at = content.end;
                    return Some((code, content));
                }
            }
        }
    }
}
