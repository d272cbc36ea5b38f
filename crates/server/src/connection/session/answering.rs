//! Answers requests, by what they wait for. Each way takes the request and asks for its own answer, so that no other
//! one can be given.

use super::ClientSession;
use crate::connection::start::Starter;
use crate::rooms::member::AnswerTo;
use crate::state::ServerState;
use futures_util::future::BoxFuture;
use protocol::{AnyAnswer, Message, Refused, Request};
use std::future::Future;
use std::sync::Arc;

impl ClientSession {
    pub(super) fn state(&self) -> &Arc<ServerState> {
        &self.connections.state
    }

    /// The person who asks.
    pub(super) fn starter(&self) -> Starter {
        Starter { name: self.me.name.clone(), sender: self.sender(), entry: self.entry.clone(), stops: self.stops }
    }

    /// Answers at once.
    pub(super) fn now<R: Request>(
        &mut self,
        ask: u32,
        request: R,
        act: impl FnOnce(&mut Self, R) -> Result<R::Answer, Refused>,
    ) {
        let outcome = act(self, request);
        self.say(ask, outcome.map(Into::into));
    }

    fn say(&self, ask: u32, outcome: Result<AnyAnswer, Refused>) {
        self.outbox.say(match outcome {
            Ok(answer) => Message::Answer { ask, answer },
            Err(no) => Message::No { ask: Some(ask), no },
        });
    }

    /// Does what has to wait by itself, so that Stop can be heard meanwhile.
    pub(super) fn later<R: Request, F: Future<Output = Result<R::Answer, Refused>> + Send + 'static>(
        &self,
        ask: u32,
        request: R,
        work: impl FnOnce(Arc<ServerState>, Starter, R) -> F,
    ) {
        let work = work(Arc::clone(self.state()), self.starter(), request);
        self.later_boxed(ask, Box::pin(async move { work.await.map(Into::into) }));
    }

    fn later_boxed(&self, ask: u32, work: BoxFuture<'static, Result<AnyAnswer, Refused>>) {
        let Some(place) = self.budget.begin(1) else { return self.outbox.no(ask, Refused::TooFast) };
        let outbox = self.outbox.clone();
        self.state().tasks.spawn(async move {
            outbox.say(match work.await {
                Ok(answer) => Message::Answer { ask, answer },
                Err(no) => Message::No { ask: Some(ask), no },
            });
            drop(place);
        });
    }

    /// Reads or writes files, which is done by the threads for that.
    pub(super) fn on_files<R: Request>(
        &self,
        ask: u32,
        request: R,
        work: impl FnOnce(&ServerState, &Starter, R) -> Result<R::Answer, Refused> + Send + 'static,
    ) {
        self.later(ask, request, move |state, who, request| async move {
            let files = state.files.clone();
            files.run(who.sender.clone(), move |_| work(&state, &who, request)).await?
        });
    }

    /// Asks what the store knows of all behaviours, when it is this person's turn.
    pub(super) fn look_up<R: Request, F: Future<Output = Result<R::Answer, Refused>> + Send + 'static>(
        &self,
        ask: u32,
        request: R,
        work: impl FnOnce(Arc<ServerState>, Starter, R) -> F + Send + 'static,
    ) {
        let outbox = self.outbox.clone();
        self.later(ask, request, move |state, who, request| async move {
            let Some(_turn) = Arc::clone(&state).lookups.turn(&who.sender).await else { return Err(Refused::TooFast) };
            // Nobody hears the answer any more.
            if outbox.is_gone() {
                return Err(Refused::TooFast);
            }
            work(state, who, request).await
        });
    }

    /// Returns the way by which a room answers a request, which holds the memory of its message until then.
    pub(super) fn answer<R: Request>(&mut self, ask: u32, _of: &R) -> AnswerTo<R::Answer> {
        let held = self.weight.take().map(|weight| Box::new(weight) as Box<dyn Send + Sync>);
        AnswerTo::Client { to: Arc::new(self.outbox.clone()), ask, held }
    }

    /// Returns the way by which a room answers a request, which takes so many places until then; none if they are taken.
    pub(super) fn placed<R: Request>(&self, ask: u32, places: u32, _of: &R) -> Option<AnswerTo<R::Answer>> {
        let Some(place) = self.budget.begin(places) else {
            self.outbox.no(ask, Refused::TooFast);
            return None;
        };
        Some(AnswerTo::Client { to: Arc::new(self.outbox.clone()), ask, held: Some(Box::new(place)) })
    }
}
