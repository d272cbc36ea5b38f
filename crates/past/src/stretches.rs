//! Stretches of time in which something went on coming: few, however often it came.

use protocol::CHANGED_STRETCHES_MAX;

/// The longest silence within a stretch, in milliseconds.
const SILENCE_MS: u64 = 1_000;

/// The stretches in which something came, in the order of time.
#[derive(Debug)]
pub(crate) struct Stretches {
    all: Vec<(u64, u64)>,
    silence_ms: u64,
}

impl Default for Stretches {
    fn default() -> Self {
        Self { all: Vec::new(), silence_ms: SILENCE_MS }
    }
}

impl Stretches {
    /// Stretches that are told as they are, as long as they are few.
    pub(crate) fn of_bars() -> Self {
        Self { all: Vec::new(), silence_ms: 1 }
    }

    /// Something came; never before what came last.
    pub(crate) fn came(&mut self, at_ms: u64) {
        self.bar((at_ms, at_ms));
    }

    /// Something came for a while; never before what came last.
    pub(crate) fn bar(&mut self, bar: (u64, u64)) {
        self.add(bar);
        while self.all.len() > CHANGED_STRETCHES_MAX {
            self.silence_ms *= 2;
            std::mem::take(&mut self.all).into_iter().for_each(|one| self.add(one));
        }
    }

    fn add(&mut self, (from, until): (u64, u64)) {
        match self.all.last_mut() {
            Some(last) if from < last.1.saturating_add(self.silence_ms) => last.1 = until.max(last.1),
            _ => self.all.push((from, until)),
        }
    }

    /// All of them.
    pub(crate) fn finish(self) -> Vec<(u64, u64)> {
        self.all
    }
}

#[cfg(test)]
mod tests {
    use super::Stretches;
    use protocol::CHANGED_STRETCHES_MAX;

    fn of(all: impl IntoIterator<Item = u64>) -> Vec<(u64, u64)> {
        let mut stretches = Stretches::default();
        all.into_iter().for_each(|at_ms| stretches.came(at_ms));
        stretches.finish()
    }

    #[test]
    fn less_than_a_second_is_no_silence() {
        assert_eq!(of([0, 999, 1_998, 2_998, 2_998, 9_000]), [(0, 1_998), (2_998, 2_998), (9_000, 9_000)]);
        assert_eq!(of([]), []);
    }

    #[test]
    fn of_many_the_long_silences_stay() {
        let all = of((0..1_000).map(|at| at * 2_500 + at / 10 * 60_000));
        assert_eq!(all.len(), 100);
        assert!(all.windows(2).all(|two| two[1].0 - two[0].1 == 62_500));
    }

    #[test]
    fn there_are_never_many() {
        let all = of((0..100_000).map(|at| at * 2_000 + at % 7));
        assert!((1..=CHANGED_STRETCHES_MAX).contains(&all.len()), "{}", all.len());
        assert_eq!((all[0].0, all.last().unwrap().1), (0, 199_998_000 + 99_999 % 7));
    }
}
