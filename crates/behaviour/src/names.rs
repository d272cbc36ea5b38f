//! From the names of streams to the argument names of procedures (thesis 6.2.1), and back when a stream is renamed.
//!
//! Letters and digits of every script stay, as Unicode counts them (UAX 31: `XID_Start`, `XID_Continue`), composed (NFC);
//! until 2026 only ASCII did. A body of before still means what it meant: [`arguments_of`].

mod composed;
pub(crate) mod look_alikes;
pub(crate) mod mistakes;
mod quotes;
mod scopes;
pub(crate) mod tokens;

use crate::{FillFrom, Lookup, LookupSet};
use composed::composed;
use scopes::{ReadProcedure, WordMeaning, read};
use std::borrow::Cow;
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

/// The argument names of a procedure from the names of its input streams, in order: `Red ball` becomes `redBall`, `距離`
/// stays.
pub fn argument_names<'a>(stream_names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let mut used = UsedNames::default();
    stream_names.into_iter().map(|name| used.first_free(argument_name(name, is_word))).collect()
}

/// Returns the names as they were before letters of every script stayed: `距離` was `x__`.
fn ascii_argument_names<'a>(stream_names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut used = UsedNames::default();
    stream_names.into_iter().map(|name| used.first_free(argument_name(name, is_plain))).collect()
}

/// The argument names that this body knows: those of today, but those of before where the body was written with them.
#[must_use]
pub fn arguments_of(body: &str, stream_names: &[&str]) -> Vec<String> {
    let today = argument_names(stream_names.iter().copied());
    if stream_names.iter().all(|name| name.is_ascii()) {
        return today;
    }
    let used: LookupSet<&str> = outer(body).into_iter().map(|place| &body[place]).collect();
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
    rename_identifiers(body, &arguments_of(body, stream_names), &argument_names(stream_names.iter().copied()))
}

fn argument_name(stream_name: &str, stays: fn(char) -> bool) -> String {
    let joined = first_lower(&join_words(stream_name.trim()));
    let plain: String = composed(&joined).chars().map(|c| if stays(c) { c } else { '_' }).collect();
    let allowed = if is_keyword(&plain) { format!("_{plain}") } else { plain };
    if begins_with_letter(&allowed) { allowed } else { format!("x{allowed}") }
}

/// A name as it looks, by which names are compared: without blanks around it, and with every letter and its marks as one
/// character (NFC), however it was written.
#[must_use]
pub fn as_looks(name: &str) -> Cow<'_, str> {
    let name = name.trim();
    if name.is_ascii() { Cow::Borrowed(name) } else { Cow::Owned(composed(name)) }
}

/// True if two names look the same.
#[must_use]
pub fn look_same(one: &str, other: &str) -> bool {
    as_looks(one) == as_looks(other)
}

/// True if the letter may stand in a name of a procedure: `_`, and letters and digits of every script.
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

/// True if a letter is the first but for underscores, as names of procedures need it.
fn begins_with_letter(name: &str) -> bool {
    name.chars().find(|c| *c != '_').is_some_and(|first| first.is_xid_start())
}

/// Names that are taken, and the number to try next for each name that was wanted twice.
#[derive(Default)]
struct UsedNames {
    names: LookupSet<String>,
    next: Lookup<String, u64>,
}

impl UsedNames {
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

/// The body with every use of the value `old` from outside replaced by `new`. What texts, comments, fields (`ball.x`) and
/// keys (`#{x: 1}`) say stays, and so do values of its own with that name; one that would take the place of `new` gets
/// another name.
#[must_use]
pub fn rename_identifier(body: &str, old: &str, new: &str) -> String {
    rename_identifiers(body, &[old], &[new])
}

/// The body with all values from outside under their new names at once, so that two may also be exchanged.
#[must_use]
pub fn rename_identifiers<S: AsRef<str>>(body: &str, old: &[S], new: &[S]) -> String {
    let names = old.iter().map(AsRef::as_ref).zip(new.iter().map(AsRef::as_ref));
    let names: Lookup<&str, &str> = names.filter(|(old, new)| old != new).filled();
    if names.is_empty() {
        return body.to_owned();
    }
    let read = read(body);
    let apart = apart(body, &read, &names);
    let word = |word: &scopes::ScopedWord| {
        let new = match word.meaning {
            WordMeaning::Outer => (*names.get(&body[word.place.clone()])?).to_owned(),
            WordMeaning::Local(local) => apart.get(&local)?.clone(),
            WordMeaning::Function | WordMeaning::Part => return None,
        };
        Some((word.place.clone(), new))
    };
    replaced(body, read.words.iter().filter_map(word))
}

/// Names for the values of its own that would take the place of a value from outside under its new name.
fn apart(body: &str, read: &ReadProcedure, names: &Lookup<&str, &str>) -> Lookup<usize, String> {
    let mut apart = Lookup::new();
    let mut taken: LookupSet<String> = read.words.iter().map(|word| body[word.place.clone()].to_owned()).filled();
    for word in read.words.iter().filter(|word| word.meaning == WordMeaning::Outer) {
        let Some(new) = names.get(&body[word.place.clone()]) else { continue };
        for local in read.known_at(word).iter().filter(|local| read.locals[**local] == *new) {
            if !apart.contains_key(local) {
                let free = crate::numbered(new, "").skip(1).find(|name| taken.insert(name.clone()));
                apart.insert(*local, free.unwrap_or_default());
            }
        }
    }
    apart
}

/// The body with another name in the place of one that means nothing there: a value, a function or a part of an object.
#[must_use]
pub fn rename_unknown(body: &str, arguments: &[String], old: &str, new: &str) -> String {
    let is_value = arguments.iter().any(|name| name == old);
    let means = |word: &&scopes::ScopedWord| match word.meaning {
        WordMeaning::Outer => !is_value,
        WordMeaning::Function | WordMeaning::Part => true,
        WordMeaning::Local(_) => false,
    };
    let words = read(body).words;
    let places = words.iter().filter(means).filter(|word| &body[word.place.clone()] == old);
    replaced(body, places.map(|word| (word.place.clone(), new.to_owned())))
}

/// The body with these texts in these places, which come in order.
fn replaced(body: &str, places: impl Iterator<Item = (Range<usize>, String)>) -> String {
    let mut made = String::with_capacity(body.len());
    let mut done = 0;
    for (place, new) in places {
        made.push_str(&body[done..place.start]);
        made.push_str(&new);
        done = place.end;
    }
    made.push_str(&body[done..]);
    made
}

/// The body with `new` where the value `old` from outside stands as a whole, without a part of it: `old < 1`, not
/// `old.x < 1`. None if it does so another number of `times`.
pub(crate) fn replace_whole(body: &str, old: &str, new: &str, times: usize) -> Option<String> {
    let is_whole = |place: &Range<usize>| {
        let rest = body[place.end..].trim_start();
        &body[place.clone()] == old && !rest.starts_with(['.', '[', '(', '?'])
    };
    let places: Vec<_> = outer(body).into_iter().filter(is_whole).collect();
    let new = |place| (place, new.to_owned());
    (places.len() == times).then(|| replaced(body, places.into_iter().map(new)))
}

/// Finds where `body` spells an argument another way (`redball` for `redBall`), as `(as written, as it should be)`.
#[must_use]
pub fn shown_spellings(body: &str, arguments: &[String]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for place in outer(body) {
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
    let new = |place: Range<usize>| Some((place.clone(), names.get(&body[place])?.clone()));
    replaced(body, uses(body).into_iter().filter_map(new))
}

/// Finds where `body` calls something, `distance(ball)`, or points to it, `Fn("distance")`.
fn uses(body: &str) -> Vec<Range<usize>> {
    places(body, WordMeaning::Function)
}

/// Finds where values from outside stand.
fn outer(body: &str) -> Vec<Range<usize>> {
    places(body, WordMeaning::Outer)
}

fn places(body: &str, meaning: WordMeaning) -> Vec<Range<usize>> {
    read(body).words.into_iter().filter(|word| word.meaning == meaning).map(|word| word.place).collect()
}

fn after_word(body: &str, start: usize) -> usize {
    body[start..].find(|c| !is_word(c)).map_or(body.len(), |length| start + length)
}

/// True if a name may begin with it.
fn is_name_start(c: char) -> bool {
    c == '_' || c.is_xid_start()
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
        assert_eq!(rename_identifier("near(near)", "near", "far"), "near(far)");
    }

    #[test]
    fn what_a_text_says_stays_and_what_is_code_in_it_follows() {
        let cases = [
            ("`the ball is at ${ball.x}`", "`the ball is at ${kite.x}`"),
            ("`one ${`ball ${ball.x}`} ball's`", "`one ${`ball ${kite.x}`} ball's`"),
            ("#\"a ball\"# + ball", "#\"a ball\"# + kite"),
        ];
        cases.into_iter().for_each(|(body, wanted)| assert_eq!(rename_identifier(body, "ball", "kite"), wanted));
    }

    #[test]
    fn values_of_its_own_keep_their_names_but_where_they_would_be_meant() {
        let cases = [
            ("let ball = ball.x; ball > 1", "let ball = kite.x; ball > 1"),
            ("[1].map(|ball| ball + 1) == ball", "[1].map(|ball| ball + 1) == kite"),
            ("let kite = 1; kite + ball", "let kite2 = 1; kite2 + kite"),
            ("[1].map(|kite| kite + ball.x)", "[1].map(|kite2| kite2 + kite.x)"),
            ("let kite = 1; kite", "let kite = 1; kite"),
        ];
        cases.into_iter().for_each(|(body, wanted)| assert_eq!(rename_identifier(body, "ball", "kite"), wanted));
        assert_eq!(super::rename_identifiers("a - b", &["a", "b"], &["b", "a"]), "b - a");
    }

    #[test]
    fn a_name_that_means_nothing_is_mended_wherever_it_is_one() {
        let mended = |body| super::rename_unknown(body, &["ball".to_owned()], "bal", "ball");
        assert_eq!(mended("bal.x + `bal ${bal.y}`"), "ball.x + `bal ${ball.y}`");
        assert_eq!(mended("let bal = ball.x; bal"), "let bal = ball.x; bal");
        assert_eq!(super::rename_unknown("naer(near)", &["near".to_owned()], "naer", "near"), "near(near)");
        assert_eq!(super::rename_unknown("siz + ball.siz", &["siz".to_owned()], "siz", "size"), "siz + ball.size");
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
    fn names_are_compared_as_they_look() {
        assert!(super::look_same("B\u{e9}l", " Be\u{301}l ") && super::look_same("ハ\u{309a}", "パ"));
        assert!(!super::look_same("Bel", "B\u{e9}l") && !super::look_same("Ball", "ball"));
    }

    #[test]
    fn helper_names_are_identifiers() {
        assert!(is_identifier("ball_to_distance") && is_identifier("_x1"));
        assert!(!is_identifier("2nd") && !is_identifier("if") && !is_identifier("a b") && !is_identifier(""));
    }
}
