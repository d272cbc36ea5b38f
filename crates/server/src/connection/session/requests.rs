//! The requests of a client, one arm each. Nothing here waits: what has to wait goes to a room or a task of its own.

use super::{ClientSession, inviting, library, robots};
use crate::connection::clients::tidy_name;
use crate::connection::hints;
use crate::connection::outbox::Out;
use crate::connection::start;
use crate::connection::told;
use crate::invitations::{AskedOperation, Identified};
use crate::robots::real;
use crate::rooms::member::AnswerTo;
use crate::rooms::{BinRequest, JoinRequest, LeaveReason, LockRequest, RoomCommand, Whereabouts};
use behaviour::{Change, Id};
use phrase::phrase;
use protocol::{AnyRequest, Refused, Request, request};

impl ClientSession {
    /// Does what is asked, if whoever asks may: the one way of every request of a socket.
    pub(super) fn request(&mut self, ask: u32, request: AnyRequest) {
        match self.entry.may(AskedOperation::Socket(&request)) {
            Ok(()) => self.allowed(ask, request),
            Err(no) => self.outbox.no(ask, no),
        }
    }

    fn allowed(&mut self, ask: u32, request: AnyRequest) {
        match request {
            AnyRequest::Hello(_) => self
                .outbox
                .no(ask, Refused::Unreadable(phrase!("server.the_greeting_came_already", "the greeting came already"))),
            AnyRequest::List(of) => self.look_up(ask, of, library::list),
            AnyRequest::Pictures(of) => self.look_up(ask, of, library::pictures),
            AnyRequest::WhereUsed(of) => self.look_up(ask, of, library::where_used),
            AnyRequest::Drivers(of) => self.look_up(ask, of, library::drivers),
            AnyRequest::Contested(of) => self.look_up(ask, of, library::contested),
            AnyRequest::Similar(of) => self.look_up(ask, of, library::similar),
            AnyRequest::Tags(of) => self.look_up(ask, of, library::tags),
            AnyRequest::Create(of) => self.later(ask, of, library::create),
            AnyRequest::Remove(of) => self.remove(ask, &of),
            AnyRequest::Restore(of) => self.later(ask, of, library::restore),
            AnyRequest::RenameHelper(of) => self.later(ask, of, library::rename_helper),
            AnyRequest::Open(of) => self.open(ask, of),
            AnyRequest::Leave(of) => self.now(ask, of, Self::leave),
            AnyRequest::Propose(of) => self.propose(ask, of),
            AnyRequest::Since(of) => self.since(ask, &of),
            AnyRequest::TakeBack(of) => self.take_back(ask, of),
            AnyRequest::History(of) => self.history(ask, &of),
            AnyRequest::At(of) => self.at(ask, &of),
            AnyRequest::GoBack(of) => self.go_back(ask, of),
            AnyRequest::BringBack(of) => self.bring_back(ask, of),
            AnyRequest::NameVersion(of) => self.name_version(ask, of),
            AnyRequest::UnnameVersion(of) => self.unname_version(ask, of),
            AnyRequest::Lock(of) => self.lock(ask, of, |of, to| (of.behaviour, LockRequest::Take(of.records, to))),
            AnyRequest::Unlock(of) => self.lock(ask, of, |of, to| (of.behaviour, LockRequest::Release(of.token, to))),
            AnyRequest::Typing(of) => self.lock(ask, of, |of, _| (of.behaviour, LockRequest::Touch(of.token))),
            AnyRequest::AskFor(of) => self.lock(ask, of, |of, to| (of.behaviour, LockRequest::Ask(of.record, to))),
            AnyRequest::TakeOver(of) => {
                self.lock(ask, of, |of, to| (of.behaviour, LockRequest::TakeOver(of.record, to)))
            }
            AnyRequest::Withdraw(of) => {
                self.lock(ask, of, |of, to| (of.behaviour, LockRequest::Withdraw(of.record, to)))
            }
            AnyRequest::HandOver(of) => {
                self.lock(ask, of, |of, to| (of.behaviour, LockRequest::Reply(of.token, of.yes, to)));
            }
            AnyRequest::Check(of) => self.later(ask, of, library::check),
            AnyRequest::Fixes(of) => self.later(ask, of, hints::fixes),
            AnyRequest::Types(of) => self.later(ask, of, hints::types),
            AnyRequest::Told(of) => self.later(ask, of, told::told),
            AnyRequest::TryExercise(of) => self.later(ask, of, hints::try_exercise),
            AnyRequest::Present(of) => self.present(of),
            AnyRequest::PresentMoment(of) => self.present_moment(of),
            AnyRequest::CallMe(of) => self.now(ask, of, Self::call_me),
            AnyRequest::Watch(of) => self.now(ask, of, Self::watch),
            AnyRequest::Start(of) => self.later(ask, of, start::start),
            AnyRequest::Apply(of) => self.later(ask, of, start::apply),
            AnyRequest::Stop(of) => self.now(ask, of, Self::stop),
            AnyRequest::Stimulate(of) => self.now(ask, of, Self::stimulate),
            AnyRequest::Hand(of) => self.hand(ask, of),
            AnyRequest::Mark(of) => self.mark(ask, of),
            AnyRequest::EditMark(of) => self.edit_mark(ask, of),
            AnyRequest::Runs(of) => self.now(ask, of, Self::runs),
            AnyRequest::Place(of) => self.on_files(ask, of, robots::place),
            AnyRequest::Record(of) => self.on_files(ask, of, robots::record),
            AnyRequest::EndRecording(of) => self.now(ask, of, Self::end_recording),
            AnyRequest::Recordings(of) => self.on_files(ask, of, robots::recordings),
            AnyRequest::RemoveRecording(of) => self.on_files(ask, of, robots::remove_recording),
            AnyRequest::Marks(of) => self.on_files(ask, of, robots::marks),
            AnyRequest::PutMark(of) => self.on_files(ask, of, robots::put_mark),
            AnyRequest::LookBack(of) => self.look_back(ask, of),
            AnyRequest::AddRobot(of) => self.on_files(ask, of, robots::add),
            AnyRequest::RenameRobot(of) => self.on_files(ask, of, robots::rename),
            AnyRequest::ReachRobot(of) => self.on_files(ask, of, robots::reach),
            AnyRequest::AcceptRobot(of) => self.on_files(ask, of, robots::accept),
            AnyRequest::RemoveRobot(of) => self.on_files(ask, of, robots::remove),
            AnyRequest::CheckRobot(of) => self.later(ask, of, robots::check),
            AnyRequest::FindRobots(of) => self.later(ask, of, |_, _, _| real::find()),
            AnyRequest::ControlRobot(of) => self.later(ask, of, robots::control),
            AnyRequest::Faces(of) => self.now(ask, of, Self::faces),
            AnyRequest::Scene(of) => self.state().robots.edit_scene(of.robot.as_ref(), of.edit),
            AnyRequest::Invite(of) => self.on_files(ask, of, inviting::invite),
            AnyRequest::Invitations(of) => self.on_files(ask, of, inviting::invitations),
            AnyRequest::Revoke(of) => self.on_files(ask, of, inviting::revoke),
        }
    }

    fn open(&mut self, ask: u32, of: request::Open) {
        let answer = self.answer(ask, &of);
        let behaviour = of.behaviour;
        if behaviour == *self.state().rooms.library() {
            return answer.no(Refused::NoBehaviour);
        }
        self.leave_open(LeaveReason::Chosen);
        self.outbox.put(Out::Want(Some(behaviour.clone())));
        self.state().rooms.tell(&behaviour, RoomCommand::Join(self.member(), JoinRequest::Behaviour(answer)));
        self.open = Some(behaviour);
    }

    fn leave(&mut self, _: request::Leave) -> Result<(), Refused> {
        self.leave_open(LeaveReason::Chosen);
        self.outbox.put(Out::Want(None));
        Ok(())
    }

    pub(super) fn tell_open(&self, note: RoomCommand) {
        if let Some(open) = &self.open {
            self.state().rooms.tell_open(open, note);
        }
    }

    fn present(&self, request::Present { pointer, selected, view }: request::Present) {
        self.tell_open(RoomCommand::Present(self.outbox.session, Whereabouts { pointer, selected, view }));
    }

    /// Gives this person another name; what was done until now keeps the old one.
    fn call_me(&mut self, of: request::CallMe) -> Result<(), Refused> {
        self.me.name = tidy_name(&of.name);
        self.tell_open(RoomCommand::Rename(self.outbox.session, self.me.name.clone()));
        if let Identified::Guest(guest) = &self.entry {
            self.state().invitations.call(guest, &self.me.name);
        }
        Ok(())
    }

    fn watch(&mut self, of: request::Watch) -> Result<(), Refused> {
        self.outbox.put(Out::Watch { robot: of.robot, scene: of.scene, values: of.values });
        Ok(())
    }

    /// Answers with what changed since a revision, one answer of a connection at a time.
    fn since(&self, ask: u32, of: &request::Since) {
        if let Some(answer) = self.placed(ask, 1, of) {
            self.state().rooms.tell(&of.behaviour, RoomCommand::Since(of.revision, answer));
        }
    }

    /// Proposes a change; its author is who sends it, whatever it says.
    fn propose(&mut self, ask: u32, of: request::Propose) {
        let answer = self.answer(ask, &of);
        let request::Propose { behaviour, change, tokens } = of;
        let change = Change { author: self.me.name.clone(), by: Some(self.me.client.clone()), ..change };
        self.state().rooms.tell(&behaviour, RoomCommand::Propose(change, tokens, answer));
    }

    /// Asks something of the locks of a behaviour, which has to be the open one.
    fn lock<R: Request>(&mut self, ask: u32, of: R, wish: impl FnOnce(R, AnswerTo<R::Answer>) -> (Id, LockRequest)) {
        let answer = self.answer(ask, &of);
        let (behaviour, locking) = wish(of, answer);
        if self.open.as_ref() == Some(&behaviour) {
            self.state().rooms.tell(&behaviour, RoomCommand::Locking(self.outbox.session, locking));
        } else {
            locking.refuse(Refused::NothingOpen);
        }
    }

    fn remove(&mut self, ask: u32, of: &request::Remove) {
        let answer = self.answer(ask, of);
        if of.behaviour == *self.state().rooms.library() {
            return answer.no(Refused::NoBehaviour);
        }
        let by = BinRequest { client: self.me.client.clone(), name: self.me.name.clone() };
        self.state().rooms.tell(&of.behaviour, RoomCommand::Remove(by, answer));
    }
}
