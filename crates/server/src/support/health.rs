//! Whether the store can be reached: asked every second, told to everyone, and asked before anything is saved.

use crate::state::Hub;
use crate::support::message::encode;
use axum::extract::ws::Utf8Bytes;
use protocol::{Reply, SaidNo};
use std::sync::Arc;
use std::time::Duration;
use store::StoreError;
use tokio::sync::watch;

/// How often the store is asked.
const ASK_MS: u64 = 1_000;
/// How long it may take to answer; with [`ASK_MS`], everyone knows within five seconds.
const ANSWER_MS: u64 = 3_000;

/// Whether the store can be reached.
pub(crate) struct Health {
    away: watch::Sender<Option<String>>,
    text: watch::Sender<Utf8Bytes>,
}

impl Health {
    /// A store that answered just now.
    pub(crate) fn good() -> Self {
        Self { away: watch::Sender::new(None), text: watch::Sender::new(text(None)) }
    }

    /// Why nothing can be saved now, if that is so.
    pub(crate) fn away(&self) -> Option<SaidNo> {
        self.away.borrow().clone().map(SaidNo::Store)
    }

    /// The newest as a message to everyone.
    pub(crate) fn text(&self) -> watch::Receiver<Utf8Bytes> {
        self.text.subscribe()
    }

    /// A change could not be saved; only what may pass by itself closes the rooms.
    pub(crate) fn failed(&self, error: &StoreError) {
        if error.is_open() || *error == StoreError::Full {
            self.set(Some(crate::support::store_call::reason(error)));
        }
    }

    fn set(&self, away: Option<String>) {
        let news = self.away.send_if_modified(|known| {
            let differs = *known != away;
            known.clone_from(&away);
            differs
        });
        if news {
            match &away {
                Some(reason) => tracing::error!(reason, "the store cannot be reached; nothing is saved meanwhile"),
                None => tracing::info!("the store can be reached again"),
            }
            self.text.send_replace(text(away));
        }
    }
}

fn text(away: Option<String>) -> Utf8Bytes {
    encode(None, Reply::Store { away })
}

/// Asks until the server ends.
pub(crate) fn keep(hub: &Arc<Hub>) {
    let hub = Arc::clone(hub);
    hub.clone().tasks.spawn(async move {
        let mut beat = tokio::time::interval(Duration::from_millis(ASK_MS));
        beat.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Delay);
        while hub.stopping.run_until_cancelled(beat.tick()).await.is_some() {
            if let Some(answer) = hub.stopping.run_until_cancelled(ask(&hub)).await {
                hub.health.set(answer.err().map(|error| crate::support::store_call::reason(&error)));
            }
        }
    });
}

/// While it seems well a cheap question is enough; to be well again it has to save, and after a full disk to have room
/// for what was refused: else the next save would fail again, and everyone would be told now this, now that.
async fn ask(hub: &Hub) -> Result<(), StoreError> {
    let well = hub.health.away.borrow().is_none();
    let answer = async { if well { hub.store.reachable().await } else { hub.store.healthy().await } };
    let bound = Duration::from_millis(ANSWER_MS);
    tokio::time::timeout(bound, answer).await.unwrap_or(Err(StoreError::Timeout))
}
