//! The meaning of keys on the graph, and on the list in its place. Which of them may be pressed by whom, and how each is called,
//! stands in the list of commands.

use crate::graph::StepDirection;
use crate::{Editor, Selected};
use std::collections::BTreeSet;

/// The signs that the program knows, whichever key they stand on.
const SIGNS: &str = "+-=";

/// A key that was pressed, by what is written on it, and where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct KeyPress<'a> {
    /// The letter or word that is written on it.
    pub key: &'a str,
    /// True while Shift is held.
    pub shift: bool,
    /// True where a button has the keyboard: Enter, blanks and some arrows are its own then.
    pub on_button: bool,
}

/// The meaning of a key on the graph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GraphKey {
    /// Begins a wire out of a stream.
    Connect,
    /// Begins a note.
    AddNote,
    /// Folds or unfolds the group.
    Fold,
    /// Offers what could stand before it.
    InsertBefore,
    /// Shows what runs over time.
    OverTime,
    /// Another name.
    Rename,
    /// Opens the editor.
    Open,
    /// Chooses one thing more, or one less.
    ChooseToo,
    /// Selects it alone.
    Select,
    /// Removes what is chosen.
    Remove,
    /// Goes on that way; with `more` what is there is chosen too.
    Walk {
        /// The way.
        way: StepDirection,
        /// See above.
        more: bool,
    },
    /// Makes everything larger by this factor.
    Zoom(f64),
    /// Shows everything.
    Fit,
    /// Shows everything in its real size.
    RealSize,
}

/// The meaning of a key with Control or Command on the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GraphChord {
    /// Chooses everything.
    ChooseAll,
    /// Copies what is chosen.
    Copy,
    /// Copies what is chosen and removes it.
    Cut,
    /// Puts in what was copied.
    Paste,
    /// A second one of what is chosen.
    Duplicate,
    /// Makes a group of what is chosen.
    Group,
    /// Takes a group apart.
    Ungroup,
}

/// Returns the name of a key: what it writes, or its place where that is no Latin letter or no digit. `types` says that a
/// modifier makes another sign of it.
#[must_use]
pub fn key_name(key: String, code: &str, shift: bool, types: bool) -> String {
    let letter = code.strip_prefix("Key").filter(|_| !key.is_ascii());
    let is_sign = |key: &str| key.chars().count() == 1 && !key.chars().all(|sign| sign.is_ascii_alphanumeric());
    let digit = code.strip_prefix("Digit").filter(|_| !shift && is_sign(&key) && !SIGNS.contains(&key));
    match letter.or(digit).filter(|_| !types) {
        Some(name) if shift => name.to_owned(),
        Some(name) => name.to_lowercase(),
        None => key,
    }
}

/// Returns the meaning of a key without Control.
#[must_use]
pub fn graph_key(press: KeyPress) -> Option<GraphKey> {
    let KeyPress { key, shift, on_button } = press;
    let walk = |way| Some(GraphKey::Walk { way, more: shift });
    match key {
        "c" | "C" => Some(GraphKey::Connect),
        "n" | "N" => Some(GraphKey::AddNote),
        "f" | "F" => Some(GraphKey::Fold),
        "i" | "I" => Some(GraphKey::InsertBefore),
        "l" | "L" => Some(GraphKey::OverTime),
        "F2" => Some(GraphKey::Rename),
        "ArrowDown" => walk(StepDirection::Down),
        "ArrowUp" => walk(StepDirection::Up),
        "+" | "=" => Some(GraphKey::Zoom(1.25)),
        "-" => Some(GraphKey::Zoom(0.8)),
        "0" => Some(GraphKey::Fit),
        "1" => Some(GraphKey::RealSize),
        _ if on_button => None,
        "Enter" => Some(GraphKey::Open),
        " " if shift => Some(GraphKey::ChooseToo),
        " " => Some(GraphKey::Select),
        "Delete" | "Backspace" => Some(GraphKey::Remove),
        "ArrowLeft" => walk(StepDirection::Left),
        "ArrowRight" => walk(StepDirection::Right),
        _ => None,
    }
}

/// Returns the meaning of a key with Control or Command, for who may edit or only look.
#[must_use]
pub fn graph_chord(key: &str, shift: bool, may_edit: bool) -> Option<GraphChord> {
    match key.to_lowercase().as_str() {
        "a" => Some(GraphChord::ChooseAll),
        "c" => Some(GraphChord::Copy),
        _ if !may_edit => None,
        "x" => Some(GraphChord::Cut),
        "v" => Some(GraphChord::Paste),
        "d" => Some(GraphChord::Duplicate),
        "g" if shift => Some(GraphChord::Ungroup),
        "g" => Some(GraphChord::Group),
        _ => None,
    }
}

/// The use of a press of Escape on the graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EscapeUse {
    /// One looks around by oneself again.
    EndFollowing,
    /// The control of a connector is closed.
    CloseControl,
    /// This is chosen no more, which is nothing to take back.
    ChooseNothing(Option<Selected>),
    /// There was nothing to take back.
    Nothing,
}

impl EscapeUse {
    /// Returns true if the press is used up: then it is none of the two that stop the robot.
    #[must_use]
    pub fn is_used(&self) -> bool {
        match self {
            Self::EndFollowing | Self::CloseControl => true,
            Self::ChooseNothing(_) | Self::Nothing => false,
        }
    }
}

impl Editor {
    /// Escape on the graph takes back one thing.
    pub fn escape(&mut self) -> EscapeUse {
        if self.unfollow() {
            return EscapeUse::EndFollowing;
        }
        let one = (*self.selected).clone();
        if one.is_none() && self.several.is_empty() {
            return EscapeUse::Nothing;
        }
        self.choose(BTreeSet::new());
        match one {
            Some(Selected::Connector(_)) => EscapeUse::CloseControl,
            one => EscapeUse::ChooseNothing(one),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{GraphChord, GraphKey, KeyPress, graph_chord, graph_key, key_name};

    #[test]
    fn a_button_keeps_the_keys_that_press_it() {
        let on = |key, on_button| graph_key(KeyPress { key, shift: false, on_button });
        for key in ["Enter", " ", "Delete", "Backspace", "ArrowLeft", "ArrowRight"] {
            assert!(on(key, false).is_some() && on(key, true).is_none(), "{key}");
        }
        for key in ["c", "N", "ArrowDown", "0"] {
            assert!(on(key, true).is_some(), "{key}");
        }
        assert_eq!(on("Q", false), None);
    }

    #[test]
    fn a_key_is_called_by_its_place_where_it_writes_no_latin_letter() {
        let cases = [
            // What it writes, where it is, with Shift; what it is called.
            ("z", "KeyZ", false, "z"),
            ("Z", "KeyZ", true, "Z"),
            ("я", "KeyZ", false, "z"),
            ("Я", "KeyZ", true, "Z"),
            ("ζ", "KeyZ", false, "z"),
            ("ئ", "KeyZ", false, "z"),
            ("لا", "KeyB", false, "b"),
            ("ז", "KeyZ", false, "z"),
            // French: the letters are Latin and count as written, whichever place they have; digits need no Shift.
            ("a", "KeyQ", false, "a"),
            ("z", "KeyW", false, "z"),
            ("à", "Digit0", false, "0"),
            ("&", "Digit1", false, "1"),
            ("-", "Digit6", false, "-"),
            ("1", "Digit1", true, "1"),
            ("!", "Digit1", true, "!"),
            ("+", "Digit1", false, "+"),
            ("ü", "BracketLeft", false, "ü"),
            ("Enter", "Enter", false, "Enter"),
            (" ", "Space", false, " "),
            ("", "", false, ""),
        ];
        for (key, code, shift, name) in cases {
            assert_eq!(key_name(key.to_owned(), code, shift, false), name, "{key} at {code}");
        }
        assert_eq!(key_name("å".to_owned(), "KeyA", false, true), "å", "a sign of its own, by Option");
    }

    #[test]
    fn shift_chooses_more() {
        let space = |shift| graph_key(KeyPress { key: " ", shift, on_button: false });
        assert_eq!([space(false), space(true)], [Some(GraphKey::Select), Some(GraphKey::ChooseToo)]);
        let down = graph_key(KeyPress { key: "ArrowDown", shift: true, on_button: false });
        assert!(matches!(down, Some(GraphKey::Walk { more: true, .. })));
    }

    #[test]
    fn who_only_looks_copies_and_changes_nothing() {
        let all = ["a", "C", "x", "v", "d", "g", "q"];
        assert_eq!(all.map(|key| graph_chord(key, false, true).is_some()), [true, true, true, true, true, true, false]);
        let looks = all.map(|key| graph_chord(key, false, false));
        let [choose, copy, rest @ ..] = looks;
        assert_eq!([choose, copy], [Some(GraphChord::ChooseAll), Some(GraphChord::Copy)]);
        assert_eq!(rest, [None; 5]);
        assert_eq!(graph_chord("G", true, true), Some(GraphChord::Ungroup));
    }
}
