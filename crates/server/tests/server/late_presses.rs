//! Presses that a stalled link held back while somebody stopped the robot: none of them moves it, and pressing again does.

use crate::house::{House, connect, connector_id, printer, start, stream, stream_id};
use behaviour::{Id, Params, Record, StreamKind, Value, connectors};
use host_key::{HostKey, Published};
use protocol::{Event, Refused, RunPhase, request};
use robot::Control;
use shell::{Client, ClientError};
use std::net::SocketAddr;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;

/// The way to a server through which bytes of both directions pass only while it is open; none is lost.
struct Gate {
    address: SocketAddr,
    is_open: watch::Sender<bool>,
    /// The host's key counts at its address too.
    _key: Published,
}

impl Gate {
    async fn before(server: SocketAddr) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let (address, is_open) = (listener.local_addr().unwrap(), watch::Sender::new(true));
        let opens = is_open.subscribe();
        let key = host_key::of_server(server).unwrap();
        let key = host_key::publish(&HostKey { address, key }, None);
        tokio::spawn(async move {
            while let Ok((client, _)) = listener.accept().await {
                let server = TcpStream::connect(server).await.unwrap();
                let ((from_client, to_client), (from_server, to_server)) = (client.into_split(), server.into_split());
                tokio::spawn(carry(from_client, to_server, opens.clone()));
                tokio::spawn(carry(from_server, to_client, opens.clone()));
            }
        });
        Self { address, is_open, _key: key }
    }

    async fn person(&self, name: &str) -> Client {
        Client::connect(&format!("http://{}/", self.address), name).await.unwrap()
    }
}

async fn carry(
    mut from: impl AsyncReadExt + Unpin,
    mut to: impl AsyncWriteExt + Unpin,
    mut opens: watch::Receiver<bool>,
) {
    let mut bytes = [0; 4096];
    while let Ok(count @ 1..) = from.read(&mut bytes).await {
        if opens.wait_for(|is_open| *is_open).await.is_err() || to.write_all(&bytes[..count]).await.is_err() {
            return;
        }
    }
}

/// A program whose action shows what comes to it.
async fn touched(client: &Client, play: &Id) {
    let head = Record::Stream(stream("Head", StreamKind::Sensor, Some("HeadTouch")));
    let through = connect(connectors::subscribe::SPEC.with(()), &["head"], "out");
    client.load(play).await.unwrap();
    for (id, record) in [(stream_id("head"), head), (stream_id("out"), printer("Out")), (connector_id("c"), through)] {
        client.put("Add", id, Some(record)).await.unwrap();
    }
}

fn pretend(play: &Id, value: i64) -> request::Stimulate {
    let (behaviour, value) = (play.clone(), Value::Int(value));
    request::Stimulate { behaviour, robot: None, stream: "head".parse().unwrap(), value }
}

fn hand() -> request::Hand {
    let (device, params) = ("Print".to_owned(), Params::default());
    request::Hand { robot: None, device, params, value: Value::Int(1) }
}

async fn until_told(client: &mut Client, play: &Id, is_so: impl Fn(&RunPhase) -> bool) {
    let newest = |event: &Event| match event {
        Event::Runs { runs, .. } => {
            runs.iter().rfind(|run| run.behaviour == *play).is_some_and(|run| is_so(&run.phase))
        }
        _ => false,
    };
    client.until(newest).await.unwrap();
}

/// The person who stops it while the link of the one who presses stalls.
async fn stop(house: &House, ben: &Client, way: &str) {
    match way {
        "socket" => {
            ben.ask(request::Stop { behaviour: None, robot: None }).await.unwrap();
        }
        "page" => {
            let mut stream = TcpStream::connect(house.address).await.unwrap();
            let (host, key) = (house.address, house.key());
            let head = format!("POST /stop HTTP/1.1\r\nHost: {host}\r\n{}: {key}\r\n", host_key::HEADER);
            stream.write_all(format!("{head}Content-Length: 0\r\n\r\n").as_bytes()).await.unwrap();
            let mut said = String::new();
            stream.read_to_string(&mut said).await.unwrap();
            assert!(said.starts_with("HTTP/1.1 2") || said.starts_with("HTTP/1.1 3"), "{said}");
        }
        _ => {
            let robot = first_robot(ben).await;
            // A simulated robot has no motors to rest; what ran is stopped all the same.
            drop(ben.ask(request::ControlRobot { robot, control: Control::Rest }).await);
        }
    }
}

async fn first_robot(client: &Client) -> Id {
    client.ask(request::Runs {}).await.unwrap().runs[0].robot.clone()
}

#[tokio::test]
async fn what_a_stalled_link_held_back_does_not_move_the_robot_after_a_stop() {
    for way in ["socket", "page", "rest"] {
        let house = House::open().await;
        let (mut ben, play) = house.maker("Ben").await;
        touched(&ben, &play).await;
        let gate = Gate::before(house.address).await;
        let mut aiko = gate.person("Aiko").await;
        aiko.ask(start(&play)).await.unwrap();
        aiko.ask(pretend(&play, 1)).await.unwrap();
        aiko.ask(hand()).await.unwrap();
        let robot = first_robot(&aiko).await;
        gate.is_open.send_replace(false);
        let held = tokio::spawn({
            let (play, robot) = (play.clone(), robot.clone());
            async move {
                let stand = request::ControlRobot { robot, control: Control::Stand };
                let apply = request::Apply { behaviour: play.clone(), robot: None };
                let (start, pretend) = (start(&play), pretend(&play, 2));
                let asked = [pretend.into(), hand().into(), apply.into(), stand.into(), start.into()];
                (futures_util::future::join_all(asked.map(|request| aiko.ask_any(request))).await, aiko)
            }
        });
        until_told(&mut ben, &play, |phase| *phase == RunPhase::Running).await;
        stop(&house, &ben, way).await;
        until_told(&mut ben, &play, |phase| matches!(phase, RunPhase::Stopped(_))).await;
        // Even what runs again was not meant.
        ben.ask(start(&play)).await.unwrap();
        until_told(&mut ben, &play, |phase| *phase == RunPhase::Running).await;
        assert!(!held.is_finished(), "{way}: the link stalls");
        gate.is_open.send_replace(true);
        let (answers, again) = held.await.unwrap();
        aiko = again;
        assert_eq!(answers, vec![Err(ClientError::No(Refused::StoppedSince)); 5], "{way}");
        // Nothing came through, and what is pressed now counts at once.
        assert_eq!(aiko.ask(pretend(&play, 3)).await, Ok(()), "{way}");
        assert_eq!(aiko.ask(hand()).await, Ok(()), "{way}");
        let told = |event: &Event| match event {
            Event::Values { values } => values.streams.iter().find(|one| one.stream.as_str() == "out").cloned(),
            _ => None,
        };
        let mut out = None;
        ben.until(|event| {
            out = told(event).filter(|one| one.value == Value::Int(3));
            out.is_some()
        })
        .await
        .unwrap();
        assert_eq!(out.map(|out| out.count), Some(1), "{way}: the value that was held back never came");
        house.close().await;
    }
}

#[tokio::test]
async fn who_pressed_stop_starts_again_at_once() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    touched(&aiko, &play).await;
    for _ in 0..20 {
        aiko.ask(start(&play)).await.unwrap();
        aiko.ask(request::Stop { behaviour: None, robot: None }).await.unwrap();
        assert_eq!(aiko.ask(hand()).await, Ok(()));
    }
    house.close().await;
}

#[tokio::test]
async fn who_comes_just_after_a_stop_presses_after_it() {
    let house = House::open().await;
    let (aiko, play) = house.maker("Aiko").await;
    touched(&aiko, &play).await;
    for round in 0..20 {
        aiko.ask(start(&play)).await.unwrap();
        aiko.ask(request::Stop { behaviour: None, robot: None }).await.unwrap();
        let ben = house.person("Ben").await;
        assert_eq!(ben.ask(hand()).await, Ok(()), "round {round}");
        assert!(ben.ask(start(&play)).await.is_ok(), "round {round}");
    }
    house.close().await;
}
