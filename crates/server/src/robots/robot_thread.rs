//! The robot's thread: the only one that touches the robot. It makes a step when one is due, empties the command queue when
//! somebody rings, and looks at Stop first either way.

mod by_hand;

use super::cancel_flag::CancelFlag;
use super::command_queue::{CommandQueue, Controlling, OpeningRun, QueuedCommand, WantedDevice};
use super::mailbox::{ReadingsKept, RunMailbox};
use super::refusal::{RunFailure, StartError};
use super::shared::RobotShared;
use crate::support::lock;
use behaviour::Id;
use by_hand::{HAND, Hands};
use engine::{HeldBy, Precedence, StreamIx};
use phrase::{Phrased, phrase};
use protocol::HeldPart;
use robot::{Health, Millis, Reading, Robot, RobotFault, SceneEdit, Use};
use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Length of a step of the robot's thread, in milliseconds.
pub(super) const STEP_MS: u64 = 10;
/// Senses that read all the time are looked at so often at most between two steps.
const SENSE_MIN: Duration = Duration::from_millis(1);
/// Steps between two pictures of the room: about 30 a second.
const STEPS_PER_PICTURE: u64 = 3;
/// After a longer gap than this robot time goes on where it was instead of catching up, in milliseconds.
const GAP_MAX_MS: u64 = 500;
/// For how long it is shown that a part was held, in milliseconds.
const HELD_SHOWN_MS: u64 = 1_000;
/// Pause before a robot that failed is made anew, in milliseconds.
const AGAIN_AFTER_MS: u64 = 1_000;

/// A robot in a room in which people can move things.
pub(super) trait RoomRobot: Robot {
    /// Does what a person did in the room.
    fn edit(&mut self, edit: &SceneEdit);
}

/// Makes the robot on its own thread.
pub(super) type Make = Box<dyn Fn() -> Box<dyn RoomRobot> + Send>;

/// Keeps a robot going until its queue says end; one that fails is made anew.
pub(super) fn keep(shared: &Arc<RobotShared>, make: &Make) {
    shared.queue.attend();
    while !shared.queue.is_ended() {
        // Before it is made: what is wanted from now on makes another one.
        shared.queue.take_renewal();
        let kept = catch_unwind(AssertUnwindSafe(|| {
            let (mut robot, ring) = (make(), Arc::clone(shared));
            robot.wake_with(Arc::new(move || ring.queue.sense()));
            let camera = robot.camera();
            shared.feed.edit(&shared.robot, |state| state.camera = camera.is_some());
            shared.camera.set(camera);
            RobotThread::new(shared, robot, Instant::now()).work();
        }));
        if kept.is_err() {
            shared.fault_all(&RunFailure::Robot);
            let reason = phrase!("server.it_failed_and_is_started", "it failed and is started again");
            shared.feed.edit(&shared.robot, |state| state.health = Health::Lost(reason));
            std::thread::sleep(Duration::from_millis(AGAIN_AFTER_MS));
        }
    }
}

/// The robot, its clock, and who uses it.
pub(super) struct RobotThread<'a> {
    shared: &'a RobotShared,
    robot: Box<dyn RoomRobot>,
    steps: u64,
    /// When its first step was due.
    began: Instant,
    users: HashMap<u64, RobotUser>,
    readings: Vec<Reading>,
    /// When it looks between two steps again what the senses have read.
    may_sense: Instant,
    /// Who holds which part of the robot.
    parts: Precedence,
    /// The actions that people do by hand.
    hands: Hands,
    blocked: BlockedPart,
    /// What was shown of that last.
    shown: HashMap<u64, Vec<HeldPart>>,
}

/// A run that uses the robot.
struct RobotUser {
    /// Its behaviour, and how people call it.
    behaviour: (Id, String),
    cancel: Arc<CancelFlag>,
    mailbox: Arc<RunMailbox>,
    streams: HashMap<Id, (StreamIx, ReadingsKept)>,
    devices: Vec<WantedDevice>,
}

/// A part that a stream of a run wanted and did not get: from whom, and when.
type BlockedPart = HashMap<(u64, Id, String), (u64, Millis)>;

impl<'a> RobotThread<'a> {
    /// A robot whose first step is due at `began`.
    pub(super) fn new(shared: &'a RobotShared, robot: Box<dyn RoomRobot>, began: Instant) -> Self {
        Self {
            shared,
            robot,
            steps: 0,
            began,
            users: HashMap::new(),
            readings: Vec::new(),
            may_sense: Instant::now(),
            parts: Precedence::default(),
            hands: Hands::default(),
            blocked: BlockedPart::new(),
            shown: HashMap::new(),
        }
    }

    /// Works until the queue says end.
    pub(super) fn work(mut self) {
        while !self.queue().is_ended() && !self.queue().is_renewed() {
            // The queue holds a bounded number of things: however often somebody rings, a step that is due comes next.
            self.serve();
            if self.is_due() {
                self.step();
            } else if self.may_sense <= Instant::now() && self.queue().take_sensed() {
                self.sense();
            }
            self.pause();
        }
        // One that is made anew ends by itself what it began.
        if self.queue().is_ended() {
            self.robot.stop(self.now());
        }
    }

    /// Does what waits, at the robot time of the coming step.
    pub(super) fn serve(&mut self) {
        self.end_what_ended();
        self.empty_the_queue();
        self.end_what_ended();
    }

    /// What a real robot has sensed does not wait for the next step.
    fn sense(&mut self) {
        let mut readings = std::mem::take(&mut self.readings);
        self.robot.sense(&mut readings);
        for reading in readings.drain(..) {
            self.hand_out(reading);
        }
        self.readings = readings;
        self.may_sense = Instant::now() + SENSE_MIN;
    }

    /// Pictures are of the step before, and made first: after it, a reading's action would wait for them.
    pub(super) fn step(&mut self) {
        if self.steps % STEPS_PER_PICTURE == 1 {
            self.show();
            self.show_held();
            self.end_what_ended();
        }
        let mut readings = std::mem::take(&mut self.readings);
        self.robot.poll(self.now(), &mut readings);
        for reading in readings.drain(..) {
            self.hand_out(reading);
        }
        self.readings = readings;
        for (user, fault) in self.robot.take_refused() {
            if user.run == HAND {
                self.refused_by_hand(&user.stream, &fault);
            } else if let Some(known) = self.users.get(&user.run) {
                known.mailbox.refuse(&user.stream, fault.phrase());
            }
        }
        if let Some(reason) = self.robot.take_halt() {
            self.end_by_hand();
            self.shared.pause_all(&RunFailure::Halt(reason));
            self.end_what_ended();
        }
        self.steps += 1;
    }

    /// Holds if that is wanted, and ends what runs did that ended. Asked again before everything that may take a moment
    /// or moves the robot.
    fn end_what_ended(&mut self) {
        if self.queue().take_stop() {
            self.robot.stop(self.now());
            self.end_by_hand();
        }
        for run in self.queue().take_closes() {
            self.close(run);
        }
        // A Stop cancels first; what is written down of it may come later.
        let stopped = self.users.iter().filter(|(_, user)| user.cancel.is_cancelled()).map(|(run, _)| *run).min();
        if let Some(run) = stopped {
            self.close(run);
            self.end_what_ended();
        }
    }

    fn empty_the_queue(&mut self) {
        let (pending, commands) = self.queue().take();
        for opening in pending.opens {
            self.end_what_ended();
            self.open(opening);
        }
        for edit in pending.edits {
            self.robot.edit(&edit);
        }
        for Controlling { control, cancel, answer } in pending.controls {
            self.end_what_ended();
            let is_void = cancel.is_cancelled() && control.moves_body();
            let stopped = || RobotFault::NotNow(StartError::StopPressed(None).phrase());
            // Who gave up waiting does not hear it.
            drop(answer.send(if is_void { Err(stopped()) } else { self.robot.control(control, self.now()) }));
        }
        for handing in pending.hands {
            self.end_what_ended();
            self.by_hand(handing);
        }
        for (user, command) in commands {
            self.end_what_ended();
            self.command(&user, &command);
        }
    }

    /// What was told before its run was stopped is void.
    fn command(&mut self, user: &Use, command: &QueuedCommand) {
        if command.cancel.is_cancelled() {
            return;
        }
        if let Err(held) = self.may_move(user) {
            self.hold_back(user, held);
        } else if let Err(fault) = self.robot.command(user, &command.value, self.now())
            && let Some(known) = self.users.get(&user.run)
        {
            known.mailbox.refuse(&user.stream, fault.phrase());
        }
    }

    /// True if nobody above holds what the stream uses; then it is its own.
    fn may_move(&mut self, user: &Use) -> Result<(), HeldBy> {
        let (now, users, order) = (self.now(), &self.users, &self.shared.order);
        let wanted = users.get(&user.run).and_then(|known| known.devices.iter().find(|one| one.stream == user.stream));
        let Some(wanted) = wanted else { return Ok(()) };
        let behaviour = |run: u64| users.get(&run).map(|known| &known.behaviour.0);
        let is_above = |one, other| match (behaviour(one), behaviour(other)) {
            (Some(one), Some(other)) => order.is_above(one, other),
            (_, of_run) => one == HAND && of_run.is_some(),
        };
        self.parts.command(now, user, &wanted.claim, is_above)?;
        let got = |run: u64, part: &String| run == user.run && wanted.claim.resources.contains(part);
        self.blocked.retain(|(run, _, part), _| !got(*run, part));
        Ok(())
    }

    /// Remembers who kept a part from whom. That is no fault of a connector, and passes.
    fn hold_back(&mut self, user: &Use, held: HeldBy) {
        if let (Some(known), Some((_, with))) = (self.users.get(&user.run), self.holder(held.by.run)) {
            let part = &held.part;
            let by_hand = held.by.run == HAND;
            let why = if by_hand {
                phrase!("server.the_is_held_by_hand", "the {part} is held by hand")
            } else {
                phrase!("server.the_is_held", "the {part} is held")
            };
            known.mailbox.held_back(&user.stream, &why, with);
        }
        self.blocked.insert((user.run, user.stream.clone(), held.part), (held.by.run, self.now()));
    }

    /// Whose a run is: its behaviour with its name, or who does something by hand.
    fn holder(&self, run: u64) -> Option<(Id, String)> {
        if run == HAND { self.hands.holder() } else { self.users.get(&run).map(|known| known.behaviour.clone()) }
    }

    /// Shows who keeps what from whom, if that changed.
    fn show_held(&mut self) {
        let (now, users) = (self.now(), &self.users);
        let is_new = |at: Millis| now.0.saturating_sub(at.0) < HELD_SHOWN_MS;
        let is_there = |run: &u64| *run == HAND || users.contains_key(run);
        self.blocked.retain(|(run, ..), (by, at)| is_new(*at) && users.contains_key(run) && is_there(by));
        let mut held: HashMap<u64, Vec<HeldPart>> = HashMap::new();
        let mut blocked: Vec<_> = self.blocked.iter().collect();
        blocked.sort_unstable();
        for ((run, stream, part), (by, _)) in blocked {
            if let Some((by, name)) = self.holder(*by) {
                held.entry(*run).or_default().push(HeldPart { part: part.clone(), stream: stream.clone(), by, name });
            }
        }
        if held != self.shown {
            self.shown.clone_from(&held);
            self.shared.held(held);
        }
    }

    fn open(&mut self, opening: OpeningRun) {
        let OpeningRun { run, behaviour, cancel, mailbox, devices, answer, follows } = opening;
        if cancel.is_cancelled() {
            // A Stop came first. Silence would be told as a robot that does not answer.
            let why = if follows { StartError::StoppedMeanwhile } else { StartError::StoppedBefore };
            return drop(answer.try_send(Err(why)));
        }
        let opened = if follows { self.exchange(run, &devices) } else { self.open_all(run, &devices) };
        if opened.is_ok() {
            let streams = devices.iter().map(|d| (d.stream.clone(), (d.index, ReadingsKept::of(&d.device)))).collect();
            self.users.insert(run, RobotUser { behaviour, cancel, mailbox, streams, devices });
        }
        // Who gave up waiting has cancelled it and asked to close.
        drop(answer.try_send(opened));
    }

    /// Opens devices; if one cannot be opened, none stays open.
    fn open_all(&mut self, run: u64, devices: &[WantedDevice]) -> Result<(), StartError> {
        for (at, wanted) in devices.iter().enumerate() {
            let user = Use { run, stream: wanted.stream.clone() };
            if let Err(reason) = self.robot.open(&user, &wanted.device, &wanted.params) {
                self.close_all(run, &devices[..at]);
                return Err(StartError::Unopened { stream: wanted.name.clone(), reason: reason.phrase() });
            }
        }
        Ok(())
    }

    /// Opens what an edited behaviour uses beyond the one before it, and closes what it does not use any more. What
    /// stays the same is not touched; if something cannot be opened, everything stays as it was.
    fn exchange(&mut self, run: u64, wanted: &[WantedDevice]) -> Result<(), StartError> {
        let before = self.users.get(&run).ok_or(StartError::StoppedMeanwhile)?.devices.clone();
        let not_in = |these: &[WantedDevice], those: &[WantedDevice]| -> Vec<WantedDevice> {
            these.iter().filter(|this| !those.iter().any(|that| that.is_same_use(this))).cloned().collect()
        };
        let (goes, comes) = (not_in(&before, wanted), not_in(wanted, &before));
        self.close_all(run, &goes);
        let opened = self.open_all(run, &comes);
        if opened.is_err() {
            // They were open a moment ago.
            self.open_all(run, &goes)?;
        }
        opened
    }

    fn close_all(&mut self, run: u64, devices: &[WantedDevice]) {
        for wanted in devices {
            self.robot.close(&Use { run, stream: wanted.stream.clone() });
        }
    }

    fn close(&mut self, run: u64) {
        self.parts.let_go(run);
        let Some(user) = self.users.remove(&run) else { return };
        let mut streams: Vec<_> = user.streams.into_keys().collect();
        streams.sort();
        for stream in streams {
            self.robot.close(&Use { run, stream });
        }
    }

    fn hand_out(&self, reading: Reading) {
        let Some(user) = self.users.get(&reading.to.run).filter(|user| !user.cancel.is_cancelled()) else { return };
        if let Some(&(stream, keep)) = user.streams.get(&reading.to.stream) {
            user.mailbox.put(stream, keep, reading.value);
        }
    }

    /// The room as it is just now.
    #[cfg(test)]
    pub(super) fn scene(&self) -> robot::Scene {
        self.robot.scene()
    }

    /// Shows the room and the robot's state, each only if it changed.
    fn show(&self) {
        let mut scene = self.robot.scene();
        let at_ms = scene.at_ms;
        scene.at_ms = self.shared.scene.borrow().at_ms;
        if scene != **self.shared.scene.borrow() {
            scene.at_ms = at_ms;
            self.shared.scene.send_replace(Arc::new(scene));
        }
        let health = match self.robot.health() {
            Health::Safe => Health::Ready,
            other => other,
        };
        let (devices, lacking, condition) = (self.robot.devices(), self.robot.lacking(), self.robot.condition());
        *lock(&self.shared.faces) = self.robot.faces();
        let (identity, installed) = (self.robot.identity(), self.robot.installed());
        self.shared.feed.edit(&self.shared.robot, |state| {
            // One that is about to be made anew is being reached, whatever it was before.
            if !self.queue().is_renewed() {
                state.health = health;
            }
            (state.lacking, state.condition) = (lacking, condition);
            state.installed = installed;
            if identity.is_some() {
                state.identity = identity;
            }
            if state.devices != devices {
                state.devices = devices.into_iter().map(str::to_owned).collect();
            }
            if state.kind != self.robot.kind() {
                self.robot.kind().clone_into(&mut state.kind);
                state.by_body = self.robot.by_body();
            }
        });
    }

    /// Robot time: whole steps, so that every run of the program computes alike. Between two steps it is the time of
    /// the coming one, whatever the clock says.
    fn now(&self) -> Millis {
        Millis(self.steps * STEP_MS)
    }

    fn due(&self) -> Instant {
        self.began + Duration::from_millis(self.steps * STEP_MS)
    }

    fn is_due(&self) -> bool {
        self.due() <= Instant::now()
    }

    /// Waits until the next step is due or somebody rings; a gap (a sleeping computer) is left out.
    fn pause(&mut self) {
        let late = Instant::now().saturating_duration_since(self.due());
        if late > Duration::from_millis(GAP_MAX_MS) {
            self.began += late;
        }
        let until = if self.queue().has_sensed() { self.due().min(self.may_sense) } else { self.due() };
        self.queue().wait(until);
    }

    fn queue(&self) -> &'a CommandQueue {
        &self.shared.queue
    }
}
