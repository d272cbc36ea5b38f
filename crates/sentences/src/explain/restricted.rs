//! Values that pass only until something else comes, or while something is so: *until the head is touched*, *while the nearest
//! person is nearer than 1 m*.

use super::SentenceTeller;
use super::chain::{Chain, ChainConnector, ChainStart, KnownGraph};
use crate::does::{Calc, ENDED, GOES_ON, GONE, SEEN, SpokenConnector, is_until};
use crate::pattern::{PatternElement, grammar};
use crate::sentence::{LiteralPlace, Piece};
use crate::test::{Asks, Comparison, ValueTest};
use crate::{carried::CarriedKind, numbers};
use behaviour::{Connector, Id};

/// The other stream that a restriction goes by, with the connectors that are told with it.
struct Restriction<'a> {
    other: &'a Id,
    connectors: Vec<(&'a Id, &'a Connector)>,
}

/// A stream that is not seen any more after a time, in milliseconds, and the connector that waits for it.
struct InView<'a> {
    seen: Restriction<'a>,
    period: u64,
    waits: &'a Id,
}

impl<'a> KnownGraph<'a> {
    /// The only connector into a stream, with what it does, if it takes from one stream.
    fn made(&self, stream: &'a Id) -> Option<(&'a Id, &'a Connector, SpokenConnector)> {
        let (id, connector) = self.graph.into_stream(stream).first().copied()?;
        let does = SpokenConnector::of(&connector.operation, &self.behaviour.arguments(connector)).0;
        (connector.inputs.len() == 1).then_some((id, connector, does))
    }

    fn as_number(&self, stream: &'a Id, number: f64) -> Option<(&'a Id, &'a Connector)> {
        let (id, connector, does) = self.made(stream)?;
        (does == SpokenConnector::Make(Calc::Number(number))).then_some((id, connector))
    }

    /// Returns the stream whose values end those of a connector, if that is what it is for.
    pub(super) fn until(&self, any: &'a Connector) -> Option<&'a Id> {
        self.ending(any).map(|ending| ending.other)
    }

    fn ending(&self, any: &'a Connector) -> Option<Restriction<'a>> {
        let [goes, ends] = &any.inputs[..] else { return None };
        self.as_number(goes, GOES_ON)?;
        let ended = self.as_number(ends, ENDED)?;
        Some(Restriction { other: ended.1.inputs.first()?, connectors: vec![ended] })
    }

    /// Returns the stream that is seen and, after a time, is not any more, if `state` tells that.
    fn view(&self, state: &'a Id) -> Option<InView<'a>> {
        let (id, any) = self.graph.into_stream(state).first().copied()?;
        let does = SpokenConnector::of(&any.operation, &self.behaviour.arguments(any)).0;
        let [is, gone] = &any.inputs[..] else { return None };
        let seen = self.as_number(is, SEEN)?;
        let ended = self.as_number(gone, GONE)?;
        let (waits, quiet, SpokenConnector::Quiet(period)) = self.made(ended.1.inputs.first()?)? else { return None };
        (does == SpokenConnector::Any && quiet.inputs.first() == Some(is)).then_some(InView {
            seen: Restriction {
                other: seen.1.inputs.first()?,
                connectors: vec![seen, (waits, quiet), ended, (id, any)],
            },
            period,
            waits,
        })
    }
}

impl<'a> SentenceTeller<'a> {
    /// Tells an *until* or a *while*, if that is what the next links are: how many.
    pub(super) fn restricted(&mut self, links: &[ChainConnector<'a>]) -> Option<usize> {
        if let Some(ending) = self.ending(links) {
            self.restriction("step.until", &links[..4], &ending, None);
            return Some(4);
        }
        let [latest, test, ..] = links else { return None };
        let SpokenConnector::Keep(asked) = &test.does else { return None };
        let [_, state] = &latest.connector.inputs[..] else { return None };
        (latest.does == SpokenConnector::Latest(Calc::Last)).then_some(())?;
        let is_seen = ValueTest { field: None, asks: Asks::Numbers(vec![(Comparison::Is, SEEN)]) };
        if let Some(view) = self.known.view(state).filter(|_| *asked == is_seen) {
            let at = LiteralPlace::Period { connector: view.waits.clone() };
            let period = Piece::Number(numbers::duration(view.period, at, self.language, false));
            self.restriction("step.within", &links[..2], &view.seen, Some(period));
            return Some(2);
        }
        self.state(&links[..2], state)?;
        Some(2)
    }

    fn ending(&self, links: &[ChainConnector<'a>]) -> Option<Restriction<'a>> {
        let [goes, any, largest, keeps, ..] = links else { return None };
        let is_one = goes.does == SpokenConnector::Make(Calc::Number(GOES_ON)) && any.does == SpokenConnector::Any;
        self.known.ending(any.connector).filter(|_| is_one && is_until(&largest.does, &keeps.does))
    }

    /// The stream that ends what the next links pass on, if they do that.
    pub(super) fn until_comes(&self, links: &[ChainConnector<'a>]) -> Option<&'a Id> {
        self.ending(links).map(|ending| ending.other)
    }

    /// Tells a restriction by a rule with the other stream in it.
    fn restriction(
        &mut self,
        rule: &'static str,
        links: &[ChainConnector<'a>],
        by: &Restriction<'a>,
        period: Option<Piece>,
    ) {
        for element in grammar(self.language).told(rule) {
            match element {
                PatternElement::Hole("other") => self.other(&self.known.chain(by.other)),
                PatternElement::Hole(_) => self.push(period.iter().cloned().collect(), links, &[]),
                element => {
                    let pieces = self.pieces(std::slice::from_ref(element), None);
                    self.push(pieces, links, &[]);
                    if let Some(phrase) = self.phrases.last_mut() {
                        phrase.connectors.extend(by.connectors.iter().map(|(id, _)| (*id).clone()));
                        phrase.streams.extend(by.connectors.iter().map(|(_, made)| made.output.clone()));
                    }
                }
            }
        }
    }

    /// A chain as one clause where it is one, else in brackets.
    fn other(&mut self, chain: &Chain<'a>) {
        let is_start = !matches!(chain.start, ChainStart::Any(..))
            && Self::new(self.known, self.unit, self.language).start(&chain.start, &chain.links) == chain.links.len();
        if is_start {
            self.depth += 1;
            self.start(&chain.start, &chain.links);
            self.depth -= 1;
        } else {
            self.group(chain);
        }
    }

    /// Tells what comes while a sense passes a test, if the test can be told of the sense.
    fn state(&mut self, links: &[ChainConnector<'a>], state: &'a Id) -> Option<()> {
        let [_, test] = links else { return None };
        let chain = self.known.chain(state);
        let ChainStart::Sense(id, stream, device) = chain.start else { return None };
        let carried = chain.links.last().map_or(CarriedKind::Sense(device.name), |last| last.carried.after(&last.does));
        let mut all = chain.links.clone();
        all.push(ChainConnector { from: state, carried, ..test.clone() });
        let mut trial = Self::new(self.known, self.unit, self.language);
        (trial.subject(id, stream, device, &all) == Some(all.len())).then_some(())?;
        for element in grammar(self.language).told("step.while") {
            match element {
                PatternElement::Hole(_) => {
                    self.subject(id, stream, device, &all);
                }
                element => {
                    let pieces = self.pieces(std::slice::from_ref(element), None);
                    self.push(pieces, links, &[]);
                }
            }
        }
        Some(())
    }
}
