//! Looking back together: the others hear at which moment somebody looks, and open the same past by their own right.

use crate::house::House;
use crate::invited::Scene;
use crate::looking_back::{NEAR, ask, near, put, recorded};
use behaviour::Id;
use protocol::{
    Event, LOOKED_NAME_MAX_BYTES, LookedMoment, Message, PastOf, PastQuestion, Person, Refused, Role, request,
};
use shell::Client;
use std::sync::Arc;
use store::MemoryStore;

fn moment(past: &PastOf, at_ms: u64) -> LookedMoment {
    LookedMoment { past: past.clone(), at_ms, clock_ms: 1_763_750_046_000 + at_ms, with: None }
}

fn looks(at: Option<LookedMoment>) -> request::PresentMoment {
    request::PresentMoment { at }
}

/// A house with a recording that Aiko has opened, and Ben beside her in the same program.
struct Together {
    house: House,
    aiko: Client,
    play: Id,
    ben: Client,
    /// Aiko's client.
    me: Id,
    past: PastOf,
    /// The data folder, kept for as long as the house stands.
    folder: tempfile::TempDir,
}

async fn together() -> Together {
    let folder = tempfile::tempdir().unwrap();
    put(folder.path(), NEAR, &near(100, "ball.cm"));
    let house = House::beside(Arc::new(MemoryStore::default()), folder.path()).await;
    let ((aiko, play), ben) = (house.maker("Aiko").await, house.person("Ben").await);
    ben.load(&play).await.unwrap();
    let (me, past) = (aiko.you().client.clone(), recorded(NEAR));
    ask(&aiko, &past, PastQuestion::Open).await.unwrap();
    Together { house, aiko, play, ben, me, past, folder }
}

/// The people that are told next.
async fn people(of: &mut Client) -> Vec<Person> {
    let mut told = Vec::new();
    let is_it = |event: &Event| {
        if let Event::People { people, .. } = event {
            told.clone_from(people);
        }
        matches!(event, Event::People { .. })
    };
    of.until(is_it).await.unwrap();
    told
}

/// The moment at which somebody looks, once that is so.
async fn until(of: &mut Client, whose: &Id, wanted: Option<&LookedMoment>) -> Vec<Person> {
    loop {
        let people = people(of).await;
        let theirs = people.iter().find(|person| person.client == *whose);
        if theirs.is_some_and(|theirs| theirs.looks_at.as_ref() == wanted) {
            return people;
        }
    }
}

#[tokio::test]
async fn others_hear_at_which_moment_of_which_past_somebody_looks() {
    let Together { house, aiko, play, mut ben, me, past, folder: _folder } = together().await;
    let first = moment(&past, 2_600);
    aiko.tell(looks(Some(first.clone()))).await.unwrap();
    until(&mut ben, &me, Some(&first)).await;

    // Whoever comes later is told too.
    let emma = house.person("Emma").await;
    let opened = emma.ask(request::Open { behaviour: play.clone() }).await.unwrap();
    let theirs = opened.people.iter().find(|person| person.client == me).unwrap();
    assert_eq!(theirs.looks_at.as_ref(), Some(&first));

    // Ben goes along, and says with whom.
    ask(&ben, &past, PastQuestion::Seek { at_ms: 2_600 }).await.unwrap();
    let beside = LookedMoment { with: Some(me.clone()), ..first.clone() };
    ben.tell(looks(Some(beside.clone()))).await.unwrap();
    let ben_is = ben.you().client.clone();
    until(&mut ben, &ben_is, Some(&beside)).await;

    // Of a past that this link did not ask for last nothing is told, nor of one that has no name of a file.
    aiko.tell(looks(Some(moment(&PastOf::Run(7), 10)))).await.unwrap();
    until(&mut ben, &me, None).await;
    aiko.tell(looks(Some(first.clone()))).await.unwrap();
    until(&mut ben, &me, Some(&first)).await;
    let long = recorded(&"x".repeat(LOOKED_NAME_MAX_BYTES + 1));
    assert!(ask(&aiko, &long, PastQuestion::Open).await.is_err());
    aiko.tell(looks(Some(moment(&long, 10)))).await.unwrap();
    until(&mut ben, &me, None).await;

    // Now again, and away.
    ask(&aiko, &past, PastQuestion::Seek { at_ms: 10 }).await.unwrap();
    aiko.tell(looks(Some(first.clone()))).await.unwrap();
    until(&mut ben, &me, Some(&first)).await;
    aiko.tell(looks(None)).await.unwrap();
    until(&mut ben, &me, None).await;
    drop(aiko);
    while people(&mut ben).await.iter().any(|person| person.client == me) {}
    house.close().await;
}

#[tokio::test]
async fn of_many_moments_the_newest_is_told_and_stop_comes_between() {
    let Together { house, aiko, mut ben, me, past, folder: _folder, .. } = together().await;
    for at_ms in 1..=100 {
        aiko.tell(looks(Some(moment(&past, at_ms)))).await.unwrap();
    }
    aiko.ask(request::Stop { behaviour: None, robot: None }).await.unwrap();
    let (mut heard, mut last) = (0, 0);
    while last < 100 {
        let people = people(&mut ben).await;
        let now = people.iter().find(|person| person.client == me).and_then(|person| person.looks_at.as_ref());
        let now = now.map_or(0, |moment| moment.at_ms);
        assert!(now >= last, "an older moment came after a newer one");
        (heard, last) = (heard + 1, now);
    }
    assert!(heard < 100, "{heard} messages");
    house.close().await;
}

#[tokio::test]
async fn a_link_that_is_lost_looks_nowhere_until_it_says_so_again() {
    let Together { house, aiko, play, mut ben, me, past, folder: _folder } = together().await;
    let at = moment(&past, 2_600);
    aiko.tell(looks(Some(at.clone()))).await.unwrap();
    until(&mut ben, &me, Some(&at)).await;
    let back = Client::connect_again(&house.url(), Some(aiko.credential()), "Aiko").await.unwrap();
    assert_eq!(back.you().client, me);
    back.load(&play).await.unwrap();
    until(&mut ben, &me, None).await;
    // Before it asks anything of that past it cannot say that it looks there.
    back.tell(looks(Some(at.clone()))).await.unwrap();
    back.ask(request::CallMe { name: "Aiko again".into() }).await.unwrap();
    while people(&mut ben).await.iter().all(|person| person.name != "Aiko again") {}
    ask(&back, &past, PastQuestion::Seek { at_ms: 2_600 }).await.unwrap();
    back.tell(looks(Some(at.clone()))).await.unwrap();
    let people = until(&mut ben, &me, Some(&at)).await;
    assert_eq!(people.iter().filter(|person| person.client == me).count(), 1);
    house.close().await;
}

/// A guest who may only look hears of it, and opens it by their own right alone.
#[tokio::test]
async fn who_follows_opens_the_past_by_their_own_right() {
    let scene = Scene::open().await;
    put(scene.data.path(), NEAR, &near(100, "ball.cm"));
    let past = recorded(NEAR);
    scene.aiko.load(&scene.play).await.unwrap();
    let (browser, invitation) = scene.guest(Role::Viewer).await;
    let mut ben = browser.socket("Ben").await.unwrap();
    ben.ask(request::Open { behaviour: scene.play.clone() }).await.unwrap();
    ask(&scene.aiko, &past, PastQuestion::Open).await.unwrap();
    let at = moment(&past, 2_600);
    scene.aiko.tell(looks(Some(at.clone()))).await.unwrap();
    let theirs = loop {
        if let Message::Event(Event::People { people, .. }) = ben.next().await.unwrap()
            && let Some(moment) = people.into_iter().find_map(|person| person.looks_at)
        {
            break moment;
        }
    };
    assert_eq!(theirs, at);
    let seek = || request::LookBack {
        past: theirs.past.clone(),
        question: Box::new(PastQuestion::Seek { at_ms: theirs.at_ms }),
    };
    ben.ask(seek()).await.unwrap();
    scene.aiko.ask(request::RemoveRecording { file: NEAR.to_owned() }).await.unwrap();
    assert_eq!(ben.ask(seek()).await.map(drop), Err(Refused::NoRecording), "hearing of it opens nothing");
    scene.aiko.ask(request::Revoke { invitation: invitation.id.clone() }).await.unwrap();
    assert!(ben.until_closed().await.is_some());
    scene.house.close().await;
}
