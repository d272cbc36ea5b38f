//! The writing side of one client: first what must arrive, in order; then, at most so often, the newest of everything
//! that only matters new.

use super::values::Watching;
use crate::connection::Connections;
use crate::connection::close_signal::CloseReason;
use crate::connection::outbox::{Out, Outbox, WaitingBytes};
use crate::connection::topics::BEAT_MS;
use crate::rooms::member::RoomFeed;
use crate::rooms::shown::GaveWay;
use crate::support::identity::Sender;
use crate::support::message::encode;
use crate::support::tasks::TaskResult;
use axum::body::Bytes;
use axum::extract::ws::{CloseFrame, Message, Utf8Bytes, WebSocket};
use behaviour::Id;
use futures_util::SinkExt;
use futures_util::stream::SplitSink;
use protocol::{ALIVE_MS, Event, PING_MS, Role};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::{broadcast, mpsc, watch};
use tokio::time::MissedTickBehavior;
use tokio_util::sync::CancellationToken;

/// Messages that are written together.
const BATCH_MAX_MESSAGES: usize = 4;
/// How long one message, or some together, may take to be written.
const WRITE_MS: u64 = 5_000;
/// How long the closing frame may take.
pub(super) const CLOSE_MS: u64 = 1_000;

struct ClientWriter {
    connections: Arc<Connections>,
    /// For whom what is told here is made.
    sender: Sender,
    sink: SplitSink<WebSocket, Message>,
    /// What is in the queue.
    waiting: WaitingBytes,
    /// Told to everyone: runs, robots, the store's health, that the list of behaviours changed.
    topics: [watch::Receiver<Utf8Bytes>; 4],
    /// Told to who may invite.
    invitations: Option<watch::Receiver<Utf8Bytes>>,
    /// The presses of people beside robots.
    presses: broadcast::Receiver<Utf8Bytes>,
    /// Pictures of the watched robot; which one, if it was named.
    scene: Option<watch::Receiver<Utf8Bytes>>,
    robot: Option<Id>,
    scene_wanted: bool,
    values_wanted: bool,
    watching: Watching,
    /// The room that the client opened last.
    wanted: Option<Id>,
    feed: Option<Box<RoomFeed>>,
    /// Nothing is told before the welcome.
    welcomed: bool,
}

/// Writes until the link is closed.
pub(super) async fn write(
    connections: Arc<Connections>,
    link: Outbox,
    sink: SplitSink<WebSocket, Message>,
    inbox: mpsc::Receiver<Out>,
    (waiting, role): (WaitingBytes, Option<Role>),
) {
    let (sender, close) = (link.person.told(link.session), link.close.clone());
    // The queue ends when all who put something into it went.
    drop(link);
    let mut topics = [
        connections.topics.runs.subscribe(),
        connections.topics.robots.subscribe(),
        connections.state.health.text(),
        connections.state.rooms.news().text(),
    ];
    topics[..3].iter_mut().for_each(watch::Receiver::mark_changed);
    let scene = pictures(&connections, None);
    let invitations = (role == Some(Role::Host)).then(|| connections.topics.invitations.subscribe());
    let presses = connections.topics.presses.subscribe();
    let mut writer = ClientWriter {
        connections,
        sender,
        sink,
        waiting,
        topics,
        invitations,
        presses,
        scene,
        robot: None,
        scene_wanted: true,
        values_wanted: true,
        watching: Watching::default(),
        wanted: None,
        feed: None,
        welcomed: false,
    };
    let mut inbox = inbox;
    let why = tokio::select! {
        biased;
        why = close.wait() => why,
        why = writer.run(&mut inbox) => why,
    };
    close.with(why);
    writer.close(why, &mut inbox).await;
}

impl ClientWriter {
    async fn run(&mut self, inbox: &mut mpsc::Receiver<Out>) -> CloseReason {
        let mut beat = tokio::time::interval(Duration::from_millis(BEAT_MS));
        let mut ping = tokio::time::interval(Duration::from_millis(PING_MS));
        let (alive_every, begin) = (Duration::from_millis(ALIVE_MS), tokio::time::Instant::now());
        let mut alive = tokio::time::interval_at(begin + alive_every, alive_every);
        for interval in [&mut beat, &mut ping, &mut alive] {
            interval.set_missed_tick_behavior(MissedTickBehavior::Delay);
        }
        let mut batch = Vec::new();
        loop {
            let write = tokio::select! {
                biased;
                count = inbox.recv_many(&mut batch, BATCH_MAX_MESSAGES) => {
                    if count == 0 {
                        return CloseReason::Left;
                    }
                    self.deliver(&mut batch).await
                }
                _ = ping.tick(), if self.welcomed => self.ping().await,
                _ = alive.tick() => self.write([Message::Ping(Bytes::new())]).await,
                _ = beat.tick(), if self.welcomed => self.news().await,
            };
            if let Err(why) = write {
                return why;
            }
        }
    }

    /// Writes what must arrive.
    async fn deliver(&mut self, batch: &mut Vec<Out>) -> Result<(), CloseReason> {
        let mut texts = Vec::with_capacity(batch.len());
        let _writing: Vec<_> = batch.iter().map(|out| self.waiting.taken(out)).collect();
        for out in batch.drain(..) {
            match out {
                Out::Text(text) => texts.push(text),
                Out::Whole(ask, whole) => {
                    self.send(std::mem::take(&mut texts)).await?;
                    self.parts(whole.texts(ask)).await?;
                    self.welcomed = true;
                }
                Out::Want(wanted) => {
                    self.feed = None;
                    self.wanted = wanted;
                    // The page forgot the marks and values of another program.
                    self.watching = Watching::default();
                }
                Out::Follow(feed) if self.wanted.as_ref() == Some(&feed.behaviour) => self.feed = Some(feed),
                // It opened late, and another one was wanted meanwhile.
                Out::Follow(_) => {}
                Out::Unfollow(gone) => drop(self.feed.take_if(|feed| feed.behaviour == gone)),
                Out::Watch { robot, scene, values } => self.watch(robot, scene, values),
            }
        }
        self.welcomed |= !texts.is_empty();
        self.send(texts).await
    }

    /// Looks at another robot, whose picture is new to it, or begins anew: all marks and values come again.
    fn watch(&mut self, robot: Option<Id>, scene: bool, values: bool) {
        (self.scene_wanted, self.values_wanted) = (scene, values);
        self.watching = Watching::default();
        if robot != self.robot {
            self.scene = pictures(&self.connections, robot.as_ref());
            self.robot = robot;
        }
    }

    /// Writes the newest of what changed.
    async fn news(&mut self) -> Result<(), CloseReason> {
        let mut texts: Vec<Utf8Bytes> = self.topics.iter_mut().filter_map(newest).collect();
        texts.extend(self.invitations.as_mut().and_then(newest));
        texts.extend(pressed(&mut self.presses));
        if self.scene_wanted {
            texts.extend(self.scene.as_mut().and_then(newest));
        }
        if let Some(feed) = &mut self.feed {
            texts.extend(newest(&mut feed.people));
            texts.extend(newest(&mut feed.problems));
            texts.extend(newest(&mut feed.locks));
            texts.extend(newest(&mut feed.versions));
            let of = (self.robot.as_ref(), self.values_wanted);
            texts.extend(values(&self.connections, &mut self.watching, &feed.behaviour, of).await);
        }
        if texts.is_empty() { Ok(()) } else { self.send(texts).await }
    }

    async fn ping(&mut self) -> Result<(), CloseReason> {
        let behaviour = self.feed.as_ref().map(|feed| (feed.behaviour.clone(), *feed.revision.borrow()));
        let library_revision = self.connections.state.rooms.snapshot().revision;
        let text = encode(Event::Ping { behaviour, library_revision });
        self.write([Message::Text(text)]).await
    }

    async fn send(&mut self, texts: Vec<Utf8Bytes>) -> Result<(), CloseReason> {
        self.write(texts.into_iter().map(Message::Text)).await
    }

    /// Writes one part after the other, each made among the other work when it is its turn; the pings between them show
    /// on both sides that the link lives.
    async fn parts(
        &mut self,
        texts: impl Iterator<Item = Result<Utf8Bytes, GaveWay>> + Send + 'static,
    ) -> Result<(), CloseReason> {
        let mut texts = texts;
        loop {
            let make = move |_: &CancellationToken| {
                let text = texts.next();
                (text, texts)
            };
            let made = self.connections.state.workers.run(self.sender.clone(), make).await;
            let (text, rest) = made.map_err(|_| CloseReason::Resync)?;
            let Some(text) = text.transpose().map_err(|GaveWay| CloseReason::Resync)? else { return Ok(()) };
            self.write([Message::Text(text), Message::Ping(Bytes::new())]).await?;
            texts = rest;
        }
    }

    /// A client that takes too long is cut off; everything is still there when it comes back.
    async fn write(&mut self, messages: impl IntoIterator<Item = Message>) -> Result<(), CloseReason> {
        let sink = &mut self.sink;
        let all = async {
            for message in messages {
                sink.feed(message).await?;
            }
            sink.flush().await
        };
        match tokio::time::timeout(Duration::from_millis(WRITE_MS), all).await {
            Ok(Ok(())) => Ok(()),
            Ok(Err(_)) => Err(CloseReason::Left),
            Err(_) => Err(CloseReason::Resync),
        }
    }

    /// Says why it ends, after what was already said to somebody unwelcome.
    async fn close(mut self, why: CloseReason, inbox: &mut mpsc::Receiver<Out>) {
        let (code, reason) = why.words();
        let mut last = Vec::new();
        while let (CloseReason::Unwelcome | CloseReason::Restart, Ok(out)) = (why, inbox.try_recv()) {
            last.push(out);
        }
        let end = async {
            let _ = self.deliver(&mut last).await;
            let frame = CloseFrame { code, reason: reason.into() };
            let _ = self.sink.send(Message::Close(Some(frame))).await;
        };
        let _ = tokio::time::timeout(Duration::from_millis(CLOSE_MS), end).await;
    }
}

/// Returns the presses that were not told yet; those that were too many are missed.
fn pressed(presses: &mut broadcast::Receiver<Utf8Bytes>) -> Vec<Utf8Bytes> {
    let mut texts = Vec::new();
    loop {
        match presses.try_recv() {
            Ok(text) => texts.push(text),
            Err(broadcast::error::TryRecvError::Lagged(_)) => {}
            Err(broadcast::error::TryRecvError::Empty | broadcast::error::TryRecvError::Closed) => return texts,
        }
    }
}

/// Returns what is new of the marks and the live values, made on the server's other threads.
async fn values(
    connections: &Arc<Connections>,
    watching: &mut Watching,
    behaviour: &Id,
    (robot, wanted): (Option<&Id>, bool),
) -> Vec<Utf8Bytes> {
    let (known, all, behaviour, robot) =
        (std::mem::take(watching), Arc::clone(connections), behaviour.clone(), robot.cloned());
    let (work, made) = TaskResult::by(async move {
        let mut known = known;
        (known.news(&all, &behaviour, (robot.as_ref(), wanted)), known)
    });
    let Ok((texts, known)) = made.when(connections.state.tasks.runtime.spawn(work)).await else { return Vec::new() };
    *watching = known;
    texts
}

/// Pictures of a robot, beginning with the newest.
fn pictures(connections: &Connections, robot: Option<&Id>) -> Option<watch::Receiver<Utf8Bytes>> {
    let mut pictures = connections.state.robots.pictures(robot)?;
    pictures.mark_changed();
    Some(pictures)
}

/// The newest text, if it is one that was not taken yet.
fn newest(text: &mut watch::Receiver<Utf8Bytes>) -> Option<Utf8Bytes> {
    let new = text.has_changed().unwrap_or(false);
    new.then(|| text.borrow_and_update().clone()).filter(|text| !text.is_empty())
}
