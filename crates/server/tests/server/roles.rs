//! Every request of every way in, asked by everyone who may be in: what they may is done or refused for another reason,
//! everything else is refused by the role it needs. A route that is new has to be put here; requests come from their table.

use crate::browser::status;
use crate::invited::Scene;
use protocol::{AnyRequest, Message, Refused, Role, request};

/// An example of every request and the least that somebody must be for it.
pub(crate) fn requests() -> Vec<(AnyRequest, Role)> {
    let read = |text: &str| serde_json::from_str(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let real = r#"{"is": "addRobot", "robot": "real", "name": "NAO", "real": {"address": "nao"}}"#;
    let table = AnyRequest::TABLE.iter().map(|row| (read(&row.example_json()), row.role));
    table.chain([(read(real), Role::Host)]).collect()
}

#[tokio::test]
async fn every_request_of_a_socket_asks_for_the_role() {
    let scene = Scene::open().await;
    for role in [Role::Viewer, Role::Operator, Role::Editor] {
        let (browser, _) = scene.guest(role).await;
        let mut socket = browser.socket("Ben").await.unwrap();
        for (request, least) in requests() {
            let number = socket.send(request.clone()).await;
            // Some are not answered if they may be asked; the next one is.
            let next = socket.send(request::Runs {}).await;
            let mut no = None;
            loop {
                match socket.next().await.unwrap() {
                    Message::No { ask: Some(ask), no: said } if ask == number => no = Some(said),
                    Message::Answer { ask, .. } if ask == next => break,
                    _ => {}
                }
            }
            assert_eq!(no == Some(Refused::Role(least)), role < least, "{request:?} as {role:?}: {no:?}");
        }
    }
    let made = scene.aiko.ask(request::List { query: protocol::ListQuery::default() }).await.unwrap();
    assert_eq!(made.programs.len(), 2, "the editor made one, and nobody else did");
    scene.house.close().await;
}

#[tokio::test]
async fn every_route_asks_for_the_role() {
    let scene = Scene::open().await;
    let file = format!("/api/behaviours/{}.json", scene.play);
    let table = [
        ("GET", "/", Role::Viewer),
        ("GET", "/healthz", Role::Viewer),
        ("GET", "/readyz", Role::Viewer),
        ("GET", "/come-in", Role::Viewer),
        ("GET", "/come-in.css", Role::Viewer),
        ("GET", "/come-in.js", Role::Viewer),
        ("GET", "/socket", Role::Viewer),
        ("GET", "/api/behaviours", Role::Viewer),
        ("GET", &file, Role::Viewer),
        ("GET", "/api/recordings", Role::Viewer),
        ("GET", "/api/recordings/none.jsonl", Role::Viewer),
        ("GET", "/recordings/none.jsonl/report", Role::Viewer),
        ("GET", "/recordings", Role::Viewer),
        ("GET", "/recordings.css", Role::Viewer),
        ("POST", "/recordings/none.jsonl/change", Role::Operator),
        ("GET", "/report.css", Role::Viewer),
        ("GET", "/report.js", Role::Viewer),
        ("GET", "/api/robots/none/camera", Role::Operator),
        ("GET", "/api/backup", Role::Editor),
        ("POST", "/api/import", Role::Editor),
        ("POST", "/api/import?mode=restore", Role::Editor),
        ("POST", "/stop", Role::Viewer),
        // Written in another way, so that the thread that accepts does not see that it is a Stop.
        ("POST", "//stop", Role::Viewer),
    ];
    for role in [Role::Viewer, Role::Operator, Role::Editor] {
        let (browser, _) = scene.guest(role).await;
        for (method, path, least) in table {
            let answer = browser.raw(&browser.request(method, path, &browser.own_page(), "")).await;
            let refused = status(&answer) == 403 && answer.contains(&Refused::Role(least).to_string());
            assert_eq!(refused, role < least, "{method} {path} as {role:?}: {answer}");
            assert_ne!(status(&answer), 401, "{path}");
        }
    }
    scene.house.close().await;
}
