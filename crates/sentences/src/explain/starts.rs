//! Where sentences start: senses with what is asked of them, several that come together, streams by name.

use super::chain::{Chain, ChainConnector, ChainStart};
use super::{SentenceTeller, fill};
use crate::clauses::{Clause, SENSES, SUBJECTS, goes_by_distance};
use crate::does::{Calc, SpokenConnector};
use crate::fits::{is_part, params_fit};
use crate::pattern::grammar;
use crate::sentence::{Piece, SentencePart};
use crate::test::{Asks, ValueTest};
use behaviour::{Connector, Id, Stream};
use robot::Device;

/// The most phrases of a sentence; what is beyond is told by the names of streams.
const PHRASES_MAX: usize = 48;
/// How deep brackets stand in brackets.
const DEPTH_MAX: usize = 4;

impl<'a> SentenceTeller<'a> {
    /// Where a chain starts, with the first links that are told with it: how many.
    pub(super) fn start(&mut self, start: &ChainStart<'a>, links: &[ChainConnector<'a>]) -> usize {
        match start {
            ChainStart::Sense(id, stream, device) => self.sense(id, stream, device, links),
            ChainStart::Any(id, connector) => {
                self.any(id, connector);
                0
            }
            ChainStart::Named(id, name) => self.named(id, name, links),
        }
    }

    fn sense(&mut self, id: &'a Id, stream: &Stream, device: &'static Device, links: &[ChainConnector<'a>]) -> usize {
        let grammar = grammar(self.language);
        let fits = |clause: &&Clause| {
            let parts = clause.parts.iter().zip(links).filter(|(part, link)| is_part(&link.does, **part)).count();
            clause.device == device.name
                && parts == clause.parts.len()
                && params_fit(grammar, clause.id, clause.fixed, device, &stream.params)
        };
        let fitting = SENSES.iter().find(fits);
        if fitting.is_none_or(|clause| clause.parts.is_empty())
            && let Some(used) = self.subject(id, stream, device, links)
        {
            return used;
        }
        let Some(clause) = fitting else { return self.named(id, &stream.name, links) };
        let links = &links[..clause.parts.len()];
        let fills = fill::Fills { device: Some((device, id, stream)), seen: None, links };
        let pieces = self.filled(grammar.told(clause.id), &fills, "").unwrap_or_default();
        self.push(pieces, links, &[id]);
        links.len()
    }

    /// A sense and what is asked of it, as its subject and a test; none if that cannot be said so.
    pub(super) fn subject(
        &mut self,
        id: &'a Id,
        stream: &Stream,
        device: &'static Device,
        links: &[ChainConnector<'a>],
    ) -> Option<usize> {
        let by_distance = goes_by_distance(device.name, "");
        let before = usize::from(by_distance);
        if by_distance {
            let SpokenConnector::Make(Calc::Helper(name)) = &links.first()?.does else { return None };
            (self.known.knows(name) && ["distance", "ball_to_distance"].contains(&name.as_str())).then_some(())?;
        }
        let SpokenConnector::Keep(ValueTest { field, asks }) = &links.get(before)?.does else { return None };
        let asked = field.as_deref().unwrap_or("");
        let (rule, ..) = SUBJECTS.iter().find(|(_, sense, field)| *sense == device.name && *field == asked)?;
        let is_asked = match asks {
            Asks::Truth(_) => false,
            Asks::Text(..) => !by_distance,
            Asks::Numbers(_) => true,
        };
        is_asked.then_some(())?;
        let grammar = grammar(self.language);
        params_fit(grammar, rule, &[], device, &stream.params).then_some(())?;
        let fills = fill::Fills { device: Some((device, id, stream)), seen: None, links: &[] };
        let pieces = self.filled(grammar.told(rule), &fills, "")?;
        self.push(pieces, &[], &[id]);
        self.text(self.words.asked);
        let pieces = self.test_pieces(&links[before]);
        self.push(pieces, &links[..=before], &[]);
        Some(before + 1)
    }

    /// A stream that is told by its name, with a test of it.
    fn named(&mut self, id: &'a Id, name: &str, links: &[ChainConnector<'a>]) -> usize {
        if let Some(link) = links.first()
            && let SpokenConnector::Keep(ValueTest { field: None, asks: Asks::Numbers(_) | Asks::Text(..) }) =
                &link.does
        {
            let pieces = self.named_pieces("subject.named", name);
            self.push(pieces, &[], &[id]);
            self.text(self.words.asked);
            let pieces = self.test_pieces(link);
            self.push(pieces, &links[..1], &[]);
            return 1;
        }
        let pieces = self.named_pieces("named", name);
        self.push(pieces, &[], &[id]);
        0
    }

    /// Several streams of which one comes.
    fn any(&mut self, id: &'a Id, connector: &'a Connector) {
        if self.is_full() {
            let ChainStart::Named(id, name) = self.known.named(&connector.output) else { return };
            self.named(id, name, &[]);
            return;
        }
        for (at, input) in connector.inputs.iter().enumerate() {
            if at > 0 {
                let or = SentencePart {
                    pieces: vec![Piece::Text(self.words.or.to_owned())],
                    streams: vec![connector.output.clone()],
                    connectors: vec![id.clone()],
                };
                self.phrases.push(or);
            }
            let chain = self.known.chain(input);
            if self.is_simple(&chain) {
                self.depth += 1;
                let used = self.start(&chain.start, &chain.links);
                if let Some(link) = chain.links.get(used)
                    && let Some(rule) = tight(&link.does)
                {
                    let pieces = self.step_pieces(rule, link);
                    self.push(pieces, &chain.links[used..=used], &[]);
                }
                self.depth -= 1;
            } else {
                self.group(&chain);
            }
        }
    }

    /// Whether a chain is one clause without steps.
    fn is_simple(&self, chain: &Chain<'a>) -> bool {
        if matches!(chain.start, ChainStart::Any(..)) {
            return false;
        }
        let mut trial = Self::new(self.known, self.unit, self.language);
        let used = trial.start(&chain.start, &chain.links);
        match &chain.links[used..] {
            [] => true,
            [only] => tight(&only.does).is_some(),
            _ => false,
        }
    }

    /// A chain in brackets.
    pub(super) fn group(&mut self, chain: &Chain<'a>) {
        self.text(self.words.brackets.0);
        self.depth += 1;
        if self.is_full() {
            let last = chain.links.last().map_or(chain.first(), |link| &link.connector.output);
            let start = self.known.named(last);
            self.way(&Chain { start, links: Vec::new() }, 0, "");
        } else {
            self.way(chain, chain.links.len(), "");
        }
        self.depth -= 1;
        self.text(self.words.brackets.1);
    }

    fn is_full(&self) -> bool {
        self.depth > DEPTH_MAX || self.phrases.len() > PHRASES_MAX
    }
}

/// The rule of a step that stands in brackets right after its sense.
pub(super) fn tight(does: &SpokenConnector) -> Option<&'static str> {
    match does {
        SpokenConnector::Make(Calc::Text(_)) => Some("tight.text"),
        SpokenConnector::Make(Calc::Number(_)) => Some("tight.number"),
        _ => None,
    }
}
