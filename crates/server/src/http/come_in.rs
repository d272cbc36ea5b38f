//! The page of an invitation's link, and the one that strangers see. A link only opens a page with a button, so that who
//! looks at links before people do (a messenger, a scanner) does not use it up; its token stands behind the `#`, which
//! browsers send to nobody, and comes in the body of what the button sends.

mod words;

pub(super) use words::Language;

use super::door::Came;
use crate::invitations::{Entry, NotIn};
use crate::support::identity::Identity;
use crate::support::workers::Workers;
use axum::extract::{Form, FromRequest, Request};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Redirect, Response};
use protocol::Refused;
use serde::Deserialize;
use std::sync::Arc;

const PAGE: &str = include_str!("come_in/page.html");
const STYLE: &str = include_str!("come_in/page.css");
const SCRIPT: &str = include_str!("come_in/page.js");

/// What its button sends.
#[derive(Deserialize)]
struct Sent {
    token: String,
}

/// For who follows a link.
pub(super) fn page(language: Language) -> Response {
    let [title, text] = language.invited();
    show(StatusCode::OK, language, [title, text], true)
}

/// For who was not invited.
pub(super) fn ask_for_one(language: Language) -> Response {
    let [title, text] = language.by_invitation();
    show(StatusCode::UNAUTHORIZED, language, [title, text], false)
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
pub(super) async fn come_in(came: Came, entry: &Entry, files: &Workers, request: Request) -> Response {
    let Some(invitations) = came.door.invitations().map(Arc::clone) else {
        debug_assert!(matches!(entry, Entry::Local));
        return Redirect::to("/").into_response();
    };
    let (source, language) = (came.source(request.headers()), Language::of(request.headers()));
    let Ok(Form(Sent { token })) = Form::<Sent>::from_request(request, &()).await else {
        return no(&NotIn::Unknown, language);
    };
    let sender = Identity::Stranger.asks(source.number());
    let exchanged = files.run(sender, move |_| invitations.come_in(&token, source)).await;
    let exchanged = exchanged.unwrap_or_else(|why| Err(NotIn::NotKept(Refused::from(why).to_string())));
    match exchanged {
        Ok(secret) => {
            let mut response = Redirect::to("/").into_response();
            let cookie = came.door.give(&secret).and_then(|cookie| HeaderValue::from_str(&cookie).ok());
            cookie.into_iter().for_each(|cookie| drop(response.headers_mut().insert(header::SET_COOKIE, cookie)));
            response
        }
        Err(why) => no(&why, language),
    }
}

fn no(why: &NotIn, language: Language) -> Response {
    let status = match why {
        NotIn::Unknown => StatusCode::FORBIDDEN,
        NotIn::TooMany(_) => StatusCode::TOO_MANY_REQUESTS,
        NotIn::NotKept(_) => StatusCode::SERVICE_UNAVAILABLE,
    };
    let mut response = show(status, language, [language.not_in(), &language.why(why)], false);
    if let NotIn::TooMany(seconds) = why {
        response.headers_mut().insert(header::RETRY_AFTER, HeaderValue::from(*seconds));
    }
    response
}

/// The page with this title and text, and perhaps with a button to come in by.
fn show(status: StatusCode, language: Language, [title, text]: [&str; 2], button: bool) -> Response {
    let text = escaped(text);
    let holes = [
        ("{language}", language.code()),
        ("{title}", title),
        ("{hidden}", if button { "" } else { "hidden" }),
        ("{come in}", language.come_in()),
        ("{broken}", language.broken()),
        ("{needs script}", language.needs_script()),
        ("{text}", text.as_str()),
    ];
    let page = holes.iter().fold(PAGE.to_owned(), |page, (hole, said)| page.replace(hole, said));
    let headers = [
        (header::CONTENT_TYPE, "text/html; charset=utf-8"),
        (header::CACHE_CONTROL, "no-store"),
        (header::VARY, "accept-language"),
    ];
    (status, headers, page).into_response()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
