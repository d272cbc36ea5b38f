//! Small files that are there whole or not at all.

use std::io::{Error, ErrorKind};
use std::path::Path;

/// Puts a file in the place of the old one, once the new one is safe on the disk. Only its user may read it.
///
/// # Errors
/// If it could not be written; then the old one is as it was.
pub(crate) fn put(path: &Path, text: &str) -> std::io::Result<()> {
    store::disk::put(path, text.as_bytes())
}

/// What a JSON file says, if it is there. One that cannot be read is kept beside it under another name.
pub(crate) fn read<T: serde::de::DeserializeOwned>(path: &Path) -> Option<T> {
    let text = match std::fs::read_to_string(path) {
        Ok(text) => Ok(text),
        Err(error) if error.kind() == ErrorKind::NotFound => return None,
        Err(error) => Err(error),
    };
    let read = text.and_then(|text| serde_json::from_str(&text).map_err(Error::other));
    read.inspect_err(|error| set_aside(path, error)).ok()
}

fn set_aside(path: &Path, error: &Error) {
    let aside = path.with_extension("unreadable");
    let kept = store::disk::rename(path, &aside);
    tracing::warn!(path = %path.display(), aside = %aside.display(), ?kept, %error, "a file could not be read; it begins anew");
}

#[cfg(test)]
mod tests {
    use super::{put, read};

    #[test]
    fn what_cannot_be_read_is_kept_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new").join("list.json");
        assert_eq!(read::<Vec<u8>>(&path), None);
        put(&path, "[1]").unwrap();
        put(&path, "[1, 2]").unwrap();
        assert_eq!(read::<Vec<u8>>(&path), Some(vec![1, 2]));
        std::fs::write(&path, "nonsense").unwrap();
        assert_eq!(read::<Vec<u8>>(&path), None);
        assert!(!path.exists());
        assert_eq!(std::fs::read_to_string(path.with_extension("unreadable")).unwrap(), "nonsense");
    }
}
