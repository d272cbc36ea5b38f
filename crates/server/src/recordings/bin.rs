//! The bin of the recordings, and the names that people give them: small files beside a recording, which itself never changes.

use super::titles::title_of;
use super::{NotRecorded, Recordings, described, files, marks_of, removed};
use crate::support::{atomic_file, lock};
use behaviour::without_unseen;
use protocol::{RECORDING_TITLE_MAX_CHARS, Recording, Refused};
use std::io;
use std::path::{Path, PathBuf};

/// The folder of the bin in that of the recordings.
const BIN: &str = "bin";

impl Recordings {
    /// The recordings in the bin, newest first. Reads the folder: not for the async threads.
    pub(crate) fn binned(&self) -> Vec<Recording> {
        let Some(bin) = self.bin() else { return Vec::new() };
        let mut all: Vec<Recording> = files(&bin).filter_map(|(path, bytes)| described(&path, bytes)).collect();
        all.sort_by(|one, other| other.file.cmp(&one.file));
        all
    }

    /// Puts a recording with its marks and its name into the bin.
    ///
    /// # Errors
    /// If there is no such recording, if it is still being written, or if it cannot be moved.
    pub(crate) fn remove(&self, name: &str) -> Result<(), Refused> {
        let (Some(bin), Some(path)) = (self.bin(), self.find(name)) else { return Err(Refused::NoRecording) };
        if lock(&self.open).contains(name) {
            return Err(NotRecorded::GoesOn.into());
        }
        let _naming = lock(&self.naming);
        let _marking = lock(&self.marking);
        if bin.join(name).exists() {
            return Err(NotRecorded::NameTaken.into());
        }
        let moved = store::disk::make_folder(&bin).and_then(|()| moved(&path, &bin.join(name)));
        self.pasts.forget(name);
        moved.map_err(|error| NotRecorded::NotRemoved(error).into())
    }

    /// Brings a recording back from the bin.
    ///
    /// # Errors
    /// If it is not in the bin, if its name is taken, or if it cannot be moved.
    pub(crate) fn restore(&self, name: &str) -> Result<(), Refused> {
        let _naming = lock(&self.naming);
        let _marking = lock(&self.marking);
        let (Some(folder), Some(binned)) = (self.folder.as_deref(), self.find_binned(name)) else {
            return Err(Refused::NoRecording);
        };
        let path = folder.join(name);
        if path.exists() {
            return Err(NotRecorded::NameTaken.into());
        }
        moved(&binned, &path).map_err(|error| NotRecorded::NotRemoved(error).into())
    }

    /// Removes a recording in the bin for good.
    ///
    /// # Errors
    /// If it is not in the bin, or if it cannot be removed.
    pub(crate) fn remove_for_good(&self, name: &str) -> Result<(), Refused> {
        let _marking = lock(&self.marking);
        let path = self.find_binned(name).ok_or(Refused::NoRecording)?;
        let done = removed(&path).and_then(|()| store::disk::sync_names(path.parent().unwrap_or(Path::new(""))));
        done.map_err(|error| NotRecorded::NotRemoved(error).into())
    }

    /// Gives a recording a name; an empty one takes it away.
    ///
    /// # Errors
    /// If there is no such recording, if the name is too long, or if it cannot be written.
    pub(crate) fn name(&self, file: &str, title: &str) -> Result<(), Refused> {
        let _marking = lock(&self.marking);
        let path = self.find(file).ok_or(Refused::NoRecording)?;
        let title = without_unseen(title).trim().to_owned();
        if title.chars().count() > RECORDING_TITLE_MAX_CHARS {
            return Err(NotRecorded::LongTitle.into());
        }
        let path = title_of(&path);
        let written =
            if title.is_empty() { none_is_fine(std::fs::remove_file(&path)) } else { atomic_file::put(&path, &title) };
        written.map_err(|error| NotRecorded::TitleUnwritten(error).into())
    }

    pub(super) fn bin(&self) -> Option<PathBuf> {
        self.folder.as_deref().map(|folder| folder.join(BIN))
    }

    fn find_binned(&self, name: &str) -> Option<PathBuf> {
        let all = files(&self.bin()?).map(|(path, _)| path).collect::<Vec<_>>();
        all.into_iter().find(|path| path.file_name().is_some_and(|known| known == name))
    }
}

/// Moves a recording first, so that what a power cut leaves behind comes along when it is moved again.
fn moved(from: &Path, to: &Path) -> io::Result<()> {
    std::fs::rename(from, to)?;
    for of in [marks_of, title_of] {
        none_is_fine(std::fs::rename(of(from), of(to)))?;
    }
    [from, to].iter().filter_map(|path| path.parent()).try_for_each(store::disk::sync_names)
}

/// Takes it as done if there was nothing to move or remove.
pub(super) fn none_is_fine(done: io::Result<()>) -> io::Result<()> {
    match done {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}
