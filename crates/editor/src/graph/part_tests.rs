//! Tests of the part of a program, and what becomes of it elsewhere.

use super::super::graph_tests::{graph, ground, id, places, start};
use super::ProgramPart;
use crate::Selected;
use crate::layout::tests::SIZES;
use behaviour::{Behaviour, Group, Helper, Id, Kind, Note, Place, Procedure, Record, RecordId};
use std::collections::BTreeSet;

fn both() -> BTreeSet<Selected> {
    [Selected::Stream(id("distance")), Selected::Stream(id("close"))].into()
}

fn part(made: &Behaviour, of: &BTreeSet<Selected>) -> ProgramPart {
    let helper =
        |name: &str| Helper { name: name.into(), params: vec!["b".into()], body: "1".into(), ..Helper::default() };
    ProgramPart::of(made, &places(made), of, &[helper("distance"), helper("other")])
}

fn numbered() -> impl FnMut() -> Id {
    let mut number = 0;
    move || {
        number += 1;
        id(&format!("new-{number}"))
    }
}

#[test]
fn a_part_goes_as_a_text_into_another_program() {
    let made = graph();
    let text = part(&made, &both()).text();
    let copy = ProgramPart::read(&text, serde_json::from_str).unwrap();
    assert_eq!(copy.helpers.len(), 0, "the connector into the part is not in it");
    let other = Behaviour::default();
    let (change, streams) = copy.into(&other, start(), (0.0, 0.0), numbered());
    let mut after = other;
    after.apply(&change);
    assert_eq!((streams.len(), after.streams().count(), after.connectors().count()), (2, 2, 1));
    let (_, filter) = after.connectors().next().unwrap();
    assert_eq!(filter.operation.procedure(), Some(&Procedure::body("distance < 20")));
    for text in ["", "{}", "hello", "{\"format\":\"rrp-part/2\",\"records\":{},\"helpers\":[]}"] {
        assert!(ProgramPart::read(text, serde_json::from_str).is_none(), "{text}");
    }
}

#[test]
fn a_part_put_in_beside_itself_has_names_of_its_own_and_its_bodies_follow() {
    let mut made = graph();
    let of: BTreeSet<Selected> = both().into_iter().chain([Selected::Connector(id("to-distance"))]).collect();
    let copy = part(&made, &of);
    assert_eq!(copy.helpers.len(), 1);
    let shift = copy.to(Place { x: 500.0, y: 100.0 }, SIZES);
    let (change, streams) = copy.into(&made, start(), shift, numbered());
    made.apply(&change);
    let names: Vec<&str> = streams.iter().map(|one| made.stream(one.id()).unwrap().name.as_str()).collect();
    assert!(names.contains(&"Distance 2") && names.contains(&"Close 2"), "{names:?}");
    let bodies = |(_, connector): (&Id, &behaviour::Connector)| format!("{:?}", connector.operation.procedure());
    assert!(made.connectors().map(bodies).any(|body| body.contains("distance2 < 20")));
    let again = made.connectors().filter(|(_, connector)| connector.inputs == [id("ball")]).count();
    assert_eq!(again, 2, "what is outside of the part feeds the copy too");
}

#[test]
fn a_copy_stands_beside_and_covers_nothing() {
    let mut made = graph();
    let (dx, dy) = part(&made, &both()).to_free(ground(&made, &places(&made)));
    assert!(dx > 100.0 && dy == 0.0, "{dx} {dy}");
    let (change, _) = part(&made, &both()).into(&made, start(), (dx, dy), numbered());
    made.apply(&change);
    let all: Vec<Place> = made.streams().filter_map(|(id, _)| made.place(id)).collect();
    for (at, one) in all.iter().enumerate() {
        assert!(all[at + 1..].iter().all(|other| one.x != other.x || one.y != other.y), "{all:?}");
    }
    let again = part(&made, &both()).to_free(ground(&made, &places(&made)));
    assert!(again != (dx, dy), "the next copy goes elsewhere");
}

#[test]
fn a_helper_of_the_same_name_with_another_body_comes_under_a_free_one() {
    let made = graph();
    let of: BTreeSet<Selected> = both().into_iter().chain([Selected::Connector(id("to-distance"))]).collect();
    let helper =
        |name: &str, body: &str| Helper { name: name.into(), body: body.into(), ..part(&made, &of).helpers[0].clone() };
    let used = |part: &ProgramPart| {
        let names = part.records.connectors().filter_map(|(_, connector)| match connector.operation.procedure() {
            Some(Procedure::Helper(name)) => Some(name.clone()),
            _ => None,
        });
        names.collect::<Vec<_>>()
    };
    let (same, new) = part(&made, &of).for_library(&[helper("distance", "1")]);
    assert_eq!((used(&same), new.len()), (vec!["distance".to_owned()], 0));
    let (other, new) = part(&made, &of).for_library(&[helper("distance", "2")]);
    assert_eq!((used(&other), new[0].name.as_str()), (vec!["distance_2".to_owned()], "distance_2"));
    let (known, new) = part(&made, &of).for_library(&[helper("distance", "2"), helper("distance_2", "1")]);
    assert_eq!((used(&known), new.len()), (vec!["distance_2".to_owned()], 0), "it is there already");
    let (absent, new) = part(&made, &of).for_library(&[]);
    assert_eq!((used(&absent), new.len()), (vec!["distance".to_owned()], 1));
}

#[test]
fn a_connector_alone_is_in_no_part() {
    let made = graph();
    let alone = part(&made, &[Selected::Connector(id("to-close"))].into());
    assert!(alone.is_empty() && !alone.holds(&Selected::Connector(id("to-close"))));
    let whole = part(&made, &both());
    assert!(whole.holds(&Selected::Connector(id("to-close"))) && whole.holds(&Selected::Stream(id("close"))));
    assert!(!whole.holds(&Selected::Connector(id("to-distance"))));
}

#[test]
fn notes_and_groups_go_with_what_is_in_them() {
    let mut made = graph();
    let note = Note { text: "Ask Yuki".into(), by: "Aiko".into(), at_ms: 5 };
    let group = |folded| Group { title: "Near".into(), streams: [id("distance"), id("close")].into(), folded };
    let put = |made: &mut Behaviour, kind, name: &str, record| {
        made.records.insert(RecordId::new(kind, &id(name)), record);
    };
    put(&mut made, Kind::Note, "note", Record::Note(note.clone()));
    put(&mut made, Kind::Group, "near", Record::Group(group(false)));
    let mut at = places(&made);
    at.insert(id("note"), Place { x: -300.0, y: 0.0 });
    let of: BTreeSet<Selected> = both().into_iter().chain([Selected::Note(id("note"))]).collect();
    let copy = ProgramPart::read(&ProgramPart::of(&made, &at, &of, &[]).text(), serde_json::from_str).unwrap();
    let (change, chosen) = copy.into(&made, start(), (400.0, 0.0), numbered());
    let mut after = made.clone();
    after.apply(&change);
    assert_eq!((after.notes().count(), after.groups().count(), chosen.len()), (2, 2, 3));
    let (_, copied) = after.groups().find(|(one, _)| **one != id("near")).unwrap();
    assert!(copied.title == "Near" && copied.streams.is_disjoint(&group(false).streams), "{copied:?}");
    assert!(after.notes().all(|(_, other)| *other == note), "who wrote it stays");
    put(&mut made, Kind::Group, "near", Record::Group(group(true)));
    let (_, chosen) = ProgramPart::of(&made, &at, &of, &[]).into(&made, start(), (400.0, 0.0), numbered());
    assert_eq!(chosen.len(), 2, "a folded group is chosen for what is in it: {chosen:?}");
    let half = ProgramPart::of(&made, &at, &[Selected::Stream(id("close"))].into(), &[]);
    assert_eq!(half.records.groups().count(), 0);
}
