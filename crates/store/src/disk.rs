//! Files and folders on this computer's disk: readable by their user only, and there whole after a power cut.

use crate::StoreError;
use std::fs::{self, DirBuilder, File, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

/// The ending of a file until it takes the place of the old one.
const FRESH: &str = "new";
/// The file that is written to see whether there is room.
const ROOM: &str = "rrp.room";
/// The most bytes of it that are written at once.
const PIECE_BYTES: usize = 64 << 10;
/// The beginnings of names of files in a data folder; their endings follow.
const OURS: [&str; 2] = ["rrp.", "b-"];
const OUR_ENDINGS: [&str; 4] = [".json", ".jsonl", ".url", ".new"];
/// Folders that may be in a data folder.
const OUR_FOLDERS: [&str; 4] = ["recordings", "robot-orders", "stores", ".git"];

/// Makes a folder, and those above it, into which only its user may look. One that is there stays as it is.
///
/// # Errors
/// If it cannot be made.
pub fn make_folder(folder: &Path) -> io::Result<()> {
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    unix::only_ours(&mut builder);
    builder.create(folder)
}

/// Returns the options to write a file that only its user may read.
#[must_use]
pub fn private() -> OpenOptions {
    let mut options = File::options();
    options.write(true);
    unix::only_ours_to_read(&mut options);
    options
}

/// Puts a file in the place of the old one, once the new one is safe on the disk, its name included.
///
/// # Errors
/// If it could not be written; then the old one is as it was.
pub fn put(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if let Some(folder) = path.parent() {
        make_folder(folder)?;
    }
    let fresh = path.with_extension(FRESH);
    let written = write_anew(&fresh, bytes).and_then(|()| rename(&fresh, path));
    written.inspect_err(|_| drop(fs::remove_file(&fresh)))
}

fn write_anew(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// An empty file that only its user may read, in the place of one that is there.
///
/// # Errors
/// If it cannot be made.
pub fn create(path: &Path) -> io::Result<File> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    private().create_new(true).open(path)
}

/// Renames a file so that its new name survives a power cut.
///
/// # Errors
/// If it cannot be renamed.
pub fn rename(from: &Path, to: &Path) -> io::Result<()> {
    fs::rename(from, to)?;
    sync_names(to.parent().unwrap_or(Path::new("")))
}

/// Makes new and lost names in a folder survive a power cut.
///
/// # Errors
/// If the disk does not take them.
pub fn sync_names(folder: &Path) -> io::Result<()> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    // Elsewhere a folder cannot be opened; the system looks after its names itself.
    if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
}

/// Says the failure of a file in the words of the store.
pub(crate) fn told(path: &Path, error: &io::Error) -> StoreError {
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => StoreError::Full,
        _ => StoreError::Unavailable(format!("{}: {error}", path.display()).into()),
    }
}

/// Checks that so many bytes can be written into a folder now.
///
/// # Errors
/// Returns the reason why they cannot.
pub(crate) fn has_room(folder: &Path, bytes: usize) -> io::Result<()> {
    let path = folder.join(ROOM);
    let tried = create(&path).and_then(|file| fill(file, bytes));
    let gone = fs::remove_file(&path);
    tried.and(gone)
}

/// Bytes of all kinds, so that a disk that compresses needs the room too.
fn fill(mut file: File, bytes: usize) -> io::Result<()> {
    let mut last = 1_u64;
    let mut next = || {
        last ^= last << 13;
        last ^= last >> 7;
        last ^= last << 17;
        last.to_le_bytes()
    };
    let mut left = bytes;
    while left > 0 {
        let piece: Vec<u8> = (0..left.min(PIECE_BYTES).div_ceil(8)).flat_map(|_| next()).collect();
        file.write_all(&piece)?;
        left = left.saturating_sub(piece.len());
    }
    file.sync_all()
}

/// Takes from everybody else the right to look into a data folder and its files, as older versions left it to them. A
/// folder that holds other people's folders too, such as `/tmp`, stays open; our files in it do not.
///
/// # Errors
/// If that is not allowed.
pub fn close_to_others(folder: &Path) -> io::Result<()> {
    let mut is_ours_alone = true;
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let (name, kind) = (entry.file_name(), entry.file_type()?);
        let name = name.to_str().unwrap_or_default();
        if kind.is_dir() {
            is_ours_alone &= OUR_FOLDERS.contains(&name);
            close_folder(name, &entry.path())?;
        } else if kind.is_file() && is_our_file(name) {
            unix::close(&entry.path())?;
        }
    }
    if is_ours_alone { unix::close(folder) } else { Ok(()) }
}

fn close_folder(name: &str, folder: &Path) -> io::Result<()> {
    if !matches!(name, "recordings" | "robot-orders") {
        return Ok(());
    }
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_file() {
            unix::close(&entry.path())?;
        }
    }
    unix::close(folder)
}

fn is_our_file(name: &str) -> bool {
    OURS.iter().any(|ours| name.starts_with(ours)) || OUR_ENDINGS.iter().any(|ours| name.ends_with(ours))
}

#[cfg(unix)]
mod unix {
    use std::fs::{DirBuilder, OpenOptions, Permissions};
    use std::io;
    use std::os::unix::fs::{DirBuilderExt, OpenOptionsExt, PermissionsExt};
    use std::path::Path;

    /// The permissions of the user on a folder and a file.
    const FOLDER_MODE: u32 = 0o700;
    const FILE_MODE: u32 = 0o600;
    /// The permission bits of everybody else.
    const OTHERS: u32 = 0o077;

    pub(super) fn only_ours(builder: &mut DirBuilder) {
        builder.mode(FOLDER_MODE);
    }

    pub(super) fn only_ours_to_read(options: &mut OpenOptions) {
        options.mode(FILE_MODE);
    }

    pub(super) fn close(path: &Path) -> io::Result<()> {
        let mode = std::fs::metadata(path)?.permissions().mode();
        if mode & OTHERS == 0 { Ok(()) } else { std::fs::set_permissions(path, Permissions::from_mode(mode & !OTHERS)) }
    }
}

/// Elsewhere a user's folders are closed to others by the system.
#[cfg(not(unix))]
mod unix {
    use std::fs::{DirBuilder, OpenOptions};
    use std::io;
    use std::path::Path;

    pub(super) fn only_ours(_: &mut DirBuilder) {}

    pub(super) fn only_ours_to_read(_: &mut OpenOptions) {}

    pub(super) fn close(_: &Path) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::{close_to_others, create, has_room, make_folder, put};
    use std::fs::{self, Permissions};
    use std::os::unix::fs::PermissionsExt;
    use std::path::Path;

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).expect("it is there").permissions().mode() & 0o777
    }

    fn opened(path: &Path) {
        fs::set_permissions(path, Permissions::from_mode(0o755)).expect("to open it");
    }

    #[test]
    fn what_is_written_is_for_its_user_alone() {
        let temp = tempfile::tempdir().expect("a folder");
        let data = temp.path().join("a/b");
        put(&data.join("robots.json"), b"[]").expect("to write");
        create(&data.join("backup")).expect("to write");
        assert_eq!(
            [&data, &data.join("robots.json"), &data.join("backup")].map(|path| mode(path)),
            [0o700, 0o600, 0o600]
        );
        fs::write(data.join("backup"), "old").expect("to write");
        opened(&data.join("backup"));
        drop(create(&data.join("backup")).expect("to write"));
        assert_eq!(mode(&data.join("backup")), 0o600, "also in the place of one that others could read");
    }

    #[test]
    fn what_others_could_read_is_closed_to_them() {
        let temp = tempfile::tempdir().expect("a folder");
        let (data, recordings) = (temp.path().join("data"), temp.path().join("data/recordings"));
        make_folder(&recordings).expect("to make it");
        let files = [data.join("rrp.sqlite-wal"), data.join("robots.json"), recordings.join("one.jsonl")];
        for file in &files {
            fs::write(file, "x").expect("to write");
        }
        for path in files.iter().chain([&data, &recordings]) {
            opened(path);
        }
        close_to_others(&data).expect("to close it");
        assert_eq!(
            [&data, &recordings, &files[0], &files[1], &files[2]].map(|path| mode(path)),
            [0o700, 0o700, 0o700, 0o700, 0o700]
        );
    }

    #[test]
    fn a_folder_with_folders_of_others_stays_open() {
        let temp = tempfile::tempdir().expect("a folder");
        fs::create_dir(temp.path().join("somebody")).expect("to make it");
        fs::write(temp.path().join("robots.json"), "x").expect("to write");
        for path in [temp.path(), &temp.path().join("robots.json"), &temp.path().join("somebody")] {
            opened(path);
        }
        close_to_others(temp.path()).expect("to close it");
        assert_eq!(mode(temp.path()), 0o755);
        assert_eq!(mode(&temp.path().join("somebody")), 0o755);
        assert_eq!(mode(&temp.path().join("robots.json")), 0o700);
    }

    #[test]
    fn room_is_tried_and_given_back() {
        let temp = tempfile::tempdir().expect("a folder");
        has_room(temp.path(), 100_000).expect("there is room");
        assert_eq!(fs::read_dir(temp.path()).expect("to look").count(), 0);
        assert!(has_room(&temp.path().join("nowhere"), 1).is_err());
    }
}
