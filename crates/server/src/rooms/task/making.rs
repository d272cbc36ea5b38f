//! Changes that come of the past: what somebody takes back, does again, goes back to or brings back. Each is made here and
//! then decided about like any other.

use super::replay::{newest, one};
use super::saving::{MadeChange, Saved, known};
use crate::rooms::Surroundings;
use crate::rooms::member::AnswerTo;
use crate::rooms::past::{RevertRequest, WantedChange, Was};
use crate::support::identity::Sender;
use behaviour::labels;
use behaviour::{Change, Id, Refusal, Room, UndoLog, what_went};
use phrase::phrase;
use protocol::{Person, Refused, answer};
use std::sync::Arc;

/// The newest changes that undo reads.
const UNDO_MAX_CHANGES: usize = 512;
/// All of them together, in bytes.
const UNDO_MAX_BYTES: usize = 2 << 20;
/// What going back may change at once, in bytes of all that it takes and puts.
const GO_BACK_MAX_BYTES: usize = 1 << 20;

/// Makes the change that somebody wishes.
pub(super) async fn make(
    around: Arc<Surroundings>,
    id: Id,
    room: Arc<Room>,
    wish: RevertRequest,
    from: AnswerTo<answer::Saved>,
) -> Saved {
    let outcome = match known(&around, &id, &room, &wish.op).await {
        Ok(None) => new(&around, &id, room, wish, &from).await,
        Ok(Some(accepted)) if is_answer(&wish, &accepted.change) => Ok(MadeChange::Known(accepted)),
        Ok(Some(_)) => Err(Refused::Change(Refusal::Reused)),
        Err(no) => Err(no),
    };
    Saved::Made { outcome: Box::new(outcome), from }
}

/// True if a change that has the op id of a wish can have come of it.
fn is_answer(wish: &RevertRequest, made: &Change) -> bool {
    matches!(wish.what, WantedChange::Undo | WantedChange::Redo) == made.undoes.is_some()
}

async fn new(
    around: &Surroundings,
    id: &Id,
    room: Arc<Room>,
    wish: RevertRequest,
    from: &AnswerTo<answer::Saved>,
) -> Result<MadeChange, Refused> {
    let RevertRequest { op, who, tokens, what } = wish;
    let (sender, mine) = (from.sender(), who.clone());
    let change = match what {
        WantedChange::Undo | WantedChange::Redo => {
            undo(around, id, room, (op, mine.client, matches!(what, WantedChange::Redo)), sender).await
        }
        WantedChange::Again(was) => go_back(around, room, start(op, &mine), was, sender).await,
        WantedChange::BringBack(revision) => bring_back(around, id, room, (start(op, &mine), revision), sender).await,
        WantedChange::GoBack(..) => Err(Refused::NoVersion),
    }?;
    let change = Change { author: who.name, by: Some(who.client), ..change };
    Ok(MadeChange::New(change, tokens))
}

fn start(op: Id, who: &Person) -> Change {
    Change::of(op, &who.name, "")
}

async fn undo(
    around: &Surroundings,
    id: &Id,
    room: Arc<Room>,
    (op, by, again): (Id, Id, bool),
    sender: Sender,
) -> Result<Change, Refused> {
    let Some(_turn) = around.lookups.turn(&sender).await else { return Err(Refused::TooFast) };
    let log = newest(around, id, room.revision(), UNDO_MAX_CHANGES, UNDO_MAX_BYTES).await?;
    let find = move |_: &_| {
        let log = UndoLog::of(&log);
        if again { log.redo(&by, op, &room) } else { log.undo(&by, op, &room) }
    };
    around.workers.run(sender, find).await?.map_err(Refused::Change)
}

async fn go_back(
    around: &Surroundings,
    room: Arc<Room>,
    start: Change,
    was: Box<Was>,
    sender: Sender,
) -> Result<Change, Refused> {
    let compare = move |_: &_| {
        let change = room.go_back(&was.behaviour, Change { label: was.label, ..start });
        let bytes = change.bytes();
        (change, bytes)
    };
    match around.workers.run(sender, compare).await? {
        (change, _) if change.edits.is_empty() => Err(Refused::Change(Refusal::Edits(0))),
        (_, bytes) if bytes > GO_BACK_MAX_BYTES => Err(Refused::FarBack),
        (change, _) => Ok(change),
    }
}

async fn bring_back(
    around: &Surroundings,
    id: &Id,
    room: Arc<Room>,
    (start, revision): (Change, u64),
    sender: Sender,
) -> Result<Change, Refused> {
    if !(1..=room.revision()).contains(&revision) {
        return Err(Refused::NoVersion);
    }
    let Some(turn) = around.lookups.turn(&sender).await else { return Err(Refused::TooFast) };
    let knowing = Arc::clone(&around.knowing);
    let removal = one(around, id, revision).await?.change;
    drop(turn);
    let find = move |_: &_| {
        let what = what_went(&removal)
            .unwrap_or_else(|| phrase!("label.Removed", "what was removed: {label}", label = removal.label));
        let start = Change { label: labels::bring_back(what), ..start };
        room.bring_back(&removal, start, &knowing.within_budget())
    };
    around.workers.run(sender, find).await?.map_err(Refused::Change)?.ok_or(Refused::NothingGone)
}
