//! The clients, the server and the links between them, as one plan moves them, and what must be true when all is calm.

use crate::client::Client;
use crate::gestures::{id, record, start};
use crate::plan::{Plan, Step};
use crate::server::{Down, Server, Up};
use crate::witness::Check;
use behaviour::{AnyKnowledge, Change, Committed, Decision, RecordId, Room, UndoLog};
use std::collections::{BTreeMap, VecDeque};

/// Rounds of a second in which everything must have become calm.
const CALM_ROUNDS: usize = 60;
/// Rounds of a second until everybody heard a ping.
const PING_ROUNDS: usize = 7;

struct Link {
    client: usize,
    up: VecDeque<Up>,
    down: VecDeque<Down>,
    /// Nothing is put on it any more.
    is_dead: bool,
}

/// The failure of a plan.
pub(crate) struct Failure {
    /// The step, or one after the last.
    pub(crate) step: usize,
    pub(crate) why: String,
}

pub(crate) struct World {
    pub(crate) server: Server,
    clients: Vec<Client>,
    links: BTreeMap<u64, Link>,
    sessions: u64,
    now_ms: u64,
}

impl World {
    fn new(plan: &Plan) -> Self {
        let people = plan.people.clamp(2, 6);
        let clients = (0..people).map(|number| Client::new(number, start(), plan.mutant)).collect();
        Self { server: Server::new(plan.mutant), clients, links: BTreeMap::new(), sessions: 0, now_ms: 0 }
    }

    /// Plays a plan, then lets everything become calm. Says what happened how often.
    pub(crate) fn play(plan: &Plan) -> Result<BTreeMap<&'static str, usize>, Failure> {
        let mut world = Self::new(plan);
        for (number, step) in plan.steps.iter().enumerate() {
            let done = world.step(step).and_then(|()| world.server.witness.check_dead(world.now_ms));
            done.map_err(|why| Failure { step: number, why })?;
        }
        let calm = world.calm().and_then(|()| world.check_calm()).and_then(|()| world.check_undone());
        calm.map_err(|why| Failure { step: plan.steps.len(), why })?;
        Ok(world.server.counts)
    }

    fn who(&self, who: u64) -> usize {
        (who % self.clients.len() as u64) as usize
    }

    fn step(&mut self, step: &Step) -> Check {
        match *step {
            Step::Wait { ms, flowing } => self.wait(ms, flowing)?,
            Step::Edit { who, gesture } => self.wish(who, |client, now_ms| client.edit(now_ms, gesture)),
            Step::Forge { who, gesture, others } => self.forge(who, gesture, others),
            Step::Undo { who, again } => self.wish(who, |client, _| client.undo(again)),
            Step::Pass { link, up, nth } => self.pass(link, up, nth)?,
            Step::Lose { link, up, nth } => self.lose(link, up, nth),
            Step::Flush { who } => {
                let session = self.clients[self.who(who)].link;
                session.map_or(Ok(()), |session| self.flush(session))?;
            }
            Step::Cut { who } => self.cut(self.who(who)),
            Step::HalfOpen { who } => self.half_open(self.who(who)),
            Step::Connect { who } => self.connect(self.who(who)),
            Step::Jump { who, ms } => {
                let who = self.who(who);
                self.clients[who].off_ms = ms;
            }
            Step::Store { fails } => self.server.saved(fails)?,
            Step::Kill { kept } => self.kill(kept)?,
            Step::Take { .. } | Step::Release { .. } | Step::Type { .. } => self.lock_step(step),
            Step::Ask { .. } | Step::Answer { .. } | Step::Steal { .. } => self.lock_step(step),
        }
        self.carry();
        Ok(())
    }

    fn forge(&mut self, who: u64, gesture: u64, others: bool) {
        let tokens = match others {
            true => self.server.witness.tokens(),
            false => self.clients[self.who(who)].older_tokens(),
        };
        self.wish(who, |client, now_ms| {
            let ups = client.edit(now_ms, gesture).into_iter();
            ups.map(|up| if let Up::Propose(wish, _) = up { Up::Propose(wish, tokens.clone()) } else { up }).collect()
        });
    }

    /// A client wants something.
    fn wish(&mut self, who: u64, wish: impl FnOnce(&mut Client, u64) -> Vec<Up>) {
        let (who, now_ms) = (self.who(who), self.now_ms);
        let ups = wish(&mut self.clients[who], now_ms);
        self.send(who, ups);
    }

    /// Steps with locks are one message.
    fn lock_step(&mut self, step: &Step) {
        let lock = |who: u64, nth: u64| self.clients[self.who(who)].lock(nth);
        let (who, up) = match step {
            Step::Take { who, records } => {
                (who, Some(Up::Take(records.iter().map(|number| record(*number)).collect())))
            }
            Step::Release { who, nth } => (who, lock(*who, *nth).map(Up::Release)),
            Step::Type { who, nth } => (who, lock(*who, *nth).map(Up::Type)),
            Step::Ask { who, record: number } => (who, Some(Up::Ask(self.held(*number)))),
            Step::Answer { who, nth, yes } => (who, lock(*who, *nth).map(|token| Up::Answer(token, *yes))),
            Step::Steal { who, record: number } => (who, Some(Up::Steal(self.held(*number)))),
            _ => return,
        };
        let who = self.who(*who);
        if let Some(Up::Release(token)) = up {
            self.clients[who].forget(token);
        }
        self.send(who, up.into_iter().collect());
    }

    /// A record that somebody holds, if anybody does.
    fn held(&self, number: u64) -> RecordId {
        self.server.witness.held(number).unwrap_or_else(|| record(number))
    }

    /// Puts messages of a client on its link.
    fn send(&mut self, who: usize, ups: Vec<Up>) {
        let link = self.clients[who].link.and_then(|session| self.links.get_mut(&session));
        if let Some(link) = link.filter(|link| !link.is_dead) {
            link.up.extend(ups);
        }
    }

    /// Puts what the server said on the links.
    fn carry(&mut self) {
        for (session, down) in std::mem::take(&mut self.server.said) {
            if let Some(link) = self.links.get_mut(&session).filter(|link| !link.is_dead) {
                link.down.push_back(down);
            }
        }
    }

    /// A message that waits at one of the links.
    fn choose(&self, link: u64, up: bool, nth: u64) -> Option<(u64, usize)> {
        let waiting = |link: &Link| if up { link.up.len() } else { link.down.len() };
        let some: Vec<(u64, usize)> =
            self.links.iter().map(|(session, link)| (*session, waiting(link))).filter(|(_, many)| *many > 0).collect();
        let (session, many) = *some.get((link.checked_rem(some.len() as u64)?) as usize)?;
        Some((session, (nth % many as u64) as usize))
    }

    fn pass(&mut self, link: u64, up: bool, nth: u64) -> Check {
        match self.choose(link, up, nth) {
            Some((session, nth)) if up => self.pass_up(session, nth),
            Some((session, nth)) => self.pass_down(session, nth),
            None => Ok(()),
        }
    }

    fn pass_up(&mut self, session: u64, nth: usize) -> Check {
        let up = self.links.get_mut(&session).and_then(|link| link.up.remove(nth));
        if let Some(up) = up {
            self.server.witness.heard(session, self.now_ms);
            self.server.hear(session, up)?;
            self.carry();
        }
        Ok(())
    }

    fn pass_down(&mut self, session: u64, nth: usize) -> Check {
        let Some(link) = self.links.get_mut(&session) else { return Ok(()) };
        let (who, down) = (link.client, link.down.remove(nth));
        let Some(down) = down.filter(|_| self.clients[who].link == Some(session)) else { return Ok(()) };
        let ups = self.clients[who].hear(down, &self.server.disk)?;
        self.send(who, ups);
        Ok(())
    }

    fn lose(&mut self, link: u64, up: bool, nth: u64) {
        let Some((session, nth)) = self.choose(link, up, nth) else { return };
        let Some(link) = self.links.get_mut(&session) else { return };
        if up {
            link.up.remove(nth);
        } else {
            link.down.remove(nth);
        }
    }

    /// Everything on a link arrives in order.
    fn flush(&mut self, session: u64) -> Check {
        loop {
            let Some(link) = self.links.get(&session) else { return Ok(()) };
            match (link.up.is_empty(), link.down.is_empty()) {
                (true, true) => return Ok(()),
                (false, _) => self.pass_up(session, 0)?,
                (true, false) => self.pass_down(session, 0)?,
            }
        }
    }

    fn flush_all(&mut self) -> Check {
        let sessions: Vec<u64> = self.links.keys().copied().collect();
        sessions.into_iter().try_for_each(|session| self.flush(session))?;
        self.links.retain(|_, link| !link.is_dead || !link.up.is_empty());
        Ok(())
    }

    /// Time passes, in as many pieces as the server needs. The store answers meanwhile.
    fn wait(&mut self, ms: u64, flowing: bool) -> Check {
        let until_ms = self.now_ms + ms;
        while self.now_ms < until_ms {
            while !self.server.is_idle() {
                self.server.saved(false)?;
            }
            self.now_ms = self.server.due_ms().max(self.now_ms + 1).min(until_ms);
            let has_pinged = self.server.tick(self.now_ms)?;
            self.carry();
            if has_pinged && flowing {
                let alive = |client: &Client| client.link.filter(|session| self.links.contains_key(session));
                let alive: Vec<u64> = self.clients.iter().filter_map(alive).collect();
                alive.into_iter().try_for_each(|session| self.flush(session))?;
            }
            self.server.witness.check_dead(self.now_ms)?;
        }
        Ok(())
    }

    /// The link of a client carries nothing more of it; what is on its way arrives, and then that it ended.
    fn cut(&mut self, who: usize) {
        let Some(session) = self.clients[who].link else { return };
        self.clients[who].connect(None);
        let Some(link) = self.links.get_mut(&session).filter(|link| !link.is_dead) else { return };
        link.up.retain(|up| !matches!(up, Up::Pong));
        link.up.push_back(Up::Close);
        link.down.clear();
        link.is_dead = true;
        self.server.witness.dies(session, self.now_ms);
    }

    fn half_open(&mut self, who: usize) {
        let session = self.clients[who].link;
        let Some((session, link)) = session.and_then(|session| Some((session, self.links.get_mut(&session)?))) else {
            return;
        };
        (link.up, link.down, link.is_dead) = (VecDeque::new(), VecDeque::new(), true);
        self.server.witness.dies(session, self.now_ms);
    }

    fn connect(&mut self, who: usize) {
        self.cut(who);
        self.sessions += 1;
        let (up, down) = (VecDeque::from([Up::Hello(who)]), VecDeque::new());
        self.links.insert(self.sessions, Link { client: who, up, down, is_dead: false });
        self.clients[who].connect(Some(self.sessions));
    }

    fn kill(&mut self, kept: bool) -> Check {
        self.server.kill(kept)?;
        self.links.clear();
        self.clients.iter_mut().for_each(|client| client.connect(None));
        Ok(())
    }

    fn is_linked(&self, client: &Client) -> bool {
        let session = client.link.filter(|session| client.is_welcome && self.server.knows(*session));
        session.and_then(|session| self.links.get(&session)).is_some_and(|link| !link.is_dead)
    }

    /// Nothing is lost any more, and nobody does anything.
    fn calm(&mut self) -> Check {
        for round in 0..CALM_ROUNDS {
            let unlinked: Vec<usize> =
                (0..self.clients.len()).filter(|who| !self.is_linked(&self.clients[*who])).collect();
            unlinked.into_iter().for_each(|who| self.connect(who));
            self.flush_all()?;
            self.wait(1_000, true)?;
            self.flush_all()?;
            if round >= PING_ROUNDS && self.is_calm() {
                break;
            }
        }
        Ok(())
    }

    fn is_calm(&self) -> bool {
        let revision = self.server.room.revision();
        self.server.is_idle()
            && self.clients.iter().all(|client| client.pending.is_empty() && client.revision == revision)
    }

    /// Everybody sees the same, and everything was answered as it is.
    fn check_calm(&self) -> Check {
        let disk = &self.server.disk;
        if *self.server.room.behaviour() != disk.behaviour || disk.replay(start()) != disk.behaviour {
            return Err("a cold reload is something else".to_owned());
        }
        for client in &self.clients {
            if let Some(wish) = client.pending.front() {
                return Err(format!("{} is never answered", wish.op()));
            }
            if client.seen != disk.behaviour || client.revision != disk.revision() {
                return Err(format!("{} sees something else", client.id));
            }
            let wrong = client.answers.iter().find(|(op, made)| disk.ops.contains_key(op) != **made);
            if let Some((op, made)) = wrong {
                return Err(format!("{op} was answered as made: {made}, and the store says otherwise"));
            }
        }
        let answered = self.clients.iter().map(|client| client.answers.values().filter(|made| **made).count());
        if answered.sum::<usize>() != disk.log.len() { Err("something made is not answered".into()) } else { Ok(()) }
    }

    /// Undoing everything leaves nothing: from the last change back, and as far as each takes back their own.
    fn check_undone(&mut self) -> Check {
        let disk = &self.server.disk;
        let mut room = self.server.room.clone();
        for Committed { revision, change } in disk.log.iter().rev() {
            make(&mut room, change.swapped(id(&format!("back{revision}")), ""))?;
        }
        if *room.behaviour() != start() {
            return Err("undoing everything leaves something".to_owned());
        }
        let (mut room, mut log, mut ops) = (self.server.room.clone(), UndoLog::of(&disk.log), disk.ops.clone());
        loop {
            let last = self.clients.iter().filter_map(|client| Some((ops.get(&log.last(&client.id)?.op)?, &client.id)));
            let Some((_, by)) = last.max() else { break };
            let op = id(&format!("undo{}", room.revision()));
            let change = log.undo(by, op.clone(), &room).map_err(|no| format!("the newest is not undone: {no}"))?;
            // Something that it needs was taken back by somebody else before.
            let Ok(committed) = make(&mut room, change) else {
                self.server.counts.insert("undo needs what is gone", 1);
                return Ok(());
            };
            ops.insert(op, committed.revision);
            log.take(&committed);
        }
        let is_nothing = *room.behaviour() == start();
        if is_nothing { Ok(()) } else { Err("when all took back their own, something is left".to_owned()) }
    }
}

fn make(room: &mut Room, change: Change) -> Result<Committed, String> {
    match room.propose(0, change, &AnyKnowledge) {
        Decision::Save(committed) => {
            room.commit(&committed);
            Ok(committed)
        }
        other => Err(format!("undoing is answered {other:?}")),
    }
}
