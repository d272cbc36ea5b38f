//! The real program with files: there and back, checked, backed up, moved.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

struct Said {
    code: i32,
    out: String,
    err: String,
}

fn rrp(args: &[&str]) -> Said {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rrp"));
    let done = command.args(args).env_remove("RRP_STORE").output().expect("rrp starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    Said { code: done.status.code().expect("an exit code"), out: text(done.stdout), err: text(done.stderr) }
}

/// What it said on standard output; panics unless it went well.
fn fine(args: &[&str]) -> String {
    let said = rrp(args);
    assert_eq!(said.code, 0, "{args:?}: {} {}", said.out, said.err);
    said.out
}

fn template(name: &str) -> String {
    format!("{}/../../tests/behaviours/{name}.json", env!("CARGO_MANIFEST_DIR"))
}

struct Room(tempfile::TempDir);

impl Room {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder"))
    }

    fn path(&self, name: &str) -> String {
        self.0.path().join(name).display().to_string()
    }

    fn put(&self, name: &str, text: &str) -> String {
        std::fs::write(self.0.path().join(name), text).expect("written");
        self.path(name)
    }
}

fn read(path: &str) -> String {
    std::fs::read_to_string(path).expect("a text")
}

/// A store with three behaviours, two of them from one file.
fn filled(room: &Room) -> String {
    let store = room.path("data");
    let said =
        fine(&["import", &template("greeter"), &template("track_nearest_arm"), &template("greeter"), "--data", &store]);
    assert!(said.contains("“Greeter” is here now") && said.contains("“Greeter 2” is here now"), "{said}");
    store
}

#[test]
fn a_behaviour_goes_out_and_comes_back_as_itself_in_every_format_and_store() {
    let room = Room::new();
    let store = filled(&room);
    let out = room.path("arm.json");
    assert_eq!(fine(&["export", "track with nearest arm", "--data", &store, "--out", &out]), "");
    let json = read(&out);
    for (format, to) in [("json", "files:"), ("xml", "files:"), ("xml", "sqlite:")] {
        let file = room.put(
            &format!("arm.{format}"),
            &fine(&["export", "Track with nearest arm", "--format", format, "--data", &store]),
        );
        let other = format!("{to}{}", room.path(&format!("other-{format}-{}", &to[..5])));
        fine(&["import", "--restore", &file, "--store", &other]);
        assert_eq!(fine(&["export", "Track with nearest arm", "--store", &other]), json, "{format} {other}");
        let again = rrp(&["import", "--restore", &file, "--store", &other]);
        assert!(again.code == 1 && again.err.contains("without --restore"), "{}", again.err);
    }
    let svg = fine(&["export", "Track with nearest arm", "--format", "svg", "--data", &store]);
    assert!(svg.starts_with("<svg ") && svg.contains(">Head yaw</text>"), "{svg}");
    let unknown = rrp(&["export", "Dance", "--data", &store]);
    assert!(unknown.code == 1 && unknown.err.contains("There are “Greeter”, “Greeter 2”"), "{}", unknown.err);
}

#[test]
fn what_is_exported_can_be_replayed() {
    let room = Room::new();
    let store = filled(&room);
    let file = room.put("greeter.json", &fine(&["export", "Greeter", "--data", &store]));
    let trace = room.put("trace.jsonl", "");
    fine(&["replay", "--behaviour", &file, "--trace", &trace]);
}

#[test]
fn a_helper_that_means_something_else_comes_under_another_name_and_is_told() {
    let room = Room::new();
    let store = filled(&room);
    let other = read(&template("track_far_and_close")).replace("0.03 / sin(ball.size)", "1.0 / ball.size");
    let said = fine(&["import", &room.put("other.json", &other), "--data", &store]);
    assert!(said.contains("ball_to_distance means something else here; it came as ball_to_distance2"), "{said}");
    let out = fine(&["export", "Track far and close balls", "--data", &store]);
    assert!(
        out.contains("\"helper\": \"ball_to_distance2\"") && out.contains("\"body\": \"1.0 / ball.size\""),
        "{out}"
    );
}

#[test]
fn check_tells_everything_with_its_place_and_says_by_its_exit_code_what_it_means() {
    let room = Room::new();
    let good = read(&template("greeter"));
    let fine_file = room.put("good.json", &good);
    let said = rrp(&["check", &fine_file]);
    assert_eq!((said.code, said.out), (0, format!("{fine_file}: can be imported and started.\n")));

    let empty = room.put("empty.json", &good.replace("\"body\": \"face.new\"", "\"body\": \"\""));
    let said = rrp(&["check", &empty]);
    assert!(
        said.code == 1 && said.out.contains("empty.json:18:5: ") && said.out.contains("choose a helper.\n"),
        "{}",
        said.out
    );

    let bad = good.replace("\"sensor\"", "\"sense\"").replace("\"periodMs\": 10000", "\"periodMs\": 0");
    let bad = room.put("bad.json", &bad);
    let said = rrp(&["check", &bad]);
    let lines: Vec<&str> = said.out.lines().collect();
    assert_eq!((said.code, lines.len()), (3, 3), "{}", said.out);
    assert!(lines[0].contains("bad.json:6:") && lines[1].contains("bad.json:17:"), "{}", said.out);

    let cycle = good.replace("\"output\": \"new\"", "\"output\": \"face\"");
    let said = rrp(&["check", &room.put("cycle.json", &cycle)]);
    assert!(said.code == 3 && said.out.contains("cycle.json:1"), "{}", said.out);

    let body = good.replace("\"body\": \"face.new\"", "\"body\": \"\\n face.\"");
    let said = rrp(&["check", &room.put("body.json", &body)]);
    assert!(
        said.code == 3 && said.out.contains("body.json:18:5: In its procedure, line 2, character "),
        "{}",
        said.out
    );

    let said = rrp(&["check", "--json", &bad]);
    let told: serde_json::Value = serde_json::from_str(&said.out).expect("JSON");
    assert_eq!((said.code, &told["importable"], &told["ready"]), (3, &false.into(), &false.into()));
    assert_eq!(told["problems"][0]["line"], 6);
    let sentence = told["problems"][0]["reason"].as_str().expect("a sentence");
    assert!(said.code == 3 && lines[0].ends_with(&format!(": {sentence}")), "{sentence}");

    let said = rrp(&["check", &room.path("nothing.json")]);
    assert!(said.code == 4 && said.err.contains("could not be opened"), "{}", said.err);
    let said = rrp(&["import", &bad, "--data", &room.path("new")]);
    assert!(said.code == 1 && said.err.contains("bad.json:6:"), "{}", said.err);
    assert!(fine(&["check", "--help"]).contains("3 it cannot be imported"));
}

#[test]
fn explain_prints_a_sentence_a_line_in_both_languages() {
    let room = Room::new();
    let far = template("track_far_and_close");
    let said = rrp(&["explain", &far]);
    let english =
        "When the red ball is at least 0.5 m away, the head follows it.\nOtherwise the whole body follows it.\n";
    assert_eq!((said.code, said.out.as_str()), (0, english));
    let said = rrp(&["explain", &far, "--language", "ja"]);
    assert!(said.out.starts_with("赤いボールが 0.5 m 以上離れているとき、頭で追いかけます。\n"), "{}", said.out);

    // What a helper of one's own gives has its unit.
    let own = r#"{"format": "rrp-behaviour/1", "name": "Own",
        "helpers": [{"name": "reach", "params": ["ball"], "body": "100.0 * 0.03 / sin(ball.size)", "gives": "cm"}],
        "streams": [{"id": "ball", "kind": "sensor", "name": "Red ball", "device": "RedBall"},
            {"id": "gap", "kind": "ordinary", "name": "Gap"}, {"id": "near", "kind": "ordinary", "name": "Near"},
            {"id": "head", "kind": "actuator", "name": "Head", "device": "Tracker"}],
        "connectors": [{"id": "c1", "type": "map", "inputs": ["ball"], "output": "gap", "helper": "reach"},
            {"id": "c2", "type": "filter", "inputs": ["gap"], "output": "near", "body": "gap < 40"},
            {"id": "c3", "type": "subscribe", "inputs": ["near"], "output": "head"}]}"#;
    let said = rrp(&["explain", &room.put("own.json", own)]);
    assert!(said.code == 0 && said.out.contains("40 cm"), "{} {}", said.out, said.err);

    let said = rrp(&["explain", &room.put("bad.json", "{\"format\": 7")]);
    assert!(said.code == 3 && said.out.is_empty() && said.err.contains("bad.json:1:"), "{}", said.err);
    let said = rrp(&["explain", &room.path("nothing.json")]);
    assert!(said.code == 4 && said.err.contains("could not be opened"), "{}", said.err);
    let said = rrp(&["explain", &far, "--language", "fr"]);
    assert!(said.code == 2 && said.err.contains("choose en or ja"), "{}", said.err);
}

/// A backup without its first and last line, which hold the epoch and the sum over it.
fn middle(path: &str) -> Vec<String> {
    let lines: Vec<String> = read(path).lines().map(str::to_owned).collect();
    lines[1..lines.len() - 1].to_vec()
}

#[test]
fn a_backup_fills_an_empty_store_with_the_same_and_no_other() {
    let room = Room::new();
    let store = filled(&room);
    let backup = room.path("all.rrpbackup");
    let said = fine(&["backup", &backup, "--data", &store]);
    assert!(said.starts_with("4 behaviours with 4 changes in "), "{said}");
    assert!(!Path::new(&(backup.clone() + ".part")).exists());
    for to in ["files:new-files", "sqlite:new-sqlite"] {
        let to = to.replace("new", &room.path("new"));
        fine(&["restore", &backup, "--store", &to]);
        fine(&["restore", &backup, "--store", &to]);
        let again = room.path("again.rrpbackup");
        fine(&["backup", &again, "--store", &to]);
        assert_eq!(middle(&again), middle(&backup));
    }
    let cut = room.put("cut.rrpbackup", &read(&backup)[..2_000]);
    let said = rrp(&["restore", &cut, "--data", &room.path("fresh")]);
    assert!(said.code == 1 && said.err.contains("ends too early"), "{}", said.err);
    let other = room.path("strange");
    fine(&["import", &template("greeter"), "--data", &other]);
    let said = rrp(&["restore", &backup, "--data", &other]);
    assert!(said.code == 1 && said.err.contains("not empty"), "{}", said.err);
    let said = rrp(&["backup", &room.path("no/such/folder/x"), "--data", &store]);
    assert!(said.code == 1 && said.err.contains("could not be read or written"), "{}", said.err);
}

#[test]
fn a_migration_moves_everything_and_proves_it() {
    let room = Room::new();
    let (store, files) = (filled(&room), format!("files:{}", room.path("files")));
    for _ in 0..2 {
        let said = fine(&["migrate", "--from", &store, "--to", &files]);
        assert!(said.starts_with("4 behaviours with 4 changes; both stores hold the same"), "{said}");
    }
    let (one, other) =
        (fine(&["export", "Greeter 2", "--data", &store]), fine(&["export", "Greeter 2", "--store", &files]));
    assert_eq!(one, other);
    let said = rrp(&["migrate", "--from", &store, "--to", &store]);
    assert!(said.code == 1 && said.err.contains("same store"), "{}", said.err);
    fine(&["import", &template("greeter"), "--store", &files]);
    let said = rrp(&["migrate", "--from", &store, "--to", &files]);
    assert!(said.code == 1 && said.err.contains("not empty"), "{}", said.err);
}

#[test]
fn every_command_has_an_example() {
    for command in ["export", "import", "check", "explain", "backup", "restore", "migrate"] {
        let said = fine(&[command, "--help"]);
        assert!(said.contains("Example") && said.contains("Exit codes"), "{said}");
    }
}

/// A server that ends with the test.
struct Serving(std::process::Child);

impl Serving {
    fn on(store: &str) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rrp"));
        command.args(["serve", "--listen", "127.0.0.1:0", "--data", store]).env_remove("RRP_STORE");
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("rrp starts");
        let mut line = String::new();
        BufReader::new(child.stdout.take().expect("its output")).read_line(&mut line).expect("a line");
        assert!(line.starts_with("rrp is ready: "), "{line}");
        Self(child)
    }
}

impl Drop for Serving {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn a_store_that_a_server_uses_is_reached_through_that_server() {
    let room = Room::new();
    let store = filled(&room);
    let before = fine(&["export", "Greeter", "--data", &store]);
    let serving = Serving::on(&store);
    assert_eq!(fine(&["export", "Greeter", "--data", &store]), before);
    let xml = room.put("arm.xml", &fine(&["export", "Track with nearest arm", "--format", "xml", "--data", &store]));
    let said = fine(&["import", &xml, "--data", &store]);
    assert!(said.contains("“Track with nearest arm 2” is here now"), "{said}");
    let said = rrp(&["import", "--restore", &xml, "--data", &store]);
    assert!(said.code == 1 && said.err.contains("here already"), "{}", said.err);
    let unknown = rrp(&["export", "Dance", "--data", &store]);
    assert!(unknown.code == 1 && unknown.err.contains("There are “Greeter”"), "{}", unknown.err);
    let backup = room.path("all.rrpbackup");
    assert!(fine(&["backup", &backup, "--data", &store]).starts_with("5 behaviours with 5 changes in "));
    let said = rrp(&["restore", &backup, "--data", &store]);
    assert!(said.code == 1 && said.err.contains("Stop it"), "{}", said.err);
    drop(serving);
    let again = room.path("again.rrpbackup");
    fine(&["backup", &again, "--data", &store]);
    assert_eq!(middle(&again), middle(&backup));
}
