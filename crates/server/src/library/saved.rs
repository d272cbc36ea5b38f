//! Saves what every new behaviour needs: a name that is one, and its first change saved.

use super::LibraryService;
use crate::support::store_call::{bounded, reason};
use behaviour::{Behaviour, Committed, Id, Refusal, has_unseen, without_unseen};
use phrase::phrase;
use protocol::Refused;
use store::{Append, StoreError};

pub(crate) fn check_name(name: &str) -> Result<(), Refused> {
    let no = |refusal| Err(Refused::Change(refusal));
    let shown = || without_unseen(name).chars().take(40).collect();
    if name.trim().is_empty() {
        return no(Refusal::Name(shown()));
    }
    if has_unseen(name) {
        return no(Refusal::Unseen(shown()));
    }
    // Room for the number that a taken name gets.
    let most = behaviour::NAME_MAX_CHARS - 10;
    if name.chars().count() > most { no(Refusal::TooLong(phrase!("limited.name", "this name"), most)) } else { Ok(()) }
}

/// Saves a change of a behaviour that nobody has open; once more if the outcome is open, the op id settles it.
pub(crate) async fn append(
    library: &LibraryService,
    id: &Id,
    made: &Committed,
    after: &Behaviour,
) -> Result<(), Refused> {
    let mut answer = bounded(library.store.append(id, made, after)).await;
    if answer.as_ref().is_err_and(StoreError::is_open) {
        answer = bounded(library.store.append(id, made, after)).await;
    }
    match answer {
        Ok(Append::Applied | Append::Duplicate { .. }) => Ok(()),
        Ok(Append::Reused { .. }) => Err(Refused::Change(Refusal::Reused)),
        Ok(Append::Conflict { .. }) => Err(Refused::Change(Refusal::Stale(phrase!("this.program", "this program")))),
        Err(error) => {
            library.health.failed(&error);
            Err(Refused::Change(Refusal::NotSaved(reason(&error))))
        }
    }
}
