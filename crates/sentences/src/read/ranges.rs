//! The values that a sense may have: a comparison that all of them pass, or none, says nothing.

use crate::carried::CarriedKind;
use crate::clauses::RANGES;
use crate::test::{Asks, Comparison, ValueTest, is_possible};

/// So far no camera of a robot sees anything, in metres.
const SEEN_MAX_M: f64 = 20.0;
/// The head turns so far to a side, and up and down, in radians.
const HEAD_YAW: (f64, f64) = (-2.0857, 2.0857);
const HEAD_PITCH: (f64, f64) = (-0.672, 0.5149);

/// True if a test of what is carried here is passed by no value of it, or by each.
pub(super) fn is_senseless(test: &ValueTest, carried: &CarriedKind) -> bool {
    let Asks::Numbers(numbers) = &test.asks else { return false };
    let Some(range) = range(carried, test.field.as_deref()) else { return false };
    let within = |more: &[(Comparison, f64)]| {
        let ends = [(Comparison::AtLeast, range.0), (Comparison::AtMost, range.1)];
        is_possible(&ends.iter().chain(more).copied().collect::<Vec<_>>(), false)
    };
    let always = matches!(numbers[..], [(one, value)] if !within(&[(one.opposite(), value)]));
    !within(numbers) || always
}

/// True if the head can turn so far.
pub(super) fn can_turn(joint: &str, angle: f64) -> bool {
    let (least, most) = match joint {
        "HeadYaw" => HEAD_YAW,
        "HeadPitch" => HEAD_PITCH,
        _ => return true,
    };
    (least..=most).contains(&angle)
}

/// The least and the greatest value of what is carried, or of one of its fields.
fn range(carried: &CarriedKind, field: Option<&str>) -> Option<(f64, f64)> {
    match (carried, field) {
        (CarriedKind::Sense(device), field) => {
            let known = RANGES.iter().find(|(name, of, _)| name == device && *of == field.unwrap_or_default());
            known.map(|(.., range)| *range)
        }
        (CarriedKind::Distance("m"), None) => Some((0.0, SEEN_MAX_M)),
        (CarriedKind::Distance("cm"), None) => Some((0.0, 100.0 * SEEN_MAX_M)),
        _ => None,
    }
}
