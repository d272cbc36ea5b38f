//! The optimised server under attack, by everything that once took Stop away from everyone: each attack alone, then all
//! at once. While it goes on Stop is pressed again and again, over HTTP and over a socket; afterwards the server's memory
//! is back, and somebody can come in and edit as if nothing had been.

#![expect(clippy::print_stdout, reason = "what was measured is for whoever runs it with --nocapture")]

mod connections;
mod downloads;
mod full_disk;
mod log;
mod messages;
mod robots;
mod shares;
mod stops;
mod target;

use futures_util::future::BoxFuture;
use house::{Outcome, Server, skip};
use std::fmt::Write as _;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use stops::Stops;
use target::{Attackers, Target};

/// Stops by each way under each attack.
const STOPS: usize = 300;
/// What 99 of 100 Stops may take, in milliseconds.
const STOP_P99_MS: u128 = 50;
/// What any of them may take, in milliseconds.
const STOP_WORST_MS: u128 = 250;
/// An attack is measured again so often if the computer was busy with something else.
const TRIES: usize = 3;
/// What the server may take beyond what it takes at rest, in KiB.
const MORE_MAX_KIB: u64 = 200 << 10;
/// How soon it has to be given back.
const BACK: Duration = Duration::from_secs(30);
/// What counts as given back, in KiB beyond the rest: what an allocator keeps for the next time.
const KEPT_KIB: u64 = 100 << 10;

/// An attack, which goes on until it is dropped.
type Attack = fn(Target) -> BoxFuture<'static, ()>;

const ATTACKS: [(&str, Attack); 12] = [
    ("proposals that are slow to check", |target| Box::pin(messages::procedures(target))),
    ("requests as fast as they go", |target| Box::pin(messages::floods(target))),
    ("actions by hand as fast as they go", |target| Box::pin(messages::hands(target))),
    ("sockets that ask and never read", |target| Box::pin(messages::unread(target))),
    ("behaviours that are opened and never read", |target| Box::pin(messages::openers(target))),
    ("sockets that never greet", |target| Box::pin(connections::half_open(target))),
    ("connections that are held", |target| Box::pin(connections::held(target))),
    ("a thousand Stops at once", |target| Box::pin(connections::storm(target))),
    ("downloads that nobody reads", |target| Box::pin(downloads::unread(target))),
    ("imports that are slow to read", |target| Box::pin(downloads::imports(target))),
    ("a library that grows without end", |target| Box::pin(messages::growth(target))),
    ("robots that lie", |target| Box::pin(robots::lying(target))),
];

/// Held by a test that measures: one attacks at a time, or each would measure the others too.
fn alone() -> MutexGuard<'static, ()> {
    static ONE: Mutex<()> = Mutex::new(());
    ONE.lock().unwrap_or_else(PoisonError::into_inner)
}

#[test]
fn stop_is_heard_and_memory_stays_under_every_attack() -> Outcome<()> {
    skip::unless!(optimised("attacks on the optimised server"));
    let _alone = alone();
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    runtime.block_on(async {
        let folder = house::folder()?;
        downloads::prepare(folder.path())?;
        let server = Server::start_binary(&house::optimised(), folder.path(), &[]).await?;
        let target = Target::of(&server)?;
        downloads::fill(&target).await?;
        let mut report = String::new();
        for (name, attack) in ATTACKS {
            under(&target, name, &[attack], &mut report).await?;
        }
        under(&target, "all of these at once", &ATTACKS.map(|(_, attack)| attack), &mut report).await?;
        println!("{report}");
        Ok(())
    })
}

#[test]
fn a_log_that_nobody_reads_stops_nothing() -> Outcome<()> {
    skip::unless!(optimised("a log that nobody reads"));
    let _alone = alone();
    tokio::runtime::Builder::new_current_thread().enable_all().build()?.block_on(log::unread())
}

/// Built as `cargo xtask serve` builds it, which is how it is attacked here.
#[test]
fn a_server_built_without_neo4j_says_so() -> Outcome<()> {
    skip::unless!(optimised("a server without Neo4j"));
    let asked = ["serve", "--listen", "127.0.0.1:0", "--store", "bolt://neo4j@127.0.0.1:1"];
    let said = std::process::Command::new(house::optimised()).args(asked).output()?;
    let words = String::from_utf8_lossy(&said.stderr);
    assert!(!said.status.success() && words.contains("built without Neo4j") && words.contains("--store"), "{words}");
    Ok(())
}

/// Measures under attacks, at most so often until what was promised is seen.
async fn under(target: &Target, name: &str, attacks: &[Attack], report: &mut String) -> Outcome<()> {
    let rest_kib = target.memory_kib()?;
    let mut sentence = String::new();
    for _ in 0..TRIES {
        let attackers = Attackers::start(target, attacks)?;
        let measured = stops::measure(target, STOPS)?;
        let more_kib = target.most_memory_kib()?.saturating_sub(rest_kib);
        drop(attackers);
        let back = back(target, rest_kib).await.map_err(|error| format!("After {name}: {error}"))?;
        target.still_works().await?;
        sentence = format!("{name}: {measured}, {} MiB more, back after {} s", more_kib >> 10, back.as_secs());
        if measured.kept() && more_kib <= MORE_MAX_KIB {
            writeln!(report, "{sentence}")?;
            return Ok(());
        }
        println!("again, after {sentence}");
    }
    Err(format!("Under attack by {sentence}; promised are {STOP_P99_MS} and {STOP_WORST_MS} ms, and 200 MiB.").into())
}

impl Stops {
    fn kept(&self) -> bool {
        self.each().iter().all(|ms| ms.p99 <= STOP_P99_MS && ms.worst <= STOP_WORST_MS)
    }
}

/// How long it takes until the memory is given back. People go on working meanwhile: what a thread's allocator keeps it gives
/// back as that thread does something again.
async fn back(target: &Target, rest_kib: u64) -> Outcome<Duration> {
    let began = Instant::now();
    while target.memory_kib()? > rest_kib + KEPT_KIB {
        if began.elapsed() > BACK {
            let kib = target.memory_kib()?;
            return Err(format!("The server keeps {} MiB, {} at rest.", kib >> 10, rest_kib >> 10).into());
        }
        target.still_works().await?;
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    Ok(began.elapsed())
}
