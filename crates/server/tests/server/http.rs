//! The routes: who may come in, what is sent, and Stop.

use crate::house::{House, make};
use std::time::{Duration, Instant};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;

/// Sends a request of the host's and answers with everything that came back.
pub(crate) async fn raw(house: &House, request: &str) -> String {
    let (first, rest) = request.split_once("\r\n").unwrap_or((request, ""));
    if rest.is_empty() {
        return unproven(house, request).await;
    }
    unproven(house, &format!("{first}\r\n{}: {}\r\n{rest}", host_key::HEADER, house.key())).await
}

/// Sends a request as it is and answers with everything that came back.
pub(crate) async fn unproven(house: &House, request: &str) -> String {
    let mut stream = TcpStream::connect(house.address).await.unwrap();
    stream.write_all(request.as_bytes()).await.unwrap();
    let mut answer = Vec::new();
    let _ = tokio::time::timeout(Duration::from_secs(60), stream.read_to_end(&mut answer)).await.unwrap();
    String::from_utf8_lossy(&answer).into_owned()
}

fn line(method: &str, path: &str, house: &House, more: &str) -> String {
    format!("{method} {path} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n{more}\r\n", house.address)
}

#[tokio::test]
async fn stop_answers_at_once_and_headers_are_strict() {
    let house = House::open().await;
    let answer = raw(&house, &line("POST", "/stop", &house, "Content-Length: 0\r\n")).await;
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
    assert!(answer.ends_with(r#"{"stopped":true}"#), "{answer}");
    let number = |answer: &str| {
        let line = answer.lines().find_map(|line| line.strip_prefix(protocol::STOPS_HEADER)?.strip_prefix(": "));
        line.and_then(|number| number.parse::<u64>().ok())
    };
    let first = number(&answer).unwrap();
    assert!(answer.contains("content-security-policy: default-src 'none'; script-src 'self' 'wasm-unsafe-eval'"));
    assert!(answer.contains("x-content-type-options: nosniff") && answer.contains("referrer-policy: same-origin"));
    let origin = format!("Origin: http://{}\r\n", house.address);
    let form = format!("{origin}Content-Type: application/x-www-form-urlencoded\r\nContent-Length: 3\r\n\r\na=b");
    let answer = raw(&house, &line("POST", "/stop?behaviour=x", &house, &form)).await;
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
    assert_eq!(number(&answer), Some(first + 1), "each Stop tells its number: {answer}");
    let evil = line("POST", "/stop", &house, "Origin: http://evil.example\r\nContent-Length: 0\r\n");
    assert_eq!(number(&raw(&house, &evil).await), None, "what was refused was no Stop");
    house.close().await;
}

/// What a browser sends with a form whose page's address it keeps to itself.
pub(crate) const FORM: &str = "Origin: null\r\nSec-Fetch-Site: same-origin\r\nSec-Fetch-Mode: navigate\r\n\
                               Accept: text/html,application/xhtml+xml,*/*;q=0.8\r\nAccept-Language: ja,en;q=0.5\r\n\
                               Content-Type: application/x-www-form-urlencoded\r\nContent-Length: 0\r\n";

/// The lines of an answer, without those that say when it was given, and after which Stop.
fn undated(answer: &str) -> Vec<&str> {
    let of_moment = |line: &str| ["date: ", protocol::STOPS_HEADER].iter().any(|begun| line.starts_with(begun));
    let mut lines: Vec<&str> = answer.lines().filter(|line| !of_moment(line)).collect();
    lines.sort_unstable();
    lines
}

#[tokio::test]
async fn a_form_stops_and_gets_a_page_however_its_request_is_written() {
    let house = House::open().await;
    let site = |site: &str| FORM.replace("same-origin", site);
    let json = FORM.replace("text/html", "application/json");
    for (sent, starts, says) in [
        (FORM, "HTTP/1.1 200", "停止しました"),
        (&FORM.replace("ja,en", "en,ja"), "HTTP/1.1 200", "The robot holds still."),
        (&json.replace("xhtml+xml", "x"), "HTTP/1.1 200", "{\"stopped\":true}"),
        (&site("cross-site"), "HTTP/1.1 403", "胸のボタン"),
        (&site("same-site"), "HTTP/1.1 403", "胸のボタン"),
    ] {
        let [path, whole] = ["/stop?robot=r1".to_owned(), format!("http://{}/stop?robot=r1", house.address)];
        let answer = raw(&house, &line("POST", &path, &house, sent)).await;
        assert!(answer.starts_with(starts) && answer.contains(says), "{sent}: {answer}");
        assert!(answer.contains("cache-control: no-store") && answer.contains("frame-ancestors 'none'"), "{answer}");
        let again = answer.contains("<form method=\"post\" action=\"/stop?robot=r1\">");
        assert_eq!(again, answer.contains("text/html"), "a page has Stop again: {answer}");
        let other = raw(&house, &line("POST", &whole, &house, sent)).await;
        assert_eq!(undated(&answer), undated(&other), "on the accepting thread and elsewhere");
    }
    house.close().await;
}

#[tokio::test]
async fn strangers_are_turned_away() {
    let house = House::open().await;
    let evil = "Origin: http://evil.example\r\nContent-Length: 0\r\n";
    let upgrade = "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
    let bent = "GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n".to_owned();
    let requests = [
        line("POST", "/stop", &house, evil),
        line("GET", "/socket", &house, &format!("{upgrade}Origin: http://evil.example\r\n")),
        line("POST", "/other", &house, "Content-Length: 0\r\n"),
        bent,
    ];
    for request in requests {
        let answer = raw(&house, &request).await;
        assert!(answer.starts_with("HTTP/1.1 403"), "{request}: {answer}");
    }
    house.close().await;
}

#[tokio::test]
async fn health_and_pages_answer() {
    let house = House::open().await;
    for path in ["/healthz", "/readyz"] {
        assert!(raw(&house, &line("GET", path, &house, "")).await.starts_with("HTTP/1.1 200"), "{path}");
    }
    for path in ["/nothing.js", "/../Cargo.toml", "/.git/config", "/app.js.br", "/%2e%2e/x", "/api/behaviours/x.json"] {
        let answer = raw(&house, &line("GET", path, &house, "")).await;
        assert!(answer.starts_with("HTTP/1.1 404") || answer.starts_with("HTTP/1.1 400"), "{path}: {answer}");
    }
    house.close().await;
}

#[tokio::test]
async fn a_behaviour_is_exported_with_its_helpers() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let made = make(&aiko, "Far", Some("Track far and close balls")).await;
    let answer = raw(&house, &line("GET", &format!("/api/behaviours/{made}.json"), &house, "")).await;
    let (head, body) = answer.split_once("\r\n\r\n").unwrap();
    assert!(head.contains("content-type: application/json"), "{head}");
    let file: behaviour::BehaviourFile = serde_json::from_str(body).unwrap();
    assert_eq!(file.name, "Far");
    assert!(!file.helpers.is_empty() && file.records(|_| None).is_ok());
    house.close().await;
}

#[tokio::test]
async fn half_a_header_and_a_silent_socket_do_not_stay() {
    let house = House::open().await;
    let start = Instant::now();
    for begun in ["GET / HTTP/1.1\r\nHost: local", ""] {
        raw(&house, begun).await;
    }
    assert!(start.elapsed() < Duration::from_secs(15), "{:?}", start.elapsed());
    house.close().await;
}

pub(crate) fn post(house: &House, path: &str, body: &str) -> String {
    let more = format!("Origin: http://{}\r\nContent-Length: {}\r\n\r\n{body}", house.address, body.len());
    line("POST", path, house, &more).trim_end_matches("\r\n").to_owned()
}

/// Status line and body of what came back.
pub(crate) async fn asked(house: &House, request: &str) -> (String, String) {
    let answer = raw(house, request).await;
    let (head, body) = answer.split_once("\r\n\r\n").expect("a head and a body");
    let status = head.split_whitespace().nth(1).expect("a status").to_owned();
    (status, body.to_owned())
}

pub(crate) async fn exported(house: &House, id: &str, ending: &str) -> String {
    let (status, body) = asked(house, &line("GET", &format!("/api/behaviours/{id}.{ending}"), house, "")).await;
    assert_eq!(status, "200", "{body}");
    body
}

#[tokio::test]
async fn an_exported_file_comes_back_as_a_copy_or_as_itself() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let made = make(&aiko, "Far <&>", Some("Track far and close balls")).await.to_string();
    let other = House::open().await;
    for ending in ["json", "xml"] {
        let file = exported(&house, &made, ending).await;
        let (status, copied) = asked(&house, &post(&house, "/api/import?by=Ben", &file)).await;
        let copied: serde_json::Value = serde_json::from_str(&copied).unwrap();
        assert_eq!((status.as_str(), &copied["renamedHelpers"]), ("200", &serde_json::json!([])));
        assert!(copied["id"] != made.as_str() && copied["name"].as_str().unwrap().starts_with("Far <&> "));
        let (status, taken) = asked(&house, &post(&house, "/api/import?mode=restore", &file)).await;
        assert!(status == "409" && taken.contains("here already"), "{taken}");
    }
    let file = exported(&house, &made, "json").await;
    let mut copies = Vec::new();
    for _ in 0..2 {
        let (status, copy) = asked(&house, &post(&house, "/api/import?behaviour=wanted", &file)).await;
        let copy: serde_json::Value = serde_json::from_str(&copy).unwrap();
        assert_eq!((status.as_str(), &copy["id"]), ("200", &serde_json::json!("wanted")));
        copies.push((copy["name"].clone(), copy["wasHere"].clone()));
    }
    assert_eq!(copies[0].0, copies[1].0, "sent twice, it is there once");
    assert_eq!([&copies[0].1, &copies[1].1], [false, true]);
    let (status, restored) =
        asked(&other, &post(&other, "/api/import?mode=restore", &exported(&house, &made, "xml").await)).await;
    assert_eq!((status.as_str(), restored.contains(&made)), ("200", true), "{restored}");
    assert_eq!(exported(&other, &made, "json").await, exported(&house, &made, "json").await);
    let svg = exported(&house, &made, "svg").await;
    assert!(svg.contains("<title id=\"title\">Far &lt;&amp;&gt;</title>"), "{svg}");
    for house in [house, other] {
        house.close().await;
    }
}

#[tokio::test]
async fn a_program_keeps_the_script_of_its_name_as_a_file() {
    let house = House::open().await;
    let file = r#"{"format":"rrp-behaviour/1","name":"近いボール","helpers":[],
        "streams":[{"id":"s","kind":"sensor","name":"ボール","device":"RedBall"}],"connectors":[]}"#;
    let (status, made) = asked(&house, &post(&house, "/api/import", file)).await;
    let made: serde_json::Value = serde_json::from_str(&made).unwrap();
    assert_eq!(status, "200", "{made}");
    for ending in ["json", "xml", "svg"] {
        let path = format!("/api/behaviours/{}.{ending}", made["id"].as_str().unwrap());
        let answer = raw(&house, &line("GET", &path, &house, "")).await;
        let own = "filename*=UTF-8''%E8%BF%91%E3%81%84%E3%83%9C%E3%83%BC%E3%83%AB";
        let wanted = format!("attachment; filename=\"program.{ending}\"; {own}.{ending}\r\n");
        assert!(answer.contains(&wanted), "{answer}");
    }
}

#[tokio::test]
async fn a_note_from_a_word_processor_is_exported_as_xml() {
    let house = House::open().await;
    let file = r#"{"format":"rrp-behaviour/1","name":"Agenda","helpers":[],"streams":[],"connectors":[],
        "notes":[{"id":"n","text":"First\u000bthen"}]}"#;
    let (status, made) = asked(&house, &post(&house, "/api/import", file)).await;
    let made: serde_json::Value = serde_json::from_str(&made).unwrap();
    assert_eq!(status, "200", "{made}");
    let xml = exported(&house, made["id"].as_str().unwrap(), "xml").await;
    assert!(xml.contains("First\nthen"), "{xml}");
}

#[tokio::test]
async fn another_kind_of_file_is_named_to_who_brings_it() {
    let house = House::open().await;
    let deep = format!("<ChoregrapheProject>{}{}</ChoregrapheProject>", "<Box>".repeat(9), "</Box>".repeat(9));
    for (file, what) in [(deep.as_str(), "a Choregraphe project"), ("<!DOCTYPE html>\n<html></html>", "a web page")] {
        let (status, told) = asked(&house, &post(&house, "/api/import", file)).await;
        assert!(status == "400" && told.contains(&format!("This is {what}, no program of rrp.")), "{told}");
    }
}

#[tokio::test]
async fn a_helper_that_means_something_else_here_is_told() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let made = make(&aiko, "Far", Some("Track far and close balls")).await.to_string();
    let file = exported(&house, &made, "json").await.replace("0.03 / sin(ball.size)", "1.0 / ball.size");
    let (status, answer) = asked(&house, &post(&house, "/api/import", &file)).await;
    let answer: serde_json::Value = serde_json::from_str(&answer).unwrap();
    assert_eq!(status, "200", "{answer}");
    assert_eq!(answer["renamedHelpers"], serde_json::json!([["ball_to_distance", "ball_to_distance2"]]));
    let copy = exported(&house, answer["id"].as_str().unwrap(), "json").await;
    assert!(copy.contains("\"helper\": \"ball_to_distance2\"") && copy.contains("1.0 / ball.size"), "{copy}");
    house.close().await;
}

#[tokio::test]
async fn a_file_that_cannot_be_imported_is_refused_with_line_and_reason() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let made = make(&aiko, "Far", Some("Track far and close balls")).await.to_string();
    let file = exported(&house, &made, "json").await;
    let cases = [
        (file.replace("\"sensor\"", "\"sense\""), "400", "Line 9, column "),
        (file.replace("\"device\": \"RedBall\"", "\"device\": \"Nose\""), "422", "Nose"),
        (file.replace("distance >= 0.5", "distance >="), "422", "This procedure cannot run"),
        (file.replace("\"name\": \"Far\"", "\"name\": \" \""), "422", "cannot be a name"),
        ("<!DOCTYPE x><behaviour/>".to_owned(), "400", "Line 1, column 1: A program may have no DOCTYPE"),
        (" ".repeat(store::files::FILE_MAX_BYTES + 1), "413", "larger than 8388608 bytes"),
    ];
    for (text, status, reason) in cases {
        let (said, body) = asked(&house, &post(&house, "/api/import", &text)).await;
        let answer: serde_json::Value = serde_json::from_str(&body).unwrap();
        let sentence = answer["error"].as_str().unwrap();
        assert!(said == status && sentence.contains(reason) && sentence.ends_with('.'), "{said} {sentence}");
    }
    let strange = line("POST", "/api/import", &house, "Origin: http://evil.example\r\nContent-Length: 0\r\n");
    assert_eq!(asked(&house, &strange).await.0, "403");
    house.close().await;
}

#[tokio::test]
async fn the_list_and_a_whole_backup_can_be_had() {
    let house = House::open().await;
    let aiko = house.person("Aiko").await;
    let made = make(&aiko, "Far", Some("Track far and close balls")).await.to_string();
    let (_, list) = asked(&house, &line("GET", "/api/behaviours", &house, "")).await;
    assert_eq!(list, format!(r#"[{{"id":"{made}","name":"Far"}}]"#));
    let request = format!("GET /api/backup HTTP/1.0\r\nHost: {}\r\n\r\n", house.address);
    let (status, backup) = asked(&house, &request).await;
    let counted = store::backup::verify(&mut backup.as_bytes()).unwrap();
    assert_eq!((status.as_str(), counted.behaviours), ("200", 2), "the library and one behaviour");
    house.close().await;
}
