//! Saving one change: what the store answers, and what that means for the room.

use crate::connection::outbox::Answer;
use crate::state::Hub;
use crate::support::store_call::{bounded, reason, store_no};
use crate::support::workers::Sender;
use behaviour::{Accepted, Behaviour, Change, Committed, Decision, Id, Knowledge, Record, Refusal, Room};
use protocol::SaidNo;
use std::sync::Arc;
use store::{Append, StoreError};

/// Changes fetched at once when another server wrote.
const MISSED_MAX_CHANGES: u32 = 10_000;

/// What came of a job.
pub(super) enum Saved {
    /// The store was asked to keep a change.
    Change {
        /// Changes this room did not know, to be made its truth in order; the saved one is the last.
        news: Vec<Committed>,
        /// What who asked is told.
        answer: Result<Accepted, SaidNo>,
        /// Who asked.
        from: Answer,
        /// Whether the store may have more.
        uncertain: bool,
    },
    /// The room asked what it does not know.
    CaughtUp(Result<Vec<Committed>, SaidNo>),
    /// The store was asked to put the behaviour into the bin.
    Removed {
        /// Whether it did.
        outcome: Result<(), SaidNo>,
        /// Who asked.
        from: Answer,
        /// Who said so.
        by: String,
    },
}

/// What is to be kept, and what has to be so before.
struct Keep {
    /// The change.
    committed: Committed,
    /// The behaviour with the change made.
    after: Behaviour,
    /// Helpers that nobody may use.
    helpers: Vec<String>,
}

/// What the room decided about a change.
enum Decided {
    Save(Box<Keep>),
    Duplicate(u64),
    /// Not as its sender saw it; it may be one that was made long ago.
    Stale(Change, Refusal),
    Refuse(Refusal),
}

/// Decides about a change among the other work, then keeps it.
pub(super) async fn decide(hub: Arc<Hub>, id: Id, room: Arc<Room>, change: Change, from: Answer) -> Saved {
    let sender = from.session().map_or(Sender::Server, Sender::Link);
    let (knowing, now_ms) = (Arc::clone(&hub.knowing), crate::support::now_ms());
    let decided = hub.workers.run(sender, move |_| judge(&room, change, &knowing.within_budget(), now_ms)).await;
    let no = |no: SaidNo, from| Saved::Change { news: Vec::new(), answer: Err(no), from, uncertain: false };
    match decided {
        Ok(Decided::Save(keep)) => save(hub, id, *keep, from).await,
        Ok(Decided::Duplicate(revision)) => repeat(hub, id, revision, from).await,
        Ok(Decided::Stale(change, refusal)) => settle(hub, id, change, refusal, from).await,
        Ok(Decided::Refuse(refusal)) => no(SaidNo::Change(refusal), from),
        Err(why) => no(why.into(), from),
    }
}

fn judge(room: &Room, change: Change, knowledge: &dyn Knowledge, now_ms: u64) -> Decided {
    match room.propose(now_ms, change.clone(), knowledge) {
        Decision::Save(committed) => {
            let helpers = helpers_let_go(&committed.change);
            let mut after = room.behaviour().clone();
            after.apply(&committed.change);
            Decided::Save(Box::new(Keep { committed, after, helpers }))
        }
        Decision::Duplicate(revision) => Decided::Duplicate(revision),
        Decision::Refuse(refusal @ Refusal::Stale(_)) => Decided::Stale(change, refusal),
        Decision::Refuse(refusal) => Decided::Refuse(refusal),
    }
}

/// The helpers that would no longer be there under their name.
fn helpers_let_go(change: &Change) -> Vec<String> {
    let gone = change.edits.iter().filter_map(|edit| match (&edit.before, &edit.after) {
        (Some(Record::Helper(before)), Some(Record::Helper(after))) if before.name == after.name => None,
        (Some(Record::Helper(before)), _) => Some(before.name.clone()),
        _ => None,
    });
    gone.collect()
}

/// Keeps a change.
async fn save(hub: Arc<Hub>, id: Id, keep: Keep, from: Answer) -> Saved {
    let Keep { committed, after, helpers } = keep;
    let before = committed.revision.saturating_sub(1);
    let no = |no, uncertain| (Vec::new(), Err(no), uncertain);
    let (news, answer, uncertain) = match unused(&hub, helpers).await {
        Err(refusal) => no(refusal, false),
        Ok(()) => match append(&hub, &id, &committed, &after).await {
            Ok(Append::Applied) => (vec![committed.clone()], Ok(committed), false),
            Ok(Append::Duplicate { revision }) => {
                let answer = one(&hub, &id, revision).await;
                with_news(&hub, &id, before, answer).await
            }
            Ok(Append::Conflict { .. }) => {
                let no = SaidNo::Change(Refusal::Stale("this behaviour".to_owned()));
                with_news(&hub, &id, before, Err(no)).await
            }
            Err(StoreError::Gone) => no(SaidNo::Change(Refusal::Gone), false),
            Err(error) if error.is_open() => no(store_no(&error), true),
            Err(error @ StoreError::Full) => no(store_no(&error), false),
            Err(error) => no(SaidNo::Change(Refusal::NotSaved(reason(&error))), false),
        },
    };
    Saved::Change { news, answer, from, uncertain }
}

/// Once more if the outcome is open: the store keeps an op once.
async fn append(hub: &Hub, id: &Id, committed: &Committed, after: &Behaviour) -> Result<Append, StoreError> {
    let mut answer = bounded(hub.store.append(id, committed, after)).await;
    if let Err(error) = answer.as_ref().map_err(Clone::clone)
        && error.is_open()
    {
        tracing::warn!(behaviour = %id, %error, "saving is tried once more");
        answer = bounded(hub.store.append(id, committed, after)).await;
    }
    answer.inspect_err(|error| hub.health.failed(error))
}

async fn with_news(
    hub: &Hub,
    id: &Id,
    before: u64,
    answer: Result<Accepted, SaidNo>,
) -> (Vec<Committed>, Result<Accepted, SaidNo>, bool) {
    match bounded(hub.store.history(id, before, MISSED_MAX_CHANGES)).await {
        Ok(news) => (news, answer, false),
        Err(_) => (Vec::new(), answer, true),
    }
}

/// The change that made a revision.
async fn one(hub: &Hub, id: &Id, revision: u64) -> Result<Accepted, SaidNo> {
    let found = bounded(hub.store.history(id, revision.saturating_sub(1), 1)).await;
    found.map_err(|error| store_no(&error))?.pop().ok_or(SaidNo::NoBehaviour)
}

/// A change that the rules refuse may be one that was made long ago and is sent again: the store knows every op. Asked
/// under revision 0, which is never the next one, it keeps nothing.
async fn settle(hub: Arc<Hub>, id: Id, change: Change, refusal: Refusal, from: Answer) -> Saved {
    let probe = Committed { revision: 0, change };
    let answer = match bounded(hub.store.append(&id, &probe, &Behaviour::default())).await {
        Ok(Append::Duplicate { revision }) => one(&hub, &id, revision).await,
        _ => Err(SaidNo::Change(refusal)),
    };
    Saved::Change { news: Vec::new(), answer, from, uncertain: false }
}

/// Answers a change that the room remembers.
async fn repeat(hub: Arc<Hub>, id: Id, revision: u64, from: Answer) -> Saved {
    Saved::Change { news: Vec::new(), answer: one(&hub, &id, revision).await, from, uncertain: false }
}

/// Asks for what the room does not know.
pub(super) async fn catch_up(hub: Arc<Hub>, id: Id, revision: u64) -> Saved {
    let news = bounded(hub.store.history(&id, revision, MISSED_MAX_CHANGES)).await;
    Saved::CaughtUp(news.map_err(|error| store_no(&error)))
}

/// Moves the behaviour to the bin.
pub(super) async fn remove(hub: Arc<Hub>, id: Id, by: String, from: Answer) -> Saved {
    let outcome = if hub.robots.has(&id) {
        Err(SaidNo::Running)
    } else {
        match bounded(hub.store.remove(&id, crate::support::now_ms(), &by)).await {
            Ok(true) => Ok(()),
            Ok(false) => Err(SaidNo::NoBehaviour),
            Err(error) => Err(store_no(&error)),
        }
    };
    Saved::Removed { outcome, from, by }
}

/// Refuses to let go a helper that is used, with who uses it.
async fn unused(hub: &Hub, helpers: Vec<String>) -> Result<(), SaidNo> {
    for helper in helpers {
        let users = bounded(hub.store.users(&helper)).await.map_err(|error| store_no(&error))?;
        let mut names: Vec<String> = users.into_iter().map(|user| format!("“{}”", user.name)).collect();
        names.sort();
        names.dedup();
        if !names.is_empty() {
            return Err(SaidNo::Change(Refusal::HelperUsed(helper, names)));
        }
    }
    Ok(())
}
