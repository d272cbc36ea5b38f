//! From the names of streams to the argument names of procedures (thesis 6.2.1), and back when a stream is renamed.
//!
//! Letters and digits of every script stay, as Unicode counts them (UAX 31: `XID_Start`, `XID_Continue`), composed (NFC);
//! until 2026 only ASCII did. A body of before still means what it meant: [`arguments_of`].

mod composed;

use crate::{Filled, Lookup, LookupSet};
use composed::composed;
use std::collections::BTreeMap;
use std::ops::Range;
use unicode_xid::UnicodeXID;

/// Words that Rhai 1.27 keeps for itself; the engine's tests hold this list against Rhai.
const RHAI_KEYWORDS: &[&str] = &[
    "Fn",
    "as",
    "async",
    "await",
    "break",
    "call",
    "case",
    "catch",
    "const",
    "continue",
    "curry",
    "debug",
    "default",
    "do",
    "else",
    "eval",
    "export",
    "false",
    "fn",
    "for",
    "go",
    "goto",
    "if",
    "import",
    "in",
    "is",
    "is_def_fn",
    "is_def_var",
    "is_shared",
    "let",
    "loop",
    "match",
    "module",
    "new",
    "nil",
    "null",
    "package",
    "print",
    "private",
    "protected",
    "public",
    "return",
    "shared",
    "spawn",
    "static",
    "super",
    "switch",
    "sync",
    "this",
    "thread",
    "throw",
    "true",
    "try",
    "type_of",
    "until",
    "use",
    "var",
    "void",
    "while",
    "with",
    "yield",
];

/// How a body begins to point to a helper.
const POINTER: &str = "Fn(\"";

/// The argument names of a procedure from the names of its input streams, in order: `Red ball` becomes `redBall`, `距離`
/// stays.
pub fn argument_names<'a>(stream_names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let mut used = Used::default();
    stream_names.into_iter().map(|name| used.first_free(argument_name(name, is_word))).collect()
}

/// The same names as they were before letters of every script stayed: `距離` was `x__`.
fn ascii_argument_names<'a>(stream_names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut used = Used::default();
    stream_names.into_iter().map(|name| used.first_free(argument_name(name, is_plain))).collect()
}

/// The argument names that this body knows: those of today, but those of before where the body was written with them.
#[must_use]
pub fn arguments_of(body: &str, stream_names: &[&str]) -> Vec<String> {
    let today = argument_names(stream_names.iter().copied());
    if stream_names.iter().all(|name| name.is_ascii()) {
        return today;
    }
    let used: LookupSet<&str> = variables(body).into_iter().map(|place| &body[place]).collect();
    let before = ascii_argument_names(stream_names.iter().copied());
    let known = |(today, before): (String, String)| {
        let is_old = today != before && used.contains(before.as_str()) && !used.contains(today.as_str());
        if is_old { before } else { today }
    };
    today.into_iter().zip(before).map(known).collect()
}

/// The body with the argument names of today, if it was written with those of before.
#[must_use]
pub fn in_names_of_today(body: &str, stream_names: &[&str]) -> String {
    let pairs = arguments_of(body, stream_names).into_iter().zip(argument_names(stream_names.iter().copied()));
    pairs.fold(body.to_owned(), |body, (old, new)| if old == new { body } else { rename_identifier(&body, &old, &new) })
}

fn argument_name(stream_name: &str, stays: fn(char) -> bool) -> String {
    let joined = first_lower(&join_words(stream_name.trim()));
    let plain: String = composed(&joined).chars().map(|c| if stays(c) { c } else { '_' }).collect();
    let allowed = if is_keyword(&plain) { format!("_{plain}") } else { plain };
    if begins_with_letter(&allowed) { allowed } else { format!("x{allowed}") }
}

/// Whether the letter may stand in a name of a procedure: `_`, and letters and digits of every script.
#[must_use]
pub fn is_name_letter(letter: char) -> bool {
    is_word(letter)
}

fn is_word(c: char) -> bool {
    c == '_' || c.is_xid_continue()
}

fn join_words(name: &str) -> String {
    let mut joined = String::new();
    let mut after_space = false;
    for c in name.chars() {
        if c.is_whitespace() {
            after_space = true;
        } else if after_space {
            joined.extend(c.to_uppercase());
            after_space = false;
        } else {
            joined.push(c);
        }
    }
    joined
}

fn first_lower(name: &str) -> String {
    let mut rest = name.chars();
    rest.next().map_or_else(String::new, |first| first.to_lowercase().chain(rest).collect())
}

fn is_keyword(name: &str) -> bool {
    RHAI_KEYWORDS.contains(&name)
}

/// Whether a letter is the first but for underscores, as names of procedures need it.
fn begins_with_letter(name: &str) -> bool {
    name.chars().find(|c| *c != '_').is_some_and(|first| first.is_xid_start())
}

/// Names that are taken, and the number to try next for each name that was wanted twice.
#[derive(Default)]
struct Used {
    names: LookupSet<String>,
    next: Lookup<String, u64>,
}

impl Used {
    /// The name, or with the first number that is free.
    fn first_free(&mut self, name: String) -> String {
        if self.names.insert(name.clone()) {
            return name;
        }
        let next = self.next.entry(name.clone()).or_insert(2);
        loop {
            let numbered = format!("{name}{next}");
            *next += 1;
            if self.names.insert(numbered.clone()) {
                return numbered;
            }
        }
    }
}

/// True if `name` can name a helper or one of its parameters in Rhai.
#[must_use]
pub fn is_identifier(name: &str) -> bool {
    name.chars().all(is_word) && begins_with_letter(name) && !is_keyword(name)
}

/// The body with every use of the variable `old` replaced by `new`. Texts, comments, fields (`ball.x`) and keys
/// (`#{x: 1}`) keep their spelling.
#[must_use]
pub fn rename_identifier(body: &str, old: &str, new: &str) -> String {
    replaced(body, variables(body).into_iter().filter(|place| &body[place.clone()] == old), new)
}

/// The body with `new` in these places.
fn replaced(body: &str, places: impl Iterator<Item = Range<usize>>, new: &str) -> String {
    let mut made = String::with_capacity(body.len());
    let mut done = 0;
    for place in places {
        made.push_str(&body[done..place.start]);
        made.push_str(new);
        done = place.end;
    }
    made.push_str(&body[done..]);
    made
}

/// The body with `new` where the variable `old` stands as a whole, without a part of it: `old < 1`, not `old.x < 1`. None
/// if it does so another number of `times`.
pub(crate) fn replace_whole(body: &str, old: &str, new: &str, times: usize) -> Option<String> {
    let is_whole = |place: &Range<usize>| {
        let rest = body[place.end..].trim_start();
        &body[place.clone()] == old && !rest.starts_with(['.', '[', '(', '?'])
    };
    let places: Vec<_> = variables(body).into_iter().filter(is_whole).collect();
    (places.len() == times).then(|| replaced(body, places.into_iter(), new))
}

/// The body with every field `old` (`ball.old`) under its new name. Variables, texts, comments and keys keep theirs.
#[must_use]
pub(crate) fn rename_field(body: &str, old: &str, new: &str) -> String {
    let fields = words(body).into_iter().filter(|place| is_field(body.as_bytes(), place.start));
    replaced(body, fields.filter(|place| &body[place.clone()] == old), new)
}

/// Where `body` spells an argument another way (`redball` for `redBall`), as `(as written, as it should be)`.
#[must_use]
pub fn shown_spellings(body: &str, arguments: &[String]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for place in variables(body) {
        let written = &body[place];
        let right = arguments.iter().find(|argument| is_same_but_case(argument, written) && *argument != written);
        if let Some(right) = right.filter(|_| !arguments.iter().any(|argument| argument == written)) {
            found.push((written.to_owned(), right.clone()));
        }
    }
    found.into_iter().distinct()
}

fn is_same_but_case(one: &str, other: &str) -> bool {
    one.len() == other.len() && one.to_lowercase() == other.to_lowercase()
}

/// True if `body` calls the helper, `distance(ball)`, or points to it, `Fn("distance")`. An argument that happens
/// to have the helper's name is no call.
#[must_use]
pub fn calls_helper(body: &str, helper: &str) -> bool {
    called_names(body).contains(&helper)
}

/// The names of everything that `body` calls, `distance(ball)`, or points to, `Fn("distance")`: helpers and functions of
/// the language, each once, in the order of the alphabet.
#[must_use]
pub fn called_names(body: &str) -> Vec<&str> {
    uses(body).into_iter().map(|place| &body[place]).distinct()
}

/// The body with every helper that it uses under its new name, all at once. Arguments, fields and texts keep theirs.
#[must_use]
pub fn rename_helpers(body: &str, names: &BTreeMap<String, String>) -> String {
    let mut places = uses(body);
    places.sort_unstable_by_key(|place| place.start);
    let mut renamed = String::with_capacity(body.len());
    let mut done = 0;
    for place in places {
        let new = names.get(&body[place.clone()]).filter(|_| place.start >= done);
        if let Some(new) = new {
            renamed.push_str(&body[done..place.start]);
            renamed.push_str(new);
            done = place.end;
        }
    }
    renamed.push_str(&body[done..]);
    renamed
}

/// Where `body` calls something, `distance(ball)`, or points to it, `Fn("distance")`.
fn uses(body: &str) -> Vec<Range<usize>> {
    let opens = |place: &Range<usize>| body[place.end..].trim_start().starts_with('(');
    let mut found: Vec<_> = variables(body).into_iter().filter(opens).collect();
    for (at, before) in body.match_indices(POINTER) {
        let start = at + before.len();
        let end = after_word(body, start);
        if body[end..].starts_with("\")") {
            found.push(start..end);
        }
    }
    found
}

/// Where variables and function names stand in a Rhai text.
fn variables(body: &str) -> Vec<Range<usize>> {
    let bytes = body.as_bytes();
    let is_variable = |place: &Range<usize>| !is_field(bytes, place.start) && !is_key(bytes, place.end);
    words(body).into_iter().filter(is_variable).collect()
}

/// Where words stand in a Rhai text, outside of texts and comments.
fn words(body: &str) -> Vec<Range<usize>> {
    let bytes = body.as_bytes();
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        at = match bytes[at] {
            b'"' => after_quoted(bytes, at, b'"'),
            b'\'' => after_quoted(bytes, at, b'\''),
            b'/' if bytes.get(at + 1) == Some(&b'/') => after_line(bytes, at),
            b'/' if bytes.get(at + 1) == Some(&b'*') => after_comment(bytes, at),
            byte if byte.is_ascii_digit() => after_word(body, at),
            _ => match body[at..].chars().next() {
                Some(c) if c == '_' || c.is_xid_start() => {
                    let end = after_word(body, at);
                    found.push(at..end);
                    end
                }
                other => at + other.map_or(1, char::len_utf8),
            },
        };
    }
    found
}

fn after_quoted(bytes: &[u8], start: usize, quote: u8) -> usize {
    let mut at = start + 1;
    while at < bytes.len() && bytes[at] != quote {
        at += if bytes[at] == b'\\' { 2 } else { 1 };
    }
    (at + 1).min(bytes.len())
}

fn after_line(bytes: &[u8], start: usize) -> usize {
    bytes[start..].iter().position(|byte| *byte == b'\n').map_or(bytes.len(), |length| start + length)
}

fn after_comment(bytes: &[u8], start: usize) -> usize {
    let mut depth = 0_usize;
    let mut at = start;
    while at < bytes.len() {
        let pair = (bytes[at], bytes.get(at + 1).copied().unwrap_or(b' '));
        match pair {
            (b'/', b'*') => depth += 1,
            (b'*', b'/') => depth -= 1,
            _ => {
                at += 1;
                continue;
            }
        }
        at += 2;
        if depth == 0 {
            break;
        }
    }
    at.min(bytes.len())
}

fn after_word(body: &str, start: usize) -> usize {
    body[start..].find(|c| !is_word(c)).map_or(body.len(), |length| start + length)
}

fn is_field(bytes: &[u8], start: usize) -> bool {
    let before: Vec<u8> =
        bytes[..start].iter().rev().copied().filter(|byte| !byte.is_ascii_whitespace()).take(2).collect();
    before.first() == Some(&b'.') && before.get(1) != Some(&b'.')
}

fn is_key(bytes: &[u8], end: usize) -> bool {
    let mut after = bytes[end..].iter().copied().filter(|byte| !byte.is_ascii_whitespace());
    after.next() == Some(b':') && after.next() != Some(b':')
}

#[cfg(test)]
mod tests {
    use super::{
        argument_names, arguments_of, calls_helper, in_names_of_today, is_identifier, rename_identifier,
        shown_spellings,
    };

    #[test]
    fn stream_names_become_argument_names() {
        let cases = [
            ("Red ball", "redBall"),
            ("RedBall", "redBall"),
            ("this", "_this"),
            ("Ball#2", "ball_2"),
            ("2nd Ball", "x2ndBall"),
            ("fn", "_fn"),
            ("_2 ball", "x_2Ball"),
            ("赤いボール", "赤いボール"),
            ("距離", "距離"),
            ("距離　近い", "距離近い"),
            ("Größe 2", "größe2"),
            ("e\u{301}cart", "\u{e9}cart"),
            ("٣ كرات", "x٣كرات"),
            ("Ball 🔴", "ball_"),
            ("Мяч рядом", "мячРядом"),
            ("Print", "_print"),
            ("", "x"),
            (" a-b ", "a_b"),
            ("HEAD yaw", "hEADYaw"),
            ("Head Yaw", "headYaw"),
            ("-", "x_"),
            ("exit", "exit"),
            ("Switch", "_switch"),
        ];
        for (stream, argument) in cases {
            assert_eq!(argument_names([stream]), [argument], "{stream:?}");
        }
        assert_eq!(argument_names(["Red ball", "RedBall", "red  ball"]), ["redBall", "redBall2", "redBall3"]);
        assert_eq!(argument_names(["b", "b2", "b", "b", "b2"]), ["b", "b2", "b3", "b4", "b22"]);
    }

    #[test]
    fn a_body_of_before_knows_its_arguments() {
        let names = ["距離", "Red ball", "角度"];
        let cases = [
            ("x__ < redBall", ["x__", "redBall", "角度"]),
            ("距離 < x__2", ["距離", "redBall", "x__2"]),
            ("距離 + x__", ["距離", "redBall", "角度"]),
            ("redBall // x__", ["距離", "redBall", "角度"]),
        ];
        for (body, known) in cases {
            assert_eq!(arguments_of(body, &names), known, "{body}");
        }
        assert_eq!(in_names_of_today("x__ < x__2 && r.x__ > 1", &names), "距離 < 角度 && r.x__ > 1");
        assert_eq!(in_names_of_today("redBall < 1", &names), "redBall < 1");
    }

    #[test]
    fn words_of_every_script_are_found() {
        assert_eq!(
            rename_identifier("距離 < 20 && 距離2 > x.距離 /* 距離 */", "距離", "d"),
            "d < 20 && 距離2 > x.距離 /* 距離 */"
        );
        assert_eq!(rename_identifier("「距離」+距離", "距離", "d"), "「d」+d");
        assert_eq!(super::called_names("近い(距離)　+ é(1)").into_iter().collect::<Vec<_>>(), ["é", "近い"]);
        assert!(is_identifier("近い") && is_identifier("_é2") && !is_identifier("٣a") && !is_identifier("a・ b"));
    }

    #[test]
    fn renaming_touches_variables_only() {
        let body = r#"ball.ball + ball /* ball */ + #{ball: ball}["ball"] // ball"#;
        let renamed = r#"b.ball + b /* ball */ + #{ball: b}["ball"] // ball"#;
        assert_eq!(rename_identifier(body, "ball", "b"), renamed);
        assert_eq!(rename_identifier("x1 + x + 1x", "x", "y"), "x1 + y + 1x");
        assert_eq!(rename_identifier("0..ball", "ball", "b"), "0..b");
        assert_eq!(super::rename_field(body, "ball", "b"), body.replace("ball.ball", "ball.b"));
    }

    #[test]
    fn the_spelling_of_the_thesis_is_recognised() {
        let arguments = ["distanceToBall".to_owned()];
        let offered = shown_spellings("distancetoball < 20 && distanceToBall > 1", &arguments);
        assert_eq!(offered, [("distancetoball".to_owned(), "distanceToBall".to_owned())]);
    }

    #[test]
    fn a_helper_is_used_where_it_is_called() {
        for body in ["distance(ball)", "1 + ball.distance (2)", "[b].map(Fn(\"distance\"))", "`${distance(b)}`"] {
            assert_eq!(calls_helper(body, "distance"), !body.contains("ball.d"), "{body}");
        }
        for body in ["distance < 20", "distances(b)", "// distance(b)", "#{distance: 1}", ""] {
            assert!(!calls_helper(body, "distance"), "{body}");
        }
    }

    #[test]
    fn what_a_body_calls_is_found_at_once() {
        let body = "near(x) + near(far (1)) + [1].map(Fn(\"close\")) + y.gone(2) // no(1)";
        assert_eq!(super::called_names(body).into_iter().collect::<Vec<_>>(), ["Fn", "close", "far", "near"]);
    }

    #[test]
    fn helpers_get_their_new_names_all_at_once() {
        let names = [("near".to_owned(), "near2".to_owned()), ("near2".to_owned(), "near22".to_owned())].into();
        let body = "near(x) && near2 (x) || near < 1 && [x].map(Fn(\"near\")) && \"near(x)\" == x.near(1) // near(x)";
        let wanted =
            "near2(x) && near22 (x) || near < 1 && [x].map(Fn(\"near2\")) && \"near(x)\" == x.near(1) // near(x)";
        assert_eq!(super::rename_helpers(body, &names), wanted);
    }

    #[test]
    fn helper_names_are_identifiers() {
        assert!(is_identifier("ball_to_distance") && is_identifier("_x1"));
        assert!(!is_identifier("2nd") && !is_identifier("if") && !is_identifier("a b") && !is_identifier(""));
    }
}
