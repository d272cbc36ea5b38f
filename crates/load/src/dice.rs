//! Chance that is the same for the same seed: SplitMix64.

/// Chance.
#[derive(Clone, Debug)]
pub struct Dice(u64);

impl Dice {
    /// Chance of this seed, and of this one of those who share it.
    #[must_use]
    pub fn of(seed: u64, number: u64) -> Self {
        let mut dice = Self(seed ^ number.wrapping_mul(0x9E37_79B9_7F4A_7C15));
        dice.next();
        dice
    }

    /// One of so many numbers from 0.
    pub fn below(&mut self, many: u64) -> u64 {
        self.next() % many.max(1)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }
}
