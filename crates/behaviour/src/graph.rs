//! A behaviour seen as a graph: what flows from where to where.

use crate::walk::{self, Ends};
use crate::{Behaviour, Connector, FillFrom, Id, Lookup, LookupSet, StreamKind};
use std::collections::BTreeSet;

/// The connectors around every stream, in file order.
#[derive(Debug, Default)]
pub struct Graph<'a> {
    into: Lookup<&'a Id, Vec<(&'a Id, &'a Connector)>>,
    out_of: Lookup<&'a Id, Vec<(&'a Id, &'a Connector)>>,
    all: Vec<&'a Connector>,
}

impl<'a> Graph<'a> {
    /// The graph of a behaviour.
    #[must_use]
    pub fn of(behaviour: &'a Behaviour) -> Self {
        let mut graph = Self::default();
        for (id, connector) in behaviour.connectors_in_order() {
            graph.all.push(connector);
            graph.into.entry(&connector.output).or_default().push((id, connector));
            for input in &connector.inputs {
                graph.out_of.entry(input).or_default().push((id, connector));
            }
        }
        graph
    }

    /// Connectors that give to this stream.
    #[must_use]
    pub fn into_stream(&self, stream: &Id) -> &[(&'a Id, &'a Connector)] {
        self.into.get(stream).map_or(&[], Vec::as_slice)
    }

    /// Connectors that take from this stream.
    #[must_use]
    pub fn out_of_stream(&self, stream: &Id) -> &[(&'a Id, &'a Connector)] {
        self.out_of.get(stream).map_or(&[], Vec::as_slice)
    }

    /// All streams that values of `stream` can reach, without itself unless there is a cycle.
    #[must_use]
    pub fn below(&self, stream: &Id) -> BTreeSet<&'a Id> {
        let mut reached = BTreeSet::new();
        let mut open: Vec<&'a Id> = self.out_of_stream(stream).iter().map(|(_, connector)| &connector.output).collect();
        while let Some(next) = open.pop() {
            if reached.insert(next) {
                open.extend(self.out_of_stream(next).iter().map(|(_, connector)| &connector.output));
            }
        }
        reached
    }

    /// Returns the number of connectors on the longest way to each stream, by id, without streams in a circle or behind
    /// one.
    #[must_use]
    pub fn ranks(&self, behaviour: &'a Behaviour) -> Vec<(&'a Id, usize)> {
        let wires = self.wires(behaviour.streams().map(|(id, _)| id).collect());
        let ranks = walk::ranks(wires.streams.len(), &wires.ends());
        wires.streams.into_iter().zip(ranks).filter_map(|(id, rank)| Some((id, rank?))).collect()
    }

    /// The graph in numbers, with these streams besides those that connectors lead from and to.
    fn wires(&self, streams: Vec<&'a Id>) -> Wires<'a> {
        let ends = self.all.iter().flat_map(|connector| connector.inputs.iter().chain([&connector.output]));
        let streams = streams.into_iter().chain(ends).distinct();
        let place = |id: &Id| streams.binary_search(&id).unwrap_or_default();
        let ends = |connector: &&Connector| (connector.inputs.iter().map(place).collect(), place(&connector.output));
        let connectors = self.all.iter().map(ends).collect();
        Wires { streams, connectors }
    }

    /// The streams whose values can reach an action of the robot, actions included: one walk upwards for all of them.
    #[must_use]
    pub fn reaching_action(&self, behaviour: &'a Behaviour) -> LookupSet<&'a Id> {
        let actions = behaviour.streams().filter(|(_, stream)| stream.kind == StreamKind::Actuator);
        let mut open: Vec<&'a Id> = actions.map(|(id, _)| id).collect();
        let mut reaching: LookupSet<&'a Id> = LookupSet::new();
        while let Some(next) = open.pop() {
            if reaching.insert(next) {
                open.extend(self.into_stream(next).iter().flat_map(|(_, connector)| &connector.inputs));
            }
        }
        reaching
    }

    /// The streams whose values reach no action of the robot, in file order.
    #[must_use]
    pub fn dead_streams(&self, behaviour: &'a Behaviour) -> Vec<&'a Id> {
        let reaching = self.reaching_action(behaviour);
        let streams = behaviour.streams_in_order().into_iter().map(|(id, _)| id);
        streams.filter(|id| !reaching.contains(id)).collect()
    }

    /// A stream that flows back into itself, if there is one.
    #[must_use]
    pub fn cycle(&self) -> Option<&'a Id> {
        let wires = self.wires(Vec::new());
        let at = walk::in_circle(wires.streams.len(), &wires.ends())?;
        Some(wires.streams[wires.connectors[at].1])
    }
}

/// A graph in numbers.
struct Wires<'a> {
    /// The streams by their ids.
    streams: Vec<&'a Id>,
    /// The connectors in file order: what they take from and what they give to.
    connectors: Vec<(Vec<usize>, usize)>,
}

impl Wires<'_> {
    fn ends(&self) -> Vec<Ends<'_>> {
        self.connectors.iter().map(|(inputs, output)| (&inputs[..], *output)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Graph;
    use crate::{Behaviour, Connector, Id, Kind, Record, RecordId, Stream, StreamKind, connectors};

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    /// Streams by their first letter: s… a sense, a… an action; connectors as (from, to).
    fn behaviour(streams: &[&str], connectors: &[(&[&str], &str)]) -> Behaviour {
        let mut behaviour = Behaviour::default();
        for (order, name) in (0..).zip(streams) {
            let kind = match name.as_bytes()[0] {
                b's' => StreamKind::Sensor,
                b'a' => StreamKind::Actuator,
                _ => StreamKind::Ordinary,
            };
            let (device, params) = (None, crate::Params::new());
            let name = (*name).to_owned();
            let id = RecordId::new(Kind::Stream, &id(&name));
            let stream = Stream { kind, name, device, params, order, resources: None, priority: None, hold_ms: None };
            behaviour.records.insert(id, Record::Stream(stream));
        }
        for (order, (from, to)) in (100..).zip(connectors) {
            let inputs = from.iter().map(|from| id(from)).collect();
            let connector = Connector { operation: connectors::merge::SPEC.with(()), inputs, output: id(to), order };
            behaviour
                .records
                .insert(RecordId::new(Kind::Connector, &id(&format!("c{order}"))), Record::Connector(connector));
        }
        behaviour
    }

    #[test]
    fn what_reaches_no_action_is_dead() {
        let made = behaviour(&["s1", "s2", "x", "y", "a1"], &[(&["s1"], "x"), (&["x"], "a1"), (&["s1", "s2"], "y")]);
        let dead = Graph::of(&made).dead_streams(&made);
        assert_eq!(dead, [&id("s2"), &id("y")]);
        let below = Graph::of(&made).below(&id("s1"));
        assert_eq!(below.into_iter().map(Id::as_str).collect::<Vec<_>>(), ["a1", "x", "y"]);
    }

    #[test]
    fn a_rank_is_the_longest_way() {
        let made = behaviour(&["s1", "x", "y", "a1"], &[(&["s1"], "x"), (&["s1", "x"], "y"), (&["y"], "a1")]);
        let graph = Graph::of(&made);
        let ranks = graph.ranks(&made);
        let rank = |name: &str| ranks.iter().find(|(at, _)| at.as_str() == name).unwrap().1;
        assert_eq!([rank("s1"), rank("x"), rank("y"), rank("a1")], [0, 1, 2, 3]);
    }

    #[test]
    fn a_circle_has_no_rank_and_ends() {
        let made = behaviour(&["s1", "x", "y"], &[(&["s1", "y"], "x"), (&["x"], "y")]);
        let graph = Graph::of(&made);
        assert_eq!(graph.ranks(&made), [(&id("s1"), 0)]);
    }
}
