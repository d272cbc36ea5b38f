//! Scenes of what is changed where it stands: numbers, comparisons, helpers, durations, settings and names; and of what is put
//! into a program by a part, an edge or a place.

use crate::known::{ARM, BALLS, program};
use crate::page::SIZES;
use crate::server::id;
use crate::sketch::{plan, stream};
use crate::table::{AIKO, BEN, Table};
use behaviour::connectors;
use behaviour::{Id, Parameters, Place, Procedure, Stream, Value};
use editor::graph::{ConnectPlan, Gap, NewSpot, Output, ProgramPart, WireEnd};
use editor::numbers::{NumberTest, number_tests, with_number, with_period, with_text};
use editor::outline::{OutlineRowKind, outline};
use editor::{Editor, Put, Selected};

fn test(table: &Table, of: &str) -> NumberTest {
    let tests = number_tests(&table.body(of)).unwrap_or_else(|| panic!("{of} compares with no number"));
    tests.all[0].clone()
}

/// Aiko turns the number of a test, and rests.
fn turns(table: &mut Table, of: &str, to: impl FnOnce(&NumberTest) -> f64) {
    let test = test(table, of);
    let operation = with_number(&table.connector(of).operation, &test.number_at, to(&test)).expect("it stands there");
    table.operates(AIKO, of, operation);
}

#[test]
fn a_number_is_turned_by_keys_and_each_rest_is_one_change() {
    let mut table = Table::knowing(BALLS);
    turns(&mut table, "c4", |test| test.number + test.step());
    assert_eq!(table.body("c4"), "distance < 0.55");
    turns(&mut table, "c4", |test| test.number + 10.0 * test.step());
    assert_eq!(table.body("c4"), "distance < 1.05");
    turns(&mut table, "c4", |_| 0.7);
    turns(&mut table, "c4", |_| 1.0);
    for before in ["1.0", "0.7", "1.05", "0.55", "0.5"] {
        assert_eq!(table.body("c4"), format!("distance < {before}"));
        table.undo(AIKO);
    }
    assert_eq!(table.program(), &program(BALLS));
    table.sets("close", |seen| Stream { name: "Near ball".to_owned(), ..seen });
    assert_eq!(
        (table.sources("Near ball"), table.body("c4")),
        (vec!["Distance".to_owned()], "distance < 0.5".to_owned())
    );
}

#[test]
fn a_comparison_a_helper_and_a_duration_are_chosen_where_they_stand() {
    let mut table = Table::knowing(BALLS);
    let sign = test(&table, "c4").sign_at;
    let other = with_text(&table.connector("c4").operation, &sign, ">=").expect("it stands there");
    table.operates(AIKO, "c4", other);
    assert_eq!(table.body("c4"), "distance >= 0.5");
    table.undo(AIKO);
    assert_eq!(table.body("c4"), "distance < 0.5");

    let helper = |table: &Table| table.connector("c1").operation.procedure().cloned();
    table.operates(AIKO, "c1", connectors::map::SPEC.with(Procedure::Helper("distance".to_owned())));
    assert_eq!(helper(&table), Some(Procedure::Helper("distance".to_owned())));
    table.undo(AIKO);
    assert_eq!(helper(&table), Some(Procedure::Helper("ball_to_distance".to_owned())));

    let beat = connectors::sample::SPEC.with(Parameters::period(1_000));
    let spot = NewSpot::Into(Gap { connector: id("c5"), input: id("close") });
    let between = ConnectPlan { spot, ..plan(&["close"], beat, "Close ball every second") };
    table.gesture(AIKO, |editor, op| editor.connect(op, between));
    assert_eq!(table.sources("Head and body tracker"), ["Close ball every second"]);
    let (made, seen) = {
        let output = table.named("Close ball every second");
        let found = table.program().connectors().find(|(_, one)| one.output == output);
        found.map(|(id, one)| (id.to_string(), one.clone())).expect("it is made")
    };
    table.operates(AIKO, &made, with_period(&seen.operation, 1_100.0));
    assert_eq!(table.connector(&made).operation.period_ms(), Some(1_100));
    table.undo(AIKO);
    table.undo(AIKO);
    assert_eq!(table.program(), &program(BALLS), "each is one step");
}

#[test]
fn settings_and_names_are_changed_in_place_and_a_name_that_is_taken_stays_as_it_was() {
    let mut table = Table::knowing(BALLS);
    let set = |table: &mut Table, param: &str, value: &str| {
        table.sets("head", |mut seen| {
            seen.params.insert(param.to_owned(), Value::text(value));
            seen
        });
    };
    let shows = |table: &Table| {
        let one = table.stream("head");
        let param = |name: &str| one.params.get(name).and_then(Value::as_text).unwrap_or_default().to_owned();
        [one.name.clone(), param("mode"), param("effector")]
    };
    set(&mut table, "mode", "WholeBody");
    set(&mut table, "effector", "LArm");
    table.sets("head", |seen| Stream { name: "Follow".to_owned(), ..seen });
    assert_eq!(shows(&table), ["Follow", "WholeBody", "LArm"]);
    table.forget();
    table.sets("head", |seen| Stream { name: "Distance".to_owned(), ..seen });
    assert!(table.pages[AIKO].answers[0].is_err(), "there is one already");
    assert_eq!(shows(&table), ["Follow", "WholeBody", "LArm"]);
    table.undo(AIKO);
    assert_eq!(shows(&table), ["Head tracker", "WholeBody", "LArm"]);
    table.undo(AIKO);
    assert_eq!(shows(&table), ["Head tracker", "WholeBody", "None"]);
}

#[test]
fn one_stream_is_duplicated_cut_and_pasted_in_its_program() {
    let mut table = Table::knowing(BALLS);
    table.does(AIKO, |page| page.input(|editor| editor.select(Some(stream("far")))));
    table.gesture(AIKO, |editor, op| {
        let part = editor.part(&editor.chosen(), &[]);
        editor.put_in(op, part, Put::Beside, &[]);
    });
    assert!(table.names().len() == 7 && table.names().contains(&"Far ball 2".to_owned()), "{:?}", table.names());
    let places = table.program().streams().map(|(id, one)| (table.program().place(id).expect("it is placed"), one));
    let places: Vec<(Place, f64)> = places.map(|(place, one)| (place, (SIZES.stream)(one))).collect();
    for (at, (one, width)) in places.iter().enumerate() {
        let covers = |(other, wide): &(Place, f64)| {
            (one.x - other.x).abs() < (width + wide) / 2.0 && (one.y - other.y).abs() < 60.0
        };
        assert!(!places[at + 1..].iter().any(covers), "nothing covers anything: {places:?}");
    }
    table.undo(AIKO);
    assert_eq!(table.program(), &program(BALLS));

    let of = [stream("close")].into();
    let text = table.gesture(AIKO, |editor, op| {
        let part = editor.part(&of, &[]);
        editor.remove_several(op, &of);
        part.text()
    });
    assert!(text.contains("Close ball") && table.names().len() == 5, "{text}");
    let part = ProgramPart::read(&text, serde_json::from_str).expect("it is a part");
    table.gesture(AIKO, |editor, op| editor.put_in(op, part, Put::At(Place { x: 500.0, y: 320.0 }), &[]));
    assert_eq!((table.names().len(), table.place("Close ball").y), (6, 320.0), "it is back, under the pointer");
}

#[test]
fn a_connector_is_found_by_its_name_and_goes_where_the_offer_is() {
    let mut table = Table::knowing(BALLS);
    let there = Place { x: 40.0, y: 350.0 };
    let output =
        Output::New { name: "Eye brightness".to_owned(), device: Some("EyeBrightness".to_owned()), params: [].into() };
    let (operation, inputs) = (connectors::to_action().with(()), vec![id("far")]);
    table.gesture(AIKO, |editor, op| {
        editor.connect(op, ConnectPlan { operation, inputs, output, spot: NewSpot::At(there) });
    });
    assert_eq!(table.sources("Eye brightness"), ["Far ball"]);
    let place = table.place("Eye brightness");
    assert!((place.x - there.x).abs() < 14.0 && (place.y - there.y).abs() < 14.0, "{place:?}");

    let spot = NewSpot::Into(Gap { connector: id("c1"), input: id("ball") });
    let settle = connectors::debounce::SPEC.with(Parameters::period(500));
    table.gesture(AIKO, |editor, op| {
        editor.connect(op, ConnectPlan { spot, ..plan(&["ball"], settle, "Ball settled") })
    });
    assert_eq!(
        (table.sources("Ball settled"), table.sources("Distance")),
        (vec!["Ball".to_owned()], vec!["Ball settled".to_owned()])
    );
}

/// The rows of the list, each with what it hangs below as blanks.
fn rows(table: &Table, who: usize) -> Vec<String> {
    let editor = table.editor(who);
    let behaviour = editor.shown_behaviour();
    let called = |what: &OutlineRowKind| match what {
        OutlineRowKind::Stream(id) => behaviour.stream(id).map(|one| one.name.clone()),
        OutlineRowKind::Connector(id) => behaviour.connector(id).map(|one| one.operation.word().to_owned()),
        OutlineRowKind::Group(id) => {
            behaviour.groups().find(|(group, _)| *group == id).map(|(_, one)| one.title.clone())
        }
        OutlineRowKind::Note(_) => Some("note".to_owned()),
    };
    let row =
        |what: &OutlineRowKind, depth: usize| format!("{}{}", " ".repeat(depth), called(what).unwrap_or_default());
    outline(&behaviour, |id| editor.folded.contains(id)).iter().map(|one| row(&one.what, one.depth)).collect()
}

#[test]
fn a_list_in_place_of_the_graph_connects_and_inserts() {
    let mut table = Table::knowing(BALLS);
    let body = |table: &Table| rows(table, BEN).iter().filter(|row| row.ends_with("Head and body tracker")).count();
    assert_eq!(body(&table), 1);
    table.gesture(AIKO, |editor, op| editor.wire(op, &id("far"), &WireEnd::Stream(id("body"))));
    assert_eq!(body(&table), 2, "it leads there too");
    let spot = NewSpot::Into(Gap { connector: id("c3"), input: id("far") });
    let beat = connectors::sample::SPEC.with(Parameters::period(1_000));
    let between = ConnectPlan { spot, ..plan(&["far"], beat, "Far ball every second") };
    table.gesture(AIKO, |editor, op| editor.connect(op, between));
    let rows = rows(&table, BEN);
    let at = rows.iter().position(|row| row.trim() == "Far ball every second").expect("it is put in");
    assert_eq!(rows[at - 1].trim(), "sample");
    assert_eq!([rows[at + 1].trim(), rows[at + 2].trim()], ["subscribe", "Head tracker"]);
}

#[test]
fn commands_work_on_the_list_in_place_of_the_graph() {
    let mut table = Table::knowing(BALLS);
    let before = rows(&table, AIKO);
    table.does(AIKO, |page| page.input(|editor| editor.select(Some(stream("ball")))));
    table.gesture(AIKO, |editor, op| {
        let part = editor.part(&editor.chosen(), &[]);
        editor.put_in(op, part, Put::Beside, &[]);
    });
    assert_eq!(rows(&table, AIKO).len(), before.len() + 1, "it is there twice");
    assert_eq!(table.selected(AIKO), Some(Selected::Stream(table.named("Ball 2"))));
    table.undo(AIKO);
    assert_eq!((rows(&table, AIKO), table.selected(AIKO)), (before, None), "what was selected went with the undo");
}

#[test]
fn a_folded_group_is_one_row_of_the_list_here_and_not_where_it_is_open() {
    let mut table = Table::knowing(BALLS);
    table.gesture(AIKO, |editor, op| editor.make_group(op, &[stream("far"), stream("close")].into(), "Group"));
    let group = table.program().groups().next().map(|(id, _)| id.clone()).expect("it is made");
    table.gesture(AIKO, |editor, op| editor.fold(op, &group, true));
    table.does(BEN, |page| page.input(|editor| editor.unfold_here(&group)));
    let lists = |who: usize, name: &str| rows(&table, who).iter().any(|row| row.trim() == name);
    assert_eq!([lists(AIKO, "Group"), lists(AIKO, "Far ball"), lists(AIKO, "Head tracker")], [true, false, true]);
    assert_eq!([lists(BEN, "Group"), lists(BEN, "Far ball")], [true, true]);
}

#[test]
fn the_order_of_inputs_changes_and_comes_back() {
    let mut table = Table::knowing(ARM);
    let seen = table.connector("c9");
    let turned: Vec<Id> = seen.inputs.iter().rev().cloned().collect();
    table.gesture(AIKO, |editor, op| {
        editor.edit_connector(op, (&id("c9"), seen.clone()), (seen.operation.clone(), turned), None);
    });
    assert_eq!(table.sources("Arm angle"), ["Ball angle", "Head yaw"]);
    assert_eq!(table.body("c9"), "headYaw + ballAngle", "its body stays");
    table.undo(AIKO);
    assert_eq!(table.program(), &program(ARM));
}

#[test]
fn everything_is_chosen_and_removed_and_the_keyboard_stays_on_the_graph() {
    let mut table = Table::knowing(BALLS);
    table.does(AIKO, |page| page.input(|editor| editor.keyboard_at(Some(stream("close")))));
    table.does(AIKO, |page| page.input(Editor::choose_all));
    assert_eq!(table.editor(AIKO).several.len(), 11, "streams and connectors");
    table.gesture(AIKO, |editor, op| editor.remove_several(op, &editor.chosen()));
    assert_eq!((table.names().len(), table.pages[AIKO].focused.last()), (0, Some(&editor::FocusTarget::Graph)));
    table.undo(AIKO);
    assert_eq!(table.program(), &program(BALLS), "one step brings all of it back");
}
