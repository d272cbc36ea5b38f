//! Tests of groups: how streams become one, and what becomes of it.

use super::super::graph_tests::{id, start};
use super::{edited, expanded, grouped, ungrouped, without_empty};
use crate::Selected;
use behaviour::{Behaviour, Connector, Id, Kind, Params, Record, RecordId, Stream, StreamKind, connectors};
use std::collections::BTreeSet;

/// Streams a to d, and a connector from a to b.
fn graph() -> Behaviour {
    let mut made = Behaviour::default();
    for (order, name) in (0..).zip(["a", "b", "c", "d"]) {
        let (kind, name, params) = (StreamKind::Ordinary, name.to_owned(), Params::new());
        let key = RecordId::new(Kind::Stream, &id(&name));
        let stream = Stream { kind, name, device: None, params, order, resources: None, priority: None, hold_ms: None };
        made.records.insert(key, Record::Stream(stream));
    }
    let connector =
        Connector { operation: connectors::merge::SPEC.with(()), inputs: vec![id("a")], output: id("b"), order: 9 };
    made.records.insert(RecordId::new(Kind::Connector, &id("ab")), Record::Connector(connector));
    made
}

fn streams(names: &[&str]) -> BTreeSet<Selected> {
    names.iter().map(|name| Selected::Stream(id(name))).collect()
}

fn with_group(made: &mut Behaviour, of: &[&str], name: &str) {
    let (change, _) = grouped(made, start(), &streams(of), (&id(name), name)).unwrap();
    made.apply(&change);
}

/// Each group with its streams, such as `g:a,b`.
fn groups(made: &Behaviour) -> Vec<String> {
    let told = made.groups().map(|(id, group)| {
        let streams: Vec<&str> = group.streams.iter().map(Id::as_str).collect();
        format!("{id}:{}", streams.join(","))
    });
    told.collect()
}

#[test]
fn chosen_streams_become_a_group_and_leave_the_one_they_were_in() {
    let mut made = graph();
    with_group(&mut made, &["a", "b"], "g");
    with_group(&mut made, &["b", "c"], "h");
    assert_eq!(groups(&made), ["g:a", "h:b,c"]);
    with_group(&mut made, &["a", "d"], "i");
    assert_eq!(groups(&made), ["h:b,c", "i:a,d"], "nothing is left of g");
    assert_eq!(made.groups().next().unwrap().1.title, "h");
    assert!(grouped(&made, start(), &[Selected::Group(id("h"))].into(), (&id("n"), "n")).is_none());
}

#[test]
fn a_group_among_what_is_chosen_takes_the_rest_in() {
    let mut made = graph();
    with_group(&mut made, &["a"], "g");
    let of = [Selected::Group(id("g")), Selected::Stream(id("c"))].into();
    let (change, into) = grouped(&made, start(), &of, (&id("n"), "n")).unwrap();
    made.apply(&change);
    assert_eq!((into, groups(&made)), (id("g"), vec!["g:a,c".to_owned()]));
    let before = made.records.clone();
    made.apply(&change.swapped(id("undo"), "Undo"));
    assert_eq!(groups(&made), ["g:a"]);
    made.apply(&change);
    assert_eq!(made.records, before);
}

#[test]
fn a_group_goes_and_its_streams_stay() {
    let mut made = graph();
    with_group(&mut made, &["a", "b"], "g");
    let mut one = made.clone();
    one.apply(&ungrouped(&made, start(), &streams(&["a"])));
    assert_eq!(groups(&one), ["g:b"]);
    made.apply(&ungrouped(&made, start(), &[Selected::Group(id("g"))].into()));
    assert_eq!((groups(&made).len(), made.streams().count()), (0, 4));
}

#[test]
fn a_group_goes_with_its_last_stream_and_comes_back_with_it() {
    let mut made = graph();
    with_group(&mut made, &["c"], "g");
    let before = made.records.clone();
    let change = without_empty(&made, start().take(&made, RecordId::new(Kind::Stream, &id("c"))));
    made.apply(&change);
    assert_eq!(groups(&made).len(), 0);
    made.apply(&change.swapped(id("undo"), "Undo"));
    assert_eq!(made.records, before);
    let kept = without_empty(&made, start().take(&made, RecordId::new(Kind::Stream, &id("d"))));
    assert_eq!(kept.edits.len(), 1);
}

#[test]
fn what_is_in_a_group_is_meant_with_it() {
    let mut made = graph();
    with_group(&mut made, &["a", "b"], "g");
    let all = expanded(&made, &[Selected::Group(id("g"))].into());
    let inside = streams(&["a", "b"]).into_iter().chain([Selected::Connector(id("ab")), Selected::Group(id("g"))]);
    assert_eq!(all, inside.collect());
    made.apply(&edited(&made, start(), &id("g"), |group| group.folded = true));
    assert!(made.groups().next().unwrap().1.folded);
}
