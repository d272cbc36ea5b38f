//! A store by its address.

use crate::{BadAddress, FillingSource, FolderStore, Store, StoreError, check_whole};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// The longest time of one answer of a store elsewhere where nobody waits in a page: as long as one that has just
/// started needs.
const WORK_MAX: Duration = Duration::from_secs(60);

/// Opens a store by its address, to serve it: `sqlite:FOLDER`, or the folder alone, for the embedded one; `files:FOLDER` for
/// one file of changes a behaviour; `bolt://USER@HOST:PORT` or `neo4j://...` for a Neo4j (see `open_neo4j`; without the
/// feature `neo4j` it is refused).
///
/// # Errors
/// [`StoreError::Unfinished`] for one that is filled only in part, [`StoreError::Address`] for an address of another kind,
/// and what opening that store may fail with.
pub async fn open_url(url: &str) -> Result<Arc<dyn Store>, StoreError> {
    whole(opened(url, None).await?).await
}

/// Opens a store by its address, for a command: its answers are waited for longer than people in a page would.
///
/// # Errors
/// Fails as [`open_url`] does.
pub async fn open_url_to_work(url: &str) -> Result<Arc<dyn Store>, StoreError> {
    whole(opened(url, Some(WORK_MAX)).await?).await
}

/// Opens a store by its address as [`open_url_to_work`] does, also one that is filled only in part. What is done to it goes
/// through [`crate::Filling`].
///
/// # Errors
/// Those of [`open_url`], without the first.
pub async fn open_url_to_fill(url: &str) -> Result<Arc<dyn Store>, StoreError> {
    opened(url, Some(WORK_MAX)).await
}

async fn whole(store: Arc<dyn Store>) -> Result<Arc<dyn Store>, StoreError> {
    check_whole(&*store).await?;
    Ok(store)
}

async fn opened(url: &str, answer_max: Option<Duration>) -> Result<Arc<dyn Store>, StoreError> {
    if is_neo4j(url) {
        return neo4j(url, answer_max).await;
    }
    if let Some(folder) = url.strip_prefix("files:").filter(|folder| !folder.is_empty()) {
        return Ok(Arc::new(FolderStore::open(Path::new(folder)).await?));
    }
    let folder = url.strip_prefix("sqlite:").unwrap_or(url);
    if folder.contains("://") || folder.is_empty() {
        return Err(StoreError::Address(BadAddress::Kind));
    }
    Ok(Arc::new(crate::open(Path::new(folder)).await?))
}

#[cfg(feature = "neo4j")]
async fn neo4j(url: &str, answer_max: Option<Duration>) -> Result<Arc<dyn Store>, StoreError> {
    Ok(match answer_max {
        Some(answer_max) => Arc::new(crate::open_neo4j_within(url, answer_max).await?),
        None => Arc::new(crate::open_neo4j(url).await?),
    })
}

#[cfg(not(feature = "neo4j"))]
async fn neo4j(_url: &str, _answer_max: Option<Duration>) -> Result<Arc<dyn Store>, StoreError> {
    Err(StoreError::WithoutNeo4j)
}

/// Returns the mark of a store that is filled from the one with this address, `again` being the command for that. The
/// address may be written in another way the next time.
#[must_use]
pub fn source_of(url: &str, again: &str) -> FillingSource {
    let place = url.split_once("://").map(|(_, rest)| rest.rsplit_once('@').map_or(rest, |(_, place)| place));
    let key = match (folder_of(url), place) {
        (Some(folder), _) => {
            let kind = if url.starts_with("files:") { "files" } else { "sqlite" };
            let folder = folder.canonicalize().or_else(|_| std::path::absolute(folder)).unwrap_or(folder.to_owned());
            format!("{kind} {}", folder.display())
        }
        (None, place) => format!("database {}", place.unwrap_or(url)),
    };
    FillingSource { key, again: again.to_owned() }
}

/// An address as others may see it: without a password, its folder from the root.
#[must_use]
pub fn shown_url(url: &str) -> String {
    if let Some(folder) = folder_of(url) {
        let kind =
            url.split_once(':').filter(|(kind, _)| ["files", "sqlite"].contains(kind)).map_or("sqlite", |it| it.0);
        let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        return format!("{kind}:{}", folder.display());
    }
    let Some((scheme, rest)) = url.split_once("://") else { return url.to_owned() };
    let Some((who, place)) = rest.rsplit_once('@') else { return url.to_owned() };
    format!("{scheme}://{}@{place}", who.split(':').next().unwrap_or_default())
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

/// True if both are the same folder, however they are written.
#[must_use]
pub fn is_same_folder(one: &Path, other: &Path) -> bool {
    one == other || one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}

#[cfg(test)]
mod tests {
    use super::{folder_of, shown_url, source_of};
    use std::path::Path;

    #[test]
    fn a_source_is_the_same_however_its_address_is_written_and_no_password_is_shown() {
        let key = |url: &str| source_of(url, "").key;
        assert_eq!(key("bolt://neo4j:secret@host:7687/lab"), key("neo4j://aiko@host:7687/lab"));
        assert_ne!(key("bolt://host:7687/lab"), key("bolt://host:7687"));
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().display().to_string();
        assert_eq!(key(&path), key(&format!("sqlite:{path}/.")));
        assert_ne!(key(&path), key(&format!("files:{path}")));
        assert_eq!(shown_url("bolt://neo4j:sec@ret@host"), "bolt://neo4j@host");
        assert_eq!([shown_url("/srv/rrp"), shown_url("files:/srv/rrp")], ["sqlite:/srv/rrp", "files:/srv/rrp"]);
    }

    #[test]
    fn a_folder_is_known_by_its_address() {
        for url in ["sqlite:/a/b", "files:/a/b", "/a/b"] {
            assert_eq!(folder_of(url), Some(Path::new("/a/b")), "{url}");
        }
        assert_eq!((folder_of("neo4j://a/b"), folder_of("sqlite:")), (None, None));
    }
}
