//! A change that was refused because somebody else was first: what both made of it, and how one's own goes on top of
//! theirs. Pure, with the behaviour handed in.
//!
//! *Keep mine* is a new change against what the page knows by then: of each record what its author changed, the rest as the
//! others have it, and what is gone put back from the log. A third person's save brings it back to the same dialog.

use crate::build;
use behaviour::{
    Accepted, Behaviour, Change, Connector, Edit, FillFrom, Group, Id, Kind, Pad, Params, Procedure, Record, RecordId,
    Refusal, Settings, Stream, Tile,
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// The most refused changes that wait for their author.
pub const CONFLICTS_MAX: usize = 20;
/// The most changes of others that are kept with one of them.
const THEIRS_MAX: usize = 30;
/// All of them together, in bytes; the newest is kept whatever it takes.
const THEIRS_MAX_BYTES: usize = 128 << 10;

/// Returns the name of a stream that follows its connector, if it was made from what that did: the behaviour, the name as it
/// is, the connector as it was and as it is now. How streams are named is the page's, in its language.
pub type FollowName = fn(&Behaviour, &str, &Connector, &Connector) -> Option<String>;

/// Returns the tiles that people are shown of a behaviour in which nobody chose any. Their words are the page's.
pub type UsualPad = fn(&Behaviour) -> Pad;

/// A refused change; it stays until its author decides.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Conflict {
    pub behaviour: Id,
    /// The record that it is about: the first thing in it that somebody else touched.
    pub about: RecordId,
    /// The change as its author made it.
    pub mine: Change,
    /// The time when that was, in milliseconds since 1970 by this computer's clock.
    pub made_ms: f64,
    /// True if it was made without a connection.
    pub offline: bool,
    /// The changes that others saved since, oldest first; nothing if that could not be found out.
    pub theirs: Vec<Accepted>,
    /// True if it only waits until nobody is editing what it touches, and is proposed then as it is.
    #[serde(default)]
    pub locked: bool,
    /// The change under way that puts one's own on top.
    pub retry: Option<Id>,
    /// Somebody changed it once more while its author looked at both.
    #[serde(skip)]
    pub again: bool,
    /// True if it was shown since it was refused; after a reload it only waits.
    #[serde(skip, default = "yes")]
    pub shown: bool,
}

fn yes() -> bool {
    true
}

/// True if a refused change is shown beside what others saved: one that makes or edits streams, connectors or tiles, or that
/// words something anew, and comes too late. Moves and removals are small enough to be made anew.
pub fn is_shown_beside(change: &Change, no: &Refusal) -> bool {
    matches!(no, Refusal::Stale(_) | Refusal::MissingStream) && is_worth_keeping(change)
}

/// True if a refused change says or makes something that somebody would miss.
pub fn is_worth_keeping(change: &Change) -> bool {
    change.undoes.is_none() && change.edits.iter().any(|edit| is_about(edit) && edit.after.is_some())
}

/// True if a change only puts tiles in other places: nobody wrote anything. `usual` are the tiles that its author saw where
/// nobody had chosen any.
pub(crate) fn only_moves_tiles(change: &Change, usual: impl FnOnce() -> Pad) -> bool {
    let [Edit { before, after: Some(Record::Pad(after)), .. }] = change.edits.as_slice() else { return false };
    let before = match before {
        Some(Record::Pad(before)) => before.clone(),
        _ => usual(),
    };
    let mut left: Vec<&Tile> = before.tiles.values().collect();
    let is_there = |tile| left.iter().position(|known| *known == tile).map(|at| left.swap_remove(at)).is_some();
    after.tiles.values().all(is_there) && left.is_empty()
}

/// True if something of what a change edits is another by now.
pub fn is_late(change: &Change, now: &Behaviour) -> bool {
    change.edits.iter().any(|edit| now.records.get(&edit.id) != edit.before.as_ref())
}

fn is_part(id: &RecordId) -> bool {
    matches!(id.kind, Kind::Stream | Kind::Connector)
}

/// True if a change with this edit can be what somebody typed: of a part, of the tiles, or of a text of its own.
fn is_about(edit: &Edit) -> bool {
    is_part(&edit.id)
        || edit.id.kind == Kind::Pad
        || matches!((edit.before.as_ref().map(wording), edit.after.as_ref().map(wording)), (Some(Some(seen)), Some(Some(mine))) if seen != mine)
}

/// Returns the text that people wrote in a record that is no part of the graph.
pub fn wording(record: &Record) -> Option<&str> {
    match record {
        Record::Note(note) => Some(&note.text),
        Record::Group(group) => Some(&group.title),
        Record::Settings(settings) => Some(&settings.name),
        _ => None,
    }
}

/// Of what others saved, the changes since the author of a refused one looked: from the one on that changed what the
/// author saw.
pub fn since_seen(log: Vec<Accepted>, mine: &Change) -> Vec<Accepted> {
    let needs: BTreeSet<RecordId> = needed(mine).into_iter().chain(touched(mine).cloned()).filled();
    let touches =
        |accepted: &Accepted| accepted.change.op != mine.op && touched(&accepted.change).any(|id| needs.contains(id));
    let mut log: Vec<Accepted> = log.into_iter().filter(touches).collect();
    let leaves_it = |accepted: &Accepted| {
        mine.edits
            .iter()
            .any(|edit| accepted.change.edits.iter().any(|their| their.id == edit.id && their.before == edit.before))
            || accepted.change.edits.iter().any(|their| their.after.is_none() && needs.contains(&their.id))
    };
    let first = log.iter().position(leaves_it).unwrap_or_else(|| log.len().saturating_sub(1));
    newest(log.split_off(first))
}

/// The newest of them, within their bounds.
fn newest(mut log: Vec<Accepted>) -> Vec<Accepted> {
    let mut bytes = 0;
    let fits = log.iter().rev().take(THEIRS_MAX).take_while(|accepted| {
        bytes += accepted.change.bytes();
        bytes <= THEIRS_MAX_BYTES
    });
    let many = fits.count().max(1);
    log.split_off(log.len().saturating_sub(many))
}

fn touched(change: &Change) -> impl Iterator<Item = &RecordId> {
    change.edits.iter().map(|edit| &edit.id)
}

/// Returns what a change is about or rests on: what it edits, and the ends of its connectors.
fn needed(change: &Change) -> BTreeSet<RecordId> {
    let edited = change.edits.iter().filter(|edit| is_about(edit)).map(|edit| edit.id.clone());
    edited.chain(change.edits.iter().filter_map(|edit| edit.after.as_ref()).flat_map(ends)).filled()
}

/// The streams that a record cannot be without.
fn ends(record: &Record) -> Vec<RecordId> {
    match record {
        Record::Connector(connector) => {
            let streams = connector.inputs.iter().chain([&connector.output]);
            streams.map(|id| RecordId::new(Kind::Stream, id)).collect()
        }
        _ => Vec::new(),
    }
}

/// Returns the program with what of these is gone put back as it was: whole changes that removed it, taken back as far
/// as they still stand.
pub fn brought_back(
    now: &Behaviour,
    log: &[Accepted],
    missing: impl Fn(&Behaviour) -> BTreeSet<RecordId>,
) -> Behaviour {
    let mut whole = now.clone();
    for accepted in log.iter().rev() {
        let gone = missing(&whole);
        let removes = |edit: &Edit| edit.after.is_none() && gone.contains(&edit.id);
        if accepted.change.edits.iter().any(removes) {
            let stands: Vec<&Edit> = accepted
                .change
                .edits
                .iter()
                .filter(|edit| whole.records.get(&edit.id) == edit.after.as_ref())
                .collect();
            for edit in stands {
                put(&mut whole, &edit.id, edit.before.clone());
            }
        }
    }
    whole
}

fn put(whole: &mut Behaviour, id: &RecordId, record: Option<Record>) {
    match record {
        Some(record) => whole.records.insert(id.clone(), record),
        None => whole.records.remove(id),
    };
}

/// The change from one behaviour to another, under the name of an empty one.
pub fn between(now: &Behaviour, then: &Behaviour, start: Change) -> Change {
    let all: BTreeSet<&RecordId> = now.records.keys().chain(then.records.keys()).filled();
    let edits = all.into_iter().filter(|id| now.records.get(*id) != then.records.get(*id));
    let edit = |id: &RecordId| Edit {
        id: id.clone(),
        before: now.records.get(id).cloned(),
        after: then.records.get(id).cloned(),
    };
    Change { edits: edits.map(edit).collect(), ..start }
}

impl Conflict {
    /// A refused change, with what others saved since and the behaviour as it is now.
    pub fn of(
        behaviour: Id,
        mine: Change,
        (made_ms, offline): (f64, bool),
        theirs: Vec<Accepted>,
        now: &Behaviour,
    ) -> Option<Self> {
        let parts = || mine.edits.iter().filter(|edit| is_about(edit));
        let late = parts().find(|edit| now.records.get(&edit.id) != edit.before.as_ref());
        let about = late.or_else(|| parts().next())?.id.clone();
        Some(Self {
            behaviour,
            about,
            mine,
            made_ms,
            offline,
            theirs,
            locked: false,
            retry: None,
            again: false,
            shown: false,
        })
    }

    /// A later change of the same author joins in: it was made on top of this one, which nobody else ever had.
    pub fn join(&mut self, later: Change) {
        for edit in later.edits {
            match self.mine.edits.iter_mut().find(|known| known.id == edit.id) {
                Some(known) => known.after = edit.after,
                None => self.mine.edits.push(edit),
            }
        }
    }

    /// True if another change touches something of this one.
    pub fn meets(&self, change: &Change) -> bool {
        let mine: BTreeSet<_> = self.mine.edits.iter().filter(|edit| is_about(edit)).map(|edit| &edit.id).filled();
        touched(change).any(|id| mine.contains(id))
    }

    /// Returns the records that this change rests on and that are gone.
    fn missing(&self, now: &Behaviour) -> BTreeSet<RecordId> {
        let made = |id: &RecordId| self.mine.edits.iter().any(|edit| edit.id == *id && edit.before.is_none());
        let dropped = |id: &RecordId| self.mine.edits.iter().any(|edit| edit.id == *id && edit.after.is_none());
        let needs = needed(&self.mine).into_iter();
        needs.filter(|id| !now.records.contains_key(id) && !made(id) && !dropped(id)).filled()
    }

    /// True if somebody removed what this change is about or rests on.
    pub fn is_removed(&self, now: &Behaviour) -> bool {
        !self.missing(now).is_empty()
    }

    /// The last change of somebody to it.
    pub fn last_of_theirs(&self) -> Option<&Change> {
        self.theirs.last().map(|accepted| &accepted.change)
    }

    /// The record as its author saw it, and as the author wants it.
    pub fn mine_of(&self, id: &RecordId) -> Option<(Option<&Record>, Option<&Record>)> {
        let edit = self.mine.edits.iter().find(|edit| edit.id == *id)?;
        Some((edit.before.as_ref(), edit.after.as_ref()))
    }

    /// True if it makes something that was not there before.
    pub fn is_new(&self) -> bool {
        self.mine_of(&self.about).is_some_and(|(seen, _)| seen.is_none())
    }

    /// True if it edits a stream or connector.
    pub fn edits(&self, id: &Id) -> bool {
        touched(&self.mine).any(|edited| is_part(edited) && edited.id == *id)
    }

    /// True if a stream has to be there for it.
    pub fn rests_on(&self, stream: &Id) -> bool {
        needed(&self.mine).contains(&RecordId::new(Kind::Stream, stream))
    }

    /// True if it was put on top and is not answered yet.
    pub fn is_under_way(&self) -> bool {
        self.retry.is_some()
    }

    /// True if it is to be decided and was not shown yet.
    pub fn waits_unseen(&self) -> bool {
        !self.shown && !self.locked
    }

    /// A stream as the author of this change wants it, if it touches that.
    pub fn wanted(&self, stream: &Id) -> Option<&Record> {
        self.mine_of(&RecordId::new(Kind::Stream, stream))?.1
    }

    /// A stream that somebody removed, as it was.
    pub fn gone(&self, stream: &Id) -> Option<&Record> {
        let key = RecordId::new(Kind::Stream, stream);
        let edits = self.theirs.iter().rev().flat_map(|accepted| &accepted.change.edits);
        edits.filter(|edit| edit.id == key).find_map(|edit| edit.before.as_ref())
    }

    /// One's own on top of what there is now, after bringing back what is gone: of each record what its author changed,
    /// and the rest as the others have it. Without edits if nothing is left to change.
    pub fn on_top(&self, now: &Behaviour, start: Change, follow: FollowName) -> Change {
        let mut whole = brought_back(now, &self.theirs, |whole| self.missing(whole));
        let mut renames = false;
        for edit in &self.mine.edits {
            match (&edit.before, &edit.after) {
                (Some(Record::Stream(seen)), Some(Record::Stream(mine))) => {
                    renames |= seen.name != mine.name;
                    self.put_stream(&mut whole, &edit.id, (seen, mine));
                }
                // What only follows a new name follows it anew, in the text that is there now.
                (Some(Record::Connector(_)), Some(Record::Connector(_))) if renames => {}
                (Some(Record::Connector(seen)), Some(Record::Connector(mine))) => {
                    let [seen, mine] = [seen, mine].map(|of| self.with_new_names(&whole, of));
                    if let Some(Record::Connector(theirs)) = whole.records.get_mut(&edit.id) {
                        *theirs = merged_connector(&seen, &mine, theirs);
                    }
                }
                (Some(Record::Group(seen)), Some(Record::Group(mine))) => {
                    if let Some(Record::Group(theirs)) = whole.records.get_mut(&edit.id) {
                        *theirs = merged_group(seen, mine, theirs);
                    }
                }
                (Some(Record::Pad(seen)), Some(Record::Pad(mine))) => {
                    if let Some(Record::Pad(theirs)) = whole.records.get_mut(&edit.id) {
                        *theirs = Pad::on_top(seen, mine, theirs);
                    }
                }
                (Some(Record::Settings(seen)), Some(Record::Settings(mine))) => {
                    if let Some(Record::Settings(theirs)) = whole.records.get_mut(&edit.id) {
                        *theirs = merged_settings(seen, mine, theirs);
                    }
                }
                (_, after) => put(&mut whole, &edit.id, after.clone()),
            }
        }
        self.name_anew(now, &mut whole, follow);
        between(now, &whole, start)
    }

    /// A connector whose body names its inputs as they are called by now, after others renamed them.
    fn with_new_names(&self, now: &Behaviour, connector: &Connector) -> Connector {
        let mut was = now.clone();
        for edit in self.theirs.iter().rev().flat_map(|accepted| &accepted.change.edits) {
            if let (Some(before @ Record::Stream(_)), Some(_)) = (&edit.before, &edit.after) {
                put(&mut was, &edit.id, Some(before.clone()));
            }
        }
        let (old, new) = (was.arguments(connector), now.arguments(connector));
        let mut connector = connector.clone();
        if let Some(Procedure::Body { body, args: None }) = connector.operation.procedure_mut() {
            *body = behaviour::rename_identifiers(body, &old, &new);
        }
        connector
    }

    /// The streams that nobody named follow their connectors, which may be others now than either of both saw.
    fn name_anew(&self, now: &Behaviour, whole: &mut Behaviour, follow: FollowName) {
        for edit in &self.mine.edits {
            let (Some(Record::Connector(seen)), Some(Record::Connector(mine))) = (&edit.before, &edit.after) else {
                continue;
            };
            let (Some(theirs), Some(merged)) = (now.connector(&edit.id.id), whole.connector(&edit.id.id).cloned())
            else {
                continue;
            };
            let Some(stream) = whole.stream(&merged.output).cloned() else { continue };
            // Whichever of the three its name was made from.
            let followed = [mine, theirs, seen].into_iter().find_map(|of| follow(whole, &stream.name, of, &merged));
            if let Some(name) = followed {
                let name = build::free_name(whole, &name);
                let step = Change::of(self.mine.op.clone(), "", "");
                let step = build::stream_edited(whole, step, &merged.output, Stream { name, ..stream });
                whole.apply(&step);
            }
        }
    }

    fn put_stream(&self, whole: &mut Behaviour, id: &RecordId, (seen, mine): (&Stream, &Stream)) {
        let Some(theirs) = whole.stream(&id.id) else { return };
        let merged = merged_stream(seen, mine, theirs);
        let step = build::stream_edited(whole, Change::of(self.mine.op.clone(), "", ""), &id.id, merged);
        whole.apply(&step);
    }
}

/// Mine where it was changed, else theirs.
fn pick<T: PartialEq + Clone>(seen: &T, mine: &T, theirs: &T) -> T {
    if seen == mine { theirs.clone() } else { mine.clone() }
}

fn merged_group(seen: &Group, mine: &Group, theirs: &Group) -> Group {
    Group {
        title: pick(&seen.title, &mine.title, &theirs.title),
        streams: pick(&seen.streams, &mine.streams, &theirs.streams),
        folded: pick(&seen.folded, &mine.folded, &theirs.folded),
    }
}

fn merged_settings(seen: &Settings, mine: &Settings, theirs: &Settings) -> Settings {
    Settings {
        name: pick(&seen.name, &mine.name, &theirs.name),
        tags: pick(&seen.tags, &mine.tags, &theirs.tags),
        ..theirs.clone()
    }
}

fn merged_connector(seen: &Connector, mine: &Connector, theirs: &Connector) -> Connector {
    Connector {
        operation: pick(&seen.operation, &mine.operation, &theirs.operation),
        inputs: pick(&seen.inputs, &mine.inputs, &theirs.inputs),
        output: pick(&seen.output, &mine.output, &theirs.output),
        order: pick(&seen.order, &mine.order, &theirs.order),
    }
}

/// Mine beside what somebody else changed meanwhile; none if both changed the same of it.
pub fn beside(seen: &Stream, mine: &Stream, theirs: &Stream) -> Option<Stream> {
    let merged = merged_stream(seen, mine, theirs);
    // Whoever is the first of both: nobody gave way.
    (merged == merged_stream(seen, theirs, mine)).then_some(merged)
}

fn merged_stream(seen: &Stream, mine: &Stream, theirs: &Stream) -> Stream {
    let (device, params) = if seen.device == mine.device && seen.device == theirs.device {
        (seen.device.clone(), merged_params(&seen.params, &mine.params, &theirs.params))
    } else {
        let device = |stream: &Stream| (stream.device.clone(), stream.params.clone());
        pick(&device(seen), &device(mine), &device(theirs))
    };
    Stream {
        kind: theirs.kind,
        name: pick(&seen.name, &mine.name, &theirs.name),
        device,
        params,
        order: pick(&seen.order, &mine.order, &theirs.order),
        resources: pick(&seen.resources, &mine.resources, &theirs.resources),
        priority: pick(&seen.priority, &mine.priority, &theirs.priority),
        hold_ms: pick(&seen.hold_ms, &mine.hold_ms, &theirs.hold_ms),
    }
}

/// Of each setting mine where it was changed, else theirs.
fn merged_params(seen: &Params, mine: &Params, theirs: &Params) -> Params {
    let names: BTreeSet<&String> = mine.keys().chain(theirs.keys()).filled();
    let one = |name: &String| {
        let value = pick(&seen.get(name), &mine.get(name), &theirs.get(name));
        Some((name.clone(), value?.clone()))
    };
    names.into_iter().filter_map(one).filled()
}
