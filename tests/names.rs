//! The names of types: each has one meaning in the workspace, so that who reads it once has read it everywhere.

use std::collections::BTreeMap;

use house::Outcome;
use house::sources::{Source, none, product};

/// The folders whose types may share a name: each robot's own driver of the device of that name.
const DRIVERS: [&str; 2] = ["crates/nao/src/devices", "crates/simulation/src/nao/devices"];

/// The names that mean two things all the same, each with the reason. The list may only get shorter.
const SHARED: &[(&str, &str)] = &[
    ("Speech", "the voice of each robot"),
    ("Value", "of the qi protocol, and of behaviours; both are their field's own word"),
];

/// The words before the name of a type where it is defined.
const KINDS: [&str; 5] = ["struct ", "enum ", "trait ", "union ", "type "];

#[test]
fn a_type_name_means_one_thing() -> Outcome<()> {
    let several = several(&product()?);
    let wrong: Vec<String> = several
        .iter()
        .filter(|(name, _)| !SHARED.iter().any(|(shared, _)| shared == name))
        .map(|(name, paths)| format!("{name}: {}", paths.join(", ")))
        .collect();
    none("type names mean several things", &wrong)?;
    let unused = SHARED.iter().filter(|(shared, _)| !several.contains_key(*shared)).map(|(shared, _)| *shared);
    none("names of SHARED mean one thing by now", &unused.collect::<Vec<_>>())
}

#[test]
fn definitions_are_found() {
    let text = "pub struct One(u8);\npub(crate) enum Two {}\ntrait Three { type Item; }\ntype Four = u8;\n    type Item = u8;\n\
                // struct Five;\nlet text = \"struct Six\";\n    struct Seven;\nimpl One {}\n";
    let file = Source { path: "crates/a/src/a.rs".to_owned(), text: text.to_owned() };
    assert_eq!(defined(&file), ["One", "Two", "Three", "Four", "Seven"]);
}

#[test]
fn a_name_with_two_meanings_is_found() {
    let file = |path: &str, text: &str| Source { path: path.to_owned(), text: text.to_owned() };
    let files = [
        file("crates/nao/src/devices/say.rs", "struct Say;"),
        file("crates/simulation/src/nao/devices/say.rs", "struct Say;"),
        file("crates/nao/src/a.rs", "struct Kept;"),
        file("crates/nao/src/b.rs", "enum Kept {}"),
        file("crates/store/src/c.rs", "struct Alone;"),
    ];
    assert_eq!(several(&files).into_keys().collect::<Vec<_>>(), ["Kept"]);
}

/// The names that mean several things, each with the files that define it.
fn several(files: &[Source]) -> BTreeMap<String, Vec<String>> {
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for file in files {
        for name in defined(file) {
            found.entry(name).or_default().push(file.path.clone());
        }
    }
    found.retain(|_, paths| paths.len() > 1 && !are_drivers(paths));
    found
}

/// True if every robot has one driver of that name at most, and nothing else has the name.
fn are_drivers(paths: &[String]) -> bool {
    let of = |folder: &str| paths.iter().filter(|path| path.starts_with(folder)).count();
    let each = DRIVERS.map(of);
    each.iter().all(|count| *count <= 1) && each.iter().sum::<usize>() == paths.len()
}

/// The types that the product code of a file defines, in order. Associated types belong to their trait and do not count.
fn defined(file: &Source) -> Vec<String> {
    file.code().lines().filter_map(|line| definition(line).map(str::to_owned)).collect()
}

/// The type that a line defines.
fn definition(line: &str) -> Option<&str> {
    let begin = line.trim_start();
    let public = begin.strip_prefix("pub").map(|rest| match rest.strip_prefix('(') {
        Some(inside) => inside.split_once(')').map_or(rest, |(_, rest)| rest),
        None => rest,
    });
    let rest = public.unwrap_or(begin).trim_start();
    let kind = KINDS.iter().find(|kind| rest.starts_with(**kind))?;
    if *kind == "type " && begin.len() < line.len() {
        return None;
    }
    let name = &rest[kind.len()..];
    let end = name.find(|letter: char| !letter.is_alphanumeric() && letter != '_').unwrap_or(name.len());
    Some(&name[..end]).filter(|name| name.starts_with(char::is_uppercase))
}
