//! One socket: a task that reads and one that writes, on the threads that carry messages, and one on the server's other
//! threads that does what was asked, in order. Stop is done by the task that reads, before anything that waits.

mod answering;
mod inviting;
mod library;
mod looking;
mod operating;
mod past;
mod requests;
mod robots;

use super::budgets::{PersonBudget, Weight};
use super::hear::{HeardMessage, first_number, hear, read};
use super::inbox::{Inbox, WaitingRequest, inbox};
use crate::connection::clients::{Entered, tidy_name};
use crate::connection::close_signal::CloseReason;
use crate::connection::outbox::Outbox;
use crate::connection::{Connections, Seat};
use crate::invitations::{GuestPresence, Identified};
use crate::rooms::member::{AnswerTo, Member};
use crate::rooms::{Entering, JoinRequest, LeaveReason, RoomCommand};
use crate::support::identity::Sender;
use crate::support::tasks::boxed;
use axum::extract::ws::{Utf8Bytes, WebSocket};
use futures_util::StreamExt;
use futures_util::stream::SplitStream;
use protocol::{ALIVE_MS, AnyRequest, Ask, Message, Person, Refused, VERSION, answer, request};
use std::sync::Arc;
use std::time::Duration;
use tokio::runtime::Handle;
use tokio::sync::mpsc;

/// How long the greeting may take.
const GREETING_MS: u64 = 2_000;
/// How long a client may be silent: two pings of the WebSocket.
const SILENT_MS: u64 = 2 * ALIVE_MS;
/// How long who is told to go may take to hear it, after the second in which it is written.
const LINGER_MS: u64 = super::writer::CLOSE_MS + 500;

/// Serves one socket of somebody who is in.
pub(crate) async fn run(connections: Arc<Connections>, socket: WebSocket, entry: Identified, seat: Seat) {
    let (sink, mut stream) = socket.split();
    let (outbox, told, waiting) = Outbox::new(connections.number(), Arc::clone(&seat.person), &connections.waiting);
    let writes = super::writer::write(Arc::clone(&connections), outbox.clone(), sink, told, (waiting, entry.role()));
    let writing = connections.state.tasks.spawn_on(boxed(writes), &Handle::current());
    let greeted = tokio::select! {
        () = connections.state.tasks.stopping.cancelled() => Err(CloseReason::Restart),
        () = entry.until_over() => Err(CloseReason::Revoked),
        () = seat.place.until_lost() => Err(CloseReason::GaveWay),
        greeted = half_open(&connections, &outbox, &mut stream) => greeted,
    };
    match greeted {
        Ok((entered, ask)) => serve(connections, outbox, entered, (ask, entry, seat), &mut stream).await,
        Err(why) => outbox.close.with(why),
    }
    let _ = writing.await;
}

/// Waits for the greeting in one of few places, whose oldest gives way.
async fn half_open(
    connections: &Connections,
    outbox: &Outbox,
    stream: &mut SplitStream<WebSocket>,
) -> Result<(Entered, u32), CloseReason> {
    let Some(place) = connections.half_open.take(&outbox.person) else { return Err(CloseReason::Unwelcome) };
    let greeted = tokio::time::timeout(Duration::from_millis(GREETING_MS), greet(connections, outbox, stream));
    place.hold(greeted).await.and_then(Result::ok).unwrap_or(Err(CloseReason::Unwelcome))
}

/// The greeting comes first and in our version.
async fn greet(
    connections: &Connections,
    outbox: &Outbox,
    stream: &mut SplitStream<WebSocket>,
) -> Result<(Entered, u32), CloseReason> {
    let Ask { ask, request, .. } = loop {
        match hear(stream.next().await) {
            HeardMessage::Ask(ask) => break *ask,
            HeardMessage::Nonsense(ask, reason) => {
                outbox.say(Message::No { ask, no: Refused::Unreadable(reason) });
                return Err(CloseReason::Unwelcome);
            }
            // Such as the answer to a ping, which may come before.
            HeardMessage::Nothing => {}
            HeardMessage::Large(_) => return Err(CloseReason::Unwelcome),
            HeardMessage::End(why) => return Err(why),
        }
    };
    match request {
        AnyRequest::Hello(request::Hello { version: VERSION, name, again }) => {
            Ok((connections.clients.enter(again.as_ref(), &name, outbox.session, outbox.close.clone()), ask))
        }
        AnyRequest::Hello(_) => {
            outbox.no(ask, Refused::Version(VERSION));
            Err(CloseReason::Unwelcome)
        }
        _ => {
            outbox.no(ask, Refused::Greeting);
            Err(CloseReason::Unwelcome)
        }
    }
}

/// Reads until the link ends, while another task does what is asked.
async fn serve(
    connections: Arc<Connections>,
    outbox: Outbox,
    entered: Entered,
    (ask, entry, seat): (u32, Identified, Seat),
    stream: &mut SplitStream<WebSocket>,
) {
    let Entered { person: me, secret } = entered;
    let Some(role) = entry.role() else { return outbox.close.with(CloseReason::Unwelcome) };
    let _here = here(&connections, &entry, &me.name);
    tracing::info!(name = me.name, session = outbox.session, "somebody comes");
    connections.state.rooms.tell(
        connections.state.rooms.library(),
        RoomCommand::Join(
            Member { person: me.clone(), link: Arc::new(outbox.clone()) },
            JoinRequest::Server(
                Entering { secret, role, stops: connections.state.robots.newest_stop() },
                AnswerTo::Client { to: Arc::new(outbox.clone()), ask, held: None },
            ),
        ),
    );
    let (asking, asked) = inbox();
    let session = ClientSession::new(
        Arc::clone(&connections),
        outbox.clone(),
        me.clone(),
        (entry.clone(), Arc::clone(&seat.budget)),
    );
    let working = connections.state.tasks.spawn(session.work(asked));
    let (by, budget) = (me.name.clone(), &*seat.budget);
    let mut reader = ClientReader { connections: &connections, outbox: &outbox, by, budget, asking };
    let why = tokio::select! {
        why = reader.read(stream) => why,
        () = entry.until_over() => CloseReason::Revoked,
        () = seat.place.until_lost() => CloseReason::GaveWay,
    };
    drop(reader);
    outbox.close.with(why);
    let leaves = async {
        let _ = working.await;
        let rooms = &connections.state.rooms;
        rooms.tell_open(rooms.library(), RoomCommand::Leave(outbox.session, LeaveReason::LinkEnded));
        connections.clients.leave(&me.client, outbox.session);
        tracing::info!(name = me.name, session = outbox.session, ?why, "somebody goes");
    };
    let hears_why = async {
        if why.is_told() {
            let lingers = linger(&connections, stream, &me.name);
            let _ = tokio::time::timeout(Duration::from_millis(LINGER_MS), lingers).await;
        }
    };
    tokio::join!(leaves, hears_why);
}

/// Hears the other side until it went, so that it hears why it has to: a socket that is let go of with something unread in it
/// takes back what was written last. Its Stop still counts.
async fn linger(connections: &Connections, stream: &mut SplitStream<WebSocket>, by: &str) {
    loop {
        match hear(stream.next().await) {
            HeardMessage::Ask(ask) => {
                if let AnyRequest::Stop(request::Stop { behaviour, robot }) = ask.request {
                    connections.state.robots.stop_now(behaviour.as_ref(), robot.as_ref(), by);
                }
            }
            HeardMessage::Large(_) | HeardMessage::Nonsense(..) | HeardMessage::Nothing => {}
            HeardMessage::End(_) => return,
        }
    }
}

/// Shows who invited that a guest is here.
fn here(connections: &Connections, entry: &Identified, name: &str) -> Option<GuestPresence> {
    let Identified::Guest(guest) = entry else { return None };
    Some(connections.state.invitations.arrive(guest, name))
}

/// Hears one client.
struct ClientReader<'a> {
    connections: &'a Connections,
    outbox: &'a Outbox,
    by: String,
    budget: &'a PersonBudget,
    asking: Inbox,
}

impl ClientReader<'_> {
    async fn read(&mut self, stream: &mut SplitStream<WebSocket>) -> CloseReason {
        let (stopping, close) = (self.connections.state.tasks.stopping.clone(), self.outbox.close.clone());
        loop {
            let next = tokio::time::timeout(Duration::from_millis(SILENT_MS), stream.next());
            let message = tokio::select! {
                () = stopping.cancelled() => return CloseReason::Restart,
                why = close.wait() => return why,
                message = next => message,
            };
            let Ok(message) = message else { return CloseReason::Left };
            match hear(message) {
                HeardMessage::Ask(ask) => self.hear(*ask),
                HeardMessage::Large(text) if self.budget.may_ask() => self.large(text),
                HeardMessage::Large(text) => self.too_fast(first_number(&text)),
                HeardMessage::Nonsense(ask, reason) => {
                    self.outbox.say(Message::No { ask, no: Refused::Unreadable(reason) })
                }
                HeardMessage::Nothing => {}
                HeardMessage::End(why) => return why,
            }
        }
    }

    /// Stop always gets through, before all that waits; anything else has to keep to its share.
    fn hear(&mut self, Ask { ask, stops, request }: Ask) {
        if let AnyRequest::Stop(request::Stop { behaviour, robot }) = request {
            let robots = &self.connections.state.robots;
            robots.stop_now(behaviour.as_ref(), robot.as_ref(), &self.by);
            let stopped = answer::Stopped { stops: robots.newest_stop() };
            self.outbox.say(Message::Answer { ask, answer: stopped.into() });
            return tracing::info!(by = self.by, "Stop");
        }
        if let AnyRequest::CallMe(request::CallMe { name }) = &request {
            self.by = tidy_name(name);
        }
        let matters = !matches!(
            request,
            AnyRequest::Present(_) | AnyRequest::PresentMoment(_) | AnyRequest::Scene(_) | AnyRequest::Typing(_)
        );
        if (!self.budget.may_ask() || !self.asking.ask(Ask { ask, stops, request })) && matters {
            self.too_fast(Some(ask));
        }
    }

    fn large(&mut self, text: Utf8Bytes) {
        let ask = first_number(&text);
        if !self.asking.large(text, self.budget) {
            self.too_fast(ask);
        }
    }

    fn too_fast(&self, ask: Option<u32>) {
        self.outbox.say(Message::No { ask, no: Refused::TooFast });
    }
}

/// Does what one client asks.
struct ClientSession {
    connections: Arc<Connections>,
    outbox: Outbox,
    me: Person,
    /// As whom they are in.
    entry: Identified,
    /// The behaviour that is open.
    open: Option<behaviour::Id>,
    budget: Arc<PersonBudget>,
    /// The room that the request at hand takes, if it is a large one.
    weight: Option<Weight>,
    /// The newest Stop of which this client had heard when it asked what is at hand.
    stops: Option<u64>,
    /// Questions about the past of which only the newest counts.
    looking_back: looking::LookingBack,
}

impl ClientSession {
    fn new(
        connections: Arc<Connections>,
        outbox: Outbox,
        me: Person,
        (entry, budget): (Identified, Arc<PersonBudget>),
    ) -> Self {
        let looking_back = looking::LookingBack::default();
        Self { connections, outbox, me, entry, open: None, budget, weight: None, stops: None, looking_back }
    }

    /// For whom what this link asks is done.
    fn sender(&self) -> Sender {
        self.outbox.sender()
    }

    fn member(&self) -> Member {
        Member { person: self.me.clone(), link: Arc::new(self.outbox.clone()) }
    }

    /// One request after the other, until the link ended and all are done.
    async fn work(mut self, mut asked: mpsc::Receiver<WaitingRequest>) {
        while let Some(asked) = asked.recv().await {
            match asked {
                WaitingRequest::Small(ask) => self.take(*ask),
                WaitingRequest::Large(text, weight) => self.large(text, weight).await,
            }
        }
        self.leave_open(LeaveReason::LinkEnded);
        self.looks_back_no_more();
    }

    fn take(&mut self, Ask { ask, stops, request }: Ask) {
        self.stops = stops;
        self.request(ask, request);
    }

    /// Reads a large message among the other work, then does what it asks.
    async fn large(&mut self, text: Utf8Bytes, weight: Weight) {
        let (sender, number) = (self.sender(), first_number(&text));
        match self.connections.state.workers.run(sender, move |_| read(&text)).await {
            Ok(HeardMessage::Ask(ask)) => {
                self.weight = Some(weight);
                self.take(*ask);
                self.weight = None;
            }
            Ok(HeardMessage::Nonsense(ask, reason)) => {
                self.outbox.say(Message::No { ask, no: Refused::Unreadable(reason) })
            }
            Ok(HeardMessage::Large(_) | HeardMessage::Nothing | HeardMessage::End(_)) => {}
            Err(why) => self.outbox.say(Message::No { ask: number, no: why.into() }),
        }
    }

    fn leave_open(&mut self, parting: LeaveReason) {
        if let Some(open) = self.open.take() {
            self.connections.state.rooms.tell_open(&open, RoomCommand::Leave(self.outbox.session, parting));
        }
    }
}
