//! Scenes of two people at one program, and of what each sees of the other.

use crate::page::{Check, Fate, Page};
use crate::server::StoreAnswer;
use crate::table::{AIKO, BEN, Table};
use behaviour::{Pad, Record, RecordId, Tile, TileAction};
use editor::queue::WAITING_MAX;
use editor::{Announcement, Asking, Editor, Purpose, Saver, Saving, WriteRight};
use protocol::Refused;
use protocol::answer::Opened;

fn ben() -> Saver {
    Saver::Other("Ben".to_owned())
}

/// Returns the words of a label.
pub(crate) fn said(label: &Option<phrase::Phrase>) -> Option<String> {
    label.as_ref().map(ToString::to_string)
}

fn text(of: &str) -> Option<String> {
    Some(of.to_owned())
}

fn writing(table: &Table, who: usize) -> Option<&WriteRight> {
    table.editor(who).editing.as_ref().map(|now| &now.writing)
}

/// Aiko wrote without a connection what Ben saved anew meanwhile, and is back.
fn both_wrote() -> Table {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.write(0));
    table.does(BEN, |page| page.write(0));
    table.connect(AIKO);
    table
}

#[test]
fn an_edit_is_shown_to_nobody_before_it_is_saved_and_to_both_then() {
    let mut table = Table::laid();
    table.pages[AIKO].write(0).unwrap();
    assert_eq!([table.shown(AIKO), table.shown(BEN)], [text("Aiko wrote 1"), text("Aiko wrote 1")]);
    assert_eq!(*table.editor(AIKO).saving, Saving::Saving);
    table.settle();
    assert_eq!([table.shown(AIKO), table.shown(BEN)], [text("Aiko wrote 2"), text("Aiko wrote 2")]);
    assert_eq!(*table.editor(AIKO).saving, Saving::Saved);
}

#[test]
fn what_waits_is_shown_and_counted_and_all_of_it_goes() {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.input(|editor| editor.listen(2_000.0)));
    table.does(AIKO, |page| page.write(0));
    table.does(AIKO, |page| page.write(0));
    assert_eq!((table.shown(AIKO), table.shown(BEN)), (text("Aiko wrote 3"), text("Aiko wrote 1")));
    assert_eq!(*table.editor(AIKO).saving, Saving::Offline(2));
    assert_eq!((table.editor(AIKO).waits.len(), *table.editor(AIKO).unheard), (1, Some(2)));
    table.connect(AIKO);
    assert_eq!((table.saved(), *table.editor(AIKO).unheard), (text("Aiko wrote 3"), None));
    assert_eq!(table.said(AIKO), [Announcement::Connected(2)]);
    assert!(table.editor(AIKO).waits.is_empty());
}

#[test]
fn what_waited_is_sent_after_a_reload_too() {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.write(0));
    table.reload(AIKO);
    table.connect(AIKO);
    assert_eq!((table.saved(), table.server.log.len()), (text("Aiko wrote 2"), 2));
}

#[test]
fn what_the_store_cannot_keep_waits_and_goes_when_it_can() {
    let mut table = Table::laid();
    table.server.set_away(true);
    table.settle();
    table.does(AIKO, |page| page.write(0));
    assert_eq!(*table.editor(AIKO).saving, Saving::Away(1, Some("The disk is full.".into())));
    assert_eq!((table.shown(AIKO), table.saved()), (text("Aiko wrote 2"), text("Aiko wrote 1")));
    table.server.set_away(false);
    table.settle();
    assert_eq!((table.saved(), &*table.editor(AIKO).saving), (text("Aiko wrote 2"), &Saving::Saved));
}

#[test]
fn what_is_under_way_when_the_store_goes_and_comes_is_not_sent_twice() {
    let mut table = Table::laid();
    table.pages[AIKO].write(0).unwrap();
    table.send();
    table.server.set_away(true);
    table.server.set_away(false);
    table.hear();
    assert_eq!(table.asked(AIKO), 0, "it is not answered yet");
    table.server.saved(StoreAnswer::Failed);
    table.settle();
    assert_eq!((table.saved(), table.server.log.len()), (text("Aiko wrote 1"), 1));
    assert!(table.pages[AIKO].ledger.values().any(|entry| entry.fate == Fate::Refused));
}

#[test]
fn what_is_under_way_is_not_sent_twice_as_another_change_is_heard_as_saved_and_then_as_not() {
    let mut table = Table::laid();
    (0..2).for_each(|number| table.pages[AIKO].write(number).unwrap());
    table.send();
    table.server.saved(StoreAnswer::SavedUnheard);
    table.hear();
    table.send();
    for (_, wake) in std::mem::take(&mut table.pages[AIKO].timers) {
        table.pages[AIKO].input(|editor| editor.wake(wake)).unwrap();
    }
    assert_eq!(table.asked(AIKO), 0, "it is not answered yet");
    table.settle();
    assert_eq!((table.saved(), table.server.log.len()), (text("Aiko wrote 2"), 3));
}

#[test]
fn an_undo_that_came_too_fast_is_sent_again_in_its_order() {
    let mut table = Table::laid();
    table.does(AIKO, |page| page.write(0));
    table.does(AIKO, |page| page.write(0));
    table.too_fast = 2;
    table.does(AIKO, |page| page.step(false));
    table.pass(400);
    assert_eq!((table.too_fast, table.saved()), (0, text("Aiko wrote 3")), "it was refused twice");
    table.pass(400);
    assert_eq!(table.saved(), text("Aiko wrote 2"));
    table.does(AIKO, |page| page.step(false));
    assert_eq!((table.saved(), table.said(AIKO)), (text("Aiko wrote 1"), Vec::new()));
}

#[test]
fn one_takes_back_only_ones_own_and_does_it_again() {
    let mut table = Table::laid();
    table.does(BEN, |page| page.write(1));
    assert_eq!(*table.editor(AIKO).undoable, Some("Edit Aiko wrote 1".into()));
    assert_eq!(*table.editor(BEN).undoable, Some("Edit Ben wrote 1".into()));
    table.does(AIKO, |page| page.step(false));
    assert_eq!((table.saved(), table.editor(AIKO).undoable.as_ref()), (None, None));
    assert_eq!(*table.editor(AIKO).redoable, Some("Edit Aiko wrote 1".into()));
    table.does(AIKO, |page| page.step(true));
    assert_eq!((table.saved(), table.editor(AIKO).redoable.as_ref()), (text("Aiko wrote 1"), None));
}

#[test]
fn what_was_not_sent_is_only_withdrawn_and_put_again() {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.write(0));
    table.does(AIKO, |page| page.step(false));
    assert_eq!((table.shown(AIKO), table.editor(AIKO).queue().len()), (text("Aiko wrote 1"), 0));
    table.does(AIKO, |page| page.step(true));
    assert_eq!(table.shown(AIKO), text("Aiko wrote 2"));
    table.connect(AIKO);
    assert_eq!((table.saved(), table.server.log.len()), (text("Aiko wrote 2"), 2));
}

#[test]
fn undo_is_found_on_older_pages_of_the_history_after_the_link_broke_while_it_was_read() {
    let mut table = Table::laid();
    (0..20).for_each(|_| table.does(BEN, |page| page.write(1)));
    table.reload(AIKO);
    table.connect(AIKO);
    assert_eq!(*table.editor(AIKO).undoable, Some("Edit Aiko wrote 1".into()));
    table.reload(AIKO);
    // The first page of the history comes, and the link breaks before the next one.
    table.connect_and_hear(AIKO, 2);
    assert_eq!(table.editor(AIKO).undoable.as_ref(), None, "it is not read that far");
    table.cut(AIKO);
    table.connect(AIKO);
    assert_eq!(*table.editor(AIKO).undoable, Some("Edit Aiko wrote 1".into()));
}

#[test]
fn the_second_to_save_is_shown_both_and_keeps_theirs_on_top() {
    let mut table = both_wrote();
    let conflict = table.editor(AIKO).conflicts[0].clone();
    assert_eq!((table.saved(), table.shown(AIKO)), (text("Ben wrote 1"), text("Ben wrote 1")));
    assert!(conflict.offline && conflict.waits_unseen());
    assert_eq!(conflict.last_of_theirs().map(|change| change.author.as_str()), Some("Ben"));
    table.does(AIKO, |page| page.decide(true));
    assert_eq!((table.saved(), table.shown(BEN)), (text("Aiko wrote 2"), text("Aiko wrote 2")));
    assert!(table.editor(AIKO).conflicts.is_empty());
}

#[test]
fn the_second_to_save_may_leave_it_to_the_first() {
    let mut table = both_wrote();
    table.does(AIKO, |page| page.decide(false));
    assert_eq!((table.saved(), table.editor(AIKO).conflicts.len()), (text("Ben wrote 1"), 0));
}

#[test]
fn what_waits_for_a_decision_is_there_after_a_reload() {
    let mut table = both_wrote();
    table.reload(AIKO);
    table.connect(AIKO);
    assert_eq!(table.editor(AIKO).conflicts.len(), 1);
    table.does(AIKO, |page| page.decide(true));
    assert_eq!(table.saved(), text("Aiko wrote 2"));
}

#[test]
fn what_is_refused_is_there_if_the_page_is_loaded_again_while_it_is_found_out_who_was_first() {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.write(0));
    table.does(BEN, |page| page.write(0));
    table.connect_and_hear(AIKO, 2);
    assert_eq!((table.editor(AIKO).queue().len(), table.editor(AIKO).conflicts.len()), (0, 0), "the log is read");
    table.reload(AIKO);
    table.connect(AIKO);
    let conflict = table.editor(AIKO).conflicts[0].clone();
    assert_eq!(conflict.last_of_theirs().map(|change| change.author.as_str()), Some("Ben"));
    table.does(AIKO, |page| page.decide(true));
    assert_eq!((table.saved(), table.editor(AIKO).conflicts.len()), (text("Aiko wrote 2"), 0));
}

#[test]
fn mine_that_is_refused_on_top_is_shown_beside_the_newest_after_such_a_reload() {
    let mut table = both_wrote();
    table.pages[AIKO].decide(true).unwrap();
    let on_top = std::mem::take(&mut table.pages[AIKO].link.outbox);
    table.does(BEN, |page| page.write(0));
    table.pages[AIKO].link.outbox = on_top;
    table.send();
    table.hear();
    assert!(table.editor(AIKO).conflicts[0].is_under_way() && table.editor(AIKO).is_saved(), "the log is read");
    table.reload(AIKO);
    table.connect(AIKO);
    let conflict = table.editor(AIKO).conflicts[0].clone();
    assert_eq!(conflict.last_of_theirs().map(|change| change.label.to_string()), text("Edit Ben wrote 2"));
    assert!(conflict.again && !conflict.is_under_way());
    table.does(AIKO, |page| page.decide(true));
    assert_eq!((table.saved(), table.editor(AIKO).conflicts.len()), (text("Aiko wrote 2"), 0));
}

/// Aiko wrote twice without a connection what Ben saved anew meanwhile, beside so much that the log has several pages.
fn wrote_twice() -> Table {
    let mut table = Table::laid();
    table.cut(AIKO);
    (0..2).for_each(|_| table.does(AIKO, |page| page.write(0)));
    table.does(BEN, |page| page.write(0));
    (0..14).for_each(|_| table.does(BEN, |page| page.write(1)));
    table
}

#[test]
fn the_later_of_two_refused_changes_stays_the_later_one_if_the_link_breaks_while_the_log_is_read() {
    let mut table = wrote_twice();
    table.connect_and_hear(AIKO, 3);
    table.send();
    // Of what is on its way only one page of the log comes yet.
    table.server.said.truncate(1);
    table.hear();
    table.cut(AIKO);
    assert_eq!(table.pages[AIKO].kept_texts(), ["Aiko wrote 3".to_owned()].into());
    table.connect(AIKO);
    table.does(AIKO, |page| page.decide(true));
    assert_eq!((table.saved(), table.editor(AIKO).conflicts.len()), (text("Aiko wrote 3"), 0));
}

#[test]
fn a_change_that_a_lock_keeps_out_stays_behind_an_earlier_one_of_which_the_log_is_read() {
    let mut table = wrote_twice();
    table.connect_and_hear(AIKO, 2);
    let later = std::mem::take(&mut table.pages[AIKO].link.outbox);
    table.does(BEN, |page| page.begin_typing(0));
    table.pages[AIKO].link.outbox = later;
    table.settle();
    let kept: Vec<bool> = table.editor(AIKO).conflicts.iter().map(|kept| kept.locked).collect();
    assert_eq!(kept, [false, true], "one is to be decided, and the other waits");
    assert_eq!(table.pages[AIKO].kept_texts(), ["Aiko wrote 2".to_owned(), "Aiko wrote 3".to_owned()].into());
}

#[test]
fn what_was_removed_under_a_change_comes_back_with_it() {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.write(0));
    table.does(BEN, |page| page.remove(0));
    table.connect(AIKO);
    let conflict = table.editor(AIKO).conflicts[0].clone();
    assert!(conflict.is_removed(table.editor(AIKO).confirmed()) && table.saved().is_none());
    table.does(AIKO, |page| page.decide(true));
    assert_eq!(table.saved(), text("Aiko wrote 2"));
}

#[test]
fn mine_that_is_refused_on_top_after_a_reload_waits_for_another_decision() {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.write(0));
    table.does(BEN, |page| page.remove(0));
    table.connect(AIKO);
    table.cut(AIKO);
    table.does(AIKO, |page| page.decide(true));
    table.does(BEN, |page| page.write(0));
    table.reload(AIKO);
    assert!(table.editor(AIKO).conflicts[0].is_under_way());
    table.connect(AIKO);
    assert!(!table.editor(AIKO).conflicts[0].is_under_way());
    table.does(AIKO, |page| page.decide(true));
    assert_eq!((table.saved(), table.editor(AIKO).conflicts.len()), (text("Aiko wrote 2"), 0));
}

#[test]
fn who_is_editing_it_keeps_mine_from_going_on_top() {
    let mut table = both_wrote();
    table.does(BEN, |page| page.begin_typing(0));
    table.does(AIKO, |page| page.decide(true));
    assert_eq!((table.saved(), table.editor(AIKO).conflicts.len()), (text("Ben wrote 1"), 1));
    table.does(BEN, |page| page.end_typing());
    table.does(AIKO, |page| page.decide(true));
    assert_eq!(table.saved(), text("Aiko wrote 2"));
}

#[test]
fn what_was_changed_offline_waits_for_who_is_editing_it() {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.write(0));
    table.does(BEN, |page| page.begin_typing(0));
    table.connect(AIKO);
    assert_eq!(table.said(AIKO), [Announcement::WaitsUntilFree("Ben".to_owned())]);
    assert_eq!(table.saved(), text("Aiko wrote 1"));
    table.does(BEN, |page| page.end_typing());
    assert_eq!((table.saved(), table.editor(AIKO).conflicts.len()), (text("Aiko wrote 2"), 0));
}

#[test]
fn what_is_kept_stays_while_the_queue_is_full_and_goes_after_it() {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.write(0));
    table.does(BEN, |page| page.begin_typing(0));
    table.connect(AIKO);
    assert_eq!(table.editor(AIKO).conflicts.len(), 1, "Ben is editing it");
    table.cut(AIKO);
    table.does(BEN, |page| page.end_typing());
    for _ in 0..WAITING_MAX {
        table.does(AIKO, |page| page.write(1));
    }
    table.connect_and_hear(AIKO, 2);
    let waiting = table.editor(AIKO).queue().len();
    assert!(waiting > WAITING_MAX - 3, "hardly any of {waiting} is saved yet");
    assert_eq!(table.editor(AIKO).conflicts.len(), 1, "it is kept");
    table.settle();
    table.pass(2_000);
    table.settle();
    assert_eq!((table.saved(), table.editor(AIKO).conflicts.len()), (text("Aiko wrote 2"), 0));
}

#[test]
fn what_waits_for_who_is_editing_it_is_compared_with_what_they_saved() {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.write(0));
    table.does(BEN, |page| page.begin_typing(0));
    table.connect(AIKO);
    table.types(BEN);
    table.does(BEN, |page| page.end_typing());
    assert_eq!(table.saved(), text("Ben wrote 1"));
    assert!(table.editor(AIKO).conflicts[0].waits_unseen(), "it is shown beside theirs");
    table.does(AIKO, |page| page.decide(true));
    assert_eq!(table.saved(), text("Aiko wrote 2"));
}

#[test]
fn what_waits_for_a_colleague_is_saved_when_a_new_server_has_no_locks() {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.write(0));
    table.does(BEN, |page| page.begin_typing(0));
    table.connect(AIKO);
    assert_eq!(table.saved(), text("Aiko wrote 1"), "Ben is editing it");
    table.restart();
    assert_eq!((table.saved(), table.editor(AIKO).conflicts.len()), (text("Aiko wrote 2"), 0));
}

/// A change that Aiko made without a connection waits behind another one, after Ben was editing what it touches.
fn waits_behind_another() -> Table {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.write(0));
    table.does(BEN, |page| page.begin_typing(0));
    table.connect(AIKO);
    table.cut(AIKO);
    table.does(BEN, |page| page.end_typing());
    table.does(AIKO, |page| page.write(1));
    // It is proposed again behind what waits, which is under way.
    table.connect_and_hear(AIKO, 1);
    assert!(table.editor(AIKO).conflicts[0].is_under_way() && table.editor(AIKO).queue().len() == 2);
    table
}

#[test]
fn what_waits_for_who_is_editing_it_can_be_taken_back_before_it_is_sent() {
    let mut table = waits_behind_another();
    table.pages[AIKO].step(false).unwrap();
    assert_eq!((table.editor(AIKO).conflicts.len(), table.editor(AIKO).queue().len()), (0, 1));
    table.settle();
    assert_eq!((table.saved(), table.server.log.len()), (text("Aiko wrote 1"), 2));
}

#[test]
fn what_was_made_offline_waits_for_who_is_editing_it_after_undo_and_redo_too() {
    let mut table = waits_behind_another();
    table.pages[AIKO].step(false).unwrap();
    table.settle();
    table.does(BEN, |page| page.begin_typing(0));
    table.does(AIKO, |page| page.step(true));
    let kept: Vec<bool> = table.editor(AIKO).conflicts.iter().map(|kept| kept.locked).collect();
    assert_eq!((kept, table.saved()), (vec![true], text("Aiko wrote 1")));
    table.does(BEN, |page| page.end_typing());
    assert_eq!((table.saved(), table.editor(AIKO).conflicts.len()), (text("Aiko wrote 2"), 0));
}

#[test]
fn what_one_types_into_nobody_else_changes() {
    let mut table = Table::laid();
    table.does(AIKO, |page| page.begin_typing(0));
    assert!(matches!(writing(&table, AIKO), Some(WriteRight::Own(_))));
    table.does(BEN, |page| page.write(0));
    assert_eq!(table.saved(), text("Aiko wrote 1"));
    assert!(table.pages[BEN].ledger.values().all(|entry| entry.fate == Fate::Refused));
    table.types(AIKO);
    assert_eq!(table.saved(), text("Aiko wrote 2"));
}

#[test]
fn what_one_edits_others_read_until_it_is_handed_over() {
    let mut table = Table::laid();
    table.does(AIKO, |page| page.begin_typing(0));
    table.does(BEN, |page| page.input(|editor| editor.open_editor(crate::server::note(0))));
    let Some(WriteRight::No(reading)) = writing(&table, BEN) else { panic!("Aiko is editing it") };
    assert_eq!((reading.by.as_deref(), reading.was_own), (Some("Aiko"), false));
    table.does(BEN, |page| page.input(Editor::ask_for));
    let Some(WriteRight::No(reading)) = writing(&table, BEN) else { panic!("Aiko is editing it") };
    assert!(matches!(reading.asking, Asking::Waits { .. }));
    let Some(WriteRight::Own(own)) = writing(&table, AIKO) else { panic!("it is hers") };
    assert_eq!(own.asker.as_deref(), Some("Ben"));
    table.does(AIKO, |page| page.input(|editor| editor.hand_over(true)));
    assert!(matches!(writing(&table, BEN), Some(WriteRight::Own(_))));
    let Some(WriteRight::No(reading)) = writing(&table, AIKO) else { panic!("it is Ben's") };
    assert_eq!((reading.by.as_deref(), reading.was_own), (Some("Ben"), true));
}

#[test]
fn who_keeps_it_is_asked_again_later_and_who_closes_it_frees_it() {
    let mut table = Table::laid();
    table.does(AIKO, |page| page.begin_typing(0));
    table.does(BEN, |page| page.input(|editor| editor.open_editor(crate::server::note(0))));
    table.does(BEN, |page| page.input(Editor::ask_for));
    table.does(AIKO, |page| page.input(|editor| editor.hand_over(false)));
    let Some(WriteRight::No(reading)) = writing(&table, BEN) else { panic!("Aiko keeps it") };
    assert!(matches!(reading.asking, Asking::Waits { .. } | Asking::Kept { .. }), "{reading:?}");
    table.does(AIKO, |page| page.end_typing());
    table.does(BEN, |page| page.input(Editor::take_lock));
    assert!(matches!(writing(&table, BEN), Some(WriteRight::Own(_))));
}

#[test]
fn a_lock_is_kept_over_a_short_cut_of_the_link() {
    let mut table = Table::laid();
    table.does(AIKO, |page| page.begin_typing(0));
    table.cut(AIKO);
    assert_eq!(writing(&table, AIKO), Some(&WriteRight::Free));
    table.connect(AIKO);
    let Some(WriteRight::Own(own)) = writing(&table, AIKO) else { panic!("it is hers again") };
    assert!(table.server.holds(AIKO, own.token));
}

/// Aiko types while her link is cut and the server forgets her lock; meanwhile Ben does something to the same note.
fn typed_without_a_lock(ben: impl FnOnce(&mut Page) -> Check) -> Table {
    let mut table = Table::laid();
    table.does(AIKO, |page| page.begin_typing(0));
    table.cut(AIKO);
    table.server.restart(true);
    assert_eq!(table.pages[BEN].lost(), Ok(()));
    table.connect(BEN);
    table.does(BEN, ben);
    table.forget();
    table.connect(AIKO);
    table
}

#[test]
fn who_types_without_a_lock_is_told_who_was_first_and_keeps_what_they_typed() {
    let mut table = typed_without_a_lock(|page| page.write(0));
    assert_eq!(table.said(AIKO), [Announcement::ChangedWhileTyping(ben())]);
    table.types(AIKO);
    assert_eq!(table.saved(), text("Ben wrote 1"), "nothing is overwritten unseen");
    assert!(table.pages[AIKO].kept_texts().contains("Aiko wrote 2"));
}

#[test]
fn who_removed_what_is_typed_into_is_named() {
    let mut table = typed_without_a_lock(|page| page.remove(0));
    assert_eq!(table.said(AIKO), [Announcement::RemovedWhileTyping(ben())]);
    assert_eq!(table.editor(AIKO).removed_by.get(&crate::server::note(0).id), None, "it was not heard here");
    table.does(AIKO, |page| page.input(|editor| editor.find_remover(crate::server::note(0).id)));
    let remover = table.editor(AIKO).removed_by.get(&crate::server::note(0).id).cloned();
    assert_eq!(remover.map(|remover| remover.name).as_deref(), Some("Ben"));
}

#[test]
fn what_is_typed_just_before_the_lock_is_given_goes_with_it_and_ends_it() {
    let mut table = Table::laid();
    let there = table.server.room.behaviour().clone();
    let page = &mut table.pages[AIKO];
    page.begin_typing(0).unwrap();
    page.type_on(&there).unwrap();
    page.end_typing().unwrap();
    let asked: Vec<_> = page.link.outbox.iter().map(|(_, request)| std::mem::discriminant(request)).collect();
    assert_eq!(asked.len(), 1, "the change waits for the lock");
    table.settle();
    assert_eq!((table.saved(), table.editor(AIKO).editing.is_none()), (text("Aiko wrote 2"), true));
    assert!(table.server.locks.held().next().is_none(), "it is given back");
}

#[test]
fn without_a_role_to_edit_nothing_is_sent() {
    let mut table = Table::laid();
    let usual = |_: &behaviour::Behaviour| behaviour::Pad::default();
    let mut editor = Editor::new(|| crate::server::id("x"), |_, _, _, _| None, usual, crate::page::SIZES);
    let no = Refused::Role(protocol::Role::Editor);
    let me = editor::Me { client: None, name: "Eve".to_owned(), refused: Some(no.clone()) };
    editor.at(editor::Now::default(), me).begin_with(Some(table.server.behaviour.clone()));
    let (behaviour, records) = (table.server.behaviour.clone(), Box::new(table.server.room.behaviour().clone()));
    let (problems, people) = (Vec::new(), Vec::new());
    let opened = Opened { behaviour, revision: 1, records, more: false, problems, fingerprint: 0, people };
    let purpose = Purpose::Open { behaviour: opened.behaviour.clone(), says: true };
    editor.hear_answer(purpose, Ok(opened.into()));
    assert!(editor.open.is_some());
    editor.take_effects();
    let change = editor.change("Edit").take(editor.confirmed(), crate::server::note(0));
    editor.propose(change.clone());
    assert_eq!(editor.take_effects(), [editor::Effect::Answered(change.op, Err(no))]);
    assert!(editor.begin_typing(&crate::server::note(0)).is_none() && editor.is_saved());
    table.settle();
}

/// The words of the tiles with their keys, as this person sees them.
fn tiles(table: &Table, who: usize) -> String {
    let behaviour = table.editor(who).behaviour();
    let pad = behaviour.pad().cloned().unwrap_or_default();
    pad.tiles.iter().map(|(key, tile)| format!("{key} {}", tile.label)).collect::<Vec<_>>().join(" ")
}

/// Somebody puts a tile with this word at this key.
fn puts_tile(table: &mut Table, who: usize, key: u8, word: &str) {
    let does = TileAction::Word { word: word.to_owned(), span: false };
    let tile = Tile { label: word.to_owned(), does, asks: false };
    let put = |editor: &mut Editor| {
        let behaviour = editor.behaviour();
        let pad = behaviour.pad().cloned().unwrap_or_else(Pad::default).with(key, Some(tile));
        let change = editor.change("Edit tiles").put(&behaviour, RecordId::pad(), Record::Pad(pad));
        editor.propose(change);
    };
    assert!(table.pages[who].input(put).is_ok(), "the page takes it");
}

#[test]
fn two_people_who_choose_other_tiles_at_once_lose_nothing_and_decide_nothing() {
    let mut table = Table::laid();
    puts_tile(&mut table, AIKO, 1, "laughs");
    puts_tile(&mut table, BEN, 2, "hides");
    table.settle();
    assert_eq!(
        [AIKO, BEN].map(|who| tiles(&table, who)),
        ["1 laughs 2 hides", "1 laughs 2 hides"],
        "both are the first"
    );
    table.cut(AIKO);
    puts_tile(&mut table, AIKO, 1, "waves");
    puts_tile(&mut table, AIKO, 3, "runs");
    puts_tile(&mut table, BEN, 2, "looks");
    table.settle();
    table.connect(AIKO);
    assert_eq!([AIKO, BEN].map(|who| tiles(&table, who)), ["1 waves 2 looks 3 runs", "1 waves 2 looks 3 runs"]);
    assert!([AIKO, BEN].iter().all(|who| table.editor(*who).conflicts.is_empty()));
}

#[test]
fn two_people_who_change_the_same_tile_at_once_see_both_and_the_later_one_decides() {
    let mut table = Table::laid();
    puts_tile(&mut table, BEN, 1, "laughs");
    puts_tile(&mut table, BEN, 2, "hides");
    table.settle();
    table.cut(AIKO);
    puts_tile(&mut table, AIKO, 1, "waves");
    puts_tile(&mut table, BEN, 1, "smiles");
    puts_tile(&mut table, BEN, 2, "looks");
    table.settle();
    table.connect(AIKO);
    assert_eq!(tiles(&table, AIKO), "1 smiles 2 looks");
    let kept = table.editor(AIKO).conflicts[0].mine.op.clone();
    table.does(AIKO, |page| page.input(|editor| editor.keep_mine(&kept, crate::server::id("top"))));
    assert_eq!([AIKO, BEN].map(|who| tiles(&table, who)), ["1 waves 2 looks", "1 waves 2 looks"]);
    assert!(table.editor(AIKO).conflicts.is_empty());
}

#[test]
fn without_a_connection_undo_takes_back_what_waits_and_asks_for_the_rest_later() {
    let mut table = Table::laid();
    table.cut(AIKO);
    table.does(AIKO, |page| page.write(0));
    let (undo, redo) = (false, true);
    // Each step: the text that it shows, the number of changes that wait then, and what redo would do.
    let steps = [
        (undo, text("Aiko wrote 1"), 0, Some("Edit Aiko wrote 2")),
        (undo, None, 1, Some("Edit Aiko wrote 1")),
        (redo, text("Aiko wrote 1"), 0, Some("Edit Aiko wrote 2")),
        (redo, text("Aiko wrote 2"), 1, None),
        (undo, text("Aiko wrote 1"), 0, Some("Edit Aiko wrote 2")),
        (undo, None, 1, Some("Edit Aiko wrote 1")),
    ];
    for (again, shown, waits, next) in steps {
        table.does(AIKO, |page| page.step(again));
        let editor = table.editor(AIKO);
        assert_eq!(
            (table.shown(AIKO), editor.queue().len(), said(&editor.redoable)),
            (shown, waits, next.map(str::to_owned))
        );
    }
    assert_eq!((said(&table.editor(AIKO).undoable), table.shown(BEN)), (None, text("Aiko wrote 1")));
    table.connect(AIKO);
    assert_eq!((table.saved(), table.shown(BEN)), (None, None));
    for next in ["Aiko wrote 1", "Aiko wrote 2"] {
        assert_eq!(said(&table.editor(AIKO).redoable), Some(format!("Edit {next}")));
        table.does(AIKO, |page| page.step(redo));
        assert_eq!((table.saved(), table.shown(BEN)), (text(next), text(next)));
    }
}

/// Somebody puts the tiles of two keys in each other's place.
fn swaps_tiles(table: &mut Table, who: usize, one: u8, other: u8) {
    let swap = |editor: &mut Editor| {
        let behaviour = editor.behaviour();
        let pad = behaviour.pad().cloned().unwrap_or_default().swapped(one, other);
        let change = editor.change("Edit tiles").put(&behaviour, RecordId::pad(), Record::Pad(pad));
        editor.propose(change);
    };
    assert!(table.pages[who].input(swap).is_ok(), "the page takes it");
}

#[test]
fn a_tile_that_is_moved_while_somebody_else_writes_it_anew_is_no_conflict() {
    let mut table = Table::laid();
    puts_tile(&mut table, BEN, 1, "laughs");
    puts_tile(&mut table, BEN, 2, "hides");
    table.settle();
    table.cut(AIKO);
    swaps_tiles(&mut table, AIKO, 1, 2);
    puts_tile(&mut table, BEN, 1, "smiles");
    table.settle();
    table.connect(AIKO);
    assert!(table.editor(AIKO).conflicts.is_empty(), "nobody has to decide about a place");
    assert!(table.said(AIKO).iter().any(|said| matches!(said, Announcement::WasFirst(..))), "it is said who was first");
    assert_eq!([AIKO, BEN].map(|who| tiles(&table, who)), ["1 smiles 2 hides", "1 smiles 2 hides"]);

    // Beside what others made of other tiles it is moved nevertheless.
    table.cut(AIKO);
    swaps_tiles(&mut table, AIKO, 1, 2);
    puts_tile(&mut table, BEN, 3, "runs");
    table.settle();
    table.connect(AIKO);
    assert_eq!([AIKO, BEN].map(|who| tiles(&table, who)), ["1 hides 2 smiles 3 runs", "1 hides 2 smiles 3 runs"]);

    // A tile that is written and moved by one change is something that somebody would miss.
    table.cut(AIKO);
    puts_tile(&mut table, AIKO, 1, "waves");
    swaps_tiles(&mut table, AIKO, 1, 2);
    puts_tile(&mut table, BEN, 1, "looks");
    table.settle();
    table.connect(AIKO);
    assert_eq!(table.editor(AIKO).conflicts.len(), 1);
}
