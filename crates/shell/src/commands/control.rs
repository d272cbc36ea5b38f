//! Takes control of a robot, gives it back to its own life, lets it rest, or lets it give a sign.

use super::Command;
use crate::console::Console;
use crate::refusal::NotDone;
use protocol::Request;
use robot::Control;

pub(crate) const TAKE: Command = Command {
    name: "take control",
    words: "NAME",
    help: "Ends the robot's own life: it stands up, and programs have it.",
    run: |console, words| Box::pin(run(console, words, Control::Take)),
};

pub(crate) const GIVE_BACK: Command = Command {
    name: "give back",
    words: "NAME",
    help: "Stops what runs and gives the robot back to its own life.",
    run: |console, words| Box::pin(run(console, words, Control::GiveBack)),
};

pub(crate) const REST: Command = Command {
    name: "rest",
    words: "NAME",
    help: "Stops what runs and lets the robot sit down, its motors off.",
    run: |console, words| Box::pin(run(console, words, Control::Rest)),
};

pub(crate) const BLINK: Command = Command {
    name: "blink robot",
    words: "NAME",
    help: "Makes the robot's eyes blink for a moment, so that people see which one it is.",
    run: |console, words| Box::pin(run(console, words, Control::Blink)),
};

async fn run(console: &mut Console, wanted: &str, control: Control) -> Result<String, NotDone> {
    let (name, robot) = console.robot_meant(wanted).await?;
    console.ask(Request::ControlRobot { robot, control }).await?;
    Ok(match control {
        Control::Take => format!("{name} is under control"),
        Control::GiveBack => format!("{name} has its own life again"),
        Control::Rest => format!("{name} rests"),
        Control::Blink => format!("{name} makes its eyes blink"),
    })
}
