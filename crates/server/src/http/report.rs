//! The report of a recording as a page, and a recording in the forms of other programs: on threads of their own, which nothing
//! else waits for.

use super::join::BrowserLanguage;
use crate::recordings::{Recordings, ReportSource};
use crate::support::file_name::{disposition, encoded};
use crate::support::identity::Sender;
use crate::support::workers::{WorkNotDone, Workers};
use axum::http::{StatusCode, header};
use axum::response::{Html, IntoResponse, Response};
use behaviour::Knowledge;
use protocol::{RECORDINGS_PATH, Refused};
use recording::PrivateParts;
use report::{Form, ReportWishes, Zone};
use serde::Deserialize;

/// The addresses of what the page looks like and does.
const PARTS: [&str; 2] = ["/report.css", "/report.js"];

/// The query of an address. What is none of what can be asked is taken as not asked.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct ReportQuery {
    language: Option<String>,
    names: Option<String>,
    offset: Option<String>,
    r#as: Option<String>,
    semicolon: Option<String>,
}

impl ReportQuery {
    fn names(&self) -> bool {
        self.names.as_deref() == Some("1")
    }

    /// The form in which a recording is wanted; none as it is.
    pub(super) fn form(&self) -> Option<Result<Form, Response>> {
        let separator = if self.semicolon.as_deref() == Some("1") { ';' } else { ',' };
        Some(Ok(match self.r#as.as_deref()? {
            "jsonl" => return None,
            "csv" => Form::Csv(separator),
            "eaf" => Form::Eaf,
            "boris" => Form::Boris,
            "vtt" => Form::Vtt,
            _ => return Some(Err((StatusCode::BAD_REQUEST, NO_FORM).into_response())),
        }))
    }
}

/// Tells whoever asks for another form which there are.
const NO_FORM: &str =
    "There is no such form here. Choose as=csv, eaf, boris, vtt or jsonl; `rrp convert` also makes MCAP.\n";

/// The page, in the language that is wanted or else that of the browser.
pub(super) async fn page(
    recordings: Recordings,
    knowledge: std::sync::Arc<impl Knowledge + Send + Sync + 'static>,
    (analyses, sender): (&Workers, Sender),
    (name, wanted, browser): (String, ReportQuery, BrowserLanguage),
) -> Response {
    let language = report::language_of(wanted.language.as_deref(), browser.catalogue());
    let names = wanted.names();
    let offset = wanted.offset.as_deref().and_then(|minutes| minutes.parse().ok());
    let asked = ReportWishes {
        names,
        zone: Zone::east_by(offset),
        download: format!("{RECORDINGS_PATH}/{}", encoded(&name)),
        parts: PARTS,
    };
    let keep = PrivateParts { names, personal: false };
    let made = analyses.run(sender, move |token| {
        let ReportSource { gathered, replayed, sessions } =
            recordings.look(&name, (keep, language), &*knowledge, token)?;
        Ok(report::page(&gathered, replayed, &sessions, &asked))
    });
    match made.await {
        Ok(Ok(page)) => {
            let headers = [(header::CACHE_CONTROL, "no-store"), (header::VARY, "accept-language")];
            (headers, Html(page)).into_response()
        }
        Ok(Err(why)) => refused(&why),
        Err(why) => busy(why),
    }
}

/// A recording in another form, as a file.
pub(super) async fn converted(
    recordings: Recordings,
    (analyses, sender): (&Workers, Sender),
    (name, form, wanted): (String, Form, ReportQuery),
) -> Response {
    let stem = name.trim_end_matches(".jsonl").to_owned();
    let keep = PrivateParts { names: wanted.names(), personal: false };
    let made = analyses.run(sender, move |_| {
        let timeline = recordings.timeline(&name, keep)?;
        form.written(&timeline).map_err(|error| Refused::CannotRecord(error.to_string().into()))
    });
    match made.await {
        Ok(Ok(bytes)) => {
            let headers = [
                (header::CONTENT_TYPE, form.media_type().to_owned()),
                (header::CONTENT_DISPOSITION, disposition(&stem, form.ending())),
            ];
            (headers, bytes).into_response()
        }
        Ok(Err(why)) => refused(&why),
        Err(why) => busy(why),
    }
}

/// The stylesheet.
pub(super) fn style() -> Response {
    ([(header::CONTENT_TYPE, "text/css; charset=utf-8")], report::STYLE).into_response()
}

/// The script.
pub(super) fn script() -> Response {
    ([(header::CONTENT_TYPE, "text/javascript; charset=utf-8")], report::SCRIPT).into_response()
}

fn refused(why: &Refused) -> Response {
    let status = match why {
        Refused::NoRecording => StatusCode::NOT_FOUND,
        Refused::CannotRecord(_) => StatusCode::UNPROCESSABLE_ENTITY,
        _ => StatusCode::INTERNAL_SERVER_ERROR,
    };
    (status, format!("{why}\n")).into_response()
}

pub(super) fn busy(why: WorkNotDone) -> Response {
    (StatusCode::SERVICE_UNAVAILABLE, format!("{}\n", Refused::from(why))).into_response()
}
