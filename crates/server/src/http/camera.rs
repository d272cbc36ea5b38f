//! The next picture of a robot's camera. Each is asked for by itself, so a slow reader gets fewer and delays nobody, and who
//! may not look any more gets no other one. Nothing is kept, here or in the browser.

use crate::state::ServerState;
use crate::support::shares::ShareLimits;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use behaviour::Id;
use protocol::Refused;

/// Pictures that may be waited for at once.
pub(super) const LOOKS: ShareLimits = ShareLimits { all: 24, guest: 2, host: 12, reserved: 4, still_ms: 0 };

/// The next picture, as JPEG: no content if none comes within two seconds.
pub(super) async fn next(state: &ServerState, robot: &str) -> Response {
    let Some(host) = Id::new(robot).ok().and_then(|robot| state.robots.meant(Some(&robot)).ok()) else {
        return (StatusCode::NOT_FOUND, format!("{}\n", Refused::NoRobot)).into_response();
    };
    let kept_nowhere = (header::CACHE_CONTROL, "no-store");
    match host.camera().await {
        Some(picture) => ([(header::CONTENT_TYPE, "image/jpeg"), kept_nowhere], picture).into_response(),
        None => (StatusCode::NO_CONTENT, [kept_nowhere]).into_response(),
    }
}
