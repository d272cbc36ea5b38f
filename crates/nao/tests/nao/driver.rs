//! Drives a robot like the server's thread: a step every 10 ms of robot time.

use crate::peer::{PATIENCE, Peer};
use behaviour::{Id, Params, Value};
use nao::{Nao, RobotSettings};
use robot::{Health, Millis, Reading, Robot, Use};
use serde_json::Value as Json;
use std::time::{Duration, Instant};

/// A robot and the clock that drives it.
pub(crate) struct Driver {
    pub(crate) nao: Nao,
    steps: u64,
    pub(crate) readings: Vec<Reading>,
}

impl Driver {
    /// A robot at an address, once it is there.
    pub(crate) async fn at(address: &str) -> Self {
        Self::with(settings(address)).await
    }

    /// One that is reached so, once it is there.
    pub(crate) async fn with(settings: RobotSettings) -> Self {
        let mut this = Self::new(Nao::start(settings));
        this.until("it is there", |driver| driver.nao.health() == Health::Ready).await;
        this
    }

    /// One that may not be there yet.
    pub(crate) fn new(nao: Nao) -> Self {
        Self { nao, steps: 0, readings: Vec::new() }
    }

    /// One step of robot time.
    pub(crate) async fn step(&mut self) {
        self.steps += 1;
        self.nao.poll(Millis(self.steps * 10), &mut self.readings);
        tokio::time::sleep(Duration::from_millis(5)).await;
    }

    pub(crate) async fn until(&mut self, what: &str, mut is_so: impl FnMut(&mut Self) -> bool) {
        let end = Instant::now() + PATIENCE;
        while !is_so(self) {
            assert!(Instant::now() < end, "never: {what}; {:?} {:?}", self.nao.health(), self.nao.condition());
            self.step().await;
        }
    }

    /// Waits until the stand-in is so.
    pub(crate) async fn sees(&mut self, peer: &Peer, what: &str, is_so: impl Fn(&Json) -> bool) -> Json {
        let end = Instant::now() + PATIENCE;
        loop {
            let state = peer.state().await;
            if is_so(&state) {
                return state;
            }
            assert!(Instant::now() < end, "never: {what}; {state}");
            self.step().await;
        }
    }

    pub(crate) fn open(&mut self, stream: &str, device: &str, params: &[(&str, Value)]) -> Use {
        let user = user(stream);
        let params: Params = params.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
        let opened = self.nao.open(&user, device, &params);
        let why = opened.err().map(|refused| (refused, self.nao.health(), self.nao.take_halt()));
        assert_eq!(why, None, "{device}");
        user
    }

    pub(crate) fn tell(&mut self, user: &Use, value: impl Into<Value>) {
        let told = self.nao.command(user, &value.into(), Millis(self.steps * 10));
        let why = told.err().map(|refused| (refused, self.nao.health(), self.nao.take_halt()));
        assert_eq!(why, None);
    }

    /// The next value of a stream.
    pub(crate) async fn next(&mut self, user: &Use) -> Value {
        self.readings.clear();
        let mut found = None;
        self.until("a value comes", |driver| {
            let of = driver.readings.iter().find(|reading| reading.to == *user);
            found = of.map(|reading| reading.value.clone());
            found.is_some()
        })
        .await;
        found.unwrap()
    }

    /// Steps for a while of robot time.
    pub(crate) async fn wait(&mut self, steps: usize) {
        for _ in 0..steps {
            self.step().await;
        }
    }
}

/// The plainest way to a robot.
pub(crate) fn settings(address: &str) -> RobotSettings {
    let own_name = "rrp-test".to_owned();
    RobotSettings {
        address: address.to_owned(),
        login: None,
        own_name,
        trusted: None,
        expected: None,
        former: Vec::new(),
    }
}

pub(crate) fn user(stream: &str) -> Use {
    Use { run: 1, stream: Id::new(stream).unwrap() }
}

pub(crate) fn number(value: &Value, field: &str) -> f64 {
    value.field(field).and_then(Value::as_number).unwrap_or_else(|| panic!("no {field} in {value}"))
}
