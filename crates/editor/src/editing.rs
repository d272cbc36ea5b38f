//! The editor that is open in this tab, and who may write in it: pure, with times on the clock of the page.

use behaviour::{AskResult, Change, Grant, Id, LockEndReason, LockEvent, LockToken, Record, RecordId};
use protocol::LockShown;

/// The editor of one record.
#[derive(Clone, Debug, PartialEq)]
pub struct Editing {
    /// Counts the editors of this tab, so that the late end of an old one is recognised.
    pub number: u32,
    pub behaviour: Id,
    pub record: RecordId,
    pub writing: WriteRight,
    /// The record as whoever types here has seen it: as it was when they began, with what they saved since.
    pub seen: Option<Record>,
    /// Whoever typed has left; it ends as soon as what they typed is on its way.
    pub is_over: bool,
}

/// The right to write in an open editor.
#[derive(Clone, Debug, PartialEq)]
pub enum WriteRight {
    /// It was just opened and its lock is asked for; one may write already.
    Opening,
    /// Without a lock: the server is not reached, or gives none. What is saved meanwhile is found by comparing.
    Free,
    /// Nobody else may write.
    Own(OwnLock),
    /// Somebody else may, so this one only reads.
    No(EditReading),
}

/// A lock of one's own.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnLock {
    pub token: LockToken,
    /// The person who asks for it, if somebody does.
    pub asker: Option<String>,
    /// It was kept from them for a minute, and is handed over now.
    pub is_last: bool,
    /// The time when it will be free for others, as nothing was typed for long.
    pub free_ms: Option<f64>,
}

/// Reading what others may change.
#[derive(Clone, Debug, PartialEq)]
pub struct EditReading {
    /// The person who is editing; none if nobody is any more.
    pub by: Option<String>,
    /// It was one's own until now: what was written stays to be seen.
    pub was_own: bool,
    pub asking: Asking,
}

/// The state of asking for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asking {
    /// Nothing was asked.
    No,
    /// The holder is asked; silence until then means yes.
    Waits { until_ms: f64 },
    /// Others asked before.
    Queued,
    /// The holder keeps it; one may ask again then.
    Kept { again_ms: f64 },
    /// Enough others are waiting for it.
    Full,
}

impl Editing {
    /// Just opened: to be written in unless it is known already that somebody else is editing.
    pub fn open(number: u32, behaviour: Id, (record, seen): (RecordId, Option<Record>), by: Option<String>) -> Self {
        let writing = by.map_or(WriteRight::Opening, |by| WriteRight::No(EditReading::of(Some(by), false)));
        Self { number, behaviour, record, writing, seen, is_over: false }
    }

    /// Returns the record as a change makes it, if the change is about it.
    pub fn made_by<'a>(&self, change: &'a Change) -> Option<Option<&'a Record>> {
        let edit = change.edits.iter().find(|edit| edit.id == self.record)?;
        Some(edit.after.as_ref())
    }

    /// True if somebody else may write, so that one only reads here.
    pub fn reads(&self) -> bool {
        matches!(self.writing, WriteRight::No(_))
    }

    /// True if it was one's own until nothing was typed for long, and nobody else took it since.
    pub fn is_free_again(&self) -> bool {
        matches!(&self.writing, WriteRight::No(EditReading { by: None, was_own: true, .. }))
    }

    /// True if what others save is shown here as it comes, so that nobody has to be told.
    pub fn only_reads(&self) -> bool {
        matches!(&self.writing, WriteRight::No(reading) if !reading.was_own)
    }

    /// The token of one's own lock.
    pub fn token(&self) -> Option<LockToken> {
        match &self.writing {
            WriteRight::Own(own) => Some(own.token),
            WriteRight::Opening | WriteRight::Free | WriteRight::No(_) => None,
        }
    }

    /// Takes a lock that is for what is edited. Returns true if it is one's own now.
    pub fn granted(&mut self, grant: &Grant) -> bool {
        let is_mine = grant.records.contains(&self.record);
        if is_mine && self.token() != Some(grant.token) {
            self.writing = WriteRight::Own(OwnLock { token: grant.token, asker: None, is_last: false, free_ms: None });
        }
        is_mine
    }

    /// Somebody else is editing it.
    pub fn denied(&mut self, by: &str) {
        let was_own = match &self.writing {
            WriteRight::Opening => false,
            WriteRight::Free | WriteRight::Own(_) => true,
            WriteRight::No(reading) => reading.was_own,
        };
        self.writing = WriteRight::No(EditReading::of(Some(by.to_owned()), was_own));
    }

    /// There is no lock to be had: everybody writes, and comparing finds who was late.
    pub fn not_locked(&mut self) {
        if self.writing == WriteRight::Opening {
            self.writing = WriteRight::Free;
        }
    }

    /// The link broke: what was locked may be lost, and what was asked is forgotten.
    pub fn link_lost(&mut self) {
        match &mut self.writing {
            WriteRight::Opening | WriteRight::Own(_) => self.writing = WriteRight::Free,
            WriteRight::No(reading) => reading.asking = Asking::No,
            WriteRight::Free => {}
        }
    }

    /// Hears who is editing what now, as everyone is told.
    pub fn shown(&mut self, locks: &[LockShown], me: Option<&Id>) {
        let WriteRight::No(reading) = &mut self.writing else { return };
        let lock = locks.iter().find(|lock| lock.records.contains(&self.record));
        let is_mine = lock.is_some_and(|lock| Some(&lock.client) == me);
        if !is_mine {
            reading.by = lock.map(|lock| lock.name.clone());
        }
    }

    /// Hears the server's answer to asking. Returns true if it can be had at once.
    pub fn asked(&mut self, asked: &AskResult, at: impl Fn(u64) -> f64) -> bool {
        let WriteRight::No(reading) = &mut self.writing else { return false };
        reading.asking = match asked {
            AskResult::Waiting { by_ms } => Asking::Waits { until_ms: at(*by_ms) },
            AskResult::Queued { .. } => Asking::Queued,
            AskResult::TooSoon { again_ms } => Asking::Kept { again_ms: at(*again_ms) },
            AskResult::Full => Asking::Full,
            AskResult::Free | AskResult::Yours => Asking::No,
        };
        matches!(asked, AskResult::Free | AskResult::Yours)
    }

    /// Something happened to a lock that is held or wanted here.
    pub fn hear(&mut self, event: &LockEvent, at: impl Fn(u64) -> f64) {
        match event {
            LockEvent::Freed { grant, why, .. } if self.token() == Some(grant.token) => self.freed(why),
            LockEvent::Asked { token, asker, last, .. } if self.token() == Some(*token) => {
                self.own(|own| (own.asker, own.is_last) = (Some(asker.name.clone()), *last));
            }
            LockEvent::Withdrawn { token, .. } if self.token() == Some(*token) => self.own(|own| own.asker = None),
            LockEvent::Warned { token, free_ms, .. } if self.token() == Some(*token) => {
                self.own(|own| own.free_ms = Some(at(*free_ms)));
            }
            LockEvent::Postponed { record, by_ms, .. } if *record == self.record => {
                self.asks(Asking::Waits { until_ms: at(*by_ms) });
            }
            LockEvent::NotYet { record, again_ms, .. } if *record == self.record => {
                self.asks(Asking::Kept { again_ms: at(*again_ms) });
            }
            LockEvent::Denied { .. } => self.asks(Asking::Full),
            LockEvent::Granted { .. }
            | LockEvent::Freed { .. }
            | LockEvent::Asked { .. }
            | LockEvent::Withdrawn { .. }
            | LockEvent::Warned { .. }
            | LockEvent::Postponed { .. }
            | LockEvent::NotYet { .. }
            | LockEvent::KeptFor { .. } => {}
        }
    }

    fn freed(&mut self, why: &LockEndReason) {
        let by = match why {
            LockEndReason::HandedOver { to } => Some(to.clone()),
            LockEndReason::TakenOver { by } => Some(by.clone()),
            LockEndReason::Released | LockEndReason::Idle | LockEndReason::Left => None,
        };
        self.writing = WriteRight::No(EditReading::of(by, true));
    }

    /// Does something with one's own lock, if there is one.
    pub fn own(&mut self, act: impl FnOnce(&mut OwnLock)) {
        if let WriteRight::Own(own) = &mut self.writing {
            act(own);
        }
    }

    /// One asks no more.
    pub fn withdrawn(&mut self) {
        self.asks(Asking::No);
    }

    fn asks(&mut self, now: Asking) {
        if let WriteRight::No(reading) = &mut self.writing {
            reading.asking = now;
        }
    }

    /// Time goes on: after a while one may ask again.
    pub fn tick(&mut self, now_ms: f64) {
        if let WriteRight::No(EditReading { asking: asking @ Asking::Kept { .. }, .. }) = &mut self.writing
            && matches!(asking, Asking::Kept { again_ms } if *again_ms <= now_ms)
        {
            *asking = Asking::No;
        }
    }
}

impl EditReading {
    fn of(by: Option<String>, was_own: bool) -> Self {
        Self { by, was_own, asking: Asking::No }
    }
}

#[cfg(test)]
mod tests {
    use super::{Asking, EditReading, Editing, OwnLock, WriteRight};
    use behaviour::{AskResult, Grant, Holder, Id, Kind, LockEndReason, LockEvent, LockToken, RecordId};
    use protocol::LockShown;
    use std::collections::BTreeSet;

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    fn record() -> RecordId {
        RecordId::new(Kind::Connector, &id("c"))
    }

    fn opened(by: Option<&str>) -> Editing {
        Editing::open(1, id("b"), (record(), None), by.map(str::to_owned))
    }

    fn grant(counter: u64) -> Grant {
        Grant { token: LockToken { epoch: 1, counter }, records: BTreeSet::from([record()]) }
    }

    fn yuki() -> Holder {
        Holder { session: 1, client: id("y"), name: "Yuki".into() }
    }

    fn reading(by: Option<&str>, was_own: bool, asking: Asking) -> WriteRight {
        WriteRight::No(EditReading { by: by.map(str::to_owned), was_own, asking })
    }

    #[test]
    fn who_comes_second_reads_until_it_is_handed_over() {
        let mut editing = opened(None);
        editing.denied("Yuki");
        assert_eq!(editing.writing, reading(Some("Yuki"), false, Asking::No));
        assert!(!editing.asked(&AskResult::Waiting { by_ms: 10 }, |ms| ms as f64));
        let later = LockEvent::Postponed { to: yuki(), record: record(), by_ms: 20 };
        editing.hear(&later, |ms| ms as f64);
        assert_eq!(editing.writing, reading(Some("Yuki"), false, Asking::Waits { until_ms: 20.0 }));
        assert!(editing.granted(&grant(2)));
        assert_eq!(editing.token(), Some(grant(2).token));
    }

    #[test]
    fn who_asks_is_shown_until_they_ask_no_more_and_whether_it_is_the_last_time() {
        let mut editing = opened(None);
        editing.granted(&grant(1));
        let (holder, token, record) = (yuki(), grant(1).token, record());
        let asked = LockEvent::Asked { holder, token, asker: yuki(), record, by_ms: 10, last: true };
        editing.hear(&asked, |ms| ms as f64);
        assert!(matches!(&editing.writing, WriteRight::Own(OwnLock { asker: Some(_), is_last: true, .. })));
        editing.hear(&LockEvent::Withdrawn { holder: yuki(), token, asker: yuki() }, |ms| ms as f64);
        assert!(matches!(&editing.writing, WriteRight::Own(OwnLock { asker: None, .. })));
    }

    #[test]
    fn what_is_kept_can_be_asked_for_again_after_a_while() {
        let mut editing = opened(Some("Yuki"));
        let kept = LockEvent::NotYet { to: yuki(), record: record(), by: "Yuki".into(), again_ms: 30 };
        editing.hear(&kept, |ms| ms as f64);
        editing.tick(29.0);
        assert_eq!(editing.writing, reading(Some("Yuki"), false, Asking::Kept { again_ms: 30.0 }));
        editing.tick(30.0);
        assert_eq!(editing.writing, reading(Some("Yuki"), false, Asking::No));
    }

    #[test]
    fn what_was_handed_over_stays_to_be_seen() {
        let mut editing = opened(None);
        editing.granted(&grant(1));
        let freed = |grant, why| LockEvent::Freed { holder: yuki(), grant, why };
        editing.hear(&freed(grant(7), LockEndReason::Idle), |ms| ms as f64);
        assert!(matches!(&editing.writing, WriteRight::Own(OwnLock { .. })), "another lock's end is none of it");
        editing.hear(&freed(grant(1), LockEndReason::HandedOver { to: "Aiko".into() }), |ms| ms as f64);
        assert_eq!(editing.writing, reading(Some("Aiko"), true, Asking::No));
        editing.shown(&[], None);
        assert_eq!(editing.writing, reading(None, true, Asking::No));
    }

    #[test]
    fn without_a_link_one_writes_and_who_has_it_on_return_is_named() {
        let mut editing = opened(None);
        editing.granted(&grant(1));
        editing.link_lost();
        assert_eq!(editing.writing, WriteRight::Free);
        editing.denied("Yuki");
        assert_eq!(editing.writing, reading(Some("Yuki"), true, Asking::No));
    }

    #[test]
    fn ones_own_lock_is_nobody_elses() {
        let mut editing = opened(Some("Yuki"));
        let mine = LockShown { client: id("me"), name: "Aiko".into(), records: [record()].into(), away: false };
        editing.shown(std::slice::from_ref(&mine), Some(&id("me")));
        assert_eq!(editing.writing, reading(Some("Yuki"), false, Asking::No));
        editing.shown(&[mine], Some(&id("other")));
        assert_eq!(editing.writing, reading(Some("Aiko"), false, Asking::No));
    }
}
