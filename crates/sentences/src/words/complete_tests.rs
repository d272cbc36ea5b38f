//! Every language has words for everything there is to say.

use super::answers::answers;
use super::{device_label, words};
use crate::Language;
use crate::clauses::{ACTIONS, SENSES, SUBJECTS};
use crate::pattern::{grammar, holes};
use behaviour::{StreamKind, connectors};
use robot::ParamKind;
use std::collections::BTreeSet;

#[test]
fn every_sense_and_action_has_words_in_every_language() {
    let clauses: Vec<_> = SENSES.iter().chain(ACTIONS).collect();
    for device in robot::sensors().chain(robot::actuators()) {
        assert!(clauses.iter().any(|clause| clause.device == device.name), "{}", device.name);
        for language in Language::ALL {
            assert!(device_label(device.name, language).is_some(), "{} {language:?}", device.name);
            for param in device.params {
                let ParamKind::Choice(options) = param.kind else { continue };
                let known = words(language).choices(device.name, param.name);
                let missing = options.iter().find(|(value, _)| !known.iter().any(|(known, _)| known == value));
                assert_eq!((missing, known.len()), (None, options.len()), "{}.{}", device.name, param.name);
            }
        }
    }
}

/// Whether nothing that may be chosen for the device is left out by all of its clauses without connectors.
#[test]
fn every_parameter_can_be_told() {
    for device in robot::sensors().chain(robot::actuators()) {
        let plain =
            SENSES.iter().chain(ACTIONS).filter(|clause| clause.device == device.name && clause.parts.is_empty());
        for language in Language::ALL {
            for param in device.params {
                let told = plain.clone().any(|clause| {
                    let holes = holes(grammar(language).told(clause.id));
                    holes.contains(&param.name) || clause.fixed.iter().any(|(name, _)| *name == param.name)
                });
                assert!(told, "{}.{} {language:?}", device.name, param.name);
            }
        }
    }
}

#[test]
fn every_rule_has_words_with_the_same_holes_in_every_language() {
    let [english, japanese] = Language::ALL.map(grammar);
    let clauses = SENSES.iter().chain(ACTIONS).map(|clause| clause.id).chain(SUBJECTS.iter().map(|subject| subject.0));
    let ids = words(Language::English).rules.iter().flat_map(|rules| rules.iter()).map(|(id, _)| *id);
    for id in clauses.chain(ids).filter(|id| !id.ends_with(".then")) {
        let told = [english, japanese].map(|grammar| holes(grammar.told(id)).into_iter().collect::<BTreeSet<_>>());
        assert!(!english.rule(id).is_empty() && !japanese.rule(id).is_empty(), "{id}");
        assert_eq!(told[0], told[1], "{id}");
    }
}

#[test]
fn no_meaning_has_words_twice() {
    for language in Language::ALL {
        let ids: Vec<_> = words(language).rules.iter().flat_map(|rules| rules.iter()).map(|(id, _)| *id).collect();
        assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len(), "{language:?}");
    }
}

#[test]
fn every_field_of_a_sense_has_a_word_of_its_own() {
    for language in Language::ALL {
        let fields = robot::sensors().flat_map(|device| device.shape.fields());
        fields.for_each(|field| assert!(words(language).field(field.name).is_some(), "{}", field.name));
        let says: Vec<_> = words(language).fields.iter().flat_map(|(_, says)| says.iter()).collect();
        assert_eq!(says.iter().collect::<BTreeSet<_>>().len(), says.len(), "{language:?}");
    }
}

#[test]
fn every_connector_is_told_and_made() {
    for spec in connectors::ALL.iter().filter(|spec| !spec.acts()) {
        let (does, _) = crate::does::SpokenConnector::of(&spec.with(()), &["soFar".to_owned(), "x".to_owned()]);
        assert_eq!(does.meaning(), spec.meaning);
        let again = does.operation(&["x".to_owned()], false);
        assert_eq!(again.map(|operation| operation.spec()), Some(*spec));
    }
}

#[test]
fn labels_are_plain_words() {
    let en = Language::English;
    let labels = ["RedBall", "FaceDetection", "SayInput", "SayParameter"].map(|name| device_label(name, en).unwrap());
    assert_eq!(labels, ["Red ball", "Face", "Say the value", "Say a text"]);
    for language in Language::ALL {
        for kind in [StreamKind::Sensor, StreamKind::Actuator] {
            let all = robot::sensors().chain(robot::actuators()).filter(|device| device.kind == kind);
            let labels: Vec<_> = all.map(|device| device_label(device.name, language)).collect();
            assert_eq!(labels.iter().collect::<BTreeSet<_>>().len(), labels.len(), "{labels:?}");
        }
    }
}

#[test]
fn every_answer_has_words_with_the_same_holes_in_every_language() {
    let [english, japanese] = Language::ALL.map(answers);
    assert_eq!(english.len(), japanese.len());
    let holes = |says: &str| {
        let holes = says.split('{').skip(1).filter_map(|from| from.split_once('}')).map(|(hole, _)| hole.to_owned());
        holes.collect::<BTreeSet<String>>()
    };
    for ((id, english), (twin, japanese)) in english.iter().zip(japanese) {
        assert_eq!((id, holes(english)), (twin, holes(japanese)));
    }
}
