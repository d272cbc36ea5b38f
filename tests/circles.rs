//! No circle between the files of a crate, but for those that are known. A file and its own folder count as one: what stands
//! in `a/` is a part of `a.rs`.

use std::collections::{BTreeMap, BTreeSet};

use crate::roots;
use house::Outcome;
use house::sources::{Source, none, words};

/// The files that still use each other around circles: one line a circle. The list may only get shorter.
const KNOWN: &[(&str, &[&str])] = &[
    (
        "frontend/src",
        &[
            "graph/bounds",
            "graph/chip",
            "graph/context",
            "graph/far",
            "graph/fit",
            "graph/minimap",
            "graph/node",
            "graph/noting",
            "graph/offer",
            "graph/paper",
            "graph/stage",
            "graph/wire",
        ],
    ),
    ("frontend/src", &["desk/library/files", "desk/library/pasted", "desk/tab"]),
    (
        "frontend/src",
        &["forms/operation/actuator", "forms/operation/draft", "forms/operation/form", "forms/operation/naming"],
    ),
    ("crates/server/src", &["invitations/entry", "invitations/permissions"]),
    (
        "crates/server/src",
        &[
            "robots/command_queue",
            "robots/emission_sink",
            "robots/host",
            "robots/mailbox",
            "robots/robot_thread",
            "robots/run_marks",
            "robots/run_table",
            "robots/runner",
            "robots/shared",
            "robots/successor",
            "robots/surroundings",
        ],
    ),
    ("crates/behaviour/src", &["change", "connectors", "graph", "operation", "pad", "record", "rules", "size", "spec"]),
];

/// A module by its path in the crate; empty for the root.
type Module = Vec<String>;

#[test]
fn files_use_each_other_in_no_new_circle() -> Outcome<()> {
    let mut wrong = Vec::new();
    let known: BTreeMap<(String, String), usize> = KNOWN
        .iter()
        .enumerate()
        .flat_map(|(at, (root, files))| files.iter().map(move |file| (((*root).to_owned(), (*file).to_owned()), at)))
        .collect();
    let mut seen = BTreeSet::new();
    for root in roots()? {
        for circle in circles(&uses(&Source::below(&root)?, &root)) {
            let of: BTreeSet<Option<usize>> =
                circle.iter().map(|file| known.get(&(root.clone(), file.clone())).copied()).collect();
            match (of.len(), of.first()) {
                (1, Some(Some(at))) => seen.extend(circle.into_iter().map(|file| (*at, root.clone(), file))),
                _ => wrong.push(format!("{root}: {}", circle.join(", "))),
            }
        }
    }
    let gone = known.into_iter().filter(|((root, file), at)| !seen.contains(&(*at, root.clone(), file.clone())));
    wrong.extend(gone.map(|((root, file), _)| format!("{root}: {file} is in no circle any more and can leave KNOWN")));
    none("circles between files", &wrong)
}

/// For each file of a crate, the other files whose items its product code names.
fn uses(files: &[Source], root: &str) -> BTreeMap<Module, BTreeSet<Module>> {
    let product: BTreeMap<Module, String> =
        files.iter().filter(|file| !file.is_test()).map(|file| (module(&file.path, root), file.code())).collect();
    let named: BTreeMap<&Module, Vec<(bool, Module)>> =
        product.iter().map(|(module, code)| (module, named(module, code, &product))).collect();
    // A name that a module only hands on leads to where it is.
    let handed: BTreeMap<Module, &Module> = named
        .iter()
        .flat_map(|(module, paths)| {
            paths.iter().filter(|(is_handed_on, _)| *is_handed_on).filter_map(|(_, path)| {
                let name = path.last()?;
                Some(([module.as_slice(), std::slice::from_ref(name)].concat(), path))
            })
        })
        .collect();
    let place = |path: &Module| -> Module {
        let mut path = path.clone();
        for _ in 0..8 {
            // A module goes before a function of the same name.
            let is_module = |end: usize| end < path.len() && product.contains_key(&path[..end]);
            let longer =
                (1..=path.len()).filter(|end| !is_module(*end)).find_map(|end| Some((end, *handed.get(&path[..end])?)));
            match longer {
                Some((end, to)) if path[..end] != to[..] => path = [to.as_slice(), &path[end..]].concat(),
                _ => break,
            }
        }
        (0..=path.len())
            .rev()
            .map(|end| path[..end].to_vec())
            .find(|path| product.contains_key(path))
            .unwrap_or_default()
    };
    let mut found = BTreeMap::new();
    for (module, paths) in &named {
        let used = paths.iter().filter(|(is_handed_on, _)| !is_handed_on).map(|(_, path)| place(path));
        let apart = |other: &Module| !other.starts_with(module) && !module.starts_with(other);
        found.insert((*module).clone(), used.filter(apart).collect());
    }
    found
}

/// The module of a file.
fn module(path: &str, root: &str) -> Module {
    let below = path.strip_prefix(root).unwrap_or(path).trim_start_matches('/').trim_end_matches(".rs");
    if matches!(below, "lib" | "main") { Module::new() } else { below.split('/').map(str::to_owned).collect() }
}

/// Every path of this crate that code names, and whether it only hands it on (`pub use`).
fn named(module: &Module, code: &str, all: &BTreeMap<Module, String>) -> Vec<(bool, Module)> {
    let mut found = Vec::new();
    let mut rest = code.to_owned();
    for at in words(code, "use ") {
        let Some(end) = code[at..].find(';') else { continue };
        let line_start = code[..at].rfind('\n').map_or(0, |start| start + 1);
        let before = code[line_start..at].trim();
        if !(before.is_empty() || before.starts_with("pub")) {
            continue;
        }
        for path in spread(&code[at + 4..at + end]) {
            found.extend(absolute(module, &path, all).map(|path| (before.starts_with("pub"), path)));
        }
        rest.replace_range(at..at + end, &" ".repeat(end));
    }
    for start in ["crate::", "super::"] {
        for at in words(&rest, start) {
            if rest[..at].ends_with("::") {
                continue;
            }
            let end = rest[at..].find(|letter: char| !(letter.is_alphanumeric() || matches!(letter, '_' | ':')));
            let path = rest[at..end.map_or(rest.len(), |end| at + end)].trim_end_matches(':');
            found.extend(absolute(module, path, all).map(|path| (false, path)));
        }
    }
    found
}

/// The single paths of a tree of paths: `a::{b, c::{self, d}}` is `a::b`, `a::c` and `a::c::d`.
fn spread(tree: &str) -> Vec<String> {
    let tree: String = tree.chars().filter(|letter| !letter.is_whitespace() || *letter == ' ').collect();
    let tree = tree.trim();
    let Some((before, inside)) = tree.split_once('{') else {
        let path = tree.split(" as ").next().unwrap_or_default().trim();
        return vec![path.trim_end_matches("::self").to_owned()];
    };
    let inside = inside.trim_end().trim_end_matches('}');
    let (mut parts, mut depth, mut start) = (Vec::new(), 0_usize, 0);
    for (at, letter) in tree[before.len() + 1..].char_indices() {
        match letter {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                parts.push(&tree[before.len() + 1 + start..before.len() + 1 + at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    let last = tree[before.len() + 1 + start..].trim();
    parts.push(last.strip_suffix('}').unwrap_or(inside));
    let parts = parts.into_iter().map(str::trim).filter(|part| !part.is_empty());
    parts.flat_map(|part| spread(&format!("{}{part}", before.trim()))).collect()
}

/// A path from the root of the crate; none if it leads out of it.
fn absolute(module: &Module, path: &str, all: &BTreeMap<Module, String>) -> Option<Module> {
    let mut parts = path.split("::").map(str::trim).filter(|part| !part.is_empty()).peekable();
    let mut from = match *parts.peek()? {
        "crate" => {
            parts.next();
            Module::new()
        }
        "self" => {
            parts.next();
            module.clone()
        }
        "super" => module.clone(),
        first => {
            let child: Module = [module.as_slice(), &[first.to_owned()]].concat();
            if !all.contains_key(&child) {
                return None;
            }
            module.clone()
        }
    };
    while parts.next_if_eq(&"super").is_some() {
        from.pop();
    }
    from.extend(parts.map(str::to_owned));
    Some(from)
}

/// Groups of at least two files that reach each other.
fn circles(uses: &BTreeMap<Module, BTreeSet<Module>>) -> Vec<Vec<String>> {
    let reach: BTreeMap<&Module, BTreeSet<&Module>> = uses.keys().map(|from| (from, reached(uses, from))).collect();
    let mut found: BTreeSet<Vec<String>> = BTreeSet::new();
    for (from, reached) in &reach {
        let circle: Vec<String> = reached
            .iter()
            .filter(|other| **other == *from || reach.get(*other).is_some_and(|back| back.contains(*from)))
            .map(|module| module.join("/"))
            .collect();
        if circle.len() > 1 {
            found.insert(circle);
        }
    }
    found.into_iter().collect()
}

/// All that can be reached by at least one use.
fn reached<'a>(uses: &'a BTreeMap<Module, BTreeSet<Module>>, from: &Module) -> BTreeSet<&'a Module> {
    let (mut found, mut waiting) = (BTreeSet::new(), vec![from]);
    while let Some(module) = waiting.pop() {
        for next in uses.get(module).into_iter().flatten() {
            if found.insert(next) {
                waiting.push(next);
            }
        }
    }
    found
}

#[test]
fn circles_are_read_from_the_sources() {
    let file = |path: &str, text: &str| Source { path: format!("x/src/{path}"), text: text.to_owned() };
    let files = [
        file("lib.rs", "mod a;\nmod b;\nmod c;\npub use b::B;\n"),
        file("a.rs", "mod inner;\nuse crate::B;\npub(crate) struct A;"),
        file("a/inner.rs", "use super::A;\nuse crate::{c::{self, C}, a};"),
        file("b.rs", "fn f() { crate::c::g() }\npub struct B;"),
        file("c.rs", "// crate::b\nuse super::a::inner::X as Y;"),
        file("d.rs", "use crate::a::A;\n#[cfg(test)]\nmod tests {\n use crate::e::E;\n}"),
        file("e.rs", "use super::d;"),
    ];
    let found = uses(&files, "x/src");
    let of = |name: &str| found[&vec![name.to_owned()]].iter().map(|to| to.join("/")).collect::<Vec<_>>();
    assert_eq!((of("a"), of("b"), of("d")), (vec!["b".to_owned()], vec!["c".to_owned()], vec!["a".to_owned()]));
    assert_eq!(circles(&found), [["a/inner", "c"]]);
    assert_eq!(spread("crate::{a::{self, B}, c}"), ["crate::a", "crate::a::B", "crate::c"]);
}
