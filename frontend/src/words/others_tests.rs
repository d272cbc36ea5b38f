//! What the other rooms say reaches the page in English, and has its Japanese.

use super::complete_tests::{blocks, calls, folder, literal, numbered, read, sources};
use super::language::{speak, translated};
use std::collections::BTreeSet;

/// Sentences that only who starts a server, reads a drawing or the documentation sees.
const NOT_SHOWN: [&str; 8] = [
    "A connector of a run, by its place in the file.",
    "A certificate could not be made ({reason}). Use one of your own with --cert.",
    "A robot program with {streams} and {connectors}. Values flow from top to bottom.",
    "A stream of a run, by its place in the file.",
    "The certificate cannot be used ({reason}). See that --cert is the certificate as PEM, and --key its key.",
    "This rrp was built without Neo4j. Start it by cargo xtask serve -- --store and the address, or build it by cargo \
     build --release.",
    "{folder} has robots that are not those of the backup. Choose an empty folder with --data DIR.",
    "{name:width$}  {kind:6}  {}  Value: {}.",
];
/// Files whose sentences are no sentences of the page, or have their Japanese beside them.
const OTHER_FILES: [&str; 6] = ["/contract/", "/tests", "_tests", "/join/", "/http/stop/", "/samples.rs"];
/// The fewest words of a sentence.
const WORDS_MIN: usize = 3;

#[test]
fn every_sentence_of_the_other_rooms_is_said_in_japanese() {
    let known: BTreeSet<String> =
        blocks(&read(&folder().join("../static/ja.txt"))).iter().map(|(english, _)| blank(english)).collect();
    let shown: BTreeSet<String> = NOT_SHOWN.iter().map(|text| blank(text)).collect();
    let all: BTreeSet<String> = sentences().into_iter().chain(causes()).collect();
    assert!(all.len() > 150, "only {} sentences were found", all.len());
    let is_missing = |text: &&String| !known.contains(&blank(text)) && !shown.contains(&blank(text));
    let missing: Vec<_> = all.iter().filter(is_missing).map(String::as_str).collect();
    assert!(missing.is_empty(), "has no Japanese:\n{}", missing.join("\n"));
}

#[test]
fn a_robot_that_is_not_reached_says_why_in_japanese() {
    speak(read(&folder().join("../static/ja.txt")));
    let said = translated("opening the connection failed: nothing came within 2000 ms");
    assert_eq!(said, "接続に失敗しました：2000 ミリ秒の間、応答がありませんでした");
    assert_eq!(
        translated("logging in failed: the login is refused: no"),
        "ログインに失敗しました：ログインが断られました：no"
    );
}

/// A text whose holes have no names.
fn blank(text: &str) -> String {
    let mut parts = text.split('{');
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |made, part| made + "{}" + part.split_once('}').map_or(part, |(_, rest)| rest))
}

/// Every sentence of the rooms from which the page hears.
fn sentences() -> Vec<String> {
    let rooms = ["behaviour", "engine", "nao", "protocol", "qi", "robot", "server", "simulation", "store"];
    let files = rooms.iter().flat_map(|room| sources(&folder().join(format!("../crates/{room}/src"))));
    files.flat_map(|(path, source)| if is_other(&path) { Vec::new() } else { sentences_in(&source) }).collect()
}

fn is_other(path: &str) -> bool {
    OTHER_FILES.iter().any(|part| path.contains(part))
}

fn sentences_in(source: &str) -> Vec<String> {
    let code = without_tests_and_remarks(source);
    let (mut found, mut rest) = (Vec::new(), code.as_str());
    while let Some(at) = rest.find('"') {
        let (text, after) = literal(&rest[at + 1..]);
        if is_sentence(&text) {
            found.push(numbered(&text));
        }
        rest = after;
    }
    found
}

fn without_tests_and_remarks(source: &str) -> String {
    let code = source.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    // A quotation mark as a letter begins no text.
    lines.collect::<Vec<_>>().join("\n").replace("'\"'", "' '")
}

fn is_sentence(text: &str) -> bool {
    let begins = text.starts_with(|first: char| first.is_uppercase() || "“{<".contains(first));
    begins && text.ends_with(['.', '?']) && !text.contains('\n') && text.split(' ').count() >= WORDS_MIN
}

/// Why a robot is not reached, in the words of its protocol.
fn causes() -> Vec<String> {
    let source = read(&folder().join("../crates/qi/src/error.rs"));
    let stages = source.split("to.write_str(match self {").nth(1).and_then(|rest| rest.split("})").next()).unwrap();
    let stages = stages.split("=> ").skip(1).filter_map(|arm| Some(literal(arm.strip_prefix('"')?).0));
    let causes = source.split("pub enum ConnectError {").nth(1).and_then(|rest| rest.split("\n}\n").next()).unwrap();
    let endings = source.split("pub enum LinkEnding {").nth(1).and_then(|rest| rest.split("\n}\n").next()).unwrap();
    let said = [calls(causes, "#[error("), calls(endings, "#[error(")].concat();
    let has_words = |text: &String| blank(text).contains(char::is_alphabetic);
    stages.chain(said.into_iter().map(|text| numbered(&text)).filter(has_words)).collect()
}
