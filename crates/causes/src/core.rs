//! The parts of a tracer on which both modes of time work.

use crate::cause::{Cause, SeenValue, WayRoom, With};
use crate::cell::TracedCell;
use crate::kept::KeptValue;
use crate::wiring::Wiring;
use behaviour::BehaviourFile;
use behaviour::connectors::ConnectorMeaning;
use engine::ConnectorIx;
use robot::Millis;
use std::sync::Arc;

/// The parts on which both modes work.
#[derive(Clone, Debug)]
pub(crate) struct TracerCore {
    /// The number of the program that runs.
    pub(crate) program: usize,
    pub(crate) wiring: Arc<Wiring>,
    /// By connector.
    pub(crate) cells: Vec<TracedCell>,
    pub(crate) room: WayRoom,
    /// The number of readings so far.
    pub(crate) readings: u64,
    /// The values that tests kept back since somebody asked last; none while nobody asks.
    pub(crate) kept: Option<Vec<KeptValue>>,
}

impl TracerCore {
    pub(crate) fn of(file: &BehaviourFile, program: usize, began: Millis) -> Self {
        let wiring = Wiring::of(file);
        let cells = wiring.parts.iter().map(|part| TracedCell::of(part, began)).collect();
        Self { program, wiring: Arc::new(wiring), cells, room: WayRoom::default(), readings: 0, kept: None }
    }

    /// A reading.
    pub(crate) fn reading(&mut self, seen: SeenValue) -> Arc<Cause> {
        self.readings += 1;
        Cause::reading(seen, self.readings)
    }

    /// A connector gives a value at once, for one of an input.
    pub(crate) fn gives(&mut self, by: ConnectorIx, slot: usize, from: Option<&Cause>, seen: &SeenValue) -> Vec<With> {
        let (part, cell) = (&self.wiring.parts[by.index()], &mut self.cells[by.index()]);
        from.map_or_else(Vec::new, |from| cell.gives(part, slot, from, (&seen.value, seen.at)))
    }

    /// A connector takes a value of an input, and gives nothing now.
    pub(crate) fn takes(&mut self, by: ConnectorIx, slot: usize, cause: &Arc<Cause>) {
        let (part, cell) = (&self.wiring.parts[by.index()], &mut self.cells[by.index()]);
        cell.takes(part, slot, cause, &mut self.room);
        if let Some(kept) = self.kept.as_mut().filter(|_| part.meaning == ConnectorMeaning::Keeps) {
            kept.push(KeptValue { connector: by, seen: cause.seen.clone() });
        }
    }
}
