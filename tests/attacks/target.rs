//! The server that is attacked, and the attackers: on threads that give way to everything else, as those of another
//! computer would.

use crate::Attack;
use behaviour::{Behaviour, Id, Kind, Note, Record, RecordId};
use house::{Outcome, Server};
use protocol::request;
use shell::Client;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread::JoinHandle;
use tokio_util::sync::CancellationToken;

/// Where the server is.
#[derive(Clone)]
pub(crate) struct Target {
    pub(crate) address: SocketAddr,
    process: PathBuf,
}

impl Target {
    pub(crate) fn of(server: &Server) -> Outcome<Target> {
        let process = server.id().ok_or("The server is not running.")?;
        Ok(Target::at(server.address().parse()?, process))
    }

    /// A process that was started elsewhere.
    pub(crate) fn at(address: SocketAddr, process: u32) -> Target {
        Target { address, process: format!("/proc/{process}").into() }
    }

    pub(crate) fn url(&self) -> String {
        format!("http://{}/", self.address)
    }

    /// What the server takes of the memory now.
    pub(crate) fn memory_kib(&self) -> Outcome<u64> {
        self.status("VmRSS:")
    }

    /// The most that it took since the last question.
    pub(crate) fn most_memory_kib(&self) -> Outcome<u64> {
        let most = self.status("VmHWM:")?;
        std::fs::write(self.process.join("clear_refs"), "5")?;
        Ok(most)
    }

    /// How many threads the server has.
    pub(crate) fn threads(&self) -> Outcome<u64> {
        self.status("Threads:")
    }

    fn status(&self, name: &str) -> Outcome<u64> {
        let status = std::fs::read_to_string(self.process.join("status"))?;
        let line = status.lines().find_map(|line| line.strip_prefix(name)).ok_or("The process does not tell.")?;
        Ok(line.trim().trim_end_matches("kB").trim().parse()?)
    }

    /// Somebody comes in and edits.
    pub(crate) async fn still_works(&self) -> Outcome<()> {
        let aiko = Client::connect(&self.url(), "Aiko").await?;
        let behaviour = made(&aiko, "Afterwards").await?;
        aiko.load(&behaviour).await?;
        aiko.put("Note", note_id(&fresh("n")), Some(note("Still here"))).await?;
        Ok(())
    }
}

/// A new behaviour.
pub(crate) async fn made(client: &Client, name: &str) -> Outcome<Id> {
    let behaviour = fresh("b");
    let create = request::Create { behaviour: behaviour.clone(), name: name.to_owned(), template: None };
    Ok(client.ask(create).await?.behaviour)
}

/// A name that nothing else has.
pub(crate) fn fresh(what: &str) -> Id {
    static LAST: AtomicU64 = AtomicU64::new(0);
    let number = LAST.fetch_add(1, Ordering::Relaxed);
    Id::new(&format!("{what}-{}-{number}", std::process::id())).unwrap_or_else(|_| unreachable!("it is an id"))
}

pub(crate) fn note_id(id: &Id) -> RecordId {
    RecordId::new(Kind::Note, id)
}

pub(crate) fn note(text: &str) -> Record {
    Record::Note(Note::new(text.to_owned()))
}

/// The records of a change that puts something where nothing was.
pub(crate) fn nothing() -> Behaviour {
    Behaviour::default()
}

/// Attacks that go on until this is dropped.
pub(crate) struct Attackers {
    until: CancellationToken,
    thread: Option<JoinHandle<()>>,
}

impl Attackers {
    pub(crate) fn start(target: &Target, attacks: &[Attack]) -> Outcome<Attackers> {
        let (until, target, attacks) = (CancellationToken::new(), target.clone(), attacks.to_vec());
        target.most_memory_kib()?;
        let ending = until.clone();
        let thread = std::thread::spawn(move || give_way_and(target, &attacks, &ending));
        // So that the attack is under way when the first Stop is pressed.
        std::thread::sleep(std::time::Duration::from_millis(500));
        Ok(Attackers { until, thread: Some(thread) })
    }
}

fn give_way_and(target: Target, attacks: &[Attack], until: &CancellationToken) {
    #[cfg(target_os = "linux")]
    let _as_it_was = rustix::process::setpriority_process(Some(rustix::thread::gettid()), 19);
    let Ok(runtime) = tokio::runtime::Builder::new_current_thread().enable_all().build() else { return };
    runtime.block_on(async {
        for attack in attacks {
            tokio::spawn(attack(target.clone()));
        }
        until.cancelled().await;
    });
}

impl Drop for Attackers {
    fn drop(&mut self) {
        self.until.cancel();
        if let Some(thread) = self.thread.take() {
            drop(thread.join());
        }
    }
}
