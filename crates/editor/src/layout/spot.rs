//! A free spot for a new stream: below its sources, beside nothing.

use super::{
    CHIP_HEIGHT, DrawnSizes, GAP, Ground, LEVEL, STREAM_HEIGHT, TIDY_VALUE_ROOM, Tidy, VALUE_ROOM, WIDTH_MAX, snapped,
};
use behaviour::{Behaviour, Connector, FillFrom, Graph, Id, Place, Stream, StreamKind};
use std::collections::BTreeMap;

/// The number of spots that are tried to the sides before the next level is.
const SIDE_STEPS: i32 = 24;
/// The length of a step, and the number to the right that are tried before any to the left where siblings stand at the
/// left.
const STEP: f64 = 60.0;
const RIGHT_STEPS: i32 = 14;
/// The number that are tried to the sides in the row of the actions, and how far that may be below the next row.
const IN_ROW_STEPS: i32 = 9;
const ACTIONS_FAR: f64 = 2.0 * LEVEL;
/// From the middle of one sensor to the middle of the next, at least.
const SENSOR_STEP: f64 = 340.0;
/// The number that stand in a row while there is nothing that could tidy.
const IN_A_ROW: usize = 6;

/// Room that something takes.
#[derive(Clone, Copy, Debug)]
struct TakenSpace {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

impl TakenSpace {
    /// A stream with its live value, and the chips that lead to it.
    fn of(place: Place, size: SpotSize) -> [Self; 2] {
        let [half, half_chip] = [size.stream, size.chip].map(|width| width / 2.0);
        let stream = Self {
            left: place.x - half,
            right: place.x + half + VALUE_ROOM,
            top: place.y,
            bottom: place.y + STREAM_HEIGHT,
        };
        let above = if size.chip > 0.0 { CHIP_HEIGHT + 16.0 } else { 0.0 };
        let chip = Self {
            left: place.x - half_chip,
            right: place.x + half_chip,
            top: place.y - above,
            bottom: place.y + STREAM_HEIGHT,
        };
        [stream, chip]
    }

    fn meets(&self, other: &TakenSpace) -> bool {
        let apart = self.right + GAP <= other.left
            || other.right + GAP <= self.left
            || self.bottom + 20.0 <= other.top
            || other.bottom + 20.0 <= self.top;
        !apart
    }
}

/// The width of a stream, and of the widest of the chips that lead to it (0 without any).
#[derive(Clone, Copy, Debug)]
struct SpotSize {
    stream: f64,
    chip: f64,
}

impl SpotSize {
    fn of<'a>(sizes: DrawnSizes, stream: &Stream, into: impl Iterator<Item = &'a Connector>) -> Self {
        let chip = into.map(sizes.chip).fold(0.0, f64::max);
        Self { stream: (sizes.stream)(stream), chip }
    }
}

/// Returns how far a stream reaches to the left and to the right of its middle when all is tidy: with its live value,
/// and with the chips that lead to it, which stand beside each other where several lead to an action.
pub(super) fn reach<'a>(sizes: DrawnSizes, stream: &Stream, into: impl Iterator<Item = &'a Connector>) -> (f64, f64) {
    let chips: Vec<f64> = into.map(sizes.chip).collect();
    let chip = if stream.kind == StreamKind::Actuator {
        chips.iter().map(|width| width + GAP).sum::<f64>() - GAP
    } else {
        chips.into_iter().fold(0.0, f64::max)
    };
    let (half, half_chip) = ((sizes.stream)(stream) / 2.0, chip / 2.0);
    (half.max(half_chip), (half + TIDY_VALUE_ROOM).max(half_chip))
}

/// Returns the place for a new stream that takes from `inputs` through `connector`.
#[must_use]
pub fn free_spot(ground: Ground, stream: &Stream, connector: &Connector) -> Place {
    let Ground { behaviour, places, sizes } = ground;
    let sources: Vec<Place> = connector.inputs.iter().filter_map(|id| places.get(id).copied()).collect();
    if sources.is_empty() {
        return free_sensor_spot(ground, stream);
    }
    let x = sources.iter().map(|place| place.x).sum::<f64>() / sources.len() as f64;
    let y = sources.iter().map(|place| place.y).fold(f64::MIN, f64::max) + LEVEL;
    let size = SpotSize::of(sizes, stream, std::iter::once(connector));
    let taken = taken(ground);
    let wanted = snapped(Place { x, y });
    // Branches stand in the order in which they were made, from left to right: what is new comes behind its siblings.
    let last = last_sibling(behaviour, places, connector);
    let wanted = Place { x: last.map_or(wanted.x, |last| wanted.x.max(last)), ..wanted };
    let side = if last.is_some() { SpotSide::RightFirst } else { SpotSide::Nearest };
    let row = if stream.kind == StreamKind::Actuator { row_of_actions(behaviour, places, wanted.y) } else { None };
    row.and_then(|row| in_row(&taken, Place { y: row, ..wanted }, wanted.y, size, side))
        .unwrap_or_else(|| beside(&taken, wanted, size, side))
}

/// Returns the place of the rightmost of what comes from the same streams.
fn last_sibling(behaviour: &Behaviour, places: &BTreeMap<Id, Place>, connector: &Connector) -> Option<f64> {
    let siblings = behaviour.connectors().filter(|(_, other)| {
        other.output != connector.output && other.inputs.iter().any(|input| connector.inputs.contains(input))
    });
    siblings.filter_map(|(_, other)| places.get(&other.output)).map(|place| place.x).reduce(f64::max)
}

/// To which side of the wanted spot something stands that finds no room there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SpotSide {
    /// Wherever it is nearer.
    Nearest,
    /// To the right if there is room not far from there.
    RightFirst,
}

impl SpotSide {
    /// Returns the steps to the right of the wanted spot that are tried, one after the other.
    fn steps(self, most: i32) -> impl Iterator<Item = f64> {
        let first = if self == Self::RightFirst { 0..most.min(RIGHT_STEPS) } else { 0..0 };
        let both = (0..most).flat_map(|step| if step == 0 { vec![0] } else { vec![step, -step] });
        first.chain(both).map(f64::from)
    }
}

/// The row in which the actions stand, if that is lower than the row below the sources, and not far below it.
fn row_of_actions(behaviour: &Behaviour, places: &BTreeMap<Id, Place>, below: f64) -> Option<f64> {
    let actions = behaviour.streams().filter(|(_, stream)| stream.kind == StreamKind::Actuator);
    let lowest = actions.filter_map(|(id, _)| places.get(id)).map(|place| place.y).reduce(f64::max)?;
    (lowest > below && lowest <= below + ACTIONS_FAR).then_some(lowest)
}

/// A free spot in a row where nothing stands between it and the row below the sources either.
fn in_row(taken: &[TakenSpace], wanted: Place, from: f64, size: SpotSize, side: SpotSide) -> Option<Place> {
    let is_free = |place: &Place| {
        let [stream, chip] = TakenSpace::of(*place, size);
        let way = TakenSpace { top: from - CHIP_HEIGHT, ..chip };
        taken.iter().all(|other| [stream, way].iter().all(|room| !room.meets(other)))
    };
    side.steps(IN_ROW_STEPS).map(|step| Place { x: wanted.x + step * STEP, ..wanted }).find(is_free)
}

/// Returns the place for a new sensor: in the top row, to the right of the others.
#[must_use]
pub fn free_sensor_spot(ground: Ground, stream: &Stream) -> Place {
    let places = ground.places;
    let top = places.values().map(|place| place.y).fold(f64::MAX, f64::min);
    let y = if places.is_empty() { 0.0 } else { top };
    let row = places.values().filter(|place| (place.y - y).abs() < STREAM_HEIGHT);
    let right = row.map(|place| place.x).fold(f64::MIN, f64::max);
    let x = if places.is_empty() { 0.0 } else { right + SENSOR_STEP };
    let size = SpotSize::of(ground.sizes, stream, std::iter::empty());
    beside(&taken(ground), snapped(Place { x, y }), size, SpotSide::Nearest)
}

/// The wanted spot, else the nearest free one to its sides, else one lower.
fn beside(taken: &[TakenSpace], wanted: Place, size: SpotSize, side: SpotSide) -> Place {
    let is_free = |place: &Place| {
        let rooms = TakenSpace::of(*place, size);
        taken.iter().all(|other| rooms.iter().all(|room| !room.meets(other)))
    };
    let levels = (0..4).flat_map(|level| side.steps(SIDE_STEPS).map(move |step| (step, f64::from(level))));
    let mut spots = levels.map(|(step, level)| Place { x: wanted.x + step * STEP, y: wanted.y + level * LEVEL });
    spots.find(is_free).unwrap_or(wanted)
}

fn taken(Ground { behaviour, places, sizes }: Ground) -> Vec<TakenSpace> {
    let graph = Graph::of(behaviour);
    let rooms = behaviour.streams().filter_map(|(id, stream)| {
        let into = graph.into_stream(id);
        let size = SpotSize::of(sizes, stream, into.iter().map(|(_, connector)| *connector));
        Some(TakenSpace::of(*places.get(id)?, size))
    });
    rooms.flatten().collect()
}

/// Places for streams that nobody placed: a whole layout if nobody placed any, else a free spot for each.
#[must_use]
pub fn missing_places(
    behaviour: &Behaviour,
    sizes: DrawnSizes,
    (tidy, stage): (Option<Tidy>, (f64, f64)),
) -> BTreeMap<Id, Place> {
    let mut places: BTreeMap<Id, Place> =
        behaviour.streams().filter_map(|(id, _)| Some((id.clone(), behaviour.place(id)?))).filled();
    if places.is_empty() {
        return tidy.map_or_else(|| in_rows(behaviour), |tidy| tidy(behaviour, stage));
    }
    let graph = Graph::of(behaviour);
    let mut missing = BTreeMap::new();
    for (id, stream) in behaviour.streams_in_order() {
        if places.contains_key(id) {
            continue;
        }
        let ground = Ground { behaviour, places: &places, sizes };
        let place = match graph.into_stream(id).first() {
            Some((_, connector)) => free_spot(ground, stream, connector),
            None => free_sensor_spot(ground, stream),
        };
        places.insert(id.clone(), place);
        missing.insert(id.clone(), place);
    }
    missing
}

/// Every stream in rows, in their order: seen for a moment only.
fn in_rows(behaviour: &Behaviour) -> BTreeMap<Id, Place> {
    let apart = WIDTH_MAX + GAP;
    let at = |number: usize| Place { x: (number % IN_A_ROW) as f64 * apart, y: (number / IN_A_ROW) as f64 * LEVEL };
    behaviour.streams_in_order().into_iter().enumerate().map(|(number, (id, _))| (id.clone(), at(number))).filled()
}

#[cfg(test)]
mod tests {
    use super::{Ground, free_sensor_spot, free_spot, missing_places};
    use crate::layout::tests::SIZES;
    use crate::layout::{LEVEL, Tidy};
    use behaviour::{
        Behaviour, Connector, Id, Kind, Place, Procedure, Record, RecordId, Stream, StreamKind, connectors,
    };
    use std::collections::BTreeMap;

    fn ground<'a>(behaviour: &'a Behaviour, places: &'a BTreeMap<Id, Place>) -> Ground<'a> {
        Ground { behaviour, places, sizes: SIZES }
    }

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn stream(kind: StreamKind, name: &str) -> Stream {
        let params = behaviour::Params::new();
        Stream {
            kind,
            name: name.into(),
            device: None,
            params,
            order: 0,
            resources: None,
            priority: None,
            hold_ms: None,
        }
    }

    fn connector(input: &str, output: &str) -> Connector {
        let operation = connectors::filter::SPEC.with(Procedure::body("distanceToBall < 20"));
        Connector { operation, inputs: vec![id(input)], output: id(output), order: 0 }
    }

    #[test]
    fn a_new_stream_appears_under_its_source_and_its_siblings_beside_it() {
        let mut behaviour = Behaviour::default();
        let mut places = BTreeMap::new();
        behaviour
            .records
            .insert(RecordId::new(Kind::Stream, &id("s")), Record::Stream(stream(StreamKind::Sensor, "RedBall")));
        places.insert(id("s"), Place { x: 0.0, y: 0.0 });
        let mut spots = Vec::new();
        for name in ["a", "b", "c"] {
            let child = stream(StreamKind::Ordinary, "Close balls");
            let spot = free_spot(ground(&behaviour, &places), &child, &connector("s", name));
            behaviour.records.insert(RecordId::new(Kind::Stream, &id(name)), Record::Stream(child));
            behaviour
                .records
                .insert(RecordId::new(Kind::Connector, &id(name)), Record::Connector(connector("s", name)));
            places.insert(id(name), spot);
            spots.push(spot);
        }
        assert_eq!(spots[0], Place { x: 0.0, y: LEVEL });
        assert!(
            spots[1].x > 200.0 && spots[2].x > spots[1].x + 200.0,
            "in the order in which they were made: {spots:?}"
        );
        assert!(spots.iter().all(|spot| spot.y == LEVEL));
    }

    #[test]
    fn a_branch_that_finds_no_room_behind_its_siblings_stands_where_there_is_some() {
        let mut behaviour = Behaviour::default();
        let mut places = BTreeMap::new();
        let mut put = |name: &str, kind, x: f64, y: f64| {
            behaviour.records.insert(RecordId::new(Kind::Stream, &id(name)), Record::Stream(stream(kind, name)));
            places.insert(id(name), Place { x, y });
        };
        put("s", StreamKind::Sensor, 0.0, 0.0);
        put("a", StreamKind::Ordinary, 0.0, LEVEL);
        for at in 1..=5 {
            put(&format!("other{at}"), StreamKind::Ordinary, f64::from(at) * 320.0, LEVEL);
        }
        behaviour.records.insert(RecordId::new(Kind::Connector, &id("a")), Record::Connector(connector("s", "a")));
        let spot = free_spot(ground(&behaviour, &places), &stream(StreamKind::Ordinary, "b"), &connector("s", "b"));
        assert!(spot.x < -150.0 && spot.x > -500.0 && spot.y == LEVEL, "{spot:?}");
    }

    #[test]
    fn a_new_action_stands_in_the_row_of_the_actions_where_there_is_room() {
        let mut behaviour = Behaviour::default();
        let put = |behaviour: &mut Behaviour, name: &str, kind| {
            behaviour.records.insert(RecordId::new(Kind::Stream, &id(name)), Record::Stream(stream(kind, name)));
        };
        put(&mut behaviour, "s", StreamKind::Sensor);
        put(&mut behaviour, "mid", StreamKind::Ordinary);
        put(&mut behaviour, "act", StreamKind::Actuator);
        let mut places = BTreeMap::from([
            (id("s"), Place { x: 0.0, y: 0.0 }),
            (id("mid"), Place { x: 0.0, y: LEVEL }),
            (id("act"), Place { x: 0.0, y: 2.0 * LEVEL }),
        ]);
        let action = stream(StreamKind::Actuator, "Say");
        let spot = free_spot(ground(&behaviour, &places), &action, &connector("s", "new"));
        assert!(spot.y == 2.0 * LEVEL && spot.x.abs() > 150.0, "{spot:?}");
        let under = free_spot(ground(&behaviour, &places), &action, &connector("act", "new"));
        assert_eq!(under.y, 3.0 * LEVEL, "below what it comes from in any case");
        places.insert(id("act"), Place { x: 0.0, y: 9.0 * LEVEL });
        assert_eq!(free_spot(ground(&behaviour, &places), &action, &connector("s", "new")).y, LEVEL, "not out of view");
    }

    #[test]
    fn sensors_stand_in_a_row() {
        let mut behaviour = Behaviour::default();
        let sensor = stream(StreamKind::Sensor, "RedBall");
        let first = free_sensor_spot(ground(&behaviour, &BTreeMap::new()), &sensor);
        behaviour.records.insert(RecordId::new(Kind::Stream, &id("s")), Record::Stream(sensor.clone()));
        let second = free_sensor_spot(ground(&behaviour, &BTreeMap::from([(id("s"), first)])), &sensor);
        assert!(second.y == first.y && second.x - first.x > (SIZES.stream)(&sensor));
    }

    #[test]
    fn what_nobody_placed_gets_a_place() {
        let mut behaviour = Behaviour::default();
        for name in ["a", "b"] {
            behaviour
                .records
                .insert(RecordId::new(Kind::Stream, &id(name)), Record::Stream(stream(StreamKind::Sensor, name)));
        }
        for tidy in [None, Some((|behaviour, stage| crate::layout::tidy(behaviour, SIZES, stage)) as Tidy)] {
            let places = missing_places(&behaviour, SIZES, (tidy, (860.0, 560.0)));
            assert!(places.len() == 2 && places[&id("a")] != places[&id("b")]);
        }
        let place = Record::Place(Place { x: 5.0, y: 5.0 });
        behaviour.records.insert(RecordId::new(Kind::Place, &id("a")), place);
        assert_eq!(missing_places(&behaviour, SIZES, (None, (860.0, 560.0))).keys().collect::<Vec<_>>(), [&id("b")]);
    }
}
