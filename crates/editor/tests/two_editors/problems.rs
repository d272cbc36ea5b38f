//! Scenes of what is wrong with a program: it is told as soon as it is so, mended by one change, and one undo brings it back.

use crate::known::{ARM, Known, program};
use crate::page::SIZES;
use crate::scenes::said;
use crate::server::id;
use crate::sketch::stream;
use crate::table::{AIKO, BEN, Table};
use behaviour::connectors;
use behaviour::{Behaviour, Fix, FixKind, Helper, Kind, Problem, ProblemKind, Record, RecordId, Unit, fixes, problems};
use editor::graph::{ConnectPlan, Gap, NewSpot, Output, WireEnd};
use phrase::Phrased;
use std::collections::BTreeSet;

const BALL: &str = r#"{"id":"ball","kind":"sensor","name":"Red ball","device":"RedBall"}"#;
const EYES: &str = r#"{"id":"eyes","kind":"actuator","name":"Eyes","device":"EyeBrightness"}"#;
const HELLO: &str = r#"{"id":"hello","kind":"actuator","name":"Hello","device":"SayParameter"}"#;
const HEAD: &str = r#"{"id":"head","kind":"actuator","name":"Follow","device":"Tracker"}"#;
const JOINT: &str =
    r#"{"id":"joint","kind":"actuator","name":"Turn head","device":"SetJointPosition","params":{"joint":"HeadYaw"}}"#;

fn ordinary(id: &str, name: &str) -> String {
    format!(r#"{{"id":"{id}","kind":"ordinary","name":"{name}"}}"#)
}

fn by_helper(id: &str, from: &str, to: &str, helper: &str) -> String {
    format!(r#"{{"id":"{id}","type":"map","inputs":["{from}"],"output":"{to}","helper":"{helper}"}}"#)
}

fn by_body(id: &str, from: &str, to: &str, body: &str) -> String {
    format!(r#"{{"id":"{id}","type":"map","inputs":["{from}"],"output":"{to}","body":"{body}"}}"#)
}

fn leads(id: &str, from: &str, to: &str) -> String {
    format!(r#"{{"id":"{id}","type":"subscribe","inputs":["{from}"],"output":"{to}"}}"#)
}

/// Two people at a program that may have problems, and the library.
struct Mending {
    table: Table,
    helpers: Vec<Helper>,
}

impl Mending {
    fn of(streams: &[&str], connectors: &[&str]) -> Self {
        let (streams, connectors) = (streams.join(","), connectors.join(","));
        Self::file(&format!(
            r#"{{"format":"rrp-behaviour/1","name":"Test","helpers":[],"streams":[{streams}],"connectors":[{connectors}]}}"#
        ))
    }

    fn file(file: &str) -> Self {
        Self { table: Table::knowing(file), helpers: robot::shipped_helpers() }
    }

    fn library(&self) -> Vec<&Helper> {
        self.helpers.iter().collect()
    }

    /// All that is wrong with the program as it is saved.
    fn wrong(&self) -> Vec<Problem> {
        problems(self.table.program(), &self.library(), &Known)
    }

    /// Returns the ways to mend the first problem.
    fn fixes(&self) -> Vec<Fix> {
        let mut number = 0;
        let mut new_id = || {
            number += 1;
            id(&format!("new{number}"))
        };
        let wrong = self.wrong();
        let problem = wrong.first().expect("something is wrong");
        fixes(problem, self.table.program(), &self.library(), &Known, &mut new_id)
    }

    /// Aiko mends the first problem in this way.
    fn mends(&mut self, kind: &FixKind) {
        let all = self.fixes();
        let fix = all.iter().find(|fix| fix.kind == *kind).unwrap_or_else(|| panic!("{kind:?} is not among {all:?}"));
        let change = fix.change(self.table.pages[AIKO].op(), "Aiko");
        self.table.does(AIKO, |page| {
            page.input(|editor| {
                let change = editor.with_room(change);
                editor.propose(change);
            })
        });
    }

    /// The only problem is mended in this way by one change that both have; one undo brings all back as it was.
    fn mended_by(mut self, kind: &FixKind) -> Self {
        let (before, wrong) = (self.table.program().clone(), self.wrong());
        assert_eq!(wrong.len(), 1, "{wrong:?}");
        self.mends(kind);
        assert_eq!(self.wrong(), [], "nothing is wrong any more");
        assert_eq!(self.table.editor(BEN).confirmed(), self.table.program());
        assert!(said(&self.table.editor(AIKO).undoable).is_some_and(|label| !label.ends_with('.')));
        self.new_streams_have_places(&before);
        self.table.undo(AIKO);
        assert_eq!((self.table.program(), self.wrong()), (&before, wrong));
        self
    }

    fn new_streams_have_places(&self, before: &Behaviour) {
        let now = self.table.program();
        let new = now.streams().filter(|(id, _)| before.stream(id).is_none());
        new.for_each(|(id, stream)| assert!(now.place(id).is_some(), "{} stands nowhere", stream.name));
    }
}

/// A ball's distance in centimetres goes to a brightness that wants metres.
fn wrong_unit(helper: &str) -> Mending {
    Mending::of(
        &[BALL, &ordinary("distance", "Distance"), &ordinary("brightness", "Brightness"), EYES],
        &[
            &by_helper("c1", "ball", "distance", "distance"),
            &by_helper("c2", "distance", "brightness", helper),
            &leads("c3", "brightness", "eyes"),
        ],
    )
}

const TO_METRES: FixKind = FixKind::Convert { from: Unit::Centimetres, to: Unit::Metres };

#[test]
fn a_wrong_unit_is_told_and_mended_by_one_change() {
    let mut mending = wrong_unit("distance_to_brightness").mended_by(&TO_METRES);
    assert_eq!(mending.wrong()[0].at, RecordId::new(Kind::Connector, &id("c2")), "it is told where it is");
    mending.mends(&TO_METRES);
    assert_eq!(mending.table.sources("Brightness"), ["Distance in m"]);
    assert_eq!(mending.table.sources("Distance in m"), ["Distance"]);
}

#[test]
fn what_ones_own_helper_takes_is_known_as_it_was_said() {
    let mut mending = wrong_unit("warm");
    let warm = r#"{"name":"warm","params":["how_far"],"body":"if how_far < 1.0 { 1.0 } else { 0.0 }","takes":["m"],"gives":"fraction"}"#;
    mending.helpers.push(serde_json::from_str(warm).expect("it is a helper"));
    let mut mending = mending.mended_by(&TO_METRES);
    let other = FixKind::UseHelper("ball_to_distance".to_owned());
    mending.mends(&other);
    assert_eq!(mending.wrong(), [], "another helper that gives metres mends it too");
    mending.table.undo(AIKO);
    let warm = mending.helpers.last_mut().expect("it is there");
    warm.takes = vec![behaviour::Declared::In(Unit::Centimetres)];
    assert_eq!(mending.wrong(), [], "it takes centimetres now");
}

#[test]
fn a_wrong_helper_is_told_and_mended_by_one_change() {
    let mending = Mending::of(
        &[BALL, &ordinary("brightness", "Brightness"), EYES],
        &[&by_helper("c1", "ball", "brightness", "distance_to_brightness"), &leads("c2", "brightness", "eyes")],
    );
    mending.mended_by(&FixKind::PutHelper("ball_to_distance".to_owned()));
}

#[test]
fn two_actions_that_fight_are_told_and_told_apart_by_one_change() {
    let mending = Mending::of(
        &[BALL, &ordinary("side", "Side"), HEAD, JOINT],
        &[&by_body("c1", "ball", "side", "redBall.x"), &leads("c2", "side", "joint"), &leads("c3", "ball", "head")],
    );
    mending.mended_by(&FixKind::Prefer("Follow".to_owned()));
}

#[test]
fn a_touch_that_acts_twice_is_told_and_acts_once_after_one_change() {
    let touch = r#"{"id":"touch","kind":"sensor","name":"Touch","device":"HeadTouch","params":{"release":"yes"}}"#;
    Mending::of(&[touch, HELLO], &[&leads("c1", "touch", "hello")]).mended_by(&FixKind::OnlyPressed);
}

#[test]
fn a_sense_faster_than_its_action_is_slowed_down_by_one_change_that_covers_nothing() {
    let mending = Mending::of(&[BALL, HELLO], &[&leads("c1", "ball", "hello")]);
    let mut mending = mending.mended_by(&FixKind::SlowDown(1_000));
    // Nobody placed anything in this file.
    mending.mends(&FixKind::SlowDown(1_000));
    let table = &mut mending.table;
    let (behaviour, places) = table.does(AIKO, |page| page.input(editor::Editor::ground));
    let boxes: Vec<_> = behaviour.streams().map(|(id, stream)| (places[id], (SIZES.stream)(stream))).collect();
    assert_eq!(boxes.len(), 3);
    for (at, (one, width)) in boxes.iter().enumerate() {
        for (other, other_width) in &boxes[at + 1..] {
            let apart = (one.x - other.x).abs() >= (width + other_width) / 2.0 || (one.y - other.y).abs() >= 60.0;
            assert!(apart, "{one:?} covers {other:?}");
        }
    }
}

#[test]
fn an_old_value_in_a_combination_is_told_and_left_out_by_one_change() {
    Mending::file(ARM).mended_by(&FixKind::LeaveOutOld(1_000));
}

#[test]
fn a_name_that_means_nothing_is_told_with_the_one_that_is_meant() {
    let mending = Mending::of(
        &[BALL, &ordinary("side", "Side"), JOINT],
        &[&by_body("c1", "ball", "side", "siin(redBall.x)"), &leads("c2", "side", "joint")],
    );
    let wrong = mending.wrong();
    assert!(
        matches!(&wrong[0].kind, ProblemKind::UnknownName { name, near } if name == "siin" && near == "sin"),
        "{wrong:?}"
    );
    let rename = FixKind::Rename { from: "siin".to_owned(), to: "sin".to_owned() };
    let mut mending = mending.mended_by(&rename);
    mending.mends(&rename);
    assert_eq!(mending.table.body("c1"), "sin(redBall.x)");
}

#[test]
fn what_leads_nowhere_gets_an_action_and_what_gets_nothing_a_source() {
    let mut mending = Mending::of(&[BALL, &ordinary("distance", "Distance")], &[]);
    let kinds = |mending: &Mending| mending.wrong().into_iter().map(|one| one.kind).collect::<Vec<_>>();
    assert_eq!(kinds(&mending), [ProblemKind::Unused, ProblemKind::NoSource, ProblemKind::Unused]);
    let table = &mut mending.table;
    table.gesture(AIKO, |editor, op| editor.wire(op, &id("ball"), &WireEnd::Stream(id("distance"))));
    assert_eq!(table.sources("Distance"), ["Red ball"]);
    let output = Output::New { name: "Tracker".to_owned(), device: Some("Tracker".to_owned()), params: [].into() };
    let (operation, inputs) = (connectors::to_action().with(()), vec![id("distance")]);
    table.gesture(AIKO, |editor, op| {
        editor.connect(op, ConnectPlan { operation, inputs, output, spot: NewSpot::Below });
    });
    assert_eq!(table.sources("Tracker"), ["Distance"]);
    assert_eq!(kinds(&mending), [], "everything leads somewhere");
}

#[test]
fn what_is_left_over_is_told_beside_what_leads_on() {
    let mut mending = Mending::of(
        &[BALL, &ordinary("distance", "Distance"), HEAD],
        &[&by_helper("c1", "ball", "distance", "distance"), &leads("c2", "ball", "head")],
    );
    let at = |mending: &Mending| mending.wrong().into_iter().map(|one| one.at.id.to_string()).collect::<BTreeSet<_>>();
    assert_eq!(at(&mending), ["distance".to_owned()].into());
    mending.table.gesture(AIKO, |editor, op| editor.remove(op, &stream("head")));
    assert_eq!(at(&mending), ["ball", "distance"].map(str::to_owned).into(), "the rest leads nowhere either");
}

#[test]
fn a_way_that_goes_on_without_a_stream_is_told_what_does_not_fit_any_more() {
    let mut mending = Mending::file(crate::known::BALLS);
    assert_eq!(mending.wrong(), []);
    mending.table.gesture(AIKO, |editor, op| editor.remove_and_heal(op, &id("distance")));
    assert_eq!(mending.table.body("c4"), "ball < 0.5");
    let wrong = mending.wrong();
    let objects =
        wrong.iter().filter(|one| matches!(&one.kind, ProblemKind::ObjectAsNumber { name } if name == "ball"));
    assert_eq!(objects.count(), 2, "a ball is no number: {wrong:?}");
    let parts: Vec<String> = mending.fixes().iter().map(|fix| fix.kind.to_string()).collect();
    assert!(parts.iter().any(|part| part.contains("ball.size")), "{parts:?}");
    mending.table.undo(AIKO);
    assert_eq!((mending.table.program(), mending.wrong()), (&program(crate::known::BALLS), Vec::new()));
}

#[test]
fn a_conversion_is_put_into_the_edge_as_one_step() {
    let mut mending = wrong_unit("distance_to_brightness");
    let before = mending.table.program().clone();
    let metres = Unit::Centimetres.convert(Unit::Metres, "distance").expect("they are lengths");
    let operation = connectors::to_new_value().with(behaviour::Procedure::body(&metres));
    let output = Output::New { name: "Distance in m".to_owned(), device: None, params: [].into() };
    let spot = NewSpot::Into(Gap { connector: id("c2"), input: id("distance") });
    let plan = ConnectPlan { operation, inputs: vec![id("distance")], output, spot };
    mending.table.gesture(AIKO, |editor, op| editor.connect(op, plan));
    assert_eq!((mending.table.sources("Brightness"), mending.wrong()), (vec!["Distance in m".to_owned()], Vec::new()));
    mending.table.undo(AIKO);
    assert_eq!(mending.table.program(), &before);
}

#[test]
fn a_bad_edit_is_answered_with_a_clear_sentence_and_changes_nothing() {
    let mut table = Table::knowing(crate::known::BALLS);
    let before = table.program().clone();
    let is_refused = |table: &mut Table, says: &str| {
        let answer = table.pages[AIKO].answers.pop().expect("it is answered");
        let sentence = answer.expect_err("it is refused").phrase().to_string();
        let is_clear = sentence.ends_with('.') && sentence.chars().count() < 300 && !sentence.contains("::");
        assert!(sentence.contains(says) && is_clear, "{sentence}");
        assert_eq!(table.program(), &before, "{sentence}");
        assert_eq!(table.editor(BEN).confirmed(), &before);
        assert!(table.editor(AIKO).conflicts.is_empty() && table.editor(AIKO).is_saved(), "nothing waits");
    };
    table.operates(AIKO, "c4", crate::sketch::filter("redBall.size +"));
    is_refused(&mut table, "This procedure cannot run");
    table.sets("distance", |seen| behaviour::Stream { name: "x".repeat(9_000), ..seen });
    is_refused(&mut table, "is too long");
    table.sets("distance", |seen| behaviour::Stream { name: "Head tracker".to_owned(), ..seen });
    is_refused(&mut table, "There is already a “Head tracker”");

    // What no page offers is answered as well.
    let map = |input: &str, output: &str| {
        let operation = connectors::map::SPEC.with(behaviour::Procedure::body("1"));
        Record::Connector(behaviour::Connector { operation, inputs: vec![id(input)], output: id(output), order: 99 })
    };
    let sense = |device: &str| behaviour::Stream {
        name: "New one".to_owned(),
        device: Some(device.to_owned()),
        ..table.stream("ball")
    };
    let key = |kind: Kind, name: &str| RecordId::new(kind, &id(name));
    let ordinary = Record::Stream(behaviour::Stream { name: "New one".to_owned(), ..table.stream("far") });
    let bad = [
        (vec![(key(Kind::Connector, "c1"), map("far", "distance"))], "in a circle"),
        (vec![(key(Kind::Connector, "way"), map("ball", "distance"))], "already gets its values"),
        (
            vec![(key(Kind::Stream, "new"), ordinary), (key(Kind::Connector, "way"), map("head", "new"))],
            "nothing can come out of it",
        ),
        (vec![(key(Kind::Stream, "new"), Record::Stream(sense("Nose")))], "Nose"),
    ];
    for (records, says) in bad {
        let op = table.pages[AIKO].op();
        table.does(AIKO, |page| {
            page.input(|editor| {
                let now = editor.behaviour();
                let change = behaviour::Change::of(op, "Aiko", "Edit");
                let change = records.into_iter().fold(change, |change, (key, record)| change.put(&now, key, record));
                editor.propose(change);
            })
        });
        is_refused(&mut table, says);
    }
}
