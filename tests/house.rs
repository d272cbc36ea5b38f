//! The structure of the house: who may use whom, and what the sources may not say.

mod guides;
mod scripts;

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use behaviour::connectors;
use house::sources::{self, Source, none, product};
use house::{Outcome, Trouble};
use serde_json::Value;

/// Rooms whose outside libraries are listed in full.
const LIBRARIES: [(&str, &[&str]); 18] = [
    ("behaviour", &["serde", "unicode-normalization", "unicode-xid", "uuid"]),
    ("catalogues", &[]),
    ("causes", &[]),
    ("compression", &["brotli", "flate2"]),
    ("editor", &["serde", "serde_json"]),
    ("engine", &["libm", "rhai", "serde"]),
    ("lanes", &[]),
    ("past", &["serde"]),
    ("phrase", &["serde"]),
    ("phrase_macros", &["proc-macro2", "quote", "syn"]),
    ("protocol", &["serde"]),
    ("qi", &["rustls", "sha2", "tokio", "tokio-rustls"]),
    ("recording", &["serde", "serde_json"]),
    ("report", &["maud", "quick-xml", "time"]),
    ("robot", &["serde", "serde_json"]),
    ("sentences", &["serde"]),
    ("simulation", &["libm", "rapier3d", "serde", "toml"]),
    (
        "store",
        &[
            "async-trait",
            "idna_adapter",
            "neo4rs",
            "quick-xml",
            "rusqlite",
            "serde",
            "serde_json",
            "thiserror",
            "tokio",
        ],
    ),
];

/// Rooms without clock, threads, network or chance.
const PURE: [&str; 12] = [
    "behaviour",
    "causes",
    "editor",
    "engine",
    "lanes",
    "past",
    "protocol",
    "recording",
    "report",
    "robot",
    "sentences",
    "simulation",
];
const IMPURE: [&str; 6] = ["std::time::Instant", "Instant::now", "SystemTime", "std::thread", "std::net", "tokio"];
/// Rooms whose work must happen in the same order in every run. There is one file that keeps the order of hashes to itself.
const ORDERED: [&str; 10] =
    ["behaviour", "causes", "editor", "engine", "lanes", "past", "recording", "report", "sentences", "simulation"];
const UNORDERED: [&str; 2] = ["HashMap", "HashSet"];
const LOOKUP: &str = "crates/behaviour/src/lookup.rs";
/// The ways to go through a map, which would show the order of hashes.
const GOES_THROUGH: [&str; 6] = [".iter(", ".into_iter(", ".keys(", ".values(", ".drain(", "IntoIterator for"];
/// Functions of the standard library that differ between machines; `libm` does not.
const TRIGONOMETRY: [&str; 8] =
    [".sin()", ".cos()", ".tan()", ".asin()", ".acos()", ".atan()", ".atan2(", ".sin_cos()"];

/// The entries of the root of the repository, besides hidden files.
const TOP: [&str; 13] = [
    "CHANGELOG.md",
    "Cargo.lock",
    "Cargo.toml",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "README.md",
    "crates",
    "docker-compose.yml",
    "frontend",
    "migrations",
    "rust-toolchain.toml",
    "static",
    "tests",
];
/// Where cargo and the tests put what they make; never in a commit.
const MADE: &str = "target";

/// The places where connectors may be named: their own files, and the engine that runs them.
const CONNECTOR_ROOMS: [&str; 2] = ["crates/behaviour/src/connectors", "crates/engine/src/"];
/// Where devices may be named: their own files, the robots that have them, and what sentences say of each.
const DEVICE_ROOMS: [&str; 6] = [
    "crates/robot/src/devices",
    "crates/nao/src/",
    "crates/simulation/src/",
    "crates/sentences/src/clauses.rs",
    "crates/sentences/src/read/spoken.rs",
    "crates/sentences/src/words/",
];
/// Files or folders in which one of them (none: any of them) is named all the same, and why.
const NAMED_ELSEWHERE: [(&str, &str, &str); 5] = [
    ("crates/report/src/words.rs", "People", "those who took part in a session"),
    ("crates/behaviour/src/connectors/", "Tracker", "a stream of an example, as people call it"),
    ("crates/nao/src/senses.rs", "subscribe", "a method of NAOqi's extractors"),
    ("crates/store/src/contract/", "", "what every store is tried with"),
    ("frontend/src/robots/room.rs", "sample", "a class of the stylesheet: a spot of colour"),
];
/// Labels of connectors that are also words of Rust or its libraries: `Value::Map`, `MissedTickBehavior::Delay`.
const COMMON_LABELS: [&str; 2] = ["Map", "Delay"];
/// Devices that are also common names of types: people who are here, a button of the page, the lights that say how a robot is, a
/// walk through a tree, the voice as a part of the body.
const COMMON_DEVICES: [&str; 5] = ["Button", "Lights", "People", "Voice", "Walk"];

/// The files in which browser tests sleep, how often, and what for. A ratchet: nothing may be added.
const SLEEPS: [(&str, usize, &str); 4] = [
    ("tests/journeys/by_touch.rs", 1, "between two looks"),
    ("tests/journeys/library.rs", 1, "before a request that came too fast is sent again"),
    ("tests/journeys/robot_console.rs", 1, "between two looks"),
    ("tests/journeys/stop_anywhere.rs", 1, "between two looks"),
];
/// The longest function, in lines. A ratchet: it may only go down.
const FUNCTION_MAX: usize = 90;

/// First words that turn a sentence of a doc comment into a noun clause, without a named subject and an early verb.
const VERBLESS: [&str; 5] = ["What", "Who", "How", "Whether", "Its"];
/// Files and folders of whose doc comments no line begins with one of these words.
const PLAIN: [&str; 25] = [
    "crates/behaviour/",
    "crates/causes/",
    "crates/editor/",
    "crates/engine/",
    "crates/host_key/",
    "crates/lanes/",
    "crates/load/",
    "crates/nao/",
    "crates/protocol/",
    "crates/qi/",
    "crates/recording/",
    "crates/report/",
    "crates/robot/",
    "crates/shell/",
    "crates/simulation/",
    "crates/store/",
    "crates/xtask/",
    "frontend/src/desk",
    "frontend/src/graph",
    "frontend/src/layout",
    "frontend/src/steps",
    "tests/folders.rs",
    "tests/house.rs",
    "tests/scripts.rs",
    "tests/src/",
];
/// The most such lines in all other files. A ratchet: it may only go down.
const VERBLESS_MAX: usize = 1_470;

#[test]
fn plain_rooms_use_only_the_libraries_on_their_list() -> Outcome<()> {
    let rooms = rooms()?;
    let mut wrong = Vec::new();
    for (room, may) in LIBRARIES {
        let uses = rooms.get(room).ok_or_else(|| Trouble(format!("There is no room {room}.")))?;
        let others = uses.iter().filter(|used| !rooms.contains_key(*used));
        wrong.extend(others.filter(|used| !may.contains(&used.as_str())).map(|used| format!("{room} uses {used}")));
    }
    none("rooms use libraries that are not on their list", &wrong)
}

#[test]
fn files_are_named_for_what_they_hold() -> Outcome<()> {
    let files = everything()?;
    let wrong: Vec<&str> = files.iter().filter(|file| file.name() == "mod.rs").map(|file| file.path.as_str()).collect();
    none("files are named mod.rs", &wrong)
}

#[test]
fn every_file_opens_with_its_purpose() -> Outcome<()> {
    let purpose = |file: &&Source| {
        file.text.strip_prefix("//! ").is_none_or(|rest| rest.trim_start_matches([' ', '\t']).starts_with('\n'))
    };
    let files = everything()?;
    let wrong: Vec<&str> = files.iter().filter(purpose).map(|file| file.path.as_str()).collect();
    none("files do not open with `//! ` and their purpose", &wrong)
}

#[test]
fn pure_rooms_have_no_clock_no_threads_and_no_network() -> Outcome<()> {
    let mut wrong = mentions(&PURE, &IMPURE)?;
    wrong.extend(mentions(&ORDERED, &UNORDERED)?.into_iter().filter(|found| !found.starts_with(LOOKUP)));
    wrong.extend(mentions(&["behaviour"], &GOES_THROUGH)?.into_iter().filter(|found| found.starts_with(LOOKUP)));
    none("pure rooms mention what depends on the machine", &wrong)
}

#[test]
fn the_simulation_computes_the_same_everywhere() -> Outcome<()> {
    none("uses of the machine's trigonometry instead of libm's", &mentions(&["simulation"], &TRIGONOMETRY)?)
}

#[test]
fn the_page_never_turns_text_into_markup() -> Outcome<()> {
    let mut wrong = Vec::new();
    for file in Source::below("frontend")? {
        let code = file.code();
        wrong.extend(
            ["inner_html", "innerHTML", "insert_adjacent_html"]
                .iter()
                .filter(|word| code.contains(**word))
                .map(|word| format!("{}: {word}", file.path)),
        );
    }
    none("ways to turn text into markup", &wrong)
}

/// Where keys are read: elsewhere the Enter that only ends a word of Japanese would save, and a letter on a Russian or
/// Greek keyboard would be no letter.
const KEYS: &str = "frontend/src/keys.rs";

#[test]
fn keys_are_read_in_one_place_of_the_page() -> Outcome<()> {
    let raw = [".key()", ".key_code()", ".is_composing()", "event.code()"];
    let reads = |source: &Source| {
        let code = source.code();
        code.contains("KeyboardEvent") && raw.iter().any(|raw| code.contains(raw))
    };
    let all: Vec<String> = Source::below("frontend/src")?.into_iter().filter(reads).map(|source| source.path).collect();
    assert!(all.iter().any(|path| path == KEYS), "they are read there");
    let elsewhere: Vec<String> = all.into_iter().filter(|path| path != KEYS).collect();
    none("files of the page that read keys by themselves", &elsewhere)
}

/// Where Escape is heard: whoever uses it says so there, or the second of two would be Stop.
const ESCAPE: &str = "frontend/src/escape.rs";

#[test]
fn escape_is_heard_in_one_place_of_the_page() -> Outcome<()> {
    let hears = |source: &Source| source.literals().iter().any(|(_, text)| text == "Escape");
    let all: Vec<String> =
        Source::below("frontend")?.iter().filter(|file| hears(file)).map(|file| file.path.clone()).collect();
    assert!(all.iter().any(|path| path == ESCAPE), "it is heard there");
    let elsewhere: Vec<String> = all.into_iter().filter(|path| path != ESCAPE).collect();
    none("files of the page that hear Escape by themselves", &elsewhere)
}

#[test]
fn browser_tests_wait_for_the_page_and_not_for_a_time() -> Outcome<()> {
    let mut wrong = Vec::new();
    for folder in ["tests/hands", "tests/journeys", "tests/looks"] {
        for file in Source::below(folder)? {
            let found = file.code().matches("time::sleep(").count();
            let may = SLEEPS.iter().find(|(path, ..)| *path == file.path).map_or(0, |(_, may, _)| *may);
            if found != may {
                wrong.push(format!("{}: {found}, and {may} are listed", file.path));
            }
        }
    }
    none("files of browser tests sleep more or less often than they may; wait by `Page::settled` or `until`", &wrong)
}

#[test]
fn tests_are_skipped_in_one_line() -> Outcome<()> {
    let mut wrong = Vec::new();
    for file in Source::below("tests")?.iter().filter(|file| file.path != "tests/src/skip.rs") {
        let code = file.code();
        let lines: Vec<&str> = code.lines().map(str::trim).collect();
        let is_long = |pair: &[&str]| {
            let asks = ["if !skip::", "if !house::skip::"].iter().any(|asks| pair[0].starts_with(asks));
            asks && pair[1] == "return Ok(());"
        };
        let found = lines.windows(2).enumerate().filter(|(_, pair)| is_long(pair));
        wrong.extend(found.map(|(at, _)| format!("{}:{}", file.path, at + 1)));
    }
    none("tests skip themselves in several lines; write `skip::unless!(ready(…));`", &wrong)
}

#[test]
fn the_root_holds_only_what_belongs_there() -> Outcome<()> {
    let mut wrong = Vec::new();
    for entry in std::fs::read_dir(house::root())? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        if !name.starts_with('.') && name != MADE && !TOP.contains(&name.as_str()) {
            wrong.push(name);
        }
    }
    none("entries of the root that do not belong there", &wrong)
}

#[test]
fn functions_stay_short() -> Outcome<()> {
    let mut wrong = Vec::new();
    for file in product()? {
        let long = sources::functions(&file.code()).into_iter().filter(|function| function.lines > FUNCTION_MAX);
        wrong.extend(long.map(|long| format!("{}:{}: {} has {} lines", file.path, long.line, long.name, long.lines)));
    }
    none(&format!("functions are longer than {FUNCTION_MAX} lines"), &wrong)
}

#[test]
fn docs_name_their_subject() -> Outcome<()> {
    let files = everything()?;
    let unused = PLAIN.iter().filter(|plain| !files.iter().any(|file| file.path.starts_with(**plain)));
    none("plain files or folders are not there", &unused.collect::<Vec<_>>())?;
    let all = files.iter().flat_map(|file| verbless(&file.text).map(move |line| (file, line)));
    let (wrong, others): (Vec<_>, Vec<_>) =
        all.partition(|(file, _)| PLAIN.iter().any(|plain| file.path.starts_with(plain)));
    let wrong = wrong.iter().map(|(file, (number, line))| format!("{}:{number}: {line}", file.path));
    none("lines of docs begin without their subject and verb", &wrong.collect::<Vec<_>>())?;
    assert!(
        others.len() <= VERBLESS_MAX,
        "{} lines of docs begin so elsewhere, at most {VERBLESS_MAX} may",
        others.len()
    );
    Ok(())
}

#[test]
fn lines_of_docs_without_a_verb_are_found() {
    let text = "//! What it does.\n/// Its name.\n// Who\n/// Whatever.\nlet a = 1; /// How\n    /// Whether it is.\n";
    let found: Vec<(usize, &str)> = verbless(text).collect();
    assert_eq!(found, [(1, "//! What it does."), (2, "/// Its name."), (6, "/// Whether it is.")]);
}

#[test]
fn connectors_are_named_in_their_rooms_only() -> Outcome<()> {
    let elsewhere = connectors_elsewhere()?.into_iter().filter(|named| !named.is_excused());
    none("connectors are named outside their rooms", &elsewhere.map(|named| named.to_string()).collect::<Vec<_>>())
}

#[test]
fn devices_are_named_in_their_rooms_only() -> Outcome<()> {
    let elsewhere = devices_elsewhere()?.into_iter().filter(|named| !named.is_excused());
    let lines: Vec<String> = elsewhere.map(|named| named.to_string()).collect();
    none("senses and actions are named outside their rooms", &lines)
}

#[test]
fn every_exception_of_names_is_needed() -> Outcome<()> {
    let all: Vec<Named> = connectors_elsewhere()?.into_iter().chain(devices_elsewhere()?).collect();
    let unused = NAMED_ELSEWHERE.iter().filter(|excuse| !all.iter().any(|named| named.is_excused_by(excuse)));
    none("exceptions of names are no longer needed", &unused.map(|(path, ..)| *path).collect::<Vec<_>>())
}

/// A connector or device that is named outside its rooms.
struct Named {
    path: String,
    line: usize,
    name: String,
}

impl Named {
    fn is_excused(&self) -> bool {
        NAMED_ELSEWHERE.iter().any(|excuse| self.is_excused_by(excuse))
    }

    fn is_excused_by(&self, (path, name, _): &(&str, &str, &str)) -> bool {
        self.path.starts_with(path) && (name.is_empty() || self.name == *name)
    }
}

impl std::fmt::Display for Named {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(to, "{}:{}: {}", self.path, self.line, self.name)
    }
}

fn connectors_elsewhere() -> Outcome<Vec<Named>> {
    let words: Vec<String> = connectors::ALL.iter().map(|spec| spec.word.to_owned()).collect();
    let labels = connectors::ALL.iter().map(|spec| spec.graph.label).filter(|label| !COMMON_LABELS.contains(label));
    let files = Source::below("crates/behaviour/src/connectors")?;
    let modules = files.iter().map(|file| format!("connectors::{}::", file.name().trim_end_matches(".rs")));
    let names: Vec<String> = labels.map(str::to_owned).chain(modules).collect();
    elsewhere(&CONNECTOR_ROOMS, &words, &names)
}

fn devices_elsewhere() -> Outcome<Vec<Named>> {
    let words: Vec<String> = robot::sensors().chain(robot::actuators()).map(|device| device.name.to_owned()).collect();
    let names: Vec<String> = words.iter().filter(|name| !COMMON_DEVICES.contains(&name.as_str())).cloned().collect();
    elsewhere(&DEVICE_ROOMS, &words, &names)
}

/// Where the product writes one of `words` out as a whole text, or one of `names` as a name, outside of these rooms.
fn elsewhere(rooms: &[&str], words: &[String], names: &[String]) -> Outcome<Vec<Named>> {
    let mut found = Vec::new();
    for file in product()?.iter().filter(|file| !rooms.iter().any(|room| file.path.starts_with(room))) {
        let mut add = |line, name| found.push(Named { path: file.path.clone(), line, name });
        let texts = file.literals().into_iter().filter(|(_, text)| words.contains(text));
        texts.for_each(|(line, text)| add(line, text));
        for (number, line) in file.code().lines().enumerate() {
            let here = names.iter().filter(|name| sources::words(line, name).next().is_some());
            here.for_each(|name| add(number + 1, name.clone()));
        }
    }
    Ok(found)
}

/// Every Rust file of the house.
fn everything() -> Outcome<Vec<Source>> {
    let mut files = Source::below("crates")?;
    files.extend(Source::below("frontend")?);
    files.extend(Source::below("tests")?);
    Ok(files)
}

/// Where the product code of `rooms` says one of `phrases`, as `path:line: phrase`.
fn mentions(rooms: &[&str], phrases: &[&str]) -> Outcome<Vec<String>> {
    let mut found = Vec::new();
    for file in product()? {
        if !rooms.iter().any(|room| file.path.starts_with(&format!("crates/{room}/"))) {
            continue;
        }
        for (number, line) in file.code().lines().enumerate() {
            let said = phrases.iter().filter(|phrase| says(line, phrase));
            found.extend(said.map(|phrase| format!("{}:{}: {phrase}", file.path, number + 1)));
        }
    }
    Ok(found)
}

/// True if `line` says `phrase`: a method anywhere, anything else as a whole word.
fn says(line: &str, phrase: &str) -> bool {
    if phrase.starts_with('.') { line.contains(phrase) } else { sources::words(line, phrase).next().is_some() }
}

/// The lines of doc comments in `text` that begin with one of [`VERBLESS`], each with its number from 1.
fn verbless(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().map(str::trim).enumerate().filter(|(_, line)| is_verbless(line)).map(|(at, line)| (at + 1, line))
}

/// True if `line` is of a doc comment and begins with one of [`VERBLESS`].
fn is_verbless(line: &str) -> bool {
    let said = line.strip_prefix("/// ").or_else(|| line.strip_prefix("//! "));
    let first = said.and_then(|said| said.split(|letter: char| !letter.is_alphanumeric()).next());
    first.is_some_and(|word| VERBLESS.contains(&word))
}

/// Each of our packages with the packages that its product code uses.
fn rooms() -> Outcome<BTreeMap<String, BTreeSet<String>>> {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or("cargo".into()));
    cargo.args(["metadata", "--format-version", "1", "--no-deps", "--offline"]).current_dir(house::root());
    let output = cargo.output()?;
    if !output.status.success() {
        return Err(Trouble(format!("cargo metadata failed: {}", String::from_utf8_lossy(&output.stderr))));
    }
    let metadata: Value = serde_json::from_slice(&output.stdout)?;
    Ok(list(&metadata["packages"]).iter().map(|package| (text(&package["name"]), uses(package))).collect())
}

/// Returns the needs of a package to run or to build; needs of its tests alone are left out.
fn uses(package: &Value) -> BTreeSet<String> {
    let needs = list(&package["dependencies"]).iter().filter(|need| need["kind"] != "dev");
    needs.map(|need| text(&need["name"])).collect()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}
