//! The files of keys: readable by their user only, and gone with their server.

use crate::{FILE, HostKey, servers};
use std::fs::{self, DirBuilder, File, OpenOptions};
use std::io::{self, Write};
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Servers that may be listed: those that were killed leave their file, and the oldest is forgotten.
const LISTED_MAX: usize = 256;

/// Files with a key, until this is dropped.
#[derive(Debug)]
pub struct Published {
    key: HostKey,
    files: Vec<PathBuf>,
}

/// Returns the files in which the key of the server at this address is kept.
pub(crate) fn of(address: SocketAddr, data: Option<&Path>) -> Vec<PathBuf> {
    let listed = servers().map(|servers| servers.join(name(address)));
    data.map(|data| data.join(FILE)).into_iter().chain(listed).collect()
}

/// Names the file of an address: `127.0.0.1-7130.json`.
pub(crate) fn name(address: SocketAddr) -> String {
    let ip = address.ip().to_string().replace(':', "_");
    format!("{ip}-{}.json", address.port())
}

/// Reads the key that a file holds.
pub(crate) fn read(file: &Path) -> Option<HostKey> {
    serde_json::from_str(&fs::read_to_string(file).ok()?).ok()
}

impl Published {
    /// Writes the key into these files, as far as that is possible.
    pub(crate) fn in_files(key: &HostKey, files: Vec<PathBuf>) -> Self {
        let text = serde_json::to_string(key).unwrap_or_default();
        let files = files.into_iter().filter(|file| put(file, text.as_bytes()).is_ok()).collect();
        if let Some(servers) = servers() {
            forget_oldest(&servers);
        }
        Self { key: key.clone(), files }
    }

    /// True if a program of this user finds the key.
    #[must_use]
    pub fn is_kept(&self) -> bool {
        !self.files.is_empty()
    }
}

impl Drop for Published {
    /// Leaves alone what a later server at the same place has written.
    fn drop(&mut self) {
        let ours = self.files.iter().filter(|file| read(file).as_ref() == Some(&self.key));
        ours.for_each(|file| drop(fs::remove_file(file)));
    }
}

/// Puts a file in the place of an older one. On a full disk it is written over the older one, which is as long.
fn put(file: &Path, text: &[u8]) -> io::Result<()> {
    if let Some(folder) = file.parent() {
        let mut builder = DirBuilder::new();
        builder.recursive(true);
        private::folder(&mut builder);
        builder.create(folder)?;
    }
    let fresh = file.with_extension("new");
    let written = write(&fresh, File::options().create(true).truncate(true), text);
    let put = written.and_then(|()| fs::rename(&fresh, file));
    put.or_else(|_| {
        drop(fs::remove_file(&fresh));
        write(file, &mut File::options(), text)
    })
}

fn write(path: &Path, options: &mut OpenOptions, text: &[u8]) -> io::Result<()> {
    private::file(options);
    let mut file = options.write(true).open(path)?;
    file.write_all(text)?;
    file.set_len(text.len() as u64)
}

fn forget_oldest(servers: &Path) {
    let Ok(entries) = fs::read_dir(servers) else { return };
    let written = |entry: &fs::DirEntry| entry.metadata().and_then(|data| data.modified());
    let mut all: Vec<(SystemTime, PathBuf)> =
        entries.flatten().filter_map(|entry| Some((written(&entry).ok()?, entry.path()))).collect();
    all.sort();
    let many = all.len().saturating_sub(LISTED_MAX);
    all.iter().take(many).for_each(|(_, file)| drop(fs::remove_file(file)));
}

#[cfg(unix)]
mod private {
    use std::fs::{DirBuilder, OpenOptions};
    use std::os::unix::fs::{DirBuilderExt, OpenOptionsExt};

    pub(super) fn folder(builder: &mut DirBuilder) {
        builder.mode(0o700);
    }

    pub(super) fn file(options: &mut OpenOptions) {
        options.mode(0o600);
    }
}

/// Elsewhere a user's own folders are private already.
#[cfg(not(unix))]
mod private {
    use std::fs::{DirBuilder, OpenOptions};

    pub(super) fn folder(_: &mut DirBuilder) {}

    pub(super) fn file(_: &mut OpenOptions) {}
}
