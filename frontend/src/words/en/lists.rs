//! Names in a row, and what others say.

use crate::words::language::{label_of, said_by, shown};
use behaviour::Lasting;
use phrase::Phrased;
use std::fmt::Display;

/// A person in a sentence, as they are spoken of.
pub(crate) fn person_called(person: &str) -> String {
    say!(person_called: "{person}", person)
}

/// Names one after the other: "Red, Green".
pub(crate) fn listed<Name: Display>(names: impl IntoIterator<Item = Name>) -> String {
    let names = names.into_iter().map(|name| name.to_string());
    names.reduce(|before, last| say!(listed: "{before}, {last}", before, last)).unwrap_or_default()
}

/// Names that belong together: "Red and Green".
pub(crate) fn joined<Name: Display>(names: impl IntoIterator<Item = Name>) -> String {
    let names = names.into_iter().map(|name| name.to_string());
    names.reduce(|before, last| say!(joined: "{before} and {last}", before, last)).unwrap_or_default()
}

/// Where a connector comes from: "Red and Green".
pub(crate) fn sources(names: &[String]) -> String {
    joined(names)
}

/// A title and what is below it, in one line.
pub(crate) fn titled(title: &str, text: &str) -> String {
    say!(titled: "{title}: {text}", title, text)
}

/// What a connector is called.
pub(crate) fn connector_word(spec: &behaviour::connectors::Spec) -> &'static str {
    label_of(&spec.called_by_people())
}

/// What a refusal, a problem or the server says.
pub(crate) fn told_by(what: &impl Phrased) -> String {
    shown(what)
}

/// What a sense or an action does.
pub(crate) fn device_says(device: &robot::Device) -> &'static str {
    label_of(&device.described())
}

/// What a connector does.
pub(crate) fn connector_says(spec: &behaviour::connectors::Spec) -> &'static str {
    said_by(&format!("connector.{}.says", spec.word), spec.says)
}

/// How long something lasts, in the unit in which people say it.
pub(crate) fn duration(ms: u64) -> String {
    match Lasting::of(ms) {
        Lasting::Minutes(1) => said!(duration_n1_minute: "1 minute").to_owned(),
        Lasting::Minutes(minutes) => say!(duration_minutes: "{minutes} minutes", minutes),
        Lasting::Seconds(_) if ms == 1_000 => said!(duration_n1_second: "1 second").to_owned(),
        Lasting::Seconds(seconds) => say!(duration_seconds: "{seconds} seconds", seconds),
        Lasting::Milliseconds(ms) => say!(duration_ms: "{ms} ms", ms),
    }
}

/// The duration of a connector: "every 1 second" of a beat.
pub(crate) fn period_of(spec: &behaviour::connectors::Spec, ms: u64) -> String {
    let duration = duration(ms);
    if spec.beats() { say!(period_of: "every {duration}", duration) } else { duration }
}
