//! What can be changed in a sentence, and which part of the graph its phrases mean.

use crate::support::templates;
use behaviour::{Behaviour, Id, Procedure};
use sentences::{Language, LiteralPlace, Piece, Sentence, explain};

fn told(name: &str, language: Language) -> (Behaviour, Vec<Sentence>) {
    let template = templates().into_iter().find(|template| template.behaviour.name() == name).unwrap();
    let helpers: Vec<_> = template.helpers.iter().collect();
    let sentences = explain(&template.behaviour, &helpers, &|_| None, language);
    (template.behaviour, sentences)
}

fn literal(at: &LiteralPlace, behaviour: &Behaviour) -> String {
    let LiteralPlace::Body { connector, start, end } = at else { panic!("{at:?}") };
    let Some(Procedure::Body { body, .. }) = behaviour.connector(connector).unwrap().operation.procedure() else {
        panic!()
    };
    body[*start..*end].to_owned()
}

#[test]
fn a_phrase_lights_its_part_and_its_number_is_a_place_in_the_body() {
    for language in Language::ALL {
        let (behaviour, sentences) = told("Track far and close balls", language);
        let phrase = sentences[0].phrases.iter().find(|phrase| phrase.connectors.len() == 2).unwrap();
        assert_eq!(phrase.connectors, ["c1", "c2"].map(|id| Id::new(id).unwrap()));
        assert_eq!(phrase.streams, ["distance", "far"].map(|id| Id::new(id).unwrap()));
        let number =
            phrase.pieces.iter().find_map(|piece| if let Piece::Number(number) = piece { Some(number) } else { None });
        let number = number.unwrap();
        assert_eq!((number.text.as_str(), number.value, number.unit.as_str()), ("0.5 m", 0.5, "m"));
        assert!((number.min, number.max, number.step) == (0.0, 3.0, 0.05));
        assert_eq!(literal(&number.at, &behaviour), "0.5");
        let choice =
            phrase.pieces.iter().find_map(|piece| if let Piece::Choice(choice) = piece { Some(choice) } else { None });
        let choice = choice.unwrap();
        assert_eq!((choice.chosen.as_str(), choice.options.len()), (">=", 4));
        assert_eq!(literal(&choice.at, &behaviour), ">=");
    }
}

#[test]
fn an_action_has_its_choices_and_a_duration_its_number() {
    let (_, sentences) = told("Track far and close balls", Language::English);
    let action = sentences[1].phrases.iter().find(|phrase| phrase.text().contains("follows")).unwrap();
    let choices: Vec<_> =
        action.pieces.iter().filter(|piece| matches!(piece, Piece::Choice(_))).map(Piece::text).collect();
    assert_eq!(choices, ["whole body", "it"]);
    let (_, sentences) = told("Say ball color", Language::English);
    let Piece::Number(second) = &sentences[0].phrases[0].pieces[1] else { panic!("{sentences:?}") };
    assert_eq!((second.text.as_str(), second.value, second.scale), ("second", 1.0, 1_000.0));
}

#[test]
fn sentences_survive_a_journey_as_json() {
    for template in templates() {
        let sentences = explain(&template.behaviour, &[], &|_| None, Language::Japanese);
        let text = serde_json::to_string(&sentences).unwrap();
        assert_eq!(serde_json::from_str::<Vec<Sentence>>(&text).unwrap(), sentences);
    }
}

#[test]
fn units_that_the_caller_knows_are_told() {
    let text = r#"{"format":"rrp-behaviour/1","name":"x","helpers":[],"streams":[
        {"id":"b","kind":"sensor","name":"Ball","device":"RedBall"},{"id":"d","kind":"ordinary","name":"Far"},
        {"id":"f","kind":"ordinary","name":"Near"},{"id":"p","kind":"actuator","name":"Print","device":"Print"}],
        "connectors":[{"id":"c1","type":"map","inputs":["b"],"output":"d","body":"10 / ball.size"},
        {"id":"c2","type":"filter","inputs":["d"],"output":"f","body":"far < 40"},
        {"id":"c3","type":"subscribe","inputs":["f"],"output":"p"}]}"#;
    let file: behaviour::BehaviourFile = serde_json::from_str(text).unwrap();
    let behaviour = file.records(|_| None).unwrap();
    let unit = |id: &Id| (id.as_str() == "d").then(|| "cm".to_owned());
    let told = explain(&behaviour, &[], &unit, Language::English);
    assert_eq!(
        told[0].text(),
        "When the red ball is seen, taking `10 / ball.size`, and it is less than 40 cm, the page shows it."
    );
}
