//! The recordings as a page, and the forms on it that change one: by plain HTML, without a program in the browser.

use super::join::BrowserLanguage;
use super::report::busy;
use crate::recordings::{ALL_MAX_BYTES, Recordings};
use crate::support::file_name::encoded;
use crate::support::identity::Sender;
use crate::support::workers::Workers;
use axum::http::{StatusCode, header};
use axum::response::{Html, IntoResponse, Redirect, Response};
use behaviour::Id;
use phrase::phrase;
use protocol::{RECORDINGS_PATH, REPORTS_PATH, RecordingMark, Refused};
use report::{Choice, List, Zone};
use serde::Deserialize;

/// The addresses of what the page looks like and does.
const PARTS: [&str; 3] = ["/report.css", "/recordings.css", "/report.js"];
/// The name under which marks stand that the host changes here, where nobody says who they are.
pub(super) const HOST: &str = "host";
/// The longest text that is looked for, in bytes.
const FIND_MAX_BYTES: usize = 400;
/// The most rows that are shown.
const ROWS_MAX: usize = 1_000;

/// The query of an address.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct ListQueryWanted {
    language: Option<String>,
    offset: Option<String>,
    find: String,
    program: String,
    code: String,
    rows: Option<String>,
    bin: Option<String>,
    chosen: Option<String>,
}

/// A form that was sent.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct ListForm {
    language: Option<String>,
    offset: Option<String>,
    bin: Option<String>,
    r#do: String,
    title: String,
    mark: String,
    word: String,
    note: String,
    gone: Option<String>,
}

fn number<T: std::str::FromStr>(text: Option<&str>) -> Option<T> {
    text.and_then(|text| text.parse().ok())
}

/// The page.
pub(super) async fn page(
    recordings: Recordings,
    (analyses, sender): (&Workers, Sender),
    (wanted, browser, may_change): (ListQueryWanted, BrowserLanguage, bool),
) -> Response {
    let is_short = |text: &String| text.len() <= FIND_MAX_BYTES;
    let made = analyses.run(sender, move |token| {
        let bin = wanted.bin.as_deref() == Some("1");
        let (all, chosen) = recordings.listed(bin, wanted.chosen.as_deref(), token);
        let [find, program, code] =
            [wanted.find, wanted.program, wanted.code].map(|text| Some(text).filter(is_short).unwrap_or_default());
        let rows = number::<usize>(wanted.rows.as_deref()).unwrap_or(0).min(ROWS_MAX);
        report::list(&List {
            all,
            chosen,
            choice: Choice { find, program, code, rows, bin },
            binned: recordings.binned().len(),
            most_bytes: ALL_MAX_BYTES,
            may_change,
            language: report::language_of(wanted.language.as_deref(), browser.catalogue()),
            zone: Zone::east_by(number(wanted.offset.as_deref())),
            parts: PARTS,
            downloads: RECORDINGS_PATH,
            encoded,
        })
    });
    match made.await {
        Ok(page) => {
            ([(header::CACHE_CONTROL, "no-store"), (header::VARY, "accept-language")], Html(page)).into_response()
        }
        Err(why) => busy(why),
    }
}

/// Does what a form says, and shows the list again.
pub(super) async fn change(
    recordings: Recordings,
    (files, sender): (&Workers, Sender),
    (file, change, by, browser): (String, ListForm, String, BrowserLanguage),
) -> Response {
    let language = report::language_of(change.language.as_deref(), browser.catalogue());
    let mut back = format!("{REPORTS_PATH}?language={}", language.language().code);
    if let Some(minutes) = number::<i32>(change.offset.as_deref()) {
        back.push_str(&format!("&offset={minutes}"));
    }
    // A recording that was removed or brought back is in the other list.
    let moves = matches!(change.r#do.as_str(), "bin" | "restore" | "remove");
    let bin = if change.bin.as_deref() == Some("1") { "&bin=1" } else { "" };
    let shown = if moves { bin.to_owned() } else { format!("{bin}&chosen={}", encoded(&file)) };
    let done = files.run(sender, move |_| done(&recordings, &file, change, &by));
    match done.await {
        Ok(Ok(())) => Redirect::to(&format!("{back}{shown}")).into_response(),
        Ok(Err(why)) => {
            let status = if why == Refused::NoRecording { StatusCode::NOT_FOUND } else { StatusCode::CONFLICT };
            (status, Html(report::no(&why, language, PARTS, &back))).into_response()
        }
        Err(why) => busy(why),
    }
}

fn done(recordings: &Recordings, file: &str, change: ListForm, by: &str) -> Result<(), Refused> {
    match change.r#do.as_str() {
        "title" => recordings.name(file, &change.title),
        "bin" => recordings.remove(file),
        "restore" => recordings.restore(file),
        "remove" => recordings.remove_for_good(file),
        "mark" => {
            let id = Id::new(&change.mark).map_err(|_| Refused::NoRecording)?;
            let known = recordings.marks(file)?.into_iter().find(|mark| mark.id == id).ok_or(Refused::NoRecording)?;
            let gone = change.gone.is_some();
            recordings.change_mark(file, RecordingMark { word: change.word, note: change.note, gone, ..known }, by)
        }
        _ => Err(Refused::CannotRecord(phrase!("recordings.form", "this form is of another version; reload the page"))),
    }
}

/// The stylesheet.
pub(super) fn style() -> Response {
    ([(header::CONTENT_TYPE, "text/css; charset=utf-8")], report::LIST_STYLE).into_response()
}
