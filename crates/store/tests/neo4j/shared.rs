//! One Neo4j for the tests that do it no harm; they use it one after the other.

use crate::server::{self, Neo4j};
use neo4rs::{Graph, query};
use serde_json::Value;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use store::Neo4jStore;
use tokio::sync::{Mutex, MutexGuard, OnceCell};

const PATIENCE: Duration = Duration::from_secs(120);

static SHARED: OnceCell<Arc<Neo4j>> = OnceCell::const_new();
static TURN: Mutex<()> = Mutex::const_new(());

/// A Neo4j for one test at a time.
pub(crate) struct Alone {
    neo4j: Arc<Neo4j>,
    /// Held where it is the shared one.
    _turn: Option<MutexGuard<'static, ()>>,
}

/// Waits for the shared Neo4j; none if there is none here.
pub(crate) async fn alone(part: &str) -> Option<Alone> {
    let folder = server::folder(part)?;
    let turn = TURN.lock().await;
    let neo4j = Arc::clone(SHARED.get_or_init(|| start(folder)).await);
    Some(Alone { neo4j, _turn: Some(turn) })
}

/// A Neo4j of its own for a test that takes long, while others use the shared one; none if there is none here.
pub(crate) async fn own(part: &str) -> Option<Alone> {
    let folder = server::folder(part)?;
    Some(Alone { neo4j: start(folder).await, _turn: None })
}

async fn start(folder: PathBuf) -> Arc<Neo4j> {
    tokio::task::spawn_blocking(|| Arc::new(Neo4j::start(folder))).await.expect("a start")
}

impl Alone {
    pub(crate) fn url(&self) -> String {
        self.neo4j.url()
    }

    /// A handle like that of another server on the same database. It waits longer than people would: these tests
    /// are about what is kept, on machines of any speed.
    pub(crate) async fn store(&self) -> Neo4jStore {
        store::open_neo4j_within(&self.url(), PATIENCE).await.expect("a store")
    }

    /// Takes everything out but the schema.
    pub(crate) async fn empty(&self) {
        self.rows("MATCH (n) WHERE NOT n:Migration AND NOT n:Shared DETACH DELETE n").await;
    }

    /// A handle to a database without anything in it.
    pub(crate) async fn empty_store(&self) -> Neo4jStore {
        let store = self.store().await;
        self.empty().await;
        store
    }

    /// Returns the answer of the database itself.
    pub(crate) async fn rows(&self, text: &str) -> Vec<Value> {
        rows(&self.neo4j, text).await
    }
}

/// Returns the answer of a Neo4j, row by row.
pub(crate) async fn rows(neo4j: &Neo4j, text: &str) -> Vec<Value> {
    let graph = Graph::new(neo4j.place(), "neo4j", neo4j.password()).expect("a graph");
    let mut stream = graph.execute(query(text)).await.expect("the statement runs");
    let mut rows = Vec::new();
    while let Some(row) = stream.next().await.expect("a row") {
        rows.push(row.to().expect("values"));
    }
    rows
}
