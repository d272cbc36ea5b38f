//! Who may move a part of the robot when several streams want it: a pure function of the commands.

use crate::holds::{Hold, Holds};
use behaviour::FileStream;
use robot::Millis;

/// For how long a command holds its resources, in milliseconds, if nothing else is said.
const HOLD_MS: u64 = 1_000;

/// What a stream claims when it commands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// The parts of the robot.
    pub resources: Vec<String>,
    /// Higher wins.
    pub priority: i64,
    /// For how long a command holds, in milliseconds.
    pub hold_ms: u64,
}

impl Claim {
    /// The claim of a stream, with the defaults for what it leaves out.
    #[must_use]
    pub fn of(stream: &FileStream) -> Self {
        let device = || stream.device.iter().cloned().collect();
        Self {
            resources: stream.resources.clone().unwrap_or_else(device),
            priority: stream.priority.unwrap_or(0),
            hold_ms: stream.hold_ms.unwrap_or(HOLD_MS),
        }
    }
}

/// Remembers who holds what.
#[derive(Clone, Debug, Default)]
pub struct Arbiter {
    holds: Holds<usize>,
}

impl Arbiter {
    /// A command of stream `by`: admitted, it takes the resources, and every other holder of one of them loses all of
    /// its own. Equal priority: the newer one wins.
    ///
    /// # Errors
    /// The stream of higher priority that still holds one of the resources.
    pub fn command(&mut self, at: Millis, by: usize, claim: &Claim) -> Result<(), usize> {
        let wins = |hold: &Hold<usize>| hold.by != by && hold.priority > claim.priority;
        self.holds.command(at, &by, claim, wins).map_err(|(_, hold)| hold.by)
    }
}

#[cfg(test)]
mod tests {
    use super::{Arbiter, Claim};
    use robot::Millis;

    fn claim(resources: &[&str], priority: i64) -> Claim {
        Claim { resources: resources.iter().map(|&name| name.to_owned()).collect(), priority, hold_ms: 100 }
    }

    #[test]
    fn a_higher_stream_holds_until_its_time_is_over() {
        let mut arbiter = Arbiter::default();
        let (high, low) = (claim(&["head"], 2), claim(&["head", "voice"], 1));
        assert_eq!(arbiter.command(Millis(0), 0, &high), Ok(()));
        assert_eq!(arbiter.command(Millis(99), 1, &low), Err(0));
        assert_eq!(arbiter.command(Millis(100), 1, &low), Ok(()));
        assert_eq!(arbiter.command(Millis(150), 0, &high), Ok(()));
        assert_eq!(arbiter.command(Millis(160), 2, &claim(&["voice"], 0)), Ok(()), "who lost one lost all");
    }

    #[test]
    fn of_equals_the_newer_wins() {
        let mut arbiter = Arbiter::default();
        assert_eq!(arbiter.command(Millis(0), 0, &claim(&["head"], 1)), Ok(()));
        assert_eq!(arbiter.command(Millis(1), 1, &claim(&["head"], 1)), Ok(()));
        assert_eq!(arbiter.command(Millis(2), 0, &claim(&["head"], 1)), Ok(()));
    }
}
