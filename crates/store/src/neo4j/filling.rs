//! The mark of a database that is being filled: every server on it sees it.

use super::link::{Broken, Neo4jConnections, StatementParams};
use crate::{FillingSource, StoreError};
use serde_json::{Value, json};

const MARK: &str = "MATCH (n:Shared {name: 'filling'}) RETURN n.source AS key, n.again AS again";

/// Twice does the same as once.
const BEGIN: &str = "
MERGE (n:Shared {name: 'filling'})
ON CREATE SET n.source = $source, n.again = $again
RETURN n.source AS key, n.again AS again";

const END: &str = "MATCH (n:Shared {name: 'filling'}) DELETE n RETURN count(*) AS many";

/// Returns the source from which it is being filled.
pub(super) async fn mark(link: &Neo4jConnections) -> Result<Option<FillingSource>, StoreError> {
    Ok(link.read(MARK, StatementParams::new()).await?.into_iter().next())
}

/// Marks it, unless it is marked already; gives the mark that it has then.
pub(super) async fn begin(link: &Neo4jConnections, source: &FillingSource) -> Result<FillingSource, StoreError> {
    let params = [("source", json!(source.key)), ("again", json!(source.again))];
    let params = params.map(|(name, value)| (name.to_owned(), value)).into_iter().collect();
    let found = link.ask::<FillingSource>(BEGIN, params, Broken::Again).await?;
    Ok(found.rows.into_iter().next().unwrap_or_else(|| source.clone()))
}

/// Takes the mark away.
pub(super) async fn end(link: &Neo4jConnections) -> Result<(), StoreError> {
    link.ask::<Value>(END, StatementParams::new(), Broken::Again).await.map(|_| ())
}
