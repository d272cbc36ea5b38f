//! All of a program that is not saved yet, as one change.

use behaviour::{Behaviour, Change, Edit, Record, RecordId, with_otherwise};

/// A draft that is turned or typed: the record that it is about, and each record as it would be, none where it would be gone.
pub type DraftedEdits = (RecordId, Vec<(RecordId, Option<Record>)>);

/// Returns the change from what is saved to what would be: what waits to be sent, and what is turned or typed.
#[must_use]
pub fn unsaved(saved: &Behaviour, now: &Behaviour, draft: Option<DraftedEdits>, start: Change) -> Change {
    let all = saved.records.keys().chain(now.records.keys().filter(|id| !saved.records.contains_key(id)));
    let edits = all.filter_map(|id| {
        let (before, after) = (saved.records.get(id), now.records.get(id));
        (before != after).then(|| Edit { id: id.clone(), before: before.cloned(), after: after.cloned() })
    });
    let waits = Change { edits: edits.collect(), ..start.clone() };
    let Some((_, records)) = draft.filter(|(about, _)| now.records.contains_key(about)) else { return waits };
    let drafted = records.into_iter().fold(start, |change, (id, record)| match record {
        Some(record) => change.put(now, id, record),
        None => change.take(now, id),
    });
    let drafted = with_otherwise(now, drafted);
    drafted.edits.into_iter().fold(waits, |change, Edit { id, after, .. }| match after {
        Some(record) => change.put(saved, id, record),
        None => change.take(saved, id),
    })
}

#[cfg(test)]
mod tests {
    use super::{DraftedEdits, unsaved};
    use behaviour::{Behaviour, Change, Id, Kind, Note, Record, RecordId};

    fn note(id: &str, text: &str) -> (RecordId, Record) {
        (RecordId::new(Kind::Note, &Id::new(id).unwrap()), Record::Note(Note::new(text.to_owned())))
    }

    fn of(all: &[(&str, &str)]) -> Behaviour {
        Behaviour { records: all.iter().map(|(id, text)| note(id, text)).collect() }
    }

    /// Types about the first of some notes.
    fn typed(all: &[(&str, Option<&str>)]) -> Option<DraftedEdits> {
        let about = note(all[0].0, "").0;
        let record = |(id, text): &(&str, Option<&str>)| (note(id, "").0, text.map(|text| note(id, text).1));
        Some((about, all.iter().map(record).collect()))
    }

    #[test]
    fn what_waits_and_what_is_typed_are_one_change() {
        let (saved, now) = (of(&[("a", "1"), ("b", "1"), ("c", "1")]), of(&[("a", "2"), ("b", "1"), ("d", "1")]));
        let start = Change::of(Id::new("op").unwrap(), "Aiko", "Edit");
        let made = |draft| {
            let mut after = saved.clone();
            after.apply(&unsaved(&saved, &now, draft, start.clone()));
            after
        };
        assert_eq!(made(None), now);
        assert_eq!(made(typed(&[("b", Some("3"))])), of(&[("a", "2"), ("b", "3"), ("d", "1")]));
        assert_eq!(made(typed(&[("a", Some("3"))])), of(&[("a", "3"), ("b", "1"), ("d", "1")]), "the newest counts");
        assert_eq!(made(typed(&[("c", Some("3"))])), now, "what was removed is not typed into any more");
        let new = [("b", Some("3")), ("e", Some("1")), ("d", None)];
        assert_eq!(made(typed(&new)), of(&[("a", "2"), ("b", "3"), ("e", "1")]), "what is new and what would be gone");
    }
}
