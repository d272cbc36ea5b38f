//! A store by its address.

use crate::{Store, StoreError};
use std::path::Path;
use std::sync::Arc;

/// Opens a store by its address: `sqlite:FOLDER`, or the folder alone, for the embedded one.
///
/// # Errors
/// [`StoreError::Address`] for an address of another kind, and what opening that store may fail with.
pub async fn open_url(url: &str) -> Result<Arc<dyn Store>, StoreError> {
    let folder = url.strip_prefix("sqlite:").unwrap_or(url);
    if folder.contains("://") || folder.is_empty() {
        let known = "begin it with sqlite: and a folder";
        return Err(StoreError::Address(known.to_owned()));
    }
    Ok(Arc::new(crate::open(Path::new(folder)).await?))
}
