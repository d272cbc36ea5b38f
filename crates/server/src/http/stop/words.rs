//! Words of the page after a Stop, in the language of the browser: it comes where rrp's own page cannot say it.

use crate::http::join::BrowserLanguage;
use crate::http::origin::NotAllowed;
use phrase::{Phrase, phrase};

impl BrowserLanguage {
    pub(super) fn stopped(self) -> [String; 2] {
        self.both(
            &phrase!("stopped.title", "Stopped"),
            &phrase!(
                "stopped.holds",
                "The robot holds still. If it goes on, press Stop again, or press the button on its chest."
            ),
        )
    }

    /// Says that a Stop was not taken, and what to do.
    pub(super) fn not_stopped(self, why: NotAllowed) -> [String; 2] {
        self.both(&phrase!("not_stopped.title", "Stop did not reach the robot"), &instead(why))
    }

    pub(super) fn stop(self) -> String {
        self.say(&phrase!("stopped.stop", "Stop"))
    }

    pub(super) fn back(self) -> String {
        self.say(&phrase!("stopped.back", "Back to rrp"))
    }
}

/// Says what to do where a Stop was not taken.
fn instead(why: NotAllowed) -> Phrase {
    match why {
        NotAllowed::NotInvited => phrase!(
            "not_stopped.not_invited",
            "You are not in, or not any more. Press the button on its chest, and ask the person at the robot’s computer for an \
             invitation."
        ),
        NotAllowed::OtherHost => phrase!(
            "not_stopped.other_host",
            "This computer is reached by another address here. Press the button on its chest, or open the address that rrp \
             printed, and press Stop there."
        ),
        NotAllowed::Forwarded => phrase!(
            "not_stopped.forwarded",
            "A proxy passes this on to a server that was not told of it. Press the button on its chest. Whoever runs rrp starts \
             it with --behind-proxy."
        ),
        NotAllowed::OtherPage | NotAllowed::NoOrigin | NotAllowed::NoHost | NotAllowed::Unreadable => phrase!(
            "not_stopped.other_page",
            "Your browser did not say that this press came from rrp’s own page. Press Stop here again, or press the button on \
             its chest."
        ),
    }
}
