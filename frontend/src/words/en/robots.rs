//! Real robots: adding one, how its body is, and who has it.

use super::saying;
use robot::Control;

sentences! {
    rename: "Rename";
    rename_robot: "Rename the robot";
    another_answers: "another robot answers";
    say_which_first: "Another robot answers at its address. Say first which one is meant.";
    speak: "Say";
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

/// Two names for one body.
pub(crate) fn same_as(name: &str) -> String {
    say!(same_as: "It is the same robot as “{name}”. Start it there, or remove one of the two.", name)
}

/// Start, of what the robot interrupted.
pub(crate) fn go_on() -> &'static str {
    said!(go_on: "Continue")
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
