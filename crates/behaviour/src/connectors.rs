//! Every connector in one file each: its words, ends, parameter, place in a graph database, and help.
//!
//! Menus, forms, rules, files, schemas, stores and help are drawn from this list. To add a connector, add a file and its
//! two words here, and what it does with values to the engine.

pub mod combine_latest;
pub mod debounce;
pub mod delay;
pub mod distinct;
pub mod filter;
pub mod map;
pub mod merge;
pub mod sample;
pub mod scan;
pub mod subscribe;
pub mod timestamp;
pub mod with_latest;

use crate::StreamKind;
pub use crate::spec::{
    Carries, ConnectorMeaning, GraphForm, Help, Icon, Inputs, Offered, PERIOD_MS, Passes, Procedural, ResultUse, Spec,
    Takes,
};
use phrase::{Phrase, Phrased};

/// All connectors, in the order in which people see them: that of the thesis, `merge` before `timestamp`.
pub const ALL: &[&Spec] = &[
    &sample::SPEC,
    &subscribe::SPEC,
    &filter::SPEC,
    &map::SPEC,
    &combine_latest::SPEC,
    &merge::SPEC,
    &timestamp::SPEC,
    &distinct::SPEC,
    &scan::SPEC,
    &debounce::SPEC,
    &delay::SPEC,
    &with_latest::SPEC,
];

/// A connector by its word in files.
#[must_use]
pub fn spec(word: &str) -> Option<&'static Spec> {
    ALL.iter().copied().find(|spec| spec.word == word)
}

/// Speaks of a connector by its word in files.
#[must_use]
pub fn named(word: &str) -> Phrase {
    spec(word).map_or_else(|| word.phrase(), Phrased::phrase)
}

/// The connector that a sentence with this meaning makes: of several the first, in the order of [`ALL`], that makes ordinary
/// streams.
#[must_use]
pub fn with_meaning(meaning: ConnectorMeaning) -> Option<&'static Spec> {
    ALL.iter().copied().find(|spec| spec.meaning == meaning && spec.ends == StreamKind::Ordinary)
}

/// The connector that leads a stream to an action of the robot.
#[must_use]
pub fn to_action() -> &'static Spec {
    &subscribe::SPEC
}

/// The connector that makes a new value of every value, one for one: what a helper alone stands for.
#[must_use]
pub fn to_new_value() -> &'static Spec {
    &map::SPEC
}

/// The connector that passes on whatever comes on any of several streams: how a stream is fed by one more.
#[must_use]
pub fn to_join() -> &'static Spec {
    &merge::SPEC
}

/// The connector that passes on the values that pass a test.
#[must_use]
pub fn to_choose() -> &'static Spec {
    &filter::SPEC
}

/// The connector that passes on the newest value at a steady beat.
#[must_use]
pub fn to_slow_down() -> &'static Spec {
    &sample::SPEC
}

/// The connector that passes on only what differs from the value before.
#[must_use]
pub fn to_leave_out_the_same() -> &'static Spec {
    &distinct::SPEC
}

/// The connector that puts the time beside each value.
#[must_use]
pub fn to_tell_the_time() -> &'static Spec {
    &timestamp::SPEC
}

/// The connector that remembers the newest value of each of its streams, however old it is.
#[must_use]
pub fn to_combine() -> &'static Spec {
    &combine_latest::SPEC
}

/// The words of those that fulfil a condition, in order.
pub fn words(of: impl Fn(&Spec) -> bool) -> impl Iterator<Item = &'static str> {
    ALL.iter().filter(move |spec| of(spec)).map(|spec| spec.word)
}

/// Names in a sentence: `map, filter or merge`.
#[must_use]
pub fn in_words<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.into_iter().collect();
    match names.split_last() {
        Some((last, [])) => (*last).to_owned(),
        Some((last, before)) => format!("{} or {last}", before.join(", ")),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::{ALL, Passes, ResultUse, Spec, spec, to_action, to_new_value};
    use crate::marbles::Lane;
    use crate::{StreamKind, is_identifier};
    use std::collections::BTreeSet;

    fn different(what: &str, of: impl Fn(&Spec) -> &str) {
        let all: BTreeSet<&str> = ALL.iter().map(|spec| of(spec)).collect();
        assert_eq!(all.len(), ALL.len(), "{what} are different: {all:?}");
        assert!(all.iter().all(|one| !one.trim().is_empty()), "{what} are there: {all:?}");
    }

    #[test]
    fn every_file_here_is_on_the_list() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/connectors");
        let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
        let stem = |path: std::path::PathBuf| path.file_stem().unwrap().to_string_lossy().replace('_', "");
        let files: BTreeSet<String> = files.map(stem).collect();
        assert_eq!(files, ALL.iter().map(|spec| spec.word.to_lowercase()).collect());
    }

    #[test]
    fn connectors_are_told_apart_and_say_what_they_do() {
        different("words", |spec| spec.word);
        different("names", |spec| spec.name);
        different("sentences", |spec| spec.says);
        different("icons", |spec| spec.icon.name);
        different("labels of nodes", |spec| spec.graph.label);
        for one in ALL {
            assert_eq!(spec(one.word), Some(*one));
            assert!(is_identifier(one.word) && one.says.ends_with('.') && !one.icon.strokes.is_empty(), "{one:?}");
            assert!(one.ends != StreamKind::Sensor, "{one:?}");
            assert!(one.graph.relationship.is_none() || !one.inputs.are_many(), "{one:?}");
            let makes = one.takes.procedure.is_some_and(|takes| takes.result == ResultUse::Value);
            assert_eq!(one.passes == Passes::Result, makes, "{one:?}");
        }
    }

    #[test]
    fn people_read_plain_names() {
        let named = |word: &str| spec(word).map(|spec| spec.name);
        for (word, name) in [
            ("distinct", "changed"),
            ("scan", "remember"),
            ("debounce", "settle"),
            ("delay", "delay"),
            ("withLatest", "with latest"),
        ] {
            assert_eq!(named(word), Some(name));
        }
    }

    #[test]
    fn one_leads_to_actions_and_one_applies_helpers() {
        assert!(ALL.iter().all(|spec| spec.acts() == (*spec == to_action())));
        let makes = to_new_value();
        assert!(makes.passes == Passes::Result && !makes.inputs.are_many() && makes.argument_count(1) == 1);
    }

    #[test]
    fn every_stream_that_is_made_can_be_called_something() {
        const HOLES: [&str; 6] = ["{input}", "{others}", "{helper}", "{body}", "{period}", "{every}"];
        for spec in ALL {
            assert_eq!(spec.called.is_empty(), spec.acts(), "{spec:?}: an action is called after its device");
            let says = |name: &&str| HOLES.iter().any(|hole| name.contains(hole));
            assert!(spec.called.iter().all(says), "{spec:?}: its name tells what it does");
            for name in spec.called {
                let rest = HOLES.iter().fold((*name).to_owned(), |rest, hole| rest.replace(hole, ""));
                assert!(!rest.contains(['{', '}']), "{spec:?}: {name}");
            }
        }
    }

    #[test]
    fn every_connector_has_help_with_examples() {
        for spec in ALL {
            let help = spec.help;
            assert!(help.examples.len() >= 2 && help.does.ends_with('.') && help.when.ends_with('.'), "{spec:?}");
            for example in help.examples {
                let set = example.setting;
                assert!(example.given.len() >= spec.inputs.least(), "{}", example.title);
                assert!(spec.takes.procedure.is_some() || set.body.is_empty(), "{}", example.title);
                assert_eq!(spec.takes.period.is_some(), set.period_ms > 0, "{}", example.title);
                assert!(spec.takes.start.is_some() || set.start.is_empty(), "{}", example.title);
            }
        }
    }

    #[test]
    fn every_marble_is_one_and_in_time() {
        for example in ALL.iter().flat_map(|spec| spec.help.examples) {
            for lane in example.given.iter().chain([&example.then]) {
                let times: Vec<u64> = lane.marbles().map(|marble| marble.at_ms).collect();
                assert_eq!(times.len(), lane.1.split_whitespace().count(), "{lane:?}");
                assert!(times.is_sorted() && times.iter().all(|at| *at <= example.until_ms), "{lane:?}");
            }
            assert!(example.title.ends_with('.') && !example.given.is_empty(), "{example:?}");
        }
    }

    #[test]
    fn names_in_examples_are_those_of_the_arguments() {
        for (spec, example) in ALL.iter().flat_map(|spec| spec.help.examples.iter().map(move |one| (spec, one))) {
            let names = spec.argument_names(example.given.iter().map(|Lane(name, _)| *name));
            let body = example.setting.body;
            let used = |name: &String| is_identifier(name) && body.contains(name);
            assert!(body.is_empty() || names.iter().any(used), "{}", example.title);
        }
    }
}
