//! `rrp backup`, `rrp restore` and `rrp migrate`: a whole store at once.

use crate::LineCommand;
use crate::failure::Failure;
use crate::link::LocalServer;
use crate::patience;
use crate::store_at::{StoreArgs, StoreWay, open, open_to_fill, run};
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use server::PageFiles;
use std::fs::File;
use std::io::{BufReader, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};
use store::backup::{BackedUpRobot, BackupError, Counted, StoreDifference};
use store::{Filling, FolderLock, Store};

/// How often the bar is drawn, in times a second.
const DRAWN_HZ: u8 = 10;

/// Writes every behaviour with its whole history, the bin, the library and the robots into one file of JSON lines.
///
/// Only its user may read the file. Recordings are files already and not in it. The last line tells whether the file is whole. Exit codes: 0 written; 1 not, and no file of that name is left behind.
#[derive(Debug, Args)]
#[command(after_help = "Example: rrp backup monday.rrpbackup --data /srv/rrp")]
pub(crate) struct BackupArgs {
    /// The file to write; one that is there is replaced at the end.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    at: StoreArgs,
}

impl LineCommand for BackupArgs {
    const EXAMPLES: &'static [&'static str] = &["rrp backup monday.rrpbackup          keep everything in one file"];

    fn run(self, _: PageFiles) -> ExitCode {
        crate::ended(backup(&self))
    }
}

/// Puts a backup into an empty store.
///
/// The whole file is read before anything is changed. Ended early, the same command goes on where it was; until then no
/// server serves what is there. Robots and their orders go to the data folder. Exit codes: 0 restored; 1 not.
#[derive(Debug, Args)]
#[command(after_help = "Example: rrp restore monday.rrpbackup --store files:/srv/new")]
pub(crate) struct RestoreArgs {
    /// The backup.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    at: StoreArgs,
}

impl LineCommand for RestoreArgs {
    fn run(self, _: PageFiles) -> ExitCode {
        crate::ended(restore(&self))
    }
}

/// Copies a whole store into another one that is empty, then compares both.
///
/// Revision, records, history and bin of every behaviour are compared at the end. Ended early, the same command goes on
/// where it was, and until then no server serves the second store; the first one stays as it is. Exit codes: 0 both hold the same; 1 not.
#[derive(Debug, Args)]
#[command(after_help = "Example: rrp migrate --from sqlite:/srv/rrp --to files:/srv/rrp-files")]
pub(crate) struct MigrateArgs {
    /// The address of the store to copy.
    #[arg(long, value_name = "URL")]
    from: String,
    /// The address of the store to fill.
    #[arg(long, value_name = "URL")]
    to: String,
}

impl LineCommand for MigrateArgs {
    fn run(self, _: PageFiles) -> ExitCode {
        crate::ended(migrate(&self))
    }
}

/// Backs up, or says why not.
fn backup(args: &BackupArgs) -> Result<(), Failure> {
    let (part, bar) = (part(&args.file), Bar::new());
    let done = run(async {
        match args.at.way().await? {
            StoreWay::Store(store) => {
                let robots = args.at.folder().map(|folder| server::robots_in(&folder)).unwrap_or_default();
                Ok(write(&*store, &robots, &part, &bar).await?)
            }
            StoreWay::Server(link) => fetch(&link, &part).await,
        }
    });
    let done = done.and_then(|done| {
        let kept = store::disk::rename(&part, &args.file);
        kept.map(|()| done).map_err(|error| Failure::unwritten(&args.file, &error))
    });
    match done {
        Ok(done) => say(&format!("{} in {}.", counted(done), args.file.display())),
        Err(failure) => {
            // It may not even have been begun.
            let _ = std::fs::remove_file(&part);
            Err(failure)
        }
    }
}

/// The file that is written until all of it is there.
fn part(file: &Path) -> PathBuf {
    let mut name = file.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    file.with_file_name(name)
}

async fn write(store: &dyn Store, robots: &[BackedUpRobot], part: &Path, bar: &Bar) -> Result<Counted, BackupError> {
    let to = Mutex::new(BufWriter::new(store::disk::create(part)?));
    let put = |line: String| {
        let written = to.lock().unwrap_or_else(PoisonError::into_inner).write_all(line.as_bytes());
        std::future::ready(written)
    };
    let epoch = store.next_epoch().await?;
    let done = store::backup::backup(store, epoch, robots, put, &|done, of| bar.at(done, of)).await?;
    let file = to
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner)
        .into_inner()
        .map_err(std::io::IntoInnerError::into_error)?;
    file.sync_all()?;
    Ok(done)
}

/// Has a backup written by the server that has the store.
async fn fetch(link: &LocalServer, part: &Path) -> Result<Counted, Failure> {
    let unwritten = |error| Failure::unwritten(part, &error);
    let mut file = BufWriter::new(store::disk::create(part).map_err(unwritten)?);
    link.get("/api/backup").await?.copy(&mut file).await?;
    let file = file.into_inner().map_err(|error| unwritten(error.into_error()))?;
    file.sync_all().map_err(unwritten)?;
    let mut written = BufReader::new(File::open(part).map_err(unwritten)?);
    Ok(store::backup::verify(&mut written)?)
}

/// Restores, or says why not.
fn restore(args: &RestoreArgs) -> Result<(), Failure> {
    let unopened = |error| Failure::unopened(&args.file, &error);
    let (file, bar) = (BufReader::new(File::open(&args.file).map_err(unopened)?), Bar::new());
    let done = run(async {
        let (store, url) = (args.at.open_to_fill().await?, args.at.url()?);
        let backup = patience::told(&url, store::backup::read(file, &*store)).await?;
        let (robots, source) = (backup.robots().to_vec(), backup.source(&again(&args.file, &url)));
        let _beside = if robots.is_empty() { None } else { lock_beside(&args.at)? };
        let goes_on = store.filling().await?.is_some();
        let folder = folder_for(&args.at, &robots, goes_on)?;
        let filling = Filling::begin(&store, &source).await?;
        let done = store::backup::restore(backup, &filling, &|done, of| bar.at(done, of)).await?;
        if let Some(folder) = folder {
            let kept = server::put_robots(&folder, &robots).and_then(|()| store::end_in_folder(&folder));
            kept.map_err(unkept)?;
        }
        filling.end().await?;
        Ok(done)
    })?;
    say(&format!("{} from {}.", counted(done), args.file.display()))
}

/// The robots of a backup could not be kept.
fn unkept(error: std::io::Error) -> Failure {
    Failure::of(format!("The data folder cannot be written ({error}). Look at the disk, then do this again."))
}

/// Keeps servers away from the folder beside a store that is elsewhere.
fn lock_beside(at: &StoreArgs) -> Result<Option<FolderLock>, Failure> {
    let (url, folder) = (at.url()?, at.folder());
    let folder = folder.filter(|folder| store::folder_of(&url).is_none_or(|own| !store::is_same_folder(own, folder)));
    Ok(folder.map(|folder| store::lock_folder(&folder)).transpose()?)
}

/// Where the robots go, when the restore goes on or is new.
fn folder_for(at: &StoreArgs, robots: &[BackedUpRobot], goes_on: bool) -> Result<Option<PathBuf>, Failure> {
    let folder = at.folder().filter(|folder| folder.is_dir() || !robots.is_empty());
    match &folder {
        Some(folder) => server::check_robots(folder, robots, goes_on).map_err(Failure::of)?,
        None if robots.is_empty() => {}
        None => return Err(Failure::of("There is no folder for the robots in the backup. Say one with --data DIR.")),
    }
    Ok(folder)
}

/// The command that goes on with a restore.
fn again(file: &Path, url: &str) -> String {
    let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    format!("rrp restore {} --store {}", word(&file.display().to_string()), word(&store::shown_url(url)))
}

/// A word of a command, as a shell reads it.
fn word(text: &str) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || "/._-:@+=%".contains(letter);
    if text.chars().all(is_plain) { text.to_owned() } else { format!("'{}'", text.replace('\'', "'\\''")) }
}

/// Copies, or says why not.
fn migrate(args: &MigrateArgs) -> Result<(), Failure> {
    let bar = Bar::new();
    let (done, differences) = run(async {
        if args.from == args.to {
            return Err(BackupError::Same.into());
        }
        let (from, to) = (open(&args.from).await?, open_to_fill(&args.to).await?);
        let [shown, filled] = [&args.from, &args.to].map(|url| word(&store::shown_url(url)));
        let source = store::source_of(&args.from, &format!("rrp migrate --from {shown} --to {filled}"));
        Ok(store::backup::migrate(&from, &to, &source, &|done, of| bar.at(done, of)).await?)
    })?;
    if !differences.is_empty() {
        return Err(differ(&differences));
    }
    say(&format!("{}; both stores hold the same: revisions, records, histories and bin.", counted(done)))
}

/// In these the copied store differs from the first one.
fn differ(all: &[StoreDifference]) -> Failure {
    let lines: String = all.iter().map(|one| format!("\n  {}: {} differs", one.behaviour, one.what)).collect();
    Failure::of(format!("The stores are not the same. Empty the second one and try again:{lines}"))
}

fn counted(done: Counted) -> String {
    let some = |many: u64, one: &str| format!("{many} {one}{}", if many == 1 { "" } else { "s" });
    format!("{} with {}", some(done.behaviours, "behaviour"), some(done.changes, "change"))
}

fn say(sentence: &str) -> Result<(), Failure> {
    writeln!(std::io::stdout().lock(), "{sentence}").map_err(Failure::of)
}

/// How far it is, on a terminal only.
struct Bar(ProgressBar);

impl Bar {
    fn new() -> Self {
        let target = if std::io::stderr().is_terminal() {
            ProgressDrawTarget::stderr_with_hz(DRAWN_HZ)
        } else {
            ProgressDrawTarget::hidden()
        };
        let bar = ProgressBar::with_draw_target(None, target);
        let style = ProgressStyle::with_template("{wide_bar} {pos} of {len} behaviours, {msg} changes, {elapsed}");
        Self(style.map_or_else(|_| bar.clone(), |style| bar.clone().with_style(style)))
    }

    fn at(&self, done: Counted, of: u64) {
        self.0.set_length(of);
        self.0.set_position(done.behaviours);
        self.0.set_message(done.changes.to_string());
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
