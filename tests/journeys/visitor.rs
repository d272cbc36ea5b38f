//! Somebody without a page: talks to the server over its socket, to look at the room and to ask what no page offers.

use std::time::{Duration, Instant};

use behaviour::{Behaviour, Change, Id, RecordId};
use futures_util::{SinkExt, StreamExt};
use house::{Outcome, Server, Trouble};
use protocol::{
    Ask, Event, ListQuery, LockShown, Message, Refused, Request, RequestAnswer, RunPhase, RunState, request,
};
use robot::Scene;
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::Message as Frame;
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream};

/// How long anything may take.
const PATIENCE: Duration = Duration::from_secs(30);

/// A second connection.
pub(crate) struct Visitor {
    socket: WebSocketStream<MaybeTlsStream<TcpStream>>,
    asked: u32,
    /// Who is editing what, as it was heard last.
    locks: Vec<LockShown>,
}

/// A behaviour as the server has it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Opened {
    pub(crate) id: Id,
    pub(crate) revision: u64,
    pub(crate) records: Behaviour,
}

impl Opened {
    /// The id of the stream with this name.
    pub(crate) fn stream(&self, name: &str) -> Outcome<Id> {
        let found = self.records.streams().find(|(_, stream)| stream.name == name);
        found.map(|(id, _)| id.clone()).ok_or_else(|| Trouble(format!("There is no stream {name}.")))
    }
}

impl Visitor {
    /// Comes in and greets.
    pub(crate) async fn enter(server: &Server) -> Outcome<Self> {
        Self::enter_as(server, "Visitor").await
    }

    /// Comes in by this name.
    pub(crate) async fn enter_as(server: &Server, name: &str) -> Outcome<Self> {
        let address = server.url();
        let asked = shell::handshake(&address).await.map_err(|error| Trouble(format!("{address}: {error}")))?;
        let connected = tokio_tungstenite::connect_async(asked).await;
        let (socket, _) = connected.map_err(|error| Trouble(format!("{address}: {error}")))?;
        let mut visitor = Self { socket, asked: 0, locks: Vec::new() };
        let hello = request::Hello { version: protocol::VERSION, name: name.to_owned(), again: None };
        visitor.ask(hello).await?;
        Ok(visitor)
    }

    /// Asks what must not be refused, and reads on until the answer.
    pub(crate) async fn ask<R: Request>(&mut self, request: R) -> Outcome<R::Answer> {
        self.try_to(request).await?.map_err(|no| Trouble(format!("This was refused: {no}")))
    }

    /// Asks what may be refused, and reads on until the answer.
    pub(crate) async fn try_to<R: Request>(&mut self, request: R) -> Outcome<Result<R::Answer, Refused>> {
        self.asked += 1;
        let text = serde_json::to_string(&Ask::new(self.asked, request))?;
        self.socket.send(Frame::text(text)).await.map_err(|error| Trouble(error.to_string()))?;
        let mine = self.asked;
        match self.hear(|message| message.answer_to(mine), "the answer").await? {
            Ok(answer) => Ok(Ok(R::Answer::of(answer).ok_or("Something else was answered.")?)),
            Err(no) => Ok(Err(no)),
        }
    }

    /// Opens the behaviour that was changed last.
    pub(crate) async fn open_newest(&mut self) -> Outcome<Opened> {
        let query = ListQuery::default();
        let programs = self.ask(request::List { query }).await?.programs;
        let newest = programs.first().ok_or("There is no program.")?;
        self.open(&id(&newest.id)?).await
    }

    /// Opens a behaviour, or looks at it again.
    pub(crate) async fn open(&mut self, behaviour: &Id) -> Outcome<Opened> {
        let opened = self.ask(request::Open { behaviour: behaviour.clone() }).await?;
        Ok(Opened { id: opened.behaviour, revision: opened.revision, records: *opened.records })
    }

    /// Proposes a change that must be refused; answers with the sentence.
    pub(crate) async fn refused(&mut self, behaviour: &Id, change: Change) -> Outcome<String> {
        match self.try_to(request::Propose { behaviour: behaviour.clone(), change, tokens: Vec::new() }).await? {
            Err(no) => Ok(no.to_string()),
            Ok(other) => Err(Trouble(format!("A bad edit was answered with {other:?}."))),
        }
    }

    /// Waits until it is heard that this person is editing a record.
    pub(crate) async fn edited(&mut self, record: &RecordId, name: &str) -> Outcome<()> {
        self.held(record, Some(name), &format!("{name} is editing {record}")).await
    }

    /// Waits until it is heard that nobody is editing a record.
    pub(crate) async fn freed(&mut self, record: &RecordId) -> Outcome<()> {
        self.held(record, None, &format!("nobody is editing {record}")).await
    }

    async fn held(&mut self, record: &RecordId, name: Option<&str>, what: &str) -> Outcome<()> {
        let by = |locks: &[LockShown]| {
            locks.iter().find(|lock| lock.records.contains(record)).map(|lock| lock.name.as_str()) == name
        };
        if by(&self.locks) {
            return Ok(());
        }
        let look = |message: Message| {
            let Message::Event(Event::Locks { locks, .. }) = message else { return None };
            by(&locks).then_some(())
        };
        self.hear(look, what).await
    }

    /// Waits until so many programs run.
    pub(crate) async fn runs(&mut self, what: &str, wanted: usize) -> Outcome<()> {
        let look = |message: Message| {
            let Message::Event(Event::Runs { runs, .. }) = message else { return None };
            (runs.iter().filter(|run| run.phase == RunPhase::Running).count() == wanted).then_some(())
        };
        self.hear(look, what).await
    }

    /// The newest run.
    pub(crate) async fn newest_run(&mut self) -> Outcome<RunState> {
        let look = |message: Message| {
            let Message::Event(Event::Runs { runs, .. }) = message else { return None };
            runs.into_iter().max_by_key(|run| run.run)
        };
        self.hear(look, "what runs").await
    }

    /// The first picture of the room from now on that is as wanted; `what` says it in words.
    pub(crate) async fn scene(&mut self, what: &str, wanted: impl Fn(&Scene) -> bool) -> Outcome<Scene> {
        let mut last = None;
        let look = |message: Message| match message {
            Message::Event(Event::Scene { scene, .. }) if wanted(&scene) => Some(*scene),
            Message::Event(Event::Scene { scene, .. }) => {
                last = Some(scene);
                None
            }
            _ => None,
        };
        let seen = self.hear(look, what).await;
        seen.map_err(|trouble| Trouble(format!("{trouble}; the last picture was {last:?}")))
    }

    /// Reads messages until one is what is looked for.
    async fn hear<T>(&mut self, mut look: impl FnMut(Message) -> Option<T>, what: &str) -> Outcome<T> {
        let began = Instant::now();
        while let Some(left) = PATIENCE.checked_sub(began.elapsed()) {
            match tokio::time::timeout(left, self.socket.next()).await {
                Ok(Some(Ok(Frame::Text(text)))) => {
                    let message: Message = serde_json::from_str(&text)?;
                    if let Message::Event(Event::Locks { locks, .. }) = &message {
                        self.locks.clone_from(locks);
                    }
                    if let Some(found) = look(message) {
                        return Ok(found);
                    }
                }
                Ok(Some(Ok(_))) => {}
                Ok(Some(Err(error))) => return Err(Trouble(format!("{what}: the socket broke ({error})"))),
                Ok(None) => return Err(Trouble(format!("{what}: the server closed the socket"))),
                Err(_) => break,
            }
        }
        Err(Trouble(format!("{what}: not within {} s", PATIENCE.as_secs())))
    }
}

/// An id from a text.
pub(crate) fn id(text: &str) -> Outcome<Id> {
    Ok(Id::new(text)?)
}
