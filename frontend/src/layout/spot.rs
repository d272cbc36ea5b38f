//! A free spot for a new stream: below its sources, beside nothing.

use super::{CHIP_HEIGHT, GAP, LEVEL, STREAM_HEIGHT, VALUE_ROOM, chip_width, chip_words, snapped, stream_width};
use behaviour::{Behaviour, Connector, Filled, Graph, Id, Place, Stream};
use std::collections::BTreeMap;

/// How many spots are tried to the sides before the next level is.
const SIDE_STEPS: i32 = 24;
/// From the middle of one sensor to the middle of the next, at least.
const SENSOR_STEP: f64 = 340.0;

/// Room that something takes.
#[derive(Clone, Copy, Debug)]
struct Room {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

impl Room {
    /// A stream with its live value, and the chips that lead to it.
    fn of(place: Place, size: Size) -> [Self; 2] {
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

    fn meets(&self, other: &Room) -> bool {
        let apart = self.right + GAP <= other.left
            || other.right + GAP <= self.left
            || self.bottom + 20.0 <= other.top
            || other.bottom + 20.0 <= self.top;
        !apart
    }
}

/// How wide a stream is, and the widest of the chips that lead to it (0 without any).
#[derive(Clone, Copy, Debug)]
struct Size {
    stream: f64,
    chip: f64,
}

impl Size {
    fn of<'a>(stream: &Stream, into: impl Iterator<Item = &'a Connector>) -> Self {
        let chip = into.map(|connector| chip_width(&chip_words(connector))).fold(0.0, f64::max);
        Self { stream: stream_width(stream), chip }
    }
}

/// How much room a stream needs around its middle, with its live value and the chips that lead to it.
pub(super) fn whole_width<'a>(stream: &Stream, into: impl Iterator<Item = &'a Connector>) -> f64 {
    let size = Size::of(stream, into);
    f64::max(size.stream + VALUE_ROOM, size.chip)
}

/// Where a new stream goes that takes from `inputs` through `connector`.
pub(crate) fn free_spot(
    behaviour: &Behaviour,
    places: &BTreeMap<Id, Place>,
    stream: &Stream,
    connector: &Connector,
) -> Place {
    let sources: Vec<Place> = connector.inputs.iter().filter_map(|id| places.get(id).copied()).collect();
    if sources.is_empty() {
        return free_sensor_spot(behaviour, places, stream);
    }
    let x = sources.iter().map(|place| place.x).sum::<f64>() / sources.len() as f64;
    let y = sources.iter().map(|place| place.y).fold(f64::MIN, f64::max) + LEVEL;
    let size = Size::of(stream, std::iter::once(connector));
    beside(&taken(behaviour, places), snapped(Place { x, y }), size)
}

/// Where a new sensor goes: in the top row, to the right of the others.
pub(crate) fn free_sensor_spot(behaviour: &Behaviour, places: &BTreeMap<Id, Place>, stream: &Stream) -> Place {
    let top = places.values().map(|place| place.y).fold(f64::MAX, f64::min);
    let y = if places.is_empty() { 0.0 } else { top };
    let row = places.values().filter(|place| (place.y - y).abs() < STREAM_HEIGHT);
    let right = row.map(|place| place.x).fold(f64::MIN, f64::max);
    let x = if places.is_empty() { 0.0 } else { right + SENSOR_STEP };
    beside(&taken(behaviour, places), snapped(Place { x, y }), Size::of(stream, std::iter::empty()))
}

/// The wanted spot, else the nearest free one to its sides, else one lower.
fn beside(taken: &[Room], wanted: Place, size: Size) -> Place {
    let is_free = |place: &Place| {
        let rooms = Room::of(*place, size);
        taken.iter().all(|other| rooms.iter().all(|room| !room.meets(other)))
    };
    let levels = (0..4).flat_map(|level| {
        let steps = (0..SIDE_STEPS).flat_map(move |step| {
            if step == 0 { vec![0.0] } else { vec![1.0, -1.0] }.into_iter().map(move |side| side * f64::from(step))
        });
        steps.map(move |step| (step, f64::from(level)))
    });
    let spots = levels.map(|(step, level)| Place { x: wanted.x + step * 60.0, y: wanted.y + level * LEVEL });
    spots.into_iter().find(is_free).unwrap_or(wanted)
}

fn taken(behaviour: &Behaviour, places: &BTreeMap<Id, Place>) -> Vec<Room> {
    let graph = Graph::of(behaviour);
    let rooms = behaviour.streams().filter_map(|(id, stream)| {
        let into = graph.into_stream(id);
        let size = Size::of(stream, into.iter().map(|(_, connector)| *connector));
        Some(Room::of(*places.get(id)?, size))
    });
    rooms.flatten().collect()
}

/// Places for streams that nobody placed: a whole layout if nobody placed any, else a free spot for each.
pub(crate) fn missing_places(behaviour: &Behaviour) -> BTreeMap<Id, Place> {
    let mut places: BTreeMap<Id, Place> =
        behaviour.streams().filter_map(|(id, _)| Some((id.clone(), behaviour.place(id)?))).filled();
    if places.is_empty() {
        return super::tidy(behaviour);
    }
    let graph = Graph::of(behaviour);
    let mut missing = BTreeMap::new();
    for (id, stream) in behaviour.streams_in_order() {
        if places.contains_key(id) {
            continue;
        }
        let place = match graph.into_stream(id).first() {
            Some((_, connector)) => free_spot(behaviour, &places, stream, connector),
            None => free_sensor_spot(behaviour, &places, stream),
        };
        places.insert(id.clone(), place);
        missing.insert(id.clone(), place);
    }
    missing
}

#[cfg(test)]
mod tests {
    use super::{free_sensor_spot, free_spot, missing_places};
    use crate::layout::{LEVEL, stream_width};
    use behaviour::{
        Behaviour, Connector, Id, Kind, Place, Procedure, Record, RecordId, Stream, StreamKind, connectors,
    };
    use std::collections::BTreeMap;

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
            let spot = free_spot(&behaviour, &places, &child, &connector("s", name));
            behaviour.records.insert(RecordId::new(Kind::Stream, &id(name)), Record::Stream(child));
            behaviour
                .records
                .insert(RecordId::new(Kind::Connector, &id(name)), Record::Connector(connector("s", name)));
            places.insert(id(name), spot);
            spots.push(spot);
        }
        assert_eq!(spots[0], Place { x: 0.0, y: LEVEL });
        assert!(spots[1].x > 200.0 && spots[2].x < -200.0, "{spots:?}");
        assert!(spots.iter().all(|spot| spot.y == LEVEL));
    }

    #[test]
    fn sensors_stand_in_a_row() {
        let mut behaviour = Behaviour::default();
        let sensor = stream(StreamKind::Sensor, "RedBall");
        let first = free_sensor_spot(&behaviour, &BTreeMap::new(), &sensor);
        behaviour.records.insert(RecordId::new(Kind::Stream, &id("s")), Record::Stream(sensor.clone()));
        let second = free_sensor_spot(&behaviour, &BTreeMap::from([(id("s"), first)]), &sensor);
        assert!(second.y == first.y && second.x - first.x > stream_width(&sensor));
    }

    #[test]
    fn what_nobody_placed_gets_a_place() {
        let mut behaviour = Behaviour::default();
        for name in ["a", "b"] {
            behaviour
                .records
                .insert(RecordId::new(Kind::Stream, &id(name)), Record::Stream(stream(StreamKind::Sensor, name)));
        }
        assert_eq!(missing_places(&behaviour).len(), 2);
        let place = Record::Place(Place { x: 5.0, y: 5.0 });
        behaviour.records.insert(RecordId::new(Kind::Place, &id("a")), place);
        assert_eq!(missing_places(&behaviour).keys().collect::<Vec<_>>(), [&id("b")]);
    }
}
