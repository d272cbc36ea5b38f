//! The state of saving, as a state machine: no clock and no link in it, so that it is tested.

use crate::Saving;
use phrase::Phrase;

/// The state that says if changes can be sent, and why not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) enum SaveState {
    /// The page has no link yet.
    #[default]
    Connecting,
    /// A change is sent at once, and shown when it is saved.
    Ready,
    /// It can be saved again: what waited is sent, and shown already until all of it is saved.
    CatchingUp,
    /// The server could not save the last change; it is sent again in a moment.
    Stalled,
    /// The server says why it cannot save.
    Away(Phrase),
    /// The link broke; and why the server could not save before, if that was so.
    Lost(Option<Phrase>),
}

/// The events that bear on saving.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum SaveEvent {
    /// The server greeted back.
    LinkUp,
    /// The link broke.
    LinkLost,
    /// The server says that it cannot save, and why.
    StoreAway(Phrase),
    /// The server says that it can save.
    StoreBack,
    /// The server could not save a change.
    NotSaved,
    /// The wait after a change that could not be saved is over.
    Waited,
    /// Nothing waits to be saved.
    AllSaved,
}

impl SaveState {
    /// Returns the state that follows; an event that bears on nothing here changes nothing.
    pub(crate) fn after(self, event: SaveEvent) -> Self {
        use SaveEvent as Event;
        match (self, event) {
            (Self::Away(why) | Self::Lost(Some(why)), Event::LinkLost) => Self::Lost(Some(why)),
            (_, Event::LinkLost) => Self::Lost(None),
            (Self::Lost(Some(why)), Event::LinkUp) => Self::Away(why),
            (Self::Lost(None), Event::LinkUp) => Self::CatchingUp,
            (Self::Connecting, Event::LinkUp) => Self::Ready,
            (Self::Lost(_), Event::StoreAway(why)) => Self::Lost(Some(why)),
            (_, Event::StoreAway(why)) => Self::Away(why),
            (Self::Lost(_), Event::StoreBack) => Self::Lost(None),
            (Self::Away(_), Event::StoreBack) | (Self::Stalled, Event::Waited) => Self::CatchingUp,
            (Self::Ready | Self::CatchingUp, Event::NotSaved) => Self::Stalled,
            (Self::CatchingUp, Event::AllSaved) => Self::Ready,
            (state, _) => state,
        }
    }

    /// True if what is proposed can be saved now.
    pub(crate) fn can_save(&self) -> bool {
        matches!(self, Self::Ready | Self::CatchingUp)
    }

    /// True if changes are shown before they are saved: only where the page says that they wait.
    pub(crate) fn shows_waiting(&self) -> bool {
        !matches!(self, Self::Connecting | Self::Ready)
    }

    /// Returns what people are told of it while so many changes wait.
    pub(crate) fn told(&self, waiting: usize) -> Saving {
        match self {
            Self::Lost(_) => Saving::Offline(waiting),
            Self::Stalled => Saving::Away(waiting, None),
            Self::Away(why) => Saving::Away(waiting, Some(why.clone())),
            Self::Connecting | Self::Ready | Self::CatchingUp if waiting > 0 => Saving::Saving,
            Self::Connecting | Self::Ready | Self::CatchingUp => Saving::Saved,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::SaveEvent::{AllSaved, LinkLost, LinkUp, NotSaved, StoreAway, StoreBack, Waited};
    use super::{SaveEvent, SaveState, Saving};

    fn after<const MANY: usize>(events: [SaveEvent; MANY]) -> SaveState {
        events.into_iter().fold(SaveState::default(), SaveState::after)
    }

    fn full() -> SaveEvent {
        StoreAway("The disk is full.".into())
    }

    #[test]
    fn the_first_link_makes_ready_and_shows_nothing_that_is_not_saved() {
        let state = after([LinkUp, StoreBack]);
        assert_eq!(state, SaveState::Ready);
        assert!(state.can_save() && !state.shows_waiting());
        assert_eq!([0, 1].map(|waiting| state.told(waiting)), [Saving::Saved, Saving::Saving]);
    }

    #[test]
    fn nothing_can_be_saved_before_the_first_link() {
        let state = after([]);
        assert!(!state.can_save() && !state.shows_waiting());
    }

    #[test]
    fn a_lost_link_shows_what_waits_until_all_of_it_is_saved() {
        let lost = after([LinkUp, LinkLost]);
        assert!(!lost.can_save() && lost.shows_waiting());
        assert_eq!(lost.told(2), Saving::Offline(2));
        let back = lost.after(LinkUp);
        assert_eq!(back, SaveState::CatchingUp);
        assert!(back.can_save() && back.shows_waiting());
        assert_eq!(back.told(2), Saving::Saving);
        assert_eq!(back.after(AllSaved), SaveState::Ready);
    }

    #[test]
    fn a_first_link_that_fails_counts_as_lost() {
        assert_eq!(after([LinkLost]).told(0), Saving::Offline(0));
        assert_eq!(after([LinkLost, LinkUp, AllSaved]), SaveState::Ready);
    }

    #[test]
    fn a_change_that_could_not_be_saved_is_tried_again_after_a_wait() {
        let stalled = after([LinkUp, NotSaved]);
        assert_eq!(stalled.told(1), Saving::Away(1, None));
        assert!(!stalled.can_save() && stalled.shows_waiting());
        assert_eq!(stalled.clone().after(StoreBack), SaveState::Stalled, "the wait is not shortened");
        assert_eq!(stalled.after(Waited), SaveState::CatchingUp);
        assert_eq!(after([LinkUp, NotSaved, Waited, NotSaved]), SaveState::Stalled);
    }

    #[test]
    fn the_server_says_why_it_cannot_save_and_when_it_can_again() {
        let away = after([LinkUp, NotSaved, full()]);
        assert_eq!(away.told(1), Saving::Away(1, Some("The disk is full.".into())));
        assert_eq!(away.clone().after(Waited), away, "the end of a wait does not bring the store back");
        assert_eq!(away.clone().after(NotSaved), away);
        assert_eq!(away.clone().after(AllSaved), away, "it cannot save, even if nothing waits");
        assert_eq!(away.after(StoreBack), SaveState::CatchingUp);
    }

    #[test]
    fn a_store_that_was_away_is_away_after_the_link_too_until_the_server_says_otherwise() {
        let lost = after([LinkUp, full(), LinkLost, LinkLost]);
        assert_eq!(lost.told(3), Saving::Offline(3));
        assert!(!lost.clone().after(LinkUp).can_save());
        assert_eq!(lost.after(LinkUp).after(StoreBack), SaveState::CatchingUp);
    }

    #[test]
    fn a_late_wait_of_before_the_link_broke_changes_nothing() {
        assert_eq!(after([LinkUp, NotSaved, LinkLost, Waited]), SaveState::Lost(None));
        assert_eq!(after([LinkUp, NotSaved, LinkLost, LinkUp, AllSaved, Waited]), SaveState::Ready);
    }
}
