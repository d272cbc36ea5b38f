//! The answer of a program that was built without the Neo4j driver, when it is asked for a Neo4j.

use crate::StoreError;
use behaviour::BehaviourFile;

/// Would read the programs of a Neo4j that the thesis's own environment wrote; this program was built without that.
///
/// # Errors
/// [`StoreError::WithoutNeo4j`], always.
pub async fn read_thesis(_url: &str) -> Result<Vec<BehaviourFile>, StoreError> {
    Err(StoreError::WithoutNeo4j)
}
