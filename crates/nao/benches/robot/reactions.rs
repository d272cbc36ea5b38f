//! From an event of the robot to the call that it causes, both as the stand-in notes them: when the event is raised, and when
//! the call comes.

use crate::client::Client;
use crate::figures::{Times, Verdict, micros, title};
use crate::peer::{PATIENCE, Peer};
use behaviour::{Params, Value};
use engine::{Emission, Limits, Run};
use nao::{Nao, RobotSettings};
use qi::{EventChoice, Session, SessionOptions};
use robot::{Health, Millis, Robot, Use};
use serde_json::{Value as Json, json};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, mpsc};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Touches of each way in a turn, and turns. The ways of one turn are compared with each other, as everything else on this
/// computer changes meanwhile; whoever begins is another one each turn.
const TOUCHES: usize = 40;
const TURNS: usize = 9;
/// Round trips between two bare threads.
const BARE: usize = 2_000;
/// Pause between a touch and its end, which falls into every part of the steps and cycles; what is spoken is over by then.
const UNEVEN_US: u64 = 28_371;
/// The bar of what is added, in microseconds, and of the whole beside the Python client.
const BAR_US: f64 = 1_000.0;
const BAR: f64 = 1.1;
const KEY: &str = "FrontTactilTouched";
/// The time between two polls of the server, beside what the robot rings for.
const STEP: Duration = Duration::from_millis(10);

/// The ways to react.
#[derive(Clone, Copy)]
enum Way {
    Python,
    Qi,
    /// Through `nao` and a behaviour.
    Nao,
}

/// Words are told as they come; of joints the first after a quiet cycle is, and then the newest once a cycle.
pub(crate) async fn measure(verdict: &mut Verdict) {
    let Some(peer) = Peer::start("the benchmark of reactions", &[]).await else { return };
    peer.world(json!({"speech_ms_per_char": 0})).await;
    let robot = Watched::at(&peer.address).await;
    let ways = [Way::Python, Way::Qi, Way::Nao];
    let (python, qi) = ("Python client: signal.connect, then the call", "qi alone: the same loop");
    let nao = "nao and engine, as the server asks";
    for (action, name) in [("say", "ALTextToSpeech.say"), ("setAngles", "ALMotion.setAngles")] {
        let mut times: [Times; 3] = Default::default();
        let (mut beside, mut added) = (Times::default(), Times::default());
        for turn in 0..TURNS {
            let mut p50 = [0.0; 3];
            for at in (0..ways.len()).map(|at| (at + turn) % ways.len()) {
                let found = Times(robot.turn(&peer.address, ways[at], action, name).await);
                p50[at] = found.within(50);
                times[at].0.extend(found.0);
            }
            beside.0.push(p50[2] / p50[0]);
            added.0.push(p50[2] - p50[1]);
        }
        title(&format!("from a touch to {name}"), "by Python");
        for (what, found) in [python, qi, nao].iter().zip(&times) {
            found.print(what, Some(&times[0]));
        }
        println!(
            "  (two bare threads need {:.3} ms there and back, p50: the machine's own part)",
            bare().within(50) / 1e3
        );
        verdict.at_most("event to action, added by nao and engine to qi alone, p50", added.within(50), BAR_US);
        let ratio = beside.within(50);
        verdict.ratio_at_most("event to action beside the Python client, p50 of the turns", ratio, BAR);
    }
}

/// Measures how long it takes to wake another thread and to be woken by it, in microseconds.
fn bare() -> Times {
    let (ask, asked) = mpsc::sync_channel::<()>(0);
    let (answer, answered) = mpsc::sync_channel::<()>(0);
    let other = std::thread::spawn(move || asked.iter().all(|()| answer.send(()).is_ok()));
    let mut times = Times::default();
    for _ in 0..BARE {
        std::thread::sleep(Duration::from_micros(200));
        let began = Instant::now();
        ask.send(()).unwrap();
        answered.recv().unwrap();
        times.0.push(micros(began.elapsed()));
    }
    drop(ask);
    other.join().unwrap();
    times
}

/// The stand-in, and what is asked of it.
pub(crate) struct Watched(Session);

impl Watched {
    pub(crate) async fn at(address: &str) -> Self {
        Self(Session::connect(&format!("tcp://{address}").parse().unwrap(), SessionOptions::default()).await.unwrap())
    }

    pub(crate) async fn told(&self, what: &str) -> Json {
        let said = self.0.service("StandIn").await.unwrap().call(what, &[]).await.unwrap();
        serde_json::from_str(&said.as_text().unwrap_or("null".into())).unwrap()
    }

    /// Touches it again and again while somebody reacts.
    async fn turn(&self, address: &str, way: Way, action: &'static str, name: &str) -> Vec<f64> {
        let reacting = Reacting::start(address, way, action);
        while !self.told("state").await["listened"].to_string().contains(KEY) {
            tokio::time::sleep(STEP).await;
        }
        self.told_nothing("clear").await;
        let memory = self.0.service("ALMemory").await.unwrap();
        for number in 1..=TOUCHES {
            for value in [1.0_f32, 0.0] {
                memory.call("raiseEvent", &[KEY.into(), qi::Value::dynamic(value)]).await.unwrap();
                tokio::time::sleep(Duration::from_micros(UNEVEN_US)).await;
                // However late: what comes after the next touch would count for that.
                let began = Instant::now();
                while self.count(name).await < number {
                    assert!(began.elapsed() < PATIENCE, "a touch without {name}");
                    tokio::time::sleep(STEP).await;
                }
            }
        }
        let calls = self.told("calls").await;
        drop(reacting);
        while self.told("state").await["listened"].to_string().contains(KEY) {
            tokio::time::sleep(STEP).await;
        }
        passages(&calls, name)
    }

    /// Returns how often it was called so.
    async fn count(&self, name: &str) -> usize {
        self.told("calls").await.as_array().unwrap().iter().filter(|call| called(call) == name).count()
    }

    async fn told_nothing(&self, what: &str) {
        self.0.service("StandIn").await.unwrap().call(what, &[]).await.unwrap();
    }
}

fn called(call: &Json) -> String {
    format!("{}.{}", call["service"].as_str().unwrap(), call["method"].as_str().unwrap())
}

/// From each touch to the call before the next; every touch has one.
fn passages(calls: &Json, name: &str) -> Vec<f64> {
    let (mut touched, mut taken) = (None, Vec::new());
    for call in calls.as_array().unwrap() {
        let at = call["monotonic_us"].as_f64().unwrap();
        let called = called(call);
        if called == "ALMemory.raiseEvent" && call["args"][1].as_f64() == Some(1.0) {
            assert_eq!(touched.replace(at), None, "a touch without {name}");
        } else if called == name {
            taken.extend(touched.take().map(|touched| at - touched));
        }
    }
    assert_eq!(taken.len(), TOUCHES, "calls of {name}");
    taken
}

/// Reacts until it is dropped.
enum Reacting {
    Python(Client),
    Thread(Arc<AtomicBool>, Option<JoinHandle<()>>),
}

impl Reacting {
    fn start(address: &str, way: Way, action: &'static str) -> Self {
        let (ended, address) = (Arc::new(AtomicBool::new(false)), address.to_owned());
        let over = Arc::clone(&ended);
        let thread = match way {
            Way::Python => {
                let mut client = Client::at(&address);
                client.react(action);
                return Self::Python(client);
            }
            Way::Qi => std::thread::spawn(move || by_qi(&address, action, &over)),
            Way::Nao => std::thread::spawn(move || by_nao(address, action, &over)),
        };
        Self::Thread(ended, Some(thread))
    }
}

impl Drop for Reacting {
    fn drop(&mut self) {
        match self {
            Self::Python(client) => client.rest(),
            Self::Thread(ended, thread) => {
                ended.store(true, Ordering::SeqCst);
                thread.take().unwrap().join().unwrap();
            }
        }
    }
}

/// Hears and calls, nothing else; on one thread, as `nao` has its link.
fn by_qi(address: &str, action: &str, ended: &AtomicBool) {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
    runtime.block_on(async {
        let session =
            Session::connect(&format!("tcp://{address}").parse().unwrap(), SessionOptions::default()).await.unwrap();
        let memory = session.service("ALMemory").await.unwrap();
        let service = if action == "say" { "ALTextToSpeech" } else { "ALMotion" };
        let does = session.service(service).await.unwrap();
        let subscriber = memory.call_object("subscriber", &[KEY.into()]).await.unwrap();
        let mut signal = subscriber.subscribe("signal", EventChoice::All(16)).await.unwrap();
        let mut number = 0;
        while !ended.load(Ordering::SeqCst) {
            let Ok(event) = tokio::time::timeout(STEP * 10, signal.next()).await else { continue };
            if event.unwrap().arguments[0].as_f64().unwrap() > 0.5 {
                number += 1;
                let words = vec![number.to_string().into()];
                let arguments = if action == "say" { words } else { crate::calls::set_angles(number) };
                let (does, action) = (does.clone(), action.to_owned());
                tokio::spawn(async move { does.call(&action, &arguments).await.unwrap() });
            }
        }
    });
}

/// Reacts as the server does it, on one thread instead of two: readings into the behaviour, its commands to the robot.
fn by_nao(address: String, action: &str, ended: &AtomicBool) {
    let settings = RobotSettings {
        address,
        login: None,
        own_name: "rrp-bench".to_owned(),
        trusted: None,
        expected: None,
        former: Vec::new(),
    };
    let mut nao = Nao::start(settings);
    while nao.health() != Health::Ready {
        std::thread::sleep(STEP);
    }
    let user = |stream: &str| Use { run: 1, stream: behaviour::Id::new(stream).unwrap() };
    let (touch, does) = (user("touch"), user("does"));
    let joint = Params::from([("joint".to_owned(), Value::text("HeadYaw"))]);
    let (device, params) = if action == "say" { ("SayInput", Params::new()) } else { ("SetJointPosition", joint) };
    nao.open(&does, device, &params).unwrap();
    nao.open(&touch, "HeadTouch", &Params::from([("part".to_owned(), Value::text("front"))])).unwrap();
    let mut run = Run::build(&behaviour(), Limits::default()).ok().unwrap();
    let (from, to) = (run.stream_index("touch").unwrap(), run.stream_index("does").unwrap());
    let (began, mut readings) = (Instant::now(), Vec::new());
    let mut due = began;
    let thread = std::thread::current();
    nao.wake_with(Arc::new(move || thread.unpark()));
    while !ended.load(Ordering::SeqCst) {
        let now = Millis(u64::try_from(began.elapsed().as_millis()).unwrap());
        if due <= Instant::now() {
            nao.poll(now, &mut readings);
            due += STEP;
        } else {
            nao.sense(&mut readings);
        }
        for reading in readings.drain(..) {
            run.feed(now, from, reading.value, &mut |told| {
                if let Emission::Value { stream, value, .. } = told
                    && stream == to
                {
                    nao.command(&does, value, now).unwrap();
                }
            });
        }
        run.until(now, &mut |_| {});
        std::thread::park_timeout(due.saturating_duration_since(Instant::now()));
    }
    nao.close(&touch);
    nao.close(&does);
}

/// Every touch becomes a number, and that is said or looked at.
fn behaviour() -> behaviour::BehaviourFile {
    let stream = |id: &str, kind: &str| json!({"id": id, "kind": kind, "name": id});
    let map = json!({"id": "map", "type": "map", "inputs": ["touch"], "output": "number", "args": ["x"],
        "body": "if x { 0.5 } else { 0.0 }"});
    let subscribe = json!({"id": "subscribe", "type": "subscribe", "inputs": ["number"], "output": "does"});
    let streams = [stream("touch", "sensor"), stream("number", "ordinary"), stream("does", "actuator")];
    let file = json!({"format": "rrp-behaviour/1", "name": "", "helpers": [], "streams": streams,
        "connectors": [map, subscribe]});
    serde_json::from_value(file).unwrap()
}
