//! Tests of the recordings that are kept, and of their later marks.

use super::{About, RECORDING_MAX_BYTES, RecordingBounds, Recordings};
use behaviour::{BehaviourFile, Id};
use protocol::{MarkSort, RECORDING_MARKS_MAX, Recorded, RecordedSession, RecordingMark, Refused};
use std::collections::BTreeSet;
use std::sync::Arc;

fn file() -> Arc<BehaviourFile> {
    let text = r#"{"format":"rrp-behaviour/1","name":"Greet","helpers":[],"connectors":[],
        "streams":[{"id":"ball","kind":"sensor","name":"Ball"}]}"#;
    Arc::new(serde_json::from_str(text).unwrap())
}

fn id(text: &str) -> Id {
    Id::new(text).unwrap()
}

/// Records nothing, with a mark, and answers with the file's name.
fn record(recordings: &Recordings, session: &RecordedSession) -> String {
    let about = About { run: 1, robot: "NAO", behaviour: &id("b"), revision: 1, by: "Aiko", file: &file(), session };
    let mut recorder = recordings.begin(&about).map_err(|why| why.to_string()).unwrap();
    let name = recorder.news().unwrap().file;
    let note = RecordingMark { by: "Ben".to_owned(), note: "he laughs".to_owned(), ..mark("note-1", 1_500, "") };
    recorder.note(note.into());
    recorder.end("it was stopped", None);
    while recordings.is_writing() {
        std::thread::yield_now();
    }
    name
}

fn mark(name: &str, t: u64, word: &str) -> RecordingMark {
    let (until, note, by, at) = (None, String::new(), "somebody else".to_owned(), String::new());
    RecordingMark {
        id: id(name),
        t,
        until,
        word: word.to_owned(),
        sort: MarkSort::Good,
        note,
        by,
        at,
        open: false,
        gone: false,
    }
}

#[test]
fn the_newest_recordings_survive() {
    let folder = tempfile::tempdir().unwrap();
    let bounds = RecordingBounds { kept: 3, bytes: u64::MAX };
    let recordings = Recordings { bounds, ..Recordings::within(Some(folder.path())) };
    let old = |name: &str, age_s: u64| {
        let path = recordings.find(name).unwrap();
        let written = std::time::SystemTime::now() - std::time::Duration::from_secs(age_s);
        std::fs::File::options().append(true).open(path).unwrap().set_modified(written).unwrap();
    };
    let mut all = Vec::new();
    for age_s in [500, 400, 300, 200, 100] {
        all.push(record(&recordings, &RecordedSession::default()));
        old(all.last().unwrap(), age_s);
    }
    recordings.put_mark(&all[2], mark("m", 1, "laughs"), "Aiko").unwrap();
    let left = |recordings: &Recordings| recordings.list().into_iter().map(|one| one.file).collect::<BTreeSet<_>>();
    assert_eq!(left(&recordings), BTreeSet::from_iter(all[2..].iter().cloned()));
    // The bound leaves room for one more besides the last.
    let last = std::fs::metadata(recordings.find(&all[4]).unwrap()).unwrap().len();
    let few =
        Recordings { bounds: RecordingBounds { kept: 9, bytes: last + RECORDING_MAX_BYTES }, ..recordings.clone() };
    let newest = record(&few, &RecordedSession::default());
    assert_eq!(left(&few), BTreeSet::from([all[4].clone(), newest]));
    let names = std::fs::read_dir(folder.path().join("recordings")).unwrap().count();
    assert_eq!(names, 2, "their marks went with them");
    // A recording that is being written never gives way; then nothing more begins.
    let (file, session) = (file(), RecordedSession::default());
    let about =
        About { run: 1, robot: "NAO", behaviour: &id("b"), revision: 1, by: "Aiko", file: &file, session: &session };
    let full = Recordings { bounds: RecordingBounds { kept: 1, bytes: u64::MAX }, ..recordings };
    let mut writing = full.begin(&about).unwrap();
    assert_eq!(writing.news().unwrap().gave_way, 2);
    let no = full.begin(&about).unwrap_err().to_string();
    assert_eq!(no, "there is no room for another recording; download and remove some first");
}

#[test]
fn a_list_says_of_whom_and_how_long_a_recording_is() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let participant = Some(" C-07 ".to_owned());
    let name = record(
        &recordings,
        &RecordedSession { participant, session: Some("2".to_owned()), ..RecordedSession::default() },
    );
    let listed = recordings.list().remove(0);
    assert_eq!((listed.by.as_str(), listed.session.participant.as_deref()), ("Aiko", Some("C-07")));
    assert_eq!((listed.marks, listed.length_ms, listed.old_form, listed.cut_off), (Some(1), Some(0), false, false));
    let path = recordings.find(&name).unwrap();
    let old = "{\"format\":\"rrp-recording/1\",\"name\":\"x\",\"revision\":3,\"began\":\"d\"}\n{\"t\":70,\"stream\":\"a\",\"value\":1}\n{\"t\":90";
    std::fs::write(path, old).unwrap();
    let listed = recordings.list().remove(0);
    assert_eq!((listed.name.as_str(), listed.revision, listed.length_ms), ("x", 3, Some(70)));
    assert!(listed.old_form && listed.cut_off && listed.marks.is_none());
}

#[test]
fn marks_are_added_changed_and_removed_and_every_line_stays() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let name = record(&recordings, &RecordedSession::default());
    let put = |mark: RecordingMark| recordings.put_mark(&name, mark, "Aiko");
    let words = || -> Vec<(String, u64, String)> {
        let marks = recordings.marks(&name).unwrap().into_iter();
        marks.map(|mark| (mark.id.to_string(), mark.t, format!("{}{}", mark.word, mark.note))).collect()
    };
    let is = |id: &str, t, words: &str| (id.to_owned(), t, words.to_owned());
    put(mark("m1", 900, " smiles ")).unwrap();
    put(RecordingMark { until: Some(2_000), ..mark("m2", 1_600, "plays") }).unwrap();
    let all = [is("m1", 900, "smiles"), is("note-1", 1_500, "he laughs"), is("m2", 1_600, "plays")];
    assert_eq!(words(), all);
    assert_eq!(recordings.marks(&name).unwrap()[0].by, "Aiko", "who writes it is the server's to say");
    put(RecordingMark { gone: true, ..mark("note-1", 1_500, "") }).unwrap();
    put(mark("m1", 950, "laughs")).unwrap();
    assert_eq!(words(), [is("m1", 950, "laughs"), is("m2", 1_600, "plays")]);
    put(RecordingMark { note: "he laughs".to_owned(), ..mark("note-1", 1_500, "") }).unwrap();
    assert_eq!(words()[1], is("note-1", 1_500, "he laughs"), "what is gone comes back");
    let path = super::marks_of(&recordings.find(&name).unwrap());
    let text = std::fs::read_to_string(&path).unwrap();
    assert_eq!(text.lines().count(), 5, "{text}");
    // A power cut tears a line; the next one is whole all the same.
    std::fs::write(&path, format!("{text}{{\"id\":\"m3\",\"t")).unwrap();
    put(mark("m4", 3_000, "waves")).unwrap();
    assert_eq!(words().last(), Some(&is("m4", 3_000, "waves")));
    assert!(std::fs::read_to_string(&path).unwrap().starts_with(&text), "it only grows");
    recordings.remove(&name).unwrap();
    assert!(!path.exists() && recordings.marks(&name) == Err(Refused::NoRecording));
    recordings.restore(&name).unwrap();
    assert_eq!(words().last(), Some(&is("m4", 3_000, "waves")), "they come back with it");
}

#[test]
fn the_marks_of_a_recording_that_goes_on_are_its_runs() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let (file, session) = (file(), RecordedSession::default());
    let about =
        About { run: 1, robot: "NAO", behaviour: &id("b"), revision: 1, by: "Aiko", file: &file, session: &session };
    let mut goes_on = recordings.begin(&about).unwrap();
    let name = goes_on.news().unwrap().file;
    let no = recordings.change_mark(&name, mark("m1", 1_000, "plays"), "Ben").unwrap_err().to_string();
    assert!(no.contains("still being recorded"), "{no}");
    assert!(!super::marks_of(&recordings.find(&name).unwrap()).exists());
}

#[test]
fn nothing_in_the_bin_is_replaced_by_another_of_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let name = record(&recordings, &RecordedSession::default());
    let path = recordings.find(&name).unwrap();
    let first = std::fs::read_to_string(&path).unwrap();
    recordings.remove(&name).unwrap();
    std::fs::write(&path, first.replace("Aiko", "Ben")).unwrap();
    assert!(recordings.remove(&name).is_err() && path.exists());
    std::fs::remove_file(&path).unwrap();
    recordings.restore(&name).unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), first);
}

#[test]
fn the_bin_gives_way_before_any_recording_does() {
    let folder = tempfile::tempdir().unwrap();
    let recordings =
        Recordings { bounds: RecordingBounds { kept: 3, bytes: u64::MAX }, ..Recordings::within(Some(folder.path())) };
    let [first, second] = [(); 2].map(|()| record(&recordings, &RecordedSession::default()));
    recordings.name(&second, " The second ").unwrap();
    recordings.remove(&second).unwrap();
    let binned = || recordings.binned().into_iter().map(|one| (one.file, one.title)).collect::<Vec<_>>();
    assert_eq!(binned(), [(second.clone(), Some("The second".to_owned()))]);
    record(&recordings, &RecordedSession::default());
    assert_eq!(binned().len(), 1, "there is room for three");
    let (file, session) = (file(), RecordedSession::default());
    let about =
        About { run: 1, robot: "NAO", behaviour: &id("b"), revision: 1, by: "Aiko", file: &file, session: &session };
    let mut fourth = recordings.begin(&about).unwrap();
    let Recorded { file, gave_way, .. } = fourth.news().unwrap();
    assert_eq!(gave_way, 0, "nothing that is kept gave way");
    assert!(recordings.find(&first).is_some() && binned().is_empty());
    let still = recordings.remove(&file).unwrap_err().to_string();
    assert!(still.contains("it is still being recorded; end its recording first"), "{still}");
    assert!(recordings.list().iter().any(|one| one.goes_on && !one.cut_off));
}

#[test]
fn marks_have_bounds_with_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let name = record(&recordings, &RecordedSession::default());
    let said = |mark: RecordingMark| recordings.put_mark(&name, mark, "Aiko").unwrap_err().to_string();
    assert!(said(mark("m", 1, &"w".repeat(41))).contains("a note has at most 200 characters, and a word 40"));
    assert!(said(RecordingMark { note: "n".repeat(201), ..mark("m", 1, "") }).contains("at most 200 characters"));
    assert!(said(RecordingMark { until: Some(7), ..mark("m", 7, "") }).contains("ends after it begins"));
    assert!(said(mark("m", u64::MAX, "")).contains("within the recording"));
    let path = super::marks_of(&recordings.find(&name).unwrap());
    let line = |number: usize| recording::json(&mark(&format!("m{number}"), 1, "")) + "\n";
    std::fs::write(&path, (1..RECORDING_MARKS_MAX).map(line).collect::<String>()).unwrap();
    assert!(said(mark("more", 1, "")).contains("as many marks as a recording may have"));
    recordings.put_mark(&name, mark("m7", 2, "changed"), "Aiko").unwrap();
    std::fs::write(&path, "x".repeat(2 << 20)).unwrap();
    assert!(said(mark("m7", 1, "")).contains("as many marks"));
}
