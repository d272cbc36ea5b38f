//! Tests of sentences: derived ones, their holes, and how numbers decide over words.

use crate::{PageLanguage, Phrase, Phrased, Plural, filled, holes, phrase};

#[derive(Debug, Phrased)]
enum Fault {
    #[error("nothing came within {} ms", .0.as_millis())]
    Late(std::time::Duration),
    #[error("{stage} failed: {cause}")]
    Failed { stage: &'static str, cause: Box<Fault> },
    #[error("{0:?} is {1} too many")]
    Many(String, usize),
}

fn japanese(key: &str) -> Option<&'static str> {
    match key {
        "Fault.Failed" => Some("{stage}に失敗しました：{cause}"),
        "Fault.Late" => Some("{0} ミリ秒の間、応答がありませんでした"),
        _ => None,
    }
}

#[test]
fn a_fault_is_said_by_its_key() {
    let fault = Fault::Failed { stage: "TCP", cause: Box::new(Fault::Late(std::time::Duration::from_millis(20))) };
    assert_eq!(fault.to_string(), "TCP failed: nothing came within 20 ms");
    let said = fault.phrase().said(&crate::LANGUAGES[1], &japanese);
    assert_eq!(said, "TCPに失敗しました：20 ミリ秒の間、応答がありませんでした");
    let other = Fault::Many("a {name}".to_owned(), 3).phrase();
    assert_eq!(other.said(&crate::LANGUAGES[1], &japanese), "\"a {name}\" is 3 too many");
    assert_eq!(other.key(), Some("Fault.Many"));
}

#[test]
fn words_in_holes_are_never_read_as_a_sentence() {
    let (by, what) = ("{what}", "Fault.Late");
    let said = phrase!("a.b", "{by} is editing {^what}: {{}} {0}", 1.5);
    assert_eq!(said.to_string(), "{what} is editing Fault.Late: {} 1.5");
}

#[test]
fn numbers_choose_their_words() {
    let text = |many: usize| phrase!("a.c", "{many} {many|change|changes}").to_string();
    assert_eq!([text(0), text(1), text(2)], ["0 changes", "1 change", "2 changes"]);
    let form = |plural: Plural| [0.0, 1.0, 2.0, 5.0, 12.0, 22.0, 1.5].map(|many| plural.form(many));
    assert_eq!(form(Plural::Same), [0; 7]);
    assert_eq!(form(Plural::One), [1, 0, 1, 1, 1, 1, 1]);
    assert_eq!(form(Plural::UpToOne), [0, 0, 1, 1, 1, 1, 1]);
    assert_eq!(form(Plural::Few), [2, 0, 1, 2, 2, 1, 2]);
    let (inner, outer) = (Phrase::from("it fell."), "no.");
    assert_eq!(phrase!("a.g", "{outer} ({.inner}): {^.inner}!").to_string(), "no. (it fell): It fell!");
    assert_eq!(holes("{many} {many|a|b} {^what}"), ["many", "many", "what"]);
    assert_eq!(filled("{ {no}", &PageLanguage::ENGLISH, &|_| None), "{ {no}");
}

#[test]
fn words_are_read_as_they_were_written() {
    let list = vec!["a".to_owned(), "b".to_owned()];
    let all = [phrase!("a.d", "{list} of {many}", many = 2_u64), Phrase::from("as it was"), Phrase::default()];
    for one in all {
        let json = serde_json::to_string(&one).unwrap();
        assert_eq!(serde_json::from_str::<Phrase>(&json).unwrap(), one, "{json}");
    }
    assert_eq!(serde_json::from_str::<Phrase>("\"old words\"").unwrap().to_string(), "old words");
    let newer = r#"{"key":"a.e","english":"new","also":{"key":"x"},"with":{"n":1}}"#;
    assert_eq!(serde_json::from_str::<Phrase>(newer).unwrap().key(), Some("a.e"));
    assert_eq!(phrase!("a.f", "it fell"), Phrase::from("it fell"));
}

/// A label comes from whoever sits at a page: none may keep a server or the pages of others busy.
#[test]
fn a_sentence_that_was_made_to_be_endless_is_cut_and_every_part_counts() {
    let nested = |english: &'static str, times: usize| {
        (0..times).fold(Phrase::from("ha"), |of, _| Phrase::of("a.h", english, vec![("of", of)]))
    };
    let laughs = nested("{of}{of}{of}{of}{of}{of}{of}{of}", 14);
    assert!(laughs.bytes() < 1_000);
    assert_eq!(laughs.to_string().len(), crate::SAID_MAX_BYTES);
    let twice = |_: &str| Some("{of}{of}");
    assert_eq!(nested("", 15).said(&crate::LANGUAGES[1], &twice).len(), crate::SAID_MAX_BYTES);
    let list = Phrase::List(vec![laughs; 3]);
    assert_eq!(list.to_string().len(), crate::SAID_MAX_BYTES);
    assert_eq!(nested("{of}", 200).to_string(), "", "so deep is none of ours");
    assert_eq!(nested("{of}", 12).to_string(), "ha");
    let empty = Phrase::List(vec![Phrase::default(); 1_000]);
    assert!(empty.bytes() > 8_000, "parts without words count too");
}
