//! Measures how long a call takes, from before its arguments are written until its answer is read.

use crate::client::Client;
use crate::driver::Driver;
use crate::figures::{Times, Verdict, computed_us, micros, monotonic_us, title};
use crate::peer::Peer;
use crate::reactions::Watched;
use behaviour::Value;
use qi::{Session, SessionOptions, Value as Said};
use robot::{Millis, Robot};
use serde_json::json;
use std::time::{Duration, Instant};

/// Calls of each kind in a round, and rounds; who is measured takes turns.
const CALLS: usize = 250;
const ROUNDS: usize = 20;
/// The methods that are called, each with its name here and in `client.py`.
const KINDS: [(&str, &str); 3] = [
    ("ServiceDirectory.machineId, answered by libqi", "machineId"),
    ("ALMotion.ping, an empty function in Python", "ping"),
    ("ALMotion.setAngles", "setAngles"),
];
/// The first ones of each are not counted: connections, caches and branch predictors get warm.
const WARM: usize = 200;
/// The bar of our own share of a call, in microseconds: what our thread computes for it. The rest is the peer's, and the way.
const BAR_US: f64 = 60.0;
/// Values told to an action, and steps between them.
const TOLD: i64 = 300;
const STEPS: usize = 8;
const WITHIN: Duration = Duration::from_secs(2);

/// One after the other, by `qi` and by Python.
pub(crate) async fn measure(verdict: &mut Verdict) {
    let Some(peer) = Peer::start("the benchmark of calls", &[]).await else { return };
    let address = peer.address.clone();
    let (ours, python, cpu_us) = tokio::task::spawn_blocking(move || turns(&address)).await.unwrap();
    title("calls, from call to answer", "by Python");
    for ((kind, _), (ours, python)) in KINDS.iter().zip(ours.iter().zip(&python)) {
        python.print(&format!("{kind}: Python client"), None);
        ours.print(&format!("{kind}: qi"), Some(python));
    }
    let told = told(&peer).await;
    told.print("a value told to nao, until the stand-in has the call of its action", None);
    let own_us = ours[2].within(50) - ours[0].within(50);
    println!("  (a setAngles takes {:.3} ms more than what libqi answers: Python in the stand-in)", own_us / 1e3);
    println!("  (all of these take {:.3} ms of the computing time of qi's thread, on average)", cpu_us / 1e3);
    verdict.at_most("our own share of a call, on average", cpu_us, BAR_US);
}

/// From a value that an action is told until its call is noted; what is spoken is over before the next.
async fn told(peer: &Peer) -> Times {
    peer.world(json!({"speech_ms_per_char": 0})).await;
    let robot = Watched::at(&peer.address).await;
    let mut driver = Driver::at(&peer.address).await;
    let say = driver.open("say", "SayInput", &[]);
    let mut began = Vec::new();
    for number in 0..TOLD {
        began.push(monotonic_us());
        let told = driver.nao.command(&say, &Value::Int(number), Millis(0));
        assert_eq!(
            told,
            Ok(()),
            "value {number}: {:?} {:?} {:?}",
            driver.nao.health(),
            driver.nao.condition(),
            driver.nao.take_halt()
        );
        driver.wait(STEPS).await;
    }
    let calls = robot.told("calls").await;
    let calls = calls.as_array().unwrap().iter().filter(|call| call["method"] == "say");
    let noted: Vec<f64> = calls.map(|call| call["monotonic_us"].as_f64().unwrap()).collect();
    assert_eq!(noted.len(), began.len());
    Times(noted.into_iter().zip(began).map(|(noted, began)| noted - began).collect())
}

/// Ours, those of Python, and microseconds of computing that each of ours took of its thread.
fn turns(address: &str) -> ([Times; KINDS.len()], [Times; KINDS.len()], f64) {
    // As `nao` has it: everything of a link on one thread.
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
    let session =
        runtime.block_on(Session::connect(&format!("tcp://{address}").parse().unwrap(), SessionOptions::default()));
    let (session, mut client) = (session.unwrap(), Client::at(address));
    let (mut ours, mut python): ([Times; KINDS.len()], [Times; KINDS.len()]) = Default::default();
    for (_, what) in KINDS {
        runtime.block_on(calls(&session, what, WARM));
        client.calls(what, WARM);
    }
    let mut cpu = 0.0;
    for _ in 0..ROUNDS {
        for (at, (_, what)) in KINDS.into_iter().enumerate() {
            let began = computed_us();
            ours[at].0.extend(runtime.block_on(calls(&session, what, CALLS)));
            cpu += computed_us() - began;
            python[at].0.extend(client.calls(what, CALLS));
        }
    }
    let count = ROUNDS * CALLS * KINDS.len();
    (ours, python, cpu / count as f64)
}

async fn calls(session: &Session, what: &str, count: usize) -> Vec<f64> {
    let mut taken = Vec::with_capacity(count);
    for number in 0..count {
        let began = Instant::now();
        let service = if what == "machineId" { "ServiceDirectory" } else { "ALMotion" };
        let arguments = if what == "setAngles" { set_angles(number) } else { Vec::new() };
        let object = session.service(service).await.unwrap();
        object.call_within(what, &arguments, WITHIN).await.unwrap();
        taken.push(micros(began.elapsed()));
    }
    taken
}

/// The arguments as `nao` writes them; `client.py` has the same.
pub(crate) fn set_angles(number: usize) -> Vec<Said> {
    let names = Said::List(vec!["HeadYaw".into()]);
    let angles = Said::List(vec![Said::F32((number % 7) as f32 / 10.0)]);
    vec![Said::dynamic(names), Said::dynamic(angles), Said::F32(0.3)]
}
