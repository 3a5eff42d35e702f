//! Writes CVAT's XML, 'CVAT for images 1.1'.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use super::{Labelled, MarkedImage, labels};
use crate::exchange::label::What;

type XmlWriter = Writer<Vec<u8>>;

/// The text of the file. A task that it is loaded into must have its labels.
pub(super) fn text(images: &[MarkedImage], study: &str) -> io::Result<String> {
    let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
    writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("utf-8"), None)))?;
    writer.create_element("annotations").write_inner_content(|writer| {
        element(writer, "version", "1.1")?;
        meta(writer, images, study)?;
        (0..).zip(images).try_for_each(|(id, marked)| image(writer, id, marked))
    })?;
    let text = String::from_utf8(writer.into_inner()).map_err(io::Error::other)?;
    Ok(text + "\n")
}

fn element(writer: &mut XmlWriter, name: &str, text: &str) -> io::Result<()> {
    writer.create_element(name).write_text_content(BytesText::new(text)).map(|_| ())
}

fn meta(writer: &mut XmlWriter, images: &[MarkedImage], study: &str) -> io::Result<()> {
    let task = |writer: &mut XmlWriter| {
        element(writer, "name", study)?;
        element(writer, "size", &images.len().to_string())?;
        element(writer, "mode", "annotation")?;
        let labels = labels(images);
        let all = |writer: &mut XmlWriter| labels.iter().try_for_each(|(name, what)| label(writer, name, *what));
        writer.create_element("labels").write_inner_content(all).map(|_| ())
    };
    let inner = |writer: &mut XmlWriter| writer.create_element("task").write_inner_content(task).map(|_| ());
    writer.create_element("meta").write_inner_content(inner).map(|_| ())
}

fn label(writer: &mut XmlWriter, name: &str, what: What) -> io::Result<()> {
    let inner = |writer: &mut XmlWriter| {
        element(writer, "name", name)?;
        element(writer, "type", kind(what))?;
        element(writer, "attributes", "")
    };
    writer.create_element("label").write_inner_content(inner).map(|_| ())
}

fn kind(what: What) -> &'static str {
    match what {
        What::Line(_) => "polyline",
        What::Outline(_) => "polygon",
    }
}

fn image(writer: &mut XmlWriter, id: usize, image: &MarkedImage) -> io::Result<()> {
    let [width, height] = image.size_px.map(|size| size.to_string());
    let id = id.to_string();
    let attributes = [("id", id.as_str()), ("name", &image.name), ("width", &width), ("height", &height)];
    let shapes = |writer: &mut XmlWriter| image.marks.iter().try_for_each(|mark| shape(writer, mark));
    writer.create_element("image").with_attributes(attributes).write_inner_content(shapes).map(|_| ())
}

fn shape(writer: &mut XmlWriter, mark: &Labelled) -> io::Result<()> {
    let label = mark.label();
    let points = mark.points_px.iter().map(|[x, y]| format!("{x},{y}")).collect::<Vec<_>>().join(";");
    let attributes =
        [("label", label.as_str()), ("source", "manual"), ("occluded", "0"), ("points", &points), ("z_order", "0")];
    writer.create_element(kind(mark.what)).with_attributes(attributes).write_inner_content(|_| Ok(())).map(|_| ())
}
