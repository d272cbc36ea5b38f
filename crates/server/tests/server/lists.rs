//! Making, listing, removing and keeping behaviours.

use crate::house::{House, id, make, plain, stream_id};
use protocol::{Reply, Request, SaidNo, Summary};
use shell::{Client, Trouble};

async fn names(client: &Client) -> Vec<String> {
    match client.ask(Request::List).await.unwrap() {
        Reply::Programs { programs } => programs.into_iter().map(|Summary { name, .. }| name).collect(),
        other => panic!("{other:?}"),
    }
}

#[tokio::test]
async fn names_stay_unique_and_asking_twice_makes_one() {
    let house = House::open().await;
    let mut ben = house.person("Ben").await;
    let aiko = house.person("Aiko").await;
    let create = || Request::Create { behaviour: id("mine"), name: "Play".into(), template: None };
    let first = aiko.ask(create()).await.unwrap();
    assert_eq!(aiko.ask(create()).await.unwrap(), first);
    make(&aiko, "Play", None).await;
    let mut all = names(&aiko).await;
    all.sort();
    assert_eq!(all, ["Play", "Play 2"]);
    ben.until(|reply| matches!(reply, Reply::Programs { programs } if programs.len() == 2)).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn every_template_becomes_a_behaviour_without_problems() {
    let house = House::open().await;
    let mut aiko = house.person("Aiko").await;
    let welcome = Client::connect(&house.url(), "Ben").await.unwrap();
    assert_eq!(welcome.library().revision, 1);
    for name in ["Greeter", "Track far and close balls", "Say ball color"] {
        let made = make(&aiko, name, Some(name)).await;
        let opened = aiko.ask(Request::Open { behaviour: made }).await.unwrap();
        let Reply::Opened { problems, records, .. } = opened else { panic!() };
        assert!(problems.iter().all(|problem| !problem.blocks), "{name}: {problems:?}");
        assert!(records.streams().count() > 1);
    }
    let no = aiko.ask(Request::Create { behaviour: id("x"), name: "X".into(), template: Some("None".into()) }).await;
    assert_eq!(no, Err(Trouble::No(SaidNo::NoTemplate("None".into()))));
    assert_eq!(names(&aiko).await.len(), 3);
    assert!(aiko.until(|reply| matches!(reply, Reply::Programs { .. })).await.is_ok());
    house.close().await;
}

#[tokio::test]
async fn a_restart_keeps_everything() {
    let folder = tempfile::tempdir().unwrap();
    let house = House::at(folder.path()).await;
    let (aiko, play) = house.maker("Aiko").await;
    aiko.put("Add", stream_id("a"), Some(plain("One"))).await.unwrap();
    let (before, library, epoch) = (aiko.open(), aiko.library(), aiko.epoch());
    house.close().await;
    let house = House::at(folder.path()).await;
    let ben = house.person("Ben").await;
    assert_eq!(Some(ben.load(&play).await.unwrap()), before);
    assert_eq!(ben.library(), library);
    assert!(ben.epoch() > epoch);
    assert_eq!(names(&ben).await, ["Play"]);
    house.close().await;
}

#[tokio::test]
async fn a_removed_behaviour_can_be_taken_back() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    let mut ben = house.person("Ben").await;
    ben.load(&play).await.unwrap();
    aiko.ask(Request::Remove { behaviour: play.clone() }).await.unwrap();
    let told = ben.until(|reply| matches!(reply, Reply::Removed { .. })).await.unwrap();
    assert_eq!(told, Reply::Removed { behaviour: play.clone(), by: "Aiko".into() });
    assert_eq!(ben.open(), None);
    assert_eq!(ben.load(&play).await, Err(Trouble::No(SaidNo::NoBehaviour)));
    assert!(names(&ben).await.is_empty());
    ben.ask(Request::Restore { behaviour: play.clone() }).await.unwrap();
    assert_eq!(ben.load(&play).await.unwrap().revision, 1);
    assert_eq!(names(&aiko).await, ["Play"]);
    house.close().await;
}
