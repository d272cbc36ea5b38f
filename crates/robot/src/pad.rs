//! The pad that people are shown while nobody made one.

use crate::devices::DONE_BY_HAND;
use crate::{Device, Param, ParamKind, device};
use behaviour::{
    Behaviour, FillFrom, Id, Pad, Params, Stream, StreamKind, TILE_KEYS, TILE_MAX_CHARS, Tile, TileAction, Value,
};
use phrase::{Phrase, Phrased};

/// Says the words on a tile that does this.
pub type TileWords<'a> = &'a dyn Fn(&TileAction, &Phrase) -> String;

/// Returns the tiles of a behaviour without a pad, in the words of whoever says them: its buttons, then what it says and its
/// animations, then what each of its other senses can be pretended to tell; nine at most, each once.
#[must_use]
pub fn usual_pad(behaviour: &Behaviour, say: TileWords) -> Pad {
    let streams = behaviour.streams_in_order();
    let with_device = |kind: StreamKind| {
        let known = streams.iter().filter(move |(_, stream)| stream.kind == kind);
        known.filter_map(move |(id, stream)| Some((*id, *stream, device(kind, stream.device.as_deref()?).ok()?)))
    };
    let buttons = with_device(StreamKind::Sensor).filter(|(.., sense)| sense.button.is_some());
    let pressed = buttons.flat_map(|(id, stream, sense)| {
        let written = sense.button_words(&stream.params);
        pretended(id, sense, written, say)
    });
    let by_hand = DONE_BY_HAND.into_iter().flat_map(|offered| {
        with_device(StreamKind::Actuator)
            .filter(move |(.., action)| *action == offered)
            .filter_map(|all| by_hand(all, say))
    });
    let others = with_device(StreamKind::Sensor).filter(|(.., sense)| sense.button.is_none());
    let others = others.flat_map(|(id, _, sense)| pretended(id, sense, None, say));
    let mut tiles: Vec<Tile> = Vec::new();
    for tile in pressed.chain(by_hand).chain(others) {
        if !tiles.contains(&tile) {
            tiles.push(tile);
        }
        if tiles.len() == usize::from(*TILE_KEYS.end()) {
            break;
        }
    }
    Pad { tiles: TILE_KEYS.zip(tiles).filled() }
}

/// The tiles for what a sense can be pretended to tell.
fn pretended(id: &Id, sense: &Device, label: Option<Phrase>, say: TileWords) -> Vec<Tile> {
    let tile = |pretend: &crate::Pretend| {
        let value = serde_json::from_str(pretend.value).ok()?;
        let does = TileAction::Pretend { stream: id.clone(), value };
        let label = label.clone().unwrap_or_else(|| sense.pretend_called(pretend).phrase());
        Some(Tile { label: shortened(&say(&does, &label)), does, asks: false })
    };
    sense.pretend.iter().filter_map(tile).collect()
}

/// The tile for an action.
fn by_hand((_, stream, action): (&Id, &Stream, &Device), say: TileWords) -> Option<Tile> {
    let label = label_by_hand(action, &stream.params)?;
    let (device, params) = (action.name.to_owned(), stream.params.clone());
    let does = TileAction::Hand { device, params, value: serde_json::from_str(action.example).ok()? };
    Some(Tile { label: shortened(&say(&does, &label)), does, asks: false })
}

/// Returns the action with which a new tile begins.
#[must_use]
pub fn first_by_hand() -> &'static Device {
    DONE_BY_HAND[0]
}

/// Returns the words of the last parameter that says which one of many an action is; none if no parameter does.
#[must_use]
pub fn label_by_hand(action: &Device, params: &Params) -> Option<Phrase> {
    action.params.iter().rev().find_map(|param| written(params, action, param))
}

/// The words of a parameter: its choice, the text that somebody wrote, or what it is where nobody chose; none if it says nothing.
fn written(params: &Params, device: &Device, param: &Param) -> Option<Phrase> {
    let given = params.get(param.name).and_then(Value::as_text);
    match param.kind {
        ParamKind::Choice(options) => {
            let first = options.first().map(|(choice, _)| *choice);
            let option = options.iter().find(|(choice, _)| given.or(first) == Some(choice))?;
            Some(device.choice_called(param, *option).phrase())
        }
        ParamKind::Text { default, .. } => {
            Some(given.unwrap_or(default)).filter(|text| !text.trim().is_empty()).map(Phrase::from)
        }
        ParamKind::Number { .. } => None,
    }
}

fn shortened(text: &str) -> String {
    let line: String = behaviour::without_unseen(text).chars().filter(|letter| !letter.is_control()).collect();
    if line.chars().count() <= TILE_MAX_CHARS {
        return line;
    }
    line.chars().take(TILE_MAX_CHARS - 1).chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::usual_pad;
    use behaviour::{Behaviour, Id, Kind, Params, Record, RecordId, Stream, StreamKind, TileAction, Value};

    /// A stream: its kind, its device and its parameters.
    type Given<'a> = (StreamKind, &'a str, &'a [(&'a str, &'a str)]);

    fn with(all: &[Given]) -> Behaviour {
        let mut behaviour = Behaviour::default();
        for (order, (kind, device, params)) in (0..).zip(all) {
            let params: Params = params.iter().map(|(name, value)| ((*name).to_owned(), Value::text(value))).collect();
            let (name, device) = (format!("s{order}"), Some((*device).to_owned()));
            let (kind, resources, priority, hold_ms) = (*kind, None, None, None);
            let id = RecordId::new(Kind::Stream, &Id::new(&name).unwrap());
            let stream = Stream { kind, name, device, params, order, resources, priority, hold_ms };
            behaviour.records.insert(id, Record::Stream(stream));
        }
        behaviour
    }

    fn labels(behaviour: &Behaviour) -> Vec<String> {
        usual_pad(behaviour, &|_, words| words.to_string()).tiles.into_values().map(|tile| tile.label).collect()
    }

    #[test]
    fn buttons_come_first_then_what_is_said_and_shown_then_what_is_pretended() {
        use StreamKind::{Actuator, Sensor};
        let behaviour = with(&[
            (Sensor, "RedBall", &[]),
            (Actuator, "Animation", &[("animation", "Bow")]),
            (Actuator, "Animation", &[("animation", "robot"), ("gesture", "animations/Stand/Gestures/Hey_1")]),
            (Actuator, "SayParameter", &[("text", "Well done")]),
            (Actuator, "SayParameter", &[("text", "Well done")]),
            (Actuator, "SayInput", &[]),
            (Sensor, "Button", &[("label", "Next")]),
            (Sensor, "Button", &[]),
        ]);
        let labels = labels(&behaviour);
        assert_eq!(labels[..5], ["Next", "Go on", "Well done", "bowing", "animations/Stand/Gestures/Hey_1"]);
        let pretend: Vec<_> = crate::sensors().find(|sense| sense.name == "RedBall").unwrap().pretend.to_vec();
        assert_eq!(labels[5], pretend[0].says);
    }

    #[test]
    fn nine_at_most_that_the_catalogue_takes() {
        let senses: Vec<Given> =
            crate::sensors().map(|sense| (StreamKind::Sensor, sense.name, [].as_slice())).collect();
        let actions = crate::actuators().map(|action| (StreamKind::Actuator, action.name, [].as_slice()));
        let all = with(&senses.into_iter().chain(actions).collect::<Vec<_>>());
        let pad = usual_pad(&all, &|_, words| words.to_string());
        assert_eq!(pad.tiles.keys().copied().collect::<Vec<_>>(), (1..=9).collect::<Vec<u8>>());
        for tile in pad.tiles.values() {
            if let TileAction::Hand { device, params, .. } = &tile.does {
                let device = crate::device(StreamKind::Actuator, device).unwrap();
                assert!(device.check(params).is_ok(), "{tile:?}");
            }
        }
        assert!(labels(&Behaviour::default()).is_empty());
    }
}
