//! The page of an invitation's link, and the one that strangers see. A link only opens a page with a button, so that who
//! looks at links before people do (a messenger, a scanner) does not use it up; its token stands behind the `#`, which
//! browsers send to nobody, and comes in the body of what the button sends.

use super::door::Came;
use crate::invitations::{Entry, NotIn};
use axum::extract::{Form, FromRequest, Request};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;
use std::sync::Arc;

const PAGE: &str = include_str!("come_in/page.html");
const STYLE: &str = include_str!("come_in/page.css");
const SCRIPT: &str = include_str!("come_in/page.js");

/// What stands on it.
struct Words {
    title: &'static str,
    text: String,
    /// Whether there is a button to come in by.
    button: bool,
}

/// What its button sends.
#[derive(Deserialize)]
struct Sent {
    token: String,
}

/// For who follows a link.
pub(super) fn page() -> Response {
    let text = "Somebody invites you to build robot behaviours together, or to watch what a robot does.";
    show(StatusCode::OK, Words { title: "You are invited", text: text.to_owned(), button: true })
}

/// For who was not invited.
pub(super) fn ask_for_one() -> Response {
    let text = "Ask the person at the robot’s computer for an invitation: a link to open here, or its QR code to scan.";
    show(StatusCode::UNAUTHORIZED, Words { title: "By invitation only", text: text.to_owned(), button: false })
}

/// How it looks.
pub(super) fn style() -> Response {
    ([(header::CONTENT_TYPE, "text/css; charset=utf-8")], STYLE).into_response()
}

/// What it does.
pub(super) fn script() -> Response {
    ([(header::CONTENT_TYPE, "text/javascript; charset=utf-8")], SCRIPT).into_response()
}

/// Exchanges the token that was sent for a cookie: always a new one, whatever cookie came along.
pub(super) async fn come_in(came: Came, entry: &Entry, request: Request) -> Response {
    let Some(invitations) = came.door.invitations().map(Arc::clone) else {
        debug_assert!(matches!(entry, Entry::Local));
        return Redirect::to("/").into_response();
    };
    let source = came.source(request.headers());
    let Ok(Form(Sent { token })) = Form::<Sent>::from_request(request, &()).await else {
        return no(&NotIn::Unknown);
    };
    let exchanged = tokio::task::spawn_blocking(move || invitations.come_in(&token, source)).await;
    let exchanged = exchanged.unwrap_or_else(|error| Err(NotIn::NotKept(error.to_string())));
    match exchanged {
        Ok(secret) => {
            let mut response = Redirect::to("/").into_response();
            let cookie = came.door.give(&secret).and_then(|cookie| HeaderValue::from_str(&cookie).ok());
            cookie.into_iter().for_each(|cookie| drop(response.headers_mut().insert(header::SET_COOKIE, cookie)));
            response
        }
        Err(why) => no(&why),
    }
}

fn no(why: &NotIn) -> Response {
    let status = match why {
        NotIn::Unknown => StatusCode::FORBIDDEN,
        NotIn::TooMany(_) => StatusCode::TOO_MANY_REQUESTS,
        NotIn::NotKept(_) => StatusCode::SERVICE_UNAVAILABLE,
    };
    let mut response = show(status, Words { title: "You are not in yet", text: why.to_string(), button: false });
    if let NotIn::TooMany(seconds) = why {
        response.headers_mut().insert(header::RETRY_AFTER, HeaderValue::from(*seconds));
    }
    response
}

fn show(status: StatusCode, words: Words) -> Response {
    let Words { title, text, button } = words;
    let hidden = if button { "" } else { "hidden" };
    let page = PAGE.replace("{title}", title).replace("{text}", &escaped(&text)).replace("{hidden}", hidden);
    let headers = [(header::CONTENT_TYPE, "text/html; charset=utf-8"), (header::CACHE_CONTROL, "no-store")];
    (status, headers, page).into_response()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
