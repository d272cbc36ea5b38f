//! Making, listing, removing and keeping behaviours.

use crate::house::{House, id, make, plain, stream_id};
use behaviour::{Kind, Record, RecordId, Settings};
use protocol::{Event, ListQuery, PictureOf, Refused, SearchPlace, Sort, Summary, answer, request};
use shell::{Client, ClientError};

async fn names(client: &Client) -> Vec<String> {
    let programs = client.programs(ListQuery::default(), usize::MAX).await.unwrap();
    programs.into_iter().map(|Summary { name, .. }| name).collect()
}

#[tokio::test]
async fn names_stay_unique_and_asking_twice_makes_one() {
    let house = House::open().await;
    let mut ben = house.person("Ben").await;
    let aiko = house.person("Aiko").await;
    let create = || request::Create { behaviour: id("mine"), name: "Play".into(), template: None };
    let first = aiko.ask(create()).await.unwrap();
    assert_eq!(aiko.ask(create()).await.unwrap(), first);
    make(&aiko, "Play", None).await;
    let mut all = names(&aiko).await;
    all.sort();
    assert_eq!(all, ["Play", "Play 2"]);
    ben.until(|reply| *reply == Event::ProgramsChanged).await.unwrap();
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
        let opened = aiko.ask(request::Open { behaviour: made }).await.unwrap();
        let answer::Opened { problems, records, .. } = opened;
        assert!(problems.iter().all(|problem| !problem.blocks), "{name}: {problems:?}");
        assert!(records.streams().count() > 1);
    }
    let no = aiko.ask(request::Create { behaviour: id("x"), name: "X".into(), template: Some("None".into()) }).await;
    assert_eq!(no, Err(ClientError::No(Refused::NoTemplate("None".into()))));
    assert_eq!(names(&aiko).await.len(), 3);
    assert!(aiko.until(|reply| *reply == Event::ProgramsChanged).await.is_ok());
    house.close().await;
}

#[tokio::test]
async fn the_list_comes_in_pages_of_what_is_asked_for() {
    let house = House::open().await;
    let (aiko, ben) = (house.person("Aiko").await, house.person("Ben").await);
    for number in 1..=6 {
        make(if number > 4 { &ben } else { &aiko }, &format!("Play {number}"), None).await;
    }
    make(&ben, "Greet", Some("Greeter")).await;
    let by_name = ListQuery { sort: Sort::Name, most: 3, words: "play".into(), ..ListQuery::default() };
    let first = aiko.ask(request::List { query: by_name.clone() }).await.unwrap();
    let answer::Programs { programs, next: Some(next), total: 7 } = first else { panic!("{first:?}") };
    assert_eq!(
        programs.iter().map(|program| program.name.as_str()).collect::<Vec<_>>(),
        ["Play 1", "Play 2", "Play 3"]
    );
    assert!(programs.iter().all(|program| program.owner == "Aiko" && program.revision == 1));
    let query = ListQuery { after: Some(next), most: 50, ..by_name };
    let rest = aiko.ask(request::List { query }).await.unwrap();
    let answer::Programs { programs, next: None, total: 7 } = rest else { panic!("{rest:?}") };
    assert_eq!(programs.len(), 3);
    let mine = ListQuery { owner: Some("Ben".into()), ..ListQuery::default() };
    assert_eq!(aiko.programs(mine, usize::MAX).await.unwrap().len(), 3);
    let heard = ListQuery { words: "facedetection HELLO".into(), ..ListQuery::default() };
    assert_eq!(aiko.programs(heard, usize::MAX).await.unwrap()[0].name, "Greet");
    house.close().await;
}

#[tokio::test]
async fn everyone_hears_of_a_new_name_but_gets_no_list() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    let mut ben = house.person("Ben").await;
    let settings = RecordId::settings();
    aiko.put("Rename", settings, Some(Record::Settings(Settings::named("Dance")))).await.unwrap();
    let told = ben.until(|reply| matches!(reply, Event::ProgramsChanged)).await.unwrap();
    assert_eq!(told, Event::ProgramsChanged);
    assert_eq!(names(&ben).await, ["Dance"]);
    aiko.put("Add", stream_id("a"), Some(plain("One"))).await.unwrap();
    assert!(ben.until(|reply| *reply == Event::ProgramsChanged).await.is_ok(), "later, together with others");
    drop(play);
    house.close().await;
}

#[tokio::test]
async fn pictures_follow_the_revision() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    let picture = async |revision| {
        let of =
            vec![PictureOf { behaviour: play.clone(), revision }, PictureOf { behaviour: id("gone"), revision: 1 }];
        let answer::Pictures { pictures } = aiko.ask(request::Pictures { of }).await.unwrap();
        assert_eq!(pictures.len(), 1);
        pictures[0].1.streams.len()
    };
    assert_eq!(picture(1).await, 0);
    aiko.put("Add", RecordId::new(Kind::Stream, &id("a")), Some(plain("One"))).await.unwrap();
    assert_eq!(picture(2).await, 1);
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
    aiko.ask(request::Remove { behaviour: play.clone() }).await.unwrap();
    let told = ben.until(|reply| matches!(reply, Event::Removed { .. })).await.unwrap();
    assert_eq!(told, Event::Removed { behaviour: play.clone(), by: "Aiko".into() });
    assert_eq!(ben.open(), None);
    assert_eq!(ben.load(&play).await, Err(ClientError::No(Refused::NoBehaviour)));
    assert!(names(&ben).await.is_empty());
    let bin = || ListQuery { place: SearchPlace::Bin, ..ListQuery::default() };
    let removed = ben.programs(bin(), usize::MAX).await.unwrap();
    assert_eq!(removed.iter().map(|one| (one.name.as_str(), one.by.as_str())).collect::<Vec<_>>(), [("Play", "Aiko")]);
    ben.ask(request::Restore { behaviour: play.clone() }).await.unwrap();
    assert!(ben.programs(bin(), usize::MAX).await.unwrap().is_empty());
    assert_eq!(ben.load(&play).await.unwrap().revision, 1);
    assert_eq!(names(&aiko).await, ["Play"]);
    house.close().await;
}
