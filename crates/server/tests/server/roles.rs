//! Every request of every way in, asked by everyone who may be in: what they may is done or refused for another reason,
//! everything else is refused by the role it needs. A request or route that is new has to be put here.

use crate::browser::status;
use crate::invited::Scene;
use protocol::{Refused, Reply, Request, Role};
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// An example of every request and the least that somebody must be for it.
pub(crate) fn requests() -> Vec<(Value, Role)> {
    use Role::{Editor, Host, Operator, Viewer};
    let token = json!({"epoch": 1, "counter": 1});
    let change = json!({"op": "o1", "label": "x", "author": "x", "at_ms": 0, "edits": []});
    let helper = json!({"name": "x", "params": [], "body": "1"});
    let problem = json!({"at": "stream/a", "name": "a", "kind": "noSource", "blocks": false});
    vec![
        (json!({"is": "hello", "version": 1, "name": "x"}), Viewer),
        (json!({"is": "list"}), Viewer),
        (json!({"is": "pictures", "of": []}), Viewer),
        (json!({"is": "whereUsed", "helper": "x"}), Viewer),
        (json!({"is": "drivers", "actuator": "Say"}), Viewer),
        (json!({"is": "contested"}), Viewer),
        (json!({"is": "similar", "behaviour": "none"}), Viewer),
        (json!({"is": "tags"}), Viewer),
        (json!({"is": "fixes", "behaviour": "none", "problem": problem}), Viewer),
        (json!({"is": "types", "behaviour": "none"}), Viewer),
        (json!({"is": "tryExercise", "behaviour": "none", "exercise": "x"}), Viewer),
        (json!({"is": "create", "behaviour": "made", "name": "x", "template": null}), Editor),
        (json!({"is": "open", "behaviour": "none"}), Viewer),
        (json!({"is": "leave"}), Viewer),
        (json!({"is": "remove", "behaviour": "none"}), Editor),
        (json!({"is": "restore", "behaviour": "none"}), Editor),
        (json!({"is": "propose", "behaviour": "none", "change": change}), Editor),
        (json!({"is": "renameHelper", "helper": "none", "seen": helper, "after": helper}), Editor),
        (json!({"is": "lock", "behaviour": "none", "records": []}), Editor),
        (json!({"is": "unlock", "behaviour": "none", "token": token}), Editor),
        (json!({"is": "typing", "behaviour": "none", "token": token}), Editor),
        (json!({"is": "askFor", "behaviour": "none", "record": "stream/a"}), Editor),
        (json!({"is": "withdraw", "behaviour": "none", "record": "stream/a"}), Editor),
        (json!({"is": "handOver", "behaviour": "none", "token": token, "yes": true}), Editor),
        (json!({"is": "takeOver", "behaviour": "none", "record": "stream/a"}), Host),
        (json!({"is": "since", "behaviour": "none", "revision": 0}), Viewer),
        (json!({"is": "takeBack", "behaviour": "none", "op": "o1"}), Editor),
        (json!({"is": "history", "behaviour": "none"}), Viewer),
        (json!({"is": "at", "behaviour": "none", "revision": 1}), Viewer),
        (json!({"is": "goBack", "behaviour": "none", "revision": 1, "op": "o1"}), Editor),
        (json!({"is": "bringBack", "behaviour": "none", "revision": 1, "op": "o1"}), Editor),
        (json!({"is": "nameVersion", "behaviour": "none", "revision": 1, "name": "x"}), Editor),
        (json!({"is": "unnameVersion", "behaviour": "none", "name": "x"}), Editor),
        (json!({"is": "check", "arguments": [], "body": "1", "inputs": []}), Viewer),
        (json!({"is": "present", "pointer": null, "selected": null}), Viewer),
        (json!({"is": "callMe", "name": "Ben"}), Viewer),
        (json!({"is": "start", "behaviour": "none"}), Operator),
        (json!({"is": "record", "behaviour": "none"}), Operator),
        (json!({"is": "endRecording", "behaviour": "none"}), Operator),
        (json!({"is": "hand", "device": "none", "value": 1}), Operator),
        (json!({"is": "marks", "file": "x"}), Viewer),
        (json!({"is": "putMark", "file": "x", "mark": {"id": "m", "t": 1}}), Operator),
        (json!({"is": "mark", "behaviour": "none", "note": ""}), Operator),
        (json!({"is": "editMark", "run": 0, "id": "m", "edit": "undo"}), Operator),
        (json!({"is": "runs"}), Viewer),
        (json!({"is": "place", "behaviour": "none", "above": null}), Operator),
        (json!({"is": "recordings"}), Viewer),
        (json!({"is": "removeRecording", "file": "x"}), Operator),
        (json!({"is": "apply", "behaviour": "none"}), Operator),
        (json!({"is": "stop", "behaviour": null}), Viewer),
        (json!({"is": "stimulate", "behaviour": "none", "stream": "a", "value": 1}), Operator),
        (json!({"is": "scene", "edit": {"do": "touch", "part": "headFront", "down": false}}), Operator),
        (json!({"is": "addRobot", "robot": "other", "name": "Other"}), Operator),
        (json!({"is": "addRobot", "robot": "real", "name": "NAO", "real": {"address": "nao"}}), Host),
        (json!({"is": "renameRobot", "robot": "none", "name": "x"}), Operator),
        (json!({"is": "reachRobot", "robot": "none", "real": {"address": "nao"}}), Host),
        (json!({"is": "acceptRobot", "robot": "none", "found": {}}), Host),
        (json!({"is": "checkRobot", "real": {"address": "nao"}}), Host),
        (json!({"is": "findRobots"}), Host),
        (json!({"is": "controlRobot", "robot": "none", "control": "take"}), Operator),
        (json!({"is": "faces", "robot": "none"}), Operator),
        (json!({"is": "removeRobot", "robot": "none"}), Operator),
        (json!({"is": "invite", "role": "viewer", "lasts": "day", "label": ""}), Host),
        (json!({"is": "invitations"}), Host),
        (json!({"is": "revoke", "invitation": "none"}), Host),
        (json!({"is": "watch", "scene": false, "values": false}), Viewer),
    ]
}

/// The names of all requests that there are, as the protocol says when it hears another one.
fn all() -> BTreeSet<String> {
    let error = serde_json::from_value::<Request>(json!({"is": "?"})).unwrap_err().to_string();
    error.split('`').skip(3).step_by(2).map(str::to_owned).collect()
}

#[test]
fn no_request_is_left_out() {
    let here: BTreeSet<String> = requests().iter().map(|(one, _)| one["is"].as_str().unwrap().to_owned()).collect();
    assert!(here.len() > 30);
    assert_eq!(here, all());
}

#[tokio::test]
async fn every_request_of_a_socket_asks_for_the_role() {
    let scene = Scene::open().await;
    for role in [Role::Viewer, Role::Operator, Role::Editor] {
        let (browser, _) = scene.guest(role).await;
        let mut socket = browser.socket("Ben").await.unwrap();
        for (text, least) in requests() {
            let request: Request =
                serde_json::from_value(text.clone()).unwrap_or_else(|error| panic!("{text}: {error}"));
            let number = socket.send(request).await;
            // Some are not answered if they may be asked; the next one is.
            let next = socket.send(Request::Runs).await;
            let mut said = None;
            loop {
                let message = socket.next().await.unwrap();
                if message.ask == Some(number) {
                    said = Some(message.reply);
                } else if message.ask == Some(next) {
                    break;
                }
            }
            let refused = said == Some(Reply::No { no: Refused::Role(least) });
            assert_eq!(refused, role < least, "{text} as {role:?}: {said:?}");
        }
    }
    let made = scene.aiko.ask(Request::List { query: protocol::ListQuery::default() }).await.unwrap();
    let Reply::Programs { programs, .. } = made else { panic!() };
    assert_eq!(programs.len(), 2, "the editor made one, and nobody else did");
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
