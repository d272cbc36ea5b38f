//! Keys as numbers, which a page carries instead of their letters.

/// The number with which the number of a key begins: one with which all keys have numbers of their own.
const BEGINNING: u32 = 10;
/// The bits of a number: three bytes of a page each.
const BITS: u32 = 20;

/// The number of a key (FNV-1a, folded to 20 bits). No two keys of a catalogue have the same, which a test of the page holds:
/// where a new key meets another one, it takes another name.
#[must_use]
pub const fn key_of(key: &str) -> u32 {
    let (bytes, mut at, mut number) = (key.as_bytes(), 0, BEGINNING);
    while at < bytes.len() {
        number = (number ^ bytes[at] as u32).wrapping_mul(0x0100_0193);
        at += 1;
    }
    (number ^ (number >> 12)) & ((1 << BITS) - 1)
}
