//! Signs in procedures that look right and are others: of wide keyboards, of word processors, of tablets; and numbers with
//! a comma before their decimals. None of them can stand there in a procedure that runs, so reading them as what they mean
//! changes none that does. What stands in a text stays.

use super::quotes::quoted;
use super::tokens::{Bracket, PlacedToken, TokenKind, tokens};
use crate::{TypedNumber, has_unseen, typed_number};

/// A procedure as it is probably meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AsMeant {
    /// The first part that only looks right.
    pub from: String,
    /// The text that it means.
    pub to: String,
    /// The whole procedure.
    pub body: String,
}

/// Returns the procedure that is meant where signs only look right: one, or two where a number may be read in two ways;
/// none if all signs are right. Names that are `arguments` stay.
#[must_use]
pub fn as_meant(body: &str, arguments: &[String]) -> Vec<AsMeant> {
    let (plain, mut first) = with_plain_signs(body, arguments);
    let mut done = String::with_capacity(plain.len());
    let mut from = 0;
    for (place, number) in decimal_commas(&plain) {
        done.push_str(&plain[from..place.start]);
        match number {
            TypedNumber::Is(number) => {
                let written = measured(number);
                first.get_or_insert_with(|| (plain[place.clone()].to_owned(), written.clone()));
                done.push_str(&written);
            }
            TypedNumber::Either(grouped, decimal) => {
                let ways = [format!("{grouped}"), measured(decimal)];
                let rest = &plain[place.end..];
                return ways
                    .map(|to| AsMeant { from: plain[place.clone()].to_owned(), body: format!("{done}{to}{rest}"), to })
                    .into();
            }
        }
        from = place.end;
    }
    done.push_str(&plain[from..]);
    first.map(|(from, to)| AsMeant { from, to, body: done }).into_iter().collect()
}

/// With a point, so that it stays a measured number.
fn measured(number: f64) -> String {
    let text = format!("{number}");
    if text.contains('.') { text } else { format!("{text}.0") }
}

/// The procedure in plain signs, and the first that was none with what it means.
fn with_plain_signs(body: &str, arguments: &[String]) -> (String, Option<(String, String)>) {
    let (mut plain, mut first, mut done) = (String::with_capacity(body.len()), None, 0);
    for PlacedToken { kind, place } in tokens(body) {
        let written = &body[place.clone()];
        let means = match kind {
            TokenKind::Sign => sign(written),
            TokenKind::Text => quoted(written).map(|_| in_plain_quotes(written)),
            TokenKind::Word if arguments.iter().all(|name| name != written) => narrow(written),
            _ => None,
        };
        if let Some(means) = means {
            plain.push_str(&body[done..place.start]);
            plain.push_str(&means);
            done = place.end;
            first.get_or_insert_with(|| (written.to_owned(), means));
        }
    }
    plain.push_str(&body[done..]);
    (plain, first)
}

/// Returns the sign that is meant by one that only looks right.
fn sign(written: &str) -> Option<String> {
    let c = written.chars().next()?;
    let means = match c {
        _ if c.is_ascii() => return None,
        '−' | '–' | '—' | '\u{2010}' | '\u{2011}' | '﹣' => "-",
        '×' | '∗' | '⋅' | '·' | '✕' => "*",
        '÷' | '∕' | '⁄' => "/",
        '≤' | '≦' | '⩽' => "<=",
        '≥' | '≧' | '⩾' => ">=",
        '≠' => "!=",
        '∧' => "&&",
        '∨' => "||",
        '¬' => "!",
        '、' => ",",
        _ if c.is_whitespace() => " ",
        _ if has_unseen(written) => "",
        _ => return narrow(written),
    };
    Some(means.to_owned())
}

/// Wide letters, digits and signs as plain ones.
fn narrow(written: &str) -> Option<String> {
    let is_wide = |c: char| ('\u{ff01}'..='\u{ff5e}').contains(&c);
    let plain = |c: char| if is_wide(c) { char::from_u32(c as u32 - 0xfee0).unwrap_or(c) } else { c };
    written.contains(is_wide).then(|| written.chars().map(plain).collect())
}

fn in_plain_quotes(written: &str) -> String {
    let mut inside = written.chars();
    inside.next();
    inside.next_back();
    format!("\"{}\"", inside.as_str().replace('"', "\\\""))
}

/// Numbers with a comma before their decimals, where no comma can stand.
fn decimal_commas(body: &str) -> Vec<(std::ops::Range<usize>, TypedNumber)> {
    let tokens = tokens(body);
    let text = |at: usize| tokens.get(at).map_or("", |token: &PlacedToken| &body[token.place.clone()]);
    let is = |at: usize, kind: TokenKind| tokens.get(at).is_some_and(|token| token.kind == kind);
    let chooses = tokens.iter().enumerate().any(|(at, token)| token.kind == TokenKind::Word && text(at) == "switch");
    // For each bracket that is open, whether commas may stand in it.
    let (mut open, mut found): (Vec<bool>, Vec<_>) = (Vec::new(), Vec::new());
    for at in 0..tokens.len() {
        match tokens[at].kind {
            TokenKind::Open(Bracket::Round) => {
                let before = at.checked_sub(1).map(|before| tokens[before].kind);
                open.push(matches!(before, Some(TokenKind::Word | TokenKind::Close(_) | TokenKind::Text)));
            }
            TokenKind::Open(Bracket::Square | Bracket::Map) => open.push(true),
            TokenKind::Open(Bracket::Block | Bracket::Hole) => open.push(chooses),
            TokenKind::Close(_) => drop(open.pop()),
            TokenKind::Number
                if !open.last().copied().unwrap_or(false) && is(at + 2, TokenKind::Number) && text(at + 1) == "," =>
            {
                let (first, last) = (&tokens[at].place, &tokens[at + 2].place);
                let is_alone = (at == 0 || text(at - 1) != ".") && text(at + 3) != "." && text(at + 3) != ",";
                let is_one = first.end + 1 == last.start && is_alone;
                let number = typed_number(&body[first.start..last.end]).filter(|_| is_one);
                found.extend(number.map(|number| (first.start..last.end, number)));
            }
            _ => {}
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::as_meant;

    fn meant(body: &str) -> Vec<String> {
        as_meant(body, &["distance".to_owned(), "Ｄ".to_owned()]).into_iter().map(|one| one.body).collect()
    }

    #[test]
    fn signs_that_look_right_are_read_as_what_they_mean() {
        let cases = [
            ("distance\u{3000}< 0.5", "distance < 0.5"),
            ("distance\u{a0}<\u{202f}0.5", "distance < 0.5"),
            ("distance ＜ ０．５", "distance < 0.5"),
            ("ｍａｘ（distance，１）", "max(distance,1)"),
            ("Ｄ ＞ 1", "Ｄ > 1"),
            ("“near”", "\"near\""),
            ("„near“ + ‘it’", "\"near\" + \"it\""),
            ("“say \"no\"”", "\"say \"no\"”"),
            ("distance ≤ 0.5", "distance <= 0.5"),
            ("distance ≠ −2 × 3 ÷ 4 && distance ≥ 1", "distance != -2 * 3 / 4 && distance >= 1"),
            ("distance\u{200b} < 1", "distance < 1"),
            ("distance < 0,5", "distance < 0.5"),
            ("(distance < 0,5) && distance > 1,25", "(distance < 0.5) && distance > 1.25"),
            ("distance ＜ ０，５", "distance < 0.5"),
            ("`${distance × 2} × ， “a”`", "`${distance * 2} × ， “a”`"),
            ("if distance < 1,5 { 2,5 } else { 3 }", "if distance < 1.5 { 2.5 } else { 3 }"),
        ];
        for (body, wanted) in cases {
            assert_eq!(meant(body), [wanted], "{body}");
        }
    }

    #[test]
    fn what_is_said_and_what_is_right_stays() {
        for body in [
            "distance < 0.5",
            "\"１，５ × “a” 0,5\"",
            "`≤ “a” 0,5`",
            "distance // × 0,5\n",
            "max(0,5)",
            "[0,5]",
            "#{a: 1,b: 2}",
            "switch distance { 1 => 2,3 => 4 }",
            "distance.max(0,5)",
            "",
            "“open",
            "1.0,5",
        ] {
            assert_eq!(meant(body), [""; 0], "{body}");
        }
    }

    #[test]
    fn a_number_that_may_be_two_is_both() {
        assert_eq!(meant("distance < 1,000 × 2"), ["distance < 1000 * 2", "distance < 1.0 * 2"]);
    }
}
