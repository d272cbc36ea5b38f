//! The gestures of people in the simulations, to few records so that they meet, and whether a graph keeps the rules.

use crate::plan::Dice;
use behaviour::{
    Behaviour, Change, Connector, Graph, Id, Kind, Note, Pad, Params, Place, Procedure, Record, RecordId, Settings,
    Stream, StreamKind, Tile, TileAction, Value, connectors,
};

const STREAMS: u64 = 6;
const CONNECTORS: u64 = 4;
const NOTES: u64 = 3;

pub(crate) fn id(text: &str) -> Id {
    Id::new(text).expect("a short id")
}

fn key(kind: Kind, letter: char, number: u64) -> RecordId {
    RecordId::new(kind, &id(&format!("{letter}{number}")))
}

/// A behaviour with a name and nothing else.
pub(crate) fn start() -> Behaviour {
    let mut behaviour = Behaviour::default();
    behaviour.records.insert(RecordId::settings(), Record::Settings(Settings::named("Town")));
    behaviour
}

/// A record that can be locked.
pub(crate) fn record(number: u64) -> RecordId {
    match number % (STREAMS + CONNECTORS + NOTES) {
        stream @ 0..STREAMS => key(Kind::Stream, 's', stream),
        other if other < STREAMS + CONNECTORS => key(Kind::Connector, 'c', other - STREAMS),
        note => key(Kind::Note, 'n', note - STREAMS - CONNECTORS),
    }
}

/// Edits what somebody sees; where that is nothing, writes a note.
pub(crate) fn gesture(change: Change, seen: &Behaviour, number: u64) -> Change {
    let mut dice = Dice(number);
    let change = graph_gesture(change, seen, &mut dice);
    if !change.edits.is_empty() {
        return change;
    }
    let change = change.put(seen, key(Kind::Note, 'n', dice.roll(NOTES)), note(&mut dice));
    change.put(seen, key(Kind::Note, 'n', dice.roll(NOTES)), note(&mut dice))
}

fn graph_gesture(change: Change, seen: &Behaviour, dice: &mut Dice) -> Change {
    let some = key(Kind::Stream, 's', dice.roll(STREAMS));
    match dice.roll(12) {
        0..=3 => change.put(seen, some, stream(dice)),
        4 => with_all_of_it(change, seen, some),
        5 => change.put(seen, key(Kind::Place, 's', dice.roll(STREAMS)), place(dice)),
        6..=8 => match connector(seen, dice) {
            Some(connector) => change.put(seen, key(Kind::Connector, 'c', dice.roll(CONNECTORS)), connector),
            None => change,
        },
        9 => change.take(seen, key(Kind::Connector, 'c', dice.roll(CONNECTORS))),
        10 if dice.roll(2) == 0 => change.put(seen, RecordId::pad(), pad(dice)),
        10 => change.take(seen, key(Kind::Note, 'n', dice.roll(NOTES))),
        _ => change,
    }
}

/// A stream goes with its connectors and its place.
fn with_all_of_it(change: Change, seen: &Behaviour, stream: RecordId) -> Change {
    let ends = seen.connectors().filter(|(_, one)| one.output == stream.id || one.inputs.contains(&stream.id));
    let change = ends.fold(change, |made, (id, _)| made.take(seen, RecordId::new(Kind::Connector, id)));
    change.take(seen, RecordId::new(Kind::Place, &stream.id)).take(seen, stream)
}

fn stream(dice: &mut Dice) -> Record {
    let kind = [StreamKind::Sensor, StreamKind::Ordinary, StreamKind::Ordinary, StreamKind::Actuator];
    let (kind, name) = (kind[dice.roll(4) as usize], format!("N{}", dice.roll(40)));
    let device = (kind != StreamKind::Ordinary).then(|| "RedBall".to_owned());
    let (params, resources, priority, hold_ms) = (Params::new(), None, None, None);
    Record::Stream(Stream { kind, name, device, params, order: 0, resources, priority, hold_ms })
}

/// A connector between two streams, one of which may be gone meanwhile; often one that the rules do not allow.
fn connector(seen: &Behaviour, dice: &mut Dice) -> Option<Record> {
    let streams: Vec<(&Id, StreamKind)> = seen.streams().map(|(id, stream)| (id, stream.kind)).collect();
    let many = streams.len() as u64;
    let (input, output) = (dice.roll(many.max(1)) as usize, dice.roll(many.max(1)) as usize);
    let ((input, _), (output, kind)) = (*streams.get(input)?, *streams.get(output)?);
    let operation = match kind {
        StreamKind::Actuator => connectors::subscribe::SPEC.with(()),
        StreamKind::Sensor | StreamKind::Ordinary => connectors::map::SPEC.with(Procedure::body("1")),
    };
    let (inputs, output) = (vec![input.clone()], output.clone());
    Some(Record::Connector(Connector { operation, inputs, output, order: 0 }))
}

fn place(dice: &mut Dice) -> Record {
    Record::Place(Place { x: dice.roll(9) as f64, y: 0.0 })
}

/// A pad with a tile for a stream that may be gone, or no sense.
fn pad(dice: &mut Dice) -> Record {
    let stream = key(Kind::Stream, 's', dice.roll(STREAMS)).id;
    let does = TileAction::Pretend { stream, value: Value::Int(dice.roll(9) as i64) };
    let key = 1 + dice.roll(9) as u8;
    Record::Pad(Pad { tiles: [(key, Tile { label: "Press".to_owned(), does, asks: false })].into() })
}

fn note(dice: &mut Dice) -> Record {
    Record::Note(Note::new(dice.roll(1 << 30).to_string()))
}

/// Checks that the graph keeps the rules, in another way than the room does.
pub(crate) fn check_rules(behaviour: &Behaviour) -> Result<(), String> {
    let graph = Graph::of(behaviour);
    let mut is_right = graph.cycle().is_none();
    for (id, stream) in behaviour.streams() {
        is_right &= match stream.kind {
            StreamKind::Sensor => graph.into_stream(id).is_empty(),
            StreamKind::Ordinary => graph.into_stream(id).len() <= 1,
            StreamKind::Actuator => graph.out_of_stream(id).is_empty(),
        };
    }
    for (_, connector) in behaviour.connectors() {
        is_right &= behaviour.stream(&connector.output).is_some();
        is_right &= connector.inputs.iter().all(|input| behaviour.stream(input).is_some());
    }
    if is_right { Ok(()) } else { Err(format!("a graph that breaks the rules: {behaviour:?}")) }
}
