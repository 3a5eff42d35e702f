//! Reads a figure as any reader of SVG would: as XML, with its paths.

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

/// The content of a figure.
#[derive(Debug, Default)]
pub struct Drawn {
    pub view_box: [f64; 2],
    pub ids: Vec<String>,
    pub elements: Vec<String>,
    /// Class of the group and the points of every path, one list for each part that begins with M or m.
    pub parts: Vec<(String, Vec<[f64; 2]>)>,
    /// Place and words of every text.
    pub texts: Vec<([f64; 2], String)>,
    /// The texts that pointers show, and the title and the description of the figure.
    pub titles: Vec<String>,
}

impl Drawn {
    /// Panics where the figure is not well formed.
    pub fn parse(svg: &str) -> Self {
        let mut drawn = Self::default();
        let mut reader = Reader::from_str(svg);
        let (mut class, mut open): (String, Vec<String>) = (String::new(), Vec::new());
        loop {
            match reader.read_event().unwrap() {
                Event::Start(start) => {
                    drawn.element(&start, &mut class);
                    open.push(name(&start));
                }
                Event::Empty(start) => drawn.element(&start, &mut class),
                Event::Text(text) => drawn.words(&text.decode().unwrap(), &open),
                Event::GeneralRef(reference) => {
                    let known = [("amp", "&"), ("lt", "<"), ("gt", ">"), ("quot", "\""), ("apos", "'")];
                    let code = reference.decode().unwrap().into_owned();
                    let number = || Some(reference.resolve_char_ref().unwrap()?.to_string());
                    let named = known.iter().find(|(name, _)| *name == code).map(|(_, text)| (*text).to_owned());
                    drawn.words(&named.or_else(number).unwrap(), &open);
                }
                Event::End(end) => {
                    assert_eq!(open.pop().unwrap().as_bytes(), end.name().as_ref());
                }
                Event::Eof => break,
                other => panic!("{other:?} in\n{svg}"),
            }
        }
        assert!(open.is_empty(), "{open:?} is not closed");
        drawn
    }

    fn element(&mut self, start: &BytesStart<'_>, class: &mut String) {
        let attribute = |name: &str| {
            let mut all = start.attributes().map(Result::unwrap);
            all.find(|found| found.key.as_ref() == name.as_bytes())
                .map(|found| found.unescape_value().unwrap().into_owned())
        };
        self.elements.push(name(start));
        self.ids.extend(attribute("id"));
        match name(start).as_str() {
            "svg" => {
                let numbers: Vec<f64> =
                    attribute("viewBox").unwrap().split(' ').map(|text| text.parse().unwrap()).collect();
                assert_eq!(numbers[..2], [0.0, 0.0]);
                self.view_box = [numbers[2], numbers[3]];
            }
            "g" => *class = attribute("class").unwrap(),
            "path" => self.parts.extend(parts(&attribute("d").unwrap()).into_iter().map(|part| (class.clone(), part))),
            "text" => {
                let place = ["x", "y"].map(|name| attribute(name).unwrap().parse().unwrap());
                self.texts.push((place, String::new()));
            }
            "title" | "desc" => self.titles.push(String::new()),
            _ => {}
        }
    }

    fn words(&mut self, words: &str, open: &[String]) {
        match open.last().map(String::as_str) {
            Some("text") => self.texts.last_mut().unwrap().1.push_str(words),
            Some("title" | "desc") => self.titles.last_mut().unwrap().push_str(words),
            _ => assert!(words.trim().is_empty(), "'{words}' stands outside of a text"),
        }
    }

    /// Number of marks: the parts of paths of a class that begin with an M. A cross has two such parts.
    pub fn marks(&self) -> usize {
        self.parts.iter().filter(|(class, _)| class == "marks").count()
    }
}

fn name(start: &BytesStart<'_>) -> String {
    String::from_utf8(start.name().as_ref().to_vec()).unwrap()
}

/// The points of a path of M, m, L, l, H, h, V, v, a and z.
fn parts(path: &str) -> Vec<Vec<[f64; 2]>> {
    let mut parts: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut at = [0.0, 0.0];
    let begins: Vec<usize> = path
        .char_indices()
        .filter(|(_, c)| c.is_ascii_alphabetic())
        .map(|(index, _)| index)
        .chain([path.len()])
        .collect();
    for window in begins.windows(2) {
        let (command, rest) = path[window[0]..window[1]].split_at(1);
        let numbers: Vec<f64> =
            rest.split([',', ' ']).filter(|text| !text.is_empty()).map(|text| text.parse().unwrap()).collect();
        assert!(numbers.iter().all(|number| number.is_finite()), "{path}");
        at = match (command, numbers.as_slice()) {
            ("M" | "L", [x, y]) => [*x, *y],
            ("m" | "l", [x, y]) | ("a", [_, _, _, _, _, x, y]) => [at[0] + x, at[1] + y],
            ("H", [x]) => [*x, at[1]],
            ("h", [x]) => [at[0] + x, at[1]],
            ("V", [y]) => [at[0], *y],
            ("v", [y]) => [at[0], at[1] + y],
            ("z", []) => at,
            other => panic!("{other:?} in {path}"),
        };
        if command == "M" {
            parts.push(Vec::new());
        }
        parts.last_mut().unwrap().push(at);
    }
    parts
}
