//! Behaviours in a Neo4j database, as the thesis maps them (5.2.4): a stream is a node, a simple connector a
//! relationship.

mod address;
mod append;
mod bin;
mod checkpoints;
mod delta;
mod fault;
mod filling;
mod insight;
mod link;
mod list;
mod load;
mod nodes;
#[cfg(test)]
mod peer;
mod schema;
#[cfg(test)]
mod tests;
mod thesis;

use crate::{
    ActionDriver, Append, Contested, FillingSource, HelperUse, LIBRARY, Listing, Loaded, Query, Similar, Store,
    StoreError, json,
};
use address::Neo4jAddress;
use async_trait::async_trait;
use behaviour::{Behaviour, Checkpoint, Committed, Id};
use link::Neo4jConnections;
use std::sync::Arc;
use std::time::Duration;
pub use thesis::read_thesis;

/// Keeps behaviours in a Neo4j database, which other servers may use at the same time. Every call answers within
/// 3 seconds, also when Neo4j does not; what failed then works again as soon as Neo4j does.
pub struct Neo4jStore {
    link: Arc<Neo4jConnections>,
}

/// The longest time of a call, all attempts together.
const ANSWER_MAX: Duration = Duration::from_secs(3);

/// Opens the database at `bolt://USER:PASSWORD@HOST:PORT` (also `neo4j://`, and `+s` or `+ssc` for encryption; a
/// database other than the default one as `/NAME`) and brings its schema up to date. Without a password in the
/// address, it is taken from the variable `RRP_NEO4J_PASSWORD` or the file that `RRP_NEO4J_PASSWORD_FILE` names.
///
/// # Errors
/// [`StoreError::Address`] for an address that cannot be understood, [`StoreError::Newer`] or
/// [`StoreError::Unavailable`] if the database there cannot be used.
pub async fn open_neo4j(url: &str) -> Result<Neo4jStore, StoreError> {
    let store = open_neo4j_within(url, ANSWER_MAX).await?;
    store.warm_up();
    Ok(store)
}

/// Opens a Neo4j database of which every call answers within `answer_max`: for work on much data, where nobody waits. What
/// people need at first is not planned beforehand.
///
/// # Errors
/// Fails as [`open_neo4j`] does.
pub async fn open_neo4j_within(url: &str, answer_max: Duration) -> Result<Neo4jStore, StoreError> {
    let address = Neo4jAddress::read(url, &|name| std::env::var(name).ok())?;
    schema::migrate(&address).await?;
    Ok(Neo4jStore { link: Arc::new(Neo4jConnections::new(&address, answer_max)?) })
}

impl Neo4jStore {
    /// Only for speed: what fails here is said to whoever asks next.
    fn warm_up(&self) {
        let link = Arc::clone(&self.link);
        tokio::spawn(async move { append::warm_up(&link).await });
    }
}

#[async_trait]
impl Store for Neo4jStore {
    async fn append(&self, behaviour: &Id, committed: &Committed, after: &Behaviour) -> Result<Append, StoreError> {
        let json = json::checked(committed)?;
        append::append(&self.link, behaviour, committed, json, after).await
    }

    async fn load(&self, behaviour: &Id) -> Result<Option<Loaded>, StoreError> {
        load::load(&self.link, behaviour).await
    }

    async fn list(&self, query: &Query) -> Result<Listing, StoreError> {
        list::list(&self.link, query).await
    }

    async fn history(&self, behaviour: &Id, since: u64, most: u32) -> Result<Vec<Committed>, StoreError> {
        load::history(&self.link, behaviour, since, most).await
    }

    async fn checkpoints(&self, behaviour: &Id) -> Result<Vec<Checkpoint>, StoreError> {
        checkpoints::all(&self.link, behaviour).await
    }

    async fn keep_checkpoint(&self, behaviour: &Id, checkpoint: &Checkpoint) -> Result<bool, StoreError> {
        crate::checkpoints::check(checkpoint)?;
        checkpoints::keep(&self.link, behaviour, checkpoint).await
    }

    async fn drop_checkpoint(&self, behaviour: &Id, name: &str) -> Result<(), StoreError> {
        checkpoints::drop(&self.link, behaviour, name).await
    }

    async fn remove(&self, behaviour: &Id, now_ms: u64, by: &str) -> Result<bool, StoreError> {
        if behaviour.as_str() == LIBRARY {
            return Ok(false);
        }
        bin::remove(&self.link, behaviour, now_ms, by).await
    }

    async fn restore(&self, behaviour: &Id) -> Result<bool, StoreError> {
        bin::restore(&self.link, behaviour).await
    }

    async fn purge(&self, removed_before_ms: u64) -> Result<u32, StoreError> {
        bin::purge(&self.link, removed_before_ms).await
    }

    async fn users(&self, helper: &str) -> Result<Vec<HelperUse>, StoreError> {
        insight::users(&self.link, helper).await
    }

    async fn drivers(&self, actuator: &str) -> Result<Vec<ActionDriver>, StoreError> {
        insight::drivers(&self.link, actuator).await
    }

    async fn contested(&self) -> Result<Vec<Contested>, StoreError> {
        insight::contested(&self.link).await
    }

    async fn similar(&self, behaviour: &Id, most: u32) -> Result<Vec<Similar>, StoreError> {
        insight::similar(&self.link, behaviour, most).await
    }

    async fn next_epoch(&self) -> Result<u64, StoreError> {
        bin::next_epoch(&self.link).await
    }

    async fn raise_epoch(&self, least: u64) -> Result<(), StoreError> {
        bin::raise_epoch(&self.link, least).await
    }

    async fn filling(&self) -> Result<Option<FillingSource>, StoreError> {
        filling::mark(&self.link).await
    }

    async fn begin_filling(&self, source: &FillingSource) -> Result<FillingSource, StoreError> {
        filling::begin(&self.link, source).await
    }

    async fn end_filling(&self) -> Result<(), StoreError> {
        filling::end(&self.link).await
    }

    async fn reachable(&self) -> Result<(), StoreError> {
        // Also a server that was here before somebody fills it from elsewhere learns of that.
        crate::check_whole(self).await
    }

    async fn healthy(&self) -> Result<(), StoreError> {
        bin::probe(&self.link).await?;
        if self.link.was_away() {
            self.warm_up();
        }
        crate::check_whole(self).await
    }
}
