//! The door to the editor: whatever happens is told it here, what it shows goes into the signals, and what it wants is done.

use super::{Document, DocumentEvent};
use crate::browser::{self, Drawer};
use crate::desk::tab::{Dialog, set_if_new};
use crate::link::EditorLink;
use crate::words;
use behaviour::{Change, Id, Kind};
use editor::{Announcement, Conflict, Editor, EditorEvent, Effect, Link, Me, Now, Saver};
use leptos::prelude::*;
use protocol::{Refused, Role};
use std::cell::RefCell;

const QUEUE_KEY: &str = "rrp.waiting";
const CONFLICTS_KEY: &str = "rrp.conflicts";

pub(super) type OnAnswer = Box<dyn FnOnce(Result<(), Refused>)>;
/// Hears who changed something last, and when, in milliseconds since 1970.
type OnLastChange = Box<dyn FnOnce(String, f64)>;

#[derive(Default)]
struct Callbacks {
    /// Those that want to know what became of a change; nobody after a reload.
    answers: Vec<(Id, OnAnswer)>,
    /// Those that look for who changed something last.
    looks: Vec<(u32, OnLastChange)>,
    looked: u32,
}

thread_local! {
    static CALLBACKS: RefCell<Callbacks> = RefCell::default();
}

fn callbacks<T>(act: impl FnOnce(&mut Callbacks) -> T) -> T {
    CALLBACKS.with(|callbacks| act(&mut callbacks.borrow_mut()))
}

/// Puts the news of these fields of the editor into the signals of the same name.
macro_rules! show_news {
    ($document:ident, $($field:ident),*) => {
        let news = {
            let editor = &mut $document.state().editor;
            ($(editor.$field.news(),)*)
        };
        let ($($field,)*) = news;
        $(if let Some(value) = $field {
            $document.$field.set(value);
        })*
    };
}

impl Document {
    /// Tells the editor something, shows what is another one then, and does what it wants.
    pub(super) fn input<T>(&self, act: impl FnOnce(&mut Editor) -> T) -> T {
        self.tell_time();
        let answer = act(&mut self.state().editor);
        self.show_and_do();
        answer
    }

    fn tell_time(&self) {
        let now = Now { clock_ms: browser::now_ms(), today_ms: browser::today_ms() };
        let me = self.tab.me.get_untracked();
        let (client, name) = me.map_or_else(Default::default, |me| (Some(me.client), me.name));
        let me = Me { client, name, refused: self.tab.refusal(Role::Editor) };
        self.state().editor.at(now, me);
    }

    fn show_and_do(&self) {
        let (records, effects, unheard) = {
            let editor = &mut self.state().editor;
            (editor.take_news(), editor.take_effects(), editor.unheard.news())
        };
        self.show_records(records);
        if let Some(unheard) = unheard {
            self.tab.unheard.set(unheard);
        }
        show_news!(
            self, open, revision, history, locks, editing, lock_clock, saving, waits, undoable, redoable, conflicts,
            removed_by, folded, hidden, people, following, selected, several
        );
        effects.into_iter().for_each(|effect| self.perform(effect));
    }

    fn perform(&self, effect: Effect) {
        match effect {
            Effect::Send(request, purpose) => self.link().send(request, purpose),
            Effect::Focus(target) => self.tab.keyboard.set(Some(target)),
            Effect::After(ms, wake) => {
                let document = self.clone();
                browser::after(ms, move || document.input(|editor| editor.wake(wake)));
            }
            Effect::KeepQueue => self.keep_queue(),
            Effect::KeepConflicts => self.keep_conflicts(),
            Effect::ForgetDraft(about) => Drawer::Tab.drop(&super::draft_key(&about)),
            Effect::Say(announcement) => self.announce(announcement),
            Effect::Answered(op, answer) => match callbacks(|all| take(&mut all.answers, &op)) {
                Some(on_answer) => on_answer(answer),
                None => self.tab.say_refusal(answer),
            },
            Effect::Renamed { was, now } => callbacks(|all| {
                if let Some(renamed) = all.answers.iter_mut().find(|(op, _)| *op == was) {
                    renamed.0 = now;
                }
            }),
            Effect::Unanswered(op) => drop(callbacks(|all| take(&mut all.answers, &op))),
            Effect::LastChange(number, last) => {
                let then = callbacks(|all| take(&mut all.looks, &number));
                if let (Some(then), Some((saver, at_ms))) = (then, last) {
                    then(called(&saver), at_ms as f64);
                }
            }
            Effect::Address(id) => self.remember_address(id.as_ref()),
            Effect::Decide(conflict) => self.replace_its_editor(&conflict),
            Effect::Happened(event) => self.hand_on(event),
            Effect::Opened { problems, fingerprint } => self.opened(problems, fingerprint),
            Effect::Made(accepted) => self.made(*accepted),
        }
    }

    /// The editor's link to the server.
    fn link(&self) -> impl Link {
        let document = self.clone();
        EditorLink(move |purpose, answer| document.input(|editor| editor.hear_answer(purpose, answer)))
    }

    fn hand_on(&self, event: EditorEvent) {
        match event {
            EditorEvent::Chosen => self.happened(DocumentEvent::Chosen),
            EditorEvent::Left => self.left(),
            EditorEvent::Opening => self.tab.to_graph.set(true),
            EditorEvent::Saved => self.happened(DocumentEvent::Saved),
            EditorEvent::NotSaved => self.happened(DocumentEvent::NotSaved),
            EditorEvent::Silent => self.tab.forget_good_news(),
        }
    }

    fn announce(&self, announcement: Announcement) {
        match announcement {
            Announcement::Refused(no) => self.tab.say_no(&no),
            Announcement::Unreachable => self.tab.say_unreachable(),
            Announcement::Connected(sent) => {
                let refused = self.tab.notice.with_untracked(|notice| notice.as_ref().is_some_and(|notice| notice.bad));
                if !refused {
                    self.tab.say(&words::connected(sent), false);
                }
            }
            Announcement::NothingToGroup => self.tab.say(words::nothing_to_group(), false),
            Announcement::InNoGroup => self.tab.say(words::in_no_group(), false),
            Announcement::MovedInto(title) => self.tab.whisper.set(words::moved_into(&title)),
            Announcement::NoLongerHere(name) => self.tab.say(&words::no_longer_here(&name), false),
            Announcement::WaitsElsewhere => self.tab.say(words::waits_elsewhere(), true),
            Announcement::WaitsUntilFree(name) => self.tab.say(&words::waits_until_free(&name), true),
            Announcement::WasFirst(who, what) => {
                self.tab.say(&words::was_first(&called(&who), &words::shown(&what)), true)
            }
            Announcement::ChangedWhileTyping(who) => self.tab.say(&words::changed_while_typing(&called(&who)), true),
            Announcement::RemovedWhileTyping(who) => self.tab.say(&words::removed_while_typing(&called(&who)), true),
        }
    }

    /// Names the person who saved a change: *you*, if it was in another window.
    pub(crate) fn called(&self, change: &Change) -> String {
        self.tell_time();
        called(&self.state().editor.saver(change))
    }

    /// Whoever made this change hears what became of it, once.
    pub(super) fn on_answer(&self, op: &Id, on_answer: OnAnswer) {
        callbacks(|all| all.answers.push((op.clone(), on_answer)));
    }

    /// Whoever looks for the last change of something hears of it under this number.
    pub(super) fn on_last_change(&self, then: OnLastChange) -> u32 {
        callbacks(|all| {
            all.looked = all.looked.wrapping_add(1);
            all.looks.push((all.looked, then));
            all.looked
        })
    }

    /// Proposes a change to the open behaviour; a refusal is shown as a notice.
    pub(super) fn propose(&self, change: Change) {
        self.input(|editor| editor.propose(change));
    }

    /// Proposes a change to the open behaviour and tells what became of it.
    pub(super) fn propose_and(&self, change: Change, on_answer: impl FnOnce(Result<(), Refused>) + 'static) {
        self.on_answer(&change.op, Box::new(on_answer));
        self.propose(change);
    }

    /// Proposes a change to the helper library: it waits in the queue of all changes.
    pub(in crate::desk) fn propose_to_library(
        &self,
        change: Change,
        on_answer: impl FnOnce(Result<(), Refused>) + 'static,
    ) {
        self.on_answer(&change.op, Box::new(on_answer));
        self.input(|editor| editor.propose_to_library(change));
    }

    /// True if what is proposed can be saved now.
    pub(crate) fn can_save(&self) -> bool {
        self.state().editor.can_save()
    }

    /// True if nothing waits to be saved.
    pub(in crate::desk) fn is_saved(&self) -> bool {
        self.state().editor.is_saved()
    }

    /// Takes back this person's last change.
    pub(crate) fn undo(&self) {
        if self.may_step() {
            self.input(Editor::undo);
        }
    }

    /// Does again what was taken back last.
    pub(crate) fn redo(&self) {
        if self.may_step() {
            self.input(Editor::redo);
        }
    }

    fn may_step(&self) -> bool {
        self.open.with_untracked(Option::is_some) && !self.tab.refuses(Role::Editor)
    }

    /// Asks for what was before all that is known.
    pub(crate) fn read_older(&self) {
        self.input(Editor::read_older);
    }

    fn keep_queue(&self) {
        let kept = self.state().editor.queue().to_keep();
        match kept.and_then(|kept| serde_json::to_string(&kept).ok()) {
            Some(text) => Drawer::Tab.put(QUEUE_KEY, &text),
            None => Drawer::Tab.drop(QUEUE_KEY),
        }
    }

    fn keep_conflicts(&self) {
        match self.conflicts.with_untracked(serde_json::to_string) {
            Ok(text) if text != "[]" => Drawer::Tab.put(CONFLICTS_KEY, &text),
            Ok(_) | Err(_) => Drawer::Tab.drop(CONFLICTS_KEY),
        }
    }

    /// Takes up what waited before the page was loaded again.
    pub(in crate::desk) fn restore(&self) {
        if let Some(queue) = Drawer::Tab.get(QUEUE_KEY).and_then(|text| crate::json::read(&text).ok()) {
            self.input(|editor| editor.restore_queue(queue));
        }
        let kept = Drawer::Tab.get(CONFLICTS_KEY).and_then(|text| crate::json::read::<Vec<Conflict>>(&text).ok());
        if let Some(kept) = kept {
            self.input(|editor| editor.restore_conflicts(kept));
        }
    }

    /// The editor in which the change was made gives its place to the comparison.
    fn replace_its_editor(&self, conflict: &Conflict) {
        let output = |connector: &Id| {
            self.connector(connector).map(|signals| signals.record.with_untracked(|at| at.output.clone()))
        };
        let is_its = |dialog: &Dialog| match dialog {
            Dialog::Operation { connector: Some(connector), .. } => {
                conflict.edits(connector) || output(connector).is_some_and(|output| conflict.edits(&output))
            }
            Dialog::Operation { connector: None, input, .. } => conflict.is_new() && conflict.rests_on(input),
            Dialog::EditStream(stream) => conflict.edits(stream),
            Dialog::Programs | Dialog::RenameProgram => conflict.about.kind == Kind::Settings,
            Dialog::Tiles => conflict.about.kind == Kind::Pad && !self.tab.writes_tile.get_untracked(),
            _ => false,
        };
        if self.tab.dialog.with_untracked(|dialog| dialog.as_ref().is_some_and(is_its)) {
            self.tab.dialog.set(Some(Dialog::Conflict(conflict.mine.op.clone())));
        }
    }

    /// The program that was open is not shown any more.
    fn left(&self) {
        self.happened(DocumentEvent::Left);
        set_if_new(&self.tab.dialog, None);
        set_if_new(&self.problems, Vec::new());
        set_if_new(&self.name, String::new());
        set_if_new(&self.versions, Vec::new());
        self.end_comparing();
    }
}

fn take<K: PartialEq, T>(all: &mut Vec<(K, T)>, key: &K) -> Option<T> {
    let at = all.iter().position(|(known, _)| known == key)?;
    Some(all.swap_remove(at).1)
}

fn called(saver: &Saver) -> String {
    match saver {
        Saver::Me => words::you_elsewhere().to_owned(),
        Saver::Other(name) => words::person_called(name),
    }
}
