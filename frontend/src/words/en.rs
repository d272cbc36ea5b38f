//! The page in English.

mod conflicts;
mod history;
mod invite;
mod locks;
mod people;
mod robots;

pub(crate) use conflicts::*;
pub(crate) use history::*;
pub(crate) use invite::*;
pub(crate) use locks::*;
pub(crate) use people::*;
pub(crate) use robots::*;

use crate::desk::NotBrought;
use crate::fields::Unfilled;
use crate::link::NoAnswer;
use behaviour::{Refusal, StreamKind};

sentences! {
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
    you: "you";
    my_name: "Your name";
    my_name_hint: "The others see it beside your pointer and your edits.";
    no_helpers: "There are no helpers yet.";
    all_programs: "All programs and templates …";
    keys_and_gestures: "Keys and gestures";

    // The left list
    palette_name: "Find or add";
    find_or_add: "Find or add…";
    senses: "Senses";
    helpers: "Helpers";
    actions: "Actions";
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
    start: "Start";
    running: "Running";
    was_running: "Was running";
    may_still_move: "It may still be moving.";
    no_answer: "No answer from the server";
    not_recorded: "This run is not recorded.";
    apply: "Apply to the running robot";
    running_together: "Runs on the robot";
    upper_wins: "If they disagree, the upper one wins.";
    stop: "Stop";
    record: "Record the next run";
    end_recording: "End the recording";
    mark: "Mark";
    mark_hint: "What happens now?";
    marked: "Marked in the recording.";
    recordings: "Recordings";
    no_recordings: "Nothing was recorded yet.";
    open_first: "Open a program to start it.";
    starts_when_online: "Start works again as soon as this page is connected.";
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
    edit: "Edit";
    remove: "Remove";
    close: "Close";
    save: "Save";
    select: "Select";
    stimulate: "Send a value";
    last_value: "Last value";
    rate: "Rate";
    carried: "Values so far";
    fired: "Passed on";
    faults: "Failed";
    no_value_yet: "No value yet.";
    starts_to_see: "Press Start to see values.";
    problems: "Problems";
    last_run_failed: "In the last run:";
    last_run: "Last run: ";
    not_used_yet: "not used yet";
    runs_before: "Not used yet: the robot still runs it as it was before.";
    no_problems: "Nothing is missing. Press Start when you like.";
    no_problems_now: "Nothing is missing.";
    select_to_edit: "Select a stream or a connector to see more of it.";
    says_ordinary: "Carries what its connector makes.";
    last_inputs: "last inputs";
    result: "result";
    passes: "passes";
    stopped: "stopped";

    // The Operation dialog
    operation: "Operation";
    connector: "Connector";
    how_it_works: "How it works";
    how_it_works_less: "Hide how it works";
    how_to_read: "Time runs from left to right. Above is what comes, below is what the connector makes of it.";
    from: "From";
    body: "Body";
    helper: "Helper";
    procedure: "Procedure";
    parameters: "Parameters:";
    output_stream_name: "Output stream name";
    milliseconds: "ms";
    actuator: "Actuator";
    input_streams: "Input streams, in this order";
    no_fitting_helper: "No helper takes this many values. Write a body, or add a helper.";
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

    // Other dialogs
    edit_sensor: "Edit stream sensor";
    edit_actuator: "Edit stream actuator";
    edit_ordinary: "Edit stream";
    type_label: "Type";
    name: "Name";
    new_behaviour: "New behaviour";
    create: "Create";
    behaviours: "Behaviours";
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
    used_nowhere: "Nothing uses it.";
    used_in: "Used in";
    this_program: "This program";
    value_json: "Value";
    value_hint: "Sent as if the robot had sensed it, while the program runs.";
    send: "Send";
    value_unreadable: "This is no value yet. Write it like the example.";

    // Help
    help_stop: "Escape twice";
    help_stop_says: "stops the robot, everywhere on this page";
    help_walk: "Arrow keys";
    help_walk_says: "walk along the graph";
    help_edit: "Enter";
    help_edit_says: "edits what is selected";
    help_lines: "Enter, Shift Enter";
    help_lines_says: "save a procedure, begin a new line in it";
    help_remove: "Delete";
    help_remove_says: "removes it; undo brings it back";
    help_undo: "Ctrl Z, Ctrl Y";
    help_undo_says: "undo and redo your own changes";
    help_pan: "Drag the paper, pinch or Ctrl and wheel";
    help_pan_says: "move and zoom the graph";

    // Empty states
    library_title: "What shall the robot do?";
    library_says: "Open a program, begin with a template, or start with an empty program.";
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
pub(crate) fn unfilled(why: &Unfilled) -> String {
    match why {
        Unfilled::Gone => stream_gone().to_owned(),
        Unfilled::Name => name_missing().to_owned(),
        Unfilled::Helper => choose_helper().to_owned(),
        Unfilled::Body => write_body().to_owned(),
        Unfilled::BodyBegun => finish_body().to_owned(),
        Unfilled::Start => start_is_no_value().to_owned(),
        Unfilled::Rate(ms) => Refusal::Rate(*ms).to_string(),
        Unfilled::Param(reason) => whole_sentence(reason),
    }
}

/// A reason with a capital letter and a full stop.
fn whole_sentence(reason: &str) -> String {
    let mut rest = reason.chars();
    let first: String = rest.next().into_iter().flat_map(char::to_uppercase).collect();
    format!("{first}{}.", rest.as_str())
}

/// Why there is no answer to what was asked.
pub(crate) fn not_answered(why: &NoAnswer) -> String {
    match why {
        NoAnswer::Refused(no) => no.to_string(),
        NoAnswer::Unreachable => unreachable().to_owned(),
    }
}

/// Why a file did not become a program.
pub(crate) fn not_brought(why: &NotBrought) -> String {
    match why {
        NotBrought::TooLarge => file_too_large().to_owned(),
        NotBrought::Unreachable => unreachable().to_owned(),
        NotBrought::Unclear => file_unclear().to_owned(),
        NotBrought::Refused(said) => said.clone(),
    }
}

pub(crate) fn offline(waiting: usize) -> String {
    match waiting {
        0 => "Offline".to_owned(),
        1 => "Offline: 1 change waits here".to_owned(),
        many => format!("Offline: {many} changes wait here"),
    }
}

/// The banner of a lost link; `runs` says whether something ran on the robot.
pub(crate) fn no_connection(waiting: usize, runs: bool) -> String {
    let waits = match waiting {
        0 => "No connection. You can go on; it is sent when the connection is back.".to_owned(),
        1 => "No connection. 1 change waits here and is sent when it is back.".to_owned(),
        many => format!("No connection. {many} changes wait here and are sent when it is back."),
    };
    let robot = if runs { " The robot goes on by itself." } else { "" };
    format!("{waits}{robot} Stop still tries its own way.")
}

pub(crate) fn last_heard(seconds: u32) -> String {
    format!("Last heard {seconds} s ago.")
}

pub(crate) fn connected(sent: usize) -> String {
    match sent {
        0 => "Connected.".to_owned(),
        1 => "Connected. 1 change was sent.".to_owned(),
        many => format!("Connected. {many} changes were sent."),
    }
}

pub(crate) fn room_as_it_was(seconds: u32) -> String {
    format!("Room · as it was {seconds} s ago")
}

pub(crate) fn value_ago(value: &str, seconds: u32) -> String {
    format!("{value}, {seconds} s ago")
}

pub(crate) fn last_was(value: &str) -> String {
    format!("last {value}")
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
    if count_of == 1 { "once".to_owned() } else { format!("{} times", count(count_of)) }
}

/// How often something failed and why, without its name: `Failed 3 times: there is no field y.`
pub(crate) fn failed(faults: u64, why: &str) -> String {
    format!("Failed {}: {}", times(faults), sentence(why))
}

/// How often something failed and why, with its name, for the list: `“map” failed 3 times: there is no field y.`
pub(crate) fn named_failed(name: &str, faults: u64, why: &str) -> String {
    format!("“{name}” failed {}: {}", times(faults), sentence(why))
}

/// Said once, when something begins to fail.
pub(crate) fn begins_to_fail(name: &str, why: &str) -> String {
    format!("“{name}” fails: {}", sentence(why))
}

/// Beside the lamp.
pub(crate) fn parts_fail(count: usize) -> String {
    if count == 1 { "1 fails".to_owned() } else { format!("{count} fail") }
}

fn sentence(why: &str) -> String {
    let why = why.trim_end();
    if why.ends_with(['.', '!', '?']) { why.to_owned() } else { format!("{why}.") }
}

/// Somebody else removed what a dialog is about.
pub(crate) fn removed_by(name: &str) -> String {
    format!("{name} removed this.")
}

/// While a new program cannot be saved.
pub(crate) fn not_made_yet(name: &str) -> String {
    format!("“{name}” cannot be saved just now. It is made as soon as that is possible.")
}

pub(crate) fn not_saved(waiting: usize) -> String {
    match waiting {
        0 => "Nothing can be saved now".to_owned(),
        1 => "Not saved: 1 change waits here".to_owned(),
        many => format!("Not saved: {many} changes wait here"),
    }
}

pub(crate) fn away_banner(reason: Option<String>, waiting: usize) -> String {
    let reason = reason.map_or_else(String::new, |reason| format!(" ({reason})"));
    format!("{}{reason}. You can go on; it is saved as soon as that is possible.", not_saved(waiting))
}

pub(crate) fn running_older(runs: u64, edits: u64) -> String {
    if runs == edits {
        return format!("Running version {runs}; a helper was edited since");
    }
    format!("Running version {runs}, editing {edits}")
}

pub(crate) fn held_by(part: &str, name: &str) -> String {
    format!("The {part} is held by “{name}”.")
}

pub(crate) fn holds(part: &str, name: &str) -> String {
    format!("Holds the {part}; “{name}” waits.")
}

pub(crate) fn move_up(name: &str) -> String {
    format!("Move “{name}” up")
}

pub(crate) fn move_down(name: &str) -> String {
    format!("Move “{name}” down")
}

pub(crate) fn stop_title(name: &str) -> String {
    format!("Stop {name} (Esc Esc)")
}

pub(crate) fn robot_named(name: &str) -> String {
    format!("Robot: {name}")
}

pub(crate) fn remove_robot(name: &str) -> String {
    format!("Remove “{name}”")
}

pub(crate) fn runs_names(names: &str) -> String {
    format!("runs {names}")
}

pub(crate) fn robot_gone(gone: &str, now: &str) -> String {
    format!("“{gone}” is gone. This page looks at “{now}” now.")
}

pub(crate) fn remove_running(robot: &str) -> String {
    format!("It runs on “{robot}”; stop it there first.")
}

pub(crate) fn stop_one(name: &str) -> String {
    format!("Stop “{name}”")
}

pub(crate) fn recording_goes(lost: u64, trouble: Option<&str>) -> String {
    match (trouble, lost) {
        (Some(why), _) => format!("The recording stopped: {why}."),
        (None, 0) => "Recording".to_owned(),
        (None, lost) => format!("Recording with gaps, {lost} lines are missing"),
    }
}

pub(crate) fn recording_about(robot: &str, began: &str, bytes: u64, cut_off: bool) -> String {
    let (day, time) = began.split_once('T').unwrap_or((began, ""));
    let time = time.get(..5).unwrap_or_default();
    let size = if bytes < 1 << 20 { format!("{} KB", bytes.div_ceil(1 << 10)) } else { format!("{} MB", bytes >> 20) };
    let robot = if robot.is_empty() { String::new() } else { format!("{robot}, ") };
    let end = if cut_off { ", its end is missing" } else { "" };
    format!("{robot}{day} {time}, {size}{end}")
}

pub(crate) fn download_recording(name: &str) -> String {
    format!("Download the recording of {name}")
}

pub(crate) fn applied(revision: u64) -> String {
    format!("The robot goes on with version {revision}.")
}

pub(crate) fn running_here(revision: u64) -> String {
    format!("Running version {revision}")
}

pub(crate) fn other_runs(name: &str) -> String {
    format!("“{name}” is running.")
}

pub(crate) fn ended(reason: &str) -> String {
    format!("It ended by itself: {reason}. Press Start to try again.")
}

pub(crate) fn cannot_start(problem: &str) -> String {
    format!("It cannot start yet. {problem}")
}

pub(crate) fn robot_lost(reason: &str) -> String {
    // The reason says what to do, or that it comes back by itself.
    format!("The robot cannot be reached: {reason}.")
}

pub(crate) fn remove_question(name: &str) -> String {
    format!("Remove “{name}”?")
}

pub(crate) fn uses(count: usize) -> String {
    if count == 1 { "1 use".to_owned() } else { format!("{count} uses") }
}

pub(crate) fn saying(text: &str) -> String {
    format!("“{text}”")
}

pub(crate) fn follows(what: &str) -> String {
    format!("follows {what}")
}

pub(crate) fn metres(distance: f64) -> String {
    format!("{distance:.2} m")
}

pub(crate) fn quiet_for(seconds: u64) -> String {
    format!("quiet for {seconds} s")
}

pub(crate) fn spelling(written: &str, right: &str) -> String {
    format!("Change {written} to {right}")
}

pub(crate) fn field_of(argument: &str, field: &str, says: &str) -> String {
    format!("{argument}.{field}: {says}")
}

pub(crate) fn trial(given: &str, result: &str) -> String {
    format!("{given} → {result}")
}

pub(crate) fn streams(count: u32) -> String {
    if count == 1 { "1 stream".to_owned() } else { format!("{count} streams") }
}

pub(crate) fn changed_by(name: &str) -> String {
    format!("last changed by {name}")
}

/// How long ago something was, up to six days; none for longer.
pub(crate) fn ago(seconds: u64) -> Option<String> {
    let (minutes, hours, days) = (seconds / 60, seconds / 3_600, seconds / 86_400);
    match (minutes, hours, days) {
        (0, ..) => Some("just now".to_owned()),
        (1, ..) => Some("a minute ago".to_owned()),
        (many, 0, _) => Some(format!("{many} minutes ago")),
        (_, 1, _) => Some("an hour ago".to_owned()),
        (_, many, 0) => Some(format!("{many} hours ago")),
        (.., 1) => Some("yesterday".to_owned()),
        (.., many @ 2..=6) => Some(format!("{many} days ago")),
        _ => None,
    }
}

/// A day that is longer ago.
pub(crate) fn on_day(day: &str) -> String {
    format!("on {day}")
}

/// What a line of the list says below the name: `Aiko · 6 streams · 2 hours ago`.
pub(crate) fn program_line(owner: &str, count: u32, when: &str, by: &str) -> String {
    let changed = if by == owner || by.is_empty() { when.to_owned() } else { format!("changed {when} by {by}") };
    let owner = if owner.is_empty() { String::new() } else { format!("{owner} · ") };
    format!("{owner}{} · {changed}", streams(count))
}

/// What a line of the bin says below the name: `removed 2 hours ago by Aiko · stays 27 more days`.
pub(crate) fn removed_line(when: &str, by: &str, days_left: u64) -> String {
    let left = match days_left {
        0 => "goes today".to_owned(),
        1 => "stays 1 more day".to_owned(),
        many => format!("stays {many} more days"),
    };
    format!("removed {when} by {by} · {left}")
}

pub(crate) fn nothing_fits(words: &str) -> String {
    format!("Nothing fits “{words}”.")
}

pub(crate) fn more_about(name: &str) -> String {
    format!("More about {name}")
}

pub(crate) fn restore_named(name: &str) -> String {
    format!("Restore {name}")
}

pub(crate) fn is_back(name: &str) -> String {
    format!("“{name}” is back among the programs.")
}

pub(crate) fn shared_devices(count: u32) -> String {
    if count == 1 { "1 sense or action in common".to_owned() } else { format!("{count} senses and actions in common") }
}

pub(crate) fn programs_in_all(count: u64) -> String {
    if count == 1 { "1 program".to_owned() } else { format!("{count} programs") }
}

pub(crate) fn through(helper: &str) -> String {
    format!("through {helper}")
}

pub(crate) fn and_more(count: u64) -> String {
    format!("and {count} more")
}

/// A file became a program; helpers that differ from those of the same name here have another name now.
pub(crate) fn file_opened(name: &str, renamed: &[(String, String)]) -> String {
    let helpers: Vec<_> = renamed.iter().map(|(old, new)| format!("{old} is {new} here")).collect();
    match helpers.len() {
        0 => format!("“{name}” was opened from the file."),
        _ => format!("“{name}” was opened from the file. Helpers of other content: {}.", helpers.join(", ")),
    }
}

pub(crate) fn hangs_below(count: usize) -> String {
    format!("What hangs below: {}", streams(u32::try_from(count).unwrap_or(u32::MAX)))
}

pub(crate) fn also_use(action: &str) -> String {
    format!("Other programs with {action}")
}

pub(crate) fn from_senses(senses: &str) -> String {
    format!("from {senses}")
}

pub(crate) fn has_all(robot: &str) -> String {
    format!("{robot} has all the senses and actions it needs.")
}

pub(crate) fn helper_called(name: &str) -> String {
    format!("helper {name}")
}

pub(crate) fn is_editing(name: &str) -> String {
    format!("{name} is editing")
}

/// `map (1), connector from RedBall to Distance, Yuki is editing`
pub(crate) fn with_editor(what: String, name: Option<&str>) -> String {
    match name {
        Some(name) => format!("{what}, {}", is_editing(name)),
        None => what,
    }
}

/// Said once when somebody begins to edit something.
pub(crate) fn is_editing_this(name: &str, what: &str) -> String {
    format!("{} {what}.", is_editing(name))
}

/// What one sees of what somebody else is editing.
pub(crate) fn until_saved(name: &str) -> String {
    format!("It is as {name} left it until {name} saves.")
}

pub(crate) fn ask_person(name: &str) -> String {
    format!("Ask {name}")
}

pub(crate) fn asked_yours_in(seconds: u32) -> String {
    format!("Asked. Yours in {seconds} s.")
}

pub(crate) fn keeps_for_now(name: &str) -> String {
    format!("{name} keeps it for now.")
}

pub(crate) fn ask_again_in(seconds: u32) -> String {
    format!("You can ask again in {seconds} s.")
}

pub(crate) fn would_like_to_edit(name: &str) -> String {
    format!("{name} would like to edit this.")
}

pub(crate) fn free_for_others_in(seconds: u32) -> String {
    format!("Still editing? It is free for others in {seconds} s.")
}

pub(crate) fn helper_item(name: &str, params: &str) -> String {
    format!("{name} ({params})")
}

pub(crate) fn example(value: &str) -> String {
    format!("For example {value}")
}

pub(crate) fn add_named(name: &str) -> String {
    format!("Add {name}")
}

pub(crate) fn lead_to(name: &str) -> String {
    format!("Lead the selected stream to {name}")
}

pub(crate) fn lead_to_existing(name: &str) -> String {
    format!("“{name}”, which is there already")
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
    format!("{value} at {}", seconds_short(at_ms))
}

/// A lane of a marble example: "Distance: 5 at 0 s, 30 at 0.3 s".
pub(crate) fn lane_tells(name: &str, values: &str) -> String {
    if values.is_empty() { format!("{name}: nothing") } else { format!("{name}: {values}") }
}

/// What a marble example gives.
pub(crate) fn comes_out(lane: &str) -> String {
    format!("Out comes {lane}")
}

/// A short time: "0.3 s".
pub(crate) fn seconds_short(ms: u64) -> String {
    format!("{} s", ms as f64 / 1_000.0)
}

/// The time written beside a value.
pub(crate) fn at_ms(time: &str) -> String {
    format!("t = {time}")
}

/// A duration: "500 ms", "2 s".
pub(crate) fn duration(ms: u64) -> String {
    if ms.is_multiple_of(1_000) { format!("{} s", ms / 1_000) } else { format!("{ms} ms") }
}

/// How often that is: "every 500 ms", "every second".
pub(crate) fn every(ms: u64) -> String {
    if ms == 1_000 { "every second".to_owned() } else { format!("every {}", duration(ms)) }
}

/// Names of which one is meant: "Red or Green".
pub(crate) fn one_of(names: &[String]) -> String {
    names.join(" or ")
}

/// How deep a row of the outline stands, for screen readers.
pub(crate) fn level(depth: usize) -> String {
    format!("Level {depth}: ")
}

/// `Head tracker, red ball · head, actuator stream`
pub(crate) fn stream_name(name: &str, what_it_is: &str, kind: StreamKind) -> String {
    let kind = match kind {
        StreamKind::Sensor => "sensor stream",
        StreamKind::Ordinary => "stream",
        StreamKind::Actuator => "actuator stream",
    };
    if what_it_is.is_empty() { format!("{name}, {kind}") } else { format!("{name}, {what_it_is}, {kind}") }
}

/// `map (distance), connector from RedBall to Distance`
pub(crate) fn connector_name(words: &str, from: &[String], to: &str) -> String {
    format!("{words}, connector from {} to {to}", from.join(" and "))
}

pub(crate) fn next_steps(name: &str) -> String {
    format!("Next steps for {name}")
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
        assert_eq!(failed(1_477, "there is no field z"), "Failed 1,477 times: there is no field z.");
        assert_eq!(failed(1, "too many steps."), "Failed once: too many steps.");
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
