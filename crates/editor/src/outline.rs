//! The graph as the rows of a list: every stream under the connector that makes it, every connector under its first stream.

use behaviour::{Behaviour, Graph, Id, StreamKind};
use std::collections::BTreeSet;

/// One row of the list.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct OutlineNode {
    /// The thing that it shows.
    pub what: OutlineRowKind,
    /// The number of rows above it that it hangs below.
    pub depth: usize,
    /// True if the stream stands above already; then nothing follows below it.
    pub again: bool,
    /// The row that it stands under, so that the same stream twice is two rows.
    under: Option<Id>,
}

/// The things that a row shows.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum OutlineRowKind {
    /// A stream.
    Stream(Id),
    /// A connector.
    Connector(Id),
    /// The heading of a group, before the first of its streams.
    Group(Id),
    /// A note, below all others.
    Note(Id),
}

/// Returns the rows of streams and connectors from top to bottom.
fn nodes(behaviour: &Behaviour) -> Vec<OutlineNode> {
    let graph = Graph::of(behaviour);
    let mut walk = OutlineWalk { graph: &graph, seen: BTreeSet::new(), rows: Vec::new() };
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

/// Returns all rows from top to bottom, with groups and notes; what is in a folded group is left out.
pub fn outline(behaviour: &Behaviour, is_folded: impl Fn(&Id) -> bool) -> Vec<OutlineNode> {
    let mut seen = BTreeSet::new();
    let mut rows = Vec::new();
    let alone = |what, depth| OutlineNode { what, depth, again: false, under: None };
    for node in nodes(behaviour) {
        let stream = match &node.what {
            OutlineRowKind::Stream(id) => Some(id),
            OutlineRowKind::Connector(id) => behaviour.connector(id).map(|connector| &connector.output),
            OutlineRowKind::Group(_) | OutlineRowKind::Note(_) => None,
        };
        let group = stream.and_then(|stream| behaviour.group_of(stream)).map(|(id, _)| id);
        if let Some(group) = group.filter(|group| seen.insert((*group).clone())) {
            rows.push(alone(OutlineRowKind::Group(group.clone()), node.depth));
        }
        if !group.is_some_and(&is_folded) {
            rows.push(node);
        }
    }
    rows.extend(behaviour.notes().map(|(id, _)| alone(OutlineRowKind::Note(id.clone()), 0)));
    rows
}

struct OutlineWalk<'a> {
    graph: &'a Graph<'a>,
    seen: BTreeSet<Id>,
    rows: Vec<OutlineNode>,
}

impl OutlineWalk<'_> {
    fn stream(&mut self, id: &Id, depth: usize, under: Option<&Id>) {
        let again = !self.seen.insert(id.clone());
        self.rows.push(OutlineNode { what: OutlineRowKind::Stream(id.clone()), depth, again, under: under.cloned() });
        if again {
            return;
        }
        let graph = self.graph;
        for (connector, record) in graph.out_of_stream(id) {
            let what = OutlineRowKind::Connector((*connector).clone());
            self.rows.push(OutlineNode { what, depth: depth + 1, again: false, under: Some(id.clone()) });
            self.stream(&record.output, depth + 1, Some(connector));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{OutlineRowKind, nodes, outline};
    use behaviour::{Behaviour, Connector, Group, Id, Kind, Note, Record, RecordId, Stream, StreamKind, connectors};

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
    fn a_group_has_a_heading_and_what_is_in_a_folded_one_is_left_out() {
        let mut behaviour = Behaviour::default();
        for (order, name) in (0..).zip(["a", "b", "c"]) {
            stream(&mut behaviour, name, if order == 0 { StreamKind::Sensor } else { StreamKind::Ordinary }, order);
        }
        merge(&mut behaviour, "ab", &["a"], "b");
        merge(&mut behaviour, "bc", &["b"], "c");
        let streams = [Id::new("b").unwrap()].into();
        put(&mut behaviour, Kind::Group, "g", Record::Group(Group { title: "G".into(), streams, folded: false }));
        put(&mut behaviour, Kind::Note, "n", Record::Note(Note::default()));
        let shown = |folded: bool| {
            let told = outline(&behaviour, |_| folded).into_iter().map(|row| match row.what {
                OutlineRowKind::Stream(id) | OutlineRowKind::Connector(id) => id.to_string(),
                OutlineRowKind::Group(id) => format!("[{id}]"),
                OutlineRowKind::Note(id) => format!("({id})"),
            });
            told.collect::<Vec<_>>().join(" ")
        };
        assert_eq!(shown(false), "a [g] ab b bc c (n)");
        assert_eq!(shown(true), "a [g] bc c (n)");
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
            OutlineRowKind::Stream(id) => format!("{}{id}{}", " ".repeat(row.depth), if row.again { "…" } else { "" }),
            OutlineRowKind::Connector(id) => format!("{}({id})", " ".repeat(row.depth)),
            OutlineRowKind::Group(_) | OutlineRowKind::Note(_) => String::new(),
        });
        assert_eq!(shown.collect::<Vec<_>>(), ["a", " (m)", " both", "b", " (m)", " both…"]);
    }
}
