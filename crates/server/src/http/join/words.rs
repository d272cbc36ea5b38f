//! What the pages of invitations say, in the language of the browser: they come before the page, which knows its language.

use crate::invitations::NotIn;
use axum::http::{HeaderMap, header};
use phrase::{Catalogue, Phrase, Phrased, phrase};
use protocol::Role;

/// In which language a browser is answered.
#[derive(Clone, Copy, Debug)]
pub(in crate::http) struct BrowserLanguage(&'static Catalogue);

impl BrowserLanguage {
    /// The language that the browser asks for first; English if that is none of ours.
    pub(in crate::http) fn of(headers: &HeaderMap) -> Self {
        Self(asked(headers, catalogues::all()).unwrap_or_else(catalogues::english))
    }

    /// The language of this catalogue.
    #[cfg(test)]
    pub(in crate::http) fn with(catalogue: &'static Catalogue) -> Self {
        Self(catalogue)
    }

    /// The catalogue of this language.
    pub(in crate::http) fn catalogue(self) -> &'static Catalogue {
        self.0
    }

    /// The tag of this language, as HTML has it.
    pub(in crate::http) fn code(self) -> &'static str {
        self.0.language().code
    }

    /// Says something in this language.
    pub(in crate::http) fn say(self, what: &impl Phrased) -> String {
        self.0.say(what)
    }

    pub(super) fn invited(self) -> [String; 2] {
        self.both(
            &phrase!("join.invited", "You are invited"),
            &phrase!("join.by_somebody", "Somebody who has a robot invites you."),
        )
    }

    /// Says who invites, and what for.
    pub(super) fn invites(self, by: &str, role: Role) -> String {
        let may = may(role);
        // A terminal makes invitations in the name of its program.
        let is_named = !by.is_empty() && !by.starts_with("rrp ");
        self.say(&if is_named {
            phrase!("join.invites", "{by} invites you {may}")
        } else {
            phrase!("join.host_invites", "The person at the robot’s computer invites you {may}")
        })
    }

    pub(super) fn by_invitation(self) -> [String; 2] {
        self.both(
            &phrase!("join.by_invitation", "By invitation only"),
            &phrase!(
                "join.ask",
                "Ask the person at the robot’s computer for an invitation: a link to open here, or its QR code to scan."
            ),
        )
    }

    /// For who follows the link of the host.
    pub(super) fn opening(self) -> [String; 2] {
        self.both(
            &phrase!("join.opening", "Opening rrp"),
            &phrase!("join.becomes_host", "This browser becomes the host’s: it stays in, also after a restart."),
        )
    }

    /// For who is at the host's computer and not known.
    pub(super) fn by_link(self) -> [String; 2] {
        self.both(
            &phrase!("join.not_known", "This browser is not known here yet"),
            &phrase!(
                "join.open_link",
                "In a terminal of this computer, run “rrp open” and open the link that it prints. Stop works without it."
            ),
        )
    }

    /// For who comes through a tunnel with this port and is not known.
    pub(super) fn by_link_through(self, port: u16) -> String {
        self.say(&phrase!(
            "join.open_link_through",
            "In a terminal of the computer that runs rrp, run “rrp open”. Open the link that it prints here, with {port} in the \
             place of its port. Stop works without it."
        ))
    }

    /// For who opens the link of the host a second time.
    pub(super) fn old_link(self) -> [String; 2] {
        self.both(
            &phrase!("join.used", "This link was used already"),
            &phrase!(
                "join.used_once",
                "Each link works once, until rrp ends. Run “rrp open” in a terminal of this computer and open the link that it \
                 prints. Stop works without it."
            ),
        )
    }

    /// The words on the button that stops all robots.
    pub(super) fn stop_all(self) -> String {
        self.say(&phrase!("join.stop_all", "Stop all robots"))
    }

    /// That somebody did not come in, and why.
    pub(super) fn not_in(self, why: &NotIn) -> [String; 2] {
        self.both(&phrase!("join.not_in", "You are not in yet"), &why.phrase())
    }

    pub(super) fn join(self) -> String {
        self.say(&phrase!("join.come_in", "Come in"))
    }

    pub(super) fn broken(self) -> String {
        self.say(&phrase!("join.broken", "This link is not whole. Copy all of it, or scan the QR code again."))
    }

    pub(super) fn needs_script(self) -> String {
        self.say(&phrase!(
            "join.needs_script",
            "This page needs JavaScript. Allow it for this address, then open the link again."
        ))
    }

    /// A title and a text.
    pub(in crate::http) fn both(self, title: &Phrase, text: &Phrase) -> [String; 2] {
        [self.say(title), self.say(text)]
    }
}

/// The first of these languages that a browser asks for, if that is one of them.
fn asked(headers: &HeaderMap, all: &'static [Catalogue]) -> Option<&'static Catalogue> {
    let asked = headers.get(header::ACCEPT_LANGUAGE).and_then(|asked| asked.to_str().ok()).unwrap_or_default();
    let first = asked.split([',', ';']).next().unwrap_or_default().trim().to_ascii_lowercase();
    let code = first.split('-').next().unwrap_or_default();
    all.iter().find(|catalogue| catalogue.language().code == code)
}

/// Says what an invitation is for, after who invites.
fn may(role: Role) -> Phrase {
    match role {
        Role::Viewer => phrase!(
            "join.to_watch",
            "to watch what a robot does. You see the programs and can press Stop; you change nothing."
        ),
        Role::Operator => {
            phrase!("join.to_run", "to run a robot. You start and stop programs; you do not edit them.")
        }
        Role::Editor | Role::Host => {
            phrase!("join.to_build", "to build robot programs together. You edit them, and start and stop the robot.")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{BrowserLanguage, asked};
    use crate::http::german::german;
    use crate::invitations::NotIn;
    use axum::http::{HeaderMap, HeaderValue, header};
    use protocol::Role;

    fn headers(text: &'static str) -> HeaderMap {
        HeaderMap::from_iter([(header::ACCEPT_LANGUAGE, HeaderValue::from_static(text))])
    }

    #[test]
    fn the_browser_says_in_which_language() {
        for text in ["ja", "ja-JP,ja;q=0.9,en;q=0.8", "JA-jp"] {
            assert_eq!(BrowserLanguage::of(&headers(text)).code(), "ja", "{text}");
        }
        for text in ["", "en-GB,ja;q=0.5", "jam", "*", "de-DE,ja;q=0.9"] {
            assert_eq!(BrowserLanguage::of(&headers(text)).code(), "en", "{text}");
        }
        assert_eq!(BrowserLanguage::of(&HeaderMap::new()).code(), "en");
    }

    #[test]
    fn every_reason_is_said_in_japanese() {
        let [english, japanese] = ["en", "ja"].map(|code| BrowserLanguage::of(&headers(code)));
        for why in [NotIn::Unknown, NotIn::TooMany(9), NotIn::NotKept("…".into())] {
            assert!(japanese.not_in(&why)[1].contains('。') && english.not_in(&why)[1].contains('.'));
        }
        let invites = japanese.invites("Aiko", Role::Viewer);
        assert!(invites.starts_with("Aiko さんからの招待です。ロボットの動き"), "{invites}");
        assert!(!japanese.invites("rrp open", Role::Viewer).contains("rrp"));
    }

    #[test]
    fn a_third_language_is_a_catalogue_and_a_line() {
        let language = BrowserLanguage(asked(&headers("de-AT,de;q=0.9,en;q=0.8"), german()).unwrap());
        assert_eq!(language.code(), "de");
        assert_eq!(language.join(), "Hereinkommen");
        let invites = language.invites("Aiko", Role::Operator);
        assert_eq!(invites, "Aiko lädt Sie ein: to run a robot. You start and stop programs; you do not edit them.");
    }
}
