//! Attacks by what says that it is a robot: somebody added it, and now the server talks to it.

use crate::target::{Target, fresh};
use futures_util::future::join_all;
use house::Outcome;
use protocol::{RealRobot, request};
use qi::{Framer, Layout, MessageFrame, MessageHeader, MessageKind, Value, encode};
use shell::Client;
use std::time::Duration;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};

/// What a robot of this kind says.
#[derive(Clone, Copy)]
enum Lie {
    /// Anything, as fast as it goes.
    Garbage,
    /// Nothing.
    Silence,
    /// The head of a message of the largest size, and then zeros without end.
    Huge,
    /// Lets the server in, and answers everything with 4 MB of texts.
    Flood,
    /// Lets the server in, and answers everything with events that nobody asked for.
    Events,
}

const LIES: [Lie; 5] = [Lie::Garbage, Lie::Silence, Lie::Huge, Lie::Flood, Lie::Events];
/// Texts of a flooding answer, and bytes of each.
const TEXTS: usize = 4_096;
const TEXT_BYTES: usize = 1_024;
/// Events for one call.
const EVENTS: usize = 10_000;
/// Before the next look at all of them.
const PAUSE: Duration = Duration::from_millis(100);

/// Robots that lie, added and looked at again and again.
pub(crate) async fn lying(target: Target) {
    let _over = lie(&target).await;
}

async fn lie(target: &Target) -> Outcome<()> {
    let client = Client::connect(&target.url(), "Host").await?;
    let mut robots = Vec::new();
    for lie in LIES {
        let listener = TcpListener::bind("127.0.0.1:0").await?;
        let address = listener.local_addr()?.to_string();
        tokio::spawn(async move {
            while let Ok((stream, _)) = listener.accept().await {
                tokio::spawn(async move { drop(serve(stream, lie).await) });
            }
        });
        let real = RealRobot { address, user: None, password: None, fingerprint: None, identity: None };
        // As many as may be: those of an attack before are still there.
        let add = request::AddRobot { robot: fresh("r"), name: "Liar".to_owned(), real: Some(Box::new(real.clone())) };
        let _full = client.ask(add).await;
        robots.push(real);
    }
    loop {
        let looks =
            robots.iter().map(|real| client.ask(request::CheckRobot { real: Box::new(real.clone()), robot: None }));
        join_all(looks).await;
        tokio::time::sleep(PAUSE).await;
    }
}

async fn serve(mut stream: TcpStream, lie: Lie) -> std::io::Result<()> {
    let hello = MessageHeader { kind: MessageKind::Reply, flags: 0, id: 1, service: 0, object: 0, action: 8 };
    match lie {
        Lie::Garbage => loop {
            stream.write_all(&[0xA7; 65_536]).await?;
        },
        Lie::Silence => loop {
            if stream.read(&mut [0; 4_096]).await? == 0 {
                return Ok(());
            }
        },
        Lie::Huge => {
            stream.write_all(&hello.to_bytes(u32::try_from(qi::FRAME_MAX_BYTES).unwrap_or(u32::MAX))).await?;
            loop {
                stream.write_all(&[0; 65_536]).await?;
            }
        }
        Lie::Flood | Lie::Events => answer(stream, lie).await,
    }
}

/// As libqi at first, and then not.
async fn answer(mut stream: TcpStream, lie: Lie) -> std::io::Result<()> {
    let written = |signature: &str, value: &Value| {
        signature
            .parse()
            .ok()
            .and_then(|signature| encode(value, &signature, Layout::default()).ok())
            .unwrap_or_default()
    };
    let texts = Value::List(vec![Value::from("x".repeat(TEXT_BYTES).as_str()); TEXTS]);
    let flood = written("[s]", &texts);
    let can = written("{sm}", &Value::map([("__qi_auth_state", Value::dynamic(3_u32))]));
    let (mut framer, mut bytes) = (Framer::default(), vec![0; 65_536]);
    loop {
        match stream.read(&mut bytes).await? {
            0 => return Ok(()),
            read => framer.feed(&bytes[..read]),
        }
        while let Ok(Some(MessageFrame { header, .. })) = framer.next_frame() {
            if (header.service, header.action) == (0, 8) {
                say(&mut stream, MessageHeader { kind: MessageKind::Reply, flags: 0, ..header }, can.clone()).await?;
                continue;
            }
            if matches!(lie, Lie::Events) {
                for number in 0..EVENTS as u32 {
                    let event = MessageHeader { kind: MessageKind::Event, flags: 0, id: number, action: 106, ..header };
                    say(&mut stream, event, vec![0; 64]).await?;
                }
            }
            say(&mut stream, MessageHeader { kind: MessageKind::Reply, flags: 0, ..header }, flood.clone()).await?;
        }
    }
}

async fn say(stream: &mut TcpStream, header: MessageHeader, payload: Vec<u8>) -> std::io::Result<()> {
    let bytes = MessageFrame { header, payload }.to_bytes().ok_or(std::io::ErrorKind::InvalidData)?;
    stream.write_all(&bytes).await
}
