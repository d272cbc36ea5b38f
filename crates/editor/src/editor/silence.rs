//! While the server is silent nothing is claimed: for how long it has been, and what is said once it speaks again.

use crate::effect::{Announcement, EditorEvent};
use crate::{Editor, LinkState};

/// Without a word for so long nothing is claimed any more, in milliseconds; several pings would have come.
const SILENCE_MS: f64 = 1_750.0;

/// The state of the server's silence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Silence {
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
    pub(crate) fn after_sending(self) -> Self {
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

impl Editor {
    /// Nothing was heard for so many milliseconds; 0 with every word.
    pub fn listen(&mut self, silent_ms: f64) {
        if self.link == LinkState::Connecting {
            return;
        }
        let now = self.silence.after_listening(silent_ms, self.link == LinkState::Offline);
        let before = std::mem::replace(&mut self.silence, now);
        self.unheard.set(now.seconds());
        if before.seconds().is_none() && now.seconds().is_some() {
            self.happened(EditorEvent::Silent);
        }
        if before != now {
            self.say_back();
        }
    }

    /// Says once that the server speaks again, as soon as what waited was sent.
    pub(crate) fn say_back(&mut self) {
        if let Silence::Over { sent } = self.silence
            && self.queue.is_empty()
        {
            self.silence = Silence::No;
            self.say(Announcement::Connected(sent));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Silence;
    use crate::queue::SendMode;
    use crate::{Announcement, Editor, Effect};
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
        let mut editor = Editor::new(
            || Id::new("new").unwrap(),
            |_, _, _, _| None,
            |_| behaviour::Pad::default(),
            crate::layout::tests::SIZES,
        );
        editor.silence = Silence::Over { sent: 1 };
        let (behaviour, op) = (Id::new("b").unwrap(), Id::new("op").unwrap());
        editor.queue.push(behaviour, Change::of(op.clone(), "Aiko", "Edit"), SendMode::Propose);
        let mut said = |answered: bool| {
            if answered {
                editor.queue.answered(&op);
            }
            editor.say_back();
            editor.take_effects()
        };
        assert_eq!(said(false), []);
        assert_eq!(said(true), [Effect::Say(Announcement::Connected(1))]);
        assert_eq!(said(false), []);
    }
}
