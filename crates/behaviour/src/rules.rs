//! The rules every change must keep, and the refusal that names the broken one.

use crate::size::{RECORD_MAX_BYTES, Size};
use crate::{
    Behaviour, Change, Connector, DeviceType, Edit, FillFrom, Graph, Group, Helper, Id, Lookup, LookupSet, Note,
    Params, Procedure, Record, Settings, Signature, Stream, StreamKind, ValueType, as_looks, has_unseen, record_bytes,
};
use phrase::{Phrase, Phrased, Word, phrase, word};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::ops::RangeInclusive;

/// The longest name of a behaviour, stream or helper, in characters.
pub const NAME_MAX_CHARS: usize = 200;
/// The longest body of a procedure, in characters.
pub const BODY_MAX_CHARS: usize = 8_192;
/// The longest note, in characters.
pub(crate) const NOTE_MAX_CHARS: usize = 4_000;
/// The latest time that a note may say, in milliseconds since 1970: the end of the year 9999.
pub(crate) const NOTE_MAX_MS: u64 = 253_402_300_799_999;
/// Tags of one behaviour.
pub const TAGS_MAX: usize = 8;
/// The longest tag, in characters.
pub const TAG_MAX_CHARS: usize = 24;
/// Streams in one behaviour.
pub const STREAMS_MAX: usize = 2_000;
/// Connectors in one behaviour.
pub const CONNECTORS_MAX: usize = 4_000;
/// Edits in one change.
pub const EDITS_MAX: usize = 10_000;
/// The durations a connector may have, in milliseconds.
pub const RATE_MS: RangeInclusive<u64> = 1..=3_600_000;

/// The questions of the rules to rooms they may not know: the catalogue of devices and the procedure language.
pub trait Knowledge {
    /// Checks that the device exists for that kind of stream and takes these parameters.
    ///
    /// # Errors
    /// A sentence for the person.
    fn device(&self, kind: StreamKind, device: &str, params: &Params) -> Result<(), Phrase>;

    /// Checks that the body can run with these arguments; a refusal says the place of the mistake.
    ///
    /// # Errors
    /// A sentence for the person.
    fn body(&self, arguments: &[String], body: &str) -> Result<(), Phrase>;

    /// Returns the kind of a device's values with these parameters, and its pace; nothing by default.
    fn device_type(&self, _kind: StreamKind, _device: &str, _params: &Params) -> DeviceType {
        DeviceType::default()
    }

    /// The kind of value that a body makes of arguments of these kinds; `helper` says what a helper makes, if there is one
    /// of that name with so many parameters. Any kind by default, and at every doubt.
    fn result(&self, _arguments: &[(String, ValueType)], _body: &str, _helper: HelperCall) -> ValueType {
        ValueType::Any
    }

    /// Returns the declared signature of a helper; nothing by default.
    fn signature(&self, _helper: &Helper) -> Option<Signature> {
        None
    }

    /// An argument of the body that is an object and is compared with a number or reckoned with, and how often; nothing by
    /// default, and at every doubt.
    fn misused(&self, _arguments: &[(String, ValueType)], _body: &str, _helper: HelperCall) -> Option<(String, usize)> {
        None
    }

    /// Returns the name for a stream that a helper of this name makes, if it is not the helper's; nothing by default.
    fn stream_of(&self, _helper: &str) -> Option<&'static str> {
        None
    }

    /// A name in the body that means nothing with these arguments and helpers, with those that would in its place.
    fn unknown_name(
        &self,
        _arguments: &[(String, ValueType)],
        _body: &str,
        _helpers: &[&str],
    ) -> Option<(String, Vec<String>)> {
        None
    }
}

/// Knows every device and every procedure: for decisions in which neither is asked about.
#[derive(Clone, Copy, Debug)]
pub struct AnyKnowledge;

impl Knowledge for AnyKnowledge {
    fn device(&self, _: StreamKind, _: &str, _: &Params) -> Result<(), Phrase> {
        Ok(())
    }

    fn body(&self, _: &[String], _: &str) -> Result<(), Phrase> {
        Ok(())
    }
}

/// Returns the kind that a helper makes of arguments of these kinds, if one of that name has so many parameters.
pub type HelperCall<'a> = &'a dyn Fn(&str, &[ValueType]) -> Option<ValueType>;

/// The reasons why a change was not made. [`std::fmt::Display`] says each in one English sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Refusal {
    /// Somebody changed these names of things meanwhile.
    Stale(Phrase),
    /// Somebody is editing one of these records.
    Locked {
        /// The words by which a person calls it.
        what: Phrase,
        /// The name of who is editing it.
        by: String,
    },
    /// Somebody changed this since, so it cannot be taken back.
    ChangedSince {
        /// The words by which a person calls it.
        what: Phrase,
        /// The name of who changed it.
        by: String,
    },
    /// Nothing of this person is left to take back, or to do again.
    NothingToUndo,
    /// The behaviour is gone.
    Gone,
    /// The change has no edits, or too many.
    Edits(usize),
    /// A record under an id of another kind, or one twice.
    Malformed(Phrase),
    /// Another change has this op id already.
    Reused,
    /// A name is empty.
    Name(String),
    /// A name has characters that nobody sees; without them.
    Unseen(String),
    /// Another stream has this name.
    NameTaken(String),
    /// A text is too long; with its limit in characters.
    TooLong(Phrase, usize),
    /// More streams, connectors, notes, groups, places or helpers than fit; with the limit.
    TooMany(Phrase, usize),
    /// The behaviour or the library would hold more than fits; which of them, and the limit in bytes.
    Full(Phrase, usize),
    /// One thing with all its texts and lists is too large; what it is called.
    TooLarge(Phrase),
    /// Values would flow in a circle through this stream.
    Cycle(String),
    /// This stream already has an incoming connector.
    SecondInput(String),
    /// A sensor stream cannot take from a connector.
    IntoSensor(String),
    /// An actuator stream cannot give to a connector.
    OutOfActuator(String),
    /// Only subscribe ends in this actuator stream.
    OnlySubscribe(String),
    /// Subscribe must end in an actuator stream, not in this one.
    SubscribeEnd(String),
    /// A connector names a stream that is not there.
    MissingStream,
    /// This connector takes exactly one input.
    OneInput(Phrase),
    /// One stream is named twice as input of this connector.
    InputTwice(String),
    /// The beat in milliseconds is outside its range.
    Rate(u64),
    /// A parameter of a device is no finite number.
    Infinite,
    /// No device is chosen for the stream of this kind and name.
    NeedsDevice(StreamKind, String),
    /// The sensor or actuator stream of this name has no device.
    NoDevice(String),
    /// An ordinary stream has a device.
    OrdinaryDevice,
    /// The device or its parameters do not fit; with the reason.
    Device(Phrase),
    /// The body cannot run; with the reason and its place.
    Body(Phrase),
    /// A helper's name or parameter cannot be used in a procedure.
    Identifier(String),
    /// A helper that is said to take more values than it has parameters; with how many those are.
    TakesMore(String, usize),
    /// These behaviours and helpers use the helper that was to go.
    HelperUsed(String, Vec<String>),
    /// The helper of this name is used by more programs than can follow its new name; with how many could.
    UsedByMany(String, usize),
    /// The stream of this name is in the group of this title already, and can be in one only.
    InGroup {
        /// The name of the stream.
        stream: String,
        /// The title of the group that has it.
        group: String,
    },
    /// Saving failed; with the reason. Nothing was changed.
    NotSaved(Phrase),
}

/// Checks that `after` keeps the rules, given that `change` led to it from what had the size `before`. The cheap rules
/// come first.
///
/// # Errors
/// The first broken rule.
pub(crate) fn check(
    after: &Behaviour,
    change: &Change,
    before: &Size,
    knowledge: &dyn Knowledge,
) -> Result<(), Refusal> {
    before.after(change).check(before)?;
    change.edits.iter().try_for_each(check_bounds)?;
    check_touched(after, change, knowledge)?;
    let graph_touched =
        change.edits.iter().any(|edit| matches!(edit.id.kind, crate::Kind::Stream | crate::Kind::Connector));
    if graph_touched {
        check_names(after, change)?;
        check_graph(after)?;
    }
    if change.edits.iter().any(|edit| edit.id.kind == crate::Kind::Group) {
        check_groups(after)?;
    }
    check_helper_names(after, change)
}

/// Bounds that older versions did not have: what was beyond one of them may stay so, or become smaller.
fn check_bounds(edit: &Edit) -> Result<(), Refusal> {
    let Some(after) = &edit.after else { return Ok(()) };
    let (bytes, before) = (record_bytes(&edit.id, after), edit.before.as_ref());
    if bytes > RECORD_MAX_BYTES && before.is_none_or(|before| record_bytes(&edit.id, before) < bytes) {
        return Err(Refusal::TooLarge(edit.id.kind.this()));
    }
    let known: LookupSet<&str> = before.map(names_in).unwrap_or_default().into_iter().filled();
    let mut new = names_in(after).into_iter().filter(|name| !known.contains(name));
    new.try_for_each(|name| {
        within(word!("limited.name", "this name"), name, NAME_MAX_CHARS)?;
        if has_unseen(name) { Err(Refusal::Unseen(shortened(name))) } else { Ok(()) }
    })
}

/// Every name that people read in a record.
fn names_in(record: &Record) -> Vec<&str> {
    match record {
        Record::Settings(settings) => {
            let own = [&settings.name, &settings.robot].into_iter().chain(&settings.exercise);
            own.chain(&settings.tags).map(String::as_str).collect()
        }
        Record::Helper(helper) => std::iter::once(&helper.name).chain(&helper.params).map(String::as_str).collect(),
        Record::Stream(stream) => {
            let names = stream.params.keys().chain(stream.resources.iter().flatten()).chain(&stream.device);
            std::iter::once(&stream.name).chain(names).map(String::as_str).collect()
        }
        Record::Connector(connector) => match connector.operation.procedure() {
            Some(Procedure::Body { args, .. }) => args.iter().flatten().map(String::as_str).collect(),
            Some(Procedure::Helper(name)) => vec![name],
            None => Vec::new(),
        },
        Record::Group(group) => vec![&group.title],
        Record::Pad(pad) => pad.names(),
        Record::Place(_) | Record::Note(_) => Vec::new(),
    }
}

fn check_touched(after: &Behaviour, change: &Change, knowledge: &dyn Knowledge) -> Result<(), Refusal> {
    for edit in &change.edits {
        let Some(record) = &edit.after else { continue };
        match record {
            Record::Settings(settings) => check_settings(settings)?,
            Record::Stream(stream) => check_stream(stream, knowledge)?,
            Record::Connector(connector) => check_connector(after, connector, knowledge)?,
            Record::Helper(helper) => check_helper(helper, knowledge)?,
            Record::Note(note) => check_note(note)?,
            Record::Group(group) => check_group(group)?,
            Record::Pad(pad) => crate::pad::check(&edit.id, pad, knowledge)?,
            Record::Place(place) if place.x.is_finite() && place.y.is_finite() => {}
            Record::Place(_) => return Err(Refusal::Malformed(phrase!("malformed.position", "a position"))),
        }
    }
    Ok(())
}

fn check_note(note: &Note) -> Result<(), Refusal> {
    within(word!("this.note", "this note"), &note.text, NOTE_MAX_CHARS)?;
    within(word!("limited.name", "this name"), &note.by, NAME_MAX_CHARS)?;
    if note.at_ms > NOTE_MAX_MS {
        Err(Refusal::Malformed(phrase!("malformed.note_time", "the time of a note")))
    } else {
        Ok(())
    }
}

fn check_group(group: &Group) -> Result<(), Refusal> {
    check_name(&group.title)?;
    let fits = group.streams.len() <= STREAMS_MAX;
    if fits { Ok(()) } else { Err(Refusal::TooMany(phrase!("many.streams", "streams"), STREAMS_MAX)) }
}

/// A stream is in one group at most, whether it is there or gone.
fn check_groups(after: &Behaviour) -> Result<(), Refusal> {
    let mut seen: Lookup<&Id, &Group> = Lookup::new();
    for (_, group) in after.groups() {
        for id in &group.streams {
            if let Some(other) = seen.insert(id, group) {
                let stream = after.stream(id).map_or_else(|| id.to_string(), |stream| stream.name.clone());
                return Err(Refusal::InGroup { stream, group: other.title.clone() });
            }
        }
    }
    Ok(())
}

fn check_settings(settings: &Settings) -> Result<(), Refusal> {
    check_name(&settings.name)?;
    check_tags(&settings.tags)?;
    match settings.engine {
        crate::Engine::Event => Ok(()),
        crate::Engine::Frame { frame_ms } if (1..=1000).contains(&frame_ms) => Ok(()),
        crate::Engine::Frame { frame_ms } => Err(Refusal::Rate(frame_ms)),
    }
}

/// Tags are short, few, and different from each other in more than their case.
fn check_tags(tags: &[String]) -> Result<(), Refusal> {
    if tags.len() > TAGS_MAX {
        return Err(Refusal::TooMany(phrase!("many.tags", "tags"), TAGS_MAX));
    }
    let mut seen = LookupSet::new();
    tags.iter().try_for_each(|tag| {
        if tag.trim() != tag {
            return Err(Refusal::Name(shortened(tag)));
        }
        check_name(tag)?;
        within(word!("limited.tag", "this tag"), tag, TAG_MAX_CHARS)?;
        if seen.insert(as_looks(tag).to_lowercase()) { Ok(()) } else { Err(Refusal::NameTaken(tag.clone())) }
    })
}

fn check_name(name: &str) -> Result<(), Refusal> {
    if name.trim().is_empty() || name.chars().any(char::is_control) {
        return Err(Refusal::Name(shortened(name)));
    }
    within(word!("limited.name", "this name"), name, NAME_MAX_CHARS)
}

fn within(what: Word, text: &str, limit: usize) -> Result<(), Refusal> {
    if text.chars().count() > limit { Err(Refusal::TooLong(what.phrase(), limit)) } else { Ok(()) }
}

fn shortened(text: &str) -> String {
    crate::without_unseen(text).chars().take(40).collect()
}

fn check_stream(stream: &Stream, knowledge: &dyn Knowledge) -> Result<(), Refusal> {
    check_name(&stream.name)?;
    if stream.params.values().any(|value| !value.is_finite()) {
        return Err(Refusal::Infinite);
    }
    match (stream.kind, &stream.device) {
        (StreamKind::Ordinary, None) => Ok(()),
        (StreamKind::Ordinary, Some(_)) => Err(Refusal::OrdinaryDevice),
        (kind, None) => Err(Refusal::NeedsDevice(kind, stream.name.clone())),
        (kind, Some(device)) => knowledge.device(kind, device, &stream.params).map_err(Refusal::Device),
    }
}

fn check_connector(after: &Behaviour, connector: &Connector, knowledge: &dyn Knowledge) -> Result<(), Refusal> {
    if let Some(period_ms) = connector.operation.period_ms()
        && !RATE_MS.contains(&period_ms)
    {
        return Err(Refusal::Rate(period_ms));
    }
    let Some(Procedure::Body { body, args }) = connector.operation.procedure() else { return Ok(()) };
    within(word!("limited.procedure", "this procedure"), body, BODY_MAX_CHARS)?;
    if let Some(bad) = args.iter().flatten().find(|name| !crate::is_identifier(name)) {
        return Err(Refusal::Identifier(shortened(bad)));
    }
    if body.trim().is_empty() {
        return Ok(());
    }
    knowledge.body(&after.arguments(connector), body).map_err(Refusal::Body)
}

fn check_helper(helper: &Helper, knowledge: &dyn Knowledge) -> Result<(), Refusal> {
    within(word!("limited.name", "this name"), &helper.name, NAME_MAX_CHARS)?;
    within(word!("limited.procedure", "this procedure"), &helper.body, BODY_MAX_CHARS)?;
    within(word!("limited.sentence", "This sentence"), &helper.says, NOTE_MAX_CHARS)?;
    let names = std::iter::once(&helper.name).chain(&helper.params);
    if let Some(bad) = names.into_iter().find(|name| !crate::is_identifier(name)) {
        return Err(Refusal::Identifier(shortened(bad)));
    }
    let mut distinct: Vec<_> = helper.params.iter().map(|name| as_looks(name)).collect();
    distinct.sort_unstable();
    if let Some(pair) = distinct.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(Refusal::NameTaken(pair[0].to_string()));
    }
    if helper.takes.len() > helper.params.len() {
        return Err(Refusal::TakesMore(shortened(&helper.name), helper.params.len()));
    }
    if helper.body.trim().is_empty() {
        return Ok(());
    }
    knowledge.body(&helper.params, &helper.body).map_err(Refusal::Body)
}

fn check_names(after: &Behaviour, change: &Change) -> Result<(), Refusal> {
    let names = || after.streams().map(|(_, stream)| stream.name.trim());
    unique(names())?;
    look_unique(names(), change, |record| match record {
        Record::Stream(stream) => Some(stream.name.trim()),
        _ => None,
    })
}

fn check_helper_names(after: &Behaviour, change: &Change) -> Result<(), Refusal> {
    let names = || after.helpers().map(|(_, helper)| helper.name.as_str());
    unique(names())?;
    look_unique(names(), change, |record| match record {
        Record::Helper(helper) => Some(&helper.name),
        _ => None,
    })
}

/// Checks that no name which the change gives looks like another one. Two that look alike since an older version stay,
/// until somebody changes one.
fn look_unique<'a>(
    names: impl Iterator<Item = &'a str>,
    change: &Change,
    name_of: impl Fn(&Record) -> Option<&str>,
) -> Result<(), Refusal> {
    let given = change.edits.iter().filter_map(|edit| {
        let after = name_of(edit.after.as_ref()?)?;
        let is_new = edit.before.as_ref().and_then(&name_of) != Some(after);
        (is_new && !after.is_ascii()).then_some(after)
    });
    let given: Vec<&str> = given.collect();
    if given.is_empty() {
        return Ok(());
    }
    let mut counts: Lookup<Cow<str>, usize> = Lookup::new();
    names.filter(|name| !name.is_ascii()).for_each(|name| *counts.entry(as_looks(name)).or_insert(0) += 1);
    let twin = given.into_iter().find(|name| counts.get(&as_looks(name)).is_some_and(|count| *count > 1));
    twin.map_or(Ok(()), |name| Err(Refusal::NameTaken(as_looks(name).into_owned())))
}

fn unique<'a>(names: impl Iterator<Item = &'a str>) -> Result<(), Refusal> {
    let mut seen = LookupSet::new();
    for name in names {
        if !seen.insert(name) {
            return Err(Refusal::NameTaken(name.to_owned()));
        }
    }
    Ok(())
}

fn check_graph(after: &Behaviour) -> Result<(), Refusal> {
    let streams: Lookup<&Id, &Stream> = after.streams().filled();
    for (_, connector) in after.connectors_in_order() {
        check_ends(&streams, connector)?;
    }
    let graph = Graph::of(after);
    for (id, stream) in after.streams() {
        if stream.kind == StreamKind::Ordinary && graph.into_stream(id).len() > 1 {
            return Err(Refusal::SecondInput(stream.name.clone()));
        }
    }
    let name_of = |id: &Id| streams.get(id).map_or_else(String::new, |stream| stream.name.clone());
    graph.cycle().map_or(Ok(()), |id| Err(Refusal::Cycle(name_of(id))))
}

fn check_ends(streams: &Lookup<&Id, &Stream>, connector: &Connector) -> Result<(), Refusal> {
    let output = streams.get(&connector.output).ok_or(Refusal::MissingStream)?;
    let inputs: Option<Vec<_>> = connector.inputs.iter().map(|id| streams.get(id)).collect();
    let inputs = inputs.ok_or(Refusal::MissingStream)?;
    let spec = connector.operation.spec();
    if !spec.inputs.are_many() && inputs.len() != 1 {
        return Err(Refusal::OneInput(spec.phrase()));
    }
    let mut seen = LookupSet::new();
    for (id, input) in connector.inputs.iter().zip(inputs) {
        if !seen.insert(id) {
            return Err(Refusal::InputTwice(input.name.clone()));
        }
        if input.kind == StreamKind::Actuator {
            return Err(Refusal::OutOfActuator(input.name.clone()));
        }
    }
    match (output.kind, spec.ends) {
        (StreamKind::Sensor, _) => Err(Refusal::IntoSensor(output.name.clone())),
        (StreamKind::Actuator, StreamKind::Actuator) => Ok(()),
        (StreamKind::Actuator, _) => Err(Refusal::OnlySubscribe(output.name.clone())),
        (StreamKind::Ordinary, StreamKind::Actuator) => Err(Refusal::SubscribeEnd(output.name.clone())),
        (StreamKind::Ordinary, _) => Ok(()),
    }
}
