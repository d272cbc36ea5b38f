//! The way to the server: every call has an end, and is made again where that is safe.

use super::address::Neo4jAddress;
use super::fault::{Neo4jFault, told};
use crate::StoreError;
use neo4rs::{BoltType, ConfigBuilder, Graph, query};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;
use tokio::time::{Instant, sleep, timeout_at};

/// Connections kept open at the same time; further calls wait for one.
const CONNECTIONS_MAX: usize = 16;
/// Rows fetched at a time.
const ROWS_AT_ONCE: usize = 1_000;
/// The first pause before another attempt; it doubles up to the longest.
const PAUSE_MIN: Duration = Duration::from_millis(5);
const PAUSE_MAX: Duration = Duration::from_millis(320);
/// Attempts after a broken connection; a server that is away does not come back within one call.
const BROKEN_MAX: u32 = 3;

/// The parameters of a statement.
pub(super) type StatementParams = Map<String, Value>;

/// The way to go on when the connection broke before the answer came.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Broken {
    /// Do it again: twice does the same as once.
    Again,
    /// Give up: it may have been done.
    GiveUp,
}

/// Connections to one Neo4j.
pub(super) struct Neo4jConnections {
    graph: Graph,
    server: String,
    answer_max: Duration,
    pauses: AtomicU64,
    was_away: AtomicBool,
}

/// The rows that a call found, and whether an earlier attempt of it may have done its work too.
pub(super) struct FoundRows<T> {
    pub(super) rows: Vec<T>,
    pub(super) open_before: bool,
}

impl Neo4jConnections {
    /// A way to the server, where a call may take that long, all attempts together. It connects when first asked.
    pub(super) fn new(address: &Neo4jAddress, answer_max: Duration) -> Result<Self, StoreError> {
        let config = ConfigBuilder::default()
            .uri(&address.server)
            .user(&address.user)
            .password(&address.password)
            .fetch_size(ROWS_AT_ONCE)
            .max_connections(CONNECTIONS_MAX)
            .connection_timeout(answer_max)
            // The driver's name for how long to wait for a free connection.
            .max_lifetime(Some(answer_max));
        let config = match &address.database {
            Some(name) => config.db(name.as_str()),
            None => config,
        };
        let graph = config.build().and_then(Graph::connect);
        let graph = graph.map_err(|error| StoreError::Unavailable(format!("{}: {error}", address.server).into()))?;
        let pauses = AtomicU64::new(u64::from(std::process::id()));
        Ok(Self { graph, server: address.server.clone(), answer_max, pauses, was_away: AtomicBool::new(false) })
    }

    /// The driver's own handle, for transactions.
    pub(super) fn graph(&self) -> &Graph {
        &self.graph
    }

    /// True once after calls failed because the server did not answer: it may have started anew since.
    pub(super) fn was_away(&self) -> bool {
        self.was_away.swap(false, Ordering::Relaxed)
    }

    /// Reads rows.
    pub(super) async fn read<T: DeserializeOwned>(
        &self,
        text: &str,
        params: StatementParams,
    ) -> Result<Vec<T>, StoreError> {
        Ok(self.ask(text, params, Broken::Again).await?.rows)
    }

    /// Says a fault.
    pub(super) fn told(&self, fault: Neo4jFault) -> StoreError {
        told(fault, &self.server, self.answer_max)
    }

    /// Reads or writes.
    pub(super) async fn ask<T: DeserializeOwned>(
        &self,
        text: &str,
        params: StatementParams,
        broken: Broken,
    ) -> Result<FoundRows<T>, StoreError> {
        self.ask_for(self.answer_max, text, params, broken).await
    }

    /// Reads or writes within a time.
    pub(super) async fn ask_for<T: DeserializeOwned>(
        &self,
        at_most: Duration,
        text: &str,
        params: StatementParams,
        broken: Broken,
    ) -> Result<FoundRows<T>, StoreError> {
        let end = Instant::now() + at_most;
        let (mut open_before, mut tries, mut breaks) = (false, 0, 0);
        loop {
            let fault = match timeout_at(end, self.once(text, &params)).await {
                Ok(Ok(rows)) => return Ok(FoundRows { rows, open_before }),
                Ok(Err(fault)) => fault,
                Err(_) => Neo4jFault::Silent,
            };
            breaks += u32::from(fault == Neo4jFault::Broken);
            open_before |= fault == Neo4jFault::Broken;
            let again = match fault {
                Neo4jFault::Passing(_) => true,
                Neo4jFault::Broken => broken == Broken::Again && breaks < BROKEN_MAX,
                Neo4jFault::Away | Neo4jFault::Silent | Neo4jFault::Said(_) => false,
            };
            let pause = self.pause(tries);
            tries += 1;
            if !again || Instant::now() + pause >= end {
                let away = matches!(fault, Neo4jFault::Broken | Neo4jFault::Away | Neo4jFault::Silent);
                self.was_away.fetch_or(away, Ordering::Relaxed);
                return Err(told(fault, &self.server, at_most));
            }
            sleep(pause).await;
        }
    }

    /// One attempt: the statement, then every row. (Rows left unread would leave errors unread too.)
    async fn once<T: DeserializeOwned>(&self, text: &str, params: &StatementParams) -> Result<Vec<T>, Neo4jFault> {
        let statement = params.iter().try_fold(query(text), |statement, (name, value)| {
            Ok::<_, Neo4jFault>(statement.param(name, BoltType::try_from(value.clone())?))
        })?;
        let mut stream = self.graph.execute(statement).await?;
        let mut rows = Vec::new();
        while let Some(row) = stream.next().await? {
            let row: Value = row.to().map_err(|error| Neo4jFault::damaged(&error))?;
            rows.push(serde_json::from_value(row).map_err(|error| Neo4jFault::damaged(&error))?);
        }
        Ok(rows)
    }

    /// A pause of chance length, so that those who collided do not collide again.
    fn pause(&self, tries: u32) -> Duration {
        let longest = PAUSE_MAX.min(PAUSE_MIN * 2_u32.saturating_pow(tries.min(16)));
        let drawn = self.pauses.fetch_add(0x9E37_79B9_7F4A_7C15, Ordering::Relaxed);
        let mixed = (drawn ^ (drawn >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        longest.mul_f64(0.5 + ((mixed >> 11) as f64) / ((1_u64 << 53) as f64) / 2.0)
    }
}
