//! XML text into elements with their places. quick-xml finds the marks; what it would let pass is refused here.

use super::escape::{of_attribute, of_element, reference};
use crate::files::FileFault;
use crate::files::place::LineStarts;
use crate::files::tree::TOO_MANY;
use phrase::{Phrase, Phrased, phrase};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

/// The greatest depth to which elements may lie in each other.
const DEPTH_MAX: usize = 8;
/// Elements in one file; what the rules allow has fewer.
const ELEMENTS_MAX: usize = 100_000;
/// Attributes of one element; those that are known are fewer.
const ATTRIBUTES_MAX: usize = 16;

/// An element with what it holds.
#[derive(Debug, Default)]
pub(super) struct XmlElement {
    pub(super) name: String,
    /// The byte where it begins.
    pub(super) at: usize,
    /// Name, place and text, in the order of the file.
    pub(super) attributes: Vec<(String, usize, String)>,
    pub(super) children: Vec<XmlElement>,
    pub(super) text: String,
    /// The byte at which its text begins.
    pub(super) text_at: usize,
    /// True once there is text other than blanks.
    has_text: bool,
}

impl XmlElement {
    /// Returns the byte at which there is text other than blanks.
    pub(super) fn loose_text_at(&self) -> Option<usize> {
        (!self.text.trim_matches([' ', '\t', '\n', '\r']).is_empty()).then_some(self.text_at)
    }

    fn add(&mut self, at: usize, text: &str) {
        if !self.has_text {
            self.text_at = at + text.len() - text.trim_start().len();
            self.has_text = !text.trim().is_empty();
        }
        self.text.push_str(text);
    }
}

/// Place and name of the first element, unless something stands before it that is no XML.
pub(in crate::files) fn first_name(text: &str) -> Option<(usize, String)> {
    let mut reader = Reader::from_str(text);
    loop {
        let at = position(reader.buffer_position());
        match reader.read_event().ok()? {
            Event::Decl(_) | Event::PI(_) | Event::Comment(_) | Event::DocType(_) => {}
            Event::Text(blank) if blank.iter().all(u8::is_ascii_whitespace) => {}
            Event::Start(start) | Event::Empty(start) => {
                return Some((at, String::from_utf8_lossy(start.name().as_ref()).into_owned()));
            }
            Event::Text(_) | Event::CData(_) | Event::GeneralRef(_) | Event::End(_) | Event::Eof => return None,
        }
    }
}

/// The one element around all others.
pub(super) fn root(text: &str, lines: &LineStarts) -> Result<XmlElement, FileFault> {
    let mut parser = ElementParser { lines, reader: Reader::from_str(text), open: Vec::new(), root: None, elements: 0 };
    let config = parser.reader.config_mut();
    config.check_comments = true;
    while parser.step()? {}
    parser.finish(text.len())
}

struct ElementParser<'l, 't> {
    lines: &'l LineStarts<'t>,
    reader: Reader<&'t [u8]>,
    open: Vec<XmlElement>,
    root: Option<XmlElement>,
    elements: usize,
}

impl ElementParser<'_, '_> {
    fn no<T>(&self, at: usize, reason: impl Into<Phrase>) -> Result<T, FileFault> {
        Err(self.lines.fault(at, reason))
    }

    /// One mark further; false at the end.
    fn step(&mut self) -> Result<bool, FileFault> {
        let at = position(self.reader.buffer_position());
        let event = match self.reader.read_event() {
            Ok(event) => event,
            Err(error) => return self.no(position(self.reader.error_position()), broken(&error)),
        };
        match event {
            Event::Start(start) => self.start(at, &start)?,
            Event::Empty(start) => {
                self.start(at, &start)?;
                self.end();
            }
            Event::End(_) => self.end(),
            Event::Text(text) => self.text(at, &of_element(&String::from_utf8_lossy(&text)))?,
            Event::CData(text) => self.text(at, &of_element(&String::from_utf8_lossy(&text)))?,
            Event::GeneralRef(name) => {
                let read = reference(&String::from_utf8_lossy(&name));
                let c = read.map_err(|why| self.lines.fault(at, why.phrase()))?;
                self.text(at, c.encode_utf8(&mut [0; 4]))?;
            }
            Event::Decl(declared) => self.declared(at, &declared)?,
            Event::DocType(_) => {
                return self
                    .no(at, phrase!("file.a_program_may_have_no", "A program may have no DOCTYPE. Take it out."));
            }
            Event::PI(_) => {
                return self.no(at, phrase!("file.may_not_be_in_a", "<?…?> may not be in a program. Take it out."));
            }
            Event::Comment(_) => {}
            Event::Eof => return Ok(false),
        }
        Ok(true)
    }

    fn declared(&self, at: usize, declared: &quick_xml::events::BytesDecl) -> Result<(), FileFault> {
        let encoding = declared.encoding().map(|found| found.map(|name| name.eq_ignore_ascii_case(b"utf-8")));
        let version = declared.version().is_ok_and(|version| version.as_ref() == b"1.0");
        if at == 0 && version && !matches!(encoding, Some(Err(_) | Ok(false))) {
            return Ok(());
        }
        self.no(
            at,
            phrase!(
                "file.xml_must_be_the_first",
                "<?xml …?> must be the first line, with version 1.0 and UTF-8. Mend it or leave it out."
            ),
        )
    }

    fn start(&mut self, at: usize, start: &BytesStart) -> Result<(), FileFault> {
        let name = String::from_utf8_lossy(start.name().as_ref()).into_owned();
        if self.open.len() >= DEPTH_MAX {
            return self.no(
                at,
                phrase!(
                    "file.elements_lie_in_each_other",
                    "Elements lie in each other more than {DEPTH_MAX} deep. Make it simpler."
                ),
            );
        }
        self.elements += 1;
        if self.elements > ELEMENTS_MAX {
            return self.no(at, TOO_MANY.phrase());
        }
        if self.root.is_some() {
            return self.no(
                at,
                phrase!("file.stands_after_the_end_of", "<{name}> stands after the end of the program. Take it out."),
            );
        }
        let attributes = self.attributes(at, start)?;
        self.open.push(XmlElement { name, at, attributes, ..XmlElement::default() });
        Ok(())
    }

    fn attributes(&self, at: usize, start: &BytesStart) -> Result<Vec<(String, usize, String)>, FileFault> {
        let mut all: Vec<(String, usize, String)> = Vec::new();
        let mend = |reason: Phrase| {
            self.no(
                at,
                phrase!(
                    "file.mend_it_in",
                    "{reason} Mend it in <{name}>.",
                    name = String::from_utf8_lossy(start.name().as_ref())
                ),
            )
        };
        // The reader's own check for doubles compares each with all others, however many there are.
        for attribute in start.attributes().with_checks(false) {
            let Ok(attribute) = attribute else {
                return mend(phrase!(
                    "file.an_attribute_is_broken_write",
                    "An attribute is broken; write it as name=\"value\"."
                ));
            };
            if all.len() >= ATTRIBUTES_MAX {
                return mend(phrase!(
                    "file.there_are_more_than_attributes",
                    "There are more than {ATTRIBUTES_MAX} attributes."
                ));
            }
            let name = String::from_utf8_lossy(attribute.key.as_ref()).into_owned();
            if all.iter().any(|(known, ..)| *known == name) {
                return mend(phrase!("file.an_attribute_is_there_twice", "An attribute is there twice."));
            }
            let key = inside(start, attribute.key.as_ref());
            if !start.get(key.wrapping_sub(1)).is_some_and(u8::is_ascii_whitespace) {
                return self.no(
                    at + 1 + key,
                    phrase!("file.there_must_be_a_blank", "There must be a blank before {name}. Add one."),
                );
            }
            let raw = String::from_utf8_lossy(&attribute.value);
            let value_at = at + 1 + inside(start, &attribute.value);
            let text = of_attribute(&raw).map_err(|(within, why)| self.lines.fault(value_at + within, why.phrase()))?;
            all.push((name, at + 1 + key, text));
        }
        Ok(all)
    }

    fn end(&mut self) {
        let Some(done) = self.open.pop() else { return };
        match self.open.last_mut() {
            Some(around) => around.children.push(done),
            None => self.root = Some(done),
        }
    }

    fn text(&mut self, at: usize, text: &str) -> Result<(), FileFault> {
        match self.open.last_mut() {
            Some(element) => element.add(at, text),
            None if text.trim_start_matches('\u{feff}').trim().is_empty() => {}
            None => {
                let at = at + text.len() - text.trim_start().len();
                return self.no(
                    at,
                    phrase!("file.there_is_text_outside_of", "There is text outside of the program. Take it out."),
                );
            }
        }
        Ok(())
    }

    fn finish(self, end: usize) -> Result<XmlElement, FileFault> {
        if let Some(open) = self.open.last() {
            let reason = phrase!(
                "file.the_file_ends_inside_of",
                "The file ends inside of <{}>. Copy it again as a whole.",
                open.name
            );
            return self.no(end, reason);
        }
        match self.root {
            Some(root) => Ok(root),
            None => Err(self.lines.fault(
                end,
                phrase!("file.there_is_no_program_in", "There is no program in this file. Choose another one."),
            )),
        }
    }
}

fn position(at: u64) -> usize {
    usize::try_from(at).unwrap_or(usize::MAX)
}

/// Returns the byte at which a part of a start mark begins in it.
fn inside(start: &BytesStart, part: &[u8]) -> usize {
    let offset = (part.as_ptr() as usize).wrapping_sub(start.as_ptr() as usize);
    if offset <= start.len() { offset } else { 0 }
}

fn broken(error: &quick_xml::Error) -> Phrase {
    match error {
        quick_xml::Error::IllFormed(why) => {
            phrase!("file.this_is_no_xml_mend", "This is no XML: {why}. Mend it here.", why = why.to_string())
        }
        quick_xml::Error::Syntax(why) => {
            phrase!("file.this_is_no_xml_mend", "This is no XML: {why}. Mend it here.", why = why.to_string())
        }
        other => phrase!("file.this_is_no_xml_mend", "This is no XML: {why}. Mend it here.", why = other.to_string()),
    }
}
