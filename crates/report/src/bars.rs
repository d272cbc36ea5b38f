//! Counts how often and how long something was: what comes again within a second is one bar, however many values that are.

/// A pause shorter than this, in milliseconds, does not end a thing that goes on.
const JOINED_MS: u64 = 1_000;
/// The most bars that are kept to be drawn; beyond that near ones are drawn as one.
const DRAWN_MAX: usize = 2_048;

/// The bars of one thing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct ReportBars {
    /// The number of bars.
    pub(crate) count: u64,
    /// The time of all bars together, in milliseconds.
    pub(crate) total_ms: u64,
    /// From and until when, in milliseconds, by time: as they are drawn.
    pub(crate) drawn: Vec<(u64, u64)>,
    /// The text that the newest bar shows; none for what is told with other numbers all the while.
    says: Option<String>,
    /// The time of the newest value.
    last_ms: u64,
    /// Pauses up to this are not drawn.
    near_ms: u64,
}

impl ReportBars {
    /// Something came; `says` is its text, if it is one.
    pub(crate) fn come(&mut self, at_ms: u64, says: Option<&str>) {
        let goes_on = self.count > 0
            && at_ms.saturating_sub(self.last_ms) < JOINED_MS
            && self.says.as_deref() == says
            // Lines of people may come a little late.
            && at_ms >= self.last_ms;
        if goes_on {
            self.total_ms += at_ms - self.last_ms;
            if let Some((_, until_ms)) = self.drawn.last_mut() {
                *until_ms = at_ms.max(*until_ms);
            }
        } else {
            self.begin(at_ms, at_ms);
            self.says = says.map(str::to_owned);
        }
        self.last_ms = at_ms;
    }

    fn begin(&mut self, from_ms: u64, until_ms: u64) {
        self.count += 1;
        match self.drawn.last_mut() {
            Some(last) if from_ms <= last.1.saturating_add(self.near_ms) && from_ms >= last.0 && self.near_ms > 0 => {
                last.1 = last.1.max(until_ms);
            }
            _ => self.drawn.push((from_ms, until_ms)),
        }
        while self.drawn.len() > DRAWN_MAX {
            self.near_ms = (self.near_ms * 2).max(JOINED_MS);
            self.draw_near_ones_as_one();
        }
    }

    fn draw_near_ones_as_one(&mut self) {
        let mut fewer: Vec<(u64, u64)> = Vec::new();
        for (from_ms, until_ms) in std::mem::take(&mut self.drawn) {
            match fewer.last_mut() {
                Some(last) if from_ms <= last.1.saturating_add(self.near_ms) => last.1 = last.1.max(until_ms),
                _ => fewer.push((from_ms, until_ms)),
            }
        }
        self.drawn = fewer;
    }
}

#[cfg(test)]
mod tests {
    use super::{DRAWN_MAX, ReportBars};

    #[test]
    fn what_comes_again_within_a_second_is_one_bar() {
        let mut bars = ReportBars::default();
        for at_ms in [0, 400, 1_399, 2_399, 5_000] {
            bars.come(at_ms, None);
        }
        assert_eq!((bars.count, bars.total_ms), (3, 1_399));
        assert_eq!(bars.drawn, [(0, 1_399), (2_399, 2_399), (5_000, 5_000)]);
        let mut said = ReportBars::default();
        [(0, "a"), (100, "b"), (200, "b")].into_iter().for_each(|(at_ms, says)| said.come(at_ms, Some(says)));
        assert_eq!((said.count, said.total_ms), (2, 100), "another text is another one");
    }

    #[test]
    fn however_many_there_are_few_are_drawn_and_all_are_counted() {
        let mut bars = ReportBars::default();
        (0..100_000_u64).for_each(|number| bars.come(number * 1_500, None));
        assert_eq!(bars.count, 100_000);
        assert!(bars.drawn.len() <= DRAWN_MAX && bars.drawn.is_sorted(), "{}", bars.drawn.len());
        assert_eq!((bars.drawn[0].0, bars.drawn.last().unwrap().1), (0, 99_999 * 1_500));
    }
}
