//! A touch that goes on, told as people do: *while the head is held*, *unless the head is held*.

use super::chain::{Chain, ChainConnector, ChainStart, KnownGraph};
use super::{SentenceTeller, fill};
use crate::clauses::{BOTH, TOUCHES};
use crate::does::{COMES, Calc, HELD, LET_GO, SpokenConnector, is_kept};
use crate::fits::params_fit;
use crate::pattern::grammar;
use crate::test::{Asks, ValueTest};
use behaviour::{Connector, Id, Stream};
use robot::Device;

/// A touch: its stream and its sense.
type HeldTouch<'a> = (&'a Id, &'a Stream, &'static Device);

/// The parts of an *unless*: the touch, and besides its own links the connectors that tell of it.
pub(super) struct Unless<'a> {
    touch: HeldTouch<'a>,
    connectors: Vec<(&'a Id, &'a Connector)>,
}

impl<'a> KnownGraph<'a> {
    /// The touch that a chain is, with both its ends.
    fn touch(&self, chain: &Chain<'a>) -> Option<HeldTouch<'a>> {
        let ChainStart::Sense(id, stream, device) = chain.start else { return None };
        chain.links.is_empty().then_some((id, stream, device))
    }

    /// The value that comes at a connector unless something is held, if that is what it is for.
    pub(super) fn unless(&self, any: &'a Connector) -> Option<Unless<'a>> {
        let [comes, begins, ends] = &any.inputs[..] else { return None };
        let made = |stream: &'a Id| self.graph.into_stream(stream).first().copied();
        let does =
            |connector: &Connector| SpokenConnector::of(&connector.operation, &self.behaviour.arguments(connector)).0;
        let is_number =
            |connector: &Connector, number: f64| does(connector) == SpokenConnector::Make(Calc::Number(number));
        let (_, makes) = made(comes).filter(|(_, makes)| makes.inputs.len() == 1 && is_number(makes, COMES))?;
        let mut connectors = Vec::new();
        let mut felt = None;
        for (stream, number, truth) in [(begins, HELD, true), (ends, LET_GO, false)] {
            let number = made(stream).filter(|(_, makes)| is_number(makes, number))?;
            let test = made(number.1.inputs.first()?)?;
            let asks = SpokenConnector::Keep(ValueTest { field: None, asks: Asks::Truth(truth) });
            let sense =
                test.1.inputs.first().filter(|sense| does(test.1) == asks && felt.is_none_or(|felt| felt == *sense))?;
            felt = Some(sense);
            connectors.extend([test, number]);
        }
        let touch = self.touch(&Chain { start: self.chain(felt?).start, links: Vec::new() })?;
        (touch.0 == felt? && makes.inputs.first() != felt).then_some(Unless { touch, connectors })
    }
}

impl<'a> SentenceTeller<'a> {
    /// Tells a touch that goes on, if that is what the next links are: how many.
    pub(super) fn held(&mut self, links: &[ChainConnector<'a>]) -> Option<usize> {
        let is_true = |link: &ChainConnector| {
            link.does == SpokenConnector::Keep(ValueTest { field: None, asks: Asks::Truth(true) })
        };
        match links {
            [latest, test, ..] if latest.does == SpokenConnector::Latest(Calc::Last) && is_true(test) => {
                let [_, state] = &latest.connector.inputs[..] else { return None };
                let touch = self.known.touch(&self.known.chain(state))?;
                self.touching(touch, false, &links[..2], &[])?;
                Some(2)
            }
            _ => {
                let unless = self.unless_held(links)?;
                self.touching(unless.touch, true, &links[..4], &unless.connectors)?;
                Some(4)
            }
        }
    }

    /// The next links make this of a value that comes unless something is held.
    pub(super) fn unless_held(&self, links: &[ChainConnector<'a>]) -> Option<Unless<'a>> {
        let [_, any, holds, keeps, ..] = links else { return None };
        let fits = any.does == SpokenConnector::Any && is_kept(&holds.does, &keeps.does);
        self.known.unless(any.connector).filter(|unless| fits && self.touch_rule(unless.touch, true).is_some())
    }

    /// The rule for a touch that goes on, or that does not.
    fn touch_rule(&self, (_, stream, device): HeldTouch, not: bool) -> Option<&'static str> {
        let (held, unless, _) = TOUCHES.iter().find(|(.., sense)| *sense == device.name)?;
        let rule = if not { unless } else { held };
        params_fit(grammar(self.language), rule, BOTH, device, &stream.params).then_some(*rule)
    }

    fn touching(
        &mut self,
        touch: HeldTouch<'a>,
        not: bool,
        links: &[ChainConnector<'a>],
        more: &[(&'a Id, &'a Connector)],
    ) -> Option<()> {
        let rule = self.touch_rule(touch, not)?;
        let (id, stream, device) = touch;
        let fills = fill::Fills { device: Some((device, id, stream)), seen: None, links: &[] };
        let pieces = self.filled(grammar(self.language).told(rule), &fills, "")?;
        let streams: Vec<&Id> = std::iter::once(id).chain(more.iter().map(|(_, made)| &made.output)).collect();
        self.push(pieces, links, &streams);
        if let Some(phrase) = self.phrases.last_mut() {
            phrase.connectors.extend(more.iter().map(|(id, _)| (*id).clone()));
        }
        Some(())
    }
}
