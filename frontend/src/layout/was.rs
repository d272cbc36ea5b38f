//! The words for what something is or was, where two versions differ.

use super::label::{chip_words, what_it_is};
use crate::words;
use behaviour::{Behaviour, Connector, Group, Id, Record, RecordId, Stream};

/// Names a thing: `Distance`, `map to Distance`.
pub(crate) fn called(behaviour: &Behaviour, id: &RecordId) -> String {
    match behaviour.records.get(id) {
        Some(Record::Stream(stream)) => stream.name.clone(),
        Some(Record::Connector(connector)) => {
            words::connector_to(words::connector_word(connector.operation.spec()), &name(behaviour, &connector.output))
        }
        Some(Record::Helper(helper)) => helper.name.clone(),
        Some(Record::Note(_)) => words::a_note().to_owned(),
        Some(Record::Group(group)) => group.title.clone(),
        Some(Record::Pad(_)) => words::the_tiles().to_owned(),
        Some(Record::Settings(_) | Record::Place(_)) | None => words::program_name().to_owned(),
    }
}

/// The name by which people know it: a connector is known by the stream it leads to.
pub(crate) fn subject(behaviour: &Behaviour, id: &RecordId) -> String {
    match behaviour.records.get(id) {
        Some(Record::Connector(connector)) => name(behaviour, &connector.output),
        _ => called(behaviour, id),
    }
}

/// All that a thing says of itself.
pub(crate) fn whole(behaviour: &Behaviour, id: &RecordId) -> String {
    match behaviour.records.get(id) {
        Some(Record::Stream(stream)) => {
            let second = what_it_is(stream);
            if second.is_empty() { stream.name.clone() } else { words::listed([&stream.name, &second]) }
        }
        Some(Record::Connector(connector)) => {
            words::made_from(&chip_words(connector).whole(), &sources(behaviour, connector))
        }
        Some(Record::Helper(helper)) => helper.body.clone(),
        Some(Record::Note(note)) => note.text.clone(),
        Some(Record::Group(group)) => group.title.clone(),
        Some(Record::Settings(settings)) => settings.name.clone(),
        Some(Record::Pad(pad)) => words::listed(pad.tiles.values().map(|tile| &tile.label)),
        Some(Record::Place(_)) | None => words::not_there().to_owned(),
    }
}

/// Says what was another about a thing that changed, in a few words.
pub(crate) fn what_it_was(was: &Behaviour, is: &Behaviour, id: &RecordId) -> String {
    match (was.records.get(id), is.records.get(id)) {
        (Some(Record::Stream(old)), Some(Record::Stream(new))) => stream_was(old, new),
        (Some(Record::Connector(old)), Some(Record::Connector(new))) => connector_was(was, old, new),
        (Some(Record::Group(old)), Some(Record::Group(new))) => group_was(old, new),
        _ => whole(was, id),
    }
}

fn group_was(old: &Group, new: &Group) -> String {
    match () {
        () if old.title != new.title => old.title.clone(),
        () if old.streams != new.streams => words::other_streams().to_owned(),
        () if old.folded => words::was_folded().to_owned(),
        () => words::was_open().to_owned(),
    }
}

fn stream_was(old: &Stream, new: &Stream) -> String {
    let (before, now) = (what_it_is(old), what_it_is(new));
    match () {
        () if old.name != new.name => old.name.clone(),
        () if before != now && !before.is_empty() => before,
        () => words::other_order().to_owned(),
    }
}

fn connector_was(was: &Behaviour, old: &Connector, new: &Connector) -> String {
    if old.operation != new.operation {
        let chosen = chip_words(old);
        let same_kind = old.operation.spec().name == new.operation.spec().name;
        let detail = chosen.detail.strip_prefix('(').and_then(|detail| detail.strip_suffix(')'));
        return match detail.filter(|_| same_kind) {
            Some(detail) => detail.to_owned(),
            None => chosen.whole(),
        };
    }
    match () {
        () if old.inputs != new.inputs => words::came_from(&sources(was, old)),
        () if old.output != new.output => words::led_to(&name(was, &old.output)),
        () => words::other_order().to_owned(),
    }
}

pub(super) fn sources(behaviour: &Behaviour, connector: &Connector) -> String {
    words::sources(&connector.inputs.iter().map(|id| name(behaviour, id)).collect::<Vec<_>>())
}

fn name(behaviour: &Behaviour, id: &Id) -> String {
    behaviour.stream(id).map_or_else(|| words::not_there().to_owned(), |stream| stream.name.clone())
}

#[cfg(test)]
mod tests {
    use super::{called, what_it_was, whole};
    use behaviour::{
        Behaviour, Connector, Id, Operation, Params, Procedure, Record, RecordId, Stream, StreamKind, connectors,
    };

    fn behaviour(name: &str, operation: Operation, from: &str) -> Behaviour {
        let id = |text: &str| Id::new(text).unwrap();
        let stream = |name: &str| {
            let (kind, name, params) = (StreamKind::Ordinary, name.to_owned(), Params::new());
            Record::Stream(Stream {
                kind,
                name,
                device: None,
                params,
                order: 0,
                resources: None,
                priority: None,
                hold_ms: None,
            })
        };
        let map = Connector { operation, inputs: vec![id(from)], output: id("b"), order: 0 };
        let records = [("stream/a", stream("A")), ("stream/b", stream(name)), ("connector/m", Record::Connector(map))];
        Behaviour { records: records.into_iter().map(|(id, record)| (id.parse().unwrap(), record)).collect() }
    }

    fn body(text: &str) -> Operation {
        connectors::map::SPEC.with(Procedure::body(text))
    }

    #[test]
    fn what_changed_is_said_by_what_it_was() {
        let was = behaviour("Near", body("a < (2 + 3)"), "a");
        let said = |is: &Behaviour, id: &str| what_it_was(&was, is, &id.parse::<RecordId>().unwrap());
        assert_eq!(said(&behaviour("Close", body("1"), "a"), "stream/b"), "Near");
        assert_eq!(said(&behaviour("Near", body("1"), "a"), "connector/m"), "a < (2 + 3)");
        assert_eq!(
            said(&behaviour("Near", connectors::subscribe::SPEC.with(()), "a"), "connector/m"),
            "map (a < (2 + 3))"
        );
        assert_eq!(said(&behaviour("Near", body("a < (2 + 3)"), "b"), "connector/m"), "from A");
    }

    #[test]
    fn things_are_called_by_their_names() {
        let is = behaviour("Near", body("1"), "a");
        let id = |text: &str| text.parse::<RecordId>().unwrap();
        assert_eq!([called(&is, &id("stream/b")), called(&is, &id("connector/m"))], ["Near", "map to Near"]);
        assert_eq!(whole(&is, &id("connector/m")), "map (1) from A");
        assert_eq!(whole(&is, &id("stream/gone")), "not there");
    }
}
