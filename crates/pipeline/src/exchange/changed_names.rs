//! Names of pictures as tools change them on export, and how they lead back to the picture.

use std::collections::BTreeSet;

/// The extensions that Roboflow writes behind `_`.
const EXTENSIONS: [&str; 7] = ["jpg", "jpeg", "png", "bmp", "webp", "tif", "tiff"];

/// The way in which a name was changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Change {
    /// Folders that are none of the picture's.
    Folders,
    /// `1a2b3c4d-NAME.JPG`: Label Studio puts 8 digits of a random number before the name.
    LabelStudio,
    /// `NAME_JPG.rf.HASH.jpg`, of Roboflow.
    Roboflow,
    /// `NAME%20X.JPG`: as in a web address.
    Percent,
    /// Other characters for blanks, brackets and such, or for the `/` between folders.
    Characters,
}

impl Change {
    /// The change in words, for a note on the pictures that were found in spite of it.
    pub fn words(self) -> &'static str {
        match self {
            Self::Folders => {
                "images in folders that are none of the study's, found by their names, which one picture alone has"
            }
            Self::LabelStudio => "names with 8 digits before them, as Label Studio writes them, found without these",
            Self::Roboflow => "names with '.rf.' and a code, as Roboflow writes them, found without these",
            Self::Percent => {
                "names with % and digits, as in web addresses, found by the characters that these stand for"
            }
            Self::Characters => {
                "names in which a tool put other characters for some, or for the '/' between folders, found by the rest"
            }
        }
    }
}

/// The names, without extension, that the name of an image may have had before tools changed it, each with the last change. `stem`
/// itself is not among them.
pub(super) fn names_before(stem: &str) -> Vec<(String, Change)> {
    const MOST_CHANGES: usize = 3; // one tool's export goes through another
    let mut names: Vec<(String, Change)> = Vec::new();
    let mut last = vec![stem.to_owned()];
    for _ in 0..MOST_CHANGES {
        let before: Vec<(String, Change)> = last.iter().flat_map(|name| undone(name)).collect();
        last = before.iter().map(|(name, _)| name.clone()).collect();
        names.extend(before);
    }
    names
}

fn undone(name: &str) -> impl Iterator<Item = (String, Change)> {
    let label_studio = without_digits(name).map(|name| (name.to_owned(), Change::LabelStudio));
    let roboflow = without_code(name).map(|name| (name.to_owned(), Change::Roboflow));
    let percent = decoded(name).map(|name| (name, Change::Percent));
    [label_studio, roboflow, percent].into_iter().flatten()
}

fn without_digits(name: &str) -> Option<&str> {
    let (digits, rest) = name.split_once('-')?;
    let is_digit = |byte: u8| matches!(byte, b'0'..=b'9' | b'a'..=b'f');
    (digits.len() == 8 && digits.bytes().all(is_digit) && !rest.is_empty()).then_some(rest)
}

fn without_code(name: &str) -> Option<&str> {
    let (name, code) = name.rsplit_once(".rf.")?;
    let code = code.split_once('.').map_or(code, |(code, _)| code); // the extension may still be there
    let (name, extension) = name.rsplit_once('_')?;
    let is_code = code.len() >= 8 && code.bytes().all(|byte| byte.is_ascii_alphanumeric());
    let is_extension = EXTENSIONS.iter().any(|known| extension.eq_ignore_ascii_case(known));
    (is_code && is_extension && !name.is_empty()).then_some(name)
}

/// The text of a web address; none where it holds no code of a character.
pub(super) fn decoded(name: &str) -> Option<String> {
    let (first, rest) = name.split_once('%')?;
    let mut bytes = first.as_bytes().to_vec();
    for part in rest.split('%') {
        let (digits, text) = part.split_at_checked(2)?;
        bytes.push(u8::from_str_radix(digits, 16).ok().filter(|_| !digits.starts_with('+'))?);
        bytes.extend_from_slice(text.as_bytes());
    }
    String::from_utf8(bytes).ok().map(ingest::nfc)
}

/// The letters and digits of a name, in words: the same for names that differ in other characters alone.
pub(super) fn words_of(name: &str) -> String {
    name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
}

/// The [`words_of`] all names that tools may give to a picture: without its folders, with some or all of them, and without the
/// characters that web servers take out.
pub(super) fn all_words(session: &str, stem: &str, folders: &[&str]) -> BTreeSet<String> {
    let served: String = stem.replace(' ', "_").chars().filter(|c| c.is_alphanumeric() || "-_.".contains(*c)).collect();
    let mut path = words_of(stem);
    let mut words = BTreeSet::from([words_of(&served), format!("{}-{path}", words_of(session)), path.clone()]);
    for folder in folders.iter().rev().copied().chain([session, "cards"]) {
        path = format!("{}-{path}", words_of(folder));
        words.insert(path.clone());
    }
    words.remove("");
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    fn before(name: &str) -> Vec<String> {
        names_before(name).into_iter().map(|(name, _)| name).collect()
    }

    #[test]
    fn names_of_tools_lead_back() {
        assert_eq!(before("1a2b3c4d-20210301T154030.250Z"), ["20210301T154030.250Z"]);
        assert_eq!(before("a_JPG.rf.0123456789abcdef0123456789abcdef"), ["a"]);
        assert_eq!(before("a_b_png.rf.AbCdEfGh12"), ["a_b"]);
        assert_eq!(before("1a2b3c4d-a_jpg.rf.0123456789abcdef"), ["a_jpg.rf.0123456789abcdef", "1a2b3c4d-a", "a", "a"]);
        assert_eq!(before("K%C3%A4se%20(1)"), ["K\u{e4}se (1)"]);
        for other in [
            "a",
            "1a2b3c4-a",
            "1A2B3C4D-a",
            "1a2b3c4d-",
            "a.rf.0123456789",
            "a_gif.rf.0123456789",
            "50%",
            "a%zz",
            "%+1a",
        ] {
            assert_eq!(before(other), Vec::<String>::new(), "{other}");
        }
    }

    #[test]
    fn words_are_what_tools_keep() {
        let words = all_words("S 1", "a (1).b", &["IMAGES"]);
        for name in ["a (1).b", "a_1.b", "a-1-b", "S_1_a_1_b", "IMAGES__a_1_b", "cards_S-1_IMAGES_a-1.b"] {
            assert!(words.contains(&words_of(name)), "{name}: {words:?}");
        }
        assert!(!words.contains(&words_of("a_1b")));
    }
}
