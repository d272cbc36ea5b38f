//! The past of a behaviour: one's own undo and redo, history, what was, and versions with names.

use crate::house::{House, ball, connector_id, id, map, plain, sentence, stream_id};
use behaviour::{Accepted, Behaviour, Checkpoint, Id, RecordId, Refusal};
use protocol::{Event, HISTORY_MAX_LINES, HistoryLine, Refused, answer, request};
use shell::{Client, ClientError};
use std::sync::Arc;
use store::{MemoryStore, Store};

pub(crate) fn take_back(play: &Id, op: &str, again: bool) -> request::TakeBack {
    request::TakeBack { behaviour: play.clone(), op: id(op), again, tokens: Vec::new() }
}

/// The change that was saved, as the log has it.
async fn accepted(client: &Client, play: &Id, answer: Result<answer::Saved, ClientError>) -> Accepted {
    let revision = answer.unwrap().revision;
    let since = request::Since { behaviour: play.clone(), revision: revision - 1 };
    let answer::Newer::Missed(missed) = client.ask(since).await.unwrap() else { panic!("the newest are told") };
    missed.changes.into_iter().next().unwrap()
}

async fn undo(client: &Client, play: &Id, op: &str) -> Accepted {
    accepted(client, play, client.ask(take_back(play, op, false)).await).await
}

async fn name(client: &Client, stream: &str, name: &str) {
    client.put(&format!("Name it {name}"), stream_id(stream), Some(plain(name))).await.unwrap();
}

fn names(behaviour: &Behaviour) -> Vec<String> {
    behaviour.streams().map(|(_, stream)| stream.name.clone()).collect()
}

async fn now(client: &Client, play: &Id) -> Behaviour {
    client.load(play).await.unwrap().records
}

async fn two(house: &House) -> (Client, Client, Id) {
    let (aiko, play) = house.maker("Aiko").await;
    let ben = house.person("Ben").await;
    ben.load(&play).await.unwrap();
    (aiko, ben, play)
}

pub(crate) async fn was(client: &Client, play: &Id, revision: u64) -> Result<Behaviour, ClientError> {
    let at = client.ask(request::At { behaviour: play.clone(), revision }).await?;
    assert_eq!((&at.behaviour, at.revision, at.more), (play, revision, false));
    Ok(*at.records)
}

async fn page(client: &Client, play: &Id, before: Option<u64>) -> (Vec<HistoryLine>, bool) {
    let page = client.ask(request::History { behaviour: play.clone(), before }).await.unwrap();
    (page.lines, page.more)
}

#[tokio::test]
async fn each_takes_back_and_does_again_only_their_own() {
    let house = House::open().await;
    let (aiko, mut ben, play) = two(&house).await;
    name(&aiko, "a", "A1").await;
    ben.load(&play).await.unwrap();
    name(&ben, "b", "B1").await;
    aiko.load(&play).await.unwrap();
    name(&aiko, "a", "A2").await;
    ben.load(&play).await.unwrap();
    name(&ben, "b", "B2").await;
    let made = undo(&aiko, &play, "u1").await;
    assert_eq!((made.change.label.to_string().as_str(), made.change.author.as_str()), ("Undo: Name it A2", "Aiko"));
    assert_eq!(made.change.by.as_ref(), Some(&aiko.you().client));
    let told = ben.until(|told| matches!(told, Event::Accepted { accepted, .. } if *accepted == made)).await;
    assert!(told.is_ok(), "everyone there is told");
    assert_eq!(names(&now(&aiko, &play).await), ["A1", "B2"]);
    undo(&ben, &play, "u2").await;
    assert_eq!(names(&now(&ben, &play).await), ["A1", "B1"]);
    accepted(&aiko, &play, aiko.ask(take_back(&play, "r1", true)).await).await;
    assert_eq!(names(&now(&aiko, &play).await), ["A2", "B1"]);
    let nothing = aiko.ask(take_back(&play, "r2", true)).await;
    assert_eq!(nothing, Err(ClientError::No(Refused::Change(Refusal::NothingToUndo))));
    for op in ["u3", "u4"] {
        undo(&aiko, &play, op).await;
    }
    assert_eq!(names(&now(&aiko, &play).await), ["B1"]);
    house.close().await;
}

#[tokio::test]
async fn an_undo_over_the_change_of_somebody_else_is_refused_with_their_name() {
    let house = House::open().await;
    let (aiko, ben, play) = two(&house).await;
    name(&aiko, "a", "Hers").await;
    ben.load(&play).await.unwrap();
    name(&ben, "a", "His").await;
    let no = aiko.ask(take_back(&play, "u1", false)).await;
    let (what, by) = ("“His”".into(), "Ben".to_owned());
    assert_eq!(no, Err(ClientError::No(Refused::Change(Refusal::ChangedSince { what, by }))));
    undo(&ben, &play, "u2").await;
    undo(&aiko, &play, "u3").await;
    assert_eq!(names(&now(&aiko, &play).await), Vec::<String>::new());
    house.close().await;
}

#[tokio::test]
async fn undo_goes_on_after_a_reload_and_a_restart_and_is_done_once_though_it_is_sent_twice() {
    let (store, data) = (Arc::new(MemoryStore::default()), tempfile::tempdir().unwrap());
    let house = House::beside(Arc::clone(&store) as Arc<dyn Store>, data.path()).await;
    let (aiko, play) = house.maker("Aiko").await;
    for number in 1..=4 {
        name(&aiko, "a", &format!("A{number}")).await;
    }
    let first = undo(&aiko, &play, "u1").await;
    assert_eq!(undo(&aiko, &play, "u1").await, first, "sent twice, done once");
    let me = aiko.credential();
    drop(aiko);
    let aiko = Client::connect_again(&house.url(), Some(me.clone()), "Aiko T.").await.unwrap();
    let second = undo(&aiko, &play, "u2").await;
    assert_eq!(second.change.author, "Aiko T.");
    assert_eq!(names(&now(&aiko, &play).await), ["A2"]);
    house.close().await;
    let house = House::beside(store, data.path()).await;
    let aiko = Client::connect_again(&house.url(), Some(me.clone()), "Aiko").await.unwrap();
    assert_eq!(aiko.you().client, me.client);
    assert_eq!(undo(&aiko, &play, "u1").await, first, "as it was answered then");
    undo(&aiko, &play, "u3").await;
    accepted(&aiko, &play, aiko.ask(take_back(&play, "r1", true)).await).await;
    accepted(&aiko, &play, aiko.ask(take_back(&play, "r2", true)).await).await;
    assert_eq!(names(&now(&aiko, &play).await), ["A3"]);
    let somebody = house.person("Aiko").await;
    let no = somebody.ask(take_back(&play, "u4", false)).await;
    assert_eq!(no, Err(ClientError::No(Refused::Change(Refusal::NothingToUndo))), "a name proves nothing");
    house.close().await;
}

#[tokio::test]
async fn nobody_changes_or_takes_back_in_another_s_name() {
    let house = House::open().await;
    let (aiko, ben, play) = two(&house).await;
    name(&aiko, "a", "Hers").await;
    let mut forged = ben.change("Forge", &now(&ben, &play).await, vec![(stream_id("b"), Some(plain("His")))]);
    (forged.by, forged.author) = (Some(aiko.you().client.clone()), "Aiko".to_owned());
    let made = accepted(
        &ben,
        &play,
        ben.ask(request::Propose { behaviour: play.clone(), change: forged, tokens: vec![] }).await,
    )
    .await;
    assert_eq!((made.change.by.as_ref(), made.change.author.as_str()), (Some(&ben.you().client), "Ben"));
    undo(&aiko, &play, "u1").await;
    assert_eq!(names(&now(&aiko, &play).await), ["His"], "the newest change is not hers");
    house.close().await;
}

#[tokio::test]
async fn locks_hold_for_what_is_taken_back_too() {
    let house = House::open().await;
    let (aiko, ben, play) = two(&house).await;
    name(&aiko, "a", "A").await;
    let held = || request::Lock { behaviour: play.clone(), records: [stream_id("a")].into() };
    let answer::Locked { grant } = ben.ask(held()).await.unwrap();
    assert_eq!(
        sentence(aiko.ask(take_back(&play, "u1", false)).await),
        "Ben is editing “A”. Ask, or wait until it is free."
    );
    let back =
        request::GoBack { behaviour: play.clone(), revision: 1, op: id("g1"), called: String::new(), tokens: vec![] };
    assert!(sentence(aiko.ask(back).await).starts_with("Ben is editing"));
    ben.ask(request::Unlock { behaviour: play.clone(), token: grant.token }).await.unwrap();
    let answer::Locked { grant } = aiko.ask(held()).await.unwrap();
    let no = sentence(aiko.ask(take_back(&play, "u2", false)).await);
    assert!(no.starts_with("Aiko is editing"), "{no}");
    let op = id("u3");
    let mine = request::TakeBack { behaviour: play.clone(), op, again: false, tokens: vec![grant.token] };
    accepted(&aiko, &play, aiko.ask(mine).await).await;
    house.close().await;
}

#[tokio::test]
async fn the_history_comes_newest_first_in_pages() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    for number in 0..HISTORY_MAX_LINES + 20 {
        name(&aiko, "a", &format!("A{number}")).await;
    }
    aiko.put("Remove it", stream_id("a"), None).await.unwrap();
    let made = undo(&aiko, &play, "u1").await;
    let (first, more) = page(&aiko, &play, None).await;
    assert_eq!((first.len(), more), (HISTORY_MAX_LINES, true));
    assert_eq!((first[0].revision, first[0].op.clone(), first[0].removes), (made.revision, id("u1"), false));
    assert_eq!((first[0].undoes.as_ref(), first[1].label.to_string().as_str()), (Some(&first[1].op), "Remove it"));
    assert_eq!((first[1].removes, first[2].removes), (true, false));
    assert_eq!((first[1].by.as_ref(), first[1].author.as_str()), (Some(&aiko.you().client), "Aiko"));
    let (rest, more) = page(&aiko, &play, first.last().map(|line| line.revision)).await;
    assert!(!more);
    let all: Vec<u64> = first.iter().chain(&rest).map(|line| line.revision).collect();
    assert!(all.iter().copied().eq((1..=made.revision).rev()), "{all:?}");
    for before in [0, 1] {
        assert_eq!(page(&aiko, &play, Some(before)).await, (vec![], false));
    }
    house.close().await;
}

#[tokio::test]
async fn a_behaviour_is_shown_as_it_was_after_every_change() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    let mut all = vec![now(&aiko, &play).await];
    for number in 0..80 {
        let gone = (number % 7 == 6).then(|| stream_id(&format!("s{}", number - 3)));
        match gone {
            Some(gone) => drop(aiko.put("Remove", gone, None).await.unwrap()),
            None => name(&aiko, &format!("s{number}"), &format!("S{number}")).await,
        }
        all.push(aiko.open().unwrap().records);
    }
    for (before, records) in all.iter().enumerate() {
        assert_eq!(was(&aiko, &play, before as u64 + 1).await.as_ref(), Ok(records), "{before}");
    }
    for revision in [0, 82, u64::MAX] {
        assert_eq!(was(&aiko, &play, revision).await, Err(ClientError::No(Refused::NoVersion)));
    }
    let nobody = was(&aiko, &id("nobody"), 1).await;
    assert_eq!(nobody, Err(ClientError::No(Refused::NoBehaviour)));
    house.close().await;
}

#[tokio::test]
async fn going_back_is_one_new_change_that_can_be_taken_back() {
    let house = House::open().await;
    let (aiko, ben, play) = two(&house).await;
    for stream in ["a", "b", "c"] {
        name(&aiko, stream, stream).await;
    }
    let then = aiko.open().unwrap();
    aiko.put("Remove b", stream_id("b"), None).await.unwrap();
    name(&aiko, "a", "other").await;
    let later = aiko.open().unwrap();
    ben.load(&play).await.unwrap();
    let back = |op: &str, revision, called: &str| request::GoBack {
        behaviour: play.clone(),
        revision,
        op: id(op),
        called: called.into(),
        tokens: vec![],
    };
    let made = accepted(&ben, &play, ben.ask(back("g1", then.revision, "14:05")).await).await;
    assert_eq!((made.revision, made.change.label.to_string().as_str()), (later.revision + 1, "Go back to 14:05"));
    assert_eq!((made.change.author.as_str(), made.change.edits.len()), ("Ben", 2));
    assert_eq!(now(&ben, &play).await, then.records);
    assert_eq!(
        accepted(&ben, &play, ben.ask(back("g1", then.revision, "14:05")).await).await,
        made,
        "sent twice, made once"
    );
    undo(&ben, &play, "u1").await;
    assert_eq!(now(&aiko, &play).await, later.records);
    let same = aiko.ask(back("g2", later.revision, "")).await;
    assert_eq!(same, Err(ClientError::No(Refused::Change(Refusal::Edits(0)))));
    assert_eq!(aiko.ask(back("g3", 99, "")).await, Err(ClientError::No(Refused::NoVersion)));
    house.close().await;
}

#[tokio::test]
async fn what_was_removed_is_brought_back_as_far_as_it_may() {
    let house = House::open().await;
    let (aiko, ben, play) = two(&house).await;
    aiko.put("Add", stream_id("ball"), Some(ball("Ball"))).await.unwrap();
    for stream in ["near", "far"] {
        name(&aiko, stream, stream).await;
    }
    aiko.put("Add", connector_id("m"), Some(map("ball", "ball", "near"))).await.unwrap();
    let whole = aiko.open().unwrap().records;
    let gone: Vec<(RecordId, _)> = vec![(connector_id("m"), None), (stream_id("near"), None)];
    let change = aiko.change("Remove near", &whole, gone);
    let removal =
        accepted(&aiko, &play, aiko.ask(request::Propose { behaviour: play.clone(), change, tokens: vec![] }).await)
            .await;
    let bring =
        |op: &str, revision| request::BringBack { behaviour: play.clone(), revision, op: id(op), tokens: vec![] };
    let back = accepted(&ben, &play, ben.ask(bring("b1", removal.revision)).await).await;
    assert_eq!((back.change.label.to_string().as_str(), back.change.author.as_str()), ("Bring back “near”", "Ben"));
    assert_eq!(now(&ben, &play).await, whole);
    assert_eq!(
        accepted(&ben, &play, ben.ask(bring("b1", removal.revision)).await).await,
        back,
        "sent twice, made once"
    );
    assert_eq!(ben.ask(bring("b2", removal.revision)).await, Err(ClientError::No(Refused::NothingGone)));
    assert_eq!(ben.ask(bring("b3", 1)).await, Err(ClientError::No(Refused::NothingGone)), "nothing was removed there");
    assert_eq!(ben.ask(bring("b4", 99)).await, Err(ClientError::No(Refused::NoVersion)));
    undo(&ben, &play, "u1").await;
    aiko.load(&play).await.unwrap();
    name(&aiko, "other", "near").await;
    let taken = ben.ask(bring("b5", removal.revision)).await;
    assert_eq!(taken, Err(ClientError::No(Refused::Change(Refusal::NameTaken("near".into())))));
    house.close().await;
}

/// The next that is told of named versions.
async fn versions(client: &mut Client) -> Vec<Checkpoint> {
    match client.until(|told| matches!(told, Event::Versions { .. })).await.unwrap() {
        Event::Versions { versions, .. } => versions,
        other => panic!("{other:?}"),
    }
}

fn called(versions: &[Checkpoint]) -> Vec<(u64, &str, &str)> {
    versions.iter().map(|one| (one.revision, one.name.as_str(), one.by.as_str())).collect()
}

#[tokio::test]
async fn versions_with_names_are_told_to_everyone_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let house = House::at(folder.path()).await;
    let (mut aiko, mut ben, play) = two(&house).await;
    assert_eq!((versions(&mut aiko).await, versions(&mut ben).await), (vec![], vec![]), "told to who opens it");
    name(&aiko, "a", "A").await;
    let give = |revision, name: &str| request::NameVersion { behaviour: play.clone(), revision, name: name.into() };
    aiko.ask(give(2, " With a stream ")).await.unwrap();
    assert_eq!(called(&versions(&mut ben).await), [(2, "With a stream", "Aiko")]);
    assert_eq!(aiko.ask(give(2, "With a stream")).await, Ok(()), "said twice, done once");
    let no = ben.ask(give(1, "With a stream")).await;
    assert_eq!(no, Err(ClientError::No(Refused::Change(Refusal::NameTaken("With a stream".into())))));
    for revision in [0, 3] {
        assert_eq!(ben.ask(give(revision, "Later")).await, Err(ClientError::No(Refused::NoVersion)));
    }
    assert!(sentence(ben.ask(give(1, " ")).await).contains("name is missing"));
    let elsewhere = request::NameVersion { behaviour: id("library"), revision: 1, name: "x".into() };
    assert_eq!(ben.ask(elsewhere).await, Err(ClientError::No(Refused::NoBehaviour)));
    ben.ask(give(1, "Empty")).await.unwrap();
    house.close().await;
    let house = House::at(folder.path()).await;
    let mut yuki = house.person("Yuki").await;
    yuki.load(&play).await.unwrap();
    assert_eq!(called(&versions(&mut yuki).await), [(1, "Empty", "Ben"), (2, "With a stream", "Aiko")]);
    let (called_so, tokens) = ("14:05".into(), vec![]);
    let back = request::GoBack { behaviour: play.clone(), revision: 1, op: id("g1"), called: called_so, tokens };
    assert_eq!(accepted(&yuki, &play, yuki.ask(back).await).await.change.label, "Go back to “Empty”");
    for _ in 0..2 {
        let unname = request::UnnameVersion { behaviour: play.clone(), name: "Empty".into() };
        assert_eq!(yuki.ask(unname).await, Ok(()));
    }
    assert_eq!(called(&versions(&mut yuki).await), [(2, "With a stream", "Aiko")]);
    house.close().await;
}
