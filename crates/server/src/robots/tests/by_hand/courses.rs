//! A thousand random courses of two programs, people's hands and Stop on the simulated robot: what reaches it is inside its limits
//! and its arbitration.

use crate::robots::cancel_flag::CancelFlag;
use crate::robots::command_queue::{ByHand, Handing, OpeningRun, QueuedCommand, WantedDevice};
use crate::robots::mailbox::RunMailbox;
use crate::robots::order::RobotOrder;
use crate::robots::refusal::NotByHand;
use crate::robots::robot_thread::{RobotThread, RoomRobot};
use crate::robots::shared::RobotShared;
use crate::robots::simulated;
use crate::robots::status_feed::StatusFeed;
use behaviour::{Id, Params, StreamKind, Value};
use engine::{Claim, StreamIx};
use robot::{
    Condition, Control, Device, Health, JOINTS, Lacking, Millis, Reading, Robot, RobotFault, Scene, SceneEdit, Use,
};
use simulation::SimulatedNao;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::sync_channel;
use std::time::Instant;
use tokio::sync::oneshot;

const COURSES: u64 = 1_000;
const TURNS: u64 = 14;
/// The table that tells the limits.
const TABLE: &str = include_str!("../../../../../simulation/src/nao_body.toml");

/// A call that reached the robot.
#[derive(Clone, Debug)]
enum Reached {
    Open(Use, Params),
    Command(Use, Millis),
    Stop,
}

/// The simulated robot, and what reached it.
struct Witness {
    nao: SimulatedNao,
    log: Rc<RefCell<Vec<Reached>>>,
}

impl RoomRobot for Witness {
    fn edit(&mut self, _: &SceneEdit) {}
}

impl Robot for Witness {
    fn kind(&self) -> &'static str {
        self.nao.kind()
    }
    fn devices(&self) -> Vec<&'static str> {
        self.nao.devices()
    }
    fn lacking(&self) -> Vec<Lacking> {
        self.nao.lacking()
    }
    fn open(&mut self, user: &Use, device: &str, params: &Params) -> Result<(), RobotFault> {
        self.log.borrow_mut().push(Reached::Open(user.clone(), params.clone()));
        self.nao.open(user, device, params)
    }
    fn close(&mut self, user: &Use) {
        self.nao.close(user);
    }
    fn command(&mut self, user: &Use, value: &Value, now: Millis) -> Result<(), RobotFault> {
        self.log.borrow_mut().push(Reached::Command(user.clone(), now));
        self.nao.command(user, value, now)
    }
    fn poll(&mut self, now: Millis, readings: &mut Vec<Reading>) {
        self.nao.poll(now, readings);
    }
    fn stop(&mut self, now: Millis) {
        self.log.borrow_mut().push(Reached::Stop);
        self.nao.stop(now);
    }
    fn control(&mut self, control: Control, now: Millis) -> Result<(), RobotFault> {
        self.nao.control(control, now)
    }
    fn take_halt(&mut self) -> Option<phrase::Phrase> {
        self.nao.take_halt()
    }
    fn health(&self) -> Health {
        self.nao.health()
    }
    fn condition(&self) -> Condition {
        self.nao.condition()
    }
    fn scene(&self) -> Scene {
        self.nao.scene()
    }
}

struct Dice(u64);

impl Dice {
    fn below(&mut self, below: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % below
    }

    fn of<'t, T>(&mut self, all: &'t [T]) -> &'t T {
        &all[self.below(all.len())]
    }

    /// Something to tell an action: what it takes, or what it should not.
    fn value(&mut self, device: &Device) -> Value {
        match self.below(5) {
            0 => Value::Float((self.below(4_000) as f64 - 2_000.0) / 100.0),
            1 => Value::Float(f64::INFINITY),
            2 => Value::list((0..self.below(4)).map(|at| Value::Float(at as f64 * 3.0 - 4.0))),
            _ => serde_json::from_str(device.example).unwrap(),
        }
    }
}

/// Actions with parameters that people may choose.
fn actions(nao: &SimulatedNao) -> Vec<(&'static Device, Params)> {
    let has = nao.devices();
    let plain =
        robot::actuators().filter(|device| has.contains(&device.name)).map(|device| (device, Params::default()));
    let joint = robot::actuators().find(|device| device.params.iter().any(|param| param.name == "joint")).unwrap();
    let joints = ["HeadYaw", "HeadPitch", "LShoulderPitch", "RElbowRoll", "Head", "LArm", "RHand"];
    let joints = joints.map(|name| (joint, [("joint".to_owned(), Value::text(name))].into_iter().collect()));
    plain.chain(joints).collect()
}

fn parts(device: &Device, params: &Params) -> Vec<String> {
    device.parts(params).into_iter().map(|part| part.word().to_owned()).collect()
}

/// A program that has all actions open.
struct Program {
    run: u64,
    cancel: Arc<CancelFlag>,
}

struct Course<'a> {
    dice: Dice,
    shared: &'a RobotShared,
    thread: RobotThread<'a>,
    log: Rc<RefCell<Vec<Reached>>>,
    actions: Vec<(&'static Device, Params)>,
    programs: Vec<Program>,
    runs: u64,
    now: Millis,
    /// The parts that hands hold: for each, the action and the time until which it holds.
    held: BTreeMap<String, (Id, Millis)>,
    /// With which parameters a hand has an action open.
    hands: BTreeMap<Id, Params>,
    counts: Counts,
}

#[derive(Debug, Default)]
struct Counts {
    hands: usize,
    programs: usize,
    kept_back: usize,
    stopped: usize,
}

impl Course<'_> {
    fn start(&mut self) {
        while self.programs.len() < 2 {
            self.runs += 1;
            let name = Id::new(&format!("p{}", self.runs % 2)).unwrap();
            self.shared.order.add(&name).unwrap();
            let cancel = self.shared.cancel_flags.add(&name);
            let wanted = |(at, (device, params)): (usize, &(&'static Device, Params))| WantedDevice {
                stream: Id::new(&format!("s{at}")).unwrap(),
                index: StreamIx::of(at),
                name: device.name.to_owned(),
                device: device.name.to_owned(),
                params: params.clone(),
                claim: Claim { resources: parts(device, params), priority: 0, hold_ms: 1_000 },
            };
            let devices = self.actions.iter().enumerate().map(wanted).collect();
            let (answer, opened) = sync_channel(1);
            let (behaviour, mailbox) = ((name.clone(), name.to_string()), Arc::new(RunMailbox::default()));
            let (run, cancel) = (self.runs, cancel);
            let opening =
                OpeningRun { run, behaviour, cancel: cancel.clone(), mailbox, devices, follows: false, answer };
            self.shared.queue.open(opening);
            self.serve();
            opened.recv().unwrap().map_err(|why| why.to_string()).unwrap();
            self.programs.push(Program { run, cancel });
        }
    }

    fn turn(&mut self) {
        let mut answers = Vec::new();
        for _ in 0..self.dice.below(5) {
            let (device, params) = self.dice.of(&self.actions).clone();
            let value = self.dice.value(device);
            if self.dice.below(2) == 0 {
                let (answer, answered) = oneshot::channel();
                let cancel = self.shared.cancel_flags.add(&self.shared.robot);
                let hand = ByHand { device: device.name.to_owned(), params, value, by: "Aiko".to_owned() };
                self.shared.queue.hand(Handing { hand, cancel, answer });
                answers.push((device, answered));
            } else if let Some(program) = self.programs.get(self.dice.below(2)) {
                let at = self.actions.iter().position(|(known, with)| known.name == device.name && *with == params);
                let stream = Id::new(&format!("s{}", at.unwrap())).unwrap();
                let command = QueuedCommand { cancel: program.cancel.clone(), value };
                self.shared.queue.command(Use { run: program.run, stream }, device.name, command);
            }
        }
        let stops = self.dice.below(8) == 0;
        if stops {
            self.shared.stop_now(None, "Ben");
            self.programs.clear();
        }
        self.serve();
        for (device, mut answered) in answers {
            let answer = answered.try_recv().unwrap_or_else(|_| panic!("{} was never answered", device.name));
            if stops {
                assert_eq!(answer, Err(NotByHand::StopPressed), "nothing passes Stop");
                self.counts.stopped += 1;
            }
        }
        self.thread.step();
        self.now = Millis(self.now.0 + 10);
        self.halted();
        self.start();
    }

    /// The robot's thread does what waits, and what reached the robot is compared with the rule.
    fn serve(&mut self) {
        self.thread.serve();
        let reached = std::mem::take(&mut *self.log.borrow_mut());
        for reached in reached {
            match reached {
                Reached::Stop => {
                    self.held.clear();
                    self.hands.clear();
                }
                Reached::Open(Use { run: 0, stream }, params) => {
                    self.hands.insert(stream, params);
                }
                Reached::Open(..) => {}
                Reached::Command(user, now) => self.command(&user, now),
            }
        }
    }

    fn command(&mut self, user: &Use, now: Millis) {
        assert_eq!(now, self.now);
        self.held.retain(|_, (_, until)| *until > now);
        if user.run != 0 {
            let at: usize = user.stream.as_str()[1..].parse().unwrap();
            let (device, params) = &self.actions[at];
            let taken: Vec<_> = parts(device, params).into_iter().filter(|part| self.held.contains_key(part)).collect();
            assert!(taken.is_empty(), "{} of a program moved {taken:?}, which a hand holds", device.name);
            self.counts.programs += 1;
            self.counts.kept_back += usize::from(!self.held.is_empty());
            return;
        }
        let device = robot::device(StreamKind::Actuator, user.stream.as_str()).unwrap();
        let taken = parts(device, &self.hands[&user.stream]);
        let losing: Vec<Id> = taken.iter().filter_map(|part| Some(self.held.get(part)?.0.clone())).collect();
        self.held.retain(|_, (by, _)| !losing.contains(by));
        let hold = (user.stream.clone(), Millis(now.0 + 1_000));
        self.held.extend(taken.into_iter().map(|part| (part, hold.clone())));
        self.counts.hands += 1;
    }

    /// The robot halted: everything ends.
    fn halted(&mut self) {
        if self.programs.iter().any(|program| program.cancel.is_cancelled()) {
            self.programs.clear();
            self.held.clear();
            self.hands.clear();
        }
    }
}

#[test]
fn a_hand_stays_inside_the_limits_of_the_robot_and_its_arbitration() {
    let (limits, mut total) = (limits(), Counts::default());
    for seed in 0..COURSES {
        let feed = Arc::new(StatusFeed::default());
        let shared = RobotShared::new(Id::new("nao").unwrap(), feed, RobotOrder::default());
        let (log, nao) = (Rc::new(RefCell::new(Vec::new())), simulated::nao(seed));
        let actions = actions(&nao);
        let robot = Box::new(Witness { nao, log: log.clone() });
        let thread = RobotThread::new(&shared, robot, Instant::now());
        let (dice, now) = (Dice(seed), Millis(0));
        let mut course = Course {
            dice,
            shared: &shared,
            thread,
            log,
            actions,
            programs: Vec::new(),
            runs: 0,
            now,
            held: BTreeMap::new(),
            hands: BTreeMap::new(),
            counts: Counts::default(),
        };
        course.start();
        for _ in 0..TURNS {
            course.turn();
            let body = course.thread.scene().body;
            for ((joint, angle), [low, high]) in JOINTS.iter().zip(&body.joints).zip(&limits) {
                assert!((low - 0.01..=high + 0.01).contains(angle), "seed {seed}: {joint} is at {angle}");
            }
        }
        let Counts { hands, programs, kept_back, stopped } = course.counts;
        total.hands += hands;
        total.programs += programs;
        total.kept_back += kept_back;
        total.stopped += stopped;
    }
    assert!(total.hands > 3_000 && total.programs > 1_000 && total.kept_back > 300, "{total:?}");
    assert!(total.stopped > 300, "{total:?}");
}

/// The limits of each joint, as the table has them.
fn limits() -> Vec<[f32; 2]> {
    let of = |joint: &&str| {
        let row = TABLE.lines().find(|line| line.contains(&format!("name = \"{joint}\"")));
        let Some((_, rest)) = row.and_then(|row| row.split_once("limits = [")) else { return [0.0, 1.0] };
        let (numbers, _) = rest.split_once(']').unwrap();
        let mut numbers = numbers.split(',').map(|number| number.trim().parse().unwrap());
        [numbers.next().unwrap(), numbers.next().unwrap()]
    };
    JOINTS.iter().map(of).collect()
}
