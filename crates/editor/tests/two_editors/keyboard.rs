//! Scenes of the keyboard on the graph: where it goes, what it means, and that Escape takes back one thing at a time.

use crate::server::id;
use crate::sketch::{connector, stream, streams};
use crate::table::{AIKO, BEN, Table};
use behaviour::Place;
use editor::graph::StepDirection;
use editor::graph::StepDirection::{Down, Left, Right, Up};
use editor::keys::EscapeUse;
use editor::{FocusTarget, Selected};

fn steps(table: &mut Table, here: Option<Selected>, way: StepDirection, more: bool) -> Option<Selected> {
    table.does(AIKO, |page| page.input(|editor| editor.step(here, way, more)))
}

fn keyboard_at(table: &mut Table, who: usize, part: Selected) {
    table.does(who, |page| page.input(|editor| editor.keyboard_at(Some(part))));
}

fn escape(table: &mut Table) -> EscapeUse {
    table.does(AIKO, |page| page.input(editor::Editor::escape))
}

#[test]
fn arrow_keys_walk_down_up_and_aside_and_choose_what_they_reach() {
    let mut table = Table::sketched();
    assert_eq!(steps(&mut table, None, Down, false), Some(stream("ball")), "from nowhere to the first");
    assert_eq!(steps(&mut table, Some(stream("ball")), Down, false), Some(stream("distance")));
    assert_eq!(table.selected(AIKO), Some(stream("distance")));
    assert_eq!(steps(&mut table, Some(stream("distance")), Up, false), Some(stream("ball")));
    assert_eq!(steps(&mut table, Some(stream("ball")), Right, false), Some(stream("touch")));
    assert_eq!(steps(&mut table, Some(stream("touch")), Left, false), Some(stream("ball")));
    assert_eq!(steps(&mut table, Some(stream("ball")), Up, false), None, "nothing is above it");
    assert_eq!(table.selected(AIKO), Some(stream("ball")));
    assert_eq!(steps(&mut table, Some(connector("to-close")), Down, false), Some(stream("close")));
    assert_eq!(steps(&mut table, Some(connector("to-close")), Up, false), Some(stream("distance")));
}

#[test]
fn shift_and_arrows_choose_more_and_less() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(|editor| editor.select(Some(stream("ball")))));
    steps(&mut table, Some(stream("ball")), Down, true);
    steps(&mut table, Some(stream("distance")), Down, true);
    assert_eq!(*table.editor(AIKO).several, streams(&["ball", "distance", "close"]));
    steps(&mut table, Some(stream("close")), Up, true);
    assert_eq!(*table.editor(AIKO).several, streams(&["ball", "distance"]), "back over what is chosen it is let go of");
}

#[test]
fn arrow_keys_reach_a_folded_group_as_one_box() {
    let mut table = Table::sketched();
    table.gesture(AIKO, |editor, op| editor.make_group(op, &streams(&["distance", "close"]), "Group"));
    let made = table.program().groups().next().map(|(id, _)| id.clone()).unwrap();
    table.gesture(AIKO, |editor, op| editor.fold(op, &made, true));
    assert_eq!(steps(&mut table, Some(stream("ball")), Down, false), Some(Selected::Group(made)));
}

#[test]
fn the_keyboard_goes_on_to_what_a_removed_part_came_from() {
    let mut table = Table::sketched();
    let before =
        |table: &mut Table, what: Selected| table.does(AIKO, |page| page.input(|editor| editor.before_it(&what)));
    assert_eq!(before(&mut table, stream("close")), Some(stream("distance")));
    assert_eq!(before(&mut table, connector("to-close")), Some(stream("distance")));
    assert_eq!(before(&mut table, stream("ball")), None);
    assert_eq!(before(&mut table, Selected::Note(id("n"))), Some(stream("ball")), "the first stream");
}

#[test]
fn a_part_that_somebody_removes_gives_the_keyboard_to_what_stands_nearest() {
    let mut table = Table::sketched();
    keyboard_at(&mut table, AIKO, stream("close"));
    table.gesture(BEN, |editor, op| editor.remove(op, &stream("close")));
    assert_eq!(table.pages[AIKO].focused, [FocusTarget::Part(stream("distance"))]);
    assert_eq!(table.editor(AIKO).keyboard(), Some(&stream("distance")));
    assert!(table.pages[BEN].focused.is_empty(), "Ben's keyboard was elsewhere");
}

#[test]
fn a_part_that_is_folded_away_gives_the_keyboard_to_its_box() {
    let mut table = Table::sketched();
    table.gesture(BEN, |editor, op| editor.make_group(op, &streams(&["distance", "close"]), "Group"));
    let made = table.program().groups().next().map(|(id, _)| id.clone()).unwrap();
    keyboard_at(&mut table, AIKO, connector("to-close"));
    table.gesture(BEN, |editor, op| editor.fold(op, &made, true));
    assert_eq!(table.pages[AIKO].focused, [FocusTarget::Part(Selected::Group(made))]);
}

#[test]
fn when_nothing_is_left_the_keyboard_is_on_the_graph() {
    let mut table = Table::sketched();
    keyboard_at(&mut table, AIKO, stream("ball"));
    table.gesture(BEN, |editor, op| {
        editor.choose_all();
        editor.remove_several(op, &editor.chosen());
    });
    assert_eq!(table.pages[AIKO].focused.last(), Some(&FocusTarget::Graph));
    assert_eq!(table.editor(AIKO).keyboard(), None);
}

#[test]
fn an_edit_elsewhere_leaves_the_keyboard_where_it_is() {
    let mut table = Table::sketched();
    keyboard_at(&mut table, AIKO, stream("close"));
    table.does(BEN, |page| page.input(|editor| editor.move_to(&[(id("close"), Place { x: 70.0, y: 70.0 })])));
    table.gesture(BEN, |editor, op| editor.remove(op, &stream("touch")));
    assert!(table.pages[AIKO].focused.is_empty());
    assert_eq!(table.editor(AIKO).keyboard(), Some(&stream("close")));
}

#[test]
fn what_is_selected_and_removed_by_somebody_is_selected_no_more() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(|editor| editor.select(Some(connector("to-close")))));
    table.gesture(BEN, |editor, op| editor.remove(op, &stream("close")));
    assert_eq!(table.selected(AIKO), None);
    table.does(AIKO, |page| page.input(|editor| editor.choose(streams(&["ball", "touch", "distance"]))));
    table.gesture(BEN, |editor, op| editor.remove(op, &stream("touch")));
    assert_eq!(*table.editor(AIKO).several, streams(&["ball", "distance"]));
}

#[test]
fn escape_closes_a_control_and_stops_nothing() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(|editor| editor.select(Some(connector("to-close")))));
    let used = escape(&mut table);
    assert_eq!((used.is_used(), used), (true, EscapeUse::CloseControl));
    assert!(table.editor(AIKO).chosen().is_empty());
    assert!(!escape(&mut table).is_used(), "there is nothing more to take back");
}

#[test]
fn escape_chooses_nothing_any_more_which_takes_nothing_back() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(|editor| editor.select(Some(stream("ball")))));
    let used = escape(&mut table);
    assert_eq!((used.is_used(), used), (false, EscapeUse::ChooseNothing(Some(stream("ball")))));
    table.does(AIKO, |page| page.input(|editor| editor.choose(streams(&["ball", "touch"]))));
    assert_eq!(escape(&mut table), EscapeUse::ChooseNothing(None));
    assert_eq!(escape(&mut table), EscapeUse::Nothing);
}

#[test]
fn escape_ends_following_before_anything_else() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(|editor| editor.choose(streams(&["ball", "touch"]))));
    let ben = crate::server::Server::client(BEN);
    table.does(AIKO, |page| page.input(|editor| editor.follow(&ben)));
    let used = escape(&mut table);
    assert_eq!((used.is_used(), used), (true, EscapeUse::EndFollowing));
    assert_eq!(table.editor(AIKO).several.len(), 2, "what is chosen stays");
}
