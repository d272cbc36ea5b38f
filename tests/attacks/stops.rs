//! Pressing Stop again and again, and how long each took until it was answered.

use crate::target::Target;
use futures_util::{SinkExt, StreamExt};
use house::Outcome;
use protocol::{AnyRequest, Ask, Message as Told, VERSION, request};
use std::fmt;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};
use tokio_tungstenite::tungstenite::Message;

/// Between two Stops.
const PAUSE: Duration = Duration::from_millis(3);
/// After this a Stop counts as not answered.
const PATIENCE: Duration = Duration::from_secs(10);

/// How long Stops took by one way, in milliseconds.
pub(crate) struct Spread {
    pub(crate) p50: u128,
    pub(crate) p99: u128,
    pub(crate) worst: u128,
}

/// How long they took by both.
pub(crate) struct Stops {
    http: Spread,
    socket: Spread,
}

impl Stops {
    pub(crate) fn each(&self) -> [&Spread; 2] {
        [&self.http, &self.socket]
    }
}

impl fmt::Display for Stops {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let [http, socket] = self.each();
        write!(to, "Stop over HTTP {} / {} / {} ms, ", http.p50, http.p99, http.worst)?;
        write!(to, "over a socket {} / {} / {} ms (p50 / p99 / worst)", socket.p50, socket.p99, socket.worst)
    }
}

/// Presses Stop so often by each way, on two threads.
pub(crate) fn measure(target: &Target, stops: usize) -> Outcome<Stops> {
    let (one, other) = (target.clone(), target.clone());
    let http = std::thread::spawn(move || spread(over_http(&one, stops)));
    let socket = std::thread::spawn(move || spread(over_socket(&other, stops)));
    let ended = |_| "A thread that pressed Stop panicked.";
    Ok(Stops { http: http.join().map_err(ended)??, socket: socket.join().map_err(ended)?? })
}

fn spread(taken: Outcome<Vec<Duration>>) -> Outcome<Spread> {
    let mut taken = taken?;
    taken.sort_unstable();
    let at =
        |part: usize| taken.get((taken.len() * part).div_ceil(100).saturating_sub(1)).map_or(0, Duration::as_millis);
    Ok(Spread { p50: at(50), p99: at(99), worst: at(100) })
}

fn over_http(target: &Target, stops: usize) -> Outcome<Vec<Duration>> {
    let request = format!("POST /stop HTTP/1.1\r\nHost: {}\r\nContent-Length: 0\r\n\r\n", target.address);
    let press = |_| {
        std::thread::sleep(PAUSE);
        let began = Instant::now();
        let mut stream = TcpStream::connect_timeout(&target.address, PATIENCE)?;
        stream.set_read_timeout(Some(PATIENCE))?;
        stream.write_all(request.as_bytes())?;
        let mut answer = String::new();
        stream.read_to_string(&mut answer)?;
        let took = began.elapsed();
        if answer.starts_with("HTTP/1.1 200") { Ok(took) } else { Err(format!("Stop: {answer:?}").into()) }
    };
    (0..stops).map(press).collect()
}

fn over_socket(target: &Target, stops: usize) -> Outcome<Vec<Duration>> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    runtime.block_on(async {
        // It may take a few tries to get in; who is in can stop.
        let mut socket = loop {
            if let Ok(Some(socket)) = tokio::time::timeout(PATIENCE, greeted(target)).await.map(Result::ok) {
                break socket;
            }
        };
        let mut taken = Vec::with_capacity(stops);
        for ask in 2..stops as u32 + 2 {
            tokio::time::sleep(PAUSE).await;
            let began = Instant::now();
            socket.send(said(ask, request::Stop { behaviour: None, robot: None })?).await?;
            tokio::time::timeout(PATIENCE, answered(&mut socket, ask))
                .await
                .map_err(|_| "A Stop was not answered.")??;
            taken.push(began.elapsed());
        }
        Ok(taken)
    })
}

type Socket = tokio_tungstenite::WebSocketStream<tokio_tungstenite::MaybeTlsStream<tokio::net::TcpStream>>;

/// A link that was let in and asks for no pictures.
pub(crate) async fn greeted(target: &Target) -> Outcome<Socket> {
    let (mut socket, _) = tokio_tungstenite::connect_async(shell::handshake(&target.url()).await?).await?;
    let hello = request::Hello { version: VERSION, name: "Operator".to_owned(), again: None };
    socket.send(said(0, hello)?).await?;
    answered(&mut socket, 0).await?;
    socket.send(said(1, request::Watch { robot: None, scene: false, values: false })?).await?;
    answered(&mut socket, 1).await?;
    Ok(socket)
}

/// A request as a message.
pub(crate) fn said(ask: u32, request: impl Into<AnyRequest>) -> Outcome<Message> {
    Ok(Message::text(serde_json::to_string(&Ask::new(ask, request))?))
}

async fn answered(socket: &mut Socket, ask: u32) -> Outcome<()> {
    while let Some(message) = socket.next().await {
        let Message::Text(text) = message? else { continue };
        let told: Told = serde_json::from_str(&text)?;
        if let Some(outcome) = told.answer_to(ask) {
            return outcome.map(drop).map_err(|no| no.to_string().into());
        }
    }
    Err("The link ended.".into())
}
