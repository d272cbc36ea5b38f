//! Questions that a client may ask about the past of a run. Answers are made on threads of their own, which no run and no Stop waits for.

use super::ClientSession;
use crate::connection::outbox::Outbox;
use crate::state::ServerState;
use crate::support::identity::Sender;
use crate::support::lock;
use crate::support::until::Until;
use behaviour::{BehaviourFile, Helper};
use past::{EditedRun, Hook, Past};
use protocol::{
    EditedProgram, MESSAGE_MAX_BYTES, Message, NotSeen, PastAnswer, PastQuestion, Refused, answer, request,
};
use std::rc::Rc;
use std::sync::{Arc, Mutex};
use tokio_util::sync::CancellationToken;

/// The time that an answer may take once the past is open, in milliseconds.
const ANSWER_MS: u64 = 4_000;
/// The time that a comparison with an edited program may take, in milliseconds.
const COMPARE_MS: u64 = 8_000;
/// The time that is spent after an opening, so that causes are told quickly, in milliseconds.
const TRACE_MS: u64 = 8_000;

/// The bytes that a message has besides an answer, in bytes.
const MESSAGE_REST_BYTES: usize = 256;

/// A question that waits.
struct WaitingQuestion {
    ask: u32,
    of: request::LookBack,
}

/// Questions of one kind, of which only the newest counts. The one that is answered just now is finished: who scrubs without a
/// rest sees something nevertheless.
#[derive(Clone, Default)]
pub(super) struct NewestQuestion(Arc<Mutex<NewestState>>);

#[derive(Default)]
struct NewestState {
    busy: bool,
    waiting: Option<WaitingQuestion>,
}

/// The kinds of questions of one client of which only the newest counts.
#[derive(Default)]
pub(super) struct LookingBack {
    seek: NewestQuestion,
    compare: NewestQuestion,
}

impl NewestQuestion {
    /// Takes a question; answers it at once if none is under way, else later instead of the one that waits.
    fn put(&self, question: WaitingQuestion, outbox: &Outbox) -> Option<WaitingQuestion> {
        let mut newest = lock(&self.0);
        if !newest.busy {
            newest.busy = true;
            return Some(question);
        }
        let older = newest.waiting.replace(question);
        drop(newest);
        older.into_iter().for_each(|older| outbox.no(older.ask, Refused::from(NotSeen::Newer)));
        None
    }

    /// One is answered; returns the next.
    fn next(&self) -> Option<WaitingQuestion> {
        let mut newest = lock(&self.0);
        let next = newest.waiting.take();
        newest.busy = next.is_some();
        next
    }
}

impl ClientSession {
    pub(super) fn look_back(&mut self, ask: u32, of: request::LookBack) {
        if !self.state().recordings.pasts.enter(&self.outbox.person, self.outbox.session, &of.past) {
            return self.outbox.no(ask, Refused::from(NotSeen::TooMany));
        }
        let newest = match &*of.question {
            PastQuestion::Seek { .. } => &self.looking_back.seek,
            PastQuestion::Compare { .. } => &self.looking_back.compare,
            _ => {
                return self.later(ask, of, |state, who, of| answer(state, who.sender, of));
            }
        };
        let Some(first) = newest.put(WaitingQuestion { ask, of }, &self.outbox) else { return };
        let Some(place) = self.budget.begin(1) else {
            newest.next();
            return self.outbox.no(ask, Refused::TooFast);
        };
        let (state, outbox, newest) = (Arc::clone(self.state()), self.outbox.clone(), newest.clone());
        self.state().tasks.spawn(async move {
            let mut next = Some(first);
            while let Some(WaitingQuestion { ask, of }) = next.filter(|_| !outbox.is_gone()) {
                let answered = answer(Arc::clone(&state), outbox.sender(), of).await;
                outbox.say(match answered {
                    Ok(answer) => Message::Answer { ask, answer: answer.into() },
                    Err(no) => Message::No { ask: Some(ask), no },
                });
                next = newest.next();
            }
            drop(place);
        });
    }

    /// This link needs no place any more.
    pub(super) fn looks_back_no_more(&self) {
        self.state().recordings.pasts.leave(self.outbox.session);
    }
}

/// Answers one question.
async fn answer(
    state: Arc<ServerState>,
    sender: Sender,
    request::LookBack { past: of, question }: request::LookBack,
) -> Result<answer::Past, Refused> {
    let edited = edited(&state, &question, &sender).await?;
    let (around, opens) = (Arc::clone(&state), matches!(*question, PastQuestion::Open));
    let made = state.analyses.run(sender.clone(), move |token| {
        let past = around.recordings.look_back(&of, opens, |run| around.robots.live_past(run), token)?;
        let answer = told(&past, &question, edited, &around, token).map_err(Refused::NotSeen)?;
        Ok::<_, Refused>((past, answer))
    });
    let (past, answer) = made.await??;
    if opens {
        trace_later(&state, &past, sender);
    }
    within_a_message(recording::json(&answer)).map(|answer| answer::Past { answer })
}

/// An answer as a text, unless a message has no room for it: there a mark before each quotation mark takes room too.
fn within_a_message(answer: String) -> Result<String, Refused> {
    let marks = answer.bytes().filter(|byte| matches!(byte, b'"' | b'\\')).count();
    let fits = answer.len() + marks + MESSAGE_REST_BYTES <= MESSAGE_MAX_BYTES;
    if fits { Ok(answer) } else { Err(NotSeen::TooMuch.into()) }
}

/// The edited programs of a comparison: the one to compare with if there is one, and the edited one.
type EditedFiles = Option<(Option<BehaviourFile>, BehaviourFile)>;

async fn edited(state: &ServerState, question: &PastQuestion, sender: &Sender) -> Result<EditedFiles, Refused> {
    let PastQuestion::Compare { before, now, .. } = question else { return Ok(None) };
    let before = match before {
        Some(before) => Some(file(state, before, sender).await?),
        None => None,
    };
    Ok(Some((before, file(state, now, sender).await?)))
}

/// A behaviour as it is saved, or was once, with what is not saved yet.
async fn file(state: &ServerState, edited: &EditedProgram, sender: &Sender) -> Result<BehaviourFile, Refused> {
    let mut behaviour = match edited.revision {
        Some(revision) => state.rooms.look_at(&edited.behaviour, revision, sender.clone()).await?,
        None => state.rooms.look(&edited.behaviour).await?.behaviour().clone(),
    };
    if let Some(change) = &edited.change {
        behaviour.apply(change);
    }
    let snapshot = state.rooms.snapshot();
    let mut helpers: Vec<&Helper> = snapshot.helpers();
    let drafted = edited.helper.as_ref().map(|draft| Helper { name: draft.name.clone(), ..draft.helper.clone() });
    if let Some(drafted) = &drafted {
        helpers.iter_mut().filter(|helper| helper.name == drafted.name).for_each(|helper| *helper = drafted);
    }
    Ok(BehaviourFile::of(&behaviour, &helpers))
}

fn told(
    past: &Past,
    question: &PastQuestion,
    edited: EditedFiles,
    state: &ServerState,
    token: &CancellationToken,
) -> Result<PastAnswer, NotSeen> {
    let hook = |ms| -> Hook { Rc::new(Until::after(ms, token).hook()) };
    match (question, edited) {
        (PastQuestion::Compare { from_ms, streams, .. }, Some((before, now))) => {
            let hook = hook(COMPARE_MS);
            let before = before.map(|file| EditedRun::of(file, &hook)).transpose()?;
            let changes = past.compare(before, EditedRun::of(now, &hook)?, *from_ms, streams, &hook)?;
            Ok(PastAnswer::Changes(Box::new(changes)))
        }
        _ => past.answer(question, &*state.knowing, &hook(ANSWER_MS)),
    }
}

/// Prepares causes behind what people wait for, in the share of whoever opened the past.
fn trace_later(state: &Arc<ServerState>, past: &Arc<Past>, sender: Sender) {
    // One that is not kept any more by then needs none.
    let (analyses, past) = (state.analyses.clone(), Arc::downgrade(past));
    state.tasks.spawn(async move {
        let traced = analyses.run(sender, move |token| {
            let hook: Hook = Rc::new(Until::after(TRACE_MS, token).hook());
            past.upgrade().map_or(Ok(()), |past| past.trace(&hook))
        });
        if let Ok(Err(why)) = traced.await {
            tracing::debug!(?why, "causes are told more slowly");
        }
    });
}
