//! XML into the same tree as JSON: which element and attribute is which field.

mod element;
mod escape;
pub(super) mod write;

use super::FileFault;
use super::json::number;
use super::place::LineStarts;
use super::tree::{FileNode, NoNumber, NodeKind};
use behaviour::{FORMAT, Value};
pub(super) use element::first_name;
use element::{XmlElement, root};
#[cfg(test)]
pub(super) use escape::reference;
pub(super) use escape::{cannot_hold, in_element};
use phrase::{Phrase, Phrased, phrase};

/// The most characters that are told of the name of an unknown element.
const NAME_SHOWN_CHARS: usize = 40;
/// The version of the XML form.
const VERSION: &str = "1";

/// The ways to read the text of an attribute.
#[derive(Clone, Copy)]
enum AttributeReading {
    Text,
    /// A number as in JSON.
    Number,
    /// A number with the unit ms behind it.
    Millis,
    /// Names with blanks between them.
    Names,
    /// `true` or `false`; anything else stays a text, of which the reader says that it is neither.
    Truth,
}

/// An attribute, the field it is, and how it is read.
type KnownAttribute = (&'static str, &'static str, AttributeReading);

const BEHAVIOUR: &[KnownAttribute] = &[
    ("format", "format", AttributeReading::Text),
    ("id", "id", AttributeReading::Text),
    ("name", "name", AttributeReading::Text),
    ("robot", "robot", AttributeReading::Text),
    ("engine", "engine", AttributeReading::Text),
    ("frame", "frame", AttributeReading::Millis),
    ("exercise", "exercise", AttributeReading::Text),
];
const HELPER: &[KnownAttribute] = &[
    ("id", "name", AttributeReading::Text),
    ("args", "params", AttributeReading::Names),
    ("says", "says", AttributeReading::Text),
    ("takes", "takes", AttributeReading::Names),
    ("gives", "gives", AttributeReading::Text),
];
const STREAM: &[KnownAttribute] = &[
    ("id", "id", AttributeReading::Text),
    ("name", "name", AttributeReading::Text),
    ("device", "device", AttributeReading::Text),
    ("priority", "priority", AttributeReading::Number),
    ("hold", "holdMs", AttributeReading::Millis),
    ("order", "order", AttributeReading::Number),
];
const CONNECTOR: &[KnownAttribute] = &[
    ("id", "id", AttributeReading::Text),
    ("to", "output", AttributeReading::Text),
    ("helper", "helper", AttributeReading::Text),
    ("period", "periodMs", AttributeReading::Millis),
    ("start", "start", AttributeReading::Text),
    ("order", "order", AttributeReading::Number),
];
const NOTE: &[KnownAttribute] = &[
    ("id", "id", AttributeReading::Text),
    ("by", "by", AttributeReading::Text),
    ("at", "at", AttributeReading::Number),
];
const GROUP: &[KnownAttribute] = &[
    ("id", "id", AttributeReading::Text),
    ("title", "title", AttributeReading::Text),
    ("streams", "streams", AttributeReading::Names),
    ("folded", "folded", AttributeReading::Truth),
];
const TILE: &[KnownAttribute] = &[
    ("key", "key", AttributeReading::Number),
    ("label", "label", AttributeReading::Text),
    ("device", "device", AttributeReading::Text),
    ("stream", "stream", AttributeReading::Text),
    ("value", "value", AttributeReading::Text),
    ("word", "word", AttributeReading::Text),
    ("span", "span", AttributeReading::Truth),
    ("asks", "asks", AttributeReading::Truth),
];
const AT: &[KnownAttribute] = &[
    ("ref", "ref", AttributeReading::Text),
    ("x", "x", AttributeReading::Number),
    ("y", "y", AttributeReading::Number),
];

/// The tree of an XML text.
pub(super) fn tree(text: &str, lines: &LineStarts) -> Result<FileNode, FileFault> {
    let root = root(text, lines)?;
    check_name(&root.name, root.at, lines)?;
    XmlDoor { lines }.behaviour(&root)
}

/// Checks that a text may be a program by its first element; nothing inside of it is looked at.
pub(super) fn check_root(text: &str, lines: &LineStarts) -> Result<(), FileFault> {
    match first_name(text) {
        Some((at, name)) => check_name(&name, at, lines),
        None => Ok(()),
    }
}

fn check_name(name: &str, at: usize, lines: &LineStarts) -> Result<(), FileFault> {
    if name == "behaviour" {
        return Ok(());
    }
    let name: String = name.chars().filter(|c| !c.is_control()).take(NAME_SHOWN_CHARS).collect();
    Err(lines
        .fault(at, phrase!("file.this_is_no_program_but", "This is no program but <{name}>. Choose another file.")))
}

type XmlEntry = (String, FileNode);

struct XmlDoor<'l, 't> {
    lines: &'l LineStarts<'t>,
}

impl XmlDoor<'_, '_> {
    fn behaviour(&self, root: &XmlElement) -> Result<FileNode, FileFault> {
        let mut fields = self.attributes(root, BEHAVIOUR)?;
        for (name, node) in fields.iter_mut().filter(|(name, _)| name == "format") {
            if node.value().as_text() != Some(VERSION) {
                let reason = phrase!(
                    "file.this_file_has_another",
                    "This file has another {name} than {VERSION}. Export it again with this rrp.",
                    name = &*name
                );
                return Err(self.lines.fault(node.at, reason));
            }
            *node = FileNode::text(node.at, FORMAT);
        }
        frame(&mut fields);
        let mut order = Vec::new();
        for section in self.children(root)? {
            let field = match section.name.as_str() {
                "tags" => self.list(section, |child| self.named(child, "tag"))?,
                "helpers" => self.list(section, |child| self.helper(child))?,
                "streams" => self.list(section, |child| self.stream(child, &mut order))?,
                "connectors" => self.list(section, |child| self.connector(child, &mut order))?,
                "notes" => self.list(section, |child| self.note(child))?,
                "groups" => self.list(section, |child| self.group(child))?,
                "pad" => self.list(section, |child| self.tile(child))?,
                "layout" => self.layout(section)?,
                _ => {
                    let known = "tags, helpers, streams, connectors, notes, groups, pad, layout";
                    return Err(self.unknown(section, known));
                }
            };
            fields.push((section.name.clone(), field));
        }
        if !order.is_empty() {
            fields.push(("order".to_owned(), FileNode::object(root.at, order)));
        }
        Ok(FileNode::object(root.at, fields))
    }

    fn list(
        &self,
        section: &XmlElement,
        mut read: impl FnMut(&XmlElement) -> Result<FileNode, FileFault>,
    ) -> Result<FileNode, FileFault> {
        self.attributes(section, &[])?;
        let items = self.children(section)?.iter().map(&mut read).collect::<Result<_, _>>()?;
        Ok(FileNode::array(section.at, items))
    }

    fn helper(&self, element: &XmlElement) -> Result<FileNode, FileFault> {
        self.check_name(element, "helper")?;
        let mut fields = self.attributes(element, HELPER)?;
        fields.push(("body".to_owned(), self.text(element)?));
        Ok(FileNode::object(element.at, fields))
    }

    fn stream(&self, element: &XmlElement, order: &mut Vec<XmlEntry>) -> Result<FileNode, FileFault> {
        let kind = match element.name.as_str() {
            kind @ ("sensor" | "actuator") => kind,
            "stream" => "ordinary",
            _ => return Err(self.unknown(element, "sensor, stream, actuator")),
        };
        let mut fields = self.attributes(element, STREAM)?;
        fields.push(("kind".to_owned(), FileNode::text(element.at, kind)));
        let mut params = Vec::new();
        for child in self.children(element)? {
            match child.name.as_str() {
                "param" => params.push(self.param(child)?),
                "resources" => {
                    let names = self.list(child, |child| self.named(child, "resource"))?;
                    fields.push(("resources".to_owned(), names));
                }
                _ => return Err(self.unknown(child, "param, resources")),
            }
        }
        if !params.is_empty() {
            fields.push(("params".to_owned(), FileNode::object(element.at, params)));
        }
        take_order(&mut fields, order);
        Ok(FileNode::object(element.at, fields))
    }

    /// `value` is a text; anything else is written as `json`.
    fn param(&self, element: &XmlElement) -> Result<XmlEntry, FileFault> {
        const PARAM: &[KnownAttribute] = &[
            ("name", "name", AttributeReading::Text),
            ("value", "value", AttributeReading::Text),
            ("json", "json", AttributeReading::Text),
        ];
        self.children_none(element)?;
        let fields = self.attributes(element, PARAM)?;
        let get = |name: &str| fields.iter().find(|(known, _)| known == name).map(|(_, node)| node);
        let name = get("name").and_then(|node| node.value().as_text().map(str::to_owned));
        let name = name.ok_or_else(|| self.lines.fault(element.at, "A param needs a name. Add name=\"…\"."))?;
        let node = match (get("value"), get("json")) {
            (Some(value), None) => FileNode { at: value.at, what: NodeKind::Plain(value.value()) },
            (None, Some(json)) => self.json(json)?,
            _ => return Err(self.lines.fault(element.at, "A param has either a value or a json. Write one of them.")),
        };
        Ok((name, node))
    }

    /// A tree of JSON inside the attribute, all of it at the attribute's place.
    fn json(&self, json: &FileNode) -> Result<FileNode, FileFault> {
        let text = json.value();
        let text = text.as_text().unwrap_or_default();
        let lines = LineStarts::of(text);
        let tree = super::json::tree(text, &lines).map_err(|fault| self.lines.fault(json.at, fault.reason))?;
        Ok(moved(tree, json.at))
    }

    /// An element that is a name and nothing else.
    fn named(&self, element: &XmlElement, called: &str) -> Result<FileNode, FileFault> {
        self.check_name(element, called)?;
        self.children_none(element)?;
        let fields = self.attributes(element, &[("name", "name", AttributeReading::Text)])?;
        let name = fields.into_iter().next().map(|(_, node)| node);
        name.ok_or_else(|| self.lines.fault(element.at, format!("A {called} needs a name. Add name=\"…\".")))
    }

    fn connector(&self, element: &XmlElement, order: &mut Vec<XmlEntry>) -> Result<FileNode, FileFault> {
        let mut fields = self.attributes(element, CONNECTOR)?;
        if let Some((_, start)) = fields.iter_mut().find(|(name, _)| name == "start") {
            *start = self.json(start)?;
        }
        fields.push(("type".to_owned(), FileNode::text(element.at, &element.name)));
        let mut inputs = Vec::new();
        for child in self.children(element)? {
            match child.name.as_str() {
                "from" => inputs.push(self.from(child)?),
                "body" => {
                    fields.extend(self.attributes(child, &[("args", "args", AttributeReading::Names)])?);
                    fields.push(("body".to_owned(), self.text(child)?));
                }
                _ => return Err(self.unknown(child, "from, body")),
            }
        }
        fields.push(("inputs".to_owned(), FileNode::array(element.at, inputs)));
        take_order(&mut fields, order);
        Ok(FileNode::object(element.at, fields))
    }

    fn from(&self, element: &XmlElement) -> Result<FileNode, FileFault> {
        self.children_none(element)?;
        let fields = self.attributes(element, &[("stream", "stream", AttributeReading::Text)])?;
        let stream = fields.into_iter().next().map(|(_, node)| node);
        stream.ok_or_else(|| self.lines.fault(element.at, "A from needs a stream. Add stream=\"…\"."))
    }

    fn note(&self, element: &XmlElement) -> Result<FileNode, FileFault> {
        self.check_name(element, "note")?;
        let mut fields = self.attributes(element, NOTE)?;
        fields.push(("text".to_owned(), self.text(element)?));
        Ok(FileNode::object(element.at, fields))
    }

    fn group(&self, element: &XmlElement) -> Result<FileNode, FileFault> {
        self.check_name(element, "group")?;
        self.children_none(element)?;
        Ok(FileNode::object(element.at, self.attributes(element, GROUP)?))
    }

    fn tile(&self, element: &XmlElement) -> Result<FileNode, FileFault> {
        self.check_name(element, "tile")?;
        let mut fields = self.attributes(element, TILE)?;
        if let Some((_, value)) = fields.iter_mut().find(|(name, _)| name == "value") {
            *value = self.json(value)?;
        }
        let params: Vec<XmlEntry> = self
            .children(element)?
            .iter()
            .map(|child| {
                self.check_name(child, "param")?;
                self.param(child)
            })
            .collect::<Result<_, _>>()?;
        if !params.is_empty() {
            fields.push(("params".to_owned(), FileNode::object(element.at, params)));
        }
        Ok(FileNode::object(element.at, fields))
    }

    fn layout(&self, section: &XmlElement) -> Result<FileNode, FileFault> {
        self.attributes(section, &[])?;
        let mut places = Vec::new();
        for child in self.children(section)? {
            self.check_name(child, "at")?;
            self.children_none(child)?;
            let mut fields = self.attributes(child, AT)?;
            let at = fields.iter().position(|(name, _)| name == "ref");
            let at = at.ok_or_else(|| self.lines.fault(child.at, "An at needs a ref. Add ref=\"…\"."))?;
            let (_, name) = fields.remove(at);
            places.push((name.value().as_text().unwrap_or_default().to_owned(), FileNode::object(child.at, fields)));
        }
        Ok(FileNode::object(section.at, places))
    }

    fn attributes(&self, element: &XmlElement, known: &[KnownAttribute]) -> Result<Vec<XmlEntry>, FileFault> {
        let mut fields = Vec::new();
        for (name, at, text) in &element.attributes {
            let Some((_, field, how)) = known.iter().find(|(known, ..)| known == name) else {
                let known: Vec<_> = known.iter().map(|(name, ..)| *name).collect();
                let may =
                    if known.is_empty() { phrase!("file.nothing", "nothing") } else { Phrase::text(known.join(", ")) };
                let within = &element.name;
                let reason = phrase!(
                    "file.is_not_known_here_within",
                    "“{name}” is not known here; <{within}> has {may}. Leave it out."
                );
                return Err(self.lines.fault(*at, reason));
            };
            let node = read(*how, text, *at).map_err(|why| self.lines.fault(*at, why.phrase()))?;
            fields.push(((*field).to_owned(), node));
        }
        Ok(fields)
    }

    /// The elements in an element that has no text of its own.
    fn children<'e>(&self, element: &'e XmlElement) -> Result<&'e [XmlElement], FileFault> {
        match element.loose_text_at() {
            None => Ok(&element.children),
            Some(at) => Err(self.lines.fault(
                at,
                phrase!("file.holds_no_text", "<{name}> holds no text of its own. Take it out.", name = element.name),
            )),
        }
    }

    fn children_none(&self, element: &XmlElement) -> Result<(), FileFault> {
        match self.children(element)?.first() {
            None => Ok(()),
            Some(child) => Err(self.unknown(child, "nothing")),
        }
    }

    /// The text in an element that has nothing else.
    fn text(&self, element: &XmlElement) -> Result<FileNode, FileFault> {
        match element.children.first() {
            None => Ok(FileNode::text(element.text_at, &element.text)),
            Some(child) => Err(self.unknown(child, "text")),
        }
    }

    fn check_name(&self, element: &XmlElement, name: &str) -> Result<(), FileFault> {
        if element.name == name { Ok(()) } else { Err(self.unknown(element, name)) }
    }

    fn unknown(&self, element: &XmlElement, known: &str) -> FileFault {
        let reason = phrase!(
            "file.is_not_known_here_only",
            "<{name}> is not known here, only {known}. Take it out.",
            name = element.name
        );
        self.lines.fault(element.at, reason)
    }
}

/// A number as people write it, where only one can be meant: 0,5.
fn measured(text: &str) -> Option<Value> {
    behaviour::typed_number(text)?.one().map(Value::Float)
}

fn read(how: AttributeReading, text: &str, at: usize) -> Result<FileNode, NoNumber> {
    let plain = |value| FileNode { at, what: NodeKind::Plain(value) };
    match how {
        AttributeReading::Text => Ok(FileNode::text(at, text)),
        AttributeReading::Number => number(text).or_else(|no| measured(text).ok_or(no)).map(plain),
        AttributeReading::Millis => match text.strip_suffix("ms").map(number) {
            Some(Ok(value @ Value::Int(_))) => Ok(plain(value)),
            _ => Err(NoNumber::NoMillis),
        },
        AttributeReading::Truth => match text {
            "true" => Ok(plain(Value::Bool(true))),
            "false" => Ok(plain(Value::Bool(false))),
            _ => Ok(FileNode::text(at, text)),
        },
        AttributeReading::Names => {
            let names = text.split(' ').filter(|name| !name.is_empty());
            Ok(FileNode::array(at, names.map(|name| FileNode::text(at, name)).collect()))
        }
    }
}

/// `frame="50ms"` is the engine.
fn frame(fields: &mut Vec<XmlEntry>) {
    if let Some(at) = fields.iter().position(|(name, _)| name == "frame") {
        let (_, frame) = fields.remove(at);
        let at = frame.at;
        let frame = FileNode::object(at, vec![("frameMs".to_owned(), frame)]);
        fields.push(("engine".to_owned(), FileNode::object(at, vec![("frame".to_owned(), frame)])));
    }
}

/// Moves the order of one thing to where the behaviour has it.
fn take_order(fields: &mut Vec<XmlEntry>, order: &mut Vec<XmlEntry>) {
    let Some(at) = fields.iter().position(|(name, _)| name == "order") else { return };
    let (_, number) = fields.remove(at);
    let id = fields.iter().find(|(name, _)| name == "id").and_then(|(_, id)| id.value().as_text().map(str::to_owned));
    if let Some(id) = id {
        order.push((id, number));
    }
}

fn moved(node: FileNode, at: usize) -> FileNode {
    let what = match node.what {
        NodeKind::Plain(value) => NodeKind::Plain(value),
        NodeKind::Array(items) => NodeKind::Array(items.into_iter().map(|item| moved(item, at)).collect()),
        NodeKind::Object(fields) => {
            NodeKind::Object(fields.into_iter().map(|(name, field)| (name, moved(field, at))).collect())
        }
    };
    FileNode { at, what }
}
