//! While the server is silent nothing is claimed: for how long it has been, and what is said once it speaks again.

use super::{Document, DocumentState};
use crate::desk::tab::{LinkState, set_if_new};
use crate::words;
use leptos::prelude::*;

/// Without a word for so long nothing is claimed any more, in milliseconds; several pings would have come.
const SILENCE_MS: f64 = 1_750.0;

/// The state of the server's silence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Silence {
    /// It speaks, and everybody knows.
    #[default]
    No,
    /// It has been silent for so many seconds.
    Lasts(u32),
    /// It speaks again, which is said as soon as what waited is sent: so many changes until now.
    Over { sent: usize },
}

impl Silence {
    /// Nothing was heard for so long, or the link is lost.
    fn after_listening(self, silent_ms: f64, lost: bool) -> Self {
        match self {
            _ if lost || silent_ms >= SILENCE_MS => Self::Lasts((silent_ms / 1_000.0).round().max(1.0) as u32),
            Self::Lasts(_) => Self::Over { sent: 0 },
            Self::No | Self::Over { .. } => self,
        }
    }

    /// A change that waited was sent.
    pub(super) fn after_sending(self) -> Self {
        match self {
            Self::Over { sent } => Self::Over { sent: sent + 1 },
            Self::No | Self::Lasts(_) => self,
        }
    }

    /// For how many seconds nothing was heard, if that is too long to claim anything.
    fn seconds(self) -> Option<u32> {
        match self {
            Self::Lasts(seconds) => Some(seconds),
            Self::No | Self::Over { .. } => None,
        }
    }
}

impl Document {
    /// Nothing was heard for so long; 0 with every word.
    pub(in crate::desk) fn listen(&self, silent_ms: f64) {
        let link = self.tab.online.get_untracked();
        if link == LinkState::Connecting {
            return;
        }
        let (before, now) = {
            let silence = &mut self.state().silence;
            let now = silence.after_listening(silent_ms, link == LinkState::Offline);
            (std::mem::replace(silence, now), now)
        };
        set_if_new(&self.tab.unheard, now.seconds());
        if before.seconds().is_none() && now.seconds().is_some() {
            self.tab.forget_good_news();
        }
        if before != now {
            self.say_back();
        }
    }

    /// Says once that the server speaks again, as soon as what waited was sent.
    pub(super) fn say_back(&self) {
        let Some(sent) = self.state().end_of_silence() else { return };
        let refused = self.tab.notice.with_untracked(|notice| notice.as_ref().is_some_and(|notice| notice.bad));
        if !refused {
            self.tab.say(&words::connected(sent), false);
        }
    }
}

impl DocumentState {
    /// Returns how many changes were sent since the server speaks again, once, when none waits any more.
    fn end_of_silence(&mut self) -> Option<usize> {
        match self.silence {
            Silence::Over { sent } if self.queue.len() == 0 => {
                self.silence = Silence::No;
                Some(sent)
            }
            Silence::No | Silence::Lasts(_) | Silence::Over { .. } => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{DocumentState, Silence};
    use crate::desk::document::queue::SendMode;
    use behaviour::{Change, Id};

    fn seconds(silent_ms: f64, lost: bool) -> Option<u32> {
        Silence::No.after_listening(silent_ms, lost).seconds()
    }

    #[test]
    fn nothing_is_claimed_after_two_seconds_of_silence() {
        assert_eq!([0.0, 600.0, 1_600.0].map(|ms| seconds(ms, false)), [None; 3]);
        assert_eq!([1_800.0, 2_000.0, 3_400.0].map(|ms| seconds(ms, false)), [Some(2), Some(2), Some(3)]);
    }

    #[test]
    fn nothing_is_claimed_while_the_link_is_lost() {
        assert_eq!([10.0, 9_000.0].map(|ms| seconds(ms, true)), [Some(1), Some(9)]);
    }

    #[test]
    fn the_end_of_a_silence_counts_what_is_sent_and_another_silence_begins_anew() {
        let over = Silence::Lasts(3).after_listening(0.0, false);
        assert_eq!(over, Silence::Over { sent: 0 });
        assert_eq!(over.after_sending().after_sending(), Silence::Over { sent: 2 });
        assert_eq!(over.after_listening(5_000.0, false), Silence::Lasts(5));
        assert_eq!(Silence::No.after_listening(0.0, false).after_sending(), Silence::No);
    }

    #[test]
    fn that_the_server_speaks_again_is_said_once_and_only_when_nothing_waits() {
        let mut state = DocumentState { silence: Silence::Over { sent: 1 }, ..DocumentState::default() };
        let (behaviour, op) = (Id::new("b").unwrap(), Id::new("op").unwrap());
        state.queue.push(behaviour, Change::of(op.clone(), "Aiko", "Edit"), SendMode::Propose);
        assert_eq!(state.end_of_silence(), None);
        state.queue.answered(&op);
        assert_eq!([state.end_of_silence(), state.end_of_silence()], [Some(1), None]);
    }
}
