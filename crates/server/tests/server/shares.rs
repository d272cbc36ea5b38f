//! Shares of the server belong to people, not to links or addresses: whoever opens, asks or downloads much takes it from
//! themselves.

use crate::browser::{Browser, Socket, status};
use crate::http;
use crate::invited::Scene;
use crate::roles::requests;
use protocol::{AnyRequest, CLOSE_GAVE_WAY, Message, Refused, RequestRow, Role, request};
use std::collections::BTreeSet;
use std::time::{Duration, Instant};
use tokio::io::AsyncReadExt;

/// How long the answers to a flood may take to come.
const PATIENCE: Duration = Duration::from_secs(60);
/// Pages that a guest has at once.
const PAGES: usize = 8;

/// As many pages of somebody as they may have.
async fn pages(browser: &Browser) -> Vec<Socket> {
    let mut pages = Vec::new();
    for _ in 0..PAGES {
        pages.push(browser.socket("Ben").await.unwrap());
    }
    pages
}

#[tokio::test]
async fn a_ninth_page_takes_the_place_of_the_first_which_is_told() {
    let scene = Scene::open().await;
    let (browser, _) = scene.guest(Role::Viewer).await;
    let mut pages = pages(&browser).await;
    let mut ninth = browser.socket("Ben").await.unwrap();
    assert_eq!(pages[0].until_closed().await, Some(CLOSE_GAVE_WAY));
    for page in pages.iter_mut().skip(1).chain([&mut ninth]) {
        assert!(page.ask(request::Runs {}).await.is_ok());
    }
    scene.house.close().await;
}

#[tokio::test]
async fn who_opens_pages_again_and_again_locks_out_neither_host_nor_colleague() {
    let scene = Scene::open().await;
    let (browser, _) = scene.guest(Role::Viewer).await;
    let (mut held, mut refused) = (Vec::new(), 0);
    for _ in 0..60 {
        match browser.socket("Ben").await {
            Ok(socket) => held.push(socket),
            Err(code) => refused += usize::from(code == 429),
        }
    }
    assert!(refused > 20, "opened as often as they like: {refused}");
    let (colleague, _) = scene.guest(Role::Editor).await;
    assert!(colleague.socket("Chie").await.is_ok());
    assert_eq!(scene.house.person("Host").await.you().name, "Host");
    scene.house.close().await;
}

/// What bounds what a viewer may ask, besides what everything passes: eight links, and the requests that a person and those
/// of one invitation have in a time (`connection/budgets.rs`).
const BOUNDS: [(&str, &str); 27] = [
    ("hello", "answered at once; the greeting has one of the eight half open places of a person"),
    ("list", "eight under way of a person; one lookup at a time of an invitation"),
    ("pictures", "as a list; so many of one request; drawn by the workers, one at a time of an invitation"),
    ("whereUsed", "as a list; the longest that is told"),
    ("drivers", "as a list; the longest that is told"),
    ("contested", "as a list"),
    ("similar", "as a list; the longest that is told"),
    ("tags", "as a list"),
    ("open", "four wholes that wait for a link; what is kept for an invitation gives way first; made part by part"),
    ("leave", "answered at once"),
    ("since", "eight under way of a person; one lookup at a time of an invitation; a page at a time"),
    ("history", "eight under way of a person; one lookup at a time of an invitation; a page at a time"),
    ("at", "two under way of a person; one replay at a time of an invitation"),
    ("check", "eight under way of a person; the workers, one at a time of an invitation; each call in time and steps"),
    ("fixes", "eight under way of a person; the workers, one at a time of an invitation"),
    ("types", "eight under way of a person; the workers, one at a time of an invitation"),
    ("told", "eight under way of a person; the workers, one at a time of an invitation; so many sentences"),
    ("tryExercise", "eight under way of a person; the workers, one at a time of an invitation, ended with who asks"),
    ("present", "nothing waits; people are told at their own pace"),
    ("presentMoment", "as `present`; a past with a short name, and only the one that the link asked about last"),
    ("callMe", "known in memory; written with others once in a while, apart from revoking"),
    ("runs", "answered at once, from memory"),
    ("recordings", "eight under way of a person; the threads for files, one at a time of an invitation"),
    ("marks", "as the recordings; a line of the file at a time, and as many marks as a recording may have"),
    (
        "lookBack",
        "eight people; eight under way of a person; the analyses, one at a time of an invitation, each in a time",
    ),
    ("watch", "answered at once; the newest is told at the link's own pace"),
    ("stop", "never bounded: it passes before all that"),
];

#[test]
fn nothing_that_a_viewer_may_ask_is_left_without_a_bound() {
    let bounded: BTreeSet<String> = BOUNDS.iter().map(|(name, _)| (*name).to_owned()).collect();
    let asked = AnyRequest::TABLE.iter().filter(|row| row.role == Role::Viewer);
    assert_eq!(bounded, asked.map(RequestRow::wire_name).collect());
}

/// Asks on two links in turn, so often that one person may not; how often it was not refused for that, and in what time.
async fn flooded(browser: &Browser, request: &AnyRequest) -> (u32, f64) {
    const EACH: u32 = 300;
    let mut links = [browser.socket("Ben").await.unwrap(), browser.socket("Ben").await.unwrap()];
    let began = Instant::now();
    for _ in 0..EACH {
        for link in &mut links {
            link.send(request.clone()).await;
        }
    }
    let mut done = 0;
    for link in &mut links {
        let mut left = EACH;
        while left > 0 {
            match link.next().await.unwrap() {
                Message::Answer { .. } => (left, done) = (left - 1, done + 1),
                Message::No { ask: Some(_), no } => (left, done) = (left - 1, done + u32::from(no != Refused::TooFast)),
                _ => {}
            }
        }
    }
    (done, began.elapsed().as_secs_f64())
}

#[tokio::test]
async fn whatever_a_viewer_asks_counts_for_all_their_links_together() {
    let scene = Scene::open().await;
    // Not answered, not bounded, or a link that opens a program again and again and is cut off for that.
    let apart = ["Present", "PresentMoment", "Stop", "Open"];
    let asked = requests().into_iter().filter(|(_, least)| *least == Role::Viewer).map(|(one, _)| one);
    for request in asked.filter(|one| !apart.contains(&one.row().name)) {
        let (browser, _) = scene.guest(Role::Viewer).await;
        let flooded = tokio::time::timeout(PATIENCE, flooded(&browser, &request)).await;
        let (done, seconds) = flooded.unwrap_or_else(|_| panic!("{request:?} is not answered"));
        let most = 200.0 + 50.0 * seconds + 10.0;
        assert!(f64::from(done) <= most, "{request:?}: {done} in {seconds} s");
    }
    scene.house.close().await;
}

#[tokio::test]
async fn downloads_that_a_guest_does_not_read_refuse_nobody_else() {
    let scene = Scene::open().await;
    let recording = "2026-01-01T00-00-00Z-slow.jsonl";
    std::fs::create_dir_all(scene.data.path().join("recordings")).unwrap();
    // Longer than what may be on its way to somebody who reads nothing.
    let file = std::fs::File::create(scene.data.path().join("recordings").join(recording)).unwrap();
    file.set_len(256 << 20).unwrap();
    let (browser, _) = scene.guest(Role::Viewer).await;
    let mut held = Vec::new();
    for _ in 0..12 {
        let request = browser.request("GET", &format!("/api/recordings/{recording}"), "", "");
        let mut stream = browser.begin(&request).await.unwrap();
        let mut begun = [0; 12];
        stream.read_exact(&mut begun).await.unwrap();
        held.push((String::from_utf8_lossy(&begun).into_owned(), stream));
    }
    let begun = held.iter().filter(|(answer, _)| answer.ends_with("200")).count();
    assert!((1..12).contains(&begun), "{begun}");
    let backup = format!("GET /api/backup HTTP/1.1\r\nHost: {}\r\n\r\n", scene.house.address);
    assert_eq!(status(&http::raw(&scene.house, &backup).await), 200, "the host takes a backup");
    let (colleague, _) = scene.guest(Role::Editor).await;
    assert_eq!(status(&colleague.get("/api/backup").await), 200, "and so does a colleague");
    drop(held);
    scene.house.close().await;
}
