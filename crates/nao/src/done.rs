//! The news of what ended or was seen, for whoever does what actions want.

use robot::{RobotFault, TrackTarget};

/// A kind of which only the newest counts.
pub(crate) type Slot = &'static str;

/// An action that came to its end, or a target that was seen.
pub(crate) enum Done {
    Slot(Slot),
    Said,
    /// With its number, and why it did not come about, if it did not.
    Lasted(String, u64, Option<RobotFault>),
    /// There is a new picture of what is followed.
    Seen(TrackTarget),
}
