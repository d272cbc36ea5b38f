//! The robot and its room as a recording has them: told when they are new, at most once a second.

use super::runner::RunJob;
use crate::recordings::Recorder;
use protocol::RobotState;
use recording::RobotLine;
use robot::{Body, Health, Scene};

/// The time between two looks at them, in milliseconds.
const LOOK_MS: u64 = 1_000;

/// The robot and its room as they were recorded last.
#[derive(Debug, Default)]
pub(super) struct RecordedSurroundings {
    robot: Option<RobotLine>,
    room: Scene,
    /// The logical time of the next look, in milliseconds; none before the first.
    next_ms: Option<u64>,
}

impl RecordedSurroundings {
    /// Returns the logical time of the next look, in milliseconds; none before the first.
    pub(super) fn next_ms(&self) -> Option<u64> {
        self.next_ms
    }

    /// Records what is new by now.
    pub(super) fn look(&mut self, job: &RunJob, at_ms: u64, recorder: &mut Recorder) {
        if self.next_ms.is_some_and(|next_ms| at_ms < next_ms) {
            return;
        }
        self.next_ms = Some(at_ms + LOOK_MS);
        if let Some(line) = line(job)
            && self.robot.as_ref() != Some(&line)
        {
            recorder.robot(RobotLine { at_ms, ..line.clone() });
            self.robot = Some(line);
        }
        let room = room(&job.shared.scene.borrow());
        if room != self.room {
            recorder.room(at_ms, room.clone());
            self.room = room;
        }
    }

    /// Records that the robot interrupted what ran.
    pub(super) fn halt(&mut self, job: &RunJob, why: &str, at_ms: u64, recorder: &mut Recorder) {
        let line = line(job).unwrap_or_default();
        recorder.robot(RobotLine { at_ms, halt: Some(why.to_owned()), ..line });
    }
}

fn line(job: &RunJob) -> Option<RobotLine> {
    let RobotState { health, condition, .. } = job.shared.feed.state(&job.shared.robot)?;
    let (link, why) = match health {
        Health::Connecting => ("connecting", None),
        Health::Ready | Health::Safe => ("ready", None),
        Health::Degraded(why) => ("degraded", Some(why)),
        Health::Lost(why) => ("lost", Some(why)),
        Health::Stranger(_) => ("stranger", None),
    };
    let why = why.map(|why| why.to_string());
    Some(RobotLine { link: link.to_owned(), why, condition, ..RobotLine::default() })
}

/// Returns what stands in a room. Of the robot only its place counts: its actions tell what it does.
fn room(scene: &Scene) -> Scene {
    let body = Body { base: scene.body.base, ..Body::default() };
    Scene { at_ms: 0, body, ..scene.clone() }
}
