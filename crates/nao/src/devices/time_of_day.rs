//! The time of day, by the clock and the time zone of the server: a robot's own clock is often wrong, as nobody sets it.

use super::{NaoDriver, OpenDevice, Sense};
use behaviour::Value;
use robot::{MINUTES_A_DAY, time_of_day};

pub(super) const DRIVER: NaoDriver =
    NaoDriver { name: "TimeOfDay", services: &[], joints: &[], open: |_| OpenDevice::sense(TimeOfDay { told: None }) };

/// A clock that is put back by so many minutes at most shows these times again: summer time ended, or it was a little fast. One
/// that is put back by more was wrong.
const BACK_MAX_MIN: i64 = 2 * 60;

/// The sense. A time that the clock shows twice is told once, so that nothing acts twice for it; a time that the clock leaves out
/// is not told, as what is past is not made up for.
struct TimeOfDay {
    /// The latest minute that was told, counted from 1970.
    told: Option<i64>,
}

impl Sense for TimeOfDay {
    fn needs_clock(&self) -> bool {
        true
    }

    /// The minutes of the clock since 1970, told when they go on.
    fn read(&mut self, _: &str, value: &qi::Value, _: u64) -> Option<Value> {
        let minutes = value.as_i64()?;
        if self.told.is_some_and(|told| (0..=BACK_MAX_MIN).contains(&(told - minutes))) {
            return None;
        }
        self.told = Some(minutes);
        u32::try_from(minutes.rem_euclid(i64::from(MINUTES_A_DAY))).ok().map(time_of_day)
    }
}

/// The times that are told while the clock shows these minutes, one after the other.
#[cfg(test)]
pub(crate) fn told_of_minutes(minutes: impl Iterator<Item = i64>) -> Vec<String> {
    let mut sense = TimeOfDay { told: None };
    let told = minutes.filter_map(|minutes| sense.read("poll", &qi::Value::I64(minutes), 0));
    told.filter_map(|told| Some(told.field("clock")?.as_text()?.to_owned())).collect()
}

#[cfg(test)]
mod tests {
    use super::told_of_minutes;

    #[test]
    fn each_minute_is_told_once() {
        let nine = 24 * 60 * 20_000 + 9 * 60;
        let minutes = [-1, -1, 0, 1, 0].map(|minutes| nine + minutes);
        assert_eq!(told_of_minutes(minutes.into_iter()), ["08:59", "09:00", "09:01"], "put back by a minute");
        let wrong = [nine, nine - 600, nine - 599].into_iter();
        assert_eq!(told_of_minutes(wrong), ["09:00", "23:00", "23:01"], "it was ten hours fast");
    }
}
