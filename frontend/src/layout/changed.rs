//! The words for a change, as its history tells it: "Close ball: 40 → 60 cm".

use super::was::{called, sources, what_it_was};
use crate::words::{self, HistoryWords};
use behaviour::{Behaviour, Connector, Edit, Id, Kind, Record, RecordId, StreamKind};
use protocol::HistoryLine;
use std::collections::BTreeMap;

/// The unit in which the numbers of a stream are, empty if there is none.
type UnitOf<'a> = &'a dyn Fn(&Id) -> &'static str;

/// Says what somebody did with a line of the history: by what it changed where the line holds that, else by its label.
/// A thing that has another name today is called as today.
pub(crate) fn done(now: &Behaviour, line: &HistoryLine, unit: UnitOf) -> HistoryWords {
    let Some(again) = behaviour::labels::taken_back(&line.label) else {
        return of_edits(now, &line.edits, unit).unwrap_or_else(|| words::deed(&line.label));
    };
    // What was taken back is told as it was done.
    let turned = |edit: &Edit| match again {
        true => edit.clone(),
        false => Edit { id: edit.id.clone(), before: edit.after.clone(), after: edit.before.clone() },
    };
    let edits: Vec<Edit> = line.edits.iter().map(turned).collect();
    let told = of_edits(now, &edits, unit).map(|deed| words::taken_back_deed(again, &deed.whole()));
    told.unwrap_or_else(|| words::deed(&line.label))
}

/// Says what these edits did, if they are of a kind that is told.
fn of_edits(now: &Behaviour, edits: &[Edit], unit: UnitOf) -> Option<HistoryWords> {
    let (was, is) = (with(now, edits, |edit| &edit.before), with(now, edits, |edit| &edit.after));
    if let Some(led) = led(edits) {
        return Some(told_led(&is, led));
    }
    let is_change = |edit: &Edit| edit.before.is_some() && edit.after.is_some();
    if !edits.iter().all(is_change) {
        return None;
    }
    // A name that follows from a number changes with it; it is the number that somebody changed.
    let mut connectors = edits.iter().filter(|edit| edit.id.kind == Kind::Connector);
    let one = match (connectors.next(), connectors.next(), edits) {
        (Some(one), None, _) => one,
        (None, None, [one]) if matches!(one.id.kind, Kind::Stream | Kind::Group) => one,
        _ => return None,
    };
    Some(told_changed(&was, &is, one, unit))
}

fn told_changed(was: &Behaviour, is: &Behaviour, edit: &Edit, unit: UnitOf) -> HistoryWords {
    let name = named(is, &edit.id);
    let (before, after) = (what_it_was(was, is, &edit.id), what_it_was(is, was, &edit.id));
    match (&edit.before, &edit.after) {
        _ if before == after => words::changed(&name),
        (Some(Record::Stream(old)), Some(Record::Stream(new))) if old.name != new.name => {
            words::renamed(&before, &after)
        }
        (Some(Record::Group(old)), Some(Record::Group(new))) if old.title != new.title => {
            words::renamed(&before, &after)
        }
        (Some(Record::Connector(_)), Some(Record::Connector(new))) => match one_number(&before, &after) {
            Some((before, after)) => {
                words::changed_from_to(&name, before, format!("{after} {}", measured(new, unit)).trim_end())
            }
            None => words::changed_from_to(&name, &before, &after),
        },
        _ => words::changed_from_to(&name, &before, &after),
    }
}

/// In what the numbers of the procedure of a connector are, where it takes one stream and looks at nothing in it.
fn measured(connector: &Connector, unit: UnitOf) -> &'static str {
    let looks_inside =
        |body: &str| body.split('.').skip(1).any(|part| part.starts_with(|c: char| c.is_alphabetic() || c == '_'));
    match (&connector.inputs[..], connector.operation.procedure()) {
        ([input], Some(_)) if !looks_inside(&connector.operation.chosen().concat()) => unit(input),
        _ => "",
    }
}

/// Names a thing where it is told: a connector by the stream that it gives to.
fn named(behaviour: &Behaviour, id: &RecordId) -> String {
    let output = match behaviour.records.get(id) {
        Some(Record::Connector(connector)) => behaviour.stream(&connector.output),
        _ => None,
    };
    output.map_or_else(|| called(behaviour, id), |stream| stream.name.clone())
}

/// The one number in which two texts differ, before and after; what stands after it goes with neither.
fn one_number<'a>(before: &'a str, after: &'a str) -> Option<(&'a str, &'a str)> {
    let is_of_number = |c: char| c.is_ascii_digit() || c == '.';
    let pairs = before.char_indices().zip(after.chars());
    let alike: usize = pairs.take_while(|((_, old), new)| old == new).map(|((_, old), _)| old.len_utf8()).sum();
    // A number that begins alike is shown whole.
    let start = before[..alike].trim_end_matches(is_of_number).len();
    let number = |text: &'a str| {
        let text = &text[start..];
        text.split_at(text.find(|c| !is_of_number(c)).unwrap_or(text.len()))
    };
    let ((old, rest), (new, other)) = (number(before), number(after));
    let are_numbers = old != new && old.parse::<f64>().is_ok() && new.parse::<f64>().is_ok();
    (rest == other && are_numbers).then_some((old, new))
}

/// A new connector, alone or with the new stream that it leads to.
struct Led<'a> {
    connector: &'a Connector,
    is_new: bool,
}

fn led(edits: &[Edit]) -> Option<Led<'_>> {
    let is_added = |edit: &Edit| edit.before.is_none() && edit.after.is_some();
    let mut connectors = edits.iter().filter_map(|edit| match &edit.after {
        Some(Record::Connector(connector)) => Some(connector),
        _ => None,
    });
    let (connector, None) = (connectors.next()?, connectors.next()) else { return None };
    let streams: Vec<&Edit> = edits.iter().filter(|edit| edit.id.kind == Kind::Stream).collect();
    let only_these = edits.len() == 1 + streams.len() && edits.iter().all(is_added);
    match streams[..] {
        [] if only_these => Some(Led { connector, is_new: false }),
        [one] if only_these && one.id == RecordId::new(Kind::Stream, &connector.output) => {
            Some(Led { connector, is_new: true })
        }
        _ => None,
    }
}

fn told_led(is: &Behaviour, Led { connector, is_new }: Led) -> HistoryWords {
    let (from, output) = (sources(is, connector), is.stream(&connector.output));
    let name = output.map_or_else(|| words::not_there().to_owned(), |stream| stream.name.clone());
    let is_action = output.is_some_and(|stream| stream.kind == StreamKind::Actuator);
    match (is_new, is_action) {
        (true, true) => words::added_for(&name, &from),
        (true, false) => words::added_from(&name, &from),
        (false, _) => words::led(&from, &name),
    }
}

/// Returns the records that these edits touch, with one side of them, and the streams that they speak of as they are
/// now.
fn with(now: &Behaviour, edits: &[Edit], side: impl Fn(&Edit) -> &Option<Record>) -> Behaviour {
    let both = edits.iter().flat_map(|edit| [&edit.before, &edit.after]);
    let connectors = both.filter_map(|record| match record {
        Some(Record::Connector(connector)) => Some(connector),
        _ => None,
    });
    let spoken = connectors.flat_map(|connector| connector.inputs.iter().chain([&connector.output]));
    let ids = spoken.map(|stream| RecordId::new(Kind::Stream, stream));
    let mut records: BTreeMap<RecordId, Record> =
        ids.filter_map(|id| Some((id.clone(), now.records.get(&id)?.clone()))).collect();
    for edit in edits {
        match side(edit) {
            Some(record) => records.insert(edit.id.clone(), record.clone()),
            None => records.remove(&edit.id),
        };
    }
    Behaviour { records }
}

#[cfg(test)]
mod tests {
    use super::{done, one_number};
    use behaviour::labels;
    use behaviour::{
        Accepted, Behaviour, Change, Connector, Id, Operation, Parameters, Params, Procedure, Record, RecordId, Stream,
        StreamKind, connectors,
    };
    use protocol::HistoryLine;

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn stream(name: &str, kind: StreamKind) -> Record {
        let (name, device, params) = (name.to_owned(), None, Params::new());
        Record::Stream(Stream { kind, name, device, params, order: 0, resources: None, priority: None, hold_ms: None })
    }

    fn gives(operation: Operation, to: &str) -> Record {
        Record::Connector(Connector { operation, inputs: vec![id("a")], output: id(to), order: 0 })
    }

    fn near(body: &str) -> Record {
        gives(connectors::filter::SPEC.with(Procedure::body(body)), "b")
    }

    fn program() -> Behaviour {
        let records = [
            ("stream/a", stream("Distance", StreamKind::Ordinary)),
            ("stream/b", stream("Close ball", StreamKind::Ordinary)),
            ("connector/f", near("distance < 40")),
        ];
        Behaviour { records: records.into_iter().map(|(id, record)| (id.parse().unwrap(), record)).collect() }
    }

    /// Returns the words for putting these records, and for taking that back.
    fn said(label: &str, records: &[(&str, Record)]) -> [String; 2] {
        let mut now = program();
        let mut change = Change::of(id("op"), "Aiko", label);
        for (at, record) in records {
            change = change.put(&now, at.parse::<RecordId>().unwrap(), record.clone());
        }
        let back = change.swapped(id("back"), labels::undo_of(false, &label.into()));
        now.apply(&change);
        [change, back].map(|change| {
            let line = HistoryLine::of(Accepted { revision: 1, change });
            done(&now, &line, &|stream| if stream.as_str() == "a" { "cm" } else { "" }).whole()
        })
    }

    #[test]
    fn a_number_is_told_with_what_it_was_and_its_unit() {
        let number = said("Edit filter", &[("connector/f", near("distance < 60"))]);
        assert_eq!(number, ["changed Close ball: 40 → 60 cm", "took back “changed Close ball: 40 → 60 cm”"]);
        let named =
            [("connector/f", near("distance < 60")), ("stream/b", stream("Distance < 60", StreamKind::Ordinary))];
        assert_eq!(said("Edit filter", &named)[0], "changed Distance < 60: 40 → 60 cm");
        let other = said("Edit filter", &[("connector/f", near("distance > 60"))]);
        assert_eq!(other[0], "changed Close ball: distance < 40 → distance > 60");
        let sample = gives(connectors::sample::SPEC.with(Parameters::period(500)), "b");
        let kind = said("Edit sample", &[("connector/f", sample)]);
        assert_eq!(kind[0], "changed Close ball: filter (distance < 40) → sample (every 0.5 seconds)");
    }

    #[test]
    fn what_is_new_is_told_with_what_it_is_for() {
        let subscribed = |to: &str| gives(connectors::subscribe::SPEC.with(()), to);
        let action = [("stream/t", stream("Tracker", StreamKind::Actuator)), ("connector/s", subscribed("t"))];
        assert_eq!(said("Add Tracker", &action)[0], "added Tracker for Distance");
        let plain = [("stream/t", stream("Far", StreamKind::Ordinary)), ("connector/s", subscribed("t"))];
        assert_eq!(said("Add map", &plain)[0], "added Far from Distance");
        assert_eq!(said("Connect Close ball", &[("connector/s", subscribed("b"))])[0], "led Distance to Close ball");
        let renamed = said("Rename Close ball", &[("stream/b", stream("Near", StreamKind::Ordinary))]);
        assert_eq!(renamed, ["renamed Close ball to Near", "took back “renamed Close ball to Near”"]);
        assert_eq!(said("Tidy", &[])[0], "made a change: Tidy", "what an older version wrote");
    }

    #[test]
    fn texts_differ_in_one_number() {
        assert_eq!(one_number("a < 40", "a < 45"), Some(("40", "45")));
        assert_eq!(one_number("every 0.5 seconds", "every 1 seconds"), Some(("0.5", "1")));
        assert_eq!(one_number("a < 40", "a < 405"), Some(("40", "405")));
        for (old, new) in [("a < 40", "a > 45"), ("a < 40", "b < 40"), ("40 + 1", "41 + 2"), ("é 1", "è 1"), ("", "1")]
        {
            assert_eq!(one_number(old, new), None, "{old} {new}");
        }
    }
}
