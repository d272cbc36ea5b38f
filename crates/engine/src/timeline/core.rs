//! The core that both modes share: the wiring, the connectors with their context, and the budget of values.

use super::Emission;
use super::budget::TurnBudget;
use super::end::End;
use super::trigger::Trigger;
use crate::connectors::{ConnectorMemory, RunConnector, RunContext};
use crate::program::{ConnectorInfo, Program, RunGraph};
use crate::values::{ConnectorIx, IndexVec, StreamIx};
use behaviour::Value;
use robot::Millis;

/// A run without its time.
pub(crate) struct Core {
    pub(crate) graph: RunGraph,
    pub(crate) connectors: IndexVec<ConnectorIx, Box<dyn RunConnector>>,
    pub(crate) context: RunContext,
    /// The budget of values.
    pub(crate) budget: TurnBudget,
    /// The reason why it goes no further, once it does not.
    pub(crate) end: Option<End>,
}

impl Core {
    pub(crate) fn of(program: Program) -> Self {
        let Program { graph, engine, procedures, connectors, limits, .. } = program;
        let turns_once = graph.connectors.iter().map(|ConnectorInfo { inputs, .. }| inputs.len()).sum();
        let budget = TurnBudget::of(&limits, turns_once);
        let context = RunContext::of(engine, procedures, graph.streams.len());
        Self { graph, connectors, context, budget, end: None }
    }

    /// Tells and counts a value on a stream, and which input of which connector it is by.
    pub(crate) fn emit(
        &mut self,
        at: Millis,
        stream: StreamIx,
        value: &Value,
        by: Option<Trigger>,
        out: &mut (impl FnMut(Emission) + ?Sized),
    ) {
        self.context.stats.streams[stream].copy(at, value);
        out(Emission::Value { at, stream, value, by });
    }

    /// Returns the memory of every connector.
    pub(crate) fn memories(&self) -> Vec<(ConnectorIx, ConnectorMemory)> {
        self.connectors.enumerate().map(|(at, connector)| (at, connector.memory())).collect()
    }

    /// Lets connectors go on with what others of the same meaning remembered. What knows another number of values was
    /// written down by somebody else, and is left out.
    pub(crate) fn resume(&mut self, memories: Vec<(ConnectorIx, ConnectorMemory)>) {
        for (connector, memory) in memories {
            let connector = &mut self.connectors[connector];
            if connector.memory().known.len() == memory.known.len() {
                connector.resume(memory);
            }
        }
    }
}
