//! The work of the trackers: who asked to follow what, with which part of the body, and until when.

use crate::hash::{RunningHash, digest_use};
use crate::model::ArmSide;
use robot::{TrackMode, TrackTarget, Use};

/// A tracker follows for so long after a value, in milliseconds.
pub(crate) const HOLD_MS: u64 = 1_000;

/// With which arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effector {
    None,
    Arm(ArmSide),
    Nearest,
    Value,
}

/// The camera's pictures, thirty a second, counted from a moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct CameraPictures {
    from: u64,
    taken: u64,
}

/// The head, and perhaps the legs, following something.
#[derive(Clone, Debug)]
pub(crate) struct FollowingBody {
    pub(crate) user: Use,
    pub(crate) target: TrackTarget,
    pub(crate) mode: TrackMode,
    pub(crate) until: u64,
    pub(crate) pictures: CameraPictures,
    /// True if the whole body is turning.
    pub(crate) turning: bool,
}

/// An arm pointing at something. Without a side it takes the nearest once it sees the target.
#[derive(Clone, Debug)]
pub(crate) struct PointingArm {
    pub(crate) user: Use,
    pub(crate) target: TrackTarget,
    pub(crate) wish: Option<ArmSide>,
    /// The arm that points now.
    pub(crate) side: Option<ArmSide>,
    pub(crate) until: u64,
    pub(crate) pictures: CameraPictures,
}

impl CameraPictures {
    /// The first one a thirtieth of a second after `from`.
    pub(crate) fn from(from: u64) -> Self {
        Self { from, taken: 0 }
    }

    /// Takes a picture if one is due; true if it is.
    pub(crate) fn due(&mut self, now: u64) -> bool {
        let due = self.from + (self.taken + 1) * 1_000 / 30 <= now;
        self.taken += u64::from(due);
        due
    }

    fn digest(self, digest: &mut RunningHash) {
        digest.whole(self.from);
        digest.whole(self.taken);
    }
}

impl FollowingBody {
    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest_use(&self.user, digest);
        digest.text(self.mode.words());
        digest.text(self.target.words());
        digest.whole(self.until);
        digest.truth(self.turning);
        self.pictures.digest(digest);
    }

    /// Returns what it does, in words.
    pub(crate) fn words(&self) -> String {
        format!("{} with {}", self.target.words(), self.mode.words())
    }
}

impl PointingArm {
    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest_use(&self.user, digest);
        digest.text(self.wish.map_or("", ArmSide::word));
        digest.text(&self.words());
        digest.whole(self.until);
        self.pictures.digest(digest);
    }

    /// Returns what it does, in words.
    pub(crate) fn words(&self) -> String {
        format!("{} with {} arm", self.target.words(), self.side.or(self.wish).map_or("nearest", ArmSide::word))
    }
}
