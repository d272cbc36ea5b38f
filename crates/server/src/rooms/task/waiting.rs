//! What waits for saving in one room: each sender's in order, bounded, and the senders take turns.

use super::saving::Proposal;
use crate::rooms::BinRequest;
use crate::rooms::member::AnswerTo;
use crate::rooms::past::{RevertRequest, VersionNaming};
use crate::support::identity::{Sender, ShareGroup};
use behaviour::{Change, Edit, Kind};
use protocol::{Refused, answer};
use std::collections::{HashMap, VecDeque};

/// Jobs that may wait in one room.
const WAITING_MAX_JOBS: usize = 1_024;
/// Jobs among them of a guest, by all their links, or of one link of the host.
const WAITING_PER_SENDER_MAX_JOBS: usize = 256;
/// Jobs among them of all who came by one invitation.
const WAITING_PER_GROUP_MAX_JOBS: usize = 512;

/// The largest of them, in bytes.
const SMALL_MAX_BYTES: usize = 4 << 10;

/// What has to be saved.
pub(super) enum SavingJob {
    /// A change.
    Save(Proposal),
    /// A change that has to be made first, out of what was.
    Make(RevertRequest, AnswerTo<answer::Saved>),
    /// A version gets a name, or loses it.
    Name(VersionNaming, AnswerTo<()>),
    /// The behaviour goes to the bin; with who says so.
    Remove(BinRequest, AnswerTo<()>),
}

impl SavingJob {
    /// For whom it is done.
    pub(super) fn sender(&self) -> Sender {
        match self {
            Self::Save(Proposal { from, .. }) | Self::Make(_, from) => from.sender(),
            Self::Name(_, from) | Self::Remove(_, from) => from.sender(),
        }
    }

    pub(super) fn no(self, no: Refused) {
        match self {
            Self::Save(Proposal { from, .. }) | Self::Make(_, from) => from.no(no),
            Self::Name(_, from) | Self::Remove(_, from) => from.no(no),
        }
    }
}

/// True if a change is decided about at once, so that nobody waits for it if it is saved with others: moves, notes and groups.
pub(super) fn is_small(change: &Change) -> bool {
    let is_light = |edit: &Edit| matches!(edit.id.kind, Kind::Place | Kind::Note | Kind::Group);
    change.edits.iter().all(is_light) && change.bytes() <= SMALL_MAX_BYTES
}

/// Jobs that wait: each sender's in order, and the senders take turns.
#[derive(Default)]
pub(super) struct WaitingJobs {
    of: HashMap<Sender, VecDeque<SavingJob>>,
    /// Who is next.
    turns: VecDeque<Sender>,
    count: usize,
}

impl WaitingJobs {
    /// True if one more job of this sender finds room.
    pub(super) fn has_room(&self, sender: &Sender) -> bool {
        let mine = self.of.get(sender).map_or(0, VecDeque::len);
        let group = sender.group();
        let ours =
            || self.of.iter().filter(|(other, _)| other.group() == group).map(|(_, jobs)| jobs.len()).sum::<usize>();
        let is_few = matches!(group, ShareGroup::Host | ShareGroup::Server) || ours() < WAITING_PER_GROUP_MAX_JOBS;
        self.count < WAITING_MAX_JOBS && mine < WAITING_PER_SENDER_MAX_JOBS && is_few
    }

    pub(super) fn put(&mut self, job: SavingJob) {
        let sender = job.sender();
        let mine = self.of.entry(sender.clone()).or_default();
        if mine.is_empty() {
            self.turns.push_back(sender);
        }
        mine.push_back(job);
        self.count += 1;
    }

    pub(super) fn take(&mut self) -> Option<SavingJob> {
        let sender = self.turns.pop_front()?;
        let jobs = self.of.get_mut(&sender)?;
        let job = jobs.pop_front()?;
        self.count -= 1;
        if jobs.is_empty() {
            self.of.remove(&sender);
        } else {
            self.turns.push_back(sender);
        }
        Some(job)
    }

    /// The next job, if it is a small change.
    pub(super) fn take_small(&mut self) -> Option<Proposal> {
        let next = self.of.get(self.turns.front()?)?.front();
        next.filter(|job| matches!(job, SavingJob::Save(Proposal { change, .. }) if is_small(change)))?;
        self.take().and_then(|job| if let SavingJob::Save(proposal) = job { Some(proposal) } else { None })
    }

    /// Puts back what was taken last.
    pub(super) fn put_back(&mut self, job: SavingJob) {
        let sender = job.sender();
        let mine = self.of.entry(sender.clone()).or_default();
        if mine.is_empty() {
            self.turns.push_front(sender);
        }
        mine.push_front(job);
        self.count += 1;
    }

    pub(super) fn take_all(&mut self) -> Vec<SavingJob> {
        std::iter::from_fn(|| self.take()).collect()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.count == 0
    }
}

#[cfg(test)]
mod tests {
    use super::{Proposal, SavingJob, WAITING_PER_GROUP_MAX_JOBS, WAITING_PER_SENDER_MAX_JOBS, WaitingJobs};
    use crate::rooms::BinRequest;
    use crate::rooms::member::{AnswerTo, Recipient, RoomFeed, WholeBehaviour};
    use crate::support::identity::PersonIdentity;
    use crate::support::identity::tests::guest;
    use axum::extract::ws::Utf8Bytes;
    use behaviour::{Change, Edit, Id, Kind, RecordId};
    use std::sync::Arc;

    /// A link that nobody reads.
    struct Silent(u64, PersonIdentity);

    impl Recipient for Silent {
        fn session(&self) -> u64 {
            self.0
        }

        fn person(&self) -> &PersonIdentity {
            &self.1
        }

        fn is_gone(&self) -> bool {
            false
        }

        fn send(&self, _: Utf8Bytes) {}

        fn send_whole(&self, _: u32, _: WholeBehaviour) {}

        fn follow(&self, _: Box<RoomFeed>) {}

        fn unfollow(&self, _: Id) {}
    }

    fn answer<A>(session: u64) -> AnswerTo<A> {
        AnswerTo::Client { to: Arc::new(Silent(session, guest("a", &session.to_string()))), ask: 1, held: None }
    }

    fn change(waiting: &mut WaitingJobs, session: u64, op: &str, edited: Kind) {
        let edit = Edit { id: RecordId::new(edited, &Id::new("r").unwrap()), before: None, after: None };
        let change = Change { edits: vec![edit], ..Change::of(Id::new(op).unwrap(), "Ben", "Edit") };
        waiting.put(SavingJob::Save(Proposal { change, tokens: Vec::new(), from: answer(session) }));
    }

    #[test]
    fn small_changes_that_come_next_are_taken_and_what_is_put_back_comes_first() {
        let mut waiting = WaitingJobs::default();
        change(&mut waiting, 1, "move", Kind::Place);
        change(&mut waiting, 1, "connect", Kind::Connector);
        change(&mut waiting, 2, "note", Kind::Note);
        change(&mut waiting, 2, "more", Kind::Note);
        let mut ops = Vec::new();
        while let Some(small) = waiting.take_small() {
            ops.push(small.change.op.to_string());
            if ops.len() == 2 {
                waiting.put_back(SavingJob::Save(small));
            }
        }
        assert_eq!(ops, ["move", "note"], "then it is the turn of a connector");
        let rest: Vec<_> = waiting.take_all().iter().map(SavingJob::sender).collect();
        assert_eq!(
            (rest, waiting.is_empty()),
            ([1, 2, 2].map(|session| answer::<()>(session).sender()).to_vec(), true)
        );
    }

    fn put(waiting: &mut WaitingJobs, session: u64, by: &str) -> bool {
        let has_room = waiting.has_room(&answer::<()>(session).sender());
        if has_room {
            let by = BinRequest { client: Id::new("client").unwrap(), name: by.to_owned() };
            waiting.put(SavingJob::Remove(by, answer(session)));
        }
        has_room
    }

    #[test]
    fn senders_take_turns_and_each_has_its_own_bound() {
        let mut waiting = WaitingJobs::default();
        let mine = (0..2 * WAITING_PER_SENDER_MAX_JOBS).filter(|_| put(&mut waiting, 1, "Ben")).count();
        assert!(mine == WAITING_PER_SENDER_MAX_JOBS && put(&mut waiting, 2, "Aiko"));
        let mut next = || waiting.take().map(|job| job.sender());
        assert_eq!([next(), next(), next()], [1, 2, 1].map(|session| Some(answer::<()>(session).sender())));
        let others = (3..9).map(|session| (0..500).filter(|_| put(&mut waiting, session, "Ben")).count());
        assert!(others.sum::<usize>() <= WAITING_PER_GROUP_MAX_JOBS, "of one invitation");
    }
}
