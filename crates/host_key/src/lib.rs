//! The key by which a program of the user who runs a server proves to it that it speaks for its host. A server makes a new
//! one at each start and keeps it in files that only this user can read; whoever shows it, as [`header`] says, is the host.

mod files;

pub use files::Published;

use serde::{Deserialize, Serialize};
use std::net::SocketAddr;
use std::path::{Path, PathBuf};

/// The file in a server's data folder.
const FILE: &str = "rrp.host.json";
/// The folder that lists all running servers of a user, below the folder of what programs of this user remember.
const SERVERS: &str = "rrp/servers";

/// The name of the header of a request that shows a key.
pub const HEADER: &str = "authorization";

/// A key, and the server at whose address it counts.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct HostKey {
    /// The address at which the server listens for this computer.
    pub address: SocketAddr,
    /// The secret.
    pub key: String,
}

/// The value of [`HEADER`] that shows this key.
#[must_use]
pub fn header(key: &str) -> String {
    format!("Bearer {key}")
}

/// The key that a value of [`HEADER`] shows, if it shows one.
#[must_use]
pub fn shown(header: &str) -> Option<&str> {
    let (scheme, key) = header.split_once(' ')?;
    scheme.eq_ignore_ascii_case("bearer").then(|| key.trim())
}

/// Keeps the key of a server that starts: in its data folder, if it has one, and in the list of this user's servers. Where
/// neither can be written, as on a full disk, only browsers that come by a link can show that they are the host.
#[must_use]
pub fn publish(key: &HostKey, data: Option<&Path>) -> Published {
    Published::in_files(key, files::of(key.address, data))
}

/// The key of the server at this very address, if this user runs one there.
#[must_use]
pub fn of_server(address: SocketAddr) -> Option<String> {
    let kept = files::read(&servers()?.join(files::name(address)))?;
    (kept.address == address).then_some(kept.key)
}

/// The server that uses this data folder and its key; it may have ended since without a word.
#[must_use]
pub fn in_folder(data: &Path) -> Option<HostKey> {
    files::read(&data.join(FILE))
}

/// The list of this user's servers: below `$XDG_STATE_HOME`, else below `~/.local/state`.
fn servers() -> Option<PathBuf> {
    let said = |name| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let state = said("XDG_STATE_HOME").or_else(|| said("HOME").map(|home| home.join(".local/state")));
    state.map(|state| state.join(SERVERS))
}

#[cfg(test)]
mod tests {
    use super::{HostKey, header, in_folder, of_server, publish, shown};

    #[test]
    fn a_key_is_there_while_its_server_is() {
        let folder = tempfile::tempdir().unwrap();
        let own = HostKey { address: "127.0.0.1:1".parse().unwrap(), key: "first".into() };
        let told = publish(&own, Some(folder.path()));
        assert_eq!(in_folder(folder.path()), Some(own.clone()));
        assert_eq!(of_server(own.address).as_deref(), Some("first"));
        let next = HostKey { key: "other".into(), ..own.clone() };
        let next_told = publish(&next, Some(folder.path()));
        drop(told);
        assert_eq!(in_folder(folder.path()), Some(next), "that of a later server stays");
        drop(next_told);
        assert_eq!((in_folder(folder.path()), of_server(own.address)), (None, None));
    }

    #[test]
    fn a_header_shows_the_key_and_nothing_else_does() {
        assert_eq!(shown(&header("abc")), Some("abc"));
        assert_eq!(shown("bearer abc"), Some("abc"));
        assert_eq!((shown("abc"), shown("Basic abc")), (None, None));
    }
}
