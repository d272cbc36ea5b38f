//! The way of values to an action, as a chain: where it starts, and one connector after another.

use crate::carried::{CarriedKind, is_known_helper};
use crate::does::{Calc, SpokenConnector, is_kept, is_until};
use crate::test::TestPlaces;
use behaviour::{Behaviour, Connector, Graph, Helper, Id, Stream, StreamKind};
use robot::Device;
use std::collections::BTreeSet;

/// The most connectors that a chain tells; what is before them is told by the name of its stream.
const CHAIN_MAX: usize = 16;
/// The most streams that are told as coming to one place.
const ANY_MAX: usize = 10;

/// A connector of a chain.
#[derive(Clone, Debug)]
pub(super) struct ChainConnector<'a> {
    pub(super) id: &'a Id,
    pub(super) connector: &'a Connector,
    pub(super) does: SpokenConnector,
    pub(super) places: TestPlaces,
    /// What it takes first.
    pub(super) from: &'a Id,
    /// What its first input carries.
    pub(super) carried: CarriedKind,
}

/// Where a chain starts.
#[derive(Clone, Debug)]
pub(super) enum ChainStart<'a> {
    /// A sense of the catalogue, with parameters that it has.
    Sense(&'a Id, &'a Stream, &'static Device),
    /// Several streams that come together at this connector.
    Any(&'a Id, &'a Connector),
    /// A stream that is told by its name.
    Named(&'a Id, &'a str),
}

/// A chain.
#[derive(Clone, Debug)]
pub(super) struct Chain<'a> {
    pub(super) start: ChainStart<'a>,
    pub(super) links: Vec<ChainConnector<'a>>,
}

/// The graph with what is known about it.
pub(super) struct KnownGraph<'a> {
    pub(super) behaviour: &'a Behaviour,
    pub(super) graph: Graph<'a>,
    pub(super) helpers: &'a [&'a Helper],
}

impl<'a> KnownGraph<'a> {
    /// The chain that ends in a stream.
    pub(super) fn chain(&self, stream: &'a Id) -> Chain<'a> {
        let mut links: Vec<ChainConnector<'a>> = Vec::new();
        let mut seen = BTreeSet::from([stream]);
        let mut at = stream;
        let start = loop {
            let Some(&(id, connector)) = self.graph.into_stream(at).first() else { break self.start(at) };
            let (does, places) = SpokenConnector::of(&connector.operation, &self.behaviour.arguments(connector));
            let goes_on = links.len() + 1 < CHAIN_MAX && self.goes_through(connector, &links, &seen);
            if does == SpokenConnector::Any && connector.inputs.len() > 1 && !goes_on {
                let few = connector.inputs.len() <= ANY_MAX;
                break if few { ChainStart::Any(id, connector) } else { self.named(at) };
            }
            let Some(from) = connector.inputs.first() else { break self.named(at) };
            if links.len() == CHAIN_MAX || connector.inputs.len() > ANY_MAX || !seen.insert(from) {
                break self.named(at);
            }
            links.push(ChainConnector { id, connector, does, places, from, carried: CarriedKind::Other });
            at = from;
        };
        links.reverse();
        let mut carried = if let ChainStart::Sense(_, _, device) = &start {
            CarriedKind::Sense(device.name)
        } else {
            CarriedKind::Other
        };
        for link in &mut links {
            let after = self.after(&carried, &link.does);
            link.carried = std::mem::replace(&mut carried, after);
        }
        Chain { start, links }
    }

    /// A connector as the link after the chain to its first input; none if it takes from nothing.
    pub(super) fn link(&self, id: &'a Id, connector: &'a Connector) -> Option<ChainConnector<'a>> {
        let from = connector.inputs.first()?;
        let (does, places) = SpokenConnector::of(&connector.operation, &self.behaviour.arguments(connector));
        let chain = self.chain(from);
        let carried = match (chain.links.last(), &chain.start) {
            (Some(last), _) => self.after(&last.carried, &last.does),
            (None, ChainStart::Sense(_, _, device)) => CarriedKind::Sense(device.name),
            (None, ChainStart::Any(..) | ChainStart::Named(..)) => CarriedKind::Other,
        };
        Some(ChainConnector { id, connector, does, places, from, carried })
    }

    /// True if what comes here goes on: unless something is held meanwhile, or until something else comes. `after` is what
    /// comes later, the last first.
    fn goes_through(&self, any: &'a Connector, after: &[ChainConnector], seen: &BTreeSet<&'a Id>) -> bool {
        let [.., keeps, before] = after else { return false };
        let ends = is_kept(&before.does, &keeps.does) && self.unless(any).is_some()
            || is_until(&before.does, &keeps.does) && self.until(any).is_some();
        let from = any.inputs.first().and_then(|comes| self.graph.into_stream(comes).first());
        ends && from.is_some_and(|(_, made)| !made.inputs.iter().any(|from| seen.contains(from)))
    }

    fn after(&self, carried: &CarriedKind, does: &SpokenConnector) -> CarriedKind {
        match does {
            SpokenConnector::Make(Calc::Helper(name)) if !is_known_helper(name, self.helpers) => CarriedKind::Other,
            _ => carried.after(does),
        }
    }

    fn start(&self, at: &'a Id) -> ChainStart<'a> {
        let sense = self.behaviour.stream(at).filter(|stream| stream.kind == StreamKind::Sensor);
        let device = sense.and_then(|stream| {
            let device = robot::device(StreamKind::Sensor, stream.device.as_deref()?).ok()?;
            device.check(&stream.params).is_ok().then_some((stream, device))
        });
        device.map_or_else(|| self.named(at), |(stream, device)| ChainStart::Sense(at, stream, device))
    }

    /// A stream that is told by its name.
    pub(super) fn named(&self, at: &'a Id) -> ChainStart<'a> {
        let name = self.behaviour.stream(at).map_or(at.as_str(), |stream| stream.name.as_str());
        ChainStart::Named(at, name)
    }

    /// Whether a helper means what the words for its name say.
    pub(super) fn knows(&self, helper: &str) -> bool {
        is_known_helper(helper, self.helpers)
    }
}

impl<'a> Chain<'a> {
    /// Its stream at the start.
    pub(super) fn first(&self) -> &'a Id {
        match self.start {
            ChainStart::Sense(id, ..) | ChainStart::Named(id, _) => id,
            ChainStart::Any(_, connector) => &connector.output,
        }
    }

    /// The name of its sense, if it starts at one.
    pub(super) fn sense(&self) -> Option<&'static str> {
        if let ChainStart::Sense(_, _, device) = &self.start { Some(device.name) } else { None }
    }
}
