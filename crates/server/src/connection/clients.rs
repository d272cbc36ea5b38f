//! Who is connected: one link per client, a colour for each, and links that can be ended.

use crate::connection::close_signal::{CloseReason, CloseSignal};
use crate::connection::secrets::Secrets;
use crate::invitations::SOMEBODY;
use crate::support::lock;
use behaviour::{Id, without_unseen};
use protocol::{Credential, Person};
use std::collections::HashMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// Colours for people.
const COLORS: u8 = 8;
/// The longest name of a person, in characters.
const NAME_MAX_CHARS: usize = 40;

/// Everyone who is connected.
#[derive(Debug, Default)]
pub(crate) struct Clients {
    links: AtomicU64,
    here: Mutex<HashMap<Id, ClientLink>>,
    secrets: Secrets,
}

#[derive(Debug)]
struct ClientLink {
    session: u64,
    color: u8,
    close: CloseSignal,
}

/// Somebody who came in.
#[derive(Debug)]
pub(crate) struct Entered {
    /// Who they are to others.
    pub(crate) person: Person,
    /// What proves that it is them.
    pub(crate) secret: Id,
}

impl Clients {
    /// Nobody is here yet.
    pub(crate) fn proved_by(secrets: Secrets) -> Self {
        Self { secrets, ..Self::default() }
    }

    /// A number for a new link.
    pub(crate) fn number(&self) -> u64 {
        self.links.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// Somebody came. Who proves to be the client of an older link ends that one and is who they were; anybody else is
    /// somebody new, whatever they say.
    pub(crate) fn enter(&self, again: Option<&Credential>, name: &str, session: u64, close: CloseSignal) -> Entered {
        let proved = again.filter(|again| self.secrets.proves(again)).cloned();
        let Credential { client, secret } = proved.unwrap_or_else(|| self.secrets.new_client());
        let mut here = lock(&self.here);
        let before = here.remove(&client);
        let color = before.as_ref().map_or_else(|| free_color(&here), |link| link.color);
        if let Some(before) = before {
            before.close.with(CloseReason::Replaced);
        }
        here.insert(client.clone(), ClientLink { session, color, close });
        let name = tidy_name(name);
        let person = Person { client, name, color, pointer: None, selected: None, view: None, looks_at: None };
        Entered { person, secret }
    }

    /// The link ended; the client may have come back on another one meanwhile.
    pub(crate) fn leave(&self, client: &Id, session: u64) {
        let mut here = lock(&self.here);
        if here.get(client).is_some_and(|link| link.session == session) {
            here.remove(client);
        }
    }
}

/// The first colour nobody has, else the one that fewest have.
fn free_color(here: &HashMap<Id, ClientLink>) -> u8 {
    let uses = |color: &u8| here.values().filter(|link| link.color == *color).count();
    (0..COLORS).min_by_key(uses).unwrap_or(0)
}

/// A name that fits: nothing in it that is not seen, at most forty characters, never empty.
pub(super) fn tidy_name(name: &str) -> String {
    let short: String = without_unseen(name).trim().chars().take(NAME_MAX_CHARS).collect();
    if short.is_empty() { SOMEBODY.to_owned() } else { short }
}

#[cfg(test)]
mod tests {
    use super::{Clients, CloseReason, CloseSignal, Entered, tidy_name};
    use protocol::Credential;

    fn enter(clients: &Clients, again: Option<&Credential>) -> (u64, Entered, CloseSignal) {
        let (session, close) = (clients.number(), CloseSignal::new());
        (session, clients.enter(again, "Aiko", session, close.clone()), close)
    }

    fn of(entered: &Entered) -> Credential {
        Credential { client: entered.person.client.clone(), secret: entered.secret.clone() }
    }

    #[test]
    fn colours_are_the_first_free_ones() {
        let clients = Clients::default();
        let color = || enter(&clients, None).1.person.color;
        let (session, first, _) = enter(&clients, None);
        assert_eq!((first.person.color, color()), (0, 1));
        clients.leave(&first.person.client, session);
        assert_eq!(color(), 0);
        for number in 2..8 {
            assert_eq!(color(), number);
        }
        assert_eq!(color(), 0, "a ninth person");
    }

    #[tokio::test]
    async fn a_second_link_of_a_client_replaces_the_first() {
        let clients = Clients::default();
        let (session, first, close) = enter(&clients, None);
        let (_, second, _) = enter(&clients, Some(&of(&first)));
        assert_eq!((close.wait().await, of(&second)), (CloseReason::Replaced, of(&first)));
        clients.leave(&first.person.client, session);
        let other = enter(&clients, None).1.person.color;
        assert_eq!((second.person.color, other), (0, 1), "the colour stays with the client");
    }

    #[tokio::test]
    async fn nobody_becomes_somebody_else_without_their_secret() {
        let clients = Clients::default();
        let (session, aiko, close) = enter(&clients, None);
        let guess = Credential { secret: of(&aiko).client, ..of(&aiko) };
        let (_, thief, _) = enter(&clients, Some(&guess));
        assert_ne!(thief.person.client, aiko.person.client);
        tokio::select! {
            biased;
            why = close.wait() => panic!("{why:?}"),
            () = std::future::ready(()) => {}
        }
        clients.leave(&aiko.person.client, session);
        assert_ne!(enter(&clients, Some(&guess)).1.person.client, aiko.person.client, "also while she is away");
        assert_eq!(enter(&clients, Some(&of(&aiko))).1.person.client, aiko.person.client, "she comes back as herself");
    }

    #[test]
    fn names_are_trimmed() {
        assert_eq!(tidy_name("  Ai\nko "), "Aiko");
        assert_eq!(tidy_name("\t"), "Somebody");
        assert_eq!(tidy_name("\u{202e}nairB\u{200b}"), "nairB");
        assert_eq!(tidy_name("\u{2066}\u{200f}"), "Somebody");
        assert_eq!(tidy_name(&"x".repeat(99)).len(), 40);
    }
}
