//! What people read of the past of a behaviour, beside all that goes on in its room.

use super::replay::{PAGE_MAX_CHANGES, page, replay};
use super::waiting::SavingJob;
use super::{RoomTask, Stay};
use crate::rooms::member::AnswerTo;
use crate::rooms::past::{PastRequest, RevertRequest, WantedChange, Was};
use crate::rooms::shown::ShownBehaviour;
use crate::rooms::{RoomCommand, Surroundings};
use crate::support::identity::Sender;
use behaviour::labels;
use behaviour::{Behaviour, Id, Room, without_unseen};
use phrase::{Phrase, phrase};
use protocol::{HISTORY_MAX_LINES, HistoryLine, Refused, answer};
use std::sync::{Arc, Weak};
use tokio::sync::oneshot;

/// The lines of one page of a history, in bytes; a longer one is alone.
const LINES_MAX_BYTES: usize = 128 << 10;

impl RoomTask {
    /// Does what somebody wants of the past.
    pub(super) fn past(&mut self, past: PastRequest) {
        if self.stay == Stay::Gone {
            return past.refuse(Refused::NoBehaviour);
        }
        match past {
            PastRequest::History(before, answer) => self.history(before, answer),
            PastRequest::At(revision, answer) => self.at(revision, answer),
            PastRequest::LookAt(revision, sender, answer) => self.look_at(revision, sender, answer),
            PastRequest::Wish(
                RevertRequest { op, who, tokens, what: WantedChange::GoBack(revision, called) },
                answer,
            ) => {
                let label = self.back_to(revision, &called);
                self.find_was(
                    revision,
                    label,
                    move |was| RevertRequest { op, who, tokens, what: WantedChange::Again(was) },
                    answer,
                );
            }
            PastRequest::Wish(wish, answer) => self.wait(SavingJob::Make(wish, answer)),
            PastRequest::Name(_, answer) if self.is_library() => answer.no(Refused::NoBehaviour),
            PastRequest::Name(naming, answer) => self.wait(SavingJob::Name(naming, answer)),
        }
    }

    fn history(&self, before: Option<u64>, answer: AnswerTo<answer::History>) {
        let (around, id, now) = (Arc::clone(&self.around), self.id.clone(), self.room.revision());
        let to = before.map_or(now, |before| now.min(before.saturating_sub(1)));
        self.around.tasks.spawn(async move {
            let Some(_turn) = around.lookups.turn(&answer.sender()).await else { return answer.no(Refused::TooFast) };
            if answer.is_unwanted() {
                return;
            }
            match lines(&around, &id, to).await {
                Ok((lines, more)) => answer.give(answer::History { behaviour: id, lines, more }),
                Err(no) => answer.no(no),
            }
        });
    }

    /// One after the other: each takes as much memory as the behaviour until it is shown.
    fn at(&self, revision: u64, answer: AnswerTo<answer::At>) {
        let (around, id, room) = (Arc::clone(&self.around), self.id.clone(), Arc::clone(&self.room));
        self.around.tasks.spawn(async move {
            let Some(_turn) = around.replays.turn(&answer.sender()).await else { return answer.no(Refused::TooFast) };
            if answer.is_unwanted() {
                return;
            }
            match at(&around, &id, room, revision, &answer).await {
                Ok((at, shown)) => answer.show(at, shown),
                Err(no) => answer.no(no),
            }
        });
    }

    /// One after the other too, though nothing of it is shown.
    fn look_at(&self, revision: u64, sender: Sender, answer: oneshot::Sender<Result<Behaviour, Refused>>) {
        let (around, id, room) = (Arc::clone(&self.around), self.id.clone(), Arc::clone(&self.room));
        self.around.tasks.spawn(async move {
            let was = match around.replays.turn(&sender).await {
                Some(_turn) => replay(&around, &id, room, revision, &sender, || answer.is_closed()).await,
                None => Err(Refused::TooFast),
            };
            drop(answer.send(was));
        });
    }

    /// Finds what there was, beside all that goes on; then it is the room's turn.
    fn find_was(
        &self,
        revision: u64,
        label: Phrase,
        wish: impl FnOnce(Box<Was>) -> RevertRequest + Send + 'static,
        answer: AnswerTo<answer::Saved>,
    ) {
        let (around, id, room) = (Arc::clone(&self.around), self.id.clone(), Arc::clone(&self.room));
        let rooms = self.rooms.clone();
        self.around.tasks.spawn(async move {
            let Some(turn) = around.replays.turn(&answer.sender()).await else { return answer.no(Refused::TooFast) };
            match replay(&around, &id, room, revision, &answer.sender(), || answer.is_unwanted()).await {
                Ok(behaviour) => {
                    let was = Box::new(Was { behaviour, label, _turn: Some(turn) });
                    rooms.tell(&id, RoomCommand::Past(PastRequest::Wish(wish(was), answer)));
                }
                Err(no) => answer.no(no),
            }
        });
    }

    /// What going back is called: by the name of the version, else as its author calls it.
    fn back_to(&self, revision: u64, called: &str) -> Phrase {
        let named = self.versions.all().iter().rev().find(|one| one.revision == revision);
        let called = without_unseen(called.trim());
        labels::go_back(match named {
            Some(version) => phrase!("label.Version", "“{name}”", name = version.name),
            None if called.is_empty() => phrase!("label.Revision", "version {revision}"),
            None => called.into(),
        })
    }
}

async fn at(
    around: &Surroundings,
    id: &Id,
    room: Arc<Room>,
    revision: u64,
    answer: &AnswerTo<answer::At>,
) -> Result<(answer::At, Arc<ShownBehaviour>), Refused> {
    let sender = answer.sender();
    let was = replay(around, id, room, revision, &sender, || answer.is_unwanted()).await?;
    let room = around.workers.run(sender, move |_| Arc::new(Room::open(was, revision))).await?;
    let at = answer::At { behaviour: id.clone(), revision, records: Box::default(), more: false };
    Ok((at, around.past_shown.show(&room, &Weak::new(), &answer.group())))
}

/// A page of lines up to a revision, newest first, and whether there are older ones.
async fn lines(around: &Surroundings, id: &Id, mut to: u64) -> Result<(Vec<HistoryLine>, bool), Refused> {
    let (mut lines, mut bytes) = (Vec::new(), 0);
    while to > 0 {
        for made in page(around, id, to.saturating_sub(PAGE_MAX_CHANGES), to).await?.into_iter().rev() {
            let line = HistoryLine::of(made);
            bytes += line.bytes();
            if lines.len() >= HISTORY_MAX_LINES || (bytes > LINES_MAX_BYTES && !lines.is_empty()) {
                return Ok((lines, true));
            }
            lines.push(line);
        }
        to = to.saturating_sub(PAGE_MAX_CHANGES);
    }
    Ok((lines, false))
}
