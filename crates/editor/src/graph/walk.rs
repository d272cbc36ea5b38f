//! Walking along the graph with arrow keys.

use behaviour::{Behaviour, FillFrom, Graph, Id, Place, sort_few};

/// The directions of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepDirection {
    Down,
    Up,
    Left,
    Right,
}

/// The stream that is reached from `from`; `place` tells where streams stand.
pub fn walk(behaviour: &Behaviour, from: &Id, way: StepDirection, place: impl Fn(&Id) -> Option<Place>) -> Option<Id> {
    let graph = Graph::of(behaviour);
    match way {
        StepDirection::Down => graph.out_of_stream(from).first().map(|(_, connector)| connector.output.clone()),
        StepDirection::Up => {
            graph.into_stream(from).iter().find_map(|(_, connector)| connector.inputs.first().cloned())
        }
        StepDirection::Left | StepDirection::Right => {
            let mut row = siblings(behaviour, &graph, from);
            let x = |id: &Id| place(id).map_or(0.0, |place| place.x);
            sort_few(&mut row, |one, other| x(one).total_cmp(&x(other)).then_with(|| one.cmp(other)).is_lt());
            let at = row.iter().position(|id| id == from)?;
            let next = if way == StepDirection::Left { at.checked_sub(1)? } else { at + 1 };
            row.get(next).cloned()
        }
    }
}

/// The streams beside one: what else comes out of its sources, or what else has no source.
fn siblings(behaviour: &Behaviour, graph: &Graph, of: &Id) -> Vec<Id> {
    let sources: Vec<&Id> = graph.into_stream(of).iter().flat_map(|(_, connector)| &connector.inputs).collect();
    let row: Vec<Id> = if sources.is_empty() {
        let alone = behaviour.streams().filter(|(id, _)| graph.into_stream(id).is_empty());
        alone.map(|(id, _)| id.clone()).collect()
    } else {
        let beside = sources.iter().flat_map(|source| graph.out_of_stream(source));
        beside.map(|(_, connector)| connector.output.clone()).collect()
    };
    row.into_iter().distinct()
}

#[cfg(test)]
mod tests {
    use super::{StepDirection, walk};
    use behaviour::{Behaviour, Connector, Id, Kind, Params, Place, Record, RecordId, Stream, StreamKind, connectors};

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn graph() -> Behaviour {
        let mut made = Behaviour::default();
        for (order, name) in (0..).zip(["a", "b", "c", "z"]) {
            let (name, params) = (name.to_owned(), Params::new());
            let kind = StreamKind::Ordinary;
            let key = RecordId::new(Kind::Stream, &id(&name));
            let stream =
                Stream { kind, name, device: None, params, order, resources: None, priority: None, hold_ms: None };
            made.records.insert(key, Record::Stream(stream));
        }
        for (order, output) in (0..).zip(["b", "c"]) {
            let connector = Connector {
                operation: connectors::merge::SPEC.with(()),
                inputs: vec![id("a")],
                output: id(output),
                order,
            };
            made.records.insert(RecordId::new(Kind::Connector, &id(output)), Record::Connector(connector));
        }
        made
    }

    #[test]
    fn arrow_keys_walk_down_up_and_to_the_sides() {
        let made = graph();
        let x = |id: &Id| Some(Place { x: if id.as_str() == "c" { -50.0 } else { 0.0 }, y: 0.0 });
        let go = |from: &str, way| walk(&made, &id(from), way, x).map(|id| id.to_string());
        assert_eq!(go("a", StepDirection::Down).as_deref(), Some("b"));
        assert_eq!(go("b", StepDirection::Up).as_deref(), Some("a"));
        assert_eq!(go("b", StepDirection::Left).as_deref(), Some("c"));
        assert_eq!(go("b", StepDirection::Right), None);
        assert_eq!(go("a", StepDirection::Right).as_deref(), Some("z"));
    }
}
