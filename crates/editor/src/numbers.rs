//! Numbers of a connector that are changed where they stand: the comparisons of a body, such as `distance < 40` or
//! `d > 0.5 && d <= 1.0`, a number anywhere in a body, and a duration.

use behaviour::{Operation, Parameters, Procedure, RATE_MS};
use std::ops::Range;

/// The signs by which two values may be compared, the longest first.
const SIGNS: [&str; 6] = ["<=", ">=", "==", "!=", "<", ">"];

/// The most comparisons in one body that can be turned by hand.
const TESTS_MAX: usize = 2;

/// One comparison with a number.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberTest {
    /// The compared value: an argument, or a field of one.
    pub subject: String,
    /// The sign between both.
    pub sign: &'static str,
    /// The bytes of the body that are the sign.
    pub sign_at: Range<usize>,
    /// The bytes of the body that are the number.
    pub number_at: Range<usize>,
    /// The number.
    pub number: f64,
    /// The places that it has behind the point; none for a whole number.
    places: Option<usize>,
}

/// The comparisons of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberTests {
    /// All of them, from left to right.
    pub all: Vec<NumberTest>,
    /// True if one that is true is enough.
    any: bool,
}

impl NumberTests {
    /// Tells if these values pass, one a comparison; nothing if there are none.
    #[must_use]
    pub fn passes(&self, values: &[f64]) -> Option<bool> {
        let mut each = self.all.iter().zip(values).map(|(test, value)| test.passes(*value));
        let passes = if self.any { each.any(|passes| passes) } else { each.all(|passes| passes) };
        (values.len() == self.all.len()).then_some(passes)
    }
}

/// Returns the comparisons of a body, if it is nothing but one or two of them.
#[must_use]
pub fn number_tests(body: &str) -> Option<NumberTests> {
    let joint = if body.contains("&&") { "&&" } else { "||" };
    let mut found = Vec::new();
    let mut start = 0;
    for part in body.split(joint) {
        found.push(test(part, start)?);
        start += part.len() + joint.len();
    }
    let any = joint == "||";
    (found.len() <= TESTS_MAX).then_some(NumberTests { all: found, any })
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
    /// Returns how far one press of a stepper goes: about a fiftieth of what the number may be, round.
    #[must_use]
    pub fn step(&self) -> f64 {
        let size = self.number.abs();
        match self.places {
            None if size < 200.0 => 1.0,
            None => 10.0,
            Some(_) if size < 2.0 => 0.05,
            Some(_) if size < 20.0 => 0.5,
            Some(_) => 1.0,
        }
    }

    /// Returns a number as this one is written: whole stays whole, and one with a point keeps it.
    #[must_use]
    pub fn written(&self, number: f64) -> String {
        written(self.places, number)
    }

    /// Tells if a value passes.
    #[must_use]
    pub fn passes(&self, value: f64) -> bool {
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

fn written(places: Option<usize>, number: f64) -> String {
    let text = written_with(places, number);
    // A number that is rounded to nothing has no sign.
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

/// Returns a body with other text at a place.
#[must_use]
pub fn replaced(body: &str, at: &Range<usize>, with: &str) -> String {
    let mut new = body.to_owned();
    new.replace_range(at.clone(), with);
    new
}

/// Returns an operation with another text at a place of its body; none if that place is gone.
#[must_use]
pub fn with_text(operation: &Operation, at: &Range<usize>, text: &str) -> Option<Operation> {
    let mut operation = operation.clone();
    let Procedure::Body { body, .. } = operation.procedure_mut()? else { return None };
    body.get(at.clone())?;
    *body = replaced(body, at, text);
    Some(operation)
}

/// Returns an operation with another number at a place of its body, written as the old one; none if that place is gone.
#[must_use]
pub fn with_number(operation: &Operation, at: &Range<usize>, number: f64) -> Option<Operation> {
    let Procedure::Body { body, .. } = operation.procedure()? else { return None };
    let places = body.get(at.clone())?.split_once('.').map(|(_, places)| places.len());
    with_text(operation, at, &written(places, number))
}

/// Returns an operation with another duration in milliseconds, as short or as long as there are.
#[must_use]
pub fn with_period(operation: &Operation, ms: f64) -> Operation {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is too small or too large is kept within"
    )]
    let ms = (ms.round().max(0.0) as u64).clamp(*RATE_MS.start(), *RATE_MS.end());
    let (procedure, start) = (operation.procedure().cloned(), operation.start().cloned());
    operation.spec().with(Parameters { period_ms: Some(ms), procedure, start })
}

#[cfg(test)]
mod tests {
    use super::{number_tests, replaced, with_number, with_period, with_text};
    use behaviour::{Parameters, Procedure, connectors};

    #[test]
    fn comparisons_with_numbers_are_found_where_they_stand() {
        let one = &number_tests("distance < 40").unwrap().all[0];
        assert_eq!((one.subject.as_str(), one.sign, one.number), ("distance", "<", 40.0));
        assert_eq!(replaced("distance < 40", &one.number_at, &one.written(45.0)), "distance < 45");
        let both = number_tests("d > 0.5 && seen.d <= -1.0").unwrap().all;
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
            assert_eq!(number_tests(body), None, "{body}");
        }
    }

    #[test]
    fn of_two_comparisons_both_must_be_true_or_one() {
        let both = number_tests("d > 20 && d < 80").unwrap();
        assert_eq!([50.0, 90.0].map(|d| both.passes(&[d, d])), [Some(true), Some(false)]);
        let either = number_tests("d < 20 || d > 80").unwrap();
        assert_eq!([10.0, 50.0, 90.0].map(|d| either.passes(&[d, d])), [Some(true), Some(false), Some(true)]);
        assert_eq!(either.passes(&[10.0]), None);
        assert_eq!(number_tests("a < 1 || b < 2 && c < 3"), None);
    }

    #[test]
    fn numbers_stay_as_they_are_written() {
        let whole = &number_tests("a < 40").unwrap().all[0];
        let point = &number_tests("a < 0.5").unwrap().all[0];
        assert_eq!((whole.written(41.0), whole.written(40.5)), ("41".to_owned(), "40.5".to_owned()));
        assert_eq!((point.written(0.55), point.written(1.0)), ("0.55".to_owned(), "1.0".to_owned()));
        assert_eq!((whole.step(), point.step()), (1.0, 0.05));
        assert!(point.passes(0.4) && !point.passes(0.5));
    }

    #[test]
    fn what_is_changed_stands_where_it_stood() {
        let filter = connectors::filter::SPEC.with(Procedure::body("distance < 40"));
        let body = |made: Option<behaviour::Operation>| made.and_then(|made| made.procedure().cloned());
        assert_eq!(body(with_number(&filter, &(11..13), 45.0)), Some(Procedure::body("distance < 45")));
        assert_eq!(body(with_text(&filter, &(9..10), ">=")), Some(Procedure::body("distance >= 40")));
        assert_eq!(with_number(&filter, &(90..99), 1.0), None, "that place is gone");
        let sample = connectors::sample::SPEC.with(Parameters::period(1_000));
        assert_eq!(with_number(&sample, &(0..1), 1.0), None, "it has no body");
        let periods = [2_000.0, 0.0, f64::MAX].map(|ms| with_period(&sample, ms).period_ms());
        assert_eq!(periods, [2_000, *behaviour::RATE_MS.start(), *behaviour::RATE_MS.end()].map(Some));
    }
}
