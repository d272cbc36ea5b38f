//! The real program with files as other programs save them: every command reads what `rrp check` reads, with the same
//! sentences, and names what is another kind of file.

use std::process::{Command, Output};

const PROGRAM: &str = r#"{
 "format": "rrp-behaviour/1",
 "name": "P",
 "helpers": [],
 "streams": [
  {"id": "s", "kind": "sensor", "name": "Sonar", "device": "Sonar"},
  {"id": "a", "kind": "actuator", "name": "Show", "device": "Print"}
 ],
 "connectors": [
  {"id": "u", "type": "subscribe", "inputs": ["s"], "output": "a"}
 ]
}"#;
const XML: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<behaviour format="1" name="P">
  <helpers/>
  <streams>
    <sensor id="s" name="Sonar" device="Sonar"/>
    <actuator id="a" name="Show" device="Print"/>
  </streams>
  <connectors>
    <subscribe id="u" to="a"><from stream="s"/></subscribe>
  </connectors>
</behaviour>
"#;
const TRACE: &str = "{\"t\":0,\"stream\":\"s\",\"value\":1}\r\n";
const BOM: &[u8] = b"\xef\xbb\xbf";

struct Folder(tempfile::TempDir);

impl Folder {
    fn put(&self, name: &str, bytes: impl AsRef<[u8]>) -> String {
        let path = self.0.path().join(name);
        std::fs::write(&path, bytes).expect("written");
        path.display().to_string()
    }
}

fn folder() -> Folder {
    Folder(tempfile::tempdir().expect("a folder"))
}

fn rrp(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rrp")).args(args).env_remove("RRP_STORE").output().expect("rrp starts")
}

/// Code, standard output, standard error.
fn said(args: &[&str]) -> (Option<i32>, String, String) {
    let Output { status, stdout, stderr } = rrp(args);
    (status.code(), String::from_utf8_lossy(&stdout).into_owned(), String::from_utf8_lossy(&stderr).into_owned())
}

#[test]
fn what_check_takes_replay_and_bench_take() {
    let folder = folder();
    let programs = [
        folder.put("program.json", PROGRAM),
        folder.put("bom.json", [BOM, PROGRAM.as_bytes()].concat()),
        folder.put("program.xml", XML),
        folder.put("bom.xml", [BOM, XML.as_bytes()].concat()),
    ];
    let recording = format!("{{\"format\":\"rrp-recording/1\",\"name\":\"P\"}}\n{TRACE}");
    let traces = [
        folder.put("trace.jsonl", TRACE),
        folder.put("bom.jsonl", [BOM, TRACE.as_bytes()].concat()),
        folder.put("recording.jsonl", &recording),
        folder.put("bom-recording.jsonl", [BOM, recording.as_bytes()].concat()),
    ];
    for program in &programs {
        assert_eq!(said(&["check", program]).0, Some(0), "{program}");
        for trace in &traces {
            let (code, out, err) = said(&["replay", "--behaviour", program, "--trace", trace]);
            let told = (code, out.as_str(), err.as_str());
            assert_eq!(told, (Some(0), "{\"t\":0,\"stream\":\"a\",\"value\":1}\n", ""), "{program} {trace}");
            let (code, out, err) = said(&["bench", "--behaviour", program, "--trace", trace, "--repeat", "1"]);
            assert!(code == Some(0) && out.contains("\"events\":1"), "{program} {trace}: {err}");
        }
    }
}

#[test]
fn what_check_refuses_replay_and_bench_refuse_with_the_same_sentence() {
    let folder = folder();
    let trace = folder.put("trace.jsonl", TRACE);
    let utf16 = [vec![0xff, 0xfe], PROGRAM.encode_utf16().flat_map(u16::to_le_bytes).collect()].concat();
    let deep = format!("<ChoregrapheProject>{}{}</ChoregrapheProject>", "<Box>".repeat(9), "</Box>".repeat(9));
    let files = [
        (folder.put("utf16.json", utf16), "1:1: This text is UTF-16. Save the file as UTF-8."),
        (
            folder.put("latin.json", b"{\"name\": \"Gr\xf6\xdfe\"}"),
            "1:13: This is no UTF-8 text. Save the file as UTF-8.",
        ),
        (folder.put("cut.json", &PROGRAM[..200]), "The file ends too early. Copy it again as a whole."),
        (folder.put("behavior.xar", deep), "1:1: This is a Choregraphe project, no program of rrp."),
        (folder.put("page.html", "<!DOCTYPE html>\n<html></html>"), "1:1: This is a web page, no program of rrp."),
        (
            folder.put("flows.json", r#"[{"id":"a1","type":"tab","label":"Flow"}]"#),
            "1:1: This is a file of Node-RED flows",
        ),
        (folder.put("program.json.zip", b"PK\x03\x04\x14\0"), "1:1: This is a packed file (zip), no program of rrp."),
        (folder.put("session.jsonl", TRACE), "1:1: This is a list of readings, no program of rrp."),
    ];
    for (file, sentence) in &files {
        let (code, out, _) = said(&["check", file]);
        assert!(code == Some(3) && out.contains(sentence), "{out}");
        let of = format!("{file}:");
        let wanted = out.lines().find(|line| line.contains(sentence)).and_then(|line| line.strip_prefix(&of));
        for command in ["replay", "bench"] {
            let (code, _, err) = said(&[command, "--behaviour", file, "--trace", &trace]);
            assert!(
                code == Some(2) && wanted.is_some_and(|wanted| err.contains(wanted)),
                "{command}: {err} {wanted:?}"
            );
        }
    }
}

#[test]
fn a_recording_of_another_form_gets_a_sentence_that_helps() {
    let folder = folder();
    let program = folder.put("program.json", PROGRAM);
    let table = [
        ("t,stream,value\n0,s,1\n", "This is a table (CSV), and here should be readings"),
        (PROGRAM, "This is a program, and here should be readings"),
        (XML, "This is a program, and here should be readings"),
        ("<html></html>", "This is a web page, and here should be readings"),
        ("{\"t\":1.5,\"stream\":\"s\",\"value\":1}", "If this is in seconds, write 1500"),
        ("{\"t\":1732761600,\"stream\":\"s\",\"value\":1}", "a time since 1970"),
        ("{\"timestamp\":5,\"stream\":\"s\",\"value\":1}", "write t instead of “timestamp”"),
        ("[{\"t\":1,\"stream\":\"s\",\"value\":1}]", "Write one JSON object a line"),
    ];
    for (trace, sentence) in table {
        let trace = folder.put("trace", trace);
        for command in ["replay", "bench"] {
            let (code, _, err) = said(&[command, "--behaviour", &program, "--trace", &trace]);
            assert!(code == Some(3) && err.contains(sentence), "{command} {sentence}: {err}");
        }
    }
}

#[test]
fn a_folder_that_is_another_from_every_place_is_refused() {
    let folder = folder();
    let export = |xdg: &str, home: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rrp"));
        command.args(["export", "x"]).env_remove("RRP_STORE").env("XDG_DATA_HOME", xdg).env("HOME", home);
        let done = command.current_dir(folder.0.path()).output().expect("rrp starts");
        (done.status.code(), String::from_utf8_lossy(&done.stderr).into_owned())
    };
    let (code, err) = export("", "");
    assert!(code == Some(1) && err.contains("HOME is empty."), "{err}");
    let (code, err) = export("share", "/nowhere");
    assert!(code == Some(1) && err.contains("XDG_DATA_HOME is “share”, which is no whole path"), "{err}");
    for words in [&["serve", "--listen", "127.0.0.1:0"][..], &["shell"], &["invite", "--role", "viewer"]] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rrp"));
        let done = command.args(words).env("XDG_STATE_HOME", "state").current_dir(folder.0.path()).output();
        let done = done.expect("rrp starts");
        let err = String::from_utf8_lossy(&done.stderr);
        assert!(done.status.code() == Some(1) && err.contains("XDG_STATE_HOME is “state”"), "{words:?}: {err}");
    }
    assert_eq!(std::fs::read_dir(folder.0.path()).expect("a folder").count(), 0, "nothing was made there");
}
