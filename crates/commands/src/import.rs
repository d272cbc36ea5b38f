//! `rrp import`: files into a store, each as a new behaviour or as itself.

mod batch;

use crate::LineCommand;
use crate::failure::Failure;
use crate::link::{self, LocalServer};
use crate::patience;
use crate::program::read_bytes;
use crate::store_at::{self, StoreArgs, StoreWay, run};
use batch::{FileBatch, Goes};
use behaviour::{Behaviour, BehaviourFile, Change, Committed, Decision, Id, Room};
use clap::Args;
use server::{Knowing, PageFiles, free_name};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{SystemTime, UNIX_EPOCH};
use store::files::{FILE_MAX_BYTES, FileFault, Import, ImportMode, ReadFile};
use store::{Append, LIBRARY, Store};

/// Brings files into a store: the behaviours, and the helpers that its library does not have yet.
///
/// A helper whose name means something else there comes under a free name, and the behaviour uses that. Nothing is
/// ever started. Cut short, the same command goes on: what it brought is not brought twice. Exit codes: 0 all are imported;
/// 1 one could not be, those before it are; every reason is printed.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  rrp import tracking.json greeting.xml
  rrp import --restore tracking.json --store files:/srv/rrp
  rrp import --thesis bolt://neo4j@127.0.0.1:7687")]
pub(crate) struct ImportArgs {
    /// The files, rrp-behaviour/1 as JSON or XML; - reads standard input.
    #[arg(value_name = "FILE", required_unless_present = "thesis")]
    files: Vec<PathBuf>,
    /// Every program of a Neo4j that the thesis's own environment wrote.
    #[arg(long, value_name = "URL", conflicts_with_all = ["files", "restore"])]
    thesis: Option<String>,
    /// Under the ids of the file, for a store that does not have the behaviour; else it becomes a copy.
    #[arg(long)]
    restore: bool,
    #[command(flatten)]
    at: StoreArgs,
}

impl LineCommand for ImportArgs {
    const EXAMPLES: &'static [&'static str] = &["rrp import tracking.xml              bring a behaviour in, as a copy"];

    fn run(self, _: PageFiles) -> ExitCode {
        crate::ended(import(&self))
    }
}

/// Imports, or says why not.
fn import(args: &ImportArgs) -> Result<(), Failure> {
    run(async {
        let (way, files) = (args.at.way().await?, given(args).await?);
        match way {
            StoreWay::Store(store) => patience::told(&args.at.url()?, into_store(&*store, &files, args.restore)).await,
            StoreWay::Server(link) => through_server(&link, files, args.restore).await,
        }
    })
}

async fn into_store(store: &dyn Store, files: &[(PathBuf, Vec<u8>)], restore: bool) -> Result<(), Failure> {
    let batch = FileBatch::in_store(store, files).await?;
    for (at, (file, bytes)) in files.iter().enumerate() {
        let goes = if restore { None } else { Some(batch.goes(store, at, bytes, now_ms()).await?) };
        match goes {
            Some(Goes::IsHere(id, name)) => tell_is_here(file, &name, &id),
            Some(Goes::Under(id)) => tell(file, &import_one(store, file, bytes, Some(id)).await?.into()),
            None => tell(file, &import_one(store, file, bytes, None).await?.into()),
        }
    }
    Ok(())
}

async fn through_server(link: &LocalServer, files: Vec<(PathBuf, Vec<u8>)>, restore: bool) -> Result<(), Failure> {
    let listed = link.listed().await?;
    let batch = FileBatch::among(&listed.into_iter().map(|named| named.id).collect(), &files);
    for (at, (file, bytes)) in files.into_iter().enumerate() {
        let id = (!restore).then(|| batch.id(at, 0));
        let brought = through(link, &file, bytes, id).await?;
        if brought.was_here { tell_is_here(&file, &brought.name, &brought.id) } else { tell(&file, &brought) }
    }
    Ok(())
}

/// What to import: its name and its bytes.
async fn given(args: &ImportArgs) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
    let Some(url) = &args.thesis else {
        return args.files.iter().map(|file| Ok((file.clone(), read_bytes(file)?))).collect();
    };
    let programs = store::read_thesis(url).await?;
    let files = programs.into_iter().map(|file| (PathBuf::from(&file.name), store::files::write_json(&file).into()));
    Ok(files.collect())
}

/// What came of a file.
#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase")]
struct ImportOutcome {
    id: Id,
    name: String,
    renamed_helpers: Vec<(String, String)>,
    /// Whether it was brought before.
    #[serde(default)]
    was_here: bool,
}

impl From<Import> for ImportOutcome {
    fn from(import: Import) -> Self {
        Self { id: import.behaviour, name: import.name, renamed_helpers: import.renamed, was_here: false }
    }
}

/// Imports a file through the server that has the store, as a copy of this id or as itself.
async fn through(link: &LocalServer, path: &Path, bytes: Vec<u8>, copy: Option<Id>) -> Result<ImportOutcome, Failure> {
    #[derive(serde::Deserialize)]
    struct No {
        error: String,
    }
    let mode = copy.map_or_else(|| "restore".to_owned(), |id| format!("copy&behaviour={id}"));
    if bytes.len() > FILE_MAX_BYTES {
        let path = path.display();
        return Err(Failure::of(format!("{path} is larger than {FILE_MAX_BYTES} bytes. Split it into several.")));
    }
    let answer = link.post(&format!("/api/import?mode={mode}&by=rrp%20import"), bytes).await?;
    let fine = answer.fine;
    let text = answer.text().await?;
    if fine {
        return link::understood(&text);
    }
    let No { error } = link::understood(&text)?;
    Err(Failure::of(format!("{}: {error}", path.display())))
}

fn tell(file: &Path, brought: &ImportOutcome) {
    let mut out = std::io::stdout().lock();
    let _ = writeln!(out, "{}: “{}” is here now, as {}.", file.display(), brought.name, brought.id);
    for (old, new) in &brought.renamed_helpers {
        let _ = writeln!(out, "  Its helper {old} means something else here; it came as {new}.");
    }
}

fn tell_is_here(file: &Path, name: &str, id: &Id) {
    let _ = writeln!(std::io::stdout().lock(), "{}: “{name}” is here already, as {id}.", file.display());
}

/// Imports a file, as a copy of this id or as itself.
async fn import_one(store: &dyn Store, path: &Path, bytes: &[u8], copy: Option<Id>) -> Result<Import, Failure> {
    let mut looked = store::files::look(bytes);
    let named = |faults: Vec<FileFault>| Failure::faults(path, &faults);
    let Some(mut file) = looked.file.take() else { return Err(named(looked.faults)) };
    let mode = if copy.is_some() { ImportMode::Copy } else { ImportMode::Restore };
    if mode == ImportMode::Restore {
        check_absent(store, &file).await?;
    }
    file.name = free_name(store, file.name.trim()).await?;
    let library = library(store).await?;
    let brought = judged(&file, mode, library.behaviour(), &looked).map_err(named)?;
    let brought = Import { behaviour: copy.unwrap_or(brought.behaviour), ..brought };
    save_library(store, library, &brought).await?;
    save(store, &brought).await?;
    Ok(brought)
}

fn judged(
    file: &BehaviourFile,
    mode: ImportMode,
    library: &Behaviour,
    looked: &ReadFile,
) -> Result<Import, Vec<FileFault>> {
    file.records(|_| None).map_err(|faults| looked.place(&faults))?;
    let new_id = || Id::from_uuid(uuid::Uuid::new_v4());
    let brought = store::files::import(file, mode, library, "rrp import", new_id);
    let brought = brought.map_err(|faults| looked.place(&faults))?;
    Room::rehearse(&brought.changes, &Knowing::default()).map_err(|refusal| looked.place(&[refusal]))?;
    Ok(brought)
}

async fn check_absent(store: &dyn Store, file: &BehaviourFile) -> Result<(), Failure> {
    let Some(id) = file.id.as_deref().and_then(|id| Id::new(id).ok()) else { return Ok(()) };
    let there = store.load(&id).await?;
    if there.is_none() && id.as_str() != LIBRARY {
        return Ok(());
    }
    Err(Failure::of(format!(
        "“{}” is there already, perhaps in the bin. Import it without --restore to get a copy.",
        file.name
    )))
}

/// The library as it is; a fresh store gets the helpers that come with the robot, as from a server.
async fn library(store: &dyn Store) -> Result<Room, Failure> {
    let id = store_at::library()?;
    let mut loaded = store.load(&id).await?;
    if loaded.is_none() {
        let (first, mut after) = (server::first_library(), Behaviour::default());
        after.apply(&first.change);
        store.append(&id, &first, &after).await?;
        loaded = store.load(&id).await?;
    }
    Ok(loaded
        .map_or_else(|| Room::open(Behaviour::default(), 0), |loaded| Room::open(loaded.behaviour, loaded.revision)))
}

async fn save_library(store: &dyn Store, library: Room, brought: &Import) -> Result<(), Failure> {
    let Some(change) = brought.library.clone() else { return Ok(()) };
    match library.propose(now_ms(), change, &Knowing::default()) {
        Decision::Save(made) => {
            let mut after = library.behaviour().clone();
            after.apply(&made.change);
            append(store, &store_at::library()?, &made, &after).await
        }
        Decision::Duplicate(_) => Ok(()),
        Decision::Refuse(refusal) => Err(Failure::of(refusal)),
    }
}

async fn save(store: &dyn Store, brought: &Import) -> Result<(), Failure> {
    let (mut after, now_ms) = (Behaviour::default(), now_ms());
    for (revision, change) in (1..).zip(&brought.changes) {
        after.apply(change);
        let made = Committed { revision, change: Change { at_ms: now_ms, ..change.clone() } };
        append(store, &brought.behaviour, &made, &after).await?;
    }
    Ok(())
}

async fn append(store: &dyn Store, id: &Id, made: &Committed, after: &Behaviour) -> Result<(), Failure> {
    match store.append(id, made, after).await? {
        Append::Applied | Append::Duplicate { .. } => Ok(()),
        Append::Reused { .. } | Append::Conflict { .. } => {
            Err(Failure::of("Somebody else changed the store just now. Try again."))
        }
    }
}

fn now_ms() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    u64::try_from(since.as_millis()).unwrap_or(u64::MAX)
}
