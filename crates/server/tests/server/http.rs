//! The routes: who may come in, what is sent, and Stop.

use crate::house::{House, make};
use std::time::{Duration, Instant};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;

/// Sends a request as it is and answers with everything that came back.
pub(crate) async fn raw(house: &House, request: &str) -> String {
    let mut stream = TcpStream::connect(house.address).await.unwrap();
    stream.write_all(request.as_bytes()).await.unwrap();
    let mut answer = Vec::new();
    let _ = tokio::time::timeout(Duration::from_secs(10), stream.read_to_end(&mut answer)).await.unwrap();
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
    assert!(answer.contains("content-security-policy: default-src 'none'; script-src 'self' 'wasm-unsafe-eval'"));
    assert!(answer.contains("x-content-type-options: nosniff") && answer.contains("referrer-policy: no-referrer"));
    let origin = format!("Origin: http://{}\r\n", house.address);
    let form = format!("{origin}Content-Type: application/x-www-form-urlencoded\r\nContent-Length: 3\r\n\r\na=b");
    let answer = raw(&house, &line("POST", "/stop?behaviour=x", &house, &form)).await;
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
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
