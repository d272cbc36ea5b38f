//! Who is host: who shows a secret of this computer, and nobody else who comes from it.

use crate::browser::{status, token};
use crate::house::House;
use crate::http::{raw, unproven};
use std::sync::Arc;
use store::MemoryStore;
use tokio_tungstenite::connect_async;
use tokio_tungstenite::tungstenite::Error;

const FORM: &str = "Content-Type: application/x-www-form-urlencoded\r\n";

/// A request of a page at this computer.
fn asked(house: &House, method: &str, path: &str, more: &str, body: &str) -> String {
    let (address, length) = (house.address, body.len());
    let head = format!("Host: {address}\r\nOrigin: http://{address}\r\nConnection: close\r\n{more}");
    format!("{method} {path} HTTP/1.1\r\n{head}Content-Length: {length}\r\n\r\n{body}")
}

async fn comes_in(house: &House, link: &str) -> String {
    unproven(house, &asked(house, "POST", "/come-in", FORM, &format!("token={}", token(link)))).await
}

/// A link for one more browser of the host.
async fn next_link(house: &House) -> String {
    let answer = raw(house, &asked(house, "POST", "/api/host-link", "", "")).await;
    answer.split('"').find(|part| part.starts_with("http://")).unwrap().to_owned()
}

/// The cookie that an answer gives, as a line of later requests.
fn cookie(answer: &str) -> String {
    let given = answer.lines().find_map(|line| line.strip_prefix("set-cookie: ")).unwrap();
    assert!(given.contains("; HttpOnly") && given.contains("SameSite=Strict"), "{given}");
    format!("Cookie: a=b; {}\r\n", given.split(';').next().unwrap())
}

#[tokio::test]
async fn who_comes_from_this_computer_and_shows_nothing_may_only_stop() {
    let house = House::open().await;
    for path in ["/api/behaviours", "/api/backup", "/readyz", "/boot.js", "/api/recordings", "/catalogue"] {
        let answer = unproven(&house, &asked(&house, "GET", path, "", "")).await;
        assert!(status(&answer) == 401 && answer.contains("rrp open"), "{path}: {answer}");
    }
    let page = unproven(&house, &asked(&house, "GET", "/", "", "")).await;
    assert!(status(&page) == 401 && page.contains("rrp open") && page.contains("action=\"/stop\""), "{page}");
    for path in ["/api/import", "/api/host-link"] {
        assert_eq!(status(&unproven(&house, &asked(&house, "POST", path, "", "{}")).await), 401, "{path}");
    }
    let socket = connect_async(format!("ws://{}/socket", house.address)).await;
    assert!(matches!(socket, Err(Error::Http(answer)) if answer.status() == 401));
    // Also written so that the thread that accepts does not see that it is one.
    for path in ["/stop", &format!("http://{}/stop", house.address)] {
        assert_eq!(status(&unproven(&house, &asked(&house, "POST", path, "", "")).await), 200, "{path}");
    }
    assert_eq!(status(&unproven(&house, &asked(&house, "GET", "/healthz", "", "")).await), 200);
    house.close().await;
}

#[tokio::test]
async fn a_link_makes_one_browser_the_hosts_and_another_one_the_next() {
    let folder = tempfile::tempdir().unwrap();
    let house = House::beside(Arc::new(MemoryStore::default()), folder.path()).await;
    let link = house.host_link.clone().unwrap();
    let came = comes_in(&house, &link).await;
    assert_eq!(status(&came), 303, "{came}");
    let own = cookie(&came);
    assert_eq!(status(&unproven(&house, &asked(&house, "GET", "/api/behaviours", &own, "")).await), 200);
    let again = comes_in(&house, &link).await;
    assert!(status(&again) == 403 && again.contains("rrp open") && again.contains("/stop"), "{again}");
    let held = unproven(&house, &asked(&house, "POST", "/come-in", &format!("{own}{FORM}"), "token=x")).await;
    assert_eq!(status(&held), 303, "who is in already goes to the page");

    let next = next_link(&house).await;
    assert_eq!(status(&comes_in(&house, &next).await), 303);
    house.close().await;

    let house = House::beside(Arc::new(MemoryStore::default()), folder.path()).await;
    // Browsers name the cookie after the port, which is another one here.
    let value = own.trim().rsplit_once('=').unwrap().1;
    let kept = format!("Cookie: rrp-host-{}={value}\r\n", house.address.port());
    assert_eq!(status(&unproven(&house, &asked(&house, "GET", "/api/behaviours", &kept, "")).await), 200);
    let forged = kept.replace(&value[..4], "AAAA");
    assert_eq!(status(&unproven(&house, &asked(&house, "GET", "/api/behaviours", &forged, "")).await), 401);
    house.close().await;
}

#[tokio::test]
async fn a_proxy_that_nobody_declared_makes_nobody_host() {
    let house = House::open().await;
    for said in ["X-Forwarded-For: 203.0.113.9", "X-Forwarded-Proto: https", "X-Real-IP: 1.2.3.4", "Forwarded: for=x"] {
        for (method, path) in [("GET", "/"), ("GET", "/api/backup"), ("POST", "/api/import"), ("POST", "/stop")] {
            let more = format!("{said}\r\n");
            let answer = unproven(&house, &asked(&house, method, path, &more, "")).await;
            assert!(status(&answer) == 403 && answer.contains("--behind-proxy"), "{method} {path} {said}: {answer}");
        }
        let of_host = raw(&house, &asked(&house, "POST", "/stop", &format!("{said}\r\n"), "")).await;
        assert_eq!(status(&of_host), 200, "who is known is never refused a Stop");
        let backup = raw(&house, &asked(&house, "GET", "/api/backup", &format!("{said}\r\n"), "")).await;
        assert_eq!(status(&backup), 403, "and nothing else, not even by the host's own cookie");
    }
    // As nginx does unless it is told more: nothing says that it speaks for somebody else.
    let plain = format!("GET /api/backup HTTP/1.0\r\nHost: {}\r\nConnection: close\r\n\r\n", house.address);
    assert_eq!(status(&unproven(&house, &plain).await), 401);
    house.close().await;
}

/// The case `behind-a-tunnel`.
#[tokio::test]
async fn through_a_tunnel_at_another_port_the_host_comes_in_and_a_page_of_another_port_does_not() {
    let house = House::open().await;
    let through = |method: &str, path: &str, host: &str, origin: &str, more: &str, body: &str| {
        let head = format!("Host: {host}\r\nOrigin: http://{origin}\r\nConnection: close\r\n{more}");
        format!("{method} {path} HTTP/1.1\r\n{head}Content-Length: {}\r\n\r\n{body}", body.len())
    };
    for tunnel in ["localhost:8080", "127.0.0.1:8080", "[::1]:8080", "localhost"] {
        let page = unproven(&house, &through("GET", "/", tunnel, tunnel, "", "")).await;
        let port = tunnel.rsplit_once(':').map_or("80", |(_, port)| port);
        let says = format!("with {port} in the place of its port");
        assert!(status(&page) == 401 && page.contains(&says), "{tunnel}: {page}");
        assert_eq!(status(&unproven(&house, &through("POST", "/stop", tunnel, tunnel, "", "")).await), 200, "{tunnel}");
        let link = next_link(&house).await;
        let token = format!("token={}", token(&link));
        let came = unproven(&house, &through("POST", "/come-in", tunnel, tunnel, FORM, &token)).await;
        assert_eq!(status(&came), 303, "{tunnel}: {came}");
        let backup = through("GET", "/api/backup", tunnel, tunnel, &cookie(&came), "");
        assert_eq!(status(&unproven(&house, &backup).await), 200, "{tunnel}");
        for origin in ["localhost:3000", "evil.example:8080", &house.address.to_string()] {
            let other = through("POST", "/stop", tunnel, origin, &cookie(&came), "");
            assert_eq!(status(&unproven(&house, &other).await), 403, "{origin} to {tunnel}");
        }
    }
    let named = unproven(&house, &through("GET", "/", "rrp.example:8080", "rrp.example:8080", "", "")).await;
    assert!(status(&named) == 403 && named.contains("by localhost, 127.0.0.1 or [::1]"), "{named}");
    house.close().await;
}

#[tokio::test]
async fn the_files_with_the_key_are_for_the_servers_user_only() {
    let folder = tempfile::tempdir().unwrap();
    let house = House::beside(Arc::new(MemoryStore::default()), folder.path()).await;
    let kept = host_key::in_folder(folder.path()).unwrap();
    assert_eq!((kept.address, host_key::header(&kept.key)), (house.address, house.key()));
    #[cfg(unix)]
    for file in ["rrp.host.json", "rrp.host-cookies.json"] {
        use std::os::unix::fs::PermissionsExt;
        let mode = std::fs::metadata(folder.path().join(file)).unwrap().permissions().mode();
        assert_eq!(mode & 0o077, 0, "{file}");
    }
    house.close().await;
    assert_eq!(host_key::in_folder(folder.path()), None, "a server that ended leaves none");
}
