//! Slips in procedures that run and cannot be meant: `=` for `==` in a test, and whole numbers divided as if they were
//! measured.

use super::tokens::{Bracket, PlacedToken, TokenKind, tokens};

/// The test with `==` in the place of each `=`; none if it has none, or does more than ask.
pub(crate) fn compared(body: &str) -> Option<String> {
    let tokens = tokens(body);
    let text = |token: &PlacedToken| &body[token.place.clone()];
    let does_more = |token: &PlacedToken| match token.kind {
        TokenKind::Sign => text(token) == ";",
        TokenKind::Word => matches!(text(token), "let" | "const"),
        TokenKind::Open(Bracket::Block) => true,
        _ => false,
    };
    if tokens.iter().any(does_more) {
        return None;
    }
    let stores: Vec<_> = tokens.iter().filter(|token| token.kind == TokenKind::Sign && text(token) == "=").collect();
    let (mut made, mut done) = (String::new(), 0);
    for token in &stores {
        made.push_str(&body[done..token.place.start]);
        made.push_str("==");
        done = token.place.end;
    }
    made.push_str(&body[done..]);
    (!stores.is_empty()).then_some(made)
}

/// Two whole numbers of which one is divided by the other, and something is left over.
pub(crate) struct Divided {
    /// The division, as it is written.
    pub(crate) written: String,
    /// The whole number that it gives.
    pub(crate) gives: i64,
    /// The division that is probably meant.
    pub(crate) meant: String,
    /// The procedure with that.
    pub(crate) body: String,
}

/// The first division of two whole numbers that leaves something over.
pub(crate) fn divided(body: &str) -> Option<Divided> {
    let tokens = tokens(body);
    let text = |at: usize| tokens.get(at).map_or("", |token| &body[token.place.clone()]);
    let whole = |at: usize| match tokens.get(at)?.kind {
        TokenKind::Number => text(at).parse::<i64>().ok(),
        _ => None,
    };
    (0..tokens.len()).find_map(|at| {
        let (one, other) = (whole(at)?, whole(at + 2).filter(|other| *other != 0)?);
        let before = at.checked_sub(1).map_or("", text);
        let is_alone = !matches!(before, "." | "*" | "/" | "%" | "**") && !matches!(text(at + 3), "." | "**");
        if text(at + 1) != "/" || !is_alone || one % other == 0 {
            return None;
        }
        let (first, last) = (&tokens[at].place, &tokens[at + 2].place);
        let meant = format!("{one}.0{}", &body[first.end..last.end]);
        Some(Divided {
            written: body[first.start..last.end].to_owned(),
            gives: one / other,
            body: format!("{}{meant}{}", &body[..first.start], &body[last.end..]),
            meant,
        })
    })
}

#[cfg(test)]
mod tests {
    use super::{compared, divided};

    #[test]
    fn a_test_asks_and_stores_nothing() {
        assert_eq!(compared("sonar = 0.5").as_deref(), Some("sonar == 0.5"));
        assert_eq!(compared("a > 1 && b = \"=\"").as_deref(), Some("a > 1 && b == \"=\""));
        for body in
            ["a == 1", "a <= 1", "a != 1", "a >= 1", "let a = 1; a", "\"=\"", "a *= 2", "[1].map(|x| { x = 1 })", ""]
        {
            assert_eq!(compared(body), None, "{body}");
        }
    }

    #[test]
    fn whole_numbers_that_are_divided_leave_something_over() {
        let found = |body| divided(body).map(|found| (found.written, found.gives, found.body));
        let wanted = |written: &str, gives, body: &str| Some((written.to_owned(), gives, body.to_owned()));
        assert_eq!(found("sonar < 1/2"), wanted("1/2", 0, "sonar < 1.0/2"));
        assert_eq!(found("7 / 2 * x"), wanted("7 / 2", 3, "7.0 / 2 * x"));
        for body in ["x / 2", "1.0/2", "1/2.0", "4/2", "x * 1/2", "\"1/2\"", "1/0", "`1/2`", "// 1/2", "2/x"] {
            assert_eq!(found(body), None, "{body}");
        }
    }
}
