//! A second host: a computer of its own in a network that the test makes, from which people come to a real server with an
//! invitation or without one.
//!
//! The network is made of what Linux gives to everybody: the test starts itself again as the root of a user namespace with
//! an empty network, adds another one, and lays a wire between the two. Nothing outside is touched.

#![expect(clippy::print_stdout, reason = "what was measured is for whoever runs it with --nocapture")]

#[expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]
#[path = "../../crates/server/tests/server/browser.rs"]
mod browser;
mod flood;
mod floods;
mod guesses;
mod wire;

use behaviour::Id;
use browser::{Browser, Socket, status};
use floods::Bar;
use house::{Outcome, Server, Trouble, skip};
use protocol::{AnyRequest, CLOSE_REVOKED, Event, Invitation, Lasts, ListQuery, Refused, Role, request};
use serde_json::json;
use shell::Client;
use std::time::Duration;
use wire::Network;

/// What the test is called among those that are run or skipped.
const PART: &str = "invitations: a second host";
/// How soon who is revoked has to be out.
const OUT: Duration = Duration::from_secs(2);

#[test]
fn a_second_host_comes_in_by_invitation_only() -> Outcome<()> {
    if wire::is_inside() {
        let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build()?;
        return runtime.block_on(scene());
    }
    skip::unless!(built(PART));
    skip::unless!(possible(PART, wire::missing()));
    wire::again_inside("a_second_host_comes_in_by_invitation_only")
}

/// Wrong links, and what 99 of 100 Stops may take meanwhile, in a run of all tests and where it is measured.
const GUESSES: [(usize, Duration); 2] = [(400, Duration::from_secs(2)), (100_000, Duration::from_millis(50))];

#[test]
fn stop_is_heard_while_links_are_guessed() -> Outcome<()> {
    guessed("stop_is_heard_while_links_are_guessed", GUESSES[0], None)
}

#[test]
#[ignore = "measured by `cargo xtask bench rooms`"]
fn figure_7_stop_while_links_are_guessed() -> Outcome<()> {
    guessed("figure_7_stop_while_links_are_guessed", GUESSES[1], Some(house::optimised()))
}

/// Stops under each flood, in a run of all tests and where it is measured: for a minute.
const FLOODS: [Bar; 2] = [
    Bar { stops: 25, p99: Duration::from_secs(3), rest: Duration::from_millis(10) },
    Bar { stops: 300, p99: Duration::from_millis(250), rest: Duration::from_millis(190) },
];

#[test]
fn stop_is_heard_while_strangers_flood_the_way_in() -> Outcome<()> {
    flooded("stop_is_heard_while_strangers_flood_the_way_in", FLOODS[0], None)
}

#[test]
#[ignore = "measured by `cargo xtask bench rooms`"]
fn figure_8_stop_while_strangers_flood_the_way_in() -> Outcome<()> {
    flooded("figure_8_stop_while_strangers_flood_the_way_in", FLOODS[1], Some(house::optimised()))
}

#[test]
#[ignore = "started by the others, as a process of its own"]
fn strangers_flood() -> Outcome<()> {
    let Ok(told) = std::env::var(flood::TOLD) else { return Ok(()) };
    tokio::runtime::Builder::new_current_thread().enable_all().build()?.block_on(flood::flood(&told))
}

fn flooded(test: &str, bar: Bar, optimised: Option<std::path::PathBuf>) -> Outcome<()> {
    let part = "invitations: floods from a second host";
    if wire::is_inside() {
        let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build()?;
        return runtime.block_on(async { floods::flooded(&Network::lay().await?, optimised.as_deref(), bar).await });
    }
    let is_there = if optimised.is_some() { skip::optimised(part) } else { skip::built(part) };
    if !is_there || !skip::possible(part, wire::missing()) {
        return Ok(());
    }
    wire::again_inside(test)
}

fn guessed(test: &str, guesses: (usize, Duration), optimised: Option<std::path::PathBuf>) -> Outcome<()> {
    let part = "invitations: guesses from a second host";
    if wire::is_inside() {
        let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build()?;
        return runtime.block_on(async {
            let network = Network::lay().await?;
            let folder = house::folder()?;
            let listen = ["--listen", &format!("{}:0", wire::HERE)];
            let server = match optimised {
                Some(binary) => Server::start_binary(&binary, folder.path(), &listen).await?,
                None => Server::start_with(folder.path(), &listen).await?,
            };
            guesses::guessed(&network, &server, folder.path(), guesses).await
        });
    }
    let is_there = if optimised.is_some() { skip::optimised(part) } else { skip::built(part) };
    if !is_there || !skip::possible(part, wire::missing()) {
        return Ok(());
    }
    wire::again_inside(test)
}

/// An invitation, and its link.
async fn invite(aiko: &Client, role: Role) -> Outcome<(Invitation, String)> {
    let wish = request::Invite { role, lasts: Lasts::UntilRevoked, label: "a second host".into() };
    let invited = aiko.ask(wish).await.map_err(said)?;
    Ok((*invited.invitation, invited.link))
}

/// At the server's computer: Aiko and what she has made.
struct Home {
    aiko: Client,
    play: Id,
}

impl Home {
    /// Ends an invitation; who came by it has to be out in time.
    async fn revoke(&self, invitation: Invitation, mut socket: Socket) -> Outcome<()> {
        self.aiko.ask(request::Revoke { invitation: invitation.id }).await.map_err(said)?;
        let closed = tokio::time::timeout(OUT, socket.until_closed()).await;
        assert_eq!(closed.map_err(|_| Trouble("A revoked guest is still in.".into()))?, Some(CLOSE_REVOKED));
        Ok(())
    }
}

fn said(trouble: impl std::fmt::Display) -> Trouble {
    Trouble(trouble.to_string())
}

async fn scene() -> Outcome<()> {
    let network = Network::lay().await?;
    let folder = house::folder()?;
    let server = Server::start_with(folder.path(), &["--listen", &format!("{}:0", wire::HERE)]).await?;
    let aiko = Client::connect(&server.url(), "Aiko").await.map_err(said)?;
    let play = Id::new("yuki-morning")?;
    let make = request::Create { behaviour: play.clone(), name: "Yuki morning".into(), template: None };
    aiko.ask(make).await.map_err(said)?;
    aiko.load(&play).await.map_err(said)?;
    let mut home = Home { aiko, play };
    let (editing, link) = invite(&home.aiko, Role::Editor).await?;
    assert!(link.starts_with(&format!("https://{}:", wire::HERE)), "{link}");
    let far = Browser::new(folder.path(), &link);

    let stranger = far.stranger();
    network.do_there(async move { without_an_invitation(&stranger).await }).await?;

    let (mut browser, play) = (far.clone(), home.play.clone());
    let change = home.aiko.change("Rename", &behaviour::Behaviour::default(), Vec::new());
    let socket = network.do_there(async move { as_an_editor(&mut browser, &link, play, change).await }).await?;
    home.aiko
        .until(|told| matches!(told, Event::Accepted { accepted, .. } if accepted.change.author == "Ben"))
        .await
        .map_err(said)?;
    home.revoke(editing, socket).await?;

    let ((looking, link), mut browser, play) = (invite(&home.aiko, Role::Viewer).await?, far, home.play.clone());
    let socket = network.do_there(async move { as_a_viewer(&mut browser, &link, &play).await }).await?;
    home.revoke(looking, socket).await?;
    let list = request::List { query: ListQuery::default() };
    let programs = home.aiko.ask(list).await.map_err(said)?.programs;
    assert_eq!(programs.len(), 1, "the viewer made nothing");
    Ok(())
}

async fn without_an_invitation(browser: &Browser) {
    assert_eq!(status(&browser.get("/healthz").await), 200);
    for path in ["/", "/index.html", "/api/behaviours", "/api/behaviours/yuki-morning.json", "/api/backup", "/readyz"] {
        let answer = browser.get(path).await;
        assert!(status(&answer) == 401 && answer.contains("invit"), "{path}: {answer}");
        assert!(!answer.contains("Yuki") && !answer.contains("Aiko"), "{path}: {answer}");
    }
    assert_eq!(status(&browser.post("/stop", "").await), 403);
    assert_eq!(browser.socket("Nobody").await.err(), Some(401));
    // The way of the server's own computer does not reach this far.
    let local = tokio::net::TcpStream::connect((wire::HERE, 7130)).await;
    assert!(local.is_err(), "nothing else listens there");
}

async fn as_an_editor(browser: &mut Browser, link: &str, play: Id, change: behaviour::Change) -> Socket {
    assert_eq!(status(&browser.join(link).await), 303);
    assert!(browser.get("/api/behaviours").await.contains("Yuki morning"));
    let mut ben = browser.socket("Ben").await.unwrap_or_else(|status| panic!("{status}"));
    let opened = ben.ask(request::Open { behaviour: play.clone() }).await;
    assert!(opened.is_ok(), "{opened:?}");
    let edits = json!([{
        "id": "stream/far", "before": null,
        "after": {"stream": {"kind": "ordinary", "name": "Far", "params": {}, "order": 0}},
    }]);
    let edits = serde_json::from_value(edits).unwrap_or_else(|error| panic!("{error}"));
    let proposed =
        request::Propose { behaviour: play, change: behaviour::Change { edits, ..change }, tokens: Vec::new() };
    let answer = ben.ask(proposed).await;
    assert!(answer.is_ok(), "{answer:?}");
    ben
}

async fn as_a_viewer(browser: &mut Browser, link: &str, play: &Id) -> Socket {
    assert_eq!(status(&browser.join(link).await), 303);
    let mut chie = browser.socket("Chie").await.unwrap_or_else(|status| panic!("{status}"));
    let opened = chie.ask(request::Open { behaviour: play.clone() }).await;
    assert!(opened.is_ok(), "{opened:?}");
    let change = json!({"op": "o1", "label": "x", "author": "x", "at_ms": 0, "edits": []});
    let writes = [
        (json!({"is": "create", "behaviour": "made", "name": "x", "template": null}), Role::Editor),
        (json!({"is": "remove", "behaviour": play}), Role::Editor),
        (json!({"is": "restore", "behaviour": play}), Role::Editor),
        (json!({"is": "propose", "behaviour": play, "change": change}), Role::Editor),
        (json!({"is": "lock", "behaviour": play, "records": ["stream/far"]}), Role::Editor),
        (json!({"is": "takeOver", "behaviour": play, "record": "stream/far"}), Role::Host),
        (json!({"is": "start", "behaviour": play}), Role::Operator),
        (json!({"is": "addRobot", "robot": "other", "name": "Other"}), Role::Operator),
        (json!({"is": "invite", "role": "editor", "lasts": "day", "label": ""}), Role::Host),
    ];
    for (write, least) in writes {
        let request: AnyRequest =
            serde_json::from_value(write.clone()).unwrap_or_else(|error| panic!("{write}: {error}"));
        assert_eq!(chie.ask_any(request).await, Err(Refused::Role(least)), "{write}");
    }
    for path in ["/api/import", "/api/import?mode=restore"] {
        let answer = browser.post(path, "{}").await;
        assert!(status(&answer) == 403 && answer.contains("an editor"), "{path}: {answer}");
    }
    assert_eq!(status(&browser.get("/api/backup").await), 403);
    assert_eq!(status(&browser.get(&format!("/api/behaviours/{play}.json")).await), 200, "reading is fine");
    assert!(chie.ask(request::Stop { behaviour: None, robot: None }).await.is_ok());
    assert_eq!(status(&browser.post("/stop", "").await), 200, "Stop is for everybody who is in");
    chie
}
