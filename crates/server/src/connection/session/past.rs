//! What a client may ask about the past of a behaviour.

use super::ClientSession;
use crate::rooms::RoomCommand;
use crate::rooms::member::AnswerTo;
use crate::rooms::past::{PastRequest, RevertRequest, VersionNaming, WantedChange};
use behaviour::{Id, LockToken};
use protocol::{Refused, Request};
use std::sync::Arc;

/// Of the places that a link has for what is under way: a page of history takes one, a behaviour as it was takes several.
const AT_PLACES: u32 = 4;

impl ClientSession {
    pub(super) fn past(&mut self, ask: u32, request: Request) {
        let (behaviour, past, answer) = match request {
            Request::History { behaviour, before } => (behaviour, PastRequest::History(before), self.placed(ask, 1)),
            Request::At { behaviour, revision } => (behaviour, PastRequest::At(revision), self.placed(ask, AT_PLACES)),
            Request::GoBack { behaviour, revision, op, called, tokens } => {
                (behaviour, self.wish(op, tokens, WantedChange::GoBack(revision, called)), self.placed(ask, AT_PLACES))
            }
            Request::TakeBack { behaviour, op, again, tokens } => {
                let what = if again { WantedChange::Redo } else { WantedChange::Undo };
                (behaviour, self.wish(op, tokens, what), Some(self.answer(ask)))
            }
            Request::BringBack { behaviour, revision, op, tokens } => {
                (behaviour, self.wish(op, tokens, WantedChange::BringBack(revision)), Some(self.answer(ask)))
            }
            Request::NameVersion { behaviour, revision, name } => {
                let naming = VersionNaming::Name { revision, name, by: self.me.name.clone() };
                (behaviour, PastRequest::Name(naming), Some(self.answer(ask)))
            }
            Request::UnnameVersion { behaviour, name } => {
                (behaviour, PastRequest::Name(VersionNaming::Unname(name)), Some(self.answer(ask)))
            }
            _ => return,
        };
        match answer {
            Some(answer) => self.state().rooms.tell(&behaviour, RoomCommand::Past(past, answer)),
            None => self.outbox.no(ask, Refused::TooFast),
        }
    }

    /// Whoever sends it wants it, whatever they say.
    fn wish(&self, op: Id, tokens: Vec<LockToken>, what: WantedChange) -> PastRequest {
        PastRequest::Wish(RevertRequest { op, who: self.me.clone(), tokens, what })
    }

    /// An answer that takes so many places until it is given; none if they are taken.
    fn placed(&self, ask: u32, places: u32) -> Option<AnswerTo> {
        let place = self.budget.begin(places)?;
        Some(AnswerTo::Client { to: Arc::new(self.outbox.clone()), ask, held: Some(Box::new(place)) })
    }
}
