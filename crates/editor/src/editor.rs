//! The state of what one person does in an open program, and what all its parts use.

pub(crate) mod after;
mod places;
mod presence;
mod selection;
mod silence;
pub(crate) mod undo;

use crate::conflict::{Conflict, FollowName, UsualPad};
use crate::editing::Editing;
use crate::effect::{Announcement, EditorEvent, Effect, Purpose, Saver};
use crate::history::HistoryPanel;
use crate::layout::DrawnSizes;
use crate::queue::Queue;
use crate::save_state::SaveState;
use crate::{EditorRequest, Saving, Selected, Watched};
use after::Following;
use behaviour::{Behaviour, Change, FillFrom, Group, Id, Kind, Place, Record, RecordId};
use phrase::Phrase;
use places::ShownPlaces;
use presence::Presence;
use protocol::{LockShown, Person, Refused};
use selection::{Folds, KeyboardPlace};
use silence::Silence;
use std::collections::{BTreeMap, BTreeSet};
use undo::Mine;

/// Of so many removed things it is remembered who removed them.
const REMOVED_MAX: usize = 2_000;

/// The editor of one person. Inputs are its methods, each after [`Editor::at`]; then [`Editor::take_news`], the [`Watched`]
/// fields and [`Editor::take_effects`] tell what came of them.
pub struct Editor {
    new_id: Box<dyn FnMut() -> Id + Send>,
    pub(crate) follow: FollowName,
    pub(crate) usual_pad: UsualPad,
    pub(crate) now: Now,
    pub(crate) me: Me,
    pub(crate) link: LinkState,

    /// The open program.
    pub open: Watched<Option<Id>>,
    /// The revision of the open program.
    pub revision: Watched<u64>,
    /// The history of the open program as far as it is known.
    pub history: Watched<HistoryPanel>,
    /// The locks that show who is editing what, this person included.
    pub locks: Watched<Vec<LockShown>>,
    /// The editor that is open here.
    pub editing: Watched<Option<Editing>>,
    /// Moves while something is counted down beside the editor; on the clock of the page.
    pub lock_clock: Watched<f64>,
    /// The state of saving.
    pub saving: Watched<Saving>,
    /// The records of the open program with changes that wait to be sent.
    pub waits: Watched<BTreeSet<RecordId>>,
    /// The label of what undo would take back.
    pub undoable: Watched<Option<Phrase>>,
    /// The label of what redo would do again.
    pub redoable: Watched<Option<Phrase>>,
    /// Refused changes that wait for their author, of any program.
    pub conflicts: Watched<Vec<Conflict>>,
    /// The people who removed something, by its id.
    pub removed_by: Watched<Removers>,
    /// For how many seconds the server has been silent, if that is too long to claim anything.
    pub unheard: Watched<Option<u32>>,
    /// The one thing that is chosen alone.
    pub selected: Watched<Option<Selected>>,
    /// Several things that are chosen together; none or at least two.
    pub several: Watched<BTreeSet<Selected>>,
    /// The groups that are seen as boxes on this page.
    pub folded: Watched<BTreeSet<Id>>,
    /// The streams that are not seen here, and the folded group of each.
    pub hidden: Watched<BTreeMap<Id, Id>>,
    /// Everyone in the open program, this person included.
    pub people: Watched<Vec<Person>>,
    /// The client whose view is looked at here.
    pub following: Watched<Option<Id>>,

    pub(crate) confirmed: Behaviour,
    pub(crate) wanted: Option<Id>,
    pub(crate) queue: Queue,
    pub(crate) saves: SaveState,
    pub(crate) silence: Silence,
    pub(crate) mine: Mine,
    pub(crate) reads_history: bool,
    /// The log is being read to find out who was before the first refused change.
    pub(crate) looks_who_was_first: bool,
    /// The number of editors that were opened.
    pub(crate) editors: u32,
    /// The time at which typing was told last.
    pub(crate) typed_ms: f64,
    pub(crate) folds: Folds,
    pub(crate) keyboard: Option<KeyboardPlace>,
    pub(crate) places: ShownPlaces,
    pub(crate) presence: Presence,
    /// The program that is shown in place of the open one, only to look at.
    pub(crate) past: Option<Behaviour>,
    pub(crate) following_of: Following,
    pub(crate) news: RecordNews,
    effects: Vec<Effect>,
}

/// The time of an input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Now {
    /// On the clock of the page, which only goes on, in milliseconds.
    pub clock_ms: f64,
    /// Since 1970, by this computer's clock, in milliseconds.
    pub today_ms: f64,
}

/// The person who sits here, as the server knows them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Me {
    /// None before the server has greeted back.
    pub client: Option<Id>,
    /// The name that others see.
    pub name: String,
    /// The reason why this person may not edit, if so.
    pub refused: Option<Refused>,
}

/// The state of the link to the server.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LinkState {
    /// There was none yet.
    #[default]
    Connecting,
    /// The server greeted back.
    Online,
    /// It broke.
    Offline,
}

/// The person who removed something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remover {
    /// Their name.
    pub name: String,
    /// By this they are told apart from others of that name; none in changes of older versions.
    pub client: Option<Id>,
}

/// The people who removed something lately.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Removers(Vec<(Id, Remover)>);

impl Removers {
    /// Returns the person who removed this last.
    #[must_use]
    pub fn get(&self, id: &Id) -> Option<&Remover> {
        self.0.iter().rfind(|(removed, _)| removed == id).map(|(_, remover)| remover)
    }

    /// Notes that somebody removed these.
    pub(crate) fn note(&mut self, ids: Vec<Id>, remover: &Remover) {
        let many = (self.0.len() + ids.len()).saturating_sub(REMOVED_MAX).min(self.0.len());
        self.0.drain(..many);
        self.0.extend(ids.into_iter().map(|id| (id, remover.clone())));
    }
}

/// The records that are to be shown anew.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct RecordNews {
    /// All of the program: another one is shown in place of what was.
    pub is_whole: bool,
    /// These records, one or more times.
    pub touched: Vec<RecordId>,
}

impl Editor {
    /// An editor in which nothing is open. It gets new ids from `new_id`, new names of streams from `follow`, and the sizes of
    /// what is drawn.
    #[must_use]
    pub fn new(
        new_id: impl FnMut() -> Id + Send + 'static,
        follow: FollowName,
        usual_pad: UsualPad,
        sizes: DrawnSizes,
    ) -> Self {
        Self {
            new_id: Box::new(new_id),
            follow,
            usual_pad,
            now: Now::default(),
            me: Me::default(),
            link: LinkState::default(),
            open: Watched::default(),
            revision: Watched::default(),
            history: Watched::default(),
            locks: Watched::default(),
            editing: Watched::default(),
            lock_clock: Watched::default(),
            saving: Watched::default(),
            waits: Watched::default(),
            undoable: Watched::default(),
            redoable: Watched::default(),
            conflicts: Watched::default(),
            removed_by: Watched::default(),
            unheard: Watched::default(),
            selected: Watched::default(),
            several: Watched::default(),
            folded: Watched::default(),
            hidden: Watched::default(),
            people: Watched::default(),
            following: Watched::default(),
            confirmed: Behaviour::default(),
            wanted: None,
            queue: Queue::default(),
            saves: SaveState::default(),
            silence: Silence::default(),
            mine: Mine::default(),
            reads_history: false,
            looks_who_was_first: false,
            editors: 0,
            typed_ms: 0.0,
            folds: Folds::default(),
            keyboard: None,
            places: ShownPlaces::new(sizes),
            presence: Presence::default(),
            past: None,
            following_of: Following::default(),
            news: RecordNews::default(),
            effects: Vec::new(),
        }
    }

    /// Tells when the next input comes, and who sits here.
    pub fn at(&mut self, now: Now, me: Me) -> &mut Self {
        (self.now, self.me) = (now, me);
        self
    }

    /// Takes what is to be done, in order.
    pub fn take_effects(&mut self) -> Vec<Effect> {
        std::mem::take(&mut self.effects)
    }

    /// Takes which records are to be shown anew, after what is chosen followed them.
    pub fn take_news(&mut self) -> RecordNews {
        self.follow_records();
        std::mem::take(&mut self.news)
    }

    /// Returns the open program with what waits to be sent.
    #[must_use]
    pub fn behaviour(&self) -> Behaviour {
        match &self.wanted {
            Some(open) => self.queue.on_top_of(open, &self.confirmed),
            None => Behaviour::default(),
        }
    }

    /// Returns the open program as the server has it.
    #[must_use]
    pub fn confirmed(&self) -> &Behaviour {
        &self.confirmed
    }

    /// Returns the program that is to be open.
    #[must_use]
    pub fn wanted(&self) -> Option<&Id> {
        self.wanted.as_ref()
    }

    /// Returns what waits to be sent.
    #[must_use]
    pub fn queue(&self) -> &Queue {
        &self.queue
    }

    /// Returns a record as it is to be shown.
    #[must_use]
    pub fn record(&self, key: &RecordId) -> Option<Record> {
        let waiting = match &self.wanted {
            Some(open) if self.saves.shows_waiting() => self.queue.record(open, key),
            _ => None,
        };
        waiting.unwrap_or_else(|| self.confirmed.records.get(key).cloned())
    }

    /// Returns the groups of the open program with what waits to be sent.
    pub(crate) fn groups_now(&self) -> Vec<(Id, Group)> {
        let waiting = self.wanted.as_ref().map(|open| self.queue.touched(open)).unwrap_or_default();
        let waiting = waiting.into_iter().filter(|key| key.kind == Kind::Group);
        let confirmed = self.confirmed.groups().map(|(id, _)| RecordId::new(Kind::Group, id));
        let keys: BTreeSet<RecordId> = confirmed.chain(waiting).filled();
        let group = |key: RecordId| match self.record(&key) {
            Some(Record::Group(group)) => Some((key.id, group)),
            _ => None,
        };
        keys.into_iter().filter_map(group).collect()
    }

    /// Returns the place where something was put.
    #[must_use]
    pub fn saved_place(&self, id: &Id) -> Option<Place> {
        match self.record(&RecordId::new(Kind::Place, id)) {
            Some(Record::Place(place)) => Some(place),
            _ => None,
        }
    }

    /// Returns an empty change of this person.
    pub fn change(&mut self, label: impl Into<Phrase>) -> Change {
        let op = self.next_id();
        Change::of(op, &self.me.name, label)
    }

    /// Returns true if this is the program that is to be open.
    #[must_use]
    pub fn is_wanted(&self, id: &Id) -> bool {
        self.wanted.as_ref() == Some(id)
    }

    /// Returns true if this program is open.
    #[must_use]
    pub fn is_open(&self, id: &Id) -> bool {
        self.open.as_ref() == Some(id)
    }

    /// Returns true if what is proposed can be saved now.
    #[must_use]
    pub fn can_save(&self) -> bool {
        self.saves.can_save()
    }

    /// Returns true if nothing waits to be saved.
    #[must_use]
    pub fn is_saved(&self) -> bool {
        self.queue.is_empty()
    }

    pub(crate) fn next_id(&mut self) -> Id {
        (self.new_id)()
    }

    /// Returns who saved a change.
    #[must_use]
    pub fn saver(&self, change: &Change) -> Saver {
        let is_me = self.me.client.is_some() && self.me.client == change.by;
        if is_me { Saver::Me } else { Saver::Other(change.author.clone()) }
    }

    /// These records are to be shown anew.
    pub(crate) fn touch(&mut self, records: impl IntoIterator<Item = RecordId>) {
        self.news.touched.extend(records);
    }

    /// Shows a whole program in place of what was shown.
    pub(crate) fn show_whole(&mut self, records: Behaviour) {
        let before = std::mem::replace(&mut self.confirmed, records);
        self.places.begin_anew(&self.confirmed);
        self.news.is_whole = true;
        let places = self.confirmed.streams().map(|(id, _)| RecordId::new(Kind::Place, id));
        let touched = before.records.keys().chain(self.confirmed.records.keys()).cloned().chain(places);
        let touched: Vec<RecordId> = touched.collect();
        self.touch(touched);
        if let Some(open) = &self.wanted {
            self.news.touched.extend(self.queue.touched(open));
        }
    }

    pub(crate) fn effect(&mut self, effect: Effect) {
        self.effects.push(effect);
    }

    pub(crate) fn happened(&mut self, event: EditorEvent) {
        self.effect(Effect::Happened(event));
    }

    pub(crate) fn say(&mut self, announcement: Announcement) {
        self.effect(Effect::Say(announcement));
    }

    /// Tells the server something that it does not answer.
    pub(crate) fn send_news(&mut self, news: impl Into<EditorRequest>) {
        self.effect(Effect::Send(news.into(), None));
    }

    pub(crate) fn ask(&mut self, request: impl Into<EditorRequest>, purpose: Purpose) {
        self.effect(Effect::Send(request.into(), Some(purpose)));
    }
}
