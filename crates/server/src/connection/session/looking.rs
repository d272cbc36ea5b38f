//! Questions that a client may ask about the past of a run. Answers are made on threads of their own, which no run and no Stop waits for.

use super::ClientSession;
use crate::connection::outbox::Outbox;
use crate::rooms::RoomCommand;
use crate::state::ServerState;
use crate::support::identity::Sender;
use crate::support::lock;
use crate::support::until::Until;
use behaviour::{BehaviourFile, Helper};
use past::{EditedRun, Hook, Past};
use protocol::{
    EditedProgram, LOOKED_NAME_MAX_BYTES, LookedMoment, MESSAGE_MAX_BYTES, Message, NotSeen, PastAnswer, PastOf,
    PastQuestion, Refused, answer, request,
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
    /// The past of which something was asked last.
    past: Option<PastOf>,
}

impl LookingBack {
    /// Returns a moment as others are told it; none if it is of another past than the one that is asked.
    fn told(&self, at: Option<LookedMoment>) -> Option<LookedMoment> {
        at.filter(|at| self.past.as_ref() == Some(&at.past) && is_short(&at.past))
    }
}

/// True if a past has a name that others can be told.
fn is_short(past: &PastOf) -> bool {
    match past {
        PastOf::Recording(name) => name.len() <= LOOKED_NAME_MAX_BYTES,
        PastOf::Run(_) => true,
    }
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
        if self.looking_back.past.as_ref() != Some(&of.past) {
            self.looking_back.past = Some(of.past.clone());
        }
        let newest = match &*of.question {
            PastQuestion::Seek { .. } => &self.looking_back.seek,
            PastQuestion::Compare { .. } => &self.looking_back.compare,
            _ => {
                let outbox = self.outbox.clone();
                return self.later(ask, of, |state, who, of| async move {
                    while_wanted(&outbox, answer(state, who.sender, of)).await
                });
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
                let answered = while_wanted(&outbox, answer(Arc::clone(&state), outbox.sender(), of)).await;
                outbox.say(match answered {
                    Ok(answer) => Message::Answer { ask, answer: answer.into() },
                    Err(no) => Message::No { ask: Some(ask), no },
                });
                next = newest.next();
            }
            drop(place);
        });
    }

    /// Tells the others at which moment this person looks.
    pub(super) fn present_moment(&self, request::PresentMoment { at }: request::PresentMoment) {
        let at = self.looking_back.told(at);
        self.tell_open(RoomCommand::PresentMoment(self.outbox.session, at));
    }

    /// This link needs no place any more.
    pub(super) fn looks_back_no_more(&self) {
        self.state().recordings.pasts.leave(self.outbox.session);
    }
}

/// Makes an answer for as long as somebody is there to hear it: with the link ends what is under way, also in the middle of
/// reading a recording.
async fn while_wanted<T>(outbox: &Outbox, answer: impl Future<Output = Result<T, Refused>>) -> Result<T, Refused> {
    if outbox.is_gone() {
        return Err(Refused::TooFast);
    }
    tokio::select! {
        biased;
        _ = outbox.close.wait() => Err(Refused::TooFast),
        answered = answer => answered,
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
        Some(before) => Some(file(state, before.clone(), sender).await?),
        None => None,
    };
    Ok(Some((before, file(state, now.clone(), sender).await?)))
}

/// A behaviour as it is saved, or was once, with what is not saved yet.
async fn file(state: &ServerState, edited: EditedProgram, sender: &Sender) -> Result<BehaviourFile, Refused> {
    let EditedProgram { behaviour, revision, change, helper } = edited;
    let (was, now) = match revision {
        Some(revision) => (Some(state.rooms.look_at(&behaviour, revision, sender.clone()).await?), None),
        None => (None, Some(state.rooms.look(&behaviour).await?)),
    };
    let snapshot = state.rooms.snapshot();
    // It is copied and written as a file, which takes long where it is large.
    let write = move |_: &_| {
        let mut behaviour = was.or_else(|| now.map(|now| now.behaviour().clone())).unwrap_or_default();
        change.iter().for_each(|change| behaviour.apply(change));
        let mut helpers: Vec<&Helper> = snapshot.helpers();
        let drafted = helper.map(|draft| Helper { name: draft.name, ..draft.helper });
        if let Some(drafted) = &drafted {
            helpers.iter_mut().filter(|helper| helper.name == drafted.name).for_each(|helper| *helper = drafted);
        }
        BehaviourFile::of(&behaviour, &helpers)
    };
    Ok(state.workers.run(sender.clone(), write).await?)
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

#[cfg(test)]
mod tests {
    use super::while_wanted;
    use crate::connection::close_signal::CloseReason;
    use crate::connection::outbox::{AllWaiting, Outbox};
    use crate::support::identity::PersonIdentity;
    use crate::support::identity::tests::guest;
    use crate::support::workers::Workers;
    use protocol::Refused;
    use std::sync::{Arc, mpsc};

    fn link(session: u64, person: PersonIdentity) -> (Outbox, impl Sized) {
        let (outbox, inbox, _) = Outbox::new(session, Arc::new(person), &AllWaiting::default());
        (outbox, inbox)
    }

    #[tokio::test]
    async fn what_is_asked_on_a_link_that_closes_ends_in_its_middle_and_what_waits_does_not_begin() {
        let analyses = Workers::for_analyses().unwrap();
        let (begun, begins) = tokio::sync::oneshot::channel();
        let (ended, ends) = mpsc::channel();
        let (outbox, _inbox) = link(1, guest("ben", "one"));
        // It never ends by itself.
        let endless = analyses.run(outbox.sender(), move |token| {
            begun.send(()).unwrap();
            while !token.is_cancelled() {
                std::thread::yield_now();
            }
            ended.send("the first").unwrap();
        });
        let first = while_wanted(&outbox, async { Ok(endless.await?) });
        // The same person has one turn at a time, so this one waits behind it.
        let waiting = analyses.run(outbox.sender(), |_| unreachable!("nobody wants it any more"));
        let second = while_wanted(&outbox, async { Ok(waiting.await?) });
        let closes = async {
            begins.await.unwrap();
            outbox.close.with(CloseReason::Left);
        };
        let (first, second, ()) = tokio::join!(first, second, closes);
        assert_eq!((first, second), (Err(Refused::TooFast), Err(Refused::TooFast)));
        assert_eq!(ends.recv(), Ok("the first"));
        // What somebody else of the same invitation asks comes after both.
        let (other, _inbox) = link(2, guest("ben", "two"));
        let made = while_wanted(&other, async { Ok(analyses.run(other.sender(), |_| "done").await?) });
        assert_eq!(made.await, Ok("done"));
    }

    #[tokio::test]
    async fn nothing_is_begun_for_a_link_that_is_gone() {
        let (outbox, inbox) = link(1, PersonIdentity::Host);
        drop(inbox);
        let made = while_wanted(&outbox, async { unreachable!("nobody hears it") });
        assert_eq!(made.await, Err::<(), _>(Refused::TooFast));
    }
}
