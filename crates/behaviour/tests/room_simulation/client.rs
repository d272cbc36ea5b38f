//! Somebody with a page: what they see, what they wait for, which locks they were given.

use crate::gestures;
use crate::server::{Down, Mutant, Up, Wish};
use crate::witness::{Check, Disk, check_fits};
use behaviour::{Behaviour, Change, Grant, Id, LockToken, RecordId};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Changes that may wait for an answer.
const PENDING_MAX: usize = 8;

pub(crate) struct Client {
    pub(crate) id: Id,
    name: String,
    mutant: Option<Mutant>,
    pub(crate) seen: Behaviour,
    pub(crate) revision: u64,
    /// The link, as far as the client knows.
    pub(crate) link: Option<u64>,
    pub(crate) is_welcome: bool,
    pub(crate) pending: VecDeque<Wish>,
    /// The changes that were answered, each with true if it was made, as this client was told.
    pub(crate) answers: BTreeMap<Id, bool>,
    locks: BTreeMap<LockToken, BTreeSet<RecordId>>,
    ops: u64,
    /// The error of its clock, in milliseconds.
    pub(crate) off_ms: i64,
}

impl Client {
    pub(crate) fn new(number: usize, seen: Behaviour, mutant: Option<Mutant>) -> Self {
        let (id, name) = (gestures::id(&format!("client{number}")), format!("P{number}"));
        let (pending, answers, locks) = (VecDeque::new(), BTreeMap::new(), BTreeMap::new());
        let (link, is_welcome, ops, off_ms) = (None, false, 0, 0);
        Self { id, name, mutant, seen, revision: 0, link, is_welcome, pending, answers, locks, ops, off_ms }
    }

    fn op(&mut self) -> Id {
        self.ops += 1;
        gestures::id(&format!("{}-{}", self.id, self.ops))
    }

    /// Edits what it sees.
    pub(crate) fn edit(&mut self, now_ms: u64, number: u64) -> Vec<Up> {
        let start = Change::of(self.op(), &self.name, "gesture");
        let at_ms = now_ms.saturating_add_signed(self.off_ms);
        let change = gestures::gesture(Change { at_ms, by: Some(self.id.clone()), ..start }, &self.seen, number);
        self.wish(Wish::Change(change))
    }

    /// Takes back its last change, or does it again.
    pub(crate) fn undo(&mut self, again: bool) -> Vec<Up> {
        let op = self.op();
        self.wish(Wish::Undo { op, again })
    }

    fn wish(&mut self, wish: Wish) -> Vec<Up> {
        if self.pending.len() >= PENDING_MAX {
            return Vec::new();
        }
        self.pending.push_back(wish.clone());
        if self.is_welcome { vec![self.send(wish)] } else { Vec::new() }
    }

    fn send(&self, wish: Wish) -> Up {
        Up::Propose(wish, self.locks.keys().copied().collect())
    }

    fn send_again(&self) -> Vec<Up> {
        self.pending.iter().cloned().map(|wish| self.send(wish)).collect()
    }

    /// One of the locks it thinks it has.
    pub(crate) fn lock(&self, nth: u64) -> Option<LockToken> {
        let many = self.locks.len() as u64;
        self.locks.keys().nth(nth.checked_rem(many)? as usize).copied()
    }

    /// Returns its tokens, as a server before this one would have given them.
    pub(crate) fn older_tokens(&self) -> Vec<LockToken> {
        self.locks.keys().map(|token| LockToken { epoch: token.epoch.wrapping_sub(1), ..*token }).collect()
    }

    /// It gives a lock back.
    pub(crate) fn forget(&mut self, token: LockToken) {
        self.locks.remove(&token);
    }

    /// Takes another link, or none.
    pub(crate) fn connect(&mut self, link: Option<u64>) {
        (self.link, self.is_welcome) = (link, false);
    }

    /// Hears the server, and what it says to that.
    pub(crate) fn hear(&mut self, down: Down, disk: &Disk) -> Result<Vec<Up>, String> {
        match down {
            Down::Welcome { revision, behaviour, grants } => {
                (self.revision, self.seen, self.is_welcome) = (revision, behaviour, true);
                self.locks = grants.into_iter().map(|Grant { token, records }| (token, records)).collect();
                return Ok(self.send_again());
            }
            Down::Changed(committed) => return self.apply(committed.revision, &committed.change),
            Down::Missed(changes) => {
                for committed in changes {
                    if committed.revision == self.revision + 1 {
                        self.apply(committed.revision, &committed.change)?;
                    }
                }
            }
            Down::Made(op, revision) => self.answered(&op, true, disk.ops.get(&op) == Some(&revision))?,
            Down::Refused(op) => self.answered(&op, false, !disk.ops.contains_key(&op))?,
            Down::Granted(grant) => drop(self.locks.insert(grant.token, grant.records)),
            Down::Freed(token) => self.forget(token),
            Down::Ping(revision) => return Ok(self.pinged(revision)),
            Down::Closed => self.connect(None),
        }
        Ok(Vec::new())
    }

    fn apply(&mut self, revision: u64, change: &Change) -> Result<Vec<Up>, String> {
        let is_next = revision == self.revision + 1;
        if revision <= self.revision || !self.is_welcome {
            return Ok(Vec::new());
        }
        if !is_next && self.mutant != Some(Mutant::IgnoredGap) {
            return Ok(vec![Up::Since(self.revision)]);
        }
        check_fits(&self.seen, change).map_err(|why| format!("a gap at {}: {why}", self.id))?;
        self.seen.apply(change);
        self.revision = revision;
        Ok(Vec::new())
    }

    fn pinged(&self, revision: Option<u64>) -> Vec<Up> {
        let missed = revision.is_some_and(|revision| revision > self.revision) && self.is_welcome;
        let since = missed.then_some(Up::Since(self.revision));
        [Up::Pong].into_iter().chain(since).chain(self.send_again()).collect()
    }

    fn answered(&mut self, op: &Id, made: bool, is_true: bool) -> Check {
        if !is_true {
            return Err(format!("{op} is answered as made: {made}, and the store says otherwise"));
        }
        self.pending.retain(|wish| wish.op() != op);
        let before = self.answers.insert(op.clone(), made);
        if before.is_some_and(|before| before != made) { Err(format!("{op} is answered both ways")) } else { Ok(()) }
    }
}
