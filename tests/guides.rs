//! Compares what the pages for engineers promise with the code: `crates/ARCHITECTURE.md`, `crates/ADDING.md`,
//! `tests/TESTING.md`.

use std::collections::{BTreeMap, BTreeSet};

use house::guide::{self, ADDING, ARCHITECTURE, Guide, TESTING};
use house::sources::Source;
use house::{Outcome, Trouble};

use super::{none, rooms};

const ALL: [&str; 3] = [ARCHITECTURE, TESTING, ADDING];
/// The most words that are read in ten minutes.
const WORDS_MAX: usize = 2_300;
/// The things that engineers ask for most; each has to have a row.
const ADDED: [&str; 8] = [
    "a connector",
    "a sensor or an actuator",
    "a request over the socket",
    "a panel",
    "a dialog",
    "a command of the command line",
    "a console command",
    "a language of the page",
];

#[test]
fn the_map_shows_who_uses_whom_and_arrows_only_point_down() -> Outcome<()> {
    let (rooms, table) = (rooms()?, Guide::read(ARCHITECTURE)?.table("Rooms")?);
    let mut shown: Vec<(&str, BTreeSet<&str>)> = Vec::new();
    for row in &table {
        match (row.first().map(|cell| guide::code(cell)).as_deref(), row.get(2)) {
            (Some([name]), Some(uses)) => shown.push((name, guide::code(uses).into_iter().collect())),
            _ => return Err(Trouble(format!("{ARCHITECTURE}: this row names no room and what it uses: {row:?}"))),
        }
    }
    let below: BTreeMap<&str, usize> = shown.iter().enumerate().map(|(place, (name, _))| (*name, place)).collect();
    let mut wrong = Vec::new();
    for (place, (room, says)) in shown.iter().enumerate() {
        let Some(uses) = rooms.get(*room) else {
            wrong.push(format!("{room} stands in the map and is not there"));
            continue;
        };
        let ours: BTreeSet<&str> = uses.iter().map(String::as_str).filter(|used| rooms.contains_key(*used)).collect();
        wrong.extend(ours.difference(says).map(|used| format!("{room} uses {used}, and the map does not allow it")));
        wrong.extend(says.difference(&ours).map(|used| format!("{room} uses no {used}, and the map says so")));
        let upwards = says.iter().filter(|used| below.get(*used).is_some_and(|at| *at <= place));
        wrong.extend(upwards.map(|used| format!("{room} uses {used}, which stands above it in the map")));
    }
    wrong.extend(rooms.keys().filter(|room| !below.contains_key(room.as_str())).map(|room| format!("{room} is new")));
    none("things in the code are not as the table of rooms says", &wrong)
}

#[test]
fn every_path_that_is_named_exists() -> Outcome<()> {
    let files = names_of_files()?;
    let mut wrong = Vec::new();
    for path in ALL {
        let guide = Guide::read(path)?;
        assert!(guide.text.matches('`').count().is_multiple_of(2), "{path}: a mark of code has no end");
        let named = guide::paths(&guide.text);
        assert!(named.len() > 20, "{path} names many paths: {named:?}");
        wrong.extend(named.iter().filter(|name| !guide::exists(name, &files)).map(|name| format!("{path}: {name}")));
    }
    none("paths that are named do not exist", &wrong)
}

#[test]
fn every_page_is_read_in_ten_minutes() -> Outcome<()> {
    let mut wrong = Vec::new();
    for path in ALL {
        let text = Guide::read(path)?.text;
        // The lines of a table are no words.
        let words = text.split_whitespace().filter(|word| word.contains(char::is_alphanumeric)).count();
        if words > WORDS_MAX {
            wrong.push(format!("{path} has {words} words"));
        }
    }
    none(&format!("pages have more than {WORDS_MAX} words"), &wrong)
}

#[test]
fn whoever_adds_something_touches_what_the_page_says() -> Outcome<()> {
    let (guide, files) = (Guide::read(ADDING)?, names_of_files()?);
    let (mut wrong, mut added) = (Vec::new(), BTreeSet::new());
    for heading in guide.headings_of_tables() {
        for row in guide.table(heading)? {
            let [what, touch, count, _] = row.as_slice() else {
                return Err(Trouble(format!("{ADDING}: this row has not four cells: {row:?}")));
            };
            let touched = guide::paths(touch);
            let gone = touched.iter().filter(|path| !guide::exists(path, &files));
            wrong.extend(gone.map(|path| format!("{what}: there is no {path}")));
            if touched.is_empty() || count.parse() != Ok(touched.len()) {
                wrong.push(format!("{what}: {} files are named, and {count} are counted", touched.len()));
            }
            added.insert(what.clone());
        }
    }
    wrong.extend(ADDED.iter().filter(|what| !added.contains(**what)).map(|what| format!("{what} has no row")));
    none("rows are not as the code is", &wrong)
}

#[test]
fn every_kind_of_test_and_every_variable_is_told() -> Outcome<()> {
    let guide = Guide::read(TESTING)?;
    let manifest = std::fs::read_to_string(house::root().join("tests/Cargo.toml"))?;
    let places = manifest.lines().filter_map(|line| line.strip_prefix("path = \"")?.strip_suffix('"'));
    let places: Vec<String> = places
        .filter(|path| *path != "src/lib.rs")
        .map(|path| format!("`tests/{}", path.trim_end_matches("/main.rs")))
        .collect();
    assert!(places.len() > 8, "the tests of the house are found: {places:?}");
    let mut wrong: Vec<String> = places
        .iter()
        .filter(|place| !guide.text.contains(*place))
        .map(|place| format!("{place}` is not told"))
        .collect();
    let mut sources = Source::below("crates")?;
    sources.extend(Source::below("tests")?);
    for row in guide.table("Running one test")? {
        let named = row.first().map(|cell| guide::code(cell)).unwrap_or_default();
        let names = named.iter().map(|name| name.split('=').next().unwrap_or_default());
        let unknown = names.filter(|name| !sources.iter().any(|file| file.text.contains(&format!("\"{name}\""))));
        wrong.extend(unknown.map(|name| format!("nothing reads {name}")));
    }
    none("things in TESTING are not so", &wrong)
}

/// The name of every file of the repository that is in none of the folders that are made.
fn names_of_files() -> Outcome<BTreeSet<String>> {
    let tops = ["crates", "frontend", "migrations", "static", "tests"];
    let mut waiting: Vec<_> = tops.iter().map(|top| house::root().join(top)).collect();
    let mut found = BTreeSet::new();
    while let Some(folder) = waiting.pop() {
        for entry in std::fs::read_dir(&folder)? {
            let entry = entry?;
            if entry.file_type()?.is_dir() {
                waiting.push(entry.path());
            } else {
                found.insert(entry.file_name().to_string_lossy().into_owned());
            }
        }
    }
    Ok(found)
}
