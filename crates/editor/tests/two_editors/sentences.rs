//! Scenes of sentences: a program is read as sentences, its numbers and choices are changed where they say them, and a typed
//! sentence is added as one.

use crate::known::{BALLS, Known, program};
use crate::server::id;
use crate::table::{AIKO, BEN, Table};
use behaviour::{Behaviour, Connector, Helper, Id, Place, Stream, StreamKind, Unit, Value, ValueType};
use editor::graph::{Ghost, GhostConnector, GhostStream};
use editor::numbers::with_number;
use sentences::{Draft, Language, Lexicon, LiteralPlace, Number, Piece, SentenceChoice, TextReading};

/// The sentences that a program is read as.
fn told(behaviour: &Behaviour, language: Language) -> Vec<sentences::Sentence> {
    let helpers = robot::shipped_helpers();
    let helpers: Vec<&Helper> = helpers.iter().collect();
    let types = behaviour::infer(behaviour, &helpers, &Known);
    let unit = |id: &Id| match types.get(id) {
        Some(ValueType::Number { unit: Some(unit), .. }) if *unit != Unit::Fraction => Some(unit.symbol().to_owned()),
        _ => None,
    };
    sentences::explain(behaviour, &helpers, &unit, language)
}

fn reads(table: &Table) -> Vec<String> {
    told(table.program(), Language::English).iter().map(ToString::to_string).collect()
}

/// The pieces of the first sentence.
fn pieces(table: &Table) -> Vec<Piece> {
    let first = told(table.program(), Language::English).remove(0);
    first.phrases.into_iter().flat_map(|phrase| phrase.pieces).collect()
}

fn number(table: &Table) -> Number {
    let found =
        pieces(table).into_iter().find_map(|piece| if let Piece::Number(number) = piece { Some(number) } else { None });
    found.expect("it has a number")
}

fn choice(table: &Table, text: &str) -> SentenceChoice {
    let is_it = |choice: &SentenceChoice| choice.text == text;
    let found = pieces(table)
        .into_iter()
        .find_map(|piece| if let Piece::Choice(choice) = piece { Some(choice).filter(is_it) } else { None });
    found.expect("it has that choice")
}

/// Reads a typed text as the page reads it.
fn read(table: &Table, text: &str, language: Language) -> TextReading {
    let helpers = robot::shipped_helpers();
    let helpers: Vec<&Helper> = helpers.iter().collect();
    sentences::read_speech(text, language, Lexicon::of(language), &helpers, Some(table.program()))
}

/// A draft as a part of the graph that nobody added yet; its new streams stand in a row.
fn ghost(draft: &Draft) -> Ghost {
    let name = |at: usize| draft.streams[at].existing.clone().unwrap_or_else(|| id(&format!("draft-{at}")));
    let new = (0..draft.streams.len()).filter(|at| draft.streams[*at].existing.is_none());
    let stream = |at: usize| {
        let from = &draft.streams[at];
        let (resources, priority, hold_ms) = (None, None, None);
        let (device, params) = (from.device.clone(), from.params.clone());
        let stream =
            Stream { kind: from.kind, name: from.name.clone(), device, params, order: 0, resources, priority, hold_ms };
        GhostStream {
            id: name(at),
            stream,
            place: Place { x: 900.0 + 300.0 * at as f64, y: 900.0 },
            doubtful: from.doubtful,
        }
    };
    let leads = |from: &sentences::DraftConnector| {
        let inputs = from.inputs.iter().map(|at| name(*at)).collect();
        let connector = Connector { operation: from.operation.clone(), inputs, output: name(from.output), order: 0 };
        GhostConnector { connector, doubtful: from.doubtful }
    };
    Ghost { streams: new.map(stream).collect(), connectors: draft.connectors.iter().map(leads).collect() }
}

/// Aiko types this, and adds it once nothing is in doubt; the new sentences.
fn adds(table: &mut Table, text: &str, language: Language) -> Vec<String> {
    let before = told(table.program(), language).len();
    let reading = read(table, text, language);
    assert!(reading.is_whole(), "{text} is in doubt: {:?}", reading.doubts);
    table.gesture(AIKO, |editor, op| editor.put_ghost(op, ghost(&reading.draft)));
    assert_eq!(table.editor(BEN).confirmed(), table.program(), "both have it");
    told(table.program(), language).split_off(before).iter().map(ToString::to_string).collect()
}

/// The devices of all actions, with how they follow.
fn trackers(table: &Table) -> Vec<Option<String>> {
    let actions = table.program().streams_in_order().into_iter().filter(|(_, one)| one.kind == StreamKind::Actuator);
    actions.map(|(_, one)| one.params.get("mode").and_then(Value::as_text).map(str::to_owned)).collect()
}

const FAR: &str = "When the red ball is at least 0.5 m away, the head follows it.";
const CLOSE: &str = "Otherwise the whole body follows it.";

#[test]
fn a_sentence_says_what_happens_and_its_number_is_changed_in_it() {
    let mut table = Table::knowing(BALLS);
    assert_eq!(reads(&table), [FAR, CLOSE]);
    let before = table.program().clone();
    let number = number(&table);
    assert_eq!((number.text.as_str(), number.value, number.step), ("0.5 m", 0.5, 0.05));
    let LiteralPlace::Body { connector, start, end } = number.at else { panic!("{:?}", number.at) };
    let operation = table.connector(connector.as_str()).operation;
    let turned = with_number(&operation, &(start..end), 0.7 * number.scale).expect("it stands there");
    table.operates(AIKO, connector.as_str(), turned);
    assert_eq!(reads(&table)[0], FAR.replace("0.5", "0.7"));
    assert_eq!(
        table.place("Distance"),
        before.place(&id("distance")).expect("it is placed"),
        "the graph does not move"
    );
    table.undo(AIKO);
    assert_eq!((table.program(), reads(&table)), (&before, vec![FAR.to_owned(), CLOSE.to_owned()]));
}

#[test]
fn a_choice_is_changed_where_the_sentence_says_it() {
    let mut table = Table::knowing(BALLS);
    let head = choice(&table, "head");
    assert!(head.options.iter().any(|option| option.value == "WholeBody" && option.words == "whole body"), "{head:?}");
    let LiteralPlace::Param { stream, param } = head.at else { panic!("{:?}", head.at) };
    table.sets(stream.as_str(), |mut seen| {
        seen.params.insert(param, Value::text("WholeBody"));
        seen
    });
    assert_eq!(reads(&table)[0], FAR.replace("the head", "the whole body"));
    table.undo(AIKO);
    assert_eq!(reads(&table)[0], FAR);
}

#[test]
fn a_typed_sentence_is_shown_and_added_as_one() {
    let mut table = Table::knowing(BALLS);
    let typed = "When the head is toched, the eyes turn green.";
    let reading = read(&table, typed, Language::English);
    let [doubt] = &reading.doubts[..] else { panic!("{:?}", reading.doubts) };
    assert_eq!(
        (&typed[doubt.range.clone()], doubt.suggestions.first().map(String::as_str)),
        ("toched", Some("touched"))
    );
    assert!(!reading.is_whole(), "nothing is guessed");
    let mended = typed.replace("toched", "touched");
    let whole = read(&table, &mended, Language::English);
    assert_eq!(ghost(&whole.draft).streams.len(), 3, "so many are shown before they are added");
    assert_eq!(adds(&mut table, &mended, Language::English), [mended]);
    assert_eq!((table.names().len(), table.editor(AIKO).several.len()), (9, 3), "they are chosen");
    table.undo(AIKO);
    assert_eq!(table.program(), &program(BALLS), "one undo takes all of it back");
}

#[test]
fn what_is_said_in_other_words_is_understood_or_said_to_be_impossible() {
    let mut table = Table::knowing(BALLS);
    let added = adds(&mut table, "say 'well done' whenever somebody pats your head", Language::English);
    assert_eq!(added, ["When the head is touched, the robot says “well done”."]);
    let reading = read(&table, "When the child cries, wave.", Language::English);
    let why = reading.doubts.first().and_then(|doubt| doubt.why.clone()).unwrap_or_default();
    assert!(why.starts_with("The robot cannot notice crying.") && !reading.is_whole(), "{reading:?}");
}

#[test]
fn several_lines_are_sentences_and_a_vague_word_shows_its_number() {
    let mut table = Table::knowing(BALLS);
    let typed = "When the head is touched, wave. When I approach, say hello.";
    let reading = read(&table, typed, Language::English);
    let [vague] = &reading.vague[..] else { panic!("{:?}", reading.vague) };
    assert_eq!((vague.value, vague.unit, &typed[vague.range.clone()]), (1.0, "m", "approach"));
    let mut said = typed.to_owned();
    said.replace_range(vague.range.clone(), &vague.said(0.8));
    assert_eq!(said, "When the head is touched, wave. When I come closer than 0.8 m, say hello.");
    let added = adds(&mut table, &said, Language::English);
    let close = "When the nearest person is nearer than 0.8 m, the robot says “hello”.";
    assert_eq!(added, ["When the head is touched, the robot waves.", close]);
}

#[test]
fn a_polite_sentence_is_added_as_it_is_meant() {
    let mut table = Table::knowing(BALLS);
    let added = adds(&mut table, "Please wave at everyone you know!", Language::English);
    assert_eq!((added, table.names().len()), (vec!["When a known face is seen, the robot waves.".to_owned()], 9));
}

#[test]
fn a_japanese_sentence_is_read_too() {
    let mut table = Table::knowing(BALLS);
    let first = told(table.program(), Language::Japanese)[0].to_string();
    assert_eq!(first, "赤いボールが 0.5 m 以上離れているとき、頭で追いかけます。");
    let typed = "頭に手が触れたとき、目が緑に光ります。";
    assert_eq!(sentences::language_of(typed), Language::Japanese);
    assert_eq!(adds(&mut table, typed, Language::Japanese).len(), 1);
    assert_eq!(table.names().len(), 8);
}

#[test]
fn the_walkthrough_is_one_sentence() {
    let mut table = Table::with(Behaviour::default());
    let added = adds(&mut table, "If the red ball is closer than 60 cm, follow it with your head.", Language::English);
    assert_eq!(added, ["When the red ball is nearer than 60 cm, the head follows it."]);
    assert_eq!(trackers(&table), [Some("Head".to_owned())]);
}

#[test]
fn the_create_task_is_one_sentence_or_two() {
    let typed = [
        "If the red ball is closer than 60 cm, follow it with your whole body, otherwise follow it with your head.",
        "When the red ball is nearer than 60 cm, the whole body follows it. Otherwise the head follows it.",
    ];
    for typed in typed {
        let mut table = Table::with(Behaviour::default());
        let added = adds(&mut table, typed, Language::English);
        let close = "When the red ball is nearer than 60 cm, the whole body follows it.";
        assert_eq!(added, [close, "Otherwise the head follows it."], "{typed}");
        assert_eq!(trackers(&table), ["WholeBody", "Head"].map(|mode| Some(mode.to_owned())), "{typed}");
        table.undo(AIKO);
        assert_eq!(table.program(), &Behaviour::default(), "one undo takes all of it back");
    }
}
