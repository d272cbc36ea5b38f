//! Marks of a running session: two operators and a viewer hear of each, presses count once and at their time, and the recording
//! has what became of them.

use crate::browser::Socket;
use crate::house::{House, connect, connector_id, make, printer, start, stream, stream_id};
use crate::invited::Scene;
use behaviour::{Id, Record, StreamKind, connectors};
use protocol::{
    AGO_MAX_MS, Event, MarkEdit, MarkSort, Message, RecordedSession, RecordingMark, Refused, Role, RunPhase, answer,
    request,
};
use shell::Client;
use std::sync::Arc;
use store::MemoryStore;

fn id(name: &str) -> Id {
    Id::new(name).unwrap()
}

fn mark(behaviour: &Id, name: &str, word: &str, (span, ago_ms): (bool, u64)) -> request::Mark {
    let (id, word, sort, note) = (Some(id(name)), word.to_owned(), MarkSort::Good, String::new());
    request::Mark { behaviour: behaviour.clone(), robot: None, run: None, id, word, sort, span, note, ago_ms }
}

fn edit(run: u64, name: &str, edit: MarkEdit) -> request::EditMark {
    request::EditMark { run, id: id(name), edit, ago_ms: 0 }
}

fn marked<E: std::fmt::Debug>(answer: Result<answer::Marked, E>) -> (RecordingMark, bool) {
    let answer::Marked { mark, kept } = answer.unwrap();
    (*mark, kept)
}

/// Fills a behaviour with what can run.
async fn fill(aiko: &Client) {
    let head = stream("Head", StreamKind::Sensor, Some("HeadTouch"));
    aiko.put("Add", stream_id("head"), Some(Record::Stream(head))).await.unwrap();
    aiko.put("Add", stream_id("out"), Some(printer("Out"))).await.unwrap();
    let through = connect(connectors::subscribe::SPEC.with(()), &["head"], "out");
    aiko.put("Add", connector_id("c"), Some(through)).await.unwrap();
}

async fn run(aiko: &Client) -> u64 {
    let answer::Runs { runs, .. } = aiko.ask(request::Runs {}).await.unwrap();
    runs.iter().map(|run| run.run).max().unwrap()
}

/// Waits until somebody hears of a mark as it shall be.
async fn hears(socket: &mut Socket, wanted: impl Fn(&RecordingMark) -> bool) -> RecordingMark {
    let told = std::mem::take(&mut socket.heard);
    let mut told = told.into_iter();
    loop {
        let message = match told.next() {
            Some(event) => Message::Event(event),
            None => socket.next().await.unwrap(),
        };
        if let Message::Event(Event::LiveMarks { marks, .. }) = message
            && let Some(mark) = marks.into_iter().find(&wanted)
        {
            return mark;
        }
    }
}

#[tokio::test]
async fn two_operators_and_a_viewer_hear_of_every_press_and_who_comes_later_of_all() {
    let scene = Scene::open().await;
    fill(&scene.aiko).await;
    scene.aiko.ask(start(&scene.play)).await.unwrap();
    let run = run(&scene.aiko).await;
    let mut people = Vec::new();
    for (role, name) in [(Role::Operator, "Ben"), (Role::Operator, "Cleo"), (Role::Viewer, "Dan")] {
        let (browser, _) = scene.guest(role).await;
        let mut socket = browser.socket(name).await.unwrap();
        socket.ask(request::Open { behaviour: scene.play.clone() }).await.unwrap();
        people.push(socket);
    }
    let [ben, cleo, dan] = &mut people[..] else { panic!() };
    let (first, kept) = marked(ben.ask(mark(&scene.play, "m1", "smiles", (false, 0))).await);
    assert!(!kept, "nothing is recorded, and that is said");
    for socket in [&mut *cleo, &mut *dan] {
        let heard = hears(socket, |mark| mark.id == id("m1")).await;
        assert_eq!((&heard, heard.by.as_str(), heard.word.as_str()), (&first, "Ben", "smiles"));
    }
    // The link was cut in the middle, so that it is sent again.
    assert_eq!(marked(ben.ask(mark(&scene.play, "m1", "smiles", (false, 900))).await).0, first);
    let (open, _) = marked(cleo.ask(mark(&scene.play, "m2", "plays", (true, 0))).await);
    assert!(open.open && open.until.is_none());
    assert!(hears(dan, |mark| mark.id == id("m2")).await.open);
    let (ended, _) = marked(ben.ask(edit(run, "m2", MarkEdit::End)).await);
    assert_eq!(hears(dan, |mark| mark.id == id("m2")).await, ended);
    assert_eq!((ended.open, ended.by.as_str()), (false, "Cleo"));
    let no = cleo.ask(edit(run, "m1", MarkEdit::Undo)).await;
    assert!(matches!(&no, Err(no) if no.to_string().contains("by who made it")), "{no:?}");
    assert!(marked(ben.ask(edit(run, "m1", MarkEdit::Undo)).await).0.gone);
    assert!(hears(dan, |mark| mark.id == id("m1")).await.gone);
    let no = Err(Refused::Role(Role::Operator));
    assert_eq!(dan.ask(mark(&scene.play, "m3", "x", (false, 0))).await, no);
    assert_eq!(dan.ask(edit(run, "m2", MarkEdit::Undo)).await, no);
    let (browser, _) = scene.guest(Role::Viewer).await;
    let mut late = browser.socket("Eve").await.unwrap();
    late.ask(request::Open { behaviour: scene.play.clone() }).await.unwrap();
    assert_eq!(hears(&mut late, |mark| mark.id == id("m2")).await, ended);
    // A page that listens later than it opened, as its code came later, asks for all again.
    assert!(late.heard.is_empty());
    assert_eq!(late.ask(request::Watch { robot: None, scene: true, values: true }).await, Ok(()));
    assert_eq!(hears(&mut late, |mark| mark.id == id("m2")).await, ended);
    scene.house.close().await;
}

#[tokio::test]
async fn the_recording_has_the_time_of_the_press_and_spans_end_with_stop() {
    let folder = tempfile::tempdir().unwrap();
    let house = House::beside(Arc::new(MemoryStore::default()), folder.path()).await;
    let (mut aiko, play) = house.maker("Aiko").await;
    fill(&aiko).await;
    aiko.ask(start(&play)).await.unwrap();
    let run = run(&aiko).await;
    let (early, kept) = marked(aiko.ask(mark(&play, "early", "waits", (false, 0))).await);
    assert!(!kept);
    let record = request::Record { behaviour: play.clone(), robot: None, session: RecordedSession::default() };
    aiko.ask(record).await.unwrap();
    let (past, kept) = marked(aiko.ask(mark(&play, "past", "laughs", (false, 10 * AGO_MAX_MS))).await);
    assert!(kept && past.t == 0, "what was before Start counts as Start: {past:?}");
    let (span, _) = marked(aiko.ask(mark(&play, "span", "plays", (true, 0))).await);
    marked(aiko.ask(mark(&play, "undone", "oops", (false, 0))).await);
    marked(aiko.ask(edit(run, "undone", MarkEdit::Undo)).await);
    aiko.ask(request::Stop { behaviour: None, robot: None }).await.unwrap();
    let is_stopped = |reply: &Event| matches!(reply, Event::Runs { runs, .. } if runs.iter().any(|one| matches!(one.phase, RunPhase::Stopped(_))));
    let Event::Runs { runs, .. } = aiko.until(is_stopped).await.unwrap() else { panic!() };
    let file = runs.iter().find_map(|run| Some(run.recording.as_ref()?.file.clone())).unwrap();
    let written = |one: &RecordingMark| (one.id.to_string(), one.t, one.word.clone());
    let marks = loop {
        let answer::Marks { marks, .. } = aiko.ask(request::Marks { file: file.clone() }).await.unwrap();
        // The run writes its last lines after Stop was answered.
        if marks.iter().any(|mark| mark.id == span.id && !mark.open) {
            break marks;
        }
        tokio::task::yield_now().await;
    };
    let mut wanted: Vec<_> = [&early, &past, &span].map(written).into();
    wanted.sort_by_key(|(id, t, _)| (*t, id.clone()));
    assert_eq!(marks.iter().map(written).collect::<Vec<_>>(), wanted);
    let ended = marks.iter().find(|mark| mark.id == span.id).unwrap();
    assert!(ended.until.unwrap() > span.t, "{ended:?}");
    // A note that was written after Stop joins its mark, and a press that came late by a bad link counts.
    let note = MarkEdit::Note("for the first time".to_owned());
    let (_, kept) = marked(aiko.ask(edit(run, "past", note)).await);
    let late = mark(&play, "late", "nods", (false, AGO_MAX_MS));
    assert!(kept && marked(aiko.ask(late).await).1);
    let answer::Marks { marks, .. } = aiko.ask(request::Marks { file }).await.unwrap();
    let noted = marks.iter().find(|mark| mark.id == past.id).unwrap();
    assert_eq!((noted.note.as_str(), noted.word.as_str()), ("for the first time", "laughs"));
    assert!(marks.iter().any(|mark| mark.word == "nods"));
    let other = make(&aiko, "Other", None).await;
    assert!(aiko.ask(mark(&other, "none", "x", (false, 0))).await.is_err(), "it never ran");
    house.close().await;
}
