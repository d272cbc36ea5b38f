//! Making a behaviour: empty or from a template, whose helpers join the library.

use super::LibraryService;
use super::exercises::exercise;
use super::import::{TRIES, is_overtaken, judge, shelve};
use super::list::free_name;
use super::saved::{append, check_name};
use super::templates::{Template, templates};
use crate::support::identity::Sender;
use crate::support::store_call::{answer_by, bounded, by, store_no};
use behaviour::labels;
use behaviour::{Accepted, Behaviour, Change, Committed, Id, Kind, Record, RecordId, Settings};
use protocol::{Refused, answer};
use std::sync::Arc;
use store::files::ImportMode;
use uuid::Uuid;

/// What a client wants made.
pub(crate) struct CreateRequest {
    /// Its id.
    pub(crate) behaviour: Id,
    /// Its name.
    pub(crate) name: String,
    /// The template's name.
    pub(crate) template: Option<String>,
    /// Who wants it.
    pub(crate) by: String,
    /// For whom it is made.
    pub(crate) sender: Sender,
}

/// Makes the behaviour; asked twice with the same id, it makes one.
pub(crate) async fn create(library: &Arc<LibraryService>, wish: CreateRequest) -> Result<answer::Created, Refused> {
    by(answer_by(), made(library, wish)).await
}

async fn made(library: &Arc<LibraryService>, wish: CreateRequest) -> Result<answer::Created, Refused> {
    let template = wish.template.as_deref().map(find).transpose()?;
    if wish.behaviour == *library.rooms.library() {
        return Err(Refused::NoBehaviour);
    }
    check_name(&wish.name)?;
    if is_there(library, &wish).await? {
        return Ok(answer::Created { behaviour: wish.behaviour });
    }
    let records = match template {
        Some(template) => from_template(library, template, &wish).await?,
        None => Behaviour::default(),
    };
    let _one_at_a_time = library.creating.lock().await;
    if !is_there(library, &wish).await? {
        save(library, &wish, records).await?;
    }
    Ok(answer::Created { behaviour: wish.behaviour })
}

async fn is_there(library: &LibraryService, wish: &CreateRequest) -> Result<bool, Refused> {
    let there = bounded(library.store.load(&wish.behaviour)).await.map_err(|error| store_no(&error))?;
    Ok(there.is_some())
}

fn find(name: &str) -> Result<&'static Template, Refused> {
    let shown = || Refused::NoTemplate(name.chars().take(40).collect());
    let template = templates().iter().find(|template| template.name == name);
    template.or_else(|| Some(&exercise(name)?.template)).ok_or_else(shown)
}

async fn save(library: &Arc<LibraryService>, wish: &CreateRequest, mut records: Behaviour) -> Result<(), Refused> {
    let name = bounded(free_name(&*library.store, wish.name.trim())).await.map_err(|error| store_no(&error))?;
    let settings = records.settings().cloned().unwrap_or_else(|| Settings::named(""));
    let settings = Settings { name: name.clone(), ..settings };
    records.records.insert(RecordId::settings(), Record::Settings(settings));
    let mut change = Change::of(wish.behaviour.clone(), &wish.by, labels::add(&name));
    change.at_ms = crate::support::now_ms();
    for (id, record) in &records.records {
        change = change.put(&Behaviour::default(), id.clone(), record.clone());
    }
    let first = Accepted { revision: 1, change };
    append(library, &wish.behaviour, &first, &records).await?;
    library.rooms.news().changed(&first);
    Ok(())
}

/// The records of a template under new ids, its helpers in the library.
async fn from_template(
    library: &Arc<LibraryService>,
    template: &Template,
    wish: &CreateRequest,
) -> Result<Behaviour, Refused> {
    let (file, sender) = (Arc::new(template.file()), wish.sender.clone());
    let mut last = Refused::TooFast;
    for _ in 0..TRIES {
        let brought = judge(library, &sender, &file, ImportMode::Copy, &wish.by).await?;
        match shelve(library, &brought).await {
            Err(no) if is_overtaken(&no) => last = no,
            Err(no) => return Err(no),
            Ok(()) => {
                let mut records = Behaviour::default();
                brought.changes.iter().for_each(|change| records.apply(change));
                if let Some(Record::Settings(settings)) = records.records.get_mut(&RecordId::settings()) {
                    settings.exercise = exercise(template.name).map(|_| template.name.to_owned());
                }
                return Ok(records);
            }
        }
    }
    Err(last)
}

/// The library of a fresh store: the helpers that come with the robot, as one change.
#[must_use]
pub fn first_library() -> Committed {
    let mut change = Change::of(Id::from_uuid(Uuid::new_v4()), "rrp", labels::first_helpers());
    change.at_ms = crate::support::now_ms();
    for helper in robot::shipped_helpers() {
        let id = RecordId::new(Kind::Helper, &Id::from_uuid(Uuid::new_v4()));
        change = change.put(&Behaviour::default(), id, Record::Helper(helper));
    }
    Committed { revision: 1, change }
}
