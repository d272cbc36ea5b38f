//! What is done for people and runs between two steps of the robot.

use super::puppet::Puppet;
use super::{id, until};
use crate::robots::cancel_flag::CancelFlag;
use crate::robots::command_queue::{Controlling, OpeningRun, QueuedCommand, WantedDevice};
use crate::robots::mailbox::RunMailbox;
use crate::robots::order::RobotOrder;
use crate::robots::refusal::StartError;
use crate::robots::robot_thread::{Make, RobotThread, RoomRobot, keep};
use crate::robots::shared::RobotShared;
use crate::robots::status_feed::StatusFeed;
use behaviour::{Params, Value};
use engine::{Claim, StreamIx};
use robot::{Control, Use};
use std::sync::mpsc::{Receiver, sync_channel};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tokio::sync::oneshot;

/// Long after every test.
const NEVER_S: u64 = 86_400;

/// A robot that makes no step, since its first is never due.
struct Still {
    puppet: Puppet,
    shared: Arc<RobotShared>,
    cancel: Arc<CancelFlag>,
    mailbox: Arc<RunMailbox>,
    thread: Option<JoinHandle<()>>,
}

fn shared() -> Arc<RobotShared> {
    Arc::new(RobotShared::new(id("puppet"), Arc::new(StatusFeed::default()), RobotOrder::default()))
}

impl Still {
    fn new() -> Self {
        let shared = shared();
        Self { puppet: Puppet::default(), shared, cancel: Arc::default(), mailbox: Arc::default(), thread: None }
    }

    /// From now on somebody looks at the queue.
    fn begin(&mut self) {
        let (shared, puppet) = (self.shared.clone(), self.puppet.clone());
        self.thread = Some(std::thread::spawn(move || {
            shared.queue.attend();
            RobotThread::new(&shared, Box::new(puppet), Instant::now() + Duration::from_secs(NEVER_S)).work();
        }));
    }

    fn open(&self) -> Receiver<Result<(), StartError>> {
        self.asks_for_devices(false)
    }

    fn asks_for_devices(&self, follows: bool) -> Receiver<Result<(), StartError>> {
        let claim = Claim { resources: Vec::new(), priority: 0, hold_ms: 0 };
        let (name, device, params) = (String::new(), "Print".to_owned(), Params::default());
        let devices = vec![WantedDevice { stream: id("page"), index: StreamIx::of(0), name, device, params, claim }];
        let (answer, opened) = sync_channel(1);
        let (behaviour, cancel, mailbox) = ((id("one"), String::new()), self.cancel.clone(), self.mailbox.clone());
        self.shared.queue.open(OpeningRun { run: 1, behaviour, cancel, mailbox, devices, follows, answer });
        opened
    }

    fn command(&self, value: i64) {
        command(&self.shared, &self.cancel, value);
    }

    async fn ends(mut self) {
        self.shared.queue.end();
        let thread = self.thread.take().unwrap();
        until("the thread ends", || thread.is_finished()).await;
        thread.join().unwrap();
        assert_eq!((self.puppet.steps(), self.puppet.strays()), (0, 0));
    }
}

fn command(shared: &RobotShared, cancel: &Arc<CancelFlag>, value: i64) {
    let user = Use { run: 1, stream: id("page") };
    shared.queue.command(user, "Print", QueuedCommand { cancel: cancel.clone(), value: Value::Int(value) });
}

#[tokio::test]
async fn whoever_puts_something_in_the_queue_waits_for_no_step() {
    let mut still = Still::new();
    still.begin();
    let opened = still.open();
    until("the devices are open", || matches!(opened.try_recv(), Ok(Ok(())))).await;
    for value in [5, 6] {
        still.command(value);
        until("the robot is told", || still.puppet.told(1).last() == Some(&Value::Int(value))).await;
    }
    still.shared.queue.stop();
    until("the robot holds", || still.puppet.log() == ["told 5", "told 6", "held"]).await;
    still.shared.queue.close(1);
    until("the devices are given back", || still.puppet.users().is_empty()).await;
    still.ends().await;
}

#[tokio::test]
async fn what_would_move_the_robot_is_void_after_a_stop_and_what_calms_it_is_not() {
    let mut still = Still::new();
    let ask = |control| {
        let (answer, answered) = oneshot::channel();
        let cancel = still.shared.cancel_flags.add(&still.shared.robot);
        still.shared.queue.control(Controlling { control, cancel, answer });
        answered
    };
    let (moves, calms) =
        ([Control::Take, Control::WakeUp, Control::Stand, Control::Sit].map(ask), ask(Control::GiveBack));
    // It comes while they wait for the robot's thread.
    still.shared.stop_now(None, "Aiko");
    still.begin();
    for answered in moves {
        assert!(answered.await.unwrap().unwrap_err().to_string().contains("Stop was pressed"));
    }
    assert!(calms.await.unwrap().is_ok());
    assert_eq!(still.puppet.log(), ["held", "GiveBack"]);
    still.ends().await;
}

#[tokio::test]
async fn what_the_senses_read_waits_for_no_step() {
    let mut still = Still::new();
    still.begin();
    let opened = still.open();
    until("the devices are open", || matches!(opened.try_recv(), Ok(Ok(())))).await;
    for value in [5, 6] {
        still.puppet.reads(Value::Int(value));
        still.shared.queue.sense();
        let mut read = Vec::new();
        until("it is handed out", || {
            read.extend(still.mailbox.take(Some(Instant::now())).readings);
            !read.is_empty()
        })
        .await;
        assert_eq!(read.len(), 1);
        assert_eq!(read[0].value, Value::Int(value));
    }
    still.ends().await;
}

#[tokio::test]
async fn stop_comes_before_everything_that_waits() {
    let mut still = Still::new();
    still.command(1);
    still.command(2);
    still.shared.queue.stop();
    // Somebody wants it once more between the two.
    let shared = still.shared.clone();
    still.puppet.when_told(move |value| {
        if *value == Value::Int(1) {
            shared.queue.stop();
        }
    });
    still.begin();
    until("the robot is told", || still.puppet.log() == ["held", "told 1", "held", "told 2"]).await;
    still.ends().await;
}

#[tokio::test]
async fn what_a_run_told_before_it_was_stopped_is_void() {
    let mut still = Still::new();
    still.command(1);
    still.command(2);
    let (shared, cancel) = (still.shared.clone(), still.cancel.clone());
    still.puppet.when_told(move |_| {
        cancel.cancel();
        shared.queue.stop();
    });
    still.begin();
    until("the robot holds", || still.puppet.log() == ["told 1", "held"]).await;
    still.ends().await;
}

#[tokio::test]
async fn a_run_that_was_stopped_before_its_devices_opened_hears_of_the_stop_and_not_of_a_silent_robot() {
    let mut still = Still::new();
    let (begins, follows) = (still.asks_for_devices(false), still.asks_for_devices(true));
    // It comes while both wait for the robot's thread.
    still.cancel.cancel();
    still.begin();
    assert!(matches!(begins.recv(), Ok(Err(StartError::StoppedBefore))));
    assert!(matches!(follows.recv(), Ok(Err(StartError::StoppedMeanwhile))));
    assert!(still.puppet.users().is_empty());
    still.ends().await;
}

#[tokio::test]
async fn what_a_run_does_ends_before_anything_else_that_waits() {
    let mut still = Still::new();
    still.begin();
    let opened = still.open();
    until("the devices are open", || matches!(opened.try_recv(), Ok(Ok(())))).await;
    let (shared, cancel, puppet) = (still.shared.clone(), still.cancel.clone(), still.puppet.clone());
    let seen = Arc::new(Mutex::new(None));
    let at_last = seen.clone();
    still.puppet.when_told(move |value| match value {
        // Both wait together, and the run ends while the first of them is done.
        Value::Int(0) => [1, 2].into_iter().for_each(|value| command(&shared, &cancel, value)),
        Value::Int(1) => shared.queue.close(1),
        _ => *at_last.lock().unwrap() = Some(puppet.users().is_empty()),
    });
    still.command(0);
    until("all is told", || seen.lock().unwrap().is_some()).await;
    assert_eq!(*seen.lock().unwrap(), Some(true), "its devices were given back first");
    still.ends().await;
}

#[tokio::test]
async fn a_queue_that_is_never_empty_delays_no_step() {
    let (puppet, shared) = (Puppet::default(), shared());
    let (cancel, queue) = (Arc::new(CancelFlag::default()), shared.clone());
    command(&shared, &cancel, 1);
    // Whenever one command was done the next one is there.
    puppet.when_told(move |_| command(&queue, &cancel, 1));
    let (kept, robot) = (shared.clone(), puppet.clone());
    let make = move || -> Box<dyn RoomRobot> { Box::new(robot.clone()) };
    let thread = std::thread::spawn(move || keep(&kept, &(Box::new(make) as Make)));
    until("the steps go on", || puppet.steps() >= 20).await;
    shared.queue.end();
    until("the thread ends", || thread.is_finished()).await;
    assert!(puppet.told(1).len() > 20);
    assert_eq!(puppet.strays(), 0, "all came at the time of the coming step");
}
