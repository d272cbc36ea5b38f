//! Those who come through a proxy, which speaks plain HTTP to the server: to this computer's own address, and yet they are
//! not at this computer.

use crate::browser::{status, token};
use crate::house::House;
use crate::http::FORM;
use server::{GuestNetwork, Secured};
use std::net::SocketAddr;
use std::sync::Arc;
use store::MemoryStore;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;

const ORIGIN: &str = "Origin: https://rrp.example\r\nContent-Type: application/x-www-form-urlencoded\r\n";

/// What the proxy hears for a request that it hands on.
async fn handed_on(proxy: SocketAddr, method: &str, path: &str, more: &str, body: &str) -> String {
    let mut stream = TcpStream::connect(proxy).await.unwrap();
    let head = format!("{method} {path} HTTP/1.1\r\nHost: {proxy}\r\nContent-Length: {}\r\n{more}\r\n", body.len());
    stream.write_all(format!("{head}{body}").as_bytes()).await.unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).await.unwrap();
    answer
}

#[tokio::test]
async fn a_proxy_on_this_computer_opens_nothing_by_itself() {
    let secured = Secured::Proxy { origin: "https://rrp.example".into() };
    let network = GuestNetwork { listen: "127.0.0.1:0".parse().unwrap(), secured };
    let house = House::with(Arc::new(MemoryStore::default()), Some(network), None).await;
    let (proxy, link) = (house.network.unwrap(), house.link.clone().unwrap());
    assert!(link.starts_with("https://rrp.example/come-in#"), "{link}");
    assert_eq!(status(&handed_on(proxy, "GET", "/healthz", "", "").await), 200);
    for host in ["", "X-Forwarded-For: 127.0.0.1\r\n", "X-Forwarded-Host: localhost\r\nForwarded: for=127.0.0.1\r\n"] {
        assert_eq!(status(&handed_on(proxy, "GET", "/api/behaviours", host, "").await), 401);
        assert_eq!(status(&handed_on(proxy, "POST", "/stop", host, "").await), 403);
    }
    let own = format!("token={}", token(&link));
    let here = format!("Origin: http://{proxy}\r\nContent-Type: application/x-www-form-urlencoded\r\n");
    assert_eq!(status(&handed_on(proxy, "POST", "/come-in", &here, &own).await), 403, "not a page of the proxy");

    // Each is slowed by what the proxy says of it, not by what it says itself.
    let from = |own: &str, seen: &str| format!("{ORIGIN}X-Forwarded-For: {own}, {seen}\r\n");
    let mut last = 0;
    for guess in 0..20 {
        let forged = from(&format!("10.1.1.{guess}"), "10.0.0.66");
        last = status(&handed_on(proxy, "POST", "/come-in", &forged, "token=wrong").await);
    }
    assert_eq!(last, 429);
    let answer = handed_on(proxy, "POST", "/come-in", &from("10.0.0.66", "10.0.0.5"), &own).await;
    assert_eq!(status(&answer), 303, "{answer}");
    let cookie = answer.lines().find_map(|line| line.strip_prefix("set-cookie: ")).unwrap();
    assert!(cookie.starts_with("__Host-rrp=") && cookie.contains("; Secure"), "{cookie}");
    let cookie = format!("Cookie: a=b; {}\r\n", cookie.split(';').next().unwrap());
    assert_eq!(status(&handed_on(proxy, "GET", "/api/behaviours", &cookie, "").await), 200);
    assert_eq!(status(&handed_on(proxy, "POST", "/stop", &format!("{ORIGIN}{cookie}"), "").await), 200);
    // Without script, where the browser does not say from which page.
    let form = FORM.replace("Content-Length: 0\r\n", &cookie);
    for path in ["/stop".to_owned(), format!("http://{proxy}/stop")] {
        let answer = handed_on(proxy, "POST", &path, &form, "").await;
        assert!(status(&answer) == 200 && answer.contains("停止しました"), "{answer}");
        let elsewhere = form.replace("same-origin", "cross-site");
        let answer = handed_on(proxy, "POST", &path, &elsewhere, "").await;
        assert!(status(&answer) == 403 && answer.contains("胸のボタン"), "{answer}");
    }
    house.close().await;
}
