//! The thread that writes a recording: takes what the run hands on, and says what got lost.

use super::RECORDING_MAX_BYTES;
use crate::support::lock;
use phrase::{Phrase, Phrased};
use recording::{Line, LineNames};
use std::fs::File;
use std::io::{self, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::Receiver;
use std::sync::{Arc, Mutex};

/// Room for the last lines of a recording that is full, in bytes.
const LAST_LINES_BYTES: u64 = 4_096;

/// Lines on their way.
#[derive(Debug)]
pub(super) struct LineBatch {
    /// What their indices mean.
    pub(super) names: Arc<LineNames>,
    /// Lines that were lost before these.
    pub(super) missed: u64,
    /// The lines.
    pub(super) lines: Vec<Line>,
}

/// How the writing goes, for both sides.
#[derive(Debug, Default)]
pub(super) struct WriteProgress {
    /// Batches that were written, or lost.
    taken: AtomicU64,
    lost: AtomicU64,
    stuck: Mutex<Option<Stuck>>,
}

impl WriteProgress {
    /// How many batches are not on their way any more.
    pub(super) fn taken(&self) -> u64 {
        self.taken.load(Ordering::Acquire)
    }

    /// Lines that are not in the file.
    pub(super) fn lost(&self) -> u64 {
        self.lost.load(Ordering::Relaxed)
    }

    /// So many more are not in the file.
    pub(super) fn lose(&self, lines: u64) {
        self.lost.fetch_add(lines, Ordering::Relaxed);
    }

    /// Why nothing more is written, in words, if so.
    pub(super) fn trouble(&self) -> Option<Phrase> {
        lock(&self.stuck).as_ref().map(Phrased::phrase)
    }

    fn is_stuck(&self) -> bool {
        lock(&self.stuck).is_some()
    }
}

/// Why nothing more is written of a recording.
#[derive(Debug)]
pub(crate) enum Stuck {
    /// It has as many bytes as it may have.
    Full(u64),
    /// The disk takes no more.
    Unwritable(io::Error),
}

/// Writes until nobody hands on any more, then makes sure that it is on disk. `bytes` are in the file already.
pub(super) fn write(file: File, bytes: u64, batches: &Receiver<LineBatch>, progress: &WriteProgress) {
    let mut pen = Pen { file, bytes, text: String::new() };
    while let Ok(batch) = batches.recv() {
        if progress.is_stuck() {
            progress.lose(batch.lines.len() as u64);
        } else if let Err(why) = pen.take(&batch) {
            *lock(&progress.stuck) = Some(why);
        }
        progress.taken.fetch_add(1, Ordering::Release);
    }
    if progress.is_stuck() || pen.file.sync_all().is_err() {
        tracing::warn!("a recording is not complete");
    }
}

struct Pen {
    file: File,
    bytes: u64,
    text: String,
}

impl Pen {
    fn take(&mut self, batch: &LineBatch) -> Result<(), Stuck> {
        if batch.missed > 0 {
            self.text.push_str(&format!("{{\"mark\":\"gap\",\"lost\":{}}}\n", batch.missed));
        }
        for line in &batch.lines {
            batch.names.write(line, &mut self.text);
        }
        if self.bytes + self.text.len() as u64 + LAST_LINES_BYTES > RECORDING_MAX_BYTES {
            self.text = "{\"mark\":\"full\"}\n".to_owned();
            self.write().map_err(Stuck::Unwritable)?;
            return Err(Stuck::Full(RECORDING_MAX_BYTES));
        }
        self.write().map_err(Stuck::Unwritable)
    }

    fn write(&mut self) -> io::Result<()> {
        let written = self.file.write_all(self.text.as_bytes());
        self.bytes += self.text.len() as u64;
        self.text.clear();
        written
    }
}
