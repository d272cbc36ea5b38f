//! The table of the second language says all that the page says.

use super::language::speak;
use super::{
    NameLanguage, condition, connector_word, deed, device, found_robot, helper_name_of, listed, no_connection,
    people_and_you, saved_test, start, step_title, stop as stop_word, tour_action, tour_helper, tour_number,
    tour_sense, tour_start, tour_stop, tour_test, while_you,
};
use behaviour::connectors;
use robot::{Condition, Device, JOINTS, ParamKind};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The most Latin letters in a row that need no reason.
const LATIN_MAX: usize = 3;
/// Words that are the same in Japanese: keys, names, and words of procedures.
const LATIN: [&str; 39] = [
    "Ctrl",
    "DOCTYPE",
    "English",
    "Enter",
    "JSON",
    "LyingBelly",
    "PageDown",
    "PageUp",
    "Pepper",
    "Shift",
    "Sitting",
    "Standing",
    "Wi-Fi",
    "actuator",
    "break",
    "continue",
    "data",
    "engine",
    "event",
    "false",
    "frame",
    "frameMs",
    "listen",
    "local",
    "name",
    "null",
    "ordinary",
    "params",
    "sensor",
    "serve",
    "soFar",
    "true",
    "value",
    "Android",
    "Chrome",
    "Safari",
    "Windows",
    "iPad",
    "iPhone",
];

/// What is made of parts where it is said: the words of a refusal, of a unit, of a kind of value, of where a fault is.
const MADE: &[&str] = &[
    "a function",
    "a letter",
    "a measured number",
    "a range",
    "a whole number",
    "an object",
    "becomes",
    "can become",
    "centimetres",
    "connection refused",
    "connection reset",
    "degrees",
    "host unreachable",
    "at character {column}: {fault}",
    "line {line}, character {column}: {fault}",
    "line {line}: {fault}",
    "metres",
    "milliseconds",
    "network unreachable",
    "percent",
    "radians",
    "seconds",
    "timed out",
    "a number from 0 to 1",
    "there is no function “{name}”",
    "{left} and {right} cannot be combined with {name}",
    "{name} does not work on {one}",
    "nothing",
    "{what} in “{program}”",
];
/// Lines for who reads files, which the page does not show, and what has no words of its own.
const NOT_SHOWN: &[&str] = &[
    "a frame has 1 to 1000 milliseconds",
    "an id has 1 to {ID_MAX_CHARS} letters, digits, - or _; {text:?} does not",
    "it has both a body and a helper",
    "it has more than {most} blocks {{ }} in a row; move a part into a helper",
    "its order {here} comes before {above}, the one above it; leave order out of the file",
    "at character {column}: ",
    "line {line}, character {column}: ",
    "line {line}: ",
    "nothing can come out of the actuator stream {id}",
    "nothing can lead into the sensor stream {id}",
    "only subscribe leads into the actuator stream {id}",
    "order names it, but there is no such stream or connector",
    "the input {id} is there twice",
    "the stream {id} already has an incoming connector",
    "the stream {id:?} is in another group too",
    "there is no connector {word:?}",
    "there is no stream {id:?}",
    "this id is used twice",
    "{format:?} is not {FORMAT}",
    "{text:?} is not a record id like stream/3f2a",
    "{word:?} is no kind of record",
    "{word} must lead to an actuator stream, and {id} is none",
    "{word} needs a periodMs of 1 or more",
    "{word} takes {0}, not {gets}",
];

type Texts = BTreeMap<String, String>;

#[test]
fn every_text_of_the_page_is_said_in_japanese() {
    let mut wanted = texts_of_the_page();
    assert!(wanted.len() > 500, "only {} texts were found in the sources", wanted.len());
    wanted.extend(stop());
    wanted.extend(catalogue());
    wanted.extend(joints());
    wanted.extend(templates());
    wanted.extend(exercises());
    wanted.extend(rules());
    let said = said_elsewhere();
    let known = |key: &str| MADE.contains(&key) || key.starts_with("this ") || said.contains(longest_piece(key));
    let wrong = faults(&wanted, &blocks(&read(&folder().join("../static/ja.txt"))), &known);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_is_wrong_with_a_table_is_found() {
    let wanted = ["Start", "{name} left", "Stop"].map(str::to_owned).into();
    let table =
        "# A remark.\n\nStart\nStart now\n\n{name} left\n{nama} さん\n\nGone\nなし\n\nhead\n頭\n\nStart\n開始\n";
    let right = [
        "has two blocks: Start",
        "has no Japanese: Stop",
        "has other holes: {name} left",
        "has no source: Gone",
        "is not all Japanese (Start): Start",
    ];
    assert_eq!(faults(&wanted, &blocks(table), &|key| key == "head"), right);
    assert_eq!(calls("say!(\n \"a {b}\", b) + said(\"c\\\"d \\\n   e\")", "say!("), ["a {b}"]);
    assert_eq!(calls("say!(\n \"a {b}\", b) + said(\"c\\\"d \\\n   e\")", "said("), ["c\"d e"]);
    assert_eq!(in_rows("x!{}sentences! {\n    // Two\n    one: \"1\";\n    two: \"2\";\n}\n\"3\""), ["1", "2"]);
}

#[test]
fn whole_sentences_are_japanese() {
    speak(read(&folder().join("../static/ja.txt")));
    let (before, after) = while_you(true, "Yuki さん", saved_test);
    assert_eq!(
        before + "Near" + &after,
        "オフラインの間に、Yuki さんが「Near」の条件を保存しました。あなたの変更はここにあります。"
    );
    let deeds = ["Add Near", "Undo: Edit map", "Rename program", "Connect Near"].map(|label| deed(label).whole());
    assert_eq!(listed(deeds), "Near を追加、「変換 を編集」を元に戻す、プログラムの名前を変更、変更：Near をつなぐ");
    assert_eq!(step_title("元に戻す", Some("Undo: Move")), "元に戻す：位置を移動");
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
    let filter = connector_word(connectors::filter::SPEC.name);
    assert!(tour_test().contains(&quoted(filter)) && tour_number().contains(&quoted(filter)));
    let label =
        |name: &str| robot::sensors().chain(robot::actuators()).find(|one| one.name == name).map(device).unwrap();
    assert!(tour_sense().contains(&quoted(label("RedBall"))) && tour_action().contains(&quoted(label("Tracker"))));
    assert!(tour_start().contains(&quoted(start())) && tour_stop().contains(&quoted(stop_word())));
}

fn faults(wanted: &BTreeSet<String>, table: &[(String, String)], known: &dyn Fn(&str) -> bool) -> Vec<String> {
    let (mut said, mut wrong) = (Texts::new(), Vec::new());
    for (english, japanese) in table {
        if said.contains_key(english) {
            wrong.push(format!("has two blocks: {english}"));
        } else {
            said.insert(english.clone(), japanese.clone());
        }
    }
    wrong.extend(wanted.iter().filter(|text| !said.contains_key(*text)).map(|text| format!("has no Japanese: {text}")));
    let other = said.iter().filter(|(english, japanese)| holes(english) != holes(japanese));
    wrong.extend(other.map(|(english, _)| format!("has other holes: {english}")));
    let stale = said.keys().filter(|key| !wanted.contains(*key) && !known(key));
    wrong.extend(stale.map(|key| format!("has no source: {key}")));
    for (english, japanese) in &said {
        let foreign = latin(japanese).into_iter().filter(|word| !LATIN.contains(&word.as_str()));
        wrong.extend(foreign.map(|word| format!("is not all Japanese ({word}): {english}")));
    }
    wrong
}

/// The English and the Japanese text of each block.
pub(super) fn blocks(table: &str) -> Vec<(String, String)> {
    let lines = |block: &str| {
        let mut lines = block.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
        Some((lines.next()?.to_owned(), lines.next().unwrap_or_default().to_owned()))
    };
    table.split("\n\n").filter_map(lines).collect()
}

fn holes(text: &str) -> BTreeSet<&str> {
    let hole = |part: &'_ str| -> Option<usize> { part.find('}') };
    text.split('{').skip(1).filter_map(|part| Some(part[..hole(part)?].trim_end_matches('*'))).collect()
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

/// All that the rooms say from which the page hears, with texts over several lines in one.
fn said_elsewhere() -> String {
    let rooms = ["behaviour", "engine", "nao", "protocol", "qi", "robot", "server", "simulation", "store"];
    let all = rooms.iter().flat_map(|room| sources(&folder().join(format!("../crates/{room}/src"))));
    let one_line = |source: String| {
        source.split_whitespace().collect::<Vec<_>>().join(" ").replace("\\ ", "").replace("\\\"", "\"")
    };
    all.map(|(_, source)| one_line(source)).collect()
}

/// What is longest between the holes.
fn longest_piece(key: &str) -> &str {
    key.split('{')
        .enumerate()
        .map(|(at, part)| if at == 0 { part } else { part.split_once('}').map_or("", |(_, rest)| rest) })
        .max_by_key(|piece| piece.len())
        .unwrap_or(key)
}

/// What the rules and the engine say.
fn rules() -> BTreeSet<String> {
    let files = [
        "../crates/behaviour/src/words.rs",
        "../crates/behaviour/src/problems/words.rs",
        "../crates/engine/src/faults/words.rs",
    ];
    let text = |file: &str| {
        let source = read(&folder().join(file));
        let source = source.split("#[cfg(test)]").next().unwrap_or_default();
        let one_line = source.split_whitespace().collect::<Vec<_>>().join(" ").replace("\\ ", "");
        let calls_of = |name: &str| calls(&one_line, name);
        let all = [calls_of("write!(to, "), calls_of("write!( to, "), calls_of("write_str(")];
        all.concat().iter().map(|text| numbered(text)).collect::<Vec<_>>()
    };
    let is_said = |text: &String| has_words(text) && !NOT_SHOWN.iter().any(|known| text == known);
    files.iter().flat_map(|file| text(file)).filter(is_said).collect()
}

/// Whether something is said around its holes.
fn has_words(text: &str) -> bool {
    text.split('{').enumerate().any(|(at, part)| after_hole(at, part).contains(char::is_alphabetic))
}

/// Holes without a name have their place as a name.
pub(super) fn numbered(text: &str) -> String {
    let mut parts = text.split("{}");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.enumerate().fold(first, |made, (at, part)| format!("{made}{{{at}}}{part}"))
}

fn texts_of_the_page() -> BTreeSet<String> {
    let words = folder().join("src/words");
    let parts = sources(&words.join("en")).into_iter().map(|(_, source)| source);
    let all = parts.chain([read(&words.join("en.rs"))]);
    all.map(|source| source.split("#[cfg(test)]").next().unwrap_or_default().to_owned())
        .flat_map(|source| [in_rows(&source), calls(&source, "say!("), calls(&source, "said(")].concat())
        .collect()
}

/// The literals of every `sentences!`.
fn in_rows(source: &str) -> Vec<String> {
    let mut found = Vec::new();
    for rows in source.split("sentences! {").skip(1) {
        let mut rest = rows.split("\n}").next().unwrap_or_default();
        while let Some(at) = rest.find('"') {
            let (text, after) = literal(&rest[at + 1..]);
            found.push(text);
            rest = after;
        }
    }
    found
}

/// The literals with which a function or macro is called.
pub(super) fn calls(source: &str, name: &str) -> Vec<String> {
    let first = |call: &str| call.trim_start().strip_prefix('"').map(|text| literal(text).0);
    source.split(name).skip(1).filter_map(first).collect()
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
fn stop() -> BTreeSet<String> {
    let page = read(&folder().join("../static/index.html"));
    let form = page.split("<form id=\"stop-form\"").nth(1).and_then(|form| form.split("</form>").next()).unwrap();
    let parts: Vec<&str> = form.split('"').collect();
    let attributes = parts.chunks(2).filter_map(|pair| Some((pair[0].split_whitespace().last()?, *pair.get(1)?)));
    let is_said = |name: &str| name.starts_with("data-") || ["aria-label=", "title="].contains(&name);
    let said: BTreeSet<String> =
        attributes.filter(|(name, _)| is_said(name)).map(|(_, text)| text.to_owned()).collect();
    let label = form.split("<span>").nth(1).and_then(|label| label.split("</span>").next()).unwrap();
    assert!(said.len() > 8, "{said:?}");
    said.into_iter().chain([label.to_owned()]).collect()
}

/// What is said of senses, actions and connectors.
fn catalogue() -> BTreeSet<String> {
    let devices = robot::sensors().chain(robot::actuators()).flat_map(of_device);
    let connectors = connectors::ALL.iter().flat_map(|spec| {
        let said = [spec.word, spec.name, spec.says, spec.brief].into_iter();
        let called = spec.called.iter().copied().filter(|name| has_words(name));
        said.chain(spec.takes.period).chain(spec.takes.start).chain(called)
    });
    devices.chain(connectors).chain(robot::helper_labels()).chain(robot::helper_streams()).map(str::to_owned).collect()
}

fn of_device(device: &'static Device) -> Vec<&'static str> {
    let mut all = vec![device.label, device.says];
    all.extend(device.next_step.label);
    all.extend(device.next_step.stream);
    all.extend(device.pretend.iter().map(|pretend| pretend.says));
    all.extend(device.shape.fields().iter().map(|field| field.says));
    for param in device.params {
        all.push(param.label);
        if let ParamKind::Choice(options) = param.kind {
            all.extend(options.iter().map(|option| option.1));
        }
    }
    all
}

fn templates() -> Vec<String> {
    let source = read(&folder().join("../crates/server/src/library/templates.rs"));
    let source = source.split("#[cfg(test)]").next().unwrap_or_default();
    [calls(source, "name: "), calls(source, "says: ")].concat()
}

/// The tasks: what they are called and say, their goals, and what is answered to who tries.
fn exercises() -> Vec<String> {
    let source = read(&folder().join("../crates/server/src/library/exercises.rs"));
    let starts = source.split("Template::of(").skip(1).flat_map(|start| {
        let (name, rest) = literal(start.split_once('"').unwrap().1);
        [name, literal(rest.split_once('"').unwrap().1).0]
    });
    let goals = sources_of("json", &folder().join("../tests/exercises"));
    let said = |goal: String| {
        let fields = ["says", "reached", "otherwise", "ask"].map(|field| calls(&goal, &format!("\"{field}\": ")));
        let answers = goal.split("\"answers\": [").skip(1).flat_map(|list| {
            let list = list.split_once(']').unwrap().0.split('"');
            list.skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>()
        });
        fields.concat().into_iter().chain(answers).collect::<Vec<_>>()
    };
    let goals = goals.into_iter().map(|(_, text)| text).filter(|text| text.contains("\"expects\"")).flat_map(said);
    let all: Vec<String> = starts.chain(goals).collect();
    assert!(all.len() > 20, "{all:?}");
    all
}

/// What joints are called without their side.
fn joints() -> BTreeSet<String> {
    let hot = JOINTS.iter().map(|joint| (*joint).to_owned()).collect();
    let lights = condition(&Condition { hot, ..Condition::default() });
    let said = lights.iter().find_map(|(_, words)| words.strip_prefix("Hot: ")).unwrap();
    let bare = |joint: &str| joint.trim_start_matches("left ").trim_start_matches("right ").to_owned();
    said.split(", ").map(bare).collect()
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
