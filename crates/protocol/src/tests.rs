//! Tests of the whole table: every request travels as it is documented, and `PROTOCOL.md` says what there is.

use crate::request::wire_name;
use crate::{
    AnyAnswer, AnyRequest, Ask, Event, Handler, ListQuery, Message, Refused, RequestRow, SearchPlace, request,
};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

#[test]
fn every_request_travels_as_its_example_says() {
    for row in AnyRequest::TABLE {
        let text = row.example_json();
        let read: AnyRequest = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(read.row().name, row.name);
        let written = serde_json::to_string(&read).unwrap();
        assert_eq!(serde_json::from_str::<AnyRequest>(&written).unwrap(), read, "{written}");
        let asked = Ask::new(3, read);
        assert_eq!(serde_json::from_str::<Ask>(&serde_json::to_string(&asked).unwrap()).unwrap(), asked);
    }
}

#[test]
fn every_request_has_a_name_a_doc_and_an_answer_of_the_table() {
    let names: BTreeSet<_> = AnyRequest::TABLE.iter().map(|row| row.name).collect();
    assert!(names.len() == AnyRequest::TABLE.len() && names.len() > 60, "{names:?}");
    let answers: BTreeSet<_> = AnyAnswer::TABLE.iter().map(|(name, _)| *name).collect();
    let asked: BTreeSet<_> = AnyRequest::TABLE.iter().map(|row| row.answer.trim_start_matches("answer::")).collect();
    // Two that are no message of their own: nothing, and either of two.
    let others = BTreeSet::from(["Unanswered", "Newer"]);
    assert_eq!(asked.difference(&answers).copied().collect::<BTreeSet<_>>(), others);
    let by_two = BTreeSet::from(["Missed"]);
    assert_eq!(answers.difference(&asked).copied().collect::<BTreeSet<_>>(), by_two, "an answer to nothing");
    assert!(AnyRequest::TABLE.iter().all(|row| row.doc.trim().ends_with(['.', ']'])));
}

#[test]
fn an_ask_is_plain_json() {
    let text = r#"{"ask":3,"request":{"is":"open","behaviour":"abc"}}"#;
    let ask: Ask = serde_json::from_str(text).unwrap();
    assert!(matches!(ask.request, AnyRequest::Open(_)));
    assert_eq!(serde_json::to_string(&ask).unwrap(), text);
}

#[test]
fn a_press_says_which_stop_its_person_knew() {
    let text = r#"{"ask":3,"stops":7000001,"request":{"is":"runs"}}"#;
    let ask: Ask = serde_json::from_str(text).unwrap();
    assert_eq!(ask, Ask { stops: Some(7_000_001), ..Ask::new(3, request::Runs {}) });
    assert_eq!(serde_json::to_string(&ask).unwrap(), text);
    for (text, stops) in [
        (r#"{"answer":{"ask":3,"answer":{"stopped":{"stops":7000002}}}}"#, Some(7_000_002)),
        (r#"{"answer":{"ask":3,"answer":{"runs":{"runs":[],"stops":7000003}}}}"#, Some(7_000_003)),
        (r#"{"event":{"runs":{"runs":[],"stops":7000004}}}"#, Some(7_000_004)),
        (r#"{"answer":{"ask":3,"answer":"done"}}"#, None),
    ] {
        let message: Message = serde_json::from_str(text).unwrap();
        assert_eq!((message.stops(), serde_json::to_string(&message).unwrap().as_str()), (stops, text));
    }
}

#[test]
fn a_list_may_be_asked_for_in_few_words() {
    let ask: Ask = serde_json::from_str(r#"{"ask":1,"request":{"is":"list"}}"#).unwrap();
    assert_eq!(ask.request, request::List { query: ListQuery::default() }.into());
    let text = r#"{"ask":1,"request":{"is":"list","query":{"place":"bin","words":"ball","most":10}}}"#;
    let AnyRequest::List(request::List { query }) = serde_json::from_str::<Ask>(text).unwrap().request else {
        panic!()
    };
    assert_eq!((query.place, query.words.as_str(), query.most), (SearchPlace::Bin, "ball", 10));
}

#[test]
fn what_the_server_says_is_named_from_outside() {
    let no = Refused::Change(behaviour::Refusal::NameTaken("Ball".into()));
    let said = [
        (Message::Answer { ask: 3, answer: AnyAnswer::Done }, r#"{"answer":{"ask":3,"answer":"done"}}"#),
        (Message::No { ask: Some(3), no }, r#"{"no":{"ask":3,"no":{"change":{"nameTaken":"Ball"}}}}"#),
        (Message::No { ask: None, no: Refused::TooFast }, r#"{"no":{"no":"tooFast"}}"#),
        (Event::ProgramsChanged.into(), r#"{"event":"programsChanged"}"#),
    ];
    for (message, text) in said {
        assert_eq!(serde_json::to_string(&message).unwrap(), text);
        assert_eq!(serde_json::from_str::<Message>(text).unwrap(), message);
    }
}

/// A documentation as one line, without the brackets of links.
fn line(doc: &str) -> String {
    let doc = doc.trim().replace("[`", "`").replace("`]", "`").replace("crate::", "");
    doc.replace('|', "\\|")
}

/// The page about the protocol.
fn page() -> String {
    let mut page = String::from(
        "# The protocol between page and server\n\nWritten by `RRP_WRITE_PROTOCOL=1 cargo test -p protocol`; a test compares it with \
         the code.\n\nA client sends `{\"ask\": 3, \"request\": {\"is\": …}}` with a number of its choice, first of all \
         `hello`. `stops` beside them is the newest Stop of which it was told, so that what was pressed before a Stop moves no \
         robot after it. The server answers `{\"answer\": {\"ask\": 3, \"answer\": {NAME: …}}}` or refuses by `{\"no\": {\"ask\": 3, \
         \"no\": …}}`. What it tells unasked is `{\"event\": {NAME: …}}`. More records of a large answer follow as \
         `{\"records\": …}`. `()` is the answer `\"done\"`; what has no answer can still be refused.\n",
    );
    let mut handlers: BTreeMap<Handler, Vec<&RequestRow>> = BTreeMap::new();
    AnyRequest::TABLE.iter().for_each(|row| handlers.entry(row.handler).or_default().push(row));
    for (handler, rows) in handlers {
        write!(page, "\n## Requests: {handler:?}\n\n| request | least role | answer | what it does | example |\n|---|---|---|---|---|\n")
            .unwrap();
        for row in rows {
            let answer = match row.answer.trim_start_matches("answer::") {
                "Unanswered" => "none".to_owned(),
                "Newer" => "`missed` or `opened`".to_owned(),
                "()" => "`()`".to_owned(),
                name => format!("`{}`", wire_name(name)),
            };
            let (name, role, doc) = (row.wire_name(), row.role, line(row.doc));
            writeln!(page, "| `{name}` | {role:?} | {answer} | {doc} | `{}` |", row.example_json()).unwrap();
        }
    }
    for (title, table) in [("Answers", AnyAnswer::TABLE), ("Events", Event::TABLE)] {
        write!(page, "\n## {title}\n\n| name | what it says |\n|---|---|\n").unwrap();
        for (name, doc) in table {
            let name = if *name == "()" { "done".to_owned() } else { wire_name(name) };
            writeln!(page, "| `{name}` | {} |", line(doc)).unwrap();
        }
    }
    page
}

#[test]
fn the_page_about_the_protocol_says_what_there_is() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/PROTOCOL.md");
    let page = page();
    if std::env::var_os("RRP_WRITE_PROTOCOL").is_some() {
        std::fs::write(path, &page).unwrap();
    }
    let is = std::fs::read_to_string(path).unwrap_or_default();
    assert!(is == page, "PROTOCOL.md is not what the code says: RRP_WRITE_PROTOCOL=1 cargo test -p protocol");
}
