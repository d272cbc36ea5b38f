//! Hints and their fixes, with the catalogue and the procedures as they are: over all templates, and over behaviours with
//! one fault each.
#![expect(clippy::unwrap_used, reason = "a test may give up")]
#![expect(clippy::print_stdout, reason = "what is said of the templates is read by people")]

#[path = "hints/known.rs"]
mod known;

use behaviour::{
    Behaviour, BehaviourFile, Decision, Declared, Fix, Helper, Id, Kind, Note, Place, Problem, ProblemKind, Record,
    RecordId, Room, Unit, ValueType, fixes, infer, problems,
};
use known::Known;
use std::path::Path;

fn id(text: &str) -> Id {
    Id::new(text).unwrap()
}

/// A behaviour out of its streams and connectors as files write them, with the helpers of a fresh library.
fn behaviour(streams: &str, connectors: &str) -> (Behaviour, Vec<Helper>) {
    let text = format!(
        r#"{{"format":"rrp-behaviour/1","name":"Test","helpers":[],"streams":[{streams}],"connectors":[{connectors}]}}"#
    );
    let file: BehaviourFile = serde_json::from_str(&text).unwrap();
    (file.records(|_| None).unwrap(), robot::shipped_helpers())
}

const BALL: &str = r#"{"id":"ball","kind":"sensor","name":"Ball","device":"RedBall"}"#;
const YAW: &str =
    r#"{"id":"yaw","kind":"sensor","name":"Head yaw","device":"JointPosition","params":{"joint":"HeadYaw"}}"#;
const TOUCH: &str = r#"{"id":"touch","kind":"sensor","name":"Touch","device":"HeadTouch","params":{"release":"yes"}}"#;
const EYES: &str = r#"{"id":"eyes","kind":"actuator","name":"Eyes","device":"EyeBrightness"}"#;
const SAY: &str = r#"{"id":"say","kind":"actuator","name":"Say","device":"SayInput"}"#;
const HELLO: &str = r#"{"id":"hello","kind":"actuator","name":"Hello","device":"SayParameter"}"#;
const HEAD: &str = r#"{"id":"head","kind":"actuator","name":"Follow","device":"Tracker"}"#;
const JOINT: &str =
    r#"{"id":"joint","kind":"actuator","name":"Turn head","device":"SetJointPosition","params":{"joint":"HeadYaw"}}"#;

fn ordinary(id: &str, name: &str) -> String {
    format!(r#"{{"id":"{id}","kind":"ordinary","name":"{name}"}}"#)
}

fn with_body(id: &str, word: &str, from: &str, to: &str, body: &str) -> String {
    let inputs: Vec<String> = from.split(' ').map(|input| format!("{input:?}")).collect();
    format!(r#"{{"id":"{id}","type":"{word}","inputs":[{}],"output":"{to}","body":{body:?}}}"#, inputs.join(","))
}

fn with_helper(id: &str, from: &str, to: &str, helper: &str) -> String {
    format!(r#"{{"id":"{id}","type":"map","inputs":["{from}"],"output":"{to}","helper":"{helper}"}}"#)
}

fn subscribe(id: &str, from: &str, to: &str) -> String {
    format!(r#"{{"id":"{id}","type":"subscribe","inputs":["{from}"],"output":"{to}"}}"#)
}

fn join(all: &[&str]) -> String {
    all.join(",")
}

/// Returns the problems, save of streams that lead nowhere.
fn said((behaviour, helpers): &(Behaviour, Vec<Helper>)) -> Vec<Problem> {
    let all = problems(behaviour, &helpers.iter().collect::<Vec<_>>(), &Known);
    all.into_iter().filter(|problem| problem.kind != ProblemKind::Unused).collect()
}

/// The fixes of the only problem, each tried: it is one change that a room accepts, the problem is gone after it, and
/// taking it back leaves nothing behind.
fn mended(made: &(Behaviour, Vec<Helper>)) -> (String, Vec<(Fix, Behaviour)>) {
    let (behaviour, helpers) = made;
    let found = said(made);
    let [problem] = &found[..] else { panic!("{found:?}") };
    let mut number = 0;
    let mut new_id = || {
        number += 1;
        id(&format!("new{number}"))
    };
    let library: Vec<&Helper> = helpers.iter().collect();
    let offered = fixes(problem, behaviour, &library, &Known, &mut new_id);
    let after = |fix: Fix| {
        let room = Room::open(behaviour.clone(), 1);
        let change = fix.change(id("op"), "Aiko");
        let Decision::Save(saved) = room.propose(5, change.clone(), &Known) else { panic!("{fix:?}") };
        let mut after = behaviour.clone();
        after.apply(&saved.change);
        assert_eq!(said(&(after.clone(), helpers.clone())), [], "{}", fix.kind);
        let file = BehaviourFile::of(&after, &library);
        assert!(engine::Run::build(&file, engine::Limits::default()).is_ok(), "{}", fix.kind);
        let mut back = after.clone();
        back.apply(&change.swapped(id("back"), "Undo"));
        assert_eq!(&back, behaviour);
        (fix, after)
    };
    (problem.to_string(), offered.into_iter().map(after).collect())
}

fn kinds(fixes: &[(Fix, Behaviour)]) -> Vec<String> {
    fixes.iter().map(|(fix, _)| fix.kind.to_string()).collect()
}

fn body_of(behaviour: &Behaviour, connector: &str) -> String {
    behaviour.connector(&id(connector)).unwrap().operation.chosen().remove(0)
}

fn template(path: &Path) -> (Behaviour, Vec<Helper>) {
    let file: BehaviourFile = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    (file.records(|_| None).unwrap(), file.library())
}

fn templates() -> Vec<(String, (Behaviour, Vec<Helper>))> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/behaviours");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.iter().map(|path| (path.file_stem().unwrap().to_string_lossy().into_owned(), template(path))).collect()
}

/// The one that the thesis shows to be wrong (4.4.8) is said to be, and no other.
#[test]
fn of_all_templates_only_the_wrong_one_is_blamed() {
    let mut all = Vec::new();
    for (name, made) in templates() {
        all.extend(said(&made).into_iter().map(|problem| format!("{name}: {problem}")));
    }
    all.iter().for_each(|line| println!("{line}"));
    assert_eq!(
        all,
        ["track_nearest_arm: “Head yaw” is combined with the last “Ball angle”, however long ago that was. Leave out \
          what is too old."]
    );
}

#[test]
fn the_fix_of_the_wrong_template_is_that_of_the_thesis() {
    let made = templates().into_iter().find(|(name, _)| name == "track_nearest_arm").unwrap().1;
    let (_, fixes) = mended(&made);
    assert_eq!(kinds(&fixes), ["Leave out what is older than 1 s."]);
    let after = &fixes[0].1;
    assert_eq!(body_of(after, "c9"), "#{v: headYaw.v + ballAngle.v, t: headYaw.t - ballAngle.t}");
    assert_eq!((after.streams().count(), after.connectors().count()), (17, 15), "as in the one in time");
}

#[test]
fn every_stream_of_a_template_has_a_kind() {
    let made = templates().into_iter().find(|(name, _)| name == "track_nearest_arm_in_time").unwrap().1;
    let types = infer(&made.0, &made.1.iter().collect::<Vec<_>>(), &Known);
    let of = |name: &str| types[&id(name)].clone();
    let radians = |range| ValueType::Number { unit: Some(Unit::Radians), range };
    assert_eq!(of("distance"), ValueType::in_unit(Unit::Metres));
    assert_eq!(of("close").field("d"), Some(ValueType::in_unit(Unit::Metres)));
    assert_eq!(of("timed-angle").field("t"), Some(ValueType::in_unit(Unit::Milliseconds)));
    assert_eq!([of("arm-angle"), of("ball-angle"), of("arm")], [radians(None), radians(None), ValueType::Text]);
    assert_eq!(types.len(), made.0.streams().count());
}

#[test]
fn centimetres_for_metres_are_converted_or_the_helper_is_exchanged() {
    let streams = join(&[BALL, &ordinary("d", "Distance"), &ordinary("b", "Brightness"), EYES]);
    let connectors = join(&[
        &with_helper("c1", "ball", "d", "distance"),
        &with_helper("c2", "d", "b", "distance_to_brightness"),
        &subscribe("c3", "b", "eyes"),
    ]);
    let (problem, fixes) = mended(&behaviour(&streams, &connectors));
    assert_eq!(problem, "Map wants metres, gets cm. Convert it.");
    assert_eq!(kinds(&fixes), ["Convert to metres.", "Use “ball_to_distance” instead."]);
    let after = &fixes[0].1;
    let names: Vec<_> = after.streams().map(|(_, stream)| stream.name.as_str()).collect();
    assert!(names.contains(&"Distance in m"), "{names:?}");
    assert_eq!(body_of(after, "new2"), "distance / 100.0");
    assert_eq!(fixes[0].0.change(id("op"), "Aiko").label, "Convert to metres");
}

#[test]
fn a_percentage_for_a_fraction_is_converted() {
    let battery = r#"{"id":"battery","kind":"sensor","name":"Battery","device":"Battery"}"#;
    let (problem, fixes) = mended(&behaviour(&join(&[battery, EYES]), &subscribe("c1", "battery", "eyes")));
    assert_eq!(problem, "Subscribe wants a number from 0 to 1, gets %. Convert it.");
    assert_eq!(kinds(&fixes), ["Convert to a fraction."]);
    assert_eq!(body_of(&fixes[0].1, "new2"), "battery / 100.0");
}

#[test]
fn an_object_for_a_number_gets_a_helper_between() {
    let streams = join(&[BALL, &ordinary("b", "Brightness"), EYES]);
    let connectors = join(&[&with_helper("c1", "ball", "b", "distance_to_brightness"), &subscribe("c2", "b", "eyes")]);
    let (problem, fixes) = mended(&behaviour(&streams, &connectors));
    assert!(problem.starts_with("Map wants a number in m, gets an object with size, time, x, y."), "{problem}");
    assert_eq!(kinds(&fixes), ["Put “ball_to_distance” between."]);
    let spoken = behaviour(&join(&[BALL, SAY]), &subscribe("c1", "ball", "say"));
    assert!(said(&spoken).iter().any(|problem| matches!(problem.kind, ProblemKind::WrongType { .. })));
}

/// The declaration of a helper by a person counts as much as the knowledge of a shipped one.
#[test]
fn a_helper_of_ones_own_is_known_as_it_was_declared() {
    let streams = join(&[BALL, &ordinary("d", "Distance"), &ordinary("b", "Brightness"), EYES]);
    let connectors = join(&[
        &with_helper("c1", "ball", "d", "distance"),
        &with_helper("c2", "d", "b", "warm"),
        &subscribe("c3", "b", "eyes"),
    ]);
    let (behaviour, mut helpers) = behaviour(&streams, &connectors);
    let own =
        Helper { name: "warm".into(), params: vec!["how_far".into()], body: "how_far".into(), ..Helper::default() };
    helpers.push(own.clone());
    assert_eq!(said(&(behaviour.clone(), helpers.clone())).len(), 1, "what it gives is found out: cm for a brightness");
    let declared = Helper {
        body: "if how_far < 1.0 { 1.0 } else { 0.0 }".into(),
        takes: vec![Declared::In(Unit::Metres)],
        gives: Declared::In(Unit::Fraction),
        ..own
    };
    *helpers.last_mut().unwrap() = declared;
    let (problem, fixes) = mended(&(behaviour.clone(), helpers.clone()));
    assert_eq!(problem, "Map wants metres, gets cm. Convert it.");
    assert_eq!(kinds(&fixes), ["Convert to metres.", "Use “ball_to_distance” instead."]);
    let types = infer(&behaviour, &helpers.iter().collect::<Vec<_>>(), &Known);
    assert_eq!(types[&id("b")], ValueType::in_unit(Unit::Fraction));
}

/// A kind that nobody can tell before is told once it was seen.
#[test]
fn what_was_seen_tells_what_nobody_knew() {
    let streams = join(&[&ordinary("text", "Words"), &ordinary("b", "Brightness"), BALL, EYES]);
    let connectors = join(&[
        &with_body("c1", "map", "ball", "text", r#"if ball.x > 0.0 { "left" } else { 1 }"#),
        &with_helper("c2", "text", "b", "distance_to_brightness"),
        &subscribe("c3", "b", "eyes"),
    ]);
    let (behaviour, helpers) = behaviour(&streams, &connectors);
    assert_eq!(said(&(behaviour.clone(), helpers.clone())), []);
    let library: Vec<&Helper> = helpers.iter().collect();
    let seen = behaviour::SeenKinds::from([(id("text"), ValueType::Text)]);
    let found = behaviour::problems_seeing(&behaviour, &library, &Known, &seen);
    assert!(matches!(&found[..], [problem] if matches!(problem.kind, ProblemKind::WrongType { .. })), "{found:?}");
    let known = behaviour::infer_seeing(&behaviour, &library, &Known, &seen);
    assert_eq!(known[&id("text")], seen[&id("text")]);
}

#[test]
fn an_object_compared_with_a_number_is_told_with_its_parts() {
    let streams = join(&[BALL, &ordinary("near", "Near"), HEAD]);
    let made = |body: &str| {
        let test = with_body("c1", "filter", "ball", "near", body);
        behaviour(&streams, &join(&[&test, &subscribe("c2", "near", "head")]))
    };
    let (problem, fixes) = mended(&made("ball < 0.5"));
    assert_eq!(problem, "“ball” is an object, and here a number is wanted. Use a part of it.");
    assert_eq!(kinds(&fixes)[0], "Use “ball.size”.");
    assert!(kinds(&fixes).contains(&"Use “distance(ball)”.".to_owned()), "{:?}", kinds(&fixes));
    assert_eq!(body_of(&fixes[0].1, "c1"), "ball.size < 0.5");
    let both = mended(&made("ball.x < 0.2 && ball < 0.5")).1;
    assert_eq!(body_of(&both[0].1, "c1"), "ball.x < 0.2 && ball.size < 0.5");
    assert_eq!(said(&made("ball.size < 0.5")), []);
}

#[test]
fn units_that_measure_something_else_are_not_converted() {
    let streams = join(&[BALL, &ordinary("d", "Distance"), JOINT]);
    let made = behaviour(
        &streams,
        &join(&[&with_helper("c1", "ball", "d", "ball_to_distance"), &subscribe("c2", "d", "joint")]),
    );
    let (problem, fixes) = mended(&made);
    assert_eq!(problem, "Subscribe wants radians, gets m. Choose another value.");
    assert!(fixes.is_empty());
}

#[test]
fn two_actions_with_one_head_fight_unless_told_apart() {
    let streams = join(&[BALL, &ordinary("x", "Side"), &ordinary("near", "Near"), HEAD, JOINT]);
    let side = with_body("c1", "map", "ball", "x", "ball.x");
    let both = join(&[&side, &subscribe("c2", "x", "joint"), &subscribe("c3", "ball", "head")]);
    let (problem, fixes) = mended(&behaviour(&streams.replace(&(ordinary("near", "Near") + ","), ""), &both));
    assert!(problem.starts_with("“Turn head” and “Follow” want the head at the same time"), "{problem}");
    assert_eq!(kinds(&fixes), ["Give “Follow” the first place.", "Give “Turn head” the first place."]);
    let far = ordinary("far", "Far");
    let apart = join(&[
        &with_body("c0", "filter", "ball", "near", "ball.size > 0.1"),
        &with_body("c4", "filter", "ball", "far", "ball.size <= 0.1"),
        &with_body("c1", "map", "near", "x", "near.x"),
        &subscribe("c2", "x", "joint"),
        &subscribe("c3", "far", "head"),
    ]);
    assert_eq!(said(&behaviour(&join(&[&streams, &far]), &apart)), []);
}

#[test]
fn letting_go_is_no_touch() {
    let (problem, fixes) = mended(&behaviour(&join(&[TOUCH, HELLO]), &subscribe("c1", "touch", "hello")));
    assert!(problem.starts_with("“Hello” also acts when “Touch” is let go."), "{problem}");
    assert_eq!(kinds(&fixes), ["Only when touched."]);
    assert_eq!(body_of(&fixes[0].1, "new2"), "touch");
    let told = TOUCH.replace("yes", "no");
    assert_eq!(said(&behaviour(&join(&[&told, HELLO]), &subscribe("c1", "touch", "hello"))), []);
}

#[test]
fn words_take_longer_than_pictures() {
    let (problem, fixes) = mended(&behaviour(&join(&[BALL, HELLO]), &subscribe("c1", "ball", "hello")));
    assert!(problem.starts_with("“Ball” tells “Hello” many times a second"), "{problem}");
    assert_eq!(kinds(&fixes), ["Once a second.", "Only when it changes."]);
    let after = &fixes[0].1;
    assert_eq!(after.connector(&id("new2")).unwrap().operation.period_ms(), Some(1_000));
}

#[test]
fn a_mistyped_name_is_written_as_it_was_meant() {
    let streams = join(&[BALL, &ordinary("x", "Side"), JOINT]);
    let made = |body: &str| {
        behaviour(&streams, &join(&[&with_body("c1", "map", "ball", "x", body), &subscribe("c2", "x", "joint")]))
    };
    for (body, wanted, blocks) in [
        ("bal.x + 0.1", "ball.x + 0.1", true),
        ("siin(ball.x)", "sin(ball.x)", false),
        ("ball_to_distnace(ball) * 0.1", "ball_to_distance(ball) * 0.1", false),
        ("ball.siez * 1.0", "ball.size * 1.0", false),
    ] {
        let made = made(body);
        assert_eq!(said(&made)[0].blocks, blocks, "{body}");
        let (_, fixes) = mended(&made);
        assert_eq!(body_of(&fixes[0].1, "c1"), wanted);
    }
    let far = made("qwertyuiop(ball)");
    assert_eq!(said(&far), [], "nobody knows what is meant");
}

/// Ten thousand records with the longest procedures take no time that anybody notices, and no stack.
#[test]
fn a_huge_behaviour_is_looked_at_within_bounds() {
    let long = format!("ball.x{}", " + 1.0".repeat(1_000));
    let mut streams = vec![BALL.to_owned(), YAW.to_owned(), EYES.to_owned()];
    let mut connectors = Vec::new();
    for at in 0..1_000 {
        streams.push(ordinary(&format!("s{at}"), &format!("S{at}")));
        let from = if at == 0 { "ball".to_owned() } else { format!("s{}", at - 1) };
        let body = if at % 2 == 0 { long.as_str() } else { "x.y.z" };
        let args = body.replace("ball", "v").replace("x.y", "v.y");
        let connector = with_body(&format!("c{at}"), "map", &from, &format!("s{at}"), &args);
        connectors.push(connector.replace("\"body\"", "\"args\":[\"v\"],\"body\""));
    }
    let made = behaviour(&streams.join(","), &connectors.join(","));
    let types = infer(&made.0, &[], &Known);
    assert_eq!((types.len(), &types[&id("s999")]), (1_003, &ValueType::Any));
    assert!(made.0.records.contains_key(&RecordId::new(behaviour::Kind::Stream, &id("s999"))));
}

/// A new stream has a row of its own: what stands below moves down in the same change, notes too, and nothing else does.
#[test]
fn what_is_put_between_makes_room_for_itself() {
    let streams = join(&[BALL, &ordinary("b", "Brightness"), EYES]);
    let connectors = join(&[&with_helper("c1", "ball", "b", "distance_to_brightness"), &subscribe("c2", "b", "eyes")]);
    let places = |made: &Behaviour| {
        let place = |of: &str| match made.records.get(&RecordId::new(Kind::Place, &id(of))) {
            Some(Record::Place(place)) => (place.x, place.y),
            other => panic!("{of}: {other:?}"),
        };
        ["ball", "new1", "b", "eyes", "note", "high"].map(place)
    };
    let made = |rows: [f64; 3]| {
        let (mut made, helpers) = behaviour(&streams, &connectors);
        let spots = [("ball", 0.0), ("b", rows[0]), ("eyes", rows[1]), ("note", rows[2]), ("high", 0.0)];
        for (of, y) in spots {
            made.records.insert(RecordId::new(Kind::Place, &id(of)), Record::Place(Place { x: 20.0, y }));
        }
        for note in ["note", "high"] {
            made.records.insert(RecordId::new(Kind::Note, &id(note)), Record::Note(Note::new("Look".into())));
        }
        let (_, fixes) = mended(&(made, helpers));
        places(&fixes[0].1).map(|(_, y)| y)
    };
    assert_eq!(made([140.0, 280.0, 200.0]), [0.0, 140.0, 280.0, 420.0, 340.0, 0.0]);
    assert_eq!(made([280.0, 420.0, 300.0]), [0.0, 140.0, 280.0, 420.0, 300.0, 0.0], "there is room");
}

const SHOW: &str = r#"{"id":"show","kind":"actuator","name":"Show","device":"Print"}"#;
const SONAR: &str = r#"{"id":"sonar","kind":"sensor","name":"Sonar","device":"Sonar"}"#;

/// A filter over the sonar, and what is said of it.
fn tested(body: &str) -> (Behaviour, Vec<Helper>) {
    let streams = join(&[SONAR, &ordinary("near", "Near"), EYES]);
    behaviour(
        &streams,
        &join(&[&with_body("test", "filter", "sonar", "near", body), &subscribe("sub", "near", "eyes")]),
    )
}

#[test]
fn a_filter_that_can_never_answer_is_told_before_start() {
    let about = |body: &str| {
        let found = said(&tested(body)).into_iter().filter(|problem| problem.at.id == id("test"));
        found.map(|problem| problem.to_string()).collect::<Vec<_>>()
    };
    let cases = [
        ("sonar = 0.5", "“=” stores a value, and a test compares with “==”. Write “==”."),
        ("sonar > 0.1 && sonar = 0.5", "“=” stores a value, and a test compares with “==”. Write “==”."),
        ("\"near\"", "A test must give true or false, and this one gives a text. Compare it with something."),
        ("sonar * 2.0", "A test must give true or false, and this one gives a number. Compare it with something."),
        ("sonar < 1/2", "“1/2” is 0: of whole numbers, what is left over is lost. Write “1.0/2”."),
        ("sonar < 0,5", "The procedure of filter cannot run: “0,5” means 0.5 here; write it so."),
    ];
    for (body, wanted) in cases {
        assert_eq!(about(body), [wanted], "{body}");
    }
    for body in ["sonar < 0.5", "let far = 0.5; sonar < far", "sonar == 4/2", "!(sonar < 1.0)"] {
        assert_eq!(about(body), [""; 0], "{body}");
    }
}

/// Returns what each fix of the problem of the filter writes.
fn written(body: &str) -> Vec<String> {
    let (behaviour, helpers) = tested(body);
    let library: Vec<&Helper> = helpers.iter().collect();
    let all = problems(&behaviour, &library, &Known);
    let problem = all.iter().find(|problem| problem.at.id == id("test")).unwrap();
    let offered = fixes(problem, &behaviour, &library, &Known, &mut || id("new"));
    let after = |fix: Fix| {
        let mut after = behaviour.clone();
        after.apply(&fix.change(id("op"), "Aiko"));
        body_of(&after, "test")
    };
    offered.into_iter().map(after).collect()
}

#[test]
fn what_is_meant_is_one_press_away() {
    assert_eq!(written("sonar = 0.5"), ["sonar == 0.5"]);
    assert_eq!(written("sonar < 1/2"), ["sonar < 1.0/2"]);
    assert_eq!(written("sonar ≤ 0,5"), ["sonar <= 0.5"]);
    assert_eq!(written("sonar < 1,000"), ["sonar < 1000", "sonar < 1.0"]);
    assert_eq!(written("\"near\""), [""; 0]);
}

#[test]
fn an_otherwise_that_is_none_any_more_is_told_and_follows_again() {
    let streams = join(&[SONAR, &ordinary("near", "Near"), &ordinary("far", "Otherwise"), SHOW]);
    let made = |body: &str| {
        let tests = [
            with_body("test", "filter", "sonar", "near", "sonar < 0.45"),
            with_body("other", "filter", "sonar", "far", body),
        ];
        behaviour(&streams, &join(&[&tests[0], &tests[1], &subscribe("s1", "near", "show")]))
    };
    assert_eq!(said(&made("sonar >= 0.45")), []);
    assert_eq!(said(&made("!(sonar < 0.45)")), []);
    let (told, fixes) = mended(&made("sonar >= 0.4"));
    assert!(
        told.starts_with("“Otherwise” is not the other side of “Near”: some values pass both, or neither."),
        "{told}"
    );
    assert_eq!(body_of(&fixes[0].1, "other"), "sonar >= 0.45");
}
