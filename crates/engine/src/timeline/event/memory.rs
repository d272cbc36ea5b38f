//! Giving and taking the memory of event mode.

use super::Event;
use crate::program::model::Graph;
use crate::timeline::memory::{Held, Memory};
use std::collections::BTreeMap;

impl Event {
    /// What it remembers.
    pub(crate) fn memory(&self) -> Memory {
        let held = |&(tick, _, connector): &(u64, usize, usize)| {
            let value = self.held[connector].clone()?;
            Some((connector, Held { value, origin: (self.open, 0), tick }))
        };
        let latest = self.latest.iter().enumerate().filter(|(_, known)| known.iter().any(Option::is_some));
        Memory {
            open: self.open,
            readings: 0,
            held: self.due.iter().filter_map(held).collect(),
            latest: latest.map(|(at, known)| (at, known.clone())).collect(),
            waiting: BTreeMap::new(),
        }
    }

    /// Goes on with what another run of the same connectors remembered. A reading that waits for a frame has no place
    /// here.
    pub(crate) fn remember(&mut self, graph: &Graph, memory: Memory) {
        self.open = memory.open;
        for (connector, held) in memory.held {
            self.held[connector] = Some(held.value);
            self.due.insert((held.tick.max(self.open), graph.ranks[connector], connector));
        }
        for (connector, known) in memory.latest {
            self.latest[connector] = known;
        }
    }
}
