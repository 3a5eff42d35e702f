//! XML as far as CVAT writes it: elements, attributes and text, with the lines that they stand in.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;

use quick_xml::events::{BytesStart, Event};

use super::ExchangeError;

/// A piece of the document.
pub(super) enum Element<'a> {
    Start(Start<'a>),
    Text(Cow<'a, str>),
    End,
}

/// The beginning of an element.
pub(super) struct Start<'a> {
    tag: BytesStart<'a>,
    name: String,
    line: usize,
}

/// Reads a document piece by piece. No entities but those of XML itself are known.
pub(super) struct Reader<'a> {
    xml: quick_xml::Reader<&'a [u8]>,
    text: &'a str,
    path: &'a Path,
    /// Line breaks have been counted up to this byte.
    counted: usize,
    line: usize,
}

impl<'a> Reader<'a> {
    pub fn new(text: &'a str, path: &'a Path) -> Self {
        let mut xml = quick_xml::Reader::from_str(text);
        xml.config_mut().expand_empty_elements = true;
        Self { xml, text, path, counted: 0, line: 1 }
    }

    /// The next piece; none at the end of the document.
    pub fn next(&mut self) -> Result<Option<Element<'a>>, ExchangeError> {
        loop {
            let line = self.line_now();
            let event = self.xml.read_event().map_err(|error| self.malformed(line, error.to_string()))?;
            let text = |text: Result<Cow<'a, str>, quick_xml::encoding::EncodingError>| {
                text.map_err(|error| Self::malformed_at(self.path, line, error.to_string()))
            };
            return Ok(Some(match event {
                Event::Eof => return Ok(None),
                Event::Start(tag) => {
                    let name = String::from_utf8_lossy(tag.name().as_ref()).into_owned();
                    Element::Start(Start { tag, name, line })
                }
                Event::End(_) => Element::End,
                Event::Text(content) => Element::Text(text(content.decode())?),
                Event::CData(content) => Element::Text(text(content.decode())?),
                Event::GeneralRef(reference) => Element::Text(self.resolved(&reference, line)?.into()),
                Event::DocType(_) => {
                    return Err(self.malformed(line, "a document type, which CVAT does not write".to_owned()));
                }
                Event::Decl(_) | Event::Comment(_) | Event::PI(_) | Event::Empty(_) => continue,
            }));
        }
    }

    /// The next piece of an element that has begun.
    pub fn next_within(&mut self) -> Result<Element<'a>, ExchangeError> {
        let at_end = |reader: &mut Self| {
            let line = reader.line_now();
            reader.malformed(line, "the file ends within an element: it is not whole".to_owned())
        };
        self.next()?.ok_or_else(|| at_end(self))
    }

    /// Passes over an element, with all that is in it.
    pub fn skip(&mut self, start: &Start<'_>) -> Result<(), ExchangeError> {
        let end = start.tag.to_end().into_owned();
        let skipped = self.xml.read_to_end(end.name());
        skipped.map(|_| ()).map_err(|error| self.malformed(start.line, error.to_string()))
    }

    /// The text of an element that has begun; elements in it are passed over.
    pub fn text_of(&mut self) -> Result<String, ExchangeError> {
        let mut text = String::new();
        loop {
            match self.next_within()? {
                Element::Text(piece) => text.push_str(&piece),
                Element::Start(start) => self.skip(&start)?,
                Element::End => return Ok(text),
            }
        }
    }

    /// Checks that nothing but white space follows.
    pub fn expect_end(&mut self) -> Result<(), ExchangeError> {
        while let Some(element) = self.next()? {
            if !matches!(&element, Element::Text(text) if text.trim().is_empty()) {
                let line = self.line_now();
                return Err(self.malformed(line, "something follows </annotations>".to_owned()));
            }
        }
        Ok(())
    }

    /// The error that the document is XML, but not CVAT's.
    pub fn not_cvat(&mut self, fact: String) -> ExchangeError {
        ExchangeError::NotCvat { path: self.path.to_owned(), line: self.line_now(), fact }
    }

    fn resolved(&self, reference: &quick_xml::events::BytesRef<'_>, line: usize) -> Result<String, ExchangeError> {
        let refuse = |error: String| self.malformed(line, error);
        if let Some(character) = reference.resolve_char_ref().map_err(|error| refuse(error.to_string()))? {
            return Ok(character.to_string());
        }
        let name = reference.decode().map_err(|error| refuse(error.to_string()))?;
        let known = quick_xml::escape::resolve_predefined_entity(&name);
        known.map(str::to_owned).ok_or_else(|| refuse(format!("unknown entity '{name}'")))
    }

    fn line_now(&mut self) -> usize {
        let at = usize::try_from(self.xml.buffer_position()).unwrap_or(usize::MAX).min(self.text.len());
        let read = self.text.as_bytes().get(self.counted..at).unwrap_or_default();
        self.line += read.iter().filter(|byte| **byte == b'\n').count();
        self.counted = self.counted.max(at);
        self.line
    }

    fn malformed(&self, line: usize, fact: String) -> ExchangeError {
        Self::malformed_at(self.path, line, fact)
    }

    fn malformed_at(path: &Path, line: usize, fact: String) -> ExchangeError {
        ExchangeError::Xml { path: path.to_owned(), line, fact }
    }
}

impl Start<'_> {
    pub fn name(&self) -> &str {
        &self.name
    }

    pub fn place(&self) -> String {
        format!("line {}", self.line)
    }

    /// The attributes of an element by name; one that stands there twice is an error.
    pub fn attributes(&self, reader: &Reader<'_>) -> Result<BTreeMap<String, String>, ExchangeError> {
        let refuse = |fact: String| reader.malformed(self.line, fact);
        let mut attributes = BTreeMap::new();
        for attribute in self.tag.attributes() {
            let attribute = attribute.map_err(|error| refuse(error.to_string()))?;
            let value = attribute.unescape_value().map_err(|error| refuse(error.to_string()))?;
            attributes.insert(String::from_utf8_lossy(attribute.key.as_ref()).into_owned(), value.into_owned());
        }
        Ok(attributes)
    }
}
