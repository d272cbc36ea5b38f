//! Watches what is granted, let in and saved, and compares it with what was promised. Knows nothing of how rooms do it.

use crate::gestures::check_rules;
use behaviour::{Behaviour, Change, Committed, Edit, Grant, Id, Kind, LockToken, Presented, RecordId};
use std::collections::BTreeMap;

/// The result of a check: the words of what went wrong, if something did.
pub(crate) type Check = Result<(), String>;

/// The longest time that the locks of a dead client may last.
const DEAD_MAX_MS: u64 = 25_000;

/// The clients that were told that a record is theirs.
#[derive(Default)]
pub(crate) struct Witness {
    holders: BTreeMap<RecordId, (LockToken, u64)>,
    /// Whose each link is.
    clients: BTreeMap<u64, Id>,
    /// Links that carry nothing any more, and since when.
    dead: BTreeMap<u64, u64>,
}

impl Witness {
    /// A client is let in by a link.
    pub(crate) fn welcomed(&mut self, session: u64, client: Id) {
        self.clients.insert(session, client);
    }

    /// Somebody is told that they have a lock.
    pub(crate) fn granted(&mut self, session: u64, grant: &Grant) -> Check {
        for record in &grant.records {
            let here = self.holders.insert(record.clone(), (grant.token, session));
            if here.is_some_and(|(token, _)| token != grant.token) {
                return Err(format!("two hold {record}"));
            }
        }
        Ok(())
    }

    /// A lock ended.
    pub(crate) fn freed(&mut self, grant: &Grant) {
        self.holders.retain(|_, (token, _)| *token != grant.token);
    }

    /// One of the records that somebody holds.
    pub(crate) fn held(&self, number: u64) -> Option<RecordId> {
        let many = self.holders.len() as u64;
        self.holders.keys().nth(number.checked_rem(many)? as usize).cloned()
    }

    /// Every token that is good for something.
    pub(crate) fn tokens(&self) -> Vec<LockToken> {
        self.holders.values().map(|(token, _)| *token).collect()
    }

    /// A link carries nothing any more.
    pub(crate) fn dies(&mut self, session: u64, now_ms: u64) {
        self.dead.entry(session).or_insert(now_ms);
    }

    /// Something that was on its way when the link died arrived only now.
    pub(crate) fn heard(&mut self, session: u64, now_ms: u64) {
        self.dead.entry(session).and_modify(|since_ms| *since_ms = now_ms);
    }

    /// A server died, and all that it had promised.
    pub(crate) fn epoch_ends(&mut self) {
        *self = Self::default();
    }

    /// The first record of a change that another holds, if it came without what shows that it may.
    fn other(&self, change: &Change, presented: &Presented) -> Option<RecordId> {
        let mut edits = change.edits.iter().filter(|edit| edit.id.kind != Kind::Place);
        let found = edits.find(|edit| {
            self.holders.get(&edit.id).is_some_and(|(token, session)| {
                presented.client.as_ref() != self.clients.get(session) || !presented.tokens.contains(token)
            })
        });
        found.map(|edit| edit.id.clone())
    }

    /// A change is let in.
    pub(crate) fn let_in(&self, sent: &Change, made: &Change, presented: &Presented) -> Check {
        if let Some(record) = self.other(sent, presented) {
            return Err(format!("{} let somebody edit {record}, which another holds", made.op));
        }
        if sent.edits == made.edits {
            Ok(())
        } else {
            Err(format!("an update is lost: {} saw something else", sent.op))
        }
    }

    /// A change is refused because of a lock.
    pub(crate) fn kept_out(&self, sent: &Change, presented: &Presented) -> Check {
        let other = self.other(sent, presented);
        other.map_or_else(|| Err(format!("{} is refused, and nobody else holds anything of it", sent.op)), |_| Ok(()))
    }

    /// A change is saved. Who sent it may have got a lock meanwhile, nobody else.
    pub(crate) fn saved(&self, change: &Change, presented: &Presented) -> Check {
        let holder = |edit: &Edit| self.holders.get(&edit.id).and_then(|(_, session)| self.clients.get(session));
        let edits = change.edits.iter().filter(|edit| edit.id.kind != Kind::Place);
        let mut others =
            edits.filter(|edit| holder(edit).is_some_and(|holder| presented.client.as_ref() != Some(holder)));
        let other = others.next().map(|edit| format!("{} was got by another while {} was saved", edit.id, change.op));
        other.map_or(Ok(()), Err)
    }

    /// Time passed.
    pub(crate) fn check_dead(&self, now_ms: u64) -> Check {
        let since = |session| self.dead.get(session).copied().unwrap_or(now_ms);
        let late = self.holders.iter().find(|(_, (_, session))| now_ms - since(session) > DEAD_MAX_MS);
        late.map_or(Ok(()), |(record, _)| Err(format!("a dead client still holds {record}")))
    }
}

/// The data that outlives the server.
pub(crate) struct Disk {
    pub(crate) log: Vec<Committed>,
    /// The revision each change made.
    pub(crate) ops: BTreeMap<Id, u64>,
    /// All of them applied.
    pub(crate) behaviour: Behaviour,
    pub(crate) epoch: u64,
}

impl Disk {
    /// A disk with a behaviour and no change of it.
    pub(crate) fn new(behaviour: Behaviour) -> Self {
        Self { log: Vec::new(), ops: BTreeMap::new(), behaviour, epoch: 0 }
    }

    /// The newest revision.
    pub(crate) fn revision(&self) -> u64 {
        self.log.len() as u64
    }

    /// Keeps a change for ever.
    pub(crate) fn append(&mut self, committed: &Committed) -> Check {
        let Committed { revision, change } = committed;
        if *revision != self.revision() + 1 {
            return Err(format!("revision {revision} is saved after {}", self.revision()));
        }
        if self.ops.insert(change.op.clone(), *revision).is_some() {
            return Err(format!("{} is saved twice", change.op));
        }
        check_fits(&self.behaviour, change)?;
        self.behaviour.apply(change);
        self.log.push(committed.clone());
        check_rules(&self.behaviour)
    }

    /// All changes applied anew.
    pub(crate) fn replay(&self, start: Behaviour) -> Behaviour {
        self.log.iter().fold(start, |mut behaviour, committed| {
            behaviour.apply(&committed.change);
            behaviour
        })
    }
}

/// Checks that a change finds what it says it found.
pub(crate) fn check_fits(behaviour: &Behaviour, change: &Change) -> Check {
    let other = change.edits.iter().find(|edit| behaviour.records.get(&edit.id) != edit.before.as_ref());
    other.map_or(Ok(()), |edit| Err(format!("{} does not fit what is there of {}", change.op, edit.id)))
}
