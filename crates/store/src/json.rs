//! Changes and records as the JSON that is kept, and the check that lets in only what reads back the same.

use crate::{StoreError, Unkept};
use behaviour::{Change, Committed};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The latest time that is kept; also the largest whole number of SQLite.
const TIME_MAX_MS: u64 = i64::MAX as u64;

/// Checks that a time is one that is kept.
pub(crate) fn check_time(at_ms: u64) -> Result<(), StoreError> {
    if at_ms > TIME_MAX_MS { Err(StoreError::Refused(Unkept::TooLate)) } else { Ok(()) }
}

/// The JSON of a change that surely reads back as the same change.
pub(crate) fn checked(committed: &Committed) -> Result<String, StoreError> {
    let change = &committed.change;
    check_time(change.at_ms)?;
    if let Some(edit) = change.edits.iter().find(|edit| edit.after.as_ref().is_some_and(|r| r.kind() != edit.id.kind)) {
        return Err(StoreError::Refused(Unkept::OtherKind(edit.id.clone())));
    }
    let json = encode(change).map_err(unwritable)?;
    match decode::<Change>(&json) {
        Ok(read) if read == *change => Ok(json),
        Ok(_) => Err(StoreError::Refused(Unkept::Different)),
        Err(reason) => Err(StoreError::Refused(Unkept::Unreadable(reason.to_string()))),
    }
}

pub(crate) fn encode(what: &impl Serialize) -> serde_json::Result<String> {
    serde_json::to_string(what)
}

pub(crate) fn decode<T: DeserializeOwned>(json: &str) -> serde_json::Result<T> {
    serde_json::from_str(json)
}

/// Refuses a record that cannot be written as JSON, and so cannot be kept.
pub(crate) fn unwritable(error: serde_json::Error) -> StoreError {
    StoreError::Refused(Unkept::Unwritable(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::checked;
    use crate::StoreError;
    use behaviour::{Behaviour, Change, Committed, Id, Kind, Place, Record, RecordId};

    fn moved_to(x: f64, kind: Kind) -> Committed {
        let id = RecordId::new(kind, &Id::new("a").expect("an id"));
        let change = Change::of(Id::new("op").expect("an id"), "Aiko", "Move");
        Committed { revision: 1, change: change.put(&Behaviour::default(), id, Record::Place(Place { x, y: 0.0 })) }
    }

    #[test]
    fn only_what_reads_back_the_same_is_let_in() {
        assert!(checked(&moved_to(0.1, Kind::Place)).is_ok());
        for x in [f64::NAN, f64::INFINITY] {
            assert!(matches!(checked(&moved_to(x, Kind::Place)), Err(StoreError::Refused(_))), "{x}");
        }
        assert!(matches!(checked(&moved_to(1.0, Kind::Note)), Err(StoreError::Refused(_))));
    }
}
