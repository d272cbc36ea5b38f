//! XML into the same tree as JSON: which element and attribute is which field.

mod element;
mod escape;
pub(super) mod write;

use super::FileFault;
use super::json::number;
use super::place::Lines;
use super::tree::{NoNumber, Node, What};
use behaviour::{FORMAT, Value};
pub(super) use element::first_name;
use element::{Element, root};
#[cfg(test)]
pub(super) use escape::reference;
pub(super) use escape::{cannot_hold, in_element};

/// The most characters that are told of the name of an unknown element.
const NAME_SHOWN_CHARS: usize = 40;
/// The version of the XML form.
const VERSION: &str = "1";

/// The ways to read the text of an attribute.
#[derive(Clone, Copy)]
enum How {
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
type Known = (&'static str, &'static str, How);

const BEHAVIOUR: &[Known] = &[
    ("format", "format", How::Text),
    ("id", "id", How::Text),
    ("name", "name", How::Text),
    ("robot", "robot", How::Text),
    ("engine", "engine", How::Text),
    ("frame", "frame", How::Millis),
    ("exercise", "exercise", How::Text),
];
const HELPER: &[Known] = &[
    ("id", "name", How::Text),
    ("args", "params", How::Names),
    ("says", "says", How::Text),
    ("takes", "takes", How::Names),
    ("gives", "gives", How::Text),
];
const STREAM: &[Known] = &[
    ("id", "id", How::Text),
    ("name", "name", How::Text),
    ("device", "device", How::Text),
    ("priority", "priority", How::Number),
    ("hold", "holdMs", How::Millis),
    ("order", "order", How::Number),
];
const CONNECTOR: &[Known] = &[
    ("id", "id", How::Text),
    ("to", "output", How::Text),
    ("helper", "helper", How::Text),
    ("period", "periodMs", How::Millis),
    ("start", "start", How::Text),
    ("order", "order", How::Number),
];
const NOTE: &[Known] = &[("id", "id", How::Text), ("by", "by", How::Text), ("at", "at", How::Number)];
const GROUP: &[Known] = &[
    ("id", "id", How::Text),
    ("title", "title", How::Text),
    ("streams", "streams", How::Names),
    ("folded", "folded", How::Truth),
];
const TILE: &[Known] = &[
    ("key", "key", How::Number),
    ("label", "label", How::Text),
    ("device", "device", How::Text),
    ("stream", "stream", How::Text),
    ("value", "value", How::Text),
    ("word", "word", How::Text),
    ("span", "span", How::Truth),
];
const AT: &[Known] = &[("ref", "ref", How::Text), ("x", "x", How::Number), ("y", "y", How::Number)];

/// The tree of an XML text.
pub(super) fn tree(text: &str, lines: &Lines) -> Result<Node, FileFault> {
    let root = root(text, lines)?;
    check_name(&root.name, root.at, lines)?;
    Door { lines }.behaviour(&root)
}

/// Checks that a text may be a program by its first element; nothing inside of it is looked at.
pub(super) fn check_root(text: &str, lines: &Lines) -> Result<(), FileFault> {
    match first_name(text) {
        Some((at, name)) => check_name(&name, at, lines),
        None => Ok(()),
    }
}

fn check_name(name: &str, at: usize, lines: &Lines) -> Result<(), FileFault> {
    if name == "behaviour" {
        return Ok(());
    }
    let name: String = name.chars().filter(|c| !c.is_control()).take(NAME_SHOWN_CHARS).collect();
    Err(lines.fault(at, format!("This is no program but <{name}>. Choose another file.")))
}

type Entry = (String, Node);

struct Door<'l, 't> {
    lines: &'l Lines<'t>,
}

impl Door<'_, '_> {
    fn behaviour(&self, root: &Element) -> Result<Node, FileFault> {
        let mut fields = self.attributes(root, BEHAVIOUR)?;
        for (name, node) in fields.iter_mut().filter(|(name, _)| name == "format") {
            if node.value().as_text() != Some(VERSION) {
                let reason = format!("This file has another {name} than {VERSION}. Export it again with this rrp.");
                return Err(self.lines.fault(node.at, reason));
            }
            *node = Node::text(node.at, FORMAT);
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
            fields.push(("order".to_owned(), Node::object(root.at, order)));
        }
        Ok(Node::object(root.at, fields))
    }

    fn list(
        &self,
        section: &Element,
        mut read: impl FnMut(&Element) -> Result<Node, FileFault>,
    ) -> Result<Node, FileFault> {
        self.attributes(section, &[])?;
        let items = self.children(section)?.iter().map(&mut read).collect::<Result<_, _>>()?;
        Ok(Node::array(section.at, items))
    }

    fn helper(&self, element: &Element) -> Result<Node, FileFault> {
        self.check_name(element, "helper")?;
        let mut fields = self.attributes(element, HELPER)?;
        fields.push(("body".to_owned(), self.text(element)?));
        Ok(Node::object(element.at, fields))
    }

    fn stream(&self, element: &Element, order: &mut Vec<Entry>) -> Result<Node, FileFault> {
        let kind = match element.name.as_str() {
            kind @ ("sensor" | "actuator") => kind,
            "stream" => "ordinary",
            _ => return Err(self.unknown(element, "sensor, stream, actuator")),
        };
        let mut fields = self.attributes(element, STREAM)?;
        fields.push(("kind".to_owned(), Node::text(element.at, kind)));
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
            fields.push(("params".to_owned(), Node::object(element.at, params)));
        }
        take_order(&mut fields, order);
        Ok(Node::object(element.at, fields))
    }

    /// `value` is a text; anything else is written as `json`.
    fn param(&self, element: &Element) -> Result<Entry, FileFault> {
        const PARAM: &[Known] =
            &[("name", "name", How::Text), ("value", "value", How::Text), ("json", "json", How::Text)];
        self.children_none(element)?;
        let fields = self.attributes(element, PARAM)?;
        let get = |name: &str| fields.iter().find(|(known, _)| known == name).map(|(_, node)| node);
        let name = get("name").and_then(|node| node.value().as_text().map(str::to_owned));
        let name = name.ok_or_else(|| self.lines.fault(element.at, "A param needs a name. Add name=\"…\"."))?;
        let node = match (get("value"), get("json")) {
            (Some(value), None) => Node { at: value.at, what: What::Plain(value.value()) },
            (None, Some(json)) => self.json(json)?,
            _ => return Err(self.lines.fault(element.at, "A param has either a value or a json. Write one of them.")),
        };
        Ok((name, node))
    }

    /// A tree of JSON inside the attribute, all of it at the attribute's place.
    fn json(&self, json: &Node) -> Result<Node, FileFault> {
        let text = json.value();
        let text = text.as_text().unwrap_or_default();
        let lines = Lines::of(text);
        let tree = super::json::tree(text, &lines).map_err(|fault| self.lines.fault(json.at, fault.reason))?;
        Ok(moved(tree, json.at))
    }

    /// An element that is a name and nothing else.
    fn named(&self, element: &Element, called: &str) -> Result<Node, FileFault> {
        self.check_name(element, called)?;
        self.children_none(element)?;
        let fields = self.attributes(element, &[("name", "name", How::Text)])?;
        let name = fields.into_iter().next().map(|(_, node)| node);
        name.ok_or_else(|| self.lines.fault(element.at, format!("A {called} needs a name. Add name=\"…\".")))
    }

    fn connector(&self, element: &Element, order: &mut Vec<Entry>) -> Result<Node, FileFault> {
        let mut fields = self.attributes(element, CONNECTOR)?;
        if let Some((_, start)) = fields.iter_mut().find(|(name, _)| name == "start") {
            *start = self.json(start)?;
        }
        fields.push(("type".to_owned(), Node::text(element.at, &element.name)));
        let mut inputs = Vec::new();
        for child in self.children(element)? {
            match child.name.as_str() {
                "from" => inputs.push(self.from(child)?),
                "body" => {
                    fields.extend(self.attributes(child, &[("args", "args", How::Names)])?);
                    fields.push(("body".to_owned(), self.text(child)?));
                }
                _ => return Err(self.unknown(child, "from, body")),
            }
        }
        fields.push(("inputs".to_owned(), Node::array(element.at, inputs)));
        take_order(&mut fields, order);
        Ok(Node::object(element.at, fields))
    }

    fn from(&self, element: &Element) -> Result<Node, FileFault> {
        self.children_none(element)?;
        let fields = self.attributes(element, &[("stream", "stream", How::Text)])?;
        let stream = fields.into_iter().next().map(|(_, node)| node);
        stream.ok_or_else(|| self.lines.fault(element.at, "A from needs a stream. Add stream=\"…\"."))
    }

    fn note(&self, element: &Element) -> Result<Node, FileFault> {
        self.check_name(element, "note")?;
        let mut fields = self.attributes(element, NOTE)?;
        fields.push(("text".to_owned(), self.text(element)?));
        Ok(Node::object(element.at, fields))
    }

    fn group(&self, element: &Element) -> Result<Node, FileFault> {
        self.check_name(element, "group")?;
        self.children_none(element)?;
        Ok(Node::object(element.at, self.attributes(element, GROUP)?))
    }

    fn tile(&self, element: &Element) -> Result<Node, FileFault> {
        self.check_name(element, "tile")?;
        let mut fields = self.attributes(element, TILE)?;
        if let Some((_, value)) = fields.iter_mut().find(|(name, _)| name == "value") {
            *value = self.json(value)?;
        }
        let params: Vec<Entry> = self
            .children(element)?
            .iter()
            .map(|child| {
                self.check_name(child, "param")?;
                self.param(child)
            })
            .collect::<Result<_, _>>()?;
        if !params.is_empty() {
            fields.push(("params".to_owned(), Node::object(element.at, params)));
        }
        Ok(Node::object(element.at, fields))
    }

    fn layout(&self, section: &Element) -> Result<Node, FileFault> {
        self.attributes(section, &[])?;
        let mut places = Vec::new();
        for child in self.children(section)? {
            self.check_name(child, "at")?;
            self.children_none(child)?;
            let mut fields = self.attributes(child, AT)?;
            let at = fields.iter().position(|(name, _)| name == "ref");
            let at = at.ok_or_else(|| self.lines.fault(child.at, "An at needs a ref. Add ref=\"…\"."))?;
            let (_, name) = fields.remove(at);
            places.push((name.value().as_text().unwrap_or_default().to_owned(), Node::object(child.at, fields)));
        }
        Ok(Node::object(section.at, places))
    }

    fn attributes(&self, element: &Element, known: &[Known]) -> Result<Vec<Entry>, FileFault> {
        let mut fields = Vec::new();
        for (name, at, text) in &element.attributes {
            let Some((_, field, how)) = known.iter().find(|(known, ..)| known == name) else {
                let known: Vec<_> = known.iter().map(|(name, ..)| *name).collect();
                let may = if known.is_empty() { "nothing".to_owned() } else { known.join(", ") };
                let reason = format!("“{name}” is not known here; <{}> has {may}. Leave it out.", element.name);
                return Err(self.lines.fault(*at, reason));
            };
            let node = read(*how, text, *at).map_err(|why| self.lines.fault(*at, why.to_string()))?;
            fields.push(((*field).to_owned(), node));
        }
        Ok(fields)
    }

    /// The elements in an element that has no text of its own.
    fn children<'e>(&self, element: &'e Element) -> Result<&'e [Element], FileFault> {
        match element.loose_text_at() {
            None => Ok(&element.children),
            Some(at) => Err(self.lines.fault(at, format!("<{}> holds no text of its own. Take it out.", element.name))),
        }
    }

    fn children_none(&self, element: &Element) -> Result<(), FileFault> {
        match self.children(element)?.first() {
            None => Ok(()),
            Some(child) => Err(self.unknown(child, "nothing")),
        }
    }

    /// The text in an element that has nothing else.
    fn text(&self, element: &Element) -> Result<Node, FileFault> {
        match element.children.first() {
            None => Ok(Node::text(element.text_at, &element.text)),
            Some(child) => Err(self.unknown(child, "text")),
        }
    }

    fn check_name(&self, element: &Element, name: &str) -> Result<(), FileFault> {
        if element.name == name { Ok(()) } else { Err(self.unknown(element, name)) }
    }

    fn unknown(&self, element: &Element, known: &str) -> FileFault {
        let reason = format!("<{}> is not known here, only {known}. Take it out.", element.name);
        self.lines.fault(element.at, reason)
    }
}

/// A number as people write it, where only one can be meant: 0,5.
fn measured(text: &str) -> Option<Value> {
    behaviour::typed_number(text)?.one().map(Value::Float)
}

fn read(how: How, text: &str, at: usize) -> Result<Node, NoNumber> {
    let plain = |value| Node { at, what: What::Plain(value) };
    match how {
        How::Text => Ok(Node::text(at, text)),
        How::Number => number(text).or_else(|no| measured(text).ok_or(no)).map(plain),
        How::Millis => match text.strip_suffix("ms").map(number) {
            Some(Ok(value @ Value::Int(_))) => Ok(plain(value)),
            _ => Err(NoNumber::NoMillis),
        },
        How::Truth => match text {
            "true" => Ok(plain(Value::Bool(true))),
            "false" => Ok(plain(Value::Bool(false))),
            _ => Ok(Node::text(at, text)),
        },
        How::Names => {
            let names = text.split(' ').filter(|name| !name.is_empty());
            Ok(Node::array(at, names.map(|name| Node::text(at, name)).collect()))
        }
    }
}

/// `frame="50ms"` is the engine.
fn frame(fields: &mut Vec<Entry>) {
    if let Some(at) = fields.iter().position(|(name, _)| name == "frame") {
        let (_, frame) = fields.remove(at);
        let at = frame.at;
        let frame = Node::object(at, vec![("frameMs".to_owned(), frame)]);
        fields.push(("engine".to_owned(), Node::object(at, vec![("frame".to_owned(), frame)])));
    }
}

/// Moves the order of one thing to where the behaviour has it.
fn take_order(fields: &mut Vec<Entry>, order: &mut Vec<Entry>) {
    let Some(at) = fields.iter().position(|(name, _)| name == "order") else { return };
    let (_, number) = fields.remove(at);
    let id = fields.iter().find(|(name, _)| name == "id").and_then(|(_, id)| id.value().as_text().map(str::to_owned));
    if let Some(id) = id {
        order.push((id, number));
    }
}

fn moved(node: Node, at: usize) -> Node {
    let what = match node.what {
        What::Plain(value) => What::Plain(value),
        What::Array(items) => What::Array(items.into_iter().map(|item| moved(item, at)).collect()),
        What::Object(fields) => {
            What::Object(fields.into_iter().map(|(name, field)| (name, moved(field, at))).collect())
        }
    };
    Node { at, what }
}
