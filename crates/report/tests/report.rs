//! The report of a recording, from its lines to its page: whole, old, torn, long and hostile ones.
#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

use behaviour::{DeviceType, Knowledge, Params, StreamKind};
use phrase::Catalogue;
use protocol::Recording;
use recording::{PrivateParts, open};
use report::{Gathered, Replayed, ReportWishes, SessionNumbers, Zone, page};

const RECORDING: &str = include_str!("data/greet.jsonl");
const MARKS: &str = include_str!("data/greet.marks.jsonl");

/// The catalogue of devices alone.
struct Devices;

impl Knowledge for Devices {
    fn device(&self, _: StreamKind, _: &str, _: &Params) -> Result<(), phrase::Phrase> {
        Ok(())
    }

    fn body(&self, _: &[String], _: &str) -> Result<(), phrase::Phrase> {
        Ok(())
    }

    fn device_type(&self, kind: StreamKind, device: &str, params: &Params) -> DeviceType {
        robot::device_type(kind, device, params)
    }
}

fn gathered(text: &str, later: &str, names: bool, language: &'static Catalogue) -> Gathered {
    let (header, lines) = open(text).unwrap();
    let mut gathered = Gathered::of(header, PrivateParts { names, personal: false }, language);
    lines.entries().for_each(|entry| gathered.take(&entry, &Devices));
    gathered.finish(later);
    gathered
}

fn asked(names: bool) -> ReportWishes {
    let download = "/api/recordings/greet.jsonl".to_owned();
    ReportWishes { names, zone: Zone::east_by(Some(60)), download, parts: ["/report.css", "/report.js"] }
}

fn told(text: &str, later: &str, names: bool, language: &'static Catalogue) -> String {
    let gathered = gathered(text, later, names, language);
    page(&gathered, Replayed::from(&recording::check(text)), &[], &asked(names))
}

fn english(text: &str) -> String {
    told(text, "", false, catalogues::english())
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
    let plain = text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&");
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[track_caller]
fn says(page: &str, wanted: &[&str]) {
    let seen = seen(page);
    for text in wanted {
        let shown: String = seen.chars().take(4_000).collect();
        assert!(seen.contains(text), "“{text}” is not in:\n{shown}");
    }
}

#[test]
fn a_report_says_what_happened() {
    let page = told(RECORDING, MARKS, true, catalogues::english());
    says(
        &page,
        &[
            "Session report: C-07 Greet , version 1",
            "Day 21 November 2026 Time 19:34:06 to 19:34:10 (0:04)",
            "People Aiko , Ben , Cleo Robot NAO , battery 80 %",
            "What it did When a face is seen",
            "It ended: it was stopped",
            "By the program, 4 What Count Time Say, \"loud\" 1 Eyes 3",
            "What it sensed Count Time Face 1 Word 1",
            "By hand, 2 What Count By Say the value: “ =1+1; <b>--> & \"so\" ” 1 Cleo As if: Ball 1 Ben",
            "Marks, 3 Word Count Time laughs 2 0:02 a note only 1",
            "Troubles, 3 19:34:09 “ Say, \"loud\" ” was refused ( the voice is held by hand ) It was kept by Cleo",
            "19:34:09 “ Hello ” failed ( no text )",
            "Lines that could not be written in time and are missing here: 3.",
            "Notes and verdicts, 3 written by the operators 19:34:07 ( Cleo ) · laughs · good 19:34:07 “ with Ben ” ( Cleo ) · laughs 19:34:08 “ told Aiko, so ” ( Ben )",
            "Notes are the operators’ own words.",
            "No name was asked for.",
        ],
    );
    assert!(page.contains("<svg class=\"timeline\"") && !page.contains("over 1 sessions"), "{page}");
}

#[test]
fn staff_are_named_by_choice_alone_and_never_what_the_robot_sensed_of_somebody() {
    for language in catalogues::all() {
        let plain = told(RECORDING, MARKS, false, language);
        for name in ["Aiko", "Ben", "Cleo", "Emma", "banana"] {
            assert!(!plain.contains(name), "{name}: {plain}");
        }
        assert!(plain.contains("P1") && plain.contains("&amp;names=1") && !plain.contains("csv&amp;names"), "{plain}");
        let named = told(RECORDING, MARKS, true, language);
        assert!(["Aiko", "Ben", "Cleo"].iter().all(|name| named.contains(name)), "{named}");
        assert!(!named.contains("Emma") && !named.contains("banana"), "{named}");
        assert!(named.contains("?as=csv&amp;names=1"), "the downloads follow: {named}");
    }
}

#[test]
fn the_words_are_japanese_where_they_are_wanted() {
    let page = told(RECORDING, MARKS, false, catalogues::of("ja").unwrap());
    says(
        &page,
        &[
            "セッションのレポート：C-07",
            "2026年11月21日",
            "バッテリー 80 %",
            "名前はたずねていません。",
            "ためしに：",
            "再生",
        ],
    );
    let seen = seen(&page);
    for english in ["Session", "Count", "Troubles", "Marks", "written", "Download", "battery", "version"] {
        assert!(!seen.contains(english), "{english} is in {seen}");
    }
    assert!(page.starts_with("<!DOCTYPE html><html lang=\"ja\">"), "{page}");
}

#[test]
fn a_recording_says_what_it_lacks_and_where_it_ends() {
    let without =
        |kind: &str| -> String { RECORDING.split_inclusive('\n').filter(|line| !line.contains(kind)).collect() };
    let old = without("\"mark\":\"file\"").replacen("rrp-recording/2", "rrp-recording/1", 1);
    says(
        &english(&old),
        &["This recording is of an older form.", "Values by id Count Time face 1", "old file without the program"],
    );
    let marks = RECORDING.replacen("\"run\":1", "\"run\":1,\"records\":\"marks\"", 1);
    says(&english(&marks), &["Only marks and actions were recorded", "not possible: marks and actions only"]);
    let torn = without("\"mark\":\"end\"") + "{\"t\":4000,\"ma";
    says(&english(&torn), &["It ends early, at 19:34:09: the server or the disk ended", "without its last line"]);
    let full = without("\"mark\":\"end\"") + "{\"mark\":\"full\"}\n";
    says(&english(&full), &["it is as large as a recording may be", "as large as one may be, and ends here"]);
    let header = RECORDING.lines().next().unwrap();
    says(&english(header), &["cut off before it says what ran", "it lacks what ran", "Nothing was marked."]);
    let strange = RECORDING.replacen("2026-11-21T18:34:06Z", "some day", 1);
    says(&english(&strange), &["0:00 to 0:04 (0:04)"]);
    let mut goes_on = gathered(&torn, "", false, catalogues::english());
    goes_on.goes_on();
    says(&page(&goes_on, Replayed::Same, &[], &asked(false)), &["The session goes on.", "same as recorded"]);
}

#[test]
fn a_replay_says_if_it_is_the_same() {
    let of = |found| page(&gathered(RECORDING, "", false, catalogues::english()), found, &[], &asked(false));
    says(&of(Replayed::Same), &["Replay: same as recorded"]);
    says(&of(Replayed::Differs(3_000)), &["Replay: differs from 19:34:09"]);
    says(&of(Replayed::SameUntil(1_000)), &["same as recorded until 19:34:07; lines are missing after it"]);
    says(&of(Replayed::TooLong), &["use rrp replay --check with the download"]);
}

#[test]
fn what_was_applied_while_it_ran_is_told() {
    let file = RECORDING.lines().nth(1).unwrap();
    let later = file.replacen("\"t\":0,", "\"t\":2000,", 1).replace("EyeColor", "Print");
    let applied = format!(
        "{{\"t\":2000,\"mark\":\"applied\",\"revision\":2}}\n{}",
        later.replace("\"revision\":1", "\"revision\":2")
    );
    let end = RECORDING.lines().last().unwrap();
    let page = english(&RECORDING.replace(end, &format!("{applied}\n{end}")));
    says(
        &page,
        &[
            "At 19:34:08 changed while it ran: version 2. Before: When the red ball is seen, “Eyes” gets it.",
            "After: When the red ball is seen, the page shows it.",
        ],
    );
}

/// Texts as somebody would write them who wants a page to do something else.
const HOSTILE: [&str; 5] = [
    "<script>alert(1)</script>",
    "\"><img src=x onerror=alert(1)>",
    "' onmouseover='x",
    "\u{202e}evil\u{2066}",
    "</bdi></title>&lt;",
];

#[test]
fn no_text_of_anybody_is_more_than_a_text() {
    for text in HOSTILE {
        let json = serde_json::to_string(text).unwrap();
        let inner = &json[1..json.len() - 1];
        let hostile = [
            "Aiko",
            "Cleo",
            "Ben",
            "NAO",
            "C-07",
            "Face\"",
            "Greet",
            "Say, \\\"loud\\\"",
            "it was stopped",
            "told Aiko, so",
            "no\\ttext",
            "2026-11-21T18:34:06Z",
        ]
        .iter()
        .fold(RECORDING.replace("\"Face\"", "\"Face\\\"\""), |all, known| all.replace(known, inner));
        let later = MARKS.replace("laughs", inner).replace("Cleo", inner);
        for names in [false, true] {
            let page = told(&hostile, &later, names, catalogues::english());
            let tags: Vec<&str> = page.split('<').skip(1).collect();
            assert_eq!(tags.iter().filter(|tag| tag.starts_with("script")).count(), 1, "{text}: {page}");
            assert!(!tags.iter().any(|tag| tag.starts_with("img")), "{text}: {page}");
            // An attribute ends only where its tag does or where the next one of ours begins.
            let mut attributes = tags
                .iter()
                .filter_map(|tag| tag.split('>').next())
                .filter(|tag| tag.contains("onmouse") || tag.contains("onerror"));
            assert!(attributes.all(|tag| tag.starts_with("main data-began=\"")), "{text}: {page}");
            assert!(!page.contains(['\u{202e}', '\u{2066}']), "{text}: it turns around what stands beside it");
            assert_eq!(page.matches("<main data-began=\"").count(), 1);
            let began = page.split("data-began=\"").nth(1).unwrap().split('"').next().unwrap();
            assert!(
                page.contains(&format!("data-began=\"{began}\"><header>")),
                "{text}: the attribute ends where it should"
            );
        }
    }
}

fn session(began: &str, laughs: u64, away_ms: u64, is_this: bool) -> SessionNumbers {
    let mut marks: Vec<_> = (0..laughs)
        .map(|at| serde_json::from_str(&format!(r#"{{"id":"m{at}","t":{at},"word":"laughs"}}"#)).unwrap())
        .collect();
    let away = format!(r#"{{"id":"a","t":0,"until":{away_ms},"word":"looks away"}}"#);
    marks.push(serde_json::from_str(&away).unwrap());
    let about = Recording { began: began.to_owned(), length_ms: Some(90_000), ..Recording::default() };
    let mut session = SessionNumbers::of(&about, &marks, is_this);
    for line in RECORDING.lines() {
        session.count(line);
    }
    session
}

#[test]
fn sessions_of_a_participant_are_compared() {
    let of = gathered(RECORDING, "", false, catalogues::english());
    let sessions = [
        session("2026-11-03T10:00:00Z", 1, 200_000, false),
        session("2026-11-12T10:00:00Z", 4, 122_000, false),
        session("2026-11-21T18:34:06Z", 3, 85_000, true),
    ];
    let compared = page(&of, Replayed::Same, &sessions, &asked(false));
    says(
        &compared,
        &[
            "C-07 over 3 sessions laughs , times 1 3 Nov 4 12 Nov 3 21 Nov looks away , minutes:seconds 3:20 3 Nov 2:02 12 Nov 1:25 21 Nov",
            "3 November 2026 11:00:00 1:30 1 1 (3:20) 1",
            "21 November 2026 19:34:06 · this one 1:30 3 1 (1:25) 1",
        ],
    );
    let alone = page(&of, Replayed::Same, &sessions[..1], &asked(false));
    assert!(!alone.contains("class=\"sessions\""), "one alone is compared with nothing");
}

#[test]
fn however_long_a_recording_is_its_page_stays_small() {
    let end = RECORDING.lines().last().unwrap();
    let mut lines: Vec<&str> = RECORDING.lines().filter(|line| *line != end).collect();
    let many: Vec<String> = (0..60_000_u64)
        .flat_map(|number| {
            let ms = 4_000 + number * 1_700;
            [
                format!(r#"{{"t":{ms},"stream":"face","value":{number}}}"#),
                format!(r#"{{"t":{ms},"hand":"SayInput","value":"{}","by":"Person {}"}}"#, number % 999, number % 500),
                format!(r#"{{"t":{ms},"connector":"c","error":"{number}"}}"#),
                format!(r#"{{"t":{ms},"mark":"note","by":"Ben","note":"{number}"}}"#),
            ]
        })
        .collect();
    lines.extend(many.iter().map(String::as_str));
    lines.push(end);
    let page = english(&lines.join("\n"));
    assert!(page.len() < 600_000, "{} bytes", page.len());
    says(&page, &["By hand, 60002", "and 59903 more", "P?"]);
}
