//! Tests of values as the grammar knows them: one or two comparisons, or something that is true or not.

use crate::body::{SpokenBodyPart, parts, text_literal};
use std::ops::Range;

/// How a value is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Comparison {
    Less,
    AtMost,
    More,
    AtLeast,
    Is,
    IsNot,
}

/// All comparisons with their signs and the words by which the grammar's rules are named.
pub(crate) const COMPARISONS: [(Comparison, &str, &str); 6] = [
    (Comparison::Less, "<", "less"),
    (Comparison::AtMost, "<=", "atMost"),
    (Comparison::More, ">", "more"),
    (Comparison::AtLeast, ">=", "atLeast"),
    (Comparison::Is, "==", "is"),
    (Comparison::IsNot, "!=", "isNot"),
];

impl Comparison {
    pub(crate) fn sign(self) -> &'static str {
        COMPARISONS[self as usize].1
    }

    pub(crate) fn word(self) -> &'static str {
        COMPARISONS[self as usize].2
    }

    pub(crate) fn opposite(self) -> Self {
        match self {
            Self::Less => Self::AtLeast,
            Self::AtMost => Self::More,
            Self::More => Self::AtMost,
            Self::AtLeast => Self::Less,
            Self::Is => Self::IsNot,
            Self::IsNot => Self::Is,
        }
    }

    /// True if a number passes beside this one.
    pub(crate) fn passes(self, number: f64, beside: f64) -> bool {
        match self {
            Self::Less => number < beside,
            Self::AtMost => number <= beside,
            Self::More => number > beside,
            Self::AtLeast => number >= beside,
            Self::Is => number == beside,
            Self::IsNot => number != beside,
        }
    }

    /// Whether it bounds a value from one side, so that two of them make a range.
    pub(crate) fn bounds(self) -> bool {
        !matches!(self, Self::Is | Self::IsNot)
    }
}

/// What is asked of a value, or of one of its fields.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ValueTest {
    /// The field; none for the value itself.
    pub(crate) field: Option<String>,
    pub(crate) asks: Asks,
}

/// What is asked.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Asks {
    /// Whether it is true, or whether it is not.
    Truth(bool),
    /// How it compares with one number, or with two.
    Numbers(Vec<(Comparison, f64)>),
    /// Whether it is this text, or whether it is not.
    Text(bool, String),
}

/// The places in a body of what a test compares with: of each comparison its sign and its number.
pub(crate) type TestPlaces = Vec<(Range<usize>, Range<usize>)>;

/// A side of `&&` or `||`: its field, its comparison and the literal.
pub(crate) struct TestSide {
    pub(crate) field: Option<String>,
    pub(crate) comparison: Comparison,
    pub(crate) literal: SpokenBodyPart,
    places: (Range<usize>, Range<usize>),
}

impl TestSide {
    /// The bytes of its literal in the body.
    pub(crate) fn literal_at(&self) -> Range<usize> {
        self.places.1.clone()
    }
}

/// The comparisons of a body over one argument, and true if one of them is enough. None if it is anything else.
pub(crate) fn comparisons(body: &str, args: &[String]) -> Option<(Vec<TestSide>, bool)> {
    let [_] = args else { return None };
    let all = parts(body, args)?;
    let any = all.iter().any(|(part, _)| *part == SpokenBodyPart::Sign("||"));
    let joint = SpokenBodyPart::Sign(if any { "||" } else { "&&" });
    let sides: Option<Vec<TestSide>> = all.split(|(part, _)| *part == joint).map(side).collect();
    Some((sides?, any))
}

impl ValueTest {
    /// The test of a body over one argument, with the places of its numbers; none if the grammar has no words for it.
    pub(crate) fn of(body: &str, args: &[String]) -> Option<(Self, TestPlaces)> {
        let [_] = args else { return None };
        let all = parts(body, args)?;
        let both: Vec<&[(SpokenBodyPart, Range<usize>)]> =
            all.split(|(part, _)| *part == SpokenBodyPart::Sign("&&")).collect();
        if let [only] = both[..]
            && let Some((field, truth)) = truth(only)
        {
            return Some((Self { field, asks: Asks::Truth(truth) }, Vec::new()));
        }
        let sides: Vec<TestSide> = both.into_iter().map(side).collect::<Option<_>>()?;
        Self::of_sides(sides)
    }

    fn of_sides(sides: Vec<TestSide>) -> Option<(Self, TestPlaces)> {
        let field = sides.first()?.field.clone();
        let fits = sides.len() == 1 || (sides.len() == 2 && sides.iter().all(|side| side.comparison.bounds()));
        if !fits || sides.iter().any(|side| side.field != field) {
            return None;
        }
        let places = sides.iter().map(|side| side.places.clone()).collect();
        let asks = match &sides[..] {
            [TestSide { literal: SpokenBodyPart::Text(text), comparison, .. }] if !comparison.bounds() => {
                Asks::Text(*comparison == Comparison::Is, text.clone())
            }
            _ => {
                let number = |side: &TestSide| match side.literal {
                    SpokenBodyPart::Number(number) => Some((side.comparison, number)),
                    SpokenBodyPart::Name(..) | SpokenBodyPart::Text(_) | SpokenBodyPart::Sign(_) => None,
                };
                Asks::Numbers(sides.iter().map(number).collect::<Option<_>>()?)
            }
        };
        Some((Self { field, asks }, places))
    }

    /// The test that passes exactly what this one does not; none if the grammar has no words for it.
    pub(crate) fn opposite(&self) -> Option<Self> {
        let asks = match &self.asks {
            Asks::Truth(truth) => Asks::Truth(!truth),
            Asks::Text(is, text) => Asks::Text(!is, text.clone()),
            Asks::Numbers(numbers) => match numbers[..] {
                [(comparison, number)] => Asks::Numbers(vec![(comparison.opposite(), number)]),
                _ => return None,
            },
        };
        Some(Self { field: self.field.clone(), asks })
    }

    /// The body that asks this of the argument `arg`. Numbers that are measured have a point.
    pub(crate) fn body(&self, arg: &str, is_measured: bool) -> String {
        let subject = self.field.as_ref().map_or_else(|| arg.to_owned(), |field| format!("{arg}.{field}"));
        match &self.asks {
            Asks::Truth(true) => subject,
            Asks::Truth(false) => format!("!{subject}"),
            Asks::Text(is, text) => format!("{subject} {} {}", if *is { "==" } else { "!=" }, text_literal(text)),
            Asks::Numbers(numbers) => {
                let one = |(comparison, number): &(Comparison, f64)| {
                    let number = if is_measured { format!("{number:?}") } else { format!("{number}") };
                    format!("{subject} {} {number}", comparison.sign())
                };
                numbers.iter().map(one).collect::<Vec<_>>().join(" && ")
            }
        }
    }
}

/// True if there is a number that all comparisons are true of; with `is_whole`, a whole one.
pub(crate) fn is_possible(all: &[(Comparison, f64)], is_whole: bool) -> bool {
    // The ends of the range, and whether they belong to it.
    let (mut low, mut high) = ((f64::NEG_INFINITY, true), (f64::INFINITY, true));
    for (comparison, value) in all {
        let (value, closed) = match comparison {
            Comparison::Less if is_whole => (value.ceil() - 1.0, true),
            Comparison::More if is_whole => (value.floor() + 1.0, true),
            Comparison::Less | Comparison::More => (*value, false),
            _ => (*value, true),
        };
        let is_above = matches!(comparison, Comparison::More | Comparison::AtLeast | Comparison::Is);
        let is_below = matches!(comparison, Comparison::Less | Comparison::AtMost | Comparison::Is);
        if is_below && (value < high.0 || value == high.0 && !closed) {
            high = (value, closed);
        }
        if is_above && (value > low.0 || value == low.0 && !closed) {
            low = (value, closed);
        }
    }
    let is_point = low.0 == high.0 && low.1 && high.1;
    low.0 < high.0 || is_point && !all.contains(&(Comparison::IsNot, low.0))
}

/// True if a value can pass all of these tests; those of other fields than the first one's do not count.
pub(crate) fn can_pass(tests: &[&ValueTest]) -> bool {
    let Some(first) = tests.first() else { return true };
    let asks = || tests.iter().filter(|test| test.field == first.field).map(|test| &test.asks);
    let numbers: Vec<(Comparison, f64)> = asks()
        .filter_map(|asks| if let Asks::Numbers(numbers) = asks { Some(numbers) } else { None })
        .flatten()
        .copied()
        .collect();
    let denied = |one: &Asks| match one {
        Asks::Truth(truth) => asks().any(|other| *other == Asks::Truth(!truth)),
        Asks::Text(is, text) => asks().any(|other| match other {
            Asks::Text(other_is, other) if *is && *other_is => other != text,
            Asks::Text(other_is, other) => is != other_is && other == text,
            _ => false,
        }),
        Asks::Numbers(_) => false,
    };
    is_possible(&numbers, false) && !asks().any(denied)
}

/// `x`, `!x`, `x.field` or `!x.field`.
fn truth(parts: &[(SpokenBodyPart, Range<usize>)]) -> Option<(Option<String>, bool)> {
    let (truth, rest) = match parts {
        [(SpokenBodyPart::Sign("!"), _), rest @ ..] => (false, rest),
        rest => (true, rest),
    };
    let (field, []) = subject(rest)? else { return None };
    Some((field, truth))
}

type TestParts<'p> = &'p [(SpokenBodyPart, Range<usize>)];

fn subject(parts: TestParts) -> Option<(Option<String>, TestParts)> {
    match parts {
        [
            (SpokenBodyPart::Name(_, Some(0)), _),
            (SpokenBodyPart::Sign("."), _),
            (SpokenBodyPart::Name(field, _), _),
            rest @ ..,
        ] => Some((Some(field.clone()), rest)),
        [(SpokenBodyPart::Name(_, Some(0)), _), rest @ ..] => Some((None, rest)),
        _ => None,
    }
}

fn side(parts: TestParts) -> Option<TestSide> {
    let (field, rest) = subject(parts)?;
    let [(SpokenBodyPart::Sign(sign), at_sign), rest @ ..] = rest else { return None };
    let (comparison, ..) = COMPARISONS.into_iter().find(|(_, known, _)| known == sign)?;
    let (literal, at) = match rest {
        [(SpokenBodyPart::Sign("-"), minus), (SpokenBodyPart::Number(number), at)] => {
            (SpokenBodyPart::Number(-number), minus.start..at.end)
        }
        [(literal @ (SpokenBodyPart::Number(_) | SpokenBodyPart::Text(_)), at)] => (literal.clone(), at.clone()),
        _ => return None,
    };
    Some(TestSide { field, comparison, literal, places: (at_sign.clone(), at) })
}

/// The field of `x.field`.
pub(crate) fn field_of(body: &str, args: &[String]) -> Option<String> {
    let all = parts(body, args)?;
    match (args, subject(&all)?) {
        ([_], (Some(field), [])) => Some(field),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::Comparison::{AtLeast, AtMost, Is, IsNot, Less, More};
    use super::{ValueTest, can_pass, is_possible};

    #[test]
    fn simple_bodies_are_tests_and_tests_are_bodies() {
        let args = ["ball".to_owned()];
        for body in
            ["ball < 40", "ball.d <= 0.5", "ball > -0.5 && ball <= 1.5", "!ball.new", "ball", "ball == \"a\\\"b\""]
        {
            let (test, _) = ValueTest::of(body, &args).unwrap();
            assert_eq!(test.body("ball", false), body);
        }
        for body in [
            "",
            "x < 1",
            "ball * ball > 2",
            "ball < 1 || ball > 2",
            "!(ball < 1)",
            "ball > 1 && ball.x < 2",
            "5 < ball",
        ] {
            assert_eq!(ValueTest::of(body, &args), None, "{body}");
        }
    }

    #[test]
    fn a_test_and_its_opposite_take_turns() {
        let args = ["x".to_owned()];
        let (test, places) = ValueTest::of("x <= 0.50", &args).unwrap();
        assert_eq!(test.opposite().unwrap().body("x", true), "x > 0.5");
        assert_eq!(test.opposite().unwrap().opposite(), Some(test));
        assert_eq!(places, [(2..4, 5..9)]);
    }

    #[test]
    fn a_range_is_empty_only_if_no_number_is_in_it() {
        assert!(!is_possible(&[(Less, 30.0), (More, 100.0)], false));
        assert!(is_possible(&[(Less, 100.0), (More, 30.0)], false));
        assert!(is_possible(&[(AtMost, 100.0), (AtLeast, 100.0)], false));
        assert!(!is_possible(&[(Less, 100.0), (AtLeast, 100.0)], false));
        assert!(!is_possible(&[(Is, 2.0), (IsNot, 2.0)], true));
        assert!(!is_possible(&[(More, 2.0), (Less, 3.0)], true));
        assert!(is_possible(&[(More, 2.0), (Less, 3.0)], false));
        assert!(is_possible(&[], false));
    }

    #[test]
    fn tests_that_deny_each_other_let_nothing_pass() {
        let args = ["x".to_owned()];
        let passes = |bodies: &[&str]| {
            let tests: Vec<ValueTest> = bodies.iter().map(|body| ValueTest::of(body, &args).unwrap().0).collect();
            can_pass(&tests.iter().collect::<Vec<_>>())
        };
        assert!(!passes(&["x < 30 && x > 100"]));
        assert!(!passes(&["x.d < 30", "x.d > 100"]));
        assert!(passes(&["x.d < 30", "x.x > 100"]));
        assert!(!passes(&["x", "!x"]));
        assert!(!passes(&["x == \"a\"", "x == \"b\""]));
        assert!(passes(&["x == \"a\"", "x != \"b\""]));
    }
}
