//! The actions that people have the robot do by hand: a source of commands of its own, above every program, and under
//! the robot's own limits and Stop as they are.

use super::RobotThread;
use crate::robots::command_queue::{ByHand, Handing};
use crate::robots::mailbox::{DoneByHand, Undone};
use crate::robots::refusal::NotByHand;
use behaviour::{FileStream, Id, Params, StreamKind};
use engine::Claim;
use phrase::phrase;
use protocol::BY_HAND;
use robot::{RobotFault, Use};
use std::collections::BTreeMap;

/// The number of no run: that of what is done by hand.
pub(super) const HAND: u64 = 0;

/// The actions that people do by hand.
#[derive(Debug, Default)]
pub(super) struct Hands {
    /// The actions that are open, with their parameters. Bounded by the catalogue.
    open: BTreeMap<Id, Params>,
    /// The name of the person who did something last.
    by: String,
}

impl Hands {
    /// Returns the one who keeps a part of the robot by hand.
    pub(super) fn holder(&self) -> Option<(Id, String)> {
        Some((Id::new(BY_HAND).ok()?, self.by.clone()))
    }
}

impl RobotThread<'_> {
    /// Does what somebody wants by hand, unless Stop was pressed since, and answers with what became of it.
    pub(super) fn by_hand(&mut self, Handing { hand, cancel, answer }: Handing) {
        let done = if cancel.is_cancelled() { Err(NotByHand::StopPressed) } else { self.try_by_hand(&hand) };
        // From now on a Stop ends what the robot does.
        cancel.cancel();
        let why = done.as_ref().err().map(ToString::to_string);
        self.users.values().for_each(|user| user.mailbox.done_by_hand(DoneByHand::of(hand.clone(), why.clone())));
        // A person who gave up waiting does not hear it.
        drop(answer.send(done));
    }

    fn try_by_hand(&mut self, hand: &ByHand) -> Result<(), NotByHand> {
        let device = robot::device(StreamKind::Actuator, &hand.device)?;
        device.check(&hand.params)?;
        let stream = Id::new(device.name).map_err(|_| RobotFault::NoDevice(device.name.to_owned()))?;
        Ok(self.command_by_hand(hand, &stream)?)
    }

    fn command_by_hand(
        &mut self,
        ByHand { device, params, value, by }: &ByHand,
        stream: &Id,
    ) -> Result<(), RobotFault> {
        let user = Use { run: HAND, stream: stream.clone() };
        if self.hands.open.get(stream) != Some(params) {
            // The action with other settings ends first.
            if self.hands.open.remove(stream).is_some() {
                self.robot.close(&user);
            }
            self.robot.open(&user, device, params)?;
            self.hands.open.insert(stream.clone(), params.clone());
        }
        self.hands.by.clone_from(by);
        let claim = claim(stream, device, params);
        // Nobody stands above it.
        let held = self.parts.command(self.now(), &user, &claim, |one, other| one == HAND && other != HAND);
        held.map_err(|held| RobotFault::NotNow(phrase!("server.the_is_held", "the {part} is held", part = held.part)))?;
        self.robot.command(&user, value, self.now())
    }

    /// Tells every run of what was taken by hand and did not come about.
    pub(super) fn refused_by_hand(&self, stream: &Id, fault: &RobotFault) {
        let undone = Undone { stream: stream.clone(), why: fault.to_string(), with: None };
        self.users.values().for_each(|user| user.mailbox.undone(undone.clone()));
    }

    /// Stop was pressed, or the robot halted: nothing that was done by hand goes on or is held.
    pub(super) fn end_by_hand(&mut self) {
        self.parts.let_go(HAND);
        for stream in std::mem::take(&mut self.hands.open).into_keys() {
            self.robot.close(&Use { run: HAND, stream });
        }
    }
}

/// The parts of the robot that an action takes, as if it were a program's.
fn claim(stream: &Id, device: &str, params: &Params) -> Claim {
    Claim::of(&FileStream {
        id: stream.to_string(),
        kind: StreamKind::Actuator,
        name: device.to_owned(),
        device: Some(device.to_owned()),
        params: Some(params.clone()),
        resources: None,
        priority: None,
        hold_ms: None,
    })
}
