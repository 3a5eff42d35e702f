//! The seal of a file of found rims, by which the program knows its own work from a person's.
//!
//! A person corrects a rim in the file that the program wrote, and the file keeps its name and its rater. So the program writes a hash
//! of the marks into its files ([`seal_of`]), in a key that LabelMe keeps. Where the marks are no longer those of the hash, or there is none,
//! a person has been at work.

use std::borrow::Cow;

use ingest::nfc;
use rims::Found;
use serde::{Deserialize, Serialize};

use super::LabelMeFile;
use super::Shape;
use crate::inputs::sha256_of_bytes;
use crate::json;

/// Who made the marks of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MarksAuthor {
    /// The program, and nobody changed them since.
    Program,
    /// A person, who made them or changed those of the program.
    Person,
}

/// The program's own key of a file.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct FileKey {
    /// See [`seal_of`].
    pub marks_sha256: String,
}

/// What a seal covers of a shape: everything that a size depends on, and nothing that other programs write in forms of their own.
#[derive(Serialize, PartialEq, PartialOrd)]
pub(super) struct Sealed<'a> {
    pub label: Cow<'a, str>,
    pub shape_type: &'a str,
    pub points: &'a [[f64; 2]],
    pub found: String,
}

impl<'a> Sealed<'a> {
    pub fn new(label: &'a str, shape_type: &'a str, points: &'a [[f64; 2]], found: Option<&Found>) -> Self {
        let found = found.and_then(|found| serde_json::to_string(found).ok()).unwrap_or_default();
        Self { label: Cow::Owned(nfc(label)), shape_type, points, found }
    }

    /// What there is of a shape as it was read; none where its key is not one of this program.
    fn of_shape(shape: &'a Shape) -> Option<Self> {
        let found = shape.found.as_ref().map(Found::deserialize).transpose().ok()?;
        Some(Self::new(&shape.label, shape.shape_type.as_deref()?, &shape.points, found.as_ref()))
    }
}

/// SHA-256 over the marks of a file, in whatever order its shapes are; points are in the frame of the file.
pub(super) fn seal_of(mut shapes: Vec<Sealed<'_>>) -> serde_json::Result<String> {
    shapes.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    Ok(sha256_of_bytes(&serde_json::to_vec(&shapes)?))
}

impl LabelMeFile<'_> {
    /// Who made its marks.
    pub(super) fn author(&self) -> MarksAuthor {
        if self.seal().is_some() { MarksAuthor::Program } else { MarksAuthor::Person }
    }

    /// Its seal, where that fits its marks.
    fn seal(&self) -> Option<String> {
        let key: FileKey = serde_json::from_str(self.key?.get()).ok()?;
        let shapes: Vec<Shape> =
            self.shapes.iter().map(|shape| serde_json::from_str(shape.get())).collect::<Result<_, _>>().ok()?;
        let sealed = shapes.iter().map(Sealed::of_shape).collect::<Option<_>>()?;
        (seal_of(sealed).ok()? == key.marks_sha256).then_some(key.marks_sha256)
    }
}

/// Who made the marks in the bytes of a LabelMe file. What is no such file was not written by the program.
pub(crate) fn author_of(bytes: &[u8]) -> MarksAuthor {
    if seal_in(bytes).is_some() { MarksAuthor::Program } else { MarksAuthor::Person }
}

/// The seal in the bytes of a LabelMe file whose marks nobody changed, by which it is seen to hold the same marks as another one.
pub(crate) fn seal_in(bytes: &[u8]) -> Option<String> {
    let bytes = json::with_null_for_nan(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    serde_json::from_slice::<LabelMeFile<'_>>(&bytes).ok()?.seal()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use model::{Kind, Shape as Outline};
    use rims::{HeightSource, RimHeight};
    use serde_json::{Value, json};

    use super::*;
    use crate::labelme::{AutoRim, text_of};

    fn written(rims: usize) -> Value {
        let height = RimHeight { mm: 61.0, sigma_mm: 0.1 + 0.2, source: HeightSource::Foot };
        let (kind, shape) = (Kind::Bowl, Outline::Circle);
        let found = Found { kind, shape, confidence: 1.0 / 3.0, perimeter_px: 512.0, height, plate_height: None };
        let rim = |number: usize| AutoRim {
            object: format!("auto-{number}"),
            points_px: (0..8).map(|i| [300.0 + f64::from(i), 1.123 * f64::from(i)]).collect(),
            found,
        };
        let rims: Vec<AutoRim> = (1..=rims).map(rim).collect();
        serde_json::from_str(&text_of(&rims, "a.jpg", [640, 480]).unwrap()).unwrap()
    }

    fn author(file: &Value) -> MarksAuthor {
        author_of(file.to_string().as_bytes())
    }

    #[test]
    fn a_file_as_written_is_the_program_s() {
        let mut file = written(2);
        assert_eq!(author(&file), MarksAuthor::Program);
        assert_eq!(author(&written(0)), MarksAuthor::Program, "nothing was found, and nothing added");
        // What programs change when they save a file again.
        file["version"] = json!("6.3.1");
        file["shapes"][0]["description"] = json!("");
        file["shapes"][0]["mask"] = Value::Null;
        file["shapes"][1]["points"][0] = json!([300, 0]);
        file["shapes"].as_array_mut().unwrap().reverse();
        assert_eq!(author(&file), MarksAuthor::Program);
    }

    #[test]
    fn whatever_a_person_changes_makes_it_his() {
        let changed = |change: fn(&mut Value)| {
            let mut file = written(2);
            change(&mut file);
            author(&file)
        };
        let changes: [fn(&mut Value); 8] = [
            |file| file["shapes"][0]["points"][3][1] = json!(3.37),
            |file| drop(file["shapes"][0]["points"].as_array_mut().unwrap().pop()),
            |file| file["shapes"][0]["label"] = json!("pink bowl/rim"),
            |file| file["shapes"][0]["aim_batch"]["kind"] = json!("plate"),
            |file| drop(file["shapes"][1].as_object_mut().unwrap().remove("aim_batch")),
            |file| drop(file["shapes"].as_array_mut().unwrap().pop()),
            |file| file["shapes"] = json!([]),
            |file| drop(file.as_object_mut().unwrap().remove("aim_batch")),
        ];
        for (number, change) in changes.into_iter().enumerate() {
            assert_eq!(changed(change), MarksAuthor::Person, "change {number}");
        }
        assert_eq!(author_of(b"{"), MarksAuthor::Person);
    }
}
