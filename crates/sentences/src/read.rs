//! From typed sentences to a graph.

mod build;
mod clauses;
mod doubts;
mod draft;
mod matcher;
mod meaning;
mod names;
mod parse;
mod ranges;
mod spoken;
mod tree;

pub use draft::{Doubt, Draft, DraftConnector, DraftStream, TextReading, Understood, VagueNumber};

use crate::Language;
use crate::clauses::CONVERSIONS;
use crate::speech::Lexicon;
use crate::test::Comparison;
use crate::token::{Placed, SentenceToken, tokens};
use behaviour::{Behaviour, Helper, Params, StreamKind, connectors, look_same};
use build::{FedAction, GraphBuilder, StreamSource};
use doubts::Repaired;
use names::NameGiver;
use std::ops::Range;
use tree::TokenSpan;

/// The longest text that is read, in characters.
pub const TEXT_MAX_CHARS: usize = 1_000;

/// Words by which a sentence begins before it has three words.
const LEADS: [&str; 6] = ["when", "whenever", "every", "if", "otherwise", "once"];
/// Around names: how they begin and end.
const QUOTES: [(char, char); 3] = [('“', '”'), ('"', '"'), ('「', '」')];
/// By which Japanese shows that something happens when something else does.
const LEADS_JA: [&str; 5] = ["とき", "たら", "ごとに", "それ以外", "場合"];

/// Whether somebody seems to type a sentence and no name: it begins with “when” or the like, has three words, or a
/// 「とき」.
#[must_use]
pub fn looks_like_sentence(text: &str) -> bool {
    let mut words = text.split_whitespace();
    let first = words.next().unwrap_or_default().to_lowercase();
    let leads = LEADS.contains(&first.as_str()) && text.trim_start().len() > first.len();
    leads || words.nth(1).is_some() || LEADS_JA.iter().any(|lead| text.contains(lead))
}

/// In which language a text is typed: that of its letters. Names in quotes are names in either language, and who begins
/// with “when” goes on in English.
#[must_use]
pub fn language_of(text: &str) -> Language {
    let first = text.split_whitespace().next().unwrap_or_default().to_lowercase();
    let is_japanese = |c: char| matches!(c as u32, 0x3040..=0x30ff | 0x3400..=0x9fff | 0xff66..=0xff9d);
    let says = outside_quotes(text).any(is_japanese);
    if says && !LEADS.contains(&first.as_str()) { Language::Japanese } else { Language::English }
}

/// The letters that stand in no quotes; quotes that nobody closed are none.
fn outside_quotes(text: &str) -> impl Iterator<Item = char> {
    let mut rest = text;
    std::iter::from_fn(move || {
        loop {
            let c = rest.chars().next()?;
            let after = &rest[c.len_utf8()..];
            let closing = QUOTES.iter().find(|(open, _)| *open == c).map(|(_, close)| *close);
            match closing.and_then(|close| after.split_once(close)) {
                Some((_, behind)) => rest = behind,
                None => {
                    rest = after;
                    return Some(c);
                }
            }
        }
    })
}

/// Reads one or several sentences. At most the first 1,000 characters are read. `helpers` are those of the library, which
/// are meant by their names in quotes. `behaviour` is what the graph would be added to: its streams are meant by their
/// names in quotes, and no name is given twice.
///
/// Where words are not understood, the reading has doubts with suggestions, and the draft is the best guess.
#[must_use]
pub fn read(text: &str, language: Language, helpers: &[&Helper], behaviour: Option<&Behaviour>) -> TextReading {
    let end = text.char_indices().nth(TEXT_MAX_CHARS).map_or(text.len(), |(at, _)| at);
    let known = &text[..end];
    let repaired = doubts::repaired(known, tokens(known, language), language);
    reading_of(repaired, text, end, language, helpers, behaviour, None)
}

/// Tells what was read, of the first `end` bytes of a text. With a lexicon, what makes no sense is in doubt, and that says why.
fn reading_of(
    repaired: Repaired,
    text: &str,
    end: usize,
    language: Language,
    helpers: &[&Helper],
    behaviour: Option<&Behaviour>,
    lexicon: Option<&Lexicon>,
) -> TextReading {
    let Repaired { told, tokens, mut doubts } = repaired;
    let mut builder = GraphBuilder::new(behaviour, language);
    told.iter().for_each(|sentence| builder.sentence(sentence));
    doubts.extend(builder.unmeant.iter().map(|span| Doubt {
        range: bytes(&tokens, span),
        suggestions: Vec::new(),
        why: None,
    }));
    if let Some(lexicon) = lexicon {
        doubts.extend(senseless(&builder, &tokens, lexicon));
    }
    if end < text.len() {
        doubts.push(Doubt { range: end..text.len(), suggestions: Vec::new(), why: None });
    }
    let mut reading = drafted(&builder, &tokens, NameGiver::new(language, behaviour), behaviour);
    let missing = builder.nodes.iter().filter(|node| match &node.source {
        StreamSource::Missing(_) => true,
        StreamSource::Made(does, ..) => does.helper().is_some_and(|name| !is_helper(name, helpers)),
        StreamSource::Sense(..) | StreamSource::Existing(_) => false,
    });
    let missing = missing.map(|node| &node.span).chain(builder.acts.iter().filter_map(|act| {
        let is_there = |name: &String| {
            behaviour.is_some_and(|behaviour| behaviour.streams().any(|(_, s)| look_same(&s.name, name)))
        };
        (act.device.is_none() && !act.name.as_ref().is_some_and(is_there)).then_some(&act.span)
    }));
    doubts.extend(missing.map(|span| Doubt { range: bytes(&tokens, span), suggestions: Vec::new(), why: None }));
    doubts.sort_by_key(|doubt| doubt.range.start);
    doubts.dedup_by(|one, other| one.range == other.range);
    reading.doubts = doubts;
    reading
}

/// Reads what somebody says in their own words: sentences as [`crate::explain`] tells them are read as exactly that, all
/// others by the words of `lexicon`. Bounds, `helpers` and `behaviour` are those of [`read`].
///
/// Nothing is guessed: a word that nobody knows is in doubt, and so is what is missing.
#[must_use]
pub fn read_speech(
    text: &str,
    language: Language,
    lexicon: &Lexicon,
    helpers: &[&Helper],
    behaviour: Option<&Behaviour>,
) -> TextReading {
    let end = text.char_indices().nth(TEXT_MAX_CHARS).map_or(text.len(), |(at, _)| at);
    let known = &text[..end];
    let exact = doubts::exact(known, tokens(known, language), language)
        .filter(|exact| !exact.told.iter().any(tree::ToldSentence::is_guess));
    if let Some(exact) = exact {
        let told = reading_of(exact, text, end, language, helpers, behaviour, Some(lexicon));
        let is_impossible = |told: &TextReading| told.doubts.iter().all(|doubt| doubt.why.is_some());
        if !told.is_whole() && is_impossible(&told) {
            return told;
        }
        if told.is_whole() {
            // A word without its number is shown with the number that it got.
            let spoken = read_words(text, end, language, lexicon, behaviour);
            return if spoken.is_whole() && !spoken.vague.is_empty() { spoken } else { told };
        }
    }
    read_words(text, end, language, lexicon, behaviour)
}

/// Reads the first `end` bytes of what somebody says in their own words.
fn read_words(
    text: &str,
    end: usize,
    language: Language,
    lexicon: &Lexicon,
    behaviour: Option<&Behaviour>,
) -> TextReading {
    let known = &text[..end];
    let speech = crate::speech::understood(known, language, lexicon);
    let tokens: Vec<Placed> = speech
        .places
        .iter()
        .map(|range| Placed { token: SentenceToken::Sign(' '), range: range.clone(), is_doubtful: false })
        .collect();
    let mut doubts: Vec<Doubt> = speech
        .doubts
        .into_iter()
        .map(|(range, suggestions, why)| Doubt {
            range,
            suggestions,
            why: why.filter(|why| !why.is_empty()).map(str::to_owned),
        })
        .collect();
    if end < text.len() {
        doubts.push(Doubt { range: end..text.len(), suggestions: Vec::new(), why: None });
    }
    let mut reading = TextReading::default();
    if doubts.is_empty() {
        let mut builder = GraphBuilder::new(behaviour, language);
        let mut making = spoken::GraphMaking::new(&mut builder, language);
        making.rules(&speech.rules);
        let failed = making.doubts;
        doubts.extend(failed.iter().map(|span| Doubt {
            range: bytes(&tokens, span),
            suggestions: Vec::new(),
            why: None,
        }));
        doubts.extend(senseless(&builder, &tokens, lexicon));
        if builder.acts.is_empty() && doubts.is_empty() {
            doubts.push(Doubt { range: text.len()..text.len(), suggestions: Vec::new(), why: None });
        }
        if doubts.is_empty() {
            reading = drafted(&builder, &tokens, NameGiver::new(language, behaviour), behaviour);
        }
    }
    doubts.sort_by_key(|doubt| doubt.range.start);
    doubts.dedup_by(|one, other| one.range == other.range);
    reading.texts = speech.texts;
    let told = |(range, word): (Range<usize>, crate::speech::meaning::VagueWord)| {
        let (comparison, value, unit) = word.bound;
        VagueNumber::of(known, range, (value, unit), comparison == Comparison::Less, word.moves, language)
    };
    reading.vague = speech.vague.into_iter().map(told).collect();
    reading.doubts = doubts;
    reading
}

/// Doubts about what makes no sense, each with the reason.
fn senseless(builder: &GraphBuilder, tokens: &[Placed], lexicon: &Lexicon) -> Vec<Doubt> {
    let doubt = |(span, why): &(TokenSpan, &'static str)| Doubt {
        range: bytes(tokens, span),
        suggestions: Vec::new(),
        why: lexicon.gap(why).map(str::to_owned),
    };
    builder.senseless.iter().map(doubt).collect()
}

/// Whether the library has a helper, or starts with it.
fn is_helper(name: &str, helpers: &[&Helper]) -> bool {
    CONVERSIONS.contains(&name) || helpers.iter().any(|helper| helper.name == name)
}

/// The bytes of tokens.
fn bytes(tokens: &[Placed], span: &TokenSpan) -> Range<usize> {
    let first = tokens.get(span.start).or(tokens.last()).map_or(0, |placed| placed.range.start);
    let last = tokens.get(span.end.max(span.start + 1) - 1).or(tokens.last()).map_or(first, |placed| placed.range.end);
    first..last.max(first)
}

fn drafted(
    builder: &GraphBuilder,
    tokens: &[Placed],
    mut names: NameGiver,
    behaviour: Option<&Behaviour>,
) -> TextReading {
    let mut reading = TextReading::default();
    let stream_names = names.of_nodes(builder);
    let is_doubtful =
        |span: &TokenSpan| tokens.get(span.clone()).unwrap_or_default().iter().any(|placed| placed.is_doubtful);
    // Words that mean several parts raise a doubt about the last one of them.
    let last_of = |span: &TokenSpan| builder.nodes.iter().rposition(|node| node.span == *span);
    for (at, (node, name)) in builder.nodes.iter().zip(&stream_names).enumerate() {
        let doubtful = is_doubtful(&node.span) && last_of(&node.span) == Some(at);
        let mut stream = DraftStream {
            existing: None,
            kind: StreamKind::Ordinary,
            name: name.clone(),
            device: None,
            params: Params::new(),
            doubtful,
        };
        let mut understood = Understood { range: bytes(tokens, &node.span), streams: vec![at], connectors: Vec::new() };
        match &node.source {
            StreamSource::Sense(device, params) => {
                (stream.kind, stream.device) = (StreamKind::Sensor, Some(device.name.to_owned()));
                stream.params = params.clone();
            }
            StreamSource::Existing(id) => {
                stream.existing = Some(id.clone());
                stream.kind =
                    behaviour.and_then(|behaviour| behaviour.stream(id)).map_or(stream.kind, |known| known.kind);
            }
            StreamSource::Missing(_) => stream.doubtful = true,
            StreamSource::Made(does, inputs, measured) => {
                let spec = connectors::with_meaning(does.meaning());
                let from = inputs.iter().map(|input| stream_names[*input].as_str());
                let args = spec.map_or_else(Vec::new, |spec| spec.argument_names(from));
                if let Some(operation) = does.operation(&args, *measured) {
                    understood.connectors.push(reading.draft.connectors.len());
                    let connector = DraftConnector { operation, inputs: inputs.clone(), output: at, doubtful };
                    reading.draft.connectors.push(connector);
                }
            }
        }
        reading.draft.streams.push(stream);
        understand(&mut reading.understood, understood);
    }
    let mut streams: Vec<usize> = Vec::new();
    for act in &builder.acts {
        let doubtful = is_doubtful(&act.span);
        let output = match act.same_as {
            Some(same) => streams[same],
            None => {
                reading.draft.streams.push(acting(act, &mut names, behaviour, doubtful));
                reading.draft.streams.len() - 1
            }
        };
        streams.push(output);
        let operation = connectors::to_action().with(());
        let (connector, range) = (reading.draft.connectors.len(), bytes(tokens, &act.span));
        reading.draft.connectors.push(DraftConnector { operation, inputs: vec![act.input], output, doubtful });
        understand(&mut reading.understood, Understood { range, streams: vec![output], connectors: vec![connector] });
    }
    reading.understood.sort_by_key(|understood| understood.range.start);
    reading
}

/// The stream of an action.
fn acting(act: &FedAction, names: &mut NameGiver, behaviour: Option<&Behaviour>, doubtful: bool) -> DraftStream {
    let name = names.of_act(act);
    let known = || behaviour?.streams().find(|(_, stream)| look_same(&stream.name, &name)).map(|(id, _)| id.clone());
    let existing = if act.device.is_none() { known() } else { None };
    let device = act.device.as_ref();
    DraftStream {
        doubtful: doubtful || (device.is_none() && existing.is_none()),
        existing,
        kind: StreamKind::Actuator,
        name,
        device: device.map(|(device, ..)| device.name.to_owned()),
        params: device.map_or_else(Params::new, |(_, params, _)| params.clone()),
    }
}

/// Adds what words mean to what the same words mean already.
fn understand(all: &mut Vec<Understood>, one: Understood) {
    match all.iter_mut().find(|known| known.range == one.range) {
        Some(known) => {
            known.streams.extend(one.streams);
            known.connectors.extend(one.connectors);
        }
        None => all.push(one),
    }
}

#[cfg(test)]
mod tests {
    use super::language_of;
    use crate::Language;

    #[test]
    fn the_letters_outside_of_names_tell_the_language() {
        for text in
            ["When the head", "When “距離” has a value, the head follows it.", "when 距離 is less than 40", "“距離"]
        {
            let is_open = text == "“距離";
            let language = if is_open { Language::Japanese } else { Language::English };
            assert_eq!(language_of(text), language, "{text}");
        }
        for text in ["頭に触れたとき", "「Distance」が 40 より小さいとき", "“Distance” が届いたとき"]
        {
            assert_eq!(language_of(text), Language::Japanese, "{text}");
        }
    }
}
