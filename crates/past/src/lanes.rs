//! Values over time: exact where the time is short, else by the slots that were gathered at the opening.

use crate::cut::cut;
use crate::hook::Hook;
use crate::past::Past;
use crate::play::{PlainPlayer, Played, play};
use crate::series::{Columns, ColumnsOf, drawn, field};
use crate::sparse::SparseValue;
use behaviour::Value;
use engine::Emission;
use protocol::{LANE_COLUMNS_MAX, LANE_VALUES_MAX, LANES_MAX, LaneName, LaneValue, LaneValues, NotSeen, PastLane};

/// The most readings that are played for lanes.
const PLAYED_MAX: usize = 20_000;
/// The most bytes of the values of all lanes of an answer, as they are in memory: about twice what they take as JSON.
const VALUES_MAX_BYTES: usize = 160 << 10;

impl Past {
    /// Returns lanes in a time that is divided into columns.
    ///
    /// # Errors
    /// If more is asked than is answered, or if it cannot be played.
    pub fn lanes(
        &self,
        lanes: &[LaneName],
        (from_ms, to_ms): (u64, u64),
        columns: usize,
        hook: &Hook,
    ) -> Result<Vec<PastLane>, NotSeen> {
        if lanes.len() > LANES_MAX || lanes.len().saturating_mul(columns) > LANE_COLUMNS_MAX {
            return Err(NotSeen::TooMuch);
        }
        if from_ms >= to_ms || columns == 0 {
            return Err(NotSeen::NoTime);
        }
        let axis = Columns { from_ms, to_ms, count: columns };
        let known =
            |name: &LaneName| self.streams.place(&name.stream).ok_or_else(|| NotSeen::NoStream(name.stream.clone()));
        let places = lanes.iter().map(known).collect::<Result<Vec<_>, _>>()?;
        let values = match self.exact(&axis) {
            true => self.played(lanes, &places, axis, hook)?,
            false => lanes.iter().zip(places).map(|(name, place)| self.gathered(name, place, &axis)).collect(),
        };
        let mut left = VALUES_MAX_BYTES;
        let told = |(name, (each, columns)): (&LaneName, (Option<Vec<LaneValue>>, _))| {
            let each = each.filter(|each| take(&mut left, each));
            PastLane { name: name.clone(), values: each.map_or(LaneValues::Columns(columns), LaneValues::Each) }
        };
        Ok(lanes.iter().zip(values).map(told).collect())
    }

    /// True if a time is so short that it is played again.
    fn exact(&self, axis: &Columns) -> bool {
        let (first, last) = (self.segment_at(axis.from_ms), self.segment_at(axis.to_ms - 1));
        self.segments[first..=last].iter().map(|segment| segment.tape.readings).sum::<usize>() <= PLAYED_MAX
    }

    fn played(&self, lanes: &[LaneName], places: &[usize], axis: Columns, hook: &Hook) -> Result<Vec<Drawn>, NotSeen> {
        let mut all: Vec<PlayedLane> =
            lanes.iter().zip(places).map(|(name, place)| PlayedLane::of(name, *place, axis)).collect();
        let mut hear = |played: Played| {
            let Emission::Value { at, stream, value, .. } = played.emission else { return };
            let place = self.programs[played.program].places[stream.index()];
            for lane in all.iter_mut().filter(|lane| lane.place == place) {
                lane.hear(at.0, value, played.pretended);
            }
        };
        let from = self.segment_at(axis.from_ms);
        let mut player = PlainPlayer::at(self, from, hook, &mut hear)?;
        play(self, from, axis.to_ms - 1, &mut player)?;
        Ok(all.into_iter().map(PlayedLane::finish).collect())
    }

    fn gathered(&self, name: &LaneName, place: usize, axis: &Columns) -> Drawn {
        let few = self.series.streams.get(place).and_then(|stream| stream.few.all());
        let each = few.map(|all| {
            let mut numbered = ValueNumbers::default();
            let value = |one: &SparseValue| {
                let nth = numbered.number(one.at_ms);
                let value = of_field(&one.value, name.field.as_deref())?;
                axis.of(one.at_ms)?;
                Some(LaneValue { t: one.at_ms, nth, value: value.clone(), pretended: one.pretended })
            };
            all.iter().filter_map(value).collect()
        });
        (each, self.series.columns(place, name.field.as_deref(), axis))
    }
}

/// The values of a lane, if they are few, and its columns.
type Drawn = (Option<Vec<LaneValue>>, Vec<protocol::LaneColumn>);

/// Counts the values of one millisecond.
#[derive(Default)]
struct ValueNumbers {
    at_ms: Option<u64>,
    next: usize,
}

impl ValueNumbers {
    fn number(&mut self, at_ms: u64) -> usize {
        if self.at_ms.replace(at_ms) != Some(at_ms) {
            self.next = 0;
        }
        self.next += 1;
        self.next - 1
    }
}

/// A lane while it is played.
struct PlayedLane<'n> {
    place: usize,
    field: Option<&'n str>,
    axis: Columns,
    numbered: ValueNumbers,
    /// None once they are too many.
    each: Option<Vec<LaneValue>>,
    columns: ColumnsOf,
}

impl<'n> PlayedLane<'n> {
    fn of(name: &'n LaneName, place: usize, axis: Columns) -> Self {
        let (each, columns) = (Some(Vec::new()), ColumnsOf::of(axis));
        Self { place, field: name.field.as_deref(), axis, numbered: ValueNumbers::default(), each, columns }
    }

    fn hear(&mut self, at_ms: u64, value: &Value, pretended: bool) {
        let nth = self.numbered.number(at_ms);
        let Some(value) = of_field(value, self.field) else { return };
        if self.axis.of(at_ms).is_none() {
            return;
        }
        self.columns.add(at_ms, drawn(value));
        if let Some(each) = &mut self.each {
            each.push(LaneValue { t: at_ms, nth, value: cut(value), pretended });
            if each.len() > LANE_VALUES_MAX {
                self.each = None;
            }
        }
    }

    fn finish(self) -> Drawn {
        (self.each, self.columns.finish())
    }
}

/// The value of a lane: all of it, or a field if that is a number.
fn of_field<'v>(value: &'v Value, name: Option<&str>) -> Option<&'v Value> {
    match name {
        None => Some(value),
        Some(name) => field(value, name).filter(|value| drawn(value).is_some()),
    }
}

/// Takes the bytes of some values; false if they do not fit.
fn take(left: &mut usize, each: &[LaneValue]) -> bool {
    let bytes = each.iter().map(|one| 48 + one.value.bytes()).sum();
    match left.checked_sub(bytes) {
        Some(rest) => {
            *left = rest;
            true
        }
        None => false,
    }
}
