//! Real robots: adding one, how its body is, and who has it.

use protocol::CheckStage;
use robot::{Condition, Control, JOINTS, Life, Touchable};

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
    take_control: "Take control";
    give_back: "Give back to its own life";
    rest: "Let it rest";
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
    push: "Push it over";
    help_up: "Help it up";
    buttons: "Buttons of the program";
}

/// "Touch the middle of the head".
pub(crate) fn touch_part(part: Touchable) -> String {
    if part == Touchable::HeadMiddle { "Touch head".to_owned() } else { format!("Touch the {}", part.words()) }
}

pub(crate) fn comes_in(name: &str) -> String {
    format!("{name} in")
}

pub(crate) fn goes_out(name: &str) -> String {
    format!("{name} out")
}

pub(crate) fn box_named(color: &str) -> String {
    format!("{color} box")
}

pub(crate) fn mark_named(number: u16) -> String {
    format!("Mark {number}")
}

/// A step on the way to a robot.
pub(crate) fn check_stage(stage: CheckStage) -> &'static str {
    match stage {
        CheckStage::Name => "Its name",
        CheckStage::Tcp => "Reaching it",
        CheckStage::Tls => "A secure connection",
        CheckStage::Login => "Being let in",
        CheckStage::Directory => "Asking what it can do",
        CheckStage::Services => "What a robot needs",
    }
}

/// What a look found, and the certificate that counts from now on: "“Blue” is a NAO, NAOqi 2.8.7."
pub(crate) fn found_robot(name: &str, model: &str, certificate: Option<&str>) -> String {
    let name = if name.is_empty() { "It".to_owned() } else { format!("“{name}”") };
    let shows = certificate.map(|certificate| format!(" From now on it must show the certificate {certificate}."));
    format!("{name} is a {model}.{}", shows.unwrap_or_default())
}

/// "Starts version 12 on NAO blue."
pub(crate) fn starts_on(robot: &str, revision: u64) -> String {
    format!("Start runs version {revision} on “{robot}”.")
}

/// Start, of what the robot interrupted.
pub(crate) fn go_on() -> &'static str {
    "Continue"
}

pub(crate) fn paused(why: &str) -> String {
    format!("Interrupted: {why}. “Continue” goes on where it was; Stop ends it.")
}

/// What was asked, for a sentence that it was done.
pub(crate) fn control_done(robot: &str, control: Control) -> String {
    match control {
        Control::Take => format!("You have “{robot}” now. It stands up."),
        Control::GiveBack => format!("“{robot}” has its own life again."),
        Control::Rest => format!("“{robot}” sits down to rest."),
    }
}

/// How a body is, light by light: whether that is good, bad or neither, and in words.
pub(crate) fn condition(of: &Condition) -> Vec<(&'static str, String)> {
    let mut lights = Vec::new();
    let mut light = |look: &'static str, words: &str| lights.push((look, words.to_owned()));
    if let Some(percent) = of.battery {
        let plugged = if of.plugged == Some(true) { ", charging" } else { "" };
        light(
            if percent < 20 && plugged.is_empty() { "bad" } else { "good" },
            &format!("Battery {percent} %{plugged}"),
        );
    }
    match of.awake {
        Some(true) => light("good", "Awake"),
        Some(false) => light("off", "Asleep"),
        None => {}
    }
    if of.stiff == Some(false) {
        light("off", "Motors off");
    } else if of.stiff == Some(true) {
        light("good", "Motors on");
    }
    match of.life {
        Some(Life::Disabled) => light("good", "Own life off"),
        Some(Life::Safeguard) => light("bad", "Protects itself"),
        Some(Life::Solitary | Life::Interactive) => light("off", "Lives by itself"),
        None => {}
    }
    if of.fallen == Some(true) {
        light("bad", "Has fallen");
    }
    if !of.hot.is_empty() {
        light("bad", &format!("Hot: {}", of.hot.iter().map(|joint| joint_words(joint)).collect::<Vec<_>>().join(", ")));
    }
    lights
}

/// "LKneePitch" as "left knee pitch"; what is no joint of a NAO stays as it is.
fn joint_words(joint: &str) -> String {
    if !JOINTS.contains(&joint) {
        return joint.to_owned();
    }
    let (side, rest) = match joint.split_at(1) {
        ("L", rest) => ("left", rest),
        ("R", rest) => ("right", rest),
        _ => ("", joint),
    };
    let mut words = side.to_owned();
    for letter in rest.chars() {
        if letter.is_uppercase() && !words.is_empty() {
            words.push(' ');
        }
        words.extend(letter.to_lowercase());
    }
    words
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
