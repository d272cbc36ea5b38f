//! Makes lanes that can be drawn of what the server tells.

use super::PastShared;
use crate::live::{measured, unit};
use crate::past::words;
use behaviour::{Id, StreamKind, Value, ValueType};
use lanes::{Dot, DotSpan, LaneFilling, LaneKind, LaneMark, LaneShape, RANGE_EMPTY, ShownLane};
use leptos::prelude::*;
use protocol::{LaneName, LaneValue, LaneValues, OpenedPast, PastStream, RecordingMark};

/// The lanes that are shown at first, at most.
const FIRST_LANES: usize = 10;
/// Up to so many values a lane shows each of them at first.
const MARBLES: u64 = 600;
/// The fields that tell most of a sense, best first.
const TELLING: [&str; 5] = ["distance", "size", "x", "position.x", "value"];

/// The key of a lane: the id of its stream, and its field behind a blank, which no id has.
pub(super) fn key(name: &LaneName) -> String {
    match &name.field {
        Some(field) => format!("{} {field}", name.stream),
        None => name.stream.clone(),
    }
}

/// The lane that a key is of.
pub(super) fn name(key: &str) -> LaneName {
    match key.split_once(' ') {
        Some((stream, field)) => LaneName { stream: stream.to_owned(), field: Some(field.to_owned()) },
        None => LaneName { stream: key.to_owned(), field: None },
    }
}

/// The lanes that are shown at first: all senses with the field that tells most, what is computed, and all actions.
pub(super) fn first_lanes(opened: &OpenedPast) -> Vec<LaneName> {
    let used = |kind: StreamKind| opened.streams.iter().filter(move |one| one.kind == kind && one.count > 0);
    let plain = |one: &PastStream| LaneName { stream: one.stream.clone(), field: None };
    let mut names = Vec::new();
    for sense in used(StreamKind::Sensor) {
        names.push(plain(sense));
        names.extend(telling(sense).map(|field| LaneName { field: Some(field), ..plain(sense) }));
    }
    // Actions are what everything is about: they have room whatever the senses are.
    let actions: Vec<LaneName> = used(StreamKind::Actuator).map(plain).collect();
    names.truncate(FIRST_LANES.saturating_sub(actions.len().min(FIRST_LANES / 2)));
    let room = FIRST_LANES.saturating_sub(names.len() + actions.len());
    names.extend(used(StreamKind::Ordinary).map(plain).take(room));
    names.extend(actions);
    names.truncate(FIRST_LANES);
    names
}

/// The field of a stream's values that tells most, if they have number fields.
pub(super) fn telling(stream: &PastStream) -> Option<String> {
    let telling = TELLING.iter().find_map(|wanted| stream.fields.iter().find(|field| field == wanted));
    telling.or(stream.fields.first()).cloned()
}

/// All lanes that there can be, in the order of the program.
pub(super) fn all_lanes(opened: &OpenedPast) -> Vec<LaneName> {
    let of = |one: &PastStream| {
        let plain = LaneName { stream: one.stream.clone(), field: None };
        let fields = one.fields.iter().map(|field| LaneName { stream: one.stream.clone(), field: Some(field.clone()) });
        std::iter::once(plain).chain(fields.collect::<Vec<_>>()).collect::<Vec<_>>()
    };
    opened.streams.iter().filter(|one| one.count > 0).flat_map(of).collect()
}

/// A lane without values yet.
pub(super) fn lane(opened: &OpenedPast, name: &LaneName) -> Option<ShownLane> {
    let stream = stream(opened, name)?;
    let kind = match stream.kind {
        StreamKind::Sensor => LaneKind::Sense,
        StreamKind::Ordinary => LaneKind::Stream,
        StreamKind::Actuator => LaneKind::Action,
    };
    let shape = match kind {
        _ if name.field.is_some() => LaneShape::Plot,
        LaneKind::Action => LaneShape::Marbles,
        LaneKind::Sense if stream.count > MARBLES && !stream.numbers => LaneShape::Bars,
        LaneKind::Sense | LaneKind::Stream if stream.numbers => LaneShape::Plot,
        LaneKind::Sense | LaneKind::Stream if stream.count > MARBLES => LaneShape::Bars,
        LaneKind::Sense if !stream.fields.is_empty() => LaneShape::Bars,
        LaneKind::Sense | LaneKind::Stream => LaneShape::Marbles,
    };
    Some(ShownLane::new(key(name), kind, shape))
}

/// The stream of a lane.
pub(super) fn stream<'a>(opened: &'a OpenedPast, name: &LaneName) -> Option<&'a PastStream> {
    opened.streams.iter().find(|one| one.stream == name.stream)
}

/// The name of a lane: that of its stream, and its field.
pub(super) fn label(opened: &OpenedPast, name: &LaneName) -> String {
    let stream = stream(opened, name).map_or_else(|| name.stream.clone(), |stream| stream.name.clone());
    name.field.as_ref().map_or(stream.clone(), |field| format!("{stream} · {field}"))
}

/// The kind of values of a lane, as far as the open program knows it.
pub(super) fn kind_of(past: PastShared, name: &LaneName) -> Option<ValueType> {
    let id = Id::new(&name.stream).ok()?;
    let mut kind = past.desk.desk().document.types.with_untracked(|types| types.get(&id).cloned())?;
    for part in name.field.iter().flat_map(|field| field.split('.')) {
        let ValueType::Record(mut fields) = kind else { return None };
        kind = fields.remove(part)?;
    }
    Some(kind)
}

/// A number of a lane with its unit.
pub(super) fn number_words(number: f64, kind: Option<&ValueType>) -> String {
    let text = crate::live::short_value(&Value::Float(number));
    kind.map_or(text.clone(), |kind| words::with_unit(text, unit(kind)))
}

/// The values of a lane between two moments, of which the server made so many columns. What came at `began` is at 0.
pub(super) fn filling(
    values: &LaneValues,
    (from, to): (f64, f64),
    (columns, began): (usize, f64),
    kind: Option<&ValueType>,
) -> LaneFilling {
    match values {
        LaneValues::Each(values) => LaneFilling::Values(values.iter().map(|value| dot(value, began, kind)).collect()),
        LaneValues::Columns(all) => {
            let width = (to - from) / columns.max(1) as f64;
            let span = |column: &protocol::LaneColumn| {
                let t = from + f64::from(column.at) * width;
                let numbers = column.numbers.map(|numbers| numbers.map(f64::from));
                DotSpan {
                    t,
                    until: t + width,
                    count: u64::from(column.count),
                    range: numbers.map_or(RANGE_EMPTY, |[least, most, ..]| (least, most)),
                    ends: numbers.map_or((f64::NAN, f64::NAN), |[_, _, first, last]| (first, last)),
                }
            };
            LaneFilling::Spans(all.iter().map(span).collect())
        }
    }
}

/// A value as it is drawn. What came at `began` is at 0.
pub(super) fn dot(value: &LaneValue, began: f64, kind: Option<&ValueType>) -> Dot {
    let text = match &value.value {
        // That something came is all that it says.
        Value::Bool(true) => String::new(),
        said => measured(said, kind),
    };
    let text = if value.pretended { words::pretended_value(&text) } else { text };
    Dot { t: value.t as f64 - began, number: value.value.as_number(), text: text.into() }
}

/// Marks as they are drawn.
pub(super) fn marks(opened: &OpenedPast) -> Vec<LaneMark> {
    let text = |mark: &RecordingMark| if mark.word.is_empty() { mark.note.clone() } else { mark.word.clone() };
    let at = |ms: u64| ms as f64 - opened.from_ms as f64;
    let there = opened.marks.iter().filter(|mark| !mark.gone);
    there.map(|mark| LaneMark { t: at(mark.t), until: mark.until.map(at), text: text(mark) }).collect()
}

#[cfg(test)]
mod tests {
    use super::{all_lanes, dot, filling, first_lanes, key, lane, marks, name};
    use behaviour::{StreamKind, Value};
    use lanes::{LaneFilling, LaneShape};
    use protocol::{LaneColumn, LaneName, LaneValue, LaneValues, OpenedPast, PastStream, RecordingMark};

    fn stream(stream: &str, kind: StreamKind, count: u64, fields: &[&str]) -> PastStream {
        let fields = fields.iter().map(|field| (*field).to_owned()).collect();
        let (stream, name, params) = (stream.to_owned(), stream.to_owned(), behaviour::Params::default());
        PastStream { stream, name, kind, device: None, params, count, numbers: false, fields }
    }

    fn opened(streams: Vec<PastStream>) -> OpenedPast {
        OpenedPast { streams, ..OpenedPast::default() }
    }

    #[test]
    fn a_lane_is_known_by_its_key() {
        for field in [None, Some("position.x".to_owned())] {
            let one = LaneName { stream: "face-1".into(), field };
            assert_eq!(name(&key(&one)), one);
        }
    }

    #[test]
    fn the_first_lanes_are_senses_with_what_tells_most_and_all_actions() {
        let past = opened(vec![
            stream("say", StreamKind::Actuator, 3, &[]),
            stream("face", StreamKind::Sensor, 900, &["angle", "distance"]),
            stream("close", StreamKind::Ordinary, 40, &[]),
            stream("never", StreamKind::Sensor, 0, &[]),
        ]);
        let keys: Vec<String> = first_lanes(&past).iter().map(key).collect();
        assert_eq!(keys, ["face", "face distance", "close", "say"]);
        assert_eq!(all_lanes(&past).len(), 5, "all fields, and nothing that never came");
        let shapes: Vec<LaneShape> = first_lanes(&past).iter().map(|name| lane(&past, name).unwrap().shape).collect();
        assert_eq!(shapes, [LaneShape::Bars, LaneShape::Plot, LaneShape::Marbles, LaneShape::Marbles]);
    }

    #[test]
    fn many_senses_leave_room_for_actions() {
        let senses = (0..30).map(|at| stream(&format!("sense-{at}"), StreamKind::Sensor, 5, &["x"]));
        let actions = (0..4).map(|at| stream(&format!("action-{at}"), StreamKind::Actuator, 5, &[]));
        let keys: Vec<String> = first_lanes(&opened(senses.chain(actions).collect())).iter().map(key).collect();
        assert_eq!(keys.len(), super::FIRST_LANES);
        assert_eq!(keys.iter().filter(|key| key.starts_with("action")).count(), 4);
    }

    #[test]
    fn columns_become_stretches_of_their_time() {
        let column = LaneColumn { at: 3, count: 7, numbers: Some([1.0, 9.0, 2.0, 4.0]) };
        let LaneFilling::Spans(spans) =
            filling(&LaneValues::Columns(vec![column]), (1_000.0, 2_000.0), (10, 0.0), None)
        else {
            panic!("they are told together")
        };
        assert_eq!(
            (spans[0].t, spans[0].until, spans[0].range, spans[0].ends),
            (1_300.0, 1_400.0, (1.0, 9.0), (2.0, 4.0))
        );
    }

    #[test]
    fn a_value_says_what_it_is_and_that_it_was_pretended() {
        let value = |value, pretended| LaneValue { t: 5, nth: 0, value, pretended };
        assert_eq!(&*dot(&value(Value::text("Hello"), false), 0.0, None).text, "Hello");
        assert_eq!(&*dot(&value(Value::Bool(true), false), 0.0, None).text, "");
        assert_eq!(&*dot(&value(Value::Int(3), true), 0.0, None).text, "3 (pretended)");
        assert_eq!(dot(&value(Value::Int(3), true), 0.0, None).number, Some(3.0));
    }

    #[test]
    fn a_mark_that_is_gone_is_not_shown() {
        let mark = |word: &str, note: &str, gone| RecordingMark {
            id: behaviour::Id::new("m").unwrap(),
            t: 9,
            until: None,
            word: word.into(),
            sort: protocol::MarkSort::default(),
            note: note.into(),
            by: String::new(),
            at: String::new(),
            open: false,
            gone,
        };
        let marked = vec![mark("laughs", "loudly", false), mark("", "a note", false), mark("gone", "", true)];
        let shown = marks(&OpenedPast { from_ms: 4, marks: marked, ..OpenedPast::default() });
        let shown: Vec<(f64, &str)> = shown.iter().map(|mark| (mark.t, mark.text.as_str())).collect();
        assert_eq!(shown, [(5.0, "laughs"), (5.0, "a note")]);
    }
}
