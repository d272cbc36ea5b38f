//! From a behaviour to its file.

use super::{BehaviourFile, FORMAT, FileConnector, FileGroup, FileHelper, FileNote, FileStream, FileTile};
use crate::{
    Behaviour, Connector, Engine, FillFrom, Group, Helper, Id, Lookup, Note, Place, Procedure, Record, Settings,
    Stream, Tile, TileAction, Value, called_names,
};
use std::collections::BTreeMap;

impl BehaviourFile {
    /// The file of a behaviour with those helpers of `library` that it uses, also through other helpers.
    #[must_use]
    pub fn of(behaviour: &Behaviour, library: &[&Helper]) -> Self {
        let settings = behaviour.settings().cloned().unwrap_or_else(|| Settings::named(""));
        let connectors: Vec<_> =
            behaviour.connectors_in_order().into_iter().map(|(id, c)| file_connector(id, c)).collect();
        Self {
            format: FORMAT.to_owned(),
            id: None,
            name: settings.name,
            robot: Some(settings.robot).filter(|robot| robot != "nao"),
            engine: Some(settings.engine).filter(|engine| *engine != Engine::Event),
            exercise: settings.exercise,
            tags: settings.tags,
            helpers: used_helpers(&connectors, library),
            streams: behaviour.streams_in_order().into_iter().map(|(id, stream)| file_stream(id, stream)).collect(),
            connectors,
            notes: behaviour.notes().map(|(id, note)| file_note(id, note)).collect(),
            groups: behaviour.groups().map(|(id, group)| file_group(id, group)).collect(),
            pad: behaviour.pad().map(|pad| pad.tiles.iter().map(file_tile).collect()),
            order: order_of(behaviour),
            layout: layout_of(behaviour),
        }
    }
}

/// The creation numbers that the position in the file does not tell.
fn order_of(behaviour: &Behaviour) -> BTreeMap<String, i64> {
    let streams = behaviour.streams_in_order().into_iter().map(|(id, stream)| (id, stream.order));
    let connectors = behaviour.connectors_in_order().into_iter().map(|(id, connector)| (id, connector.order));
    let numbered = (0..).zip(streams).chain((0..).zip(connectors));
    numbered.filter(|(at, (_, order))| at != order).map(|(_, (id, order))| (id.to_string(), order)).filled()
}

fn file_note(id: &Id, note: &Note) -> FileNote {
    FileNote {
        id: id.to_string(),
        text: note.text.clone(),
        by: Some(note.by.clone()).filter(|by| !by.is_empty()),
        at: Some(note.at_ms).filter(|at_ms| *at_ms > 0),
    }
}

fn file_group(id: &Id, group: &Group) -> FileGroup {
    FileGroup {
        id: id.to_string(),
        title: group.title.clone(),
        streams: group.streams.iter().map(Id::to_string).collect(),
        folded: group.folded.then_some(true),
    }
}

fn file_tile((key, tile): (&u8, &Tile)) -> FileTile {
    let asks = tile.asks.then_some(true);
    let plain = FileTile { key: *key, label: tile.label.clone(), asks, ..FileTile::default() };
    let there = |value: &Value| Some(value.clone()).filter(|value| *value != Value::Null);
    match &tile.does {
        TileAction::Hand { device, params, value } => FileTile {
            device: Some(device.clone()),
            params: Some(params.clone()).filter(|params| !params.is_empty()),
            value: there(value),
            ..plain
        },
        TileAction::Pretend { stream, value } => {
            FileTile { stream: Some(stream.to_string()), value: there(value), ..plain }
        }
        TileAction::Word { word, span } => FileTile { word: Some(word.clone()), span: span.then_some(true), ..plain },
    }
}

fn file_stream(id: &Id, stream: &Stream) -> FileStream {
    FileStream {
        id: id.to_string(),
        kind: stream.kind,
        name: stream.name.clone(),
        device: stream.device.clone(),
        params: Some(stream.params.clone()).filter(|params| !params.is_empty()),
        resources: stream.resources.clone(),
        priority: stream.priority,
        hold_ms: stream.hold_ms,
    }
}

fn file_connector(id: &Id, connector: &Connector) -> FileConnector {
    let (body, args, helper) = match connector.operation.procedure() {
        Some(Procedure::Body { body, args }) => (Some(body.clone()), args.clone(), None),
        Some(Procedure::Helper(name)) => (None, None, Some(name.clone())),
        None => (None, None, None),
    };
    FileConnector {
        id: id.to_string(),
        operation: connector.operation.word().to_owned(),
        inputs: connector.inputs.iter().map(Id::to_string).collect(),
        output: connector.output.to_string(),
        body,
        args,
        helper,
        period_ms: connector.operation.period_ms(),
        start: connector.operation.start().filter(|start| **start != Value::Null).cloned(),
    }
}

fn layout_of(behaviour: &Behaviour) -> BTreeMap<String, Place> {
    let places = behaviour.records.iter().filter_map(|(key, record)| match record {
        Record::Place(place) => Some((key.id.to_string(), *place)),
        _ => None,
    });
    places.filled()
}

fn used_helpers(connectors: &[FileConnector], library: &[&Helper]) -> Vec<FileHelper> {
    let mut known: Lookup<&str, &Helper> = library.iter().map(|helper| (helper.name.as_str(), *helper)).filled();
    let mut open: Vec<&str> = connectors.iter().filter_map(|connector| connector.helper.as_deref()).collect();
    open.extend(connectors.iter().filter_map(|connector| connector.body.as_deref()).flat_map(called_names));
    let mut used = Vec::new();
    while let Some(name) = open.pop() {
        if let Some(helper) = known.remove(name) {
            used.push(helper);
            open.extend(called_names(&helper.body));
        }
    }
    used.sort_unstable_by_key(|helper| &helper.name);
    used.into_iter().map(file_helper).collect()
}

fn file_helper(helper: &Helper) -> FileHelper {
    FileHelper {
        name: helper.name.clone(),
        params: helper.params.clone(),
        body: helper.body.clone(),
        says: helper.says.clone(),
        takes: helper.takes.clone(),
        gives: helper.gives,
    }
}
