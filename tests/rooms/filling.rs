//! `rrp migrate`, `rrp restore` and `rrp import` killed (`kill -9`) at many moments, by how far they are: what is half done is
//! not served, and the same command goes on to its end.

use crate::neo4j;
use behaviour::{Behaviour, Change, Committed, Helper, Id, Kind, Note, Record, RecordId, Settings};
use house::skip;
use std::future::Future;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};
use store::{LIBRARY, Query, Store, backup::compare};

type Outcome<T> = Result<T, Box<dyn std::error::Error + Send + Sync>>;

/// Behaviours in the first store, and changes of each.
const BEHAVIOURS: usize = 60;
const CHANGES: u64 = 10;
/// Moments at which a command is killed.
const KILLS: u64 = 8;
const KILLS_ON_NEO4J: u64 = 3;
/// How long a command may take: a guard, however busy the machine is.
const COMMAND_MAX: Duration = Duration::from_secs(120);

fn id(text: &str) -> Id {
    Id::new(text).expect("an id")
}

/// A library, and behaviours with a history, one of them in the bin.
async fn fill(store: &dyn Store) -> Outcome<()> {
    let helper = Helper { name: "near".into(), body: "1".into(), ..Helper::default() };
    save(store, LIBRARY, 1, RecordId::new(Kind::Helper, &id("h")), Record::Helper(helper)).await?;
    for at in 0..BEHAVIOURS {
        let name = format!("b{at}");
        save(store, &name, 1, RecordId::settings(), Record::Settings(Settings::named(&name))).await?;
        for revision in 2..=CHANGES {
            let key = RecordId::new(Kind::Note, &id(&format!("n{revision}")));
            save(store, &name, revision, key, Record::Note(Note::new("note ".repeat(50)))).await?;
        }
    }
    store.remove(&id("b7"), 7, "Aiko").await?;
    Ok(())
}

async fn save(store: &dyn Store, to: &str, revision: u64, key: RecordId, record: Record) -> Outcome<()> {
    let mut now = store.load(&id(to)).await?.map_or_else(Behaviour::default, |loaded| loaded.behaviour);
    let change = Change::of(id(&format!("{to}-{revision}")), "Aiko", "Edit").put(&now, key, record);
    now.apply(&change);
    store.append(&id(to), &Committed { revision, change }, &now).await?;
    Ok(())
}

fn rrp(args: &[&str]) -> Command {
    let mut command = Command::new(house::server());
    command.args(args).env_remove("RRP_STORE").stdin(Stdio::null());
    command
}

fn done(args: &[&str]) -> Outcome<Output> {
    Ok(rrp(args).output()?)
}

fn fine(args: &[&str]) -> Outcome<String> {
    let output = done(args)?;
    let said = [&output.stdout[..], &output.stderr].concat();
    let said = String::from_utf8_lossy(&said).into_owned();
    if output.status.success() { Ok(said) } else { Err(format!("{args:?}: {said}").into()) }
}

/// Kills a command as soon as it is so far; says whether it was not at its end before.
async fn killed<F: Future<Output = u64>>(args: &[&str], far: impl Fn() -> F, wanted: u64) -> Outcome<bool> {
    let mut child = rrp(args).stdout(Stdio::null()).stderr(Stdio::null()).spawn()?;
    let began = Instant::now();
    while far().await < wanted {
        if child.try_wait()?.is_some() {
            return Ok(false);
        }
        if began.elapsed() > COMMAND_MAX {
            child.kill()?;
            return Err(format!("{args:?} does not get so far").into());
        }
        tokio::time::sleep(Duration::from_micros(300)).await;
    }
    let was_under_way = child.try_wait()?.is_none();
    child.kill()?;
    child.wait()?;
    Ok(was_under_way)
}

/// How many bytes a folder holds, which grow with every change.
fn bytes_in(folder: &Path) -> u64 {
    let Ok(entries) = std::fs::read_dir(folder) else { return 0 };
    entries.flatten().filter_map(|entry| Some(entry.metadata().ok()?.len())).sum()
}

/// Every command that takes a store for the whole refuses, and says how to go on.
fn refused(at: &[&str], again: &str) -> Outcome<()> {
    let file = house::folder()?;
    let file = file.path().join("x").display().to_string();
    let commands: [&[&str]; 3] = [&["serve", "--listen", "127.0.0.1:0"], &["backup", &file], &["export", "b1"]];
    for command in commands {
        let output = done(&[command, at].concat())?;
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        if output.status.success() || !said.contains("did not come to its end") || !said.contains(again) {
            return Err(format!("{command:?} on a part: {said}").into());
        }
    }
    Ok(())
}

async fn same(one: &str, other: &str) -> Outcome<()> {
    let (one, other) = (store::open_url(one).await?, store::open_url(other).await?);
    let differences = compare(&*one, &*other).await?;
    if differences.is_empty() { Ok(()) } else { Err(format!("{differences:?}").into()) }
}

/// Kills a command that fills a fresh folder at many moments; each time a part is refused, and the same command finishes it.
async fn killed_at_many_moments(
    first: &str,
    kind: &str,
    args: impl Fn(&str) -> Vec<String>,
    again: &str,
) -> Outcome<()> {
    let room = house::folder()?;
    let fill = |folder: &Path| (format!("{kind}{}", folder.display()), folder.to_owned());
    let (whole, folder) = fill(&room.path().join("whole"));
    fine(&texts(&args(&whole)))?;
    let (total, mut halves) = (bytes_in(&folder), 0);
    for kill in 0..KILLS {
        let (url, folder) = fill(&room.path().join(format!("k{kill}")));
        let wanted = 1 + total * kill / KILLS;
        let far = || std::future::ready(bytes_in(&folder));
        let data = room.path().join("beside").display().to_string();
        if killed(&texts(&args(&url)), far, wanted).await? && store::open_url(&url).await.is_err() {
            halves += 1;
            refused(&["--store", &url, "--data", &data], again)?;
            let other = room.path().join("other").display().to_string();
            fine(&["import", &template("greeter"), "--data", &other])?;
            let no = done(&["migrate", "--from", &other, "--to", &url])?;
            let said = String::from_utf8_lossy(&no.stderr).into_owned();
            assert!(!no.status.success() && said.contains(again), "another source: {said}");
        }
        fine(&texts(&args(&url)))?;
        same(first, &url).await?;
    }
    println!("{kind}: {halves} of {KILLS} kills left a part");
    assert!(halves * 2 > KILLS, "only {halves} of {KILLS} kills were in time");
    Ok(())
}

fn texts(args: &[String]) -> Vec<&str> {
    args.iter().map(String::as_str).collect()
}

fn template(name: &str) -> String {
    house::root().join(format!("tests/behaviours/{name}.json")).display().to_string()
}

fn owned(args: &[&str]) -> Vec<String> {
    args.iter().map(|arg| (*arg).to_owned()).collect()
}

#[tokio::test]
async fn a_killed_migration_is_no_store_until_it_is_done_again() -> Outcome<()> {
    skip::unless!(served("rooms: kills of a migration"));
    let room = house::folder()?;
    let (sqlite, files) = (room.path().join("sqlite"), room.path().join("files"));
    let sqlite = format!("sqlite:{}", sqlite.display());
    fill(&*store::open_url(&sqlite).await?).await?;
    let files = format!("files:{}", files.display());
    fine(&["migrate", "--from", &sqlite, "--to", &files])?;
    for (from, kind) in [(&sqlite, "files:"), (&files, "sqlite:")] {
        let args = |to: &str| owned(&["migrate", "--from", from, "--to", to]);
        killed_at_many_moments(from, kind, args, &format!("rrp migrate --from {from} --to {kind}")).await?;
    }
    Ok(())
}

#[tokio::test]
async fn a_killed_restore_is_no_store_until_it_is_done_again() -> Outcome<()> {
    skip::unless!(served("rooms: kills of a restore"));
    let room = house::folder()?;
    let first = room.path().join("first").display().to_string();
    fill(&*store::open_url(&first).await?).await?;
    let file = room.path().join("monday.rrpbackup").display().to_string();
    fine(&["backup", &file, "--data", &first])?;
    for kind in ["files:", "sqlite:"] {
        let data = room.path().join("robots").display().to_string();
        let args = |to: &str| owned(&["restore", &file, "--store", to, "--data", &data]);
        killed_at_many_moments(&first, kind, args, &format!("rrp restore {file} --store {kind}")).await?;
    }
    Ok(())
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_second_server_on_a_neo4j_sees_that_it_is_only_filled_in_part() -> Outcome<()> {
    let part = "rooms: kills of a migration into Neo4j";
    skip::unless!(served(part));
    let Some(parts) = neo4j::folder(part) else { return Ok(()) };
    let neo4j = neo4j::Neo4j::start(parts);
    let room = house::folder()?;
    let first = room.path().join("first").display().to_string();
    fill(&*store::open_url(&first).await?).await?;
    let (url, data) = (neo4j.url(), room.path().join("beside").display().to_string());
    let (to, mut halves) = (store::open_url_to_work(&url).await?, 0);
    let far = || async {
        let query = Query::default();
        to.list(&query).await.map_or(0, |listing| listing.total)
    };
    let args = ["migrate", "--from", &first, "--to", &url];
    for kill in 0..KILLS_ON_NEO4J {
        if killed(&args, far, 1 + BEHAVIOURS as u64 * kill / KILLS_ON_NEO4J).await? {
            halves += 1;
            let again = format!("rrp migrate --from sqlite:{first} --to bolt://neo4j@");
            refused(&["--store", &url, "--data", &data], &again)?;
            assert!(to.reachable().await.is_err(), "a server that was here before is told too");
        }
    }
    fine(&args)?;
    same(&first, &url).await?;
    to.reachable().await?;
    assert!(halves > 0, "no kill was in time");
    Ok(())
}

/// Each file is a program of its own: those that were brought are whole and stay, and the same command brings the others only.
#[tokio::test]
async fn a_killed_import_of_many_goes_on_and_brings_nothing_twice() -> Outcome<()> {
    skip::unless!(served("rooms: kills of an import"));
    let room = house::folder()?;
    let names = ["greeter", "goodbye", "hello_once", "say_ball_color", "track_nearest_arm", "count_my_touches"];
    let files: Vec<String> = names.iter().map(|name| template(name)).chain([template("greeter")]).collect();
    let listed = async |folder: &Path| -> Outcome<Vec<String>> {
        let store = store::open_url(&folder.display().to_string()).await?;
        let mut names: Vec<_> = store.list(&Query::default()).await?.lines.into_iter().map(|line| line.name).collect();
        names.sort();
        Ok(names)
    };
    let args = |folder: &Path| [owned(&["import", "--data", &folder.display().to_string()]), files.clone()].concat();
    let whole = room.path().join("whole");
    fine(&texts(&args(&whole)))?;
    let (all, mut halves) = (listed(&whole).await?, 0);
    assert_eq!(all.len(), files.len(), "{all:?}");
    for brought in 1..files.len() {
        let folder = room.path().join(format!("k{brought}"));
        let mut child = rrp(&texts(&args(&folder))).stdout(Stdio::piped()).stderr(Stdio::null()).spawn()?;
        let mut told = BufReader::new(child.stdout.take().ok_or("no output")?).lines();
        let told = told.by_ref().take(brought).count();
        child.kill()?;
        child.wait()?;
        assert_eq!(told, brought);
        halves += usize::from((brought..all.len()).contains(&listed(&folder).await?.len()));
        let said = fine(&texts(&args(&folder)))?;
        assert_eq!(listed(&folder).await?, all, "{said}");
        assert!(said.matches("is here already").count() >= brought, "{said}");
    }
    println!("{halves} of {} kills left some of the programs", files.len() - 1);
    assert!(halves > 0, "no kill was in the middle");
    fine(&texts(&args(&whole)))?;
    assert_eq!(listed(&whole).await?.len(), 2 * all.len(), "whoever wants copies gets them");
    Ok(())
}
