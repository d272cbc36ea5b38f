//! What a client may ask, one arm each. Nothing here waits: what has to wait goes to a room or a task of its own.

use super::ClientSession;
use crate::connection::clients::tidy_name;
use crate::connection::hints;
use crate::connection::outbox::Out;
use crate::connection::start::{self, Starter};
use crate::invitations::{AskedOperation, Identified};
use crate::library::create::{self, CreateRequest};
use crate::library::thumbnails::{self, DrawingShare};
use crate::library::trial::{self, ProcedureTrial, helpers_of};
use crate::library::{bin, insight, list, rename};
use crate::robots::real;
use crate::rooms::member::AnswerTo;
use crate::rooms::{BinRequest, LeaveReason, LockRequest, RoomCommand, Whereabouts};
use crate::state::ServerState;
use behaviour::{Change, Helper, Id, LockToken, Value};
use futures_util::future::BoxFuture;
use protocol::{RealRobot, Refused, Reply, Request};
use robot::Control;
use std::future::Future;
use std::sync::Arc;
use tokio_util::sync::CancellationToken;

impl ClientSession {
    /// Does what is asked, if whoever asks may: the one way of every request of a socket.
    pub(super) fn request(&mut self, ask: u32, request: Request) {
        match self.entry.may(AskedOperation::Socket(&request)) {
            Ok(()) => self.allowed(ask, request),
            Err(no) => self.outbox.no(ask, no),
        }
    }

    fn allowed(&mut self, ask: u32, request: Request) {
        match request {
            Request::Hello { .. } => self.outbox.no(ask, Refused::Unreadable("the greeting came already".to_owned())),
            Request::List { .. }
            | Request::Pictures { .. }
            | Request::WhereUsed { .. }
            | Request::Drivers { .. }
            | Request::Contested
            | Request::Similar { .. }
            | Request::Tags => self.look_up(ask, request),
            Request::Create { behaviour, name, template } => self.create(ask, behaviour, name, template),
            Request::Open { behaviour } => self.open(ask, behaviour),
            Request::Leave => self.leave(ask),
            Request::Remove { behaviour } => self.remove(ask, &behaviour),
            Request::Restore { behaviour } => self.restore(ask, behaviour),
            Request::Propose { behaviour, change, tokens } => self.propose(ask, &behaviour, change, tokens),
            Request::RenameHelper { helper, seen, after } => self.rename_helper(ask, helper, *seen, *after),
            Request::TakeBack { .. }
            | Request::History { .. }
            | Request::At { .. }
            | Request::GoBack { .. }
            | Request::BringBack { .. }
            | Request::NameVersion { .. }
            | Request::UnnameVersion { .. } => self.past(ask, request),
            Request::Lock { behaviour, records } => self.locking(ask, &behaviour, |to| LockRequest::Take(records, to)),
            Request::Unlock { behaviour, token } => self.locking(ask, &behaviour, |to| LockRequest::Release(token, to)),
            Request::Typing { behaviour, token } => self.locking(ask, &behaviour, |_| LockRequest::Touch(token)),
            Request::AskFor { behaviour, record } => self.locking(ask, &behaviour, |to| LockRequest::Ask(record, to)),
            Request::TakeOver { behaviour, record } => {
                self.locking(ask, &behaviour, |to| LockRequest::TakeOver(record, to))
            }
            Request::Invite { .. } | Request::Invitations | Request::Revoke { .. } => self.invitations(ask, request),
            Request::Withdraw { behaviour, record } => {
                self.locking(ask, &behaviour, |to| LockRequest::Withdraw(record, to))
            }
            Request::HandOver { behaviour, token, yes } => {
                self.locking(ask, &behaviour, |to| LockRequest::Reply(token, yes, to))
            }
            Request::Since { behaviour, revision } => self.since(ask, &behaviour, revision),
            Request::Check { arguments, body, inputs } => self.check(ask, arguments, body, inputs),
            Request::Fixes { .. } | Request::Types { .. } | Request::TryExercise { .. } => self.hints(ask, request),
            Request::Present { pointer, selected, view } => {
                self.tell_open(RoomCommand::Present(self.outbox.session, Whereabouts { pointer, selected, view }));
            }
            Request::CallMe { name } => self.call_me(ask, &name),
            Request::Start { behaviour, robot, record, session } => {
                let (state, who) = (Arc::clone(self.state()), self.starter());
                let recorded = (record, session);
                self.later(ask, async move { start::start(&state, behaviour, robot, recorded, who).await });
            }
            Request::Apply { behaviour, robot } => {
                let (state, who) = (Arc::clone(self.state()), self.starter());
                self.later(ask, async move { start::apply(&state, behaviour, robot, who).await });
            }
            // Who reads the socket did it already, unless it was hidden in a large message.
            Request::Stop { behaviour, robot } => {
                self.state().robots.stop_now(behaviour.as_ref(), robot.as_ref(), &self.me.name);
                self.outbox.say(Some(ask), Reply::Done);
            }
            Request::Stimulate { .. }
            | Request::Hand { .. }
            | Request::Mark { .. }
            | Request::EditMark { .. }
            | Request::Record { .. }
            | Request::EndRecording { .. }
            | Request::Recordings
            | Request::RemoveRecording { .. }
            | Request::Marks { .. }
            | Request::PutMark { .. } => self.operate(ask, request),
            Request::Runs => self.tell_runs(ask),
            Request::Place { .. }
            | Request::AddRobot { .. }
            | Request::RenameRobot { .. }
            | Request::ReachRobot { .. }
            | Request::AcceptRobot { .. }
            | Request::RemoveRobot { .. } => self.change_robots(ask, request),
            Request::CheckRobot { real, robot } => self.check_robot(ask, *real, robot),
            Request::FindRobots => self.later(ask, real::find()),
            Request::ControlRobot { robot, control } => self.control(ask, &robot, control),
            Request::Faces { robot } => self.faces(ask, &robot),
            Request::Scene { robot, edit } => self.state().robots.edit_scene(robot.as_ref(), edit),
            Request::Watch { robot, scene, values } => {
                self.outbox.put(Out::Watch { robot, scene, values });
                self.outbox.say(Some(ask), Reply::Done);
            }
        }
    }

    /// Answers with what changed since a revision, one answer of a connection at a time.
    fn since(&self, ask: u32, behaviour: &Id, revision: u64) {
        let Some(place) = self.budget.begin(1) else { return self.outbox.no(ask, Refused::TooFast) };
        let answer = AnswerTo::Client { to: Arc::new(self.outbox.clone()), ask, held: Some(Box::new(place)) };
        self.state().rooms.tell(behaviour, RoomCommand::Since(revision, answer));
    }

    pub(super) fn state(&self) -> &Arc<ServerState> {
        &self.connections.state
    }

    fn starter(&self) -> Starter {
        Starter { name: self.me.name.clone(), sender: self.sender(), entry: self.entry.clone() }
    }

    /// Answers what was done at once, or not.
    pub(super) fn done(&self, ask: u32, done: Result<(), Refused>) {
        self.outbox.say(Some(ask), done.map_or_else(|no| Reply::No { no }, |()| Reply::Done));
    }

    pub(super) fn answer(&mut self, ask: u32) -> AnswerTo {
        let held = self.weight.take().map(|weight| Box::new(weight) as Box<dyn Send + Sync>);
        AnswerTo::Client { to: Arc::new(self.outbox.clone()), ask, held }
    }

    /// What has to wait goes on by itself, so that Stop can be heard meanwhile.
    pub(super) fn later(&self, ask: u32, work: impl Future<Output = Result<Reply, Refused>> + Send + 'static) {
        self.later_boxed(ask, Box::pin(work));
    }

    fn later_boxed(&self, ask: u32, work: BoxFuture<'static, Result<Reply, Refused>>) {
        let Some(place) = self.budget.begin(1) else { return self.outbox.no(ask, Refused::TooFast) };
        let outbox = self.outbox.clone();
        self.state().tasks.spawn(async move {
            let reply = work.await.unwrap_or_else(|no| Reply::No { no });
            outbox.say(Some(ask), reply);
            drop(place);
        });
    }

    /// What reads or writes files is done by the threads for that.
    pub(super) fn on_files(&self, ask: u32, work: impl FnOnce() -> Result<Reply, Refused> + Send + 'static) {
        let (files, sender) = (self.state().files.clone(), self.sender());
        self.later(ask, async move { files.run(sender, |_| work()).await? });
    }

    /// What the store knows of all behaviours.
    fn look_up(&self, ask: u32, request: Request) {
        let (state, outbox) = (Arc::clone(self.state()), self.outbox.clone());
        self.later(ask, async move {
            let Some(_turn) = state.lookups.turn(&outbox.sender()).await else { return Err(Refused::TooFast) };
            if outbox.is_gone() {
                return Ok(Reply::Done);
            }
            match request {
                Request::List { query } => list::list(&*state.store, query).await,
                Request::Pictures { of } => {
                    let (store, made, workers) = (&*state.store, &state.thumbnails, &state.workers);
                    thumbnails::pictures(DrawingShare { store, made, workers, sender: outbox.sender() }, of).await
                }
                Request::WhereUsed { helper } => insight::where_used(&*state.store, &helper).await,
                Request::Drivers { actuator } => insight::drivers(&*state.store, &actuator).await,
                Request::Similar { behaviour } => insight::similar(&*state.store, &behaviour).await,
                Request::Tags => list::tags(&*state.store).await,
                _ => insight::contested(&*state.store).await,
            }
        });
    }

    fn tell_runs(&self, ask: u32) {
        let runs = self.state().robots.runs().borrow().to_vec();
        self.outbox.say(Some(ask), Reply::Runs { runs });
    }

    /// Who has a robot.
    fn control(&self, ask: u32, robot: &Id, control: Control) {
        let (host, by) = (self.state().robots.meant(Some(robot)), self.me.name.clone());
        self.later(ask, async move { host?.control(control, &by).await.map(|()| Reply::Done) });
    }

    /// The names under which a robot remembers faces.
    fn faces(&self, ask: u32, robot: &Id) {
        let faces = self.state().robots.meant(Some(robot)).map(|host| Reply::Faces { faces: host.faces() });
        self.outbox.say(Some(ask), faces.unwrap_or_else(|no| Reply::No { no }));
    }

    /// Whether a robot can be reached.
    fn check_robot(&self, ask: u32, real: RealRobot, robot: Option<Id>) {
        let robots = self.state().robots.clone();
        self.later(ask, async move { real::check(&robots, &real, robot.as_ref()).await });
    }

    /// Which robots there are and who wins on them: kept before it counts, which may take its time.
    fn change_robots(&self, ask: u32, request: Request) {
        let robots = self.state().robots.clone();
        let (entry, is_host) = (self.entry.clone(), self.entry.may(AskedOperation::LastRobot).is_ok());
        let work = move || match request {
            Request::AddRobot { robot, name, real } => robots.add(&robot, &name, real.map(|real| *real), is_host),
            Request::RenameRobot { robot, name } => robots.rename(&robot, &name),
            Request::ReachRobot { robot, real } => robots.reach(&robot, *real),
            Request::AcceptRobot { robot, found } => robots.accept(&robot, &found),
            Request::RemoveRobot { robot } if robots.is_real(&robot) => {
                entry.may(AskedOperation::RemoveRealRobot).and_then(|()| robots.remove(&robot))
            }
            Request::RemoveRobot { robot } => robots.remove(&robot),
            Request::Place { behaviour, robot, above } => {
                robots.meant(robot.as_ref())?.place(&behaviour, above.as_ref())
            }
            _ => Ok(()),
        };
        self.on_files(ask, move || work().map(|()| Reply::Done));
    }

    /// Tries a procedure, among the other work.
    fn check(&self, ask: u32, arguments: Vec<String>, body: String, inputs: Vec<Vec<Value>>) {
        let (snapshot, workers) = (self.state().rooms.snapshot(), self.state().workers.clone());
        let sender = self.sender();
        let check = move |_: &CancellationToken| {
            let all = snapshot.helpers();
            let known = all.iter().map(|helper| helper.name.clone()).collect();
            let helpers = helpers_of(&body, &all);
            trial::check(&ProcedureTrial { arguments, body, inputs, helpers, known })
        };
        self.later(ask, async move { Ok(workers.run(sender, check).await?) });
    }

    /// What mends a problem, what streams carry, or whether a goal is reached: among the other work.
    fn hints(&self, ask: u32, request: Request) {
        let (state, sender) = (Arc::clone(self.state()), self.sender());
        self.later(ask, async move {
            match request {
                Request::Fixes { behaviour, problem, seen } => {
                    hints::fixes(&state, sender, &behaviour, (problem, seen)).await
                }
                Request::Types { behaviour, seen } => hints::types(&state, sender, &behaviour, seen).await,
                Request::TryExercise { behaviour, exercise, answers } => {
                    hints::try_exercise(&state, sender, &behaviour, &exercise, answers).await
                }
                _ => Ok(Reply::Done),
            }
        });
    }

    fn create(&self, ask: u32, behaviour: Id, name: String, template: Option<String>) {
        let (state, by) = (Arc::clone(self.state()), self.me.name.clone());
        let wish = CreateRequest { behaviour, name, template, by, sender: self.sender() };
        self.later(ask, async move { create::create(&state.library, wish).await });
    }

    fn rename_helper(&self, ask: u32, helper: Id, seen: Helper, after: Helper) {
        let (state, by) = (Arc::clone(self.state()), self.me.name.clone());
        let wish = rename::RenameRequest { helper, seen, after, by, sender: self.sender() };
        self.later(ask, async move { rename::rename(&state.library, wish).await });
    }

    fn open(&mut self, ask: u32, behaviour: Id) {
        if behaviour == *self.state().rooms.library() {
            return self.outbox.no(ask, Refused::NoBehaviour);
        }
        self.leave_open(LeaveReason::Chosen);
        self.outbox.put(Out::Want(Some(behaviour.clone())));
        self.state().rooms.tell(&behaviour, RoomCommand::Join(self.member(), ask, None));
        self.open = Some(behaviour);
    }

    fn leave(&mut self, ask: u32) {
        self.leave_open(LeaveReason::Chosen);
        self.outbox.put(Out::Want(None));
        self.outbox.say(Some(ask), Reply::Done);
    }

    fn tell_open(&self, note: RoomCommand) {
        if let Some(open) = &self.open {
            self.state().rooms.tell_open(open, note);
        }
    }

    /// What was done until now keeps the old name.
    fn call_me(&mut self, ask: u32, name: &str) {
        self.me.name = tidy_name(name);
        self.tell_open(RoomCommand::Rename(self.outbox.session, self.me.name.clone()));
        if let Identified::Guest(guest) = &self.entry {
            self.state().invitations.call(guest, &self.me.name);
        }
        self.outbox.say(Some(ask), Reply::Done);
    }

    /// The author is who sends it, whatever the change says.
    fn propose(&mut self, ask: u32, behaviour: &Id, change: Change, tokens: Vec<LockToken>) {
        let change = Change { author: self.me.name.clone(), by: Some(self.me.client.clone()), ..change };
        let answer = self.answer(ask);
        self.state().rooms.tell(behaviour, RoomCommand::Propose(change, tokens, answer));
    }

    /// Locks are of the behaviour that is open.
    fn locking(&mut self, ask: u32, behaviour: &Id, wish: impl FnOnce(AnswerTo) -> LockRequest) {
        let locking = wish(self.answer(ask));
        if self.open.as_ref() == Some(behaviour) {
            self.state().rooms.tell(behaviour, RoomCommand::Locking(self.outbox.session, locking));
        } else {
            locking.refuse(Refused::NothingOpen);
        }
    }

    fn remove(&mut self, ask: u32, behaviour: &Id) {
        if *behaviour == *self.state().rooms.library() {
            self.outbox.no(ask, Refused::NoBehaviour);
        } else {
            let by = BinRequest { client: self.me.client.clone(), name: self.me.name.clone() };
            let answer = self.answer(ask);
            self.state().rooms.tell(behaviour, RoomCommand::Remove(by, answer));
        }
    }

    fn restore(&self, ask: u32, behaviour: Id) {
        let state = Arc::clone(self.state());
        self.later(ask, async move { bin::restore(&state.library, &behaviour).await });
    }
}
