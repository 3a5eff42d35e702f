//! Converts a drawing and its label into marks of a LabelMe file.

use super::foreign::{Annotation, Drawn, Ellipse, Form, NamedPoint};
use super::label::{Meaning, Names, What};
use super::named;

/// A mark as LabelMe has it.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvertedMark {
    /// The label, `OBJECT/WHAT`.
    pub label: String,
    /// The type in LabelMe's words: line, polygon, linestrip or points.
    pub shape_type: &'static str,
    /// The points, as the tool had them.
    pub points_px: Vec<[f64; 2]>,
}

/// The marks of one annotation.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Converted {
    /// The marks.
    pub marks: Vec<ConvertedMark>,
    /// Notes on points that were left out by the rules of docs/marks.md.
    pub notes: Vec<String>,
}

/// The number of points of an ellipse. It was set by 5 numbers: more points would feign that somebody marked each of them.
const ELLIPSE_POINTS: u32 = 8;
const FEWEST_ELLIPSE_POINTS: usize = 5;

/// Tools round, and let a point lie on the border; further out nobody can have seen anything.
const OUTSIDE_PX: f64 = 1.0;

/// The marks that an annotation means. `picture_px` is the width and height of the picture; `with_hidden` says whether
/// points that are marked as hidden are taken.
///
/// # Errors
/// The reason why it gives no marks: what was expected, and what was there.
pub fn marks_of(
    annotation: &Annotation,
    names: &Names,
    picture_px: [u32; 2],
    with_hidden: bool,
) -> Result<Converted, String> {
    if let Drawn::Unusable(fact) = &annotation.drawn {
        return Err(fact.clone());
    }
    let meaning = names.meaning(annotation)?;
    let converted = match &annotation.drawn {
        Drawn::Points { form, points_px } => one(points(&meaning, *form, points_px)?),
        Drawn::Ellipse(ellipse) => one(outline_of(&meaning, ellipse, picture_px)?),
        Drawn::Named(points) => marks_of_named(&meaning, points, with_hidden)?,
        Drawn::Unusable(fact) => return Err(fact.clone()),
    };
    let outside = |point: &&[f64; 2]| !is_within(**point, picture_px);
    if let Some([x, y]) = converted.marks.iter().flat_map(|mark| &mark.points_px).find(outside) {
        let [width, height] = picture_px;
        return Err(format!("a point at {x}, {y}: expected points in the picture, of {width} x {height} px"));
    }
    Ok(converted)
}

fn one(mark: ConvertedMark) -> Converted {
    Converted { marks: vec![mark], notes: Vec::new() }
}

/// Whether a point lies in the picture; false for numbers that are not finite.
fn is_within(point: [f64; 2], [width, height]: [u32; 2]) -> bool {
    let within = |at: f64, size: u32| (-OUTSIDE_PX..=f64::from(size) + OUTSIDE_PX).contains(&at);
    within(point[0], width) && within(point[1], height)
}

fn what_of(meaning: &Meaning) -> Result<What, String> {
    meaning.what.ok_or_else(|| {
        let (object, codes) = (&meaning.object, super::label::all_codes());
        format!("the label names '{object}', but not what of it is marked: expected {object}/WHAT, or an attribute 'what'; WHAT is one of: {codes}")
    })
}

fn label(object: &str, what: What) -> String {
    format!("{object}/{}", what.code())
}

fn points(meaning: &Meaning, form: Form, points_px: &[[f64; 2]]) -> Result<ConvertedMark, String> {
    let what = what_of(meaning)?;
    let shape_type = match (what, form) {
        (What::Line(_), Form::Polyline | Form::Loose) if points_px.len() == 2 => "line",
        (What::Line(quantity), _) => {
            let form = form.word();
            return Err(format!(
                "expected a polyline with 2 points for {quantity}, got a {form} with {}",
                points_px.len()
            ));
        }
        (What::Outline(_), Form::Polygon) => "polygon",
        (What::Outline(_), Form::Polyline) => "linestrip",
        (What::Outline(_), Form::Loose) => "points",
    };
    Ok(ConvertedMark { label: label(&meaning.object, what), shape_type, points_px: points_px.to_vec() })
}

impl Form {
    const fn word(self) -> &'static str {
        match self {
            Self::Polygon => "polygon",
            Self::Polyline => "polyline",
            Self::Loose => "set of points",
        }
    }
}

/// The outline of an ellipse. Where it runs over the border nobody saw it, so those points are left out.
fn outline_of(meaning: &Meaning, ellipse: &Ellipse, picture_px: [u32; 2]) -> Result<ConvertedMark, String> {
    let what = what_of(meaning)?;
    let What::Outline(_) = what else {
        return Err(format!("expected a polyline with 2 points for {}, got an ellipse", what.code()));
    };
    let mut points_px = ellipse.points_px(ELLIPSE_POINTS);
    points_px.retain(|point| is_within(*point, picture_px));
    if points_px.len() < FEWEST_ELLIPSE_POINTS {
        let (kept, all) = (points_px.len(), ELLIPSE_POINTS);
        return Err(format!(
            "an ellipse of which only {kept} points of {all} lie in the picture: mark what is seen of it"
        ));
    }
    Ok(ConvertedMark { label: label(&meaning.object, what), shape_type: "points", points_px })
}

fn marks_of_named(meaning: &Meaning, points: &[NamedPoint], with_hidden: bool) -> Result<Converted, String> {
    let mut converted = Converted::default();
    for group in named::groups(points, meaning.what)? {
        let (taken, hidden) = group.taken(with_hidden)?;
        if hidden > 0 {
            let what = group.what.code();
            converted.notes.push(format!("{hidden} hidden points of {what} left out (--with-hidden takes them)"));
        }
        if !taken.is_empty() {
            let shape_type = if matches!(group.what, What::Line(_)) { "line" } else { "points" };
            converted.marks.push(ConvertedMark {
                label: label(&meaning.object, group.what),
                shape_type,
                points_px: taken,
            });
        }
    }
    if converted.marks.is_empty() && converted.notes.is_empty() {
        return Err("none of its points is marked as there".to_owned());
    }
    Ok(converted)
}

#[cfg(test)]
mod tests;
