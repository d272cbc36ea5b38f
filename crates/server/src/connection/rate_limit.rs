//! How often a client may ask: so many at once, then so many a second.

use std::time::Instant;

/// Requests per second.
const PER_SECOND: f64 = 50.0;
/// Requests at once.
const AT_ONCE: f64 = 200.0;

/// Permissions to ask, which come back by themselves.
#[derive(Debug)]
pub(super) struct RateLimit {
    left: f64,
    at: Instant,
}

impl RateLimit {
    /// None is taken yet.
    pub(super) fn full() -> Self {
        Self { left: AT_ONCE, at: Instant::now() }
    }

    /// Takes one permission, if there is one.
    pub(super) fn take(&mut self) -> bool {
        self.take_at(Instant::now())
    }

    fn take_at(&mut self, now: Instant) -> bool {
        let since = now.saturating_duration_since(self.at).as_secs_f64();
        self.left = (self.left + since * PER_SECOND).min(AT_ONCE);
        self.at = now;
        let may = self.left >= 1.0;
        self.left -= f64::from(u8::from(may));
        may
    }
}

#[cfg(test)]
mod tests {
    use super::RateLimit;
    use std::time::Duration;

    #[test]
    fn two_hundred_at_once_then_fifty_a_second() {
        let mut rate = RateLimit::full();
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
