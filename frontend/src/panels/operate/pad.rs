//! The nine tiles. Until a program says which: its buttons, then what it says and its gestures, then what its senses may pretend.

use crate::panels::hold::Hold;
use crate::words;
use behaviour::{Id, Params, Stream, StreamKind, Value};
use leptos::prelude::*;
use protocol::Press;
use robot::{Device, ParamKind};

/// As many as there are keys.
pub(super) const TILES_MAX: usize = 9;
/// The actions that have a tile each: both do something of their own that ends by itself.
const BY_HAND: [&str; 2] = ["SayParameter", "Animation"];

/// A tile.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tile {
    pub(super) label: String,
    /// The name of its picture.
    pub(super) icon: &'static str,
    pub(super) does: Does,
}

/// What a tile does.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Does {
    /// Has the robot do an action by hand.
    Hand { device: String, params: Params, value: Value },
    /// Lets a sense give a value, as if the robot had sensed it; `button` is one that there is for that.
    Pretend { stream: Id, value: Value, button: bool },
    /// Marks with a word: a moment, or a span that another press ends.
    Word { word: String, span: bool },
}

impl Does {
    /// True if this press is one of this tile.
    pub(super) fn is_of(&self, press: &Press) -> bool {
        match self {
            Self::Hand { device, params, value } => {
                !press.pretended && device == press.what.as_str() && (params, value) == (&press.params, &press.value)
            }
            Self::Pretend { stream, value, .. } => press.pretended && (stream, value) == (&press.what, &press.value),
            Self::Word { .. } => false,
        }
    }

    /// The look of the tile: as the kind of thing that it is about.
    pub(super) fn look(&self) -> &'static str {
        match self {
            Self::Hand { .. } => "actuator",
            Self::Pretend { .. } => "sensor",
            Self::Word { .. } => "word",
        }
    }
}

/// The tiles of the open program, renewed as it changes.
pub(super) fn pad(desk: Hold) -> Memo<Vec<Tile>> {
    Memo::new(move |_| {
        let document = &desk.desk().document;
        let ids = document.stream_ids.get();
        let streams: Vec<(Id, Stream)> =
            ids.into_iter().filter_map(|id| Some((id.clone(), document.stream(&id)?.record.get()))).collect();
        of_graph(&streams)
    })
}

/// The tiles of a program that says none itself. Pure.
pub(super) fn of_graph(streams: &[(Id, Stream)]) -> Vec<Tile> {
    let known = |(id, stream): &(Id, Stream)| {
        let device = robot::device(stream.kind, stream.device.as_deref()?).ok()?;
        Some((id.clone(), stream.clone(), device))
    };
    let known: Vec<(Id, Stream, &'static Device)> = streams.iter().filter_map(known).collect();
    let buttons = known.iter().filter_map(|(id, stream, device)| {
        let label = device.button_words(&stream.params)?.into_owned();
        let does = Does::Pretend { stream: id.clone(), value: Value::Bool(true), button: true };
        Some(Tile { label: words::translated(&label), icon: device.icon, does })
    });
    let by_hand = known
        .iter()
        .filter(|(_, stream, device)| stream.kind == StreamKind::Actuator && BY_HAND.contains(&device.name));
    let by_hand = by_hand.map(|(_, stream, device)| {
        let does =
            Does::Hand { device: device.name.to_owned(), params: stream.params.clone(), value: Value::Bool(true) };
        Tile { label: by_hand_words(device, &stream.params), icon: device.icon, does }
    });
    let pretends = known.iter().filter(|(_, _, device)| device.button.is_none()).flat_map(|(id, _, device)| {
        device.pretend.iter().filter_map(|pretend| {
            let value = crate::json::read(pretend.value).ok()?;
            let does = Does::Pretend { stream: id.clone(), value, button: false };
            Some(Tile { label: words::as_if_there_is(words::label_of(pretend.says)), icon: device.icon, does })
        })
    });
    let mut tiles: Vec<Tile> = Vec::new();
    for tile in buttons.chain(by_hand).chain(pretends) {
        if tiles.len() < TILES_MAX && tiles.iter().all(|known| known.does != tile.does) {
            tiles.push(tile);
        }
    }
    tiles
}

/// What an action does by hand, in the words of its settings: “Hello”, or waving.
fn by_hand_words(device: &Device, params: &Params) -> String {
    let chosen = |name: &str, default: &Value| params.get(name).unwrap_or(default).as_text().map(str::to_owned);
    let mut words = device.params.iter().filter_map(|param| {
        let chosen = chosen(param.name, &param.default())?;
        match param.kind {
            ParamKind::Choice(choices) => {
                // What stands for something else has its name in the next setting.
                let (_, label) = choices.iter().find(|(word, _)| *word == chosen && *word != "robot")?;
                Some(words::capitalised(words::label_of(label)))
            }
            _ => Some(chosen).filter(|text| !text.is_empty()).map(|text| words::saying(&text)),
        }
    });
    words.next().unwrap_or_else(|| words::label_of(device.label).to_owned())
}

#[cfg(test)]
mod tests {
    use super::{Does, TILES_MAX, of_graph};
    use behaviour::{Id, Params, Stream, StreamKind, Value};
    use protocol::Press;

    fn stream(id: &str, kind: StreamKind, device: &str, params: &[(&str, &str)]) -> (Id, Stream) {
        let params = params.iter().map(|&(name, value)| (name.to_owned(), Value::text(value))).collect();
        let stream = Stream { kind, name: id.to_owned(), device: Some(device.to_owned()), params, ..Stream::default() };
        (Id::new(id).unwrap(), stream)
    }

    #[test]
    fn buttons_come_first_then_what_is_done_by_hand_then_what_is_pretended() {
        let (sense, acts) = (StreamKind::Sensor, StreamKind::Actuator);
        let tiles = of_graph(&[
            stream("ball", sense, "RedBall", &[]),
            stream("hello", acts, "SayParameter", &[("text", "Hello")]),
            stream("again", acts, "SayParameter", &[("text", "Hello")]),
            stream("wave", acts, "Animation", &[("animation", "Hey")]),
            stream("track", acts, "Tracker", &[]),
            stream("go", sense, "Button", &[("label", "Go on")]),
        ]);
        let labels: Vec<&str> = tiles.iter().map(|tile| tile.label.as_str()).collect();
        assert_eq!(labels[..3], ["Go on", "“Hello”", "Waving"], "the same is there once");
        assert!(labels.len() > 3 && labels[3..].iter().all(|label| label.starts_with("As if: ")), "{labels:?}");
        let looks: Vec<&str> = tiles.iter().map(|tile| tile.does.look()).collect();
        assert_eq!(looks[..4], ["sensor", "actuator", "actuator", "sensor"]);
        let many: Vec<_> = (0..20).map(|at| stream(&format!("b{at}"), sense, "Button", &[])).collect();
        assert_eq!(of_graph(&many).len(), TILES_MAX);
    }

    #[test]
    fn a_press_is_of_the_tile_that_does_the_very_same() {
        let press = |what: &str, pretended: bool| Press {
            robot: None,
            client: Id::new("c").unwrap(),
            by: "Aiko".into(),
            what: Id::new(what).unwrap(),
            pretended,
            params: Params::default(),
            value: Value::Bool(true),
            why: None,
        };
        let button = Does::Pretend { stream: Id::new("go").unwrap(), value: Value::Bool(true), button: true };
        assert!(button.is_of(&press("go", true)) && !button.is_of(&press("go", false)));
        assert!(!button.is_of(&press("on", true)));
        let hand = Does::Hand { device: "Animation".into(), params: Params::default(), value: Value::Bool(true) };
        assert!(hand.is_of(&press("Animation", false)) && !hand.is_of(&press("Animation", true)));
    }
}
