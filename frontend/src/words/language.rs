//! In which language the page speaks, and its table of the second one: the English text, and below it how it is said.
//!
//! English is written where it is used. Another language is one file (`static/ja.txt`), fetched before the page starts and
//! only where it is chosen: blocks with an empty line between, the English text first, then what is said instead. Holes
//! (`{name}`) have the same names in both; `{name*}` is said in that language too. What the server and the rules say comes
//! in English, whole: it is found by what stands between its holes ([`translated`]).

use std::cell::OnceCell;
use std::collections::HashMap;
use std::fmt::Display;

/// Remarks between which texts with holes are only those of the page: short ones would fit what others say by chance.
const PAGE_ONLY: &str = "# Only the page says these:";
const PAGE_ENDS: &str = "# Others say these too:";
/// The most texts within texts that are followed.
const DEPTH_MAX: usize = 4;

/// The texts of a second language.
#[derive(Debug, Default)]
pub(crate) struct WordTable {
    texts: HashMap<&'static str, &'static str>,
    /// Those with holes, by what they begin with first: the longest words first.
    patterns: Vec<Pattern>,
}

/// An English text with holes, cut at them.
#[derive(Debug)]
struct Pattern {
    /// What stands around the holes, one more than there are holes.
    around: Vec<&'static str>,
    holes: Vec<&'static str>,
    said: &'static str,
}

thread_local! {
    static TABLE: OnceCell<WordTable> = const { OnceCell::new() };
}

/// Begins to speak the language of this table. It counts once, before anything is shown.
pub(crate) fn speak(text: String) {
    TABLE.with(|table| {
        let _ = table.set(WordTable::read(text.leak()));
    });
}

/// Whether the page speaks a second language.
pub(crate) fn is_second() -> bool {
    TABLE.with(|table| table.get().is_some())
}

/// How this English text is said; itself where it has no other words.
pub(crate) fn said(text: &'static str) -> &'static str {
    told(text).unwrap_or(text)
}

/// How this English text is said in the second language, if that is spoken.
pub(super) fn told(text: &str) -> Option<&'static str> {
    TABLE.with(|table| table.get()?.texts.get(text).copied())
}

/// The English texts that are said like this, for finding something by its English name too; empty in English.
pub(crate) fn english(said: &str) -> String {
    TABLE.with(|table| {
        let texts = table.get().into_iter().flat_map(|table| &table.texts);
        let mut found: Vec<&str> = texts.filter(|(_, own)| **own == said).map(|(english, _)| *english).collect();
        found.sort_unstable();
        found.join(" ")
    })
}

/// A text with its holes filled.
pub(super) fn fill(text: &str, holes: &[(&str, &dyn Display)]) -> String {
    filled(text, &|name| holes.iter().find(|(hole, _)| *hole == name).map(|(_, value)| value.to_string()), 0)
}

/// What was said in English elsewhere (by the server, the rules, a device), as this page says it.
pub(crate) fn translated(text: &str) -> String {
    deeper(text, 0)
}

fn deeper(text: &str, depth: usize) -> String {
    if depth > DEPTH_MAX || text.is_empty() {
        return text.to_owned();
    }
    TABLE.with(|table| table.get().and_then(|table| table.translate(text, depth))).unwrap_or_else(|| text.to_owned())
}

impl WordTable {
    fn read(text: &'static str) -> Self {
        let (mut table, mut page_only) = (Self::default(), false);
        for block in text.split("\n\n") {
            page_only = (page_only || block.contains(PAGE_ONLY)) && !block.contains(PAGE_ENDS);
            let mut lines = block.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
            if let (Some(english), Some(said)) = (lines.next(), lines.next()) {
                table.texts.insert(english, said);
                if !page_only && english.contains('{') {
                    table.patterns.push(Pattern::of(english, said));
                }
            }
        }
        table
            .patterns
            .sort_by_key(|pattern| std::cmp::Reverse(pattern.around.iter().map(|part| part.len()).sum::<usize>()));
        table
    }

    fn translate(&self, text: &str, depth: usize) -> Option<String> {
        if let Some(said) = self.texts.get(text).or_else(|| self.texts.get(small(text).as_str())) {
            return Some((*said).to_owned());
        }
        let pattern = |text: &str| {
            let (pattern, holes) = self.patterns.iter().find_map(|pattern| Some((pattern, pattern.fits(text)?)))?;
            let value = |name: &str| {
                let at = pattern.holes.iter().position(|hole| *hole == name)?;
                holes.get(at).map(|hole| (*hole).to_owned())
            };
            Some(filled(pattern.said, &value, depth))
        };
        pattern(text).or_else(|| self.listed(text)).or_else(|| self.in_parts(text, depth))
    }

    /// Words with commas between, if each of them is known: "red, green, blue".
    fn listed(&self, text: &str) -> Option<String> {
        let said: Option<Vec<&str>> = text.split(", ").map(|part| self.texts.get(part).copied()).collect();
        said.map(|said| said.join("、"))
    }

    /// Several sentences one after the other, or one with a full stop that it has not alone.
    fn in_parts(&self, text: &str, depth: usize) -> Option<String> {
        if let Some((first, rest)) = text.split_once(". ") {
            let first = format!("{first}.");
            return Some(format!("{}{}", self.translate(&first, depth)?, deeper(rest, depth + 1)));
        }
        if let Some((fault, advice)) = text.rsplit_once("; ") {
            return Some(format!("{}。{}", self.translate(fault, depth)?, deeper(advice, depth + 1)));
        }
        let bare = text.strip_suffix('.')?;
        Some(format!(
            "{}。",
            self.texts
                .get(bare)
                .copied()
                .map_or_else(|| self.translate_bare(bare, depth), |said| Some(said.to_owned()))?
        ))
    }

    fn translate_bare(&self, text: &str, depth: usize) -> Option<String> {
        if depth > DEPTH_MAX { None } else { self.translate(text, depth + 1) }
    }
}

/// As it stands within a sentence.
fn small(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().into_iter().flat_map(char::to_lowercase).chain(rest).collect()
}

impl Pattern {
    fn of(english: &'static str, said: &'static str) -> Self {
        let (mut around, mut holes, mut rest) = (Vec::new(), Vec::new(), english);
        while let Some((before, after)) = rest.split_once('{') {
            let Some((hole, after)) = after.split_once('}') else { break };
            around.push(before);
            holes.push(hole.split(':').next().unwrap_or(hole));
            rest = after;
        }
        around.push(rest);
        Self { around, holes, said }
    }

    /// What stands in the holes, if the text is made of this.
    fn fits<'text>(&self, text: &'text str) -> Option<Vec<&'text str>> {
        let (first, others) = self.around.split_first()?;
        let mut rest = text.strip_prefix(first)?;
        // Words are needed: two holes alone would be anything.
        if self.around.iter().all(|part| part.chars().filter(|letter| letter.is_alphanumeric()).count() < 2) {
            return None;
        }
        let mut holes = Vec::new();
        for (at, part) in others.iter().enumerate() {
            let (hole, after) =
                if at + 1 == others.len() { (rest.strip_suffix(part)?, "") } else { rest.split_once(part)? };
            holes.push(hole);
            rest = after;
        }
        Some(holes)
    }
}

fn filled(text: &str, value: &dyn Fn(&str) -> Option<String>, depth: usize) -> String {
    let (mut made, mut rest) = (String::new(), text);
    while let Some((before, after)) = rest.split_once('{') {
        let Some((hole, after)) = after.split_once('}') else { break };
        made.push_str(before);
        let (name, also) = hole.strip_suffix('*').map_or((hole, false), |name| (name, true));
        let found = value(name).unwrap_or_default();
        made.push_str(&if also { deeper(&found, depth + 1) } else { found });
        rest = after;
    }
    made.push_str(rest);
    made
}

#[cfg(test)]
mod tests {
    use super::{fill, is_second, said, speak, told, translated};

    const TEXTS: &str = "# A remark.\nStart\n開始\n\n{by} is editing {what}. Ask, or wait until it is free.\n{by} さんが{what*}を編集中です。\n\nthe filter\n条件\n\n{part} is held by {name}\n{name} が{part}を使用中\n";

    #[test]
    fn a_second_language_is_a_table() {
        assert_eq!(said("Start"), "Start");
        assert!(!is_second());
        speak(TEXTS.to_owned());
        assert!(is_second());
        assert_eq!((said("Start"), said("Stop")), ("開始", "Stop"));
        let text = told("{part} is held by {name}").unwrap_or_default();
        assert_eq!(fill(text, &[("part", &"{name}"), ("name", &"Aiko")]), "Aiko が{name}を使用中");
    }

    #[test]
    fn what_only_the_page_says_is_not_looked_for_elsewhere() {
        let table = "# Only the page says these:\n\n{one} to {other}\n{other}への{one}\n\n# Others say these too:\n\nAsk {name}.\n{name} さんに頼んでください。\n";
        speak(table.to_owned());
        assert_eq!(told("{one} to {other}"), Some("{other}への{one}"));
        assert_eq!(translated("Nothing leads to Ball"), "Nothing leads to Ball");
        assert_eq!(translated("Ask Yuki."), "Yuki さんに頼んでください。");
    }

    #[test]
    fn what_others_say_is_found_by_what_stands_between_its_holes() {
        speak(TEXTS.to_owned());
        let text = |text: &str| translated(text);
        assert_eq!(text("Yuki is editing the filter. Ask, or wait until it is free."), "Yuki さんが条件を編集中です。");
        assert_eq!(text("Start. Nobody knows this."), "開始。Nobody knows this.");
        assert_eq!(text("Nobody knows this."), "Nobody knows this.");
        assert_eq!(text(""), "");
    }
}
