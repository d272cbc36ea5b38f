//! The robot's thread and the runs' threads, with a puppet for a robot and with the simulated NAO.

mod applying;
mod between;
mod by_hand;
mod connecting;
mod ending;
mod half_hour;
mod halting;
mod identities;
mod multiplying;
mod puppet;
mod recording;
mod replayed;
mod running;
mod several;
mod simulated;
mod stopping;
mod threads;
mod together;

use super::{Host, StartOrder};
use behaviour::{BehaviourFile, FORMAT, FileConnector, FileStream, Id, StreamKind, Value};
use protocol::{RecordedSession, RunPhase, RunState};
use puppet::Puppet;
use std::time::{Duration, Instant};

/// Long enough for a busy machine; nothing here measures time.
const PATIENCE_S: u64 = 30;

async fn until(what: &str, mut is_so: impl FnMut() -> bool) {
    let end = Instant::now() + Duration::from_secs(PATIENCE_S);
    while !is_so() {
        assert!(Instant::now() < end, "never: {what}");
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
}

fn id(text: &str) -> Id {
    Id::new(text).unwrap()
}

/// A behaviour: a ball, a filter with this body, and a text on the page.
fn filtered(name: &str, body: &str) -> StartOrder {
    let stream = |id: &str, kind, device: Option<&str>| FileStream {
        id: id.to_owned(),
        kind,
        name: id.to_owned(),
        device: device.map(str::to_owned),
        params: None,
        resources: None,
        priority: None,
        hold_ms: None,
    };
    let connector = |id: &str, operation: &str, from: &str, to: &str, body: Option<&str>| FileConnector {
        id: id.to_owned(),
        operation: operation.to_owned(),
        inputs: vec![from.to_owned()],
        output: to.to_owned(),
        body: body.map(str::to_owned),
        args: None,
        helper: None,
        period_ms: None,
        start: None,
    };
    let file = BehaviourFile {
        format: FORMAT.to_owned(),
        id: None,
        name: name.to_owned(),
        robot: None,
        engine: None,
        exercise: None,
        tags: Vec::new(),
        helpers: Vec::new(),
        streams: vec![
            stream("ball", StreamKind::Sensor, Some("RedBall")),
            stream("good", StreamKind::Ordinary, None),
            stream("page", StreamKind::Actuator, Some("Print")),
        ],
        connectors: vec![
            connector("test", "filter", "ball", "good", Some(body)),
            connector("show", "subscribe", "good", "page", None),
        ],
        notes: Vec::new(),
        groups: Vec::new(),
        pad: None,
        order: std::collections::BTreeMap::new(),
        layout: std::collections::BTreeMap::new(),
    };
    StartOrder {
        behaviour: id(name),
        revision: 1,
        file: file.into(),
        record: false,
        session: RecordedSession::default(),
        by: "Aiko".to_owned(),
        invitation: None,
    }
}

fn phase(robots: &Host, run: &RunState) -> RunPhase {
    let runs = robots.runs().borrow().clone();
    runs.iter().find(|known| known.run == run.run).unwrap().phase.clone()
}

fn stopped_by(name: &str) -> RunPhase {
    RunPhase::Stopped(name.to_owned())
}

/// Shows the ball again and again until the puppet was told this value by this run.
async fn shows_until_told(puppet: &Puppet, run: &RunState, value: i64) {
    let told = puppet.told(run.run);
    until("the value comes out", || {
        puppet.show_ball(Value::Int(value));
        puppet.told(run.run)[told.len()..].contains(&Value::Int(value))
    })
    .await;
}
