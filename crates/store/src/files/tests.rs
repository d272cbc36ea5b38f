//! Files there and back, and files that nobody should have made.

use super::samples::{any_behaviour, any_file, any_text, templates};
use super::{FILE_MAX_BYTES, ImportMode, import, look, read, write_json, write_xml};
use behaviour::{Behaviour, BehaviourFile, Id, Kind, Record, RecordId, is_identifier, record_bytes};
use proptest::prelude::*;
use std::collections::BTreeMap;

const SMALL: &str = r#"{
  "format": "rrp-behaviour/1",
  "name": "Small",
  "helpers": [
    {"name": "near", "params": ["ball"], "body": "ball.x < 1"}
  ],
  "streams": [
    {"id": "ball", "kind": "sensor", "name": "Ball", "device": "RedBall"},
    {"id": "close", "kind": "ordinary", "name": "Close"}
  ],
  "connectors": [
    {"id": "c1", "type": "filter", "inputs": ["ball"], "output": "close", "helper": "near"}
  ],
  "layout": {
    "ball": {"x": 0, "y": 40}
  }
}
"#;

const SMALL_XML: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<behaviour format="1" name="Small">
  <helpers>
    <helper id="near" args="ball">ball.x &lt; 1</helper>
  </helpers>
  <streams>
    <sensor id="ball" name="Ball" device="RedBall"/>
    <stream id="close" name="Close"/>
  </streams>
  <connectors>
    <filter id="c1" to="close" helper="near"><from stream="ball"/></filter>
  </connectors>
  <layout>
    <at ref="ball" x="0" y="40"/>
  </layout>
</behaviour>
"#;

fn same(a: &BehaviourFile, b: &BehaviourFile) {
    // The text shows every bit of a float, which == does not: 0.0 equals -0.0.
    assert_eq!((a, write_json(a)), (b, write_json(b)));
}

#[test]
fn the_templates_are_written_as_they_are() {
    for (name, text) in templates() {
        assert_eq!(write_json(&read(text.as_bytes()).unwrap()), text, "{name}");
    }
    assert_eq!(write_json(&read(SMALL.as_bytes()).unwrap()), SMALL);
}

#[test]
fn json_and_xml_say_the_same() {
    let file = read(SMALL.as_bytes()).unwrap();
    assert_eq!(write_xml(&file).unwrap(), SMALL_XML);
    same(&read(SMALL_XML.as_bytes()).unwrap(), &file);
}

const MORE: &str = r#"{
  "format": "rrp-behaviour/1",
  "name": "More",
  "helpers": [
    {"name": "larger", "params": ["old", "now"], "body": "max(old, now)"}
  ],
  "streams": [
    {"id": "a", "kind": "sensor", "name": "A", "device": "HeadTouch"},
    {"id": "b", "kind": "ordinary", "name": "B"},
    {"id": "c", "kind": "ordinary", "name": "C"},
    {"id": "d", "kind": "ordinary", "name": "D"},
    {"id": "e", "kind": "ordinary", "name": "E"},
    {"id": "f", "kind": "ordinary", "name": "F"},
    {"id": "g", "kind": "ordinary", "name": "G"},
    {"id": "h", "kind": "ordinary", "name": "H"}
  ],
  "connectors": [
    {"id": "c1", "type": "distinct", "inputs": ["a"], "output": "b"},
    {"id": "c2", "type": "distinct", "inputs": ["a"], "output": "c", "body": "a.x"},
    {"id": "c3", "type": "scan", "inputs": ["a"], "output": "d", "body": "soFar.n + n", "args": ["soFar", "n"], "start": {"n": 0.0, "t": ["<", null]}},
    {"id": "c4", "type": "scan", "inputs": ["a"], "output": "e", "helper": "larger"},
    {"id": "c5", "type": "debounce", "inputs": ["a"], "output": "f", "periodMs": 5000},
    {"id": "c6", "type": "delay", "inputs": ["a"], "output": "g", "periodMs": 1},
    {"id": "c7", "type": "withLatest", "inputs": ["a", "b"], "output": "h", "body": "b"}
  ],
  "layout": {
    "a": {"x": 0, "y": 40}
  }
}
"#;

const MORE_XML: &str = r#"
    <distinct id="c1" to="b"><from stream="a"/></distinct>
    <distinct id="c2" to="c"><from stream="a"/><body>a.x</body></distinct>
    <scan id="c3" to="d" start="{&quot;n&quot;: 0.0, &quot;t&quot;: [&quot;&lt;&quot;, null]}"><from stream="a"/><body args="soFar n">soFar.n + n</body></scan>
    <scan id="c4" to="e" helper="larger"><from stream="a"/></scan>
    <debounce id="c5" to="f" period="5000ms"><from stream="a"/></debounce>
    <delay id="c6" to="g" period="1ms"><from stream="a"/></delay>
    <withLatest id="c7" to="h"><from stream="a"/><from stream="b"/><body>b</body></withLatest>
"#;

#[test]
fn connectors_beyond_the_thesis_are_written_and_imported_as_they_are() {
    let file = read(MORE.as_bytes()).unwrap();
    assert_eq!(write_json(&file), MORE);
    let xml = write_xml(&file).unwrap();
    assert!(xml.contains(MORE_XML), "{xml}");
    same(&read(xml.as_bytes()).unwrap(), &file);
    let records = file.records(|_| None).unwrap();
    let again = BehaviourFile::of(&records, &file.library().iter().collect::<Vec<_>>());
    assert_eq!(again.connectors, file.connectors);
    let made = import(&file, ImportMode::Restore, &Behaviour::default(), "Aiko", || Id::new("new").unwrap()).unwrap();
    let imported: BTreeMap<_, _> =
        made.changes.into_iter().flat_map(|change| change.edits).map(|edit| (edit.id, edit.after)).collect();
    assert_eq!(imported, records.records.into_iter().map(|(id, record)| (id, Some(record))).collect());
}

#[test]
fn a_connector_with_what_it_does_not_take_or_without_what_it_needs_is_refused() {
    let wrongs = [
        ("\"periodMs\": 5000", "\"body\": \"a\""),
        (", \"periodMs\": 5000", ""),
        ("\"periodMs\": 1}", "\"periodMs\": 0}"),
        ("\"output\": \"b\"}", "\"output\": \"b\", \"start\": 1}"),
        ("\"body\": \"b\"", "\"body\": \"b\", \"periodMs\": 1"),
    ];
    for (right, wrong) in wrongs {
        assert!(MORE.contains(right), "{right}");
        assert!(read(MORE.replacen(right, wrong, 1).as_bytes()).is_err(), "{wrong}");
    }
}

#[test]
fn whoever_knows_the_format_reads_what_is_written() {
    for (name, text) in templates() {
        let plain: BehaviourFile = serde_json::from_str(&text).unwrap();
        assert_eq!(plain, read(text.as_bytes()).unwrap(), "{name}");
    }
}

#[test]
fn the_cases_of_the_gold_suite_are_read_as_before() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/gold");
    let mut many = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let Ok(text) = std::fs::read_to_string(entry.unwrap().path().join("behaviour.json")) else { continue };
        let mut plain: BehaviourFile = serde_json::from_str(&text).unwrap();
        for stream in &mut plain.streams {
            stream.params = stream.params.take().filter(|params| !params.is_empty());
        }
        let mut params = plain.helpers.iter().flat_map(|helper| &helper.params);
        if let Some(reserved) = params.find(|name| !is_identifier(name)) {
            // The engine runs it; who brings it in is asked for another name.
            assert!(refused(text.as_bytes()).contains(&format!("“{reserved}” cannot be used in a body")));
            continue;
        }
        assert_eq!(plain, read(text.as_bytes()).unwrap());
        many += 1;
    }
    assert!(many >= 26);
}

/// A change of the small file that makes it wrong, the place of the fault and a part of its reason.
const WRONG: [(&str, &str, (u32, u32), &str); 36] = [
    ("\"rrp-behaviour/1\"", "\"rrp-behaviour/2\"", (2, 13), "not the format rrp-behaviour/1"),
    ("\"name\": \"Small\"", "\"name\": 7", (3, 11), "“name” must be a text"),
    ("  \"name\": \"Small\",\n", "", (1, 1), "“name” is missing"),
    ("\"name\": \"Small\"", "\"name\": \"Small\", \"colour\": 1", (3, 30), "“colour” is not known here"),
    ("\"name\": \"Small\"", "\"name\": \"Small\", \"name\": \"x\"", (3, 28), "“name” is there twice"),
    ("\"params\": [\"ball\"]", "\"params\": [\"if\"]", (5, 32), "“if” cannot be used in a body"),
    ("\"kind\": \"sensor\"", "\"kind\": \"sense\"", (8, 28), "not “sense”"),
    ("\"device\": \"RedBall\"", "\"device\": null", (8, 64), "“device” must be a text"),
    ("\"id\": \"close\"", "\"id\": \"ball\"", (9, 5), "“ball” is used twice"),
    ("\"id\": \"close\"", "\"id\": \"a b\"", (9, 12), "“a b” is no id"),
    ("\"device\": \"RedBall\"", "\"params\": {\"a\": 1, \"a\": 2}", (8, 78), "“a” is there twice"),
    ("\"device\": \"RedBall\"", "\"params\": {\"a\": 1e999}", (8, 70), "too large"),
    ("\"device\": \"RedBall\"", "\"params\": {\"a\": 9223372036854775808}", (8, 70), "too large"),
    ("\"device\": \"RedBall\"", "\"params\": {\"a\": 123456789012345678901}", (8, 70), "too large"),
    ("\"device\": \"RedBall\"", "\"params\": {\"a\": NaN}", (8, 70), "not an rrp program file"),
    ("\"device\": \"RedBall\"", "\"params\": []", (8, 64), "“params” must be an object"),
    ("\"device\": \"RedBall\"", "\"priority\": 0.5", (8, 66), "“priority” must be a whole number"),
    ("\"device\": \"RedBall\"", "\"holdMs\": -1", (8, 64), "must not be negative"),
    ("\"type\": \"filter\"", "\"type\": \"sieve\"", (12, 26), "There is no connector “sieve”"),
    ("\"inputs\": [\"ball\"]", "\"inputs\": \"ball\"", (12, 46), "“inputs” must be a list"),
    ("\"inputs\": [\"ball\"], ", "", (12, 5), "“inputs” is missing"),
    ("\"helper\": \"near\"", "\"helper\": \"near\", \"body\": \"1\"", (12, 85), "both a helper and a body"),
    ("\"helper\": \"near\"", "\"periodMs\": 5", (12, 87), "“filter” takes no periodMs"),
    ("\"helper\": \"near\"", "\"args\": [\"a\"]", (12, 83), "no body to use them"),
    ("\"type\": \"filter\"", "\"type\": \"sample\"", (12, 5), "from 1 to 3,600,000"),
    ("{\"x\": 0, \"y\": 40}", "{\"x\": 0}", (15, 13), "“y” must be a number"),
    ("{\"x\": 0, \"y\": 40}", "{\"x\": 0, \"y\": \"1\"}", (15, 27), "“y” must be a number"),
    (
        "\"ball\": {\"x\": 0, \"y\": 40}",
        "\"ball\": {\"x\": 0, \"y\": 4}, \"ball\": {\"x\": 1, \"y\": 4}",
        (15, 39),
        "twice",
    ),
    ("\"layout\": {", "\"order\": {\"q\": 1},\n  \"layout\": {", (14, 18), "no stream or connector “q”"),
    ("\"layout\": {", "\"layout\": [], \"x\": {", (14, 13), "“layout” must be an object"),
    ("\"name\": \"Small\"", "\"name\": \"Small\", \"engine\": \"fast\"", (3, 30), "The engine must be"),
    ("\"name\": \"Small\"", "\"name\": \"Small\", \"engine\": {\"frame\": {\"frameMs\": 0}}", (3, 40), "1 to 1000"),
    ("\"helpers\": [\n", "\"helpers\": [\n    7,\n", (5, 5), "Here should be a helper"),
    ("\"body\": \"ball.x < 1\"", "\"body\": \"\\ud800\"", (5, 50), "letters that JSON does not know"),
    ("\n}\n", "\n", (17, 1), "ends too early"),
    ("\n}\n", "\n}\n}", (18, 1), "not an rrp program file"),
];

fn check_faults(small: &str, wrongs: &[(&str, &str, (u32, u32), &str)]) {
    let mut astray = Vec::new();
    for (right, wrong, place, reason) in wrongs {
        assert!(small.contains(right), "{right}");
        let looked = look(small.replacen(right, wrong, 1).as_bytes());
        match looked.faults.iter().find(|fault| fault.reason.to_string().contains(reason)) {
            Some(fault) if (fault.line, fault.column) == *place && fault.reason.to_string().ends_with('.') => {}
            _ => astray.push(format!("{wrong}: {place:?} {reason} is not in {:?}", looked.faults)),
        }
        assert!(looked.file.is_none(), "{wrong}");
    }
    assert!(astray.is_empty(), "{}", astray.join("\n"));
}

#[test]
fn every_fault_is_told_with_its_place_and_what_to_do() {
    check_faults(SMALL, &WRONG);
}

#[test]
fn several_faults_are_told_at_once_from_top_to_bottom() {
    let text = SMALL.replace("\"sensor\"", "\"sense\"").replace("\"filter\"", "\"sieve\"").replace("40", "[]");
    let lines: Vec<u32> = look(text.as_bytes()).faults.iter().map(|fault| fault.line).collect();
    assert_eq!(lines, [8, 12, 15]);
}

#[test]
fn places_tell_where_everything_stands() {
    for (text, place) in [(SMALL, (12, 5)), (SMALL_XML, (11, 5))] {
        let places = look(text.as_bytes()).places;
        assert_eq!(places.get("c1"), Some(&place));
        assert_eq!(places.keys().collect::<Vec<_>>(), ["ball", "c1", "close", "near"]);
    }
}

const WRONG_XML: [(&str, &str, (u32, u32), &str); 32] = [
    ("<behaviour", "<!DOCTYPE behaviour>\n<behaviour", (2, 1), "DOCTYPE"),
    ("<behaviour", "<!DOCTYPE b [<!ENTITY a \"b\">]>\n<behaviour", (2, 1), "DOCTYPE"),
    ("<behaviour", "<?php 1 ?>\n<behaviour", (2, 1), "<?…?>"),
    ("<behaviour", "text<behaviour", (2, 1), "text outside"),
    ("name=\"Small\"", "name=\"&amp;&me;\"", (2, 34), "&me; stands for nothing"),
    ("ball.x &lt;", "&lol;ball.x &lt;", (4, 35), "&lol; stands for nothing"),
    ("ball.x &lt;", "&#0;", (4, 35), "&#0; stands for nothing"),
    ("ball.x &lt;", "&#x1B;", (4, 35), "&#x1B; stands for nothing"),
    ("ball.x &lt;", "&#xFFFE;", (4, 35), "stands for nothing"),
    ("ball.x &lt;", "&#x110000;", (4, 35), "stands for nothing"),
    ("name=\"Small\"", "name=\"&#0;\"", (2, 29), "&#0; stands for nothing"),
    ("name=\"Small\"", "name=\"a<b\"", (2, 30), "&lt;"),
    ("name=\"Small\"", "name=\"a&b\"", (2, 30), "&amp;"),
    ("name=\"Small\"", "name=\"a\" name=\"b\"", (2, 1), "there twice"),
    ("name=\"Small\"", "name=\"Small\" colour=\"red\"", (2, 36), "“colour” is not known"),
    ("format=\"1\" ", "format=\"1\"", (2, 22), "blank before name"),
    ("format=\"1\"", "format=\"2\"", (2, 12), "another format than 1"),
    (" format=\"1\"", "", (2, 1), "“format” is missing"),
    ("<streams>", "<rivers/><streams>", (6, 3), "<rivers> is not known"),
    ("<helpers>", "<helpers/><helpers>", (3, 13), "“helpers” is there twice"),
    ("<filter", "<sieve/><filter", (11, 5), "There is no connector “sieve”"),
    ("<from stream=\"ball\"/>", "<from/>", (11, 46), "needs a stream"),
    ("<from stream=\"ball\"/>", "<from stream=\"ball\">x</from>", (11, 66), "no text of its own"),
    ("<from stream=\"ball\"/>", "<from stream=\"ball\"/>;", (11, 67), "no text of its own"),
    ("x=\"0\"", "x=\"1e999\"", (14, 20), "too large"),
    ("x=\"0\"", "x=\"NaN\"", (14, 20), "must be a number"),
    ("x=\"0\"", "x=\"0x1F\"", (14, 20), "must be a number"),
    ("</behaviour>", "</behavior>", (16, 1), "no XML"),
    ("</behaviour>\n", "", (16, 1), "ends inside of <behaviour>"),
    ("</behaviour>", "</behaviour><behaviour/>", (16, 13), "after the end"),
    ("<?xml version=\"1.0\" encoding=\"UTF-8\"?>", "<?xml version=\"1.0\" encoding=\"latin1\"?>", (1, 1), "UTF-8"),
    (
        "<stream id=\"close\" name=\"Close\"/>",
        "<stream id=\"close\" name=\"Close\"><param/></stream>",
        (8, 37),
        "a name",
    ),
];

#[test]
fn every_fault_of_xml_is_told_with_its_place_and_what_to_do() {
    check_faults(SMALL_XML, &WRONG_XML);
}

fn id() -> Id {
    Id::new("h").expect("an id")
}

fn refused(bytes: &[u8]) -> String {
    read(bytes).expect_err("refused").to_string()
}

#[test]
fn what_is_too_much_is_refused() {
    let streams = |many: usize| {
        let all: Vec<_> = (0..many).map(|n| format!(r#"{{"id":"s{n}","kind":"ordinary","name":"S{n}"}}"#)).collect();
        SMALL.replace("\"streams\": [\n", &format!("\"streams\": [\n{},\n", all.join(",\n")))
    };
    assert!(read(streams(1_998).as_bytes()).is_ok());
    assert_eq!(
        refused(streams(1_999).as_bytes()),
        "Line 7, column 14: 2001 streams are too many: a file may have 2000. Split it."
    );
    let body = |many: usize| SMALL.replace("ball.x < 1", &"x".repeat(many));
    assert!(read(body(65_536).as_bytes()).is_ok());
    assert!(refused(body(65_537).as_bytes()).starts_with("Line 5, column 50: A text has 65537 bytes"));
    let padded = |many: usize| SMALL.to_owned() + &" ".repeat(many - SMALL.len());
    assert!(read(padded(FILE_MAX_BYTES).as_bytes()).is_ok());
    assert!(refused(padded(FILE_MAX_BYTES + 1).as_bytes()).contains("may have 8388608"));
    assert!(refused(b"").contains("empty") && refused(b"  \n").contains("Line 2, column 1: The file is empty"));
    assert!(refused(b"name: x").contains("begins with"));
    assert!(refused(b"{\n\"a\xff\":1}").starts_with("Line 2, column 3: This is no UTF-8"));
}

#[test]
fn a_file_with_more_things_than_the_rules_allow_is_refused_by_their_count() {
    let attributes: String = (0..180_000).map(|at| format!(" a{at}=\"\"")).collect();
    let element = SMALL_XML.replace("<helpers>", &format!("<helpers{attributes}>"));
    assert!(refused(element.as_bytes()).contains("more than 16 attributes"));
    let elements = SMALL_XML.replace("<helpers>", &format!("<helpers>{}", "<helper/>".repeat(110_000)));
    assert!(refused(elements.as_bytes()).contains("more things in it"));
    for (many, between) in [("1,".repeat(300_000), "[]"), (r#""a":1,"#.repeat(300_000), "{}")] {
        let (open, close) = between.split_at(1);
        let things = format!("{open}{}{close}", many.trim_end_matches(','));
        let json = SMALL.replace("\"RedBall\"", &things);
        assert!(refused(json.as_bytes()).contains("more things in it"));
    }
}

#[test]
fn of_very_many_faults_the_first_are_told() {
    let unknown: String = (0..20_000).map(|at| format!("\"u{at}\": 1, ")).collect();
    let looked = look(SMALL.replacen("\"name\"", &format!("{unknown}\"name\""), 1).as_bytes());
    assert_eq!((looked.file, looked.faults.len()), (None, 100));
}

#[test]
fn blanks_that_come_one_by_one_are_read_once() {
    let blanks = "&#32;".repeat(200_000);
    let spread = SMALL_XML.replacen("<helpers>", &format!("<helpers>{blanks}"), 1);
    assert!(read(spread.as_bytes()).is_ok());
    assert!(refused(spread.replacen(&blanks, &format!("{blanks}x"), 1).as_bytes()).contains("holds no text"));
}

#[test]
fn depth_ends_with_a_sentence() {
    for many in [9, 33, 127, 200_000] {
        let json = SMALL.replace("\"RedBall\"", &format!("{}{}", "[".repeat(many), "]".repeat(many)));
        assert!(read(json.as_bytes()).is_err(), "{many}");
        let xml = SMALL_XML.replace("<from", &format!("{}{}<from", "<a>".repeat(many), "</a>".repeat(many)));
        assert!(refused(xml.as_bytes()).contains("more than 8 deep"), "{many}");
    }
    let deep = SMALL
        .replace("\"device\": \"RedBall\"", &format!("\"params\": {{\"a\": {}{}}}", "[".repeat(40), "]".repeat(40)));
    assert!(refused(deep.as_bytes()).contains("more than 32 deep"));
    let open = SMALL.replace("\"RedBall\"", &"[".repeat(200_000));
    assert!(read(open.as_bytes()).is_err());
}

/// The case "note from a word processor": a vertical tab where Shift+Enter was pressed.
#[test]
fn control_characters_are_cleaned_on_the_way_in_and_no_xml_fails_by_them() {
    let noted = SMALL.replace(
        "  \"layout\"",
        "  \"notes\": [\n    {\"id\": \"n\", \"text\": \"First\\u000bthen\\u0007\"}\n  ],\n  \"layout\"",
    );
    let file = read(noted.replace("Small", "Sm\\u0001all").as_bytes()).unwrap();
    assert_eq!((file.notes[0].text.as_str(), file.name.as_str()), ("First\nthen", "Small"));
    let xml = write_xml(&file).unwrap();
    same(&read(xml.as_bytes()).unwrap(), &file);
    // A line end within a text of a procedure would break it.
    let body = SMALL.replace("ball.x < 1", "\\\"a\\u000bb\\u0000\\\"");
    assert_eq!(read(body.as_bytes()).unwrap().helpers[0].body, "\"a b\"");
    for (right, wrong) in [("name=\"Small\"", "name=\"Sm\u{1}all\""), ("ball.x &lt;", "ball.x \u{0}&lt;")] {
        same(&read(SMALL_XML.replace(right, wrong).as_bytes()).unwrap(), &read(SMALL.as_bytes()).unwrap());
    }
}

#[test]
fn what_another_program_saved_is_read_or_named() {
    let bom = [b"\xef\xbb\xbf", SMALL.as_bytes()].concat();
    same(&read(&bom).unwrap(), &read(SMALL.as_bytes()).unwrap());
    let little: Vec<u8> = SMALL.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = SMALL.encode_utf16().flat_map(u16::to_be_bytes).collect();
    for bytes in [[b"\xff\xfe", &little[..]].concat(), [b"\xfe\xff", &big[..]].concat(), little, big] {
        assert_eq!(refused(&bytes), "Line 1, column 1: This text is UTF-16. Save the file as UTF-8.");
    }
    let broken = SMALL.replace("Small", "Sm\nall");
    assert!(refused(broken.as_bytes()).contains("Put it into one line."));
}

proptest! {
    #[test]
    fn json_there_and_back_is_the_same_bit_for_bit(file in any_file()) {
        let text = write_json(&file);
        let again = read(text.as_bytes()).map_err(|fault| TestCaseError::fail(format!("{fault}\n{text}")))?;
        same(&again, &file);
        let plain: BehaviourFile = serde_json::from_str(&text).unwrap();
        same(&plain, &file);
    }

    #[test]
    fn xml_there_and_back_is_the_same_bit_for_bit(file in any_file()) {
        let text = write_xml(&file).map_err(|why| TestCaseError::fail(why.to_string()))?;
        let again = read(text.as_bytes()).map_err(|fault| TestCaseError::fail(format!("{fault}\n{text}")))?;
        same(&again, &file);
        prop_assert_eq!(write_xml(&again).unwrap(), text);
    }

    #[test]
    fn any_text_can_be_written_as_xml(mut file in any_file(), text: String) {
        file.name = text.chars().take(100).collect();
        file.notes.iter_mut().for_each(|note| note.text.clone_from(&text));
        file.helpers.iter_mut().for_each(|helper| helper.body.clone_from(&text));
        file.streams.iter_mut().for_each(|stream| stream.device = Some(text.clone()));
        let written = write_xml(&file).map_err(|why| TestCaseError::fail(why.to_string()))?;
        let again = read(written.as_bytes()).map_err(|fault| TestCaseError::fail(format!("{fault}\n{written}")))?;
        prop_assert_eq!(write_xml(&again).unwrap(), written);
    }

    #[test]
    fn nothing_that_a_behaviour_holds_is_lost((behaviour, library) in any_behaviour()) {
        let file = BehaviourFile::of(&behaviour, &library.iter().collect::<Vec<_>>());
        let records = library.iter().map(|helper| (RecordId::new(Kind::Helper, &id()), Record::Helper(helper.clone())));
        let all: Vec<_> = behaviour.records.clone().into_iter().chain(records).collect();
        let bound: usize = all.iter().map(|(id, record)| record_bytes(id, record)).sum();
        prop_assert!(serde_json::to_string(&all).unwrap().len() <= bound, "in messages and backups");
        for text in [write_json(&file), write_xml(&file).unwrap()] {
            prop_assert!(text.len() <= bound, "{} bytes of {bound}", text.len());
            prop_assert_eq!(&read(text.as_bytes()).unwrap().records(|_| None).unwrap(), &behaviour);
        }
    }

    #[test]
    fn broken_files_are_refused_without_a_panic(file in any_file(), at in 0.0..1.0, what in any_text(), xml: bool) {
        let mut bytes = if xml { write_xml(&file).unwrap() } else { write_json(&file) }.into_bytes();
        let at = (at * bytes.len() as f64) as usize;
        let cut = bytes[..at].to_vec();
        if !String::from_utf8_lossy(&bytes[at..]).trim().is_empty() {
            prop_assert!(read(&cut).is_err(), "a part of a file is no file");
        }
        let (line, column) = look(&cut).faults.first().map_or((1, 1), |fault| (fault.line, fault.column));
        prop_assert!(line >= 1 && column >= 1);
        bytes.splice(at..(at + what.len()).min(bytes.len()), what.bytes());
        if let Ok(again) = read(&bytes) {
            same(&read(write_json(&again).as_bytes()).unwrap(), &again);
        }
    }
}
