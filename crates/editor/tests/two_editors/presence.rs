//! Scenes of who is there: where each points, what each has chosen, and following.

use crate::server::{Server, id};
use crate::sketch::stream;
use crate::table::{AIKO, BEN, Table};
use editor::{Announcement, Editor, signs};
use protocol::{CanvasArea, Pointer};

const HERE: Pointer = Pointer { x: 10.0, y: 20.0 };

fn ben(table: &Table) -> Option<protocol::Person> {
    table.editor(AIKO).people.iter().find(|person| person.client == Server::client(BEN)).cloned()
}

fn area(x: f64) -> CanvasArea {
    let area = serde_json::json!({ "x": x, "y": 0.0, "width": 800.0, "height": 600.0 });
    serde_json::from_value(area).expect("an area")
}

#[test]
fn both_are_there_and_told_apart() {
    let table = Table::sketched();
    let letters: Vec<String> = signs(&table.editor(AIKO).people).into_iter().map(|sign| sign.letters).collect();
    assert_eq!(letters, ["AI", "BE"]);
}

#[test]
fn a_pointer_and_what_is_chosen_are_seen_by_the_other() {
    let mut table = Table::sketched();
    table.pass(100);
    table.does(BEN, |page| page.input(|editor| editor.present(Some(HERE))));
    table.pass(100);
    table.does(BEN, |page| page.input(|editor| editor.select(Some(stream("close")))));
    table.pass(100);
    let seen = ben(&table).expect("Ben is there");
    assert_eq!((seen.pointer, seen.selected), (Some(HERE), Some(id("close"))));
    table.does(BEN, |page| page.input(|editor| editor.present(None)));
    table.pass(100);
    assert_eq!(ben(&table).and_then(|ben| ben.pointer), None, "the hand left the graph");
}

#[test]
fn a_selection_that_somebody_removes_is_shown_to_nobody_any_more() {
    let mut table = Table::sketched();
    table.pass(100);
    table.does(BEN, |page| page.input(|editor| editor.select(Some(stream("close")))));
    table.pass(100);
    table.gesture(AIKO, |editor, op| editor.remove(op, &stream("close")));
    table.pass(100);
    assert_eq!(ben(&table).and_then(|ben| ben.selected), None);
}

#[test]
fn others_are_told_at_most_twenty_times_a_second_and_the_last_place_in_any_case() {
    let mut table = Table::sketched();
    table.pass(1_000);
    table.forget();
    let mut told: Vec<f64> = Vec::new();
    let mut tell = |table: &mut Table| {
        for (_, request) in std::mem::take(&mut table.pages[BEN].link.outbox) {
            let protocol::AnyRequest::Present(present) = request else { panic!("{request:?}") };
            told.extend(present.pointer.map(|pointer| pointer.x));
        }
    };
    for at in 0..100 {
        table.pages[BEN].now_ms += 10;
        table.pages[BEN].input(|editor| editor.present(Some(Pointer { x: f64::from(at), y: 0.0 }))).unwrap();
        tell(&mut table);
        let now = table.pages[BEN].now_ms;
        while let Some(due) = table.pages[BEN].timers.iter().position(|(at, _)| *at <= now) {
            let (_, wake) = table.pages[BEN].timers.remove(due);
            table.pages[BEN].input(|editor| editor.wake(wake)).unwrap();
            tell(&mut table);
        }
    }
    for (_, wake) in std::mem::take(&mut table.pages[BEN].timers) {
        table.pages[BEN].now_ms += 50;
        table.pages[BEN].input(|editor| editor.wake(wake)).unwrap();
        tell(&mut table);
    }
    assert!((15..=21).contains(&told.len()), "{} times in a second", told.len());
    assert_eq!(told.last(), Some(&99.0));
}

#[test]
fn what_did_not_change_is_not_told_again() {
    let mut table = Table::sketched();
    table.pass(1_000);
    table.does(BEN, |page| page.input(|editor| editor.present(Some(HERE))));
    table.pass(1_000);
    table.pages[BEN].input(|editor| editor.present(Some(HERE))).unwrap();
    assert!(table.pages[BEN].link.outbox.is_empty());
}

#[test]
fn who_follows_sees_and_tells_what_the_other_sees_until_a_choice_ends_it() {
    let mut table = Table::sketched();
    table.pass(100);
    table.does(BEN, |page| page.input(|editor| editor.present_view(Some(area(300.0)))));
    table.pass(100);
    table.does(AIKO, |page| page.input(|editor| editor.follow(&Server::client(BEN))));
    assert_eq!(ben(&table).and_then(|ben| ben.view), Some(area(300.0)));
    table.does(AIKO, |page| page.input(|editor| editor.present_view(Some(area(0.0)))));
    table.pass(100);
    let aiko = table.editor(BEN).people.iter().find(|person| person.client == Server::client(AIKO)).cloned();
    assert_eq!(aiko.and_then(|aiko| aiko.view), Some(area(300.0)), "two who follow each other stay where they are");
    table.does(AIKO, |page| page.input(|editor| editor.select(Some(stream("ball")))));
    assert_eq!(*table.editor(AIKO).following, None);
}

#[test]
fn who_is_followed_and_leaves_is_followed_no_more_and_named() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(|editor| editor.follow(&Server::client(BEN))));
    table.cut(BEN);
    assert_eq!(table.said(AIKO), [Announcement::NoLongerHere("Ben".to_owned())]);
    assert_eq!(*table.editor(AIKO).following, None);
    assert_eq!(ben(&table), None);
}

#[test]
fn a_lost_link_ends_following_and_after_it_one_is_shown_anew() {
    let mut table = Table::sketched();
    table.pass(100);
    table.does(BEN, |page| page.input(|editor| editor.select(Some(stream("close")))));
    table.pass(100);
    table.does(BEN, |page| page.input(|editor| editor.follow(&Server::client(AIKO))));
    table.cut(BEN);
    assert_eq!(*table.editor(BEN).following, None);
    assert_eq!(ben(&table), None, "nobody sees who is gone");
    table.connect(BEN);
    table.pass(100);
    assert_eq!(ben(&table).and_then(|ben| ben.selected), Some(id("close")), "what is still chosen is told anew");
}

#[test]
fn a_program_that_is_left_has_nobody_in_it_and_nothing_chosen() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(|editor| editor.select(Some(stream("close")))));
    table.does(AIKO, |page| page.input(Editor::close_program));
    let editor = table.editor(AIKO);
    assert!(editor.people.is_empty() && editor.chosen().is_empty() && editor.following.is_none());
}
