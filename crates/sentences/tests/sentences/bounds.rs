//! Strange graphs and strange texts: nothing panics, nothing takes long.

use crate::dice::Dice;
use crate::graphs::graph;
use crate::said::slip;
use crate::support::{Made, reading, sentences_of, templates};
use behaviour::connectors::{spec, to_action};
use behaviour::{Id, Params, Procedure, StreamKind};
use sentences::Language;
use std::time::{Duration, Instant};

/// Generous for a busy machine and unoptimised code; meant is a hundredth of it.
const LONG: Duration = Duration::from_secs(20);

fn id(at: usize) -> Id {
    Id::new(&format!("s{at}")).unwrap()
}

fn told_in_time(made: &Made) -> Vec<String> {
    let started = Instant::now();
    let told = Language::ALL.map(|language| sentences_of(&made.behaviour, &[], language));
    assert!(started.elapsed() < LONG, "{:?}", started.elapsed());
    told.concat()
}

#[test]
fn two_thousand_streams_are_told_in_time() {
    let mut made = Made::default();
    made.stream(&id(0), StreamKind::Sensor, "Ball", Some("RedBall".to_owned()), Params::new());
    for at in 1..1_000 {
        made.stream(&id(at), StreamKind::Ordinary, &format!("Step {at}"), None, Params::new());
        let operation = spec("map").unwrap().with(Procedure::body("x * 2"));
        made.connector(operation, vec![id(at - 1)], &id(at));
        made.stream(
            &id(1_000 + at),
            StreamKind::Actuator,
            &format!("Say {at}"),
            Some("SayInput".to_owned()),
            Params::new(),
        );
        made.connector(to_action().with(()), vec![id(at)], &id(1_000 + at));
    }
    let told = told_in_time(&made);
    assert_eq!(told.len(), 2 * 999);
    assert!(told[998].starts_with("When “Step 983” has a value, taking `|step983| x * 2`, "), "{}", told[998]);
}

#[test]
fn diamonds_of_diamonds_are_told_in_time() {
    let mut made = Made::default();
    made.stream(&id(0), StreamKind::Sensor, "Ball", Some("RedBall".to_owned()), Params::new());
    for at in 1..60 {
        for (side, word) in [(0, "timestamp"), (1, "distinct"), (2, "merge")] {
            made.stream(&id(3 * at + side), StreamKind::Ordinary, &format!("{word} {at}"), None, Params::new());
        }
        let from = if at == 1 { id(0) } else { id(3 * at - 1) };
        made.connector(spec("timestamp").unwrap().with(()), vec![from.clone()], &id(3 * at));
        made.connector(spec("distinct").unwrap().with(()), vec![from], &id(3 * at + 1));
        made.connector(spec("merge").unwrap().with(()), vec![id(3 * at), id(3 * at + 1)], &id(3 * at + 2));
    }
    made.stream(&id(999), StreamKind::Actuator, "Print", Some("Print".to_owned()), Params::new());
    made.connector(to_action().with(()), vec![id(3 * 59 + 2)], &id(999));
    let told = told_in_time(&made);
    assert!(told[0].chars().count() < 10_000, "{}", told[0]);
}

#[test]
fn what_is_not_finished_has_sentences_too() {
    let mut made = Made::default();
    made.stream(&id(0), StreamKind::Sensor, "Nothing", Some("Teapot".to_owned()), Params::new());
    made.stream(&id(1), StreamKind::Ordinary, "Alone", None, Params::new());
    made.stream(&id(2), StreamKind::Ordinary, "Round", None, Params::new());
    made.stream(&id(3), StreamKind::Actuator, "Odd", Some("Teapot".to_owned()), Params::new());
    made.stream(&id(4), StreamKind::Actuator, "Unfed", Some("Print".to_owned()), Params::new());
    made.connector(spec("combineLatest").unwrap().with(()), vec![], &id(1));
    made.connector(spec("merge").unwrap().with(()), vec![id(2), Id::new("gone").unwrap()], &id(2));
    for from in 0..3 {
        made.connector(to_action().with(()), vec![id(from)], &id(3));
    }
    made.connector(to_action().with(()), vec![], &id(4));
    made.connector(to_action().with(()), vec![id(0)], &Id::new("gone").unwrap());
    let told = told_in_time(&made);
    assert_eq!(told[0], "When “Nothing” has a value, “Odd” gets it.");
    assert_eq!(told[1], "When “Alone” has a value, likewise “Odd” gets it.");
    assert_eq!(told.len(), 6);
}

#[test]
fn strange_texts_are_read_without_a_panic_and_in_time() {
    let mut seeds: Vec<(String, Language)> = Vec::new();
    for template in templates() {
        for language in Language::ALL {
            seeds.push((sentences_of(&template.behaviour, &template.helpers, language).join(" "), language));
        }
    }
    let mut dice = Dice::seeded(7);
    let started = Instant::now();
    for _ in 0..200 {
        let (text, language) = dice.one(&seeds).clone();
        let mut chars: Vec<char> = text.chars().collect();
        slip(&mut dice, &mut chars);
        let text: String = chars.into_iter().collect();
        let read = reading(&text, language, &[]);
        for range in read.doubts.iter().map(|doubt| &doubt.range).chain(read.understood.iter().map(|one| &one.range)) {
            assert!(text.get(range.clone()).is_some(), "{range:?} of {text}");
        }
        assert!(read.doubts.iter().all(|doubt| doubt.suggestions.len() <= 3));
        for connector in &read.draft.connectors {
            assert!(connector.inputs.iter().chain([&connector.output]).all(|at| *at < read.draft.streams.len()));
        }
    }
    assert!(started.elapsed() < 6 * LONG, "{:?}", started.elapsed());
}

#[test]
fn the_worst_texts_take_no_longer_than_others() {
    let open = "(".repeat(2_000);
    let or = "when ".to_owned() + &"the head is touched or ".repeat(60);
    let later = "When the head is touched, ".to_owned() + &"2 seconds later, ".repeat(60);
    let long = "the robot says ".to_owned() + &"a ".repeat(500);
    for text in [open.as_str(), &or, &later, &long, &"頭に触られたか、".repeat(140), &"when ".repeat(200)] {
        for language in Language::ALL {
            let started = Instant::now();
            let read = reading(text, language, &[]);
            assert!(started.elapsed() < LONG, "{:?}: {text}", started.elapsed());
            assert!(!read.doubts.is_empty(), "{text}");
        }
    }
}

#[test]
fn sentences_of_any_graph_are_whole() {
    for seed in 0..300 {
        let made = graph(&mut Dice::seeded(seed));
        for told in Language::ALL.map(|language| sentences_of(&made, &[], language)).concat() {
            assert!(!told.contains(", ,") && !told.contains("、、") && !told.contains("  "), "seed {seed}: {told}");
            assert!(told.ends_with('.') || told.ends_with('。'), "{told}");
        }
    }
}
