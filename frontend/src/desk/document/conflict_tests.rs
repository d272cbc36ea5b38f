//! Tests of refused changes.

use crate::naming;
use behaviour::{
    Accepted, Behaviour, Change, Connector, Id, Kind, Params, Procedure, Record, RecordId, Refusal, Stream, StreamKind,
    connectors,
};
use editor::{build, graph};

use editor::conflict::{Conflict, beside, brought_back, is_shown_beside, since_seen};

fn id(text: &str) -> Id {
    Id::new(text).unwrap()
}

fn stream_key(name: &str) -> RecordId {
    RecordId::new(Kind::Stream, &id(name))
}

fn filter_key() -> RecordId {
    RecordId::new(Kind::Connector, &id("filter"))
}

fn change(op: &str, author: &str) -> Change {
    Change::of(id(op), author, "Edit")
}

/// Distance, which a filter keeps if it is below 40, as Close.
fn start() -> Behaviour {
    let stream = |name: &str| {
        let (device, resources, priority, hold_ms) = (None, None, None, None);
        let (kind, params, name) = (StreamKind::Ordinary, Params::new(), name.to_owned());
        Record::Stream(Stream { kind, name, device, params, order: 0, resources, priority, hold_ms })
    };
    let operation = connectors::filter::SPEC.with(Procedure::body("distance < 40"));
    let filter = Connector { operation, inputs: vec![id("d")], output: id("c"), order: 0 };
    let mut behaviour = Behaviour::default();
    behaviour.records.insert(stream_key("d"), stream("Distance"));
    behaviour.records.insert(stream_key("c"), stream("Close"));
    behaviour.records.insert(filter_key(), Record::Connector(filter));
    behaviour
}

fn with_test(behaviour: &Behaviour, op: &str, author: &str, body: &str) -> Change {
    let filter = behaviour.connector(&id("filter")).unwrap();
    let operation = connectors::filter::SPEC.with(Procedure::body(body));
    let change = change(op, author);
    build::connector_edited(behaviour, change, (&id("filter"), filter), (operation, filter.inputs.clone()), None)
}

fn renamed(behaviour: &Behaviour, op: &str, stream: &str, name: &str) -> Change {
    let now = behaviour.stream(&id(stream)).unwrap().clone();
    build::stream_edited(behaviour, change(op, "Aiko"), &id(stream), Stream { name: name.into(), ..now })
}

fn test_of(behaviour: &Behaviour) -> String {
    behaviour.connector(&id("filter")).unwrap().operation.chosen().join(" ")
}

/// Makes changes one after the other, as the server does.
fn made(behaviour: &mut Behaviour, changes: Vec<Change>) -> Vec<Accepted> {
    let accepted = (1..).zip(changes).map(|(revision, change)| {
        behaviour.apply(&change);
        Accepted { revision, change }
    });
    accepted.collect()
}

fn conflict(mine: Change, theirs: Vec<Accepted>, now: &Behaviour) -> Conflict {
    let theirs = since_seen(theirs, &mine);
    Conflict::of(id("b"), mine, (5.0, true), theirs, now).unwrap()
}

/// The behaviour after *Keep mine*; nothing that is there now may be overwritten unseen.
fn kept(conflict: &Conflict, now: &Behaviour) -> Behaviour {
    let top = conflict.on_top(now, change("top", "Aiko"), naming::followed);
    for edit in &top.edits {
        assert_eq!(now.records.get(&edit.id), edit.before.as_ref(), "it is on top of what there is");
    }
    let mut after = now.clone();
    after.apply(&top);
    after
}

#[test]
fn both_edit_one_test_and_mine_goes_on_top_of_theirs() {
    let mut now = start();
    let mine = with_test(&now, "mine", "Aiko", "distance < 30");
    let theirs = with_test(&now, "yuki", "Yuki", "distance < 35");
    let theirs = made(&mut now, vec![theirs]);
    let conflict = conflict(mine, theirs, &now);
    assert_eq!((conflict.about.clone(), conflict.is_removed(&now)), (filter_key(), false));
    assert_eq!(conflict.last_of_theirs().unwrap().author, "Yuki");
    assert_eq!(test_of(&kept(&conflict, &now)), "distance < 30");
}

#[test]
fn what_only_they_changed_stays_theirs() {
    let mut now = start();
    let mine = with_test(&now, "mine", "Aiko", "distance < 30");
    let mut theirs = change("yuki", "Yuki");
    let filter = now.connector(&id("filter")).unwrap().clone();
    theirs = theirs.put(&now, filter_key(), Record::Connector(Connector { order: 7, ..filter }));
    let theirs = made(&mut now, vec![theirs]);
    let after = kept(&conflict(mine, theirs, &now), &now);
    assert_eq!((test_of(&after).as_str(), after.connector(&id("filter")).unwrap().order), ("distance < 30", 7));
}

#[test]
fn a_new_name_is_followed_in_the_text_that_there_is_now() {
    let mut now = start();
    let mine = renamed(&now, "mine", "d", "Far");
    let theirs = with_test(&now, "yuki", "Yuki", "distance < 35");
    let theirs = made(&mut now, vec![theirs]);
    let conflict = conflict(mine, theirs, &now);
    assert_eq!(conflict.about, filter_key(), "the name itself is nobody else's");
    let after = kept(&conflict, &now);
    assert_eq!((after.stream(&id("d")).unwrap().name.as_str(), test_of(&after).as_str()), ("Far", "far < 35"));
}

#[test]
fn what_somebody_removed_comes_back_whole_with_mine_on_top() {
    let mut now = start();
    let mine = with_test(&now, "mine", "Aiko", "distance < 30");
    let gone = build::without_stream(&now, change("yuki", "Yuki"), &id("c"));
    let theirs = made(&mut now, vec![gone]);
    let conflict = conflict(mine, theirs, &now);
    assert!(conflict.is_removed(&now) && now.connectors().next().is_none());
    let after = kept(&conflict, &now);
    assert_eq!((test_of(&after).as_str(), after.streams().count()), ("distance < 30", 2));
}

#[test]
fn a_new_connector_out_of_a_removed_stream_brings_it_back() {
    let mut now = start();
    let plan = crate::desk::document::ConnectPlan {
        operation: connectors::map::SPEC.with(Procedure::body("1")),
        inputs: vec![id("c")],
        output: crate::desk::document::Output::New { name: "One".into(), device: None, params: Params::new() },
        spot: Default::default(),
    };
    let new = (&id("s"), &id("m"));
    let ground = editor::layout::Ground { behaviour: &now, places: &Default::default(), sizes: crate::layout::SIZES };
    let mine = graph::connected(ground, change("mine", "Aiko"), new, plan);
    assert!(is_shown_beside(&mine, &Refusal::MissingStream));
    let gone = build::without_stream(&now, change("yuki", "Yuki"), &id("c"));
    let theirs = made(&mut now, vec![gone]);
    let after = kept(&conflict(mine, theirs, &now), &now);
    assert!(after.stream(&id("c")).is_some() && after.connector(&id("m")).is_some());
}

#[test]
fn removed_by_two_in_turn_both_come_back() {
    let mut now = start();
    let was = now.clone();
    let first = build::without_connector(&now, change("yuki", "Yuki"), &id("filter"));
    now.apply(&first);
    let second = build::without_stream(&now, change("ben", "Ben"), &id("c"));
    let mut there = was.clone();
    let log = made(&mut there, vec![first, second]);
    let wanted = [filter_key(), stream_key("c")];
    let back = brought_back(&there, &log, |whole| {
        wanted.iter().filter(|id| !whole.records.contains_key(id)).cloned().collect()
    });
    assert_eq!(back, was);
}

#[test]
fn only_what_came_after_ones_look_counts_as_theirs() {
    let mut now = start();
    let before = with_test(&now, "old", "Ben", "distance < 41");
    let mut log = made(&mut now, vec![before]);
    let mine = with_test(&now, "mine", "Aiko", "distance < 30");
    let elsewhere = change("far", "Ben").put(&now, stream_key("far"), start().records[&stream_key("d")].clone());
    let theirs = with_test(&now, "yuki", "Yuki", "distance < 35");
    log.extend(made(&mut now, vec![elsewhere, theirs]));
    let since = since_seen(log, &mine);
    assert_eq!(since.iter().map(|accepted| accepted.change.op.clone()).collect::<Vec<_>>(), [id("yuki")]);
}

#[test]
fn a_second_change_on_top_of_a_refused_one_joins_it() {
    let mut now = start();
    let mine = with_test(&now, "mine", "Aiko", "distance < 30");
    let mut as_i_saw = now.clone();
    as_i_saw.apply(&mine);
    let later = with_test(&as_i_saw, "later", "Aiko", "distance < 20");
    let theirs = with_test(&now, "yuki", "Yuki", "distance < 35");
    let theirs = made(&mut now, vec![theirs]);
    let mut conflict = conflict(mine, theirs, &now);
    assert!(conflict.meets(&later));
    conflict.join(later);
    assert_eq!(test_of(&kept(&conflict, &now)), "distance < 20");
}

#[test]
fn when_both_want_the_same_nothing_is_left_to_do() {
    let mut now = start();
    let mine = with_test(&now, "mine", "Aiko", "distance < 35");
    let theirs = with_test(&now, "yuki", "Yuki", "distance < 35");
    let theirs = made(&mut now, vec![theirs]);
    assert!(conflict(mine, theirs, &now).on_top(&now, change("top", "Aiko"), naming::followed).edits.is_empty());
}

#[test]
fn who_was_first_is_known_of_names_and_positions_too() {
    let mut now = start();
    let named = |now: &Behaviour, op: &str, author: &str, name: &str| build::renamed(now, change(op, author), name);
    let mine = named(&now, "mine", "Aiko", "Ours");
    let theirs = named(&now, "yuki", "Yuki", "Hers");
    let log = made(&mut now, vec![theirs]);
    assert_eq!(since_seen(log, &mine).last().unwrap().change.author, "Yuki");
}

#[test]
fn moves_removals_and_other_refusals_are_only_said() {
    let now = start();
    let late = Refusal::Stale("this filter".into());
    let remove = build::without_connector(&now, change("a", "Aiko"), &id("filter"));
    let mine = with_test(&now, "mine", "Aiko", "distance < 35");
    assert!(!is_shown_beside(&remove, &late) && is_shown_beside(&mine, &late));
    assert!(!is_shown_beside(&mine, &Refusal::NameTaken("Close".into())));
    let undo = mine.swapped(id("undo"), "Undo");
    assert!(!is_shown_beside(&undo, &late));
}

#[test]
fn mine_names_what_they_renamed_as_it_is_called_by_now() {
    let mut now = start();
    let mine = with_test(&now, "mine", "Aiko", "distance < 30");
    let theirs = renamed(&now, "yuki", "d", "Far");
    let theirs = made(&mut now, vec![theirs]);
    assert_eq!(test_of(&now), "far < 40");
    assert_eq!(test_of(&kept(&conflict(mine, theirs, &now), &now)), "far < 30");
}

#[test]
fn a_name_that_nobody_typed_follows_what_is_kept() {
    let mut now = start();
    let called = |behaviour: &mut Behaviour, name: &str| {
        let Some(Record::Stream(stream)) = behaviour.records.get_mut(&stream_key("c")) else { panic!() };
        name.clone_into(&mut stream.name);
    };
    called(&mut now, "Distance < 40");
    let mine = with_test(&now, "mine", "Aiko", "distance < 55");
    let theirs = with_test(&now, "yuki", "Yuki", "distance < 42");
    let theirs = renaming(theirs, &now, "Distance < 42");
    let theirs = made(&mut now, vec![theirs]);
    let after = kept(&conflict(mine, theirs.clone(), &now), &now);
    assert_eq!((test_of(&after).as_str(), name_of(&after)), ("distance < 55", "Distance < 55"));

    called(&mut now, "Close");
    let mine = with_test(&start(), "mine", "Aiko", "distance < 55");
    let after = kept(&conflict(mine, theirs, &now), &now);
    assert_eq!(name_of(&after), "Close", "what a person typed stays");
}

/// The change also gives what the filter leads to another name.
fn renaming(change: Change, behaviour: &Behaviour, name: &str) -> Change {
    let stream = behaviour.stream(&id("c")).unwrap().clone();
    change.put(behaviour, stream_key("c"), Record::Stream(Stream { name: name.into(), ..stream }))
}

fn name_of(behaviour: &Behaviour) -> &str {
    &behaviour.stream(&id("c")).unwrap().name
}

#[test]
fn what_both_changed_apart_from_each_other_is_no_conflict() {
    let seen = start().stream(&id("d")).unwrap().clone();
    let mine = Stream { name: "Mine".into(), ..seen.clone() };
    let with = |value: i64| Params::from([("speed".to_owned(), behaviour::Value::Int(value))]);
    let theirs = Stream { params: with(2), ..seen.clone() };
    let both = Stream { params: with(2), ..mine.clone() };
    assert_eq!(beside(&seen, &mine, &theirs), Some(both));
    let theirs = Stream { name: "Theirs".into(), ..seen.clone() };
    assert_eq!(beside(&seen, &mine, &theirs), None);
}

#[test]
fn a_note_a_group_and_the_name_of_a_program_wait_beside_theirs_and_a_move_does_not() {
    let note = |text: &str| Record::Note(behaviour::Note::new(text.to_owned()));
    let group = |title: &str, folded| {
        Record::Group(behaviour::Group { title: title.into(), streams: [id("d")].into(), folded })
    };
    let settings = |name: &str| Record::Settings(behaviour::Settings::named(name));
    let late = Refusal::Stale("it".into());
    let cases = [
        (RecordId::new(Kind::Note, &id("n")), note("Seen"), note("Mine"), true),
        (RecordId::new(Kind::Group, &id("g")), group("Seen", false), group("Mine", false), true),
        (RecordId::new(Kind::Group, &id("g")), group("Seen", false), group("Seen", true), false),
        (RecordId::settings(), settings("Seen"), settings("Mine"), true),
    ];
    for (key, seen, mine, is_shown) in cases {
        let mut now = Behaviour::default();
        now.records.insert(key.clone(), seen);
        let mine = change("mine", "Aiko").put(&now, key.clone(), mine);
        assert_eq!(is_shown_beside(&mine, &late), is_shown, "{key}");
        if is_shown {
            let conflict = conflict(mine.clone(), Vec::new(), &now);
            assert_eq!(
                (&conflict.about, kept(&conflict, &now).records.get(&key)),
                (&key, mine.edits[0].after.as_ref())
            );
        }
    }
}
