//! The real libqi in a Python process. `cargo xtask test` makes its environment and names it in `RRP_QI_PYTHON`.

use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use qi::{Object, Session, SessionOptions};

const PYTHON: &str = "RRP_QI_PYTHON";
/// The longest time of anything before a test gives up.
const PATIENCE: Duration = Duration::from_secs(60);

/// The Python that has libqi, or nothing, said by name.
///
/// # Panics
/// When there is none and `CI` is `true`, where nothing may be skipped.
pub(crate) fn python(part: &str) -> Option<PathBuf> {
    let found = std::env::var_os(PYTHON).map(PathBuf::from).filter(|path| path.is_file());
    if found.is_none() {
        let line = format!("{part} (no libqi; `cargo xtask test` makes one, or name a Python that has it in {PYTHON})");
        assert!(std::env::var("CI").as_deref() != Ok("true"), "CI skips nothing: {line}");
        let _ = writeln!(std::io::stderr().lock(), "SKIPPED: {line}");
        if let Some(list) = std::env::var_os("RRP_SKIPPED_LIST") {
            let mut file = std::fs::OpenOptions::new().create(true).append(true).open(list).unwrap();
            writeln!(file, "{line}").unwrap();
        }
    }
    found
}

pub(crate) fn script(python: &PathBuf, words: &[&str]) -> Command {
    let mut command = Command::new(python);
    command.arg(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/qi/peer/peer.py")).args(words);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
    command
}

/// A peer that runs until it is dropped.
pub(crate) struct Peer {
    child: Child,
    pub(crate) address: String,
}

impl Peer {
    pub(crate) fn start(python: &PathBuf, words: &[&str]) -> Self {
        let mut child = script(python, words).spawn().unwrap();
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let ready =
            lines.by_ref().map(|line| line.unwrap()).find_map(|line| Some(line.strip_prefix("READY ")?.to_owned()));
        Self { child, address: ready.unwrap() }
    }

    pub(crate) async fn connect(&self) -> Session {
        let options = SessionOptions { stage_within: PATIENCE, call_within: PATIENCE, ..SessionOptions::default() };
        Session::connect(&self.address.parse().unwrap(), options).await.unwrap()
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        let _already_gone = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A session with the real peer and its service `Everything`; the first two are to be kept.
pub(crate) async fn everything(part: &str) -> Option<(Peer, Session, Object)> {
    let peer = Peer::start(&python(part)?, &["host"]);
    let session = peer.connect().await;
    let object = session.service("Everything").await.unwrap();
    Some((peer, session, object))
}
