//! The arrows between the folders of a crate: each uses only what stands in the table, and no circle comes about.

mod circles;

use std::collections::{BTreeMap, BTreeSet};

use house::Outcome;
use house::guide::{self, ARCHITECTURE, Guide};
use house::sources::{self, Source, none};

/// A folder or file at the top of a crate, and what of the crate it may use: `..x` is `x` and all after it.
type Arrows<'a> = &'a [(&'a str, &'a [&'a str])];

/// Every crate, or part of one, whose folders are held to this: where it is, its path in code, and all that is at its top.
const CRATES: &[(&str, &str, Arrows)] = &[
    ("crates/engine/src", "crate::", ENGINE),
    ("crates/server/src", "crate::", SERVER),
    ("frontend/src", "crate::", FRONTEND),
    ("frontend/src/desk", "crate::desk::", DESK),
];

const ENGINE: Arrows = &[
    ("run", &["cost", "faults", "procedure", "program", "timeline", "values"]),
    ("timeline", &["connectors", "cost", "faults", "procedure", "program", "values"]),
    ("program", &["connectors", "cost", "faults", "procedure", "rhai", "values"]),
    ("connectors", &["faults", "procedure", "values"]),
    ("procedure", &["cost", "faults", "rhai", "values"]),
    ("rhai", &["cost", "faults"]),
    ("cost", &[]),
    ("values", &["faults"]),
    ("faults", &[]),
    ("arbitration", &[]),
];

const SERVER: Arrows = &[
    ("serve", &["connection", "http", "invitations", "library", "recordings", "robots", "rooms", "state", "support"]),
    ("http", &["connection", "invitations", "library", "recordings", "robots", "rooms", "state", "support"]),
    ("connection", &["invitations", "library", "robots", "rooms", "state", "support"]),
    ("state", &["invitations", "library", "recordings", "robots", "rooms", "support"]),
    ("invitations", &["support"]),
    ("library", &["rooms", "support"]),
    ("rooms", &["support"]),
    ("robots", &["recordings", "support"]),
    ("recordings", &["support"]),
    ("support", &[]),
    ("words", &["http", "invitations", "library", "recordings", "robots", "rooms", "serve"]),
];

const FRONTEND: Arrows = &[
    ("pieces", &["..past"]),
    ("past", &["people", "sentences", "..parts"]),
    ("outline", &["forms", "graph", "library", "..parts"]),
    (
        "page",
        &[
            "operate",
            "conflicts",
            "forms",
            "palette",
            "library",
            "people",
            "robots",
            "history",
            "teaching",
            "..dialogs",
        ],
    ),
    ("operate", &["people", "robots", "..dialogs"]),
    ("conflicts", &["forms", "..dialogs"]),
    ("forms", &["palette", "..dialogs"]),
    ("palette", &["sentences", "..dialogs"]),
    ("sentences", &["graph", "..parts"]),
    ("library", &["..dialogs"]),
    ("people", &["..dialogs"]),
    ("robots", &["..dialogs"]),
    ("graph", &["..parts"]),
    ("history", &["..parts"]),
    ("teaching", &["..parts"]),
    ("dialogs", &["..parts"]),
    ("parts", &["..commands"]),
    ("commands", &["browser", "desk", "focus", "keys", "layout", "words"]),
    ("focus", &["browser", "desk", "keys", "later"]),
    ("later", &["browser", "desk", "fields", "layout", "words"]),
    ("steps", &["carries", "desk", "naming", "words"]),
    ("fields", &["browser", "desk", "icons", "keys", "reasons", "words"]),
    ("desk", &["browser", "json", "layout", "link", "live", "naming", "reasons", "words"]),
    ("link", &["browser", "json"]),
    ("layout", &["browser", "words"]),
    ("browser", &["words"]),
    ("live", &["words"]),
    ("naming", &["words"]),
    ("words", &["reasons"]),
    ("escape", &["keys"]),
    ("carries", &[]),
    ("icons", &[]),
    ("json", &[]),
    ("keys", &[]),
    ("reasons", &[]),
];

const DESK: Arrows = &[
    ("carried", &[]),
    ("hear", &["identity"]),
    ("robots", &["document", "library", "tab"]),
    ("library", &["document", "tab"]),
    ("document", &["tab"]),
    ("identity", &["tab"]),
    ("inviting", &["tab"]),
    ("roles", &["tab"]),
    ("tab", &["carried"]),
    ("tour", &[]),
];

#[test]
fn folders_use_only_the_folders_below_them() -> Outcome<()> {
    for (root, inside, table) in CRATES {
        let (allowed, found) = (allowed(table), arrows(&Source::below(root)?, root, inside));
        let mut wrong = Vec::new();
        for (from, uses) in &found {
            match allowed.get(from.as_str()) {
                None => wrong.push(format!("{from} is new; say in CRATES what it may use")),
                Some(may) => {
                    wrong.extend(uses.iter().filter(|(used, _)| !may.contains(*used)).map(|(_, place)| place.clone()))
                }
            }
        }
        let gone = allowed.keys().filter(|name| !found.contains_key(*name));
        wrong.extend(gone.map(|name| format!("{name} stands in CRATES and is not there")));
        none(&format!("arrows of {root} that nobody allowed"), &wrong)?;
    }
    Ok(())
}

#[test]
fn no_circle_is_between_folders() -> Outcome<()> {
    for (root, inside, _) in CRATES {
        let found = arrows(&Source::below(root)?, root, inside);
        let graph: Graph = found.into_iter().map(|(from, uses)| (from, uses.into_keys().collect())).collect();
        none(&format!("folders of {root} that use each other"), &in_circles(&graph))?;
    }
    Ok(())
}

#[test]
fn no_circle_is_at_the_top_of_any_crate() -> Outcome<()> {
    let mut wrong = Vec::new();
    for root in roots()? {
        let found = arrows(&Source::below(&root)?, &root, "crate::");
        let graph: Graph = found.into_iter().map(|(from, uses)| (from, uses.into_keys().collect())).collect();
        wrong.extend(in_circles(&graph).into_iter().map(|way| format!("{root}: {way}")));
    }
    none("circles at the top of crates", &wrong)
}

#[test]
fn the_map_shows_the_same_arrows() -> Outcome<()> {
    let guide = Guide::read(ARCHITECTURE)?;
    let mut wrong = Vec::new();
    for (root, _, table) in CRATES {
        let shown = shown_arrows(&guide.table(&format!("`{root}`"))?);
        let here = allowed(table).into_iter().collect::<BTreeSet<_>>();
        wrong.extend(
            here.difference(&shown).map(|(name, uses)| format!("{root}: {name} uses {uses:?}, says this test")),
        );
        wrong.extend(shown.difference(&here).map(|(name, uses)| format!("{root}: {name} uses {uses:?}, says the map")));
    }
    none(&format!("rows of {ARCHITECTURE} and of this test differ"), &wrong)
}

/// Spells out what each of a table may use.
fn allowed(table: Arrows) -> BTreeMap<String, BTreeSet<String>> {
    let names: Vec<&str> = table.iter().map(|(name, _)| *name).collect();
    let whole = |uses: &[&str]| uses.iter().flat_map(|used| spelled_out(used, &names)).collect();
    table.iter().map(|(name, uses)| ((*name).to_owned(), whole(uses))).collect()
}

/// The names that `used` stands for, of the `names` of a table in their order.
fn spelled_out(used: &str, names: &[&str]) -> Vec<String> {
    match used.strip_prefix("..") {
        None => vec![used.to_owned()],
        Some(first) => names.iter().skip_while(|name| **name != first).map(|name| (*name).to_owned()).collect(),
    }
}

/// The arrows of a table of the map. A row may name several folders of the same arrows; *all below* are those of the rows after
/// it, but for the ones that are named with these words.
fn shown_arrows(rows: &[guide::Row]) -> BTreeSet<(String, BTreeSet<String>)> {
    let names: Vec<&str> = rows.iter().flat_map(|row| cell_names(row, 0)).collect();
    let mut shown = BTreeSet::new();
    for (at, row) in rows.iter().enumerate() {
        let mut uses: BTreeSet<String> =
            cell_names(row, 2).into_iter().flat_map(|used| spelled_out(used, &names)).collect();
        if row.get(2).is_some_and(|cell| cell.starts_with("all below")) {
            let below = rows[at + 1..].iter().flat_map(|row| cell_names(row, 0)).map(str::to_owned);
            uses = below.filter(|name| !uses.contains(name)).collect();
        }
        shown.extend(cell_names(row, 0).into_iter().map(|name| (name.to_owned(), uses.clone())));
    }
    shown
}

/// The names in a cell of a row.
fn cell_names(row: &guide::Row, at: usize) -> Vec<&str> {
    row.get(at).map(|cell| guide::code(cell)).unwrap_or_default()
}

#[test]
fn rows_of_the_map_may_be_short() {
    let row = |cells: [&str; 3]| cells.map(str::to_owned).to_vec();
    let rows = [
        row(["`a`", "", "all below but `c`"]),
        row(["`b`, `c`", "", "`..d`"]),
        row(["`d`", "", "`e`"]),
        row(["`e`", "", "none"]),
    ];
    let found: Vec<String> = shown_arrows(&rows).iter().map(|(name, uses)| format!("{name}: {uses:?}")).collect();
    let right = [r#"a: {"b", "d", "e"}"#, r#"b: {"d", "e"}"#, r#"c: {"d", "e"}"#, r#"d: {"e"}"#, "e: {}"];
    assert_eq!(found, right);
    let table: Arrows = &[("b", &["..d"]), ("d", &["e"]), ("e", &[])];
    assert!(allowed(table).iter().all(|(name, uses)| found.contains(&format!("{name}: {uses:?}"))), "{table:?}");
}

#[test]
fn every_folder_says_what_it_is_for() -> Outcome<()> {
    let mut wrong = Vec::new();
    for (root, _, table) in CRATES {
        for (name, _) in *table {
            let path = house::root().join(root).join(format!("{name}.rs"));
            let text = std::fs::read_to_string(&path)?;
            if !text.starts_with("//! ") {
                wrong.push(format!("{root}/{name}.rs"));
            }
        }
    }
    none("folders without a first sentence", &wrong)
}

/// The sources of every crate, the page's with them.
fn roots() -> Outcome<Vec<String>> {
    let mut roots = vec!["frontend/src".to_owned()];
    for entry in std::fs::read_dir(house::root().join("crates"))? {
        let entry = entry?;
        if entry.path().join("src").is_dir() {
            roots.push(format!("crates/{}/src", entry.file_name().to_string_lossy()));
        }
    }
    Ok(roots)
}

/// The uses between modules: each with the ones that it uses.
type Graph = BTreeMap<String, BTreeSet<String>>;

/// For each folder or file at the top of a crate, which its code calls `inside`, what else of it its product code names,
/// and where first.
fn arrows(files: &[Source], root: &str, inside: &str) -> BTreeMap<String, BTreeMap<String, String>> {
    let tops: BTreeSet<&str> = files.iter().filter_map(|file| top(&file.path, root)).collect();
    let mut found: BTreeMap<String, BTreeMap<String, String>> = BTreeMap::new();
    for file in files.iter().filter(|file| !file.is_test()) {
        let Some(from) = top(&file.path, root) else { continue };
        let uses = found.entry(from.to_owned()).or_default();
        let code = file.code();
        // From a file at the top, the crate is just above.
        let above = format!("{root}/{from}.rs") == file.path;
        let words: &[&str] = if above { &[inside, "super::"] } else { &[inside] };
        for (at, name) in words.iter().flat_map(|word| named(&code, word)) {
            if name != from && tops.contains(name) {
                let line = code[..at].matches('\n').count() + 1;
                uses.entry(name.to_owned()).or_insert_with(|| format!("{}:{line}: {from} uses {name}", file.path));
            }
        }
    }
    found
}

/// The folder or file at the top of the crate to which a file belongs; none for the crate's own root.
fn top<'a>(path: &'a str, root: &str) -> Option<&'a str> {
    let below = path.strip_prefix(root)?.trim_start_matches('/');
    let name = below.split('/').next()?.trim_end_matches(".rs");
    (!matches!(name, "lib" | "main")).then_some(name)
}

/// Every first name after `start`, such as `crate::`, in `code`, also within braces, and where.
fn named<'a>(code: &'a str, start: &'a str) -> Vec<(usize, &'a str)> {
    let mut found = Vec::new();
    for at in sources::words(code, start) {
        let rest = &code[at + start.len()..];
        match rest.strip_prefix('{') {
            Some(list) => found.extend(first_names(list).into_iter().map(|name| (at, name))),
            None => found.push((at, word(rest))),
        }
    }
    found
}

/// The first name of each item of a list of paths, up to its closing brace.
fn first_names(list: &str) -> Vec<&str> {
    let (mut names, mut depth, mut start) = (Vec::new(), 0_usize, 0);
    for (at, letter) in list.char_indices() {
        match (letter, depth) {
            ('{', _) => depth += 1,
            (',' | '}', 0) => {
                names.push(word(list[start..at].trim_start()));
                start = at + 1;
                if letter == '}' {
                    break;
                }
            }
            ('}', _) => depth -= 1,
            _ => {}
        }
    }
    names
}

fn word(text: &str) -> &str {
    let end = text.find(|letter: char| !letter.is_alphanumeric() && letter != '_').unwrap_or(text.len());
    &text[..end]
}

/// The folders that reach themselves, each with its way.
fn in_circles(graph: &Graph) -> Vec<String> {
    graph.keys().filter_map(|start| way(graph, start, start)).map(|way| way.join(" -> ")).collect()
}

/// A shortest way of at least one arrow from one folder to another.
fn way(graph: &Graph, from: &str, to: &str) -> Option<Vec<String>> {
    let mut ways = std::collections::VecDeque::from([vec![from.to_owned()]]);
    let mut seen = BTreeSet::new();
    while let Some(way) = ways.pop_front() {
        for next in way.last().and_then(|last| graph.get(last)).into_iter().flatten() {
            let longer: Vec<String> = way.iter().cloned().chain([next.clone()]).collect();
            if next == to {
                return Some(longer);
            }
            if seen.insert(next.clone()) {
                ways.push_back(longer);
            }
        }
    }
    None
}

/// A file of an imagined crate.
fn file(path: &str, text: &str) -> Source {
    Source { path: format!("x/src/{path}"), text: text.to_owned() }
}

#[test]
fn arrows_are_read_from_the_sources() {
    let files = [
        file("a.rs", "//! A.\nmod b;\nuse crate::b::C;\n#[cfg(test)]\nuse crate::d::E;\n"),
        file("a/inner.rs", "use super::d::Z;\nuse crate::{b::{self, X}, d, a::Y};\nfn f() { crate::lock() }"),
        file("b.rs", "// crate::a\nuse super::d;\n"),
        file("d/tests.rs", "use crate::a;"),
        file("lib.rs", "use crate::a;"),
    ];
    let found = arrows(&files, "x/src", "crate::");
    let uses = |from: &str| found[from].keys().map(String::as_str).collect::<Vec<_>>();
    assert_eq!((uses("a"), uses("b")), (vec!["b", "d"], vec!["d"]));
    assert_eq!(found["a"]["b"], "x/src/a.rs:3: a uses b");
    let part = [file("a.rs", "use crate::desk::b::C;\nuse crate::d;"), file("b.rs", "use super::d;"), file("d.rs", "")];
    let found = arrows(&part, "x/src", "crate::desk::");
    assert!(found["a"].keys().eq(["b"]) && found["b"].keys().eq(["d"]), "a part of a crate: {found:?}");
}

#[test]
fn a_circle_is_found_with_its_way() {
    let graph: Graph = [("a", vec!["b"]), ("b", vec!["c"]), ("c", vec!["b"]), ("d", vec![])]
        .map(|(from, uses)| (from.to_owned(), uses.into_iter().map(str::to_owned).collect()))
        .into();
    assert_eq!(in_circles(&graph), ["b -> c -> b", "c -> b -> c"]);
}
