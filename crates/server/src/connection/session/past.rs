//! What a client may ask about the past of a behaviour.

use super::ClientSession;
use crate::rooms::RoomCommand;
use crate::rooms::past::{PastRequest, RevertRequest, VersionNaming, WantedChange};
use behaviour::{Id, LockToken};
use protocol::request;

/// Of the places that a link has for what is under way: a page of history takes one, a behaviour as it was takes several.
const AT_PLACES: u32 = 4;

impl ClientSession {
    fn tell_past(&self, behaviour: &Id, past: PastRequest) {
        self.state().rooms.tell(behaviour, RoomCommand::Past(past));
    }

    pub(super) fn history(&self, ask: u32, of: &request::History) {
        if let Some(answer) = self.placed(ask, 1, of) {
            self.tell_past(&of.behaviour, PastRequest::History(of.before, answer));
        }
    }

    pub(super) fn at(&self, ask: u32, of: &request::At) {
        if let Some(answer) = self.placed(ask, AT_PLACES, of) {
            self.tell_past(&of.behaviour, PastRequest::At(of.revision, answer));
        }
    }

    pub(super) fn go_back(&self, ask: u32, of: request::GoBack) {
        if let Some(answer) = self.placed(ask, AT_PLACES, &of) {
            let wish = self.wish(of.op, of.tokens, WantedChange::GoBack(of.revision, of.called));
            self.tell_past(&of.behaviour, PastRequest::Wish(wish, answer));
        }
    }

    pub(super) fn take_back(&mut self, ask: u32, of: request::TakeBack) {
        let answer = self.answer(ask, &of);
        let what = if of.again { WantedChange::Redo } else { WantedChange::Undo };
        self.tell_past(&of.behaviour, PastRequest::Wish(self.wish(of.op, of.tokens, what), answer));
    }

    pub(super) fn bring_back(&mut self, ask: u32, of: request::BringBack) {
        let answer = self.answer(ask, &of);
        let wish = self.wish(of.op, of.tokens, WantedChange::BringBack(of.revision));
        self.tell_past(&of.behaviour, PastRequest::Wish(wish, answer));
    }

    pub(super) fn name_version(&mut self, ask: u32, of: request::NameVersion) {
        let answer = self.answer(ask, &of);
        let naming = VersionNaming::Name { revision: of.revision, name: of.name, by: self.me.name.clone() };
        self.tell_past(&of.behaviour, PastRequest::Name(naming, answer));
    }

    pub(super) fn unname_version(&mut self, ask: u32, of: request::UnnameVersion) {
        let answer = self.answer(ask, &of);
        self.tell_past(&of.behaviour, PastRequest::Name(VersionNaming::Unname(of.name), answer));
    }

    /// Whoever sends it wants it, whatever they say.
    fn wish(&self, op: Id, tokens: Vec<LockToken>, what: WantedChange) -> RevertRequest {
        RevertRequest { op, who: self.me.clone(), tokens, what }
    }
}
