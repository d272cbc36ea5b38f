//! Numbers over time: of each stream, and of each number field of its values, the smallest, largest, first and last of every
//! slot of time. All slots are equally long, and twice as long once they become too many, so that their bytes are bounded
//! however long a run is.

use crate::sparse::Sparse;
use behaviour::Value;
use protocol::LaneColumn;
use std::sync::Arc;

/// The length of a slot at first, in milliseconds.
pub(crate) const SLOT_MS: u64 = 100;
/// The most slots of all series together: 24 bytes each.
const SLOTS_MAX: usize = 800_000;
/// The most number fields of one stream that have a series.
const FIELDS_MAX: usize = 16;
/// The most fields of all streams together.
const ALL_FIELDS_MAX: usize = 2_000;
/// The deepest field: `a.b.c`.
const DEPTH_MAX: usize = 3;

/// One slot in which something came.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SeriesSlot {
    at: u32,
    count: u32,
    /// Smallest, largest, first, last; not numbers if there was none.
    numbers: [f32; 4],
}

/// Values that came over time, in one row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Series {
    slots: Vec<SeriesSlot>,
    /// True if there are numbers.
    pub(crate) numbers: bool,
}

/// The series of one stream.
#[derive(Debug, Default)]
pub(crate) struct StreamSeries {
    pub(crate) count: u64,
    pub(crate) whole: Series,
    /// By their paths.
    pub(crate) fields: Vec<(Arc<str>, Series)>,
    /// The values themselves, as long as they are few.
    pub(crate) few: Sparse,
}

/// The series of all streams.
#[derive(Debug)]
pub(crate) struct AllSeries {
    pub(crate) streams: Vec<StreamSeries>,
    pub(crate) slot_ms: u64,
    slots: usize,
    fields: usize,
    slots_max: usize,
    /// The bytes of the values that are kept.
    few_bytes: usize,
}

impl Default for AllSeries {
    fn default() -> Self {
        Self::within(SLOTS_MAX)
    }
}

/// The number that is drawn for a value.
pub(crate) fn drawn(value: &Value) -> Option<f64> {
    match value {
        Value::Bool(truth) => Some(f64::from(u8::from(*truth))),
        other => other.as_number(),
    }
}

/// A number as it is drawn.
#[expect(clippy::cast_possible_truncation, reason = "nobody sees the difference in a drawing")]
fn short(number: f64) -> f32 {
    // A number that is too large for it is drawn at the edge.
    number.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32
}

impl SeriesSlot {
    fn of(at: u32, number: Option<f64>) -> Self {
        Self { at, count: 1, numbers: [number.map_or(f32::NAN, short); 4] }
    }

    /// A later value comes in it.
    fn add(&mut self, number: Option<f64>) {
        self.join(&Self::of(self.at, number));
    }

    /// Takes what came later.
    fn join(&mut self, later: &Self) {
        self.count = self.count.saturating_add(later.count);
        let [low, high, first, last] = later.numbers;
        if low.is_nan() {
            return;
        }
        let of = &mut self.numbers;
        if of[0].is_nan() {
            *of = later.numbers;
        } else {
            *of = [of[0].min(low), of[1].max(high), of[2], last];
        }
        debug_assert!(!first.is_nan());
    }

    fn column(&self, at: u32) -> LaneColumn {
        LaneColumn { at, count: self.count, numbers: Some(self.numbers).filter(|[low, ..]| !low.is_nan()) }
    }
}

impl Series {
    /// Adds a value in a slot that is not before the last one; true if the slot is new.
    fn add(&mut self, at: u32, number: Option<f64>) -> bool {
        self.numbers |= number.is_some();
        match self.slots.last_mut() {
            Some(last) if last.at >= at => {
                last.add(number);
                false
            }
            _ => {
                self.slots.push(SeriesSlot::of(at, number));
                true
            }
        }
    }

    /// Makes two slots one; answers how many there are.
    fn halve(&mut self) -> usize {
        let mut halved: Vec<SeriesSlot> = Vec::with_capacity(self.slots.len() / 2 + 1);
        for slot in &self.slots {
            let slot = SeriesSlot { at: slot.at / 2, ..*slot };
            match halved.last_mut() {
                Some(last) if last.at == slot.at => last.join(&slot),
                _ => halved.push(slot),
            }
        }
        self.slots = halved;
        self.slots.len()
    }

    /// The columns of a time, each slot in the one in which it begins.
    fn columns(&self, slot_ms: u64, axis: &Columns) -> Vec<LaneColumn> {
        let from = self.slots.partition_point(|slot| u64::from(slot.at) * slot_ms < axis.from_ms);
        let mut open: Option<(u32, SeriesSlot)> = None;
        let mut columns = Vec::new();
        for slot in &self.slots[from..] {
            let Some(at) = axis.of(u64::from(slot.at) * slot_ms) else { break };
            match &mut open {
                Some((column, all)) if *column == at => all.join(slot),
                _ => {
                    columns.extend(open.map(|(column, all)| all.column(column)));
                    open = Some((at, *slot));
                }
            }
        }
        columns.extend(open.map(|(column, all)| all.column(column)));
        columns
    }
}

/// A time, divided into columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Columns {
    pub(crate) from_ms: u64,
    pub(crate) to_ms: u64,
    pub(crate) count: usize,
}

impl Columns {
    /// The column of a moment; none outside.
    pub(crate) fn of(&self, at_ms: u64) -> Option<u32> {
        if at_ms < self.from_ms || at_ms >= self.to_ms {
            return None;
        }
        let (since, span) = (u128::from(at_ms - self.from_ms), u128::from(self.to_ms - self.from_ms));
        u32::try_from(since * self.count as u128 / span).ok()
    }
}

/// The columns of values that come one after the other.
#[derive(Debug)]
pub(crate) struct ColumnsOf {
    axis: Columns,
    open: Option<(u32, SeriesSlot)>,
    done: Vec<LaneColumn>,
}

impl ColumnsOf {
    pub(crate) fn of(axis: Columns) -> Self {
        Self { axis, open: None, done: Vec::new() }
    }

    pub(crate) fn add(&mut self, at_ms: u64, number: Option<f64>) {
        let Some(at) = self.axis.of(at_ms) else { return };
        match &mut self.open {
            Some((column, all)) if *column == at => all.add(number),
            _ => {
                self.done.extend(self.open.map(|(column, all)| all.column(column)));
                self.open = Some((at, SeriesSlot::of(at, number)));
            }
        }
    }

    pub(crate) fn finish(mut self) -> Vec<LaneColumn> {
        self.done.extend(self.open.map(|(column, all)| all.column(column)));
        self.done
    }
}

impl AllSeries {
    /// With so many slots at most.
    pub(crate) fn within(slots_max: usize) -> Self {
        Self { streams: Vec::new(), slot_ms: SLOT_MS, slots: 0, fields: 0, slots_max, few_bytes: 0 }
    }

    /// A value comes on a stream, not before what came last.
    pub(crate) fn add(&mut self, stream: usize, at_ms: u64, value: &Value, pretended: bool) {
        if self.streams.len() <= stream {
            self.streams.resize_with(stream + 1, StreamSeries::default);
        }
        let at = u32::try_from(at_ms / self.slot_ms).unwrap_or(u32::MAX);
        let of = &mut self.streams[stream];
        of.count += 1;
        of.few.add(at_ms, value, pretended, &mut self.few_bytes);
        self.slots += usize::from(of.whole.add(at, drawn(value)));
        if let Value::Map(_) = value {
            let mut adding = FieldAdding { of, at, slots: 0, fields: &mut self.fields, place: 0 };
            adding.object("", value, 1);
            self.slots += adding.slots;
        }
        if self.slots > self.slots_max {
            self.halve();
        }
    }

    fn halve(&mut self) {
        self.slot_ms *= 2;
        let all = self.streams.iter_mut().flat_map(|stream| {
            std::iter::once(&mut stream.whole).chain(stream.fields.iter_mut().map(|(_, field)| field))
        });
        self.slots = all.map(Series::halve).sum();
    }

    /// Nothing more is added.
    pub(crate) fn close(&mut self) {
        for stream in &mut self.streams {
            stream.whole.slots.shrink_to_fit();
            stream.fields.iter_mut().for_each(|(_, field)| field.slots.shrink_to_fit());
        }
    }

    /// Returns roughly how many bytes they take.
    pub(crate) fn bytes(&self) -> usize {
        let series = |series: &Series| series.slots.capacity() * size_of::<SeriesSlot>();
        let stream = |stream: &StreamSeries| {
            let fields = stream.fields.iter().map(|(name, field)| 64 + name.len() + series(field));
            size_of::<StreamSeries>() + series(&stream.whole) + fields.sum::<usize>()
        };
        self.streams.iter().map(stream).sum::<usize>() + self.few_bytes
    }

    /// The columns of a stream or a field.
    pub(crate) fn columns(&self, stream: usize, field: Option<&str>, axis: &Columns) -> Vec<LaneColumn> {
        let Some(of) = self.streams.get(stream) else { return Vec::new() };
        let series = match field {
            None => Some(&of.whole),
            Some(field) => of.fields.iter().find(|(name, _)| **name == *field).map(|(_, series)| series),
        };
        series.map(|series| series.columns(self.slot_ms, axis)).unwrap_or_default()
    }
}

/// The fields of a value on their way into the series of its stream.
struct FieldAdding<'s> {
    of: &'s mut StreamSeries,
    at: u32,
    /// Slots that are new.
    slots: usize,
    fields: &'s mut usize,
    /// The place at which the next field probably is: values of one stream have the same fields in the same order.
    place: usize,
}

impl FieldAdding<'_> {
    fn object(&mut self, path: &str, value: &Value, depth: usize) {
        let Value::Map(fields) = value else { return };
        for (name, value) in fields.iter() {
            match value {
                Value::Map(_) if depth < DEPTH_MAX => self.object(&joined(path, name), value, depth + 1),
                other => {
                    if let Some(number) = drawn(other) {
                        self.number(path, name, number);
                    }
                }
            }
        }
    }

    fn number(&mut self, path: &str, name: &str, number: f64) {
        let is_it = |known: &str| match path {
            "" => known == name,
            path => known.strip_prefix(path).and_then(|rest| rest.strip_prefix('.')) == Some(name),
        };
        let fields = &mut self.of.fields;
        let here = fields.get(self.place).is_some_and(|(known, _)| is_it(known)).then_some(self.place);
        let at = here.or_else(|| fields.iter().position(|(known, _)| is_it(known)));
        let at = match at {
            Some(at) => at,
            None if fields.len() < FIELDS_MAX && *self.fields < ALL_FIELDS_MAX => {
                fields.push((joined(path, name).into(), Series::default()));
                *self.fields += 1;
                fields.len() - 1
            }
            None => return,
        };
        self.place = at + 1;
        self.slots += usize::from(fields[at].1.add(self.at, Some(number)));
    }
}

fn joined(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}

/// The field of a value at a path.
pub(crate) fn field<'v>(value: &'v Value, path: &str) -> Option<&'v Value> {
    // A name may have points itself.
    value
        .field(path)
        .or_else(|| path.match_indices('.').find_map(|(at, _)| field(value.field(&path[..at])?, &path[at + 1..])))
}

#[cfg(test)]
mod tests;
