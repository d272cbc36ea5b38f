//! Speech recognition is set by whoever listens, and there is one of it: how it was is kept on the robot itself, so that the
//! next connection finds it, whatever became of who listened.

use crate::deed::ServiceCall;
use crate::kept;
use crate::link::try_call;
use qi::{Session, Value};

/// The service that hears words.
pub(crate) const SERVICE: &str = "ALSpeechRecognition";

/// The name under which it is kept: the language that it heard before.
pub(crate) const WHAT: &str = "hearing";

/// Notes how it is before it is set, unless that is noted already.
pub(crate) async fn note(session: &Session, own_name: &str) {
    if kept::kept(session, own_name, WHAT).await.is_some() {
        return;
    }
    let language = try_call(session, &ServiceCall::new(SERVICE, "getLanguage", [])).await;
    if let Some(language) = language.as_ref().and_then(Value::as_text) {
        kept::keep(session, own_name, WHAT, language.as_ref().into()).await;
    }
}

/// Puts it back as it was noted, and listening.
pub(crate) async fn put_back(session: &Session, own_name: &str) {
    let Some(language) = kept::kept(session, own_name, WHAT).await else { return };
    let Some(language) = language.as_text() else { return };
    for wanted in [
        // A language is not taken up while it listens.
        ServiceCall::new(SERVICE, "pause", [true.into()]),
        ServiceCall::new(SERVICE, "setLanguage", [language.as_ref().into()]),
        ServiceCall::new(SERVICE, "pause", [false.into()]),
    ] {
        try_call(session, &wanted).await;
    }
    kept::forget(session, own_name, WHAT).await;
}
