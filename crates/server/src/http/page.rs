//! The page's files: compressed ones where the browser takes them; always asked for again, answered with "not modified"
//! while they are the same.

use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use protocol::OPERATE_PATH;
use std::borrow::Cow;

/// A file of the page.
#[derive(Clone, Debug)]
pub struct PageFile {
    /// What is in it.
    pub data: Cow<'static, [u8]>,
    /// The SHA-256 of that.
    pub hash: [u8; 32],
}

/// The page: gives the file of a name (`index.html`, `app.js.br`), if there is one.
pub type PageFiles = fn(name: &str) -> Option<PageFile>;

/// Where there is no page yet.
const NOT_BUILT: &str = "The page was not built. Run `cargo xtask serve` in the project's folder, then reload.\n";

/// The ways a file may be compressed, best first.
const CODINGS: [(&str, &str); 2] = [("br", ".br"), ("gzip", ".gz")];

/// Kinds of files by the end of their names.
const TYPES: [(&str, &str); 13] = [
    ("css", "text/css; charset=utf-8"),
    ("html", "text/html; charset=utf-8"),
    ("ico", "image/x-icon"),
    ("jpg", "image/jpeg"),
    ("js", "text/javascript; charset=utf-8"),
    ("json", "application/json"),
    ("mjs", "text/javascript; charset=utf-8"),
    ("png", "image/png"),
    ("svg", "image/svg+xml"),
    ("txt", "text/plain; charset=utf-8"),
    ("wasm", "application/wasm"),
    ("webmanifest", "application/manifest+json"),
    ("woff2", "font/woff2"),
];

/// The file at a path.
pub(crate) fn answer(page: PageFiles, path: &str, asked: &HeaderMap) -> Response {
    let name = path.trim_start_matches('/');
    let name = if name.is_empty() || is_operate(name) { "index.html" } else { name };
    let coded = name.ends_with(".br") || name.ends_with(".gz");
    if coded || name.split('/').any(|part| part.starts_with('.')) {
        return missing(name);
    }
    match best(page, name, asked) {
        Some((file, coding)) => send(name, file, coding, asked),
        None => missing(name),
    }
}

/// True for the operator's page, whichever robot stands behind it: the page's program shows it.
fn is_operate(name: &str) -> bool {
    const OPERATE: &str = OPERATE_PATH.split_at(1).1;
    name.strip_prefix(OPERATE).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

fn missing(name: &str) -> Response {
    if name == "index.html" {
        return (StatusCode::SERVICE_UNAVAILABLE, NOT_BUILT).into_response();
    }
    (StatusCode::NOT_FOUND, "There is no such page here.\n").into_response()
}

/// The best compressed sibling that the browser takes, else the plain file.
fn best(page: PageFiles, name: &str, asked: &HeaderMap) -> Option<(PageFile, Option<&'static str>)> {
    let takes = asked.get(header::ACCEPT_ENCODING).and_then(|value| value.to_str().ok()).unwrap_or_default();
    for (coding, end) in CODINGS {
        if accepts(takes, coding)
            && let Some(file) = page(&format!("{name}{end}"))
        {
            return Some((file, Some(coding)));
        }
    }
    page(name).map(|file| (file, None))
}

/// Whether a list like `gzip, br;q=0.9` takes a coding.
fn accepts(list: &str, coding: &str) -> bool {
    list.split(',').any(|item| {
        let mut parts = item.split(';').map(str::trim);
        let named = parts.next().is_some_and(|name| name.eq_ignore_ascii_case(coding));
        let refused = |part: &str| part.strip_prefix("q=").and_then(|q| q.parse().ok()) == Some(0.0_f32);
        named && !parts.any(refused)
    })
}

fn send(name: &str, file: PageFile, coding: Option<&'static str>, asked: &HeaderMap) -> Response {
    let tag = format!("\"{}\"", URL_SAFE_NO_PAD.encode(&file.hash[..18]));
    let known = asked.get(header::IF_NONE_MATCH).and_then(|value| value.to_str().ok());
    let same = known.is_some_and(|known| known.split(',').any(|one| one.trim().trim_start_matches("W/") == tag));
    let mut response =
        if same { StatusCode::NOT_MODIFIED.into_response() } else { file.data.into_owned().into_response() };
    let headers = response.headers_mut();
    let mut put = |header, value: &str| drop(value.parse().map(|value| headers.insert(header, value)));
    put(header::CONTENT_TYPE, type_of(name));
    put(header::CACHE_CONTROL, "no-cache");
    put(header::VARY, "accept-encoding");
    put(header::ETAG, &tag);
    if let Some(coding) = coding {
        put(header::CONTENT_ENCODING, coding);
    }
    response
}

fn type_of(name: &str) -> &'static str {
    let end = name.rsplit_once('.').map_or("", |(_, end)| end);
    TYPES.iter().find(|(known, _)| *known == end).map_or("application/octet-stream", |(_, kind)| kind)
}

#[cfg(test)]
mod tests {
    use super::{accepts, is_operate, type_of};

    #[test]
    fn the_operators_page_is_there_for_every_robot_and_its_sheet_is_a_file() {
        assert!(is_operate("operate") && is_operate("operate/") && is_operate("operate/robot-1"));
        assert!(!is_operate("operate.css") && !is_operate("operators") && !is_operate(""));
    }

    #[test]
    fn a_coding_counts_unless_it_is_refused() {
        assert!(accepts("gzip, deflate, br", "br") && accepts("br;q=0.5", "br") && accepts("GZIP", "gzip"));
        assert!(!accepts("br;q=0, gzip", "br") && !accepts("", "br") && !accepts("brotli", "br"));
    }

    #[test]
    fn wasm_has_the_type_that_browsers_want() {
        assert_eq!(type_of("app_bg.wasm"), "application/wasm");
        assert_eq!(type_of("what"), "application/octet-stream");
    }
}
