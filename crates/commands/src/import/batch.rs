//! The ids that imported copies get: the same ones when the same command is given again after it was cut short, so that what
//! was brought is not brought twice; new ones once all of it is there.

use crate::failure::Failure;
use behaviour::{EDITS_MAX, Id};
use std::collections::BTreeSet;
use std::path::PathBuf;
use store::Store;

/// How often the same files can be imported.
const TURNS_MAX: u64 = 10_000;
/// How often one of them may have been left half done.
const HALVES_MAX: u64 = 100;

/// The files of one command.
pub(super) struct FileBatch {
    /// Of what is in them.
    key: u128,
    /// How often all of them were imported before.
    turn: u64,
}

/// What a store has of a file.
enum There {
    Nothing,
    /// Only the first changes of it.
    Half,
    /// All of it, under this name.
    Whole(String),
}

/// Where a file goes.
pub(super) enum Goes {
    /// It is to be imported under this id.
    Under(Id),
    /// It was brought before, as this id and name.
    IsHere(Id, String),
}

impl FileBatch {
    fn of(files: &[(PathBuf, Vec<u8>)]) -> Self {
        let key = files.iter().fold(sum(FIRST, &[]), |key, (_, bytes)| {
            let length = (bytes.len() as u64).to_be_bytes();
            sum(sum(key, &length), bytes)
        });
        Self { key, turn: 0 }
    }

    /// The first import of these files of which something is missing in the store.
    pub(super) async fn in_store(store: &dyn Store, files: &[(PathBuf, Vec<u8>)]) -> Result<Self, Failure> {
        let mut batch = Self::of(files);
        while batch.turn < TURNS_MAX && batch.is_whole(store, files).await? {
            batch.turn += 1;
        }
        Ok(batch)
    }

    /// The first import of these files of which something is not listed.
    pub(super) fn among(listed: &BTreeSet<Id>, files: &[(PathBuf, Vec<u8>)]) -> Self {
        let mut batch = Self::of(files);
        let is_here = |batch: &Self| (0..files.len()).all(|at| listed.contains(&batch.id(at, 0)));
        while batch.turn < TURNS_MAX && is_here(&batch) {
            batch.turn += 1;
        }
        batch
    }

    async fn is_whole(&self, store: &dyn Store, files: &[(PathBuf, Vec<u8>)]) -> Result<bool, Failure> {
        for (at, (_, bytes)) in files.iter().enumerate() {
            if !matches!(self.place(store, at, bytes).await?, (_, There::Whole(_))) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Where a file goes. What was left half done goes to the bin.
    pub(super) async fn goes(&self, store: &dyn Store, at: usize, bytes: &[u8], now_ms: u64) -> Result<Goes, Failure> {
        loop {
            match self.place(store, at, bytes).await? {
                (id, There::Nothing) => return Ok(Goes::Under(id)),
                (id, There::Whole(name)) => return Ok(Goes::IsHere(id, name)),
                (id, There::Half) if store.remove(&id, now_ms, "rrp import").await? => {}
                (id, There::Half) => return Err(Failure::of(format!("{id} is left half done"))),
            }
        }
    }

    /// The id of a file, beyond those that were left half done and are in the bin.
    async fn place(&self, store: &dyn Store, at: usize, bytes: &[u8]) -> Result<(Id, There), Failure> {
        let mut half = 0;
        loop {
            let id = self.id(at, half);
            let Some(loaded) = store.load(&id).await? else { return Ok((id, There::Nothing)) };
            if loaded.revision >= changes_in(bytes) {
                return Ok((id, There::Whole(loaded.behaviour.name().to_owned())));
            }
            half += 1;
            if loaded.removed_ms.is_none() || half > HALVES_MAX {
                return Ok((id, There::Half));
            }
        }
    }

    /// The id of the file at this place, when it was left half done so often.
    pub(super) fn id(&self, at: usize, half: u64) -> Id {
        let numbers = [self.turn, at as u64, half].map(u64::to_be_bytes).concat();
        Id::from_uuid(uuid::Uuid::from_u128(sum(self.key, &numbers)))
    }
}

/// How many changes make the behaviour of a file.
fn changes_in(bytes: &[u8]) -> u64 {
    let records = store::files::look(bytes).file.and_then(|file| file.records(|_| None).ok());
    records.map_or(1, |records| records.records.len().div_ceil(EDITS_MAX)).try_into().unwrap_or(u64::MAX)
}

const FIRST: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

/// FNV-1a: it tells files apart, no attacks.
fn sum(before: u128, bytes: &[u8]) -> u128 {
    bytes.iter().fold(before, |sum, byte| (sum ^ u128::from(*byte)).wrapping_mul(PRIME))
}

#[cfg(test)]
mod tests {
    use super::{FileBatch, sum};
    use std::collections::BTreeSet;
    use std::path::PathBuf;

    fn files(texts: &[&str]) -> Vec<(PathBuf, Vec<u8>)> {
        texts.iter().map(|text| (PathBuf::from("any"), text.as_bytes().to_vec())).collect()
    }

    #[test]
    fn an_import_that_was_cut_short_goes_on_and_one_that_was_not_begins_anew() {
        let files = files(&["a", "b", "a"]);
        let first = FileBatch::among(&BTreeSet::new(), &files);
        let ids: Vec<_> = (0..3).map(|at| first.id(at, 0)).collect();
        assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), 3, "the same file twice is two programs");
        let cut_short = FileBatch::among(&ids[..2].iter().cloned().collect(), &files);
        assert_eq!(cut_short.id(2, 0), ids[2]);
        let anew = FileBatch::among(&ids.iter().cloned().collect(), &files);
        assert!((0..3).all(|at| !ids.contains(&anew.id(at, 0))));
        assert_ne!(FileBatch::of(&self::files(&["ab", ""])).key, FileBatch::of(&self::files(&["a", "b"])).key);
    }

    #[test]
    fn the_sum_is_fnv_1a() {
        assert_eq!(sum(super::FIRST, b"a"), 0xd228_cb69_6f1a_8caf_7891_2b70_4e4a_8964);
    }
}
