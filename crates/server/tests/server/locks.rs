//! Who is editing what: locks over real sockets, for every way in.

use crate::house::{House, id, plain, sentence, stream_id};
use crate::http::raw;
use behaviour::{AskResult, Grant, Id, LockEndReason, LockEvent, LockToken, RecordId};
use protocol::{Event, LockShown, answer, request};
use shell::{Client, ClientError};
use std::collections::BTreeSet;

/// Aiko and Ben in a behaviour with two streams.
async fn two(house: &House) -> (Client, Client, Id) {
    let (aiko, play) = house.maker("Aiko").await;
    for name in ["a", "b"] {
        aiko.put("Add", stream_id(name), Some(plain(name))).await.unwrap();
    }
    let ben = house.person("Ben").await;
    ben.load(&play).await.unwrap();
    (aiko, ben, play)
}

async fn lock(client: &Client, play: &Id, names: &[&str]) -> Result<answer::Locked, ClientError> {
    let records = names.iter().map(|name| stream_id(name)).collect();
    client.ask(request::Lock { behaviour: play.clone(), records }).await
}

async fn grant(client: &Client, play: &Id, names: &[&str]) -> Grant {
    lock(client, play, names).await.unwrap().grant
}

async fn rename(
    client: &Client,
    play: &Id,
    stream: &str,
    name: &str,
    tokens: &[LockToken],
) -> Result<answer::Saved, ClientError> {
    let change = client.change("Rename", &client.open().unwrap().records, vec![(stream_id(stream), Some(plain(name)))]);
    client.ask(request::Propose { behaviour: play.clone(), change, tokens: tokens.to_vec() }).await
}

/// What everybody is told of the locks once somebody is told that so many are held.
async fn shown(client: &mut Client, many: usize) -> Vec<LockShown> {
    let told = client.until(|reply| matches!(reply, Event::Locks { locks, .. } if locks.len() == many)).await;
    let Event::Locks { locks, .. } = told.unwrap() else { panic!() };
    locks
}

async fn event(client: &mut Client) -> LockEvent {
    let Event::LockNews { event, .. } = client.until(|told| matches!(told, Event::LockNews { .. })).await.unwrap()
    else {
        panic!()
    };
    *event
}

#[tokio::test]
async fn who_is_at_the_computer_takes_over_and_the_other_is_told() {
    let house = House::open().await;
    let (aiko, mut ben, play) = two(&house).await;
    let held = grant(&ben, &play, &["a"]).await;
    let over = request::TakeOver { behaviour: play.clone(), record: stream_id("a") };
    let answer::Locked { grant: taken } = aiko.ask(over).await.unwrap();
    assert!(taken.token > held.token);
    let LockEvent::Freed { why, grant, .. } = event(&mut ben).await else { panic!() };
    assert_eq!((why, grant.token), (LockEndReason::TakenOver { by: "Aiko".into() }, held.token));
    let no = "Aiko is editing “a”. Ask, or wait until it is free.";
    assert_eq!(sentence(rename(&ben, &play, "a", "A", &[held.token]).await), no);
    rename(&aiko, &play, "a", "A", &[taken.token]).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn what_somebody_is_editing_is_refused_to_others_by_name() {
    let house = House::open().await;
    let (aiko, mut ben, play) = two(&house).await;
    let held = grant(&aiko, &play, &["a", "b"]).await;
    let records = BTreeSet::from([stream_id("a"), stream_id("b")]);
    let (client, name) = (aiko.you().client.clone(), "Aiko".to_owned());
    assert_eq!(shown(&mut ben, 1).await, [LockShown { client, name, records, away: false }]);
    let no = "Aiko is editing “a”. Ask, or wait until it is free.";
    assert_eq!(sentence(lock(&ben, &play, &["a"]).await), no);
    assert_eq!(sentence(rename(&ben, &play, "a", "mine", &[]).await), no);
    assert_eq!(sentence(rename(&ben, &play, "a", "mine", &[held.token]).await), no, "a token is of one link");
    assert_eq!(sentence(rename(&aiko, &play, "a", "hers", &[]).await), no, "another editor of her own");
    rename(&aiko, &play, "a", "hers", &[held.token]).await.unwrap();
    ben.put("Add", stream_id("c"), Some(plain("c"))).await.unwrap();
    aiko.ask(request::Unlock { behaviour: play.clone(), token: held.token }).await.unwrap();
    assert_eq!(shown(&mut ben, 0).await, []);
    rename(&ben, &play, "a", "mine", &[]).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn all_or_nothing_is_locked() {
    let house = House::open().await;
    let (aiko, mut ben, play) = two(&house).await;
    grant(&aiko, &play, &["b"]).await;
    assert!(sentence(lock(&ben, &play, &["a", "b"]).await).starts_with("Aiko is editing “b”"));
    assert_eq!(shown(&mut ben, 1).await[0].records, BTreeSet::from([stream_id("b")]));
    let position = BTreeSet::from([RecordId::new(behaviour::Kind::Place, &id("a"))]);
    let no = sentence(aiko.ask(request::Lock { behaviour: play.clone(), records: position }).await);
    assert!(no.starts_with("This cannot be kept for one person."), "{no}");
    let library = id(protocol::LIBRARY);
    assert!(sentence(lock(&aiko, &library, &["a"]).await).starts_with("No program is open."));
    house.close().await;
}

#[tokio::test]
async fn only_what_is_there_is_locked() {
    let house = House::open().await;
    let (aiko, _ben, play) = two(&house).await;
    let no = sentence(lock(&aiko, &play, &["a", "soon"]).await);
    assert_eq!(no, "This is not there any more, or not yet. Look again, and choose what is there.");
    grant(&aiko, &play, &["a"]).await;
    house.close().await;
}

#[tokio::test]
async fn every_way_to_write_is_refused_by_name() {
    let house = House::open().await;
    let (aiko, ben, play) = two(&house).await;
    grant(&aiko, &play, &["a"]).await;
    let no = "Aiko is editing “a”. Ask, or wait until it is free.";
    let tab = house.person("Aiko").await;
    tab.load(&play).await.unwrap();
    assert_eq!(sentence(lock(&tab, &play, &["a"]).await), no, "a second tab");
    for (who, client) in [("the second tab", &tab), ("the console's client", &ben), ("the first tab", &aiko)] {
        assert_eq!(sentence(client.put("Rename", stream_id("a"), Some(plain("mine"))).await), no, "{who}");
        assert_eq!(sentence(client.put("Remove", stream_id("a"), None).await), no, "{who}");
    }
    let carol = house.person("Carol").await;
    let change = carol.change("Rename", &ben.open().unwrap().records, vec![(stream_id("a"), Some(plain("mine")))]);
    let propose = request::Propose { behaviour: play.clone(), change, tokens: Vec::new() };
    assert_eq!(sentence(carol.ask(propose).await), no, "who has not even opened it");
    house.close().await;
}

#[tokio::test]
async fn an_import_never_touches_what_somebody_is_editing() {
    let house = House::open().await;
    let (aiko, ben, play) = two(&house).await;
    grant(&aiko, &play, &["a"]).await;
    let address = house.address;
    let send = |path: &str, body: &str| {
        let head = format!("Host: {address}\r\nOrigin: http://{address}\r\nConnection: close\r\n");
        format!("POST {path} HTTP/1.1\r\n{head}Content-Length: {}\r\n\r\n{body}", body.len())
    };
    let get = format!("GET /api/behaviours/{play}.json HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n");
    let whole = raw(&house, &get).await;
    let file = whole.split_once("\r\n\r\n").unwrap().1.replace("\"a\"", "\"aa\"");
    let before = ben.open().unwrap();
    let kept = raw(&house, &send("/api/import?mode=restore", &file)).await;
    assert!(!kept.starts_with("HTTP/1.1 200"), "it is here already: {kept}");
    let copied = raw(&house, &send("/api/import", &file)).await;
    assert!(copied.starts_with("HTTP/1.1 200"), "a copy is nobody's: {copied}");
    assert_eq!(ben.load(&play).await.unwrap(), before);
    house.close().await;
}

#[tokio::test]
async fn who_asked_may_withdraw() {
    let house = House::open().await;
    let (mut aiko, ben, play) = two(&house).await;
    grant(&aiko, &play, &["a"]).await;
    ben.ask(request::AskFor { behaviour: play.clone(), record: stream_id("a") }).await.unwrap();
    assert!(matches!(event(&mut aiko).await, LockEvent::Asked { last: false, .. }));
    ben.ask(request::Withdraw { behaviour: play.clone(), record: stream_id("a") }).await.unwrap();
    assert!(matches!(event(&mut aiko).await, LockEvent::Withdrawn { asker, .. } if asker.name == "Ben"));
    house.close().await;
}

#[tokio::test]
async fn who_asks_gets_it_when_it_is_handed_over() {
    let house = House::open().await;
    let (mut aiko, mut ben, play) = two(&house).await;
    let held = grant(&aiko, &play, &["a"]).await;
    let ask = request::AskFor { behaviour: play.clone(), record: stream_id("a") };
    let answer::Asked { now_ms, asked: AskResult::Waiting { by_ms } } = ben.ask(ask.clone()).await.unwrap() else {
        panic!()
    };
    assert_eq!(by_ms - now_ms, 10_000);
    let told = event(&mut aiko).await;
    assert!(matches!(&told, LockEvent::Asked { asker, .. } if asker.name == "Ben"), "{told:?}");
    let say = |yes| request::HandOver { behaviour: play.clone(), token: held.token, yes };
    aiko.ask(say(false)).await.unwrap();
    assert!(matches!(event(&mut ben).await, LockEvent::NotYet { by, .. } if by == "Aiko"));
    assert!(matches!(ben.ask(ask).await.unwrap(), answer::Asked { asked: AskResult::TooSoon { .. }, .. }));
    let carol = house.person("Carol").await;
    carol.load(&play).await.unwrap();
    carol.ask(request::AskFor { behaviour: play.clone(), record: stream_id("a") }).await.unwrap();
    aiko.ask(say(true)).await.unwrap();
    let why = loop {
        if let LockEvent::Freed { why, .. } = event(&mut aiko).await {
            break why;
        }
    };
    assert_eq!(why, LockEndReason::HandedOver { to: "Carol".to_owned() });
    let mut carol = carol;
    let LockEvent::Granted { grant: hers, .. } = event(&mut carol).await else { panic!() };
    assert!(sentence(rename(&aiko, &play, "a", "late", &[held.token]).await).starts_with("Carol is editing"));
    rename(&carol, &play, "a", "handed over", &[hers.token]).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn who_comes_back_has_what_was_kept() {
    let house = House::open().await;
    let (aiko, mut ben, play) = two(&house).await;
    let held = grant(&aiko, &play, &["a"]).await;
    let credential = aiko.credential();
    drop(aiko);
    while !shown(&mut ben, 1).await[0].away {}
    assert!(sentence(rename(&ben, &play, "a", "mine", &[]).await).starts_with("Aiko is editing"));
    let mut aiko = Client::connect_again(&house.url(), Some(credential), "Aiko").await.unwrap();
    aiko.load(&play).await.unwrap();
    let told = aiko.until(|reply| matches!(reply, Event::LockReturned { .. })).await.unwrap();
    assert_eq!(told, Event::LockReturned { grant: held.clone() });
    rename(&aiko, &play, "a", "hers", &[held.token]).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn what_was_made_before_the_lock_is_answered_as_made_after_it() {
    let house = House::open().await;
    let (aiko, ben, play) = two(&house).await;
    let change = ben.change("Rename", &ben.open().unwrap().records, vec![(stream_id("a"), Some(plain("first")))]);
    let propose = || request::Propose { behaviour: play.clone(), change: change.clone(), tokens: Vec::new() };
    let made = ben.ask(propose()).await.unwrap();
    grant(&aiko, &play, &["a"]).await;
    assert_eq!(ben.ask(propose()).await.unwrap(), made, "sent twice, made once");
    house.close().await;
}

#[tokio::test]
async fn a_lock_goes_with_the_behaviour_that_is_left() {
    let house = House::open().await;
    let (aiko, ben, play) = two(&house).await;
    grant(&aiko, &play, &["a"]).await;
    aiko.ask(request::Leave {}).await.unwrap();
    rename(&ben, &play, "a", "mine", &[]).await.unwrap();
    house.close().await;
}
