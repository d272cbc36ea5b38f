//! Links: greeting, nonsense, size, replacing, presence, and asking too much.

use crate::house::{House, id, plain, stream_id};
use futures_util::{SinkExt, StreamExt};
use protocol::{
    AnyAnswer, Ask, CanvasArea, Credential, Event, ListQuery, MESSAGE_MAX_BYTES, Message as Told, Person, Pointer,
    Refused, answer, request,
};
use shell::{Client, ClientError, NoLink};
use std::time::Duration;
use tokio::io::AsyncWriteExt;
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream, connect_async};

pub(crate) type Socket = WebSocketStream<MaybeTlsStream<TcpStream>>;

pub(crate) async fn socket(house: &House) -> Socket {
    connect_async(shell::handshake(&house.url()).await.unwrap()).await.unwrap().0
}

/// The greeting of somebody new.
fn hello() -> Message {
    Message::text(format!(r#"{{"ask":1,"request":{{"is":"hello","version":{},"name":"A"}}}}"#, protocol::VERSION))
}

/// Says a text and answers with the next text and the code of the closing frame, whichever come.
async fn say(socket: &mut Socket, text: &str) -> (Option<Refused>, Option<u16>) {
    socket.send(Message::text(text)).await.unwrap();
    let (mut no, mut code) = (None, None);
    while let Ok(Some(Ok(message))) = tokio::time::timeout(Duration::from_secs(5), socket.next()).await {
        match message {
            Message::Text(text) => {
                if let Told::No { no: said, .. } = serde_json::from_str::<Told>(&text).unwrap() {
                    no = Some(said);
                }
            }
            Message::Close(frame) => code = frame.map(|frame| frame.code.into()),
            _ => {}
        }
    }
    (no, code)
}

#[tokio::test]
async fn the_answer_to_a_ping_may_come_before_the_greeting() {
    let house = House::open().await;
    let mut socket = socket(&house).await;
    socket.send(Message::Pong(Vec::new().into())).await.unwrap();
    socket.send(hello()).await.unwrap();
    let welcome = loop {
        match socket.next().await.unwrap().unwrap() {
            Message::Text(text) => break serde_json::from_str::<Told>(&text).unwrap(),
            Message::Close(frame) => panic!("{frame:?}"),
            _ => {}
        }
    };
    assert!(matches!(welcome, Told::Answer { answer: AnyAnswer::Welcome(_), .. }), "{welcome:?}");
    house.close().await;
}

#[tokio::test]
async fn the_greeting_comes_first_and_in_our_version() {
    let house = House::open().await;
    let table = [
        (r#"{"ask":1,"request":{"is":"list"}}"#, Refused::Greeting),
        (r#"{"ask":1,"request":{"is":"hello","version":99,"name":"A"}}"#, Refused::Version(protocol::VERSION)),
    ];
    for (text, expected) in table {
        assert_eq!(say(&mut socket(&house).await, text).await, (Some(expected), Some(1008)));
    }
    let (no, code) = say(&mut socket(&house).await, "hello?").await;
    assert!(matches!(no, Some(Refused::Unreadable(_))) && code == Some(1008), "{no:?}");
    house.close().await;
}

#[tokio::test]
async fn a_message_that_is_too_large_ends_the_link() {
    let house = House::open().await;
    let mut socket = socket(&house).await;
    let hello = request::Hello { version: protocol::VERSION, name: "A".into(), again: None };
    let hello = serde_json::to_string(&protocol::Ask::new(1, hello)).unwrap();
    socket.send(Message::text(hello)).await.unwrap();
    let _ = socket.send(Message::text("x".repeat(MESSAGE_MAX_BYTES + 1))).await;
    let ended = async { while let Some(Ok(_)) = socket.next().await {} };
    tokio::time::timeout(Duration::from_secs(5), ended).await.expect("the link ends");
    house.person("Ben").await;
    house.close().await;
}

#[tokio::test]
async fn a_newer_link_of_the_same_client_replaces_the_older() {
    let house = House::open().await;
    let mut first = house.person("Aiko").await;
    let second = Client::connect_again(&house.url(), Some(first.credential()), "Aiko").await.unwrap();
    while first.next().await.is_some() {}
    let why = first.ask(request::List { query: ListQuery::default() }).await.unwrap_err();
    assert!(matches!(&why, ClientError::Link(NoLink::Replaced)), "{why}");
    assert!(second.ask(request::List { query: ListQuery::default() }).await.is_ok());
    assert_eq!(first.you(), second.you());
    house.close().await;
}

#[tokio::test]
async fn nobody_takes_over_the_link_of_somebody_they_see() {
    let house = House::open().await;
    let (mut aiko, play) = house.maker("Aiko").await;
    let seen = aiko.credential().client;
    let guesses = [seen.clone(), id("1"), id("aiko")];
    for secret in guesses {
        let again = Some(Credential { client: seen.clone(), secret });
        let ben = Client::connect_again(&house.url(), again, "Aiko").await.unwrap();
        assert_ne!(ben.you().client, seen);
        assert!(ben.load(&play).await.is_ok());
    }
    aiko.put("Add", stream_id("s"), Some(plain("Still here"))).await.unwrap();
    aiko.until(|reply| matches!(reply, Event::People { .. })).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn people_see_each_other_and_each_others_pointers() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    let mut ben = house.person("  Ben ").await;
    assert_eq!((ben.you().name.as_str(), aiko.you().color, ben.you().color), ("Ben", 0, 1));
    ben.load(&play).await.unwrap();
    let pointer = Some(Pointer { x: 3.0, y: 4.0 });
    let view = Some(CanvasArea { x: -50.0, y: 0.0, width: 800.0, height: 600.0 });
    aiko.tell(request::Present { pointer, selected: Some(id("s1")), view }).await.unwrap();
    let seen = |reply: &Event| matches!(reply, Event::People { people, .. } if people.iter().any(|p| p.pointer == pointer && p.view == view));
    ben.until(seen).await.unwrap();
    let (pointer, nowhere) =
        (Some(Pointer { x: 5.0, y: 1e300 }), Some(CanvasArea { x: 0.0, y: 0.0, width: 0.0, height: 1.0 }));
    aiko.tell(request::Present { pointer, selected: Some(id("s2")), view: nowhere }).await.unwrap();
    let left_out = |p: &Person| p.selected == Some(id("s2")) && p.pointer.is_none() && p.view.is_none();
    ben.until(|reply| matches!(reply, Event::People { people, .. } if people.iter().any(left_out))).await.unwrap();
    drop(aiko);
    ben.until(|reply| matches!(reply, Event::People { people, .. } if people.len() == 1)).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn a_new_name_is_told_at_once_and_stands_beside_what_is_edited() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Guest").await;
    aiko.put("Add", stream_id("s"), Some(plain("s"))).await.unwrap();
    let mut ben = house.person("Ben").await;
    ben.load(&play).await.unwrap();
    aiko.ask(request::Lock { behaviour: play.clone(), records: [stream_id("s")].into() }).await.unwrap();
    aiko.ask(request::CallMe { name: " Aiko\n".into() }).await.unwrap();
    let is_called = |reply: &Event| matches!(reply, Event::People { people, .. } if people[0].name == "Aiko");
    ben.until(is_called).await.unwrap();
    let edits = |reply: &Event| matches!(reply, Event::Locks { locks, .. } if locks.iter().any(|l| l.name == "Aiko"));
    ben.until(edits).await.unwrap();
    aiko.put("Add", stream_id("t"), Some(plain("t"))).await.unwrap();
    let added = |reply: &Event| matches!(reply, Event::Accepted { accepted, .. } if accepted.change.author == "Aiko");
    ben.until(added).await.unwrap();
    house.close().await;
}

#[tokio::test]
async fn who_asks_too_much_is_told_so_but_can_always_stop() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let watch = || request::Watch { robot: None, scene: false, values: false };
    // However slow this computer is, somebody who never pauses is refused sooner or later.
    let mut refused = 0;
    for _ in 0..20 {
        let asks: Vec<_> = (0..240).map(|_| aiko.ask(watch())).collect();
        let answers = futures_util::future::join_all(asks).await;
        refused = answers.iter().filter(|answer| **answer == Err(ClientError::No(Refused::TooFast))).count();
        assert!(
            answers.iter().all(|answer| !matches!(answer, Err(ClientError::Link(_)))),
            "nobody is cut off for that"
        );
        if refused > 0 {
            break;
        }
    }
    assert!((1..=40).contains(&refused), "{refused}");
    assert!(aiko.ask(request::Stop { behaviour: None, robot: None }).await.is_ok());
    house.close().await;
}

#[tokio::test]
async fn who_missed_changes_gets_them() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    for number in 0..5 {
        aiko.put("Add", stream_id(&format!("s{number}")), Some(plain(&format!("S{number}")))).await.unwrap();
    }
    let missed = aiko.ask(request::Since { behaviour: play, revision: 3 }).await.unwrap();
    let answer::Newer::Missed(answer::Missed { changes, .. }) = missed else { panic!() };
    assert_eq!(changes.iter().map(|change| change.revision).collect::<Vec<_>>(), [4, 5, 6]);
    house.close().await;
}

#[tokio::test]
async fn the_server_pings_with_the_revision() {
    let house = House::open().await;
    let (mut aiko, play) = house.maker("Aiko").await;
    let ping = aiko.until(|reply| matches!(reply, Event::Ping { behaviour: Some(_), .. })).await.unwrap();
    assert_eq!(ping, Event::Ping { behaviour: Some((play, 1)), library_revision: 1 });
    house.close().await;
}

/// Waits for the closing frame, whose code is this, and writes on: its own closing frame is not sent yet, and what is under
/// way to a server that let go of the link would break it. Who writes as the server's last word comes would not hear that.
async fn is_heard_until_it_knows(socket: &mut Socket, code: u16) {
    const EMPTY_PONG: [u8; 6] = [0x8A, 0x80, 0, 0, 0, 0];
    let why = loop {
        if let Message::Close(frame) = socket.next().await.unwrap().unwrap() {
            break frame.map(|frame| u16::from(frame.code));
        }
    };
    assert_eq!(why, Some(code));
    for _ in 0..50 {
        socket.get_mut().write_all(&EMPTY_PONG).await.unwrap();
        tokio::time::sleep(Duration::from_millis(1)).await;
    }
    while socket.next().await.is_some() {}
}

#[tokio::test]
async fn the_server_hears_everyone_until_they_know_that_it_ends() {
    let house = House::open().await;
    let mut socket = socket(&house).await;
    socket.send(hello()).await.unwrap();
    let _welcome = socket.next().await.unwrap().unwrap();
    let ending = tokio::spawn(house.close());
    is_heard_until_it_knows(&mut socket, 1012).await;
    ending.await.unwrap();
}

#[tokio::test]
async fn the_server_hears_who_is_replaced_until_they_know_it() {
    let house = House::open().await;
    let (mut older, mut newer) = (socket(&house).await, socket(&house).await);
    older.send(hello()).await.unwrap();
    let welcome = loop {
        if let Message::Text(text) = older.next().await.unwrap().unwrap() {
            break serde_json::from_str::<Told>(&text).unwrap();
        }
    };
    let Told::Answer { answer: AnyAnswer::Welcome(answer::Welcome { you, secret, .. }), .. } = welcome else {
        panic!("{welcome:?}")
    };
    let again = Some(Credential { client: you.client, secret });
    let request = request::Hello { version: protocol::VERSION, name: "A".into(), again };
    newer.send(Message::text(serde_json::to_string(&Ask::new(1, request)).unwrap())).await.unwrap();
    is_heard_until_it_knows(&mut older, 4000).await;
    house.close().await;
}

#[tokio::test]
async fn everyone_is_told_that_the_server_ends_and_what_was_acknowledged_is_there() {
    let folder = tempfile::tempdir().unwrap();
    let house = House::at(folder.path()).await;
    let (aiko, play) = house.maker("Aiko").await;
    let ben = house.person("Ben").await;
    ben.load(&play).await.unwrap();
    let (ended, ()) = tokio::join!(
        async {
            let mut made = 0;
            while aiko.put("Add", stream_id(&format!("s{made}")), Some(plain(&format!("S{made}")))).await.is_ok() {
                made += 1;
            }
            made
        },
        async {
            ben.put("Add", stream_id("first"), Some(plain("First"))).await.unwrap();
            house.close().await;
        }
    );
    for mut client in [aiko, ben] {
        while client.next().await.is_some() {}
        assert_eq!(client.why_ended(), Some(NoLink::Restart));
    }
    let again = House::at(folder.path()).await;
    let there = again.person("Aiko").await.load(&play).await.unwrap();
    let found = there.records.records.keys().filter(|record| record.kind == behaviour::Kind::Stream).count();
    // One more may have been saved whose answer nobody heard any more.
    assert!((ended + 1..=ended + 2).contains(&found), "{found} of {ended}");
    again.close().await;
}
