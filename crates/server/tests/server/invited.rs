//! Those who come from elsewhere: by invitation, over TLS, and not otherwise.

use crate::browser::{Browser, Socket, status, token};
use crate::house::{House, make, plain, stream_id};
use crate::http::FORM;
use behaviour::Id;
use protocol::{CLOSE_REVOKED, Event, Invitation, Lasts, Refused, Role, answer, request};
use shell::Client;
use tempfile::TempDir;

/// A server with a behaviour that nobody should hear of, who is at its computer, and somebody elsewhere.
pub(crate) struct Scene {
    pub(crate) house: House,
    pub(crate) aiko: Client,
    pub(crate) play: Id,
    pub(crate) data: TempDir,
    pub(crate) link: String,
}

impl Scene {
    pub(crate) async fn open() -> Self {
        let data = tempfile::tempdir().unwrap();
        let house = House::for_others(data.path()).await;
        let aiko = house.person("Aiko").await;
        let play = make(&aiko, "Yuki morning", None).await;
        aiko.load(&play).await.unwrap();
        let link = house.link.clone().unwrap();
        Self { house, aiko, play, data, link }
    }

    pub(crate) fn browser(&self) -> Browser {
        Browser::new(self.data.path(), &self.link)
    }

    pub(crate) async fn invite(&self, role: Role, lasts: Lasts) -> (Invitation, String) {
        let invite = request::Invite { role, lasts, label: "Ben".into() };
        let answer::Invited { invitation, link, qr, fingerprint } = self.aiko.ask(invite).await.unwrap();
        assert!(qr.len() >= 21 && fingerprint.is_some_and(|print| print.len() == 95));
        (*invitation, link)
    }

    /// Somebody who came in as this.
    pub(crate) async fn guest(&self, role: Role) -> (Browser, Invitation) {
        let (invitation, link) = self.invite(role, Lasts::UntilRevoked).await;
        let mut browser = self.browser();
        assert_eq!(status(&browser.join(&link).await), 303);
        (browser, invitation)
    }
}

#[tokio::test]
async fn a_stranger_gets_the_asking_page_and_health_and_no_names() {
    let scene = Scene::open().await;
    let mut browser = scene.browser();
    let file = format!("/api/behaviours/{}.json", scene.play);
    let paths = [
        "/api/behaviours",
        &file,
        "/api/backup",
        "/api/recordings",
        "/api/recordings/x.jsonl",
        "/api/robots/nao/camera",
        "/readyz",
    ];
    for cookie in [None, Some(format!("__Host-rrp-{}=guess", browser.address.port()))] {
        browser.cookie = cookie;
        assert_eq!(status(&browser.get("/healthz").await), 200);
        for path in ["/", "/index.html", "/app.js", "/anything/else", "/come-in"] {
            let answer = browser.get(path).await;
            assert_eq!(status(&answer), if path == "/come-in" { 200 } else { 401 }, "{answer}");
            assert!(answer.contains("nvit") && !answer.contains("Yuki") && !answer.contains("Aiko"), "{answer}");
            assert!(answer.contains("content-security-policy: default-src 'none'"), "{answer}");
        }
        for path in paths {
            let answer = browser.get(path).await;
            assert!(status(&answer) == 401 && !answer.contains("Yuki"), "{path}: {answer}");
        }
        for path in ["/api/import", "/stop"] {
            let answer = browser.post(path, "{}").await;
            assert!(matches!(status(&answer), 401 | 403), "{path}: {answer}");
        }
        assert_eq!(browser.socket("Stranger").await.err(), Some(401));
    }
    // Without TLS there is nothing at all.
    let Ok(mut plain) = tokio::net::TcpStream::connect(browser.address).await else { panic!() };
    use tokio::io::{AsyncReadExt, AsyncWriteExt};
    plain.write_all(b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n").await.unwrap();
    let mut answer = Vec::new();
    drop(plain.read_to_end(&mut answer).await);
    assert!(!String::from_utf8_lossy(&answer).contains("HTTP/1.1 200"));
    scene.house.close().await;
}

#[tokio::test]
async fn a_link_becomes_a_cookie_that_only_the_browser_sees() {
    let scene = Scene::open().await;
    let mut browser = scene.browser();
    let answer = browser.join(&scene.link).await;
    assert_eq!(status(&answer), 303);
    let lines: Vec<&str> = answer.lines().collect();
    assert!(lines.contains(&"location: /") && !answer.contains(token(&scene.link)), "{answer}");
    let cookie = lines.iter().find_map(|line| line.strip_prefix("set-cookie: ")).unwrap();
    let flags: Vec<&str> = cookie.split("; ").skip(1).collect();
    for flag in ["HttpOnly", "Secure", "SameSite=Strict", "Path=/"] {
        assert!(flags.contains(&flag), "{cookie}");
    }
    assert!(cookie.starts_with("__Host-") && !flags.iter().any(|flag| flag.starts_with("Domain")), "{cookie}");
    let secret = browser.cookie.as_deref().unwrap().split_once('=').unwrap().1;
    assert!(secret.len() >= 43 && secret != token(&scene.link));
    assert!(browser.get("/api/behaviours").await.contains("Yuki morning"));
    scene.house.close().await;
}

/// What the page of a link says before its button is pressed.
async fn asks(browser: &Browser, link: &str) -> String {
    browser.post("/come-in/invitation", &format!("token={}", token(link))).await
}

#[tokio::test]
async fn the_page_of_a_link_says_who_invites_and_what_for_and_does_not_use_it_up() {
    let scene = Scene::open().await;
    let mut browser = scene.browser();
    let table =
        [(Role::Viewer, "watch what a robot does"), (Role::Operator, "run a robot"), (Role::Editor, "build robot")];
    for (role, what_for) in table {
        let (invitation, link) = scene.invite(role, Lasts::Once).await;
        let says = asks(&browser, &link).await;
        assert!(status(&says) == 200 && says.contains("Aiko invites you to ") && says.contains(what_for), "{says}");
        assert!(!says.contains("Yuki") && !says.contains("Ben"), "nothing else is told: {says}");
        assert_eq!(status(&browser.join(&link).await), 303, "it was not used up");
        let used = asks(&browser, &link).await;
        assert!(status(&used) == 403 && used.contains("Ask for another invitation"), "{used}");
        scene.aiko.ask(request::Revoke { invitation: invitation.id }).await.unwrap();
    }
    let first = asks(&browser, &scene.link).await;
    assert!(first.contains("The person at the robot’s computer invites you"), "{first}");
    // Guessing here is slowed as it is where links are used.
    let mut answers = Vec::new();
    for guess in 0..12 {
        answers.push(status(&asks(&browser, &format!("{}{guess}", scene.link)).await));
    }
    assert!(answers.contains(&429) && !answers.contains(&200), "{answers:?}");
    assert_eq!(status(&asks(&browser, &scene.link).await), 200, "whatever was guessed, a link that works is answered");
    scene.house.close().await;
}

#[tokio::test]
async fn a_link_for_one_person_is_not_used_up_by_looking_and_works_once() {
    let scene = Scene::open().await;
    let (mut first, mut second) = (scene.browser(), scene.browser());
    let page = scene.link.strip_prefix(&format!("https://{}", first.address)).unwrap().split('#').next().unwrap();
    for _ in 0..3 {
        assert!(first.get(page).await.contains("Come in"), "a messenger looks at the link");
    }
    assert_eq!(status(&first.join(&scene.link).await), 303);
    let replayed = second.join(&scene.link).await;
    assert!(status(&replayed) == 403 && second.cookie.is_none() && replayed.contains("Ask for another"), "{replayed}");
    scene.house.close().await;
}

#[tokio::test]
async fn a_cookie_that_was_there_before_is_never_made_good() {
    let scene = Scene::open().await;
    let (mut victim, name) = (scene.browser(), format!("__Host-rrp-{}", scene.browser().address.port()));
    let planted = format!("{name}=planted-by-somebody-else-0123456789abcdefghij");
    victim.cookie = Some(planted.clone());
    let answer = victim.join(&scene.link).await;
    assert!(status(&answer) == 303 && victim.cookie.as_ref().is_some_and(|cookie| *cookie != planted));
    let (mut thief, own) = (scene.browser(), victim.cookie.clone());
    thief.cookie = Some(planted);
    assert_eq!(status(&thief.get("/api/behaviours").await), 401);
    // Who is in already and comes by another link gets another cookie, too.
    let (_, link) = scene.invite(Role::Viewer, Lasts::Once).await;
    assert!(status(&victim.join(&link).await) == 303 && victim.cookie != own);
    scene.house.close().await;
}

#[tokio::test]
async fn other_pages_use_nobodys_cookie() {
    let scene = Scene::open().await;
    let (browser, _) = scene.guest(Role::Editor).await;
    let own = browser.own_page();
    let evil = own.replace(&browser.address.to_string(), "evil.example");
    let other_port = own.replace(&browser.address.port().to_string(), "1");
    let plain = own.replace("https://", "http://");
    let local = format!("Origin: http://{}\r\n", scene.house.address);
    for origin in [&evil, &other_port, &plain, &local, "Origin: null\r\n"] {
        for path in ["/stop", "/api/import", "/come-in"] {
            let answer = browser.raw(&browser.request("POST", path, origin, "")).await;
            assert_eq!(status(&answer), 403, "{path} {origin}: {answer}");
        }
        let answer = browser.raw(&browser.request("GET", "/api/behaviours", origin, "")).await;
        assert!(status(&answer) == 403 && !answer.contains("Yuki"), "{origin}: {answer}");
    }
    for path in ["/api/import", "/come-in"] {
        let answer = browser.raw(&browser.request("POST", path, "", "")).await;
        assert_eq!(status(&answer), 403, "{path}: a page says which it is");
    }
    for site in ["cross-site", "same-site"] {
        let more = format!("Sec-Fetch-Site: {site}\r\nSec-Fetch-Mode: no-cors\r\n");
        assert_eq!(status(&browser.raw(&browser.request("GET", "/api/behaviours", &more, "")).await), 403);
    }
    assert_eq!(status(&browser.post("/stop", "").await), 200, "our own page may");
    scene.house.close().await;
}

/// How many names of people were kept: read after all changes were.
async fn came(scene: &Scene) -> Vec<(String, bool)> {
    let invitations = scene.aiko.ask(request::Invitations {}).await.unwrap().invitations;
    let came = invitations.into_iter().flat_map(|one| one.came);
    came.map(|came| (came.name, came.here)).collect()
}

#[tokio::test]
async fn who_is_revoked_is_out_and_the_others_stay() {
    let mut scene = Scene::open().await;
    let (ben, invitation) = scene.guest(Role::Editor).await;
    let (chie, _) = scene.guest(Role::Viewer).await;
    let mut sockets = [ben.socket("Ben").await.unwrap(), ben.socket("Ben").await.unwrap()];
    let mut staying = chie.socket("Chie").await.unwrap();
    let here = |told: &Event| {
        let Event::Invitations { invitations } = told else { return false };
        let came = invitations.iter().flat_map(|one| &one.came);
        came.filter(|came| came.here && !came.name.is_empty()).count() == 2
    };
    scene.aiko.until(here).await.unwrap();
    scene.aiko.ask(request::Revoke { invitation: invitation.id.clone() }).await.unwrap();
    for socket in &mut sockets {
        assert_eq!(socket.until_closed().await, Some(CLOSE_REVOKED));
    }
    for path in ["/api/behaviours", "/stop", "/"] {
        let request = ben.request(if path == "/stop" { "POST" } else { "GET" }, path, "", "");
        assert!(matches!(status(&ben.raw(&request).await), 401 | 403), "{path}");
    }
    assert_eq!(ben.socket("Ben").await.err(), Some(401));
    assert!(staying.ask(request::Runs {}).await.is_ok());
    let gone = |told: &Event| {
        let Event::Invitations { invitations } = told else { return false };
        invitations.iter().any(|one| one.revoked && one.came.iter().all(|came| !came.here && came.name == "Ben"))
    };
    scene.aiko.until(gone).await.unwrap();
    assert!(came(&scene).await.contains(&("Chie".to_owned(), true)));
    let again = scene.aiko.ask(request::Revoke { invitation: Id::new("nobody").unwrap() }).await;
    assert_eq!(again.unwrap_err().to_string(), Refused::NoInvitation.to_string());
    scene.house.close().await;
}

#[tokio::test]
async fn an_editor_from_elsewhere_edits_beside_the_first_person() {
    let mut scene = Scene::open().await;
    let (browser, _) = scene.guest(Role::Editor).await;
    let mut ben = browser.socket("Ben").await.unwrap();
    assert_eq!(ben.role, Role::Editor);
    open(&mut ben, &scene.play).await;
    let records = scene.aiko.open().unwrap().records;
    let change = scene.aiko.change("Add", &records, vec![(stream_id("far"), Some(plain("Far")))]);
    let proposed = ben.ask(request::Propose { behaviour: scene.play.clone(), change, tokens: Vec::new() }).await;
    assert!(proposed.is_ok(), "{proposed:?}");
    let accepted = scene.aiko.until(|told| matches!(told, Event::Accepted { .. })).await.unwrap();
    let Event::Accepted { accepted, .. } = accepted else { panic!() };
    assert_eq!(accepted.change.author, "Ben");
    scene.house.close().await;
}

async fn open(socket: &mut Socket, play: &Id) {
    socket.ask(request::Open { behaviour: play.clone() }).await.unwrap();
}

#[tokio::test]
async fn stop_is_heard_while_links_are_guessed_and_guessing_is_slowed() {
    let scene = Scene::open().await;
    let (browser, _) = scene.guest(Role::Viewer).await;
    let mut socket = browser.socket("Ben").await.unwrap();
    let guesses = tokio::spawn({
        let stranger = browser.stranger();
        async move {
            let mut answers = Vec::new();
            for guess in 0..150 {
                let wrong = format!("token=wrong-{guess}");
                answers.push(status(&stranger.post("/come-in", &wrong).await));
            }
            answers
        }
    });
    let mut stops = 0;
    while !guesses.is_finished() {
        assert!(socket.ask(request::Stop { behaviour: None, robot: None }).await.is_ok());
        assert_eq!(status(&browser.post("/stop", "").await), 200, "also by its own connection");
        stops += 1;
    }
    let answers = guesses.await.unwrap();
    let refused = answers.iter().filter(|status| **status == 429).count();
    assert!(stops > 1 && refused > 100 && answers[..5] == [403; 5], "{stops} {answers:?}");
    scene.house.close().await;
}

#[tokio::test]
async fn at_this_computer_nothing_is_asked_and_a_restart_keeps_who_was_invited() {
    let scene = Scene::open().await;
    let (mut browser, _) = scene.guest(Role::Operator).await;
    assert_eq!(browser.socket("Ben").await.unwrap().role, Role::Operator);
    let Scene { house, data, aiko, .. } = scene;
    drop(aiko);
    house.close().await;
    let house = House::for_others(data.path()).await;
    let now = Browser::new(data.path(), house.link.as_deref().unwrap());
    // The port is another one, and the cookie is called after it.
    let secret = browser.cookie.as_deref().unwrap().split_once('=').unwrap().1.to_owned();
    browser = now;
    browser.cookie = Some(format!("__Host-rrp-{}={secret}", browser.address.port()));
    assert!(browser.socket("Ben").await.is_ok());
    house.close().await;
}

#[tokio::test]
async fn a_guest_stops_by_the_form_alone() {
    let scene = Scene::open().await;
    let (browser, _) = scene.guest(Role::Viewer).await;
    let stranger = scene.browser().stranger();
    for path in ["/stop".to_owned(), format!("https://{}/stop", browser.address)] {
        let form = FORM.replace("Content-Length: 0\r\n", "");
        let answer = browser.raw(&browser.request("POST", &path, &form, "")).await;
        assert!(status(&answer) == 200 && answer.contains("停止しました"), "{answer}");
        let elsewhere = form.replace("same-origin", "cross-site");
        assert_eq!(status(&browser.raw(&browser.request("POST", &path, &elsewhere, "")).await), 403);
        let answer = stranger.raw(&stranger.request("POST", &path, &form, "")).await;
        assert!(status(&answer) == 403 && answer.contains("招待を頼んで"), "{answer}");
    }
    scene.house.close().await;
}

#[tokio::test]
async fn who_came_to_operate_lands_on_the_operators_page_and_others_on_the_graph() {
    let scene = Scene::open().await;
    for role in [Role::Viewer, Role::Operator, Role::Editor] {
        let (browser, _) = scene.guest(role).await;
        let lands = browser.get("/").await.to_lowercase();
        let there = lands.starts_with("http/1.1 303") && lands.contains("\nlocation: /operate\r");
        assert_eq!(there, role == Role::Operator, "{role:?}: {lands}");
        // The way out of it, and the page itself.
        for path in ["/?graph", "/operate", "/operate/nao"] {
            assert_ne!(status(&browser.get(path).await), 303, "{role:?} at {path}");
        }
    }
    scene.house.close().await;
}
