//! The way of a value through the graph, laid out as one row of steps: depth first, in array order, so that running it
//! is going from one step to the next.

use crate::procedure::Procedure;
use crate::procedure::compiled::{Comparison, Operator, Short};
use crate::program::model::{Graph, Work};
use crate::values::in_place::Number;

/// What a step does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Does {
    /// Passes the last value of its input on.
    Pass,
    /// Passes it on with the time.
    Stamp,
    /// Hands it to a map.
    Map,
    /// The same for a map that is one operation with the number of the step.
    Compute(Operator),
    /// Hands it to a filter.
    Filter,
    /// The same for a filter that is one comparison with the number of the step.
    Compare(Comparison),
    /// Hands it to a sample, which gives nothing now.
    Hold,
    /// Hands it to a combineLatest, as one of its inputs.
    Combine,
    /// The end of this row: on after the step that led here, if one did.
    End,
}

/// Where to go on once a connector gave a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Goes {
    /// At the next step.
    On,
    /// In the row of its output, then at the next step.
    Away,
    /// In the row of its output, then wherever that row's leads: the next step is the end.
    AwayForGood,
}

/// One connector's turn to take a value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    pub(crate) does: Does,
    pub(crate) goes: Goes,
    pub(crate) connector: u32,
    /// The place of its input among the inputs of the connector.
    pub(crate) slot: u32,
    pub(crate) input: u32,
    pub(crate) output: u32,
    pub(crate) number: Number,
    /// The step to go on at if it gives nothing.
    pub(crate) past: u32,
}

/// All steps, and for every stream that values start from, where its row begins.
pub(crate) struct Plan {
    pub(crate) steps: Vec<Step>,
    rows: Vec<Row>,
}

/// The steps of what one stream carries.
#[derive(Clone, Copy)]
struct Row {
    first: u32,
    /// How many there are, without the end.
    turns: u32,
}

const NO_ROW: Row = Row { first: u32::MAX, turns: 0 };
const ZERO: Number = Number::Int(0);
const END: Step =
    Step { does: Does::End, goes: Goes::On, connector: 0, slot: 0, input: 0, output: 0, number: ZERO, past: 0 };

impl Plan {
    /// Lays out a graph. Every stream is in one row only, so that this takes no more room than the graph.
    pub(crate) fn of(graph: &Graph, procedures: &[Option<Procedure>]) -> Self {
        let mut plan = Self { steps: Vec::new(), rows: vec![NO_ROW; graph.streams.len()] };
        let mut starts = vec![true; graph.streams.len()];
        for connector in graph.connectors.iter().filter(|connector| is_in_row(connector.work, connector.inputs.len())) {
            starts[connector.output] = false;
        }
        for stream in (0..graph.streams.len()).filter(|&stream| starts[stream]) {
            plan.lay_out(graph, stream);
        }
        plan.shorten(procedures);
        plan.steps.shrink_to_fit();
        plan
    }

    /// The first step of what a stream carries.
    pub(crate) fn row(&self, stream: usize) -> usize {
        self.rows[stream].first as usize
    }

    /// How many steps that row has.
    #[inline(always)]
    pub(crate) fn turns(&self, stream: usize) -> u32 {
        self.rows[stream].turns
    }

    /// A step after which nothing is left to do.
    pub(crate) fn last(&self) -> usize {
        self.steps.len() - 1
    }

    fn lay_out(&mut self, graph: &Graph, start: usize) {
        let first = self.steps.len();
        // Streams on the way down, how many of their connectors have had their turn, and the step that led there.
        let mut path: Vec<(usize, usize, Option<usize>)> = vec![(start, 0, None)];
        while let Some((stream, next, from)) = path.last_mut() {
            let Some(&(connector, slot)) = graph.outgoing[*stream].get(*next) else {
                if let Some(from) = *from {
                    self.steps[from].past = index(self.steps.len());
                }
                path.pop();
                continue;
            };
            *next += 1;
            let input = *stream;
            self.step(graph, connector, slot, input);
            let info = &graph.connectors[connector];
            if is_in_row(info.work, info.inputs.len()) {
                path.push((info.output, 0, Some(self.steps.len() - 1)));
            }
        }
        if let Some(last) = self.steps.last_mut().filter(|last| last.goes == Goes::Away) {
            last.goes = Goes::AwayForGood;
        }
        self.rows[start] = Row { first: index(first), turns: index(self.steps.len() - first) };
        self.steps.push(END);
    }

    /// Steps that are one operation need not ask the procedure.
    fn shorten(&mut self, procedures: &[Option<Procedure>]) {
        for step in &mut self.steps {
            let procedure = procedures.get(step.connector as usize).and_then(Option::as_ref);
            match (step.does, procedure.and_then(Procedure::short)) {
                (Does::Map, Some(Short::Compute(operator, number))) => {
                    (step.does, step.number) = (Does::Compute(operator), number);
                }
                (Does::Filter, Some(Short::Compare(comparison, number))) => {
                    (step.does, step.number) = (Does::Compare(comparison), number);
                }
                _ => {}
            }
        }
    }

    fn step(&mut self, graph: &Graph, connector: usize, slot: usize, input: usize) {
        let info = &graph.connectors[connector];
        let leads_away = !is_in_row(info.work, info.inputs.len()) && !graph.outgoing[info.output].is_empty();
        self.steps.push(Step {
            does: does(info.work),
            goes: if leads_away { Goes::Away } else { Goes::On },
            connector: index(connector),
            slot: index(slot),
            input: index(input),
            output: index(info.output),
            number: ZERO,
            past: index(self.steps.len() + 1),
        });
    }
}

/// Whether what a connector gives comes right after it: nothing else leads there, and nothing in between.
fn is_in_row(work: Work, inputs: usize) -> bool {
    match work {
        Work::Map | Work::Filter | Work::Timestamp | Work::Subscribe => true,
        Work::Merge | Work::CombineLatest => inputs == 1,
        Work::Sample(_) => false,
    }
}

fn does(work: Work) -> Does {
    match work {
        Work::Map => Does::Map,
        Work::Filter => Does::Filter,
        Work::Merge | Work::Subscribe => Does::Pass,
        Work::Timestamp => Does::Stamp,
        Work::Sample(_) => Does::Hold,
        Work::CombineLatest => Does::Combine,
    }
}

/// Streams, connectors and steps are far fewer than would fill it.
fn index(at: usize) -> u32 {
    u32::try_from(at).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::{Does, Goes, Plan};
    use crate::program::model::{ConnectorInfo, Graph, StreamInfo, Work};
    use behaviour::StreamKind;

    fn graph(streams: usize, connectors: &[(Work, &[usize], usize)]) -> Graph {
        let stream = |at| StreamInfo {
            id: format!("s{at}"),
            kind: StreamKind::Ordinary,
            name: String::new(),
            device: None,
            params: behaviour::Params::default(),
        };
        let connector = |&(work, inputs, output): &(Work, &[usize], usize)| ConnectorInfo {
            id: String::new(),
            work,
            inputs: inputs.to_vec(),
            output,
        };
        Graph::of((0..streams).map(stream).collect(), connectors.iter().map(connector).collect()).ok().unwrap()
    }

    /// The steps of a row as `connector>past`.
    fn row(plan: &Plan, stream: usize) -> String {
        let (first, mut said) = (plan.row(stream), Vec::new());
        for step in &plan.steps[first..] {
            if step.does == Does::End {
                break;
            }
            let away = match step.goes {
                Goes::On => "",
                Goes::Away => "^",
                Goes::AwayForGood => "^^",
            };
            said.push(format!("{}>{}{away}", step.connector, step.past as usize - first));
        }
        said.join(" ")
    }

    #[test]
    fn a_tree_is_one_row_and_a_step_that_gives_nothing_leads_past_its_branch() {
        let map = Work::Map;
        let graph = graph(5, &[(map, &[0], 1), (map, &[1], 2), (map, &[1], 3), (map, &[0], 4)]);
        assert_eq!(row(&Plan::of(&graph, &[]), 0), "0>3 1>2 2>3 3>4");
    }

    #[test]
    fn where_values_meet_or_wait_a_row_of_its_own_begins() {
        let (map, merge) = (Work::Map, Work::Merge);
        let graph = graph(6, &[(map, &[0], 1), (merge, &[0, 1], 2), (map, &[2], 3), (Work::Sample(5), &[3], 4)]);
        let plan = Plan::of(&graph, &[]);
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
        assert!(Plan::of(&graph(121, &connectors), &[]).steps.len() < 250);
    }
}
