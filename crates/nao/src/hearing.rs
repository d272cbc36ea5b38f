//! Speech recognition is set by whoever listens, and there is one of it: how it was is kept on the robot itself, so that the
//! next connection finds it, whatever became of who listened.

use crate::deed::Call;
use crate::link::try_call;
use qi::{Session, Value};

/// What hears words.
pub(crate) const SERVICE: &str = "ALSpeechRecognition";

/// Where the robot keeps the language that it heard before.
fn key(own_name: &str) -> String {
    format!("{own_name}/hearing")
}

/// Notes how it is before it is set, unless that is noted already.
pub(crate) async fn note(session: &Session, own_name: &str) {
    if kept(session, own_name).await.is_some() {
        return;
    }
    let language = try_call(session, &Call::new(SERVICE, "getLanguage", [])).await;
    if let Some(language) = language.as_ref().and_then(Value::as_text) {
        let kept = [key(own_name).into(), Value::dynamic(language.as_ref())];
        try_call(session, &Call::new("ALMemory", "insertData", kept)).await;
    }
}

/// Puts it back as it was noted, and listening.
pub(crate) async fn put_back(session: &Session, own_name: &str) {
    let Some(language) = kept(session, own_name).await else { return };
    for wanted in [
        // A language is not taken up while it listens.
        Call::new(SERVICE, "pause", [true.into()]),
        Call::new(SERVICE, "setLanguage", [language.into()]),
        Call::new(SERVICE, "pause", [false.into()]),
        // Before it is gone for good: some robots cannot take data away.
        Call::new("ALMemory", "insertData", [key(own_name).into(), Value::dynamic("")]),
        Call::new("ALMemory", "removeData", [key(own_name).into()]),
    ] {
        try_call(session, &wanted).await;
    }
}

async fn kept(session: &Session, own_name: &str) -> Option<String> {
    let value = try_call(session, &Call::new("ALMemory", "getData", [key(own_name).into()])).await?;
    value.as_text().map(|text| text.into_owned()).filter(|text| !text.is_empty())
}
