//! A part of a graph that nobody added yet, such as that of a typed sentence, and how it is put in as one change.

use behaviour::{Behaviour, Change, Connector, FillFrom, Id, Kind, Place, Record, RecordId, Stream};
use std::collections::BTreeMap;

/// A part of a graph that nobody added yet. Its new streams have ids that only it knows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ghost {
    /// New streams.
    pub streams: Vec<GhostStream>,
    /// New connectors.
    pub connectors: Vec<GhostConnector>,
}

/// A new stream.
#[derive(Clone, Debug, PartialEq)]
pub struct GhostStream {
    /// The id that only the ghost knows.
    pub id: Id,
    /// The stream.
    pub stream: Stream,
    /// The place where it would stand.
    pub place: Place,
    /// Comes of words that were not understood.
    pub doubtful: bool,
}

/// A new connector; what it takes from may be there already.
#[derive(Clone, Debug, PartialEq)]
pub struct GhostConnector {
    /// The connector.
    pub connector: Connector,
    /// Comes of words that were not understood.
    pub doubtful: bool,
}

impl Ghost {
    /// Returns it as a change of a behaviour, and the streams that it adds.
    pub fn into(self, behaviour: &Behaviour, mut change: Change, mut new_id: impl FnMut() -> Id) -> (Change, Vec<Id>) {
        let ids: BTreeMap<Id, Id> = self.streams.iter().map(|ghost| (ghost.id.clone(), new_id())).filled();
        let real = |id: &Id| ids.get(id).unwrap_or(id).clone();
        let mut order = behaviour.next_order();
        for GhostStream { id, stream, place, .. } in self.streams {
            let id = real(&id);
            change =
                change.put(behaviour, RecordId::new(Kind::Stream, &id), Record::Stream(Stream { order, ..stream }));
            change = change.put(behaviour, RecordId::new(Kind::Place, &id), Record::Place(place));
            order += 1;
        }
        for GhostConnector { connector, .. } in self.connectors {
            let (inputs, output) = (connector.inputs.iter().map(real).collect(), real(&connector.output));
            let connector = Connector { inputs, output, order, ..connector };
            change = change.put(behaviour, RecordId::new(Kind::Connector, &new_id()), Record::Connector(connector));
            order += 1;
        }
        (change, ids.into_values().collect())
    }
}

#[cfg(test)]
mod tests {
    use super::{Ghost, GhostConnector, GhostStream};
    use behaviour::{Behaviour, Change, Connector, Id, Params, Place, Stream, StreamKind, connectors};

    #[test]
    fn what_is_new_gets_ids_and_what_is_there_keeps_its_own() {
        let id = |text: &str| Id::new(text).unwrap();
        let stream = Stream {
            kind: StreamKind::Actuator,
            name: "Eyes".into(),
            device: Some("EyeLedColor".into()),
            params: Params::new(),
            order: 0,
            resources: None,
            priority: None,
            hold_ms: None,
        };
        let place = Place { x: 10.0, y: 20.0 };
        let operation = connectors::to_action().with(());
        let connector = Connector { operation, inputs: vec![id("ball")], output: id("draft-0"), order: 0 };
        let ghost = Ghost {
            streams: vec![GhostStream { id: id("draft-0"), stream, place, doubtful: false }],
            connectors: vec![GhostConnector { connector, doubtful: false }],
        };
        let mut count = 0;
        let (change, streams) = ghost.into(&Behaviour::default(), Change::of(id("c"), "Aiko", "Add"), || {
            count += 1;
            Id::new(&format!("new{count}")).unwrap()
        });
        assert_eq!(streams, [id("new1")]);
        let mut after = Behaviour::default();
        after.apply(&change);
        let made = after.connector(&id("new2")).unwrap();
        assert_eq!((made.inputs.as_slice(), &made.output), ([id("ball")].as_slice(), &id("new1")));
        assert_eq!(after.place(&id("new1")), Some(place));
    }
}
