//! The lines of a backup, and the sum at its end that tells whether it is whole.

use super::{BACKUP_FORMAT, BackedUpBehaviour, BackedUpRobot, BackupError, BackupFlaw, Counted};
use behaviour::{Checkpoint, Checkpoints, Committed, Id, Refusal, check_person};
use serde::{Deserialize, Serialize};
use std::io::BufRead;

/// The longest line, in bytes: a change of the most edits with the longest bodies.
const LINE_MAX_BYTES: u64 = 256 << 20;
/// The most starts that a server can have had.
const EPOCH_MAX: u64 = 1 << 53;
/// Robots in one backup.
const ROBOTS_MAX: usize = 64;

/// One line.
#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) enum BackupLine {
    /// The first one.
    Start { format: String, epoch: u64 },
    /// A robot with its order; all of them come before the first behaviour.
    Robot(BackedUpRobot),
    /// A behaviour; its changes follow.
    Behaviour { id: Id, revision: u64, removed: Option<Removed> },
    /// The next change of it.
    Change(Committed),
    /// A revision of it that has a name; all of them come after its changes.
    Named(Checkpoint),
    /// The last one.
    End { behaviours: u64, changes: u64, sum: String },
}

/// The time when a behaviour went to the bin, and the person who put it there.
#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Removed {
    at_ms: u64,
    by: String,
}

impl BackupLine {
    pub(super) fn of(shelf: &BackedUpBehaviour) -> Self {
        let removed = shelf.removed.clone().map(|(at_ms, by)| Removed { at_ms, by });
        Self::Behaviour { id: shelf.id.clone(), revision: shelf.revision, removed }
    }
}

/// FNV-1a over all bytes so far: no secret, but no accident passes it either.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sum(u64);

impl Default for Sum {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Sum {
    fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// A line as it is written, with its end.
    pub(super) fn line(&mut self, line: &BackupLine) -> String {
        let text = serde_json::to_string(line).unwrap_or_default() + "\n";
        self.add(text.as_bytes());
        text
    }

    pub(super) fn end(mut self, done: Counted) -> String {
        let Counted { behaviours, changes } = done;
        let sum = format!("{:016x}", self.0);
        self.line(&BackupLine::End { behaviours, changes, sum })
    }
}

/// The receiver of a backup's content, one thing after the other, checked as it comes.
pub(super) trait BackupListener {
    /// A behaviour begins.
    fn behaviour(&mut self, shelf: BackedUpBehaviour) -> Result<(), BackupError>;
    /// Takes the next change of the behaviour.
    fn change(&mut self, change: Committed) -> Result<(), BackupError>;
    /// A named version of it, after all changes.
    fn named(&mut self, checkpoint: Checkpoint);
}

/// The content of a backup besides its behaviours.
#[derive(Clone, Debug, Default)]
pub(super) struct BackupRest {
    /// The number of times that the server had started.
    pub(super) epoch: u64,
    /// The robots.
    pub(super) robots: Vec<BackedUpRobot>,
    /// The numbers of behaviours and changes in it.
    pub(super) counted: Counted,
    /// The sum over all of it.
    pub(super) sum: String,
}

/// Reads a whole backup and tells the listener; answers with all the rest. An error may come after much was told: who
/// must know first whether it is whole reads it twice.
pub(super) fn read(from: &mut dyn BufRead, to: &mut dyn BackupListener) -> Result<BackupRest, BackupError> {
    let mut reading = BackupReading { from, number: 0, sum: Sum::default() };
    let epoch = match reading.next()? {
        (_, BackupLine::Start { format, epoch }) if format == BACKUP_FORMAT && epoch <= EPOCH_MAX => epoch,
        (_, BackupLine::Start { format, .. }) if format == BACKUP_FORMAT => {
            return reading.broken(BackupFlaw::Starts);
        }
        _ => return reading.broken(BackupFlaw::NoBackup),
    };
    let (mut robots, mut done, mut left) = (Vec::new(), Counted::default(), 0..0_u64);
    let mut names = Checkpoints::default();
    loop {
        let (sum_before, line) = reading.next()?;
        match line {
            BackupLine::Robot(robot) if done.behaviours == 0 && robots.len() < ROBOTS_MAX => robots.push(robot),
            BackupLine::Behaviour { id, revision, removed } if left.is_empty() && revision > 0 => {
                done.behaviours += 1;
                (left, names) = (0..revision, Checkpoints::default());
                let removed = removed.map(|removed| (removed.at_ms, removed.by));
                reading.placed(to.behaviour(BackedUpBehaviour { id, revision, removed }))?;
            }
            BackupLine::Change(change) if left.next().is_some_and(|before| change.revision == before + 1) => {
                done.changes += 1;
                reading.placed(to.change(change))?;
            }
            BackupLine::Named(checkpoint) if left.is_empty() && done.behaviours > 0 => {
                reading.placed(check_name(&mut names, left.end, &checkpoint))?;
                to.named(checkpoint);
            }
            BackupLine::End { behaviours, changes, sum } if left.is_empty() => {
                if (Counted { behaviours, changes }) != done || sum != format!("{:016x}", sum_before.0) {
                    return reading.broken(BackupFlaw::Changed);
                }
                return reading.nothing_more().map(|()| BackupRest { epoch, robots, counted: done, sum });
            }
            _ => return reading.broken(BackupFlaw::Order),
        }
    }
}

/// A version is named as a room would have named it.
fn check_name(names: &mut Checkpoints, newest: u64, checkpoint: &Checkpoint) -> Result<(), BackupError> {
    let broken = |refusal| BackupError::Broken(0, BackupFlaw::Named(refusal));
    check_person(&checkpoint.by).map_err(broken)?;
    crate::json::check_time(checkpoint.at_ms).map_err(|_| BackupError::Broken(0, BackupFlaw::Time))?;
    match names.add(newest, checkpoint.clone()) {
        Ok(made) if made == *checkpoint && made.revision > 0 => Ok(()),
        Ok(made) => Err(broken(Refusal::Name(made.name))),
        Err(refusal) => Err(broken(refusal)),
    }
}

struct BackupReading<'r> {
    from: &'r mut dyn BufRead,
    number: u64,
    sum: Sum,
}

impl BackupReading<'_> {
    fn broken<T>(&self, flaw: BackupFlaw) -> Result<T, BackupError> {
        Err(BackupError::Broken(self.number, flaw))
    }

    /// Places what the listener found wrong in this line.
    fn placed(&self, told: Result<(), BackupError>) -> Result<(), BackupError> {
        told.map_err(|error| match error {
            BackupError::Broken(_, flaw) => BackupError::Broken(self.number, flaw),
            other => other,
        })
    }

    /// The next line, with the sum of all before it.
    fn next(&mut self) -> Result<(Sum, BackupLine), BackupError> {
        let mut bytes = Vec::new();
        std::io::Read::take(&mut *self.from, LINE_MAX_BYTES).read_until(b'\n', &mut bytes)?;
        self.number += 1;
        if bytes.last() != Some(&b'\n') {
            return self.broken(BackupFlaw::CutOff);
        }
        let before = self.sum;
        self.sum.add(&bytes);
        match serde_json::from_slice(&bytes) {
            Ok(line) => Ok((before, line)),
            Err(error) => self.broken(BackupFlaw::Unreadable(error)),
        }
    }

    fn nothing_more(&mut self) -> Result<(), BackupError> {
        if self.from.fill_buf()?.is_empty() {
            return Ok(());
        }
        self.number += 1;
        self.broken(BackupFlaw::AfterEnd)
    }
}
