//! The time of day, as the clock on the wall tells it.

use super::NUMBER;
use crate::{Device, Field, NextStep, Pace, Pretend, Resources, Shape, Waiting};
use behaviour::{StreamKind, Value};

pub(crate) const DEVICE: Device = Device {
    name: "TimeOfDay",
    kind: StreamKind::Sensor,
    label: "Time of day",
    says: "Tells the time of day: at first, and at every new minute. An hour that clocks show twice in autumn is told once.",
    icon: "clock",
    params: &[],
    shape: Shape::Object(&[
        Field { name: "clock", says: "time with hours and minutes, from “00:00” to “23:59”", of: Shape::Text },
        Field { name: "hour", says: "hour, from 0 to 23", of: NUMBER },
    ]),
    resources: Resources::Always(&[]),
    waiting: Waiting::Every,
    pace: Pace::Happening,
    button: None,
    next_step: NextStep::NEVER,
    example: r#"{"clock":"09:00","hour":9}"#,
    pretend: &[
        Pretend { says: "nine in the morning", value: r#"{"clock":"09:00","hour":9}"# },
        Pretend { says: "three in the afternoon", value: r#"{"clock":"15:00","hour":15}"# },
    ],
};

/// The minutes of a day.
pub const MINUTES_A_DAY: u32 = 24 * 60;

/// Returns the reading of the sense `TimeOfDay` so many minutes after midnight; a time of the days after is one of today.
#[must_use]
pub fn time_of_day(minutes: u32) -> Value {
    let (hour, minute) = (minutes / 60 % 24, minutes % 60);
    Value::object([("clock", Value::text(format!("{hour:02}:{minute:02}"))), ("hour", Value::Int(i64::from(hour)))])
}

#[cfg(test)]
mod tests {
    use super::{MINUTES_A_DAY, time_of_day};

    #[test]
    fn times_have_two_digits_and_begin_anew_at_midnight() {
        let told = [0, 9 * 60 + 5, MINUTES_A_DAY - 1, MINUTES_A_DAY].map(time_of_day);
        let clocks = told.map(|value| value.field("clock").and_then(|clock| clock.as_text().map(str::to_owned)));
        assert_eq!(clocks.map(Option::unwrap_or_default), ["00:00", "09:05", "23:59", "00:00"]);
    }
}
