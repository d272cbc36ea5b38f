//! A session of half an hour in virtual time, from Start to its report: what was done, by whom, how often and how long.

use super::replayed::{Course, advance, now, texts};
use super::{filtered, id};
use crate::recordings::{Recordings, ReportSource};
use crate::robots::mailbox::{Arrived, DoneByHand, Post};
use crate::robots::{ByHand, MarkPress};
use crate::rooms::knowledge::Knowing;
use behaviour::{Id, Params, Value};
use engine::StreamIx;
use protocol::{MarkEdit, MarkSort, RecordedSession, RecordingMark};
use recording::{Ending, PrivateParts};
use report::{ReportWishes, Zone};
use std::sync::Arc;
use std::time::Instant;
use tokio_util::sync::CancellationToken;

/// The session has so many minutes.
const MINUTES: u64 = 30;
/// Time goes on by so much at a turn, in milliseconds.
const TURN_MS: u64 = 500;

/// Does what happens in the turn at a time since Start; marks go their own way.
fn post(at_ms: u64) -> Post {
    let (minute, in_minute) = (at_ms / 60_000, at_ms % 60_000);
    let reading =
        |by: Option<&str>| Arrived { stream: StreamIx::of(0), at: now(), value: Value::Int(7), by: by.map(Arc::from) };
    let mut post = Post::default();
    // For twenty seconds of every minute there is a ball; now and then somebody pretends one.
    if in_minute < 20_000 {
        post.readings.push(reading(None));
    } else if in_minute == 40_000 && minute % 3 == 0 {
        post.readings.push(reading(Some("Cleo")));
    }
    if in_minute == 30_000 {
        let (device, params, by) = ("SayInput".to_owned(), Params::default(), "Ben".to_owned());
        let hand = ByHand { device, params, value: Value::text("Hello"), by };
        post.hands.push(DoneByHand { at: now(), hand, why: None });
    }
    post
}

fn mark(name: &str, word: &str, open: bool) -> RecordingMark {
    let [note, by, at] = [const { String::new() }; 3];
    let (word, sort) = (word.to_owned(), MarkSort::Note);
    RecordingMark { id: id(name), t: 0, until: None, word, sort, note, by, at, open, gone: false }
}

/// Presses what is marked at a time since Start.
fn presses(course: &Course, at_ms: u64) {
    let (_, job, mailbox) = course.runner.as_ref().unwrap();
    let marks = course.shared.table.lock().unwrap().get(job.run).unwrap().marks.clone();
    let client: Id = id("ben");
    let press = MarkPress { by: "Ben", client: &client, at: now() };
    let put = |name: &str, word: &str, open| drop(marks.put(mark(name, word, open), press, mailbox).unwrap());
    let edit = |name: &str, edit| drop(marks.edit(&id(name), edit, press, mailbox).unwrap());
    match (at_ms / 60_000, at_ms % 60_000) {
        (minute, 5_000) if minute % 2 == 0 => put(&format!("smiles{minute}"), "smiles", false),
        (minute, 10_000) if minute % 10 == 3 => put(&format!("plays{minute}"), "plays", true),
        (minute, 11_000) if minute % 10 == 4 => edit(&format!("plays{}", minute - 1), MarkEdit::End),
        (7, 20_000) => put("oops", "smiles", false),
        (7, 28_000) => edit("oops", MarkEdit::Undo),
        (29, 50_000) => put("late", "plays", true),
        _ => {}
    }
}

/// A page as its reader sees it: without tags, and each run of spaces as one.
fn seen(page: &str) -> String {
    let (mut text, mut is_tag) = (String::new(), false);
    for letter in page.chars() {
        match letter {
            '<' => (is_tag, text) = (true, text + " "),
            '>' => is_tag = false,
            letter if !is_tag => text.push(letter),
            _ => {}
        }
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn half_an_hour_is_reported_as_it_was_and_gives_its_actions_again() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let mut course = Course::of(0, recordings.clone());
    course.file = filtered("one", "ball > 3").file;
    course.session = RecordedSession { participant: Some("C-07".to_owned()), ..RecordedSession::default() };
    course.start(true);
    for turn in 0..MINUTES * 60_000 / TURN_MS {
        let at_ms = turn * TURN_MS;
        let mut post = post(at_ms);
        presses(&course, at_ms);
        let (mut runner, job, mailbox) = course.runner.take().unwrap();
        post.marks = mailbox.take(Some(Instant::now())).marks;
        assert!(runner.turn(post).is_none());
        course.runner = Some((runner, job, mailbox));
        advance(TURN_MS);
    }
    course.shared.stop_now(None, "Ben");
    course.end();
    let [text] = &texts(&recordings)[..] else { panic!() };
    let is = recording::check(text).unwrap_or_else(|why| panic!("{why}"));
    assert!(matches!(is.ends, Ending::Whole(_)), "{:?}", is.ends);
    let listed = recordings.list();
    let keep = (PrivateParts { names: true, personal: false }, catalogues::english());
    let looked = recordings.look(&listed[0].file, keep, &Knowing::default(), &CancellationToken::new());
    let ReportSource { gathered, replayed, sessions } = looked.unwrap();
    let (zone, download) = (Zone::east_by(Some(0)), "/x".to_owned());
    let page =
        report::page(&gathered, replayed, &sessions, &ReportWishes { names: true, zone, download, parts: ["", ""] });
    let page = seen(&page);
    for wanted in WANTED {
        assert!(page.contains(wanted), "{wanted:?} is not in: {page}");
    }
}

/// The page says this of the script above: what comes again within a second counts once, from its first to its last value.
const WANTED: [&str; 8] = [
    "Session report: C-07 one , version 1",
    "(30:00) People Aiko , Ben , Cleo Robot NAO",
    "It ended: it was stopped",
    "By the program, 40 What Count Time page 40 9:45",
    "What it sensed Count Time ball 30 9:45",
    "By hand, 40 What Count By Say the value: “ Hello ” 30 Ben As if: ball 10 Cleo",
    "Marks, 19 Word Count Time smiles 15 plays 4 3:13 Troubles, 0",
    "Replay: same as recorded",
];
