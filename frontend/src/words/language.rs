//! In which language the page speaks, and its catalogue of the second one.
//!
//! Every sentence has a key: its English stands where it is used (`en.rs`, and a `words.rs` beside a view), and another language
//! is one file (`static/ja.txt`), fetched before the page starts and only where it is chosen: blocks with an empty line between,
//! the key first, then the sentence. Its holes (`{name}`) have the same names in both. What the server, the rules and the robots
//! say comes as a [`Phrase`] with its key, and words of people stay as they are: nothing is found by its English.

use phrase::{Catalogue, Label, PageLanguage, Phrase, Phrased, filled, key_of};
use std::cell::{Cell, OnceCell};
use std::fmt::Display;

thread_local! {
    static TABLE: OnceCell<Catalogue> = const { OnceCell::new() };
    /// True while something is said in English for who looks for it by that.
    static IN_ENGLISH: Cell<bool> = const { Cell::new(false) };
}

/// Says something in English, for finding it by its English name too.
pub(crate) fn in_english<T>(say: impl FnOnce() -> T) -> T {
    IN_ENGLISH.set(true);
    let said = say();
    IN_ENGLISH.set(false);
    said
}

/// Begins to speak the language of this catalogue. It counts once, before anything is shown.
pub(crate) fn speak(text: String) {
    TABLE.with(|table| {
        let _ = table.set(Catalogue::read(text.leak()));
    });
}

/// The language of the page.
pub(crate) fn spoken() -> &'static PageLanguage {
    TABLE.with(|table| table.get().map_or(&PageLanguage::ENGLISH, Catalogue::language))
}

/// True if the page speaks a second language.
pub(crate) fn is_second() -> bool {
    TABLE.with(|table| table.get().is_some())
}

/// The sentence of a key in the second language, if that is spoken and has it.
fn told(key: u32) -> Option<&'static str> {
    TABLE.with(|table| table.get().filter(|_| !IN_ENGLISH.get())?.told(key))
}

/// The sentence of a key; its English where the language lacks it.
pub(crate) fn keyed(key: u32, english: &'static str) -> &'static str {
    told(key).unwrap_or(english)
}

/// The sentence of a key that is made while the page runs: of something in a list.
pub(crate) fn said_by(key: &str, english: &'static str) -> &'static str {
    keyed(key_of(key), english)
}

/// The same for an English that came from elsewhere.
pub(crate) fn said_of(key: &str, english: &str) -> String {
    told(key_of(key)).unwrap_or(english).to_owned()
}

/// The words on something of a list.
pub(crate) fn label_of(label: &Label) -> &'static str {
    said_by(&label.key, label.english)
}

/// A sentence with its holes filled.
pub(crate) fn fill_keyed(key: u32, english: &'static str, holes: &[(&str, &dyn Display)]) -> String {
    let own = told(key);
    let language = if own.is_some() { spoken() } else { &PageLanguage::ENGLISH };
    fill_in(own.unwrap_or(english), language, holes)
}

/// A text with its holes filled.
pub(super) fn fill(text: &str, holes: &[(&str, &dyn Display)]) -> String {
    fill_in(text, spoken(), holes)
}

fn fill_in(text: &str, language: &PageLanguage, holes: &[(&str, &dyn Display)]) -> String {
    filled(text, language, &|name| {
        holes.iter().find(|(hole, _)| *hole == name).map(|(_, value)| (value.to_string(), None))
    })
}

/// Says a refusal, a fault, a problem or the words of a robot.
pub(crate) fn shown(what: &impl Phrased) -> String {
    say(&what.phrase())
}

fn say(what: &Phrase) -> String {
    what.said(spoken(), &|key| told(key_of(key)))
}

/// The same without its full stop, for the middle of a sentence.
pub(crate) fn shown_within(what: &impl Phrased) -> String {
    shown(what).trim_end_matches(['.', '。']).to_owned()
}

#[cfg(test)]
mod tests {
    use super::{TABLE, fill_keyed, is_second, keyed, label_of, said_of, shown, speak};
    use crate::history::words as history;
    use crate::words;
    use phrase::{Catalogue, PageLanguage, key_of, phrase};

    /// A third language: this line, and its file.
    static GERMAN: PageLanguage =
        phrase::language!("de", "de", "Deutsch", "Diese Seite auf Deutsch", One, ", ", "Sonst");
    const GERMAN_TEXTS: &str = include_str!("../../../tests/languages/de.txt");

    #[test]
    fn a_third_language_is_one_file_and_one_line_and_english_stands_in_for_what_it_lacks() {
        TABLE.with(|table| table.set(Catalogue::of(&GERMAN, GERMAN_TEXTS)).unwrap());
        assert_eq!((words::start(), history::history()), ("Start", "Verlauf"));
        assert_eq!(words::saying("Ball"), "„Ball“");
        assert_eq!(history::needs_connection(), "This needs the connection.");
        let locked = behaviour::Refusal::Locked { what: phrase!("this.note", "this note"), by: "Ben".to_owned() };
        assert_eq!(shown(&locked), "Ben bearbeitet gerade diese Notiz.");
        let many = |many: usize| shown(&behaviour::Refusal::Edits(many));
        assert_eq!(many(1), "1 Änderung auf einmal ist zu viel.");
        assert_eq!(many(9), "9 Änderungen auf einmal sind zu viel.");
        assert_eq!(shown(&behaviour::Refusal::Gone), "This program was removed. Open another one.");
    }

    const TEXTS: &str = "# ja\n\nstart\n開始\n\nRefusal.Locked\n{by} さんが{what}を編集中です。\n\nconnector.filter\n条件\n\nheld\n{name} が{part}を使用中\n";

    #[test]
    fn a_second_language_is_a_catalogue() {
        assert_eq!(keyed(key_of("start"), "Start"), "Start");
        assert!(!is_second());
        speak(TEXTS.to_owned());
        assert!(is_second());
        assert_eq!((keyed(key_of("start"), "Start"), keyed(key_of("stop"), "Stop")), ("開始", "Stop"));
        let held = fill_keyed(key_of("held"), "{part} is held by {name}", &[("part", &"{name}"), ("name", &"Aiko")]);
        assert_eq!(held, "Aiko が{name}を使用中");
        let filter = behaviour::connectors::filter::SPEC.called_by_people();
        assert_eq!((label_of(&filter), said_of("nobody.knows", "start").as_str()), ("条件", "start"));
    }

    #[test]
    fn what_others_say_is_found_by_its_key_alone() {
        speak(TEXTS.to_owned());
        let what = behaviour::connectors::filter::SPEC.called_by_people();
        let locked = phrase!("Refusal.Locked", "{by} is editing {what}. Ask, or wait until it is free.", by = "start");
        assert_eq!(shown(&locked), "start さんが条件を編集中です。");
        assert_eq!(shown(&"start"), "start", "the words of a person");
        assert_eq!(shown(&phrase!("nobody.knows", "{what} of nobody")), "条件 of nobody");
    }
}
