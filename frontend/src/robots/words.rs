//! Sentences that only the robot says.

use crate::words::language::said_of;
pub(crate) use crate::words::*;
use phrase::Phrase;
use protocol::CheckStage;
use robot::{Condition, Identity, JOINTS, Life, Network, Touchable};

sentences! {
    whole_value: "Value";
    new_robot: "Simulated NAO";
    add_robot_hint: "It has a room of its own, and everybody here can use it.";
    remove_robot_says: "Its room and its order go with it. Programs stay.";
    may_still_move: "It may still be moving.";
    not_recorded: "This run is not recorded.";
    running_together: "Runs on the robot";
    upper_wins: "If they disagree, the upper one wins.";
    stop: "Stop";
    mark_hint: "What happens now?";
    only_watches: "Nothing leads to an action yet: the robot only watches.";
    runs_this: "The robot runs this version";
    stop_it: "Stop it";
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
    value_json: "Value";
    value_hint: "Sent as if the robot had sensed it, while the program runs.";
    send: "Send";
    as_if: "As if";
    value_is_true: "It is true";
    more_of_value: "More: the value as text";
    start_now: "Start now";
    add_real: "Add a NAO or Pepper";
    address: "Address";
    address_hint: "Its name or number in your network. NAO says its number when you press its chest button once.";
    user: "User";
    password: "Password";
    login_hint: "Only for robots that ask for one; the password stays on the server.";
    in_network: "In your network";
    looks_for_robots: "Looking for robots in your network …";
    none_in_network: "No robot announces itself in your network. Type its address.";
    looks: "Looking for the robot …";
    add: "Add";
    add_anyway: "Add anyway";
    check_went_well: "went well";
    check_failed: "failed";
    change_address: "Change the address";
    change: "Change";
    change_anyway: "Change it anyway";
    login_stays: "User and password stay as they are, unless you type others.";
    blink: "Make its eyes blink";
    accept_stranger: "It is this one now";
    expected: "Expected";
    answers: "Answers";
    take_control: "Take control";
    give_back: "Give back to its own life";
    rest: "Let it rest";
    wake_up: "Wake up";
    stand_up: "Stand up";
    sit_down: "Sit down";
    forget_faces: "Forget faces";
    forget: "Forget";
    whose_face: "Whose face";
    all_faces: "All of them";
    room_of_real: "As the robot tells";
    more_in_room: "More";
    another_person: "Another person";
    obstacle: "Box";
    printed_mark: "Printed mark";
    speak_to_it: "Say something to the robot";
    clap: "Clap at its left";
    plug: "Put it on the cable";
    unplug: "Take it off the cable";
    battery_low: "Battery nearly empty";
    minute_passes: "A minute passes";
    hour_passes: "An hour passes";
    push: "Push it over";
    help_up: "Help it up";
    buttons: "Buttons of the program";
    look_through_camera: "Look through its camera";
    camera_picture: "What the robot's camera sees now";
    camera_kept_nowhere: "Seen now, kept nowhere. Ask whoever is in the picture first.";
    camera_waits: "Waiting for a picture of the camera …";
    camera_watched: "Somebody looks through its camera.";
}

pub(crate) fn last_heard(seconds: u32) -> String {
    say!(last_heard: "Last heard {seconds} s ago.", seconds)
}

pub(crate) fn room_as_it_was(seconds: u32) -> String {
    say!(room_as_it_was: "Room · as it was {seconds} s ago", seconds)
}

/// Said once, when something begins to fail.
pub(crate) fn begins_to_fail(name: &str, why: &Phrase) -> String {
    say!(begins_to_fail: "“{name}” fails: {sentence}", name, sentence = sentence(why))
}

/// Beside the lamp.
pub(crate) fn parts_fail(count: usize) -> String {
    if count == 1 { say!(parts_fail_n1_fails: "1 fails") } else { say!(parts_fail_fail: "{count} fail", count) }
}

/// The robot still runs what there was before the last edits.
pub(crate) fn running_older(runs: u64, edits: u64) -> String {
    if runs == edits {
        say!(running_older_the_robot_runs_an: "The robot runs an older helper")
    } else {
        say!(running_older_the_robot_runs_your: "The robot runs your older version")
    }
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

pub(crate) fn robot_named(name: &str) -> String {
    say!(robot_named: "Robot: {name}", name)
}

pub(crate) fn remove_robot(name: &str) -> String {
    say!(remove_robot: "Remove “{name}”", name)
}

pub(crate) fn runs_names(names: &str) -> String {
    say!(runs_names: "runs {names}", names)
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

pub(crate) fn ended(reason: &Phrase) -> String {
    say!(ended: "It ended by itself: {reason}. Press Start to try again.", reason = shown_within(reason))
}

pub(crate) fn follows(what: &str) -> String {
    say!(follows: "follows {what}", what = listed(what.split(", ")))
}

/// Says how far something is, as the open program has it too: in centimetres, else in metres.
pub(crate) fn how_far(metres: f64, in_centimetres: bool) -> String {
    if in_centimetres { format!("{:.0} cm", metres * 100.0) } else { format!("{metres:.2} m") }
}

/// Says what was sent to which sense.
pub(crate) fn sent_to(name: &str, value: &str) -> String {
    say!(sent_to: "Sent to {name}: {value}", name, value)
}

/// Something of the catalogue where it stands alone: "Angle to the side in radians".
pub(crate) fn as_label(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().into_iter().flat_map(char::to_uppercase).chain(rest).collect()
}

pub(crate) fn ball_named(color: &str) -> &'static str {
    match color {
        "red" => ball_red(),
        "green" => ball_green(),
        "blue" => ball_blue(),
        _ => ball_other(),
    }
}

/// Says how long ago something was printed, in whole seconds.
pub(crate) fn printed_ago(seconds: u64) -> String {
    if seconds < 1 {
        say!(printed_ago_just_now: "just now")
    } else {
        say!(printed_ago_s_ago: "{seconds} s ago", seconds)
    }
}

/// "Touch the middle of the head".
pub(crate) fn touch_part(part: Touchable) -> String {
    if part == Touchable::HeadMiddle {
        say!(touch_part_touch_head: "Touch head")
    } else {
        say!(touch_part_touch_the: "Touch the {words}", words = shown(&part))
    }
}

pub(crate) fn comes_in(name: &str) -> String {
    say!(comes_in: "{name} in", name)
}

pub(crate) fn goes_out(name: &str) -> String {
    say!(goes_out: "{name} out", name)
}

pub(crate) fn box_named(color: &str) -> String {
    say!(box_named: "{color} box", color = said_of(&format!("color.{color}"), color))
}

pub(crate) fn mark_named(number: u16) -> String {
    say!(mark_named: "Mark {number}", number)
}

/// A step on the way to a robot.
pub(crate) fn check_stage(stage: CheckStage) -> &'static str {
    match stage {
        CheckStage::Name => said!(check_stage_its_name: "Its name"),
        CheckStage::Tcp => said!(check_stage_reaching_it: "Reaching it"),
        CheckStage::Tls => said!(check_stage_a_secure_connection: "A secure connection"),
        CheckStage::Login => said!(check_stage_being_let_in: "Being let in"),
        CheckStage::Directory => said!(check_stage_asking_what_it_can: "Asking what it can do"),
        CheckStage::Services => said!(check_stage_what_a_robot_needs: "What a robot needs"),
    }
}

/// Which body: "“Momo”, NAO #0344".
pub(crate) fn who(identity: &Identity) -> String {
    let name = if identity.name.is_empty() { said!(who: "without a name").to_owned() } else { saying(&identity.name) };
    let (kind, tail) = (said_of(&format!("body.{}", identity.body), &identity.body), identity.tail());
    let number = (!tail.is_empty()).then(|| format!("#{tail}"));
    let kind = [Some(kind).filter(|kind| !kind.is_empty()), number].into_iter().flatten();
    listed([name, kind.collect::<Vec<_>>().join(" ")].into_iter().filter(|part| !part.is_empty()))
}

/// Says what a robot calls itself, and its number.
pub(crate) fn calls_itself(identity: &Identity) -> String {
    say!(calls_itself: "calls itself {who}", who = who(identity))
}

/// The question while another body answers.
pub(crate) fn stranger_question(name: &str) -> String {
    say!(stranger_question: "Is this “{name}”?", name)
}

/// The dialog for another address.
pub(crate) fn change_address_of(name: &str) -> String {
    say!(change_address_of: "Change the address of “{name}”", name)
}

/// Says that a robot is not added a second time.
pub(crate) fn here_already(name: &str) -> String {
    say!(here_already: "This robot is here already, as “{name}”.", name)
}

pub(crate) fn give_this_address(name: &str) -> String {
    say!(give_this_address: "Give “{name}” this address", name)
}

/// "Starts version 12 on NAO blue."
pub(crate) fn starts_on(robot: &str, revision: u64) -> String {
    say!(starts_on: "Start runs version {revision} on “{robot}”.", revision, robot)
}

pub(crate) fn paused(why: &Phrase) -> String {
    say!(paused: "Interrupted: {why}. “Continue” goes on where it was; Stop ends it.", why = shown_within(why))
}

/// Says how the last run of this program ended.
pub(crate) fn stopped_by(name: &str) -> String {
    say!(stopped_by: "{name} pressed Stop. Start runs it again.", name)
}

/// Says why somebody should look at what runs.
pub(crate) fn started_by_revoked(name: &str) -> String {
    say!(started_by_revoked: "{name} started this and may not be here any more.", name)
}

/// Below this a robot that walks away may be lost, in percent.
const WEAK_WIFI: u8 = 40;

/// Asks before faces are forgotten.
pub(crate) fn forget_faces_of(robot: &str, count: u16) -> String {
    match count {
        1 => {
            say!(forget_faces_of_forgets_the_face_that: "“{robot}” forgets the face that it remembers. This cannot be undone.", robot)
        }
        _ => {
            say!(forget_faces_of_forgets_the_faces_that: "“{robot}” forgets the {count} faces that it remembers. This cannot be undone.", robot, count)
        }
    }
}

/// Returns the question that is asked before one face is forgotten.
pub(crate) fn forget_face_of(robot: &str, face: &str) -> String {
    say!(forget_face_of: "“{robot}” forgets the face that it remembers as “{face}”. This cannot be undone.", robot, face)
}

/// Returns the reason why nothing is forgotten any more.
pub(crate) fn robot_removed(robot: &str) -> String {
    say!(robot_removed: "Somebody has removed “{robot}” meanwhile. Nothing was forgotten.", robot)
}

/// Tells the state of a body, light by light: whether that is good, bad or neither, and in words.
pub(crate) fn condition(of: &Condition) -> Vec<(&'static str, String)> {
    let mut lights = Vec::new();
    let mut light = |look: &'static str, words: &str| lights.push((look, words.to_owned()));
    if let Some(percent) = of.battery {
        match of.plugged {
            Some(true) => light("good", &say!(condition_battery_charging: "Battery {percent} %, charging", percent)),
            Some(false) | None => {
                light(
                    if percent < 20 { "bad" } else { "good" },
                    &say!(condition_battery: "Battery {percent} %", percent),
                );
            }
        }
    }
    match of.network {
        Some(Network::Cable) => light("good", said!(condition_network_by_cable: "Network by cable")),
        Some(Network::Wifi(percent)) if percent < WEAK_WIFI => {
            light("bad", &say!(condition_wi_fi_weak: "Wi-Fi weak: {percent} %", percent))
        }
        Some(Network::Wifi(percent)) => light("good", &say!(condition_wi_fi_good: "Wi-Fi good: {percent} %", percent)),
        None => {}
    }
    match of.awake {
        Some(true) => light("good", said!(condition_awake: "Awake")),
        Some(false) => light("off", said!(condition_asleep: "Asleep")),
        None => {}
    }
    if of.stiff == Some(false) {
        light("off", said!(condition_motors_off: "Motors off"));
    } else if of.stiff == Some(true) {
        light("good", said!(condition_motors_on: "Motors on"));
    }
    match of.life {
        Some(Life::Disabled) => light("good", said!(condition_own_life_off: "Own life off")),
        Some(Life::Safeguard) => light("bad", said!(condition_protects_itself: "Protects itself")),
        Some(Life::Solitary | Life::Interactive) => {
            light("off", said!(condition_lives_by_itself_may: "Lives by itself, may move and speak"));
        }
        None => {}
    }
    if of.fallen == Some(true) {
        light("bad", said!(condition_has_fallen: "Has fallen"));
    } else if let Some(why) = &of.legs {
        light("off", &say!(condition_does_not_walk: "Does not walk: {why}", why = shown_within(why)));
    }
    match of.faces {
        None | Some(0) => {}
        Some(1) => light("off", said!(condition_remembers_a_face: "Remembers a face")),
        Some(count) => light("off", &say!(condition_remembers_faces: "Remembers {count} faces", count)),
    }
    if !of.hot.is_empty() {
        light(
            "bad",
            &say!(condition_hot: "Hot: {joints}", joints = listed(of.hot.iter().map(|joint| joint_words(joint)))),
        );
    }
    lights
}

/// "LKneePitch" as "left knee pitch"; what is no joint of a NAO stays as it is.
fn joint_words(joint: &str) -> String {
    if !JOINTS.contains(&joint) {
        return joint.to_owned();
    }
    match joint.split_at(1) {
        ("L", rest) => say!(joint_words_left: "left {joint}", joint = moves(rest)),
        ("R", rest) => say!(joint_words_right: "right {joint}", joint = moves(rest)),
        _ => moves(joint),
    }
}

/// Names what a joint moves, without its side.
fn moves(joint: &str) -> String {
    let mut words = String::new();
    for letter in joint.chars() {
        if letter.is_uppercase() && !words.is_empty() {
            words.push(' ');
        }
        words.extend(letter.to_lowercase());
    }
    said_of(&format!("joint.{joint}"), &words)
}

#[cfg(test)]
mod tests {
    use super::{condition, joint_words};
    use robot::Condition;
    use robot::Life;

    #[test]
    fn joints_have_words() {
        assert_eq!(joint_words("LKneePitch"), "left knee pitch");
        assert_eq!(joint_words("HeadYaw"), "head yaw");
        assert_eq!(joint_words("Leg/Motor"), "Leg/Motor");
    }

    #[test]
    fn a_body_is_told_light_by_light() {
        let body = Condition {
            battery: Some(12),
            awake: Some(false),
            life: Some(Life::Safeguard),
            hot: vec!["RShoulderRoll".into()],
            ..Condition::default()
        };
        let told: Vec<_> = condition(&body).into_iter().map(|(look, words)| format!("{look}: {words}")).collect();
        assert_eq!(told, ["bad: Battery 12 %", "off: Asleep", "bad: Protects itself", "bad: Hot: right shoulder roll"]);
        assert!(condition(&Condition::default()).is_empty());
    }
}
