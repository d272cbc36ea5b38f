//! A store by its address.

use crate::{FolderStore, Store, StoreError, check_whole};
use std::path::Path;
use std::sync::Arc;

/// Opens a store by its address, to serve it or to read all of it; one that is filled only in part is refused. Addresses are
/// those of [`open_url_to_fill`].
///
/// # Errors
/// [`StoreError::Unfinished`], and those of [`open_url_to_fill`].
pub async fn open_url(url: &str) -> Result<Arc<dyn Store>, StoreError> {
    let store = open_url_to_fill(url).await?;
    check_whole(&*store).await?;
    Ok(store)
}

/// Opens a store by its address, also one that is filled only in part: `sqlite:FOLDER`, or the folder alone, for the embedded one; `files:FOLDER` for one
/// file of changes a behaviour; `bolt://USER@HOST:PORT` or `neo4j://...` for a Neo4j (see `open_neo4j`; without the feature
/// `neo4j` it is refused).
///
/// # Errors
/// [`StoreError::Address`] for an address of another kind, and what opening that store may fail with.
pub async fn open_url_to_fill(url: &str) -> Result<Arc<dyn Store>, StoreError> {
    if is_neo4j(url) {
        #[cfg(feature = "neo4j")]
        return Ok(Arc::new(crate::open_neo4j(url).await?));
        #[cfg(not(feature = "neo4j"))]
        return Err(StoreError::WithoutNeo4j);
    }
    if let Some(folder) = url.strip_prefix("files:").filter(|folder| !folder.is_empty()) {
        return Ok(Arc::new(FolderStore::open(Path::new(folder)).await?));
    }
    let folder = url.strip_prefix("sqlite:").unwrap_or(url);
    if folder.contains("://") || folder.is_empty() {
        let known = "begin it with sqlite: or files: and a folder, or with bolt:// for a Neo4j";
        return Err(StoreError::Address(known.to_owned()));
    }
    Ok(Arc::new(crate::open(Path::new(folder)).await?))
}

/// True for an address of a Neo4j.
pub(crate) fn is_neo4j(url: &str) -> bool {
    let scheme = url.split_once("://").map(|(scheme, _)| scheme);
    let base = scheme.map(|scheme| scheme.strip_suffix("+s").or(scheme.strip_suffix("+ssc")).unwrap_or(scheme));
    matches!(base, Some("bolt" | "neo4j"))
}

/// The folder of a store that is one, embedded or of files; none for a store somewhere else.
#[must_use]
pub fn folder_of(url: &str) -> Option<&Path> {
    let folder = url.strip_prefix("files:").or_else(|| url.strip_prefix("sqlite:")).unwrap_or(url);
    (!folder.contains("://") && !folder.is_empty()).then(|| Path::new(folder))
}

/// Whether both are the same folder, however they are written.
#[must_use]
pub fn is_same_folder(one: &Path, other: &Path) -> bool {
    one == other || one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}

#[cfg(test)]
mod tests {
    use super::folder_of;
    use std::path::Path;

    #[test]
    fn a_folder_is_known_by_its_address() {
        for url in ["sqlite:/a/b", "files:/a/b", "/a/b"] {
            assert_eq!(folder_of(url), Some(Path::new("/a/b")), "{url}");
        }
        assert_eq!((folder_of("neo4j://a/b"), folder_of("sqlite:")), (None, None));
    }
}
