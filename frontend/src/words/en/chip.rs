//! A connector as a control, and the settings of what is selected.

sentences! {
    stream_name_label: "Stream name";
    more_of_it: "More…";
    robot_runs_this: "The robot runs this version.";
    apply_all: "Use all changes";
}

pub(crate) fn apply_of(name: &str) -> String {
    say!(apply_of: "Use {name}’s changes", name)
}

/// "Ben changed Close ball: 40 → 60 cm".
pub(crate) fn changed_from(name: &str, of: &str, was: &str, is: &str) -> String {
    say!(changed_from: "{name} changed {of}: {was} → {is}", name, of, was, is)
}

pub(crate) fn changed_it(name: &str, of: &str) -> String {
    say!(changed_it: "{name} changed {of}", name, of)
}

pub(crate) fn added_it(name: &str, of: &str) -> String {
    say!(added_it: "{name} added {of}", name, of)
}

pub(crate) fn removed_of(name: &str, of: &str) -> String {
    say!(removed_of: "{name} removed {of}", name, of)
}

pub(crate) fn still_edits(name: &str, of: &str) -> String {
    say!(still_edits: "{name} is still editing {of}", name, of)
}

/// Why the robot is not told to use what somebody is still at.
pub(crate) fn not_while_edited(name: &str, of: &str) -> String {
    say!(not_while_edited: "{name} is still editing {of}. The robot goes on as before; use the changes when {name} is done.", name, of)
}

/// What a slider says: the test, where the value is now, and what becomes of it if that can be told.
pub(crate) fn slider_said(sign: &str, number: &str, now: Option<(String, Option<bool>)>) -> String {
    let test = match sign {
        "<" => say!(slider_said_less_than: "less than {number}", number),
        "≤" => say!(slider_said_at_most: "at most {number}", number),
        ">" => say!(slider_said_more_than: "more than {number}", number),
        "≥" => say!(slider_said_at_least: "at least {number}", number),
        "=" => say!(slider_said_exactly: "exactly {number}", number),
        _ => say!(slider_said_not: "not {number}", number),
    };
    match now {
        Some((now, Some(true))) => say!(slider_said_now_passes: "{test}; now {now}, passes", test, now),
        Some((now, Some(false))) => say!(slider_said_now_left_out: "{test}; now {now}, left out", test, now),
        Some((now, None)) => say!(slider_said_now: "{test}; now {now}", test, now),
        None => test,
    }
}

/// What the robot has in the place of what was changed.
pub(crate) fn robot_still_uses(what: &str) -> String {
    say!(robot_still_uses: "The robot still uses {what}.", what)
}

/// What holds while somebody else is editing a connector: its number, if it has one.
pub(crate) fn it_is_until(number: Option<&str>, name: &str) -> String {
    match number {
        Some(number) => say!(it_is_until_it_is_until_saves: "It is {number} until {name} saves.", number, name),
        None => say!(it_is_until_it_stays_as_it: "It stays as it is until {name} saves.", name),
    }
}
