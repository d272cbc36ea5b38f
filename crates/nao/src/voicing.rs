//! The voice of the robot: changed by an action, and put back at its end, at a Stop, and after a loss as soon as it is
//! there again, also by a server that was started anew.

use crate::deed::{Manner, ServiceCall};
use crate::kept;
use crate::link::{CALL, call, try_call};
use crate::shared::NaoShared;
use crate::voice_before::{USUAL_SPEED, VoiceBefore};
use qi::{QiError, Session, Value};
use robot::Use;
use std::sync::Arc;
use std::time::Duration;

/// The name under which it is kept on the robot: volume, speed and language of before, each empty if it is not known.
pub(crate) const WHAT: &str = "voice";
/// The changes of the voice, and the use that changed it last.
pub(crate) struct Voicing {
    user: Option<Use>,
    /// The name under which this server keeps things on the robot.
    own_name: String,
    /// One change after the other.
    turn: Arc<tokio::sync::Mutex<()>>,
}

fn voice(method: &'static str, arguments: impl Into<Vec<Value>>) -> ServiceCall {
    ServiceCall::new("ALTextToSpeech", method, arguments)
}

impl Voicing {
    pub(crate) fn new(own_name: &str) -> Self {
        Self { user: None, own_name: own_name.to_owned(), turn: Arc::default() }
    }

    /// Speaks like this from now on, unless a Stop comes between.
    pub(crate) fn set(
        &mut self,
        session: &Session,
        shared: &Arc<NaoShared>,
        stop_generation: u64,
        user: Use,
        manner: Manner,
    ) {
        self.user = Some(user);
        let (session, shared, turn) = (session.clone(), Arc::clone(shared), Arc::clone(&self.turn));
        let own_name = self.own_name.clone();
        tokio::spawn(async move {
            let _alone = turn.lock().await;
            if shared.stop_generation() != stop_generation {
                return;
            }
            note_before(&session, &shared, &own_name, manner.language.is_some()).await;
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
                if shared.stop_generation() != stop_generation {
                    return;
                }
                let _told_in_the_log = try_call(&session, &wanted).await;
            }
        });
    }

    /// A use ends: if it changed the voice last, that is as before.
    pub(crate) fn leave(&mut self, session: &Session, shared: &Arc<NaoShared>, user: &Use) {
        if self.user.as_ref() == Some(user) {
            self.end(session, shared);
        }
    }

    /// The voice is as before.
    pub(crate) fn end(&mut self, session: &Session, shared: &Arc<NaoShared>) {
        if self.user.take().is_some() {
            let (session, shared, turn) = (session.clone(), Arc::clone(shared), Arc::clone(&self.turn));
            let own_name = self.own_name.clone();
            tokio::spawn(async move {
                let _alone = turn.lock().await;
                put_back(&session, &shared, &own_name).await;
            });
        }
    }
}

/// Remembers how it speaks, unless that is remembered: what it was before the first change counts.
async fn note_before(session: &Session, shared: &NaoShared, own_name: &str, with_language: bool) {
    let known = shared.state().voice_before.clone();
    let mut before = match known.clone() {
        Some(known) => known,
        None => {
            let number = async |wanted: ServiceCall| Some(try_call(session, &wanted).await?.as_f64()? as f32);
            let volume = number(voice("getVolume", [])).await;
            VoiceBefore { volume, speed: number(voice("getParameter", ["speed".into()])).await, language: None }
        }
    };
    if with_language && before.language.is_none() {
        let language = try_call(session, &voice("getLanguage", [])).await;
        before.language = language.and_then(|language| Some(language.as_text()?.into_owned()));
    }
    if known.as_ref() != Some(&before) {
        kept::keep(session, own_name, WHAT, before.value()).await;
    }
    shared.state().voice_before = Some(before);
}

/// Speaks as before it was changed, if it was.
pub(crate) async fn put_back(session: &Session, shared: &NaoShared, own_name: &str) {
    let before = {
        let mut state = shared.state();
        (state.gestures, state.voice_speed) = (false, USUAL_SPEED);
        state.voice_before.clone()
    };
    let Some(before) = before else { return };
    if restore(session, own_name, before).await {
        shared.state().voice_before = None;
    }
}

/// Speaks as before it was changed by who could not put it back.
pub(crate) async fn put_back_left(session: &Session, own_name: &str) {
    if let Some(before) = kept::kept(session, own_name, WHAT).await {
        restore(session, own_name, VoiceBefore::of(&before)).await;
    }
}

/// False if the link is over: then it is done when the robot is there again.
async fn restore(session: &Session, own_name: &str, before: VoiceBefore) -> bool {
    let VoiceBefore { volume, speed, language } = before;
    let language = language.map(|language| voice("setLanguage", [language.as_str().into()]));
    let speed = speed.map(|speed| voice("setParameter", ["speed".into(), speed.into()]));
    let volume = volume.map(|volume| voice("setVolume", [volume.into()]));
    for wanted in [language, speed, volume].into_iter().flatten() {
        if let Err(QiError::Disconnected(_)) = call(session, &wanted, CALL).await {
            return false;
        }
    }
    kept::forget(session, own_name, WHAT).await;
    true
}

/// Says a text, with gestures if that is wanted and the robot can.
pub(crate) async fn say(session: &Session, shared: &NaoShared, text: &str, within: Duration) -> Result<Value, QiError> {
    if shared.state().gestures {
        let animated = ServiceCall::new("ALAnimatedSpeech", "say", [text.into()]);
        match call(session, &animated, within).await {
            Err(QiError::NoService { .. } | QiError::NoMethod { .. }) => {}
            done => return done,
        }
    }
    call(session, &voice("say", [text.into()]), within).await
}
