//! A connector as a control, and the settings of what is selected.

sentences! {
    stream_name_label: "Stream name";
    more_of_it: "More…";
    robot_runs_this: "The robot runs this version.";
}

/// What a slider says: the test, where the value is now, and what becomes of it if that can be told.
pub(crate) fn slider_said(sign: &str, number: &str, now: Option<(String, Option<bool>)>) -> String {
    let test = match sign {
        "<" => say!("less than {number}", number),
        "≤" => say!("at most {number}", number),
        ">" => say!("more than {number}", number),
        "≥" => say!("at least {number}", number),
        "=" => say!("exactly {number}", number),
        _ => say!("not {number}", number),
    };
    match now {
        Some((now, Some(true))) => say!("{test}; now {now}, passes", test, now),
        Some((now, Some(false))) => say!("{test}; now {now}, left out", test, now),
        Some((now, None)) => say!("{test}; now {now}", test, now),
        None => test,
    }
}

/// What the robot has in the place of what was changed.
pub(crate) fn robot_still_uses(what: &str) -> String {
    say!("The robot still uses {what}.", what)
}

/// What holds while somebody else is editing a connector: its number, if it has one.
pub(crate) fn it_is_until(number: Option<&str>, name: &str) -> String {
    match number {
        Some(number) => say!("It is {number} until {name} saves.", number, name),
        None => say!("It stays as it is until {name} saves.", name),
    }
}
