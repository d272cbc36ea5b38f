//! Names in a row, and what others say.

use crate::words::language::{said, translated};
use behaviour::Lasting;
use std::fmt::Display;

/// A person in a sentence, as they are spoken of.
pub(crate) fn person_called(person: &str) -> String {
    say!("{person}", person)
}

/// Names one after the other: "Red, Green".
pub(crate) fn listed<Name: Display>(names: impl IntoIterator<Item = Name>) -> String {
    let names = names.into_iter().map(|name| name.to_string());
    names.reduce(|before, last| say!("{before}, {last}", before, last)).unwrap_or_default()
}

/// Names that belong together: "Red and Green".
pub(super) fn joined<Name: Display>(names: impl IntoIterator<Item = Name>) -> String {
    let names = names.into_iter().map(|name| name.to_string());
    names.reduce(|before, last| say!("{before} and {last}", before, last)).unwrap_or_default()
}

/// Where a connector comes from: "Red and Green".
pub(crate) fn sources(names: &[String]) -> String {
    joined(names)
}

/// A title and what is below it, in one line.
pub(crate) fn titled(title: &str, text: &str) -> String {
    say!("{title}: {text}", title, text)
}

/// What a connector is called.
pub(crate) fn connector_word(name: &'static str) -> &'static str {
    said(name)
}

/// What a refusal, a problem or the server says.
pub(crate) fn told_by(what: &impl Display) -> String {
    translated(&what.to_string())
}

/// What a sense or an action does.
pub(crate) fn device_says(device: &robot::Device) -> &'static str {
    said(device.says)
}

/// What a connector does.
pub(crate) fn connector_says(spec: &behaviour::connectors::Spec) -> &'static str {
    said(spec.says)
}

/// A label of a field or a choice of the catalogue.
pub(crate) fn label_of(label: &'static str) -> &'static str {
    said(label)
}

/// How long something lasts, in the unit in which people say it.
pub(crate) fn duration(ms: u64) -> String {
    match Lasting::of(ms) {
        Lasting::Minutes(1) => said("1 minute").to_owned(),
        Lasting::Minutes(minutes) => say!("{minutes} minutes", minutes),
        Lasting::Seconds(_) if ms == 1_000 => said("1 second").to_owned(),
        Lasting::Seconds(seconds) => say!("{seconds} seconds", seconds),
        Lasting::Milliseconds(ms) => say!("{ms} ms", ms),
    }
}

/// The duration of a connector: "every 1 second" of a beat.
pub(crate) fn period_of(spec: &behaviour::connectors::Spec, ms: u64) -> String {
    let duration = duration(ms);
    if spec.beats() { say!("every {duration}", duration) } else { duration }
}

/// Sentences one after the other.
pub(crate) fn one_after_another(sentences: &[String]) -> String {
    let sentences = sentences.iter().cloned();
    sentences.reduce(|before, last| say!("{before}. {last}", before, last)).unwrap_or_default()
}
