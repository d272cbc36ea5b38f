//! One socket: a task that reads and a task that writes, until one of them ends.

mod bucket;
mod hear;
mod requests;
mod values;
mod writer;

use crate::cut::Why;
use crate::hub::Hub;
use crate::outbox::Outbox;
use crate::rooms::{Member, Note};
use axum::extract::ws::{Message, WebSocket};
use bucket::Bucket;
use futures_util::StreamExt;
use futures_util::stream::SplitStream;
use hear::{Heard, hear};
use protocol::{Ask, PING_MS, Person, Request, SaidNo, VERSION};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Semaphore;

/// How long the greeting may take.
const GREETING_MS: u64 = 10_000;
/// How long a client may be silent: two pings unanswered, and a little.
const SILENT_MS: u64 = 2 * PING_MS + 2_000;
/// Requests of one client that may be under way.
const UNDER_WAY_MAX: usize = 8;

/// The reading side of one client.
struct Session {
    hub: Arc<Hub>,
    outbox: Outbox,
    me: Person,
    /// The behaviour that is open.
    open: Option<behaviour::Id>,
    bucket: Bucket,
    under_way: Arc<Semaphore>,
}

/// Serves one socket.
pub(crate) async fn run(hub: Arc<Hub>, socket: WebSocket) {
    let (sink, mut stream) = socket.split();
    let (outbox, inbox) = Outbox::new(hub.clients.number());
    let writing = hub.tasks.spawn(writer::write(Arc::clone(&hub), sink, inbox, outbox.cut.clone()));
    let greeted = tokio::select! {
        () = hub.stopping.cancelled() => Err(Why::Restart),
        greeted = tokio::time::timeout(Duration::from_millis(GREETING_MS), greet(&hub, &outbox, &mut stream)) => {
            greeted.unwrap_or(Err(Why::Unwelcome))
        }
    };
    match greeted {
        Ok((me, ask)) => Session::new(hub, outbox, me).serve(ask, &mut stream).await,
        Err(why) => outbox.cut.with(why),
    }
    let _ = writing.await;
}

/// The greeting comes first and in our version.
async fn greet(hub: &Hub, outbox: &Outbox, stream: &mut SplitStream<WebSocket>) -> Result<(Person, u32), Why> {
    let Ask { ask, request } = match hear(stream.next().await) {
        Heard::Ask(ask) => *ask,
        Heard::Nonsense(ask, reason) => {
            outbox.say(ask, protocol::Reply::No { no: SaidNo::Unreadable(reason) });
            return Err(Why::Unwelcome);
        }
        Heard::Nothing => return Err(Why::Unwelcome),
        Heard::End(why) => return Err(why),
    };
    match request {
        Request::Hello { version: VERSION, client, name } => {
            Ok((hub.clients.enter(client, &name, outbox.session, outbox.cut.clone()), ask))
        }
        Request::Hello { .. } => {
            outbox.no(ask, SaidNo::Version(VERSION));
            Err(Why::Unwelcome)
        }
        _ => {
            outbox.no(ask, SaidNo::Greeting);
            Err(Why::Unwelcome)
        }
    }
}

impl Session {
    fn new(hub: Arc<Hub>, outbox: Outbox, me: Person) -> Self {
        let under_way = Arc::new(Semaphore::new(UNDER_WAY_MAX));
        Self { hub, outbox, me, open: None, bucket: Bucket::full(), under_way }
    }

    fn member(&self) -> Member {
        Member { person: self.me.clone(), outbox: self.outbox.clone() }
    }

    async fn serve(mut self, ask: u32, stream: &mut SplitStream<WebSocket>) {
        tracing::info!(name = self.me.name, session = self.outbox.session, "somebody comes");
        self.hub.tell(&self.hub.library, Note::Join(self.member(), ask));
        let why = self.read(stream).await;
        self.outbox.cut.with(why);
        self.leave_open();
        self.hub.tell_open(&self.hub.library, Note::Leave(self.outbox.session));
        self.hub.clients.leave(&self.me.client, self.outbox.session);
        tracing::info!(name = self.me.name, session = self.outbox.session, ?why, "somebody goes");
    }

    async fn read(&mut self, stream: &mut SplitStream<WebSocket>) -> Why {
        let (stopping, cut) = (self.hub.stopping.clone(), self.outbox.cut.clone());
        loop {
            let next = tokio::time::timeout(Duration::from_millis(SILENT_MS), stream.next());
            let message = tokio::select! {
                () = stopping.cancelled() => return Why::Restart,
                why = cut.wait() => return why,
                message = next => message,
            };
            let Ok(message) = message else { return Why::Left };
            match hear(message) {
                Heard::Ask(ask) => self.hear(*ask),
                Heard::Nonsense(ask, reason) => {
                    self.outbox.say(ask, protocol::Reply::No { no: SaidNo::Unreadable(reason) });
                }
                Heard::Nothing => {}
                Heard::End(why) => return why,
            }
        }
    }

    /// Stop always gets through; anything else has to keep to its share.
    fn hear(&mut self, ask: Ask) {
        let free = matches!(ask.request, Request::Stop { .. });
        if free || self.bucket.take() {
            self.request(ask.ask, ask.request);
        } else if !matches!(ask.request, Request::Present { .. } | Request::Scene { .. }) {
            self.outbox.no(ask.ask, SaidNo::TooFast);
        }
    }

    fn leave_open(&mut self) {
        if let Some(open) = self.open.take() {
            self.hub.tell_open(&open, Note::Leave(self.outbox.session));
        }
    }
}

type Incoming = Option<Result<Message, axum::Error>>;
