//! Sentences that only the frame of a dialog says.

pub(crate) use crate::words::*;

sentences! {
    silence_means_yes: "No answer for 10 seconds means yes.";
    nobody_edits: "Nobody is editing it any more.";
    text_stays: "Your text stays here until you close.";
    free_text_stays: "Nobody is editing it now. Your text stays here until you close.";
    edit_it: "Edit it";
    go_on_editing: "Go on editing";
    asked_before: "Asked. Somebody asked before you.";
    enough_wait: "Enough people are waiting for it already.";
    yours_now: "You can edit it now.";
    hand_over: "Hand over";
    keep_it: "Keep it";
    still_editing: "Still editing";
    idle_free: "Still editing? It is free for others soon.";
    take_over: "Take over";
    take_it: "Take it over";
    ask_no_more: "Never mind";
    last_moment: "It is handed over in ten seconds. Save what you have; what you wrote stays here.";
}

pub(crate) fn remove_question(name: &str) -> String {
    say!(remove_question: "Remove “{name}”?", name)
}

/// Says who is editing, and what that means meanwhile.
pub(crate) fn is_editing_and(name: &str, meanwhile: &str) -> String {
    say!(is_editing_and: "{name} is editing. {meanwhile}", name, meanwhile)
}

/// Says what one sees of what somebody else is editing.
pub(crate) fn until_saved(name: &str) -> String {
    say!(until_saved: "It is as {name} left it until {name} saves.", name)
}

pub(crate) fn asked_yours_in(seconds: u32) -> String {
    say!(asked_yours_in: "Asked. Yours in {seconds} s.", seconds)
}

pub(crate) fn keeps_for_now(name: &str) -> String {
    say!(keeps_for_now: "{name} keeps it for now.", name)
}

pub(crate) fn ask_again_in(seconds: u32) -> String {
    say!(ask_again_in: "You can ask again in {seconds} s.", seconds)
}

pub(crate) fn would_like_to_edit(name: &str) -> String {
    say!(would_like_to_edit: "{name} would like to edit this.", name)
}

pub(crate) fn free_for_others_in(seconds: u32) -> String {
    say!(free_for_others_in: "Still editing? It is free for others in {seconds} s.", seconds)
}

/// Before one takes what somebody else is editing.
pub(crate) fn take_over_question(name: &str) -> String {
    say!(take_over_question: "{name} cannot save it then; the text stays with {name}. Take it over?", name)
}
