//! A robot that does something for somebody who is killed or frozen, or whose line is cut: how long it goes on. All times are
//! those of the stand-in, on the computer's monotonic clock.

use crate::driver::Driver;
use crate::peer::{PATIENCE, PAUSE, Peer};
use crate::proxy::{Cut, Proxy};
use behaviour::Value;
use robot::{Millis, Robot};
use rustix::process::{Pid, Signal, kill_process};
use rustix::time::{ClockId, clock_gettime};
use serde_json::{Value as Json, json};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Names the activity to the process that does it, and where its robot is.
const DOES: &str = "RRP_HARM_DOES";
const ROBOT: &str = "RRP_HARM_ROBOT";
/// It is calm when it was quiet for so long, in milliseconds; pieces follow each other closer.
const QUIET_MS: f64 = 1_500.0;

/// The activity of the robot when the harm comes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Activity {
    pub(crate) name: &'static str,
    device: &'static str,
    params: &'static [(&'static str, &'static str)],
    /// Of the times that the stand-in tells.
    last: &'static str,
    /// True if it is at it.
    is_on: fn(&Json) -> bool,
    /// The longest that it may go on, in milliseconds.
    pub(crate) within_ms: f64,
    /// The service whose end is one of the harms.
    service: &'static str,
}

const BODY: &[(&str, &str)] = &[("mode", "WholeBody")];
const MOVE: &[(&str, &str)] = &[("mode", "Move")];
const ARM: &[(&str, &str)] = &[("mode", "Arm"), ("effector", "LArm")];
const BELL: &[(&str, &str)] = &[("sound", "file"), ("file", "/home/nao/sounds/bell.wav")];

fn walks(state: &Json) -> bool {
    state["moving"] == json!(true) && state["velocity"][0].as_f64().is_some_and(|speed| speed > 0.04)
}

fn turns(state: &Json) -> bool {
    state["velocity"][2].as_f64().is_some_and(|speed| speed.abs() > 0.2)
}

fn points(state: &Json) -> bool {
    // A picture sends it on a little way, and it is there before the next.
    let moved = state["last_ms"]["moved"].as_f64().unwrap_or_default();
    moved > 0.0 && state["t_ms"].as_f64().unwrap() - moved < 60.0
}

fn has(state: &Json, name: &str) -> bool {
    state[name].as_array().is_some_and(|all| !all.is_empty())
}

/// All of them. A gesture is as long as the robot's package makes it, here two seconds, and a sound as its file, here one:
/// nothing on the robot ends them sooner.
pub(crate) const ACTIVITIES: [Activity; 7] = [
    Activity {
        name: "walking",
        device: "Walk",
        params: &[],
        last: "moved",
        is_on: walks,
        within_ms: 1_000.0,
        service: "ALMotion",
    },
    Activity {
        name: "whole-body tracking",
        device: "Tracker",
        params: BODY,
        last: "moved",
        is_on: turns,
        within_ms: 1_000.0,
        service: "ALMotion",
    },
    Activity {
        name: "walking after a ball",
        device: "Tracker",
        params: MOVE,
        last: "moved",
        is_on: walks,
        within_ms: 1_000.0,
        service: "ALMotion",
    },
    Activity {
        name: "arm tracking",
        device: "Tracker",
        params: ARM,
        last: "moved",
        is_on: points,
        within_ms: 1_000.0,
        service: "ALMotion",
    },
    Activity {
        name: "speech",
        device: "SayInput",
        params: &[],
        last: "spoke",
        is_on: |state| state["speaking"].is_string(),
        within_ms: 2_000.0,
        service: "ALTextToSpeech",
    },
    Activity {
        name: "sound",
        device: "Sound",
        params: BELL,
        last: "sounded",
        is_on: |state| has(state, "sounding"),
        within_ms: 1_100.0,
        service: "ALAudioPlayer",
    },
    Activity {
        name: "gesture",
        device: "Animation",
        params: &[],
        last: "played",
        is_on: |state| has(state, "playing"),
        within_ms: 2_100.0,
        service: "ALAnimationPlayer",
    },
];

/// The harms that happen to who drives the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Harm {
    Killed,
    Frozen,
    Line(Cut),
    Service,
}

pub(crate) const HARMS: [(&str, Harm); 7] = [
    ("server killed", Harm::Killed),
    ("frozen", Harm::Frozen),
    ("cut to it", Harm::Line(Cut::To)),
    ("cut from it", Harm::Line(Cut::From)),
    ("cut both ways", Harm::Line(Cut::Both)),
    ("half-open", Harm::Line(Cut::HalfOpen)),
    ("service gone", Harm::Service),
];

/// The process that drives the robot; its end takes nothing else along.
struct Server(Child);

impl Server {
    /// This program again, which has to lead to [`drive_if_told`] with these words.
    fn start(words: &[&str], activity: &Activity, robot: &str) -> Self {
        let mut command = Command::new(std::env::current_exe().unwrap());
        command.args(words).env(DOES, activity.name).env(ROBOT, robot);
        Self(command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap())
    }

    fn tell(&self, signal: Signal) {
        let id = i32::try_from(self.0.id()).unwrap();
        kill_process(Pid::from_raw(id).unwrap(), signal).unwrap();
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _already_gone = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Drives the robot until it is killed, if this is the process that shall. True if it was.
pub(crate) fn drive_if_told() -> bool {
    let (Ok(does), Ok(robot)) = (std::env::var(DOES), std::env::var(ROBOT)) else { return false };
    let activity = ACTIVITIES.iter().find(|one| one.name == does).unwrap();
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
    runtime.block_on(async {
        let mut driver = Driver::at(&robot).await;
        let params: Vec<(&str, Value)> =
            activity.params.iter().map(|(name, value)| (*name, Value::text(*value))).collect();
        let user = driver.open("does", activity.device, &params);
        let value = if activity.name == "speech" {
            Value::text("Once upon a time there was a robot that told a long story, and nobody stopped it. ".repeat(4))
        } else {
            Value::Float(0.05)
        };
        // Whoever watches ends this.
        let until = Instant::now() + 2 * PATIENCE;
        while Instant::now() < until {
            let _refused_while_it_is_gone = driver.nao.command(&user, &value, Millis(0));
            driver.step().await;
        }
    });
    true
}

fn monotonic_ms() -> f64 {
    let time = clock_gettime(ClockId::Monotonic);
    time.tv_sec as f64 * 1e3 + time.tv_nsec as f64 / 1e6
}

/// Does something and comes to harm: how long it went on, in milliseconds.
///
/// `late_ms` after it began, so that the harm comes in any part of a step, a word or a piece.
pub(crate) async fn calm_after(words: &[&str], activity: &Activity, harm: Harm, late_ms: u64) -> Option<f64> {
    let peer = Peer::start(&format!("nao: calm, {}", activity.name), &[]).await?;
    // A ball that swings far enough to turn for, or that is far ahead.
    let at = if activity.name == "walking after a ball" { [1.8, 0.0, 0.5] } else { [0.5, 0.0, 0.45] };
    let swing = if at[0] > 1.0 { json!(null) } else { json!({"amplitude": [0.0, 0.4, 0.0], "hz": [0.0, 0.15, 0.0]}) };
    peer.world(json!({"balls": {"red": {"at": at, "path": swing}}})).await;
    let proxy = Proxy::before(&peer.address).await;
    let mut server = Server::start(words, activity, &proxy.address);
    let end = Instant::now() + PATIENCE;
    let mut since = None;
    loop {
        let state = peer.state().await;
        assert!(Instant::now() < end, "never: {} {state}", activity.name);
        assert!(server.0.try_wait().unwrap().is_none(), "who drives is gone");
        let is_on = (activity.is_on)(&state);
        let began = *since.get_or_insert_with(Instant::now);
        if is_on && began.elapsed() >= Duration::from_millis(late_ms) {
            break;
        }
        if !is_on && began.elapsed() < Duration::from_millis(late_ms) {
            since = None;
        }
        tokio::time::sleep(PAUSE).await;
    }
    let harmed = monotonic_ms();
    match harm {
        Harm::Killed => server.tell(Signal::KILL),
        Harm::Frozen => server.tell(Signal::STOP),
        Harm::Line(cut) => proxy.cut_line(cut),
        Harm::Service => peer.fault(json!({"do": "unregister", "service": activity.service})).await,
    }
    loop {
        let state = peer.state().await;
        let born = state["born_us"].as_f64().unwrap() / 1e3;
        let last = born + state["last_ms"][activity.last].as_f64().unwrap_or_default();
        let now = born + state["t_ms"].as_f64().unwrap();
        if now - last > QUIET_MS && now - harmed > QUIET_MS {
            peer.was_safe().await;
            return Some((last - harmed).max(0.0));
        }
        assert!(now - harmed < 20_000.0, "{} never ends after {harm:?}", activity.name);
        tokio::time::sleep(PAUSE).await;
    }
}
