//! The precedence among several behaviours on one robot over its parts: if they disagree, the upper one wins. A pure
//! function of the commands and of the order that people gave the behaviours.

use crate::arbitration::Claim;
use crate::arbitration::holds::{Holds, PartHold};
use robot::{Millis, Use};

/// The streams that hold the parts of the robot.
#[derive(Clone, Debug, Default)]
pub struct Precedence {
    holds: Holds<Use>,
}

/// The reason why a command was refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HeldBy {
    /// The part of the robot.
    pub part: String,
    /// The stream that holds it.
    pub by: Use,
    /// The time until which it holds, unless it commands again.
    pub until: Millis,
}

impl Precedence {
    /// A command of an actuator stream. It is refused while a stream of a behaviour above its own holds one of the
    /// parts, or a stream of higher priority in the same behaviour. Otherwise it takes its parts for its hold time, and
    /// every other stream that holds one of them loses all of its own. `is_above` says whether the first run's
    /// behaviour stands above the second's now: people may change the order at any time.
    ///
    /// # Errors
    /// The part and who holds it.
    pub fn command(
        &mut self,
        at: Millis,
        by: &Use,
        claim: &Claim,
        is_above: impl Fn(u64, u64) -> bool,
    ) -> Result<(), HeldBy> {
        let wins = |hold: &PartHold<Use>| match hold.by.run == by.run {
            true => hold.by.stream != by.stream && hold.priority > claim.priority,
            false => is_above(hold.by.run, by.run),
        };
        let held = |(part, hold): (String, PartHold<Use>)| HeldBy { part, by: hold.by, until: hold.until };
        self.holds.command(at, by, claim, wins).map_err(held)
    }

    /// A run ended: it holds nothing any more.
    pub fn let_go(&mut self, run: u64) {
        self.holds.let_go(|by| by.run == run);
    }
}

#[cfg(test)]
mod tests {
    use super::{HeldBy, Precedence};
    use crate::arbitration::Claim;
    use behaviour::Id;
    use robot::{Millis, Use};

    fn claim(parts: &[&str], priority: i64) -> Claim {
        Claim { resources: parts.iter().map(|&part| part.to_owned()).collect(), priority, hold_ms: 100 }
    }

    fn stream(run: u64, stream: &str) -> Use {
        Use { run, stream: Id::new(stream).unwrap() }
    }

    /// Run 1 stands above run 2, and so on.
    fn by_number(one: u64, other: u64) -> bool {
        one < other
    }

    #[test]
    fn the_upper_behaviour_holds_until_its_time_is_over() {
        let mut parts = Precedence::default();
        let (upper, lower) = (stream(1, "a"), stream(2, "b"));
        let head = claim(&["head"], 0);
        assert_eq!(parts.command(Millis(0), &lower, &head, by_number), Ok(()));
        assert_eq!(parts.command(Millis(1), &upper, &head, by_number), Ok(()), "the upper one takes it at once");
        let held = HeldBy { part: "head".into(), by: upper.clone(), until: Millis(101) };
        assert_eq!(parts.command(Millis(100), &lower, &head, by_number), Err(held));
        assert_eq!(parts.command(Millis(101), &lower, &head, by_number), Ok(()));
        assert_eq!(parts.command(Millis(101), &lower, &claim(&["voice"], 0), by_number), Ok(()));
    }

    #[test]
    fn another_order_counts_from_the_next_command_on() {
        let mut parts = Precedence::default();
        let (one, two) = (stream(1, "a"), stream(2, "b"));
        let head = claim(&["head"], 0);
        assert_eq!(parts.command(Millis(0), &one, &head, by_number), Ok(()));
        assert!(parts.command(Millis(1), &two, &head, by_number).is_err());
        assert_eq!(parts.command(Millis(2), &two, &head, |one, other| one > other), Ok(()));
        assert!(parts.command(Millis(3), &one, &head, |one, other| one > other).is_err());
    }

    #[test]
    fn within_a_behaviour_the_later_one_wins_unless_the_other_is_more_important() {
        let mut parts = Precedence::default();
        let (one, two) = (stream(1, "a"), stream(1, "b"));
        assert_eq!(parts.command(Millis(0), &one, &claim(&["head", "legs"], 0), by_number), Ok(()));
        assert_eq!(parts.command(Millis(0), &two, &claim(&["head"], 0), by_number), Ok(()));
        let legs = claim(&["legs"], 0);
        assert_eq!(parts.command(Millis(1), &stream(2, "c"), &legs, by_number), Ok(()), "who lost one lost all");
        assert_eq!(parts.command(Millis(2), &one, &claim(&["head"], 1), by_number), Ok(()));
        assert!(parts.command(Millis(3), &two, &claim(&["head"], 0), by_number).is_err());
    }

    #[test]
    fn a_run_that_ended_holds_nothing() {
        let mut parts = Precedence::default();
        assert_eq!(parts.command(Millis(0), &stream(1, "a"), &claim(&["head"], 0), by_number), Ok(()));
        parts.let_go(1);
        assert_eq!(parts.command(Millis(1), &stream(2, "b"), &claim(&["head"], 0), by_number), Ok(()));
    }

    /// Against the plain rule, checked over random commands: a refusal always names a holder above, and what a lower
    /// behaviour does never delays an upper one.
    #[test]
    fn what_stands_below_never_delays_what_stands_above() {
        let mut chance: u64 = 7;
        let mut next = |below: u64| {
            chance = chance.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (chance >> 33) % below
        };
        let (mut all, mut upper_alone, mut refused) = (Precedence::default(), Precedence::default(), 0);
        let names = ["head", "legs", "voice"];
        for at in 0..4_000 {
            let run = 1 + next(3);
            let parts: Vec<&str> = names.into_iter().filter(|_| next(2) == 0).collect();
            let (user, claim) = (stream(run, "s"), claim(&parts, 0));
            let said = all.command(Millis(at * 10), &user, &claim, by_number);
            if let Err(held) = &said {
                assert!(held.by.run < run && held.until.0 > at * 10 && claim.resources.contains(&held.part));
                refused += 1;
            }
            if run < 3 {
                assert_eq!(said, upper_alone.command(Millis(at * 10), &user, &claim, by_number), "at {at}");
            }
        }
        assert!(refused > 500, "{refused}");
    }
}
