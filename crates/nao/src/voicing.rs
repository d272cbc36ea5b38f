//! How the robot speaks: changed by an action, and put back at its end, at a Stop, and after a loss as soon as it is there
//! again.

use crate::deed::Call;
use crate::link::{CALL, call, try_call};
use crate::shared::Shared;
use qi::{QiError, Session, Value};
use robot::Use;
use std::sync::Arc;
use std::time::Duration;

/// The speed of a voice that nobody changed, in percent.
pub(crate) const USUAL_SPEED: f32 = 100.0;

/// How to speak.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Manner {
    /// From 0 to 1.
    pub(crate) volume: f32,
    /// In percent of the usual speed.
    pub(crate) speed: f32,
    /// Whether it moves its arms meanwhile.
    pub(crate) gestures: bool,
    /// By its English name; none leaves it.
    pub(crate) language: Option<String>,
}

/// How the robot spoke before.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Before {
    volume: Option<f32>,
    speed: Option<f32>,
    /// Only if it was changed.
    language: Option<String>,
}

/// Who changed the voice last.
#[derive(Default)]
pub(crate) struct Voicing {
    user: Option<Use>,
    /// One change after the other.
    turn: Arc<tokio::sync::Mutex<()>>,
}

fn voice(method: &'static str, arguments: impl Into<Vec<Value>>) -> Call {
    Call::new("ALTextToSpeech", method, arguments)
}

impl Voicing {
    /// Speaks like this from now on, unless a Stop comes between.
    pub(crate) fn set(&mut self, session: &Session, shared: &Arc<Shared>, gate: u64, user: Use, manner: Manner) {
        self.user = Some(user);
        let (session, shared, turn) = (session.clone(), Arc::clone(shared), Arc::clone(&self.turn));
        tokio::spawn(async move {
            let _alone = turn.lock().await;
            if shared.gate() != gate {
                return;
            }
            note_before(&session, &shared, manner.language.is_some()).await;
            {
                let mut state = shared.state();
                (state.gestures, state.voice_speed) = (manner.gestures, manner.speed);
            }
            // Another language is another voice, with a speed of its own: it comes first.
            let language = manner.language.map(|language| voice("setLanguage", [language.as_str().into()]));
            let rest = [
                voice("setParameter", ["speed".into(), manner.speed.into()]),
                voice("setVolume", [manner.volume.into()]),
            ];
            for wanted in language.into_iter().chain(rest) {
                if shared.gate() != gate {
                    return;
                }
                let _told_in_the_log = try_call(&session, &wanted).await;
            }
        });
    }

    /// A use ends: if it changed the voice last, that is as before.
    pub(crate) fn leave(&mut self, session: &Session, shared: &Arc<Shared>, user: &Use) {
        if self.user.as_ref() == Some(user) {
            self.end(session, shared);
        }
    }

    /// The voice is as before.
    pub(crate) fn end(&mut self, session: &Session, shared: &Arc<Shared>) {
        if self.user.take().is_some() {
            let (session, shared, turn) = (session.clone(), Arc::clone(shared), Arc::clone(&self.turn));
            tokio::spawn(async move {
                let _alone = turn.lock().await;
                put_back(&session, &shared).await;
            });
        }
    }
}

/// Remembers how it speaks, unless that is remembered: what it was before the first change counts.
async fn note_before(session: &Session, shared: &Shared, with_language: bool) {
    let known = shared.state().voice_before.clone();
    let mut before = match known {
        Some(known) => known,
        None => {
            let number = async |wanted: Call| Some(try_call(session, &wanted).await?.as_f64()? as f32);
            let volume = number(voice("getVolume", [])).await;
            Before { volume, speed: number(voice("getParameter", ["speed".into()])).await, language: None }
        }
    };
    if with_language && before.language.is_none() {
        let language = try_call(session, &voice("getLanguage", [])).await;
        before.language = language.and_then(|language| Some(language.as_text()?.into_owned()));
    }
    shared.state().voice_before = Some(before);
}

/// Speaks as before it was changed, if it was.
pub(crate) async fn put_back(session: &Session, shared: &Shared) {
    let before = {
        let mut state = shared.state();
        (state.gestures, state.voice_speed) = (false, USUAL_SPEED);
        state.voice_before.clone()
    };
    let Some(Before { volume, speed, language }) = before else { return };
    let language = language.map(|language| voice("setLanguage", [language.as_str().into()]));
    let speed = speed.map(|speed| voice("setParameter", ["speed".into(), speed.into()]));
    let volume = volume.map(|volume| voice("setVolume", [volume.into()]));
    for wanted in [language, speed, volume].into_iter().flatten() {
        match call(session, &wanted, CALL).await {
            // It is done when the robot is there again.
            Err(QiError::Disconnected(_)) => return,
            done => drop(done),
        }
    }
    shared.state().voice_before = None;
}

/// Says a text, with gestures if that is wanted and the robot can.
pub(crate) async fn say(session: &Session, shared: &Shared, text: &str, within: Duration) -> Result<Value, QiError> {
    if shared.state().gestures {
        let animated = Call::new("ALAnimatedSpeech", "say", [text.into()]);
        match call(session, &animated, within).await {
            Err(QiError::NoService { .. } | QiError::NoMethod { .. }) => {}
            done => return done,
        }
    }
    call(session, &voice("say", [text.into()]), within).await
}
