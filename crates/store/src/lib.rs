//! Stores of behaviours: one trait, the embedded SQLite store, Neo4j, a folder of files, a store in memory, and the
//! contract that all keep.
//!
//! The contract in short. A change is saved under the next revision of its behaviour or not at all; it is durable
//! when [`Store::append`] answers; the same op id sent to the same behaviour twice is saved once, and never with other edits. After an error the
//! outcome may be open ([`StoreError::is_open`]): send the same change again, and the op id settles it.
#![warn(missing_docs)]

pub mod backup;
mod checkpoints;
#[cfg(any(test, feature = "contract"))]
pub mod contract;
mod damage;
pub mod disk;
mod error;
pub mod files;
mod filling;
mod folder;
mod folder_lock;
mod insight;
mod json;
mod memory;
#[cfg(feature = "neo4j")]
mod neo4j;
mod open;
mod query;
mod sqlite;
mod tags;
mod usage;
#[cfg(not(feature = "neo4j"))]
mod without_neo4j;

pub use behaviour::LIBRARY;
pub use behaviour::library::{ActionDriver, Contested, Cursor, HelperUse, SearchPlace, Similar, Sort, Tagged};
pub use damage::{BadAddress, Damage};
pub use error::{StoreError, Unkept};
pub use filling::{Filling, FillingSource, check_folder, check_whole, end_in_folder};
pub use folder::FolderStore;
pub use folder_lock::{FolderLock, lock_folder};
pub use memory::MemoryStore;
#[cfg(feature = "neo4j")]
pub use neo4j::{Neo4jStore, open_neo4j, open_neo4j_within, read_thesis};
pub use open::{folder_of, is_same_folder, open_url, open_url_to_fill, open_url_to_work, shown_url, source_of};
pub use query::{Listing, PAGE_MAX_LINES, Query, search_text};
pub use sqlite::{SqliteStore, open};
#[cfg(not(feature = "neo4j"))]
pub use without_neo4j::read_thesis;

use async_trait::async_trait;
use behaviour::{Behaviour, Change, Checkpoint, Committed, Id};

/// A place that keeps behaviours with their whole history.
#[async_trait]
pub trait Store: Send + Sync {
    /// Saves a change under its revision, which must be one more than the last; revision 1 creates the behaviour.
    /// Durable when it answers. Checks in order: op id seen in this behaviour, in the bin, revision.
    ///
    /// `after` is the whole behaviour with the change made, a graph that keeps the rules: every connector's streams
    /// exist. What lists and searches show is taken from it.
    ///
    /// # Errors
    /// [`StoreError::Gone`] for a behaviour in the bin, [`StoreError::Refused`] for values that cannot be kept (such as NaN).
    async fn append(&self, behaviour: &Id, committed: &Committed, after: &Behaviour) -> Result<Append, StoreError>;

    /// Saves changes that follow each other, each with the behaviour after it, together if it can. Answers as
    /// [`Self::append`] would for each, up to the first that is not applied; those after it are not tried, and neither are
    /// those after a fault that came when some were saved.
    ///
    /// # Errors
    /// Those of [`Self::append`], if nothing is known to be saved.
    async fn append_all(&self, behaviour: &Id, changes: &[(Committed, Behaviour)]) -> Result<Vec<Append>, StoreError> {
        let mut answers = Vec::new();
        for (committed, after) in changes {
            match self.append(behaviour, committed, after).await {
                Err(error) if answers.is_empty() => return Err(error),
                Err(_) => break,
                Ok(answer) => answers.push(answer),
            }
            if answers.last() != Some(&Append::Applied) {
                break;
            }
        }
        Ok(answers)
    }

    /// The behaviour as it is now, also from the bin; none if there never was one or it was purged.
    async fn load(&self, behaviour: &Id) -> Result<Option<Loaded>, StoreError>;

    /// A page of the behaviours that a query finds. Never the library.
    async fn list(&self, query: &Query) -> Result<Listing, StoreError>;

    /// At most `most` changes with a revision above `since`, oldest first.
    async fn history(&self, behaviour: &Id, since: u64, most: u32) -> Result<Vec<Committed>, StoreError>;

    /// The revisions of a behaviour that have a name, also in the bin: by revision, then as they were named.
    async fn checkpoints(&self, behaviour: &Id) -> Result<Vec<Checkpoint>, StoreError>;

    /// Keeps a revision with its name; durable when it answers. True also if it was kept before, false if another one has
    /// the name or there is no such revision. It is no change, goes with its behaviour, and what a name may be is not asked.
    async fn keep_checkpoint(&self, behaviour: &Id, checkpoint: &Checkpoint) -> Result<bool, StoreError>;

    /// Lets a name go, if it is there; durable when it answers. The revision stays.
    async fn drop_checkpoint(&self, behaviour: &Id, name: &str) -> Result<(), StoreError>;

    /// Moves a behaviour to the bin. False if it is not there, already in the bin, or the library.
    async fn remove(&self, behaviour: &Id, now_ms: u64, by: &str) -> Result<bool, StoreError>;

    /// Takes a behaviour out of the bin again. False if it is not in the bin.
    async fn restore(&self, behaviour: &Id) -> Result<bool, StoreError>;

    /// Deletes for ever what went to the bin before that time, with its history; says how many behaviours.
    async fn purge(&self, removed_before_ms: u64) -> Result<u32, StoreError>;

    /// Returns the direct users of a helper: connectors of behaviours outside the bin that name it or call it in their
    /// body, and other helpers of the library that call it. In order of behaviour and record.
    async fn users(&self, helper: &str) -> Result<Vec<HelperUse>, StoreError>;

    /// Returns the users of a helper, also through other helpers. Nearest uses first, then in order of behaviour and
    /// record.
    async fn where_used(&self, helper: &str) -> Result<Vec<HelperUse>, StoreError> {
        usage::through_others(self, helper).await
    }

    /// Behaviours outside the bin that drive an action of the robot, by its name in the catalogue, each with the names
    /// of the sensor streams that lead there. In order of behaviour.
    async fn drivers(&self, actuator: &str) -> Result<Vec<ActionDriver>, StoreError>;

    /// Actions that more than one behaviour outside the bin drives, by name, each with those behaviours.
    async fn contested(&self) -> Result<Vec<Contested>, StoreError>;

    /// Other behaviours outside the bin that use the same senses and actions, most shared first, then by id.
    async fn similar(&self, behaviour: &Id, most: u32) -> Result<Vec<Similar>, StoreError>;

    /// The tags of behaviours outside the bin, in order of the tag without its case; those that most have, if they are
    /// more than [`Tagged::SHOWN_MAX`].
    async fn tags(&self) -> Result<Vec<Tagged>, StoreError> {
        tags::of_all(self).await
    }

    /// The next number of a server start. Grows by one at each call and is durable when it answers.
    async fn next_epoch(&self) -> Result<u64, StoreError>;

    /// The number of the last server start is at least this from now on; durable when it answers.
    async fn raise_epoch(&self, least: u64) -> Result<(), StoreError>;

    /// Returns the source from which it is being filled, if that has begun and not ended: then only a part is in it.
    async fn filling(&self) -> Result<Option<FillingSource>, StoreError>;

    /// Marks it as being filled from there, unless it is marked already; gives the mark that it has then, and is durable when
    /// it answers. [`Filling`] is the door to this.
    async fn begin_filling(&self, source: &FillingSource) -> Result<FillingSource, StoreError>;

    /// Takes the mark away, if there is one; durable when it answers.
    async fn end_filling(&self) -> Result<(), StoreError>;

    /// Checks that the store answers; cheap enough to be asked every second.
    async fn reachable(&self) -> Result<(), StoreError> {
        self.healthy().await
    }

    /// Checks that changes can be saved now; the error says why not.
    async fn healthy(&self) -> Result<(), StoreError>;
}

/// The outcome of a change that was handed to the store.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Append {
    /// It is saved.
    Applied,
    /// It was already saved, as this revision.
    Duplicate {
        /// The revision it made then.
        revision: u64,
    },
    /// It is not saved: its op id was saved with other edits, as this revision.
    Reused {
        /// The revision that the other change made.
        revision: u64,
    },
    /// It is not saved: its revision is not the next one. Somebody else wrote; load again.
    Conflict {
        /// The last saved revision; 0 if there is no such behaviour.
        head: u64,
    },
}

impl Append {
    /// The answer to a change whose op id was saved before, with these edits.
    pub(crate) fn again(wanted: &Change, saved: &Change, revision: u64) -> Self {
        if wanted.does_as(saved) { Self::Duplicate { revision } } else { Self::Reused { revision } }
    }
}

/// A behaviour as the store has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The records of the behaviour.
    pub behaviour: Behaviour,
    /// The number of changes ever made.
    pub revision: u64,
    /// The time when it went to the bin, if it is there.
    pub removed_ms: Option<u64>,
}

/// One line in the list of behaviours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ListedBehaviour {
    /// The id of the behaviour.
    pub id: Id,
    /// The name of the behaviour.
    pub name: String,
    /// The number of changes ever made.
    pub revision: u64,
    /// The time when it was last changed (in the bin: removed), in milliseconds since 1970.
    pub changed_ms: u64,
    /// The name of the person who did that.
    pub by: String,
    /// The name of the person who made it.
    pub owner: String,
    /// The number of streams in it.
    pub streams: u32,
    /// The tags of the behaviour, as it has them.
    pub tags: Vec<String>,
}
