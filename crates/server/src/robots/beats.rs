//! How often something happened lately.

/// Length of a slot in milliseconds.
pub(super) const SLOT_MS: u64 = 250;
/// Slots in the window: two seconds.
const SLOTS: usize = 8;

/// Counts over the last two seconds.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Beats {
    counts: [u32; SLOTS],
    newest_slot: u64,
}

impl Beats {
    /// It happened once more.
    pub(super) fn beat(&mut self, at_ms: u64) {
        self.turn(at_ms);
        let slot = self.slot(self.newest_slot);
        *slot = slot.saturating_add(1);
    }

    /// How often a second over about the last two seconds, or since the start at time 0; to a tenth.
    pub(super) fn per_second(&mut self, at_ms: u64) -> f32 {
        self.turn(at_ms);
        let total: u32 = self.counts.iter().sum();
        let covered_ms = SLOT_MS * (SLOTS as u64 - 1) + at_ms % SLOT_MS;
        let window_ms = covered_ms.min(at_ms).max(SLOT_MS);
        ((f64::from(total) * 10_000.0 / window_ms as f64).round() / 10.0) as f32
    }

    /// Empties the slots that time has left behind.
    fn turn(&mut self, at_ms: u64) {
        let slot_now = at_ms / SLOT_MS;
        if slot_now.saturating_sub(self.newest_slot) >= SLOTS as u64 {
            self.counts = [0; SLOTS];
            self.newest_slot = slot_now;
        }
        while self.newest_slot < slot_now {
            self.newest_slot += 1;
            *self.slot(self.newest_slot) = 0;
        }
    }

    fn slot(&mut self, slot: u64) -> &mut u32 {
        &mut self.counts[(slot % SLOTS as u64) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::Beats;

    #[test]
    fn the_rate_follows_and_fades_within_two_seconds() {
        let mut beats = Beats::default();
        for at_ms in (0..4_000).step_by(100) {
            beats.beat(at_ms);
        }
        assert!((beats.per_second(3_999) - 10.0).abs() < 0.6);
        assert!((beats.per_second(4_000) - 10.0).abs() < 0.6);
        assert!((beats.per_second(5_000) - 4.5).abs() < 1.0);
        assert!(beats.per_second(6_000) < 0.1);
        assert!(Beats::default().per_second(0) < 0.1);
    }
}
