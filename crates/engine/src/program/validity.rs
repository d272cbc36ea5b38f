//! Whether a behaviour can run: every fault with the id of the stream or connector and a reason.

use crate::cost::Limits;
use crate::procedure::helpers::{Helpers, check_distinct};
use crate::procedure::{Fault, Procedure};
use crate::program::model::{ConnectorInfo, Graph, StreamInfo, Work};
use crate::rhai::maths::has_power;
use crate::rhai::sandbox::hardened_engine;
use behaviour::{BehaviourFile, Engine, FORMAT, FileConnector, StreamKind, argument_names, is_identifier};
use std::collections::{BTreeMap, BTreeSet};

/// Everything that keeps a behaviour from running, in the order of the file; empty if it can run.
#[must_use]
pub fn validate(file: &BehaviourFile) -> Vec<Fault> {
    prepare(file, &Limits::default()).err().unwrap_or_default()
}

/// A behaviour ready to run.
pub(crate) struct Prepared {
    pub(crate) graph: Graph,
    pub(crate) engine: rhai::Engine,
    pub(crate) procedures: Vec<Option<Procedure>>,
}

/// Checks, wires and compiles.
pub(crate) fn prepare(file: &BehaviourFile, limits: &Limits) -> Result<Prepared, Vec<Fault>> {
    let mut engine = hardened_engine(limits);
    engine.set_fast_operators(!has_powers(file));
    let mut door = Door { file, streams: index(file), faults: Vec::new() };
    door.check_file();
    door.check_ids();
    let connectors = door.connectors();
    let helpers = Helpers::compile(&engine, &file.helpers, limits).unwrap_or_else(|faults| door.give_up(faults));
    let procedures: Vec<_> = file.connectors.iter().map(|c| door.procedure(&engine, &helpers, c)).collect();
    let Some(connectors) = connectors else { return Err(door.faults) };
    let streams = file.streams.iter().map(StreamInfo::of).collect();
    match Graph::of(streams, connectors) {
        Ok(graph) if door.faults.is_empty() => Ok(Prepared { graph, engine, procedures }),
        Ok(_) => Err(door.faults),
        Err(at) => {
            door.fault(&file.connectors[at].id, "values would flow in a circle through it");
            Err(door.faults)
        }
    }
}

fn has_powers(file: &BehaviourFile) -> bool {
    let bodies = file.connectors.iter().filter_map(|connector| connector.body.as_ref());
    bodies.chain(file.helpers.iter().map(|helper| &helper.body)).any(|body| has_power(body))
}

fn index(file: &BehaviourFile) -> BTreeMap<&str, usize> {
    file.streams.iter().enumerate().rev().map(|(at, stream)| (stream.id.as_str(), at)).collect()
}

/// Where a file comes in.
struct Door<'f> {
    file: &'f BehaviourFile,
    streams: BTreeMap<&'f str, usize>,
    faults: Vec<Fault>,
}

impl<'f> Door<'f> {
    fn fault(&mut self, id: &str, reason: impl Into<String>) {
        self.faults.push(Fault { id: id.to_owned(), reason: reason.into() });
    }

    fn give_up(&mut self, faults: Vec<Fault>) -> Helpers {
        self.faults.extend(faults);
        Helpers::default()
    }

    fn check_file(&mut self) {
        if self.file.format != FORMAT {
            self.fault("format", format!("{:?} is not {FORMAT}", self.file.format));
        }
        if let Some(Engine::Frame { frame_ms }) = self.file.engine
            && !(1..=1000).contains(&frame_ms)
        {
            self.fault("engine", "a frame has 1 to 1000 milliseconds");
        }
    }

    fn check_ids(&mut self) {
        let mut seen = BTreeSet::new();
        let ids = self.file.streams.iter().map(|s| &s.id).chain(self.file.connectors.iter().map(|c| &c.id));
        let twice: Vec<_> = ids.filter(|id| !seen.insert(id.as_str())).collect();
        for id in twice {
            self.fault(id, "this id is used twice");
        }
    }

    /// All connectors with their ends, unless an end is missing.
    fn connectors(&mut self) -> Option<Vec<ConnectorInfo>> {
        let mut fed = BTreeSet::new();
        let mut all = Vec::with_capacity(self.file.connectors.len());
        for connector in &self.file.connectors {
            match self.connector(connector, &mut fed) {
                Ok(info) => all.push(info),
                Err(reason) => self.fault(&connector.id, reason),
            }
        }
        (all.len() == self.file.connectors.len()).then_some(all)
    }

    fn connector(&self, connector: &FileConnector, fed: &mut BTreeSet<usize>) -> Result<ConnectorInfo, String> {
        let work = work(connector)?;
        let inputs = connector.inputs.iter().map(|id| self.stream(id)).collect::<Result<Vec<_>, _>>()?;
        let output = self.stream(&connector.output)?;
        self.check_inputs(work, connector, &inputs)?;
        self.check_output(work, output)?;
        if !fed.insert(output) && work != Work::Subscribe {
            return Err(format!("the stream {} already has an incoming connector", connector.output));
        }
        Ok(ConnectorInfo { id: connector.id.clone(), work, inputs, output })
    }

    fn stream(&self, id: &str) -> Result<usize, String> {
        self.streams.get(id).copied().ok_or_else(|| format!("there is no stream {id:?}"))
    }

    fn check_inputs(&self, work: Work, connector: &FileConnector, inputs: &[usize]) -> Result<(), String> {
        let many = matches!(work, Work::CombineLatest | Work::Merge);
        if inputs.is_empty() || (!many && inputs.len() > 1) {
            let wanted = if many { "one input or more" } else { "exactly one input" };
            return Err(format!("{} takes {wanted}, not {}", connector.operation, inputs.len()));
        }
        for (at, input) in inputs.iter().enumerate() {
            if inputs[..at].contains(input) {
                return Err(format!("the input {} is there twice", connector.inputs[at]));
            }
            if self.file.streams[*input].kind == StreamKind::Actuator {
                return Err(format!("nothing can come out of the actuator stream {}", connector.inputs[at]));
            }
        }
        Ok(())
    }

    fn check_output(&self, work: Work, output: usize) -> Result<(), String> {
        let stream = &self.file.streams[output];
        match (stream.kind, work) {
            (StreamKind::Sensor, _) => Err(format!("nothing can lead into the sensor stream {}", stream.id)),
            (StreamKind::Actuator, Work::Subscribe) => Ok(()),
            (StreamKind::Actuator, _) => Err(format!("only subscribe leads into the actuator stream {}", stream.id)),
            (StreamKind::Ordinary, Work::Subscribe) => {
                Err(format!("subscribe must lead to an actuator stream, and {} is none", stream.id))
            }
            (StreamKind::Ordinary, _) => Ok(()),
        }
    }

    fn procedure(&mut self, engine: &rhai::Engine, helpers: &Helpers, of: &FileConnector) -> Option<Procedure> {
        if !matches!(of.operation.as_str(), "map" | "filter" | "combineLatest") {
            return None;
        }
        let compiled = self.text(of).and_then(|(names, body)| Procedure::compile(engine, helpers, &names, &body));
        compiled.map_err(|reason| self.fault(&of.id, reason)).ok()
    }

    /// The argument names and the body of a connector. A helper is run as a body of its own.
    fn text(&self, of: &FileConnector) -> Result<(Vec<String>, String), String> {
        let many = of.inputs.len();
        match (&of.body, &of.helper) {
            (Some(_), Some(_)) => Err("it has both a body and a helper".to_owned()),
            (None, None) => Err("it has no procedure yet".to_owned()),
            (None, Some(name)) => {
                let helper = self.file.helpers.iter().find(|helper| helper.name == *name);
                let helper = helper.ok_or_else(|| format!("there is no helper “{name}”"))?;
                let takes = helper.params.len();
                if takes != many {
                    return Err(format!("the helper “{name}” takes {takes} values, but gets {many}"));
                }
                Ok((helper.params.clone(), helper.body.clone()))
            }
            (Some(body), None) => Ok((self.arguments(of)?, body.clone())),
        }
    }

    fn arguments(&self, of: &FileConnector) -> Result<Vec<String>, String> {
        let Some(names) = &of.args else {
            let name =
                |id: &String| self.streams.get(id.as_str()).map_or("", |at| self.file.streams[*at].name.as_str());
            return Ok(argument_names(of.inputs.iter().map(name)));
        };
        if names.len() != of.inputs.len() {
            return Err(format!("it names {} arguments for {} inputs", names.len(), of.inputs.len()));
        }
        if let Some(bad) = names.iter().find(|name| !is_identifier(name)) {
            return Err(format!("“{bad}” cannot be a name in a procedure"));
        }
        check_distinct(names)?;
        Ok(names.clone())
    }
}

fn work(connector: &FileConnector) -> Result<Work, String> {
    Ok(match connector.operation.as_str() {
        "map" => Work::Map,
        "filter" => Work::Filter,
        "timestamp" => Work::Timestamp,
        "combineLatest" => Work::CombineLatest,
        "merge" => Work::Merge,
        "subscribe" => Work::Subscribe,
        "sample" => match connector.period_ms {
            Some(period) if period > 0 => Work::Sample(period),
            Some(_) | None => return Err("sample needs a periodMs of 1 or more".to_owned()),
        },
        other => return Err(format!("there is no connector {other:?}")),
    })
}
