//! Sentences that only the frame of the page says.

pub(crate) use crate::words::*;
use behaviour::labels::bare;
use phrase::Phrase;

sentences! {
    skip_name: "Main tools";
    untitled: "No program open";
    menu: "Menu";
    all_saved: "All changes saved";
    saving: "Saving …";
    opening: "Opening …";
    no_helpers: "There are no helpers yet.";
    all_programs: "All programs and templates …";
    right_name: "Robot";
    save_file_more: "Save as file …";
    help_lasso: "Shift and drag, Shift and press";
    help_lasso_says: "choose several";
    by_hand: "By hand";
    search_commands: "What would you like to do?";
    no_command: "Nothing is called like that. Try another word.";
    help_lines: "Enter, Shift Enter";
    help_lines_says: "save a procedure; begin a new line in it";
    help_extend: "Shift and arrow keys, Shift and a click";
    help_extend_says: "select more";
    help_pan: "Drag the paper, wheel, pinch, Ctrl and wheel";
    help_pan_says: "move and zoom the graph";
    notices_name: "Messages";
    other_saved: "All other changes saved";
    show_them: "Show them";
    connection_name: "Connection";
    help_carry: "Drag from the list; with a finger, rest on it first";
    help_carry_says: "A sense where you drop it, an action or a helper after a stream";
    you_look: "You may look";
    you_operate: "You may start and stop";
    revoked_title: "Your invitation has ended";
    revoked_says: "You are no longer connected. What you saved stays. If you still want to take part, ask the person who invited you for a new link.";
    gave_way_title: "Open in other pages";
    gave_way_says: "Too many pages of yours are open: each person has eight at once. This one is no longer connected, and what you saved stays. Close some of the others, then go on here.";
    go_on_here: "Go on here";
}

pub(crate) fn offline(waiting: usize) -> String {
    match waiting {
        0 => say!(offline_offline: "Offline"),
        1 => say!(offline_offline_1_change_waits: "Offline: 1 change waits here"),
        many => say!(offline_offline_changes_wait_here: "Offline: {many} changes wait here", many),
    }
}

/// The banner of a lost link; `runs` says whether something ran on the robot.
pub(crate) fn no_connection(waiting: usize, runs: bool) -> String {
    let waits = match waiting {
        0 => {
            say!(no_connection_no_connection_you_can: "No connection. You can go on; it is sent when the connection is back.")
        }
        1 => {
            say!(no_connection_no_connection_1_change: "No connection. 1 change waits here and is sent when it is back.")
        }
        many => {
            say!(no_connection_no_connection_changes_wait: "No connection. {many} changes wait here and are sent when it is back.", many)
        }
    };
    if runs {
        say!(no_connection_the_robot_goes_on: "{waits} The robot goes on by itself. Stop still tries its own way.", waits)
    } else {
        say!(no_connection_stop_still_tries_its: "{waits} Stop still tries its own way.", waits)
    }
}

pub(crate) fn not_saved(waiting: usize) -> String {
    match waiting {
        0 => say!(not_saved_nothing_can_be_saved: "Nothing can be saved now"),
        1 => say!(not_saved_not_saved_1_change: "Not saved: 1 change waits here"),
        many => say!(not_saved_not_saved_changes_wait: "Not saved: {many} changes wait here", many),
    }
}

pub(crate) fn away_banner(reason: Option<Phrase>, waiting: usize) -> String {
    let not_saved = not_saved(waiting);
    match reason.map(|reason| shown_within(&reason)) {
        Some(reason) => {
            say!(away_banner_you_can_go_on: "{not_saved} ({reason}). You can go on; it is saved as soon as that is possible.", not_saved, reason)
        }
        None => {
            say!(away_banner_you_can_go_on_2: "{not_saved}. You can go on; it is saved as soon as that is possible.", not_saved)
        }
    }
}

/// Said once when somebody begins to edit something.
pub(crate) fn is_editing_this(name: &str, what: &str) -> String {
    say!(is_editing_this: "{name} is editing {what}.", name, what)
}

/// The tooltip of undo or redo: `Undo: Add map`.
pub(crate) fn step_title(word: &str, label: Option<&Phrase>) -> String {
    label.map_or_else(
        || word.to_owned(),
        |label| say!(step_title: "{word}: {label}", word, label = label_said(&bare(label))),
    )
}

#[cfg(test)]
mod tests {
    use super::{connected, no_connection, step_title};

    #[test]
    fn a_lost_link_promises_nothing_of_a_robot_that_rests() {
        assert!(
            no_connection(2, true).contains("2 changes wait here and are sent")
                && no_connection(0, true).contains("goes on by itself")
        );
        assert!(!no_connection(1, false).contains("robot"));
        assert_eq!(
            [0, 1, 2].map(connected),
            ["Connected.", "Connected. 1 change was sent.", "Connected. 2 changes were sent."]
        );
    }

    #[test]
    fn a_step_is_named_by_what_it_takes_back() {
        assert_eq!(step_title("Undo", Some(&"Undo: Move".into())), "Undo: Move");
    }
}
