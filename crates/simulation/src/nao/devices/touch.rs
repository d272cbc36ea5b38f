//! Touch: fields on the head and the hands, and what every field and bumper feels. Told in the step after it happens,
//! when the first of the wanted fields is touched and, if wanted, when the last is let go.

use super::{Beat, DeviceParams, Sense, SimulatedDevice, SimulatedDriver};
use crate::hash::RunningHash;
use crate::nao::SimulatedNao;
use behaviour::Value;
use robot::Touchable;

pub(super) const HEAD: SimulatedDriver = SimulatedDriver { name: "HeadTouch", open: head };
pub(super) const HAND: SimulatedDriver = SimulatedDriver { name: "HandTouch", open: hand };

/// The most times that somebody may touch or let go of one part between two steps; more are left out in pairs.
const TOUCHES_MAX: u8 = 16;
const PARTS: usize = Touchable::ALL.len();

/// The feelings of all parts.
#[derive(Default)]
pub(crate) struct Pads {
    pads: [TouchPad; PARTS],
}

/// The feelings of one part.
#[derive(Clone, Copy, Default)]
struct TouchPad {
    /// True if a hand is there, as people know it.
    hand: bool,
    /// The number of times that the hand came or left and that is not yet felt.
    waiting: u8,
    /// True if it is felt: now, and in the step before.
    felt: [bool; 2],
}

impl Pads {
    /// A hand comes or leaves.
    pub(crate) fn touch(&mut self, part: Touchable, down: bool) {
        let pad = &mut self.pads[part as usize];
        if pad.hand != down {
            pad.hand = down;
            pad.waiting = if pad.waiting < TOUCHES_MAX { pad.waiting + 1 } else { pad.waiting - 1 };
        }
    }

    /// All hands leave.
    pub(crate) fn let_go(&mut self) {
        Touchable::ALL.iter().for_each(|part| self.touch(*part, false));
    }

    /// One step: a hand that came or left is felt, or what meets the left and the right bumper.
    pub(crate) fn step(&mut self, bumped: [bool; 2]) {
        for pad in &mut self.pads {
            pad.waiting = pad.waiting.saturating_sub(1);
            let hand = pad.hand != (pad.waiting % 2 == 1);
            pad.felt = [hand, pad.felt[0]];
        }
        for (bumper, bumped) in [Touchable::BumperLeft, Touchable::BumperRight].into_iter().zip(bumped) {
            self.pads[bumper as usize].felt[0] |= bumped;
        }
    }

    /// Where it is touched or pressed now.
    pub(crate) fn touched(&self) -> Vec<Touchable> {
        let felt = Touchable::ALL.iter().zip(&self.pads).filter(|(_, pad)| pad.felt[0] || pad.hand);
        felt.map(|(part, _)| *part).collect()
    }

    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        for pad in &self.pads {
            digest.truth(pad.hand);
            digest.whole(u64::from(pad.waiting));
            pad.felt.iter().for_each(|felt| digest.truth(*felt));
        }
    }
}

/// A sense of some parts together.
#[derive(Debug)]
pub(super) struct Touch {
    parts: Vec<Touchable>,
    /// True if it also tells when they are let go.
    release: bool,
}

impl Touch {
    /// Those of `all` that were chosen: of each, the words of its choices that must be `any` or its own.
    pub(super) fn of(chosen: &DeviceParams, all: &[(Touchable, &[(&str, &str)])]) -> Option<SimulatedDevice> {
        let fits = |(param, own): &(&str, &str)| chosen.is(param, "any") || chosen.is(param, own);
        let parts = all.iter().filter(|(_, words)| words.iter().all(fits)).map(|(part, _)| *part).collect();
        SimulatedDevice::sense(Self { parts, release: chosen.is("release", "yes") })
    }
}

impl Sense for Touch {
    fn beat(&self) -> Beat {
        Beat::Step
    }

    fn read(&mut self, nao: &mut SimulatedNao, _count: u64) -> Option<Value> {
        let [now, before] = [0, 1].map(|when| self.parts.iter().any(|part| nao.pads.pads[*part as usize].felt[when]));
        (now != before && (now || self.release)).then_some(Value::Bool(now))
    }
}

fn head(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    let parts: [(Touchable, &[(&str, &str)]); 3] = [
        (Touchable::HeadFront, &[("part", "front")]),
        (Touchable::HeadMiddle, &[("part", "middle")]),
        (Touchable::HeadRear, &[("part", "rear")]),
    ];
    Touch::of(chosen, &parts)
}

fn hand(chosen: &DeviceParams) -> Option<SimulatedDevice> {
    let parts: [(Touchable, &[(&str, &str)]); 6] = [
        (Touchable::HandLeftBack, &[("hand", "left"), ("part", "back")]),
        (Touchable::HandLeftLeft, &[("hand", "left"), ("part", "left")]),
        (Touchable::HandLeftRight, &[("hand", "left"), ("part", "right")]),
        (Touchable::HandRightBack, &[("hand", "right"), ("part", "back")]),
        (Touchable::HandRightLeft, &[("hand", "right"), ("part", "left")]),
        (Touchable::HandRightRight, &[("hand", "right"), ("part", "right")]),
    ];
    Touch::of(chosen, &parts)
}
