//! What many ask of the past takes few places, and little memory, at once.

use crate::history::{take_back, was};
use crate::house::{House, id, plain, stream_id};
use crate::limits::too_large;
use crate::slow::Hanging;
use behaviour::Kind;
use protocol::{Refused, request};
use shell::ClientError;
use std::sync::Arc;
use std::sync::atomic::Ordering;

#[tokio::test]
async fn a_large_behaviour_is_shown_whole_as_it_was() {
    let house = too_large().await;
    let aiko = house.person("Aiko").await;
    let play = aiko.load(&id("play")).await.unwrap();
    let gone = play.records.records.keys().find(|id| id.kind == Kind::Note).unwrap().clone();
    aiko.put("Remove", gone, None).await.unwrap();
    assert_eq!(was(&aiko, &id("play"), play.revision).await, Ok(play.records));
    house.close().await;
}

#[tokio::test]
async fn going_back_over_more_than_a_message_can_carry_is_refused() {
    let house = too_large().await;
    let aiko = house.person("Aiko").await;
    let play = aiko.load(&id("play")).await.unwrap();
    let (behaviour, op, called) = (id("play"), id("g1"), String::new());
    let back = request::GoBack { behaviour, revision: 1, op, called, tokens: Vec::new() };
    assert_eq!(aiko.ask(back).await, Err(ClientError::No(Refused::FarBack)));
    assert_eq!(aiko.open().unwrap(), play);
    house.close().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn however_many_look_at_what_was_few_are_served_at_once_and_all_at_last() {
    let store = Arc::new(Hanging::default());
    let house = House::on(store.clone()).await;
    let (aiko, play) = house.maker("Aiko").await;
    for number in 0..6 {
        aiko.put("Add", stream_id(&format!("s{number}")), Some(plain(&format!("S{number}")))).await.unwrap();
    }
    let mut people = Vec::new();
    for number in 0..12 {
        people.push(house.person(&format!("P{number}")).await);
    }
    store.looked_most.store(0, Ordering::SeqCst);
    let mut asked = Vec::new();
    for person in people {
        let play = play.clone();
        asked.push(tokio::spawn(async move {
            let all = (0..6).map(|_| person.ask(request::At { behaviour: play.clone(), revision: 2 }));
            let mut answers = Vec::new();
            for answer in futures_util::future::join_all(all).await {
                answers.push(answer.map(drop));
            }
            (answers, was(&person, &play, 3).await)
        }));
    }
    for person in asked {
        let (answers, after) = person.await.unwrap();
        let shown = answers.iter().filter(|answer| **answer == Ok(())).count();
        let refused = answers.iter().filter(|answer| **answer == Err(ClientError::No(Refused::TooFast))).count();
        assert!(shown >= 2 && shown + refused == 6, "{answers:?}");
        assert_eq!(after.unwrap().streams().count(), 2);
    }
    assert!(store.looked_most.load(Ordering::SeqCst) <= 2, "{}", store.looked_most.load(Ordering::SeqCst));
    aiko.ask(take_back(&play, "u1", false)).await.unwrap();
    house.close().await;
}
