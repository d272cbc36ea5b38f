//! The identity of this tab to the server and to the others: its greeting, its name and what it proves itself with.

use super::Desk;
use super::tab::set_if_new;
use crate::{browser, link};
use behaviour::Id;
use browser::Drawer;
use leptos::prelude::*;
use protocol::{Credential, request};

const TAB_KEY: &str = "rrp.client";
const ALIVE_KEY: &str = "rrp.alive";
const NAME_KEY: &str = "rrp.name";
const ASKED_KEY: &str = "rrp.name.asked";
/// The longest name of a person, in characters.
const NAME_MAX_CHARS: usize = 40;
/// The name of those who did not say theirs yet, before a number.
const GUEST: &str = "Guest ";

impl Desk {
    /// Sets the name of this person that others see; keeps it in this browser, and tells them at once.
    pub(crate) fn set_my_name(&self, name: &str) {
        let name: String = name.trim().chars().take(NAME_MAX_CHARS).collect();
        if !name.is_empty() && name != my_name() {
            Drawer::Browser.put(NAME_KEY, &name);
            self.tell_my_name(name);
        }
        self.keep_my_name();
    }

    /// True if the name that the others shall see is to be asked for: there are others, and nobody said it here.
    /// Reactive.
    pub(crate) fn asks_for_name(&self) -> bool {
        self.name_wanted.get() && !self.document.others().is_empty()
    }

    /// The name is fine as it is; nobody is asked again.
    pub(crate) fn keep_my_name(&self) {
        Drawer::Browser.put(ASKED_KEY, "1");
        set_if_new(&self.name_wanted, false);
    }

    /// Without a link the next greeting tells it.
    fn tell_my_name(&self, name: String) {
        let me = self.me.clone();
        link::ask(request::CallMe { name: name.clone() }, move |answer| {
            if answer.is_ok() {
                me.update(|me| me.iter_mut().for_each(|me| me.name.clone_from(&name)));
            }
        });
    }
}

/// Returns the greeting of this tab.
pub(super) fn greeting() -> request::Hello {
    request::Hello { version: protocol::VERSION, name: my_name(), again: kept_credential() }
}

/// Returns the credential that this tab had on an earlier link.
fn kept_credential() -> Option<Credential> {
    watch_this_tab();
    let kept = Drawer::Tab.get(TAB_KEY)?;
    let (client, secret) = kept.split_once(' ')?;
    Some(Credential { client: Id::new(client).ok()?, secret: Id::new(secret).ok()? })
}

pub(super) fn keep_credential(client: &Id, secret: &Id) {
    Drawer::Tab.put(TAB_KEY, &format!("{client} {secret}"));
}

/// A doubled tab copies what is kept for a tab, so a tab that is alive already counts as another one: once for each page.
fn watch_this_tab() {
    thread_local! {
        static WATCHED: () = {
            if Drawer::Tab.get(ALIVE_KEY).is_some() {
                Drawer::Tab.drop(TAB_KEY);
            }
            Drawer::Tab.put(ALIVE_KEY, "1");
            if let Some(window) = browser::window() {
                browser::hear(&window, "pagehide", |_| Drawer::Tab.drop(ALIVE_KEY));
                browser::hear(&window, "pageshow", |_| Drawer::Tab.put(ALIVE_KEY, "1"));
            }
        };
    }
    WATCHED.with(|()| ());
}

/// The name in this browser, at first "Guest" with a number.
fn my_name() -> String {
    Drawer::Browser.get(NAME_KEY).unwrap_or_else(|| {
        let name = format!("{GUEST}{}", (browser::random() * 90.0) as u32 + 10);
        Drawer::Browser.put(NAME_KEY, &name);
        name
    })
}

/// True if nobody here ever said a name, or was asked for it.
pub(super) fn is_name_wanted() -> bool {
    let number = |name: &str| name.strip_prefix(GUEST).is_some_and(|number| number.parse::<u8>().is_ok());
    Drawer::Browser.get(ASKED_KEY).is_none() && number(&my_name())
}
