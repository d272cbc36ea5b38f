//! The behaviours that are edited under load: made before, put into the bin afterwards.

use behaviour::{Change, Id, Kind, Note, Record, RecordId};
use protocol::request;
use shell::{Client, ClientError};

/// A note of a client.
pub(crate) fn note_of(client: usize) -> RecordId {
    RecordId::new(Kind::Note, &named(&format!("note-{client}")))
}

/// An id that is known to be one.
pub(crate) fn named(text: &str) -> Id {
    #[expect(clippy::expect_used, reason = "only letters, digits and lines")]
    Id::new(text).expect("an id")
}

/// Makes the note of a client after so many edits.
pub(crate) fn text(client: usize, edits: u64) -> Record {
    Record::Note(Note::new(format!("Edit {edits} of client {client}, as long as notes of people are.")))
}

/// Returns the number of edits of a client's note, as the note says.
pub(crate) fn edits(record: &Record) -> Option<u64> {
    let Record::Note(Note { text, .. }) = record else { return None };
    text.strip_prefix("Edit ")?.split(' ').next()?.parse().ok()
}

/// Makes a behaviour for a load.
///
/// # Errors
/// If the server says no, or the link ends.
pub(crate) async fn make(maker: &Client, run: &str, number: usize) -> Result<Id, ClientError> {
    let (behaviour, name) = (named(&format!("load-{run}-{number}")), format!("Load {number}"));
    Ok(maker.ask(request::Create { behaviour, name, template: None }).await?.behaviour)
}

/// The name of one edit: who made it, which one it is, and when it was due, for all who hear of it.
pub(crate) fn op(run: &str, client: usize, edits: u64, due_us: u64) -> Id {
    named(&format!("load-{run}-{client}-{edits}-{due_us}"))
}

/// Returns the time when an edit of this run was due.
pub(crate) fn due_us(run: &str, change: &Change) -> Option<u64> {
    let parts = change.op.as_str().strip_prefix("load-")?.strip_prefix(run)?.strip_prefix('-')?;
    parts.rsplit('-').next()?.parse().ok()
}
