//! The part of a connector that the robot still uses in the place of what is here now.

use crate::forms::words;
use behaviour::{Operation, Procedure};
use editor::numbers::number_tests;

/// Says what the robot still uses in the place of what is here now, in few words: the number where only that differs.
pub(crate) fn instead_of(ran: &Operation, now: &Operation, unit: &str) -> Option<String> {
    if ran.spec() != now.spec() {
        return Some(words::connector_word(ran.spec()).to_owned());
    }
    match (ran.procedure(), now.procedure()) {
        (Some(Procedure::Body { body: before, .. }), Some(Procedure::Body { body: after, .. })) if before != after => {
            let (was, is) = (number_tests(before), number_tests(after));
            Some(match (was.as_ref().map(|it| &it.all[..]), is.as_ref().map(|it| &it.all[..])) {
                (Some([was]), Some([is])) if (&was.subject, was.sign) == (&is.subject, is.sign) => {
                    words::with_unit(was.written(was.number), if was.subject.contains('.') { "" } else { unit })
                }
                _ => before.trim().to_owned(),
            })
        }
        (Some(Procedure::Helper(before)), Some(after)) if *after != Procedure::Helper(before.clone()) => {
            Some(before.clone())
        }
        _ => {
            let before = ran.period_ms().filter(|before| Some(*before) != now.period_ms())?;
            Some(words::with_unit((before as f64 / 1_000.0).to_string(), words::seconds_unit()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::instead_of;
    use behaviour::{Operation, Parameters, Procedure, connectors};

    #[test]
    fn what_the_robot_still_uses_is_said_shortly() {
        let filter = |body: &str| connectors::filter::SPEC.with(Procedure::body(body));
        let said = |was: &Operation, is: &Operation| instead_of(was, is, "cm");
        assert_eq!(said(&filter("d < 40"), &filter("d < 45")).as_deref(), Some("40\u{a0}cm"));
        assert_eq!(said(&filter("d < 40"), &filter("d > 40")).as_deref(), Some("d < 40"));
        assert_eq!(said(&filter("d.x < 0.5"), &filter("d.x < 0.6")).as_deref(), Some("0.5"));
        let helper = |name: &str| connectors::map::SPEC.with(Procedure::Helper(name.to_owned()));
        assert_eq!(said(&helper("near"), &helper("far")).as_deref(), Some("near"));
        assert_eq!(said(&helper("near"), &helper("near")), None, "the helper itself works otherwise");
        let sample = |ms| connectors::sample::SPEC.with(Parameters::period(ms));
        assert_eq!(said(&sample(1_000), &sample(500)).as_deref(), Some("1\u{a0}s"));
    }
}
