//! Durations, as a histogram in microseconds.

use hdrhistogram::Histogram;
use std::fmt;
use std::time::Duration;

/// Digits that count.
const DIGITS: u8 = 3;

/// A histogram of durations.
#[derive(Clone, Debug)]
pub struct Durations(Histogram<u64>);

impl Default for Durations {
    fn default() -> Self {
        #[expect(clippy::expect_used, reason = "three digits are allowed")]
        Self(Histogram::new(DIGITS).expect("a histogram"))
    }
}

impl Durations {
    /// One more, in microseconds.
    pub(crate) fn note(&mut self, us: u64) {
        #[expect(clippy::expect_used, reason = "it grows as it needs")]
        self.0.record(us).expect("it grows");
    }

    /// All of these too.
    pub(crate) fn add(&mut self, other: &Self) {
        #[expect(clippy::expect_used, reason = "both grow as they need")]
        self.0.add(&other.0).expect("it grows");
    }

    /// Returns the number of durations.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.0.len()
    }

    /// Returns the duration that so many of a hundred do not exceed.
    #[must_use]
    pub fn share(&self, percent: f64) -> Duration {
        Duration::from_micros(self.0.value_at_percentile(percent))
    }

    /// The longest.
    #[must_use]
    pub fn longest(&self) -> Duration {
        Duration::from_micros(self.0.max())
    }
}

impl fmt::Display for Durations {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        let [half, most, nearly_all] = [50.0, 90.0, 99.0].map(|percent| ms(self.share(percent)));
        let longest = ms(self.longest());
        write!(to, "p50 {half:.1} ms, p90 {most:.1} ms, p99 {nearly_all:.1} ms, longest {longest:.1} ms")
    }
}

#[cfg(test)]
mod tests {
    use super::Durations;
    use std::time::Duration;

    #[test]
    fn one_of_a_hundred_exceeds_the_99th_percent() {
        let mut times = Durations::default();
        (1..=200).for_each(|ms| times.note(ms * 1_000));
        let near = |time: Duration, ms: f64| (time.as_secs_f64() * 1e3 - ms).abs() < ms / 500.0;
        assert!(near(times.share(99.0), 198.0) && near(times.longest(), 200.0), "{times}");
        let mut both = Durations::default();
        both.add(&times);
        both.add(&times);
        assert_eq!(both.count(), 400);
    }
}
