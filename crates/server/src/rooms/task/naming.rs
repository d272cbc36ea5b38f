//! Names of versions: kept by the store, told to everyone in the room.

use super::RoomTask;
use super::saving::Saved;
use crate::rooms::Surroundings;
use crate::rooms::member::AnswerTo;
use crate::rooms::past::VersionNaming;
use crate::support::message::encode;
use crate::support::now_ms;
use crate::support::store_call::{bounded, store_no};
use axum::extract::ws::Utf8Bytes;
use behaviour::{Checkpoint, Checkpoints, Id, Refusal};
use protocol::{Event, Refused};
use std::sync::Arc;
use store::{Store, StoreError};

/// The named versions of a behaviour as the store has them.
pub(super) async fn kept(store: &dyn Store, id: &Id) -> Result<Checkpoints, StoreError> {
    bounded(store.checkpoints(id)).await.map(Checkpoints::of)
}

/// Gives a version a name or takes it away, when so many revisions there are. Another server may have named some, so
/// that the store is asked first.
pub(super) async fn name(
    around: Arc<Surroundings>,
    id: Id,
    newest: u64,
    naming: VersionNaming,
    from: AnswerTo<()>,
) -> Saved {
    let outcome = named(&around, &id, newest, naming).await;
    Saved::Named { outcome, from }
}

async fn named(around: &Surroundings, id: &Id, newest: u64, naming: VersionNaming) -> Result<Checkpoints, Refused> {
    let mut all = kept(&*around.store, id).await.map_err(|error| store_no(&error))?;
    match naming {
        VersionNaming::Name { revision, name, by } => {
            // Said twice, it is done once.
            let is_same = |one: &Checkpoint| one.revision == revision && one.name == name.trim() && one.by == by;
            if !all.all().iter().any(is_same) {
                give(around, id, newest, &mut all, Checkpoint { revision, name, by, at_ms: now_ms() }).await?;
            }
        }
        VersionNaming::Unname(name) => {
            all.remove(&name);
            let mut gone = bounded(around.store.drop_checkpoint(id, &name)).await;
            if gone.as_ref().is_err_and(StoreError::is_open) {
                gone = bounded(around.store.drop_checkpoint(id, &name)).await;
            }
            gone.map_err(|error| away(around, &error))?;
        }
    }
    Ok(all)
}

async fn give(
    around: &Surroundings,
    id: &Id,
    newest: u64,
    all: &mut Checkpoints,
    wanted: Checkpoint,
) -> Result<(), Refused> {
    if !(1..=newest).contains(&wanted.revision) {
        return Err(Refused::NoVersion);
    }
    let made = all.add(newest, wanted).map_err(Refused::Change)?;
    let mut kept = bounded(around.store.keep_checkpoint(id, &made)).await;
    if kept.as_ref().is_err_and(StoreError::is_open) {
        kept = bounded(around.store.keep_checkpoint(id, &made)).await;
    }
    let kept = kept.map_err(|error| away(around, &error))?;
    if kept { Ok(()) } else { Err(Refused::Change(Refusal::NameTaken(made.name))) }
}

fn away(around: &Surroundings, error: &StoreError) -> Refused {
    around.health.failed(error);
    store_no(error)
}

/// What everyone in the room is told.
pub(super) fn text(behaviour: &Id, versions: &Checkpoints) -> Utf8Bytes {
    encode(Event::Versions { behaviour: behaviour.clone(), versions: versions.all().to_vec() })
}

impl RoomTask {
    /// The store answered.
    pub(super) fn named(&mut self, outcome: Result<Checkpoints, Refused>, from: AnswerTo<()>) {
        match outcome {
            Ok(versions) => {
                self.versions = versions;
                self.versions_text.send_replace(text(&self.id, &self.versions));
                from.give(());
            }
            Err(no) => from.no(no),
        }
    }
}
