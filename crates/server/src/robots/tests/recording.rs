//! Recording what runs.

use super::puppet::Puppet;
use super::together::head;
use super::{PATIENCE_S, filtered, id, until};
use crate::recordings::Recordings;
use crate::robots::{Host, MarkPress, PressOutcome, StartOrder};
use behaviour::{BehaviourFile, Value};
use engine::{Emission, Limits, Run};
use protocol::{MarkSort, RecordedSession, RecordingMark, Records, Refused};
use robot::Millis;
use std::sync::Arc;
use std::time::Instant;

pub(super) fn recorded(start: StartOrder) -> StartOrder {
    StartOrder { record: true, ..start }
}

/// The lines of the only recording, once it has its last.
pub(super) async fn lines(recordings: &Recordings) -> Vec<Value> {
    let read = || {
        let list = recordings.list();
        let path = recordings.find(&list.first()?.file)?;
        let text = std::fs::read_to_string(path).ok()?;
        text.lines().map(|line| serde_json::from_str::<Value>(line).ok()).collect::<Option<Vec<_>>>()
    };
    let is_done = || read().is_some_and(|lines| lines.iter().any(|line| mark(line) == Some("end")));
    until("the last line", is_done).await;
    read().unwrap()
}

fn mark(line: &Value) -> Option<&str> {
    line.field("mark")?.as_text()
}

pub(super) fn text<'v>(line: &'v Value, field: &str) -> Option<&'v str> {
    line.field(field)?.as_text()
}

/// What the readings of a recording make of a behaviour, as `(time, value)` of its only action.
pub(super) fn replayed(file: &BehaviourFile, lines: &[Value]) -> Vec<(u64, Value)> {
    let mut run = Run::build(file, Limits::default()).map_err(|faults| faults[0].to_string()).unwrap();
    let (ball, page) = (run.stream_index("ball").unwrap(), run.stream_index("page").unwrap());
    let mut told = Vec::new();
    let mut hear = |emission: Emission| {
        if let Emission::Value { at, stream, value, .. } = emission
            && stream == page
        {
            told.push((at.0, value.clone()));
        }
    };
    for line in lines.iter().filter(|line| text(line, "stream") == Some("ball")) {
        run.feed(Millis(time(line)), ball, line.field("value").unwrap().clone(), &mut hear);
    }
    told
}

fn time(line: &Value) -> u64 {
    let Some(&Value::Int(time)) = line.field("t") else { panic!("{line} has no time") };
    time.unsigned_abs()
}

pub(super) fn outputs(lines: &[Value]) -> Vec<(u64, Value)> {
    let page = lines.iter().filter(|line| text(line, "stream") == Some("page"));
    page.map(|line| (time(line), line.field("value").unwrap().clone())).collect()
}

fn stimulate(robots: &Host, value: i64) {
    robots.stimulate(&id("one"), &id("ball"), Value::Int(value), "Ben").unwrap();
}

/// Marks a moment so long ago.
fn mark_at(robots: &Host, note: &str, ago_ms: u64) -> Result<PressOutcome, Refused> {
    let now = Instant::now();
    let at = now.checked_sub(std::time::Duration::from_millis(ago_ms)).unwrap_or(now);
    let [word, by, at_time] = [const { String::new() }; 3];
    let (id, note, sort) = (behaviour::Id::from_uuid(uuid::Uuid::new_v4()), note.to_owned(), MarkSort::Note);
    let mark = RecordingMark { id, t: 0, until: None, word, sort, note, by, at: at_time, open: false, gone: false };
    robots.mark(&self::id("one"), mark, MarkPress { by: "Ben", client: &self::id("ben"), at })
}

#[tokio::test]
async fn a_recording_has_what_was_read_what_was_told_and_how_it_ended() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let puppet = Puppet::default();
    let robots = puppet.robots_with(Limits::default, recordings.clone());
    let run = robots.start(recorded(filtered("one", "ball > 3"))).await.unwrap();
    for value in 0..8 {
        stimulate(&robots, value);
        until("the value was taken", || value <= 3 || puppet.told(run.run).contains(&Value::Int(value))).await;
    }
    mark_at(&robots, "she \"smiles\"", 0).unwrap();
    let shown = robots.runs().borrow()[0].recording.clone().unwrap();
    assert_eq!((shown.lost, shown.trouble), (0, None));
    robots.stop(None, "Ben");
    let lines = lines(&recordings).await;
    assert_eq!(text(&lines[0], "format"), Some("rrp-recording/2"));
    assert_eq!(text(&lines[0], "robot"), Some("Puppet"));
    assert_eq!((text(&lines[0], "behaviour"), text(&lines[0], "mode")), (Some("one"), Some("event")));
    assert_eq!(text(lines.last().unwrap(), "why"), Some("it was stopped"));
    assert_eq!(outputs(&lines).into_iter().map(|(_, value)| value).collect::<Vec<_>>(), [4, 5, 6, 7].map(Value::Int));
    assert_eq!(outputs(&lines), replayed(&filtered("one", "ball > 3").file, &lines));
    let note = lines.iter().find(|line| mark(line) == Some("note")).unwrap();
    assert_eq!((text(note, "by"), text(note, "note")), (Some("Ben"), Some("she \"smiles\"")));
    assert!(lines.windows(2).all(|pair| mark(&pair[1]) != Some("note") || outputs(&pair[..1]).len() == 1), "after all");
    let known = &recordings.list()[0];
    assert_eq!(known.robot, "Puppet");
    assert_eq!((known.file.as_str(), known.name.as_str(), known.revision), (shown.file.as_str(), "one", 1));
    // The writer lets go of it a moment after the last line.
    until("it is removed", || recordings.remove(&known.file).is_ok()).await;
    assert_eq!(recordings.remove(&shown.file), Err(Refused::NoRecording));
    assert_eq!(recordings.find("../one"), None);
}

#[tokio::test]
async fn a_recording_goes_on_with_what_is_applied_and_ends_when_somebody_wants() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let puppet = Puppet::default();
    let robots = puppet.robots_with(Limits::default, recordings.clone());
    assert_eq!(robots.end_recording(&id("one"), "Ben"), Err(Refused::NotRunning));
    let run = robots.start(recorded(filtered("one", "ball > 3"))).await.unwrap();
    stimulate(&robots, 5);
    until("the first", || puppet.told(run.run) == [Value::Int(5)]).await;
    let mut edited = filtered("one", "ball < 3");
    (edited.revision, edited.file) = (9, Arc::new((*edited.file).clone()));
    robots.apply(edited, None).await.unwrap();
    stimulate(&robots, 2);
    until("the second", || puppet.told(run.run) == [5, 2].map(Value::Int)).await;
    robots.end_recording(&id("one"), "Ben").unwrap();
    let lines = lines(&recordings).await;
    let applied = lines.iter().position(|line| mark(line) == Some("applied")).unwrap();
    assert_eq!(lines[applied].field("revision"), Some(&Value::Int(9)));
    assert_eq!((outputs(&lines[..applied]).len(), outputs(&lines[applied..]).len()), (1, 1));
    assert_eq!(text(lines.last().unwrap(), "why"), Some("the recording was ended"));
    until("it is not recorded any more", || robots.runs().borrow()[0].recording.is_none()).await;
    stimulate(&robots, 1);
    until("it runs on", || puppet.told(run.run).len() == 3).await;
}

#[tokio::test]
async fn before_the_first_reading_it_is_listed_and_can_be_marked() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let robots = Puppet::default().robots_with(Limits::default, recordings.clone());
    let run = robots.start(recorded(filtered("one", "true"))).await.unwrap();
    let listed = recordings.list();
    assert_eq!(listed.len(), 1);
    assert_eq!(run.recording.map(|recorded| recorded.file).as_ref(), Some(&listed[0].file));
    assert!(!listed[0].cut_off, "it is being written");
    mark_at(&robots, "quiet", 0).unwrap();
    robots.stop(None, "Ben");
    let lines = lines(&recordings).await;
    assert!(lines.iter().any(|line| text(line, "note") == Some("quiet")));
    assert!(!recordings.list()[0].cut_off);
    let path = recordings.find(&listed[0].file).unwrap();
    let whole = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, &whole[..whole.len() - 5]).unwrap();
    until("its last line is not whole", || recordings.list()[0].cut_off).await;
}

#[tokio::test]
async fn what_runs_can_be_recorded_from_its_middle_on_and_says_who_pretended_what() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let puppet = Puppet::default();
    let robots = puppet.robots_with(Limits::default, recordings.clone());
    let (one, session) =
        (id("one"), RecordedSession { participant: Some("C-07".to_owned()), ..RecordedSession::default() });
    assert_eq!(robots.record(&one, "Ben", &session), Err(Refused::NotRunning));
    let run = robots.start(counting("one")).await.unwrap();
    stimulate(&robots, 5);
    until("the first", || puppet.told(run.run) == [Value::Int(5)]).await;
    assert!(!mark_at(&robots, "early", 0).unwrap().kept, "nothing is recorded yet");
    robots.record(&one, "Ben", &session).unwrap();
    robots.record(&one, "Cleo", &RecordedSession::default()).unwrap();
    assert_eq!(recordings.list().len(), 1, "once is enough");
    assert!(mark_at(&robots, "long ago", 10_000_000).unwrap().kept);
    stimulate(&robots, 2);
    until("the second", || puppet.told(run.run) == [5, 7].map(Value::Int)).await;
    robots.stop(None, "Cleo");
    let lines = lines(&recordings).await;
    assert_eq!((text(&lines[0], "by"), text(&lines[0], "participant")), (Some("Ben"), Some("C-07")));
    let reading = lines.iter().find(|line| text(line, "stream") == Some("ball")).unwrap();
    assert_eq!(text(reading, "by"), Some("Ben"));
    let notes: Vec<&Value> = lines.iter().filter(|line| mark(line) == Some("note")).collect();
    assert_eq!(notes.iter().map(|note| text(note, "note")).collect::<Vec<_>>(), [Some("early"), Some("long ago")]);
    assert_eq!(notes[1].field("t"), Some(&Value::Int(0)), "what was before Start counts as Start");
    let end = lines.last().unwrap();
    assert_eq!((text(end, "why"), text(end, "by")), (Some("it was stopped"), Some("Cleo")));
    assert_eq!(end.field("marks"), Some(&Value::Int(2)));
    let path = recordings.find(&recordings.list()[0].file).unwrap();
    let checked = recording::check(&std::fs::read_to_string(path).unwrap()).unwrap();
    assert_eq!((checked.actions, checked.readings), (1, 1), "what it remembered is in it");
}

/// A behaviour that shows the sum of all balls so far.
fn counting(name: &str) -> StartOrder {
    let start = filtered(name, "true");
    let mut file = (*start.file).clone();
    let connector = &mut file.connectors[0];
    (connector.operation, connector.start) = ("scan".to_owned(), Some(Value::Int(0)));
    connector.body = Some("soFar + ball".to_owned());
    StartOrder { file: file.into(), ..start }
}

#[tokio::test]
async fn a_recording_of_marks_has_nothing_of_what_was_sensed() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let puppet = Puppet::default();
    let robots = puppet.robots_with(Limits::default, recordings.clone());
    let session = RecordedSession { records: Records::Marks, ..RecordedSession::default() };
    let run = robots.start(StartOrder { record: true, session, ..filtered("one", "ball > 3") }).await.unwrap();
    for value in [1, 5] {
        stimulate(&robots, value);
    }
    until("the second", || puppet.told(run.run) == [Value::Int(5)]).await;
    robots.stop(None, "Ben");
    let lines = lines(&recordings).await;
    assert!(lines.iter().all(|line| text(line, "stream") != Some("ball")), "{lines:?}");
    assert_eq!(outputs(&lines).len(), 1);
    let path = recordings.find(&recordings.list()[0].file).unwrap();
    let why = recording::check(&std::fs::read_to_string(path).unwrap()).unwrap_err().to_string();
    assert!(why.to_string().contains("marks and actions only"), "{why}");
}

#[tokio::test]
async fn what_the_robot_did_not_do_and_how_it_was_is_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let puppet = Puppet::default();
    let robots = puppet.robots_with(Limits::default, recordings.clone());
    let upper = robots.start(head("upper")).await.unwrap();
    let run = robots.start(recorded(head("one"))).await.unwrap();
    let holds = |value| robots.stimulate(&id("upper"), &id("ball"), Value::Int(value), "Ben").unwrap();
    holds(7);
    until("the upper one shows it", || puppet.told(upper.run).len() == 1).await;
    stimulate(&robots, 5);
    let is_held = || robots.runs().borrow().iter().any(|known| known.run == run.run && !known.held.is_empty());
    until("it is held", is_held).await;
    puppet.halt("it fell");
    until("it is interrupted", || robots.shared().threads() == 0).await;
    let lines = lines(&recordings).await;
    let refused = lines.iter().find(|line| text(line, "refused") == Some("page")).unwrap();
    assert_eq!((text(refused, "with"), text(refused, "why")), (Some("upper"), Some("the head is held")));
    let robot: Vec<_> = lines.iter().filter(|line| mark(line) == Some("robot")).collect();
    assert!(robot.first().unwrap().field("link").is_some());
    assert!(text(robot.last().unwrap(), "halt").unwrap().starts_with("it fell"));
    assert!(text(lines.last().unwrap(), "why").unwrap().starts_with("it fell"));
}

#[tokio::test]
async fn without_a_place_to_record_a_recorded_start_is_refused() {
    let robots = Puppet::default().robots(Limits::default);
    let no = robots.start(recorded(filtered("one", "true"))).await.unwrap_err();
    assert_eq!(no.to_string(), "this server has no data folder; start it with --data DIR");
    assert!(!robots.is_running(&id("one")));
}

#[tokio::test]
async fn however_fast_readings_come_logical_time_does_not_run_ahead() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let puppet = Puppet::default();
    let robots = puppet.robots_with(Limits::default, recordings.clone());
    let mut stamped = filtered("one", "true");
    let file = Arc::make_mut(&mut stamped.file);
    (file.connectors[0].operation, file.connectors[0].body) = ("timestamp".to_owned(), None);
    let (file, began) = (stamped.file.clone(), Instant::now());
    let run = robots.start(recorded(stamped)).await.unwrap();
    for number in 0..500 {
        stimulate(&robots, number);
        // Each on its own, as soon as the one before is through: on most machines many fall into one millisecond.
        while puppet.told(run.run).len() as i64 <= number {
            assert!(began.elapsed().as_secs() < PATIENCE_S, "never: {number}");
            tokio::task::yield_now().await;
        }
    }
    let latest_ms = began.elapsed().as_millis() as i64 + 1;
    let told = puppet.told(run.run);
    let Some(Value::Int(stamp)) = told[499].field("t") else { panic!("{}", told[499]) };
    assert!(*stamp <= latest_ms, "{stamp} ms, but not more than {latest_ms} ms have passed");
    robots.stop(None, "Ben");
    let lines = lines(&recordings).await;
    let said: Vec<_> = outputs(&lines).into_iter().map(|(_, value)| value).collect();
    assert_eq!(said, told);
    assert_eq!(outputs(&lines), replayed(&file, &lines));
}
