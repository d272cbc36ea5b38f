//! The time of day in the room: eight in the morning when the robot begins, and later as somebody lets time pass.

use super::{Beat, Sense, SimulatedDevice, SimulatedDriver};
use crate::hash::RunningHash;
use crate::nao::SimulatedNao;
use behaviour::Value;
use robot::{MINUTES_A_DAY, time_of_day};

pub(super) const DRIVER: SimulatedDriver =
    SimulatedDriver { name: "TimeOfDay", open: |_| SimulatedDevice::sense(TimeOfDay(None)) };

/// The time of day at robot time 0, in minutes after midnight.
const BEGINS_MIN: u32 = 8 * 60;
/// A minute of robot time, in milliseconds.
const MINUTE_MS: u64 = 60_000;

/// The sense, with the minute that it told last.
#[derive(Debug)]
struct TimeOfDay(Option<u32>);

/// The clock on the wall of the room.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct RoomClock {
    /// The minutes that somebody let pass, besides those of robot time.
    passed: u32,
}

impl RoomClock {
    /// Lets time pass.
    pub(crate) fn pass(&mut self, minutes: u16) {
        self.passed = (self.passed + u32::from(minutes)) % MINUTES_A_DAY;
    }

    /// The minutes after midnight at this robot time.
    fn minutes(&self, now_ms: u64) -> u32 {
        let ran = now_ms / MINUTE_MS % u64::from(MINUTES_A_DAY);
        (BEGINS_MIN + self.passed + u32::try_from(ran).unwrap_or(0)) % MINUTES_A_DAY
    }

    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest.whole(u64::from(self.passed));
    }
}

impl Sense for TimeOfDay {
    fn beat(&self) -> Beat {
        Beat::Step
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        let minutes = nao.clock.minutes(nao.now);
        (self.0.replace(minutes) != Some(minutes)).then(|| time_of_day(minutes))
    }
}
