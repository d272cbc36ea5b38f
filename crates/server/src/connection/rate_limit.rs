//! How often something may be asked: so many at once, then so many a second.

use std::time::Instant;

/// How often.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rate {
    /// How many a second.
    pub(super) per_second: f64,
    /// How many at once.
    pub(super) at_once: f64,
}

/// Permissions to ask, which come back by themselves.
#[derive(Debug)]
pub(super) struct RateLimit {
    pace: Rate,
    left: f64,
    at: Instant,
}

impl RateLimit {
    /// None is taken yet.
    pub(super) fn full(pace: Rate) -> Self {
        Self { pace, left: pace.at_once, at: Instant::now() }
    }

    /// Takes one permission, if there is one.
    pub(super) fn take(&mut self) -> bool {
        self.take_at(Instant::now())
    }

    /// Whether all have come back.
    pub(super) fn is_full(&self) -> bool {
        self.left_at(Instant::now()) >= self.pace.at_once
    }

    fn left_at(&self, now: Instant) -> f64 {
        let since = now.saturating_duration_since(self.at).as_secs_f64();
        (self.left + since * self.pace.per_second).min(self.pace.at_once)
    }

    fn take_at(&mut self, now: Instant) -> bool {
        (self.left, self.at) = (self.left_at(now), now);
        let may = self.left >= 1.0;
        self.left -= f64::from(u8::from(may));
        may
    }
}

#[cfg(test)]
mod tests {
    use super::{Rate, RateLimit};
    use std::time::Duration;

    #[test]
    fn so_many_at_once_then_so_many_a_second() {
        let mut rate = RateLimit::full(Rate { per_second: 50.0, at_once: 200.0 });
        let start = rate.at;
        let takes = |rate: &mut RateLimit, ms: u64| {
            let now = start + Duration::from_millis(ms);
            (0..1_000).filter(|_| rate.take_at(now)).count()
        };
        assert_eq!(takes(&mut rate, 0), 200);
        assert_eq!(takes(&mut rate, 1_000), 50);
        assert_eq!(takes(&mut rate, 60_000), 200);
    }
}
