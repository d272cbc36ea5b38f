//! Readings in few bytes: an hour of them is a tenth of its recording.

use behaviour::{FieldNames, Fields, Lookup, Value};
use engine::StreamIx;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The deepest that a value is nested; what is deeper is kept as nothing. JSON is read no deeper either.
const DEPTH_MAX: usize = 128;
/// Shapes that are found at once.
const BY_SHAPE_MAX: usize = 1_024;

/// A reading.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TapedReading {
    pub(crate) at_ms: u64,
    pub(crate) stream: StreamIx,
    pub(crate) value: Value,
    /// True if somebody pretended that it was sensed.
    pub(crate) pretended: bool,
}

/// The names of fields, each set of them once.
#[derive(Default)]
pub(crate) struct Shapes {
    all: Vec<FieldNames>,
    by_names: BTreeMap<Vec<Arc<str>>, usize>,
    /// By [`Fields::shape`], as far as there is room: large objects have another one each.
    by_shape: Lookup<u64, usize>,
}

/// Some readings one after the other.
#[derive(Debug, Default)]
pub(crate) struct Tape {
    bytes: Vec<u8>,
    pub(crate) readings: usize,
}

/// The kinds of values, as their first byte.
mod kind {
    pub(super) const NULL: u8 = 0;
    pub(super) const FALSE: u8 = 1;
    pub(super) const TRUE: u8 = 2;
    pub(super) const INT: u8 = 3;
    pub(super) const FLOAT: u8 = 4;
    /// A float that needs half its bits.
    pub(super) const SHORT: u8 = 5;
    pub(super) const TEXT: u8 = 6;
    pub(super) const LIST: u8 = 7;
    pub(super) const MAP: u8 = 8;
}

impl std::fmt::Debug for Shapes {
    fn fmt(&self, to: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(to, "Shapes({})", self.all.len())
    }
}

impl Shapes {
    fn place(&mut self, fields: &Fields) -> usize {
        if let Some(place) = self.by_shape.get(&fields.shape()) {
            return *place;
        }
        let all = &mut self.all;
        let names = fields.iter().map(|(name, _)| name.clone()).collect();
        let place = *self.by_names.entry(names).or_insert_with(|| {
            all.push(fields.names().clone());
            all.len() - 1
        });
        if self.by_shape.len() < BY_SHAPE_MAX {
            self.by_shape.insert(fields.shape(), place);
        }
        place
    }

    /// Returns roughly how many bytes they take.
    pub(crate) fn bytes(&self) -> usize {
        self.all.iter().map(|names| 128 + 96 * names.len()).sum()
    }
}

impl Tape {
    /// Adds a reading; the one before it was at `before_ms`.
    pub(crate) fn push(&mut self, reading: &TapedReading, before_ms: u64, shapes: &mut Shapes) {
        self.number(reading.at_ms.saturating_sub(before_ms));
        self.number(reading.stream.index() as u64 * 2 + u64::from(reading.pretended));
        self.value(&reading.value, shapes, 0);
        self.readings += 1;
    }

    /// Adds all readings of another one, which went on where this ends.
    pub(crate) fn append(&mut self, next: &mut Self) {
        self.bytes.append(&mut next.bytes);
        self.readings += std::mem::take(&mut next.readings);
    }

    /// Nothing more is added.
    pub(crate) fn close(&mut self) {
        self.bytes.shrink_to_fit();
    }

    /// Returns the number of bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.bytes.capacity()
    }

    /// Reads from the beginning; the reading before it was at `before_ms`.
    pub(crate) fn readings<'t>(
        &'t self,
        before_ms: u64,
        shapes: &'t Shapes,
    ) -> impl Iterator<Item = TapedReading> + 't {
        let mut reader = TapeReader { rest: &self.bytes, shapes };
        let mut at_ms = before_ms;
        std::iter::from_fn(move || {
            at_ms += reader.number()?;
            let about = reader.number()?;
            let stream = StreamIx::of(usize::try_from(about / 2).ok()?);
            Some(TapedReading { at_ms, stream, value: reader.value()?, pretended: about % 2 == 1 })
        })
    }

    /// A number in seven bits a byte, the lowest first.
    fn number(&mut self, mut number: u64) {
        while number >= 0x80 {
            self.bytes.push(number.to_le_bytes()[0] | 0x80);
            number >>= 7;
        }
        self.bytes.push(number.to_le_bytes()[0]);
    }

    fn value(&mut self, value: &Value, shapes: &mut Shapes, depth: usize) {
        if depth > DEPTH_MAX {
            return self.bytes.push(kind::NULL);
        }
        match value {
            Value::Null => self.bytes.push(kind::NULL),
            Value::Bool(truth) => self.bytes.push(if *truth { kind::TRUE } else { kind::FALSE }),
            Value::Int(whole) => {
                self.bytes.push(kind::INT);
                // The sign last, so that small numbers of either are short.
                self.number(((whole << 1) ^ (whole >> 63)).cast_unsigned());
            }
            Value::Float(number) => self.float(*number),
            Value::Text(text) => {
                self.bytes.push(kind::TEXT);
                self.number(text.len() as u64);
                self.bytes.extend_from_slice(text.as_bytes());
            }
            Value::List(items) => {
                self.bytes.push(kind::LIST);
                self.number(items.len() as u64);
                items.iter().for_each(|item| self.value(item, shapes, depth + 1));
            }
            Value::Map(fields) => {
                self.bytes.push(kind::MAP);
                let place = shapes.place(fields);
                self.number(place as u64);
                fields.values().iter().for_each(|value| self.value(value, shapes, depth + 1));
            }
        }
    }

    fn float(&mut self, number: f64) {
        #[expect(clippy::cast_possible_truncation, reason = "kept only if nothing is lost")]
        let short = number as f32;
        if f64::from(short).to_bits() == number.to_bits() {
            self.bytes.push(kind::SHORT);
            self.bytes.extend_from_slice(&short.to_le_bytes());
        } else {
            self.bytes.push(kind::FLOAT);
            self.bytes.extend_from_slice(&number.to_le_bytes());
        }
    }
}

struct TapeReader<'t> {
    rest: &'t [u8],
    shapes: &'t Shapes,
}

impl<'t> TapeReader<'t> {
    fn take(&mut self, bytes: usize) -> Option<&'t [u8]> {
        let (taken, rest) = self.rest.split_at_checked(bytes)?;
        self.rest = rest;
        Some(taken)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (taken, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        Some(*taken)
    }

    fn number(&mut self) -> Option<u64> {
        let (mut number, mut shift) = (0_u64, 0);
        loop {
            let [byte] = self.array()?;
            number |= u64::from(byte & 0x7f).checked_shl(shift)?;
            if byte < 0x80 {
                return Some(number);
            }
            shift += 7;
        }
    }

    fn length(&mut self) -> Option<usize> {
        usize::try_from(self.number()?).ok()
    }

    fn value(&mut self) -> Option<Value> {
        let [kind] = self.array()?;
        Some(match kind {
            kind::FALSE => Value::Bool(false),
            kind::TRUE => Value::Bool(true),
            kind::INT => {
                let number = self.number()?;
                Value::Int((number >> 1).cast_signed() ^ -(number & 1).cast_signed())
            }
            kind::FLOAT => Value::Float(f64::from_le_bytes(self.array()?)),
            kind::SHORT => Value::Float(f64::from(f32::from_le_bytes(self.array()?))),
            kind::TEXT => {
                let length = self.length()?;
                Value::Text(Arc::from(std::str::from_utf8(self.take(length)?).ok()?))
            }
            kind::LIST => {
                let length = self.length()?;
                Value::list((0..length).map(|_| self.value()).collect::<Option<Vec<_>>>()?)
            }
            kind::MAP => {
                let place = self.length()?;
                let names = self.shapes.all.get(place)?;
                let values = (0..names.len()).map(|_| self.value()).collect::<Option<Vec<_>>>()?;
                Value::Map(Fields::with(names, values.into_iter()))
            }
            _ => Value::Null,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Shapes, Tape, TapedReading};
    use behaviour::Value;
    use engine::StreamIx;

    fn readings() -> Vec<TapedReading> {
        let object = |size: f64| {
            let place = Value::object([("x", Value::Float(0.1)), ("y", Value::Int(-3))]);
            Value::object([("size", Value::Float(size)), ("name", Value::text("赤い")), ("at", place)])
        };
        let values = [
            Value::Null,
            Value::Bool(true),
            Value::Bool(false),
            Value::Int(0),
            Value::Int(-1),
            Value::Int(i64::MAX),
            Value::Int(i64::MIN),
            Value::Float(-0.0),
            Value::Float(0.1),
            Value::Float(1.5),
            Value::Float(f64::MAX),
            Value::text(""),
            Value::list([Value::Int(1), Value::list([]), object(2.0)]),
            object(0.5),
            object(1e-300),
        ];
        let reading = |(at, value): (usize, Value)| TapedReading {
            at_ms: 1_000 + at as u64 * at as u64 * 40,
            stream: StreamIx::of(at % 3 * 70),
            value,
            pretended: at % 4 == 1,
        };
        values.into_iter().enumerate().map(reading).collect()
    }

    fn written(all: &[TapedReading], before_ms: u64, shapes: &mut Shapes) -> Tape {
        let (mut tape, mut before_ms) = (Tape::default(), before_ms);
        for reading in all {
            tape.push(reading, before_ms, shapes);
            before_ms = reading.at_ms;
        }
        tape.close();
        tape
    }

    #[test]
    fn readings_are_read_as_they_were_written_bit_for_bit() {
        let (all, mut shapes) = (readings(), Shapes::default());
        let tape = written(&all, 999, &mut shapes);
        let read: Vec<_> = tape.readings(999, &shapes).collect();
        assert_eq!(recorded(&read), recorded(&all));
        assert_eq!(tape.readings, all.len());
    }

    /// Values as JSON, which tells 0.0 from -0.0.
    fn recorded(all: &[TapedReading]) -> Vec<(u64, usize, String, bool)> {
        let one = |one: &TapedReading| (one.at_ms, one.stream.index(), recording::json(&one.value), one.pretended);
        all.iter().map(one).collect()
    }

    #[test]
    fn tapes_that_follow_each_other_are_one() {
        let (all, mut shapes) = (readings(), Shapes::default());
        let (first, second) = all.split_at(6);
        let mut one = written(first, 0, &mut shapes);
        let mut other = written(second, first[5].at_ms, &mut shapes);
        one.append(&mut other);
        assert_eq!(recorded(&one.readings(0, &shapes).collect::<Vec<_>>()), recorded(&all));
    }

    #[test]
    fn a_sighting_takes_few_bytes() {
        let sighting = |at: u64| TapedReading {
            at_ms: at * 16,
            stream: StreamIx::of(2),
            value: Value::object([
                ("x", Value::Float(0.1 + at as f64 / 7.0)),
                ("y", Value::Float(0.5)),
                ("size", Value::Float(0.25)),
                ("id", Value::Int(7)),
            ]),
            pretended: false,
        };
        let all: Vec<_> = (0..1_000).map(sighting).collect();
        assert!(written(&all, 0, &mut Shapes::default()).bytes() <= 30_000);
    }
}
