//! From a behaviour to sentences.

mod chain;
mod fill;
mod fix;
mod held;
mod miss;
mod restricted;
mod starts;
mod steps;
mod why;

use crate::clauses::{ACTIONS, Clause, ClausePart, TARGETS};
use crate::does::SpokenConnector;
use crate::fits::{is_part, params_fit};
use crate::pattern::grammar;
use crate::sentence::{Piece, Sentence, SentencePart};
use crate::test::Asks;
use crate::token::quoted;
use crate::words::{LanguageWords, words};
use crate::{Language, carried::CarriedKind};
use behaviour::{Behaviour, Connector, Graph, Helper, Id, Stream, StreamKind, Value, connectors};
use chain::{Chain, ChainConnector, ChainStart, KnownGraph};
pub use miss::TestMeasure;
use robot::Device;
use starts::tight;
pub use why::{AnswerSentence, Answers};

/// What a behaviour does: a sentence for every connector that leads to an action, in their order. `helpers` are those of
/// the library, `unit` tells in what the numbers of a stream are measured, `cm` for example, where the caller knows it.
///
/// Any graph has sentences, also one that cannot run yet: what is missing is told by the names of streams. A sentence has
/// some 50 phrases at most, so that the time is bounded by the number of actions.
#[must_use]
pub fn explain(
    behaviour: &Behaviour,
    helpers: &[&Helper],
    unit: &dyn Fn(&Id) -> Option<String>,
    language: Language,
) -> Vec<Sentence> {
    let known = KnownGraph { behaviour, graph: Graph::of(behaviour), helpers };
    let mut told: Vec<Id> = Vec::new();
    let mut before: Option<Chain> = None;
    let mut sentences = Vec::new();
    for (id, connector) in behaviour.connectors_in_order() {
        let to_action = connector.operation.spec() == connectors::to_action();
        let (Some(input), true) = (connector.inputs.first(), to_action) else { continue };
        let Some(action) = behaviour.stream(&connector.output) else { continue };
        let chain = known.chain(input);
        let mut teller = SentenceTeller::new(&known, unit, language);
        let otherwise =
            before.take().and_then(|before| follows(&before, &chain)).filter(|at| !is_never(behaviour, &chain, *at));
        teller.sentence(&chain, otherwise, (id, connector, action), told.contains(&connector.output));
        told.push(connector.output.clone());
        sentences.push(Sentence { action: connector.output.clone(), phrases: teller.phrases });
        before = otherwise.is_none().then_some(chain);
    }
    sentences
}

/// Which link of a chain passes exactly what the last test of the chain before it keeps out.
fn follows(before: &Chain, chain: &Chain) -> Option<usize> {
    let last =
        before.links.iter().rfind(|link| matches!(link.does, SpokenConnector::Keep(_) | SpokenConnector::KeepBy(_)))?;
    let at = chain.links.iter().position(|link| link.from == last.from)?;
    let is_test = matches!(chain.links[at].does, SpokenConnector::Keep(_) | SpokenConnector::KeepBy(_));
    (is_test && chain.links[at].does.is_opposite_of(&last.does)).then_some(at)
}

/// True if nothing is ever kept out: a touch that is told only when it begins is always true.
fn is_never(behaviour: &Behaviour, chain: &Chain, at: usize) -> bool {
    let link = &chain.links[at];
    let is_plain = matches!(&link.does, SpokenConnector::Keep(test) if test.field.is_none() && matches!(test.asks, Asks::Truth(_)));
    let told_once = |stream: &Stream| {
        let device = stream.device.as_deref().and_then(|name| robot::device(StreamKind::Sensor, name).ok());
        let may_tell = device.is_some_and(|device| device.params.iter().any(|param| param.name == "release"));
        may_tell && stream.params.get("release").and_then(Value::as_text) != Some("yes")
    };
    is_plain && behaviour.stream(link.from).is_some_and(told_once)
}

/// Tells one sentence.
struct SentenceTeller<'a> {
    known: &'a KnownGraph<'a>,
    unit: &'a dyn Fn(&Id) -> Option<String>,
    language: Language,
    words: &'static LanguageWords,
    phrases: Vec<SentencePart>,
    depth: usize,
}

impl<'a> SentenceTeller<'a> {
    fn new(known: &'a KnownGraph<'a>, unit: &'a dyn Fn(&Id) -> Option<String>, language: Language) -> Self {
        Self { known, unit, language, words: words(language), phrases: Vec::new(), depth: 0 }
    }

    fn sentence(
        &mut self,
        chain: &Chain<'a>,
        otherwise: Option<usize>,
        action: (&'a Id, &'a Connector, &Stream),
        again: bool,
    ) {
        let device = action.2.device.as_deref().and_then(|name| robot::device(StreamKind::Actuator, name).ok());
        let device = device.filter(|device| device.check(&action.2.params).is_ok());
        let from = otherwise.map_or(0, |at| at + 1);
        let clause = device.and_then(|device| self.action_clause(device, action.2, &chain.links[from..]));
        let used = clause.map_or(0, |clause| Self::used(clause, &chain.links[from..]));
        let end = chain.links.len() - used;
        match otherwise {
            Some(at) => {
                let rule = grammar(self.language).told("otherwise");
                let pieces = self.pieces(rule, None);
                self.push(pieces, &chain.links[at..=at], &[]);
                self.steps(&chain.links[from..end]);
                let is_bare = from == end && self.language == Language::English;
                self.text(if is_bare { " " } else { self.words.comma });
            }
            None => {
                let lead = self.words.when.0;
                self.way(chain, end, lead);
                self.text(self.words.comma);
            }
        }
        self.action(chain, clause.zip(device), &chain.links[end..], action, again);
        self.text(self.words.stop);
        if self.language == Language::English {
            self.capital();
        }
    }

    /// The first clause that says what an action does with what the last links make.
    fn action_clause(&self, device: &Device, stream: &Stream, links: &[ChainConnector]) -> Option<&'static Clause> {
        let grammar = grammar(self.language);
        ACTIONS.iter().filter(|clause| clause.device == device.name).find(|clause| {
            let fits = match (clause.parts, links.last()) {
                ([], _) => true,
                ([ClausePart::Helper(name)], Some(last)) => {
                    let measured = last.carried.is_ball() || matches!(last.carried, CarriedKind::Distance(_));
                    self.known.knows(name)
                        && is_part(&last.does, ClausePart::Helper(name))
                        && measured
                        && !needs_distance(links)
                }
                ([part], Some(last)) => is_part(&last.does, *part),
                _ => false,
            };
            fits && params_fit(grammar, clause.id, clause.fixed, device, &stream.params)
        })
    }

    /// How many of the last links an action's clause tells.
    fn used(clause: &Clause, links: &[ChainConnector]) -> usize {
        let [.., distance, last] = links else { return clause.parts.len() };
        let is_distance = is_part(&distance.does, ClausePart::Helper("ball_to_distance"));
        let with_distance =
            matches!(clause.parts, [ClausePart::Helper(_)]) && is_distance && distance.carried.is_ball();
        if with_distance && last.from == &distance.connector.output { 2 } else { clause.parts.len() }
    }

    fn action(
        &mut self,
        chain: &Chain<'a>,
        clause: Option<(&'static Clause, &'static Device)>,
        links: &[ChainConnector<'a>],
        (id, connector, stream): (&'a Id, &'a Connector, &Stream),
        again: bool,
    ) {
        let grammar = grammar(self.language);
        let mut pieces = Vec::new();
        if again {
            pieces = self.pieces(grammar.told("likewise"), None);
            pieces
                .push(Piece::Text(if self.language == Language::English { " " } else { self.words.comma }.to_owned()));
        }
        let said = clause.and_then(|(clause, device)| {
            let seen = chain.sense().and_then(|sense| TARGETS.iter().find(|(_, by)| *by == sense));
            let seen = seen.map(|(target, _)| *target);
            let fills = fill::Fills { device: Some((device, &connector.output, stream)), seen, links };
            self.filled(grammar.told(clause.id), &fills, crate::fits::number_unit(clause, &stream.params))
        });
        pieces.extend(said.unwrap_or_else(|| self.named_pieces("action.named", &stream.name)));
        let mut phrase = SentencePart { pieces, streams: vec![connector.output.clone()], connectors: vec![id.clone()] };
        for link in links {
            phrase.streams.push(link.connector.output.clone());
            phrase.connectors.push(link.id.clone());
        }
        self.phrases.push(phrase);
    }

    /// The chain up to a link, from its start, with words before it.
    fn way(&mut self, chain: &Chain<'a>, end: usize, lead: &'static str) {
        let mut links = &chain.links[..end];
        if let Some((first, rest)) = links.split_first()
            && let SpokenConnector::Every(_) = first.does
        {
            let pieces = self.step_pieces("every", first);
            self.push(pieces, &links[..1], &[]);
            self.text(self.words.when.1);
            links = rest;
        } else {
            self.text(lead);
        }
        let used = self.start(&chain.start, links);
        links = &links[used..];
        if !matches!(chain.start, ChainStart::Any(..))
            && let Some((first, rest)) = links.split_first()
            && let Some(id) = tight(&first.does)
            && self.unless_held(links).is_none()
            && self.until_comes(links).is_none()
        {
            let pieces = self.step_pieces(id, first);
            self.push(pieces, &links[..1], &[]);
            links = rest;
        }
        // A group of a clause alone needs no word that it is over.
        if self.depth == 0 || !links.is_empty() {
            self.text(self.words.close);
        }
        self.steps(links);
    }

    fn named_pieces(&self, rule: &str, name: &str) -> Vec<Piece> {
        let name = quoted(name, self.language);
        self.pieces(grammar(self.language).told(rule), Some(&name))
    }

    /// A phrase that means these links and streams.
    fn push(&mut self, mut pieces: Vec<Piece>, links: &[ChainConnector<'a>], streams: &[&Id]) {
        if self.language == Language::Japanese {
            said_once(&mut pieces);
        }
        let streams = streams.iter().copied().chain(links.iter().map(|link| &link.connector.output));
        let connectors = links.iter().map(|link| link.id.clone()).collect();
        self.phrases.push(SentencePart { pieces, streams: streams.cloned().collect(), connectors });
    }

    /// Words after those that are told already, as a part of the phrase before them.
    fn text(&mut self, text: &str) {
        if text.is_empty() {
            return;
        }
        let piece = Piece::Text(text.to_owned());
        match self.phrases.last_mut() {
            // What opens a group belongs to the phrase that follows it only by sight.
            Some(last) => last.pieces.push(piece),
            None => self.phrases.push(SentencePart { pieces: vec![piece], ..SentencePart::default() }),
        }
    }

    fn capital(&mut self) {
        let first = self.phrases.iter_mut().flat_map(|phrase| &mut phrase.pieces).next();
        if let Some(Piece::Text(text)) = first
            && let Some(letter) = text.chars().next()
        {
            text.replace_range(..letter.len_utf8(), &letter.to_uppercase().to_string());
        }
    }
}

/// Whether the last link makes a brightness of something whose distance nobody made.
fn needs_distance(links: &[ChainConnector]) -> bool {
    let [.., last] = links else { return true };
    let made = links.len() > 1 && is_part(&links[links.len() - 2].does, ClausePart::Helper("ball_to_distance"));
    last.carried.is_ball() && !made
}

/// Leaves out the 間 that a unit says already: 1 時間 and not 1 時間間.
fn said_once(pieces: &mut [Piece]) {
    for at in 1..pieces.len() {
        let (before, after) = pieces.split_at_mut(at);
        let (Some(Piece::Number(number)), Some(Piece::Text(text))) = (before.last(), after.first_mut()) else {
            continue;
        };
        if number.unit.ends_with('間')
            && let Some(rest) = text.strip_prefix('間')
        {
            *text = rest.to_owned();
        }
    }
}
