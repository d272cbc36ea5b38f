//! A server that speaks just enough Bolt 4.4 to misbehave on purpose, for tests.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};

/// The fate of a statement.
#[derive(Clone, Debug)]
pub(super) enum StatementFate {
    /// One row of these names and values.
    Row(Vec<(&'static str, RowValue)>),
    /// One row of these names and values, after a while.
    Late(Duration, Vec<(&'static str, RowValue)>),
    /// It is refused at once, with this code.
    Refused(&'static str),
    /// It begins well, and fails with this code when its rows are asked for.
    Fails(&'static str),
    /// It begins well, and then the connection is closed.
    Closed,
    /// Nothing is ever said.
    Silence,
}

/// A value in a row.
#[derive(Clone, Copy, Debug)]
pub(super) enum RowValue {
    Null,
    Truth(bool),
    Small(u8),
    Text(&'static str),
}

/// The stage to which a connection gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ConnectStage {
    /// Statements are answered.
    Open,
    /// It is taken, but nothing is said.
    SilentAtAccept,
    /// The version is agreed, but nothing is said after that.
    SilentAfterHandshake,
    /// User and password are refused.
    WrongPassword,
}

/// The server. It ends with the test's runtime.
pub(super) struct Peer {
    pub(super) place: String,
    script: Arc<Mutex<Script>>,
}

#[derive(Debug)]
struct Script {
    door: ConnectStage,
    answers: VecDeque<StatementFate>,
    otherwise: StatementFate,
    statements: usize,
}

const MAGIC: [u8; 4] = [0x60, 0x60, 0xB0, 0x17];
const BOLT_4_4: [u8; 4] = [0, 0, 4, 4];

const HELLO: u8 = 0x01;
const RESET: u8 = 0x0F;
const RUN: u8 = 0x10;
const PULL: u8 = 0x3F;
const SUCCESS: u8 = 0x70;
const RECORD: u8 = 0x71;
const IGNORED: u8 = 0x7E;
const FAILURE: u8 = 0x7F;

impl Peer {
    /// A server that gives these answers in order, and then the other one for ever.
    pub(super) async fn start(
        door: ConnectStage,
        answers: impl IntoIterator<Item = StatementFate>,
        otherwise: StatementFate,
    ) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let place = listener.local_addr().expect("a place").to_string();
        let answers = answers.into_iter().collect();
        let script = Arc::new(Mutex::new(Script { door, answers, otherwise, statements: 0 }));
        let told = Arc::clone(&script);
        tokio::spawn(async move {
            while let Ok((stream, _)) = listener.accept().await {
                let script = Arc::clone(&told);
                // An error is the other side's end.
                tokio::spawn(async move { serve(stream, &script).await.is_ok() });
            }
        });
        Self { place, script }
    }

    /// Returns the number of statements that came so far.
    pub(super) fn statements(&self) -> usize {
        self.script.lock().unwrap_or_else(PoisonError::into_inner).statements
    }

    /// Behaves differently from now on, towards new connections.
    pub(super) fn set_door(&self, door: ConnectStage) {
        self.script.lock().unwrap_or_else(PoisonError::into_inner).door = door;
    }
}

fn door(script: &Mutex<Script>) -> ConnectStage {
    script.lock().unwrap_or_else(PoisonError::into_inner).door
}

fn next_answer(script: &Mutex<Script>) -> StatementFate {
    let mut script = script.lock().unwrap_or_else(PoisonError::into_inner);
    script.statements += 1;
    script.answers.pop_front().unwrap_or_else(|| script.otherwise.clone())
}

async fn silence() -> ! {
    loop {
        tokio::time::sleep(Duration::from_secs(3600)).await;
    }
}

async fn serve(mut stream: TcpStream, script: &Mutex<Script>) -> std::io::Result<()> {
    let mut hello = [0; 20];
    stream.read_exact(&mut hello).await?;
    assert_eq!(hello[..4], MAGIC, "the other side speaks Bolt");
    if door(script) == ConnectStage::SilentAtAccept {
        silence().await;
    }
    stream.write_all(&BOLT_4_4).await?;
    if door(script) == ConnectStage::SilentAfterHandshake {
        silence().await;
    }
    let (mut answer, mut ignoring) = (None, false);
    loop {
        match kind_of_next(&mut stream).await? {
            HELLO if door(script) == ConnectStage::WrongPassword => {
                say(&mut stream, &failure("Neo.ClientError.Security.Unauthorized")).await?;
            }
            HELLO => say(&mut stream, &hello_back()).await?,
            RESET => {
                ignoring = false;
                say(&mut stream, &map(SUCCESS, &[])).await?;
            }
            RUN => {
                let next = next_answer(script);
                ignoring = begin(&mut stream, &next).await?;
                answer = Some(next);
            }
            PULL if ignoring => say(&mut stream, &[0xB0, IGNORED]).await?,
            PULL => match answer.take() {
                Some(StatementFate::Row(row) | StatementFate::Late(_, row)) => give(&mut stream, &row).await?,
                Some(StatementFate::Fails(code)) => {
                    ignoring = true;
                    say(&mut stream, &failure(code)).await?;
                }
                Some(StatementFate::Closed | StatementFate::Refused(_) | StatementFate::Silence) | None => {
                    return Ok(());
                }
            },
            _ => return Ok(()),
        }
    }
}

/// Answers RUN; true if what follows is to be ignored.
async fn begin(stream: &mut TcpStream, answer: &StatementFate) -> std::io::Result<bool> {
    let names: Vec<&str> = match answer {
        StatementFate::Silence => silence().await,
        StatementFate::Refused(code) => {
            say(stream, &failure(code)).await?;
            return Ok(true);
        }
        StatementFate::Late(time, row) => {
            tokio::time::sleep(*time).await;
            row.iter().map(|(name, _)| *name).collect()
        }
        StatementFate::Row(row) => row.iter().map(|(name, _)| *name).collect(),
        StatementFate::Fails(_) | StatementFate::Closed => Vec::new(),
    };
    let mut fields = vec![0x90 + u8::try_from(names.len()).expect("few fields")];
    names.iter().for_each(|name| fields.extend(text(name)));
    say(stream, &map(SUCCESS, &[("fields", fields)])).await?;
    Ok(false)
}

async fn give(stream: &mut TcpStream, row: &[(&str, RowValue)]) -> std::io::Result<()> {
    let mut record = vec![0xB1, RECORD, 0x90 + u8::try_from(row.len()).expect("few values")];
    record.extend(row.iter().flat_map(|(_, value)| match value {
        RowValue::Null => vec![0xC0],
        RowValue::Truth(false) => vec![0xC2],
        RowValue::Truth(true) => vec![0xC3],
        RowValue::Small(number) => vec![*number],
        RowValue::Text(words) => text(words),
    }));
    say(stream, &record).await?;
    say(stream, &map(SUCCESS, &[("type", text("rw"))])).await
}

/// Reads one message; its second byte says what it is.
async fn kind_of_next(stream: &mut TcpStream) -> std::io::Result<u8> {
    let mut message = Vec::new();
    loop {
        match stream.read_u16().await? {
            0 if message.is_empty() => {}
            0 => return Ok(message.get(1).copied().unwrap_or_default()),
            length => {
                let start = message.len();
                message.resize(start + usize::from(length), 0);
                stream.read_exact(&mut message[start..]).await?;
            }
        }
    }
}

async fn say(stream: &mut TcpStream, message: &[u8]) -> std::io::Result<()> {
    let length = u16::try_from(message.len()).expect("a short message");
    let framed = [&length.to_be_bytes(), message, &[0, 0]].concat();
    stream.write_all(&framed).await
}

fn hello_back() -> Vec<u8> {
    map(SUCCESS, &[("server", text("Neo4j/5.26.0")), ("connection_id", text("bolt-1"))])
}

fn failure(code: &str) -> Vec<u8> {
    map(FAILURE, &[("code", text(code)), ("message", text("on purpose"))])
}

fn map(kind: u8, entries: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let mut message = vec![0xB1, kind, 0xA0 + u8::try_from(entries.len()).expect("few entries")];
    for (name, value) in entries {
        message.extend(text(name));
        message.extend(value);
    }
    message
}

fn text(text: &str) -> Vec<u8> {
    let length = u8::try_from(text.len()).expect("a short text");
    [&[0xD0, length], text.as_bytes()].concat()
}
