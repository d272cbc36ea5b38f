//! The list of behaviours, and when everyone is told that it changed: at once when a name or the number of behaviours
//! changed, otherwise together with other changes, a little later.

use crate::hub::bounded;
use crate::lock;
use crate::outbox::encode;
use axum::extract::ws::Utf8Bytes;
use behaviour::{Accepted, Behaviour, Id};
use protocol::{Reply, Summary};
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use store::{Listed, Query, Store, StoreError};
use tokio::sync::watch;

/// The behaviours that are not in the bin.
#[derive(Debug)]
pub(crate) struct Programs {
    all: Mutex<BTreeMap<String, Summary>>,
    changed: AtomicBool,
    text: watch::Sender<Utf8Bytes>,
}

impl Programs {
    /// The list as the store has it.
    pub(crate) fn of(listed: Vec<Listed>) -> Self {
        let all = listed.into_iter().map(|listed| (listed.id.to_string(), summary_of(listed))).collect();
        let programs = Self {
            all: Mutex::new(all),
            changed: AtomicBool::new(false),
            text: watch::Sender::new(Utf8Bytes::default()),
        };
        programs.tell();
        programs
    }

    /// The newest list as a message to everyone.
    pub(crate) fn text(&self) -> watch::Receiver<Utf8Bytes> {
        self.text.subscribe()
    }

    /// Id and name of every behaviour, by name.
    pub(crate) fn names(&self) -> Vec<(String, String)> {
        let mut names: Vec<_> = lock(&self.all).values().map(|one| (one.name.clone(), one.id.clone())).collect();
        names.sort();
        names.into_iter().map(|(name, id)| (id, name)).collect()
    }

    /// The list as a reply, newest change first.
    pub(crate) fn reply(&self) -> Reply {
        let mut programs: Vec<_> = lock(&self.all).values().cloned().collect();
        programs.sort_by_key(|program| (Reverse(program.changed_ms), program.id.clone()));
        Reply::Programs { programs }
    }

    /// A behaviour was made or changed.
    pub(crate) fn changed(&self, behaviour: &Id, records: &Behaviour, accepted: &Accepted) {
        let summary = Summary {
            id: behaviour.to_string(),
            name: records.name().to_owned(),
            changed_ms: accepted.change.at_ms,
            by: accepted.change.author.clone(),
            streams: u32::try_from(records.streams().count()).unwrap_or(u32::MAX),
            picture: None,
        };
        let before = lock(&self.all).insert(summary.id.clone(), summary.clone());
        if before.is_none_or(|before| before.name != summary.name) {
            self.tell();
        } else {
            self.changed.store(true, Ordering::Relaxed);
        }
    }

    /// A behaviour went to the bin.
    pub(crate) fn removed(&self, behaviour: &Id) {
        lock(&self.all).remove(behaviour.as_str());
        self.tell();
    }

    /// Everything again, as the store has it.
    pub(crate) fn replace(&self, listed: Vec<Listed>) {
        *lock(&self.all) = listed.into_iter().map(|listed| (listed.id.to_string(), summary_of(listed))).collect();
        self.tell();
    }

    /// Tells what was left for later.
    pub(crate) fn tell_later_ones(&self) {
        if self.changed.swap(false, Ordering::Relaxed) {
            self.tell();
        }
    }

    /// This name, or with a number if it is taken.
    pub(crate) fn free_name(&self, wanted: &str) -> String {
        let all = lock(&self.all);
        let taken = |name: &str| all.values().any(|program| program.name == name);
        let numbered = (2_u64..).map(|number| format!("{wanted} {number}"));
        let free = std::iter::once(wanted.to_owned()).chain(numbered).find(|name| !taken(name));
        free.unwrap_or_else(|| wanted.to_owned())
    }

    fn tell(&self) {
        let reply = self.reply();
        self.text.send_replace(encode(None, reply));
    }
}

/// Everything that is not in the bin, page by page.
pub(crate) async fn all(store: &dyn Store) -> Result<Vec<Listed>, StoreError> {
    let (mut lines, mut query) = (Vec::new(), Query::default());
    loop {
        let page = bounded(store.list(&query)).await?;
        lines.extend(page.lines);
        query.after = page.next;
        if query.after.is_none() {
            return Ok(lines);
        }
    }
}

fn summary_of(listed: Listed) -> Summary {
    Summary {
        id: listed.id.to_string(),
        name: listed.name,
        changed_ms: listed.changed_ms,
        by: listed.by,
        streams: listed.streams,
        picture: None,
    }
}
