//! `rrp why` tells why values of traces and recordings came and others did not, for machines and for people.

use serde_json::{Value, json};
use std::fs::{read_to_string, write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

/// Shows a ball that is near, remembers how many were, and says so together with the newest colour.
const PROGRAM: &str = r#"{"format":"rrp-behaviour/1","name":"Near","helpers":[],
    "streams":[{"id":"ball","kind":"sensor","name":"Ball"},{"id":"colour","kind":"sensor","name":"Colour"},
        {"id":"near","kind":"ordinary","name":"Near ball"},{"id":"many","kind":"ordinary","name":"Many"},
        {"id":"both","kind":"ordinary","name":"Both"},{"id":"late","kind":"ordinary","name":"Late"},
        {"id":"say","kind":"actuator","name":"Say","device":"SayInput"}],
    "connectors":[
        {"id":"keep","type":"filter","inputs":["ball"],"output":"near","args":["ball"],"body":"ball < 20"},
        {"id":"count","type":"scan","inputs":["near"],"output":"many","args":["soFar","near"],"body":"soFar + 1","start":0},
        {"id":"join","type":"combineLatest","inputs":["colour","many"],"output":"both","args":["c","m"],"body":"c + m"},
        {"id":"wait","type":"delay","inputs":["both"],"output":"late","periodMs":1000},
        {"id":"tell","type":"subscribe","inputs":["late"],"output":"say"}]}"#;
const TRACE: &str = r#"{"t":100,"stream":"colour","value":10}
{"t":200,"stream":"ball","value":30}
{"t":300,"stream":"ball","value":15}
{"t":900,"stream":"ball","value":12}
{"t":2500,"stream":"ball","value":40}
"#;
const HEADER: &str = r#"{"format":"rrp-recording/2","began":"2026-11-21T12:04:13Z","mode":"event","records":"all"}"#;

/// A folder with the program, its trace and a recording in which an edited one goes on at 2 s.
static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("why");
    std::fs::create_dir_all(&folder).expect("a folder");
    let edited = PROGRAM.replace("ball < 20", "ball < 50").replacen(
        "{\"id\":\"ball\",",
        "{\"id\":\"x\",\"kind\":\"sensor\",\"name\":\"X\"},{\"id\":\"ball\",",
        1,
    );
    let one_line = |file: &str| serde_json::from_str::<Value>(file).expect("JSON").to_string();
    let file =
        |file: &str, t: u64| format!("{{\"t\":{t},\"mark\":\"file\",\"revision\":1,\"file\":{}}}\n", one_line(file));
    let (before, after) = TRACE.split_at(TRACE.find("{\"t\":2500").expect("the last reading"));
    let recording = format!(
        "{HEADER}\n{}{before}{{\"t\":2000,\"mark\":\"applied\",\"revision\":2}}\n{}{after}\
         {{\"t\":4000,\"mark\":\"end\",\"closed\":4000,\"why\":\"stopped\"}}\n",
        file(PROGRAM, 0),
        file(&edited, 2_000)
    );
    write(folder.join("near.json"), PROGRAM).expect("written");
    write(folder.join("trace.jsonl"), TRACE).expect("written");
    write(folder.join("recording.jsonl"), recording).expect("written");
    folder
});

fn why(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rrp")).arg("why").args(args).current_dir(&*FOLDER).output().expect("rrp starts")
}

fn of_trace(args: &[&str]) -> Output {
    why(&[&["--behaviour", "near.json", "--trace", "trace.jsonl"], args].concat())
}

fn text(of: &[u8]) -> String {
    String::from_utf8(of.to_vec()).expect("UTF-8")
}

/// The answer, if the exit code is 0.
fn told(done: &Output) -> String {
    assert!(done.status.success(), "{}", text(&done.stderr));
    text(&done.stdout)
}

/// The exit code and what is said then.
fn refused(done: &Output) -> (Option<i32>, String) {
    (done.status.code(), text(&done.stderr))
}

fn line(done: &Output) -> Value {
    serde_json::from_str(&told(done)).expect("one line of JSON")
}

#[test]
fn a_value_is_told_with_its_way_for_machines() {
    let way = line(&of_trace(&["--stream", "say", "--at", "1900", "--json"]));
    let wanted = json!({"stream": "say", "t": 1900, "value": 12, "steps": [
        {"connector": "tell", "stream": "say", "t": 1900, "value": 12, "with": []},
        {"connector": "wait", "stream": "late", "t": 1900, "value": 12, "with": []},
        {"connector": "join", "stream": "both", "t": 900, "value": 12,
            "with": [{"stream": "colour", "t": 100, "value": 10}]},
        {"connector": "count", "stream": "many", "t": 900, "value": 2, "with": [{"memory": 1, "t": 300}]},
        {"connector": "keep", "stream": "near", "t": 900, "value": 12, "with": []},
        {"connector": null, "stream": "ball", "t": 900, "value": 12, "with": []}]});
    assert_eq!(way, wanted);
}

#[test]
fn frames_have_their_own_instants() {
    let way = line(&of_trace(&["--stream", "many", "--at", "350", "--json", "--mode", "frame", "--frame-ms", "175"]));
    assert_eq!(way["steps"][0]["with"], json!([{"memory": 0, "t": 0}]));
    let none = of_trace(&["--stream", "many", "--at", "300", "--json", "--mode", "frame", "--frame-ms", "175"]);
    assert_eq!(none.status.code(), Some(1));
}

#[test]
fn what_kept_an_action_back_is_told_for_machines() {
    let not = |from: &str, until: &str| {
        line(&of_trace(&["--stream", "say", "--not", "--from", from, "--until", until, "--json"]))
    };
    let one = |connector: &str, stream: &str, t: u64, value: u64, because: &str| {
        let told = json!({"connector": connector, "stream": stream, "t": t, "value": value, "because": because});
        json!({"stream": "say", "blocked": [told]})
    };
    let nothing = |connector: &str, stream: &str| json!({"connector": connector, "stream": stream, "t": null, "value": null, "because": "nothing"});
    assert_eq!(not("400", "1000"), one("wait", "both", 900, 12, "waits"));
    let mut kept = one("keep", "ball", 2500, 40, "kept");
    kept["blocked"].as_array_mut().expect("a list").push(nothing("join", "colour"));
    assert_eq!(not("2000", "2600"), kept, "a miss is told before what was silent");
    let silent = [nothing("join", "colour"), nothing("keep", "ball")];
    assert_eq!(not("0", "50"), json!({"stream": "say", "blocked": silent}));
}

#[test]
fn each_mistake_has_its_sentence() {
    let say = |done: &Output| refused(done);
    let no_value = of_trace(&["--stream", "say", "--at", "1901", "--json"]);
    let (code, said) = say(&no_value);
    assert_eq!(
        (code, said.trim()),
        (Some(1), "Nothing came on “Say” at 0:01.901. The last value before it came at 0:01.900 (1900).")
    );
    assert!(no_value.stdout.is_empty());
    for (args, code, wanted) in [
        (vec!["--stream", "nose", "--at", "1"], 1, "No stream has the id “nose”. There are “ball”"),
        (vec!["--action", "Sing", "--at", "1"], 1, "No action is called “Sing”. There are “Say”."),
        (vec!["--stream", "say", "--at", "1900", "--nth", "1"], 1, "has one value at 0:01.900; leave out --nth."),
        (vec!["--stream", "say", "--at", "12:00:00"], 1, "A trace has no time of day."),
        (vec!["--stream", "say", "--at", "soon"], 2, "this is no time; write milliseconds since Start"),
        (vec!["--stream", "say"], 2, "--at <TIME>"),
        (vec!["--stream", "say", "--not", "--from", "9", "--until", "1"], 1, "--until is before --from."),
        (vec!["--action", "say", "--not", "--at", "1900"], 1, "“Say” did come at 0:01.300. Leave out --not"),
    ] {
        let (was, said) = say(&of_trace(&args));
        assert!(was == Some(code) && said.contains(wanted), "{args:?}: {was:?} {said}");
    }
    let (code, said) = say(&why(&["trace.jsonl", "--action", "Say", "--at", "1"]));
    assert!(code == Some(1) && said.contains("This is no recording."), "{said}");
    let (code, said) = say(&why(&["recording.jsonl", "--action", "Say", "--at", "15:30:00"]));
    assert!(code == Some(1) && said.contains("it began at 2026-11-21T12:04:13Z and went on for 0:04.000"), "{said}");
    let (code, _) = say(&why(&["--behaviour", "trace.jsonl", "--trace", "trace.jsonl", "--stream", "a", "--at", "1"]));
    assert_eq!(code, Some(2));
    let (code, _) = say(&why(&["--behaviour", "near.json", "--trace", "near.json", "--stream", "say", "--at", "1"]));
    assert_eq!(code, Some(3));
}

#[test]
fn a_recording_tells_in_sentences_what_its_edited_program_did() {
    let english = told(&why(&["recording.jsonl", "--action", "say", "--at", "12:04:16.5"]));
    assert_eq!(
        english,
        "At 0:03.500: the robot says it (13).\n\
         “Late” passed on at 0:03.500 what came at 0:02.500: 13.\n\
         “Both” came at 0:02.500: 13. With it “Colour” was 10, come 2.4 s earlier.\n\
         “Many” came at 0:02.500: 3. Before, it was 2.\n\
         “Near ball” came at 0:02.500: 40 is less than 50.\n\
         “Ball” was sensed at 0:02.500: 40.\n"
    );
    let near = told(&why(&["recording.jsonl", "--action", "Say", "--at", "0:01.8", "--language", "ja"]));
    assert!(near.starts_with("0:01.900：それを言います（12）。\n"), "{near}");
    let not = told(&why(&["recording.jsonl", "--action", "Say", "--not", "--at", "0:00.250"]));
    assert_eq!(
        not,
        "“Both” waits: “Colour” came at 0:00.100 with 10, and something else that it needs did not come yet.\n\
         At 0:00.200 “Near ball” kept 30 back: it keeps only what is less than 20.\n"
    );
    let line = line(&why(&["recording.jsonl", "--stream", "say", "--at", "3500", "--json"]));
    assert_eq!(line["steps"].as_array().map(Vec::len), Some(6));
}

#[test]
fn a_program_of_the_templates_answers_in_the_words_of_its_senses_and_actions() {
    let greeter =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/behaviours/greeter.json").display().to_string();
    let face = r#"{"id":3,"new":true,"recognized_new_face":false}"#;
    let faces = FOLDER.join("faces.jsonl").display().to_string();
    let reading = |t: u64| format!("{{\"t\":{t},\"stream\":\"face-detection\",\"value\":{face}}}\n");
    write(&faces, reading(1_000) + &reading(12_000)).expect("written");
    let answer = |args: &[&str]| told(&why(&[&["--behaviour", &greeter, "--trace", &faces], args].concat()));
    assert_eq!(
        answer(&["--action", "say hello", "--at", "0:10"]),
        "At 0:10.000: the robot says “Hello”.\n\
         “Somebody new” came at 0:10.000, as 3 is another value than before.\n\
         “New face” came at 0:10.000: it is new.\n\
         “Face” passed on at 0:10.000 what came at 0:01.000: id 3, new yes, recognized_new_face no.\n\
         At 0:01.000: a face is seen (id 3, new yes, recognized_new_face no).\n"
    );
    let stretch = ["--not", "--from", "11000", "--until", "21000"];
    assert_eq!(
        answer(&[&["--action", "Say hello"], &stretch[..]].concat()),
        "At 0:20.000 “Somebody new” kept 3 back: it was the same as before.\n"
    );
    assert_eq!(
        answer(&[&["--action", "Say hello again", "--language", "ja"], &stretch[..]].concat()),
        "0:20.000に「Known face」はそれを止めました。知っている顔であるものだけを通すからです。\n"
    );
}

#[test]
fn every_value_of_the_gold_cases_has_a_way_to_a_reading() {
    let gold = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/gold/4.20-tracking-fixed");
    let (behaviour, trace) = (gold.join("behaviour.json"), gold.join("trace.jsonl"));
    let (behaviour, trace) = (behaviour.display().to_string(), trace.display().to_string());
    let expected = read_to_string(gold.join("expected-event.jsonl")).expect("a text");
    let values: Vec<Value> = expected.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    for value in values.iter().filter(|line| line.get("value").is_some()).take(12) {
        let (stream, at) = (value["stream"].as_str().expect("a stream"), value["t"].to_string());
        let way =
            line(&why(&["--behaviour", &behaviour, "--trace", &trace, "--stream", stream, "--at", &at, "--json"]));
        assert_eq!((&way["value"], &way["steps"][0]["value"]), (&value["value"], &value["value"]));
        let last = way["steps"].as_array().and_then(|steps| steps.last().cloned()).expect("a step");
        assert!(last["connector"].is_null(), "{last}");
    }
}
