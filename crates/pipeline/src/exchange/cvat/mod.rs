//! CVAT's XML, "CVAT for images 1.1" (<https://docs.cvat.ai/docs/dataset_management/formats/format-cvat/>).
//!
//! Entities of a document type are not expanded, and such a document is refused: CVAT writes none.

mod shapes;
mod xml;

use std::path::Path;

use super::ExchangeError;
use super::foreign::{Foreign, ForeignImage, Refused, short};
use crate::json;
use xml::{Element, Reader};

const EXPORT: &str = "export the task from CVAT as 'CVAT for images 1.1'";

/// The content of a file. `path` is for messages.
///
/// # Errors
/// [`ExchangeError`] where the file is not XML, or is not CVAT's for images.
pub fn parse(text: &str, path: &Path) -> Result<Foreign, ExchangeError> {
    let mut reader = Reader::new(text, path);
    let root = loop {
        match reader.next()? {
            Some(Element::Start(start)) => break Some(start),
            Some(_) => {}
            None => break None,
        }
    };
    if root.as_ref().is_none_or(|root| root.name() != "annotations") {
        return Err(reader.not_cvat(format!("expected CVAT's <annotations>; {EXPORT}")));
    }
    let mut foreign = Foreign::default();
    let mut tracks = 0_usize;
    loop {
        match reader.next_within()? {
            Element::End => break,
            Element::Text(_) => {}
            Element::Start(start) => match start.name() {
                "image" => foreign.images.push(image(&mut reader, &start)?),
                "version" | "meta" => reader.skip(&start)?,
                other => {
                    tracks += usize::from(other == "track");
                    foreign.refused.push(refused(&start));
                    reader.skip(&start)?;
                }
            },
        }
    }
    if foreign.images.is_empty() && tracks > 0 {
        let fact = "tracks of 'CVAT for video', which name no pictures, and whose shapes between keyframes nobody drew";
        return Err(reader.not_cvat(format!("{fact}; {EXPORT}")));
    }
    reader.expect_end()?;
    Ok(foreign)
}

fn refused(start: &xml::Start<'_>) -> Refused {
    let fact = match start.name() {
        "track" => format!("a track names no pictures, and between keyframes nobody drew it; {EXPORT}"),
        other => format!("<{}> is not known here; expected <image>", short(other)),
    };
    Refused { place: start.place(), fact }
}

fn image(reader: &mut Reader<'_>, start: &xml::Start<'_>) -> Result<ForeignImage, ExchangeError> {
    let mut attributes = start.attributes(reader)?;
    let size_px = size_px(attributes.remove("width"), attributes.remove("height"));
    let mut image = ForeignImage {
        place: start.place(),
        name: attributes.remove("name").unwrap_or_default(),
        size_px: size_px.clone().unwrap_or_default(),
        fault: size_px.err(),
        annotations: Vec::new(),
    };
    loop {
        match reader.next_within()? {
            Element::Start(start) => image.annotations.push(shapes::annotation(reader, &start)?),
            Element::Text(_) => {}
            Element::End => return Ok(image),
        }
    }
}

/// The width and height of an image; none where one of them is missing.
fn size_px(width: Option<String>, height: Option<String>) -> Result<Option<[u32; 2]>, String> {
    let side = |name: &str, text: Option<String>| {
        let Some(text) = text else { return Ok(None) };
        let whole = json::whole_number(&text).and_then(|digits| digits.parse::<u32>().ok());
        whole.ok_or_else(|| format!("{name}: expected a whole number of pixels, got '{}'", short(&text))).map(Some)
    };
    Ok(side("width", width)?.zip(side("height", height)?).map(|(width, height)| [width, height]))
}

#[cfg(test)]
mod tests;
