//! Scenes of what several people have open at once: edits beside an open editor, what is taken over, what is removed under it,
//! and undo of what somebody changed since.

use crate::scenes::said;
use crate::server::{id, note};
use crate::sketch::{connector, filter, sketch, stream};
use crate::table::{AIKO, BEN, Table};
use behaviour::{Kind, Record, RecordId, Refusal, Settings};
use editor::{Announcement, Editor, Saver, WriteRight};
use phrase::Phrased;
use protocol::Refused;

fn writing(table: &Table, who: usize) -> Option<&WriteRight> {
    table.editor(who).editing.as_ref().map(|now| &now.writing)
}

fn owns(table: &Table, who: usize) -> bool {
    matches!(writing(table, who), Some(WriteRight::Own(_)))
}

/// Somebody opens the editor of a record.
fn opens(table: &mut Table, who: usize, record: &RecordId) -> u32 {
    table.does(who, |page| page.input(|editor| editor.open_editor(record.clone())))
}

#[test]
fn a_quick_edit_of_what_somebody_is_editing_is_refused_by_name() {
    let mut table = Table::sketched();
    opens(&mut table, AIKO, &connector("to-close").record());
    table.gesture(BEN, |editor, op| editor.remove(op, &connector("to-close")));
    table.operates(BEN, "to-close", filter("distance < 9"));
    let by = |answer: &Result<(), Refused>| match answer {
        Err(Refused::Change(Refusal::Locked { by, .. })) => by.clone(),
        other => panic!("{other:?}"),
    };
    assert_eq!(table.pages[BEN].answers.iter().map(by).collect::<Vec<_>>(), ["Aiko", "Aiko"]);
    assert_eq!((table.program(), owns(&table, AIKO)), (&sketch(), true));
    assert!(table.editor(BEN).conflicts.is_empty() && table.editor(BEN).is_saved(), "nothing waits");
}

#[test]
fn who_takes_over_writes_and_what_the_other_wrote_stays() {
    let mut table = Table::laid();
    table.does(BEN, |page| page.begin_typing(0));
    opens(&mut table, AIKO, &note(0));
    assert!(matches!(writing(&table, AIKO), Some(WriteRight::No(reading)) if reading.by.as_deref() == Some("Ben")));
    assert!(owns(&table, BEN), "nothing is taken before it is asked for");
    table.does(AIKO, |page| page.input(Editor::take_over));
    assert!(owns(&table, AIKO));
    let Some(WriteRight::No(reading)) = writing(&table, BEN) else { panic!("{:?}", writing(&table, BEN)) };
    assert_eq!((reading.by.as_deref(), reading.was_own), (Some("Aiko"), true), "what Ben wrote stays to be seen");
    table.types(BEN);
    assert_eq!(table.saved().as_deref(), Some("Aiko wrote 1"), "and is not saved over hers");
}

/// Aiko has the editor of a connector open without a link, and Ben removes it meanwhile; she is back.
fn removed_under_an_editor() -> (Table, RecordId) {
    let mut table = Table::sketched();
    let record = connector("to-close").record();
    table.cut(AIKO);
    opens(&mut table, AIKO, &record);
    table.gesture(BEN, |editor, op| editor.remove(op, &stream("close")));
    table.forget();
    table.connect(AIKO);
    (table, record)
}

#[test]
fn what_is_removed_under_an_open_editor_is_told_by_name_and_saved_once_it_is_back() {
    let (mut table, record) = removed_under_an_editor();
    let ben = || Saver::Other("Ben".to_owned());
    assert_eq!(table.said(AIKO), [Announcement::RemovedWhileTyping(ben())]);
    table.does(AIKO, |page| page.input(|editor| editor.find_remover(record.id.clone())));
    assert_eq!(table.editor(AIKO).removed_by.get(&record.id).map(|by| by.name.as_str()), Some("Ben"));
    assert!(table.editor(AIKO).editing.is_some(), "the editor stays open");
    table.undo(BEN);
    assert!(table.editor(AIKO).shown(&record).is_some());
    table.operates(AIKO, "to-close", filter("distance < 9"));
    assert_eq!(table.body("to-close"), "distance < 9");
    assert_eq!(table.editor(BEN).confirmed(), table.program());
}

#[test]
fn what_is_removed_under_an_open_editor_is_brought_back_from_there() {
    let (mut table, record) = removed_under_an_editor();
    let start = table.does(AIKO, |page| page.input(|editor| editor.change("Bring back")));
    table.does(AIKO, |page| page.input(|editor| editor.bring_back(record, start)));
    assert_eq!(
        (table.sources("close"), table.body("to-close")),
        (vec!["distance".to_owned()], "distance < 20".to_owned())
    );
    assert_eq!(table.sources("tracker"), ["close"], "with what came out of it");
    table.operates(AIKO, "to-close", filter("distance < 9"));
    assert_eq!(table.body("to-close"), "distance < 9", "what was written goes on top");
}

#[test]
fn an_undo_of_what_somebody_changed_since_is_refused_and_offered_again() {
    let mut first = sketch();
    first.records.insert(RecordId::settings(), Record::Settings(Settings::named("Ours")));
    let mut table = Table::with(first);
    let name = |table: &Table| table.program().settings().map(|now| now.name.clone()).unwrap_or_default();
    let renames = |table: &mut Table, who: usize, to: &str| {
        let seen = table.program().settings().cloned().expect("it has a name");
        table.gesture(who, |editor, op| editor.rename_program(op, seen, to));
    };
    table.gesture(AIKO, |editor, op| editor.add_sensor(op, ("HeadTouch", "Hand"), [].into(), None));
    renames(&mut table, AIKO, "Aiko's");
    renames(&mut table, BEN, "Ben's");
    table.reload(AIKO);
    table.connect(AIKO);
    let offers = |table: &Table| [&table.editor(AIKO).undoable, &table.editor(AIKO).redoable].map(|one| said(one));
    let rename = Some("Rename program".to_owned());
    assert_eq!(offers(&table), [rename.clone(), None], "it survives a reload");
    table.forget();
    table.undo(AIKO);
    let no = table.pages[AIKO].refusals.pop().expect("it is refused").phrase().to_string();
    assert!(no.starts_with("Ben changed") && no.ends_with('.'), "{no}");
    assert_eq!((name(&table), offers(&table)), ("Ben's".to_owned(), [rename.clone(), None]));
    table.undo(BEN);
    table.undo(AIKO);
    assert_eq!((name(&table), offers(&table)), ("Ours".to_owned(), [Some("Add Hand".to_owned()), rename.clone()]));
    table.reload(AIKO);
    table.connect(AIKO);
    assert_eq!(offers(&table)[1], rename, "and so does what was taken back");
    table.does(AIKO, |page| page.input(Editor::redo));
    assert_eq!(name(&table), "Aiko's");
}

#[test]
fn what_one_does_the_other_sees_and_undo_leaves_what_the_other_did() {
    let mut first = sketch();
    first.records.insert(RecordId::settings(), Record::Settings(Settings::named("Ours")));
    let mut table = Table::with(first);
    let rename = |table: &mut Table, to: &str| {
        let seen = table.program().settings().cloned().expect("it has a name");
        table.gesture(AIKO, |editor, op| editor.rename_program(op, seen, to));
    };
    rename(&mut table, "Our ball");
    table.sets("ball", |seen| behaviour::Stream { name: "The ball".to_owned(), ..seen });
    let aside = behaviour::Place { x: 96.0, y: 64.0 };
    table.does(AIKO, |page| page.input(|editor| editor.move_to(&[(id("ball"), aside)])));
    let seen = table.editor(BEN).confirmed();
    assert_eq!(seen.settings().map(|now| now.name.as_str()), Some("Our ball"));
    assert_eq!(
        (seen.stream(&id("ball")).map(|one| one.name.as_str()), seen.place(&id("ball"))),
        (Some("The ball"), Some(aside))
    );
    assert_eq!(said(&table.editor(BEN).undoable), None, "Ben has nothing to take back");
    table.gesture(BEN, |editor, op| editor.add_sensor(op, ("HeadTouch", "Head touch"), [].into(), None));
    rename(&mut table, "My ball");
    table.undo(AIKO);
    for who in [AIKO, BEN] {
        let seen = table.editor(who).confirmed();
        assert_eq!(seen.settings().map(|now| now.name.as_str()), Some("Our ball"));
        assert!(seen.streams().any(|(_, one)| one.name == "Head touch"), "Ben's stays");
    }
    table.cut(BEN);
    assert_eq!(table.editor(AIKO).people.len(), 1, "who left is gone");
    assert!(table.program().records.keys().all(|key| key.kind != Kind::Note));
}
