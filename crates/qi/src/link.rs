//! One connection to a peer: calls with timeouts, posts, events and an own ping, each within a bound.
//!
//! A task writes, another reads; both end with the link. Nothing waits without a bound: what is too much is
//! [`QiError::Busy`] at once.

mod fan_out;
mod mailbox;
mod pending;
mod signals;
mod tasks;

use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use tokio::io::{AsyncRead, AsyncWrite};
use tokio::sync::{mpsc, watch};
use tokio::task::AbortHandle;
use tokio::time::timeout;

pub use fan_out::SUBSCRIBERS_MAX;
pub use mailbox::{EventChoice, SignalEvent, WAITING_MAX_BYTES};
pub use pending::{CallAnswer, IN_FLIGHT_MAX};
pub use signals::Subscription;

use crate::agreed::Agreed;
use crate::error::{LinkEnding, QiError};
use crate::value::Layout;
use crate::wire::{MessageFrame, MessageHeader, MessageKind};
use fan_out::FanOut;
use pending::{PendingCall, PendingCalls};

/// The most messages that may wait to be written.
pub const QUEUE_MAX_FRAMES: usize = 256;
/// The most bytes of messages that may wait to be written.
pub const QUEUE_MAX_BYTES: usize = 32 << 20;
/// The method that is pinged: `machineId` of the service directory, which every generation has; a refusal is an answer
/// too.
const PING: MemberTarget = MemberTarget { service: 1, object: 1, action: 108 };

/// A method, signal or property of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct MemberTarget {
    /// The number of the service.
    pub service: u32,
    /// The number of the object; 1 is the service itself.
    pub object: u32,
    /// The number of the method, signal or property.
    pub action: u32,
}

/// One connection; clones are the same one. It ends when nobody holds it any more.
#[derive(Debug, Clone)]
pub struct QiLink(Arc<LinkHandle>);

#[derive(Debug)]
struct LinkHandle {
    shared: Arc<LinkShared>,
    tasks: [AbortHandle; 2],
}

impl Drop for LinkHandle {
    fn drop(&mut self) {
        self.shared.end(LinkEnding::Here);
        self.tasks.iter().for_each(AbortHandle::abort);
    }
}

/// The state that the tasks and all who hold the link have in common.
#[derive(Debug)]
struct LinkShared {
    outgoing: mpsc::Sender<Vec<u8>>,
    /// Bytes that wait to be written, or are being written.
    outgoing_bytes: AtomicUsize,
    pending: PendingCalls,
    fan_out: FanOut,
    registering: tokio::sync::Mutex<()>,
    ended: watch::Sender<Option<LinkEnding>>,
    /// The capabilities that the peer told without being asked, as they came: the generation of NAOqi 2.1.
    greeting: OnceLock<Vec<u8>>,
    agreed: OnceLock<Agreed>,
    began: Instant,
    heard_us: AtomicU64,
    late: AtomicU64,
}

impl QiLink {
    /// A link over any stream of bytes. Starts its two tasks on the current tokio runtime; nothing is said yet.
    pub fn over(stream: impl AsyncRead + AsyncWrite + Send + 'static) -> Self {
        let (outgoing, waiting) = mpsc::channel(QUEUE_MAX_FRAMES);
        let shared = Arc::new(LinkShared {
            outgoing,
            outgoing_bytes: AtomicUsize::new(0),
            pending: PendingCalls::default(),
            fan_out: FanOut::default(),
            registering: tokio::sync::Mutex::default(),
            ended: watch::Sender::new(None),
            greeting: OnceLock::new(),
            agreed: OnceLock::new(),
            began: Instant::now(),
            heard_us: AtomicU64::new(0),
            late: AtomicU64::new(0),
        });
        let (from, to) = tokio::io::split(stream);
        let reader = tokio::spawn(tasks::read(Arc::clone(&shared), from)).abort_handle();
        let writer = tokio::spawn(tasks::write(Arc::clone(&shared), to, waiting)).abort_handle();
        Self(Arc::new(LinkHandle { shared, tasks: [reader, writer] }))
    }

    /// Calls and waits for the answer. `what` names the call in errors.
    ///
    /// # Errors
    /// [`QiError::Busy`] at once with [`IN_FLIGHT_MAX`] calls under way, [`QiError::Timeout`] when nothing came `within`
    /// that time, [`QiError::Disconnected`], and what the peer answers with: [`QiError::Remote`], [`QiError::Canceled`].
    pub async fn call(
        &self,
        target: MemberTarget,
        flags: u8,
        payload: Vec<u8>,
        within: Duration,
        what: &str,
    ) -> Result<CallAnswer, QiError> {
        let mut waiting = self.asked(target, flags, payload)?;
        self.answered(&mut waiting, within, what).await
    }

    /// [`QiLink::call`] until somebody does not want it any more: then the peer is asked to cancel it, if it said that it can,
    /// and its answer is not waited for. What a method makes of that is the peer's.
    ///
    /// # Errors
    /// Fails as [`QiLink::call`] does; with [`QiError::Canceled`] if it was not wanted any more.
    pub async fn call_until(
        &self,
        target: MemberTarget,
        flags: u8,
        payload: Vec<u8>,
        within: Duration,
        what: &str,
        unwanted: impl Future<Output = ()>,
    ) -> Result<CallAnswer, QiError> {
        let mut waiting = self.asked(target, flags, payload)?;
        let id = waiting.id();
        tokio::select! {
            answer = self.answered(&mut waiting, within, what) => answer,
            () = unwanted => {
                if self.agreed().is_some_and(|agreed| agreed.cancelable) {
                    let target = MemberTarget { action: 0, ..target };
                    self.send(MessageKind::Cancel, self.shared().pending.next_id(), 0, target, id.to_le_bytes().to_vec())?;
                }
                Err(QiError::Canceled { what: what.to_owned() })
            }
        }
    }

    /// The answer to a call, as it settles.
    async fn answered(
        &self,
        waiting: &mut PendingCall<'_>,
        within: Duration,
        what: &str,
    ) -> Result<CallAnswer, QiError> {
        match timeout(within, waiting.answer()).await {
            Ok(Some(answer)) => answer.settled(what),
            Ok(None) => Err(self.disconnected()),
            Err(_) => Err(QiError::Timeout { what: what.to_owned(), within }),
        }
    }

    /// Sends a call; what waits for its answer.
    fn asked(&self, target: MemberTarget, flags: u8, payload: Vec<u8>) -> Result<PendingCall<'_>, QiError> {
        let waiting = self.shared().pending.begin().ok_or(QiError::Busy { what: "calls", limit: IN_FLIGHT_MAX });
        let waiting = match self.ending() {
            Some(ending) => return Err(QiError::Disconnected(ending)),
            None => waiting?,
        };
        self.send(MessageKind::Call, waiting.id(), flags, target, payload)?;
        Ok(waiting)
    }

    /// Sends a call whose answer nobody wants. Never waits.
    ///
    /// # Errors
    /// [`QiError::Busy`] with [`QUEUE_MAX_FRAMES`] messages or [`QUEUE_MAX_BYTES`] waiting to be written, [`QiError::Disconnected`].
    pub fn post(&self, target: MemberTarget, flags: u8, payload: Vec<u8>) -> Result<(), QiError> {
        self.send(MessageKind::Post, self.shared().pending.next_id(), flags, target, payload)
    }

    /// Asks the peer for a sign of life; answers with how long it took. A peer that is gone without a word is found by
    /// this alone: TCP tells after minutes.
    ///
    /// # Errors
    /// [`QiError::Timeout`] if there was none `within` that time, [`QiError::Disconnected`], [`QiError::Busy`].
    pub async fn ping(&self, within: Duration) -> Result<Duration, QiError> {
        let asked = Instant::now();
        match self.call(PING, 0, Vec::new(), within, "ping").await {
            Ok(_) | Err(QiError::Remote { .. } | QiError::Canceled { .. }) => Ok(asked.elapsed()),
            Err(error) => Err(error),
        }
    }

    /// Returns the time for which nothing came from the peer.
    pub fn silent_for(&self) -> Duration {
        let heard = Duration::from_micros(self.shared().heard_us.load(Ordering::Relaxed));
        self.shared().began.elapsed().saturating_sub(heard)
    }

    /// Sends a call and drops its answer. libqi does not carry out everything that is only posted: it forgets by which link
    /// a post came, and a registration belongs to its link.
    pub(crate) fn tell(&self, target: MemberTarget, payload: Vec<u8>) -> Result<(), QiError> {
        self.send(MessageKind::Call, self.shared().pending.next_id(), 0, target, payload)
    }

    /// Returns the number of answers that came and nobody waited for; they are dropped. They belong to calls that had
    /// given up, and to ends of subscriptions and of objects.
    pub fn late_answers(&self) -> u64 {
        self.shared().late.load(Ordering::Relaxed)
    }

    /// Returns the number of calls that wait for their answer, at most [`IN_FLIGHT_MAX`].
    pub fn in_flight(&self) -> usize {
        self.shared().pending.len()
    }

    /// Ends the link: everything that waits on it ends with [`QiError::Disconnected`].
    pub fn close(&self) {
        self.shared().end(LinkEnding::Here);
    }

    /// Returns the reason why the link is over, if it is.
    pub fn ending(&self) -> Option<LinkEnding> {
        self.shared().ended.borrow().clone()
    }

    /// Waits for the end of the link.
    pub async fn ended(&self) -> LinkEnding {
        self.shared().ended().await
    }

    /// Returns the result of the handshake, once there is one.
    pub fn agreed(&self) -> Option<&Agreed> {
        self.shared().agreed.get()
    }

    pub(crate) fn agree(&self, agreed: Agreed) {
        let _first_counts = self.shared().agreed.set(agreed);
    }

    pub(crate) fn layout(&self) -> Layout {
        Layout { object_uid: self.agreed().is_some_and(|agreed| agreed.object_uid) }
    }

    /// Returns the capabilities that the peer told without being asked.
    pub(crate) fn greeting(&self) -> Option<&[u8]> {
        self.shared().greeting.get().map(Vec::as_slice)
    }

    pub(crate) fn disconnected(&self) -> QiError {
        QiError::Disconnected(self.ending().unwrap_or(LinkEnding::Here))
    }

    pub(crate) fn send(
        &self,
        kind: MessageKind,
        id: u32,
        flags: u8,
        target: MemberTarget,
        payload: Vec<u8>,
    ) -> Result<(), QiError> {
        let MemberTarget { service, object, action } = target;
        let frame = MessageFrame { header: MessageHeader { kind, flags, id, service, object, action }, payload };
        self.shared().send(&frame)
    }

    fn shared(&self) -> &LinkShared {
        &self.0.shared
    }
}

impl LinkShared {
    fn send(&self, frame: &MessageFrame) -> Result<(), QiError> {
        let bytes = frame.to_bytes().ok_or(QiError::Unfit(crate::TypeMismatch::TooLarge))?;
        if let Some(ending) = self.ended.borrow().clone() {
            return Err(QiError::Disconnected(ending));
        }
        let size = bytes.len();
        if self.outgoing_bytes.fetch_add(size, Ordering::Relaxed) + size > QUEUE_MAX_BYTES {
            self.written(size);
            return Err(QiError::Busy { what: "bytes of messages", limit: QUEUE_MAX_BYTES });
        }
        self.outgoing.try_send(bytes).map_err(|error| {
            self.written(size);
            match error {
                mpsc::error::TrySendError::Full(_) => QiError::Busy { what: "messages", limit: QUEUE_MAX_FRAMES },
                mpsc::error::TrySendError::Closed(_) => QiError::Disconnected(LinkEnding::Here),
            }
        })
    }

    /// Notes that so many bytes do not wait any more.
    fn written(&self, bytes: usize) {
        self.outgoing_bytes.fetch_sub(bytes, Ordering::Relaxed);
    }

    /// The first reason counts.
    fn end(&self, ending: LinkEnding) {
        let is_first = self.ended.send_if_modified(|ended| {
            let is_first = ended.is_none();
            ended.get_or_insert(ending);
            is_first
        });
        if is_first {
            self.pending.close();
            self.fan_out.close();
        }
    }

    async fn ended(&self) -> LinkEnding {
        let mut ended = self.ended.subscribe();
        // The sender is `self`, so that this cannot fail while somebody waits here.
        ended.wait_for(Option::is_some).await.ok().and_then(|ending| ending.clone()).unwrap_or(LinkEnding::Here)
    }

    fn heard(&self) {
        let now = u64::try_from(self.began.elapsed().as_micros()).unwrap_or(u64::MAX);
        self.heard_us.store(now, Ordering::Relaxed);
    }
}
