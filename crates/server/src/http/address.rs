//! The address of a running server, kept in its folder, so that commands find the way through the server that holds it.

use std::net::SocketAddr;
use std::path::{Path, PathBuf};

/// The file with the address.
const FILE: &str = "server.url";

/// The address of the server that uses this folder, as it said when it started; it may be gone since.
#[must_use]
pub fn address_in(folder: &Path) -> Option<SocketAddr> {
    let text = std::fs::read_to_string(folder.join(FILE)).ok()?;
    text.trim().strip_prefix("http://")?.strip_suffix('/')?.parse().ok()
}

/// The file, for as long as the server serves.
pub(crate) struct AddressFile(Option<(PathBuf, SocketAddr)>);

impl AddressFile {
    /// Writes the address into the folder of the store, if it has one.
    pub(crate) fn new(store: &str, address: SocketAddr) -> Self {
        let Some(folder) = store::folder_of(store).filter(|folder| folder.is_dir()) else { return Self(None) };
        let file = folder.join(FILE);
        if let Err(error) = store::disk::put(&file, format!("http://{address}/\n").as_bytes()) {
            tracing::warn!(%error, "commands will not find this server: its address could not be written");
            // That of a server that was killed here would send them to somebody else.
            let _none_is_fine = std::fs::remove_file(&file);
        }
        Self(Some((file, address)))
    }
}

impl Drop for AddressFile {
    fn drop(&mut self) {
        // The next server may have written its own by now.
        let ours = self.0.take().filter(|(file, address)| file.parent().and_then(address_in) == Some(*address));
        if let Some((file, _)) = ours {
            // Whoever finds it later finds nobody there.
            let _ = std::fs::remove_file(file);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{AddressFile, address_in};

    #[test]
    fn the_address_is_there_while_the_server_serves() {
        let folder = tempfile::tempdir().unwrap();
        let (url, address) = (format!("sqlite:{}", folder.path().display()), "127.0.0.1:7130".parse().unwrap());
        let told = AddressFile::new(&url, address);
        assert_eq!(address_in(folder.path()), Some(address));
        drop(told);
        assert_eq!(address_in(folder.path()), None);
        assert!(AddressFile::new("neo4j://somewhere", address).0.is_none());
    }

    #[test]
    fn an_address_that_cannot_be_written_leaves_no_older_one() {
        let folder = tempfile::tempdir().unwrap();
        let (url, address) = (format!("sqlite:{}", folder.path().display()), "127.0.0.1:7130".parse().unwrap());
        std::mem::forget(AddressFile::new(&url, address));
        assert!(address_in(folder.path()).is_some(), "as a server that was killed leaves it");
        std::fs::create_dir(folder.path().join("server.new")).unwrap();
        let told = AddressFile::new(&url, "127.0.0.1:7131".parse().unwrap());
        assert_eq!(address_in(folder.path()), None);
        drop(told);
    }
}
