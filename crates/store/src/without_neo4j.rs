//! What a program says that was built without what speaks to a Neo4j, when it is asked for one.

use crate::StoreError;
use behaviour::BehaviourFile;

/// Would read the programs of a Neo4j that the thesis's own environment wrote; this program was built without that.
///
/// # Errors
/// [`StoreError::WithoutNeo4j`], always.
pub async fn read_thesis(_url: &str) -> Result<Vec<BehaviourFile>, StoreError> {
    Err(StoreError::WithoutNeo4j)
}
