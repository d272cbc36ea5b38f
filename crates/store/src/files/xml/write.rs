//! A behaviour as XML: the same sections in the same order as in JSON, one thing a line.

use super::escape::{in_attribute, in_element};
use crate::files::FileFault;
use crate::files::json::write::{coordinate, spaced};
use behaviour::{
    BehaviourFile, Engine, FileConnector, FileGroup, FileHelper, FileNote, FileStream, FileTile, StreamKind, Value,
};
use thiserror::Error;

/// The reasons why a behaviour cannot be written as XML.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum NoXml {
    /// It is not a file that could be read again.
    #[error("{}", .0.reason)]
    Unreadable(FileFault),
}

/// The file as XML. What is read from it is the same file, bit for bit, without control characters.
///
/// # Errors
/// If the file is not one that could be read.
pub fn write_xml(file: &BehaviourFile) -> Result<String, NoXml> {
    let json = super::super::json::write::write_json(file);
    let read = super::super::read(json.as_bytes()).map_err(NoXml::Unreadable)?;
    let mut to = XmlPage { text: "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned() };
    to.behaviour(&read);
    Ok(to.text)
}

struct XmlPage {
    text: String,
}

/// A start mark under way.
struct StartTag(String);

impl StartTag {
    fn of(name: &str) -> Self {
        Self(format!("<{name}"))
    }

    fn with(mut self, name: &str, text: &str) -> Self {
        self.0.push_str(&format!(" {name}=\"{}\"", in_attribute(text)));
        self
    }

    fn maybe(self, name: &str, text: Option<String>) -> Self {
        match text {
            Some(text) => self.with(name, &text),
            None => self,
        }
    }
}

impl XmlPage {
    fn line(&mut self, depth: usize, line: &str) {
        self.text.push_str(&"  ".repeat(depth));
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn behaviour(&mut self, file: &BehaviourFile) {
        let (event, frame) = match file.engine {
            None => (None, None),
            Some(Engine::Event) => (Some("event".to_owned()), None),
            Some(Engine::Frame { frame_ms }) => (None, Some(format!("{frame_ms}ms"))),
        };
        let mark = StartTag::of("behaviour").with("format", super::VERSION).maybe("id", file.id.clone());
        let mark = mark.with("name", &file.name).maybe("robot", file.robot.clone());
        self.line(
            0,
            &(mark.maybe("engine", event).maybe("frame", frame).maybe("exercise", file.exercise.clone()).0 + ">"),
        );
        if !file.tags.is_empty() {
            self.section("tags", &file.tags, |tag| vec![StartTag::of("tag").with("name", tag).0 + "/>"]);
        }
        self.section("helpers", &file.helpers, |helper| vec![helper_line(helper)]);
        self.section("streams", &file.streams, |stream| stream_lines(stream, file));
        self.section("connectors", &file.connectors, |connector| vec![connector_line(connector, file)]);
        if !file.notes.is_empty() {
            self.section("notes", &file.notes, |note| vec![note_line(note)]);
        }
        if !file.groups.is_empty() {
            self.section("groups", &file.groups, |group| vec![group_line(group)]);
        }
        if let Some(tiles) = &file.pad {
            self.section("pad", tiles, tile_lines);
        }
        if !file.layout.is_empty() {
            let places: Vec<_> = file.layout.iter().collect();
            self.section("layout", &places, |(id, place)| {
                let mark = StartTag::of("at").with("ref", id).with("x", &coordinate(place.x));
                vec![mark.with("y", &coordinate(place.y)).0 + "/>"]
            });
        }
        self.line(0, "</behaviour>");
    }

    fn section<T>(&mut self, name: &str, items: &[T], lines: impl Fn(&T) -> Vec<String>) {
        if items.is_empty() {
            return self.line(1, &format!("<{name}/>"));
        }
        self.line(1, &format!("<{name}>"));
        for line in items.iter().flat_map(lines) {
            self.line(2, &line);
        }
        self.line(1, &format!("</{name}>"));
    }
}

fn with_text(mark: &StartTag, name: &str, text: &str) -> String {
    format!("{}>{}</{name}>", mark.0, in_element(text))
}

fn note_line(note: &FileNote) -> String {
    let mark = StartTag::of("note").with("id", &note.id).maybe("by", note.by.clone());
    with_text(&mark.maybe("at", note.at.map(|ms| ms.to_string())), "note", &note.text)
}

fn group_line(group: &FileGroup) -> String {
    let mark = StartTag::of("group").with("id", &group.id).with("title", &group.title);
    let mark = mark.with("streams", &group.streams.join(" "));
    mark.maybe("folded", group.folded.map(|folded| folded.to_string())).0 + "/>"
}

fn tile_lines(tile: &FileTile) -> Vec<String> {
    let mark = StartTag::of("tile").with("key", &tile.key.to_string()).with("label", &tile.label);
    let mark = mark.maybe("device", tile.device.clone()).maybe("stream", tile.stream.clone());
    let mark = mark.maybe("value", tile.value.as_ref().map(spaced)).maybe("word", tile.word.clone());
    let mark = mark.maybe("span", tile.span.map(|span| span.to_string()));
    let mark = mark.maybe("asks", tile.asks.map(|asks| asks.to_string()));
    let inside: Vec<String> = tile.params.iter().flatten().map(|(name, value)| param(name, value)).collect();
    around(mark, "tile", inside)
}

/// An element with these lines in it.
fn around(mark: StartTag, name: &str, inside: Vec<String>) -> Vec<String> {
    if inside.is_empty() {
        return vec![mark.0 + "/>"];
    }
    let inside = inside.into_iter().map(|line| format!("  {line}"));
    std::iter::once(mark.0 + ">").chain(inside).chain([format!("</{name}>")]).collect()
}

fn helper_line(helper: &FileHelper) -> String {
    let says = Some(helper.says.clone()).filter(|says| !says.is_empty());
    let mark = StartTag::of("helper").with("id", &helper.name).with("args", &helper.params.join(" "));
    let takes: Vec<_> = helper.takes.iter().map(|one| one.word()).collect();
    let takes = Some(takes.join(" ")).filter(|takes| !takes.is_empty());
    let gives = Some(helper.gives.word().to_owned()).filter(|_| !helper.gives.is_auto());
    with_text(&mark.maybe("says", says).maybe("takes", takes).maybe("gives", gives), "helper", &helper.body)
}

fn order_of(file: &BehaviourFile, id: &str) -> Option<String> {
    file.order.get(id).map(i64::to_string)
}

fn stream_lines(stream: &FileStream, file: &BehaviourFile) -> Vec<String> {
    let word = match stream.kind {
        StreamKind::Sensor => "sensor",
        StreamKind::Ordinary => "stream",
        StreamKind::Actuator => "actuator",
    };
    let mark = StartTag::of(word).with("id", &stream.id).with("name", &stream.name);
    let mark = mark.maybe("device", stream.device.clone()).maybe("priority", stream.priority.map(|p| p.to_string()));
    let mark =
        mark.maybe("hold", stream.hold_ms.map(|ms| format!("{ms}ms"))).maybe("order", order_of(file, &stream.id));
    let mut inside: Vec<String> = stream.params.iter().flatten().map(|(name, value)| param(name, value)).collect();
    inside.extend(stream.resources.as_deref().map(resources));
    around(mark, word, inside)
}

fn param(name: &str, value: &Value) -> String {
    let mark = StartTag::of("param").with("name", name);
    let mark = match value {
        Value::Text(text) => mark.with("value", text),
        other => mark.with("json", &spaced(other)),
    };
    mark.0 + "/>"
}

fn resources(names: &[String]) -> String {
    let inside: String = names.iter().map(|name| StartTag::of("resource").with("name", name).0 + "/>").collect();
    if inside.is_empty() { "<resources/>".to_owned() } else { format!("<resources>{inside}</resources>") }
}

fn connector_line(connector: &FileConnector, file: &BehaviourFile) -> String {
    let word = &connector.operation;
    let mark = StartTag::of(word).with("id", &connector.id).with("to", &connector.output);
    let mark = mark.maybe("helper", connector.helper.clone());
    let mark = mark.maybe("period", connector.period_ms.map(|ms| format!("{ms}ms")));
    let mark = mark.maybe("start", connector.start.as_ref().map(spaced));
    let mark = mark.maybe("order", order_of(file, &connector.id));
    let mut inside: String =
        connector.inputs.iter().map(|id| StartTag::of("from").with("stream", id).0 + "/>").collect();
    if let Some(body) = &connector.body {
        let args = connector.args.as_ref().map(|args| args.join(" "));
        inside.push_str(&with_text(&StartTag::of("body").maybe("args", args), "body", body));
    }
    if inside.is_empty() { mark.0 + "/>" } else { format!("{}>{inside}</{word}>", mark.0) }
}
