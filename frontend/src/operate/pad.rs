//! The nine tiles: those of the program's pad, else the usual ones of what is in it.

use crate::parts::DeskHold;
use behaviour::{Behaviour, Id, Params, TileAction, Value};
use leptos::prelude::*;
use protocol::Press;

/// A tile.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PadTile {
    /// The key of the tile, 1 to 9.
    pub(super) key: usize,
    pub(super) label: String,
    /// The name of its picture.
    pub(super) icon: &'static str,
    pub(super) does: TileWork,
    /// True if a press asks first.
    pub(super) asks: bool,
}

/// The work of a tile.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum TileWork {
    /// Has the robot do an action by hand.
    Hand { device: String, params: Params, value: Value },
    /// Lets a sense give a value, as if the robot had sensed it.
    Pretend { stream: Id, value: Value },
    /// Marks with a word: a moment, or a span that another press ends.
    Word { word: String, span: bool },
}

impl TileWork {
    /// True if this press is one of this tile.
    pub(super) fn is_of(&self, press: &Press) -> bool {
        match self {
            Self::Hand { device, params, value } => {
                !press.pretended && device == press.what.as_str() && (params, value) == (&press.params, &press.value)
            }
            Self::Pretend { stream, value } => press.pretended && (stream, value) == (&press.what, &press.value),
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
pub(super) fn pad(desk: DeskHold) -> Memo<Vec<PadTile>> {
    Memo::new(move |_| {
        let document = &desk.desk().document;
        document.edited.track();
        document.open.track();
        tiles(&document.behaviour())
    })
}

/// The tiles of a program: its own, in their own words, or the usual ones. Pure.
fn tiles(behaviour: &Behaviour) -> Vec<PadTile> {
    let tile = |(key, tile): (u8, behaviour::Tile)| {
        let ((icon, _), label) = (crate::desk::shown_pad::pictured(behaviour, &tile.does), tile.label);
        let does = match tile.does {
            TileAction::Hand { device, params, value } => TileWork::Hand { device, params, value },
            TileAction::Pretend { stream, value } => TileWork::Pretend { stream, value },
            TileAction::Word { word, span } => TileWork::Word { word, span },
        };
        PadTile { key: usize::from(key), label, icon, does, asks: tile.asks }
    };
    crate::desk::shown_pad::of(behaviour).tiles.into_iter().map(tile).collect()
}

#[cfg(test)]
mod tests {
    use super::{TileWork, tiles};
    use crate::desk::shown_pad::made::with;
    use behaviour::{Id, Pad, Params, Record, RecordId, StreamKind, Value};
    use protocol::Press;

    #[test]
    fn the_usual_tiles_say_in_words_what_they_do_and_those_of_a_pad_are_its_own() {
        use StreamKind::{Actuator, Sensor};
        let mut behaviour = with(&[
            (Sensor, "HeadTouch", &[]),
            (Actuator, "SayParameter", &[("text", "Hello")]),
            (Actuator, "Animation", &[("animation", "Hey")]),
            (Sensor, "Button", &[("label", "Go on")]),
        ]);
        let usual = tiles(&behaviour);
        let labels: Vec<&str> = usual.iter().map(|tile| tile.label.as_str()).collect();
        assert_eq!(labels[..3], ["Go on", "“Hello”", "Waving"]);
        assert!(labels.len() > 3 && labels[3..].iter().all(|label| label.starts_with("As if: ")), "{labels:?}");
        let looks: Vec<&str> = usual.iter().map(|tile| tile.does.look()).collect();
        assert_eq!(looks[..4], ["sensor", "actuator", "actuator", "sensor"]);
        let own = r#"{"4":{"label":"laughs","does":{"word":{"word":"laughs","span":true}}}}"#;
        let own: Pad = serde_json::from_str(own).unwrap();
        behaviour.records.insert(RecordId::pad(), Record::Pad(own));
        let own = tiles(&behaviour);
        assert_eq!((own.len(), own[0].key, own[0].label.as_str(), own[0].does.look()), (1, 4, "laughs", "word"));
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
        let button = TileWork::Pretend { stream: Id::new("go").unwrap(), value: Value::Bool(true) };
        assert!(button.is_of(&press("go", true)) && !button.is_of(&press("go", false)));
        assert!(!button.is_of(&press("on", true)));
        let hand = TileWork::Hand { device: "Animation".into(), params: Params::default(), value: Value::Bool(true) };
        assert!(hand.is_of(&press("Animation", false)) && !hand.is_of(&press("Animation", true)));
    }
}
