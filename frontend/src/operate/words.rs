//! Sentences that only the operator’s page says.

pub(crate) use crate::words::*;
use phrase::Phrase;

sentences! {
    operate_name: "What the robot does";
    leave_operate: "Leave the operator’s page";
    time_of_run: "Time of the run";
    run_time: "run";
    charge: "Charge";
    by_cable: "by cable";
    link_good: "connected";
    state_running: "running";
    state_interrupted: "interrupted";
    is_recorded: "Recorded";
    is_not_recorded: "Not recorded";
    what_is_kept: "What is kept";
    what_is_kept_now: "This run is recorded.";
    record_readings: "Record readings";
    record_readings_says: "All the robot senses and does. Needed to look back.";
    marks_only: "Marks and actions only";
    marks_only_says: "No readings. Enough for counts and the report.";
    participant_code: "Participant code";
    code_not_name: "a code, never a name";
    no_code: "No code";
    code_has_signs: "A code has letters, digits, - _ and . only.";
    asked_once: "Asked once. The tape in the header changes it while it runs.";
    start_asks: "Start …";
    do_not_start: "Cancel";
    choose_program: "Choose a program";
    choose_program_says: "Then press Start. Nothing moves before.";
    none_to_choose: "There is no program yet. Somebody who edits has to make one.";
    another_program: "Another program …";
    ready_to_start: "Ready to start";
    press_start: "The robot holds still. Press Start.";
    goes_on_when_pressed: "Interrupted";
    waits_for_something: "Waits for something to happen";
    senses_nothing_now: "The robot senses nothing just now.";
    what_it_did_last: "What it did last";
    tiles_name: "Buttons";
    no_tiles: "This program has no buttons, says nothing and pretends nothing.";
    buttons_rest: "The buttons rest until the link is back; nothing is done later. Marks go on and wait here.";
    until_link_is_back: "rests until the link is back";
    robot_not_there: "the robot is not there";
    its_sense_is_gone: "its sense is gone from the program";
    only_while_it_runs: "only while it runs";
    not_known_if_done: "No connection: it may not have been done. It is not sent again.";
    sent_just_now: "sent …";
    speaking_now: "speaking …";
    moving_now: "moving …";
    done_just_now: "done";
    comes_next: "next";
    asks_now: "asks: now?";
    not_done: "It is not done.";
    how_was_it: "How was it?";
    it_should_now: "Now it should …";
    hold_for_verdict: "Hold a mark to say if it was good.";
    last_two_minutes: "The last 2 minutes";
    no_connection_now: "no connection";
    nothing_yet: "Nothing yet.";
    row_by_hand: "By hand";
    marks_begin_with_run: "Marks begin with the run.";
    too_many_marks_wait: "Too many marks wait to be sent. Go on once the link is back.";
    mark_with_word: "Mark with a word";
    word_of_mark: "Word, as: laughs";
    add_note_to_mark: "Add a note …";
    change_note: "Change the note …";
    note_of_mark: "Note, if you like …";
    mark_taken_back: "The mark is taken back.";
    mark_waits: "waits here";
    room_or_camera: "Room or camera";
    camera: "Camera";
    what_is_wrong: "What is the matter";
    press_stop_own_way: "Press Stop. It is tried on its own way.";
    take_its_power: "take its power";
    nothing_was_running: "Nothing was running.";
    stop_when_it_is_back: "Press Stop. It reaches the robot as soon as the server does.";
    look_at_its_network: "Look whether the robot is switched on and in its network.";
    another_robot_answers: "Another robot answers";
    nothing_is_done_with_it: "Nothing is done with it until somebody says which one is meant.";
    say_which_on_page: "The host says on the page with the graph which robot is meant.";
    it_fell: "The robot fell";
    look_for_damage: "Everything stopped. Look first whether somebody is hurt, then whether the robot is damaged.";
    stand_it_up: "Stand it up, or help it to stand.";
    it_was_interrupted: "The robot interrupted the program";
    or_stop: "Or press Stop, which ends it.";
    program_ended: "The program ended by itself";
    start_again: "Press Start to begin again.";
    tell_who_made_it: "If it ends again, tell who made the program.";
    holds_still: "The robot holds still.";
    may_sit_down: "It may sit down by itself at any moment.";
    plug_it_in: "Sit it down and plug it in.";
    i_have_read_it: "I have read it";
    tiles_says: "The operator presses these, also with the keys 1 to 9. Choose one to change it.";
    tiles_are_usual: "Nobody chose tiles yet: these follow from the program. The first change makes them its own.";
    usual_tiles: "Back to the usual ones";
    usual_tiles_back: "The usual tiles are back. Undo brings yours back.";
    add_tile: "Add a tile";
    tile_does: "A press";
    tile_by_hand: "has the robot do something";
    tile_pretends: "pretends a sense";
    tile_marks: "marks the moment";
    tile_action: "Action";
    tile_sense: "Sense";
    no_sense_here: "This program has no sense. Close this and add one first.";
    sense_is_gone: "A sense that is gone";
    tile_word: "Word of the mark";
    mark_lasts: "The mark is";
    tile_words: "Words on the tile";
    tile_asks: "Ask first: only a second press does it";
    tile_earlier: "Earlier";
    tile_later: "Later";
    take_tile_away: "Take away";
    back_to_tiles: "All tiles";
    decide_tile_first: "Choose one of both first.";
    tile_taken_meanwhile: "Somebody took this tile away meanwhile.";
    change_tiles: "Change the tiles …";
}

pub(crate) fn version_and_streams(revision: u64, streams: usize) -> String {
    if streams == 1 {
        say!(version_and_streams_version_1_stream: "version {revision} · 1 stream", revision)
    } else {
        say!(version_and_streams_version_streams: "version {revision} · {streams} streams", revision, streams)
    }
}

/// The words by which a run is asked for.
pub(crate) fn start_this(program: &str) -> String {
    say!(start_this: "Start {program}", program)
}

/// The state of a robot that is not heard.
pub(crate) fn heard_ago(seconds: u32) -> String {
    say!(heard_ago: "last heard {seconds} s ago", seconds)
}

pub(crate) fn seconds_ago(seconds: u32) -> String {
    say!(seconds_ago: "{seconds} s ago", seconds)
}

/// For how long the link is silent, where its quality stands else.
pub(crate) fn silent_for(seconds: u32) -> String {
    say!(silent_for: "silent for {seconds} s", seconds)
}

pub(crate) fn wifi(percent: u8) -> String {
    say!(wifi: "Wi-Fi {percent} %", percent)
}

/// On a tile: who else pressed it.
pub(crate) fn just_now(name: &str) -> String {
    say!(just_now: "{name}, just now", name)
}

/// Says that a tile asks first to who does not see it.
pub(crate) fn asks_for_yes(label: &str, key: usize) -> String {
    say!(asks_for_yes: "{label}: now? Press {key} again within two seconds, else it is not done.", label, key)
}

/// Says no to what a tile asks.
pub(crate) fn no_to(label: &str) -> String {
    say!(no_to: "Not now: {label}", label)
}

/// On the tile of a span that goes on.
pub(crate) fn again_ends_it(time: &str) -> String {
    say!(again_ends_it: "{time} · again ends it", time)
}

/// Of a span in the list of marks.
pub(crate) fn so_far(time: &str) -> String {
    say!(so_far: "{time} so far", time)
}

/// Says that a mark is there to who does not see it.
pub(crate) fn marked_as(word: &str) -> String {
    if word.is_empty() { say!(marked_as_marked: "Marked.") } else { say!(marked_as_marked_2: "Marked: {word}.", word) }
}

pub(crate) fn undo_for(seconds: u64) -> String {
    say!(undo_for: "Undo {seconds} s", seconds)
}

/// Says that a mark waited longer than the server takes its moment back.
pub(crate) fn mark_too_old(time: &str) -> String {
    say!(mark_too_old: "The mark of {time} waited longer than a minute. It stands at a minute before it was sent.", time)
}

/// Says that a mark waited for a run that an earlier start of the server knew.
pub(crate) fn mark_of_earlier_start(time: &str) -> String {
    say!(
        mark_of_earlier_start: "The server was started anew, and its run ended. The mark of {time} cannot be added here; note it in its recording.",
        time
    )
}

pub(crate) fn no_connection_for(seconds: u32) -> String {
    if seconds == 1 {
        say!(no_connection_for_no_connection_for_1: "No connection for 1 second")
    } else {
        say!(no_connection_for_no_connection_for_seconds: "No connection for {seconds} seconds", seconds)
    }
}

pub(crate) fn goes_on_by_itself() -> &'static str {
    said!(goes_on_by_itself: "The robot goes on by itself. It may still be moving.")
}

/// Says what to do at its body, in the words of the robot's own kind.
pub(crate) fn if_it_goes_on(what: &str) -> String {
    say!(if_it_goes_on: "If it goes on: {what}.", what)
}

/// The server has lost the robot, and the page has not lost the server.
pub(crate) fn robot_is_lost(robot: &str) -> String {
    say!(robot_is_lost: "The server has no connection to {robot}", robot)
}

pub(crate) fn lost_because(why: &Phrase) -> String {
    say!(
        lost_because: "This page is connected; the robot is not: {why}. It may still be moving.",
        why = shown_within(why)
    )
}

/// A reason as a sentence.
pub(crate) fn because(why: &Phrase) -> String {
    let why = shown_within(why);
    say!(because: "{why}.", why = capitalised(&why))
}

pub(crate) fn then_start(goes_on: bool) -> String {
    if goes_on {
        say!(then_start_then_press_continue_it: "Then press Continue. It goes on where it was.")
    } else {
        say!(then_start_then_press_start: "Then press Start.")
    }
}

pub(crate) fn somebody_stopped(name: &str) -> String {
    if name == protocol::STOP_BUTTON {
        return say!(somebody_stopped_somebody_stopped_the_robot: "Somebody stopped the robot");
    }
    say!(somebody_stopped_stopped_the_robot: "{name} stopped the robot", name)
}

pub(crate) fn ask_them_why(name: &str) -> String {
    if name == protocol::STOP_BUTTON {
        return say!(ask_them_why_ask_the_others_why: "Ask the others why before you go on.");
    }
    say!(ask_them_why_ask_why_before_you: "Ask {name} why before you go on.", name)
}

pub(crate) fn battery_is_low(percent: u8) -> String {
    say!(battery_is_low: "Battery {percent} %", percent)
}

/// The place of a tile, which is its key.
pub(crate) fn tile_key(key: u8) -> String {
    say!(tile_key: "Key {key}", key)
}

/// The place of the tile that is edited.
pub(crate) fn tile_place(key: u8, all: u8) -> String {
    say!(tile_place: "Key {key} of {all}", key, all)
}

/// Says that somebody else changed the tile that is edited.
pub(crate) fn tile_changed_meanwhile(label: &str) -> String {
    say!(tile_changed_meanwhile: "Somebody changed this tile meanwhile. Now it is “{label}”.", label)
}

/// Says to who does not see it what became of a tile.
pub(crate) fn tile_is_saved(label: &str, key: u8) -> String {
    say!(tile_is_saved: "{label}: key {key}", label, key)
}

/// Says to who does not see it that a place is empty now.
pub(crate) fn tile_is_away(key: u8) -> String {
    say!(tile_is_away: "Key {key} is empty.", key)
}

/// The longest words of a tile.
pub(crate) fn at_most_chars(most: usize) -> String {
    say!(at_most_chars: "At most {most} characters.", most)
}
