//! The stand-in as a process, and what tests ask of it.

use qi::{Object, Session, SessionOptions};
use serde_json::{Value as Json, json};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// The longest that anything may take before a test gives up.
pub(crate) const PATIENCE: Duration = Duration::from_secs(60);
/// Pause between two looks at what it says.
pub(crate) const PAUSE: Duration = Duration::from_millis(10);

/// A robot that is not one; it ends when this is dropped.
pub(crate) struct Peer {
    child: Child,
    /// Where it is: `127.0.0.1:PORT`.
    pub(crate) address: String,
    session: Session,
    standin: Object,
}

impl Peer {
    /// Starts one, unless there is no libqi, which is said by name as `part`.
    pub(crate) async fn start(part: &str, words: &[&str]) -> Option<Self> {
        let python = std::env::var_os("RRP_QI_PYTHON").map(PathBuf::from).filter(|path| path.is_file());
        let Some(python) = python else {
            let says =
                format!("SKIPPED: {part}: there is no libqi; `cargo xtask qi` makes one, and RRP_QI_PYTHON names it");
            assert!(std::env::var("CI").as_deref() != Ok("true"), "{says}");
            let _ = writeln!(std::io::stderr(), "{says}");
            return None;
        };
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/standin/nao.py");
        let mut command = Command::new(python);
        command.arg(script).args(words).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        let line = BufReader::new(child.stdout.take().unwrap()).lines().next().unwrap().unwrap();
        let address = line.strip_prefix("listening tcp://").unwrap().to_owned();
        let options = SessionOptions { stage_within: PATIENCE, call_within: PATIENCE, ..SessionOptions::default() };
        let session = Session::connect(&format!("tcp://{address}").parse().unwrap(), options).await.unwrap();
        let standin = session.service("StandIn").await.unwrap();
        Some(Self { child, address, session, standin })
    }

    pub(crate) fn port(&self) -> &str {
        self.address.rsplit(':').next().unwrap()
    }

    async fn tell(&self, method: &str, what: Json) {
        self.standin.call(method, &[what.to_string().into()]).await.unwrap();
    }

    pub(crate) async fn world(&self, change: Json) {
        self.tell("world", change).await;
    }

    pub(crate) async fn fault(&self, fault: Json) {
        self.tell("fault", fault).await;
    }

    pub(crate) async fn state(&self) -> Json {
        serde_json::from_str(&self.standin.call("state", &[]).await.unwrap().as_text().unwrap()).unwrap()
    }

    /// Waits until it is so.
    pub(crate) async fn until(&self, what: &str, is_so: impl Fn(&Json) -> bool) -> Json {
        let waiting = async {
            loop {
                let state = self.state().await;
                if is_so(&state) {
                    return state;
                }
                tokio::time::sleep(PAUSE).await;
            }
        };
        tokio::time::timeout(PATIENCE, waiting).await.unwrap_or_else(|_| panic!("never: {what}"))
    }

    /// Every call of a method so far: its arguments.
    pub(crate) async fn calls(&self, method: &str) -> Vec<Json> {
        let all: Json =
            serde_json::from_str(&self.standin.call("calls", &[]).await.unwrap().as_text().unwrap()).unwrap();
        let is_it = |call: &&Json| {
            format!("{}.{}", call["service"].as_str().unwrap(), call["method"].as_str().unwrap()) == method
        };
        all.as_array().unwrap().iter().filter(is_it).map(|call| call["args"].clone()).collect()
    }

    /// Every call after the one of that number.
    pub(crate) async fn calls_since(&self, seq: i32) -> Vec<Json> {
        let told = self.standin.call("calls_since", &[seq.into()]).await.unwrap();
        serde_json::from_str(&told.as_text().unwrap()).unwrap()
    }

    pub(crate) async fn clear(&self) {
        self.standin.call("clear", &[]).await.unwrap();
    }

    /// Pauses what hears words.
    pub(crate) async fn pause_hearing(&self) {
        let hearing = self.session.service("ALSpeechRecognition").await.unwrap();
        hearing.call("pause", &[true.into()]).await.unwrap();
    }

    /// It keeps something in its memory.
    pub(crate) async fn remember(&self, key: &str, value: &str) {
        let memory = self.session.service("ALMemory").await.unwrap();
        memory.call("insertData", &[key.into(), qi::Value::dynamic(value)]).await.unwrap();
    }

    /// Returns what it keeps in its memory under names with this in them.
    pub(crate) async fn remembers(&self, part: &str) -> Vec<String> {
        let memory = self.session.service("ALMemory").await.unwrap();
        let keys = memory.call("getDataList", &[part.into()]).await.unwrap();
        keys.items().unwrap().iter().map(|key| key.as_text().unwrap().into_owned()).collect()
    }

    /// Something measures for whoever subscribed by this name.
    pub(crate) async fn subscribe(&self, service: &str, name: &str) {
        let measures = self.session.service(service).await.unwrap();
        measures.call("subscribe", &[name.into()]).await.unwrap();
    }

    /// Nothing was ever done that makes a robot fall.
    pub(crate) async fn was_safe(&self) {
        assert_eq!(self.state().await["violations"], json!([]));
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        let _already_gone = self.child.kill();
        let _ = self.child.wait();
    }
}
