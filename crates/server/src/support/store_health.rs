//! Whether the store can be reached: asked every second, told to everyone, and asked before anything is saved.

use super::message::encode;
use super::store_call::reason;
use super::tasks::Tasks;
use axum::extract::ws::Utf8Bytes;
use phrase::Phrase;
use protocol::{Event, Refused};
use std::sync::Arc;
use std::time::Duration;
use store::{Store, StoreError};
use tokio::sync::watch;

/// How often the store is asked.
const ASK_MS: u64 = 1_000;
/// How long it may take to answer; with [`ASK_MS`], everyone knows within five seconds.
const ANSWER_MS: u64 = 3_000;

/// Whether the store can be reached. A clone knows the same.
#[derive(Clone)]
pub(crate) struct StoreHealth {
    away: watch::Sender<Option<Phrase>>,
    text: watch::Sender<Utf8Bytes>,
}

impl StoreHealth {
    /// A store that answered just now.
    pub(crate) fn good() -> Self {
        Self { away: watch::Sender::new(None), text: watch::Sender::new(text(None)) }
    }

    /// Why nothing can be saved now, if that is so.
    pub(crate) fn away(&self) -> Option<Refused> {
        self.away.borrow().clone().map(Refused::Store)
    }

    /// The newest as a message to everyone.
    pub(crate) fn text(&self) -> watch::Receiver<Utf8Bytes> {
        self.text.subscribe()
    }

    /// A change could not be saved; only what may pass by itself closes the rooms.
    pub(crate) fn failed(&self, error: &StoreError) {
        if error.is_open() || *error == StoreError::Full {
            self.set(Some(reason(error)));
        }
    }

    fn set(&self, away: Option<Phrase>) {
        let news = self.away.send_if_modified(|known| {
            let differs = *known != away;
            known.clone_from(&away);
            differs
        });
        if news {
            match &away {
                Some(reason) => tracing::error!(%reason, "the store cannot be reached; nothing is saved meanwhile"),
                None => tracing::info!("the store can be reached again"),
            }
            self.text.send_replace(text(away));
        }
    }
}

fn text(away: Option<Phrase>) -> Utf8Bytes {
    encode(Event::Store { away })
}

/// Asks until the server ends.
pub(crate) fn keep(health: StoreHealth, store: Arc<dyn Store>, tasks: &Tasks) {
    let ending = tasks.clone();
    tasks.spawn(async move {
        let mut beat = tokio::time::interval(Duration::from_millis(ASK_MS));
        beat.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Delay);
        while ending.until_end(beat.tick()).await.is_some() {
            if let Some(answer) = ending.until_end(ask(&health, &*store)).await {
                health.set(answer.err().map(|error| reason(&error)));
            }
        }
    });
}

/// While it seems well a cheap question is enough; to be well again it has to save, and after a full disk to have room
/// for what was refused: else the next save would fail again, and everyone would be told now this, now that.
async fn ask(health: &StoreHealth, store: &dyn Store) -> Result<(), StoreError> {
    let well = health.away.borrow().is_none();
    let answer = async { if well { store.reachable().await } else { store.healthy().await } };
    let bound = Duration::from_millis(ANSWER_MS);
    tokio::time::timeout(bound, answer).await.unwrap_or(Err(StoreError::Timeout))
}
