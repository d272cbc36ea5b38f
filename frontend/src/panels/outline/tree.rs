//! The graph as rows: every stream under the connector that makes it, every connector under its first stream.

use behaviour::{Behaviour, Graph, Id, StreamKind};
use std::collections::BTreeSet;

/// One row.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Node {
    pub(super) what: What,
    pub(super) depth: usize,
    /// Whether the stream stands above already; then nothing follows below it.
    pub(super) again: bool,
    /// Where it stands, so that the same stream twice is two rows.
    under: Option<Id>,
}

/// What a row shows.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum What {
    Stream(Id),
    Connector(Id),
}

/// All rows from top to bottom.
pub(super) fn nodes(behaviour: &Behaviour) -> Vec<Node> {
    let graph = Graph::of(behaviour);
    let mut walk = Walk { graph: &graph, seen: BTreeSet::new(), rows: Vec::new() };
    let streams = behaviour.streams_in_order();
    let is_root = |id: &Id, kind| kind == StreamKind::Sensor || graph.into_stream(id).is_empty();
    for (id, _) in streams.iter().filter(|(id, stream)| is_root(id, stream.kind)) {
        walk.stream(id, 0, None);
    }
    for (id, _) in &streams {
        if !walk.seen.contains(*id) {
            walk.stream(id, 0, None);
        }
    }
    walk.rows
}

struct Walk<'a> {
    graph: &'a Graph<'a>,
    seen: BTreeSet<Id>,
    rows: Vec<Node>,
}

impl Walk<'_> {
    fn stream(&mut self, id: &Id, depth: usize, under: Option<&Id>) {
        let again = !self.seen.insert(id.clone());
        self.rows.push(Node { what: What::Stream(id.clone()), depth, again, under: under.cloned() });
        if again {
            return;
        }
        let graph = self.graph;
        for (connector, record) in graph.out_of_stream(id) {
            let what = What::Connector((*connector).clone());
            self.rows.push(Node { what, depth: depth + 1, again: false, under: Some(id.clone()) });
            self.stream(&record.output, depth + 1, Some(connector));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{What, nodes};
    use behaviour::{Behaviour, Connector, Id, Kind, Record, RecordId, Stream, StreamKind, connectors};

    fn put(behaviour: &mut Behaviour, kind: Kind, id: &str, record: Record) {
        behaviour.records.insert(RecordId::new(kind, &Id::new(id).unwrap()), record);
    }

    fn stream(behaviour: &mut Behaviour, id: &str, kind: StreamKind, order: i64) {
        let stream = Stream {
            kind,
            name: id.into(),
            device: None,
            params: behaviour::Params::new(),
            order,
            resources: None,
            priority: None,
            hold_ms: None,
        };
        put(behaviour, Kind::Stream, id, Record::Stream(stream));
    }

    fn merge(behaviour: &mut Behaviour, id: &str, inputs: &[&str], output: &str) {
        let inputs = inputs.iter().map(|id| Id::new(id).unwrap()).collect();
        let output = Id::new(output).unwrap();
        put(
            behaviour,
            Kind::Connector,
            id,
            Record::Connector(Connector { operation: connectors::merge::SPEC.with(()), inputs, output, order: 9 }),
        );
    }

    #[test]
    fn a_stream_of_two_branches_is_shown_whole_once() {
        let mut behaviour = Behaviour::default();
        stream(&mut behaviour, "a", StreamKind::Sensor, 0);
        stream(&mut behaviour, "b", StreamKind::Sensor, 1);
        stream(&mut behaviour, "both", StreamKind::Ordinary, 2);
        merge(&mut behaviour, "m", &["a", "b"], "both");
        let rows = nodes(&behaviour);
        let shown = rows.iter().map(|row| match &row.what {
            What::Stream(id) => format!("{}{id}{}", " ".repeat(row.depth), if row.again { "…" } else { "" }),
            What::Connector(id) => format!("{}({id})", " ".repeat(row.depth)),
        });
        assert_eq!(shown.collect::<Vec<_>>(), ["a", " (m)", " both", "b", " (m)", " both…"]);
    }
}
