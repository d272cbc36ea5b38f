//! The table of the second language says all that the page says.

use super::language::speak;
use super::{NameLanguage, connector_word, deed, device, found_robot, helper_name_of, listed, start};
use crate::conflicts::words::{saved_test, while_you};
use crate::history::words::people_and_you;
use crate::page::words::{no_connection, step_title};
use crate::robots::words::{condition, stop as stop_word};
use crate::teaching::words::{tour_action, tour_helper, tour_number, tour_sense, tour_start, tour_stop, tour_test};
use behaviour::{connectors, labels};
use phrase::Phrased;
use robot::{Condition, JOINTS};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The most Latin letters in a row that need no reason.
const LATIN_MAX: usize = 3;
/// Words that are the same in Japanese: keys, names, and words of procedures.
const LATIN: [&str; 49] = [
    "Android",
    "Chrome",
    "Ctrl",
    "DOCTYPE",
    "Edge",
    "English",
    "Enter",
    "Firefox",
    "JSON",
    "JavaScript",
    "LyingBelly",
    "PageDown",
    "PageUp",
    "Pepper",
    "Safari",
    "Shift",
    "Sitting",
    "Standing",
    "Stop",
    "Wi-Fi",
    "Windows",
    "actuator",
    "behind",
    "break",
    "check",
    "continue",
    "data",
    "engine",
    "event",
    "false",
    "frame",
    "frameMs",
    "iPad",
    "iPhone",
    "jsonl",
    "listen",
    "local",
    "name",
    "null",
    "open",
    "ordinary",
    "params",
    "proxy",
    "replay",
    "sensor",
    "serve",
    "soFar",
    "true",
    "value",
];

/// Keys of what the page never shows: lines for who reads files, starts a server, or mends a robot's protocol.
const NOT_SHOWN: [&str; 23] = [
    "BackupMisfit.Others",
    "BadAddress.",
    "BadId.",
    "FlawKind.",
    "Malformed.",
    "NoCertificate.",
    "NotAllowed.",
    "QiError.Address",
    "QiError.Busy",
    "QiError.NoCandidate",
    "QiError.NoMember",
    "QiError.NoMethod",
    "QiError.Remote",
    "QiError.Unexpected",
    "QiError.Unfit",
    "QiError.Call",
    "Reason.FrameLength",
    "Reason.Input",
    "Reason.O",
    "StoreError.WithoutNeo4j",
    "TableFault.",
    "TypeMismatch.",
    "Unkept.Unwritable",
];
/// The rooms whose sentences reach the page.
const ROOMS: [&str; 14] = [
    "behaviour",
    "editor",
    "engine",
    "nao",
    "past",
    "phrase",
    "protocol",
    "qi",
    "recording",
    "report",
    "robot",
    "server",
    "simulation",
    "store",
];

/// The English of every key.
type Catalogue = BTreeMap<String, String>;

#[test]
fn every_sentence_has_its_japanese_and_nothing_else_is_there() {
    let (page, others, words) = (of_the_page(), of_others(), of_the_catalogue());
    assert!(page.len() > 1_000, "only {} sentences of the page were found", page.len());
    assert!(others.len() > 300, "only {} sentences of others were found", others.len());
    assert!(words.len() > 300, "only {} words were found", words.len());
    let wanted: Catalogue = page.into_iter().chain(others).chain(words).chain(stop()).collect();
    let wrong = faults(&wanted, &blocks(&read(&folder().join("../static/ja.txt"))));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_two_keys_have_the_same_number() {
    let mut numbers = BTreeMap::new();
    for key in of_the_page().into_keys().chain(of_others().into_keys()).chain(of_the_catalogue().into_keys()) {
        let other = numbers.insert(phrase::key_of(&key), key.clone());
        assert!(other.is_none_or(|other| other == key), "{key} needs another name");
    }
}

#[test]
fn what_is_wrong_with_a_catalogue_is_found() {
    let wanted = [("start", "Start"), ("left", "{name} left"), ("stop", "Stop")];
    let wanted: Catalogue = wanted.map(|(key, text)| (key.to_owned(), text.to_owned())).into();
    let table = "# A remark.\n\nstart\nStart now\n\nleft\n{nama} さん\n\ngone\nなし\n\nstart\n開始\n";
    let right = [
        "has two blocks: start",
        "has no Japanese: stop",
        "has other holes: left",
        "has no source: gone",
        "is not all Japanese (Start): start",
    ];
    assert_eq!(faults(&wanted, &blocks(table)), right);
    let calls = "say!(\n k: \"a {b}\", b) + said!(l: \"c\\\"d \\\n   e\") + phrase!(\n \"F.g\", \"{x:?} {}\", y)";
    assert_eq!(keyed_calls(calls, "say!("), [("k".to_owned(), "a {b}".to_owned())]);
    assert_eq!(keyed_calls(calls, "said!("), [("l".to_owned(), "c\"d e".to_owned())]);
    assert_eq!(quoted_pairs(calls, "phrase!("), [("F.g".to_owned(), "{x} {0}".to_owned())]);
    let derived = "#[derive(Debug, Phrased)]\npub enum Way {\n    /// One.\n    #[error(\"{} of {0}\", .0.a())]\n    One(u8),\n}\n";
    assert_eq!(of_variants(derived), [("Way.One".to_owned(), "{0} of {0}".to_owned())]);
    let report = "said! {\n    \"report\";\n    day: \"Day\";\n    as_if: \"As if: \";\n}\n";
    let pairs = [("report.day", "Day"), ("report.as_if", "As if: ")];
    assert_eq!(under_one_name(report), pairs.map(|(key, text)| (key.to_owned(), text.to_owned())));
    assert_eq!(in_rows("sentences! {\n    // Two\n    one: \"1\";\n}\n\"3\""), [("one".to_owned(), "1".to_owned())]);
}

#[test]
fn whole_sentences_are_japanese() {
    speak(read(&folder().join("../static/ja.txt")));
    let (before, after) = while_you(true, "Yuki さん", saved_test);
    assert_eq!(
        before + "Near" + &after,
        "オフラインの間に、Yuki さんが「Near」の条件を保存しました。あなたの変更はここにあります。"
    );
    let edited = labels::undo_of(false, &labels::edit(behaviour::connectors::map::SPEC.phrase()));
    let done = [labels::add("Near"), edited, labels::program_renamed(), labels::connect("Near")];
    let deeds = done.map(|label| deed(&label).whole());
    assert_eq!(listed(deeds), "Near を追加、「変換 を編集」を元に戻す、プログラムの名前を変更、変更：Near をつなぐ");
    let moved = labels::undo_of(false, &labels::moved());
    assert_eq!(step_title("元に戻す", Some(&moved)), "元に戻す：位置を移動");
    assert_eq!(deed(&"Add Near".into()).whole(), "変更：Add Near", "what an older version wrote");
    assert_eq!(people_and_you(&["Yuki".to_owned(), "Ben".to_owned()], true), "Yuki さん、Ben さん と あなた");
    assert_eq!(found_robot("", "NAO", None), "相手は NAO です。");
    assert!(no_connection(2, true).ends_with("送られます。ロボットは動き続けます。停止は別の経路で試みます。"));
    let hot = vec!["LKneePitch".to_owned(), "HeadYaw".to_owned()];
    let lights = condition(&Condition { battery: Some(50), plugged: Some(true), hot, ..Condition::default() });
    let said = listed(lights.iter().map(|(_, words)| words));
    assert_eq!(said, "バッテリー 50 %、充電中、熱い関節：左のひざ、首（左右）");
}

/// The tour says what stands on what is to be pressed, and the names that streams are given.
#[test]
fn the_tour_names_what_stands_on_the_page() {
    speak(read(&folder().join("../static/ja.txt")));
    let quoted = |name: &str| format!("「{name}」");
    let helper = robot::shipped_helpers().into_iter().find(|helper| helper.name == "distance").unwrap();
    assert!(tour_helper().contains(&quoted(&helper_name_of(&helper))), "{}", tour_helper());
    let argument = behaviour::argument_names([NameLanguage::Page.helper("distance").as_str()]).pop().unwrap();
    assert_eq!(argument, "距離");
    assert!(tour_test().contains(&format!("「{argument} <」")), "{}", tour_test());
    let filter = connector_word(&connectors::filter::SPEC);
    assert!(tour_test().contains(&quoted(filter)) && tour_number().contains(&quoted(filter)));
    let label =
        |name: &str| robot::sensors().chain(robot::actuators()).find(|one| one.name == name).map(device).unwrap();
    assert!(tour_sense().contains(&quoted(label("RedBall"))) && tour_action().contains(&quoted(label("Tracker"))));
    assert!(tour_start().contains(&quoted(start())) && tour_stop().contains(&quoted(stop_word())));
}

fn faults(wanted: &Catalogue, table: &[(String, String)]) -> Vec<String> {
    let (mut said, mut wrong) = (Catalogue::new(), Vec::new());
    for (key, japanese) in table {
        if said.contains_key(key) {
            wrong.push(format!("has two blocks: {key}"));
        } else {
            said.insert(key.clone(), japanese.clone());
        }
    }
    let is_shown = |key: &String| !NOT_SHOWN.iter().any(|start| key.starts_with(start));
    let missing = wanted.keys().filter(|key| is_shown(key) && !said.contains_key(*key));
    wrong.extend(missing.map(|key| format!("has no Japanese: {key}")));
    let other =
        said.iter().filter(|(key, japanese)| wanted.get(*key).is_some_and(|english| holes(english) != holes(japanese)));
    wrong.extend(other.map(|(key, _)| format!("has other holes: {key}")));
    let stale = said.keys().filter(|key| !wanted.contains_key(*key));
    wrong.extend(stale.map(|key| format!("has no source: {key}")));
    for (key, japanese) in &said {
        let foreign = latin(japanese).into_iter().filter(|word| !LATIN.contains(&word.as_str()));
        wrong.extend(foreign.map(|word| format!("is not all Japanese ({word}): {key}")));
    }
    wrong
}

/// The key and the text of each block.
pub(super) fn blocks(table: &str) -> Vec<(String, String)> {
    let lines = |block: &str| {
        let mut lines = block.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
        Some((lines.next()?.to_owned(), lines.next().unwrap_or_default().to_owned()))
    };
    table.split("\n\n").filter_map(lines).collect()
}

fn holes(text: &str) -> BTreeSet<&str> {
    phrase::holes(text).into_iter().filter(|hole| !hole.trim().is_empty()).collect()
}

/// The runs of Latin letters outside of holes that are too long for Japanese.
fn latin(text: &str) -> Vec<String> {
    let outside: String = text.split('{').enumerate().map(|(at, part)| after_hole(at, part)).collect();
    let words = outside.split(|letter: char| !letter.is_ascii_alphabetic());
    words.filter(|word| word.len() > LATIN_MAX).map(str::to_owned).collect()
}

fn after_hole(at: usize, part: &str) -> String {
    let rest = if at == 0 { part } else { part.split_once('}').map_or("", |(_, rest)| rest) };
    format!(" {rest}")
}

/// The sentences of the page by their keys.
fn of_the_page() -> Catalogue {
    // Beside `en` in `src/words` stands how sentences are made and tried.
    let is_said = |path: &str| !path.contains("src/words/") || path.contains("src/words/en");
    let all = sources(&folder().join("src")).into_iter().filter(|(path, _)| is_said(path));
    all.map(|(_, source)| source.split("#[cfg(test)]").next().unwrap_or_default().to_owned())
        .flat_map(|source| {
            let pairs = [
                keyed_calls(&source, "say!("),
                keyed_calls(&source, "said!("),
                quoted_pairs(&source, "self.keyed("),
                quoted_pairs(&source, "phrase!("),
            ];
            [in_rows(&source), pairs.concat()].concat()
        })
        .collect()
}

/// The sentences of the rooms from which the page hears, by their keys.
fn of_others() -> Catalogue {
    sources_of_others()
        .into_iter()
        .flat_map(|source| {
            let labels = if source.contains("labels! {") { labels(&source) } else { Vec::new() };
            [
                quoted_pairs(&source, "phrase!("),
                quoted_pairs(&source, "word!("),
                of_variants(&source),
                labels,
                under_one_name(&source),
            ]
            .concat()
        })
        .filter(|(key, _)| !key.starts_with('$'))
        .collect()
}

fn sources_of_others() -> Vec<String> {
    let files = ROOMS.iter().flat_map(|room| sources(&folder().join(format!("../crates/{room}/src"))));
    let is_product = |path: &str| !path.ends_with("tests.rs") && !path.contains("/tests/");
    let code =
        |(_, source): (String, String)| source.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default().to_owned();
    files.filter(|(path, _)| is_product(path)).map(code).collect()
}

/// Whether something is said around its holes.
fn has_words(text: &str) -> bool {
    text.split('{').enumerate().any(|(at, part)| after_hole(at, part).contains(char::is_alphabetic))
}

/// The names of holes as they travel: those without one have their number.
fn travelling(text: &str) -> String {
    let (mut made, mut rest, mut nth) = (String::new(), text, 0);
    while let Some((before, after)) = rest.split_once('{') {
        made.push_str(before);
        if let Some(after) = after.strip_prefix('{') {
            made.push('{');
            rest = after;
            continue;
        }
        let Some((hole, after)) = after.split_once('}') else { break };
        let marks = hole.len() - hole.trim_start_matches(['^', '.']).len();
        let (marks, name) = hole.split_at(marks);
        let name = name.split(':').next().unwrap_or_default();
        if name.is_empty() {
            made.push_str(&format!("{{{marks}{nth}}}"));
            nth += 1;
        } else {
            made.push_str(&format!("{{{marks}{name}}}"));
        }
        rest = after;
    }
    (made + rest).replace("}}", "}")
}

/// The rows of every `sentences!`.
fn in_rows(source: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for rows in source.split("sentences! {").skip(1) {
        let mut rest = rows.split("\n}").next().unwrap_or_default();
        while let Some(at) = rest.find('"') {
            let name = rest[..at].trim_end().trim_end_matches(':');
            let name = name.rsplit([' ', '\n']).next().unwrap_or_default().to_owned();
            let (text, after) = literal(&rest[at + 1..]);
            found.push((name, text));
            rest = after;
        }
    }
    found
}

/// The rows of every `said!`, which begins with what all of its keys begin with.
fn under_one_name(source: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for rows in source.split("said! {\n    \"").skip(1) {
        let (of, mut rest) = literal(rows);
        rest = rest.split("\n}").next().unwrap_or_default();
        while let Some((name, text)) = rest.split_once(": \"") {
            let (english, after) = literal(text);
            found.push((format!("{of}.{}", name.trim_start_matches([';', '\n', ' '])), english));
            rest = after;
        }
    }
    found
}

/// The keys and texts with which a macro is called: `say!(key: "text"`.
fn keyed_calls(source: &str, name: &str) -> Vec<(String, String)> {
    let pair = |call: &str| {
        let (key, text) = call.trim_start().split_once(": \"")?;
        let is_key = key.chars().all(|letter| letter.is_alphanumeric() || letter == '_');
        is_key.then(|| (key.to_owned(), literal(text).0))
    };
    source.split(name).skip(1).filter_map(pair).collect()
}

/// The keys and texts with which something is called: `phrase!("key", "text"`.
fn quoted_pairs(source: &str, name: &str) -> Vec<(String, String)> {
    let pair = |call: &str| {
        let (key, rest) = literal(call.trim_start().strip_prefix('"')?);
        let text = rest.strip_prefix(',')?.trim_start().strip_prefix('"')?;
        Some((key, travelling(&literal(text).0)))
    };
    source.split(name).skip(1).filter_map(pair).collect()
}

/// The sentences of the variants of enums that derive them.
fn of_variants(source: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for part in source.split("Phrased)]").skip(1) {
        let body = part.split("\n}\n").next().unwrap_or_default();
        let Some((_, after)) = body.split_once("enum ") else { continue };
        let name = after.split(' ').next().unwrap_or_default();
        for variant in after.split("#[error(").skip(1) {
            let Some(text) = variant.trim_start().strip_prefix('"') else { continue };
            let (text, rest) = literal(text);
            let Some((_, rest)) = rest.split_once(")]\n") else { continue };
            let variant: String = rest.trim_start().chars().take_while(|letter| letter.is_alphanumeric()).collect();
            found.push((format!("{name}.{variant}"), travelling(&text)));
        }
    }
    found
}

/// The labels of changes: rows of a name, a key and its English.
fn labels(source: &str) -> Vec<(String, String)> {
    let row = |line: &str| {
        let mut texts = line.split('"');
        let (key, english) = (texts.nth(1)?, texts.nth(1)?);
        (key.starts_with("label.") && line.ends_with(';')).then(|| (key.to_owned(), english.to_owned()))
    };
    source.lines().filter_map(row).collect()
}

/// A text up to its closing quotation mark, and what comes after.
pub(super) fn literal(source: &str) -> (String, &str) {
    let (mut text, mut rest) = (String::new(), source.chars());
    while let Some(letter) = rest.next() {
        match letter {
            '"' => break,
            '\\' => match rest.next() {
                Some('\n') => rest = rest.as_str().trim_start().chars(),
                Some(escaped) => text.push(escaped),
                None => break,
            },
            letter => text.push(letter),
        }
    }
    (text, rest.as_str())
}

/// What Stop says, which is plain HTML.
fn stop() -> Catalogue {
    let page = read(&folder().join("../static/index.html"));
    let form = page.split("<form id=\"stop-form\"").nth(1).and_then(|form| form.split("</form>").next()).unwrap();
    let parts: Vec<&str> = form.split('"').collect();
    let attributes = parts.chunks(2).filter_map(|pair| Some((pair[0].split_whitespace().last()?, *pair.get(1)?)));
    let key = |name: &str| match name {
        "aria-label=" => Some("label".to_owned()),
        "title=" => Some("title".to_owned()),
        name => name.strip_prefix("data-").map(|key| key.trim_end_matches('=').to_owned()),
    };
    let within = |text: &str, mark: &str| {
        text.split(mark).nth(1).and_then(|rest| rest.split('>').nth(1)?.split('<').next()).unwrap().to_owned()
    };
    let own = [
        ("button", within(form, "<span")),
        ("loading", within(&page, "id=\"loading\"")),
        ("unopened", within(&page, "id=\"unopened\"")),
        ("scriptless", within(&page, "<noscript>")),
    ];
    let said: Vec<(String, String)> =
        attributes.filter_map(|(name, text)| Some((key(name)?, text.to_owned()))).collect();
    assert!(said.len() > 8, "{said:?}");
    let own = own.map(|(key, text)| (key.to_owned(), text));
    said.into_iter().chain(own).map(|(key, text)| (format!("stop.{key}"), text)).collect()
}

/// Signs of units, which most languages share.
const SIGNS: [&str; 5] = ["", "%", "m/s", "rad", "rad/s"];
/// The colours of boxes in rooms.
const BOXES: [&str; 4] = ["blue", "green", "grey", "red"];
/// A kind of body that is called by more than its name.
const BODY: &str = "NAO without hands (H21)";

/// Sentences and words about senses, actions and connectors, of helpers, templates and tasks.
fn of_the_catalogue() -> Catalogue {
    let labels = robot::sensors().chain(robot::actuators()).flat_map(robot::Device::labels);
    let labels = labels.filter(|label| !SIGNS.contains(&label.english));
    let mut all: Catalogue = labels.map(|label| (label.key, label.english.to_owned())).collect();
    all.extend(connectors::ALL.iter().flat_map(|spec| of_connector(spec)));
    all.extend(robot::shipped_helpers().iter().flat_map(of_helper));
    all.extend(JOINTS.iter().map(|joint| joint_key(joint)));
    let parts = robot::Resource::ALL.map(robot::Resource::word);
    let named = |kind: &str, names: &[&str]| -> Catalogue {
        names.iter().map(|name| (format!("{kind}.{name}"), (*name).to_owned())).collect()
    };
    all.extend([named("part", &parts), named("color", &BOXES), named("body", &[BODY])].into_iter().flatten());
    all.extend(templates());
    all.extend(exercises());
    all
}

fn of_connector(spec: &connectors::Spec) -> Catalogue {
    let named = spec.output_names().filter(|label| has_words(label.english));
    let labels = [spec.called_by_people(), spec.in_brief()].into_iter().chain(named);
    let labels = labels.chain(spec.period_called()).chain(spec.start_called());
    let mut all: Catalogue = labels.map(|label| (label.key, label.english.to_owned())).collect();
    let mut put =
        |place: &str, text: &str| drop(all.insert(format!("connector.{}.{place}", spec.word), text.to_owned()));
    put("word", spec.word);
    put("says", spec.says);
    put("does", spec.help.does);
    put("when", spec.help.when);
    for (nth, example) in spec.help.examples.iter().enumerate() {
        put(&format!("example{nth}"), example.title);
    }
    let lanes = spec.help.examples.iter().flat_map(|example| example.given.iter().chain([&example.then]));
    all.extend(lanes.map(|lane| (format!("lane.{}", lane.0), lane.0.to_owned())));
    all
}

fn of_helper(helper: &behaviour::Helper) -> Catalogue {
    let (name, label) = (&helper.name, robot::helper_label(helper).unwrap());
    let stream = robot::helper_stream(name).unwrap();
    let all = [("", label), (".stream", stream), (".says", &helper.says)];
    all.into_iter().map(|(place, text)| (format!("helper.{name}{place}"), text.to_owned())).collect()
}

/// Returns the key and the name of a joint without its side.
fn joint_key(joint: &str) -> (String, String) {
    let bare = joint.strip_prefix(['L', 'R']).unwrap_or(joint);
    (format!("joint.{bare}"), bare.to_owned())
}

fn templates() -> Catalogue {
    let source = read(&folder().join("../crates/server/src/library/templates.rs"));
    let source = source.split("#[cfg(test)]").next().unwrap_or_default();
    let (names, says) = (calls(source, "name: "), calls(source, "says: "));
    assert!(names.len() > 5 && names.len() == says.len(), "{names:?}");
    names.iter().zip(says).flat_map(|(name, says)| of_template(name, &says)).collect()
}

/// The texts that follow on this in a source.
fn calls(source: &str, name: &str) -> Vec<String> {
    let first = |call: &str| call.trim_start().strip_prefix('"').map(|text| literal(text).0);
    source.split(name).skip(1).filter_map(first).collect()
}

fn of_template(name: &str, says: &str) -> [(String, String); 2] {
    [(format!("template.{name}"), name.to_owned()), (format!("template.{name}.says"), says.to_owned())]
}

/// The tasks: what they are called and say, their goals, and what is answered to who tries.
fn exercises() -> Catalogue {
    let source = read(&folder().join("../crates/server/src/library/exercises.rs"));
    let mut all = Catalogue::new();
    for start in source.split("Template::of(").skip(1) {
        let (name, rest) = literal(start.split_once('"').unwrap().1);
        let (says, rest) = literal(rest.split_once('"').unwrap().1);
        all.extend(of_template(&name, &says));
        let file =
            rest.split("goal: include_str!(\"../../../../").nth(1).and_then(|rest| rest.split('"').next()).unwrap();
        let goal: serde_json::Value = serde_json::from_str(&read(&folder().join("..").join(file))).unwrap();
        let mut put = |place: String, text: &serde_json::Value| {
            all.insert(format!("exercise.{name}.{place}"), text.as_str().unwrap().to_owned());
        };
        put("goal".to_owned(), &goal["says"]);
        put("reached".to_owned(), &goal["reached"]);
        for (nth, expected) in goal["expects"].as_array().unwrap().iter().enumerate() {
            put(format!("expects{nth}"), &expected["otherwise"]);
        }
        for (nth, asked) in goal["asks"].as_array().into_iter().flatten().enumerate() {
            put(format!("asks{nth}"), &asked["ask"]);
            put(format!("asks{nth}.otherwise"), &asked["otherwise"]);
            for (which, answer) in asked["answers"].as_array().unwrap().iter().enumerate() {
                put(format!("asks{nth}.answer{which}"), answer);
            }
        }
    }
    assert!(all.len() > 20, "{all:?}");
    all
}

pub(super) fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

pub(super) fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|why| panic!("{}: {why}", path.display()))
}

/// The paths and texts of all Rust files of a folder and the folders in it.
pub(super) fn sources(folder: &Path) -> Vec<(String, String)> {
    sources_of("rs", folder)
}

/// The paths and texts of all files of this ending, in a folder and the folders in it.
fn sources_of(ending: &str, folder: &Path) -> Vec<(String, String)> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let is_meant = |path: &&PathBuf| path.is_dir() || path.extension().is_some_and(|is| is == ending);
    let named = |path: &PathBuf| (path.to_string_lossy().into_owned(), read(path));
    let inside = |path: &PathBuf| if path.is_dir() { sources_of(ending, path) } else { vec![named(path)] };
    paths.iter().filter(is_meant).flat_map(inside).collect()
}
