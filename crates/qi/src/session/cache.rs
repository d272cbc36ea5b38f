//! Services that were asked for, until they go or come anew.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use crate::error::QiError;
use crate::link::{SignalEvent, Subscription};
use crate::locked::locked;
use crate::object::Object;

/// The most services that are remembered.
const SERVICES_MAX: usize = 1024;

#[derive(Debug, Default)]
pub(super) struct Cache(Mutex<CachedService>);

#[derive(Debug, Default)]
struct CachedService {
    objects: BTreeMap<String, Object>,
    /// The number of changes so far: an answer that was asked for before a change is not kept after it.
    changes: u64,
}

impl Cache {
    /// A service whose link still is there, and how much had changed by then.
    pub(super) fn get(&self, name: &str) -> (Option<Object>, u64) {
        let known = locked(&self.0);
        let object = known.objects.get(name).filter(|object| object.link().ending().is_none());
        (object.cloned(), known.changes)
    }

    pub(super) fn put(&self, name: &str, object: &Object, seen: u64) {
        let mut known = locked(&self.0);
        if known.changes != seen {
            return;
        }
        if known.objects.len() >= SERVICES_MAX {
            known.objects.clear();
        }
        known.objects.insert(name.to_owned(), object.clone());
    }

    pub(super) fn forget(&self, name: &str) {
        let mut known = locked(&self.0);
        known.objects.remove(name);
        known.changes += 1;
    }

    fn forget_all(&self) {
        let mut known = locked(&self.0);
        known.objects.clear();
        known.changes += 1;
    }

    fn follow(&self, change: Result<SignalEvent, QiError>, lost: bool) {
        let name = change.ok().and_then(|event| Some(event.arguments.get(1)?.as_text()?.into_owned()));
        match name {
            Some(name) if !lost => self.forget(&name),
            _ => self.forget_all(),
        }
    }
}

/// Forgets what goes and what comes anew, until the link ends.
pub(super) async fn watch(cache: Arc<Cache>, mut added: Subscription, mut removed: Subscription) {
    let mut lost = 0;
    loop {
        let change = tokio::select! {
            change = added.next() => change,
            change = removed.next() => change,
        };
        let is_over = matches!(change, Err(QiError::Disconnected(_)));
        let now_lost = added.lost() + removed.lost();
        cache.follow(change, now_lost > lost);
        lost = now_lost;
        if is_over {
            return;
        }
    }
}
