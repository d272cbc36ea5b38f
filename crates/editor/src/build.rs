//! Small changes of a behaviour, as pure functions of the behaviour as it is: another name, another operation, without.

use behaviour::{
    Behaviour, Change, Connector, Helper, Id, Kind, Operation, Place, Procedure, Record, RecordId, Settings, Stream,
    numbered, rename_identifiers,
};

fn key(kind: Kind, id: &Id) -> RecordId {
    RecordId::new(kind, id)
}

/// The first free name: "Tracker", then "Tracker 2".
pub fn free_name(behaviour: &Behaviour, base: &str) -> String {
    let base = base.trim();
    let taken = |name: &str| behaviour.streams().any(|(_, stream)| behaviour::look_same(&stream.name, name));
    numbered(base, " ").find(|name| !taken(name)).unwrap_or_else(|| base.to_owned())
}

/// Another operation or other inputs of a connector, and perhaps another name of the stream it leads to.
pub fn connector_edited(
    behaviour: &Behaviour,
    change: Change,
    (id, seen): (&Id, &Connector),
    (operation, inputs): (Operation, Vec<Id>),
    output_name: Option<&str>,
) -> Change {
    // One that is gone is put as its author saw it: the server says that it is gone, and nothing is lost.
    let connector = behaviour.connector(id).unwrap_or(seen);
    let edited = Connector { operation, inputs, ..connector.clone() };
    let change = change.put(behaviour, key(Kind::Connector, id), Record::Connector(edited));
    match (output_name, behaviour.stream(&connector.output)) {
        (Some(name), Some(stream)) if stream.name != name.trim() => {
            let renamed = Stream { name: name.trim().to_owned(), ..stream.clone() };
            stream_edited(behaviour, change, &connector.output, renamed)
        }
        _ => change,
    }
}

/// Another name or other settings of a stream; bodies that use its old argument name follow.
pub fn stream_edited(behaviour: &Behaviour, change: Change, id: &Id, stream: Stream) -> Change {
    let mut after = behaviour.clone();
    after.apply(&change);
    after.records.insert(key(Kind::Stream, id), Record::Stream(stream.clone()));
    let mut change = change.put(behaviour, key(Kind::Stream, id), Record::Stream(stream));
    for (connector_id, connector) in after.connectors().filter(|(_, connector)| connector.inputs.contains(id)) {
        if let Some(renamed) = follow_rename(behaviour, &after, connector) {
            change = change.put(behaviour, key(Kind::Connector, connector_id), Record::Connector(renamed));
        }
    }
    change
}

fn follow_rename(before: &Behaviour, after: &Behaviour, connector: &Connector) -> Option<Connector> {
    let Some(Procedure::Body { body, args: None }) = connector.operation.procedure() else { return None };
    let old = before.arguments(connector);
    let new = after.arguments(connector);
    let renamed = rename_identifiers(body, &old, &new);
    if renamed == *body {
        return None;
    }
    let mut connector = connector.clone();
    if let Some(procedure) = connector.operation.procedure_mut() {
        *procedure = Procedure::body(&renamed);
    }
    Some(connector)
}

/// Without a stream, the connectors at it, and their places.
pub fn without_stream(behaviour: &Behaviour, change: Change, id: &Id) -> Change {
    let touches = |connector: &Connector| connector.output == *id || connector.inputs.contains(id);
    let gone = behaviour.connectors().filter(|(_, connector)| touches(connector));
    let change = gone.fold(change, |change, (gone, _)| without_connector(behaviour, change, gone));
    change.take(behaviour, key(Kind::Stream, id)).take(behaviour, key(Kind::Place, id))
}

/// Without a connector and its place.
pub fn without_connector(behaviour: &Behaviour, change: Change, id: &Id) -> Change {
    change.take(behaviour, key(Kind::Connector, id)).take(behaviour, key(Kind::Place, id))
}

/// Streams somewhere else.
pub fn moved(behaviour: &Behaviour, change: Change, places: &[(Id, Place)]) -> Change {
    places.iter().fold(change, |change, (id, place)| change.put(behaviour, key(Kind::Place, id), Record::Place(*place)))
}

/// Another name of the program.
pub fn renamed(behaviour: &Behaviour, change: Change, name: &str) -> Change {
    let now = behaviour.settings().cloned().unwrap_or_else(|| Settings::named(""));
    let settings = Settings { name: name.trim().to_owned(), ..now };
    change.put(behaviour, RecordId::settings(), Record::Settings(settings))
}

/// A helper of the library, new or edited.
pub fn helper_put(library: &Behaviour, change: Change, id: &Id, helper: Helper) -> Change {
    change.put(library, key(Kind::Helper, id), Record::Helper(helper))
}

/// The change of a record that its author saw as `seen`: if it is not that any more, the server refuses, and nothing that
/// somebody else saved meanwhile is lost.
pub fn as_seen(change: Change, kind: Kind, id: &Id, seen: Record) -> Change {
    as_seen_at(change, &key(kind, id), seen)
}

/// Makes the change of a record by its key that its author saw as `seen`, as [`as_seen`] does.
pub fn as_seen_at(mut change: Change, id: &RecordId, seen: Record) -> Change {
    if let Some(edit) = change.edits.iter_mut().find(|edit| edit.id == *id) {
        edit.before = Some(seen);
    }
    change
}

/// The library without a helper.
pub fn helper_gone(library: &Behaviour, change: Change, id: &Id) -> Change {
    change.take(library, key(Kind::Helper, id))
}
