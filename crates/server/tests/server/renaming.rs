//! A helper that is used gets another name, and its uses follow: in open and closed programs, and in other helpers.

use crate::house::{House, ball, connect, connector_id, id, make, plain, sentence, stream_id};
use behaviour::{Behaviour, Helper, Id, Kind, Procedure, Record, RecordId, Refusal, connectors};
use protocol::{Event, Refused, answer, request};
use shell::{Client, ClientError};
use std::collections::BTreeSet;

fn helper(name: &str, body: &str) -> Helper {
    Helper { name: name.into(), params: vec!["v".into()], body: body.into(), ..Helper::default() }
}

fn helper_id(text: &str) -> RecordId {
    RecordId::new(Kind::Helper, &id(text))
}

async fn shelve(client: &Client, text: &str, helper: Option<Helper>) -> Result<answer::Saved, ClientError> {
    let edits = vec![(helper_id(text), helper.map(Record::Helper))];
    let change = client.change("Helper", &client.library().records, edits);
    client.ask(request::Propose { behaviour: id("library"), change, tokens: Vec::new() }).await
}

/// A program that uses `near` by its name and in a body, which is open afterwards.
async fn program(client: &Client, name: &str) -> Id {
    let play = make(client, name, None).await;
    client.load(&play).await.unwrap();
    let map = |procedure| connect(connectors::map::SPEC.with(procedure), &["ball"], "far");
    let written =
        connect(connectors::filter::SPEC.with(Procedure::body("near(far) > 1 && far != \"near\"")), &["far"], "out");
    let records = [
        (stream_id("ball"), ball("Ball")),
        (stream_id("far"), plain("Far")),
        (stream_id("out"), plain("Out")),
        (connector_id("named"), map(Procedure::Helper("near".into()))),
        (connector_id("written"), written),
    ];
    for (id, record) in records {
        client.put("Add", id, Some(record)).await.unwrap();
    }
    play
}

async fn rename(client: &Client, seen: Helper, after: Helper) -> Result<answer::HelperRenamed, ClientError> {
    let (seen, after) = (Box::new(seen), Box::new(after));
    client.ask(request::RenameHelper { helper: id("h"), seen, after }).await
}

fn uses(behaviour: &Behaviour) -> Vec<String> {
    let procedure = |name: &str| behaviour.connector(&id(name)).unwrap().operation.procedure().cloned();
    let said = |procedure: Option<Procedure>| match procedure.unwrap() {
        Procedure::Helper(name) => name,
        Procedure::Body { body, .. } => body,
    };
    ["named", "written"].map(|name| said(procedure(name))).into()
}

fn helpers(client: &Client) -> Vec<(String, String)> {
    let library = client.library();
    let own = library.records.helpers().filter(|(id, _)| id.as_str().len() < 3 || id.as_str().len() > 20);
    let mut all: Vec<_> = own.map(|(_, helper)| (helper.name.clone(), helper.body.clone())).collect();
    all.retain(|(name, _)| ["near", "close", "other"].contains(&name.as_str()));
    all.sort();
    all
}

fn pair(name: &str, body: &str) -> (String, String) {
    (name.to_owned(), body.to_owned())
}

#[tokio::test]
async fn uses_follow_in_open_and_closed_programs_and_in_other_helpers() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    shelve(&aiko, "h", Some(helper("near", "v.distance"))).await.unwrap();
    shelve(&aiko, "o", Some(helper("other", "near(v) + 1"))).await.unwrap();
    let closed = program(&aiko, "Closed").await;
    let mut ben = house.person("Ben").await;
    let open = program(&ben, "Open").await;
    program(&aiko, "Not").await;
    let library = aiko.library().revision;
    for (name, procedure) in [("named", Procedure::body("1")), ("written", Procedure::body("true"))] {
        let now = aiko.open().unwrap().records;
        let Some(Record::Connector(mut connector)) = now.records.get(&connector_id(name)).cloned() else { panic!() };
        *connector.operation.procedure_mut().unwrap() = procedure;
        aiko.put("Write", connector_id(name), Some(Record::Connector(connector))).await.unwrap();
    }
    let answer = rename(&aiko, helper("near", "v.distance"), helper("close", "v.distance")).await.unwrap();
    assert_eq!(answer, answer::HelperRenamed { programs: 2, left: Vec::new() });
    let told = ben.until(|reply| matches!(reply, Event::Accepted { behaviour, accepted } if *behaviour == open && accepted.change.author == "Aiko"));
    let Event::Accepted { accepted, .. } = told.await.unwrap() else { panic!() };
    assert_eq!(
        (accepted.change.label.to_string().as_str(), accepted.change.edits.len()),
        ("Rename helper near to close", 2)
    );
    let after = ["close", "close(far) > 1 && far != \"near\""];
    assert_eq!(uses(&ben.open().unwrap().records), after);
    assert_eq!(uses(&aiko.load(&closed).await.unwrap().records), after);
    let both = [pair("close", "v.distance"), pair("other", "close(v) + 1")];
    assert_eq!(helpers(&aiko), both);
    assert_eq!(aiko.library().revision, library + 2, "both names, then one");
    let (_, own) = helpers_by_id(&aiko);
    assert_eq!(own.name, "close", "it keeps its id");
    let answer = rename(&aiko, helper("close", "v.distance"), helper("near", "v.distance")).await.unwrap();
    assert_eq!(answer, answer::HelperRenamed { programs: 2, left: Vec::new() });
    assert_eq!(uses(&aiko.load(&closed).await.unwrap().records), ["near", "near(far) > 1 && far != \"near\""]);
    house.close().await;
}

fn helpers_by_id(client: &Client) -> (RecordId, Helper) {
    let Some(Record::Helper(helper)) = client.library().records.records.get(&helper_id("h")).cloned() else { panic!() };
    (helper_id("h"), helper)
}

#[tokio::test]
async fn what_somebody_is_editing_refuses_before_anything_is_written() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    shelve(&aiko, "h", Some(helper("near", "v.distance"))).await.unwrap();
    program(&aiko, "First").await;
    let ben = house.person("Ben").await;
    let held = program(&ben, "Second").await;
    let records = BTreeSet::from([connector_id("written")]);
    let answer::Locked { grant } = ben.ask(request::Lock { behaviour: held.clone(), records }).await.unwrap();
    let (first, library) = (aiko.open().unwrap(), aiko.library());
    let no = sentence(rename(&aiko, helper("near", "v.distance"), helper("close", "v.distance")).await);
    assert_eq!(no, "Ben is editing this filter in “Second”. Ask, or wait until it is free.");
    assert_eq!((aiko.open().unwrap(), aiko.library()), (first, library));
    ben.ask(request::Unlock { behaviour: held.clone(), token: grant.token }).await.unwrap();
    rename(&aiko, helper("near", "v.distance"), helper("close", "v.distance")).await.unwrap();
    // Asked for: what Ben hears by himself may come a moment after Aiko's answer.
    assert_eq!(uses(&ben.load(&held).await.unwrap().records)[0], "close");
    house.close().await;
}

#[tokio::test]
async fn a_name_that_is_taken_or_none_and_a_helper_that_is_another_are_refused() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let seen = helper("near", "v.distance");
    shelve(&aiko, "h", Some(seen.clone())).await.unwrap();
    shelve(&aiko, "o", Some(helper("other", "v"))).await.unwrap();
    let play = program(&aiko, "Play").await;
    let before = (aiko.open().unwrap(), aiko.library());
    let taken = rename(&aiko, seen.clone(), helper("other", "v.distance")).await;
    assert_eq!(taken, Err(ClientError::No(Refused::Change(Refusal::NameTaken("other".into())))));
    let none = rename(&aiko, seen.clone(), helper("no name", "v.distance")).await;
    assert!(matches!(none, Err(ClientError::No(Refused::Change(_)))), "{none:?}");
    let stale = rename(&aiko, helper("near", "v"), helper("close", "v")).await;
    assert!(matches!(stale, Err(ClientError::No(Refused::Change(Refusal::Stale(_))))), "{stale:?}");
    assert_eq!((aiko.open().unwrap(), aiko.library()), before);
    let answer = rename(&aiko, seen, helper("close", "near(v - 1)")).await.unwrap();
    assert_eq!(answer, answer::HelperRenamed { programs: 1, left: Vec::new() });
    assert_eq!(helpers(&aiko)[0], pair("close", "close(v - 1)"), "what it calls itself follows too");
    assert_eq!(uses(&aiko.load(&play).await.unwrap().records)[0], "close");
    house.close().await;
}
