//! From sentences back to graphs, and to the same sentences.

use crate::dice::Dice;
use crate::graphs::graph;
use crate::support::{draft_behaviour, reading, same_acting, same_graph, sentences_of, templates};
use behaviour::Helper;
use sentences::{Language, TEXT_MAX_CHARS, language_of};

#[test]
fn templates_are_read_back_as_they_are() {
    for template in templates() {
        for language in Language::ALL {
            let told = sentences_of(&template.behaviour, &template.helpers, language).join(" ");
            let read = reading(&told, language, &template.helpers);
            assert!(read.doubts.is_empty(), "{told}\n{:?}", read.doubts);
            let again = draft_behaviour(&read.draft);
            assert_eq!(sentences_of(&again, &template.helpers, language).join(" "), told);
            assert_eq!(same_graph(&again, &template.behaviour), Ok(()), "{told}");
        }
    }
}

#[test]
fn a_thousand_graphs_are_read_back_as_they_are() {
    let helper =
        |name: &str| Helper { name: name.to_owned(), params: vec![], body: "1".to_owned(), ..Helper::default() };
    let helpers = [helper("my_helper")];
    let (mut tried, mut seed) = (0, 0);
    while tried < 1_000 {
        seed += 1;
        let made = graph(&mut Dice::seeded(seed));
        let told = Language::ALL.map(|language| sentences_of(&made, &helpers, language).join(" "));
        if told.iter().any(|told| told.chars().count() > TEXT_MAX_CHARS) {
            continue;
        }
        tried += 1;
        for (told, language) in told.iter().zip(Language::ALL) {
            assert_eq!(language_of(told), language, "seed {seed}: {told}");
            let read = reading(told, language, &helpers);
            assert!(read.doubts.is_empty(), "seed {seed}: {told}\n{:?}", read.doubts);
            let again = draft_behaviour(&read.draft);
            assert_eq!(&sentences_of(&again, &helpers, language).join(" "), told, "seed {seed}");
            assert_eq!(same_acting(&again, &made), Ok(()), "seed {seed}: {told}");
        }
    }
}
