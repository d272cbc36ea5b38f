//! A real Neo4j Community in a process of its own, for tests: it can be killed, stopped, continued and started again.

use std::fs::OpenOptions;
use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::time::Duration;

/// Names the folder that `cargo xtask test` makes, with `lib/` and `neo4j.conf`.
const FOLDER: &str = "RRP_NEO4J";
const PASSWORD: &str = "only for tests";
const MAIN: &str = "Neo4jIt";
/// A start takes four seconds; a busy machine may need far more.
const START_MAX: Duration = Duration::from_secs(180);
const OPENED: [&str; 5] = ["java.nio", "java.io", "java.lang", "java.util.concurrent", "sun.nio.ch"];
/// What `cargo xtask test` has read of its classes beforehand is half of a start. Where that file is not to be used it is not.
const JAVA: [&str; 3] = ["-Xms128m", "-XX:+UseSerialGC", "-XX:SharedArchiveFile=classes.jsa"];
/// Room for a test's behaviours, and code compiled quickly rather than well.
const SMALL: Room =
    Room { java: &["-Xmx512m", "-XX:MaxDirectMemorySize=256m", "-XX:TieredStopAtLevel=1"], page_cache: "64m" };

/// What a Neo4j is given to work with.
#[derive(Clone, Copy)]
pub(crate) struct Room {
    /// Options of the Java machine, its memory above all.
    pub(crate) java: &'static [&'static str],
    /// What it keeps of its files in memory.
    pub(crate) page_cache: &'static str,
}

/// A running Neo4j. It ends when it is dropped, and when this process ends.
pub(crate) struct Neo4j {
    folder: PathBuf,
    home: tempfile::TempDir,
    place: String,
    room: Room,
    child: Child,
}

/// The folder with a Neo4j, if the tests were given one; else says by name that `part` is skipped.
///
/// # Panics
/// If there is none and `CI` is `true`, where nothing may be skipped.
pub(crate) fn folder(part: &str) -> Option<PathBuf> {
    let folder = std::env::var_os(FOLDER).map(PathBuf::from).filter(|folder| folder.join("lib").is_dir());
    if folder.is_none() {
        let why = format!("{FOLDER} names no folder with a Neo4j; `cargo xtask test` makes one");
        assert!(std::env::var("CI").as_deref() != Ok("true"), "{part} cannot run, and CI skips nothing: {why}");
        tell(&format!("{part} ({why})"));
    }
    folder
}

/// Says it past the test runner, which hides what passing tests print, and notes it for `cargo xtask test`.
fn tell(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "SKIPPED: {line}");
    if let Some(list) = std::env::var_os("RRP_SKIPPED_LIST")
        && let Ok(mut file) = OpenOptions::new().create(true).append(true).open(list)
    {
        let _ = writeln!(file, "{line}");
    }
}

impl Neo4j {
    /// Starts an empty one on a free port, and waits until it answers.
    ///
    /// # Panics
    /// If it does not start.
    pub(crate) fn start(folder: PathBuf) -> Self {
        Self::start_in(folder, SMALL)
    }

    /// The same with this room.
    pub(crate) fn start_in(folder: PathBuf, room: Room) -> Self {
        let home = tempfile::tempdir().expect("a folder for Neo4j");
        let (child, place) = launch(&folder, &home, "127.0.0.1:0", room);
        Self { folder, home, place, room, child }
    }

    /// Where it listens: `127.0.0.1:41234`.
    pub(crate) fn place(&self) -> &str {
        &self.place
    }

    /// The address for a store, with the password.
    pub(crate) fn url(&self) -> String {
        format!("bolt://neo4j:{}@{}", PASSWORD.replace(' ', "%20"), self.place)
    }

    /// The password of the user `neo4j`.
    pub(crate) fn password(&self) -> &'static str {
        PASSWORD
    }

    /// Ends it at once, as a power cut would.
    pub(crate) fn kill(&mut self) {
        self.child.kill().expect("to kill Neo4j");
        self.child.wait().expect("its end");
    }

    /// Holds it: it takes connections, but says nothing.
    pub(crate) fn hold(&self) {
        self.signal("-STOP");
    }

    /// Lets it go on.
    pub(crate) fn go_on(&self) {
        self.signal("-CONT");
    }

    /// Starts it again with the same data at the same place, after [`Neo4j::kill`].
    pub(crate) fn start_again(&mut self) {
        (self.child, _) = launch(&self.folder, &self.home, &self.place, self.room);
    }

    fn signal(&self, signal: &str) {
        let sent = Command::new("kill").args([signal, &self.child.id().to_string()]).status();
        assert!(sent.is_ok_and(|status| status.success()), "the signal {signal} was not sent");
    }
}

impl Drop for Neo4j {
    fn drop(&mut self) {
        let _already_gone = self.child.kill();
        let _ = self.child.wait();
    }
}

fn launch(folder: &std::path::Path, home: &tempfile::TempDir, place: &str, room: Room) -> (Child, String) {
    let mut java = Command::new("java");
    java.args(JAVA).args(room.java).args(OPENED.map(|package| format!("--add-opens=java.base/{package}=ALL-UNNAMED")));
    java.args(["-cp", "lib/*", MAIN]).arg(home.path()).arg("neo4j.conf");
    java.arg(format!("server.memory.pagecache.size={}", room.page_cache));
    java.arg(format!("server.bolt.listen_address={place}")).env("NEO4J_PASSWORD", PASSWORD).current_dir(folder);
    // It ends when its input ends; so it never outlives us.
    let mut child = java.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("java");
    let lines = BufReader::new(child.stdout.take().expect("its output")).lines().map_while(Result::ok);
    let (ready, waiting) = mpsc::channel();
    std::thread::spawn(move || {
        for line in lines {
            let _nobody_waits_any_more = line.strip_prefix("READY ").map(|place| ready.send(place.to_owned()));
        }
    });
    let place = waiting.recv_timeout(START_MAX);
    if place.is_err() {
        let _ = child.kill();
    }
    (child, place.expect("Neo4j starts; run it by hand to see why not"))
}
