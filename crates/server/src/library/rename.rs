//! Another name for a helper that is used: its uses follow, in each program by a change of its own through its room.
//!
//! First the library has the helper under both names, then one program after another says the new one, then the old one
//! goes. What fails in between leaves both, so that everything runs on.

use super::LibraryService;
use crate::rooms::RoomCommand;
use crate::support::identity::Sender;
use crate::support::store_call::{bounded, store_no};
use behaviour::labels;
use behaviour::{Behaviour, Change, Helper, Id, Kind, Procedure, Record, RecordId, Refusal, rename_helpers};
use phrase::phrase;
use protocol::{Refused, answer};
use std::collections::{BTreeMap, HashSet};
use std::sync::Arc;
use tokio::sync::oneshot;
use uuid::Uuid;

/// Programs that may follow at once.
pub(crate) const FOLLOWING_MAX: usize = 500;
/// How often a change is made anew when others change the same program at the same moment.
const TRIES: usize = 5;

/// A helper that somebody wants to be called something else; the rest of it may be another too.
pub(crate) struct RenameRequest {
    /// Which.
    pub(crate) helper: Id,
    /// As it was seen.
    pub(crate) seen: Helper,
    /// As it shall be.
    pub(crate) after: Helper,
    /// Who wants it.
    pub(crate) by: String,
    /// For whom it is looked whether all can follow.
    pub(crate) sender: Sender,
}

/// Renames a helper, and goes through with it whatever becomes of the sender.
pub(crate) async fn rename(
    library: &Arc<LibraryService>,
    wish: RenameRequest,
) -> Result<answer::HelperRenamed, Refused> {
    let renaming = Renaming { library: Arc::clone(library), wish };
    let work = async move {
        let library = Arc::clone(&renaming.library);
        let _one_at_a_time = library.renaming.lock().await;
        renaming.done().await
    };
    library.tasks.make(work).await.map_err(|error| Refused::Unreadable(error.to_string().into()))?
}

struct Renaming {
    library: Arc<LibraryService>,
    wish: RenameRequest,
}

/// What became of a program that uses the helper.
enum RenamedUse {
    /// It says the new name.
    Now,
    /// It did not use the helper any more.
    Before,
}

impl Renaming {
    async fn done(&self) -> Result<answer::HelperRenamed, Refused> {
        let helpers = self.library.rooms.look(self.library.rooms.library()).await?;
        let programs = self.programs().await?;
        if programs.is_empty() && !self.is_used_by_helpers(helpers.behaviour()) {
            self.propose(self.library.rooms.library(), self.plain(helpers.behaviour())).await?;
            return Ok(answer::HelperRenamed { programs: 0, left: Vec::new() });
        }
        for (program, _) in &programs {
            self.check(program).await?;
        }
        let old = Id::from_uuid(Uuid::new_v4());
        self.propose(self.library.rooms.library(), self.both_names(helpers.behaviour(), &old)).await?;
        self.follow(&old).await
    }

    /// Lets all uses follow, also those that were made meanwhile; then the old name goes.
    async fn follow(&self, old: &Id) -> Result<answer::HelperRenamed, Refused> {
        let (mut followed, mut left) = (HashSet::new(), Vec::new());
        for _ in 0..TRIES {
            left.clear();
            for (program, name) in self.programs().await? {
                match self.follow_in(&program).await {
                    Ok(RenamedUse::Now) => drop(followed.insert(program)),
                    Ok(RenamedUse::Before) => {}
                    Err(no) => {
                        tracing::warn!(behaviour = %program, %no, "a program keeps the old name of a helper");
                        left.push(name);
                    }
                }
            }
            let gone = if left.is_empty() { self.let_go(old).await } else { break };
            match gone {
                Err(Refused::Change(Refusal::HelperUsed(..) | Refusal::Stale(_))) => {}
                Err(no) => return Err(no),
                Ok(()) => break,
            }
        }
        let programs = u32::try_from(followed.len()).unwrap_or(u32::MAX);
        Ok(answer::HelperRenamed { programs, left })
    }

    /// The programs that use the helper themselves, with their names, in order of id.
    async fn programs(&self) -> Result<Vec<(Id, String)>, Refused> {
        let users = bounded(self.library.store.users(&self.wish.seen.name)).await.map_err(|error| store_no(&error))?;
        let programs = users.into_iter().filter(|user| user.behaviour != *self.library.rooms.library());
        let mut programs: Vec<(Id, String)> = programs.map(|user| (user.behaviour, user.name)).collect();
        // The store tells them in that order, once for each record.
        programs.dedup_by(|next, one| next.0 == one.0);
        if programs.len() <= FOLLOWING_MAX {
            return Ok(programs);
        }
        Err(Refused::Change(Refusal::UsedByMany(self.wish.seen.name.clone(), FOLLOWING_MAX)))
    }

    fn is_used_by_helpers(&self, helpers: &Behaviour) -> bool {
        let others = helpers.helpers().filter(|(id, _)| **id != self.wish.helper);
        others.into_iter().any(|(_, helper)| behaviour::calls_helper(&helper.body, &self.wish.seen.name))
    }

    /// Asks, before anything is written, whether a program can follow: by its rules, and nobody edits what changes there.
    async fn check(&self, program: &Id) -> Result<(), Refused> {
        let look = self.library.rooms.look(program).await?;
        let change = self.change_of(look.behaviour());
        if change.edits.is_empty() {
            return Ok(());
        }
        let (knowing, judged, asked) = (Arc::clone(&self.library.knowing), look.clone(), change.clone());
        let judge = move |_: &_| judged.judge(asked, &knowing.within_budget());
        self.library.workers.run(self.wish.sender.clone(), judge).await?.map_err(Refused::Change)?;
        let (waiting, answer) = oneshot::channel();
        self.library.rooms.tell(program, RoomCommand::MayChange(change, waiting));
        match answer.await.unwrap_or(Err(Refused::NoBehaviour)) {
            Err(Refused::Change(Refusal::Locked { what, by })) => {
                let what = phrase!("server.in", "{what} in “{program}”", program = look.behaviour().name());
                Err(Refused::Change(Refusal::Locked { what, by }))
            }
            answer => answer,
        }
    }

    async fn follow_in(&self, program: &Id) -> Result<RenamedUse, Refused> {
        let mut last = Refused::TooFast;
        for _ in 0..TRIES {
            let change = self.change_of(self.library.rooms.look(program).await?.behaviour());
            if change.edits.is_empty() {
                return Ok(RenamedUse::Before);
            }
            match self.propose(program, change).await {
                Ok(()) => return Ok(RenamedUse::Now),
                Err(no @ Refused::Change(Refusal::Stale(_))) => last = no,
                Err(no) => return Err(no),
            }
        }
        Err(last)
    }

    /// Takes the old name out of the library, and what helpers were made of it meanwhile.
    async fn let_go(&self, old: &Id) -> Result<(), Refused> {
        let library = self.library.rooms.library();
        let helpers = self.library.rooms.look(library).await?;
        let old = RecordId::new(Kind::Helper, old);
        let mut change = self.change_of(helpers.behaviour());
        change.edits.retain(|edit| edit.id != old);
        if !change.edits.is_empty() {
            self.propose(library, change).await?;
        }
        let now = self.library.rooms.look(library).await?;
        if !now.behaviour().records.contains_key(&old) {
            return Ok(());
        }
        self.propose(library, self.empty_change().take(now.behaviour(), old)).await
    }

    async fn propose(&self, to: &Id, change: Change) -> Result<(), Refused> {
        self.library.rooms.propose(to, change).await
    }

    fn empty_change(&self) -> Change {
        let label = labels::rename_helper(&self.wish.seen.name, &self.wish.after.name);
        let op = Id::from_uuid(Uuid::new_v4());
        Change::of(op, &self.wish.by, label)
    }

    /// The helper under its new name only.
    fn plain(&self, helpers: &Behaviour) -> Change {
        self.renamed_in(helpers, self.empty_change())
    }

    /// The helper under its new name, the old one beside it, and what other helpers make of it.
    fn both_names(&self, helpers: &Behaviour, old: &Id) -> Change {
        let mut change = self.change_of(helpers);
        let own = RecordId::new(Kind::Helper, &self.wish.helper);
        change.edits.retain(|edit| edit.id != own);
        let kept = Record::Helper(self.wish.seen.clone());
        self.renamed_in(helpers, change).put(helpers, RecordId::new(Kind::Helper, old), kept)
    }

    /// Against the helper as it was seen: somebody who changed it meanwhile is not overwritten.
    fn renamed_in(&self, helpers: &Behaviour, change: Change) -> Change {
        let body = self.renamed(&self.wish.after.body);
        let (id, after) = (RecordId::new(Kind::Helper, &self.wish.helper), Helper { body, ..self.wish.after.clone() });
        let mut change = change.put(helpers, id.clone(), Record::Helper(after));
        for edit in change.edits.iter_mut().filter(|edit| edit.id == id) {
            edit.before = Some(Record::Helper(self.wish.seen.clone()));
        }
        change
    }

    /// All uses in a program, or among helpers, under the new name.
    fn change_of(&self, behaviour: &Behaviour) -> Change {
        let renamed = behaviour.records.iter().filter_map(|(id, record)| Some((id.clone(), self.follows(record)?)));
        renamed.fold(self.empty_change(), |change, (id, record)| change.put(behaviour, id, record))
    }

    /// What a record is under the new name, if that is another.
    fn follows(&self, record: &Record) -> Option<Record> {
        let mut after = record.clone();
        match &mut after {
            Record::Helper(helper) => helper.body = self.renamed(&helper.body),
            Record::Connector(connector) => match connector.operation.procedure_mut()? {
                Procedure::Helper(name) if *name == self.wish.seen.name => name.clone_from(&self.wish.after.name),
                Procedure::Body { body, .. } => *body = self.renamed(body),
                Procedure::Helper(_) => {}
            },
            Record::Settings(_)
            | Record::Stream(_)
            | Record::Place(_)
            | Record::Note(_)
            | Record::Group(_)
            | Record::Pad(_) => {}
        }
        (after != *record).then_some(after)
    }

    fn renamed(&self, body: &str) -> String {
        let names = BTreeMap::from([(self.wish.seen.name.clone(), self.wish.after.name.clone())]);
        rename_helpers(body, &names)
    }
}
