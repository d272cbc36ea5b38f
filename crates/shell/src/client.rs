//! A client of the server: asks and is answered, hears what is told, and keeps its open behaviour up to date.

mod link;
mod mirror;

pub use link::handshake;
pub use mirror::Mirror;

use crate::client::link::{AskOutcome, ConsoleLink, OpenRequest};
use behaviour::{Behaviour, Change, Id, Record, RecordId};
use protocol::{
    AnyAnswer, AnyRequest, Credential, Event, ListQuery, Person, Refused, Request, RequestAnswer, RobotState, Summary,
    Unanswered, VERSION, answer, request,
};
use std::hash::{BuildHasher, RandomState};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};
use std::time::Duration;
use tokio::sync::{mpsc, oneshot};
use tokio::task::AbortHandle;

/// The address of a server when nobody says otherwise.
pub const DEFAULT_URL: &str = "http://127.0.0.1:7130/";

/// The longest time of an answer.
const ANSWER_MS: u64 = 30_000;
/// The wait when the server says that it is asked too much.
const SLOWER_MS: u64 = 100;
/// The longest wait for something awaited.
const AWAITED_MS: u64 = 20_000;

/// The reasons why something asked was not done.
#[derive(Clone, Debug, PartialEq)]
pub enum ClientError {
    /// The server said no.
    No(Refused),
    /// The link failed.
    Link(NoLink),
}

/// The reasons why a link to a server failed. [`std::fmt::Display`] says each in one English sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum NoLink {
    /// There is no server at this address.
    NoServer {
        /// The address, as it was given.
        url: String,
        /// The error of the network, in its own words.
        error: String,
    },
    /// The server at this address does not take the connection.
    Silent(String),
    /// The server at this address runs for another user, who is its host.
    NotHost(String),
    /// An id of our own is none; with the reason.
    Id(String),
    /// The server answered something else than what was asked: it is of another version.
    OtherAnswer,
    /// An answer did not come in time.
    Unanswered,
    /// Something to be told did not come in time.
    Awaited,
    /// It has ended, and nobody knows why.
    Ended,
    /// It was closed here.
    Closed,
    /// Nothing came from the server for so long that it must be gone.
    Unheard,
    /// It was lost; with what the network says.
    Lost(String),
    /// The server ended it.
    EndedByServer,
    /// The server itself ended.
    Restart,
    /// The client took too slowly what it was told.
    TooSlow,
    /// Another link of this client took its place.
    Replaced,
    /// The server ended it; with the reason it gives.
    EndedBecause(String),
}

impl From<NoLink> for ClientError {
    fn from(why: NoLink) -> Self {
        Self::Link(why)
    }
}

impl std::error::Error for ClientError {}

/// A greeted link to a server; dropping it ends the link.
pub struct Client {
    link: Arc<ConsoleLink>,
    lines: mpsc::Sender<OpenRequest>,
    told: mpsc::Receiver<Event>,
    asks: AtomicU32,
    welcome: Welcome,
    carrier: AbortHandle,
}

/// The first message of the server.
#[derive(Clone, Debug)]
struct Welcome {
    epoch: u64,
    you: Person,
    secret: Id,
}

impl Client {
    /// Connects to `http://HOST:PORT/` (or `HOST:PORT`) and greets as `name`.
    ///
    /// # Errors
    /// If there is no server, or it refuses the greeting.
    pub async fn connect(url: &str, name: &str) -> Result<Self, ClientError> {
        Self::connect_again(url, None, name).await
    }

    /// Connects as who one was on an earlier link, which this one replaces: see [`Client::credential`].
    ///
    /// # Errors
    /// If there is no server, or it refuses the greeting.
    pub async fn connect_again(url: &str, again: Option<Credential>, name: &str) -> Result<Self, ClientError> {
        let (link, lines, told, carrier) = link::open(url).await?;
        let nobody = Id::new("nobody").map_err(|reason| NoLink::Id(reason.to_string()))?;
        let client = nobody.clone();
        let you = Person {
            client,
            name: name.to_owned(),
            color: 0,
            pointer: None,
            selected: None,
            view: None,
            looks_at: None,
        };
        let welcome = Welcome { epoch: 0, you, secret: nobody };
        let mut this = Self { link, lines, told, asks: AtomicU32::new(0), welcome, carrier };
        let hello = request::Hello { version: VERSION, name: name.to_owned(), again };
        let answer::Welcome { epoch, you, secret, .. } = this.ask(hello).await?;
        this.welcome = Welcome { epoch, you, secret };
        Ok(this)
    }

    /// Returns the credential that proves to the server on a later link that it is this client.
    #[must_use]
    pub fn credential(&self) -> Credential {
        Credential { client: self.welcome.you.client.clone(), secret: self.welcome.secret.clone() }
    }

    /// Returns the person who this client is to others.
    #[must_use]
    pub fn you(&self) -> &Person {
        &self.welcome.you
    }

    /// Grows with every start of the server.
    #[must_use]
    pub fn epoch(&self) -> u64 {
        self.welcome.epoch
    }

    /// Asks and waits for the answer.
    ///
    /// # Errors
    /// If the server says no, or the link ends.
    pub async fn ask<R: Request>(&self, request: R) -> Result<R::Answer, ClientError> {
        let answer = self.ask_any(request.into()).await?;
        R::Answer::of(answer).ok_or(NoLink::OtherAnswer.into())
    }

    /// Asks something that is known only when it runs, as [`Self::ask`] does.
    ///
    /// # Errors
    /// If the server says no, or the link ends.
    pub async fn ask_any(&self, request: AnyRequest) -> Result<AnyAnswer, ClientError> {
        let (waiting, answer) = oneshot::channel();
        self.send(request, Some(waiting)).await?;
        let answered = tokio::time::timeout(Duration::from_millis(ANSWER_MS), answer).await;
        match answered {
            Ok(Ok(outcome)) => outcome.map_err(ClientError::No),
            Ok(Err(_)) => Err(self.ended()),
            Err(_) => Err(NoLink::Unanswered.into()),
        }
    }

    /// Says what is not answered.
    ///
    /// # Errors
    /// If the link ended.
    pub async fn tell(&self, request: impl Request<Answer = Unanswered>) -> Result<(), ClientError> {
        self.send(request.into(), None).await
    }

    async fn send(&self, request: AnyRequest, waiting: Option<oneshot::Sender<AskOutcome>>) -> Result<(), ClientError> {
        let ask = self.asks.fetch_add(1, Ordering::Relaxed) + 1;
        let stops = self.link.stops();
        self.lines.send(OpenRequest { ask, stops, request, waiting }).await.map_err(|_| self.ended())
    }

    /// Returns the reason why the link ended, if it did.
    #[must_use]
    pub fn why_ended(&self) -> Option<NoLink> {
        self.link.ended()
    }

    fn ended(&self) -> ClientError {
        self.link.ended().unwrap_or(NoLink::Ended).into()
    }

    /// The next thing told unasked; none when the link ended. What is not fetched waits, but pictures and live values
    /// only for a while.
    pub async fn next(&mut self) -> Option<Event> {
        self.told.recv().await
    }

    /// All that is told unasked from now on; what was told and not fetched yet comes first. [`Self::next`] gives nothing
    /// any more.
    pub fn take_told(&mut self) -> mpsc::Receiver<Event> {
        std::mem::replace(&mut self.told, mpsc::channel(1).1)
    }

    /// Ends the link without a word, as when a computer dies.
    pub fn cut(self) {
        self.carrier.abort();
    }

    /// The next thing told unasked of this kind; others before it are dropped.
    ///
    /// # Errors
    /// If the link ends, or it does not come within 20 s.
    pub async fn until(&mut self, mut wanted: impl FnMut(&Event) -> bool) -> Result<Event, ClientError> {
        let search = async {
            while let Some(event) = self.told.recv().await {
                if wanted(&event) {
                    return Some(event);
                }
            }
            None
        };
        match tokio::time::timeout(Duration::from_millis(AWAITED_MS), search).await {
            Ok(Some(event)) => Ok(event),
            Ok(None) => Err(self.ended()),
            Err(_) => Err(NoLink::Awaited.into()),
        }
    }

    /// The open behaviour as it is now.
    #[must_use]
    pub fn open(&self) -> Option<Mirror> {
        self.link.mirrors().open.clone()
    }

    /// The robots as they are now, oldest first.
    ///
    /// # Errors
    /// If the link ends, or the server does not tell of its robots within 20 s.
    pub async fn robots(&mut self) -> Result<Vec<RobotState>, ClientError> {
        self.robots_that(|robots| !robots.is_empty()).await
    }

    /// A robot, or the first one, once it has said which devices it has. What was told before is dropped.
    ///
    /// # Errors
    /// If the link ends, or it does not say so within 20 s.
    pub async fn robot(&mut self, robot: Option<&Id>) -> Result<RobotState, ClientError> {
        let find = |robots: &[RobotState]| {
            let is_meant = |known: &&RobotState| robot.is_none_or(|robot| known.robot == *robot);
            robots.iter().find(is_meant).filter(|robot| !robot.devices.is_empty()).cloned()
        };
        let robots = self.robots_that(|robots| find(robots).is_some()).await?;
        find(&robots).ok_or(ClientError::No(Refused::NoRobot))
    }

    /// The robots as soon as they are so.
    pub(crate) async fn robots_that(
        &mut self,
        wanted: impl Fn(&[RobotState]) -> bool,
    ) -> Result<Vec<RobotState>, ClientError> {
        let known = self.link.mirrors().robots.clone();
        if wanted(&known) {
            return Ok(known);
        }
        match self.until(|event| matches!(event, Event::Robots { robots } if wanted(robots))).await? {
            Event::Robots { robots } => Ok(robots),
            _ => Err(self.ended()),
        }
    }

    /// The library as it is now.
    #[must_use]
    pub fn library(&self) -> Mirror {
        self.link.mirrors().library.clone()
    }

    /// Opens a behaviour and answers with what it is.
    ///
    /// # Errors
    /// If the server says no, or the link ends.
    pub async fn load(&self, behaviour: &Id) -> Result<Mirror, ClientError> {
        self.ask(request::Open { behaviour: behaviour.clone() }).await?;
        self.open().ok_or(ClientError::No(Refused::NothingOpen))
    }

    /// Returns the programs that a query finds, page after page, until there are `most` or no more.
    ///
    /// # Errors
    /// If the server says no, or the link ends.
    pub async fn programs(&self, mut query: ListQuery, most: usize) -> Result<Vec<Summary>, ClientError> {
        let mut found = Vec::new();
        loop {
            match self.ask(request::List { query: query.clone() }).await {
                Ok(answer::Programs { programs, next, .. }) => {
                    found.extend(programs);
                    query.after = next;
                }
                Err(ClientError::No(Refused::TooFast)) => {
                    tokio::time::sleep(Duration::from_millis(SLOWER_MS)).await;
                    continue;
                }
                Err(trouble) => return Err(trouble),
            }
            if query.after.is_none() || found.len() >= most {
                found.truncate(most);
                return Ok(found);
            }
        }
    }

    /// Proposes putting, or with none taking away, one record of the open behaviour.
    ///
    /// # Errors
    /// If the server says no, or the link ends.
    pub async fn put(&self, label: &str, id: RecordId, record: Option<Record>) -> Result<answer::Saved, ClientError> {
        let open = self.open().ok_or(ClientError::No(Refused::NothingOpen))?;
        let change = self.change(label, &open.records, vec![(id, record)]);
        self.ask(request::Propose { behaviour: open.behaviour, change, tokens: Vec::new() }).await
    }

    /// A change with a name of its own that puts or takes away these records.
    #[must_use]
    pub fn change(&self, label: &str, now: &Behaviour, records: Vec<(RecordId, Option<Record>)>) -> Change {
        let op = Id::new(&format!("op-{}", unique()));
        let mut change = Change::of(op.unwrap_or_else(|_| self.welcome.you.client.clone()), &self.you().name, label);
        for (id, record) in records {
            change = match record {
                Some(record) => change.put(now, id, record),
                None => change.take(now, id),
            };
        }
        change
    }
}

/// A text that nobody else has: chance of the system and a count.
pub(crate) fn unique() -> String {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    format!("{:016x}{:016x}", RandomState::new().hash_one(count), RandomState::new().hash_one(std::process::id()))
}
