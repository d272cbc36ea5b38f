//! The sentences of all templates in both languages, as people read them.

use crate::support::{Made, sentences_of, templates};
use behaviour::connectors::to_action;
use behaviour::{Id, Params, StreamKind};
use robot::{Device, ParamKind};
use sentences::Language;

/// Set to write the file anew: then read it aloud.
const WRITE: &str = "RRP_WRITE_SENTENCES";
const GOLDEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/sentences.txt");

#[test]
fn templates_read_as_they_are_written_down() {
    let mut all = String::new();
    for template in templates() {
        all.push_str(&format!("{}\n", template.behaviour.name()));
        for language in Language::ALL {
            for sentence in sentences_of(&template.behaviour, &template.helpers, language) {
                all.push_str(&format!("  {sentence}\n"));
            }
        }
        all.push('\n');
    }
    for (title, made) in [("Every sense", every_sense()), ("Every action", every_action())] {
        all.push_str(&format!("{title}\n"));
        for language in Language::ALL {
            for sentence in sentences_of(&made.behaviour, &[], language) {
                all.push_str(&format!("  {sentence}\n"));
            }
        }
        all.push('\n');
    }
    if std::env::var_os(WRITE).is_some() {
        std::fs::write(GOLDEN, &all).unwrap();
    }
    let golden = std::fs::read_to_string(GOLDEN).unwrap_or_default();
    assert!(all == golden, "{all}\nSentences differ from tests/sentences.txt; {WRITE}=1 writes it anew.");
}

/// Every sense with what is chosen first and last for it, and a page that shows it.
fn every_sense() -> Made {
    let mut made = Made::default();
    for (at, device) in robot::sensors().enumerate() {
        for (which, params) in [("first", Params::new()), ("last", last(device))] {
            if which == "last" && params.is_empty() {
                continue;
            }
            let (from, to) = (id(&format!("{which}-{at}")), id(&format!("show-{which}-{at}")));
            made.stream(&from, StreamKind::Sensor, &format!("{which} {at}"), Some(device.name.to_owned()), params);
            made.stream(
                &to,
                StreamKind::Actuator,
                &format!("Show {which} {at}"),
                Some("Print".to_owned()),
                Params::new(),
            );
            made.connector(to_action().with(()), vec![from], &to);
        }
    }
    made
}

/// Every action with what is chosen first and last for it, when the robot falls.
fn every_action() -> Made {
    let mut made = Made::default();
    made.stream(&id("fall"), StreamKind::Sensor, "Fall", Some("Fall".to_owned()), Params::new());
    for (at, device) in robot::actuators().enumerate() {
        for (which, params) in [("first", Params::new()), ("last", last(device))] {
            if which == "last" && params.is_empty() {
                continue;
            }
            let to = id(&format!("{which}-{at}"));
            made.stream(&to, StreamKind::Actuator, &format!("{which} {at}"), Some(device.name.to_owned()), params);
            made.connector(to_action().with(()), vec![id("fall")], &to);
        }
    }
    made
}

fn id(text: &str) -> Id {
    Id::new(text).unwrap()
}

/// What stands last in every list of choices, and the largest numbers.
fn last(device: &Device) -> Params {
    let chosen = device.params.iter().filter_map(|param| {
        let value = match param.kind {
            ParamKind::Choice(options) => options.last().map(|option| option.0.into()),
            ParamKind::Number { max, .. } => Some(max.into()),
            ParamKind::Text { .. } => None,
        };
        Some((param.name.to_owned(), value?))
    });
    chosen.collect()
}
