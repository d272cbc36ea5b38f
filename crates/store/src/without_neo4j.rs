//! What a program says that was built without what speaks to a Neo4j, when it is asked for one.

use crate::{MemoryStore, StoreError};
use behaviour::BehaviourFile;

/// There is none in this program.
///
/// # Errors
/// [`StoreError::WithoutNeo4j`].
#[expect(clippy::unused_async, reason = "as it is with a Neo4j")]
pub async fn open_neo4j(_url: &str) -> Result<MemoryStore, StoreError> {
    Err(StoreError::WithoutNeo4j)
}

/// There are none that this program could read.
///
/// # Errors
/// [`StoreError::WithoutNeo4j`].
#[expect(clippy::unused_async, reason = "as it is with a Neo4j")]
pub async fn read_thesis(_url: &str) -> Result<Vec<BehaviourFile>, StoreError> {
    Err(StoreError::WithoutNeo4j)
}
