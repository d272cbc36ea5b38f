//! The requests about robots and recordings. Which robots there are and who wins on them is kept before it counts.

use super::ClientSession;
use crate::connection::start::Starter;
use crate::invitations::AskedOperation;
use crate::robots::{Presser, real};
use crate::state::ServerState;
use protocol::{Refused, answer, request};
use std::sync::Arc;

pub(super) fn place(state: &ServerState, _: &Starter, of: request::Place) -> Result<(), Refused> {
    state.robots.meant(of.robot.as_ref())?.place(&of.behaviour, of.above.as_ref())
}

pub(super) fn add(state: &ServerState, who: &Starter, of: request::AddRobot) -> Result<(), Refused> {
    let is_host = who.entry.may(AskedOperation::LastRobot).is_ok();
    state.robots.add(&of.robot, &of.name, of.real.map(|real| *real), is_host)
}

pub(super) fn rename(state: &ServerState, _: &Starter, of: request::RenameRobot) -> Result<(), Refused> {
    state.robots.rename(&of.robot, &of.name)
}

pub(super) fn reach(state: &ServerState, _: &Starter, of: request::ReachRobot) -> Result<(), Refused> {
    state.robots.reach(&of.robot, *of.real)
}

pub(super) fn accept(state: &ServerState, _: &Starter, of: request::AcceptRobot) -> Result<(), Refused> {
    state.robots.accept(&of.robot, &of.found)
}

pub(super) fn remove(state: &ServerState, who: &Starter, of: request::RemoveRobot) -> Result<(), Refused> {
    if state.robots.is_real(&of.robot) {
        who.entry.may(AskedOperation::RemoveRealRobot)?;
    }
    state.robots.remove(&of.robot)
}

/// Looks whether a robot can be reached.
pub(super) async fn check(
    state: Arc<ServerState>,
    _: Starter,
    of: request::CheckRobot,
) -> Result<answer::RobotChecked, Refused> {
    real::check(&state.robots, &of.real, of.robot.as_ref()).await
}

/// Changes who has a robot.
pub(super) async fn control(state: Arc<ServerState>, who: Starter, of: request::ControlRobot) -> Result<(), Refused> {
    state.robots.meant(Some(&of.robot))?.control(of.control, Presser { by: &who.name, stops: who.stops }).await
}

pub(super) fn record(state: &ServerState, who: &Starter, of: request::Record) -> Result<(), Refused> {
    state.robots.record(&of.behaviour, of.robot.as_ref(), &who.name, &of.session)
}

pub(super) fn recordings(
    state: &ServerState,
    _: &Starter,
    _: request::Recordings,
) -> Result<answer::Recordings, Refused> {
    Ok(answer::Recordings { recordings: state.recordings.list() })
}

pub(super) fn remove_recording(state: &ServerState, _: &Starter, of: request::RemoveRecording) -> Result<(), Refused> {
    state.recordings.remove(&of.file)
}

pub(super) fn marks(state: &ServerState, _: &Starter, of: request::Marks) -> Result<answer::Marks, Refused> {
    let marks = state.recordings.marks(&of.file)?;
    Ok(answer::Marks { file: of.file, marks })
}

pub(super) fn put_mark(state: &ServerState, who: &Starter, of: request::PutMark) -> Result<(), Refused> {
    state.recordings.change_mark(&of.file, *of.mark, &who.name)
}

impl ClientSession {
    /// Stops. Who reads the socket did it already, unless it was hidden in a large message.
    pub(super) fn stop(&mut self, of: request::Stop) -> Result<answer::Stopped, Refused> {
        let robots = &self.state().robots;
        robots.stop_now(of.behaviour.as_ref(), of.robot.as_ref(), &self.me.name);
        Ok(answer::Stopped { stops: robots.newest_stop() })
    }

    pub(super) fn runs(&mut self, _: request::Runs) -> Result<answer::Runs, Refused> {
        let robots = &self.state().robots;
        // First of which Stop they know: what is shown is never older.
        let stops = robots.newest_stop();
        Ok(answer::Runs { runs: robots.runs().borrow().to_vec(), stops })
    }

    pub(super) fn end_recording(&mut self, of: request::EndRecording) -> Result<(), Refused> {
        self.state().robots.end_recording(&of.behaviour, of.robot.as_ref(), &self.me.name)
    }

    pub(super) fn faces(&mut self, of: request::Faces) -> Result<answer::Faces, Refused> {
        Ok(answer::Faces { faces: self.state().robots.meant(Some(&of.robot))?.faces() })
    }
}
