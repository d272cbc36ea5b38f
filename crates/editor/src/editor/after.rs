//! The end of a gesture, once its change is saved or refused: new things are chosen, and things that could not be moved are
//! shown where they were.

use crate::effect::{Announcement, Effect};
use crate::{Editor, Selected};
use behaviour::{Change, Id, Kind, RecordId};
use protocol::Refused;
use std::collections::BTreeSet;

/// Gestures that wait for their answers.
pub(crate) type Following = Vec<(Id, AfterSaving)>;

/// The things to do once the change of a gesture is saved or refused.
#[derive(Clone, Debug)]
pub(crate) enum AfterSaving {
    /// These are chosen.
    Choose(BTreeSet<Selected>),
    /// This is selected, unless something else was meanwhile.
    SelectUnlessOther { before: BTreeSet<Selected>, what: Selected },
    /// These are moved, into a group of this title or only elsewhere; refused, they are shown where they were.
    Moved { ids: Vec<Id>, into: Option<String> },
}

impl Editor {
    /// Proposes a change after which something follows.
    pub(crate) fn propose_then(&mut self, change: Change, then: AfterSaving) {
        self.following_of.push((change.op.clone(), then));
        self.propose(change);
    }

    /// A change of one's own was answered.
    pub(crate) fn after_answer(&mut self, op: &Id, answer: &Result<(), Refused>) {
        let Some(then) = self.take_following(op) else { return };
        match (then, answer) {
            (AfterSaving::Choose(these), Ok(())) => {
                if these.iter().any(|one| self.is_shown(one)) {
                    self.choose(these);
                }
            }
            (AfterSaving::SelectUnlessOther { before, what }, Ok(())) if self.chosen() == before => {
                self.select(Some(what));
            }
            (AfterSaving::Moved { into: Some(title), .. }, Ok(())) => self.say(Announcement::MovedInto(title)),
            (AfterSaving::Moved { ids, .. }, Err(_)) => self.put_back(&ids),
            (
                AfterSaving::Choose(_) | AfterSaving::SelectUnlessOther { .. } | AfterSaving::Moved { .. },
                Ok(()) | Err(_),
            ) => {}
        }
    }

    /// A change of one's own is answered under another name.
    pub(crate) fn goes_on_as(&mut self, was: &Id, now: &Id) {
        if let Some(known) = self.following_of.iter_mut().find(|(op, _)| op == was) {
            known.0 = now.clone();
        }
        self.effect(Effect::Renamed { was: was.clone(), now: now.clone() });
    }

    pub(crate) fn take_following(&mut self, op: &Id) -> Option<AfterSaving> {
        let at = self.following_of.iter().position(|(known, _)| known == op)?;
        Some(self.following_of.swap_remove(at).1)
    }

    /// Shows things where they are saved, after a drag that came to nothing.
    pub fn put_back(&mut self, ids: &[Id]) {
        self.touch(ids.iter().map(|id| RecordId::new(Kind::Place, id)));
    }
}
