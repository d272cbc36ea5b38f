//! The answer to a press of Stop: a page to who sends a form, a line to everybody else.

use crate::http::join::BrowserLanguage;
use crate::http::origin::NotAllowed;
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, Uri, header};
use axum::response::{IntoResponse, Response};

const PAGE: &str = include_str!("page.html");
/// The longest query that the page has its form send again, in bytes: that of our own form is no longer than two ids.
const QUERY_MAX_BYTES: usize = 512;

/// An answer, before it is written.
pub(in crate::http) struct StopAnswer {
    pub(super) status: StatusCode,
    kind: &'static str,
    pub(super) body: String,
    /// The number of the newest Stop, where it was one.
    stops: Option<u64>,
}

impl StopAnswer {
    /// Says what became of a Stop that was sent to this address.
    pub(super) fn of(became: &Result<(), NotAllowed>, uri: &Uri, asked: &HeaderMap) -> Self {
        let status = if became.is_ok() { StatusCode::OK } else { StatusCode::FORBIDDEN };
        let (kind, body) = match became {
            _ if wants_page(asked) => ("text/html; charset=utf-8", page(became, uri, BrowserLanguage::of(asked))),
            Ok(()) => ("application/json", "{\"stopped\":true}".to_owned()),
            Err(why) => ("text/plain; charset=utf-8", format!("Refused: {why}.\n")),
        };
        Self { status, kind, body, stops: None }
    }

    /// Tells the number of the newest Stop too, if this one was done.
    pub(super) fn with_stops(self, newest: u64) -> Self {
        Self { stops: (self.status == StatusCode::OK).then_some(newest), ..self }
    }

    /// The headers of this answer, besides those of every one.
    pub(super) fn headers(&self) -> HeaderMap {
        let fixed = [
            (header::CONTENT_TYPE, self.kind),
            (header::CACHE_CONTROL, "no-store"),
            (header::VARY, "accept, accept-language"),
        ];
        let fixed = fixed.map(|(name, value)| (name, HeaderValue::from_static(value)));
        let stops = self.stops.map(|stops| (HeaderName::from_static(protocol::STOPS_HEADER), HeaderValue::from(stops)));
        fixed.into_iter().chain(stops).collect()
    }
}

impl IntoResponse for StopAnswer {
    fn into_response(self) -> Response {
        (self.status, self.headers(), self.body).into_response()
    }
}

/// Whether what comes back is shown to a person: browsers ask for pages where they go to a page only.
fn wants_page(asked: &HeaderMap) -> bool {
    let lines = asked.get_all(header::ACCEPT).iter().filter_map(|line| line.to_str().ok());
    lines.flat_map(|line| line.split(',')).any(|kind| kind.trim().to_ascii_lowercase().starts_with("text/html"))
}

fn page(became: &Result<(), NotAllowed>, uri: &Uri, language: BrowserLanguage) -> String {
    let [title, text] = match became {
        Ok(()) => language.stopped(),
        Err(why) => language.not_stopped(*why),
    };
    let holes = [
        ("{language}", language.code()),
        ("{title}", title.as_str()),
        ("{text}", &text),
        ("{address}", &escaped(&address(uri))),
        ("{stop}", &language.stop()),
        ("{back}", &language.back()),
    ];
    holes.iter().fold(PAGE.to_owned(), |page, (hole, said)| page.replace(hole, said))
}

/// Where Stop is pressed again: for the robot that was named.
fn address(uri: &Uri) -> String {
    let query = uri.query().filter(|query| query.len() <= QUERY_MAX_BYTES);
    query.map_or_else(|| protocol::STOP_PATH.to_owned(), |query| format!("{}?{query}", protocol::STOP_PATH))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;").replace('{', "%7B")
}

#[cfg(test)]
mod tests {
    use super::{StopAnswer, page, wants_page};
    use crate::http::german::german;
    use crate::http::join::BrowserLanguage;
    use crate::http::origin::NotAllowed;
    use axum::http::{HeaderMap, HeaderValue, Uri, header};

    fn asked(accept: &'static str, language: &'static str) -> HeaderMap {
        let lines = [(header::ACCEPT, accept), (header::ACCEPT_LANGUAGE, language)];
        lines.into_iter().map(|(name, value)| (name, HeaderValue::from_static(value))).collect()
    }

    #[test]
    fn a_form_gets_a_page_and_a_program_a_line() {
        assert!(
            wants_page(&asked("text/html,application/xhtml+xml,*/*;q=0.8", ""))
                && wants_page(&asked("*/*, Text/HTML", ""))
        );
        assert!(!wants_page(&asked("application/json", "")) && !wants_page(&asked("*/*", "")));
        assert!(!wants_page(&HeaderMap::new()));
        let uri: Uri = "/stop".parse().unwrap();
        assert_eq!(StopAnswer::of(&Ok(()), &uri, &asked("application/json", "ja")).body, "{\"stopped\":true}");
    }

    #[test]
    fn a_page_has_stop_again_for_the_robot_that_was_named() {
        let uri = Uri::from_static("/stop?robot=r1&x={title}'");
        let page = StopAnswer::of(&Ok(()), &uri, &asked("text/html", "en")).body;
        assert!(page.contains("action=\"/stop?robot=r1&amp;x=%7Btitle}'\""), "{page}");
        assert!(!page.contains('{'), "every hole is filled");
    }

    #[test]
    fn a_third_language_is_a_catalogue_and_a_line() {
        let german = BrowserLanguage::with(&german()[0]);
        let page = page(&Ok(()), &Uri::from_static("/stop"), german);
        assert!(page.contains("lang=\"de\"") && page.contains("<h1 role=\"status\">Angehalten</h1>"), "{page}");
        assert!(page.contains("The robot holds still."), "English stands in: {page}");
    }

    #[test]
    fn every_refusal_says_what_to_do_in_both_languages() {
        let uri = Uri::from_static("/stop");
        let all = [
            NotAllowed::Unreadable,
            NotAllowed::NoHost,
            NotAllowed::OtherHost,
            NotAllowed::NoOrigin,
            NotAllowed::OtherPage,
            NotAllowed::NotInvited,
            NotAllowed::Forwarded,
        ];
        for why in all {
            let english = StopAnswer::of(&Err(why), &uri, &asked("text/html", "en-GB")).body;
            assert!(english.contains("lang=\"en\"") && english.contains("button on its chest"), "{english}");
            let japanese = StopAnswer::of(&Err(why), &uri, &asked("text/html", "ja")).body;
            assert!(japanese.contains("lang=\"ja\"") && japanese.contains("胸のボタン"), "{japanese}");
        }
    }
}
