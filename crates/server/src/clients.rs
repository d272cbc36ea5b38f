//! Who is connected: one link per client id, a colour for each, and links that can be ended.

use crate::cut::{Cut, Why};
use crate::lock;
use behaviour::Id;
use protocol::Person;
use std::collections::BTreeMap;
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
    here: Mutex<BTreeMap<Id, Link>>,
}

#[derive(Debug)]
struct Link {
    session: u64,
    color: u8,
    cut: Cut,
}

impl Clients {
    /// A number for a new link.
    pub(crate) fn number(&self) -> u64 {
        self.links.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// Somebody came; an older link of the same client is ended.
    pub(crate) fn enter(&self, client: Id, name: &str, session: u64, cut: Cut) -> Person {
        let mut here = lock(&self.here);
        let before = here.remove(&client);
        let color = before.as_ref().map_or_else(|| free_color(&here), |link| link.color);
        if let Some(before) = before {
            before.cut.with(Why::Replaced);
        }
        here.insert(client.clone(), Link { session, color, cut });
        Person { client, name: tidy_name(name), color, pointer: None, selected: None }
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
fn free_color(here: &BTreeMap<Id, Link>) -> u8 {
    let uses = |color: &u8| here.values().filter(|link| link.color == *color).count();
    (0..COLORS).min_by_key(uses).unwrap_or(0)
}

/// A name that fits: no control characters, at most forty characters, never empty.
fn tidy_name(name: &str) -> String {
    let plain: String = name.chars().filter(|c| !c.is_control()).collect();
    let short: String = plain.trim().chars().take(NAME_MAX_CHARS).collect();
    if short.is_empty() { "Somebody".to_owned() } else { short }
}

#[cfg(test)]
mod tests {
    use super::{Clients, Cut, Why, tidy_name};
    use behaviour::Id;

    fn enter(clients: &Clients, client: &str) -> (u64, u8, Cut) {
        let (session, cut) = (clients.number(), Cut::new());
        (session, clients.enter(Id::new(client).unwrap(), client, session, cut.clone()).color, cut)
    }

    #[test]
    fn colours_are_the_first_free_ones() {
        let clients = Clients::default();
        let first = enter(&clients, "a");
        assert_eq!((first.1, enter(&clients, "b").1), (0, 1));
        clients.leave(&Id::new("a").unwrap(), first.0);
        assert_eq!(enter(&clients, "c").1, 0);
        for number in 2..8 {
            assert_eq!(enter(&clients, &format!("n{number}")).1, number);
        }
        assert_eq!(enter(&clients, "ninth").1, 0);
    }

    #[tokio::test]
    async fn a_second_link_of_a_client_replaces_the_first() {
        let clients = Clients::default();
        let first = enter(&clients, "a");
        let second = enter(&clients, "a");
        assert_eq!(first.2.wait().await, Why::Replaced);
        clients.leave(&Id::new("a").unwrap(), first.0);
        assert_eq!((second.1, enter(&clients, "b").1), (0, 1), "the colour stays with the client");
    }

    #[test]
    fn names_are_trimmed() {
        assert_eq!(tidy_name("  Ai\nko "), "Aiko");
        assert_eq!(tidy_name("\t"), "Somebody");
        assert_eq!(tidy_name(&"x".repeat(99)).len(), 40);
    }
}
