//! The meaning of a label of another tool: which object of the study, and what of it.

use std::cell::RefCell;
use std::collections::BTreeMap;

use ingest::config::nearest;
use ingest::nfc;
use model::{Feature, Quantity};

use super::foreign::{Annotation, short};

/// The attributes that say what a label leaves out.
const OBJECT: &str = "object";
const WHAT: &str = "what";

/// The number of names that a message lists.
const MOST_LISTED: usize = 20;

/// A thing that can be marked: a line that is a quantity, or the outline of a feature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum What {
    Line(Quantity),
    Outline(Feature),
}

impl What {
    pub fn all() -> impl Iterator<Item = Self> {
        let lines = Quantity::ALL.iter().copied().map(Self::Line);
        lines.chain(Feature::ALL.iter().copied().map(Self::Outline))
    }

    pub fn code(self) -> &'static str {
        match self {
            Self::Line(quantity) => quantity.code(),
            Self::Outline(feature) => feature.code(),
        }
    }

    pub fn from_code(code: &str) -> Option<Self> {
        Self::all().find(|what| what.code() == code)
    }
}

/// The codes of all that can be marked, for messages.
pub(super) fn all_codes() -> String {
    What::all().map(What::code).collect::<Vec<_>>().join(", ")
}

/// The meaning of a label.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Meaning {
    /// The object of objects.csv.
    pub object: String,
    /// The thing that is marked; none where the names of a skeleton's points must say it.
    pub what: Option<What>,
}

/// The names that labels may use.
#[derive(Debug, Clone, Default)]
pub struct Names {
    objects: Vec<String>,
    /// Labels of the file, with what they stand for.
    renamed: BTreeMap<String, String>,
    /// The messages on labels that are unclear: there are few of them, on many annotations.
    messages: RefCell<BTreeMap<String, String>>,
}

impl Names {
    /// The names that labels may use: `objects` are those of objects.csv, `renamed` holds labels of the file, each with the
    /// label that it stands for.
    pub fn new<'a>(objects: impl IntoIterator<Item = &'a String>, renamed: BTreeMap<String, String>) -> Self {
        Self {
            objects: objects.into_iter().cloned().collect(),
            renamed: renamed.into_iter().map(|(label, meaning)| (nfc(label), nfc(meaning))).collect(),
            messages: RefCell::default(),
        }
    }

    /// # Errors
    /// A text that says what is unclear, and what was expected.
    pub(super) fn meaning(&self, annotation: &Annotation) -> Result<Meaning, String> {
        let label = nfc(&annotation.label);
        let label = self.renamed.get(&label).unwrap_or(&label);
        let attribute = |key: &str| annotation.attributes.get(key).map(nfc);
        if let Some((object, code)) = label.rsplit_once('/') {
            let what = What::from_code(code).ok_or_else(|| self.unclear(label))?;
            return Ok(Meaning { object: self.known(object)?, what: Some(what) });
        }
        if let Some(what) = What::from_code(label).filter(|_| !self.has(label)) {
            let object = attribute(OBJECT).ok_or_else(|| self.unclear(label))?;
            return Ok(Meaning { object: self.known(&object)?, what: Some(what) });
        }
        if !self.has(label) {
            return Err(self.unclear(label));
        }
        let what = attribute(WHAT).map(|code| What::from_code(&code).ok_or_else(|| unclear_what(&code))).transpose()?;
        Ok(Meaning { object: label.clone(), what })
    }

    fn has(&self, object: &str) -> bool {
        self.objects.iter().any(|known| known == object)
    }

    fn known(&self, object: &str) -> Result<String, String> {
        if self.has(object) {
            return Ok(object.to_owned());
        }
        let fact = |object: &str| {
            let (near, objects) = (nearest_text(object, &self.objects), self.listed());
            format!("object '{object}' is not in objects.csv{near}; expected one of: {objects}")
        };
        Err(self.once(object, fact))
    }

    fn unclear(&self, label: &str) -> String {
        let fact = |label: &str| {
            let of_object = |object| What::all().map(move |what| format!("{object}/{}", what.code()));
            let near = nearest_text(label, &self.objects.iter().flat_map(of_object).collect::<Vec<_>>());
            let (whats, objects) = (all_codes(), self.listed());
            format!(
                "label '{label}' is unclear{near}; expected OBJECT/WHAT, or WHAT with an attribute '{OBJECT}', or OBJECT \
                 with an attribute '{WHAT}' or with named points; WHAT is one of: {whats}; OBJECT is one of: {objects}"
            )
        };
        self.once(label, fact)
    }

    /// The message on a label, worked out once.
    fn once(&self, label: &str, fact: impl Fn(&str) -> String) -> String {
        let label = short(label);
        self.messages.borrow_mut().entry(label.clone()).or_insert_with(|| fact(&label)).clone()
    }

    fn listed(&self) -> String {
        let listed = self.objects.iter().take(MOST_LISTED).map(String::as_str).collect::<Vec<_>>().join(", ");
        match self.objects.len().saturating_sub(MOST_LISTED) {
            0 => listed,
            more => format!("{listed} and {more} more"),
        }
    }
}

fn nearest_text(word: &str, known: &[String]) -> String {
    nearest(word, known).map(|near| format!(" (nearest: '{near}')")).unwrap_or_default()
}

fn unclear_what(code: &str) -> String {
    let (code, known) = (short(code), What::all().map(|what| what.code().to_owned()).collect::<Vec<_>>());
    format!("attribute '{WHAT}' is '{code}'{}; expected one of: {}", nearest_text(&code, &known), all_codes())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;
    use crate::exchange::foreign::Drawn;

    fn meaning(label: &str, attributes: &[(&str, &str)]) -> Result<(String, Option<&'static str>), String> {
        let objects = ["red bowl".to_owned(), "plate".to_owned(), "rim".to_owned()];
        let names = Names::new(&objects, BTreeMap::from([("Big".to_owned(), "red bowl/rim".to_owned())]));
        let attributes = attributes.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
        let drawn = Drawn::Unusable(String::new());
        let annotation = Annotation { place: String::new(), label: label.to_owned(), attributes, drawn };
        names.meaning(&annotation).map(|meaning| (meaning.object, meaning.what.map(What::code)))
    }

    #[test]
    fn the_ways_to_name_a_mark() {
        let red = |what| Ok(("red bowl".to_owned(), what));
        assert_eq!(meaning("red bowl/height", &[]), red(Some("height")));
        assert_eq!(meaning("red bowl", &[("what", "base")]), red(Some("base")));
        assert_eq!(meaning("diameter", &[("object", "red bowl")]), red(Some("diameter")));
        assert_eq!(meaning("red bowl", &[("colour", "red")]), red(None));
        assert_eq!(meaning("Big", &[]), red(Some("rim")));
        assert_eq!(meaning("rim", &[("what", "rim")]), Ok(("rim".to_owned(), Some("rim"))), "an object of that name");
    }

    #[test]
    fn a_name_in_either_unicode_form() {
        let names = Names::new(
            &["gr\u{fc}n".to_owned()],
            BTreeMap::from([("mu\u{308}".to_owned(), "gru\u{308}n/rim".to_owned())]),
        );
        for label in ["gru\u{308}n/rim", "m\u{fc}", "gr\u{fc}n/rim"] {
            let drawn = Drawn::Unusable(String::new());
            let annotation =
                Annotation { place: String::new(), label: label.to_owned(), attributes: BTreeMap::new(), drawn };
            assert_eq!(names.meaning(&annotation).unwrap().object, "gr\u{fc}n");
        }
    }

    #[test]
    fn what_is_unclear_is_told_with_what_was_expected() {
        for (label, attributes, expected) in [
            ("red bowl/girth", &[][..], "(nearest: 'red bowl/height')"),
            (
                "redbowl/rim",
                &[],
                "object 'redbowl' is not in objects.csv (nearest: 'red bowl'); expected one of: red bowl",
            ),
            ("Red bowl rim", &[], "OBJECT/WHAT"),
            ("diameter", &[], "attribute 'object'"),
            ("diameter", &[("object", "plat")], "nearest: 'plate'"),
            ("plate", &[("what", "rims")], "nearest: 'rim'"),
            ("", &[], "label '' is unclear"),
        ] {
            let fact = meaning(label, attributes).unwrap_err();
            assert!(fact.contains(expected), "{label}: {fact}");
        }
    }
}
