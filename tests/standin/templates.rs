//! Every template on the robot's adapter against the stand-in: what is called, with what, in which order. And the simulated
//! NAO, in a room that is alike, senses and is told the same.

use crate::nao::{Nao, PATIENCE};
use behaviour::{BehaviourFile, Id, StreamKind, Value};
use engine::{Emission, Limits, Run, StreamIx};
use robot::{Health, Millis, Reading, Robot, SceneEdit, Touchable, Use};
use serde_json::{Value as Json, json};
use simulation::SimulatedNao;
use std::collections::{BTreeMap, BTreeSet};
use std::time::{Duration, Instant};

/// Robot time of a step in milliseconds.
const STEP_MS: u64 = 10;
/// A step may take less on the clock where nothing of the robot's takes its time.
const QUICK: Manner = Manner { step: Duration::from_millis(4), settles: false };
/// Faces are told to be new after eight seconds.
const AS_THE_CLOCK: Manner = Manner { step: Duration::from_millis(STEP_MS), settles: false };
/// A head that turns is told a moment later where it is: an arm may be chosen in between that is not the nearest.
const SETTLES: Manner = Manner { step: Duration::from_millis(4), settles: true };
/// Steps in which senses begin.
const BEGIN: usize = 150;
/// Robot time in which the simulated NAO comes to rest after a change, in milliseconds.
const SETTLED_MS: u64 = 24_000;
/// How far angles and sizes may be apart, in radians; a head that follows is still on its way.
const ANGLE: f64 = 0.02;
const FOLLOWED: f64 = 0.1;

/// Ahead and near the height of the camera, and where the robot does not look.
const AHEAD: [f32; 3] = [0.60, 0.0, 0.45];
const BEHIND: [f32; 3] = [-1.0, 0.5, 0.45];

/// What acts on the robot; everything else asks, listens or prepares.
const ACTING: [&str; 14] = [
    "fadeRGB",
    "goToPosture",
    "learnFace",
    "move",
    "playFile",
    "playSine",
    "registerTarget",
    "run",
    "say",
    "setAngles",
    "setEffector",
    "setIntensity",
    "setMode",
    "track",
];

/// What somebody does in both rooms.
#[derive(Clone, Copy)]
enum Act {
    Ball(&'static str, [f32; 3]),
    Person(bool),
    Touch(bool),
}

impl Act {
    fn in_the_stand_in(self) -> Json {
        match self {
            Self::Ball(id, at) => json!({"balls": {id: {"at": at}}}),
            Self::Person(present) => json!({"people": {"person": {"present": present}}}),
            Self::Touch(down) => json!({"touch": {"part": "FrontTactilTouched", "down": down}}),
        }
    }

    fn in_the_simulation(self) -> SceneEdit {
        match self {
            Self::Ball(id, at) => SceneEdit::MoveBall { id: id.to_owned(), at },
            Self::Person(present) => SceneEdit::SetPresent { id: "person".to_owned(), present },
            Self::Touch(down) => SceneEdit::Touch { part: Touchable::HeadFront, down },
        }
    }
}

/// What somebody does, and what is called then.
type Scene<'a> = (&'a [Act], &'a [&'a str]);

/// How a template is played.
#[derive(Clone, Copy)]
struct Manner {
    /// How long a step takes on the clock, at least.
    step: Duration,
    /// Whether only what is called last of a scene is looked at.
    settles: bool,
}

/// A template that runs on a robot.
struct Playing<R> {
    robot: R,
    run: Run,
    uses: Vec<Use>,
    actions: BTreeMap<StreamIx, Use>,
    now: u64,
    /// The newest reading of each sense.
    sensed: BTreeMap<String, Value>,
    /// What actions were told, without what comes again.
    told: Vec<(String, Value)>,
    troubles: Vec<String>,
}

impl<R: Robot> Playing<R> {
    fn new(template: &str, robot: R) -> Self {
        let path = house::root().join("tests/behaviours").join(template).with_extension("json");
        let file: BehaviourFile = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        let run = Run::build(&file, Limits::default()).unwrap();
        let (sensed, actions) = (BTreeMap::new(), BTreeMap::new());
        let mut this =
            Self { robot, run, uses: Vec::new(), actions, now: 0, sensed, told: Vec::new(), troubles: Vec::new() };
        for (index, info) in this.run.streams().enumerate() {
            if let Some(device) = &info.device {
                let user = Use { run: 1, stream: Id::new(&info.id).unwrap() };
                this.robot.open(&user, device, &info.params).unwrap();
                this.uses.push(user.clone());
                if info.kind == StreamKind::Actuator {
                    this.actions.insert(index, user);
                }
            }
        }
        this
    }

    fn step(&mut self) {
        self.now += STEP_MS;
        let (now, mut readings, mut emitted) = (Millis(self.now), Vec::<Reading>::new(), Vec::new());
        self.robot.poll(now, &mut readings);
        let mut note = |emission: Emission| match emission {
            Emission::Value { stream, value, .. } => emitted.push((stream, value.clone())),
            Emission::Fault { error, .. } => self.troubles.push(error.to_string()),
        };
        for reading in readings {
            self.sensed.insert(reading.to.stream.to_string(), reading.value.clone());
            let stream = self.run.stream_index(reading.to.stream.as_str()).unwrap();
            self.run.feed(reading.at.max(now), stream, reading.value, &mut note);
        }
        self.run.until(now, &mut note);
        for (stream, value) in emitted {
            let Some(user) = self.actions.get(&stream) else { continue };
            if let Err(fault) = self.robot.command(user, &value, now) {
                self.troubles.push(fault.to_string());
            }
            let told = (user.stream.to_string(), value);
            if self.told.last() != Some(&told) {
                self.told.push(told);
            }
        }
    }
}

/// Calls that act, in words, without what comes again.
async fn acted(nao: &Nao) -> Vec<String> {
    let word = |argument: &Json| match argument {
        Json::String(text) => text.clone(),
        Json::Number(number) if number.is_f64() => format!("{:.2}", number.as_f64().unwrap()),
        other => other.to_string(),
    };
    let calls = nao.told("calls").await;
    let acts = calls.as_array().unwrap().iter().filter(|call| ACTING.contains(&call["method"].as_str().unwrap()));
    let mut said: Vec<String> = acts
        .map(|call| {
            let arguments: Vec<String> = call["args"].as_array().unwrap().iter().map(word).collect();
            let (service, method) = (call["service"].as_str().unwrap(), call["method"].as_str().unwrap());
            format!("{service}.{method}({})", arguments.join(", "))
        })
        .collect();
    said.dedup();
    said
}

/// Plays it on both robots; answers with both, and with what was called at the end.
async fn play(
    template: &str,
    scenes: &[Scene<'_>],
    manner: Manner,
) -> Option<(Playing<::nao::Nao>, Playing<SimulatedNao>)> {
    let peer = Nao::start(&format!("the template {template} on the stand-in"), &[]).await?;
    for ball in ["red", "green", "blue"] {
        peer.world(Act::Ball(ball, BEHIND).in_the_stand_in()).await;
    }
    let settings = ::nao::Settings { address: peer.address(), login: None, own_name: "rrp-test".into(), trusted: None };
    let mut robot = ::nao::Nao::start(settings);
    let mut end = Instant::now() + PATIENCE;
    while robot.health() != Health::Ready {
        assert!(Instant::now() < end, "{:?}", robot.health());
        robot.poll(Millis(0), &mut Vec::new());
        tokio::time::sleep(QUICK.step).await;
    }
    let mut real = Playing::new(template, robot);
    for _ in 0..BEGIN {
        real.step();
        tokio::time::sleep(QUICK.step).await;
    }
    let mut wanted: Vec<String> = Vec::new();
    for (acts, calls) in scenes {
        for act in *acts {
            peer.world(act.in_the_stand_in()).await;
        }
        wanted.extend(calls.iter().map(|call| (*call).to_owned()));
        end = Instant::now() + PATIENCE;
        // What senses say now is waited for too: nothing may be called for what was there before.
        for step in 0_u64.. {
            real.step();
            tokio::time::sleep(manner.step).await;
            if step % 25 == 24 {
                let called = acted(&peer).await;
                let is_there = if manner.settles {
                    called.iter().map(String::as_str).rev().take(calls.len()).eq(calls.iter().rev().copied())
                } else {
                    assert!(wanted.starts_with(&called), "{template}: {called:#?}, not {wanted:#?}");
                    called == wanted
                };
                if is_there && step > 100 {
                    break;
                }
                assert!(Instant::now() < end, "{template}: {called:#?}, not {wanted:#?}; {:?}", real.troubles);
            }
        }
    }
    real.robot.stop(Millis(real.now));
    for user in real.uses.clone() {
        real.robot.close(&user);
    }
    peer.until("nothing is measured for it", |state| !state["subscribers"].to_string().contains("rrp-test")).await;
    peer.until("it is still", |state| state["tracking"].is_null() && state["moving"] == json!(false)).await;
    assert_eq!(peer.told("state").await["violations"], json!([]), "{template}");
    Some((real, simulate(template, scenes)))
}

fn simulate(template: &str, scenes: &[Scene<'_>]) -> Playing<SimulatedNao> {
    let mut nao = SimulatedNao::new(7);
    for ball in ["red", "green", "blue"] {
        nao.edit(&Act::Ball(ball, BEHIND).in_the_simulation()).unwrap();
    }
    let mut playing = Playing::new(template, nao);
    for (acts, _) in scenes {
        for act in *acts {
            playing.robot.edit(&act.in_the_simulation()).unwrap();
        }
        (0..SETTLED_MS / STEP_MS).for_each(|_| playing.step());
    }
    playing
}

/// The same streams sensed the same things at the end: shapes, units and values.
fn sense_alike(template: &str, both: &(Playing<::nao::Nao>, Playing<SimulatedNao>), within: f64) {
    let (real, simulated) = both;
    let names = |of: &BTreeMap<String, Value>| of.keys().cloned().collect::<BTreeSet<_>>();
    assert_eq!(names(&real.sensed), names(&simulated.sensed), "{template}");
    for (stream, value) in &real.sensed {
        alike(&format!("{template}, {stream}"), value, &simulated.sensed[stream], within);
    }
    assert_eq!((&real.troubles, &simulated.troubles), (&vec![], &vec![]), "{template}");
}

/// Numbers that are near each other, the rest equal. Times are those of two clocks, and so is how long a face is there.
fn alike(what: &str, one: &Value, other: &Value, within: f64) {
    let fields =
        |of: &Value| serde_json::to_value(of).unwrap().as_object().map(|all| all.keys().cloned().collect::<Vec<_>>());
    if let (Some(fields_of_one), Some(fields_of_other)) = (fields(one), fields(other)) {
        assert_eq!(fields_of_one, fields_of_other, "{what}");
        for name in fields_of_one.iter().filter(|name| !["time", "recognized_new_face"].contains(&name.as_str())) {
            alike(&format!("{what}.{name}"), one.field(name).unwrap(), other.field(name).unwrap(), within);
        }
        return;
    }
    match (one.as_number(), other.as_number()) {
        (Some(one), Some(other)) => assert!((one - other).abs() <= within, "{what}: {one} and {other}"),
        _ => assert_eq!(one, other, "{what}"),
    }
}

/// The same actions were told the same, in the same order.
fn told_alike(template: &str, both: &(Playing<::nao::Nao>, Playing<SimulatedNao>), within: f64) {
    let (real, simulated) = (&both.0.told, &both.1.told);
    let streams = |told: &[(String, Value)]| told.iter().map(|told| told.0.clone()).collect::<Vec<_>>();
    assert_eq!(streams(real), streams(simulated), "{template}");
    for ((stream, one), (_, other)) in real.iter().zip(simulated) {
        alike(&format!("{template}, {stream}"), one, other, within);
    }
}

const RED_EYES: &str = "ALLeds.fadeRGB(FaceLeds, 16711680, 0.10)";
const GREEN_EYES: &str = "ALLeds.fadeRGB(FaceLeds, 65280, 0.10)";

/// What is called to follow.
macro_rules! follow {
    ($mode:literal, $effector:literal) => {
        [
            "ALTracker.registerTarget(RedBall, 0.06)",
            concat!("ALTracker.setMode(", $mode, ")"),
            concat!("ALTracker.setEffector(", $effector, ")"),
            "ALTracker.track(RedBall)",
        ]
    };
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn reflect_ball_color() {
    let scenes: [Scene; 2] = [
        (&[Act::Ball("red", AHEAD)], &[RED_EYES]),
        (&[Act::Ball("red", BEHIND), Act::Ball("green", AHEAD)], &[GREEN_EYES]),
    ];
    let Some(both) = play("reflect_ball_color", &scenes, QUICK).await else { return };
    sense_alike("reflect_ball_color", &both, ANGLE);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn say_ball_color() {
    let scenes: [Scene; 2] = [
        (&[Act::Ball("red", AHEAD)], &["ALTextToSpeech.say(Red)"]),
        (&[Act::Ball("red", BEHIND), Act::Ball("green", AHEAD)], &["ALTextToSpeech.say(Green)"]),
    ];
    let Some(both) = play("say_ball_color", &scenes, QUICK).await else { return };
    sense_alike("say_ball_color", &both, ANGLE);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn say_ball_color_merge() {
    let scenes: [Scene; 2] = [
        (&[Act::Ball("red", AHEAD)], &["ALTextToSpeech.say(red)"]),
        (&[Act::Ball("red", BEHIND), Act::Ball("green", AHEAD)], &["ALTextToSpeech.say(green)"]),
    ];
    let Some(both) = play("say_ball_color_merge", &scenes, QUICK).await else { return };
    sense_alike("say_ball_color_merge", &both, ANGLE);
    told_alike("say_ball_color_merge", &both, ANGLE);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn distance_to_brightness() {
    let Some(both) = play(
        "distance_to_brightness",
        &[(&[Act::Ball("red", AHEAD)], &["ALLeds.setIntensity(FaceLeds, 0.65)"])],
        QUICK,
    )
    .await
    else {
        return;
    };
    sense_alike("distance_to_brightness", &both, ANGLE);
    alike("the brightness", &both.0.told.last().unwrap().1, &both.1.told.last().unwrap().1, 0.05);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn track_far_and_close() {
    let (far, close) = ([1.20, 0.45, 0.45], [0.32, 0.10, 0.45]);
    let scenes: [Scene; 2] = [
        (&[Act::Ball("red", far)], &follow!("Head", "None")),
        (&[Act::Ball("red", close)], &follow!("WholeBody", "None")),
    ];
    let Some(both) = play("track_far_and_close", &scenes, QUICK).await else { return };
    sense_alike("track_far_and_close", &both, FOLLOWED);
}

/// Left, then right, without leaving the sight of a head that has turned to it.
async fn nearest_arm(template: &str) {
    let (left, right) = ([0.32, 0.06, 0.42], [0.32, -0.05, 0.42]);
    let scenes: [Scene; 2] =
        [(&[Act::Ball("red", left)], &follow!("Head", "LArm")), (&[Act::Ball("red", right)], &follow!("Head", "RArm"))];
    let Some((real, simulated)) = play(template, &scenes, SETTLES).await else { return };
    assert_eq!((&real.troubles, &simulated.troubles), (&vec![], &vec![]), "{template}");
    assert_eq!((real.told.first(), real.told.last()), (simulated.told.first(), simulated.told.last()), "{template}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn track_nearest_arm() {
    nearest_arm("track_nearest_arm").await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn track_nearest_arm_in_time() {
    nearest_arm("track_nearest_arm_in_time").await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn greeter() {
    let scenes: [Scene; 1] = [(
        &[Act::Person(true)],
        &["ALTextToSpeech.say(Hello)", "ALFaceDetection.learnFace(face 1)", "ALTextToSpeech.say(Hello Again)"],
    )];
    let Some(both) = play("greeter", &scenes, AS_THE_CLOCK).await else { return };
    sense_alike("greeter", &both, ANGLE);
    told_alike("greeter", &both, ANGLE);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn hello_once() {
    let scenes: [Scene; 3] = [
        (&[Act::Person(true)], &["ALTextToSpeech.say(Hello)"]),
        (&[Act::Person(false)], &[]),
        (&[Act::Person(true)], &[]),
    ];
    let Some(both) = play("hello_once", &scenes, QUICK).await else { return };
    sense_alike("hello_once", &both, ANGLE);
    told_alike("hello_once", &both, ANGLE);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn goodbye() {
    let scenes: [Scene; 2] = [(&[Act::Person(true)], &[]), (&[Act::Person(false)], &["ALTextToSpeech.say(Goodbye)"])];
    let Some(both) = play("goodbye", &scenes, QUICK).await else { return };
    sense_alike("goodbye", &both, ANGLE);
    told_alike("goodbye", &both, ANGLE);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn count_my_touches() {
    let touched: &[Act] = &[Act::Touch(true)];
    let scenes: [Scene; 4] = [
        (touched, &["ALTextToSpeech.say(1)"]),
        (&[Act::Touch(false)], &[]),
        (touched, &["ALTextToSpeech.say(2)"]),
        (&[Act::Touch(false)], &[]),
    ];
    let Some(both) = play("count_my_touches", &scenes, QUICK).await else { return };
    sense_alike("count_my_touches", &both, 0.0);
    told_alike("count_my_touches", &both, 0.5);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn touch_to_tell_the_color() {
    let scenes: [Scene; 3] = [
        (&[Act::Ball("red", AHEAD)], &[]),
        (&[Act::Touch(true)], &["ALTextToSpeech.say(red)"]),
        (&[Act::Touch(false), Act::Ball("red", BEHIND)], &[]),
    ];
    let Some(both) = play("touch_to_tell_the_color", &scenes, QUICK).await else { return };
    sense_alike("touch_to_tell_the_color", &both, ANGLE);
    told_alike("touch_to_tell_the_color", &both, ANGLE);
}

#[test]
fn every_template_is_played() {
    let folder = std::fs::read_dir(house::root().join("tests/behaviours")).unwrap();
    let files = folder.map(|file| file.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned());
    let own = include_str!("templates.rs");
    let missing: Vec<String> = files.filter(|name| !own.contains(&format!("async fn {name}()"))).collect();
    assert_eq!(missing, [""; 0]);
}
