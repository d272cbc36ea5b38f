//! The way of a value through the graph, laid out as one row of steps: depth first, in array order, so that running it
//! is going from one step to the next.

use crate::connectors::{ConnectorTurn, NextSteps};
use crate::procedure::ConnectorProcedure;
use crate::program::{ConnectorInfo, RunGraph};
use crate::values::in_place::ComputedNumber;
use crate::values::{ConnectorIx, IndexVec, StreamIx};
use behaviour::flow::Gives;

/// The step with which to go on once a connector gave a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Next {
    /// At the next step.
    On,
    /// In the row of its output, then at the next step.
    Away,
    /// In the row of its output, then wherever that row's leads: the next step is the end.
    AwayForGood,
}

/// One step of a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlanStep {
    pub(crate) op: NextSteps,
    pub(crate) next: Next,
    pub(crate) turn: ConnectorTurn,
    /// The step to go on at if it gives nothing.
    pub(crate) past: u32,
}

/// All steps, and for every stream that values start from, where its row begins.
pub(crate) struct Plan {
    pub(crate) steps: Vec<PlanStep>,
    rows: IndexVec<StreamIx, PlanRow>,
}

/// The steps of what one stream carries.
#[derive(Clone, Copy)]
struct PlanRow {
    first: u32,
    /// The number of steps, without the end.
    turns: u32,
}

const NO_ROW: PlanRow = PlanRow { first: u32::MAX, turns: 0 };
/// The turn of no connector.
pub(super) const NOBODY: ConnectorTurn = ConnectorTurn {
    connector: ConnectorIx::FIRST,
    slot: 0,
    input: StreamIx::FIRST,
    output: StreamIx::FIRST,
    number: ComputedNumber::Int(0),
};

impl Plan {
    /// Lays out a graph. Every stream is in one row only, so that this takes no more room than the graph.
    pub(crate) fn of<'p>(graph: &RunGraph, procedure: impl Fn(ConnectorIx) -> Option<&'p ConnectorProcedure>) -> Self {
        let mut plan = Self { steps: Vec::new(), rows: IndexVec::filled(&NO_ROW, graph.streams.len()) };
        let mut starts = IndexVec::filled(&true, graph.streams.len());
        for connector in graph.connectors.iter().filter(|connector| is_in_row(connector)) {
            starts[connector.output] = false;
        }
        for stream in graph.streams.indices().filter(|&stream| starts[stream]) {
            plan.lay_out(graph, stream);
        }
        plan.shorten(procedure);
        plan.steps.shrink_to_fit();
        plan
    }

    /// The first step of what a stream carries.
    pub(crate) fn row(&self, stream: StreamIx) -> usize {
        self.rows[stream].first as usize
    }

    /// Returns the number of steps in that row.
    #[inline(always)]
    pub(crate) fn turns(&self, stream: StreamIx) -> u32 {
        self.rows[stream].turns
    }

    /// A step after which nothing is left to do.
    pub(crate) fn last(&self) -> usize {
        self.steps.len() - 1
    }

    fn lay_out(&mut self, graph: &RunGraph, start: StreamIx) {
        let first = self.steps.len();
        // Streams on the way down, how many of their connectors have had their turn, and the step that led there.
        let mut path: Vec<(StreamIx, usize, Option<usize>)> = vec![(start, 0, None)];
        while let Some((stream, next, from)) = path.last_mut() {
            let Some(&(connector, slot)) = graph.outgoing[*stream].get(*next) else {
                if let Some(from) = *from {
                    self.steps[from].past = place(self.steps.len());
                }
                path.pop();
                continue;
            };
            *next += 1;
            let input = *stream;
            self.step(graph, connector, slot, input);
            let info = &graph.connectors[connector];
            if is_in_row(info) {
                path.push((info.output, 0, Some(self.steps.len() - 1)));
            }
        }
        if let Some(last) = self.steps.last_mut().filter(|last| last.next == Next::Away) {
            last.next = Next::AwayForGood;
        }
        self.rows[start] = PlanRow { first: place(first), turns: place(self.steps.len() - first) };
        self.steps.push(PlanStep { op: NextSteps::End, next: Next::On, turn: NOBODY, past: 0 });
    }

    /// Steps that are one operation need not ask the procedure.
    fn shorten<'p>(&mut self, procedure: impl Fn(ConnectorIx) -> Option<&'p ConnectorProcedure>) {
        for step in self.steps.iter_mut().filter(|step| step.op != NextSteps::End) {
            if let Some(short) = procedure(step.turn.connector).and_then(|procedure| step.op.shortened(procedure)) {
                (step.op, step.turn.number) = short;
            }
        }
    }

    fn step(&mut self, graph: &RunGraph, connector: ConnectorIx, slot: u32, input: StreamIx) {
        let info = &graph.connectors[connector];
        let leads_away = !is_in_row(info) && !graph.outgoing[info.output].is_empty();
        self.steps.push(PlanStep {
            op: info.op,
            next: if leads_away { Next::Away } else { Next::On },
            turn: ConnectorTurn { connector, slot, input, output: info.output, number: ComputedNumber::Int(0) },
            past: place(self.steps.len() + 1),
        });
    }
}

/// True if what a connector gives comes right after it: nothing else leads there, and nothing in between.
fn is_in_row(of: &ConnectorInfo) -> bool {
    of.gives != Gives::Later && of.inputs.len() == 1
}

/// Steps are far fewer than would fill it.
fn place(at: usize) -> u32 {
    u32::try_from(at).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::{Next, Plan};
    use crate::connectors::NextSteps;
    use crate::program::{ConnectorInfo, RunGraph, StreamInfo};
    use crate::values::StreamIx;
    use behaviour::StreamKind;
    use behaviour::flow::Gives;

    /// Connectors by what they do; merges and maps give at once.
    #[derive(Clone, Copy)]
    enum Work {
        Map,
        Merge,
        Sample,
    }

    fn graph(streams: usize, connectors: &[(Work, &[usize], usize)]) -> RunGraph {
        let stream = |at| StreamInfo {
            id: format!("s{at}"),
            kind: StreamKind::Ordinary,
            name: String::new(),
            device: None,
            params: behaviour::Params::default(),
        };
        let connector = |&(work, inputs, output): &(Work, &[usize], usize)| {
            let (op, gives) = match work {
                Work::Map => (NextSteps::Map, Gives::Each),
                Work::Merge => (NextSteps::Pass, Gives::Each),
                Work::Sample => (NextSteps::Take, Gives::Later),
            };
            let inputs = inputs.iter().map(|&input| StreamIx::of(input)).collect();
            ConnectorInfo { id: String::new(), word: "", inputs, output: StreamIx::of(output), gives, op }
        };
        RunGraph::of((0..streams).map(stream).collect(), connectors.iter().map(connector).collect()).ok().unwrap()
    }

    /// The steps of a row as `connector>past`.
    fn row(plan: &Plan, stream: usize) -> String {
        let (first, mut said) = (plan.row(StreamIx::of(stream)), Vec::new());
        for step in &plan.steps[first..] {
            if step.op == NextSteps::End {
                break;
            }
            let away = match step.next {
                Next::On => "",
                Next::Away => "^",
                Next::AwayForGood => "^^",
            };
            said.push(format!("{}>{}{away}", step.turn.connector.index(), step.past as usize - first));
        }
        said.join(" ")
    }

    #[test]
    fn a_tree_is_one_row_and_a_step_that_gives_nothing_leads_past_its_branch() {
        let map = Work::Map;
        let graph = graph(5, &[(map, &[0], 1), (map, &[1], 2), (map, &[1], 3), (map, &[0], 4)]);
        assert_eq!(row(&Plan::of(&graph, |_| None), 0), "0>3 1>2 2>3 3>4");
    }

    #[test]
    fn where_values_meet_or_wait_a_row_of_its_own_begins() {
        let (map, merge) = (Work::Map, Work::Merge);
        let graph = graph(6, &[(map, &[0], 1), (merge, &[0, 1], 2), (map, &[2], 3), (Work::Sample, &[3], 4)]);
        let plan = Plan::of(&graph, |_| None);
        assert_eq!(row(&plan, 0), "0>2 1>2^ 1>3^^");
        assert_eq!(row(&plan, 2), "2>2 3>2");
        assert_eq!((row(&plan, 4), row(&plan, 5)), (String::new(), String::new()));
    }

    #[test]
    fn diamonds_in_a_row_do_not_double_the_steps() {
        let mut connectors: Vec<(Work, Vec<usize>, usize)> = Vec::new();
        for at in (0..120).step_by(3) {
            connectors.push((Work::Map, vec![at], at + 1));
            connectors.push((Work::Map, vec![at], at + 2));
            connectors.push((Work::Merge, vec![at + 1, at + 2], at + 3));
        }
        let connectors: Vec<_> =
            connectors.iter().map(|(work, inputs, output)| (*work, &inputs[..], *output)).collect();
        assert!(Plan::of(&graph(121, &connectors), |_| None).steps.len() < 250);
    }
}
