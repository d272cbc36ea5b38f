//! All of a program that is not saved yet, as one change.

use behaviour::{Behaviour, Change, Edit, Record, RecordId, with_otherwise};

/// Returns the change from what is saved to what would be: what waits to be sent, and what is turned or typed.
pub fn unsaved(saved: &Behaviour, now: &Behaviour, draft: Option<(RecordId, Record)>, start: Change) -> Change {
    let all = saved.records.keys().chain(now.records.keys().filter(|id| !saved.records.contains_key(id)));
    let edits = all.filter_map(|id| {
        let (before, after) = (saved.records.get(id), now.records.get(id));
        (before != after).then(|| Edit { id: id.clone(), before: before.cloned(), after: after.cloned() })
    });
    let waits = Change { edits: edits.collect(), ..start.clone() };
    let Some((id, record)) = draft.filter(|(id, _)| now.records.contains_key(id)) else { return waits };
    let drafted = with_otherwise(now, start.put(now, id, record));
    drafted.edits.into_iter().fold(waits, |change, Edit { id, after, .. }| match after {
        Some(record) => change.put(saved, id, record),
        None => change.take(saved, id),
    })
}

#[cfg(test)]
mod tests {
    use super::unsaved;
    use behaviour::{Behaviour, Change, Id, Kind, Note, Record, RecordId};

    fn note(id: &str, text: &str) -> (RecordId, Record) {
        (RecordId::new(Kind::Note, &Id::new(id).unwrap()), Record::Note(Note::new(text.to_owned())))
    }

    fn of(all: &[(&str, &str)]) -> Behaviour {
        Behaviour { records: all.iter().map(|(id, text)| note(id, text)).collect() }
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
        assert_eq!(made(Some(note("b", "3"))), of(&[("a", "2"), ("b", "3"), ("d", "1")]));
        assert_eq!(made(Some(note("a", "3"))), of(&[("a", "3"), ("b", "1"), ("d", "1")]), "the newest counts");
        assert_eq!(made(Some(note("c", "3"))), now, "what was removed is not typed into any more");
    }
}
