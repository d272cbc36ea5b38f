//! Takes control of a robot, gives it back to its own life, has it wake up, rest, stand or sit, forget faces, or give a sign.

use super::ConsoleCommand;
use crate::console::Console;
use crate::find::unquoted;
use crate::refusal::{NotDone, NotFound};
use behaviour::Id;
use protocol::request;
use robot::Control;

pub(crate) const TAKE: ConsoleCommand = ConsoleCommand {
    name: "take control",
    words: "NAME",
    help: "Ends the robot's own life: it stands up, and programs have it.",
    run: |console, words| Box::pin(run(console, words, Control::Take)),
};

pub(crate) const GIVE_BACK: ConsoleCommand = ConsoleCommand {
    name: "give back",
    words: "NAME",
    help: "Stops what runs and gives the robot back to its own life.",
    run: |console, words| Box::pin(run(console, words, Control::GiveBack)),
};

pub(crate) const REST: ConsoleCommand = ConsoleCommand {
    name: "rest",
    words: "NAME",
    help: "Stops what runs and lets the robot sit down, its motors off.",
    run: |console, words| Box::pin(run(console, words, Control::Rest)),
};

pub(crate) const BLINK: ConsoleCommand = ConsoleCommand {
    name: "blink robot",
    words: "NAME",
    help: "Makes the robot's eyes blink for a moment, so that people see which one it is.",
    run: |console, words| Box::pin(run(console, words, Control::Blink)),
};

pub(crate) const WAKE_UP: ConsoleCommand = ConsoleCommand {
    name: "wake up",
    words: "NAME",
    help: "Wakes the robot up: its motors go on.",
    run: |console, words| Box::pin(run(console, words, Control::WakeUp)),
};

pub(crate) const STAND: ConsoleCommand = ConsoleCommand {
    name: "let stand",
    words: "NAME",
    help: "Lets the robot stand up.",
    run: |console, words| Box::pin(run(console, words, Control::Stand)),
};

pub(crate) const SIT: ConsoleCommand = ConsoleCommand {
    name: "let sit",
    words: "NAME",
    help: "Lets the robot sit down, its motors on.",
    run: |console, words| Box::pin(run(console, words, Control::Sit)),
};

pub(crate) const FORGET_FACES: ConsoleCommand = ConsoleCommand {
    name: "forget faces",
    words: "NAME",
    help: "Has the robot forget all faces that it remembers, for good.",
    run: |console, words| Box::pin(run(console, words, Control::ForgetFaces)),
};

pub(crate) const FORGET_FACE: ConsoleCommand = ConsoleCommand {
    name: "forget face",
    words: "FACE of NAME",
    help: "Has the robot forget the face that it remembers under this name, for good.",
    run: |console, words| Box::pin(forget_face(console, words)),
};

pub(crate) const SHOW_FACES: ConsoleCommand = ConsoleCommand {
    name: "show faces",
    words: "NAME",
    help: "Shows the names under which the robot remembers faces.",
    run: |console, words| Box::pin(show_faces(console, words)),
};

async fn faces(console: &mut Console, robot: &Id) -> Result<Vec<String>, NotDone> {
    Ok(console.ask(request::Faces { robot: robot.clone() }).await?.faces)
}

async fn show_faces(console: &mut Console, wanted: &str) -> Result<String, NotDone> {
    let (name, robot) = console.robot_meant(wanted).await?;
    let faces = faces(console, &robot).await?;
    Ok(if faces.is_empty() { format!("{name} remembers no face") } else { faces.join("\n") })
}

/// The whole name has to be said: what is forgotten does not come back.
async fn forget_face(console: &mut Console, words: &str) -> Result<String, NotDone> {
    let (face, wanted) = words.rsplit_once(" of ").ok_or(NotDone::NoFaceOf)?;
    let (name, robot) = console.robot_meant(wanted).await?;
    let (face, names) = (unquoted(face.trim()), faces(console, &robot).await?);
    let Some(known) = names.iter().find(|known| *known == face).cloned() else {
        return Err(NotFound::Unknown { what: "face", wanted: face.to_owned(), names }.into());
    };
    console.ask(request::ControlRobot { robot, control: Control::ForgetFace(known) }).await?;
    Ok(format!("{name} forgets {face}"))
}

async fn run(console: &mut Console, wanted: &str, control: Control) -> Result<String, NotDone> {
    let (name, robot) = console.robot_meant(wanted).await?;
    let known = console.client()?.robot(Some(&robot)).await?.condition.faces;
    console.ask(request::ControlRobot { robot, control: control.clone() }).await?;
    Ok(match control {
        Control::Take => format!("{name} is under control"),
        Control::GiveBack => format!("{name} has its own life again"),
        Control::Rest => format!("{name} rests"),
        Control::Blink => format!("{name} makes its eyes blink"),
        Control::WakeUp => format!("{name} wakes up"),
        Control::Stand => format!("{name} stands up"),
        Control::Sit => format!("{name} sits down"),
        Control::ForgetFaces => match known {
            Some(1) => format!("{name} forgets the face that it knew"),
            Some(count) => format!("{name} forgets the {count} faces that it knew"),
            None => format!("{name} forgets the faces that it knew"),
        },
        Control::ForgetFace(face) => format!("{name} forgets {face}"),
    })
}
