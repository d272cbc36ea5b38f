//! The reliable queue to one client: in order, bounded; who cannot keep up is cut off and fetches everything anew.

use crate::connection::close_signal::{CloseReason, CloseSignal};
use crate::rooms::member::{Recipient, RoomFeed, WholeBehaviour};
use crate::support::identity::{PersonIdentity, Sender, ShareGroup};
use crate::support::lock;
use crate::support::message::encode;
use axum::extract::ws::Utf8Bytes;
use protocol::{Message, Refused};
use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, Weak};
use tokio::sync::mpsc;

/// Messages that may wait for one client: answers to the 200 that it may ask at once, and some of what others do
/// meanwhile. Each takes memory of its own, however short it is.
const QUEUE_MAX_MESSAGES: usize = 1_024;
/// What may wait for one client before another message is put behind it, in bytes.
const QUEUE_MAX_BYTES: usize = 2 << 20;
/// What may wait for all who came by one invitation before each of their links is left its share only, in bytes.
const GROUP_MAX_BYTES: usize = 8 << 20;
/// What may wait for all clients together, in bytes; then the links are left their share of those for whom more waits than
/// [`GROUP_SPARED_BYTES`].
const ALL_MAX_BYTES: usize = 24 << 20;
/// What may always wait for all who came by one invitation, in bytes.
const GROUP_SPARED_BYTES: usize = 512 << 10;
/// The share of a link, in bytes.
const SHARE_BYTES: usize = 48 << 10;
/// Welcomes and opened behaviours that may wait for one client: who opens again and again reads what comes of it.
const WHOLES_MAX: usize = 4;

/// What the writing task of a client is told.
#[derive(Debug)]
pub(crate) enum Out {
    /// Send this.
    Text(Utf8Bytes),
    /// Send this in parts.
    Whole(u32, Box<WholeBehaviour>),
    /// From now on only this room is told of, or none, once its feed comes.
    Want(Option<behaviour::Id>),
    /// From now on tell what goes on in this room, if it is the wanted one.
    Follow(Box<RoomFeed>),
    /// No longer: it is gone.
    Unfollow(behaviour::Id),
    /// Which pictures are wanted.
    Watch {
        /// Of which robot; none means the first one.
        robot: Option<behaviour::Id>,
        /// Pictures of the scene.
        scene: bool,
        /// Live values.
        values: bool,
    },
}

/// The way to one client.
#[derive(Clone, Debug)]
pub(crate) struct Outbox {
    /// The number of the link, never used twice.
    pub(crate) session: u64,
    /// Whose link it is.
    pub(crate) person: Arc<PersonIdentity>,
    /// Ends the link.
    pub(crate) close: CloseSignal,
    queue: mpsc::Sender<Out>,
    waiting: WaitingBytes,
}

/// What waits for one client, and how many bytes for all together.
#[derive(Clone, Debug)]
pub(crate) struct WaitingBytes(Arc<OutboxCounts>);

/// How many bytes wait for all clients together. A clone counts the same.
#[derive(Clone, Debug, Default)]
pub(crate) struct AllWaiting(Arc<AllCounts>);

#[derive(Debug, Default)]
struct AllCounts {
    bytes: AtomicUsize,
    groups: Mutex<HashMap<ShareGroup, Weak<AtomicUsize>>>,
}

/// How many bytes wait for a group, and for all.
#[derive(Clone, Debug)]
struct Together {
    is_host: bool,
    group: Arc<AtomicUsize>,
    all: AllWaiting,
}

#[derive(Debug)]
struct OutboxCounts {
    bytes: AtomicUsize,
    wholes: AtomicUsize,
    together: Together,
}

impl AllWaiting {
    /// The counts that a person has together with others.
    fn together(&self, person: &PersonIdentity) -> Together {
        let (mut groups, group) = (lock(&self.0.groups), person.group());
        groups.retain(|_, count| count.strong_count() > 0);
        let is_host = group == ShareGroup::Host;
        let known = groups.get(&group).and_then(Weak::upgrade);
        let count = known.unwrap_or_else(|| {
            let count = Arc::new(AtomicUsize::new(0));
            groups.insert(group, Arc::downgrade(&count));
            count
        });
        Together { is_host, group: count, all: self.clone() }
    }
}

impl Together {
    /// So much more waits; how much may wait for one link then.
    fn add(&self, bytes: usize) -> usize {
        let group = self.group.fetch_add(bytes, Ordering::Relaxed);
        let all = self.all.0.bytes.fetch_add(bytes, Ordering::Relaxed);
        let is_much = (group > GROUP_MAX_BYTES && !self.is_host) || (all > ALL_MAX_BYTES && group > GROUP_SPARED_BYTES);
        if is_much { SHARE_BYTES } else { QUEUE_MAX_BYTES }
    }

    fn sub(&self, bytes: usize) {
        self.group.fetch_sub(bytes, Ordering::Relaxed);
        self.all.0.bytes.fetch_sub(bytes, Ordering::Relaxed);
    }
}

/// Bytes that are being written: they wait no more for their client, but still take memory.
#[derive(Debug)]
pub(crate) struct BytesInWriting {
    bytes: usize,
    together: Together,
}

impl WaitingBytes {
    fn of(together: Together) -> Self {
        Self(Arc::new(OutboxCounts { bytes: AtomicUsize::new(0), wholes: AtomicUsize::new(0), together }))
    }

    /// Something is put into the queue; false if what waited before was too much.
    fn put(&self, out: &Out) -> bool {
        match out {
            Out::Text(text) => {
                let own = self.0.bytes.fetch_add(text.len(), Ordering::Relaxed);
                own <= self.0.together.add(text.len())
            }
            Out::Whole(..) => self.0.wholes.fetch_add(1, Ordering::Relaxed) < WHOLES_MAX,
            Out::Want(_) | Out::Follow(_) | Out::Unfollow(_) | Out::Watch { .. } => true,
        }
    }

    /// Something was taken out of the queue; its bytes count for all until what is returned is dropped.
    pub(crate) fn taken(&self, out: &Out) -> BytesInWriting {
        let bytes = if let Out::Text(text) = out { text.len() } else { 0 };
        self.0.bytes.fetch_sub(bytes, Ordering::Relaxed);
        if let Out::Whole(..) = out {
            self.0.wholes.fetch_sub(1, Ordering::Relaxed);
        }
        BytesInWriting { bytes, together: self.0.together.clone() }
    }
}

impl Drop for OutboxCounts {
    /// What was never taken waits no more.
    fn drop(&mut self) {
        self.together.sub(*self.bytes.get_mut());
    }
}

impl Drop for BytesInWriting {
    fn drop(&mut self) {
        self.together.sub(self.bytes);
    }
}

impl Outbox {
    /// A way, its other end, and what waits between them.
    pub(crate) fn new(
        session: u64,
        person: Arc<PersonIdentity>,
        all: &AllWaiting,
    ) -> (Self, mpsc::Receiver<Out>, WaitingBytes) {
        let (queue, inbox) = mpsc::channel(QUEUE_MAX_MESSAGES);
        let waiting = WaitingBytes::of(all.together(&person));
        (Self { session, person, close: CloseSignal::new(), queue, waiting: waiting.clone() }, inbox, waiting)
    }

    /// For whom what this link asks is done.
    pub(crate) fn sender(&self) -> Sender {
        self.person.asks(self.session)
    }

    /// Says something.
    pub(crate) fn say(&self, message: Message) {
        self.put(Out::Text(encode(message)));
    }

    /// Whether the link ended.
    pub(crate) fn is_gone(&self) -> bool {
        self.queue.is_closed()
    }

    /// Says why not.
    pub(crate) fn no(&self, ask: u32, no: Refused) {
        self.say(Message::No { ask: Some(ask), no });
    }

    /// Never waits. A single message may be larger than what may wait: who reads gets it.
    pub(crate) fn put(&self, out: Out) {
        if !self.waiting.put(&out) {
            self.close.with(CloseReason::Resync);
        }
        if let Err(mpsc::error::TrySendError::Full(_)) = self.queue.try_send(out) {
            self.close.with(CloseReason::Resync);
        }
    }
}

impl Recipient for Outbox {
    fn session(&self) -> u64 {
        self.session
    }

    fn person(&self) -> &PersonIdentity {
        &self.person
    }

    fn is_gone(&self) -> bool {
        Outbox::is_gone(self)
    }

    fn send(&self, text: Utf8Bytes) {
        self.put(Out::Text(text));
    }

    fn send_whole(&self, ask: u32, whole: WholeBehaviour) {
        self.put(Out::Whole(ask, Box::new(whole)));
    }

    fn follow(&self, feed: Box<RoomFeed>) {
        self.put(Out::Follow(feed));
    }

    fn unfollow(&self, gone: behaviour::Id) {
        self.put(Out::Unfollow(gone));
    }
}

#[cfg(test)]
mod tests {
    use super::{
        ALL_MAX_BYTES, AllWaiting, GROUP_MAX_BYTES, GROUP_SPARED_BYTES, Out, Outbox, QUEUE_MAX_BYTES, SHARE_BYTES,
        WHOLES_MAX,
    };
    use crate::connection::close_signal::CloseReason;
    use crate::rooms::member::WholeBehaviour;
    use crate::rooms::shown::AllShown;
    use crate::support::identity::tests::guest;
    use crate::support::identity::{PersonIdentity, ShareGroup};
    use behaviour::{Behaviour, Room};
    use protocol::{AnyAnswer, Event, Message, Refused};
    use std::sync::atomic::Ordering;
    use std::sync::{Arc, Weak};

    /// How many large replies are queued for a client that reads nothing before its link is cut.
    async fn queued(all: &AllWaiting, person: PersonIdentity) -> (usize, Outbox) {
        let (outbox, _inbox, _) = Outbox::new(1, Arc::new(person), all);
        let no = Message::No { ask: None, no: Refused::Unreadable("x".repeat(32 << 10).into()) };
        for count in 0.. {
            tokio::select! {
                biased;
                _ = outbox.close.wait() => return (count, outbox),
                () = std::future::ready(()) => outbox.say(no.clone()),
            }
        }
        unreachable!("it is cut")
    }

    #[tokio::test]
    async fn who_reads_nothing_is_cut_off_and_gives_everything_back() {
        let all = AllWaiting::default();
        let (count, outbox) = queued(&all, PersonIdentity::Host).await;
        assert!((QUEUE_MAX_BYTES >> 15..=(QUEUE_MAX_BYTES >> 15) + 2).contains(&count), "{count}");
        drop(outbox);
        assert_eq!(all.0.bytes.load(Ordering::Relaxed), 0);
    }

    /// An opened behaviour without records.
    fn opened() -> Out {
        let shown =
            AllShown::default().show(&Arc::new(Room::open(Behaviour::default(), 0)), &Weak::new(), &ShareGroup::Host);
        Out::Whole(1, Box::new(WholeBehaviour { answer: AnyAnswer::Done, shown }))
    }

    #[tokio::test]
    async fn who_opens_again_and_again_without_reading_is_cut_off() {
        let (outbox, mut inbox, waiting) = Outbox::new(1, Arc::new(PersonIdentity::Host), &AllWaiting::default());
        for _ in 0..3 * WHOLES_MAX {
            outbox.put(opened());
            waiting.taken(&inbox.recv().await.unwrap());
        }
        (0..WHOLES_MAX).for_each(|_| outbox.put(opened()));
        tokio::select! {
            biased;
            why = outbox.close.wait() => panic!("who reads is not cut off: {why:?}"),
            () = std::future::ready(()) => outbox.put(opened()),
        }
        assert_eq!(outbox.close.wait().await, CloseReason::Resync);
    }

    #[tokio::test]
    async fn what_is_being_written_still_counts_for_all() {
        let all = AllWaiting::default();
        let (outbox, mut inbox, waiting) = Outbox::new(1, Arc::new(PersonIdentity::Host), &all);
        outbox.say(Event::ProgramsChanged.into());
        let before = all.0.bytes.load(Ordering::Relaxed);
        let writing = waiting.taken(&inbox.recv().await.unwrap());
        assert_eq!((before > 0, all.0.bytes.load(Ordering::Relaxed)), (true, before));
        drop(writing);
        assert_eq!(all.0.bytes.load(Ordering::Relaxed), 0);
    }

    #[tokio::test]
    async fn when_much_waits_for_all_who_has_much_is_left_a_share() {
        let all = AllWaiting::default();
        all.0.bytes.store(ALL_MAX_BYTES, Ordering::Relaxed);
        let spared = queued(&all, guest("a", "ben")).await.0;
        assert!((GROUP_SPARED_BYTES >> 15..=(GROUP_SPARED_BYTES >> 15) + 2).contains(&spared), "{spared}");
    }

    /// Those who came by one link and read nothing are cut off before anybody else notices.
    #[tokio::test]
    async fn an_invitation_that_reads_nothing_leaves_the_others_theirs() {
        let (all, mut held) = (AllWaiting::default(), Vec::new());
        for cookie in 0..100 {
            held.push(queued(&all, guest("many", &cookie.to_string())).await);
        }
        assert!(held[0].0 >= QUEUE_MAX_BYTES >> 15 && held[99].0 <= (SHARE_BYTES >> 15) + 2);
        assert!(all.0.bytes.load(Ordering::Relaxed) <= GROUP_MAX_BYTES + 100 * (SHARE_BYTES + (64 << 10)));
        for person in [PersonIdentity::Host, guest("other", "one")] {
            assert!(queued(&all, person).await.0 >= QUEUE_MAX_BYTES >> 15);
        }
    }
}
