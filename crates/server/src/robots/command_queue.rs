//! What waits for the robot's thread: Stop first, then what to open and close, what people do in the room, and what
//! runs command. Whoever puts something here rings, so that it does not wait for the next step.

use super::cancel_flag::CancelFlag;
use super::fair::Fair;
use super::mailbox::RunMailbox;
use super::refusal::{NotByHand, StartError};
use crate::support::lock;
use behaviour::{Id, Params, StreamKind, Value};
use engine::{Claim, StreamIx};
use robot::{Control, RobotFault, SceneEdit, Use, Waiting};
use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::SyncSender;
use std::sync::{Arc, Mutex, OnceLock};
use std::thread::Thread;
use std::time::Instant;
use tokio::sync::oneshot;

/// Things people did in the room that may wait.
const EDITS_MAX: usize = 256;
/// People who want to have the robot that may wait.
const CONTROLS_MAX: usize = 8;
/// The most actions by hand that may wait.
const HANDS_MAX: usize = 16;
/// Texts of one action that may wait to be spoken or shown.
const TEXTS_MAX: usize = 8;

/// The queue.
#[derive(Debug, Default)]
pub(super) struct CommandQueue {
    stop: AtomicBool,
    end: AtomicBool,
    /// True if the robot is to be made anew, in another way.
    renewal: AtomicBool,
    rung: AtomicBool,
    /// True if the robot's senses have read something.
    sensed: AtomicBool,
    /// True if runs ended whose devices are not given back yet.
    closing: AtomicBool,
    /// The robot's thread.
    thread: OnceLock<Thread>,
    pending: Mutex<PendingCommands>,
}

/// What waits, in the order in which the robot's thread does it.
#[derive(Debug, Default)]
pub(super) struct PendingCommands {
    /// Runs that ended.
    closes: Vec<u64>,
    /// Runs that want their devices.
    pub(super) opens: Vec<OpeningRun>,
    /// What people did in the room.
    pub(super) edits: VecDeque<SceneEdit>,
    /// Who wants to have the robot.
    pub(super) controls: Vec<Controlling>,
    /// The actions that people have it do by hand.
    pub(super) hands: Vec<Handing>,
    commands: Fair<Use, QueuedCommand>,
}

/// A run that wants its devices.
#[derive(Debug)]
pub(super) struct OpeningRun {
    /// The run.
    pub(super) run: u64,
    /// Its behaviour, and how people call it.
    pub(super) behaviour: (Id, String),
    /// What cancels it.
    pub(super) cancel: Arc<CancelFlag>,
    /// Where its readings go.
    pub(super) mailbox: Arc<RunMailbox>,
    /// Its devices, actions before senses.
    pub(super) devices: Vec<WantedDevice>,
    /// True if it follows a run with the same number, whose devices it takes over as far as they are the same.
    pub(super) follows: bool,
    /// Gets the answer; never waited for.
    pub(super) answer: SyncSender<Result<(), StartError>>,
}

/// Somebody takes control of the robot, gives it back, or lets it rest.
#[derive(Debug)]
pub(super) struct Controlling {
    /// What shall be.
    pub(super) control: Control,
    /// The flag that a Stop sets; then a robot that would move for it stays as it is.
    pub(super) cancel: Arc<CancelFlag>,
    /// Gets the answer; never waited for.
    pub(super) answer: oneshot::Sender<Result<(), RobotFault>>,
}

/// An action that somebody has the robot do by hand.
#[derive(Clone, Debug)]
pub(crate) struct ByHand {
    /// The name of the action.
    pub(crate) device: String,
    /// The parameters of the action.
    pub(crate) params: Params,
    /// The value that the action is told.
    pub(crate) value: Value,
    /// The name of the person who has it done.
    pub(crate) by: String,
}

/// Somebody waits for the robot to do something by hand.
#[derive(Debug)]
pub(super) struct Handing {
    /// The action.
    pub(super) hand: ByHand,
    /// The flag that a Stop sets; then the action is void.
    pub(super) cancel: Arc<CancelFlag>,
    /// Gets the answer; never waited for.
    pub(super) answer: oneshot::Sender<Result<(), NotByHand>>,
}

/// One device for one stream.
#[derive(Clone, Debug)]
pub(super) struct WantedDevice {
    /// The stream.
    pub(super) stream: Id,
    /// The stream's index in the run.
    pub(super) index: StreamIx,
    /// What people call it.
    pub(super) name: String,
    /// The device.
    pub(super) device: String,
    /// Its parameters.
    pub(super) params: Params,
    /// The parts of the robot that it uses.
    pub(super) claim: Claim,
}

impl WantedDevice {
    /// True if both are the same device with the same parameters for the same stream.
    pub(super) fn is_same_use(&self, other: &Self) -> bool {
        (&self.stream, &self.device, &self.params) == (&other.stream, &other.device, &other.params)
    }
}

/// A value for an action. Void once its run is cancelled.
#[derive(Debug)]
pub(super) struct QueuedCommand {
    /// What cancels the run.
    pub(super) cancel: Arc<CancelFlag>,
    /// The value.
    pub(super) value: Value,
}

impl CommandQueue {
    /// From now on this thread is the robot's, and the one that [`CommandQueue::wait`]s.
    pub(super) fn attend(&self) {
        drop(self.thread.set(std::thread::current()));
    }

    /// Wants the robot to hold safely, before anything else. Takes no lock and waits for nothing.
    pub(super) fn stop(&self) {
        self.stop.store(true, Ordering::SeqCst);
        self.ring();
    }

    /// True if somebody wanted that since the last question.
    pub(super) fn take_stop(&self) -> bool {
        self.stop.swap(false, Ordering::SeqCst)
    }

    /// The robot's senses have read something. Takes no lock and waits for nothing.
    pub(super) fn sense(&self) {
        self.sensed.store(true, Ordering::SeqCst);
        self.ring();
    }

    /// True if they have, and nobody has taken it yet.
    pub(super) fn has_sensed(&self) -> bool {
        self.sensed.load(Ordering::SeqCst)
    }

    /// True if they have since the last question.
    pub(super) fn take_sensed(&self) -> bool {
        self.sensed.swap(false, Ordering::SeqCst)
    }

    /// Wants the robot's thread to end.
    pub(super) fn end(&self) {
        self.end.store(true, Ordering::SeqCst);
        self.ring();
    }

    /// True if the robot's thread is to end.
    pub(super) fn is_ended(&self) -> bool {
        self.end.load(Ordering::SeqCst)
    }

    /// Wants the robot to be made anew.
    pub(super) fn renew(&self) {
        self.renewal.store(true, Ordering::SeqCst);
        self.ring();
    }

    /// True if the robot is to be made anew.
    pub(super) fn is_renewed(&self) -> bool {
        self.renewal.load(Ordering::SeqCst)
    }

    /// True if that was wanted since the last question.
    pub(super) fn take_renewal(&self) -> bool {
        self.renewal.swap(false, Ordering::SeqCst)
    }

    /// Gives back the devices of a run. Bounded by the number of runs.
    pub(super) fn close(&self, run: u64) {
        lock(&self.pending).closes.push(run);
        self.closing.store(true, Ordering::SeqCst);
        self.ring();
    }

    /// The runs that ended since the last question.
    pub(super) fn take_closes(&self) -> Vec<u64> {
        if self.closing.swap(false, Ordering::SeqCst) {
            std::mem::take(&mut lock(&self.pending).closes)
        } else {
            Vec::new()
        }
    }

    /// Asks for devices. Bounded by the number of runs.
    pub(super) fn open(&self, opening: OpeningRun) {
        lock(&self.pending).opens.push(opening);
        self.ring();
    }

    /// Hands on what somebody did in the room; the oldest gives way.
    pub(super) fn edit(&self, edit: SceneEdit) {
        let mut pending = lock(&self.pending);
        if pending.edits.len() >= EDITS_MAX {
            pending.edits.pop_front();
        }
        pending.edits.push_back(edit);
        drop(pending);
        self.ring();
    }

    /// Asks for control; too many at once are not answered.
    pub(super) fn control(&self, controlling: Controlling) {
        let mut pending = lock(&self.pending);
        if pending.controls.len() < CONTROLS_MAX {
            pending.controls.push(controlling);
        }
        drop(pending);
        self.ring();
    }

    /// Hands on what somebody does by hand; too much at once is not answered.
    pub(super) fn hand(&self, handing: Handing) {
        let mut pending = lock(&self.pending);
        if pending.hands.len() < HANDS_MAX {
            pending.hands.push(handing);
        }
        drop(pending);
        self.ring();
    }

    /// Hands on a value for an action; an older one of the same stream gives way.
    pub(super) fn command(&self, user: Use, device: &str, command: QueuedCommand) {
        let waiting = robot::device(StreamKind::Actuator, device).map_or(Waiting::Newest, |device| device.waiting);
        let waiting_max = if waiting == Waiting::Every { TEXTS_MAX } else { 1 };
        lock(&self.pending).commands.push(user, waiting_max, command);
        self.ring();
    }

    /// Waits until somebody rings, or until a moment. Returns at once if somebody rang since the last wait, also if
    /// what was rung for is done already.
    pub(super) fn wait(&self, until: Instant) {
        while !self.rung.swap(false, Ordering::SeqCst) {
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return;
            }
            std::thread::park_timeout(left);
        }
    }

    /// Always after what it rings for is there. A condition variable would need the lock of what waits here.
    pub(super) fn ring(&self) {
        self.rung.store(true, Ordering::SeqCst);
        if let Some(thread) = self.thread.get() {
            thread.unpark();
        }
    }

    /// Everything that waits; commands in the order in which they were given.
    pub(super) fn take(&self) -> (PendingCommands, Vec<(Use, QueuedCommand)>) {
        let mut pending = lock(&self.pending);
        let commands = pending.commands.take().collect();
        let taken = PendingCommands {
            closes: Vec::new(),
            opens: std::mem::take(&mut pending.opens),
            edits: std::mem::take(&mut pending.edits),
            controls: std::mem::take(&mut pending.controls),
            hands: std::mem::take(&mut pending.hands),
            commands: Fair::default(),
        };
        (taken, commands)
    }
}
