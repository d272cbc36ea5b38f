//! The page in English.

mod chip;
mod compare;
mod conflicts;
mod editor;
mod groups;
mod history;
mod invite;
mod lists;
mod locks;
mod names;
mod operate;
mod past;
mod people;
mod robots;
mod teaching;
mod tiles;
mod told;
mod warning;

pub(crate) use chip::*;
pub(crate) use compare::*;
pub(crate) use conflicts::*;
pub(crate) use editor::*;
pub(crate) use groups::*;
pub(crate) use history::*;
pub(crate) use invite::*;
pub(crate) use lists::*;
pub(crate) use locks::*;
pub(crate) use names::*;
pub(crate) use operate::*;
pub(crate) use past::*;
pub(crate) use people::*;
pub(crate) use robots::*;
pub(crate) use teaching::*;
pub(crate) use tiles::*;
pub(crate) use told::*;
pub(crate) use warning::*;

use super::language::{fill, label_of, said_by, said_of, shown, shown_within};
use crate::reasons::{NotBrought, Unfilled};
use ::editor::NoAnswer;
use ::editor::graph::Joining;
use behaviour::{Refusal, StreamKind};
use phrase::Phrase;

sentences! {
    whole_value: "Value";
    // Sentences
    what_it_does: "What it does";
    show_sentences: "Show the sentences";
    hide_sentences: "Hide the sentences";
    show_all_sentences: "Show all";
    show_fewer: "Show fewer";
    happens_now: "now";
    title_fails: "a part fails";
    title_offline: "offline";
    title_not_saved: "not saved yet";
    minimap: "The whole graph in small; arrow keys move what is seen";
    make_copy: "Make a copy";
    paste: "Paste";
    open_pasted: "Open what you pasted?";
    pasted_is_whole: "It is a whole program. It opens as a new one; the one that you see now stays as it is.";
    open_as_new: "Open it";
    print: "Print the program";
    remove_this_robot: "Remove the robot";
    no_sentences: "There are no sentences yet: lead a sense to an action first.";
    sentences_shown: "Show or hide the sentences";
    nothing_to_use: "There is nothing to use: the robot runs what you see, or nothing of it.";
    choose_one_stream: "Select a stream first.";
    more_commands: "More that can be done with it";
    choose_sense_first: "Select a sense first; its value is sent as if the robot had sensed it.";
    choose_several_first: "Select several first: Shift and the arrow keys, or Shift and drag around them.";
    copied_with_stream: "A connector is copied with the stream that it leads to. Choose that too.";
    nothing_copied: "Nothing was copied here yet. Ctrl V pastes what was copied elsewhere.";
    did_you_mean: "Did you mean";
    would_add: "Would add";
    add_to_graph: "Add to the graph";
    esc_clears: "clears";
    preview: "Preview";
    also_found: "Also found";
    sentence_example: "When the red ball is nearer than 40 cm, the head follows it.";
    or_say_it: "Or say what it does";
    // The bar
    skip_name: "Main tools";
    untitled: "No program open";
    load_program: "Load program";
    add_program: "Add a program";
    remove_program: "Remove program";
    add_sensor: "Add sensor";
    edit_helper: "Edit helper";
    add_helper: "Add a helper";
    program: "Program";
    menu: "Menu";
    undo: "Undo";
    redo: "Redo";
    rename_program: "Rename the program";
    all_saved: "All changes saved";
    saving: "Saving …";
    connecting: "Connecting …";
    opening: "Opening …";
    not_loaded: "This part of the page could not be loaded. Check the connection and try again.";
    you: "you";
    my_name: "Your name";
    my_name_hint: "The others see it beside your pointer and your edits.";
    no_helpers: "There are no helpers yet.";
    all_programs: "All programs and templates …";
    keys_and_gestures: "Keys and gestures";
    other_language: "日本語 (Japanese)";

    // The left list
    palette_name: "Find or add";
    find_or_add: "Find or add…";
    name_or_sentence: "Name or sentence…";
    senses: "Senses";
    helpers: "Helpers";
    actions: "Actions";
    an_action: "action";
    connect: "Connect";
    duplicate: "Duplicate";
    line_up_row: "Line up in a row";
    line_up_column: "Line up in a column";
    connect_hint: "Connect to another stream (C)";
    add_an_action: "Add an action";
    find_another: "Find another …";
    nothing_like_it: "There is nothing of that name.";
    no_source_yet: "There is no stream yet that could feed it. Add a sense first.";
    insert_here: "Insert here";
    insert_before: "Insert before it";
    remove_with_connectors: "Remove it with its connectors";
    choose_stream_first: "Select a stream to lead it to an action.";

    // The robot
    right_name: "Robot";
    robot: "Robot";
    the_robot: "the robot";
    add_robot: "Add a simulated robot";
    new_robot: "Simulated NAO";
    add_robot_hint: "It has a room of its own, and everybody here can use it.";
    remove_robot_says: "Its room and its order go with it. Programs stay.";
    stop_all_robots: "Stop all robots";
    stop_this_robot: "Stop this robot";
    start: "Start";
    running: "Running";
    was_running: "Was running";
    may_still_move: "It may still be moving.";
    no_answer: "No answer from the server";
    not_recorded: "This run is not recorded.";
    apply: "Use my changes";
    running_together: "Runs on the robot";
    upper_wins: "If they disagree, the upper one wins.";
    stop: "Stop";
    record: "Record the next run";
    end_recording: "End the recording";
    record_now: "Record from now on";
    mark: "Mark";
    mark_hint: "What happens now?";
    marked: "Marked in the recording.";
    recordings: "Recordings";
    open_first: "Open a program to start it.";
    nothing_to_run: "There is nothing in it yet. Add a sense, and lead it to an action.";
    only_watches: "Nothing leads to an action yet: the robot only watches.";
    starts_when_online: "Start works again as soon as this page is connected.";
    runs_this: "The robot runs this version";
    stop_it: "Stop it";
    robot_ready: "ready";
    robot_safe: "stopped, holding safely";
    health_connecting: "connecting";
    health_limited: "works with limits";
    health_lost: "connection lost";

    // The room
    room: "Room";
    room_hint: "Room · drag the ball";
    room_seen: "the robot sees it";
    room_picture: "The robot in its room, seen from above";
    ball_red: "Red ball";
    ball_green: "Green ball";
    ball_blue: "Blue ball";
    ball_other: "Ball";
    person: "Person";
    person_known: "Person it knows";
    move_hint: "Arrow keys move it by 5 centimetres, Page Up and Page Down lift and lower it.";
    touch: "Touch";
    person_in: "Person in";
    person_out: "Person out";
    reset_room: "Reset room";
    reset: "Reset";
    printed: "Shown by the robot";

    // The inspector
    inspector_name: "What is selected";
    inspector_tabs: "What is selected, and problems";
    is_selected: "Selected";
    edit: "Edit";
    remove: "Remove";
    keep: "Keep";
    close: "Close";
    save: "Save";
    select: "Select";
    stimulate: "Send a value";
    last_value: "Last value";
    rate: "Rate";
    carried: "Values so far";
    no_value_yet: "No value yet.";
    starts_to_see: "Press Start to see values.";
    problems: "Problems";
    last_run_failed: "In the last run:";
    last_run: "Last run:";
    not_used_yet: "not used yet";
    runs_before: "Not used yet: the robot still runs it as it was before.";
    no_problems: "Nothing is missing. Press Start when you like.";
    no_problems_now: "Nothing is missing.";
    select_to_edit: "Select a stream or a connector to see more of it.";
    says_ordinary: "Carries what its connector makes.";
    last_inputs: "last inputs";
    result: "result";
    passes: "passes";
    stopped: "left out";

    // The Operation dialog
    operation: "Operation";
    connector: "Connector";
    how_it_works: "How it works";
    how_it_works_less: "Hide how it works";
    how_to_read: "Time runs from left to right. Above is what comes, below is what the connector makes of it.";
    from: "From";
    body: "Procedure";
    write_here: "Write it here";
    use_helper: "Use a helper";
    helper: "Helper";
    procedure: "Procedure";
    parameters: "You can use:";
    output_stream_name: "Output stream name";
    seconds: "seconds";
    seconds_unit: "s";
    no_value: "nothing";
    actuator: "Actuator";
    input_streams: "Input streams, in this order";
    no_fitting_helper: "No helper takes this many values. Write it here, or add a helper.";
    now: "now";
    last: "last";
    for_example: "for example";
    draft_found: "This is your unsaved draft.";
    start_over: "Start over";
    choose_helper: "Choose a helper.";
    write_body: "Write what to do with each value.";
    start_is_no_value: "The value to start from must be a number, a text in quotes, true, false, null, a list or an object.";
    finish_body: "The test is not finished. Write a number after it, such as 20.";
    name_missing: "Give the stream a name.";
    copy_mine: "Copy what I wrote";
    copied: "Copied.";
    gone_close: "What you wrote is still here: copy it, or close.";
    you_removed: "You removed this.";
    somebody_removed: "Somebody removed this.";
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
    copy: "Copy";
    stream_gone: "Somebody removed this stream meanwhile. Close this and choose another one.";
    earlier: "Earlier in the order";

    // A connector as a control
    compared_how: "How it is compared";
    number: "Number";
    less: "Less";
    more: "More";

    // Other dialogs
    edit_ordinary: "Stream settings";
    type_label: "Type";
    name: "Name";
    new_behaviour: "New program";
    create: "Create";
    behaviours: "Programs";
    templates: "Templates";
    no_programs: "There are no programs yet. Begin with a template, or with an empty one.";
    programs: "Programs";
    bin: "Bin";
    shelf: "Show";
    search: "Search …";
    search_programs: "Search in names, streams and procedures";
    order: "Order";
    by_change: "Last changed";
    by_name: "By name";
    whose: "Whose";
    everyones: "Everyone’s";
    mine: "Mine";
    loading_list: "Loading …";
    show_templates: "Show templates";
    clear_search: "Clear the search";
    show_everyones: "Show everyone’s";
    none_mine: "You have not made a program yet.";
    bin_empty: "The bin is empty. What is removed stays here for 30 days.";
    try_again: "Try again";
    restore: "Restore";
    back_to_list: "Back to the list";
    open_program: "Open";
    similar_programs: "Similar programs";
    none_similar: "No other program uses the same senses or actions.";
    open_file: "Open a file …";
    save_file_more: "Save as file …";
    save_file: "Save as file";
    file_json: "Program (JSON)";
    file_json_says: "Everything, to open it again here or elsewhere.";
    file_xml: "Program (XML)";
    file_xml_says: "The same for programs that read XML.";
    file_svg: "Drawing (SVG)";
    file_svg_says: "The graph as a picture, for a report or a wall.";
    file_too_large: "This file is too large to be a program. Choose another one.";
    file_unclear: "The server did not say what became of the file. Look in the list of programs, then try again.";
    drop_here: "Drop the file to open it as a program of its own.";
    all_of_them: "All programs …";
    unreachable: "The server cannot be reached. This is possible again once you are online.";
    to_the_bin: "It goes to the bin for 30 days. Nobody can edit it there.";
    helper_name: "Name";
    helper_params: "Parameters, with commas between them";
    helper_says: "What it is for, in a sentence";
    helper_gives: "What it gives";
    found_out: "found out by itself";
    a_ball: "a ball";
    a_face: "a face";
    used_nowhere: "Nothing uses it.";
    used_in: "Used in";
    this_program: "This program";
    value_json: "Value";
    value_hint: "Sent as if the robot had sensed it, while the program runs.";
    send: "Send";
    value_unreadable: "What stands under More is no value yet. Write it as JSON, or press one of the buttons.";
    as_if: "As if";
    value_is_true: "It is true";
    more_of_value: "More: the value as text";

    // Help
    help_edit_says: "Edit what is selected";
    help_lasso: "Shift and drag, Shift and press";
    help_lasso_says: "choose several";
    by_hand: "By hand";
    view: "View";
    search_commands: "What would you like to do?";
    in_this_program: "In this program";
    nothing_here: "Nothing with these words.";
    no_command: "Nothing is called like that. Try another word.";
    select_all: "Select all";
    cut: "Cut";
    walk_down: "Go down the graph";
    walk_up: "Go up the graph";
    walk_left: "Go to the left";
    walk_right: "Go to the right";
    line_saves: "Enter saves. Shift and Enter begin a new line.";
    text_saves: "Ctrl and Enter save.";
    help_lines: "Enter, Shift Enter";
    help_lines_says: "save a procedure; begin a new line in it";
    help_remove_says: "Remove what is selected";
    help_extend: "Shift and arrow keys, Shift and a click";
    help_extend_says: "select more";
    help_pan: "Drag the paper, wheel, pinch, Ctrl and wheel";
    help_pan_says: "move and zoom the graph";

    // Empty states
    runs_now: "runs now";
    no_programs_yet: "There is no program yet. As soon as somebody makes one, it is here.";
    begin_empty: "Start with an empty program";
    begin_with_sense: "Add a sense to begin";
    begin_says: "What should the robot notice? Everything else follows from it.";
    more_senses: "More senses …";

    // The outline
    outline_name: "The program as a list";
    also_above: "see above";
    more_connectors: "Add a connector";

    // Notices
    notices_name: "Messages";
    dismiss: "Close this message";

    // The canvas
    graph: "The graph";
    to_graph: "To the graph";
    add_connector: "Add connector";
    otherwise: "otherwise";
    zoom_group: "Zoom";
    zoom_in: "Zoom in";
    zoom_out: "Zoom out";
    real_size: "Real size";
    fit: "Show everything";
    tidy: "Tidy";
}

/// Why a form cannot be taken.
/// Many sentences, none of which is shown.
pub(crate) fn sentences_folded(all: usize) -> String {
    say!(sentences_folded: "{all} sentences. Select a part of the graph to read its own.", all)
}

pub(crate) fn in_sentences(name: &str, some: usize, all: usize) -> String {
    say!(in_sentences: "{name} is in {some} of {all} sentences.", name, some, all)
}

pub(crate) fn first_sentences(some: usize, all: usize) -> String {
    say!(first_sentences: "The first {some} of {all} sentences.", some, all)
}

/// The name of something in a sentence that can be changed.
pub(crate) fn change_it(text: &str) -> String {
    say!(change_it: "Change: {text}", text)
}

/// What a sentence says that is not understood; nothing where something is missing.
pub(crate) fn in_doubt(said: String, helpless: bool) -> String {
    match (said.as_str(), helpless) {
        ("", true) => {
            say!(in_doubt_something_is_missing_for: "Something is missing. For example: {sentence_example}", sentence_example = sentence_example())
        }
        ("", false) => say!(in_doubt_something_is_missing_here: "Something is missing here. Did you mean"),
        (said, true) => say!(
            in_doubt_is_not_known_here: "“{said}” is not known here. For example: {sentence_example}",
            said,
            sentence_example = sentence_example()
        ),
        (said, false) => say!(in_doubt_is_not_known_here_2: "“{said}” is not known here. Did you mean", said),
    }
}

/// Where a number was before it was turned.
pub(crate) fn it_was(value: &str) -> String {
    say!(it_was: "was {value}", value)
}

/// The menu of something by its name, or of the ground.
pub(crate) fn menu_of(name: Option<&str>) -> String {
    name.map_or_else(
        || say!(menu_of_what_can_be_done: "What can be done here"),
        |name| say!(menu_of_what_can_be_done_2: "What can be done with {name}", name),
    )
}

pub(crate) fn copy_of(name: &str) -> String {
    say!(copy_of: "Copy of {name}", name)
}

pub(crate) fn copy_made(name: &str) -> String {
    say!(copy_made: "“{name}” is made and open.", name)
}

/// A way to mend a problem, for who cannot see beside which it stands.
pub(crate) fn mend_by(fix: &str) -> String {
    say!(mend_by: "Mend it: {fix}", fix)
}

/// A name in a procedure that means nothing.
pub(crate) fn no_such_name(name: &str) -> String {
    say!(no_such_name: "No “{name}” here.", name)
}

/// Writing another name in its place.
pub(crate) fn use_name(meant: &str) -> String {
    say!(use_name: "Use “{meant}”", meant)
}

/// That a problem was mended, and how.
pub(crate) fn mended(fix: &str) -> String {
    say!(mended: "Mended: {fix}", fix)
}

/// A value with its unit, which never stands alone on a line.
pub(crate) fn with_unit(value: String, unit: &str) -> String {
    if unit.is_empty() { value } else { format!("{value}\u{a0}{unit}") }
}

/// Asks which number is meant, if what was typed may be either of two.
pub(crate) fn two_ways(typed: &str) -> Option<String> {
    let Some(behaviour::TypedNumber::Either(one, other)) = behaviour::typed_number(typed) else { return None };
    let (text, one, other) = (typed.trim(), &*one.to_string(), &*other.to_string());
    Some(say!(two_ways: "“{text}” may be {one} or {other}. Type the one that is meant.", text, one, other))
}

/// What a sense or an action is called.
pub(crate) fn device(device: &robot::Device) -> &'static str {
    label_of(&device.called())
}

pub(crate) fn unfilled(why: &Unfilled) -> String {
    match why {
        Unfilled::Gone => stream_gone().to_owned(),
        Unfilled::Name => name_missing().to_owned(),
        Unfilled::Helper => choose_helper().to_owned(),
        Unfilled::Body => write_body().to_owned(),
        Unfilled::BodyBegun => finish_body().to_owned(),
        Unfilled::Start => start_is_no_value().to_owned(),
        Unfilled::Rate(ms) => told_by(&Refusal::Rate(*ms)),
        Unfilled::TwoWays(said) => said.clone(),
        Unfilled::Label => write_label().to_owned(),
        Unfilled::Word => write_word().to_owned(),
        Unfilled::Sense => choose_sense().to_owned(),
        Unfilled::Value => value_unreadable().to_owned(),
        Unfilled::Param(reason) => whole_sentence(reason),
    }
}

/// A reason with a capital letter and a full stop.
fn whole_sentence(reason: &Phrase) -> String {
    let reason = shown_within(reason);
    let mut rest = reason.chars();
    let first: String = rest.next().into_iter().flat_map(char::to_uppercase).collect();
    say!(whole_sentence: "{why}.", why = format!("{first}{}", rest.as_str()))
}

/// Why there is no answer to what was asked.
pub(crate) fn not_answered(why: &NoAnswer) -> String {
    match why {
        NoAnswer::Refused(no) => told_by(no),
        NoAnswer::Unreachable => unreachable().to_owned(),
    }
}

/// Why a file did not become a program.
pub(crate) fn not_brought(why: &NotBrought) -> String {
    match why {
        NotBrought::TooLarge => file_too_large().to_owned(),
        NotBrought::Unreachable => unreachable().to_owned(),
        NotBrought::Unclear => file_unclear().to_owned(),
        NotBrought::Refused(why) => shown(why),
    }
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

pub(crate) fn last_heard(seconds: u32) -> String {
    say!(last_heard: "Last heard {seconds} s ago.", seconds)
}

pub(crate) fn connected(sent: usize) -> String {
    match sent {
        0 => say!(connected_connected: "Connected."),
        1 => say!(connected_connected_1_change_was: "Connected. 1 change was sent."),
        many => say!(connected_connected_changes_were_sent: "Connected. {many} changes were sent.", many),
    }
}

pub(crate) fn room_as_it_was(seconds: u32) -> String {
    say!(room_as_it_was: "Room · as it was {seconds} s ago", seconds)
}

pub(crate) fn value_ago(value: &str, seconds: u32) -> String {
    say!(value_ago: "{value}, {seconds} s ago", value, seconds)
}

pub(crate) fn last_was(value: &str) -> String {
    say!(last_was: "last {value}", value)
}

/// `1,477`.
pub(crate) fn count(number: u64) -> String {
    let digits = number.to_string();
    let mut written = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            written.push(',');
        }
        written.push(digit);
    }
    written
}

fn times(count_of: u64) -> String {
    if count_of == 1 { say!(times_once: "once") } else { say!(times_times: "{count} times", count = count(count_of)) }
}

/// How often something failed and why, without its name: `Failed 3 times: there is no field y.`
pub(crate) fn failed(faults: u64, why: &Phrase) -> String {
    say!(failed: "Failed {times}: {sentence}", times = times(faults), sentence = sentence(why))
}

/// How often something failed and why, with its name, for the list: `“map” failed 3 times: there is no field y.`
pub(crate) fn named_failed(name: &str, faults: u64, why: &Phrase) -> String {
    say!(named_failed: "“{name}” failed {times}: {sentence}", name, times = times(faults), sentence = sentence(why))
}

/// Said once, when something begins to fail.
pub(crate) fn begins_to_fail(name: &str, why: &Phrase) -> String {
    say!(begins_to_fail: "“{name}” fails: {sentence}", name, sentence = sentence(why))
}

/// Beside the lamp.
pub(crate) fn parts_fail(count: usize) -> String {
    if count == 1 { say!(parts_fail_n1_fails: "1 fails") } else { say!(parts_fail_fail: "{count} fail", count) }
}

fn sentence(why: &Phrase) -> String {
    let why = shown(why);
    if why.ends_with(['.', '!', '?', '。']) { why } else { say!(sentence: "{why}.", why) }
}

/// Somebody else removed what a dialog is about.
pub(crate) fn removed_by(name: &str) -> String {
    say!(removed_by: "{name} removed this.", name)
}

/// While a new program cannot be saved.
pub(crate) fn not_made_yet(name: &str) -> String {
    say!(not_made_yet: "“{name}” cannot be saved just now. It is made as soon as that is possible.", name)
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

/// The robot still runs what there was before the last edits.
pub(crate) fn running_older(runs: u64, edits: u64) -> String {
    if runs == edits {
        say!(running_older_the_robot_runs_an: "The robot runs an older helper")
    } else {
        say!(running_older_the_robot_runs_your: "The robot runs your older version")
    }
}

/// What a connector has done: `147 worked, no errors`.
pub(crate) fn worked(fired: u64, faults: u64) -> String {
    let fired = count(fired);
    match faults {
        0 => say!(worked_worked_no_errors: "{fired} worked, no errors", fired),
        faults => say!(worked_worked_failed: "{fired} worked, {faults} failed", fired, faults = count(faults)),
    }
}

/// The title of what sets a sense, an action or a stream up: `Tracker settings`.
pub(crate) fn settings_of(what: &str) -> String {
    say!(settings_of: "{what} settings", what)
}

/// A part of the body, or what somebody called one.
fn part_of_body(part: &str) -> String {
    said_of(&format!("part.{part}"), part)
}

pub(crate) fn held_by(part: &str, name: &str) -> String {
    let part = part_of_body(part);
    say!(held_by: "The {part} is held by “{name}”.", part, name)
}

pub(crate) fn holds(part: &str, name: &str) -> String {
    let part = part_of_body(part);
    say!(holds: "Holds the {part}; “{name}” waits.", part, name)
}

pub(crate) fn move_up(name: &str) -> String {
    say!(move_up: "Move “{name}” up", name)
}

pub(crate) fn move_down(name: &str) -> String {
    say!(move_down: "Move “{name}” down", name)
}

pub(crate) fn stop_title(name: &str) -> String {
    say!(stop_title: "Stop {name} (Esc Esc)", name)
}

pub(crate) fn robot_named(name: &str) -> String {
    say!(robot_named: "Robot: {name}", name)
}

pub(crate) fn remove_robot(name: &str) -> String {
    say!(remove_robot: "Remove “{name}”", name)
}

pub(crate) fn runs_names(names: &str) -> String {
    say!(runs_names: "runs {names}", names)
}

pub(crate) fn robot_gone(gone: &str, now: &str) -> String {
    say!(robot_gone: "“{gone}” is gone. This page looks at “{now}” now.", gone, now)
}

pub(crate) fn remove_running(robot: &str) -> String {
    say!(remove_running: "It runs on “{robot}”; stop it there first.", robot)
}

pub(crate) fn stop_one(name: &str) -> String {
    say!(stop_one: "Stop “{name}”", name)
}

pub(crate) fn recording_goes(lost: u64, trouble: Option<&Phrase>) -> String {
    match (trouble, lost) {
        (Some(why), _) => {
            say!(recording_goes_the_recording_stopped: "The recording stopped: {why}.", why = shown_within(why))
        }
        (None, 0) => say!(recording_goes_recording: "Recording"),
        (None, lost) => {
            say!(recording_goes_recording_with_gaps_lines: "Recording with gaps, {lost} lines are missing", lost)
        }
    }
}

pub(crate) fn oldest_gave_way(count: u64) -> String {
    say!(oldest_gave_way: "To make room, the oldest recordings were removed: {count}.", count)
}

pub(crate) fn applied(revision: u64) -> String {
    say!(applied: "The robot goes on with version {revision}.", revision)
}

/// A press that waited until what was changed is saved, and did nothing then; `button` is what was pressed.
pub(crate) fn press_given_up(button: &str) -> String {
    say!(
        press_given_up: "{button} waited for your changes to be saved and was given up. Press {button} again once they are saved.",
        button
    )
}

/// Two sentences as one text.
pub(crate) fn one_after_other(first: &str, second: &str) -> String {
    let between = if super::language::is_second() { "" } else { " " };
    format!("{first}{between}{second}")
}

pub(crate) fn other_runs(name: &str) -> String {
    say!(other_runs: "“{name}” is running.", name)
}

pub(crate) fn ended(reason: &Phrase) -> String {
    say!(ended: "It ended by itself: {reason}. Press Start to try again.", reason = shown_within(reason))
}

pub(crate) fn cannot_start(problem: &behaviour::Problem) -> String {
    say!(cannot_start: "It cannot start yet. {problem}", problem = shown(problem))
}

pub(crate) fn robot_lost(reason: &Phrase) -> String {
    // The reason says what to do, or that it comes back by itself.
    say!(robot_lost: "The robot cannot be reached: {reason}.", reason = shown_within(reason))
}

pub(crate) fn remove_question(name: &str) -> String {
    say!(remove_question: "Remove “{name}”?", name)
}

pub(crate) fn uses(count: usize) -> String {
    if count == 1 { say!(uses_n1_use: "1 use") } else { say!(uses_uses: "{count} uses", count) }
}

pub(crate) fn saying(text: &str) -> String {
    say!(saying: "“{text}”", text)
}

pub(crate) fn follows(what: &str) -> String {
    say!(follows: "follows {what}", what = listed(what.split(", ")))
}

/// How far something is, as the open program has it too: in centimetres, else in metres.
pub(crate) fn how_far(metres: f64, in_centimetres: bool) -> String {
    if in_centimetres { format!("{:.0} cm", metres * 100.0) } else { format!("{metres:.2} m") }
}

pub(crate) fn quiet_for(seconds: u64) -> String {
    say!(quiet_for: "quiet for {seconds} s", seconds)
}

pub(crate) fn spelling(written: &str, right: &str) -> String {
    say!(spelling: "Change {written} to {right}", written, right)
}

pub(crate) fn field_of(argument: &str, device: &robot::Device, field: &robot::Field) -> String {
    format!("{argument}.{}: {}", field.name, label_of(&device.field_called(field)))
}

pub(crate) fn trial(given: &str, result: &str) -> String {
    format!("{given} → {result}")
}

pub(crate) fn streams(count: u32) -> String {
    if count == 1 { say!(streams_n1_stream: "1 stream") } else { say!(streams_streams: "{count} streams", count) }
}

pub(crate) fn changed_by(name: &str) -> String {
    say!(changed_by: "last changed by {name}", name)
}

/// How long ago something was, up to six days; none for longer.
pub(crate) fn ago(seconds: u64) -> Option<String> {
    let (minutes, hours, days) = (seconds / 60, seconds / 3_600, seconds / 86_400);
    match (minutes, hours, days) {
        (0, ..) => Some(say!(ago_just_now: "just now")),
        (1, ..) => Some(say!(ago_a_minute_ago: "a minute ago")),
        (many, 0, _) => Some(say!(ago_minutes_ago: "{many} minutes ago", many)),
        (_, 1, _) => Some(say!(ago_an_hour_ago: "an hour ago")),
        (_, many, 0) => Some(say!(ago_hours_ago: "{many} hours ago", many)),
        (.., 1) => Some(say!(ago_yesterday: "yesterday")),
        (.., many @ 2..=6) => Some(say!(ago_days_ago: "{many} days ago", many)),
        _ => None,
    }
}

/// A day that is longer ago.
pub(crate) fn on_day(day: &str) -> String {
    say!(on_day: "on {day}", day)
}

/// What a line of the list says below the name: `Aiko · 6 streams · 2 hours ago`.
pub(crate) fn program_line(owner: &str, count: u32, when: &str, by: &str) -> String {
    let changed = if by == owner || by.is_empty() {
        when.to_owned()
    } else {
        say!(program_line: "changed {when} by {by}", when, by)
    };
    let owner = if owner.is_empty() { String::new() } else { format!("{owner} · ") };
    format!("{owner}{} · {changed}", streams(count))
}

/// What a line of the bin says below the name: `removed 2 hours ago by Aiko · stays 27 more days`.
pub(crate) fn removed_line(when: &str, by: &str, days_left: u64) -> String {
    let left = match days_left {
        0 => say!(removed_line_goes_today: "goes today"),
        1 => say!(removed_line_stays_1_more_day: "stays 1 more day"),
        many => say!(removed_line_stays_more_days: "stays {many} more days", many),
    };
    say!(removed_line_removed_by: "removed {when} by {by} · {left}", when, by, left)
}

pub(crate) fn nothing_fits(words: &str) -> String {
    say!(nothing_fits: "Nothing fits “{words}”.", words)
}

pub(crate) fn more_about(name: &str) -> String {
    say!(more_about: "More about {name}", name)
}

pub(crate) fn restore_named(name: &str) -> String {
    say!(restore_named: "Restore {name}", name)
}

pub(crate) fn is_back(name: &str) -> String {
    say!(is_back: "“{name}” is back among the programs.", name)
}

pub(crate) fn shared_devices(count: u32) -> String {
    if count == 1 {
        say!(shared_devices_n1_sense_or_action: "1 sense or action in common")
    } else {
        say!(shared_devices_senses_and_actions_in: "{count} senses and actions in common", count)
    }
}

/// So many programs were found; perhaps more.
pub(crate) fn programs_found(count: usize, more: bool) -> String {
    match (count, more) {
        (0, _) => say!(programs_found_none_found: "None found"),
        (_, true) => say!(programs_found_found_so_far: "{count} found so far", count),
        (_, false) => say!(programs_found_found: "{count} found", count),
    }
}

pub(crate) fn programs_in_all(count: u64) -> String {
    if count == 1 {
        say!(programs_in_all_n1_program: "1 program")
    } else {
        say!(programs_in_all_programs: "{count} programs", count)
    }
}

/// A helper has another name, and these many programs say it now.
pub(crate) fn helper_renamed(programs: u32) -> String {
    if programs == 1 {
        say!(helper_renamed_renamed_1_program_says: "Renamed. 1 program says the new name now.")
    } else {
        say!(helper_renamed_renamed_programs_say_the: "Renamed. {programs} programs say the new name now.", programs)
    }
}

/// Programs in which somebody was editing just then what uses a helper that has another name now.
pub(crate) fn old_name_stays(names: &str) -> String {
    say!(old_name_stays: "Somebody is editing {names} just now: the old name stays for that too.", names)
}

pub(crate) fn through(helper: &str) -> String {
    say!(through: "through {helper}", helper)
}

pub(crate) fn and_more(count: u64) -> String {
    say!(and_more: "and {count} more", count)
}

/// A pasted text became a program; helpers that differ from those of the same name here have another name now.
pub(crate) fn pasted_opened(name: &str, renamed: &[(String, String)]) -> String {
    let helpers: Vec<_> =
        renamed.iter().map(|(old, new)| say!(pasted_opened_is_here: "{old} is {new} here", old, new)).collect();
    match helpers.len() {
        0 => say!(pasted_opened_was_opened_from_what: "“{name}” was opened from what you pasted.", name),
        _ => {
            say!(pasted_opened_was_opened_helpers_of: "“{name}” was opened. Helpers of other content: {join}.", name, join = listed(&helpers))
        }
    }
}

/// A file became a program; helpers that differ from those of the same name here have another name now.
pub(crate) fn file_opened(name: &str, renamed: &[(String, String)]) -> String {
    let helpers: Vec<_> =
        renamed.iter().map(|(old, new)| say!(file_opened_is_here: "{old} is {new} here", old, new)).collect();
    match helpers.len() {
        0 => say!(file_opened_was_opened_from_the: "“{name}” was opened from the file.", name),
        _ => {
            say!(file_opened_was_opened_from_the_2: "“{name}” was opened from the file. Helpers of other content: {join}.", name, join = listed(&helpers))
        }
    }
}

pub(crate) fn hangs_below(count: usize) -> String {
    say!(hangs_below: "What hangs below: {streams}", streams = streams(u32::try_from(count).unwrap_or(u32::MAX)))
}

pub(crate) fn also_use(action: &str) -> String {
    say!(also_use: "Other programs with {action}", action)
}

pub(crate) fn from_senses(senses: &str) -> String {
    say!(from_senses: "from {senses}", senses)
}

pub(crate) fn has_all(robot: &str) -> String {
    say!(has_all: "{robot} has all the senses and actions it needs.", robot)
}

pub(crate) fn helper_called(name: &str) -> String {
    say!(helper_called: "helper {name}", name)
}

pub(crate) fn is_editing(name: &str) -> String {
    say!(is_editing: "{name} is editing", name)
}

/// `map (1), connector from RedBall to Distance, Yuki is editing`
pub(crate) fn with_editor(what: String, name: Option<&str>) -> String {
    match name {
        Some(name) => listed([what, is_editing(name)]),
        None => what,
    }
}

/// Who is editing, and what that means meanwhile.
pub(crate) fn is_editing_and(name: &str, meanwhile: &str) -> String {
    say!(is_editing_and: "{name} is editing. {meanwhile}", name, meanwhile)
}

/// Said once when somebody begins to edit something.
pub(crate) fn is_editing_this(name: &str, what: &str) -> String {
    say!(is_editing_this: "{name} is editing {what}.", name, what)
}

/// What one sees of what somebody else is editing.
pub(crate) fn until_saved(name: &str) -> String {
    say!(until_saved: "It is as {name} left it until {name} saves.", name)
}

pub(crate) fn ask_person(name: &str) -> String {
    say!(ask_person: "Ask {name}", name)
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

/// The field in which one says what kind of value a helper's argument is.
pub(crate) fn helper_takes(argument: &str) -> String {
    say!(helper_takes: "What “{argument}” is", argument)
}

/// What a helper takes or gives, as one can choose it.
pub(crate) fn declared(declared: behaviour::Declared) -> String {
    use behaviour::Declared;
    match (declared, declared.value_type()) {
        (Declared::Ball, _) => a_ball().to_owned(),
        (Declared::Face, _) => a_face().to_owned(),
        (_, Some(kind)) => told_by(&kind),
        (_, None) => found_out().to_owned(),
    }
}

/// A step that turns a value into another unit: "Convert to m".
pub(crate) fn convert_to(unit: &str) -> String {
    say!(convert_to: "Convert to {unit}", unit)
}

/// What an offer makes of the value first: "converts to m".
pub(crate) fn converts_to(unit: &str) -> String {
    say!(converts_to: "converts to {unit}", unit)
}

/// What an offer does before its own: "Wants m, gets cm: it is converted first.".
pub(crate) fn converts_first(from: &str, to: &str) -> String {
    say!(converts_first: "Wants {to}, gets {from}: it is converted first.", from, to)
}

fn helper_word(name: &str, label: &'static str) -> &'static str {
    said_by(&format!("helper.{name}"), label)
}

/// How a helper is called: what a fresh library has by plain words, others as they were named.
pub(crate) fn helper_name_of(helper: &behaviour::Helper) -> String {
    robot::helper_label(helper).map_or_else(|| helper.name.clone(), |label| helper_word(&helper.name, label).to_owned())
}

/// What the helper of this name is called on a chip: “Distance in m”, its own name for one that somebody made.
pub(crate) fn plain_helper(name: &str) -> String {
    robot::helper_label_of(name).map_or_else(|| name.to_owned(), |label| helper_word(name, label).to_owned())
}

/// A helper in a list: "Distance in m · ball_to_distance (ball)".
pub(crate) fn helper_item(helper: &behaviour::Helper) -> String {
    let technical = format!("{} ({})", helper.name, helper.params.join(", "));
    robot::helper_label(helper)
        .map_or(technical.clone(), |label| format!("{} · {technical}", helper_word(&helper.name, label)))
}

/// Says what a helper does, in a sentence: one that comes with rrp in the language of the page.
pub(crate) fn what_helper_does(helper: &behaviour::Helper) -> String {
    robot::helper_label(helper)
        .map_or_else(|| helper.says.clone(), |_| said_of(&format!("helper.{}.says", helper.name), &helper.says))
}

/// The name of a template, or of a task.
pub(crate) fn template_name(template: &protocol::Summary) -> String {
    said_of(&format!("template.{}", template.id), &template.name)
}

/// Says what a template does, or what one does in a task.
pub(crate) fn template_says(template: &protocol::Summary) -> String {
    said_of(&format!("template.{}.says", template.id), &template.by)
}

/// What was sent to which sense.
pub(crate) fn sent_to(name: &str, value: &str) -> String {
    say!(sent_to: "Sent to {name}: {value}", name, value)
}

/// Something of the catalogue where it stands alone: "Angle to the side in radians".
pub(crate) fn as_label(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().into_iter().flat_map(char::to_uppercase).chain(rest).collect()
}

pub(crate) fn add_named(name: &str) -> String {
    say!(add_named: "Add {name}", name)
}

pub(crate) fn lead_to(name: &str) -> String {
    say!(lead_to: "Lead the selected stream to {name}", name)
}

pub(crate) fn lead_to_existing(name: &str) -> String {
    say!(lead_to_existing: "“{name}”, which is there already", name)
}

pub(crate) fn ball_named(color: &str) -> &'static str {
    match color {
        "red" => ball_red(),
        "green" => ball_green(),
        "blue" => ball_blue(),
        _ => ball_other(),
    }
}

/// A value of a marble example: "5 at 0.3 s".
pub(crate) fn value_at(value: &str, at_ms: u64) -> String {
    say!(value_at: "{value} at {seconds_short}", value, seconds_short = seconds_short(at_ms))
}

/// A lane of a marble example: "Distance: 5 at 0 s, 30 at 0.3 s".
pub(crate) fn lane_tells(name: &str, values: &str) -> String {
    if values.is_empty() { say!(lane_tells: "{name}: nothing", name) } else { titled(name, values) }
}

/// What a marble example gives.
pub(crate) fn comes_out(lane: &str) -> String {
    say!(comes_out: "Out comes {lane}", lane)
}

/// A short time: "0.3 s".
pub(crate) fn seconds_short(ms: u64) -> String {
    say!(seconds_short: "{seconds} s", seconds = ms as f64 / 1_000.0)
}

/// The time written beside a value.
pub(crate) fn at_ms(time: &str) -> String {
    format!("t = {time}")
}

/// How long ago something was printed, in whole seconds.
pub(crate) fn printed_ago(seconds: u64) -> String {
    if seconds < 1 {
        say!(printed_ago_just_now: "just now")
    } else {
        say!(printed_ago_s_ago: "{seconds} s ago", seconds)
    }
}

/// The field for another name.
pub(crate) fn new_name(of: &str) -> String {
    say!(new_name: "New name of {of}", of)
}

/// The title of the page: the program, whether it runs, and what is the matter with it.
pub(crate) fn page_title(program: &str, runs: bool, state: Option<&str>) -> String {
    let program = match state {
        Some(state) if !program.is_empty() => format!("{program} · {state}"),
        Some(state) => state.to_owned(),
        None => program.to_owned(),
    };
    match (program, runs) {
        (none, _) if none.is_empty() => "rrp".to_owned(),
        (program, true) => say!(page_title_rrp: "▶ {program} – rrp", program),
        (program, false) => say!(page_title_rrp_2: "{program} – rrp", program),
    }
}

/// Going to a stream.
pub(crate) fn go_to(name: &str) -> String {
    say!(go_to: "Go to {name}", name)
}

/// So many things are chosen.
pub(crate) fn selected_count(count: usize) -> String {
    say!(selected_count: "{count} selected", count)
}

/// A sign of comparison, for people.
pub(crate) fn sign(sign: &str) -> &'static str {
    match sign {
        "<" => "<",
        "<=" => "≤",
        ">" => ">",
        ">=" => "≥",
        "==" => "=",
        _ => "≠",
    }
}

/// Where a value is now.
pub(crate) fn now_is(value: &str) -> String {
    say!(now_is: "now {value}", value)
}

/// A value that a test lets through.
pub(crate) fn value_passes(value: &str) -> String {
    say!(value_passes: "{value} passes", value)
}

/// A value that a test stops.
pub(crate) fn value_left_out(value: &str) -> String {
    say!(value_left_out: "{value} is left out", value)
}

/// What comes after a stream.
pub(crate) fn after_stream(name: &str) -> String {
    say!(after_stream: "After {name}", name)
}

/// Where a connector can be put in.
pub(crate) fn insert_between(above: &str, connector: &str) -> String {
    say!(insert_between: "Insert between {above} and {connector}", above, connector)
}

/// What a wire of a stream comes to.
pub(crate) fn joining(how: Joining, target: &str) -> String {
    match how {
        Joining::Acts => say!(joining_leads_to: "leads to {target}", target),
        Joining::Feeds => say!(joining_feeds: "feeds {target}", target),
        Joining::Merges => say!(joining_joins_with_what_it: "joins {target} with what it carries", target),
        Joining::Adds => say!(joining_one_more_input_of: "one more input of {target}", target),
        Joining::Replaces => say!(joining_takes_from_it_instead: "{target} takes from it instead", target),
    }
}

/// A wire is held by the keyboard: where it may end, and where it would end now.
pub(crate) fn wire_at(at: usize, count: usize, how: &str) -> String {
    say!(wire_at: "{how}, {at} of {count}", how = capitalised(how), at = at + 1, count)
}

/// The first place that a wire comes to.
pub(crate) fn wire_first_at(from: &str, at: usize, count: usize, how: &str) -> String {
    let first = wire_at(at, count, how);
    match count {
        1 => say!(wire_first_at_connect_1_place: "Connect {from}: 1 place. {first}", from, first),
        _ => say!(wire_first_at_connect_places: "Connect {from}: {count} places. {first}", from, count, first),
    }
}

pub(crate) fn capitalised(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| first.to_uppercase().chain(rest).collect())
}

/// A wire that may end in so many places.
pub(crate) fn wire_begins(from: &str, count: usize) -> String {
    match count {
        1 => say!(wire_begins_connect_1_place_press: "Connect {from}: 1 place. Press an arrow key.", from),
        _ => {
            say!(wire_begins_connect_places_press_an: "Connect {from}: {count} places. Press an arrow key.", from, count)
        }
    }
}

/// A wire that can end nowhere.
pub(crate) fn wire_nowhere(from: &str) -> String {
    say!(wire_nowhere: "{from} is led everywhere already. Drop it on free ground to add something new.", from)
}

/// A stream whose values shall go to another place too.
pub(crate) fn connect_named(name: &str) -> String {
    say!(connect_named: "Connect {name}", name)
}

/// A stream that shall get values.
pub(crate) fn connect_to(name: &str) -> String {
    say!(connect_to: "Connect to {name}", name)
}

/// A stream that can be led nowhere else.
pub(crate) fn leads_everywhere(name: &str) -> String {
    say!(leads_everywhere: "{name} is led everywhere already.", name)
}

/// Removing a stream and joining its way.
pub(crate) fn remove_and_join(above: &str) -> String {
    say!(remove_and_join: "Remove it, and go on from {above}", above)
}

/// How deep a row of the outline stands, for screen readers.
pub(crate) fn level(depth: usize) -> String {
    format!("{} ", say!(level: "Level {depth}:", depth))
}

/// `Head tracker, red ball · head, actuator stream`
pub(crate) fn stream_name(name: &str, what_it_is: &str, kind: StreamKind) -> String {
    let kind = match kind {
        StreamKind::Sensor => said!(stream_name_sensor_stream: "sensor stream"),
        StreamKind::Ordinary => said!(stream_name_stream: "stream"),
        StreamKind::Actuator => said!(stream_name_actuator_stream: "actuator stream"),
    };
    listed([name, what_it_is, kind].into_iter().filter(|part| !part.is_empty()))
}

/// `map (distance), connector from RedBall to Distance`
pub(crate) fn connector_name(words: &str, from: &[String], to: &str) -> String {
    say!(connector_name: "{words}, connector from {join} to {to}", words, join = joined(from), to)
}

pub(crate) fn next_steps(name: &str) -> String {
    say!(next_steps: "Next steps for {name}", name)
}

pub(crate) fn percent(zoom: f64) -> String {
    format!("{:.0} %", zoom * 100.0)
}

#[cfg(test)]
mod tests {
    use super::{ago, connected, count, failed, no_connection, program_line, removed_line};

    #[test]
    fn times_are_said_as_people_say_them() {
        let said = [0, 59, 60, 150, 3_600, 7_300, 86_400, 200_000].map(|seconds| ago(seconds).unwrap());
        let right =
            ["just now", "just now", "a minute ago", "2 minutes ago", "an hour ago", "2 hours ago", "yesterday"];
        assert_eq!(said[..7], right);
        assert_eq!((said[7].as_str(), ago(86_400 * 7)), ("2 days ago", None));
    }

    #[test]
    fn numbers_are_written_in_groups() {
        assert_eq!([0, 999, 1_477, 1_234_567].map(count), ["0", "999", "1,477", "1,234,567"]);
        assert_eq!(failed(1_477, &"there is no field z".into()), "Failed 1,477 times: there is no field z.");
        assert_eq!(failed(1, &"too many steps.".into()), "Failed once: too many steps.");
    }

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
    fn a_line_names_a_person_once() {
        assert_eq!(program_line("Aiko", 1, "just now", "Aiko"), "Aiko · 1 stream · just now");
        assert_eq!(program_line("Aiko", 6, "yesterday", "Ben"), "Aiko · 6 streams · changed yesterday by Ben");
        assert_eq!(removed_line("yesterday", "Ben", 29), "removed yesterday by Ben · stays 29 more days");
    }
}
