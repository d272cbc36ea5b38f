//! The page of an invitation's link, and the one that strangers see. A link only opens a page with a button, so that who
//! looks at links before people do (a messenger, a scanner) does not use it up; its token stands behind the `#`, which
//! browsers send to nobody, and comes in the body of what the button sends.

mod words;

pub(super) use words::BrowserLanguage;

use super::door::{LetsIn, RequestArrival};
use crate::invitations::{GuessSource, HostAccess, Identified, Invitations, NotIn};
use crate::support::identity::PersonIdentity;
use crate::support::workers::Workers;
use axum::extract::{Form, FromRequest, Request};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Redirect, Response};
use phrase::Phrased;
use protocol::Refused;
use serde::Deserialize;
use std::sync::Arc;

const PAGE: &str = include_str!("join/page.html");
const STYLE: &str = include_str!("join/page.css");
const SCRIPT: &str = include_str!("join/page.js");

/// What its button sends.
#[derive(Deserialize)]
struct Sent {
    token: String,
}

/// For who follows a link.
pub(super) fn page(came: &RequestArrival, language: BrowserLanguage) -> Response {
    match came.door.lets_in() {
        LetsIn::Host(_) => show(
            StatusCode::OK,
            language,
            language.opening(),
            PageButtons { join: Some(EntryMoment::Once), stop: true },
        ),
        LetsIn::Guests(_) => show(
            StatusCode::OK,
            language,
            language.invited(),
            PageButtons { join: Some(EntryMoment::Press), stop: false },
        ),
    }
}

/// For who was not invited.
pub(super) fn ask_for_one(language: BrowserLanguage) -> Response {
    show(StatusCode::UNAUTHORIZED, language, language.by_invitation(), PageButtons::default())
}

/// For who is at this computer, or comes through a tunnel with this port, and shows no secret of it.
pub(super) fn ask_for_link(language: BrowserLanguage, tunnel: Option<u16>) -> Response {
    let [title, text] = language.by_link();
    let text = tunnel.map_or(text, |port| language.by_link_through(port));
    show(StatusCode::UNAUTHORIZED, language, [title, text], PageButtons { join: None, stop: true })
}

/// Says who invites by the link of this token and what for, before it is used; or why it lets nobody in.
pub(super) async fn invitation(came: RequestArrival, request: Request) -> Response {
    let (source, language) = (came.source(request.headers()), BrowserLanguage::of(request.headers()));
    let token = token(request).await;
    let (status, says) = match came.door.lets_in() {
        LetsIn::Host(_) => {
            let [_, says] = language.opening();
            (StatusCode::OK, says)
        }
        LetsIn::Guests(invitations) => match invitations.promise(&token, source) {
            Ok((by, role)) => (StatusCode::OK, language.invites(&by, role)),
            Err(why) => (status_of(&why), language.say(&why)),
        },
    };
    let headers = [(header::CONTENT_TYPE, "text/plain; charset=utf-8"), (header::CACHE_CONTROL, "no-store")];
    (status, headers, says).into_response()
}

async fn token(request: Request) -> String {
    let sent = Form::<Sent>::from_request(request, &()).await;
    sent.map(|Form(Sent { token })| token).unwrap_or_default()
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
pub(super) async fn join(came: RequestArrival, entry: &Identified, files: &Workers, request: Request) -> Response {
    let (source, language) = (came.source(request.headers()), BrowserLanguage::of(request.headers()));
    let token = token(request).await;
    let exchanged = match came.door.lets_in() {
        LetsIn::Host(host) => as_host(host, &token),
        LetsIn::Guests(invitations) => as_guest(Arc::clone(invitations), files, token, source).await,
    };
    match exchanged {
        Ok(secret) => {
            let mut response = Redirect::to("/").into_response();
            let cookie = HeaderValue::from_str(&came.door.give(&secret));
            cookie.into_iter().for_each(|cookie| drop(response.headers_mut().insert(header::SET_COOKIE, cookie)));
            response
        }
        // Who is the host already and presses an old link again.
        Err(_) if matches!(entry, Identified::Host) => Redirect::to("/").into_response(),
        Err(NotIn::Unknown) if matches!(entry, Identified::Unproven) => {
            show(StatusCode::FORBIDDEN, language, language.old_link(), PageButtons { join: None, stop: true })
        }
        Err(why) => no(&why, language),
    }
}

fn as_host(host: &HostAccess, token: &str) -> Result<String, NotIn> {
    host.join(token).ok_or(NotIn::Unknown)
}

async fn as_guest(
    invitations: Arc<Invitations>,
    files: &Workers,
    token: String,
    source: GuessSource,
) -> Result<String, NotIn> {
    let sender = PersonIdentity::Stranger.asks(source.number());
    let exchanged = files.run(sender, move |_| invitations.join(&token, source)).await;
    exchanged.unwrap_or_else(|why| Err(NotIn::NotKept(Refused::from(why).phrase())))
}

fn status_of(why: &NotIn) -> StatusCode {
    match why {
        NotIn::Unknown => StatusCode::FORBIDDEN,
        NotIn::TooMany(_) => StatusCode::TOO_MANY_REQUESTS,
        NotIn::NotKept(_) => StatusCode::SERVICE_UNAVAILABLE,
    }
}

fn no(why: &NotIn, language: BrowserLanguage) -> Response {
    let mut response = show(status_of(why), language, language.not_in(why), PageButtons::default());
    if let NotIn::TooMany(seconds) = why {
        response.headers_mut().insert(header::RETRY_AFTER, HeaderValue::from(*seconds));
    }
    response
}

/// When a link lets somebody in.
#[derive(Clone, Copy, PartialEq, Eq)]
enum EntryMoment {
    /// As the page is there: nobody but its reader looks at the link of a terminal.
    Once,
    /// As its button is pressed.
    Press,
}

/// Which buttons a page has.
#[derive(Clone, Copy, Default)]
struct PageButtons {
    join: Option<EntryMoment>,
    stop: bool,
}

/// The page with this title, text and buttons.
fn show(status: StatusCode, language: BrowserLanguage, [title, text]: [String; 2], shows: PageButtons) -> Response {
    let text = escaped(&text);
    let hidden_unless = |shown: bool| if shown { "" } else { "hidden" };
    let holes = [
        ("{language}", language.code()),
        ("{title}", &title),
        ("{hidden}", hidden_unless(shows.join.is_some())),
        ("{at once}", if shows.join == Some(EntryMoment::Once) { "data-at-once" } else { "" }),
        ("{come in}", &language.join()),
        ("{broken}", &language.broken()),
        ("{needs script}", &language.needs_script()),
        ("{no stop}", hidden_unless(shows.stop)),
        ("{stop}", &language.stop_all()),
        ("{text}", &text),
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
