//! Reports of recordings, recordings in other forms, and the list of recordings as a page: over HTTP, as a browser asks.

use crate::house::House;
use crate::http::raw;
use std::path::Path;
use std::sync::Arc;
use store::MemoryStore;

const RECORDING: &str = include_str!("../../../report/tests/data/greet.jsonl");
const MARKS: &str = include_str!("../../../report/tests/data/greet.marks.jsonl");
const GREET: &str = "2026-11-21T18-34-06Z-greet.jsonl";
const OLD: &str = "2026-11-20T10-00-00Z-old.jsonl";
const EVIL: &str = "2026-11-19T10-00-00Z-evil.jsonl";
const HOSTILE: &str = "\\\"><script>alert(1)</script>";

/// A data folder with a whole recording, one of the first form, and one with texts that mean harm.
fn prepare(data: &Path) {
    let folder = data.join("recordings");
    std::fs::create_dir_all(&folder).unwrap();
    let put = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    put(GREET, RECORDING);
    put(&GREET.replace(".jsonl", ".marks.jsonl"), MARKS);
    let old = RECORDING.replacen("rrp-recording/2", "rrp-recording/1", 1).replace("2026-11-21T18", "2026-11-20T10");
    put(OLD, &old.split_inclusive('\n').filter(|line| !line.contains("\"file\"")).collect::<String>());
    put(
        EVIL,
        &RECORDING.replace("C-07", HOSTILE).replace("\"Greet\"", &format!("\"{HOSTILE}\"")).replace("Aiko", HOSTILE),
    );
}

async fn get(house: &House, path: &str, more: &str) -> String {
    raw(house, &format!("GET {path} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n{more}\r\n", house.address)).await
}

async fn post(house: &House, path: &str, body: &str) -> String {
    let (address, length) = (house.address, body.len());
    let head = format!("POST {path} HTTP/1.1\r\nHost: {address}\r\nOrigin: http://{address}\r\nConnection: close\r\n");
    let form = format!("Content-Type: application/x-www-form-urlencoded\r\nContent-Length: {length}\r\n\r\n{body}");
    raw(house, &format!("{head}{form}")).await
}

#[track_caller]
fn says(answer: &str, status: &str, texts: &[&str]) {
    assert!(answer.starts_with(&format!("HTTP/1.1 {status}")), "{answer}");
    for text in texts {
        assert!(answer.contains(text), "“{text}” is not in {answer}");
    }
}

#[tokio::test]
async fn a_report_is_a_page_in_the_language_and_with_the_names_that_are_wanted() {
    let folder = tempfile::tempdir().unwrap();
    prepare(folder.path());
    let house = House::beside(Arc::new(MemoryStore::default()), folder.path()).await;
    let report = format!("/recordings/{GREET}/report");
    let page = get(&house, &report, "").await;
    says(
        &page,
        "200",
        &["text/html", "no-store", "<title>Session report: C-07", "18:34:06 to 18:34:10", " UTC", "P1", "/report.css"],
    );
    assert!(["Aiko", "Ben", "Cleo", "Emma"].iter().all(|name| !page.contains(name)), "{page}");
    let named = get(&house, &format!("{report}?names=1&offset=540&language=en"), "Accept-Language: ja\r\n").await;
    says(&named, "200", &["22 November 2026", "03:34:06 to 03:34:10 (0:04)", "Aiko", "<html lang=\"en\">"]);
    let japanese = get(&house, &report, "Accept-Language: ja\r\n").await;
    says(&japanese, "200", &["<html lang=\"ja\">", "セッションのレポート：C-07"]);
    let strange = get(&house, &format!("{report}?language=xx&offset=999999999999&names=maybe"), "").await;
    says(&strange, "200", &["<html lang=\"en\">", " UTC", "P1"]);
    says(
        &get(&house, &format!("/recordings/{OLD}/report"), "").await,
        "200",
        &["of an older form", "old file without the program"],
    );
    says(&get(&house, "/recordings/none.jsonl/report", "").await, "404", &["There is no such recording any more."]);
    says(&get(&house, "/recordings/..%2f..%2fetc%2fpasswd/report", "").await, "404", &[]);
    for path in ["/report.css", "/report.js", "/recordings.css"] {
        says(&get(&house, path, "").await, "200", &["content-type: text/"]);
    }
    house.close().await;
}

#[tokio::test]
async fn no_text_of_a_recording_is_markup_on_a_page() {
    let folder = tempfile::tempdir().unwrap();
    prepare(folder.path());
    let house = House::beside(Arc::new(MemoryStore::default()), folder.path()).await;
    for path in [
        format!("/recordings/{EVIL}/report?names=1"),
        format!("/recordings?chosen={EVIL}"),
        format!("/recordings?find=%22%3E%3Cscript%3E&program={}", "%22%3E%3Cscript%3E"),
    ] {
        let page = get(&house, &path, "").await;
        says(&page, "200", &[]);
        assert_eq!(page.matches("<script").count(), 1, "the page's own: {page}");
    }
    house.close().await;
}

#[tokio::test]
async fn recordings_are_downloaded_in_other_forms_without_names() {
    let folder = tempfile::tempdir().unwrap();
    prepare(folder.path());
    let house = House::beside(Arc::new(MemoryStore::default()), folder.path()).await;
    let file = format!("/api/recordings/{GREET}");
    for (form, media_type, text) in [
        ("csv", "text/csv; charset=utf-8", "\"t_ms\",\"clock\""),
        ("csv&semicolon=1", "text/csv; charset=utf-8", "\"t_ms\";\"clock\""),
        ("eaf", "application/xml", "<ANNOTATION_DOCUMENT"),
        ("boris", "text/tab-separated-values", "C-07\tlaughs"),
        ("vtt", "text/vtt", "WEBVTT"),
    ] {
        let plain = get(&house, &format!("{file}?as={form}"), "").await;
        says(&plain, "200", &[media_type, text, "attachment; filename="]);
        let names = ["Aiko", "Ben", "Cleo", "Emma", "banana"];
        assert!(names.iter().all(|name| !plain.contains(name)), "{form}: {plain}");
        says(&get(&house, &format!("{file}?as={form}&names=1"), "").await, "200", &["Ben"]);
    }
    says(&get(&house, &file, "").await, "200", &["application/jsonl", "Aiko"]);
    says(&get(&house, &format!("{file}?as=mcap"), "").await, "400", &["Choose as=csv, eaf, boris, vtt or jsonl"]);
    says(&get(&house, "/api/recordings/none.jsonl?as=csv", "").await, "404", &["no such recording"]);
    let large = std::fs::File::options().append(true).open(folder.path().join("recordings").join(GREET)).unwrap();
    large.set_len(33 << 20).unwrap();
    says(
        &get(&house, &format!("{file}?as=csv"), "").await,
        "422",
        &["too large to be converted here", "by the command line"],
    );
    house.close().await;
}

#[tokio::test]
async fn recordings_are_found_named_binned_and_brought_back() {
    let folder = tempfile::tempdir().unwrap();
    prepare(folder.path());
    let house = House::beside(Arc::new(MemoryStore::default()), folder.path()).await;
    let list = get(&house, "/recordings?offset=0", "").await;
    says(
        &list,
        "200",
        &[
            "<h1>Recordings</h1>",
            "C-07",
            "21 November 2026",
            "old file: no program",
            "not checked yet",
            "3 recordings",
            "Bin · 0",
        ],
    );
    let chosen = get(&house, &format!("/recordings?offset=0&chosen={GREET}"), "").await;
    says(
        &chosen,
        "200",
        &[
            "differs from 18:34:06",
            "laughs",
            "Rename",
            "To the bin",
            &format!("/recordings/{GREET}/report?language=en"),
            "as=eaf",
        ],
    );
    says(&get(&house, "/recordings?offset=0", "").await, "200", &["differs from 18:34:06"]);
    let found = get(&house, "/recordings?find=c-07+21+nov", "").await;
    assert!(found.contains(&format!("chosen={GREET}")) && !found.contains(&format!("chosen={OLD}")), "{found}");
    says(&get(&house, "/recordings?find=nobody", "").await, "200", &["No recording is found."]);
    says(
        &get(&house, "/recordings", "Accept-Language: ja\r\n").await,
        "200",
        &["記録一覧", "古い記録：プログラムなし"],
    );
    let change = format!("/recordings/{GREET}/change");
    let renamed = post(&house, &change, "do=title&title=First+session+%3Cb%3E&language=en&offset=0").await;
    says(&renamed, "303", &[&format!("location: /recordings?language=en&offset=0&chosen={GREET}")]);
    says(&get(&house, "/recordings?find=first", "").await, "200", &["First session &lt;b&gt;"]);
    says(
        &post(&house, &change, &format!("do=title&title={}", "x".repeat(61))).await,
        "409",
        &["at most 60 characters"],
    );
    says(&post(&house, &change, "do=mark&mark=a&word=smiles&note=at+mother").await, "303", &[]);
    says(&post(&house, &change, "do=mark&mark=b&word=laughs&note=&gone=1").await, "303", &[]);
    let marked = get(&house, &format!("/recordings?chosen={GREET}"), "").await;
    says(&marked, "200", &["Marks, 2", "smiles", "at mother"]);
    says(&post(&house, &change, "do=mark&mark=none&word=x").await, "404", &["no such recording"]);
    says(&post(&house, &change, "do=dance").await, "409", &["reload the page"]);
    says(&post(&house, &change, "do=bin").await, "303", &["location: /recordings?language=en\r\n"]);
    let gone = get(&house, "/recordings", "").await;
    assert!(!gone.contains(GREET) && gone.contains("Bin · 1"), "{gone}");
    says(&get(&house, &format!("/recordings/{GREET}/report"), "").await, "404", &[]);
    says(
        &get(&house, &format!("/recordings?bin=1&chosen={GREET}"), "").await,
        "200",
        &["<h1>Bin</h1>", "First session", "Bring it back"],
    );
    says(&post(&house, &change, "do=restore&bin=1").await, "303", &["location: /recordings?language=en&bin=1\r\n"]);
    says(
        &get(&house, &format!("/recordings?chosen={GREET}"), "").await,
        "200",
        &["First session", "smiles", "Bin · 0"],
    );
    says(&post(&house, &change, "do=remove").await, "404", &["no such recording"]);
    says(&post(&house, &change, "do=bin").await, "303", &[]);
    says(&post(&house, &change, "do=remove&bin=1").await, "303", &[]);
    let names: Vec<_> = walked(&folder.path().join("recordings"));
    assert!(!names.iter().any(|name| name.contains("greet")), "{names:?}");
    house.close().await;
}

/// The names of all files below a folder.
fn walked(folder: &Path) -> Vec<String> {
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap().map(Result::unwrap) {
        if entry.file_type().unwrap().is_dir() {
            names.extend(walked(&entry.path()));
        } else {
            names.push(entry.file_name().to_string_lossy().into_owned());
        }
    }
    names
}
