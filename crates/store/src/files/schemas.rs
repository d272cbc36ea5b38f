//! The schemas in `schemas/` tell the truth: what is written keeps them, and what breaks them is refused.

use super::samples::{any_file, templates};
use super::{read, write_json, write_xml};
use behaviour::connectors::{self, Spec, Takes};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use std::fs::OpenOptions;
use std::io::Write;
use std::process::{Command, Stdio};

const JSON: &str = include_str!("../../schemas/rrp-behaviour-1.schema.json");
const JSON_PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/schemas/rrp-behaviour-1.schema.json");
const XSD: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/schemas/rrp-behaviour-1.xsd");
/// Files that xmllint is shown.
const SHOWN: usize = 100;

fn validator() -> jsonschema::Validator {
    let schema: serde_json::Value = serde_json::from_str(JSON).expect("the schema is JSON");
    assert!(jsonschema::meta::is_valid(&schema), "the schema is one of draft 2020-12");
    jsonschema::draft202012::new(&schema).expect("a schema")
}

fn keeps(validator: &jsonschema::Validator, text: &str) -> bool {
    serde_json::from_str(text).is_ok_and(|value| validator.is_valid(&value))
}

/// The lines of both schemas that name connectors, as the list of connectors has them.
fn lines_with_connectors() -> (Vec<String>, Vec<String>) {
    let words = |of: fn(&Spec) -> bool| {
        let words: Vec<String> = connectors::words(of).map(|word| format!("{word:?}")).collect();
        format!("\"type\": {{\"enum\": [{}]}}", words.join(", "))
    };
    let takes = |of: fn(&Spec) -> bool| format!("\"if\": {{\"properties\": {{{}}}}},", words(of));
    let json = vec![
        words(|_| true) + ",",
        takes(|spec| spec.takes.procedure.is_some()),
        takes(|spec| spec.takes.period.is_some()),
        takes(|spec| spec.takes.start.is_some()),
    ];
    let form = |spec: &Spec| match spec.takes {
        Takes { start: Some(_), .. } => "started",
        Takes { period: Some(_), .. } => "timed",
        Takes { procedure: Some(_), .. } => "procedural",
        Takes { .. } => "plain",
    };
    let element = |spec: &&Spec| format!("<xs:element name=\"{}\" type=\"{}\"/>", spec.word, form(spec));
    (json, connectors::ALL.iter().map(element).collect())
}

/// The text with `new` lines instead of the old ones: each in its place, the last place takes all that are left.
fn replaced(text: &str, is_old: impl Fn(&str) -> bool, new: &[String]) -> String {
    let places = text.lines().filter(|line| is_old(line.trim_start())).count();
    let (mut new, mut lines, mut place) = (new.iter(), Vec::new(), 0);
    for line in text.lines() {
        if !is_old(line.trim_start()) {
            lines.push(line.to_owned());
            continue;
        }
        place += 1;
        let blanks = &line[..line.len() - line.trim_start().len()];
        let many = if place == places { usize::MAX } else { 1 };
        lines.extend(new.by_ref().take(many).map(|one| format!("{blanks}{one}")));
    }
    lines.join("\n") + "\n"
}

/// Both schemas name the connectors as the list has them. `RRP_WRITE_SCHEMAS=1` writes them anew.
#[test]
fn the_schemas_know_every_connector() {
    let (json, xsd) = lines_with_connectors();
    let is_json = |line: &str| line.starts_with("\"type\": {\"enum\"") || line.starts_with("\"if\": {");
    let is_xsd = |line: &str| {
        let forms = ["plain", "timed", "procedural", "started"];
        line.starts_with("<xs:element") && forms.iter().any(|form| line.ends_with(&format!("type=\"{form}\"/>")))
    };
    let old = std::fs::read_to_string(XSD).expect("the schema");
    let (json, xsd) = (replaced(JSON, is_json, &json), replaced(&old, is_xsd, &xsd));
    if std::env::var_os("RRP_WRITE_SCHEMAS").is_some() {
        std::fs::write(JSON_PATH, &json).expect("written");
        std::fs::write(XSD, &xsd).expect("written");
        return;
    }
    assert!(json == JSON && xsd == old, "run this test with RRP_WRITE_SCHEMAS=1: the list of connectors changed");
}

#[test]
fn every_template_keeps_the_json_schema() {
    let validator = validator();
    for (name, text) in templates() {
        assert!(keeps(&validator, &text), "{name}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]
    #[test]
    fn whatever_is_written_keeps_the_json_schema(file in any_file()) {
        let text = write_json(&file);
        let value = serde_json::from_str(&text).unwrap();
        let broken: Vec<_> = validator().iter_errors(&value).map(|error| error.to_string()).collect();
        prop_assert!(broken.is_empty(), "{:?}\n{}", broken, text);
    }
}

/// The replacements that each break a file of one map, one sample and one note.
const BREAKS: [(&str, &str); 36] = [
    ("rrp-behaviour/1", "rrp-behaviour/2"),
    ("\"name\": \"Whole\",", ""),
    ("\"name\": \"Whole\",", "\"name\": \"Whole\", \"colour\": 1,"),
    ("\"id\": \"own\"", "\"id\": \"no id\""),
    ("\"engine\": {\"frame\": {\"frameMs\": 50}}", "\"engine\": \"fast\""),
    ("\"frameMs\": 50", "\"frameMs\": 1001"),
    ("\"params\": [\"x\"]", "\"params\": [\"2x\"]"),
    ("\"kind\": \"sensor\"", "\"kind\": \"sense\""),
    ("\"kind\": \"sensor\"", "\"kind\": \"sensor\", \"x\": 1"),
    ("\"priority\": 1", "\"priority\": 1.5"),
    ("\"priority\": 1", "\"holdMs\": -1"),
    ("\"type\": \"map\"", "\"type\": \"sieve\""),
    ("\"type\": \"map\"", "\"type\": \"merge\""),
    ("\"body\": \"x\"", "\"body\": \"x\", \"helper\": \"h\""),
    ("\"body\": \"x\"", "\"args\": [\"x\"]"),
    ("\"body\": \"x\"", "\"body\": 1"),
    ("\"periodMs\": 10", "\"periodMs\": 0"),
    (", \"periodMs\": 10", ""),
    ("\"inputs\": [\"a\"]", "\"inputs\": \"a\""),
    ("\"text\": \"t\"", "\"text\": null"),
    ("\"by\": \"Aiko\"", "\"by\": 1"),
    ("\"at\": 5", "\"at\": -5"),
    ("\"streams\": [\"a\"]", "\"streams\": [\"no id\"]"),
    ("\"title\": \"G\", ", ""),
    ("\"folded\": true", "\"folded\": \"yes\""),
    ("\"key\": 1", "\"key\": 10"),
    ("\"label\": \"Hello\", ", ""),
    ("\"device\": \"SayInput\", ", ""),
    ("\"params\": {\"speed\": 0.5}", "\"word\": \"x\""),
    ("\"stream\": \"a\", \"value\"", "\"stream\": \"no id\", \"value\""),
    ("\"value\": 7", "\"value\": 7, \"span\": true"),
    ("\"span\": true", "\"span\": 1"),
    ("\"span\": true", "\"asks\": true"),
    ("\"order\": {\"a\": 0}", "\"order\": {\"a\": \"0\"}"),
    ("\"y\": 2.5", "\"y\": \"2.5\""),
    ("\"y\": 2.5", "\"y\": 2.5, \"z\": 0"),
];

const WHOLE: &str = r#"{
  "format": "rrp-behaviour/1",
  "id": "own",
  "name": "Whole",
  "engine": {"frame": {"frameMs": 50}},
  "helpers": [{"name": "h", "params": ["x"], "body": "x"}],
  "streams": [
    {"id": "a", "kind": "sensor", "name": "A", "device": "RedBall", "priority": 1, "params": {"gain": 0.1}, "resources": ["head"]},
    {"id": "b", "kind": "ordinary", "name": "B"}
  ],
  "connectors": [
    {"id": "c", "type": "map", "inputs": ["a"], "output": "b", "body": "x"},
    {"id": "d", "type": "sample", "inputs": ["a"], "output": "b", "periodMs": 10}
  ],
  "notes": [{"id": "n", "text": "t", "by": "Aiko", "at": 5}],
  "groups": [{"id": "g", "title": "G", "streams": ["a"], "folded": true}],
  "pad": [{"key": 1, "label": "Hello", "device": "SayInput", "params": {"speed": 0.5}, "value": "hello", "asks": true}, {"key": 2, "label": "Ball", "stream": "a", "value": 7}, {"key": 3, "label": "Smile", "word": "smiles", "span": true}],
  "order": {"a": 0},
  "layout": {"a": {"x": 1, "y": 2.5}}
}"#;

#[test]
fn what_breaks_the_json_schema_is_refused_and_the_other_way_round() {
    let validator = validator();
    assert!(keeps(&validator, WHOLE) && read(WHOLE.as_bytes()).is_ok());
    for (right, wrong) in BREAKS {
        assert!(WHOLE.contains(right), "{right}");
        let text = WHOLE.replacen(right, wrong, 1);
        assert!(!keeps(&validator, &text), "the schema takes {wrong}");
        assert!(read(text.as_bytes()).is_err(), "the reader takes {wrong}");
    }
}

/// True if xmllint is here; else it is said by name that the XSD is not tried, and noted for `cargo xtask test`.
fn has_xmllint() -> bool {
    let here = Command::new("xmllint").arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok();
    if !here {
        let line = "the XSD of behaviour files (there is no xmllint; install libxml2-utils)";
        let _ = writeln!(std::io::stderr().lock(), "SKIPPED: {line}");
        if let Some(list) = std::env::var_os("RRP_SKIPPED_LIST")
            && let Ok(mut file) = OpenOptions::new().create(true).append(true).open(list)
        {
            let _ = writeln!(file, "{line}");
        }
    }
    here
}

/// Returns the complaint of xmllint about a file; none if it keeps the XSD.
fn xmllint(text: &str) -> Option<String> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("behaviour.xml");
    std::fs::write(&file, text).expect("written");
    let done =
        Command::new("xmllint").args(["--noout", "--nonet", "--schema", XSD]).arg(&file).output().expect("xmllint");
    (!done.status.success()).then(|| String::from_utf8_lossy(&done.stderr).into_owned())
}

#[test]
fn whatever_is_written_keeps_the_xsd() {
    if !has_xmllint() {
        return;
    }
    for (name, text) in templates() {
        let xml = write_xml(&read(text.as_bytes()).unwrap()).unwrap();
        assert_eq!(xmllint(&xml), None, "{name}");
    }
    let mut runner = TestRunner::deterministic();
    for _ in 0..SHOWN {
        let file = any_file().new_tree(&mut runner).unwrap().current();
        let xml = write_xml(&file).unwrap();
        assert_eq!(xmllint(&xml), None, "{xml}");
    }
}

#[test]
fn what_breaks_the_xsd_is_refused() {
    let xml = write_xml(&read(WHOLE.as_bytes()).unwrap()).unwrap();
    let breaks = [
        ("format=\"1\"", "format=\"2\""),
        ("name=\"Whole\"", ""),
        ("<helpers>", "<helpers/><helpers>"),
        ("<sensor id=\"a\"", "<sense id=\"a\""),
        ("id=\"b\"", "id=\"a\""),
        ("id=\"b\"", "id=\"no id\""),
        ("frame=\"50ms\"", "frame=\"50\""),
        ("period=\"10ms\"", ""),
        ("<map id=\"c\"", "<map colour=\"red\" id=\"c\""),
        ("args=\"x\"", "args=\"2x\""),
        ("at=\"5\"", "at=\"-5\""),
        ("streams=\"a\"", "streams=\"ä\""),
        ("folded=\"true\"", "folded=\"1\""),
        ("key=\"2\"", "key=\"0\""),
        ("label=\"Ball\"", ""),
        ("stream=\"a\" value", "stream=\"ä\" value"),
        ("span=\"true\"", "span=\"yes\""),
        ("y=\"2.5\"", "y=\"INF\""),
        ("<from stream=\"a\"/><body>", "<from stream=\"a\"/>text<body>"),
    ];
    let linted = has_xmllint();
    for (right, wrong) in breaks {
        assert!(xml.contains(right), "{right} in {xml}");
        let text = xml.replacen(right, wrong, 1);
        assert!(read(text.as_bytes()).is_err(), "the reader takes {wrong}");
        assert!(!linted || xmllint(&text).is_some(), "the XSD takes {wrong}");
    }
}
