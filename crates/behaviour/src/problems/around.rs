//! A behaviour with everything that hints are made of.

use crate::connectors::{Passes, Spec};
use crate::flow::Gives;
use crate::{
    Behaviour, Connector, FillFrom, Fit, Graph, Helper, Id, Inference, Knowledge, Lookup, Procedure, SeenKinds, Stream,
    ValueType,
};
use std::collections::BTreeSet;

/// The most connectors above a stream that are looked at.
const ABOVE_MAX: usize = 500;

/// The surroundings that a hint looks at.
pub(super) struct HintSurroundings<'a> {
    pub(super) behaviour: &'a Behaviour,
    pub(super) graph: Graph<'a>,
    /// Helpers by name.
    pub(super) library: Lookup<&'a str, &'a Helper>,
    pub(super) knowledge: &'a dyn Knowledge,
    pub(super) inference: Inference<'a>,
}

impl<'a> HintSurroundings<'a> {
    pub(super) fn of(
        behaviour: &'a Behaviour,
        helpers: &[&'a Helper],
        knowledge: &'a dyn Knowledge,
        seen: &SeenKinds,
    ) -> Self {
        let library = helpers.iter().map(|helper| (helper.name.as_str(), *helper)).filled();
        let inference = Inference::seeing(behaviour, helpers, knowledge, seen);
        Self { behaviour, graph: Graph::of(behaviour), library, knowledge, inference }
    }

    pub(super) fn stream(&self, id: &Id) -> Option<&'a Stream> {
        self.behaviour.stream(id)
    }

    /// Returns the name of a stream, as a person calls it.
    pub(super) fn name(&self, id: &Id) -> String {
        self.stream(id).map_or_else(String::new, |stream| stream.name.clone())
    }

    /// The first input of a connector whose value is not what it takes: its place, what is wanted, and how it misses.
    pub(super) fn misfit(&self, connector: &Connector) -> Option<(usize, ValueType, Fit)> {
        let spec = connector.operation.spec();
        let wanted = if spec.acts() {
            vec![self.inference.of_stream(&connector.output).clone()]
        } else {
            let Some(Procedure::Helper(name)) = connector.operation.procedure() else { return None };
            let takes = self.inference.signature(name)?.takes;
            takes.into_iter().skip(spec.argument_count(0)).collect()
        };
        let each = connector.inputs.iter().zip(wanted).enumerate().map(|(at, (id, wants))| {
            let fit = wants.takes(self.inference.of_stream(id));
            (at, wants, fit)
        });
        each.into_iter().find(|(.., fit)| *fit != Fit::Good)
    }

    /// Every stream from which values flow to a stream, itself included, with the connectors on the way. None if those are
    /// too many.
    pub(super) fn above(&self, id: &'a Id) -> Option<(BTreeSet<&'a Id>, Vec<&'a Connector>)> {
        let (mut seen, mut ways, mut open) = (BTreeSet::new(), Vec::new(), vec![id]);
        while let Some(next) = open.pop() {
            if seen.insert(next) {
                for (_, connector) in self.graph.into_stream(next) {
                    ways.push(*connector);
                    open.extend(&connector.inputs);
                }
            }
            if ways.len() > ABOVE_MAX || open.len() > ABOVE_MAX {
                return None;
            }
        }
        Some((seen, ways))
    }
}

/// True if a connector gives something because of a value on this input, if it gives something at once at all: others only
/// look at their first.
pub(super) fn is_driven_by(connector: &Connector, input: &Id) -> bool {
    let spec: &Spec = connector.operation.spec();
    let only_first = spec.gives == Gives::Some && spec.inputs.are_many() && spec.passes == Passes::Result;
    !only_first || connector.inputs.first() == Some(input)
}
