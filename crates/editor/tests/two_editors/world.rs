//! People, a server, and links between them that are slow, break, and lose what is on its way.

use crate::dice::Dice;
use crate::page::{Check, Entry, Fate, Page, text_of};
use crate::server::{Server, StoreAnswer};
use crate::sketch::sketch;
use behaviour::labels::bare;
use behaviour::{Change, Kind, Params, Place, RecordId, UndoLog};
use editor::graph::{StepDirection, wire_ends};
use editor::{Editor, Selected, WriteRight};
use protocol::{AnyRequest, Event, Message};
use std::collections::{BTreeMap, BTreeSet};

/// The notes that people write.
const NOTES: u64 = 3;
const STEPS: u64 = 90;
const WAYS: [StepDirection; 4] = [StepDirection::Down, StepDirection::Up, StepDirection::Left, StepDirection::Right];

/// All that is on its way between a page and the server.
#[derive(Default)]
struct Wire {
    up: Vec<(u64, u32, AnyRequest)>,
    down: Vec<(u64, Message)>,
}

pub(crate) struct World {
    dice: Dice,
    now_ms: u64,
    server: Server,
    pages: Vec<Page>,
    wires: BTreeMap<u64, (usize, Wire)>,
    sessions: u64,
    /// The times at which each page makes its link anew.
    connects: BTreeMap<usize, u64>,
    store_ms: Option<u64>,
    ping_ms: u64,
    /// The number of times that each thing happened, to know that it does.
    pub(crate) counts: BTreeMap<&'static str, usize>,
}

impl World {
    pub(crate) fn new(seed: u64) -> Self {
        let mut dice = Dice(seed.wrapping_mul(0x51_7C_C1_B7));
        let server = Server::new(sketch());
        let many = 2 + usize::from(dice.roll(4) == 0);
        let pages: Vec<Page> = (0..many).map(|who| Page::new(who, &server.behaviour)).collect();
        let connects = (0..many).map(|who| (who, dice.roll(500))).collect();
        Self {
            dice,
            now_ms: 0,
            server,
            pages,
            wires: BTreeMap::new(),
            sessions: 0,
            connects,
            store_ms: None,
            ping_ms: 500,
            counts: BTreeMap::new(),
        }
    }

    fn count(&mut self, what: &'static str) {
        *self.counts.entry(what).or_default() += 1;
    }

    /// People do things and links break, then all is well again, and everything is compared.
    pub(crate) fn play(&mut self) -> Check {
        for _ in 0..STEPS {
            self.act()?;
            let ms = [0, 5, 40, 200, 1_500, 6_000][self.dice.roll(6) as usize];
            self.pass(ms)?;
        }
        self.heal()?;
        self.compare()
    }

    fn act(&mut self) -> Check {
        let who = self.dice.roll(self.pages.len() as u64) as usize;
        let number = self.dice.roll(NOTES);
        let page = &mut self.pages[who];
        match self.dice.roll(48) {
            0..=11 => page.write(number)?,
            12 => page.remove(number)?,
            13 | 14 => page.put(number, self.now_ms)?,
            15..=17 => page.step(false)?,
            18 | 19 => page.step(true)?,
            20..=22 => page.begin_typing(number)?,
            23..=27 => {
                let there = self.server.room.behaviour().clone();
                page.type_on(&there)?;
            }
            28 => page.end_typing()?,
            29 | 30 => page.decide(number > 0)?,
            31 => page.input([Editor::ask_for, Editor::take_over][(number % 2) as usize])?,
            32 => page.input(|editor| editor.hand_over(number > 0))?,
            33 => page.input(|editor| editor.listen(2_000.0))?,
            34 | 35 => self.cut(who)?,
            36 => self.reload(who)?,
            37 => {
                let is_away = self.dice.roll(2) == 0;
                self.server.set_away(is_away);
                self.count("store away or back");
            }
            38 if self.dice.roll(3) == 0 => self.restart()?,
            _ => self.gesture(who)?,
        }
        self.send();
        Ok(())
    }

    /// Somebody does something on the graph: chooses, walks, groups, folds, moves, leads elsewhere or removes.
    fn gesture(&mut self, who: usize) -> Check {
        let page = &mut self.pages[who];
        let parts: Vec<Selected> = page.editor.shown_behaviour().records.keys().filter_map(part).collect();
        let Some(part) = parts.get(self.dice.roll(parts.len().max(1) as u64) as usize).cloned() else { return Ok(()) };
        let seen = page.editor.seen_as(part.clone());
        let (far, way) = (self.dice.roll(900) as f64, self.dice.roll(4));
        let group = page.editor.shown_behaviour().groups().next().map(|(id, _)| id.clone());
        let what = self.dice.roll(14);
        match (what, group) {
            (0 | 1, _) => page.input(|editor| editor.select(Some(part)))?,
            (2 | 3, _) => page.input(|editor| editor.keyboard_at(Some(seen)))?,
            (4, _) => page.input(|editor| editor.choose_too(seen))?,
            (5, _) => drop(page.input(|editor| editor.step(Some(seen), WAYS[way as usize], far > 500.0))?),
            (6, _) => page.input(|editor| editor.move_to(&[(part.id().clone(), Place { x: far, y: far })]))?,
            (7, _) => page.gesture(|editor, op| editor.make_group(op, &editor.chosen(), "Group"))?,
            (8 | 9, Some(group)) => page.gesture(|editor, op| editor.fold(op, &group, far > 300.0))?,
            (10, _) => page.gesture(|editor, op| editor.add_sensor(op, ("HeadTouch", "Touch"), Params::new(), None))?,
            (11, _) if !matches!(part, Selected::Note(_)) => page.gesture(|editor, op| editor.remove(op, &part))?,
            (12, _) => drop(page.input(Editor::escape)?),
            (13, _) => page.gesture(|editor, op| {
                let ends = wire_ends(&editor.shown_behaviour(), part.id());
                if let Some((end, _)) = ends.get(way as usize) {
                    editor.wire(op, part.id(), end);
                }
            })?,
            (_, _) => {}
        }
        self.count("gesture");
        Ok(())
    }

    /// Puts what was said onto the wires.
    fn send(&mut self) {
        for page in &mut self.pages {
            let Some(session) = page.link.session else { continue };
            let Some((_, wire)) = self.wires.get_mut(&session) else { continue };
            for (ask, request) in page.link.outbox.drain(..) {
                let last = wire.up.last().map_or(0, |(at, ..)| *at);
                wire.up.push(((self.now_ms + self.dice.roll(90)).max(last), ask, request));
            }
        }
        for (session, message) in std::mem::take(&mut self.server.said) {
            let Some((_, wire)) = self.wires.get_mut(&session) else { continue };
            // A change may be missed; a later one, or the revision of a ping, tells that it was.
            if matches!(message, Message::Event(Event::Accepted { .. })) && self.dice.roll(12) == 0 {
                continue;
            }
            // News of who is editing travels beside the rest: it may come before or after that, but in its own order.
            let is_beside = |message: &Message| matches!(message, Message::Event(Event::Locks { .. }));
            let same = wire.down.iter().filter(|(_, other)| is_beside(other) == is_beside(&message));
            let last = same.map(|(at, ..)| *at).max().unwrap_or(0);
            wire.down.push(((self.now_ms + self.dice.roll(90)).max(last), message));
        }
        if self.store_ms.is_none() && !self.server.is_idle() {
            self.store_ms = Some(self.now_ms + self.dice.roll(60));
        }
    }

    /// Time passes.
    fn pass(&mut self, ms: u64) -> Check {
        let until = self.now_ms + ms;
        loop {
            self.send();
            let ups =
                self.wires.iter().filter_map(|(session, (_, wire))| Some((wire.up.first()?.0, What::Up(*session))));
            let downs = self.wires.iter().filter_map(|(session, (_, wire))| {
                Some((wire.down.iter().map(|(at, ..)| *at).min()?, What::Down(*session)))
            });
            let connects = self.connects.iter().map(|(who, at)| (*at, What::Connect(*who)));
            let timers =
                self.pages.iter().flat_map(|page| page.timers.iter().map(move |(at, _)| (*at, What::Timer(page.who))));
            let others = self.store_ms.map(|at| (at, What::Store)).into_iter();
            let others = others.chain([(self.ping_ms, What::Ping)]);
            let others = others.chain(self.server.locks.due().map(|at| (at, What::Locks)));
            let all = ups.chain(downs).chain(connects).chain(timers).chain(others);
            let Some((at, what)) = all.min_by_key(|(at, _)| *at).filter(|(at, _)| *at <= until) else { break };
            self.at(at.max(self.now_ms));
            self.happen(what)?;
        }
        self.at(until);
        Ok(())
    }

    fn at(&mut self, now_ms: u64) {
        self.now_ms = now_ms;
        self.server.tick(now_ms);
        self.pages.iter_mut().for_each(|page| page.now_ms = now_ms);
    }

    fn happen(&mut self, what: What) -> Check {
        match what {
            What::Up(session) => {
                let Some((_, wire)) = self.wires.get_mut(&session) else { return Ok(()) };
                let (_, ask, request) = wire.up.remove(0);
                self.server.hear(session, ask, request);
            }
            What::Down(session) => {
                let Some((who, wire)) = self.wires.get_mut(&session) else { return Ok(()) };
                let due = wire.down.iter().enumerate().min_by_key(|(_, (at, ..))| *at).map_or(0, |(nth, _)| nth);
                let (_, message) = wire.down.remove(due);
                self.pages[*who].hear(message)?;
            }
            What::Connect(who) => {
                self.connects.remove(&who);
                self.sessions += 1;
                self.wires.insert(self.sessions, (who, Wire::default()));
                self.server.connect(self.sessions, who);
                self.pages[who].greeted(self.sessions)?;
            }
            What::Timer(who) => {
                let page = &mut self.pages[who];
                let due = page.timers.iter().enumerate().min_by_key(|(_, (at, _))| *at).map_or(0, |(nth, _)| nth);
                let (_, wake) = page.timers.remove(due);
                page.input(|editor| editor.wake(wake))?;
            }
            What::Store => {
                self.store_ms = None;
                let how = match self.dice.roll(14) {
                    0 => StoreAnswer::Failed,
                    1 => StoreAnswer::SavedUnheard,
                    _ => StoreAnswer::Saved,
                };
                self.server.saved(how);
            }
            What::Ping => {
                self.ping_ms += 500;
                self.server.ping();
                for page in &mut self.pages {
                    page.input(Editor::tick)?;
                }
            }
            What::Locks => {}
        }
        Ok(())
    }

    /// A link breaks: some of what is on its way up arrives yet, all that is on its way down is lost.
    fn cut(&mut self, who: usize) -> Check {
        if self.pages[who].link.session.is_none() {
            return Ok(());
        }
        self.count("cut");
        self.break_link(who);
        self.pages[who].lost()?;
        self.connects.insert(who, self.now_ms + self.dice.roll(4_000));
        Ok(())
    }

    fn break_link(&mut self, who: usize) {
        let Some(session) = self.pages[who].link.session else { return };
        if let Some((_, wire)) = self.wires.remove(&session) {
            let arrives = self.dice.roll(wire.up.len() as u64 + 1) as usize;
            wire.up.into_iter().take(arrives).for_each(|(_, ask, request)| self.server.hear(session, ask, request));
        }
        if self.dice.roll(2) == 0 {
            self.server.leave(session);
        }
    }

    fn reload(&mut self, who: usize) -> Check {
        self.count("reload");
        if !self.pages[who].editor.queue().late().is_empty() {
            self.count("reload while it is found out who was first");
        }
        self.break_link(who);
        self.pages[who].reload()?;
        self.connects.insert(who, self.now_ms + self.dice.roll(500));
        Ok(())
    }

    fn restart(&mut self) -> Check {
        self.count("restart");
        let kept = self.dice.roll(2) == 0;
        self.server.restart(kept);
        self.store_ms = None;
        self.wires.clear();
        for who in 0..self.pages.len() {
            if self.pages[who].link.session.is_some() {
                self.pages[who].lost()?;
                self.connects.insert(who, self.now_ms + self.dice.roll(2_000));
            }
        }
        Ok(())
    }

    /// The store is back, links stay, and nobody does anything more.
    fn heal(&mut self) -> Check {
        self.server.set_away(false);
        for _ in 0..40 {
            self.pass(3_000)?;
            if self.is_quiet() {
                break;
            }
        }
        self.locks_agree()?;
        for page in &mut self.pages {
            page.end_typing()?;
        }
        for _ in 0..60 {
            self.pass(3_000)?;
            let waits = |page: &Page| page.editor.conflicts.iter().any(|one| one.locked);
            if self.is_quiet() && !self.pages.iter().any(waits) {
                break;
            }
        }
        self.pass(3_000)
    }

    /// True if everybody is there, nothing waits, and all that was said is heard.
    fn is_quiet(&self) -> bool {
        let is_done = |page: &Page| {
            page.link.session.is_some() && page.link.is_answered() && page.editor.queue().to_keep().is_none()
        };
        let is_ping = |(_, message): &(u64, Message)| matches!(message, Message::Event(Event::Ping { .. }));
        let is_heard = |(_, wire): &(usize, Wire)| wire.up.is_empty() && wire.down.iter().all(is_ping);
        self.server.is_idle() && self.pages.iter().all(is_done) && self.wires.values().all(is_heard)
    }

    /// Compares locks: who thinks that they hold one does, and nobody waits for one for ever.
    fn locks_agree(&self) -> Check {
        for page in &self.pages {
            let Some(editing) = page.editor.editing.as_ref() else { continue };
            let is_there = self.server.room.behaviour().records.contains_key(&editing.record);
            match &editing.writing {
                WriteRight::Own(own) if !self.server.holds(page.who, own.token) => {
                    return Err(format!("{} has no lock but writes as if: {editing:?}", page.who));
                }
                WriteRight::Opening => return Err(format!("{} waits for a lock for ever", page.who)),
                WriteRight::Free if is_there && !page.is_not_there => {
                    return Err(format!("{} edits without a lock", page.who));
                }
                WriteRight::Own(_) | WriteRight::Free | WriteRight::No(_) => {}
            }
        }
        Ok(())
    }

    fn compare(&mut self) -> Check {
        self.log_is_whole()?;
        let (room, log) = (&self.server.room, &self.server.log);
        let undo = UndoLog::of(log);
        let mut fates = Vec::new();
        for page in &self.pages {
            let editor = &page.editor;
            if editor.queue().to_keep().is_some() {
                let waiting: Vec<_> = editor.queue().all().collect();
                return Err(format!(
                    "{} still waits ({:?}, {:?}): {waiting:?}",
                    page.who,
                    editor.can_save(),
                    editor.editing.as_ref()
                ));
            }
            if editor.confirmed() != room.behaviour() || *editor.revision != room.revision() {
                return Err(format!("{} shows another program than there is", page.who));
            }
            if editor.conflicts.iter().any(|one| one.locked || one.retry.is_some()) {
                return Err(format!("{} has a change that is proposed to nobody: {:?}", page.who, *editor.conflicts));
            }
            let last = undo.last(&Server::client(page.who)).map(|change| bare(&change.label));
            if *editor.undoable != last {
                return Err(format!("{} would undo {:?} in place of {last:?}", page.who, *editor.undoable));
            }
            let kept = page.kept_texts();
            for (op, entry) in &page.ledger {
                fates.push(entry.fate);
                let named = log.iter().any(|one| one.change.op == *op);
                let written = log.iter().any(|one| writes(&one.change, &entry.text));
                let is_right = match entry.fate {
                    Fate::Waits => false,
                    Fate::Saved => named,
                    Fate::Refused | Fate::Withdrawn => !named,
                    // A later change of the same author, of the same record, took its place.
                    Fate::Kept => written || kept.contains(&entry.text) || is_replaced(page, entry),
                    Fate::Dropped => true,
                };
                if !is_right {
                    return Err(format!("{} of {}: {entry:?}, in the log: {named}", op, page.who));
                }
            }
        }
        let led: usize = self.pages.iter().map(|page| page.focused.len()).sum();
        *self.counts.entry("keyboard led on").or_default() += led;
        fates.into_iter().for_each(|fate| {
            self.count(match fate {
                Fate::Waits => "waits",
                Fate::Saved => "saved",
                Fate::Refused => "refused",
                Fate::Kept => "kept",
                Fate::Withdrawn => "withdrawn",
                Fate::Dropped => "dropped",
            });
        });
        Ok(())
    }

    /// No change was made twice, under whatever name, and everybody took back only their own.
    fn log_is_whole(&mut self) -> Check {
        let (mut ops, mut texts) = (BTreeSet::new(), BTreeSet::new());
        let mut undone = 0;
        for (nth, one) in self.server.log.iter().enumerate() {
            let change = &one.change;
            if one.revision != nth as u64 + 1 || !ops.insert(&change.op) {
                return Err(format!("{} was made twice", change.op));
            }
            if let Some(of) = &change.undoes {
                undone += 1;
                let undone = self.server.log.iter().find(|other| other.change.op == *of);
                if undone.is_none_or(|undone| undone.change.by != change.by) {
                    return Err(format!("{:?} took back what was not theirs", change.by));
                }
                continue;
            }
            let notes = change.edits.iter().filter(|edit| edit.id.kind == Kind::Note);
            for edit in notes.filter(|edit| edit.before != edit.after) {
                if let Some(text) = text_of(edit.after.as_ref())
                    && !texts.insert(text.to_owned())
                {
                    return Err(format!("{text} was written twice"));
                }
            }
        }
        *self.counts.entry("taken back").or_default() += undone;
        Ok(())
    }
}

enum What {
    Up(u64),
    Down(u64),
    Connect(usize),
    Timer(usize),
    Store,
    Ping,
    Locks,
}

fn part(key: &RecordId) -> Option<Selected> {
    match key.kind {
        Kind::Stream => Some(Selected::Stream(key.id.clone())),
        Kind::Connector => Some(Selected::Connector(key.id.clone())),
        Kind::Note => Some(Selected::Note(key.id.clone())),
        Kind::Group => Some(Selected::Group(key.id.clone())),
        Kind::Place | Kind::Settings | Kind::Helper | Kind::Pad => None,
    }
}

fn writes(change: &Change, text: &str) -> bool {
    change.edits.iter().any(|edit| text_of(edit.after.as_ref()) == Some(text))
}

/// True if its author wrote the same record anew after it, or wanted once more what they had written there before.
fn is_replaced(page: &Page, entry: &Entry) -> bool {
    let number = |entry: &Entry| entry.text.rsplit(' ').next().and_then(|number| number.parse::<u64>().ok());
    let is_later = |other: &Entry| number(other) > number(entry) || other.wanted > entry.wanted;
    page.ledger.values().any(|other| other.record == entry.record && is_later(other))
}
