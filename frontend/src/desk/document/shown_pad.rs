//! The tiles of a program in the words of the page: its own or the usual ones, with the picture and the look of each. Pure.

use crate::words;
use behaviour::{Behaviour, Pad, StreamKind, TILE_MAX_CHARS, TileAction};
use phrase::{Phrase, Phrased};
use robot::{Resource, Resources};

/// The tiles of a program: its own, or the usual ones.
pub(crate) fn of(behaviour: &Behaviour) -> Pad {
    behaviour.pad().cloned().unwrap_or_else(|| usual(behaviour))
}

/// The usual tiles of what is in a program, in words.
pub(crate) fn usual(behaviour: &Behaviour) -> Pad {
    robot::usual_pad(behaviour, &|does, label| {
        let (_, button) = pictured(behaviour, does);
        shortened(&usual_words(does, label, button))
    })
}

/// The picture of what a tile is about, and whether that is a button.
pub(crate) fn pictured(behaviour: &Behaviour, does: &TileAction) -> (&'static str, bool) {
    let device = match does {
        TileAction::Hand { device, .. } => robot::device(StreamKind::Actuator, device).ok(),
        TileAction::Pretend { stream, .. } => {
            let device = behaviour.stream(stream).and_then(|stream| stream.device.as_deref());
            device.and_then(|device| robot::device(StreamKind::Sensor, device).ok())
        }
        TileAction::Word { .. } => return ("flag", false),
    };
    device.map_or(("bolt", false), |device| (device.icon, device.button.is_some()))
}

/// The look of a tile: as the kind of thing that it is about.
pub(crate) fn look(does: &TileAction) -> &'static str {
    match does {
        TileAction::Hand { .. } => "actuator",
        TileAction::Pretend { .. } => "sensor",
        TileAction::Word { .. } => "word",
    }
}

/// The words for a tile that does this, until somebody writes others.
pub(crate) fn proposed_words(behaviour: &Behaviour, does: &TileAction) -> String {
    let (_, button) = pictured(behaviour, does);
    let label = match does {
        TileAction::Hand { device, params, .. } => {
            let action = robot::device(StreamKind::Actuator, device).ok();
            let label = action.and_then(|action| robot::label_by_hand(action, params));
            label.or_else(|| action.map(|action| action.called().phrase())).unwrap_or_default()
        }
        TileAction::Pretend { stream, value } => {
            let stream = behaviour.stream(stream);
            let sense = stream.and_then(|stream| robot::device(StreamKind::Sensor, stream.device.as_deref()?).ok());
            let is_it = |pretend: &&robot::Pretend| crate::json::read(pretend.value).ok().as_ref() == Some(value);
            let known = sense.and_then(|sense| Some(sense.pretend_called(sense.pretend.iter().find(is_it)?).phrase()));
            known.or_else(|| stream.map(|stream| stream.name.phrase())).unwrap_or_default()
        }
        TileAction::Word { word, .. } => return shortened(word),
    };
    if label.is_empty() { String::new() } else { shortened(&usual_words(does, &label, button)) }
}

/// The words on a usual tile: what is said stands in quotes, what is pretended behind “as if”.
fn usual_words(does: &TileAction, label: &Phrase, button: bool) -> String {
    let said = words::shown(label);
    match does {
        TileAction::Hand { device, .. } if speaks(device) => words::saying(&label.to_string()),
        TileAction::Pretend { .. } if !button => words::as_if_there_is(&said),
        _ => words::capitalised(&said),
    }
}

/// True for an action that uses the robot's voice.
pub(crate) fn speaks(device: &str) -> bool {
    let device = robot::device(StreamKind::Actuator, device);
    device.is_ok_and(|device| matches!(device.resources, Resources::Always(parts) if parts.contains(&Resource::Voice)))
}

/// A label of one line that is short enough for a tile.
fn shortened(label: &str) -> String {
    let line: String = behaviour::without_unseen(label).chars().filter(|letter| !letter.is_control()).collect();
    match line.trim().char_indices().nth(TILE_MAX_CHARS) {
        None => line.trim().to_owned(),
        Some(_) => line.trim().chars().take(TILE_MAX_CHARS - 1).chain(['…']).collect(),
    }
}

/// Programs for tests of tiles.
#[cfg(test)]
pub(crate) mod made {
    use behaviour::{Behaviour, Id, Kind, Params, Record, RecordId, Stream, StreamKind, Value};

    /// The kind, the device and the parameters of a stream.
    pub(crate) type StreamMade<'a> = (StreamKind, &'a str, &'a [(&'a str, &'a str)]);

    /// Makes a program of these streams.
    pub(crate) fn with(all: &[StreamMade]) -> Behaviour {
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
}

#[cfg(test)]
mod tests {
    use super::made::with;
    use super::{of, proposed_words, usual};
    use behaviour::{Id, Pad, Record, RecordId, StreamKind, TILE_MAX_CHARS, TileAction, Value};

    #[test]
    fn the_usual_tiles_can_become_those_of_the_program_however_long_their_words_are() {
        let long = "a".repeat(60);
        let behaviour = with(&[(StreamKind::Actuator, "SayParameter", &[("text", &long)])]);
        let usual = usual(&behaviour);
        assert!(usual.tiles.values().all(|tile| tile.label.chars().count() <= TILE_MAX_CHARS), "{usual:?}");
        assert_eq!(of(&behaviour), usual);
        let mut own = behaviour;
        own.records.insert(RecordId::pad(), Record::Pad(Pad::default()));
        assert_eq!(of(&own), Pad::default(), "one without tiles shows none");
    }

    #[test]
    fn a_tile_is_called_by_what_it_does_until_somebody_writes_other_words() {
        let behaviour = with(&[(StreamKind::Sensor, "HeadTouch", &[])]);
        let hand = |device: &str, params: &[(&str, &str)]| {
            let params = params.iter().map(|(name, value)| ((*name).to_owned(), Value::text(value))).collect();
            proposed_words(&behaviour, &TileAction::Hand { device: device.to_owned(), params, value: Value::Null })
        };
        assert_eq!(hand("SayParameter", &[("text", "Well done")]), "“Well done”");
        assert_eq!(hand("Animation", &[("animation", "Hey")]), "Waving");
        assert_eq!(hand("Nothing", &[]), "");
        let pretend = robot::device(StreamKind::Sensor, "HeadTouch").unwrap().pretend[0];
        let stream = Id::new("s0").unwrap();
        let value = crate::json::read(pretend.value).unwrap();
        let known = proposed_words(&behaviour, &TileAction::Pretend { stream: stream.clone(), value });
        assert_eq!(known, format!("As if: {}", pretend.says));
        let other = proposed_words(&behaviour, &TileAction::Pretend { stream, value: Value::Int(7) });
        assert_eq!(other, "As if: s0");
        assert_eq!(proposed_words(&behaviour, &TileAction::Word { word: "laughs".into(), span: true }), "laughs");
    }
}
