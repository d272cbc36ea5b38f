//! Revocations that the book on the disk does not have yet. They are written over what stands in a file already: a disk that is
//! full takes nothing new, yet what has its blocks can be written over. So nobody who was thrown out is let in again by a
//! restart. Each has a slot of its own, smaller than what a disk writes at once.

use behaviour::Id;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The file in the data folder.
const FILE: &str = "rrp.revoked.reserve";
/// The size of a slot, in bytes: an id and spaces.
const SLOT_BYTES: usize = 64;
/// Slots: more than there are invitations.
const SLOTS: usize = 128;

/// The file, and what is not in the book yet.
#[derive(Debug, Default)]
pub(super) struct Reserve {
    path: Option<PathBuf>,
    /// What stands in the slots, in their order.
    noted: Vec<Id>,
    /// What stands nowhere on the disk.
    unwritten: Vec<Id>,
}

impl Reserve {
    /// That of a data folder, whose blocks are taken now if they are not there yet; without one nothing outlasts the server.
    pub(super) fn within(data: Option<&Path>) -> Self {
        let path = data.map(|data| data.join(FILE));
        let noted = path.as_deref().map(read).unwrap_or_default();
        let reserve = Self { path, noted, unwritten: Vec::new() };
        if let Err(error) = reserve.take_blocks() {
            tracing::warn!(%error, "there is no space kept for revoking invitations on a full disk");
        }
        reserve
    }

    /// What was revoked and may not be in the book.
    pub(super) fn noted(&self) -> &[Id] {
        &self.noted
    }

    /// Whether a restart would undo that this was revoked.
    pub(super) fn is_unwritten(&self, invitation: &Id) -> bool {
        self.unwritten.contains(invitation)
    }

    /// Notes that an invitation is revoked. What cannot be written is remembered, to be tried again.
    ///
    /// # Errors
    /// Why it stands nowhere on the disk.
    pub(super) fn note(&mut self, invitation: &Id) -> io::Result<()> {
        let written = self.write(invitation);
        self.unwritten.retain(|other| other != invitation);
        if written.is_err() {
            self.unwritten.push(invitation.clone());
        }
        written
    }

    /// Tries again what could not be written.
    pub(super) fn again(&mut self) {
        for invitation in self.unwritten.clone() {
            let _told_until_written = self.note(&invitation);
        }
    }

    /// The book on the disk has these: slots that are not needed any more are free again.
    pub(super) fn kept(&mut self, is_kept: impl Fn(&Id) -> bool) {
        self.unwritten.retain(|invitation| !is_kept(invitation));
        if !self.noted.is_empty()
            && self.noted.iter().all(&is_kept)
            && self.write_over(0, &blank(self.noted.len())).is_ok()
        {
            self.noted.clear();
        }
    }

    fn write(&mut self, invitation: &Id) -> io::Result<()> {
        if self.path.is_none() || self.noted.contains(invitation) {
            return Ok(());
        }
        let mut slot = invitation.as_str().as_bytes().to_vec();
        if self.noted.len() >= SLOTS || slot.len() >= SLOT_BYTES {
            return Err(io::ErrorKind::StorageFull.into());
        }
        slot.resize(SLOT_BYTES - 1, b' ');
        slot.push(b'\n');
        self.write_over(self.noted.len(), &slot)?;
        self.noted.push(invitation.clone());
        Ok(())
    }

    fn write_over(&self, slot: usize, bytes: &[u8]) -> io::Result<()> {
        let Some(path) = &self.path else { return Ok(()) };
        self.take_blocks()?;
        let mut file = File::options().write(true).open(path)?;
        file.seek(SeekFrom::Start((slot * SLOT_BYTES) as u64))?;
        file.write_all(bytes)?;
        file.sync_all()
    }

    /// Writes all slots, if the file is not as long as they are.
    fn take_blocks(&self) -> io::Result<()> {
        let Some(path) = &self.path else { return Ok(()) };
        if path.metadata().is_ok_and(|about| about.len() == (SLOTS * SLOT_BYTES) as u64) {
            return Ok(());
        }
        store::disk::put(path, &blank(SLOTS))
    }
}

/// So many slots with nothing in them.
fn blank(slots: usize) -> Vec<u8> {
    let slot = [b" ".repeat(SLOT_BYTES - 1), b"\n".to_vec()].concat();
    slot.repeat(slots)
}

/// What stands in the slots. One that is no id was being written when the power went.
fn read(path: &Path) -> Vec<Id> {
    let mut text = Vec::new();
    let read = File::open(path).and_then(|file| file.take((SLOTS * SLOT_BYTES) as u64).read_to_end(&mut text));
    if read.is_err() {
        return Vec::new();
    }
    let slots = text.chunks(SLOT_BYTES).filter_map(|slot| std::str::from_utf8(slot).ok());
    slots.filter_map(|slot| Id::new(slot.trim()).ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::{FILE, Reserve, SLOT_BYTES, SLOTS};
    use behaviour::Id;

    fn id(name: usize) -> Id {
        Id::new(&format!("i{name}")).unwrap()
    }

    #[test]
    fn what_is_noted_is_written_over_what_was_there_and_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let mut reserve = Reserve::within(Some(folder.path()));
        let length = || folder.path().join(FILE).metadata().unwrap().len();
        assert_eq!(length(), (SLOTS * SLOT_BYTES) as u64);
        for name in [1, 2, 1] {
            reserve.note(&id(name)).unwrap();
        }
        assert_eq!(Reserve::within(Some(folder.path())).noted(), [id(1), id(2)]);
        reserve.kept(|one| *one == id(1));
        assert_eq!(Reserve::within(Some(folder.path())).noted().len(), 2, "not all are in the book");
        reserve.kept(|_| true);
        assert_eq!((Reserve::within(Some(folder.path())).noted().len(), length()), (0, (SLOTS * SLOT_BYTES) as u64));
    }

    #[test]
    fn what_cannot_be_written_is_told_until_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let mut reserve = Reserve::within(Some(folder.path()));
        std::fs::remove_file(folder.path().join(FILE)).unwrap();
        std::fs::create_dir(folder.path().join(FILE)).unwrap();
        assert!(reserve.note(&id(1)).is_err() && reserve.is_unwritten(&id(1)));
        reserve.again();
        assert!(reserve.is_unwritten(&id(1)));
        std::fs::remove_dir(folder.path().join(FILE)).unwrap();
        reserve.again();
        assert!(!reserve.is_unwritten(&id(1)));
        assert_eq!(Reserve::within(Some(folder.path())).noted(), [id(1)]);
    }

    #[test]
    fn more_than_there_are_slots_are_told() {
        let folder = tempfile::tempdir().unwrap();
        let mut reserve = Reserve::within(Some(folder.path()));
        let noted = (0..2 * SLOTS).filter(|name| reserve.note(&id(*name)).is_ok()).count();
        assert_eq!((noted, reserve.unwritten.len()), (SLOTS, SLOTS));
    }

    #[test]
    fn a_slot_that_was_half_written_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let mut reserve = Reserve::within(Some(folder.path()));
        reserve.note(&id(7)).unwrap();
        let path = folder.path().join(FILE);
        let mut text = std::fs::read(&path).unwrap();
        text[SLOT_BYTES..2 * SLOT_BYTES].fill(0xff);
        std::fs::write(&path, text).unwrap();
        assert_eq!(Reserve::within(Some(folder.path())).noted(), [id(7)]);
    }
}
