//! Event mode: values go depth first, so that a stack of those on their way says who was handed what, also without a word.

use crate::cause::{Cause, SeenValue};
use crate::core::TracerCore;
use engine::ConnectorIx;
use std::sync::Arc;

/// The values on their way, each with the number of connectors that it was handed to.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stack {
    way: Vec<(Arc<Cause>, usize)>,
}

impl Stack {
    /// A value comes.
    pub(crate) fn value(
        &mut self,
        core: &mut TracerCore,
        seen: SeenValue,
        by: Option<(ConnectorIx, usize)>,
    ) -> Arc<Cause> {
        let cause = match by {
            None => {
                self.settle(core);
                core.reading(seen)
            }
            Some((by, _)) if core.wiring.parts[by.index()].gives_later() => {
                self.settle(core);
                let from = core.cells[by.index()].lets_go(seen.at, &mut core.room);
                Cause::given(seen, by, from, Vec::new())
            }
            Some((by, slot)) => {
                let from = self.come_to(core, by, slot);
                let with = core.gives(by, slot, from.as_deref(), &seen);
                Cause::given(seen, by, from, with)
            }
        };
        self.way.push((cause.clone(), 0));
        cause
    }

    /// A procedure fails.
    pub(crate) fn fault(&mut self, core: &mut TracerCore, by: ConnectorIx, slot: usize) {
        if let Some(from) = self.come_to(core, by, slot) {
            core.cells[by.index()].fails(slot, &from);
        }
    }

    /// All values are carried to their end.
    pub(crate) fn settle(&mut self, core: &mut TracerCore) {
        while let Some((cause, next)) = self.way.pop() {
            hand(core, &cause, next, usize::MAX);
        }
    }

    /// The turn of a connector comes: everything before it has had its own. Returns the value that it takes.
    fn come_to(&mut self, core: &mut TracerCore, by: ConnectorIx, slot: usize) -> Option<Arc<Cause>> {
        let input = *core.wiring.parts[by.index()].inputs.get(slot)?;
        while self.way.last().is_some_and(|(cause, _)| cause.seen.stream != input) {
            let (cause, next) = self.way.pop()?;
            hand(core, &cause, next, usize::MAX);
        }
        let (cause, next) = self.way.last_mut()?;
        let outgoing = &core.wiring.outgoing[input.index()];
        let place = outgoing.iter().skip(*next).position(|&(to, _)| to == by)? + *next;
        let (from, first) = (cause.clone(), std::mem::replace(next, place + 1));
        hand(core, &from, first, place);
        Some(from)
    }
}

/// A value is handed to some connectors of its stream, and none of them says anything.
fn hand(core: &mut TracerCore, cause: &Arc<Cause>, first: usize, end: usize) {
    let stream = cause.seen.stream.index();
    for place in first..end.min(core.wiring.outgoing[stream].len()) {
        let (to, slot) = core.wiring.outgoing[stream][place];
        core.takes(to, slot as usize, cause);
    }
}
