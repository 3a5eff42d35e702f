//! Names of picture files. People name sessions and images as they like, but files must open everywhere, also from a link.

use std::collections::BTreeSet;

/// Length of the longest part of a name that is taken over, in characters.
const LONGEST: usize = 60;

/// The names of files that have been given away.
#[derive(Debug, Default)]
pub(super) struct Names {
    given: BTreeSet<String>,
}

impl Names {
    /// A new name `pictures/SESSION/IMAGE.VIEW.jpg` of ASCII letters, digits, `-` and `_`. A name that is taken (upper and lower
    /// case are the same, as on many disks) gets a number.
    pub(super) fn file(&mut self, session: &str, image: &str, view: &str) -> String {
        let base = image.rsplit('/').next().unwrap_or(image);
        let stem = base.rsplit_once('.').map_or(base, |(stem, _)| stem);
        let (session, stem) = (plain(session), plain(stem));
        let mut file = format!("pictures/{session}/{stem}.{view}.jpg");
        let mut number = 2;
        while !self.given.insert(file.to_ascii_lowercase()) {
            file = format!("pictures/{session}/{stem}-{number}.{view}.jpg");
            number += 1;
        }
        file
    }
}

fn plain(name: &str) -> String {
    let kept = |character: char| if character.is_ascii_alphanumeric() || character == '-' { character } else { '_' };
    // The last characters tell images apart, and the first ones do not.
    let skipped = name.chars().count().saturating_sub(LONGEST);
    let plain: String = name.chars().skip(skipped).map(kept).collect();
    // Windows keeps names of up to four characters for devices, and none of them has an underscore.
    if plain.len() < 5 { format!("{plain}_") } else { plain }
}

#[cfg(test)]
mod tests {
    use super::Names;

    #[test]
    fn names_are_harmless_short_and_differ() {
        let mut names = Names::default();
        assert_eq!(
            names.file("bench-1", "IMAGES/20210301T150010.250Z.JPG", "camera"),
            "pictures/bench-1/20210301T150010_250Z.camera.jpg"
        );
        assert_eq!(names.file("../..", "\\..\\con.jpg", "plane"), "pictures/_____/____con.plane.jpg");
        let first = names.file("s\u{e9}ance 1", "a b#?.jpg", "camera");
        assert_eq!(first, "pictures/s_ance_1/a_b__.camera.jpg");
        let again = names.file("S ance 1", "A_b?#.jpg", "camera");
        assert_eq!(again, "pictures/S_ance_1/A_b__-2.camera.jpg");
        assert!(names.file(&"x".repeat(500), &"y".repeat(500), "camera").len() < 150);
    }
}
