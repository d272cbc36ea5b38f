//! Reading the log of a behaviour backwards and forwards, a few changes at a time, and what follows from it.

use crate::rooms::Surroundings;
use crate::support::identity::Sender;
use crate::support::store_call::{bounded, store_no};
use behaviour::{Behaviour, Committed, Id, Room};
use protocol::Refused;
use std::collections::VecDeque;
use std::sync::Arc;
use store::{Damage, StoreError};

/// Changes that are fetched from the store at once.
pub(super) const PAGE_MAX_CHANGES: u64 = 32;

/// The changes after `from` up to `to`, oldest first: all of them, as a log has no gaps.
pub(super) async fn page(around: &Surroundings, id: &Id, from: u64, to: u64) -> Result<Vec<Committed>, Refused> {
    let most = u32::try_from(to.saturating_sub(from)).unwrap_or(u32::MAX);
    let mut page = bounded(around.store.history(id, from, most)).await.map_err(|error| store_no(&error))?;
    page.retain(|made| made.revision <= to);
    if page.iter().map(|made| made.revision).eq(from + 1..=to) {
        return Ok(page);
    }
    Err(store_no(&StoreError::Damaged(Damage::Gap { id: id.clone(), from })))
}

/// The change of one revision.
pub(super) async fn one(around: &Surroundings, id: &Id, revision: u64) -> Result<Committed, Refused> {
    page(around, id, revision.saturating_sub(1), revision).await?.pop().ok_or(Refused::NoVersion)
}

/// The newest changes up to a revision, oldest first: so many at most, and of so many bytes unless one alone is larger.
pub(super) async fn newest(
    around: &Surroundings,
    id: &Id,
    revision: u64,
    most: usize,
    most_bytes: usize,
) -> Result<VecDeque<Committed>, Refused> {
    let (mut newest, mut bytes, mut to) = (VecDeque::new(), 0, revision);
    while to > 0 {
        let from = to.saturating_sub(PAGE_MAX_CHANGES);
        for made in page(around, id, from, to).await?.into_iter().rev() {
            bytes += made.change.bytes();
            if newest.len() >= most || (bytes > most_bytes && !newest.is_empty()) {
                return Ok(newest);
            }
            newest.push_front(made);
        }
        to = from;
    }
    Ok(newest)
}

/// A behaviour as it was after a revision: from now backwards or from nothing forwards, whichever is shorter. Ends early
/// where nobody wants it any more.
pub(super) async fn replay(
    around: &Surroundings,
    id: &Id,
    room: Arc<Room>,
    revision: u64,
    sender: &Sender,
    is_unwanted: impl Fn() -> bool,
) -> Result<Behaviour, Refused> {
    let now = room.revision();
    if !(1..=now).contains(&revision) {
        return Err(Refused::NoVersion);
    }
    let backwards = now - revision <= revision;
    let (mut was, mut at) = (Behaviour::default(), 0);
    if backwards {
        (was, at) = (around.workers.run(sender.clone(), move |_| room.behaviour().clone()).await?, now);
    }
    while at != revision {
        if is_unwanted() {
            return Err(Refused::TooFast);
        }
        let next = if backwards {
            at.saturating_sub(PAGE_MAX_CHANGES).max(revision)
        } else {
            revision.min(at + PAGE_MAX_CHANGES)
        };
        let page = page(around, id, at.min(next), at.max(next)).await?;
        let follow = move |_: &_| {
            if backwards {
                page.iter().rev().for_each(|made| was.take_back(&made.change));
            } else {
                page.iter().for_each(|made| was.apply(&made.change));
            }
            was
        };
        (was, at) = (around.workers.run(sender.clone(), follow).await?, next);
    }
    Ok(was)
}
