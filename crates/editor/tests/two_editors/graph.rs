//! Scenes of gestures on the graph: what one does both have, one undo takes it back, and what was made is chosen.

use crate::scenes::said;
use crate::server::id;
use crate::sketch::{connector, filter, plan, sketch, stream, streams};
use crate::table::{AIKO, BEN, Table};
use behaviour::{Behaviour, Group, Id, Kind, Note, Params, Place, Procedure, Record, RecordId, connectors};
use editor::graph::{ConnectPlan, Gap, Ghost, Joining, LineUp, NewSpot, Output, ProgramPart, WireEnd, wire_ends};
use editor::{Announcement, Put, Selected};
use std::collections::BTreeSet;

const FAR: Place = Place { x: 900.0, y: 300.0 };

/// Aiko makes a group of these; its id.
fn grouped(table: &mut Table, of: &[&str]) -> Id {
    table.gesture(AIKO, |editor, op| editor.make_group(op, &streams(of), "Group"));
    let group = table.program().groups().next().map(|(id, _)| id.clone());
    group.expect("it is made")
}

fn group(table: &Table, id: &Id) -> Group {
    table.editor(BEN).shown_group(id).expect("both see it")
}

#[test]
fn a_sense_is_added_where_it_is_dropped_and_one_undo_takes_it_away() {
    let mut table = Table::sketched();
    table.gesture(AIKO, |editor, op| editor.add_sensor(op, ("HeadTouch", "Head touch"), Params::new(), Some(FAR)));
    assert_eq!(table.place("Head touch"), FAR);
    assert_eq!(table.selected(AIKO), Some(Selected::Stream(table.named("Head touch"))));
    assert_eq!(table.selected(BEN), None, "who looks on chooses for themselves");
    table.undo(AIKO);
    assert_eq!(table.program(), &sketch());
    assert_eq!(table.selected(AIKO), None);
}

#[test]
fn a_sense_without_a_place_stands_right_of_the_others_and_has_a_free_name() {
    let mut table = Table::sketched();
    table.gesture(AIKO, |editor, op| editor.add_sensor(op, ("HeadTouch", "touch"), Params::new(), None));
    let place = table.place("touch 2");
    assert!(place.y == 0.0 && place.x > 600.0, "{place:?}");
}

#[test]
fn an_action_is_led_from_the_stream_it_is_dropped_on() {
    let mut table = Table::sketched();
    let output = Output::New { name: "Say".to_owned(), device: Some("Say".to_owned()), params: Params::new() };
    let (operation, inputs) = (connectors::to_action().with(()), vec![id("touch")]);
    table.gesture(AIKO, |editor, op| {
        editor.connect(op, ConnectPlan { operation, inputs, output, spot: NewSpot::Below })
    });
    assert_eq!(table.sources("Say"), ["touch"]);
    assert!(table.place("Say").y > table.place("touch").y);
    assert_eq!(table.selected(AIKO), Some(Selected::Stream(table.named("Say"))));
    table.undo(AIKO);
    assert_eq!(table.program(), &sketch());
}

#[test]
fn a_helper_makes_a_new_value_of_the_stream_it_is_dropped_on() {
    let mut table = Table::sketched();
    let helper = connectors::map::SPEC.with(Procedure::Helper("distance".to_owned()));
    table.gesture(AIKO, |editor, op| editor.connect(op, plan(&["ball"], helper, "In metres")));
    assert_eq!(table.sources("In metres"), ["ball"]);
    assert_eq!(said(&table.editor(AIKO).undoable).as_deref(), Some("Add map"));
}

#[test]
fn a_connector_and_the_next_one_are_one_step_back() {
    let mut table = Table::sketched();
    let (first, then) = (plan(&["touch"], filter("touch.front"), "Front"), plan(&[], filter("front"), "Again"));
    table.gesture(AIKO, |editor, op| editor.connect_twice(op, first, then));
    assert_eq!((table.sources("Front"), table.sources("Again")), (vec!["touch".to_owned()], vec!["Front".to_owned()]));
    assert_eq!(table.selected(AIKO), Some(Selected::Stream(table.named("Again"))));
    table.undo(AIKO);
    assert_eq!(table.program(), &sketch());
}

#[test]
fn two_presses_put_a_connector_into_an_edge_and_one_undo_takes_it_out() {
    let mut table = Table::sketched();
    let spot = NewSpot::Into(Gap { connector: id("to-close"), input: id("distance") });
    let between = ConnectPlan { spot, ..plan(&["distance"], filter("distance > 1"), "Seen") };
    table.gesture(AIKO, |editor, op| editor.connect(op, between));
    assert_eq!((table.sources("Seen"), table.sources("close")), (vec!["distance".to_owned()], vec!["Seen".to_owned()]));
    assert!(table.place("close").y > 280.0, "what is below makes room");
    table.undo(AIKO);
    assert_eq!(table.program(), &sketch());
}

#[test]
fn a_wire_ends_at_an_action_which_is_told_these_values_too() {
    let mut table = Table::sketched();
    table.gesture(AIKO, |editor, op| editor.wire(op, &id("touch"), &WireEnd::Stream(id("tracker"))));
    let sources: BTreeSet<String> = table.sources("tracker").into_iter().collect();
    assert_eq!(sources, ["close", "touch"].map(str::to_owned).into());
    assert_eq!(table.selected(AIKO), Some(stream("tracker")));
    table.undo(AIKO);
    assert_eq!(table.program(), &sketch());
}

#[test]
fn a_wire_feeds_a_stream_again_and_a_connector_takes_one_more() {
    let mut table = Table::sketched();
    table.gesture(AIKO, |editor, op| editor.remove(op, &connector("to-distance")));
    assert!(table.sources("distance").is_empty());
    table.gesture(AIKO, |editor, op| editor.wire(op, &id("touch"), &WireEnd::Stream(id("distance"))));
    assert_eq!(table.sources("distance"), ["touch"]);
    table.gesture(AIKO, |editor, op| editor.wire(op, &id("ball"), &WireEnd::Stream(id("distance"))));
    assert_eq!(table.sources("distance"), ["touch", "ball"], "one merge of both");
    assert_eq!(table.program().connectors().count(), 3);
}

#[test]
fn who_selects_something_else_before_a_wire_is_saved_keeps_that() {
    let mut table = Table::sketched();
    table.pages[AIKO].gesture(|editor, op| editor.wire(op, &id("touch"), &WireEnd::Connector(id("to-close")))).unwrap();
    table.pages[AIKO].input(|editor| editor.select(Some(stream("ball")))).unwrap();
    table.settle();
    assert_eq!(table.sources("close"), ["touch"]);
    assert_eq!(table.selected(AIKO), Some(stream("ball")));
}

#[test]
fn keys_hear_how_many_places_a_wire_has_and_what_comes_of_each() {
    let ends = wire_ends(&sketch(), &id("touch"));
    let told: Vec<(&str, Joining)> = ends.iter().map(|(end, joining)| (end.id().as_str(), *joining)).collect();
    assert!(told.contains(&("tracker", Joining::Acts)) && told.contains(&("close", Joining::Merges)), "{told:?}");
    assert!(told.contains(&("to-close", Joining::Replaces)), "{told:?}");
    assert!(wire_ends(&sketch(), &id("tracker")).is_empty(), "nothing comes out of an action");
    let from_close = wire_ends(&sketch(), &id("close"));
    assert!(
        from_close.iter().all(|(end, _)| !["ball", "distance", "to-close"].contains(&end.id().as_str())),
        "no circle"
    );
}

#[test]
fn a_way_goes_on_without_a_stream_that_is_taken_out() {
    let mut table = Table::sketched();
    table.gesture(AIKO, |editor, op| editor.remove_and_heal(op, &id("distance")));
    assert_eq!(table.sources("close"), ["ball"]);
    assert_eq!(said(&table.editor(AIKO).undoable).as_deref(), Some("Remove distance"));
    table.undo(AIKO);
    assert_eq!(table.program(), &sketch());
}

#[test]
fn a_connector_takes_from_another_stream_and_becomes_another_kind() {
    let mut table = Table::sketched();
    let seen = table.program().connector(&id("to-close")).cloned().unwrap();
    let operation = connectors::map::SPEC.with(Procedure::body("touch.front"));
    table.gesture(AIKO, |editor, op| {
        editor.edit_connector(op, (&id("to-close"), seen), (operation, vec![id("touch")]), Some("Front"));
    });
    assert_eq!(table.sources("Front"), ["touch"]);
    assert_eq!(table.program().connector(&id("to-close")).map(|made| made.operation.word()), Some("map"));
    table.undo(AIKO);
    assert_eq!(table.program(), &sketch());
}

#[test]
fn the_inputs_of_a_connector_change_their_order() {
    let mut table = Table::sketched();
    table.gesture(AIKO, |editor, op| {
        editor.connect(op, plan(&["ball", "touch"], connectors::to_join().with(()), "Both"))
    });
    let (of, seen) = table
        .program()
        .connectors()
        .find(|(_, made)| made.output == table.named("Both"))
        .map(|(id, made)| (id.clone(), made.clone()))
        .unwrap();
    let turned = (seen.operation.clone(), vec![id("touch"), id("ball")]);
    table.gesture(AIKO, |editor, op| editor.edit_connector(op, (&of, seen), turned, None));
    assert_eq!(table.sources("Both"), ["touch", "ball"]);
}

#[test]
fn a_name_follows_its_test_until_a_person_gives_another() {
    let mut table = Table::sketched();
    table.gesture(AIKO, |editor, op| {
        editor.connect(op, plan(&["distance"], filter("distance < 40"), "Where distance < 40"))
    });
    let of = |table: &Table, name: &str| {
        let output = table.named(name);
        let found = table.program().connectors().find(|(_, made)| made.output == output);
        found.map(|(id, made)| (id.clone(), made.clone())).unwrap()
    };
    let (made, seen) = of(&table, "Where distance < 40");
    table.gesture(AIKO, |editor, op| {
        editor.edit_connector(op, (&made, seen), (filter("distance < 60"), vec![id("distance")]), None);
    });
    let (_, seen) = of(&table, "Where distance < 60");
    let (output, named) = (seen.output.clone(), table.program().stream(&seen.output).cloned().unwrap());
    let other = behaviour::Stream { name: "Near".to_owned(), ..named.clone() };
    table.gesture(AIKO, |editor, op| editor.edit_stream(op, (&output, named), other));
    table.gesture(AIKO, |editor, op| {
        editor.edit_connector(op, (&made, seen), (filter("distance < 80"), vec![id("distance")]), None);
    });
    assert!(table.names().contains(&"Near".to_owned()), "{:?}", table.names());
}

#[test]
fn a_new_name_is_followed_by_what_uses_it() {
    let mut table = Table::sketched();
    let seen = table.program().stream(&id("distance")).cloned().unwrap();
    let renamed = behaviour::Stream { name: "way".to_owned(), ..seen.clone() };
    table.gesture(BEN, |editor, op| editor.edit_stream(op, (&id("distance"), seen), renamed));
    let made = table.program().connector(&id("to-close")).unwrap();
    assert_eq!(made.operation.procedure(), Some(&Procedure::body("way < 20")));
    assert_eq!(said(&table.editor(BEN).undoable).as_deref(), Some("Rename distance"));
}

#[test]
fn two_people_who_change_other_things_of_one_stream_both_keep_theirs() {
    let mut table = Table::sketched();
    let seen = table.program().stream(&id("tracker")).cloned().unwrap();
    let (name, hold) = (
        behaviour::Stream { name: "Head".to_owned(), ..seen.clone() },
        behaviour::Stream { hold_ms: Some(500), ..seen.clone() },
    );
    table.gesture(AIKO, |editor, op| editor.edit_stream(op, (&id("tracker"), seen.clone()), name));
    table.gesture(BEN, |editor, op| editor.edit_stream(op, (&id("tracker"), seen), hold));
    let now = table.program().stream(&id("tracker")).cloned().unwrap();
    assert_eq!((now.name.as_str(), now.hold_ms), ("Head", Some(500)));
    assert!(table.editor(BEN).conflicts.is_empty());
}

#[test]
fn a_typed_sentence_is_added_as_one_and_chosen() {
    let mut table = Table::sketched();
    let made = editor::graph::GhostStream {
        id: id("draft"),
        stream: behaviour::Stream { name: "Far".to_owned(), ..table.program().stream(&id("close")).cloned().unwrap() },
        place: FAR,
        doubtful: false,
    };
    let leads = behaviour::Connector {
        operation: filter("distance > 20"),
        inputs: vec![id("distance")],
        output: id("draft"),
        order: 0,
    };
    let ghost = Ghost {
        streams: vec![made],
        connectors: vec![editor::graph::GhostConnector { connector: leads, doubtful: false }],
    };
    table.gesture(AIKO, |editor, op| editor.put_ghost(op, ghost));
    assert_eq!((table.sources("Far"), table.place("Far")), (vec!["distance".to_owned()], FAR));
    assert_eq!(table.selected(AIKO), Some(Selected::Stream(table.named("Far"))));
    table.undo(AIKO);
    assert_eq!(table.program(), &sketch());
}

#[test]
fn one_press_doubles_several_beside_themselves() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(|editor| editor.choose(streams(&["distance", "close"]))));
    table.gesture(AIKO, |editor, op| {
        let part = editor.part(&editor.chosen(), &[]);
        editor.put_in(op, part, Put::Beside, &[]);
    });
    assert_eq!(table.sources("close 2"), ["distance 2"]);
    assert!((table.place("close 2").x - table.place("close").x).abs() > 100.0, "nothing is covered");
    assert_eq!(
        *table.editor(AIKO).several,
        [table.named("distance 2"), table.named("close 2")].map(Selected::Stream).into()
    );
    table.undo(AIKO);
    assert_eq!(table.program(), &sketch());
}

#[test]
fn all_are_copied_as_a_text_and_pasted_into_another_program() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(editor::Editor::choose_all));
    assert_eq!(table.editor(AIKO).several.len(), 8, "streams and connectors");
    let text = table.does(AIKO, |page| page.input(|editor| editor.part(&editor.chosen(), &[]).text()));
    let mut other = Table::with(Behaviour::default());
    let part = ProgramPart::read(&text, serde_json::from_str).expect("it is a part");
    other.gesture(BEN, |editor, op| editor.put_in(op, part, Put::At(FAR), &[]));
    assert_eq!(other.names(), table.names());
    assert_eq!(other.sources("tracker"), ["close"]);
    assert_eq!(ProgramPart::read("hello", serde_json::from_str).map(|part| part.is_empty()), None);
}

#[test]
fn several_are_dragged_and_removed_together() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(|editor| editor.choose(streams(&["distance", "close"]))));
    let moving = table.does(AIKO, |page| page.input(|editor| editor.moving(&id("close"))));
    assert_eq!(moving.iter().map(|(id, _)| id.as_str()).collect::<Vec<_>>(), ["close", "distance"]);
    let there: Vec<(Id, Place)> = moving.into_iter().map(|(id, at)| (id, Place { x: at.x + 300.0, ..at })).collect();
    table.does(AIKO, |page| page.input(|editor| editor.move_to(&there)));
    assert_eq!([table.place("close").x, table.place("distance").x, table.place("ball").x], [300.0, 300.0, 0.0]);
    table.gesture(AIKO, |editor, op| editor.remove_several(op, &streams(&["distance", "close"])));
    assert_eq!(table.names(), ["ball", "touch", "tracker"]);
    assert!(table.editor(AIKO).chosen().is_empty() && table.program().connectors().count() == 0);
    table.undo(AIKO);
    assert_eq!((table.names().len(), table.place("close").x), (5, 300.0), "one step back brings both");
}

#[test]
fn one_alone_is_dragged_though_others_are_chosen() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(|editor| editor.choose(streams(&["distance", "close"]))));
    let moving = table.does(AIKO, |page| page.input(|editor| editor.moving(&id("ball"))));
    assert_eq!(moving, [(id("ball"), Place { x: 0.0, y: 0.0 })]);
}

#[test]
fn a_long_press_chooses_one_thing_more_and_lets_it_go_again() {
    let mut table = Table::sketched();
    let chooses =
        |table: &mut Table, what: &str| table.does(AIKO, |page| page.input(|editor| editor.choose_too(stream(what))));
    chooses(&mut table, "ball");
    assert_eq!(table.selected(AIKO), Some(stream("ball")));
    chooses(&mut table, "touch");
    assert_eq!((table.selected(AIKO), table.editor(AIKO).several.len()), (None, 2));
    chooses(&mut table, "ball");
    assert_eq!((table.selected(AIKO), table.editor(AIKO).several.len()), (Some(stream("touch")), 0));
}

#[test]
fn a_connector_alone_is_no_part_so_that_cutting_it_removes_nothing() {
    let mut table = Table::sketched();
    let part = table.does(AIKO, |page| page.input(|editor| editor.part(&[connector("to-close")].into(), &[])));
    assert!(part.is_empty() && !part.holds(&connector("to-close")));
    let of: BTreeSet<Selected> = [connector("to-close"), stream("close")].into();
    let part = table.does(AIKO, |page| page.input(|editor| editor.part(&of, &[])));
    assert!(part.holds(&connector("to-close")) && part.holds(&stream("close")));
}

#[test]
fn several_are_lined_up_in_a_row_for_both() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(|editor| editor.line_up(&streams(&["ball", "distance", "close"]), LineUp::Row)));
    let places = ["ball", "distance", "close"].map(|name| table.place(name));
    let apart = |one: usize, other: usize| (places[one].x - places[other].x).abs() > 200.0;
    assert!(places.iter().all(|place| place.y == 0.0) && apart(0, 1) && apart(1, 2) && apart(0, 2), "{places:?}");
    assert_eq!(said(&table.editor(AIKO).undoable).as_deref(), Some("Align"));
}

#[test]
fn chosen_streams_become_a_group_that_is_dragged_with_its_streams() {
    let mut table = Table::sketched();
    let made = grouped(&mut table, &["distance", "close"]);
    assert_eq!(table.selected(AIKO), Some(Selected::Group(made.clone())));
    assert_eq!((group(&table, &made).title.as_str(), group(&table, &made).streams.len()), ("Group", 2));
    let moving = table.does(AIKO, |page| page.input(|editor| editor.moving(&made)));
    assert_eq!(moving.iter().map(|(id, _)| id.as_str()).collect::<Vec<_>>(), ["close", "distance"]);
    let other = {
        table.gesture(AIKO, |editor, op| editor.make_group(op, &streams(&["touch"]), "Group"));
        table.program().groups().count()
    };
    let titles: BTreeSet<&str> = table.program().groups().map(|(_, group)| group.title.as_str()).collect();
    assert_eq!((other, titles), (2, ["Group", "Group 2"].into()));
}

#[test]
fn a_folded_group_is_one_box_for_everybody_and_unfolds_where_it_is() {
    let mut table = Table::sketched();
    let made = grouped(&mut table, &["distance", "close"]);
    table.does(BEN, |page| page.input(|editor| editor.select(Some(stream("close")))));
    table.gesture(AIKO, |editor, op| editor.fold(op, &made, true));
    for who in [AIKO, BEN] {
        assert!(table.editor(who).folded.contains(&made));
        assert_eq!(table.editor(who).folded_away(&connector("to-close")), Some(made.clone()));
    }
    assert_eq!(table.selected(BEN), Some(Selected::Group(made.clone())), "what was chosen gives its place to the box");
    table.gesture(BEN, |editor, op| editor.fold(op, &made, false));
    assert!([AIKO, BEN].iter().all(|who| table.editor(*who).hidden.is_empty()));
}

#[test]
fn what_is_looked_for_in_a_folded_group_is_shown_here_and_stays_folded_for_others() {
    let mut table = Table::sketched();
    let made = grouped(&mut table, &["distance", "close"]);
    table.gesture(AIKO, |editor, op| editor.fold(op, &made, true));
    table.does(BEN, |page| page.input(|editor| editor.select(Some(stream("close")))));
    assert_eq!(table.selected(BEN), Some(stream("close")));
    assert_eq!([AIKO, BEN].map(|who| table.editor(who).folded.contains(&made)), [true, false]);
    table.gesture(BEN, |editor, op| editor.fold(op, &made, true));
    assert!(
        table.editor(BEN).folded.contains(&made) && group(&table, &made).folded,
        "folded here again, and no change"
    );
    assert_eq!(said(&table.editor(BEN).undoable), None);
}

#[test]
fn a_group_that_is_folded_anew_is_folded_for_who_had_it_open_here() {
    let mut table = Table::sketched();
    let made = grouped(&mut table, &["distance", "close"]);
    table.gesture(AIKO, |editor, op| editor.fold(op, &made, true));
    table.does(BEN, |page| page.input(|editor| editor.unfold_here(&made)));
    table.gesture(AIKO, |editor, op| editor.fold(op, &made, false));
    assert!(!table.editor(BEN).folded.contains(&made));
    table.gesture(AIKO, |editor, op| editor.fold(op, &made, true));
    assert!(table.editor(BEN).folded.contains(&made));
}

#[test]
fn a_group_is_renamed_and_taken_apart() {
    let mut table = Table::sketched();
    let made = grouped(&mut table, &["distance", "close"]);
    let seen = group(&table, &made);
    table.gesture(BEN, |editor, op| editor.retitle(op, &made, seen.clone(), "  Near "));
    assert_eq!(group(&table, &made).title, "Near");
    table.gesture(AIKO, |editor, op| editor.retitle(op, &made, seen, "Far"));
    assert_eq!(group(&table, &made).title, "Near", "Aiko saw another title");
    table.gesture(AIKO, |editor, op| editor.ungroup(op, &[Selected::Group(made.clone())].into()));
    assert!(table.program().groups().next().is_none());
    assert_eq!(*table.editor(AIKO).several, streams(&["distance", "close"]));
}

#[test]
fn who_only_put_a_stream_into_a_group_is_in_nobodys_way() {
    let mut table = Table::sketched();
    let made = grouped(&mut table, &["distance"]);
    let seen = group(&table, &made);
    table.does(BEN, |page| page.input(|editor| editor.move_into(&[(id("close"), FAR)], &made)));
    table.gesture(AIKO, |editor, op| editor.retitle(op, &made, seen, "Near"));
    let now = group(&table, &made);
    assert_eq!((now.title.as_str(), now.streams.len()), ("Near", 2));
}

#[test]
fn where_nothing_is_to_be_grouped_it_is_said() {
    let mut table = Table::sketched();
    table.gesture(AIKO, |editor, op| editor.make_group(op, &[connector("to-close")].into(), "Group"));
    table.gesture(AIKO, |editor, op| editor.ungroup(op, &streams(&["ball"])));
    assert_eq!(table.said(AIKO), [Announcement::NothingToGroup, Announcement::InNoGroup]);
    assert_eq!(table.program(), &sketch());
}

#[test]
fn a_stream_that_is_carried_into_a_frame_is_in_the_group() {
    let mut table = Table::sketched();
    let made = grouped(&mut table, &["distance", "close"]);
    table.does(AIKO, |page| page.input(|editor| editor.move_into(&[(id("touch"), FAR)], &made)));
    assert!(group(&table, &made).streams.contains(&id("touch")));
    assert_eq!((table.place("touch"), table.said(AIKO)), (FAR, vec![Announcement::MovedInto("Group".to_owned())]));
    table.undo(AIKO);
    assert!(!group(&table, &made).streams.contains(&id("touch")) && table.place("touch").x == 600.0, "one step back");
}

#[test]
fn a_frame_that_is_taken_away_meanwhile_leaves_the_stream_where_it_is_dropped() {
    let mut table = Table::sketched();
    let made = grouped(&mut table, &["distance", "close"]);
    table.gesture(BEN, |editor, op| editor.ungroup(op, &[Selected::Group(made.clone())].into()));
    table.does(AIKO, |page| page.input(|editor| editor.move_into(&[(id("touch"), FAR)], &made)));
    assert_eq!((table.place("touch"), table.program().groups().count()), (FAR, 0));
}

#[test]
fn a_group_of_which_nothing_is_left_is_gone() {
    let mut table = Table::sketched();
    let made = grouped(&mut table, &["distance", "close"]);
    table.gesture(BEN, |editor, op| editor.remove_several(op, &streams(&["distance", "close"])));
    assert!(table.program().groups().next().is_none());
    assert_eq!(table.selected(AIKO), None, "Aiko had chosen {made}");
}

#[test]
fn what_could_not_be_moved_is_drawn_where_it_is_saved() {
    let mut table = Table::sketched();
    table.does(BEN, |page| page.input(|editor| editor.begin_typing(&RecordId::new(Kind::Stream, &id("touch")))));
    table.pages[AIKO].input(|editor| editor.move_to(&[(id("gone"), FAR)])).unwrap();
    table.pages[AIKO].redrawn.clear();
    table.settle();
    let back = RecordId::new(Kind::Place, &id("gone"));
    assert!(table.pages[AIKO].redrawn.contains(&back), "{:?}", table.pages[AIKO].redrawn);
}

#[test]
fn a_note_is_written_and_everybody_reads_who_wrote_it() {
    let mut table = Table::sketched();
    let note = table.gesture(AIKO, |editor, op| editor.add_note(op, "Ask Yuki", FAR));
    let (_, written) = table.program().notes().next().unwrap();
    assert_eq!((written.text.as_str(), written.by.as_str()), ("Ask Yuki", "Aiko"));
    assert!(written.at_ms >= 1_000_000_000_000, "by this computer's clock");
    let seen = written.clone();
    table.gesture(BEN, |editor, op| editor.edit_note(op, &note, seen.clone(), "Asked"));
    table.gesture(AIKO, |editor, op| editor.edit_note(op, &note, seen, "Ask Ken"));
    let (_, now) = table.program().notes().next().unwrap();
    assert_eq!((now.text.as_str(), now.by.as_str()), ("Asked", "Ben"), "nothing is overwritten unseen");
    assert!(table.editor(AIKO).conflicts[0].waits_unseen());
}

#[test]
fn a_note_is_taken_back_doubled_and_removed() {
    let mut table = Table::sketched();
    let note = table.gesture(AIKO, |editor, op| editor.add_note(op, "Ask Yuki", FAR));
    table.undo(AIKO);
    assert_eq!(table.program(), &sketch());
    table.does(AIKO, |page| page.input(editor::Editor::redo));
    table.gesture(AIKO, |editor, op| {
        let part = editor.part(&[Selected::Note(note.clone())].into(), &[]);
        editor.put_in(op, part, Put::Beside, &[]);
    });
    let place = |id: &Id| table.program().place(id).map(|at| (at.x as i64, at.y as i64));
    let places: BTreeSet<(i64, i64)> = table.program().notes().filter_map(|(id, _)| place(id)).collect();
    assert_eq!((table.program().notes().count(), places.len()), (2, 2), "one beside the other");
    table.gesture(AIKO, |editor, op| editor.remove(op, &Selected::Note(note.clone())));
    assert_eq!(table.program().notes().count(), 1);
}

#[test]
fn a_note_that_somebody_changed_is_not_removed_by_who_emptied_it() {
    let mut table = Table::sketched();
    let note = table.gesture(AIKO, |editor, op| editor.add_note(op, "Ask Yuki", FAR));
    let (_, seen) = table.program().notes().next().map(|(id, note)| (id.clone(), note.clone())).unwrap();
    table.gesture(BEN, |editor, op| editor.edit_note(op, &note, seen.clone(), "Ask Ken"));
    table.gesture(AIKO, |editor, op| editor.remove_note(op, &note, seen));
    assert_eq!(table.program().notes().next().map(|(_, note)| note.text.as_str()), Some("Ask Ken"));
}

#[test]
fn notes_that_nobody_placed_stand_left_of_the_graph_below_each_other() {
    let mut first = sketch();
    for name in ["one", "two"] {
        first.records.insert(RecordId::new(Kind::Note, &id(name)), Record::Note(Note::new(name.to_owned())));
    }
    let mut table = Table::with(first);
    let places = ["one", "two"].map(|name| table.does(AIKO, |page| page.input(|editor| editor.note_place(&id(name)))));
    assert!(places.iter().all(|place| place.x < -200.0) && places[1].y > places[0].y + 100.0, "{places:?}");
}

#[test]
fn the_name_of_a_program_that_comes_too_late_waits_beside_theirs() {
    let mut first = sketch();
    first.records.insert(RecordId::settings(), Record::Settings(behaviour::Settings::named("Ball")));
    let name = |table: &Table| table.program().settings().map(|now| now.name.clone());
    for (keeps, decided) in [(true, "Mine"), (false, "Theirs")] {
        let mut table = Table::with(first.clone());
        let seen = table.program().settings().cloned().unwrap();
        table.cut(AIKO);
        table.gesture(AIKO, |editor, op| editor.rename_program(op, seen.clone(), "Mine"));
        table.gesture(BEN, |editor, op| editor.rename_program(op, seen, "Theirs"));
        table.connect(AIKO);
        assert_eq!(name(&table).as_deref(), Some("Theirs"));
        let kept = table.editor(AIKO).conflicts[0].mine.op.clone();
        table.does(AIKO, |page| {
            page.input(|editor| if keeps { editor.keep_mine(&kept, id("top")) } else { editor.drop_conflict(&kept) })
        });
        assert_eq!(name(&table).as_deref(), Some(decided));
        assert!(table.editor(AIKO).conflicts.is_empty() && table.editor(AIKO).is_saved(), "nothing waits");
        assert_eq!(table.editor(AIKO).confirmed(), table.program());
    }
}

#[test]
fn an_edit_of_something_that_is_gone_is_kept_and_brings_it_back() {
    let mut table = Table::sketched();
    let seen = table.program().stream(&id("touch")).cloned().unwrap();
    table.cut(AIKO);
    let renamed = behaviour::Stream { name: "Head".to_owned(), ..seen.clone() };
    table.gesture(AIKO, |editor, op| editor.edit_stream(op, (&id("touch"), seen), renamed));
    table.gesture(BEN, |editor, op| editor.remove(op, &stream("touch")));
    table.connect(AIKO);
    assert!(!table.names().contains(&"Head".to_owned()));
    let kept = table.editor(AIKO).conflicts[0].mine.op.clone();
    table.does(AIKO, |page| page.input(|editor| editor.keep_mine(&kept, id("top"))));
    assert!(table.names().contains(&"Head".to_owned()), "{:?}", table.names());
}

#[test]
fn an_edit_redraws_what_it_touches_and_nothing_else() {
    let mut table = Table::sketched();
    table.forget();
    table.does(AIKO, |page| page.input(|editor| editor.move_to(&[(id("touch"), FAR)])));
    let touched: BTreeSet<&RecordId> = table.pages[BEN].redrawn.iter().collect();
    assert_eq!(touched, [&RecordId::new(Kind::Place, &id("touch"))].into());
}

#[test]
fn what_nobody_placed_gets_a_place_by_itself_and_keeps_it_once_somebody_moves_another() {
    let mut first = sketch();
    first.records.retain(|key, _| key.kind != Kind::Place);
    let mut table = Table::with(first);
    let tidy: editor::layout::Tidy = |behaviour, stage| editor::layout::tidy(behaviour, crate::page::SIZES, stage);
    assert!(table.does(AIKO, |page| page.input(|editor| editor.lay_out_with(tidy))));
    let (_, before) = table.does(AIKO, |page| page.input(editor::Editor::ground));
    assert!(before[&id("ball")].y < before[&id("close")].y);
    table.does(AIKO, |page| page.input(|editor| editor.move_to(&[(id("touch"), FAR)])));
    let (_, after) = table.does(AIKO, |page| page.input(editor::Editor::ground));
    assert_eq!((after[&id("ball")], after[&id("touch")]), (before[&id("ball")], FAR));
}

#[test]
fn everything_is_laid_out_afresh_as_one_step() {
    let mut table = Table::sketched();
    let tidy: editor::layout::Tidy = |behaviour, stage| editor::layout::tidy(behaviour, crate::page::SIZES, stage);
    table.does(AIKO, |page| page.input(|editor| editor.tidy(tidy)));
    assert_eq!(said(&table.editor(AIKO).undoable).as_deref(), Some("Tidy"));
    table.undo(AIKO);
    assert_eq!(table.program(), &sketch());
}

#[test]
fn a_program_of_the_past_is_only_looked_at() {
    let mut table = Table::sketched();
    let past = Behaviour { records: sketch().records.into_iter().filter(|(key, _)| key.id != id("touch")).collect() };
    table.does(AIKO, |page| page.input(|editor| editor.select(Some(stream("touch")))));
    table.does(AIKO, |page| page.input(|editor| editor.show_past(Some(past))));
    assert_eq!(table.selected(AIKO), None, "it was not there then");
    assert!(table.editor(AIKO).shown(&stream("touch").record()).is_none());
    table.does(AIKO, |page| page.input(|editor| editor.show_past(None)));
    assert!(table.editor(AIKO).shown(&stream("touch").record()).is_some());
    assert_eq!(table.program(), &sketch());
}

#[test]
fn the_walkthrough_is_built_by_gestures_and_is_the_same_for_both() {
    let mut table = Table::with(Behaviour::default());
    table.gesture(AIKO, |editor, op| editor.add_sensor(op, ("RedBall", "RedBall"), Params::new(), None));
    let ball = table.named("RedBall").to_string();
    let distance = connectors::map::SPEC.with(Procedure::body("redBall.size * 2"));
    table.gesture(AIKO, |editor, op| editor.connect(op, plan(&[&ball], distance, "Distance")));
    let from = table.named("Distance").to_string();
    table.gesture(BEN, |editor, op| editor.connect(op, plan(&[&from], filter("distance < 20"), "Close")));
    let output = Output::New { name: "Tracker".to_owned(), device: Some("Tracker".to_owned()), params: Params::new() };
    let (operation, inputs) = (connectors::to_action().with(()), vec![table.named("Close")]);
    table
        .gesture(BEN, |editor, op| editor.connect(op, ConnectPlan { operation, inputs, output, spot: NewSpot::Below }));
    assert_eq!(table.names(), ["RedBall", "Distance", "Close", "Tracker"]);
    assert_eq!(
        ["Distance", "Close", "Tracker"].map(|name| table.sources(name).concat()),
        ["RedBall", "Distance", "Close"]
    );
    let heights = ["RedBall", "Distance", "Close", "Tracker"].map(|name| table.place(name).y);
    assert!(heights.is_sorted_by(|one, other| one < other), "{heights:?}");
    assert_eq!(table.editor(AIKO).confirmed(), table.editor(BEN).confirmed());
    assert_eq!(
        [AIKO, BEN].map(|who| said(&table.editor(who).undoable)),
        [Some("Add map"), Some("Add subscribe")].map(|label| label.map(str::to_owned))
    );
}

#[test]
fn who_may_only_look_changes_nothing_by_any_gesture_and_hears_why() {
    let mut table = Table::sketched();
    let made = grouped(&mut table, &["distance", "close"]);
    table.gesture(AIKO, |editor, op| editor.fold(op, &made, true));
    let before = table.program().clone();
    let no = protocol::Refused::Role(protocol::Role::Editor);
    table.pages[BEN].refused = Some(no.clone());
    let seen = table.program().stream(&id("touch")).cloned().unwrap();
    let renamed = behaviour::Stream { name: "Head".to_owned(), ..seen.clone() };
    table.gesture(BEN, |editor, op| editor.add_sensor(op, ("HeadTouch", "Head"), Params::new(), None));
    table.gesture(BEN, |editor, op| editor.connect(op, plan(&["ball"], filter("ball"), "Seen")));
    table.gesture(BEN, |editor, op| editor.wire(op, &id("touch"), &WireEnd::Stream(id("tracker"))));
    table.gesture(BEN, |editor, op| editor.remove_and_heal(op, &id("distance")));
    table.gesture(BEN, |editor, op| editor.edit_stream(op, (&id("touch"), seen), renamed));
    table.gesture(BEN, |editor, op| editor.remove(op, &stream("touch")));
    table.gesture(BEN, |editor, op| editor.remove_several(op, &streams(&["touch", "ball"])));
    table.gesture(BEN, |editor, op| editor.make_group(op, &streams(&["touch"]), "Group"));
    table.gesture(BEN, |editor, op| editor.ungroup(op, &[Selected::Group(made.clone())].into()));
    table.gesture(BEN, |editor, op| drop(editor.add_note(op, "Ask", FAR)));
    assert_eq!(table.pages[BEN].answers, vec![Err(no); 10]);
    table.forget();
    table.does(BEN, |page| page.input(|editor| editor.move_to(&[(id("touch"), FAR)])));
    let back = RecordId::new(Kind::Place, &id("touch"));
    assert_eq!(table.pages[BEN].redrawn, [back], "it is drawn where it is saved");
    table.gesture(BEN, |editor, op| editor.fold(op, &made, false));
    assert!(!table.editor(BEN).folded.contains(&made), "it is unfolded here only");
    assert!(table.editor(AIKO).folded.contains(&made) && table.editor(BEN).is_saved());
    assert_eq!(table.program(), &before);
}

#[test]
fn who_removed_something_is_named_and_it_is_brought_back_where_it_stood() {
    let mut table = Table::sketched();
    let record = stream("touch").record();
    table.gesture(BEN, |editor, op| editor.remove(op, &stream("touch")));
    assert_eq!(table.editor(AIKO).removed_by.get(&id("touch")).map(|by| by.name.as_str()), Some("Ben"));
    let start = table.does(AIKO, |page| page.input(|editor| editor.change("Bring back")));
    table.does(AIKO, |page| page.input(|editor| editor.bring_back(record.clone(), start)));
    assert!(table.names().contains(&"touch".to_owned()), "{:?}", table.names());
    assert_eq!(table.place("touch").x, 600.0, "where it stood");
}

#[test]
fn several_that_come_too_late_are_decided_one_after_the_other() {
    let mut table = Table::sketched();
    let names = ["touch", "ball"];
    let renamed = |table: &mut Table, who: usize, of: &str, name: &str| {
        let seen = sketch().stream(&id(of)).cloned().unwrap();
        let now = behaviour::Stream { name: name.to_owned(), ..seen.clone() };
        table.gesture(who, |editor, op| editor.edit_stream(op, (&id(of), seen), now));
    };
    table.cut(AIKO);
    names.into_iter().for_each(|of| renamed(&mut table, AIKO, of, &format!("My {of}")));
    names.into_iter().for_each(|of| renamed(&mut table, BEN, of, &format!("His {of}")));
    table.connect(AIKO);
    let kept: Vec<Id> = table.editor(AIKO).conflicts.iter().map(|kept| kept.mine.op.clone()).collect();
    assert_eq!(kept.len(), 2);
    table.does(AIKO, |page| page.input(|editor| editor.keep_mine(&kept[0], id("top"))));
    table.does(AIKO, |page| page.input(|editor| editor.drop_conflict(&kept[1])));
    let names = table.names();
    assert!(names.contains(&"My touch".to_owned()) && names.contains(&"His ball".to_owned()), "{names:?}");
    assert!(table.editor(AIKO).conflicts.is_empty());
}

#[test]
fn an_otherwise_follows_the_test_that_it_is_of_in_the_same_step() {
    let mut first = sketch();
    let rest =
        behaviour::Stream { name: "Otherwise".to_owned(), order: 20, ..first.stream(&id("close")).cloned().unwrap() };
    let leads = behaviour::Connector {
        operation: filter("distance >= 20"),
        inputs: vec![id("distance")],
        output: id("rest"),
        order: 21,
    };
    first.records.insert(RecordId::new(Kind::Stream, &id("rest")), Record::Stream(rest));
    first.records.insert(RecordId::new(Kind::Connector, &id("to-rest")), Record::Connector(leads));
    let mut table = Table::with(first);
    let body = |table: &Table, of: &str| match table
        .program()
        .connector(&id(of))
        .and_then(|made| made.operation.procedure().cloned())
    {
        Some(Procedure::Body { body, .. }) => body,
        other => panic!("{other:?}"),
    };
    let seen = table.program().connector(&id("to-close")).cloned().unwrap();
    let edited = (filter("distance < 40"), vec![id("distance")]);
    table.gesture(AIKO, |editor, op| editor.edit_connector(op, (&id("to-close"), seen), edited, None));
    assert_eq!([body(&table, "to-close"), body(&table, "to-rest")], ["distance < 40", "distance >= 40"]);
    table.undo(AIKO);
    assert_eq!([body(&table, "to-close"), body(&table, "to-rest")], ["distance < 20", "distance >= 20"]);
}

#[test]
fn others_see_who_is_editing_what_until_they_are_done() {
    let mut table = Table::sketched();
    let record = stream("touch").record();
    let number = table.does(AIKO, |page| page.input(|editor| editor.open_editor(record.clone())));
    let shown = |table: &Table| {
        table
            .editor(BEN)
            .locks
            .iter()
            .map(|lock| (lock.name.clone(), lock.records.contains(&record)))
            .collect::<Vec<_>>()
    };
    assert_eq!(shown(&table), [("Aiko".to_owned(), true)]);
    table.does(AIKO, |page| page.input(|editor| editor.close_editor(number)));
    assert!(shown(&table).is_empty());
}

#[test]
fn undo_survives_a_reload_and_takes_back_only_what_is_left_of_it() {
    let mut table = Table::sketched();
    table.does(AIKO, |page| page.input(|editor| editor.move_to(&[(id("touch"), FAR)])));
    table.gesture(BEN, |editor, op| editor.add_sensor(op, ("HeadTouch", "His"), Params::new(), None));
    table.reload(AIKO);
    table.connect(AIKO);
    assert_eq!(said(&table.editor(AIKO).undoable).as_deref(), Some("Move"));
    table.undo(AIKO);
    assert_eq!((table.place("touch").x, table.names().contains(&"His".to_owned())), (600.0, true));
}
