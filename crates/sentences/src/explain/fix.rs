//! The number of a test that kept a value back, as it would have to be to let it pass.

use super::SentenceTeller;
use super::why::Answers;
use crate::body::SpokenBodyPart;
use crate::numbers;
use crate::test::{Comparison, TestSide, comparisons};
use behaviour::{Procedure, Value};
use protocol::{Because, BlockedConnector, NumberFix};

/// The most steps that a number has behind or before it: of more, ten are taken as one.
const STEPS_MAX: f64 = 10_000.0;
/// The most letters of a number.
const WRITTEN_MAX_CHARS: usize = 24;

impl Answers<'_> {
    /// The one number of a connector's test with which it lets pass what it kept back: the nearest that is round in the unit in
    /// which it is shown. None if it kept the value back for another reason, or if no single number helps.
    #[must_use]
    pub fn fix(&self, blocked: &BlockedConnector) -> Option<NumberFix> {
        let link = self.link(&blocked.connector).filter(|_| blocked.because == Because::Kept)?;
        let body = match link.connector.operation.procedure()? {
            Procedure::Body { body, .. } => body,
            Procedure::Helper(_) => return None,
        };
        let (sides, any) = comparisons(body, &self.known.behaviour.arguments(link.connector))?;
        let teller = SentenceTeller::new(&self.known, self.unit, self.language);
        let kept = sides.iter().map(|side| KeptSide::of(side, &blocked.value)).collect::<Option<Vec<_>>>()?;
        let failing: Vec<(&TestSide, &KeptSide)> = sides.iter().zip(&kept).filter(|(_, kept)| !kept.passes).collect();
        if kept.is_empty() || (any && failing.len() < kept.len()) || (!any && failing.len() > 1) {
            return None;
        }
        let fixes = failing.into_iter().filter_map(|(side, kept)| {
            let (_, unit) = teller.measured(&link, side.field.as_deref());
            kept.fix(&blocked.connector, body, side, &unit)
        });
        // Of several of which one is enough, the one that changes least for what it is.
        fixes.min_by(|one, other| far(one).total_cmp(&far(other)))
    }
}

/// The part of a number by which a fix changes it.
fn far(fix: &NumberFix) -> f64 {
    (fix.to - fix.from).abs() / fix.from.abs().max(fix.to.abs())
}

/// A comparison with the value that was kept back.
pub(super) struct KeptSide {
    pub(super) passes: bool,
    /// The value and the number beside it, where both are numbers.
    numbers: Option<(f64, f64)>,
    is_whole: bool,
}

impl KeptSide {
    /// None if nobody knows what the comparison gives for the value.
    pub(super) fn of(side: &TestSide, value: &Value) -> Option<Self> {
        let value = side.field.as_ref().map_or(Some(value), |field| value.field(field))?;
        let is_whole = matches!(value, Value::Int(_));
        Some(match (&side.literal, value) {
            (SpokenBodyPart::Number(beside), _) => {
                let number = value.as_number()?;
                let passes = side.comparison.passes(number, *beside);
                Self { passes, numbers: Some((number, *beside)), is_whole }
            }
            (SpokenBodyPart::Text(beside), Value::Text(text)) => {
                let is = **text == **beside;
                let passes = match side.comparison {
                    Comparison::Is => is,
                    Comparison::IsNot => !is,
                    Comparison::Less | Comparison::AtMost | Comparison::More | Comparison::AtLeast => return None,
                };
                Self { passes, numbers: None, is_whole }
            }
            _ => return None,
        })
    }

    /// The distance of the value from its number, as a part of that; none if another number does not help.
    pub(super) fn distance(&self, side: &TestSide) -> Option<f64> {
        let (number, beside) = self.numbers.filter(|_| side.comparison != Comparison::IsNot)?;
        let size = if beside == 0.0 { 1.0 } else { beside.abs() };
        Some((number - beside).abs() / size).filter(|distance| distance.is_finite())
    }

    fn fix(&self, connector: &str, body: &str, side: &TestSide, unit: &str) -> Option<NumberFix> {
        let (number, from) = self.numbers?;
        let at = side.literal_at();
        let literal = body.get(at.clone())?;
        let has_point = literal.contains('.');
        let step = fitting_step(numbers::step(from, unit), number.abs().max(from.abs()), self.is_whole && !has_point);
        let to = round(side.comparison, number, step)?;
        let mut written = format!("{to}");
        if has_point && !written.contains('.') {
            written.push_str(".0");
        }
        if written.len() > WRITTEN_MAX_CHARS {
            return None;
        }
        // `<-` is a sign of its own.
        if written.starts_with('-') && !body[..at.start].ends_with(char::is_whitespace) {
            written.insert(0, ' ');
        }
        let connector = connector.to_owned();
        let unit = numbers::shown_unit(unit).to_owned();
        Some(NumberFix { connector, start: at.start, end: at.end, from, to, written, unit })
    }
}

/// The step in which a number of about this size is rounded.
fn fitting_step(mut step: f64, size: f64, whole: bool) -> f64 {
    if whole && step > size {
        return 1.0;
    }
    while !whole && size > 0.0 && step > size {
        step /= 10.0;
    }
    while size / step > STEPS_MAX {
        step *= 10.0;
    }
    step
}

/// The nearest round number beside which a number passes.
fn round(comparison: Comparison, number: f64, step: f64) -> Option<f64> {
    let (first, next) = match comparison {
        Comparison::Less | Comparison::AtMost => ((number / step).floor(), 1.0),
        Comparison::More | Comparison::AtLeast => ((number / step).ceil(), -1.0),
        // Shown with three digits after the point: with more of them nobody would have meant it.
        Comparison::Is => return Some(number).filter(|number| (number * 1_000.0).round() / 1_000.0 == *number),
        Comparison::IsNot => return None,
    };
    // Three digits more than the step has, so that 19 steps of 0.05 are 0.95.
    let digits = (3.0 - step.log10().floor()).clamp(0.0, 300.0) as usize;
    let times = |many: f64| format!("{:.digits$}", many * step).parse::<f64>().ok();
    let rounded = [first, first + next, first + 2.0 * next].into_iter().filter_map(times);
    // Zero has no sign.
    rounded.map(|to| to + 0.0).find(|to| to.is_finite() && comparison.passes(number, *to))
}

#[cfg(test)]
mod tests {
    use super::{fitting_step, round};
    use crate::test::Comparison::{AtLeast, AtMost, Is, IsNot, Less, More};

    #[test]
    fn the_nearest_round_number_lets_a_value_pass() {
        assert_eq!(round(Less, 92.0, 5.0), Some(95.0));
        assert_eq!(round(Less, 95.0, 5.0), Some(100.0));
        assert_eq!(round(AtMost, 95.0, 5.0), Some(95.0));
        assert_eq!(round(More, 92.0, 5.0), Some(90.0));
        assert_eq!(round(More, 90.0, 5.0), Some(85.0));
        assert_eq!(round(AtLeast, 90.0, 5.0), Some(90.0));
        assert_eq!(round(Less, 0.93, 0.05), Some(0.95));
        assert_eq!(round(More, -0.01, 0.05), Some(-0.05));
        assert_eq!(round(More, 0.01, 0.05), Some(0.0));
        assert_eq!((round(Is, 4.0, 1.0), round(Is, 0.123_45, 0.05), round(IsNot, 4.0, 1.0)), (Some(4.0), None, None));
    }

    #[test]
    fn a_step_fits_the_size_of_its_number() {
        assert_eq!((fitting_step(5.0, 92.0, true), fitting_step(5.0, 3.0, true)), (5.0, 1.0));
        assert!((fitting_step(0.05, 0.0003, false) - 0.000_05).abs() < 1e-9);
        assert_eq!(fitting_step(1.0, 3e6, true), 1_000.0);
    }
}
