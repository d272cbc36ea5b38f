//! The time of a call, beside the client of libqi on the same peer.
//!
//! `RRP_QI_PYTHON=… cargo test -p qi --release latency -- --ignored --nocapture`

use std::time::{Duration, Instant};

use qi::Value;

use crate::real_peer::{everything, python, script};

const CALLS: usize = 5000;
const ROUNDS: usize = 3;

#[tokio::test]
#[ignore = "it measures"]
async fn a_call_is_measured_beside_libqi_on_one_thread() {
    measure().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "it measures"]
async fn a_call_is_measured_beside_libqi_on_two_threads() {
    // As a server's calls are: from a task of the runtime, not from the thread that waits for it.
    tokio::spawn(measure()).await.unwrap();
}

async fn measure() {
    let Some((peer, session, object)) = everything("the time of calls").await else { return };
    let python = python("the time of calls").unwrap();
    for round in 1..=ROUNDS {
        let mut taken = Vec::with_capacity(CALLS);
        for call in 0..CALLS {
            let began = Instant::now();
            let angle = Value::from(call as f64 / CALLS as f64);
            object.call("setAngles", &["HeadYaw".into(), angle, 0.1.into()]).await.unwrap();
            taken.push(began.elapsed().as_secs_f64() * 1e6);
        }
        taken.sort_by(f64::total_cmp);
        let mut pings = Vec::with_capacity(CALLS);
        for _ in 0..CALLS {
            pings.push(session.link().ping(Duration::from_secs(60)).await.unwrap().as_secs_f64() * 1e6);
        }
        pings.sort_by(f64::total_cmp);
        let ours = [taken[CALLS / 2], taken[CALLS * 99 / 100]];
        let output = script(&python, &["calls", &peer.address, &CALLS.to_string()]).output().unwrap();
        // libqi logs to the same place.
        let said = String::from_utf8(output.stdout).unwrap();
        let theirs: Vec<f64> =
            said.lines().last().unwrap().split_whitespace().map(|number| number.parse().unwrap()).collect();
        eprintln!(
            "round {round}: setAngles p50 {:.0} µs, p99 {:.0} µs; libqi's Python {:.0} µs, {:.0} µs; ratio {:.2}, {:.2}; ping {:.0} µs",
            ours[0],
            ours[1],
            theirs[0],
            theirs[1],
            ours[0] / theirs[0],
            ours[1] / theirs[1],
            pings[CALLS / 2],
        );
    }
}
