//! Who this tab is to the server and to the others: its greeting, its name and what it proves itself with.

use super::Desk;
use crate::{browser, link};
use behaviour::Id;
use browser::Keep;
use protocol::{Credential, Request};

const TAB_KEY: &str = "rrp.client";
const ALIVE_KEY: &str = "rrp.alive";
const NAME_KEY: &str = "rrp.name";

impl Desk {
    /// The greeting of this tab.
    pub(crate) fn greeting(&self) -> Request {
        Request::Hello { version: protocol::VERSION, name: my_name(), again: kept_credential() }
    }

    /// What others see as this person's name; kept in this browser.
    pub(crate) fn set_my_name(&self, name: &str) {
        let name: String = name.trim().chars().take(40).collect();
        if !name.is_empty() && name != my_name() {
            Keep::Browser.put(NAME_KEY, &name);
            link::again();
        }
    }
}

/// Who this tab was on an earlier link.
fn kept_credential() -> Option<Credential> {
    watch_this_tab();
    let kept = Keep::Tab.get(TAB_KEY)?;
    let (client, secret) = kept.split_once(' ')?;
    Some(Credential { client: Id::new(client).ok()?, secret: Id::new(secret).ok()? })
}

pub(super) fn keep_credential(client: &Id, secret: &Id) {
    Keep::Tab.put(TAB_KEY, &format!("{client} {secret}"));
}

/// A doubled tab copies what is kept for a tab, so a tab that is alive already counts as another one: once for each page.
fn watch_this_tab() {
    thread_local! {
        static WATCHED: () = {
            if Keep::Tab.get(ALIVE_KEY).is_some() {
                Keep::Tab.drop(TAB_KEY);
            }
            Keep::Tab.put(ALIVE_KEY, "1");
            if let Some(window) = browser::window() {
                browser::hear(&window, "pagehide", |_| Keep::Tab.drop(ALIVE_KEY));
                browser::hear(&window, "pageshow", |_| Keep::Tab.put(ALIVE_KEY, "1"));
            }
        };
    }
    WATCHED.with(|()| ());
}

/// The name in this browser, at first "Guest" with a number.
fn my_name() -> String {
    Keep::Browser.get(NAME_KEY).unwrap_or_else(|| {
        let name = format!("Guest {}", (browser::random() * 90.0) as u32 + 10);
        Keep::Browser.put(NAME_KEY, &name);
        name
    })
}
