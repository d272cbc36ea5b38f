//! Frame mode: every connector has at most one turn in a frame, on what is present in it.

use crate::cause::{Cause, SeenValue};
use crate::core::TracerCore;
use behaviour::connectors::ConnectorMeaning;
use engine::ConnectorIx;
use robot::Millis;
use std::sync::Arc;

/// The values that are present in a frame.
#[derive(Clone, Debug)]
pub(crate) struct Present {
    /// The end of the frame.
    at: Option<Millis>,
    /// By stream.
    now: Vec<Option<Arc<Cause>>>,
    /// By connector whether it had its turn.
    had_turn: Vec<bool>,
}

impl Present {
    pub(crate) fn of(streams: usize, connectors: usize) -> Self {
        Self { at: None, now: vec![None; streams], had_turn: vec![false; connectors] }
    }

    /// A value comes.
    pub(crate) fn value(
        &mut self,
        core: &mut TracerCore,
        seen: SeenValue,
        by: Option<(ConnectorIx, usize)>,
    ) -> Arc<Cause> {
        self.enter(core, seen.at);
        let stream = seen.stream.index();
        let cause = match by {
            None => core.reading(seen),
            Some((by, _)) if core.wiring.parts[by.index()].gives_later() => {
                // A beat comes after the value of its frame; other waiting takes a frame at least.
                if core.wiring.parts[by.index()].meaning == ConnectorMeaning::Every {
                    self.take(core, by);
                }
                let from = core.cells[by.index()].lets_all_go(seen.at, &mut core.room);
                Cause::given(seen, by, from, Vec::new())
            }
            Some((by, slot)) => {
                let from = self.turn(core, by, slot);
                let with = core.gives(by, slot, from.as_deref(), &seen);
                Cause::given(seen, by, from, with)
            }
        };
        self.now[stream] = Some(cause.clone());
        cause
    }

    /// A procedure fails.
    pub(crate) fn fault(&mut self, core: &mut TracerCore, at: Millis, by: ConnectorIx, slot: usize) {
        self.enter(core, at);
        if let Some(from) = self.turn(core, by, slot) {
            core.cells[by.index()].fails(slot, &from);
        }
    }

    /// The frame is over: who said nothing had a turn nevertheless.
    pub(crate) fn settle(&mut self, core: &mut TracerCore) {
        if self.at.take().is_some() {
            (0..self.had_turn.len()).for_each(|by| self.take(core, ConnectorIx::of(by)));
        }
        self.clear();
    }

    /// Forgets the frame.
    pub(crate) fn clear(&mut self) {
        self.at = None;
        self.now.fill(None);
        self.had_turn.fill(false);
    }

    fn enter(&mut self, core: &mut TracerCore, at: Millis) {
        if self.at != Some(at) {
            self.settle(core);
            self.at = Some(at);
        }
    }

    /// A connector has its turn and says something about a value. Returns that value.
    fn turn(&mut self, core: &mut TracerCore, by: ConnectorIx, slot: usize) -> Option<Arc<Cause>> {
        self.had_turn[by.index()] = true;
        self.store(core, by);
        let input = core.wiring.parts[by.index()].inputs.get(slot)?;
        self.now[input.index()].clone()
    }

    /// A connector has its turn, if there is anything for it, and says nothing.
    fn take(&mut self, core: &mut TracerCore, by: ConnectorIx) {
        let inputs = (0..).zip(&core.wiring.parts[by.index()].inputs);
        let present = inputs.filter_map(|(slot, input)| Some((slot, self.now[input.index()].as_ref()?)));
        let newer = |best: (usize, _), other: (usize, _)| {
            let (one, two): (&Arc<Cause>, &Arc<Cause>) = (best.1, other.1);
            if two.origin > one.origin { other } else { best }
        };
        let is_latest = core.wiring.parts[by.index()].meaning == ConnectorMeaning::Latest;
        let mut present = present.peekable();
        let triggered = is_latest && present.peek().is_some_and(|(slot, _)| *slot == 0);
        let found = if triggered { present.next() } else { present.reduce(newer) };
        let Some((slot, cause)) = found.map(|(slot, cause)| (slot, cause.clone())) else { return };
        if !std::mem::replace(&mut self.had_turn[by.index()], true) {
            self.store(core, by);
            core.takes(by, slot, &cause);
        }
    }

    /// A connector stores what is present at its inputs.
    fn store(&self, core: &mut TracerCore, by: ConnectorIx) {
        let (part, cell) = (&core.wiring.parts[by.index()], &mut core.cells[by.index()]);
        for (slot, input) in part.inputs.iter().enumerate() {
            if let Some(cause) = &self.now[input.index()] {
                cell.store(slot, cause);
            }
        }
    }
}
