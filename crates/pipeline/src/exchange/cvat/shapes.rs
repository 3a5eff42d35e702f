//! The shapes that CVAT draws.

use std::collections::BTreeMap;

use super::xml::{Element, Reader, Start};
use crate::exchange::ExchangeError;
use crate::exchange::foreign::{Annotation, Drawn, Ellipse, Form, NamedPoint, Sight, short};

type Attributes = BTreeMap<String, String>;

/// Reads a shape of an image, to its end.
pub(super) fn annotation(reader: &mut Reader<'_>, start: &Start<'_>) -> Result<Annotation, ExchangeError> {
    let mut own = start.attributes(reader)?;
    let drawn = if is_set(&own, "outside") {
        Drawn::Unusable("marked as outside: it is not in this picture".to_owned())
    } else {
        drawing(start.name(), &own).unwrap_or_else(Drawn::Unusable)
    };
    let place = start.place();
    let mut annotation =
        Annotation { place, label: own.remove("label").unwrap_or_default(), attributes: Attributes::new(), drawn };
    loop {
        match reader.next_within()? {
            Element::End => return Ok(annotation),
            Element::Text(_) => {}
            Element::Start(inner) if inner.name() == "attribute" => {
                let name = inner.attributes(reader)?.remove("name").unwrap_or_default();
                annotation.attributes.insert(name, reader.text_of()?);
            }
            Element::Start(inner) => {
                let point = element(inner.name(), inner.attributes(reader)?);
                reader.skip(&inner)?;
                annotation.drawn = with_element(annotation.drawn, point);
            }
        }
    }
}

fn with_element(drawn: Drawn, point: Result<NamedPoint, String>) -> Drawn {
    match (drawn, point) {
        (Drawn::Named(mut points), Ok(point)) => {
            points.push(point);
            Drawn::Named(points)
        }
        (Drawn::Named(_), Err(fact)) => Drawn::Unusable(fact),
        (other, _) => other,
    }
}

fn drawing(name: &str, own: &Attributes) -> Result<Drawn, String> {
    let points = |form| Ok(Drawn::Points { form, points_px: points(own)? });
    match name {
        "polygon" => points(Form::Polygon),
        "polyline" => points(Form::Polyline),
        "points" => points(Form::Loose),
        "ellipse" => Ok(Drawn::Ellipse(ellipse(own)?)),
        "skeleton" => Ok(Drawn::Named(Vec::new())),
        "box" => Err("a box says nothing of a rim: draw a polygon, polyline or ellipse along it".to_owned()),
        "mask" => Err("a mask says which pixels, not where the rim is: draw a polygon or ellipse along it".to_owned()),
        "cuboid" => Err("a cuboid is no mark here: draw lines and a polygon".to_owned()),
        "tag" => Err("a tag of the whole picture has no points".to_owned()),
        other => Err(format!(
            "<{}> is not known here; expected polygon, polyline, points, ellipse or skeleton",
            short(other)
        )),
    }
}

fn ellipse(own: &Attributes) -> Result<Ellipse, String> {
    let number =
        |key: &str| own.get(key).ok_or_else(|| format!("an ellipse without {key}")).and_then(|text| coordinate(text));
    let rotation_deg = own.get("rotation").map_or(Ok(0.0), |text| coordinate(text))?;
    let half_axes_px = [number("rx")?, number("ry")?];
    if half_axes_px.iter().any(|half| *half <= 0.0) {
        return Err("an ellipse whose rx and ry are not both positive".to_owned());
    }
    let centre_px = [number("cx")?, number("cy")?];
    Ok(Ellipse { centre_px, half_axes_px, rotation_rad: rotation_deg.to_radians() })
}

fn is_set(own: &Attributes, key: &str) -> bool {
    own.get(key).is_some_and(|value| !matches!(value.trim().to_ascii_lowercase().as_str(), "0" | "false" | ""))
}

/// Reads a point of a skeleton.
fn element(name: &str, mut own: Attributes) -> Result<NamedPoint, String> {
    let label = own.remove("label").unwrap_or_default();
    let sight = match (is_set(&own, "outside"), is_set(&own, "occluded")) {
        (true, _) => Sight::Absent,
        (false, true) => Sight::Hidden,
        (false, false) => Sight::Seen,
    };
    match (name, points(&own)?.as_slice()) {
        ("points", &[point_px]) => Ok(NamedPoint { name: label, point_px, sight }),
        (_, several) => {
            let (label, name) = (short(&label), short(name));
            Err(format!("'{label}' of the skeleton: expected 1 point, got a {name} with {}", several.len()))
        }
    }
}

/// The points of a text `x,y;x,y;...`.
fn points(own: &Attributes) -> Result<Vec<[f64; 2]>, String> {
    let text = own.get("points").ok_or("expected points=\"x,y;x,y;...\", got none")?;
    let point = |pair: &str| {
        let (x, y) =
            pair.split_once(',').ok_or_else(|| format!("expected points as x,y;x,y, got '{}'", short(pair)))?;
        Ok([coordinate(x)?, coordinate(y)?])
    };
    text.split(';').map(point).collect()
}

fn coordinate(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| format!("expected a finite number, got '{}'", short(text)))
}
