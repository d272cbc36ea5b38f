//! The meter of steps, each being work of about a tenth of a microsecond. Longer work counts as more steps, by the size
//! of its values alone, so that a call takes the same number of steps on every machine.
//!
//! Rhai counts the parts of a procedure as it computes them, one step each. What is heavy in one part is owed here, and
//! counted with the next part. The nanoseconds below are measured; they are weights, not times.

use rhai::{Array, Dynamic, Identifier, Map};
use std::cell::Cell;

/// The time that one step stands for.
pub(crate) const STEP_NANOS: usize = 100;
/// Copying a number, or taking another hold of a text, and dropping it.
const ITEM_NANOS: usize = 12;
/// Making and dropping a list, an object or a function.
const HOLDER_NANOS: usize = 80;
/// Copying a field with a short name.
const FIELD_NANOS: usize = 60;
/// Looking at a part that is no number.
const LOOK_NANOS: usize = 5;
/// Looking at a field.
const FIELD_LOOK_NANOS: usize = 10;
/// Looking into a list or object in another.
const HELD_NANOS: usize = 16;
/// Bytes of a long name that are copied in a nanosecond.
const NAME_BYTES_PER_NANO: usize = 4;
/// Bytes of a long name that are compared in a nanosecond: only a few of the names are.
const NAME_BYTES_SEEN_PER_NANO: usize = 128;
/// The deepest nesting that is looked into; it is deeper than any value that may leave a procedure.
const LOOK_DEPTH: usize = 64;
/// Copying what is nested deeper: no list or object could cost more.
const DEEP_NANOS: usize = 50_000;
/// Looking at what is nested deeper.
const DEEP_LOOK_NANOS: usize = 4_000;

thread_local! {
    /// Nanoseconds of work that were not counted as steps yet.
    static OWED: Cell<usize> = const { Cell::new(0) };
}

/// Counts work of about that many nanoseconds.
pub(crate) fn owe(nanos: usize) {
    OWED.set(OWED.get().saturating_add(nanos));
}

/// The whole steps that are owed; less than one step is forgotten, so that small values cost nothing.
#[inline]
pub(crate) fn owed_steps() -> u64 {
    let owed = OWED.get();
    if owed == 0 {
        return 0;
    }
    OWED.set(0);
    (owed / STEP_NANOS) as u64
}

/// Forgets what an earlier call left.
pub(crate) fn forget() {
    OWED.set(0);
}

/// Returns the cost of copying a value, and dropping the copy.
pub(crate) fn copying(value: &Dynamic) -> usize {
    nested(value, LOOK_DEPTH)
}

fn nested(value: &Dynamic, depth: usize) -> usize {
    if !holds(value) {
        return ITEM_NANOS;
    }
    let Some(depth) = depth.checked_sub(1) else { return DEEP_NANOS };
    if let Some(list) = value.read_lock::<Array>() {
        let more = list.iter().filter(|item| holds(item)).map(|item| nested(item, depth));
        return HOLDER_NANOS + list.len() * ITEM_NANOS + more.sum::<usize>();
    }
    value.read_lock::<Map>().map_or(HOLDER_NANOS, |object| HOLDER_NANOS + fields(&object, depth))
}

fn fields(object: &Map, depth: usize) -> usize {
    let field =
        |(name, value): (&Identifier, &Dynamic)| FIELD_NANOS + name.len() / NAME_BYTES_PER_NANO + nested(value, depth);
    object.iter().map(field).sum()
}

/// True for what is made anew when it is copied.
fn holds(value: &Dynamic) -> bool {
    !value.is_int() && !value.is_float() && (value.is_array() || value.is_map() || value.is_fnptr())
}

fn are_numbers(list: &Array) -> bool {
    list.iter().all(|item| item.is_int() || item.is_float())
}

/// Returns the cost of looking through a value, as Rhai does after each function that could have made it larger.
pub(crate) fn looking(value: &Dynamic) -> usize {
    looked_at(value, LOOK_DEPTH)
}

fn looked_at(value: &Dynamic, depth: usize) -> usize {
    if !holds(value) {
        return LOOK_NANOS;
    }
    let Some(depth) = depth.checked_sub(1) else { return DEEP_LOOK_NANOS };
    if let Some(list) = value.read_lock::<Array>() {
        let looked = || list.iter().map(|item| looked_at(item, depth)).sum::<usize>();
        return HELD_NANOS + if are_numbers(&list) { list.len() * 2 } else { looked() };
    }
    let Some(object) = value.read_lock::<Map>() else { return HELD_NANOS };
    let field = |(name, value): (&Identifier, &Dynamic)| {
        FIELD_LOOK_NANOS + name.len() / NAME_BYTES_SEEN_PER_NANO + looked_at(value, depth)
    };
    HELD_NANOS + object.iter().map(field).sum::<usize>()
}

/// Returns the cost of copying the largest part of a value, an item of a list or a field of an object, and finding it.
pub(crate) fn largest_part(value: &Dynamic) -> usize {
    let largest = |parts: &mut dyn Iterator<Item = &Dynamic>| parts.filter(|part| holds(part)).map(copying).max();
    if let Some(list) = value.read_lock::<Array>() {
        return list.len() * 3 / 2 + largest(&mut list.iter().filter(|part| holds(part))).unwrap_or(0);
    }
    value
        .read_lock::<Map>()
        .map_or(0, |object| FIELD_LOOK_NANOS * object.len() + largest(&mut object.values()).unwrap_or(0))
}

/// Items of a list; 0 for what is none.
pub(crate) fn list_length(value: &Dynamic) -> usize {
    value.read_lock::<Array>().map_or(0, |list| list.len())
}

/// Bytes of a text; 0 for what is none.
pub(crate) fn text_bytes(value: &Dynamic) -> usize {
    value.read_lock::<rhai::ImmutableString>().map_or(0, |text| text.len())
}

/// Bytes of the longest text in a list or object.
pub(crate) fn longest_text(value: &Dynamic) -> usize {
    longest(value, LOOK_DEPTH)
}

fn longest(value: &Dynamic, depth: usize) -> usize {
    let Some(depth) = depth.checked_sub(1) else { return 0 };
    if let Some(list) = value.read_lock::<Array>() {
        return list.iter().filter(|item| !item.is_int()).map(|item| longest(item, depth)).max().unwrap_or(0);
    }
    if let Some(object) = value.read_lock::<Map>() {
        return object.values().map(|value| longest(value, depth)).max().unwrap_or(0);
    }
    text_bytes(value)
}

/// True for what takes no longer when it is larger.
pub(crate) fn is_small(value: &Dynamic) -> bool {
    value.is_int() || value.is_float() || value.is_bool() || value.is_unit() || value.is_char()
}
