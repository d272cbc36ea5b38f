//! Reading Rust sources roughly, for the structure tests: what is code, what is not, how long functions are.

use std::path::{Path, PathBuf};

use crate::{Outcome, Trouble};

/// One Rust file.
pub struct Source {
    /// The path below the root, with `/` between the parts.
    pub path: String,
    /// The text as it is.
    pub text: String,
}

/// A function of a file.
#[derive(Debug, PartialEq, Eq)]
pub struct Function {
    /// The name of the function.
    pub name: String,
    /// The line on which it begins, from 1.
    pub line: usize,
    /// From that line to its closing brace, both counted.
    pub lines: usize,
}

impl Source {
    /// Every `.rs` file below `folder` of the repository, in the order of paths.
    pub fn below(folder: &str) -> Outcome<Vec<Source>> {
        let root = crate::root();
        let mut waiting = vec![root.join(folder)];
        let mut found = Vec::new();
        while let Some(folder) = waiting.pop() {
            for path in entries(&folder)? {
                if path.is_dir() {
                    waiting.push(path);
                } else if path.extension().is_some_and(|kind| kind == "rs") {
                    found.push(Source { path: relative(&root, &path), text: std::fs::read_to_string(&path)? });
                }
            }
        }
        found.sort_by(|one, other| one.path.cmp(&other.path));
        Ok(found)
    }

    /// The last part of the path.
    pub fn name(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or_default()
    }

    /// True if the whole file is for tests or benchmarks.
    pub fn is_test(&self) -> bool {
        let folder = self.path.split('/').any(|part| part == "tests" || part == "benches");
        folder || self.name() == "tests.rs" || self.name().ends_with("_tests.rs")
    }

    /// The product's code: comments, literals and test items are blank, lines stay where they are.
    pub fn code(&self) -> String {
        without_tests(code(&self.text))
    }

    /// The texts that the product's code writes out, each with its line.
    pub fn literals(&self) -> Vec<(usize, String)> {
        let marked = without_tests(masked(&self.text, LITERAL));
        let (mut found, mut line, mut text) = (Vec::new(), 1, String::new());
        for (mark, letter) in marked.chars().zip(self.text.chars()) {
            if mark == LITERAL {
                text.push(letter);
            } else if !text.is_empty() {
                found.push((line, content(&std::mem::take(&mut text))));
            }
            line += usize::from(letter == '\n');
        }
        found
    }
}

/// Returns every Rust file that is not a test.
pub fn product() -> Outcome<Vec<Source>> {
    let mut files = Source::below("crates")?;
    files.extend(Source::below("frontend")?);
    files.retain(|file| !file.is_test());
    Ok(files)
}

/// Fails with one line for each of `wrong`; `what` says what they are.
pub fn none<T: AsRef<str>>(what: &str, wrong: &[T]) -> Outcome<()> {
    let lines: Vec<&str> = wrong.iter().map(AsRef::as_ref).collect();
    if lines.is_empty() { Ok(()) } else { Err(Trouble(format!("{} {what}:\n  {}", lines.len(), lines.join("\n  ")))) }
}

/// The mark that stands for every letter of a literal; no source has it.
const LITERAL: char = '\u{e000}';

/// Returns the text between the marks of a literal.
fn content(literal: &str) -> String {
    let inside =
        |end: char| literal.split_once(end).and_then(|(_, rest)| rest.rsplit_once(end)).map(|(inside, _)| inside);
    inside('"').or_else(|| inside('\'')).unwrap_or(literal).to_owned()
}

fn entries(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    Ok(entries.collect::<std::io::Result<_>>()?)
}

fn relative(root: &Path, path: &Path) -> String {
    let below = path.strip_prefix(root).unwrap_or(path);
    below.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}

/// `text` with comments and literals blanked out.
pub fn code(text: &str) -> String {
    masked(text, ' ')
}

/// `text` with comments blanked out, and `literal` for every letter of a literal.
fn masked(text: &str, literal: char) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let in_word = out.chars().next_back().is_some_and(is_word);
        let (keep, length) = match blank(rest, in_word) {
            0 => (true, first.len_utf8()),
            length => (false, length),
        };
        let (now, later) = rest.split_at(length);
        let instead = if now.starts_with("//") || now.starts_with("/*") { ' ' } else { literal };
        out.extend(now.chars().map(|letter| if keep || letter == '\n' { letter } else { instead }));
        rest = later;
    }
    out
}

/// Counts the bytes at the start of `rest` that are a comment or a literal.
fn blank(rest: &str, in_word: bool) -> usize {
    if rest.starts_with("//") {
        return rest.find('\n').unwrap_or(rest.len());
    }
    if rest.starts_with("/*") {
        return comment(rest);
    }
    if rest.starts_with('"') {
        return quoted(rest, '"');
    }
    match rest.as_bytes() {
        [b'r', b'"' | b'#', ..] if !in_word => raw(rest),
        [b'b' | b'c', b'r', b'"' | b'#', ..] if !in_word => 1 + raw(&rest[1..]),
        [b'\'', ..] => character(rest),
        _ => 0,
    }
}

/// A block comment, which may hold others.
fn comment(rest: &str) -> usize {
    let (mut depth, mut at) = (0_u32, 0);
    while at < rest.len() {
        let here = &rest.as_bytes()[at..];
        let step = match here {
            [b'/', b'*', ..] => 1,
            [b'*', b'/', ..] => -1,
            _ => 0,
        };
        depth = depth.saturating_add_signed(step);
        at += if step == 0 { 1 } else { 2 };
        if depth == 0 {
            return at;
        }
    }
    rest.len()
}

/// A literal that ends with `end`, where a backslash takes the next letter.
fn quoted(rest: &str, end: char) -> usize {
    let mut letters = rest.char_indices().skip(1);
    while let Some((at, letter)) = letters.next() {
        if letter == '\\' {
            letters.next();
        } else if letter == end {
            return at + letter.len_utf8();
        }
    }
    rest.len()
}

/// A raw text, or 0 for a raw name such as `r#type`.
fn raw(rest: &str) -> usize {
    let hashes = rest[1..].bytes().take_while(|byte| *byte == b'#').count();
    if rest.as_bytes().get(1 + hashes) != Some(&b'"') {
        return 0;
    }
    let end = format!("\"{}", "#".repeat(hashes));
    let start = hashes + 2;
    rest[start..].find(&end).map_or(rest.len(), |at| start + at + end.len())
}

/// A character, or 0 for a lifetime.
fn character(rest: &str) -> usize {
    let mut letters = rest.chars().skip(1);
    match (letters.next(), letters.next()) {
        (Some('\\'), _) | (Some(_), Some('\'')) => quoted(rest, '\''),
        _ => 0,
    }
}

/// `code` with every item after `#[cfg(test)]` blanked out, letter by letter.
fn without_tests(mut code: String) -> String {
    const MARK: &str = "#[cfg(test)]";
    while let Some(start) = code.find(MARK) {
        let end = start + MARK.len();
        let end = end + item(&code[end..]).unwrap_or(code.len() - end);
        let empty: String = code[start..end].chars().map(|letter| if letter == '\n' { letter } else { ' ' }).collect();
        code.replace_range(start..end, &empty);
    }
    code
}

/// The length of an item: to its `;`, or to the brace that closes its body.
fn item(code: &str) -> Option<usize> {
    let mut nested = 0_i32;
    for (at, letter) in code.char_indices() {
        match letter {
            '(' | '[' => nested += 1,
            ')' | ']' => nested -= 1,
            ';' if nested == 0 => return Some(at + 1),
            '{' if nested == 0 => return block(&code[at..]).map(|length| at + length),
            _ => {}
        }
    }
    None
}

/// The length of a block that begins with a brace.
fn block(code: &str) -> Option<usize> {
    let mut depth = 0_i32;
    for (at, letter) in code.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(at + 1);
        }
    }
    None
}

/// The functions with a body in `code`, which `Source::code` has made.
pub fn functions(code: &str) -> Vec<Function> {
    words(code, "fn").filter_map(|start| function(code, start)).collect()
}

fn function(code: &str, start: usize) -> Option<Function> {
    let name: String = code[start + 2..].trim_start().chars().take_while(|letter| is_word(*letter)).collect();
    let length = item(&code[start..])?;
    let whole = &code[start..start + length];
    let counts = |text: &str| text.bytes().filter(|byte| *byte == b'\n').count() + 1;
    let real = !name.is_empty() && whole.ends_with('}');
    real.then(|| Function { name, line: counts(&code[..start]), lines: counts(whole) })
}

/// Returns the places where `word` stands in `code` as a whole word; `word` may hold more than letters.
pub fn words<'a>(code: &'a str, word: &'a str) -> impl Iterator<Item = usize> {
    code.match_indices(word).map(|(at, _)| at).filter(move |at| {
        let before = code[..*at].chars().next_back();
        let after = code[at + word.len()..].chars().next();
        let continues = word.ends_with(is_word) && after.is_some_and(is_word);
        !before.is_some_and(is_word) && !continues
    })
}

fn is_word(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_literals_are_not_code() {
        let text = "a // x\nb /* y /* z */ w */ c \"d { \\\" e\" r#\"f \" g\"# '{' 'a 'b' '\\'' r#type";
        let kept: Vec<String> = code(text).split_whitespace().map(str::to_owned).collect();
        assert_eq!(kept, ["a", "b", "c", "'a", "r#type"]);
        assert_eq!(code("\"a\nb\"").matches('\n').count(), 1);
    }

    #[test]
    fn test_items_are_not_product_code() {
        let text = "fn a() {}\n#[cfg(test)]\nmod tests {\n fn b() { { } }\n}\n#[cfg(test)]\nuse x;\nfn c() {}";
        let source = Source { path: "x.rs".to_owned(), text: text.to_owned() };
        let names: Vec<String> = functions(&source.code()).into_iter().map(|function| function.name).collect();
        assert_eq!(names, ["a", "c"]);
        assert_eq!(source.code().lines().count(), text.lines().count());
    }

    #[test]
    fn literals_of_the_product_have_their_lines() {
        let text =
            "const A: &str = \"a\"; // \"b\"\n#[cfg(test)]\nconst B: &str = \"é\";\nx(r#\"c\"#, 'd', \"\", b\"e\");";
        let source = Source { path: "x.rs".to_owned(), text: text.to_owned() };
        let found: Vec<(usize, String)> =
            [(1, "a"), (4, "c"), (4, "d"), (4, ""), (4, "e")].map(|(line, text)| (line, text.to_owned())).into();
        assert_eq!(source.literals(), found);
    }

    #[test]
    fn functions_are_measured_and_declarations_are_not() {
        let text =
            "trait A { fn no(x: [u8; 2]);\n fn one(f: fn(u8)) -> u8 {\n 1\n }\n}\nfn two<T>(x: T)\nwhere T: B {\n}";
        let found: Vec<(String, usize, usize)> =
            functions(&code(text)).into_iter().map(|f| (f.name, f.line, f.lines)).collect();
        assert_eq!(found, [("one".to_owned(), 2, 3), ("two".to_owned(), 6, 3)]);
    }

    #[test]
    fn words_are_whole() {
        assert_eq!(words("tokio atokio tokio_x tokio::y", "tokio").collect::<Vec<_>>(), [0, 21]);
        assert_eq!(words("x.sin() y.sinh()", ".sin()").count(), 0);
        assert_eq!(words(" .sin()", ".sin()").count(), 1);
    }
}
