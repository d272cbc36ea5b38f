//! Saving one change: what the store answers, and what that means for the room.
//!
//! Moves, notes and groups that wait together are decided one after another, each as if those before it were saved, and saved
//! in one transaction. The first that cannot be saved is settled alone, and those after it are decided again.

use crate::rooms::Surroundings;
use crate::rooms::member::AnswerTo;
use crate::support::store_call::{bounded, reason, store_no};
use crate::support::workers::WorkNotDone;
use behaviour::{
    Accepted, Behaviour, Change, Checkpoints, Committed, Decision, Id, Knowledge, LockToken, Record, Refusal, Room,
};
use phrase::phrase;
use protocol::{Refused, answer};
use std::collections::{BTreeSet, VecDeque};
use std::sync::Arc;
use store::{Append, StoreError};

/// Changes fetched at once when another server wrote.
const MISSED_MAX_CHANGES: u32 = 10_000;
/// How often a change is decided about while other servers are quicker.
const TRIES: usize = 8;

/// The outcome of a wish.
pub(super) enum MadeChange {
    /// A change to decide about, with the tokens of who wants it.
    New(Change, Vec<LockToken>),
    /// It was made before.
    Known(Accepted),
}

/// What came of a job.
pub(super) enum Saved {
    /// The store was asked to keep a change.
    Change {
        /// The name of the change.
        op: Id,
        /// What came of it.
        outcome: SaveOutcome,
        /// Who asked.
        from: AnswerTo<answer::Saved>,
    },
    /// A change was made out of what was.
    Made {
        /// What came of it.
        outcome: Box<Result<MadeChange, Refused>>,
        /// Who asked.
        from: AnswerTo<answer::Saved>,
    },
    /// The store was asked to keep the name of a version, or to let it go.
    Named {
        /// All names now.
        outcome: Result<Checkpoints, Refused>,
        /// Who asked.
        from: AnswerTo<()>,
    },
    /// The store was asked to keep several changes.
    Together {
        /// Those of which something came, in order.
        done: Vec<(Proposal, SaveOutcome)>,
        /// Those that have to be decided about again.
        left: Vec<Proposal>,
    },
    /// The room asked what it does not know.
    CaughtUp(Result<Vec<Committed>, Refused>),
    /// The store was asked to put the behaviour into the bin.
    Removed {
        /// Whether it did.
        outcome: Result<(), Refused>,
        /// Who asked.
        from: AnswerTo<()>,
        /// Who said so.
        by: String,
    },
}

/// A change, with the tokens of what its sender locked and who asked.
pub(super) struct Proposal {
    pub(super) change: Change,
    pub(super) tokens: Vec<LockToken>,
    pub(super) from: AnswerTo<answer::Saved>,
}

/// What came of keeping a change.
pub(super) struct SaveOutcome {
    /// Changes this room did not know, to be made its truth in order; the saved one is the last.
    pub(super) news: Vec<Committed>,
    /// The room with the saved change made.
    pub(super) after: Option<Arc<Room>>,
    /// What who asked is told.
    pub(super) answer: Result<Accepted, Refused>,
    /// True if the store may have more than the room knows.
    pub(super) is_uncertain: bool,
}

impl SaveOutcome {
    /// It is saved.
    fn applied(keep: SaveRequest) -> Self {
        let SaveRequest { committed, after, .. } = keep;
        Self { news: vec![committed.clone()], after: Some(after), ..Self::nothing(Ok(committed)) }
    }

    /// Nothing changed.
    fn nothing(answer: Result<Accepted, Refused>) -> Self {
        Self { news: Vec::new(), after: None, answer, is_uncertain: false }
    }

    /// This, after changes that the room did not know either.
    fn following(self, mut missed: Vec<Committed>) -> Self {
        missed.extend(self.news);
        Self { news: missed, ..self }
    }

    /// Nobody knows whether something changed.
    fn uncertain(answer: Result<Accepted, Refused>) -> Self {
        Self { is_uncertain: true, ..Self::nothing(answer) }
    }
}

/// What is to be kept, and what has to be so before.
struct SaveRequest {
    /// The change.
    committed: Committed,
    /// The room with the change made.
    after: Arc<Room>,
    /// Helpers that nobody may use.
    helpers: Vec<String>,
}

/// What the room decided about a change.
enum Decided {
    Save(Box<SaveRequest>),
    Duplicate(u64),
    /// Not made; it may be one that was made long ago.
    Refuse(Change, Refusal),
}

/// What the store made of a change.
enum StoreVerdict {
    /// It came to an end.
    Settled(SaveOutcome),
    /// Another server wrote first; with what it wrote.
    Overtaken(Vec<Committed>),
}

/// Decides about a change among the other work, then keeps it.
pub(super) async fn decide(around: Arc<Surroundings>, id: Id, room: Arc<Room>, proposal: Proposal) -> Saved {
    let op = proposal.change.op.clone();
    let first = decided(&around, &room, &proposal).await;
    let outcome = outcome(&around, &id, (room, first), &proposal).await;
    Saved::Change { op, outcome, from: proposal.from }
}

/// What comes of what a room decided about a change. Where another server was quicker, it is decided about again after what
/// that one made: only what touches the same records is stale.
async fn outcome(
    around: &Surroundings,
    id: &Id,
    (mut room, mut decided_so): (Arc<Room>, Result<Decided, WorkNotDone>),
    proposal: &Proposal,
) -> SaveOutcome {
    let mut missed = Vec::new();
    for _ in 0..TRIES {
        let more = match kept(around, id, decided_so, &proposal.change).await {
            StoreVerdict::Settled(outcome) => return outcome.following(missed),
            StoreVerdict::Overtaken(more) => more,
        };
        missed.extend(more.iter().cloned());
        room = match after(around, room, more, proposal).await {
            Ok(room) => room,
            Err(why) => return SaveOutcome::nothing(Err(why.into())).following(missed),
        };
        decided_so = decided(around, &room, proposal).await;
    }
    SaveOutcome::nothing(Err(stale())).following(missed)
}

async fn kept(around: &Surroundings, id: &Id, decided: Result<Decided, WorkNotDone>, change: &Change) -> StoreVerdict {
    StoreVerdict::Settled(match decided {
        Ok(Decided::Save(keep)) => return save(around, id, *keep).await,
        Ok(Decided::Duplicate(revision)) => SaveOutcome::nothing(made_before(around, id, revision, change).await),
        Ok(Decided::Refuse(change, refusal)) => SaveOutcome::nothing(settle(around, id, change, refusal).await),
        Err(why) => SaveOutcome::nothing(Err(why.into())),
    })
}

/// The room after what another server made.
async fn after(
    around: &Surroundings,
    room: Arc<Room>,
    missed: Vec<Committed>,
    proposal: &Proposal,
) -> Result<Arc<Room>, WorkNotDone> {
    let follow = move |_: &_| {
        let mut room = Arc::unwrap_or_clone(room);
        missed.iter().for_each(|one| room.commit(one));
        Arc::new(room)
    };
    around.workers.run(proposal.from.sender(), follow).await
}

fn stale() -> Refused {
    Refused::Change(Refusal::Stale(phrase!("this.program", "this program")))
}

/// Decides about small changes one after another, each as if those before it were saved, then keeps them together. The
/// first that cannot be kept like that is settled alone once those before it are saved; those after it wait again.
pub(super) async fn decide_together(around: Arc<Surroundings>, id: Id, room: Arc<Room>, all: Vec<Proposal>) -> Saved {
    let (mut before, mut room, mut all) = (Arc::clone(&room), room, VecDeque::from(all));
    let (mut keeps, mut kept, mut done) = (Vec::new(), Vec::new(), Vec::new());
    while let Some(proposal) = all.pop_front() {
        match decided(&around, &room, &proposal).await {
            Ok(Decided::Save(keep)) => {
                room = Arc::clone(&keep.after);
                keeps.push(*keep);
                kept.push(proposal);
            }
            other if kept.is_empty() => {
                let outcome = outcome(&around, &id, (room, other), &proposal).await;
                return Saved::Together { done: vec![(proposal, outcome)], left: all.into() };
            }
            _ => {
                all.push_front(proposal);
                break;
            }
        }
    }
    if keeps.len() == 1
        && let Some((proposal, keep)) = kept.pop().zip(keeps.pop())
    {
        let outcome = outcome(&around, &id, (before, Ok(Decided::Save(Box::new(keep)))), &proposal).await;
        return Saved::Together { done: vec![(proposal, outcome)], left: all.into() };
    }
    let follow: Vec<_> = keeps.iter().map(|keep| (keep.committed.clone(), keep.after.behaviour().clone())).collect();
    let answers = bounded(around.store.append_all(&id, &follow)).await.unwrap_or_default();
    let applied = answers.iter().take_while(|answer| **answer == Append::Applied).count();
    let mut kept = kept.into_iter().zip(keeps);
    for (proposal, keep) in kept.by_ref().take(applied) {
        before = Arc::clone(&keep.after);
        done.push((proposal, SaveOutcome::applied(keep)));
    }
    if let Some((proposal, keep)) = kept.next() {
        // The store keeps an op once, so asking again is safe whatever came of it.
        let outcome = outcome(&around, &id, (before, Ok(Decided::Save(Box::new(keep)))), &proposal).await;
        done.push((proposal, outcome));
    }
    let left = kept.map(|(proposal, _)| proposal).chain(all).collect();
    Saved::Together { done, left }
}

/// What a room decides about a change, found among the other work.
fn decided(
    around: &Surroundings,
    room: &Arc<Room>,
    proposal: &Proposal,
) -> impl Future<Output = Result<Decided, WorkNotDone>> + use<> {
    let sender = proposal.from.sender();
    let (room, change, workers) = (Arc::clone(room), proposal.change.clone(), around.workers.clone());
    let (knowing, now_ms) = (Arc::clone(&around.knowing), crate::support::now_ms());
    async move { workers.run(sender, move |_| judge(&room, change, &knowing.within_budget(), now_ms)).await }
}

/// Refuses a change of what somebody else is editing, unless it was made long ago and is sent again.
pub(super) async fn refuse(
    around: Arc<Surroundings>,
    id: Id,
    change: Change,
    locked: Refusal,
    from: AnswerTo<answer::Saved>,
) -> Saved {
    let op = change.op.clone();
    let outcome = SaveOutcome::nothing(settle(&around, &id, change, locked).await);
    Saved::Change { op, outcome, from }
}

fn judge(room: &Room, change: Change, knowledge: &dyn Knowledge, now_ms: u64) -> Decided {
    match room.propose(now_ms, change.clone(), knowledge) {
        Decision::Save(committed) => {
            let helpers = helpers_let_go(&committed.change);
            let mut after = room.clone();
            after.commit(&committed);
            Decided::Save(Box::new(SaveRequest { committed, after: Arc::new(after), helpers }))
        }
        Decision::Duplicate(revision) => Decided::Duplicate(revision),
        Decision::Refuse(refusal) => Decided::Refuse(change, refusal),
    }
}

/// The helpers that would no longer be there under their name.
fn helpers_let_go(change: &Change) -> Vec<String> {
    let name = |record: &Option<Record>| {
        if let Some(Record::Helper(helper)) = record { Some(helper.name.clone()) } else { None }
    };
    let kept: BTreeSet<String> = change.edits.iter().filter_map(|edit| name(&edit.after)).collect();
    change.edits.iter().filter_map(|edit| name(&edit.before)).filter(|name| !kept.contains(name)).collect()
}

/// Keeps a change.
async fn save(around: &Surroundings, id: &Id, keep: SaveRequest) -> StoreVerdict {
    let SaveRequest { committed, after, helpers } = keep;
    let before = committed.revision.saturating_sub(1);
    if let Err(used) = unused(around, helpers).await {
        return StoreVerdict::Settled(SaveOutcome::nothing(Err(used)));
    }
    StoreVerdict::Settled(match append(around, id, &committed, after.behaviour()).await {
        Ok(Append::Applied) => SaveOutcome::applied(SaveRequest { committed, after, helpers: Vec::new() }),
        Ok(Append::Duplicate { revision }) => {
            let answer = one(around, id, revision).await;
            with_news(around, id, before, answer).await
        }
        Ok(Append::Reused { .. }) => SaveOutcome::nothing(Err(Refused::Change(Refusal::Reused))),
        Ok(Append::Conflict { .. }) => {
            let outcome = with_news(around, id, before, Err(stale())).await;
            if !outcome.news.is_empty() {
                return StoreVerdict::Overtaken(outcome.news);
            }
            outcome
        }
        Err(StoreError::Gone) => SaveOutcome::nothing(Err(Refused::Change(Refusal::Gone))),
        Err(error) if error.is_open() => SaveOutcome::uncertain(Err(store_no(&error))),
        Err(error @ StoreError::Full) => SaveOutcome::nothing(Err(store_no(&error))),
        Err(error) => SaveOutcome::nothing(Err(Refused::Change(Refusal::NotSaved(reason(&error))))),
    })
}

/// Once more if the outcome is open: the store keeps an op once.
async fn append(
    around: &Surroundings,
    id: &Id,
    committed: &Committed,
    after: &Behaviour,
) -> Result<Append, StoreError> {
    let mut answer = bounded(around.store.append(id, committed, after)).await;
    if let Err(error) = answer.as_ref().map_err(Clone::clone)
        && error.is_open()
    {
        tracing::warn!(behaviour = %id, %error, "saving is tried once more");
        answer = bounded(around.store.append(id, committed, after)).await;
    }
    answer.inspect_err(|error| around.health.failed(error))
}

/// The answer, with what the room does not know of the store.
async fn with_news(around: &Surroundings, id: &Id, before: u64, answer: Result<Accepted, Refused>) -> SaveOutcome {
    match bounded(around.store.history(id, before, MISSED_MAX_CHANGES)).await {
        Ok(news) => SaveOutcome { news, ..SaveOutcome::nothing(answer) },
        Err(_) => SaveOutcome::uncertain(answer),
    }
}

/// The change that made a revision.
async fn one(around: &Surroundings, id: &Id, revision: u64) -> Result<Accepted, Refused> {
    let found = bounded(around.store.history(id, revision.saturating_sub(1), 1)).await;
    found.map_err(|error| store_no(&error))?.pop().ok_or(Refused::NoBehaviour)
}

/// The change that made a revision, if it does what this one would; else the op id was used for another one.
async fn made_before(around: &Surroundings, id: &Id, revision: u64, change: &Change) -> Result<Accepted, Refused> {
    let made = one(around, id, revision).await?;
    if made.change.does_as(change) { Ok(made) } else { Err(Refused::Change(Refusal::Reused)) }
}

/// A change that the rules refuse may be one that was made long ago and is sent again: the store knows every op. Asked
/// under revision 0, which is never the next one, it keeps nothing.
async fn settle(around: &Surroundings, id: &Id, change: Change, refusal: Refusal) -> Result<Accepted, Refused> {
    match probe(around, id, change).await {
        Ok(Append::Duplicate { revision }) => one(around, id, revision).await,
        Ok(Append::Reused { .. }) => Err(Refused::Change(Refusal::Reused)),
        _ => Err(Refused::Change(refusal)),
    }
}

/// Asks the store about an op; it keeps nothing.
async fn probe(around: &Surroundings, id: &Id, change: Change) -> Result<Append, StoreError> {
    bounded(around.store.append(id, &Committed { revision: 0, change }, &Behaviour::default())).await
}

/// The change of this name, if it was made; else the refusal that it met lately, if it did.
pub(super) async fn known(around: &Surroundings, id: &Id, room: &Room, op: &Id) -> Result<Option<Accepted>, Refused> {
    match room.answer(op) {
        Some(Decision::Duplicate(revision)) => return one(around, id, revision).await.map(Some),
        Some(Decision::Refuse(refusal)) => return Err(Refused::Change(refusal)),
        Some(Decision::Save(_)) | None => {}
    }
    match probe(around, id, Change::of(op.clone(), "", "")).await {
        Ok(Append::Duplicate { revision } | Append::Reused { revision }) => one(around, id, revision).await.map(Some),
        Ok(Append::Applied | Append::Conflict { .. }) => Ok(None),
        Err(StoreError::Gone) => Err(Refused::Change(Refusal::Gone)),
        Err(error) => {
            around.health.failed(&error);
            Err(store_no(&error))
        }
    }
}

/// Asks for what the room does not know.
pub(super) async fn catch_up(around: Arc<Surroundings>, id: Id, revision: u64) -> Saved {
    let news = bounded(around.store.history(&id, revision, MISSED_MAX_CHANGES)).await;
    Saved::CaughtUp(news.inspect_err(|error| around.health.failed(error)).map_err(|error| store_no(&error)))
}

/// Moves the behaviour to the bin.
pub(super) async fn remove(around: Arc<Surroundings>, id: Id, by: String, from: AnswerTo<()>) -> Saved {
    let outcome = if (around.is_running)(&id) {
        Err(Refused::Running)
    } else {
        match bounded(around.store.remove(&id, crate::support::now_ms(), &by)).await {
            Ok(true) => Ok(()),
            Ok(false) => Err(Refused::NoBehaviour),
            Err(error) => Err(store_no(&error)),
        }
    };
    Saved::Removed { outcome, from, by }
}

/// Refuses to let go a helper that is used, with who uses it.
async fn unused(around: &Surroundings, helpers: Vec<String>) -> Result<(), Refused> {
    for helper in helpers {
        let users = bounded(around.store.users(&helper)).await.map_err(|error| store_no(&error))?;
        let mut names: Vec<String> = users.into_iter().map(|user| format!("“{}”", user.name)).collect();
        names.sort();
        names.dedup();
        if !names.is_empty() {
            return Err(Refused::Change(Refusal::HelperUsed(helper, names)));
        }
    }
    Ok(())
}
