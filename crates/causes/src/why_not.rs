//! Why a value did not come: up from its stream, the nearest connector first, to whatever kept it back.

use crate::cell::{Last, Turn};
use crate::tracer::Tracer;
use behaviour::connectors::ConnectorMeaning;
use engine::{ConnectorIx, StreamIx};
use protocol::{Because, BlockedConnector, WhyNot};
use robot::Millis;
use std::collections::{BTreeSet, VecDeque};

/// The most connectors that are told.
const BLOCKED_MAX: usize = 200;

/// The finding at a connector on the way up from a stream.
enum WhyNotFinding {
    /// This kept the value back.
    Blocked(BlockedConnector),
    /// It has nothing to say: whatever kept the value back is above these inputs.
    Above(Vec<usize>),
    /// Both.
    Both(BlockedConnector, Vec<usize>),
}

impl Tracer {
    /// Tells why nothing came on a stream since `from`, once everything until now was settled: every connector that kept a
    /// value back, the nearest to the stream first, then the sources from which nothing came.
    #[must_use]
    pub fn why_not(&self, stream: StreamIx, from: Millis) -> WhyNot {
        let (mut blocked, mut silent) = (Vec::new(), Vec::new());
        let mut seen = BTreeSet::from([stream]);
        let mut open = VecDeque::from([stream]);
        while let Some(at) = open.pop_front() {
            for &connector in self.core.wiring.incoming.get(at.index()).into_iter().flatten() {
                let (found, above) = match self.found(connector, from) {
                    WhyNotFinding::Blocked(found) => (Some(found), Vec::new()),
                    WhyNotFinding::Above(above) => (None, above),
                    WhyNotFinding::Both(found, above) => (Some(found), above),
                };
                blocked.extend(found);
                for slot in above {
                    let Some(&input) = self.core.wiring.parts[connector.index()].inputs.get(slot) else { continue };
                    if self.core.wiring.incoming[input.index()].is_empty() {
                        silent.push(self.nothing(connector, input));
                    } else if seen.insert(input) {
                        open.push_back(input);
                    }
                }
            }
        }
        blocked.append(&mut silent);
        blocked.truncate(BLOCKED_MAX);
        WhyNot { stream: self.stream_id(self.core.program, stream), blocked }
    }

    fn found(&self, connector: ConnectorIx, from: Millis) -> WhyNotFinding {
        let (part, cell) = (&self.core.wiring.parts[connector.index()], &self.core.cells[connector.index()]);
        let last = cell.last.as_ref().filter(|last| last.took.at >= from && last.turn != Turn::Gave);
        let all = || (0..part.inputs.len()).collect();
        match last {
            Some(last) if last.turn == Turn::Waits && part.knows_inputs() => {
                WhyNotFinding::Both(self.blocked(connector, last), cell.unknown().collect())
            }
            Some(last) => WhyNotFinding::Blocked(self.blocked(connector, last)),
            None => match cell.holds() {
                Some(held) => {
                    WhyNotFinding::Blocked(self.blocked(connector, &Last { turn: Turn::Waits, took: held.clone() }))
                }
                None if part.meaning == ConnectorMeaning::Latest => WhyNotFinding::Above(vec![0]),
                None => WhyNotFinding::Above(all()),
            },
        }
    }

    fn blocked(&self, connector: ConnectorIx, last: &Last) -> BlockedConnector {
        let because = match last.turn {
            Turn::Gave | Turn::Kept => Because::Kept,
            Turn::Failed => Because::Fault,
            Turn::Waits => Because::Waits,
        };
        BlockedConnector {
            connector: self.connector(self.core.program, connector),
            stream: self.stream(&last.took),
            t: Some(last.took.at.0),
            value: last.took.value.clone(),
            because,
        }
    }

    /// Nothing came from a source.
    fn nothing(&self, connector: ConnectorIx, input: StreamIx) -> BlockedConnector {
        BlockedConnector {
            connector: self.connector(self.core.program, connector),
            stream: self.stream_id(self.core.program, input),
            t: None,
            value: behaviour::Value::Null,
            because: Because::Nothing,
        }
    }
}
