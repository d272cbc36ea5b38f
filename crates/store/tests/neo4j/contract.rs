//! The contract of all stores, on a real Neo4j.

use crate::shared::{self, Alone};
use std::future::Future;
use std::pin::Pin;
use std::sync::Arc;
use store::{Store, contract};

/// Each is eighty changes of all kinds, and most kinds are a statement that Neo4j plans anew.
const RUNS: u64 = 6;

type Made<'a> = Pin<Box<dyn Future<Output = Arc<dyn Store>> + 'a>>;

fn emptied<'a>(neo4j: &'a Alone, store: &'a Arc<dyn Store>) -> Made<'a> {
    Box::pin(async {
        neo4j.empty().await;
        Arc::clone(store)
    })
}

#[tokio::test(flavor = "multi_thread")]
async fn the_neo4j_store_keeps_the_contract() {
    let Some(neo4j) = shared::own("the contract of the Neo4j store").await else { return };
    let store: Arc<dyn Store> = Arc::new(neo4j.store().await);
    Box::pin(contract::check(|| emptied(&neo4j, &store), RUNS)).await;
}
