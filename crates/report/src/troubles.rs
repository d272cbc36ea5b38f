//! The troubles of a run: what was not done, what broke, and where the recording has holes.

use recording::{Hand, RefusedLine, RobotLine};

/// The most that are told one by one; the rest is counted.
const TOLD_MAX: usize = 100;

/// Something that went wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Trouble {
    /// There was no connection to the robot, until then if it came back.
    NoConnection { until_ms: Option<u64>, why: String },
    /// The connection was bad, until then if it became better.
    Weak { until_ms: Option<u64>, why: String },
    /// The robot interrupted what ran.
    Halted(String),
    /// The robot fell.
    Fell,
    /// The robot did not do what the program told it.
    NotDone { subject: String, why: String, with: String, count: u64 },
    /// The robot did not do what somebody pressed.
    NotByHand { what: (String, String), why: String, by: String },
    /// A procedure failed, and its value was dropped.
    Failed { subject: String, error: String, count: u64 },
    /// Values were dropped, as a procedure took too long.
    Late(u64),
    /// Lines could not be written in time.
    Missing(u64),
    /// The recording has as many bytes as it may have.
    Full,
    /// The last line is missing.
    CutOff,
}

/// All of a run.
#[derive(Debug, Default)]
pub(crate) struct Troubles {
    /// With their moments, in milliseconds since Start.
    pub(crate) told: Vec<(u64, Trouble)>,
    /// The number of those that are not among them.
    pub(crate) more: u64,
    fallen: bool,
}

impl Troubles {
    /// The number of all.
    pub(crate) fn count(&self) -> u64 {
        self.told.len() as u64 + self.more
    }

    /// Something went wrong.
    pub(crate) fn add(&mut self, at_ms: u64, trouble: Trouble) {
        if self.told.len() < TOLD_MAX {
            self.told.push((at_ms, trouble));
        } else {
            self.more += 1;
        }
    }

    /// The robot refused a value of a stream of this name.
    pub(crate) fn refused(&mut self, subject: &str, refusal: &RefusedLine) {
        let (with, times) = (refusal.with.clone().unwrap_or_default(), refusal.count.unwrap_or(1));
        let known = self.told.iter_mut().find_map(|(_, trouble)| match trouble {
            Trouble::NotDone { subject: of, why, with: keeper, count } => {
                (of == subject && *why == refusal.why && *keeper == with).then_some(count)
            }
            _ => None,
        });
        match known {
            Some(count) => *count += times,
            None => {
                let (subject, why) = (subject.to_owned(), refusal.why.clone());
                self.add(refusal.at_ms, Trouble::NotDone { subject, why, with, count: times });
            }
        }
    }

    /// A press was refused.
    pub(crate) fn not_by_hand(&mut self, what: (String, String), why: &str, hand: &Hand) {
        self.add(hand.at_ms, Trouble::NotByHand { what, why: why.to_owned(), by: hand.by.clone() });
    }

    /// A procedure of a connector with an output of this name failed.
    pub(crate) fn failed(&mut self, at_ms: u64, subject: &str, why: &str) {
        let known = self.told.iter_mut().find_map(|(_, trouble)| match trouble {
            Trouble::Failed { subject: of, error, count } => (of == subject && error == why).then_some(count),
            _ => None,
        });
        match known {
            Some(count) => *count += 1,
            None => {
                self.add(at_ms, Trouble::Failed { subject: subject.to_owned(), error: why.to_owned(), count: 1 });
            }
        }
    }

    /// The robot is another way.
    pub(crate) fn robot(&mut self, line: &RobotLine) {
        let why = line.why.clone().unwrap_or_default();
        match line.link.as_str() {
            "lost" => self.link(line.at_ms, Trouble::NoConnection { until_ms: None, why }),
            "degraded" => self.link(line.at_ms, Trouble::Weak { until_ms: None, why }),
            _ => self.link_is_good(line.at_ms),
        }
        let fallen = line.condition.fallen == Some(true);
        if fallen && !self.fallen {
            self.add(line.at_ms, Trouble::Fell);
        }
        self.fallen = fallen;
        if let Some(halt) = &line.halt {
            self.add(line.at_ms, Trouble::Halted(halt.clone()));
        }
    }

    /// The link is in this trouble, unless it was already.
    fn link(&mut self, at_ms: u64, trouble: Trouble) {
        let is_same = |open: &Trouble| std::mem::discriminant(open) == std::mem::discriminant(&trouble);
        if self.open().is_some_and(|open| is_same(open)) {
            return;
        }
        self.link_is_good(at_ms);
        self.add(at_ms, trouble);
    }

    fn link_is_good(&mut self, at_ms: u64) {
        if let Some(Trouble::NoConnection { until_ms, .. } | Trouble::Weak { until_ms, .. }) = self.open() {
            *until_ms = Some(at_ms);
        }
    }

    /// The trouble of the link that goes on.
    fn open(&mut self) -> Option<&mut Trouble> {
        self.told.iter_mut().rev().map(|(_, trouble)| trouble).find(|trouble| {
            matches!(trouble, Trouble::NoConnection { until_ms: None, .. } | Trouble::Weak { until_ms: None, .. })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{TOLD_MAX, Trouble, Troubles};
    use recording::RobotLine;

    #[test]
    fn a_link_is_in_one_trouble_at_a_time() {
        let mut troubles = Troubles::default();
        for (at_ms, link) in [(0, "ready"), (10, "degraded"), (20, "lost"), (30, "lost"), (90, "ready"), (95, "lost")] {
            troubles.robot(&RobotLine { at_ms, link: link.to_owned(), ..RobotLine::default() });
        }
        let why = String::new;
        let wanted = [
            (10, Trouble::Weak { until_ms: Some(20), why: why() }),
            (20, Trouble::NoConnection { until_ms: Some(90), why: why() }),
            (95, Trouble::NoConnection { until_ms: None, why: why() }),
        ];
        assert_eq!(troubles.told, wanted);
    }

    #[test]
    fn what_comes_again_is_counted_and_many_are_bounded() {
        let mut troubles = Troubles::default();
        (0..1_000).for_each(|at_ms| troubles.failed(at_ms, "Hello", "no text"));
        (0..1_000).for_each(|at_ms| troubles.failed(at_ms, "Hello", &at_ms.to_string()));
        let failed = Trouble::Failed { subject: "Hello".to_owned(), error: "no text".to_owned(), count: 1_000 };
        assert_eq!(troubles.told[0], (0, failed));
        assert_eq!((troubles.told.len(), troubles.count()), (TOLD_MAX, 1_001));
    }
}
