//! The page in English.

mod conflicts;
mod groups;
mod history;
mod invite;
mod lists;
mod names;
mod operate;
mod past;
mod people;
mod robots;
mod told;

pub(crate) use conflicts::*;
pub(crate) use groups::*;
pub(crate) use history::*;
pub(crate) use invite::*;
pub(crate) use lists::*;
pub(crate) use names::*;
pub(crate) use operate::*;
pub(crate) use past::*;
pub(crate) use people::*;
pub(crate) use robots::*;
pub(crate) use told::*;

use super::language::{label_of, said_by, said_of, shown, shown_within};
use crate::reasons::{NotBrought, Unfilled};
use behaviour::Refusal;
use editor::NoAnswer;
use editor::graph::Joining;
use phrase::Phrase;

sentences! {
    // Sentences
    what_it_does: "What it does";
    happens_now: "now";
    title_fails: "a part fails";
    title_offline: "offline";
    title_not_saved: "not saved yet";
    make_copy: "Make a copy";
    paste: "Paste";
    print: "Print the program";
    remove_this_robot: "Remove the robot";
    no_sentences: "There are no sentences yet: lead a sense to an action first.";
    sentences_shown: "Show or hide the sentences";
    nothing_to_use: "There is nothing to use: the robot runs what you see, or nothing of it.";
    choose_one_stream: "Select a stream first.";
    choose_sense_first: "Select a sense first; its value is sent as if the robot had sensed it.";
    choose_several_first: "Select several first: Shift and the arrow keys, or Shift and drag around them.";
    sentence_example: "When the red ball is nearer than 40 cm, the head follows it.";
    // The bar
    load_program: "Load program";
    add_program: "Add a program";
    remove_program: "Remove program";
    add_sensor: "Add sensor";
    edit_helper: "Edit helper";
    add_helper: "Add a helper";
    program: "Program";
    undo: "Undo";
    redo: "Redo";
    rename_program: "Rename the program";
    connecting: "Connecting …";
    not_loaded: "This part of the page could not be loaded. Check the connection and try again.";
    my_name: "Your name";
    keys_and_gestures: "Keys and gestures";
    other_language: "日本語 (Japanese)";
    // The left list
    palette_name: "Find or add";
    find_or_add: "Find or add…";
    an_action: "action";
    connect: "Connect";
    duplicate: "Duplicate";
    line_up_row: "Line up in a row";
    line_up_column: "Line up in a column";
    add_an_action: "Add an action";
    find_another: "Find another …";
    nothing_like_it: "There is nothing of that name.";
    insert_here: "Insert here";
    insert_before: "Insert before it";
    remove_with_connectors: "Remove it with its connectors";
    // The robot
    robot: "Robot";
    the_robot: "the robot";
    add_robot: "Add a simulated robot";
    stop_all_robots: "Stop all robots";
    stop_this_robot: "Stop this robot";
    start: "Start";
    running: "Running";
    was_running: "Was running";
    no_answer: "No answer from the server";
    apply: "Use my changes";
    record: "Record the next run";
    end_recording: "End the recording";
    record_now: "Record from now on";
    mark: "Mark";
    marked: "Marked in the recording.";
    recordings: "Recordings";
    open_first: "Open a program to start it.";
    nothing_to_run: "There is nothing in it yet. Add a sense, and lead it to an action.";
    starts_when_online: "Start works again as soon as this page is connected.";
    robot_ready: "ready";
    robot_safe: "stopped, holding safely";
    health_connecting: "connecting";
    health_limited: "works with limits";
    health_lost: "connection lost";
    // The room
    room: "Room";
    // The inspector
    edit: "Edit";
    remove: "Remove";
    keep: "Keep";
    close: "Close";
    save: "Save";
    select: "Select";
    stimulate: "Send a value";
    problems: "Problems";
    last_run_failed: "In the last run:";
    not_used_yet: "not used yet";
    // The Operation dialog
    seconds_unit: "s";
    no_value: "nothing";
    choose_helper: "Choose a helper.";
    write_body: "Write what to do with each value.";
    start_is_no_value: "The value to start from must be a number, a text in quotes, true, false, null, a list or an object.";
    finish_body: "The test is not finished. Write a number after it, such as 20.";
    name_missing: "Give the stream a name.";
    copied: "Copied.";
    copy: "Copy";
    stream_gone: "Somebody removed this stream meanwhile. Close this and choose another one.";
    // A connector as a control
    number: "Number";
    less: "Less";
    more: "More";
    // Other dialogs
    name: "Name";
    create: "Create";
    templates: "Templates";
    try_again: "Try again";
    open_file: "Open a file …";
    save_file: "Save as file";
    file_too_large: "This file is too large to be a program. Choose another one.";
    file_unclear: "The server did not say what became of the file. Look in the list of programs, then try again.";
    unreachable: "The server cannot be reached. This is possible again once you are online.";
    value_unreadable: "What stands under More is no value yet. Write it as JSON, or press one of the buttons.";
    // Help
    help_edit_says: "Edit what is selected";
    view: "View";
    in_this_program: "In this program";
    select_all: "Select all";
    cut: "Cut";
    walk_down: "Go down the graph";
    walk_up: "Go up the graph";
    walk_left: "Go to the left";
    walk_right: "Go to the right";
    line_saves: "Enter saves. Shift and Enter begin a new line.";
    text_saves: "Ctrl and Enter save.";
    help_remove_says: "Remove what is selected";
    // Notices
    dismiss: "Close this message";
    // The canvas
    graph: "The graph";
    add_connector: "Add connector";
    otherwise: "otherwise";
    zoom_in: "Zoom in";
    zoom_out: "Zoom out";
    real_size: "Real size";
    fit: "Show everything";
    tidy: "Tidy";
    // Learning
    try_it: "Try it";
    show_exercise: "Show the task";
    no_exercise: "This program is no task. Tasks are in the library, below the templates.";
    take_tour: "Take the tour";
    // The tiles of the operator’s page
    edit_tiles: "Tiles of the operator’s page";
    mark_moment: "a moment";
    mark_span: "a span; a second press ends it";
    write_label: "Write the words that the tile shows.";
    write_word: "Write the word that the tile marks with.";
    choose_sense: "Choose the sense that the tile pretends.";
}

/// Says why the robot is not told to use what somebody is still at.
pub(crate) fn not_while_edited(name: &str, of: &str) -> String {
    say!(not_while_edited: "{name} is still editing {of}. The robot goes on as before; use the changes when {name} is done.", name, of)
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

/// Says why a form cannot be taken.
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

pub(crate) fn connected(sent: usize) -> String {
    match sent {
        0 => say!(connected_connected: "Connected."),
        1 => say!(connected_connected_1_change_was: "Connected. 1 change was sent."),
        many => say!(connected_connected_changes_were_sent: "Connected. {many} changes were sent.", many),
    }
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

pub(crate) fn sentence(why: &Phrase) -> String {
    let why = shown(why);
    if why.ends_with(['.', '!', '?', '。']) { why } else { say!(sentence: "{why}.", why) }
}

/// While a new program cannot be saved.
pub(crate) fn not_made_yet(name: &str) -> String {
    say!(not_made_yet: "“{name}” cannot be saved just now. It is made as soon as that is possible.", name)
}

/// A part of the body, or what somebody called one.
pub(crate) fn part_of_body(part: &str) -> String {
    said_of(&format!("part.{part}"), part)
}

pub(crate) fn held_by(part: &str, name: &str) -> String {
    let part = part_of_body(part);
    say!(held_by: "The {part} is held by “{name}”.", part, name)
}

pub(crate) fn stop_title(name: &str) -> String {
    say!(stop_title: "Stop {name} (Esc Esc)", name)
}

pub(crate) fn robot_gone(gone: &str, now: &str) -> String {
    say!(robot_gone: "“{gone}” is gone. This page looks at “{now}” now.", gone, now)
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

pub(crate) fn cannot_start(problem: &behaviour::Problem) -> String {
    say!(cannot_start: "It cannot start yet. {problem}", problem = shown(problem))
}

pub(crate) fn robot_lost(reason: &Phrase) -> String {
    // The reason says what to do, or that it comes back by itself.
    say!(robot_lost: "The robot cannot be reached: {reason}.", reason = shown_within(reason))
}

pub(crate) fn saying(text: &str) -> String {
    say!(saying: "“{text}”", text)
}

pub(crate) fn quiet_for(seconds: u64) -> String {
    say!(quiet_for: "quiet for {seconds} s", seconds)
}

pub(crate) fn streams(count: u32) -> String {
    if count == 1 { say!(streams_n1_stream: "1 stream") } else { say!(streams_streams: "{count} streams", count) }
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

pub(crate) fn is_back(name: &str) -> String {
    say!(is_back: "“{name}” is back among the programs.", name)
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

pub(crate) fn ask_person(name: &str) -> String {
    say!(ask_person: "Ask {name}", name)
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

pub(crate) fn add_named(name: &str) -> String {
    say!(add_named: "Add {name}", name)
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

/// So many things are chosen.
pub(crate) fn selected_count(count: usize) -> String {
    say!(selected_count: "{count} selected", count)
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

pub(crate) fn capitalised(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| first.to_uppercase().chain(rest).collect())
}

/// Removing a stream and joining its way.
pub(crate) fn remove_and_join(above: &str) -> String {
    say!(remove_and_join: "Remove it, and go on from {above}", above)
}

pub(crate) fn next_steps(name: &str) -> String {
    say!(next_steps: "Next steps for {name}", name)
}

#[cfg(test)]
mod tests {
    use super::{ago, count, failed};

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
}
