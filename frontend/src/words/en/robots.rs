//! Real robots: adding one, how its body is, and who has it.

use super::{listed, saying};
use crate::words::language::{said_of, shown, shown_within};
use phrase::Phrase;
use protocol::CheckStage;
use robot::{Condition, Control, Identity, JOINTS, Life, Network, Touchable};

sentences! {
    add_real: "Add a NAO or Pepper";
    rename: "Rename";
    rename_robot: "Rename the robot";
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
    another_answers: "another robot answers";
    say_which_first: "Another robot answers at its address. Say first which one is meant.";
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
    speak: "Say";
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

/// What a look found, and the certificate that counts from now on: "“Blue” is a NAO, NAOqi 2.8.7."
pub(crate) fn found_robot(name: &str, model: &str, certificate: Option<&str>) -> String {
    let name = if name.is_empty() { say!(found_robot_it: "It") } else { saying(name) };
    match certificate {
        Some(certificate) => say!(
            found_robot_is_a_from_now: "{name} is a {model}. From now on it must show the certificate {certificate}.",
            name,
            model,
            certificate
        ),
        None => say!(found_robot_is_a: "{name} is a {model}.", name, model),
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

/// What a robot calls itself, and its number.
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

/// Two names for one body.
pub(crate) fn same_as(name: &str) -> String {
    say!(same_as: "It is the same robot as “{name}”. Start it there, or remove one of the two.", name)
}

/// That a robot is not added a second time.
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

/// Start, of what the robot interrupted.
pub(crate) fn go_on() -> &'static str {
    said!(go_on: "Continue")
}

pub(crate) fn paused(why: &Phrase) -> String {
    say!(paused: "Interrupted: {why}. “Continue” goes on where it was; Stop ends it.", why = shown_within(why))
}

/// How the last run of this program ended.
pub(crate) fn stopped_by(name: &str) -> String {
    say!(stopped_by: "{name} pressed Stop. Start runs it again.", name)
}

/// Why somebody should look at what runs.
pub(crate) fn started_by_revoked(name: &str) -> String {
    say!(started_by_revoked: "{name} started this and may not be here any more.", name)
}

/// What was asked, for a sentence that it was done.
pub(crate) fn control_done(robot: &str, control: &Control) -> String {
    match control {
        Control::Take => say!(control_done_you_have_now_it: "You have “{robot}” now. It stands up.", robot),
        Control::GiveBack => say!(control_done_has_its_own_life: "“{robot}” has its own life again.", robot),
        Control::Rest => say!(control_done_sits_down_to_rest: "“{robot}” sits down to rest.", robot),
        Control::Blink => say!(control_done_the_eyes_of_blink: "The eyes of “{robot}” blink for a moment.", robot),
        Control::WakeUp => say!(control_done_wakes_up: "“{robot}” wakes up.", robot),
        Control::Stand => say!(control_done_stands_up: "“{robot}” stands up.", robot),
        Control::Sit => say!(control_done_sits_down: "“{robot}” sits down.", robot),
        Control::ForgetFaces => {
            say!(control_done_forgets_the_faces_that: "“{robot}” forgets the faces that it knew.", robot)
        }
        Control::ForgetFace(face) => say!(control_done_forgets: "“{robot}” forgets “{face}”.", robot, face),
    }
}

/// Below this a robot that walks away may be lost, in percent.
const WEAK_WIFI: u8 = 40;

/// What is asked before faces are forgotten.
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

/// How a body is, light by light: whether that is good, bad or neither, and in words.
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

/// What a joint moves, without its side.
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
    use robot::{Condition, Life};

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
