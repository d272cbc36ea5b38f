//! What was read of a sentence, as a part of a graph in a free place. Pure.

use crate::desk::{Ghost, GhostConnector, GhostStream};
use crate::layout::{self, GAP, LEVEL, STREAM_HEIGHT, snapped, stream_width};
use behaviour::{Behaviour, Connector, FillFrom, Id, Kind, Place, Record, RecordId, Stream};
use protocol::CanvasArea;
use sentences::{Draft, DraftStream};
use std::collections::BTreeMap;

/// How far a place is tried beside the last one, in canvas units, and how often to each side and downwards.
const STEP: (f64, f64) = (60.0, 70.0);
const TRIES: (i32, i32) = (60, 30);
/// What a place outside of what is seen costs, in canvas units of distance.
const UNSEEN: f64 = 4_000.0;
/// Room left to everything else, and to the edge of what is seen.
const ROOM: f64 = 30.0;
/// What of the room for live values stays free beside a stream.
const BESIDE: f64 = 60.0;
/// What of the top of the stage is covered while a sentence is typed.
const COVERED: f64 = 216.0;

#[derive(Clone, Copy, Debug)]
struct Box {
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
}

impl Box {
    fn of(stream: &Stream, place: Place) -> Self {
        let half = stream_width(stream) / 2.0;
        Self { left: place.x - half, top: place.y, right: place.x + half + BESIDE, bottom: place.y + STREAM_HEIGHT }
    }

    fn moved(self, x: f64, y: f64) -> Self {
        Self { left: self.left + x, right: self.right + x, top: self.top + y, bottom: self.bottom + y }
    }

    fn meets(&self, other: &Self) -> bool {
        self.left < other.right + ROOM
            && other.left < self.right + ROOM
            && self.top < other.bottom + ROOM
            && other.top < self.bottom + ROOM
    }

    fn around(all: impl Iterator<Item = Self>) -> Option<Self> {
        all.reduce(|one, other| Self {
            left: one.left.min(other.left),
            top: one.top.min(other.top),
            right: one.right.max(other.right),
            bottom: one.bottom.max(other.bottom),
        })
    }
}

/// A draft as a part of a graph. What is new stands together in a free place: near what it takes from, else in view.
pub(super) fn ghost(
    draft: &Draft,
    behaviour: &Behaviour,
    places: &BTreeMap<Id, Place>,
    view: Option<CanvasArea>,
) -> Ghost {
    let ids: Vec<Id> = (0..).zip(&draft.streams).filter_map(|(at, stream)| id_of(at, stream)).collect();
    if ids.len() != draft.streams.len() {
        return Ghost::default();
    }
    let connectors: Vec<(Connector, bool)> = (0..)
        .zip(&draft.connectors)
        .filter_map(|(order, connector)| {
            let inputs = connector.inputs.iter().map(|at| ids.get(*at).cloned()).collect::<Option<Vec<_>>>()?;
            let output = ids.get(connector.output)?.clone();
            let made = Connector { operation: connector.operation.clone(), inputs, output, order };
            Some((made, connector.doubtful))
        })
        .collect();
    let new: Vec<(&Id, Stream, bool)> = (0..)
        .zip(ids.iter().zip(&draft.streams))
        .filter(|(_, (_, stream))| stream.existing.is_none())
        .map(|(order, (id, stream))| (id, stream_of(stream, order), stream.doubtful))
        .collect();
    let local = local_places(&new, &connectors);
    let own = Box::around(new.iter().filter_map(|(id, stream, _)| Some(Box::of(stream, *local.get(*id)?))));
    let Some(own) = own else { return Ghost::default() };
    let taken = behaviour.streams().filter_map(|(id, stream)| Some(Box::of(stream, *places.get(id)?)));
    let taken: Vec<Box> = taken.collect();
    let source = connectors.iter().flat_map(|(connector, _)| &connector.inputs).find_map(|id| places.get(id));
    let (x, y) = free_shift(own, &taken, source.copied(), view);
    let place = |id: &Id| {
        let place = local.get(id).copied().unwrap_or(Place { x: 0.0, y: 0.0 });
        snapped(Place { x: place.x + x, y: place.y + y })
    };
    Ghost {
        streams: new
            .iter()
            .map(|(id, stream, doubtful)| GhostStream {
                id: (*id).clone(),
                stream: stream.clone(),
                place: place(id),
                doubtful: *doubtful,
            })
            .collect(),
        connectors: connectors
            .into_iter()
            .map(|(connector, doubtful)| GhostConnector { connector, doubtful })
            .collect(),
    }
}

fn id_of(at: usize, stream: &DraftStream) -> Option<Id> {
    stream.existing.clone().or_else(|| Id::new(&format!("draft-{at}")).ok())
}

fn stream_of(stream: &DraftStream, order: i64) -> Stream {
    let (resources, priority, hold_ms) = (None, None, None);
    let (name, device, params) = (stream.name.clone(), stream.device.clone(), stream.params.clone());
    Stream { kind: stream.kind, name, device, params, order, resources, priority, hold_ms }
}

/// Where the new streams stand to each other.
fn local_places(new: &[(&Id, Stream, bool)], connectors: &[(Connector, bool)]) -> BTreeMap<Id, Place> {
    let mut alone = Behaviour::default();
    for (id, stream, _) in new {
        alone.records.insert(RecordId::new(Kind::Stream, id), Record::Stream(stream.clone()));
    }
    let is_new = |id: &Id| new.iter().any(|(other, ..)| *other == id);
    for (at, (connector, _)) in connectors.iter().enumerate() {
        let inputs: Vec<Id> = connector.inputs.iter().filter(|id| is_new(id)).cloned().collect();
        if let Ok(id) = Id::new(&format!("draft-c{at}"))
            && !inputs.is_empty()
            && is_new(&connector.output)
        {
            let connector = Connector { inputs, ..connector.clone() };
            alone.records.insert(RecordId::new(Kind::Connector, &id), Record::Connector(connector));
        }
    }
    layout::tidy(&alone, (f64::MAX, f64::MAX)).into_iter().collect::<Vec<_>>().into_iter().filled()
}

/// How far the part moves to a free place: the nearest to where it is wanted, seen if that is possible.
fn free_shift(own: Box, taken: &[Box], source: Option<Place>, view: Option<CanvasArea>) -> (f64, f64) {
    let middle = (own.left + own.right - BESIDE) / 2.0;
    let bottom = taken.iter().map(|other| other.bottom).fold(0.0, f64::max);
    let wanted = match (source, view) {
        (Some(source), _) => (source.x, source.y + LEVEL),
        (None, Some(view)) => (view.x + view.width / 2.0, view.y + COVERED + GAP),
        (None, None) => (0.0, if taken.is_empty() { 0.0 } else { bottom + LEVEL }),
    };
    let shift = |across: i32, down: i32| {
        let (x, y) = (f64::from(across) * STEP.0, f64::from(down) * STEP.1);
        (wanted.0 - middle + x, wanted.1 - own.top + y)
    };
    let seen = |at: &Box| {
        view.is_none_or(|view| {
            at.left >= view.x + ROOM
                && at.top >= view.y + COVERED
                && at.right <= view.x + view.width
                && at.bottom <= view.y + view.height - ROOM
        })
    };
    let cost = |(across, down): (i32, i32)| {
        let (x, y) = shift(across, down);
        let at = own.moved(x, y);
        if taken.iter().any(|other| other.meets(&at)) {
            return None;
        }
        let far = f64::from(across.abs()) * STEP.0 + f64::from(down) * STEP.1 * 2.0;
        Some((if seen(&at) { far } else { far + UNSEEN }, (x, y)))
    };
    let tries = (0..=TRIES.1).flat_map(|down| (-TRIES.0..=TRIES.0).map(move |across| (across, down)));
    let best = tries.filter_map(cost).min_by(|(one, _), (other, _)| one.total_cmp(other));
    best.map_or_else(|| (wanted.0 - middle, bottom + LEVEL - own.top), |(_, shift)| shift)
}

#[cfg(test)]
mod tests {
    use super::ghost;
    use behaviour::{Behaviour, Id, Kind, Params, Place, Record, RecordId, Stream, StreamKind};
    use protocol::CanvasArea;
    use sentences::{Language, read};
    use std::collections::BTreeMap;

    const VIEW: CanvasArea = CanvasArea { x: 0.0, y: 0.0, width: 1_400.0, height: 900.0 };

    fn with_ball() -> (Behaviour, BTreeMap<Id, Place>, Id) {
        let id = Id::new("ball").unwrap();
        let ball = Stream {
            kind: StreamKind::Sensor,
            name: "Ball".into(),
            device: Some("RedBall".into()),
            params: Params::new(),
            order: 0,
            resources: None,
            priority: None,
            hold_ms: None,
        };
        let mut behaviour = Behaviour::default();
        behaviour.records.insert(RecordId::new(Kind::Stream, &id), Record::Stream(ball));
        (behaviour, [(id.clone(), Place { x: 700.0, y: 220.0 })].into(), id)
    }

    #[test]
    fn a_sentence_stands_in_view_and_over_nothing() {
        let (behaviour, places, _) = with_ball();
        let reading = read("When the head is touched, the eyes turn green.", Language::English, &[], Some(&behaviour));
        let made = ghost(&reading.draft, &behaviour, &places, Some(VIEW));
        assert!(made.streams.len() >= 2 && !made.connectors.is_empty());
        for stream in &made.streams {
            let Place { x, y } = stream.place;
            assert!((100.0..1_300.0).contains(&x) && (200.0..860.0).contains(&y), "{:?}", stream.place);
            assert!((x - 700.0).abs() > 150.0 || (y - 220.0).abs() > 80.0, "{:?}", stream.place);
        }
    }

    #[test]
    fn nothing_is_drawn_of_nothing() {
        assert_eq!(ghost(&sentences::Draft::default(), &Behaviour::default(), &BTreeMap::new(), None).streams, []);
    }
}
