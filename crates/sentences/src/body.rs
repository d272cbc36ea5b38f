//! Simple bodies of procedures, read without the language itself: tests, fields and constants, with the places of their
//! literals.

use behaviour::is_name_letter;
use std::ops::Range;

/// A part of a body.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SpokenBodyPart {
    /// A name; of an argument, its number.
    Name(String, Option<usize>),
    /// A number as it is written.
    Number(f64),
    /// A text.
    Text(String),
    /// An operator or another sign.
    Sign(&'static str),
}

/// Signs, the longer ones first.
const SIGNS: [&str; 24] = [
    "<=", ">=", "==", "!=", "&&", "||", "<", ">", "!", ".", "+", "-", "*", "/", "(", ")", "{", "}", "[", "]", ",", ":",
    "#", "%",
];

/// The parts of a body whose arguments have these names, each with its bytes. None if anything else stands there.
pub(crate) fn parts(body: &str, args: &[String]) -> Option<Vec<(SpokenBodyPart, Range<usize>)>> {
    let mut found: Vec<(SpokenBodyPart, Range<usize>)> = Vec::new();
    let mut at = 0;
    while at < body.len() {
        let rest = &body[at..];
        let first = rest.chars().next()?;
        if first.is_whitespace() {
            at += first.len_utf8();
            continue;
        }
        let (part, length) = if first.is_ascii_digit() {
            number(rest)?
        } else if is_name_letter(first) {
            let is_field = matches!(found.last(), Some((SpokenBodyPart::Sign("."), _)));
            name(rest, if is_field { &[] } else { args })
        } else if first == '"' {
            text(rest)?
        } else if rest.starts_with("//") || rest.starts_with("/*") {
            return None;
        } else {
            let sign = SIGNS.iter().find(|sign| rest.starts_with(**sign))?;
            (SpokenBodyPart::Sign(sign), sign.len())
        };
        found.push((part, at..at + length));
        at += length;
    }
    Some(found)
}

fn number(rest: &str) -> Option<(SpokenBodyPart, usize)> {
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(rest);
    let fraction = rest[whole..].strip_prefix('.').map_or(0, digits);
    let length = if fraction > 0 { whole + 1 + fraction } else { whole };
    let is_plain = !rest[length..].starts_with(is_name_letter);
    is_plain.then_some((SpokenBodyPart::Number(rest[..length].parse().ok()?), length))
}

fn name(rest: &str, args: &[String]) -> (SpokenBodyPart, usize) {
    let length = rest.find(|c| !is_name_letter(c)).unwrap_or(rest.len());
    let name = &rest[..length];
    (SpokenBodyPart::Name(name.to_owned(), args.iter().position(|arg| arg == name)), length)
}

fn text(rest: &str) -> Option<(SpokenBodyPart, usize)> {
    let mut inside = String::new();
    let mut chars = rest.char_indices().skip(1);
    while let Some((at, c)) = chars.next() {
        match c {
            '"' => return Some((SpokenBodyPart::Text(inside), at + 1)),
            '\\' => inside.push(match chars.next()?.1 {
                'n' => '\n',
                same @ ('"' | '\\') => same,
                _ => return None,
            }),
            c => inside.push(c),
        }
    }
    None
}

/// A text as a body writes it.
pub(crate) fn text_literal(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n"))
}

/// A body with its arguments as `$0`, `$1` and without white space, to compare bodies by; as it is if it is not simple.
pub(crate) fn skeleton(body: &str, args: &[String]) -> String {
    let Some(parts) = parts(body, args) else { return body.to_owned() };
    let mut all = String::new();
    for (part, _) in parts {
        let piece = match part {
            SpokenBodyPart::Name(_, Some(number)) => format!("${number}"),
            SpokenBodyPart::Name(name, None) => format!(" {name}"),
            SpokenBodyPart::Number(number) => format!(" {number}"),
            SpokenBodyPart::Text(text) => text_literal(&text),
            SpokenBodyPart::Sign(sign) => sign.to_owned(),
        };
        all.push_str(&piece);
    }
    all
}

/// The names of a body that are no calls, no fields and not of its own making, in the order in which they come first.
pub(crate) fn free_names(body: &str) -> Vec<String> {
    const WORDS: [&str; 9] = ["if", "else", "true", "false", "let", "const", "for", "in", "return"];
    let mut found: Vec<String> = Vec::new();
    let mut own: Vec<String> = Vec::new();
    let mut before = String::new();
    let mut at = 0;
    while at < body.len() {
        let rest = &body[at..];
        let first = rest.chars().next().unwrap_or_default();
        let length = match first {
            '"' => text(rest).map_or(rest.len(), |(_, length)| length),
            letter if is_name_letter(letter) => {
                let (_, length) = name(rest, &[]);
                let after = rest[length..].trim_start();
                let is_field = body[..at].trim_end().ends_with('.') && !body[..at].trim_end().ends_with("..");
                let is_key = after.starts_with(':') && !after.starts_with("::");
                let word = &rest[..length];
                if ["let", "const", "for"].contains(&before.as_str()) {
                    own.push(word.to_owned());
                }
                let counts = !letter.is_numeric() && !is_field && !is_key && !after.starts_with('(');
                let known = WORDS.contains(&word) || own.iter().chain(&found).any(|name| name == word);
                if counts && !known {
                    found.push(word.to_owned());
                }
                word.clone_into(&mut before);
                length
            }
            '/' if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            '/' if rest.starts_with("/*") => rest.find("*/").map_or(rest.len(), |end| end + 2),
            other => other.len_utf8(),
        };
        at += length;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{free_names, skeleton};

    #[test]
    fn bodies_are_compared_without_the_names_of_their_arguments() {
        let args = ["soFar".to_owned(), "touch".to_owned()];
        assert_eq!(skeleton("if touch { soFar + 1 } else { soFar }", &args), " if$1{$0+ 1} else{$0}");
        assert_eq!(skeleton("x.touch < 1.0", &args), " x. touch< 1");
    }

    #[test]
    fn free_names_are_those_of_arguments() {
        let body = "let y = near(ball); #{v: y + ball.x, t: head.y} // é";
        assert_eq!(free_names(body), ["ball", "head"]);
        assert_eq!(free_names("x*x > 2"), ["x"]);
        assert_eq!(free_names("\"x\" + 1e5"), Vec::<String>::new());
    }
}
