//! The memory of one connector, as far as it can still cause a value, and how its last turn ended.

use crate::cause::{Cause, SeenValue, WaitingCause, WayRoom, With};
use crate::wiring::WiredConnector;
use behaviour::Value;
use behaviour::connectors::ConnectorMeaning;
use robot::Millis;
use std::collections::VecDeque;
use std::sync::Arc;

/// A connector's memory and last turn.
#[derive(Clone, Debug)]
pub(crate) struct TracedCell {
    /// The newest value of each input.
    known: Vec<KnownInput>,
    /// Values that it will give by itself.
    waiting: VecDeque<WaitingCause>,
    /// The result before, and since when; none if that came before there was a tracer.
    memory: Option<(Value, Millis)>,
    pub(crate) last: Option<Last>,
}

/// The newest value of an input.
#[derive(Clone, Debug)]
enum KnownInput {
    /// Nothing ever came.
    Nothing,
    /// One came before there was a tracer: nobody knows when.
    Before,
    Value(SeenValue),
}

/// The end of a connector's last turn.
#[derive(Clone, Debug)]
pub(crate) struct Last {
    pub(crate) turn: Turn,
    /// The value that it took.
    pub(crate) took: SeenValue,
}

/// The ways in which a turn ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Turn {
    /// It gave a value.
    Gave,
    /// It kept the value back.
    Kept,
    /// The procedure failed.
    Failed,
    /// It waits, for a time or for another input.
    Waits,
}

impl TracedCell {
    /// Returns the cell of a connector that begins.
    pub(crate) fn of(part: &WiredConnector, began: Millis) -> Self {
        let known = if part.knows_inputs() { vec![KnownInput::Nothing; part.inputs.len()] } else { Vec::new() };
        Self { known, waiting: VecDeque::new(), memory: Some((part.start.clone(), began)), last: None }
    }

    /// The run goes on from results of which there was no tracer.
    pub(crate) fn forget_memory(&mut self) {
        self.memory = None;
    }

    /// The run goes on with values of these inputs, of which it may be known when they came.
    pub(crate) fn knew(&mut self, slot: usize, seen: Option<SeenValue>) {
        if let Some(known) = self.known.get_mut(slot) {
            *known = seen.map_or(KnownInput::Before, KnownInput::Value);
        }
    }

    /// It stores the value of an input, if it does.
    pub(crate) fn store(&mut self, slot: usize, cause: &Cause) {
        if let Some(known) = self.known.get_mut(slot) {
            *known = KnownInput::Value(cause.seen.clone());
        }
    }

    /// It gives a value for one of an input at once. Returns the other values that it used.
    pub(crate) fn gives(
        &mut self,
        part: &WiredConnector,
        slot: usize,
        from: &Cause,
        made: (&Value, Millis),
    ) -> Vec<With> {
        self.store(slot, from);
        self.turned(Turn::Gave, from);
        if part.meaning == ConnectorMeaning::Remembers {
            let before = self.memory.replace((made.0.clone(), made.1));
            return before.map(|(memory, since)| With::Memory(memory, since)).into_iter().collect();
        }
        let others = self.known.iter().enumerate().filter(|(other, _)| *other != slot);
        others.filter_map(|(_, known)| known.seen().cloned().map(With::Value)).collect()
    }

    /// The procedure fails for a value of an input.
    pub(crate) fn fails(&mut self, slot: usize, from: &Cause) {
        self.store(slot, from);
        self.turned(Turn::Failed, from);
    }

    /// It takes a value of an input and gives nothing for it now.
    pub(crate) fn takes(&mut self, part: &WiredConnector, slot: usize, cause: &Arc<Cause>, room: &mut WayRoom) {
        match part.meaning {
            ConnectorMeaning::Keeps | ConnectorMeaning::Changes => self.turned(Turn::Kept, cause),
            ConnectorMeaning::Every => {
                // Whatever its beat is: it is given when the engine says so.
                self.hold(cause, Millis(0), room);
            }
            ConnectorMeaning::Settles => self.hold(cause, due(cause, part), room),
            ConnectorMeaning::Later => {
                self.waiting.push_back(room.enter(cause, due(cause, part)));
                self.turned(Turn::Waits, cause);
            }
            ConnectorMeaning::Together => {
                self.store(slot, cause);
                self.turned(Turn::Waits, cause);
            }
            ConnectorMeaning::Latest => {
                self.store(slot, cause);
                if slot == 0 {
                    self.turned(Turn::Waits, cause);
                }
            }
            // Of a run that goes on these give something for everything, or fail.
            ConnectorMeaning::Makes
            | ConnectorMeaning::Stamps
            | ConnectorMeaning::Remembers
            | ConnectorMeaning::PassesOn => {}
        }
    }

    /// It holds a value instead of the one before.
    fn hold(&mut self, cause: &Arc<Cause>, due: Millis, room: &mut WayRoom) {
        self.waiting.drain(..).for_each(|waiting| drop(room.leave(waiting)));
        self.waiting.push_back(room.enter(cause, due));
        self.turned(Turn::Waits, cause);
    }

    /// It gives the first value that waits by itself. None if that came before there was a tracer.
    pub(crate) fn lets_go(&mut self, at: Millis, room: &mut WayRoom) -> Option<Arc<Cause>> {
        let is_due = self.waiting.front().is_some_and(|first| first.due <= at);
        let cause = is_due.then(|| self.waiting.pop_front()).flatten().map(|first| room.leave(first));
        if let Some(cause) = &cause {
            self.turned(Turn::Gave, cause);
        }
        cause
    }

    /// The last of all values that are due, which is what a frame has of them.
    pub(crate) fn lets_all_go(&mut self, at: Millis, room: &mut WayRoom) -> Option<Arc<Cause>> {
        std::iter::from_fn(|| self.lets_go(at, room)).last()
    }

    /// The value that it will give by itself next.
    pub(crate) fn holds(&self) -> Option<&SeenValue> {
        self.waiting.front().map(|first| &first.cause.seen)
    }

    /// All values that it will give by itself.
    pub(crate) fn waiting(&self) -> impl Iterator<Item = &WaitingCause> {
        self.waiting.iter()
    }

    /// The places of the inputs that it waits for, as nothing ever came there.
    pub(crate) fn unknown(&self) -> impl Iterator<Item = usize> {
        let nothing = |known: &KnownInput| matches!(known, KnownInput::Nothing);
        self.known.iter().enumerate().filter(move |(_, known)| nothing(known)).map(|(slot, _)| slot)
    }

    /// Returns roughly how many bytes it takes without the ways of what waits.
    pub(crate) fn bytes(&self) -> usize {
        size_of::<Self>()
            + self.known.len() * 2 * size_of::<SeenValue>()
            + self.waiting.len() * size_of::<WaitingCause>()
    }

    fn turned(&mut self, turn: Turn, took: &Cause) {
        self.last = Some(Last { turn, took: took.seen.clone() });
    }
}

impl KnownInput {
    fn seen(&self) -> Option<&SeenValue> {
        match self {
            Self::Value(seen) => Some(seen),
            Self::Nothing | Self::Before => None,
        }
    }
}

/// When a value that comes now is due.
fn due(cause: &Cause, part: &WiredConnector) -> Millis {
    Millis(cause.seen.at.0.saturating_add(part.period_ms))
}
