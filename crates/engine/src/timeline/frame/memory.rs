//! Giving and taking the memory of frame mode.

use super::{Carried, Frame};
use crate::program::model::{Graph, Work};
use crate::timeline::memory::{Held, Memory};
use robot::Millis;

impl Frame {
    /// Whether readings wait for the open frame.
    pub(crate) fn is_fed(&self) -> bool {
        self.fed
    }

    /// What it remembers.
    pub(crate) fn memory(&self, graph: &Graph) -> Memory {
        let held = |&(end, connector): &(u64, usize)| {
            let Work::Sample(period) = graph.connectors[connector].work else { return None };
            let Carried { value, origin } = self.held[connector].clone()?;
            // The tick is the first beat in the frame that gives it.
            let tick = ((end - self.length) / period + 1).saturating_mul(period);
            Some((connector, Held { value, origin, tick }))
        };
        let latest = self.latest.iter().enumerate().filter(|(_, known)| known.iter().any(Option::is_some));
        let waiting = self.now.iter().enumerate().filter_map(|(at, carried)| Some((at, carried.clone()?)));
        Memory {
            open: self.open - self.length + 1,
            readings: self.readings,
            held: self.due.iter().filter_map(held).collect(),
            latest: latest.map(|(at, known)| (at, known.clone())).collect(),
            waiting: waiting.map(|(at, carried)| (at, (carried.value, carried.origin))).collect(),
        }
    }

    /// Goes on with what another run of the same connectors remembered: the next frame is the first that ends in an
    /// instant that is not closed.
    pub(crate) fn remember(&mut self, graph: &Graph, memory: Memory) {
        self.open = self.end_of(Millis(memory.open)).0;
        self.readings = memory.readings;
        self.fed = !memory.waiting.is_empty();
        for (stream, (value, origin)) in memory.waiting {
            self.now[stream] = Some(Carried { value, origin });
        }
        for (connector, Held { value, origin, tick }) in memory.held {
            self.held[connector] = Some(Carried { value, origin });
            self.due.insert((self.end_of(Millis(tick)).0.max(self.open), connector));
        }
        for (connector, known) in memory.latest {
            if graph.connectors[connector].work == Work::CombineLatest {
                self.latest[connector] = known;
            }
        }
    }
}
