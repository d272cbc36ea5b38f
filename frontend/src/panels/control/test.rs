//! A body that compares numbers, so that its numbers can be turned by hand: `distance < 40`, `d > 0.5 && d <= 1.0`. Pure.

use std::ops::Range;

/// How two values may be compared, longest sign first.
const SIGNS: [&str; 6] = ["<=", ">=", "==", "!=", "<", ">"];

/// At most so many comparisons in one body can be turned by hand.
const TESTS_MAX: usize = 2;

/// One comparison with a number.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct NumberTest {
    /// What is compared: an argument, or a field of one.
    pub(crate) subject: String,
    pub(crate) sign: &'static str,
    /// Where the sign and the number are written.
    pub(crate) sign_at: Range<usize>,
    pub(crate) number_at: Range<usize>,
    pub(crate) number: f64,
    /// How many places it has behind the point; none for a whole number.
    pub(crate) places: Option<usize>,
}

/// The comparisons of a body.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tests {
    pub(crate) all: Vec<NumberTest>,
    /// Whether one that is true is enough.
    any: bool,
}

impl Tests {
    /// Whether these values pass, one a comparison; nothing if there are none.
    pub(crate) fn passes(&self, values: &[f64]) -> Option<bool> {
        let mut each = self.all.iter().zip(values).map(|(test, value)| test.passes(*value));
        let passes = if self.any { each.any(|passes| passes) } else { each.all(|passes| passes) };
        (values.len() == self.all.len()).then_some(passes)
    }
}

/// The comparisons of a body, if it is nothing but one or two of them.
pub(crate) fn tests(body: &str) -> Option<Tests> {
    let joint = if body.contains("&&") { "&&" } else { "||" };
    let mut found = Vec::new();
    let mut start = 0;
    for part in body.split(joint) {
        found.push(test(part, start)?);
        start += part.len() + joint.len();
    }
    let any = joint == "||";
    (found.len() <= TESTS_MAX).then_some(Tests { all: found, any })
}

fn test(part: &str, start: usize) -> Option<NumberTest> {
    let (at, sign) = SIGNS
        .iter()
        .filter_map(|sign| Some((part.find(sign)?, *sign)))
        .min_by_key(|(at, sign)| (*at, 2 - sign.len()))?;
    let (subject, rest) = (part[..at].trim(), &part[at + sign.len()..]);
    let is_path = !subject.is_empty() && subject.split('.').all(behaviour::is_identifier);
    let text = rest.trim();
    let digits = text.strip_prefix('-').unwrap_or(text);
    let is_number = digits.starts_with(|c: char| c.is_ascii_digit())
        && digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.')
        && !digits.ends_with('.');
    if !is_path || !is_number {
        return None;
    }
    let number_start = start + at + sign.len() + (rest.len() - rest.trim_start().len());
    Some(NumberTest {
        subject: subject.to_owned(),
        sign,
        sign_at: start + at..start + at + sign.len(),
        number_at: number_start..number_start + text.len(),
        number: text.parse().ok()?,
        places: digits.split_once('.').map(|(_, places)| places.len()),
    })
}

impl NumberTest {
    /// How far one press of a stepper goes: about a fiftieth of what the number may be, round.
    pub(crate) fn step(&self) -> f64 {
        let size = self.number.abs();
        match self.places {
            None if size < 200.0 => 1.0,
            None => 10.0,
            Some(_) if size < 2.0 => 0.05,
            Some(_) if size < 20.0 => 0.5,
            Some(_) => 1.0,
        }
    }

    /// A number as this one is written: whole stays whole, and one with a point keeps it.
    pub(crate) fn written(&self, number: f64) -> String {
        written(self.places, number)
    }

    /// Whether a value passes.
    pub(crate) fn passes(&self, value: f64) -> bool {
        match self.sign {
            "<" => value < self.number,
            "<=" => value <= self.number,
            ">" => value > self.number,
            ">=" => value >= self.number,
            "==" => value == self.number,
            _ => value != self.number,
        }
    }
}

/// A number as an old one is written.
pub(crate) fn written_like(old: &str, number: f64) -> String {
    written(old.split_once('.').map(|(_, places)| places.len()), number)
}

fn written(places: Option<usize>, number: f64) -> String {
    let text = written_with(places, number);
    // What is rounded to nothing has no sign.
    let is_nothing = !text.contains(|c: char| ('1'..='9').contains(&c));
    if is_nothing { text.trim_start_matches('-').to_owned() } else { text }
}

fn written_with(places: Option<usize>, number: f64) -> String {
    match places {
        None if number.fract() == 0.0 => format!("{number:.0}"),
        None => trimmed(&format!("{number:.3}")),
        Some(places) => {
            let text = trimmed(&format!("{number:.*}", places.max(3)));
            if text.contains('.') { text } else { format!("{text}.0") }
        }
    }
}

fn trimmed(text: &str) -> String {
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The body with other text at a place.
pub(crate) fn replaced(body: &str, at: &Range<usize>, with: &str) -> String {
    let mut new = body.to_owned();
    new.replace_range(at.clone(), with);
    new
}

#[cfg(test)]
mod tests {
    use super::{replaced, tests};

    #[test]
    fn comparisons_with_numbers_are_found_where_they_stand() {
        let one = &tests("distance < 40").unwrap().all[0];
        assert_eq!((one.subject.as_str(), one.sign, one.number), ("distance", "<", 40.0));
        assert_eq!(replaced("distance < 40", &one.number_at, &one.written(45.0)), "distance < 45");
        let both = tests("d > 0.5 && seen.d <= -1.0").unwrap().all;
        assert_eq!((both[1].subject.as_str(), both[1].sign, both[1].number), ("seen.d", "<=", -1.0));
        assert_eq!(replaced("d > 0.5 && seen.d <= -1.0", &both[1].number_at, "2"), "d > 0.5 && seen.d <= 2");
        assert_eq!(replaced("d > 0.5 && seen.d <= -1.0", &both[0].sign_at, ">="), "d >= 0.5 && seen.d <= -1.0");
    }

    #[test]
    fn anything_else_is_left_to_the_dialog() {
        for body in [
            "",
            "touched",
            "a < b",
            "a < 1 && b",
            "(a) < 1",
            "a + 1 < 2",
            "a < 1.",
            "1 < a",
            "a < 1 && b < 2 && c < 3",
            "f(a) < 2",
            "a < 1e5",
        ] {
            assert_eq!(tests(body), None, "{body}");
        }
    }

    #[test]
    fn of_two_comparisons_both_must_be_true_or_one() {
        let both = tests("d > 20 && d < 80").unwrap();
        assert_eq!([50.0, 90.0].map(|d| both.passes(&[d, d])), [Some(true), Some(false)]);
        let either = tests("d < 20 || d > 80").unwrap();
        assert_eq!([10.0, 50.0, 90.0].map(|d| either.passes(&[d, d])), [Some(true), Some(false), Some(true)]);
        assert_eq!(either.passes(&[10.0]), None);
        assert_eq!(tests("a < 1 || b < 2 && c < 3"), None);
    }

    #[test]
    fn numbers_stay_as_they_are_written() {
        let whole = &tests("a < 40").unwrap().all[0];
        let point = &tests("a < 0.5").unwrap().all[0];
        assert_eq!((whole.written(41.0), whole.written(40.5)), ("41".to_owned(), "40.5".to_owned()));
        assert_eq!((point.written(0.55), point.written(1.0)), ("0.55".to_owned(), "1.0".to_owned()));
        assert_eq!((whole.step(), point.step()), (1.0, 0.05));
        assert!(point.passes(0.4) && !point.passes(0.5));
    }
}
