//! Causes that kept a run or its recording from going on as usual.

use protocol::{INTERRUPTIONS_MAX, Interrupted, Interruption};
use recording::RobotLine;

/// The most signs of a reason that are kept.
const HALT_MAX_CHARS: usize = 400;

/// The interruptions so far.
#[derive(Debug, Default)]
pub(crate) struct Interruptions {
    pub(crate) all: Vec<Interruption>,
    fallen: bool,
    /// The place of the one that goes on.
    lost: Option<usize>,
}

impl Interruptions {
    pub(crate) fn add(&mut self, at_ms: u64, what: Interrupted) -> Option<usize> {
        (self.all.len() < INTERRUPTIONS_MAX).then(|| {
            self.all.push(Interruption { at_ms, until_ms: None, what });
            self.all.len() - 1
        })
    }

    /// The robot is another way.
    pub(crate) fn robot(&mut self, line: &RobotLine) {
        match (line.link == "lost", self.lost) {
            (true, None) => self.lost = self.add(line.at_ms, Interrupted::NoConnection),
            (false, Some(at)) => {
                self.all[at].until_ms = Some(line.at_ms);
                self.lost = None;
            }
            (true, Some(_)) | (false, None) => {}
        }
        let fallen = line.condition.fallen == Some(true);
        if fallen && !self.fallen {
            self.add(line.at_ms, Interrupted::Fell);
        }
        self.fallen = fallen;
        if let Some(halt) = &line.halt {
            self.add(line.at_ms, Interrupted::Halted(halt.chars().take(HALT_MAX_CHARS).collect::<String>().into()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Interruptions;
    use protocol::{INTERRUPTIONS_MAX, Interrupted, Interruption};
    use recording::RobotLine;
    use robot::Condition;

    #[test]
    fn a_lost_link_lasts_until_it_is_back_and_a_fall_is_told_once() {
        let mut troubles = Interruptions::default();
        for (at_ms, link, fallen) in [(0, "ready", false), (20, "lost", false), (30, "lost", true), (90, "ready", true)]
        {
            let condition = Condition { fallen: Some(fallen), ..Condition::default() };
            troubles.robot(&RobotLine { at_ms, link: link.to_owned(), condition, ..RobotLine::default() });
        }
        let wanted = [
            Interruption { at_ms: 20, until_ms: Some(90), what: Interrupted::NoConnection },
            Interruption { at_ms: 30, until_ms: None, what: Interrupted::Fell },
        ];
        assert_eq!(troubles.all, wanted);
    }

    #[test]
    fn many_are_bounded() {
        let mut troubles = Interruptions::default();
        for at_ms in 0..10_000 {
            let link = if at_ms % 2 == 0 { "lost" } else { "ready" };
            troubles.robot(&RobotLine { at_ms, link: link.to_owned(), ..RobotLine::default() });
        }
        assert_eq!(troubles.all.len(), INTERRUPTIONS_MAX);
    }
}
