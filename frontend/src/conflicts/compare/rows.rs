//! What both made of one record, part by part, and where they differ. Pure.

use crate::conflicts::words;
use crate::desk::{Conflict, wording};
use crate::live::short_value;
use behaviour::{
    Behaviour, Connector, Id, Kind, Procedure, Record, RecordId, Stream, StreamKind, Tile, TileAction, Value,
};
use robot::{Device, Param, ParamKind};

/// One part, as both have it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ConflictRow {
    pub(super) label: String,
    pub(super) mine: DifferingPieces,
    pub(super) theirs: DifferingPieces,
    pub(super) code: bool,
}

/// What is alike, what differs, and what is alike again.
pub(super) type DifferingPieces = [String; 3];

/// A part of a record, in words.
#[derive(Clone, Debug, PartialEq)]
struct Facet {
    label: String,
    text: String,
    code: bool,
    /// Shown even where both are alike.
    always: bool,
}

impl Facet {
    fn of(label: &str, text: String) -> Self {
        Self { label: label.to_owned(), text, code: false, always: false }
    }

    fn always(self) -> Self {
        Self { always: true, ..self }
    }
}

/// The rows of a comparison with the behaviour as it is now.
pub(super) fn rows(conflict: &Conflict, now: &Behaviour) -> Vec<ConflictRow> {
    let Some((seen, mine)) = conflict.mine_of(&conflict.about) else { return Vec::new() };
    let theirs = now.records.get(&conflict.about);
    let facets = |record: Option<&Record>, name: &dyn Fn(&Id) -> String| {
        record.map_or_else(Vec::new, |record| facets(record, name))
    };
    let wanted = |id: &Id| name_in(conflict.wanted(id), now, id);
    let saved = |id: &Id| name_in(None, now, id);
    let (seen, mine, theirs) = (facets(seen, &saved), facets(mine, &wanted), facets(theirs, &saved));
    let mut labels: Vec<&Facet> = Vec::new();
    for facet in mine.iter().chain(&theirs) {
        if labels.iter().all(|known| known.label != facet.label) {
            labels.push(facet);
        }
    }
    let text = |of: &[Facet], label: &str| of.iter().find(|facet| facet.label == label).map(|facet| facet.text.clone());
    let row = |facet: &Facet| {
        let [was, mine, theirs] = [&seen, &mine, &theirs].map(|of| text(of, &facet.label));
        let differs = mine != theirs;
        (differs || facet.always).then(|| {
            let known = was.filter(|was| differs && !was.is_empty());
            let label = known.map_or_else(|| facet.label.clone(), |was| words::was(&facet.label, &was));
            let [mine, theirs] = [mine, theirs].map(|text| text.unwrap_or_else(|| words::not_there().to_owned()));
            let (mine, theirs) = apart(&mine, &theirs);
            ConflictRow { label, mine, theirs, code: facet.code }
        })
    };
    labels.into_iter().filter_map(row).collect()
}

/// What a stream is called: as its author wants it, else as it is.
fn name_in(wanted: Option<&Record>, now: &Behaviour, id: &Id) -> String {
    match wanted.or_else(|| now.records.get(&RecordId::new(Kind::Stream, id))) {
        Some(Record::Stream(stream)) => stream.name.clone(),
        _ => words::not_there().to_owned(),
    }
}

fn facets(record: &Record, name: &dyn Fn(&Id) -> String) -> Vec<Facet> {
    match record {
        Record::Connector(connector) => of_connector(connector, name),
        Record::Stream(stream) => of_stream(stream),
        Record::Pad(pad) => pad.tiles.iter().map(|(key, tile)| of_tile(*key, tile, name)).collect(),
        Record::Note(note) => vec![Facet::of(words::text_label(), note.text.clone()).always()],
        _ => wording(record).map(|name| Facet::of(words::leads_to(), name.to_owned()).always()).into_iter().collect(),
    }
}

/// A tile: its words, and what a press does.
fn of_tile(key: u8, tile: &Tile, name: &dyn Fn(&Id) -> String) -> Facet {
    let does = match &tile.does {
        TileAction::Hand { device, params, value } => {
            let action = robot::device(StreamKind::Actuator, device).ok();
            let of = |(action, param): (&Device, &Param)| Some(shown(action, param, params.get(param.name)?));
            let all = action.into_iter().flat_map(|action| action.params.iter().map(move |param| (action, param)));
            let chosen = all.filter_map(of);
            let told = action.is_none_or(|action| crate::json::read(action.example).ok().as_ref() != Some(value));
            let action = action.map_or_else(|| device.clone(), |action| words::device(action).to_owned());
            words::listed([action].into_iter().chain(chosen).chain(told.then(|| short_value(value))))
        }
        TileAction::Pretend { stream, value } => words::titled(&name(stream), &short_value(value)),
        TileAction::Word { word, span } => {
            let lasts = if *span { words::mark_span() } else { words::mark_moment() };
            words::listed([word.as_str(), lasts])
        }
    };
    let asks = tile.asks.then(|| words::asks_first().to_owned());
    let parts = [tile.label.clone(), does].into_iter().chain(asks);
    Facet::of(&words::tile_on(key), parts.collect::<Vec<_>>().join(" · "))
}

fn of_connector(connector: &Connector, name: &dyn Fn(&Id) -> String) -> Vec<Facet> {
    let (operation, spec) = (&connector.operation, connector.operation.spec());
    let procedure = operation.procedure().map(|procedure| {
        let label = if spec.is_test() { words::test_label() } else { words::procedure_label() };
        Facet { code: true, ..Facet::of(label, procedure_text(procedure)).always() }
    });
    let inputs: Vec<String> = connector.inputs.iter().map(name).collect();
    let start = operation.start().map(|start| Facet::of(words::start_label(), short_value(start)));
    let every = operation.period_ms().map(|ms| Facet::of(words::every_label(), words::duration(ms)));
    let first = [
        Facet::of(words::connector_label(), words::connector_word(spec).to_owned()),
        Facet::of(words::takes_from(), words::listed(inputs)),
    ];
    let last = Facet::of(words::leads_to(), name(&connector.output)).always();
    procedure.into_iter().chain(first).chain(start).chain(every).chain([last]).collect()
}

pub(super) fn procedure_text(procedure: &Procedure) -> String {
    match procedure {
        Procedure::Body { body, .. } => body.clone(),
        Procedure::Helper(name) => name.clone(),
    }
}

fn of_stream(stream: &Stream) -> Vec<Facet> {
    let mut all = vec![Facet::of(words::leads_to(), stream.name.clone()).always()];
    let device = stream.device.as_deref().and_then(|name| robot::device(stream.kind, name).ok());
    all.extend(stream.device.clone().map(|name| Facet::of(words::type_of(), name)));
    let params = device.into_iter().flat_map(|device| device.params.iter().map(move |param| (device, param)));
    all.extend(params.map(|(device, param)| {
        let default = param.default();
        let value = stream.params.get(param.name).unwrap_or(&default);
        Facet::of(words::label_of(&device.param_called(param)), shown(device, param, value))
    }));
    let other = (&stream.resources, stream.priority, stream.hold_ms);
    if other != (&None, None, None) {
        let parts = other.0.iter().flatten().cloned();
        let numbers = other.1.map(|priority| priority.to_string()).into_iter().chain(other.2.map(words::duration));
        all.push(Facet::of(words::other_settings(), parts.chain(numbers).collect::<Vec<_>>().join(" · ")));
    }
    all
}

fn shown(device: &Device, param: &Param, value: &Value) -> String {
    let option = match param.kind {
        ParamKind::Choice(options) => options.iter().find(|option| value.as_text() == Some(option.0)),
        _ => None,
    };
    option
        .map_or_else(|| short_value(value), |option| words::label_of(&device.choice_called(param, *option)).to_owned())
}

/// Two texts in pieces, so that only what differs is pointed out.
fn apart(one: &str, other: &str) -> (DifferingPieces, DifferingPieces) {
    let (a, b) = (tokens(one), tokens(other));
    if a == b {
        return ([one.to_owned(), String::new(), String::new()], [other.to_owned(), String::new(), String::new()]);
    }
    let head = a.iter().zip(&b).take_while(|(a, b)| a == b).count();
    let most = a.len().min(b.len()) - head;
    let tail = a.iter().rev().zip(b.iter().rev()).take(most).take_while(|(a, b)| a == b).count();
    (cut(&a, head, tail), cut(&b, head, tail))
}

fn cut(tokens: &[&str], head: usize, tail: usize) -> DifferingPieces {
    let end = tokens.len() - tail;
    [&tokens[..head], &tokens[head..end], &tokens[end..]].map(|part| part.concat())
}

/// Words, numbers and single signs.
fn tokens(text: &str) -> Vec<&str> {
    let is_word = |letter: char| letter.is_alphanumeric() || matches!(letter, '_' | '.');
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let end =
            if is_word(first) { rest.find(|letter| !is_word(letter)).unwrap_or(rest.len()) } else { first.len_utf8() };
        let (token, after) = rest.split_at(end);
        found.push(token);
        rest = after;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::apart;

    fn pieces(one: &str, other: &str) -> (String, String) {
        let show = |[head, middle, tail]: super::DifferingPieces| format!("{head}[{middle}]{tail}");
        let (a, b) = apart(one, other);
        (show(a), show(b))
    }

    #[test]
    fn only_what_differs_is_pointed_out() {
        let cases = [
            ("distance < 30", "distance < 35", "distance < [30]", "distance < [35]"),
            ("Close ball", "Close ball", "Close ball[]", "Close ball[]"),
            ("0.5 + x", "0.25 + x", "[0.5] + x", "[0.25] + x"),
            ("a", "", "[a]", "[]"),
            ("f(x)", "f(x, x)", "f(x[])", "f(x[, x])"),
            ("近い < 1", "遠い < 1", "[近い] < 1", "[遠い] < 1"),
        ];
        for (one, other, a, b) in cases {
            assert_eq!(pieces(one, other), (a.to_owned(), b.to_owned()), "{one} | {other}");
        }
    }
}
