//! How the real program starts: on full disks, on folders in use, beside stores elsewhere, with a database that is silent,
//! and on what a restore left half done.
#![cfg(target_os = "linux")]

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// How long anything may take.
const PATIENCE: Duration = Duration::from_secs(60);
/// While a file of this name is in the data folder, the disk is full.
const FULL: &str = "full";

fn rrp(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rrp"));
    command.args(args).env_remove("RRP_STORE");
    command
}

fn done(args: &[&str]) -> Output {
    rrp(args).output().expect("rrp starts")
}

fn fine(args: &[&str]) -> String {
    let done = done(args);
    assert!(done.status.success(), "{args:?}: {}", String::from_utf8_lossy(&done.stderr));
    String::from_utf8(done.stdout).expect("UTF-8")
}

/// Why it did not work.
fn refused(args: &[&str]) -> String {
    let done = done(args);
    assert!(!done.status.success(), "{args:?}");
    String::from_utf8(done.stderr).expect("UTF-8")
}

fn text(path: &Path) -> String {
    path.display().to_string()
}

fn template(name: &str) -> String {
    format!("{}/../../tests/behaviours/{name}.json", env!("CARGO_MANIFEST_DIR"))
}

/// Waits until something is so.
fn until(what: &str, mut is_so: impl FnMut() -> bool) {
    let began = Instant::now();
    while !is_so() {
        assert!(began.elapsed() < PATIENCE, "never: {what}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

/// A library that makes the disk of a data folder full while [`FULL`] is in it.
fn full_disk(room: &Path) -> PathBuf {
    let library = room.join("disk_full.so");
    let source = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/journeys/disk_full.c");
    let built = Command::new("cc").args(["-shared", "-fPIC", "-o"]).arg(&library).arg(source).arg("-ldl").status();
    assert!(built.expect("a C compiler").success());
    library
}

/// A server that ends with the test.
struct Server {
    child: Child,
    url: String,
}

impl Server {
    fn start(args: &[&str]) -> Self {
        Self::of(rrp(&[&["serve", "--listen", "127.0.0.1:0"], args].concat()))
    }

    /// On a data folder whose disk can be full.
    fn on_a_disk(library: &Path, data: &Path) -> Self {
        let mut command = rrp(&["serve", "--listen", "127.0.0.1:0", "--data", &text(data)]);
        command.env("LD_PRELOAD", library).env("RRP_FULL", data.join(FULL));
        Self::of(command)
    }

    fn of(mut command: Command) -> Self {
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::inherit()).spawn().expect("rrp starts");
        let mut line = String::new();
        BufReader::new(child.stdout.take().expect("a pipe")).read_line(&mut line).expect("a line");
        let url = line.trim().strip_prefix("rrp is ready: ").map(str::to_owned);
        if url.is_none() {
            drop(child.kill());
        }
        Self { child, url: url.expect("it is ready") }
    }

    /// What the console says to these lines, refusals included.
    fn console(&self, lines: &str) -> String {
        let mut command = rrp(&["shell", &self.url]);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("rrp starts");
        child.stdin.take().expect("a pipe").write_all(lines.as_bytes()).expect("written");
        let done = child.wait_with_output().expect("it ends");
        String::from_utf8([done.stdout, done.stderr].concat()).expect("UTF-8")
    }

    fn asked(&self, method: &str, path: &str) -> String {
        self.sent(method, path, "")
    }

    /// What it answers to a behaviour that is brought.
    fn brought(&self, name: &str) -> String {
        self.sent("POST", "/api/import", &std::fs::read_to_string(template(name)).expect("a template"))
    }

    fn sent(&self, method: &str, path: &str, body: &str) -> String {
        let address = self.url.trim_start_matches("http://").trim_end_matches('/');
        let mut stream = TcpStream::connect(address).expect("it listens");
        let key = host_key::of_server(address.parse().expect("an address")).expect("a key");
        let key = format!("{}: {}", host_key::HEADER, host_key::header(&key));
        let head = format!("{method} {path} HTTP/1.0\r\nHost: {address}\r\nOrigin: http://{address}\r\n{key}\r\n");
        let whole = format!("{head}Content-Length: {}\r\n\r\n{body}", body.len());
        stream.write_all(whole.as_bytes()).expect("sent");
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("an answer");
        answer
    }

    fn signal(&mut self, signal: &str) {
        let sent = Command::new("kill").args([signal, &self.child.id().to_string()]).status();
        assert!(sent.expect("kill starts").success());
        self.child.wait().expect("its end");
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        drop(self.child.kill());
        drop(self.child.wait());
    }
}

/// A data folder with a behaviour, left by a server that ended so.
fn left_by(library: &Path, data: &Path, signal: &str) {
    let mut server = Server::on_a_disk(library, data);
    fine(&["import", &template("greeter"), "--data", &text(data)]);
    server.signal(signal);
}

#[test]
fn a_start_on_a_full_disk_serves_for_reading_and_saves_again_once_there_is_room() {
    let room = tempfile::tempdir().expect("a folder");
    let library = full_disk(room.path());
    for signal in ["-KILL", "-TERM"] {
        let data = room.path().join(signal);
        left_by(&library, &data, signal);
        std::fs::write(data.join(FULL), "").expect("to fill the disk");
        let mut server = Server::on_a_disk(&library, &data);
        let said = server.console("show programs\nload program Greeter\nshow streams\n");
        assert!(said.contains("Greeter") && !said.contains("refused"), "{said}");
        let exported = server.asked("GET", "/api/behaviours");
        assert!(exported.contains("200 OK") && exported.contains("Greeter"), "{exported}");
        assert!(server.asked("POST", "/stop").contains("\"stopped\":true"));
        assert!(server.asked("GET", "/api/backup").contains("\"end\""));
        let refused = server.brought("track_nearest_arm");
        assert!(refused.contains("The disk is full"), "{refused}");
        assert!(server.asked("GET", "/readyz").contains("The disk is full"));

        std::fs::remove_file(data.join(FULL)).expect("to make room");
        until("it can save again", || server.asked("GET", "/readyz").contains("200 OK"));
        until("a behaviour is saved", || server.brought("say_ball_color").contains("200 OK"));
        server.signal("-TERM");
        let server = Server::start(&["--data", &text(&data)]);
        let said = server.console("show programs\n");
        assert!(said.contains("Greeter") && said.contains("Say"), "{said}");
    }
}

#[test]
fn a_disk_stays_full_until_there_is_room_for_what_was_refused() {
    let room = tempfile::tempdir().expect("a folder");
    let (library, data) = (full_disk(room.path()), room.path().join("data"));
    let server = Server::on_a_disk(&library, &data);
    fine(&["import", &template("greeter"), "--data", &text(&data)]);
    let log = std::fs::metadata(data.join("rrp.sqlite-wal")).expect("the log").len();
    // Room for some pages more, as a disk has it that just became full.
    std::fs::write(data.join(FULL), (log + 6 * 4_120).to_string()).expect("to fill the disk");
    let no = refused(&["import", &template("track_nearest_arm"), "--data", &text(&data)]);
    assert!(no.contains("The disk is full"), "{no}");
    for look in 0..10 {
        let said = server.asked("GET", "/readyz");
        assert!(said.contains("The disk is full"), "look {look}: {said}");
    }
    std::fs::remove_file(data.join(FULL)).expect("to make room");
    until("it can save again", || server.asked("GET", "/readyz").contains("200 OK"));
}

#[test]
fn on_a_full_disk_nothing_seems_to_be_recorded() {
    let room = tempfile::tempdir().expect("a folder");
    let (library, data) = (full_disk(room.path()), room.path().join("data"));
    left_by(&library, &data, "-TERM");
    let server = Server::on_a_disk(&library, &data);
    std::fs::create_dir_all(data.join("recordings")).expect("to make it");
    // Only the file of the recording has no room.
    let said = server.console("start greeter\nstop greeter\n");
    assert!(said.contains("runs"), "its place in the order is kept now: {said}");
    std::fs::write(data.join(FULL), "").expect("to fill the disk");
    let said = server.console("record on\nstart greeter\n");
    assert!(said.contains("it cannot be recorded") && said.contains("free some space"), "{said}");
    assert_eq!(std::fs::read_dir(data.join("recordings")).expect("to look").count(), 0, "nothing is left of it");
    let said = server.console("start greeter\n");
    assert!(said.contains("runs"), "without recording it runs: {said}");
}

#[test]
fn two_servers_never_share_a_folder() {
    let room = tempfile::tempdir().expect("a folder");
    for (name, kind) in [("one", ""), ("two", "sqlite:"), ("three", "files:")] {
        let folder = room.path().join(name);
        let (url, beside) = (format!("{kind}{}", text(&folder)), text(&room.path().join(format!("beside {name}"))));
        let _server = Server::start(&["--store", &url, "--data", &beside]);
        std::fs::remove_file(folder.join("rrp.lock")).expect("the lock file");
        std::fs::remove_file(Path::new(&beside).join("rrp.lock")).expect("the lock file");
        let serve = ["serve", "--listen", "127.0.0.1:0", "--store"];
        let other = text(&room.path().join("other"));
        let no = refused(&[&serve[..], &[&url, "--data", &other]].concat());
        assert!(no.contains("Another rrp server already uses"), "{no}");
        let no = refused(&[&serve[..], &[&format!("sqlite:{other}"), "--data", &beside]].concat());
        assert!(no.contains("Another rrp server already uses") && no.contains("beside"), "{no}");
    }
}

#[test]
fn robots_and_recordings_are_in_the_folder_beside_a_store_elsewhere() {
    let room = tempfile::tempdir().expect("a folder");
    let (store, data) = (format!("files:{}", text(&room.path().join("files"))), room.path().join("data"));
    let server = Server::start(&["--store", &store, "--data", &text(&data)]);
    fine(&["import", &template("greeter"), "--store", &store, "--data", &text(&data)]);
    let said = server.console("add robot Second\nrecord on\nstart greeter\nstop greeter\n");
    assert!(said.contains("is recorded"), "{said}");
    assert!(data.join("robots.json").is_file() && data.join("robot-orders").is_dir(), "{said}");
    assert_eq!(std::fs::read_dir(data.join("recordings")).expect("to look").count(), 1);
    assert!(!room.path().join("files/robots.json").exists() && !room.path().join("files/recordings").exists());
}

#[test]
fn what_is_kept_is_for_its_user_alone() {
    let room = tempfile::tempdir().expect("a folder");
    let data = room.path().join("data");
    let mode = |path: &Path| std::fs::metadata(path).expect("it is there").permissions().mode() & 0o777;
    let backup = room.path().join("all.rrpbackup");
    std::fs::write(&backup, "an older one that everybody may read").expect("written");
    {
        let server = Server::start(&["--data", &text(&data)]);
        fine(&["import", &template("greeter"), "--data", &text(&data)]);
        server.console("add robot Second\nrecord on\nstart greeter\n");
        fine(&["backup", &text(&backup), "--data", &text(&data)]);
        let files = ["rrp.sqlite", "rrp.sqlite-wal", "rrp.sqlite-shm", "robots.json", "rrp.lock", "server.url"];
        for path in files.map(|name| data.join(name)).iter().chain([&backup]) {
            assert_eq!(mode(path), 0o600, "{}", path.display());
        }
        for path in [&data, &data.join("recordings"), &data.join("robot-orders")] {
            assert_eq!(mode(path), 0o700, "{}", path.display());
            for entry in std::fs::read_dir(path).expect("to look").flatten().filter(|entry| entry.path().is_file()) {
                assert_eq!(mode(&entry.path()), 0o600, "{}", entry.path().display());
            }
        }
    }
    std::fs::set_permissions(&data, PermissionsExt::from_mode(0o755)).expect("to open it");
    std::fs::set_permissions(data.join("rrp.sqlite"), PermissionsExt::from_mode(0o644)).expect("to open it");
    let _server = Server::start(&["--data", &text(&data)]);
    assert_eq!((mode(&data), mode(&data.join("rrp.sqlite"))), (0o700, 0o600), "as older versions left it");
}

#[test]
fn a_backup_brings_robots_and_orders_back_and_half_of_one_is_not_served() {
    let room = tempfile::tempdir().expect("a folder");
    let (data, again) = (room.path().join("data"), room.path().join("again"));
    let [live, still] = ["live", "still"].map(|name| text(&room.path().join(name)));
    {
        let server = Server::start(&["--data", &text(&data)]);
        fine(&["import", &template("greeter"), "--data", &text(&data)]);
        server.console("add robot Second\nuse robot Second\nstart greeter\nstop greeter\n");
        fine(&["backup", &live, "--data", &text(&data)]);
    }
    fine(&["backup", &still, "--data", &text(&data)]);
    let kept = |folder: &Path| {
        let robots = std::fs::read_to_string(folder.join("robots.json")).expect("the robots");
        let orders = std::fs::read_dir(folder.join("robot-orders")).expect("the orders").flatten();
        let mut orders: Vec<_> = orders.map(|entry| std::fs::read_to_string(entry.path()).expect("an order")).collect();
        orders.sort();
        (robots, orders)
    };
    for backup in [&live, &still] {
        drop(std::fs::remove_dir_all(&again));
        std::fs::create_dir_all(&again).expect("to make it");
        std::fs::write(again.join("rrp.restoring"), "").expect("as a restore that was killed leaves it");
        for args in [&["serve", "--listen", "127.0.0.1:0"][..], &["backup", &text(&room.path().join("x"))]] {
            let no = refused(&[args, &["--data", &text(&again)]].concat());
            assert!(no.contains("did not come to its end") && no.contains("rrp restore, with the same backup"), "{no}");
        }
        fine(&["restore", backup, "--data", &text(&again)]);
        assert_eq!(kept(&again), kept(&data));
        fine(&["restore", backup, "--data", &text(&again)]);
    }
    let server = Server::start(&["--data", &text(&again)]);
    let said = server.console("show robots\nshow programs\n");
    assert!(said.contains("Second") && said.contains("Greeter"), "{said}");
    server.console("remove robot Second\n");
    drop(server);
    let no = refused(&["restore", &still, "--data", &text(&again)]);
    assert!(no.contains("Choose an empty folder"), "{no}");
}

#[test]
fn a_database_that_is_silent_is_said_in_the_log() {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let url = format!("bolt://neo4j:secret@{}", listener.local_addr().expect("an address"));
    let (room, held) = (tempfile::tempdir().expect("a folder"), std::thread::spawn(move || listener.accept()));
    let mut command = rrp(&["serve", "--listen", "127.0.0.1:0", "--store", &url, "--data", &text(room.path())]);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("rrp starts");
    let lines = BufReader::new(child.stderr.take().expect("a pipe")).lines().map_while(Result::ok);
    let said = lines.into_iter().find(|line| line.contains("does not answer"));
    drop((child.kill(), child.wait(), held.join()));
    let said = said.expect("a sentence");
    assert!(said.contains("does not answer yet") && !said.contains("secret"), "{said}");
}

#[test]
fn links_that_let_people_in_are_printed_on_a_terminal_only() {
    let data = tempfile::tempdir().expect("a folder");
    let line =
        ["serve", "--listen", "127.0.0.1:0", "--behind-proxy", "https://rrp.example", "--data", &text(data.path())];
    let mut child = rrp(&line).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("rrp starts");
    let mut first = String::new();
    let mut out = BufReader::new(child.stdout.take().expect("its output"));
    out.read_line(&mut first).expect("a line");
    assert!(first.starts_with("rrp is ready: http://127.0.0.1:"), "{first}");
    let opened = fine(&["open", "--data", &text(data.path())]);
    assert!(opened.contains("/come-in#") && opened.contains("http://127.0.0.1:"), "{opened}");
    let invited = fine(&["invite", "--role", "viewer", "--lasts", "day", "--data", &text(data.path())]);
    let links: Vec<&str> = invited.lines().filter(|line| line.starts_with("https://rrp.example/come-in#")).collect();
    assert!(matches!(links[..], [link] if link.len() > 60), "{invited}");
    assert!(invited.contains("look on") && invited.contains("for a day"), "{invited}");
    assert!(!invited.contains('\u{1b}'), "no picture where no terminal is: {invited}");
    child.kill().and_then(|()| child.wait()).expect("it ends");
    let mut rest = String::new();
    out.read_to_string(&mut rest).expect("its output");
    child.stderr.take().expect("its log").read_to_string(&mut rest).expect("its log");
    assert!(!rest.contains("come-in#"), "no link for a journal: {rest}");
    assert!(rest.contains("rrp open") && rest.contains("rrp invite"), "{rest}");
    let none = refused(&["open", "--data", &text(&data.path().join("other"))]);
    assert!(none.contains("No rrp server of yours runs on") && none.contains("rrp serve"), "{none}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_terminal_shows_both_links() {
    let data = tempfile::tempdir().expect("a folder");
    let serve = rrp(&[]).get_program().to_string_lossy().into_owned();
    let serve =
        format!("{serve} serve --listen 127.0.0.1:0 --behind-proxy https://rrp.example --data {}", text(data.path()));
    let mut terminal = Command::new("script");
    terminal.args(["-qec", &serve, "/dev/null"]).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null());
    let mut child = terminal.spawn().expect("`script` starts");
    let lines = BufReader::new(child.stdout.take().expect("its output")).lines().map_while(Result::ok);
    let said: Vec<String> = lines.take_while(|line| !line.starts_with("The page and `rrp invite`")).collect();
    drop((child.kill(), child.wait()));
    let has = |begin: &str| said.iter().any(|line| line.starts_with(begin));
    assert!(has("http://127.0.0.1:") && has("https://rrp.example/come-in#"), "{said:?}");
    assert!(said.iter().any(|line| line.contains('\u{1b}')), "a picture for phones: {said:?}");
}

#[test]
fn what_does_not_go_together_is_said() {
    let two = refused(&["serve", "--listen", "127.0.0.1:0", "--listen", "127.0.0.2:0"]);
    assert!(two.contains("Say --listen once for this computer"), "{two}");
    let data = tempfile::tempdir().expect("a folder");
    let nobody = text(&data.path().join("nobody.pem"));
    let line = ["serve", "--listen", "0.0.0.0:0", "--cert", &nobody, "--key", &nobody, "--data", &text(data.path())];
    let unread = refused(&line);
    assert!(unread.contains("nobody.pem cannot be used"), "{unread}");
}
