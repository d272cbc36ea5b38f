//! The mailbox of a run: readings wait here until the run's thread takes them; bounded, and never slowing the robot.

use super::command_queue::ByHand;
use super::fair::Fair;
use super::successor::Successor;
use crate::recordings::Recorder;
use crate::support::lock;
use behaviour::{BehaviourFile, Id, StreamKind, Value};
use engine::StreamIx;
use phrase::Phrase;
use protocol::RecordingMark;
use robot::Waiting;
use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex};
use std::time::Instant;

/// Readings of one stream that may wait when every one counts (touches).
const QUEUE_MAX_READINGS: usize = 256;

/// Marks that may wait.
const MARKS_MAX: usize = 32;
/// Different things that the robot did not do and that may wait to be recorded.
const UNDONE_MAX: usize = 256;
/// Things done by hand that may wait to be recorded; more than come while a run looks at its clock.
const HANDS_MAX: usize = 256;

/// Which readings of a stream are kept while the run is busy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum ReadingsKept {
    /// Only the newest: what a camera or joint says now.
    Newest,
    /// Every one, up to a bound: what happened.
    All,
}

impl ReadingsKept {
    /// How the readings of a sense are kept.
    pub(super) fn of(device: &str) -> Self {
        match robot::device(StreamKind::Sensor, device).map(|device| device.waiting) {
            Ok(Waiting::Every) => Self::All,
            Ok(Waiting::Newest) | Err(_) => Self::Newest,
        }
    }

    fn readings_max(self) -> usize {
        match self {
            Self::Newest => 1,
            Self::All => QUEUE_MAX_READINGS,
        }
    }
}

/// A reading and when it arrived.
#[derive(Debug)]
pub(super) struct Arrived {
    /// The stream of the run.
    pub(super) stream: StreamIx,
    /// When it came into the mailbox.
    pub(super) at: Instant,
    /// What was read.
    pub(super) value: Value,
    /// The name of the person who pretended it; none if it was sensed.
    pub(super) by: Option<Arc<str>>,
}

/// Something that an action was told and the robot did not do.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Undone {
    /// The action's stream.
    pub(super) stream: Id,
    /// The reason, in words.
    pub(super) why: String,
    /// The one who keeps the part of the robot, if somebody does.
    pub(super) with: Option<String>,
}

/// What the run's thread takes out.
#[derive(Debug, Default)]
pub(super) struct Post {
    /// Readings in order of arrival.
    pub(super) readings: Vec<Arrived>,
    /// Commands that the robot dropped, by the actuator stream's id, each with how many and the newest reason.
    pub(super) refused: BTreeMap<Id, (u64, Phrase)>,
    /// A run that wants to follow.
    pub(super) successor: Option<Successor>,
    /// Marks that are new or changed.
    pub(super) marks: Vec<RecordingMark>,
    /// The values that the robot did not do: each with the time of the first and the number by now.
    pub(super) undone: BTreeMap<Undone, (Instant, u64)>,
    /// The actions that people did by hand.
    pub(super) hands: Vec<DoneByHand>,
    /// The recording that the run has from now on.
    pub(super) begin_recording: Option<Beginning>,
    /// The name of the person who wants the recording to end.
    pub(super) end_recording: Option<String>,
}

/// An action that somebody had the robot do by hand beside the run.
#[derive(Debug)]
pub(super) struct DoneByHand {
    /// The time at which the robot did it or refused it.
    pub(super) at: Instant,
    /// The action, with the name of the person.
    pub(super) hand: ByHand,
    /// The reason why the robot did not do it; none if it did.
    pub(super) why: Option<String>,
}

impl DoneByHand {
    /// Now.
    pub(super) fn of(hand: ByHand, why: Option<String>) -> Self {
        Self { at: Instant::now(), hand, why }
    }
}

/// A recording that begins in the middle of a run.
#[derive(Debug)]
pub(super) struct Beginning {
    /// The recorder that it goes to.
    pub(super) recorder: Recorder,
    /// The behaviour that ran when the recording was begun.
    pub(super) file: Arc<BehaviourFile>,
}

/// The mailbox.
#[derive(Debug, Default)]
pub(super) struct RunMailbox {
    inbox: Mutex<RunInbox>,
    bell: Condvar,
}

#[derive(Debug, Default)]
struct RunInbox {
    readings: Fair<(StreamIx, ReadingsKept), Arrived>,
    refused: BTreeMap<Id, (u64, Phrase)>,
    undone: BTreeMap<Undone, (Instant, u64)>,
    hands: Vec<DoneByHand>,
    successor: Option<Successor>,
    marks: Vec<RecordingMark>,
    begin_recording: Option<Beginning>,
    end_recording: Option<String>,
    rung: bool,
}

impl RunMailbox {
    /// Puts a reading in.
    pub(super) fn put(&self, stream: StreamIx, keep: ReadingsKept, value: Value) {
        self.put_of(stream, keep, value, None);
    }

    /// Puts a reading in that somebody pretended; every one counts.
    pub(super) fn pretend(&self, stream: StreamIx, value: Value, by: &str) {
        self.put_of(stream, ReadingsKept::All, value, Some(by.into()));
    }

    fn put_of(&self, stream: StreamIx, keep: ReadingsKept, value: Value, by: Option<Arc<str>>) {
        let mut inbox = lock(&self.inbox);
        let arrived = Arrived { stream, at: Instant::now(), value, by };
        inbox.readings.push((stream, keep), keep.readings_max(), arrived);
        // Who is woken must not find the mailbox locked.
        drop(inbox);
        self.bell.notify_one();
    }

    /// Notes that the robot dropped a command of an actuator stream.
    pub(super) fn refuse(&self, stream: &Id, reason: Phrase) {
        let mut inbox = lock(&self.inbox);
        inbox.undone(Undone { stream: stream.clone(), why: reason.to_string(), with: None });
        let noted = inbox.refused.entry(stream.clone()).or_default();
        *noted = (noted.0 + 1, reason);
        drop(inbox);
        self.bell.notify_one();
    }

    /// Notes that somebody else keeps what a command of an actuator stream would move. That is no fault, and wakes nobody.
    pub(super) fn held_back(&self, stream: &Id, why: &Phrase, with: String) {
        lock(&self.inbox).undone(Undone { stream: stream.clone(), why: why.to_string(), with: Some(with) });
    }

    /// Notes that the robot did not do something that no program wanted.
    pub(super) fn undone(&self, undone: Undone) {
        lock(&self.inbox).undone(undone);
    }

    /// Notes what somebody had the robot do by hand.
    pub(super) fn done_by_hand(&self, done: DoneByHand) {
        let mut inbox = lock(&self.inbox);
        if inbox.hands.len() < HANDS_MAX {
            inbox.hands.push(done);
        }
    }

    /// Announces the run that follows. Readings that were put in before are still for the one that ends.
    pub(super) fn succeed(&self, successor: Successor) {
        lock(&self.inbox).successor = Some(successor);
        self.bell.notify_one();
    }

    /// Has the recording keep a mark that is new or changed; false if too many marks wait.
    pub(super) fn mark(&self, mark: RecordingMark) -> bool {
        let mut inbox = lock(&self.inbox);
        let has_room = inbox.marks.len() < MARKS_MAX;
        if has_room {
            inbox.marks.push(mark);
        }
        inbox.rung = true;
        self.bell.notify_one();
        has_room
    }

    /// Records from now on.
    pub(super) fn begin_recording(&self, beginning: Beginning) {
        let mut inbox = lock(&self.inbox);
        (inbox.begin_recording, inbox.rung) = (Some(beginning), true);
        drop(inbox);
        self.bell.notify_one();
    }

    /// Wants the recording to end.
    pub(super) fn end_recording(&self, by: &str) {
        let mut inbox = lock(&self.inbox);
        (inbox.end_recording, inbox.rung) = (Some(by.to_owned()), true);
        drop(inbox);
        self.bell.notify_one();
    }

    /// Wakes the run's thread without a reading.
    pub(super) fn ring(&self) {
        lock(&self.inbox).rung = true;
        self.bell.notify_one();
    }

    /// Takes everything; waits for something until `until`, or without end if that is none.
    pub(super) fn take(&self, until: Option<Instant>) -> Post {
        let mut inbox = lock(&self.inbox);
        while inbox.is_quiet() {
            let left = until.map(|until| until.saturating_duration_since(Instant::now()));
            inbox = match left {
                Some(left) if left.is_zero() => break,
                Some(left) => self.bell.wait_timeout(inbox, left).map_or_else(|e| e.into_inner().0, |woken| woken.0),
                None => self.bell.wait(inbox).unwrap_or_else(std::sync::PoisonError::into_inner),
            };
        }
        inbox.rung = false;
        let readings = inbox.readings.take().map(|(_, arrived)| arrived).collect();
        Post {
            readings,
            refused: std::mem::take(&mut inbox.refused),
            undone: std::mem::take(&mut inbox.undone),
            hands: std::mem::take(&mut inbox.hands),
            successor: inbox.successor.take(),
            marks: std::mem::take(&mut inbox.marks),
            begin_recording: inbox.begin_recording.take(),
            end_recording: inbox.end_recording.take(),
        }
    }

    /// How many readings gave way to newer ones.
    pub(super) fn dropped(&self) -> u64 {
        lock(&self.inbox).readings.dropped()
    }
}

impl RunInbox {
    /// The same again only counts; of more different things than may wait the newest are left out.
    fn undone(&mut self, undone: Undone) {
        if self.undone.len() < UNDONE_MAX || self.undone.contains_key(&undone) {
            self.undone.entry(undone).or_insert_with(|| (Instant::now(), 0)).1 += 1;
        }
    }

    fn is_quiet(&self) -> bool {
        !self.rung && self.readings.is_empty() && self.refused.is_empty() && self.successor.is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::{ReadingsKept, RunMailbox};
    use behaviour::Value;
    use engine::StreamIx;

    #[test]
    fn how_readings_are_kept_is_what_their_device_says() {
        for sense in robot::sensors() {
            let every = sense.waiting == robot::Waiting::Every;
            assert_eq!(ReadingsKept::of(sense.name) == ReadingsKept::All, every, "{}", sense.name);
        }
        assert_eq!(ReadingsKept::of("no such sense"), ReadingsKept::Newest);
    }

    #[test]
    fn a_camera_keeps_its_newest_and_a_touch_keeps_every_one() {
        let mailbox = RunMailbox::default();
        for at in 0..300_i64 {
            mailbox.put(StreamIx::of(0), ReadingsKept::Newest, Value::Int(at));
            mailbox.put(StreamIx::of(1), ReadingsKept::All, Value::Int(at));
        }
        let post = mailbox.take(None);
        let of = |at| post.readings.iter().filter(move |reading| reading.stream == StreamIx::of(at));
        assert_eq!(of(0).map(|reading| reading.value.clone()).collect::<Vec<_>>(), [Value::Int(299)]);
        assert_eq!(of(1).count(), 256);
        assert_eq!(of(1).next().unwrap().value, Value::Int(44));
        assert_eq!(mailbox.dropped(), 299 + 44);
    }

    #[test]
    fn waiting_ends_at_its_time_or_when_it_is_rung() {
        let mailbox = RunMailbox::default();
        assert!(mailbox.take(Some(std::time::Instant::now())).readings.is_empty());
        mailbox.ring();
        assert!(mailbox.take(None).readings.is_empty());
    }
}
