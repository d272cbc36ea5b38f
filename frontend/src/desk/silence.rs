//! While the server is silent nothing is claimed: for how long it has been, and what is said once it speaks again.

use super::{Desk, LinkState, set_if_new};
use crate::words;
use leptos::prelude::*;

/// Without a word for so long nothing is claimed any more, in milliseconds; several pings would have come.
const SILENCE_MS: f64 = 1_750.0;

/// For how many seconds nothing was heard, if that is long or the link is lost.
fn unheard(silent_ms: f64, lost: bool) -> Option<u32> {
    (lost || silent_ms >= SILENCE_MS).then_some((silent_ms / 1_000.0).round().max(1.0) as u32)
}

impl Desk {
    /// Nothing was heard for so long; 0 with every word.
    pub(crate) fn listen(&self, silent_ms: f64) {
        let link = self.online.get_untracked();
        if link == LinkState::Connecting {
            return;
        }
        let before = self.unheard.get_untracked();
        let now = unheard(silent_ms, link == LinkState::Offline);
        set_if_new(&self.unheard, now);
        if before.is_some() && now.is_none() {
            self.state().back = Some(0);
            self.say_back();
        }
    }

    /// A change that waited was sent.
    pub(super) fn sent(&self) {
        if let Some(sent) = &mut self.state().back {
            *sent += 1;
        }
    }

    /// Says once that the server speaks again, as soon as what waited was sent.
    pub(super) fn say_back(&self) {
        let sent = {
            let mut state = self.state();
            let all_sent = state.queue.len() == 0;
            state.back.take_if(|_| all_sent)
        };
        let refused = self.notice.with_untracked(|notice| notice.as_ref().is_some_and(|notice| notice.bad));
        if let Some(sent) = sent.filter(|_| !refused) {
            self.say(&words::connected(sent), false);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::unheard;

    #[test]
    fn nothing_is_claimed_after_two_seconds_of_silence() {
        assert_eq!([0.0, 600.0, 1_600.0].map(|ms| unheard(ms, false)), [None; 3]);
        assert_eq!([1_800.0, 2_000.0, 3_400.0].map(|ms| unheard(ms, false)), [Some(2), Some(2), Some(3)]);
    }

    #[test]
    fn nothing_is_claimed_while_the_link_is_lost() {
        assert_eq!([10.0, 9_000.0].map(|ms| unheard(ms, true)), [Some(1), Some(9)]);
    }
}
