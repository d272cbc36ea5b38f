//! A fingerprint of the whole state, the same on every machine: FNV-1a over bytes in a chosen order.

use robot::Use;

/// Adds whose it is.
pub(crate) fn digest_use(user: &Use, digest: &mut RunningHash) {
    digest.whole(user.run);
    digest.text(user.stream.as_str());
}

/// A running fingerprint.
pub(crate) struct RunningHash(u64);

impl RunningHash {
    /// The start value of FNV-1a with 64 bits.
    pub(crate) fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Adds a whole number.
    pub(crate) fn whole(&mut self, number: u64) {
        self.bytes(&number.to_le_bytes());
    }

    /// Adds how many things follow.
    pub(crate) fn count(&mut self, count: usize) {
        self.whole(count as u64);
    }

    /// Adds measured numbers bit for bit.
    pub(crate) fn floats(&mut self, numbers: &[f32]) {
        for number in numbers {
            self.bytes(&number.to_bits().to_le_bytes());
        }
    }

    /// Adds true or false.
    pub(crate) fn truth(&mut self, truth: bool) {
        self.bytes(&[u8::from(truth)]);
    }

    /// Adds a text with its length.
    pub(crate) fn text(&mut self, text: &str) {
        self.count(text.len());
        self.bytes(text.as_bytes());
    }

    /// The fingerprint.
    pub(crate) fn finish(self) -> u64 {
        self.0
    }
}
