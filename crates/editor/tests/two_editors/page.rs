//! One person's page without a page: an editor, what it wants done, and a ledger of what became of every edit.

use crate::link::PageLink;
use crate::server::{Server, id, note};
use behaviour::{Behaviour, Change, Connector, Id, Note, Place, Procedure, Record, RecordId, Refusal};
use editor::layout::DrawnSizes;
use editor::{
    AlarmPurpose, Announcement, Editor, Effect, FocusTarget, KeyboardStay, Link, Me, NoAnswer, Now, Purpose, Selected,
    WriteRight, build,
};
use protocol::{AnyAnswer, Event, Message, Refused, answer};
use std::collections::{BTreeMap, BTreeSet};

pub(crate) type Check = Result<(), String>;

/// The fate of an edit, as its author knows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fate {
    Waits,
    Saved,
    Refused,
    /// It waits for its author's decision.
    Kept,
    /// The author took it back before it was sent.
    Withdrawn,
    /// The author let it go.
    Dropped,
}

/// An edit. Its text is nobody else's, so that it is found wherever it goes.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) record: RecordId,
    pub(crate) text: String,
    pub(crate) fate: Fate,
    /// The time at which its author wanted it last: made it, put it on top, or did it again.
    pub(crate) wanted: u64,
    /// True if nobody else could touch the record when it was made.
    is_safe: bool,
}

pub(crate) struct Page {
    pub(crate) who: usize,
    pub(crate) editor: Editor,
    lives: u32,
    pub(crate) link: PageLink,
    pub(crate) timers: Vec<(u64, AlarmPurpose)>,
    /// The texts that are kept over a reload: of the queue, and of refused changes.
    kept: [String; 2],
    pub(crate) stay: Option<(KeyboardStay, RecordId)>,
    pub(crate) ledger: BTreeMap<Id, Entry>,
    pub(crate) now_ms: u64,
    was_greeted: bool,
    /// The server said that what is edited here is not there, so that it gave no lock.
    pub(crate) is_not_there: bool,
    texts: u64,
    /// The number of times that something was wanted.
    wants: u64,
    pub(crate) said: Vec<Announcement>,
    /// The places to which the keyboard was led.
    pub(crate) focused: Vec<FocusTarget>,
    /// The records that were drawn anew.
    pub(crate) redrawn: Vec<RecordId>,
    gestures: u64,
    /// The reason why this person may not edit, if so.
    pub(crate) refused: Option<Refused>,
    /// The answers to their gestures.
    pub(crate) answers: Vec<Result<(), Refused>>,
    /// The refusals of other changes, such as undo.
    pub(crate) refusals: Vec<Refused>,
    /// The texts that its author decides about in this input.
    decided: BTreeSet<String>,
}

/// About the sizes of a page.
pub(crate) const SIZES: DrawnSizes = DrawnSizes {
    stream: |stream| (stream.name.chars().count() as f64 * 9.0 + 40.0).clamp(96.0, 260.0),
    chip: |connector| (connector.operation.word().len() as f64 * 8.0 + 52.0).clamp(72.0, 260.0),
    note: |text| (248.0, 38.0 + text.lines().count() as f64 * 20.0),
};

/// A name of a stream that follows a test with a number, as pages have them.
fn followed(behaviour: &Behaviour, name: &str, seen: &Connector, edited: &Connector) -> Option<String> {
    let called = |connector: &Connector| match connector.operation.procedure() {
        Some(Procedure::Body { body, .. }) => Some(format!("Where {body}")),
        _ => None,
    };
    let is_given = called(seen).as_deref() == Some(name) && behaviour.stream(&seen.output).is_some();
    called(edited).filter(|_| is_given)
}

fn editor_of(who: usize, life: u32) -> Editor {
    let mut made = 0;
    let new_id = move || {
        made += 1;
        id(&format!("op-{who}-{life}-{made}"))
    };
    Editor::new(new_id, followed, |_| behaviour::Pad::default(), SIZES)
}

pub(crate) fn text_of(record: Option<&Record>) -> Option<&str> {
    record.and_then(editor::wording)
}

impl Page {
    pub(crate) fn new(who: usize, program: &Id) -> Self {
        let mut page = Self {
            who,
            editor: editor_of(who, 0),
            lives: 0,
            link: PageLink::default(),
            timers: Vec::new(),
            kept: [const { String::new() }; 2],
            stay: None,
            ledger: BTreeMap::new(),
            now_ms: 0,
            was_greeted: false,
            is_not_there: false,
            texts: 0,
            wants: 0,
            said: Vec::new(),
            focused: Vec::new(),
            redrawn: Vec::new(),
            gestures: 0,
            refused: None,
            answers: Vec::new(),
            refusals: Vec::new(),
            decided: BTreeSet::new(),
        };
        page.editor.begin_with(Some(program.clone()));
        page
    }

    /// One input, and all that follows of it.
    pub(crate) fn input<T>(&mut self, act: impl FnOnce(&mut Editor) -> T) -> Result<T, String> {
        let now = Now { clock_ms: self.now_ms as f64, today_ms: 1e12 + self.now_ms as f64 };
        let client = self.was_greeted.then(|| Server::client(self.who));
        let name = if self.was_greeted { Server::name(self.who) } else { String::new() };
        let done = act(self.editor.at(now, Me { client, name, refused: self.refused.clone() }));
        let news = self.editor.take_news();
        self.redrawn.extend(news.touched);
        for effect in self.editor.take_effects() {
            self.perform(effect)?;
        }
        self.nothing_gone_is_chosen()?;
        self.forget_safety();
        Ok(done)
    }

    /// Nothing that is gone is chosen, and the keyboard is in nothing that is gone or folded away.
    fn nothing_gone_is_chosen(&self) -> Check {
        let is_there = |one: &Selected| self.editor.shown(&one.record()).is_some();
        if let Some(gone) = self.editor.chosen().iter().find(|one| !is_there(one)) {
            return Err(format!("{gone:?} is chosen and gone"));
        }
        match self.editor.keyboard() {
            Some(part) if !is_there(part) => Err(format!("the keyboard is in {part:?}, which is gone")),
            Some(part) if self.editor.folded_away(part).is_some() => {
                Err(format!("the keyboard is in the folded {part:?}"))
            }
            Some(_) | None => Ok(()),
        }
    }

    /// A name for the change of a gesture.
    pub(crate) fn op(&mut self) -> Id {
        self.gestures += 1;
        id(&format!("gesture-{}-{}-{}", self.who, self.lives, self.gestures))
    }

    /// Does a gesture under a new name.
    pub(crate) fn gesture<T>(&mut self, act: impl FnOnce(&mut Editor, Id) -> T) -> Result<T, String> {
        let op = self.op();
        self.input(|editor| act(editor, op))
    }

    fn perform(&mut self, effect: Effect) -> Check {
        match effect {
            Effect::Send(request, purpose) => {
                self.link.send(request, purpose);
                for purpose in self.link.unsent() {
                    self.input(|editor| editor.hear_answer(purpose, Err(NoAnswer::Unreachable)))?;
                }
            }
            Effect::Focus(target) => self.focused.push(target),
            Effect::After(ms, wake) => self.timers.push((self.now_ms + ms as u64, wake)),
            Effect::KeepQueue => {
                let kept = self.editor.queue().to_keep();
                self.kept[0] = kept.map_or_else(String::new, |kept| serde_json::to_string(&kept).expect("it is text"));
            }
            Effect::KeepConflicts => self.kept[1] = serde_json::to_string(&*self.editor.conflicts).expect("it is text"),
            Effect::Say(announcement) => {
                if matches!(announcement, Announcement::Refused(_)) {
                    self.was_refused();
                }
                self.said.push(announcement);
            }
            Effect::Answered(op, answer) => return self.answered(&op, answer),
            Effect::Renamed { was, now } => {
                if let Some(entry) = self.ledger.remove(&was) {
                    self.ledger.insert(now, entry);
                }
            }
            Effect::Unanswered(op) => {
                if let Some(entry) = self.ledger.get_mut(&op) {
                    entry.fate = Fate::Kept;
                }
            }
            Effect::ForgetDraft(_)
            | Effect::LastChange(..)
            | Effect::Address(_)
            | Effect::Decide(_)
            | Effect::Opened { .. }
            | Effect::Made(_)
            | Effect::Happened(_) => {}
        }
        Ok(())
    }

    fn answered(&mut self, op: &Id, answer: Result<(), Refused>) -> Check {
        if op.as_str().starts_with("gesture-") {
            self.answers.push(answer.clone());
        } else if let Err(no) = &answer {
            self.refusals.push(no.clone());
        }
        let Some(entry) = self.ledger.get_mut(op) else { return Ok(()) };
        if entry.is_safe && matches!(answer, Err(Refused::Change(Refusal::Stale(_) | Refusal::Locked { .. }))) {
            return Err(format!("{entry:?} was typed under a lock and is refused: {answer:?}"));
        }
        if entry.fate == Fate::Waits {
            entry.fate = if answer.is_ok() { Fate::Saved } else { Fate::Refused };
        }
        Ok(())
    }

    /// A refusal was told: what was kept, and is not any more, is refused.
    fn was_refused(&mut self) {
        let kept = self.kept_texts();
        let gone = self.ledger.values_mut().filter(|entry| entry.fate == Fate::Kept && !kept.contains(&entry.text));
        gone.for_each(|entry| entry.fate = Fate::Refused);
    }

    pub(crate) fn kept_texts(&self) -> BTreeSet<String> {
        let edits = self.editor.conflicts.iter().flat_map(|conflict| &conflict.mine.edits);
        edits.filter_map(|edit| text_of(edit.after.as_ref())).map(str::to_owned).collect()
    }

    /// Only as long as the lock is there is what was typed under it safe.
    fn forget_safety(&mut self) {
        let has_lock = matches!(self.editor.editing.as_ref().map(|now| &now.writing), Some(WriteRight::Own(_)));
        if !has_lock || self.link.session.is_none() {
            self.ledger.values_mut().for_each(|entry| entry.is_safe = false);
        }
    }

    pub(crate) fn hear(&mut self, message: Message) -> Check {
        self.input(|editor| editor.listen(0.0))?;
        match message {
            Message::Answer { ask, answer } => self.hear_answer(ask, Ok(answer)),
            Message::No { ask: Some(ask), no } => self.hear_answer(ask, Err(NoAnswer::Refused(no))),
            Message::Event(event) => self.hear_event(event),
            Message::No { ask: None, .. } | Message::Records { .. } => Ok(()),
        }
    }

    fn hear_answer(&mut self, ask: u32, answer: Result<AnyAnswer, NoAnswer>) -> Check {
        let Some(purpose) = self.link.answered(ask) else { return Ok(()) };
        if matches!(purpose, Purpose::Lock(_)) {
            self.is_not_there = answer == Err(NoAnswer::Refused(Refused::NothingThere));
        }
        if let Ok(AnyAnswer::Opened(answer::Opened { records, .. })) = &answer
            && let Some(edited) = self.editor.editing.as_ref().map(|now| &now.record)
        {
            self.is_not_there |= !records.records.contains_key(edited);
        }
        self.input(|editor| editor.hear_answer(purpose, answer))
    }

    /// As `frontend/src/desk/hear.rs` does.
    fn hear_event(&mut self, event: Event) -> Check {
        match event {
            Event::Accepted { behaviour, accepted } => self.input(|editor| editor.hear_accepted(&behaviour, &accepted)),
            Event::People { behaviour, people } => self.input(|editor| editor.hear_people(&behaviour, people)),
            Event::Locks { behaviour, locks } => self.input(|editor| editor.hear_locks(&behaviour, locks)),
            Event::LockReturned { grant } => self.input(|editor| editor.hear_grant(&grant)),
            Event::LockNews { behaviour, now_ms, event } => {
                self.input(|editor| editor.hear_lock_event(&behaviour, now_ms, &event))
            }
            Event::Store { away } => self.input(|editor| editor.hear_store(away)),
            Event::Ping { behaviour, .. } => self.input(|editor| editor.hear_ping(behaviour)),
            _ => Ok(()),
        }
    }

    /// The server greeted back.
    pub(crate) fn greeted(&mut self, session: u64) -> Check {
        self.link.session = Some(session);
        self.input(Editor::link_up)?;
        self.input(|editor| editor.listen(0.0))?;
        self.was_greeted = true;
        self.input(Editor::reopen)
    }

    /// The link broke: whoever waits for an answer is told that there is none.
    pub(crate) fn lost(&mut self) -> Check {
        let unanswered = self.link.lose();
        self.input(Editor::link_lost)?;
        for purpose in unanswered {
            self.input(|editor| editor.hear_answer(purpose, Err(NoAnswer::Unreachable)))?;
        }
        Ok(())
    }

    /// The page is loaded again, and hears nothing more before that: only what was kept is there.
    pub(crate) fn reload(&mut self) -> Check {
        self.lives += 1;
        self.link.lose();
        let wanted = self.editor.wanted().cloned();
        self.editor = editor_of(self.who, self.lives);
        self.was_greeted = false;
        (self.timers, self.stay) = (Vec::new(), None);
        let [queue, conflicts] = self.kept.clone();
        if let Ok(queue) = serde_json::from_str(&queue) {
            self.input(|editor| editor.restore_queue(queue))?;
        }
        if let Ok(conflicts) = serde_json::from_str(&conflicts) {
            self.input(|editor| editor.restore_conflicts(conflicts))?;
        }
        self.input(|editor| editor.begin_with(wanted))
    }

    fn new_text(&mut self) -> String {
        self.texts += 1;
        format!("{} wrote {}", Server::name(self.who), self.texts)
    }

    fn propose(&mut self, change: Change, entry: Option<(RecordId, String, bool)>) -> Check {
        if let Some((record, text, is_safe)) = entry {
            self.wants += 1;
            let wanted = self.wants;
            self.ledger.insert(change.op.clone(), Entry { record, text, fate: Fate::Waits, wanted, is_safe });
        }
        self.input(|editor| editor.propose(change))
    }

    fn written(text: &str) -> Record {
        Record::Note(Note::new(text.to_owned()))
    }

    /// Writes a note, new or not.
    pub(crate) fn write(&mut self, number: u64) -> Check {
        let (record, text, now) = (note(number), self.new_text(), self.editor.behaviour());
        let change = self.input(|editor| editor.change(format!("Edit {text}")))?;
        let change = change.put(&now, record.clone(), Self::written(&text));
        self.propose(change, Some((record, text, false)))
    }

    /// Removes a note.
    pub(crate) fn remove(&mut self, number: u64) -> Check {
        let now = self.editor.behaviour();
        let change = self.input(|editor| editor.change("Remove note"))?.take(&now, note(number));
        self.propose(change, None)
    }

    /// Moves a note.
    pub(crate) fn put(&mut self, number: u64, x: u64) -> Check {
        let now = self.editor.behaviour();
        let place = RecordId::new(behaviour::Kind::Place, &note(number).id);
        let change = self.input(|editor| editor.change("Move"))?;
        self.propose(change.put(&now, place, Record::Place(Place { x: x as f64, y: 0.0 })), None)
    }

    pub(crate) fn begin_typing(&mut self, number: u64) -> Check {
        self.end_typing()?;
        let record = note(number);
        let stay = self.input(|editor| editor.begin_typing(&record))?;
        self.stay = stay.map(|stay| (stay, record));
        Ok(())
    }

    pub(crate) fn end_typing(&mut self) -> Check {
        match self.stay.take() {
            Some((stay, _)) => self.input(|editor| editor.end_typing(&stay)),
            None => Ok(()),
        }
    }

    /// Saves what is typed, as a change of what was seen when the keyboard came. Returns what that was.
    pub(crate) fn type_on(&mut self, there: &Behaviour) -> Check {
        let Some((stay, record)) = self.stay.clone() else { return Ok(()) };
        self.input(Editor::typing)?;
        let Some(seen) = self.editor.seen(&stay) else { return Ok(()) };
        let has_lock = matches!(self.editor.editing.as_ref().map(|now| &now.writing), Some(WriteRight::Own(_)));
        let is_first = self.editor.queue().touched(&stay.behaviour).iter().all(|waits| *waits != record);
        let is_safe = has_lock && is_first && there.records.get(&record) == Some(&seen);
        let (text, now) = (self.new_text(), self.editor.behaviour());
        let change = self.input(|editor| editor.change(format!("Edit {text}")))?;
        let change = change.put(&now, record.clone(), Self::written(&text));
        let change = build::as_seen_at(change, &record, seen);
        self.propose(change, Some((record, text, is_safe)))
    }

    pub(crate) fn step(&mut self, again: bool) -> Check {
        let waiting = |page: &Self| -> BTreeMap<Id, BTreeSet<String>> {
            let of = |change: &Change| {
                let texts = change.edits.iter().filter_map(|edit| text_of(edit.after.as_ref()));
                (change.op.clone(), texts.map(str::to_owned).collect())
            };
            let changes = page.editor.queue().all().map(|waiting| &waiting.change);
            changes.filter(|change| change.undoes.is_none()).map(of).collect()
        };
        let before = waiting(self);
        self.input(if again { Editor::redo } else { Editor::undo })?;
        let after = waiting(self);
        self.refate(before.iter().filter(|(op, _)| !after.contains_key(op)), Fate::Withdrawn);
        self.refate(after.iter().filter(|(op, _)| !before.contains_key(op)), Fate::Waits);
        Ok(())
    }

    /// Another fate of these changes. What was kept and goes by another name in one of them is answered by that name.
    fn refate<'a>(&mut self, changes: impl Iterator<Item = (&'a Id, &'a BTreeSet<String>)>, fate: Fate) {
        for (op, texts) in changes {
            let is_in =
                |entry: &Entry| matches!(entry.fate, Fate::Kept | Fate::Withdrawn) && texts.contains(&entry.text);
            let kept = self.ledger.iter().find(|(_, entry)| is_in(entry)).map(|(was, _)| was.clone());
            let was = if self.ledger.contains_key(op) { Some(op.clone()) } else { kept };
            if let Some(entry) = was.and_then(|was| self.ledger.remove(&was)) {
                self.wants += u64::from(fate == Fate::Waits);
                let wanted = if fate == Fate::Waits { self.wants } else { entry.wanted };
                self.ledger.insert(op.clone(), Entry { fate, wanted, ..entry });
            }
        }
    }

    /// Decides about the first refused change: keeps one's own or lets it go.
    pub(crate) fn decide(&mut self, keeps: bool) -> Check {
        let undecided = self.editor.conflicts.iter().find(|one| one.retry.is_none() && !one.locked);
        let Some(conflict) = undecided.cloned() else { return Ok(()) };
        let texts = conflict.mine.edits.iter().filter_map(|edit| text_of(edit.after.as_ref()));
        let texts: BTreeSet<String> = texts.map(str::to_owned).collect();
        if keeps {
            self.wants += 1;
            let kept = self.ledger.values_mut().filter(|entry| texts.contains(&entry.text));
            kept.for_each(|entry| entry.wanted = self.wants);
            let top = self.input(|editor| editor.change(""))?.op;
            return self.input(|editor| editor.keep_mine(&conflict.mine.op, top));
        }
        self.decided = texts;
        self.input(|editor| editor.drop_conflict(&conflict.mine.op))?;
        let decided = std::mem::take(&mut self.decided);
        let dropped = self.ledger.values_mut().filter(|entry| entry.fate == Fate::Kept);
        dropped.filter(|entry| decided.contains(&entry.text)).for_each(|entry| entry.fate = Fate::Dropped);
        Ok(())
    }
}
