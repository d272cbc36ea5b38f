//! Keys as numbers, which a page carries instead of their letters.

/// The number of a key (FNV-1a). No two keys of a catalogue have the same, which a test of the page holds.
#[must_use]
pub const fn key_of(key: &str) -> u32 {
    let (bytes, mut at, mut number) = (key.as_bytes(), 0, 0x811c_9dc5_u32);
    while at < bytes.len() {
        number = (number ^ bytes[at] as u32).wrapping_mul(0x0100_0193);
        at += 1;
    }
    number
}
