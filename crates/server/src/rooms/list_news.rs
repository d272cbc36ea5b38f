//! When everyone is told that the list of behaviours changed: at once when a name, the tags or the number of behaviours
//! changed, otherwise together with other changes, a little later.

use crate::support::message::encode;
use axum::extract::ws::Utf8Bytes;
use behaviour::{Accepted, Edit, Record, RecordId};
use protocol::Event;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tokio::sync::watch;

/// Tells everyone that the list changed. A clone tells the same.
#[derive(Clone, Debug)]
pub(crate) struct ListNews(Arc<News>);

#[derive(Debug)]
struct News {
    changed: AtomicBool,
    text: watch::Sender<Utf8Bytes>,
}

impl Default for ListNews {
    fn default() -> Self {
        let text = watch::Sender::new(encode(Event::ProgramsChanged));
        Self(Arc::new(News { changed: AtomicBool::new(false), text }))
    }
}

impl ListNews {
    /// The message to everyone, new each time the list changed.
    pub(crate) fn text(&self) -> watch::Receiver<Utf8Bytes> {
        self.0.text.subscribe()
    }

    /// A behaviour was made or changed.
    pub(crate) fn changed(&self, accepted: &Accepted) {
        if accepted.revision == 1 || accepted.change.edits.iter().any(renames) {
            self.tell();
        } else {
            self.0.changed.store(true, Ordering::Relaxed);
        }
    }

    /// Tells what was left for later.
    pub(crate) fn tell_later_ones(&self) {
        if self.0.changed.swap(false, Ordering::Relaxed) {
            self.tell();
        }
    }

    /// Tells everyone now.
    pub(crate) fn tell(&self) {
        self.0.text.send_modify(|_| {});
    }
}

/// True if another name or other tags come of it.
fn renames(edit: &Edit) -> bool {
    let shown = |record: &Option<Record>| match record {
        Some(Record::Settings(settings)) => (settings.name.clone(), settings.tags.clone()),
        _ => <(String, Vec<String>)>::default(),
    };
    edit.id == RecordId::settings() && shown(&edit.before) != shown(&edit.after)
}
