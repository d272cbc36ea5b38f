//! What a client may ask about the past of a behaviour.

use super::Session;
use crate::rooms::Note;
use crate::rooms::member::Answer;
use crate::rooms::past::{Naming, Past, Wanted, Wish};
use behaviour::{Id, Token};
use protocol::{Refused, Request};
use std::sync::Arc;

/// Of the places that a link has for what is under way: a page of history takes one, a behaviour as it was takes several.
const AT_PLACES: u32 = 4;

impl Session {
    pub(super) fn past(&mut self, ask: u32, request: Request) {
        let (behaviour, past, answer) = match request {
            Request::History { behaviour, before } => (behaviour, Past::History(before), self.placed(ask, 1)),
            Request::At { behaviour, revision } => (behaviour, Past::At(revision), self.placed(ask, AT_PLACES)),
            Request::GoBack { behaviour, revision, op, called, tokens } => {
                (behaviour, self.wish(op, tokens, Wanted::GoBack(revision, called)), self.placed(ask, AT_PLACES))
            }
            Request::TakeBack { behaviour, op, again, tokens } => {
                let what = if again { Wanted::Redo } else { Wanted::Undo };
                (behaviour, self.wish(op, tokens, what), Some(self.answer(ask)))
            }
            Request::BringBack { behaviour, revision, op, tokens } => {
                (behaviour, self.wish(op, tokens, Wanted::BringBack(revision)), Some(self.answer(ask)))
            }
            Request::NameVersion { behaviour, revision, name } => {
                let naming = Naming::Name { revision, name, by: self.me.name.clone() };
                (behaviour, Past::Name(naming), Some(self.answer(ask)))
            }
            Request::UnnameVersion { behaviour, name } => {
                (behaviour, Past::Name(Naming::Unname(name)), Some(self.answer(ask)))
            }
            _ => return,
        };
        match answer {
            Some(answer) => self.state().rooms.tell(&behaviour, Note::Past(past, answer)),
            None => self.outbox.no(ask, Refused::TooFast),
        }
    }

    /// Whoever sends it wants it, whatever they say.
    fn wish(&self, op: Id, tokens: Vec<Token>, what: Wanted) -> Past {
        Past::Wish(Wish { op, who: self.me.clone(), tokens, what })
    }

    /// An answer that takes so many places until it is given; none if they are taken.
    fn placed(&self, ask: u32, places: u32) -> Option<Answer> {
        let place = self.budget.begin(places)?;
        Some(Answer::Client { to: Arc::new(self.outbox.clone()), ask, held: Some(Box::new(place)) })
    }
}
