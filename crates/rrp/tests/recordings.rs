//! What was recorded of a live run on the simulated robot, replayed, gives the same outputs byte for byte.

use serde_json::json;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// How long anything may take.
const PATIENCE: Duration = Duration::from_secs(120);
/// Lines of a recording that are enough.
const LINES: usize = 400;

fn rrp(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rrp"));
    command.args(args).env_remove("RRP_STORE");
    command
}

fn fine(args: &[&str]) -> String {
    let done = rrp(args).output().expect("rrp starts");
    assert!(done.status.success(), "{args:?}: {}", String::from_utf8_lossy(&done.stderr));
    String::from_utf8(done.stdout).expect("UTF-8")
}

/// A server that ends with the test.
struct Server {
    child: Child,
    url: String,
}

impl Server {
    fn start(data: &str) -> Self {
        let mut command = rrp(&["serve", "--listen", "127.0.0.1:0", "--data", data]);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("rrp starts");
        let mut line = String::new();
        let out = child.stdout.take().expect("a pipe");
        BufReader::new(out).read_line(&mut line).expect("a line");
        let url = line.trim().strip_prefix("rrp is ready: ").expect("the address").to_owned();
        Self { child, url }
    }

    fn console(&self, lines: &str) -> String {
        let mut command = rrp(&["shell", &self.url]);
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("rrp starts");
        child.stdin.take().expect("a pipe").write_all(lines.as_bytes()).expect("written");
        let done = child.wait_with_output().expect("it ends");
        let said = String::from_utf8(done.stdout).expect("UTF-8");
        assert!(done.status.success(), "{said}");
        said
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        drop(self.child.kill());
        drop(self.child.wait());
    }
}

/// The only recording, as soon as it is as wanted.
fn recording(data: &Path, wanted: impl Fn(&str) -> bool) -> (String, String) {
    let began = Instant::now();
    loop {
        let folder = std::fs::read_dir(data.join("recordings")).into_iter().flatten().flatten();
        for path in folder.map(|entry| entry.path()) {
            let text = std::fs::read_to_string(&path).expect("a text");
            if wanted(&text) {
                return (path.display().to_string(), text);
            }
        }
        assert!(began.elapsed() < PATIENCE, "there is no such recording");
        std::thread::sleep(Duration::from_millis(50));
    }
}

/// The lines of these streams.
fn lines_of(text: &str, streams: &[String]) -> String {
    let is_one = |line: &&str| streams.iter().any(|id| line.contains(&format!("\"stream\":\"{id}\"")));
    text.lines().filter(is_one).map(|line| format!("{line}\n")).collect()
}

fn replay(behaviour: &str, trace: &str) -> Output {
    rrp(&["replay", "--behaviour", behaviour, "--trace", trace]).output().expect("rrp starts")
}

/// Records a behaviour that was edited to run in `engine`, and replays it.
fn record_and_replay(engine: &str) {
    let room = tempfile::tempdir().expect("a folder");
    let path = |name: &str| room.path().join(name).display().to_string();
    let template = format!("{}/../../tests/behaviours/track_nearest_arm_in_time.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(template).expect("a template");
    let mut file: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    file["engine"] = serde_json::from_str(engine).expect("JSON");
    file["name"] = "Recorded".into();
    let add = |file: &mut serde_json::Value, key: &str, one: serde_json::Value| {
        file[key].as_array_mut().expect("a list").push(one);
    };
    // Something that runs by the clock alone.
    add(&mut file, "streams", json!({"id": "beat", "kind": "ordinary", "name": "Beat"}));
    add(&mut file, "streams", json!({"id": "page", "kind": "actuator", "name": "Page", "device": "Print"}));
    let sample = json!({"id": "s", "type": "sample", "inputs": ["distance"], "output": "beat", "periodMs": 70});
    add(&mut file, "connectors", sample);
    add(&mut file, "connectors", json!({"id": "p", "type": "subscribe", "inputs": ["beat"], "output": "page"}));
    let behaviour = path("behaviour.json");
    std::fs::write(&behaviour, file.to_string()).expect("written");
    fine(&["import", &behaviour, "--data", &path("data")]);
    let server = Server::start(&path("data"));
    let said = server.console("record on\nstart recorded\nshow commands\n");
    assert!(said.contains("Recorded runs and is recorded"), "{said}");
    let exported = path("exported.json");
    fine(&["export", "Recorded", "--data", &path("data"), "--out", &exported]);
    let file: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(&exported).expect("a text")).expect("JSON");
    let streams = file["streams"].as_array().expect("streams");
    let actions = streams.iter().filter(|stream| stream["kind"] == "actuator");
    let actions: Vec<String> = actions.filter_map(|stream| stream["id"].as_str().map(str::to_owned)).collect();
    let data = room.path().join("data");
    let enough = |text: &str| text.lines().count() > LINES && lines_of(text, &actions).lines().count() > 5;
    recording(&data, enough);
    server.console("stop recorded\n");
    let (trace, text) = recording(&data, |text| text.contains("\"mark\":\"end\""));
    let made = replay(&exported, &trace);
    let complaints = String::from_utf8_lossy(&made.stderr).into_owned();
    assert!(made.status.success() && complaints.is_empty(), "{complaints}");
    let wanted = lines_of(&text, &actions);
    let made = String::from_utf8(made.stdout).expect("UTF-8");
    let different = made.lines().zip(wanted.lines()).find(|(made, wanted)| made != wanted);
    assert!(
        made == wanted,
        "first difference: {different:?}, lines {} {}",
        made.lines().count(),
        wanted.lines().count()
    );

    // Alone it gives the same, through the program that it has.
    let check = |file: &str| rrp(&["replay", "--check", file]).output().expect("rrp starts");
    let checked = check(&trace);
    let told = String::from_utf8_lossy(&checked.stdout).into_owned();
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
    let same = format!("It gives its own actions again: {} from ", wanted.lines().count());
    assert!(told.starts_with(&same) && told.contains("It ends there: it was stopped."), "{told}");
    let forged = path("forged.jsonl");
    let first = wanted.lines().next().expect("an action");
    std::fs::write(&forged, text.replacen(&format!("{first}\n"), "", 1)).expect("written");
    let checked = check(&forged);
    let told = String::from_utf8_lossy(&checked.stderr).into_owned();
    assert!(checked.status.code() == Some(1) && told.starts_with("The replay differs: "), "{told}");

    // It says why the robot did its last action.
    tells_why(&trace, wanted.lines().last().expect("an action"));

    // Every other program gets it in its own form.
    for (form, begins) in
        [("csv", "\u{feff}\"t_ms\""), ("eaf", "<?xml"), ("boris", "0."), ("vtt", "WEBVTT"), ("mcap", "")]
    {
        let to = path(&format!("recording.{form}"));
        fine(&["convert", &trace, "--to", form, "--out", &to]);
        let made = std::fs::read(&to).expect("it is written");
        assert!(made.len() > 100 && made.starts_with(begins.as_bytes()), "{form}: {}", String::from_utf8_lossy(&made));
    }

    // An edited behaviour takes the same recording; what it does not have any more is said.
    let mut edited = file.clone();
    let gone = actions[0].clone();
    let list = |edited: &mut serde_json::Value, key: &str, keep: &dyn Fn(&serde_json::Value) -> bool| {
        edited[key].as_array_mut().expect("a list").retain(|one| keep(one));
    };
    list(&mut edited, "connectors", &|connector| connector["output"] != gone.as_str());
    list(&mut edited, "streams", &|stream| stream["id"] != gone.as_str());
    std::fs::write(&behaviour, edited.to_string()).expect("written");
    let made = replay(&behaviour, &trace);
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    assert_eq!(String::from_utf8(made.stdout).expect("UTF-8"), lines_of(&text, &actions[1..]));
    let listed = server.console("recordings\n");
    assert!(listed.contains("Recorded on Simulated NAO, revision 1, 2"), "{listed}");
}

/// A recording leads from a recorded action back to a reading.
fn tells_why(trace: &str, action: &str) {
    let action: serde_json::Value = serde_json::from_str(action).expect("JSON");
    let (stream, at) = (action["stream"].as_str().expect("a stream"), action["t"].to_string());
    let way = fine(&["why", trace, "--stream", stream, "--at", &at, "--json"]);
    let way: serde_json::Value = serde_json::from_str(&way).expect("JSON");
    let steps = way["steps"].as_array().expect("steps");
    assert_eq!(steps[0]["value"], action["value"]);
    assert!(steps.len() > 2 && steps[steps.len() - 1]["connector"].is_null(), "{way}");
    let sentences = fine(&["why", trace, "--stream", stream, "--at", &at, "--language", "ja"]);
    assert_eq!(sentences.lines().count(), steps.len());
}

#[test]
fn a_live_recording_replayed_gives_the_same_outputs_in_event_mode() {
    record_and_replay(r#""event""#);
}

#[test]
fn a_live_recording_replayed_gives_the_same_outputs_in_frame_mode() {
    record_and_replay(r#"{"frame":{"frameMs":40}}"#);
}

#[test]
fn a_server_that_is_killed_leaves_a_recording_that_says_where_it_ends() {
    let room = tempfile::tempdir().expect("a folder");
    let path = |name: &str| room.path().join(name).display().to_string();
    let template = format!("{}/../../tests/behaviours/track_nearest_arm_in_time.json", env!("CARGO_MANIFEST_DIR"));
    fine(&["import", &template, "--data", &path("data")]);
    let mut server = Server::start(&path("data"));
    server.console("record on\nstart Track with nearest arm, in time\n");
    let data = room.path().join("data");
    let (trace, _) = recording(&data, |text| text.lines().count() > LINES);
    server.child.kill().expect("it is killed");
    server.child.wait().expect("it ends");
    let checked = rrp(&["replay", "--check", &trace]).output().expect("rrp starts");
    let told = String::from_utf8_lossy(&checked.stdout).into_owned();
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
    assert!(told.contains("It is cut off there"), "{told}");
    let server = Server::start(&path("data"));
    let listed = server.console("recordings\n");
    assert!(listed.contains("its end is missing"), "{listed}");
}
