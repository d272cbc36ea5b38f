//! The check that a behaviour can run: every fault with the id of the stream, connector or helper, and a reason.

use super::Program;
use super::model::{ConnectorInfo, RunGraph, StreamInfo};
use super::operation::DeclaredConnector;
use super::reserved::without_reserved;
use crate::cost::Limits;
use crate::faults::{BodyFault, GraphFault, Reason};
use crate::procedure::ConnectorProcedure;
use crate::procedure::helpers::{HelperPrograms, check_distinct};
use crate::rhai::maths::has_power;
use crate::rhai::sandbox::hardened_engine;
use crate::values::{ConnectorIx, IndexVec, StreamIx};
use behaviour::{
    BehaviourFile, Engine, FORMAT, FileConnector, FlawKind, Procedure as Written, StreamKind, is_identifier,
};
use behaviour::{Lookup, LookupSet};

/// Everything that keeps a behaviour from running, in the order of the file; empty if it can run.
#[must_use]
pub fn validate(file: &BehaviourFile) -> Vec<GraphFault> {
    Program::of(file, Limits::default()).err().unwrap_or_default()
}

impl Program {
    /// Checks a behaviour, wires it and compiles its procedures.
    ///
    /// # Errors
    /// Every reason why it cannot run, in the order of the file.
    pub fn of(file: &BehaviourFile, limits: Limits) -> Result<Self, Vec<GraphFault>> {
        let file = &*without_reserved(file);
        let mut engine = hardened_engine(&limits);
        engine.set_fast_operators(!has_powers(file));
        let mut check = Check { file, streams: index(file), faults: Vec::new() };
        check.file();
        check.ids();
        let (declared, infos) = check.connectors();
        let helpers =
            HelperPrograms::compile(&engine, &file.helpers, &limits).unwrap_or_else(|faults| check.give_up(faults));
        let procedures = declared.iter().zip(&file.connectors);
        let procedures =
            procedures.map(|(declared, of)| check.procedure(&engine, &helpers, declared.as_ref()?, of)).collect();
        let Some(infos) = infos else { return Err(check.faults) };
        let graph = check.wired(infos);
        let made = |(declared, of): (&Option<DeclaredConnector>, &FileConnector)| {
            declared.as_ref().map(|declared| (declared.kind.make)(&declared.choice(of.inputs.len())))
        };
        // Not out of the list itself, whose memory a run would keep.
        let connectors = declared.iter().zip(&file.connectors).filter_map(made).collect();
        match graph {
            Some(graph) if check.faults.is_empty() => {
                let mode = file.engine.unwrap_or_default();
                Ok(Self { graph, mode, engine, procedures, connectors, limits })
            }
            _ => Err(check.faults),
        }
    }
}

fn has_powers(file: &BehaviourFile) -> bool {
    let bodies = file.connectors.iter().filter_map(|connector| connector.body.as_ref());
    bodies.chain(file.helpers.iter().map(|helper| &helper.body)).any(|body| has_power(body))
}

fn index(file: &BehaviourFile) -> Lookup<&str, usize> {
    let streams = file.streams.iter().enumerate().rev();
    streams.map(|(at, stream)| (stream.id.as_str(), at)).collect()
}

/// A file that is checked.
struct Check<'f> {
    file: &'f BehaviourFile,
    streams: Lookup<&'f str, usize>,
    faults: Vec<GraphFault>,
}

impl Check<'_> {
    fn fault(&mut self, id: &str, reason: impl Into<Reason>) {
        self.faults.push(GraphFault { id: id.to_owned(), reason: reason.into() });
    }

    fn give_up(&mut self, faults: Vec<GraphFault>) -> HelperPrograms {
        self.faults.extend(faults);
        HelperPrograms::default()
    }

    fn file(&mut self) {
        if self.file.format != FORMAT {
            self.fault("format", FlawKind::Format(self.file.format.clone()));
        }
        if let Some(Engine::Frame { frame_ms }) = self.file.engine
            && !(1..=1000).contains(&frame_ms)
        {
            self.fault("engine", Reason::FrameLength);
        }
    }

    fn ids(&mut self) {
        let mut seen = LookupSet::new();
        let ids = self.file.streams.iter().map(|s| &s.id).chain(self.file.connectors.iter().map(|c| &c.id));
        let twice: Vec<_> = ids.filter(|id| !seen.insert(id.as_str())).collect();
        for id in twice {
            self.fault(id, FlawKind::IdTwice);
        }
    }

    /// Returns the operation of every connector of the file, if it has one; and all of them with their ends, unless one
    /// is missing.
    fn connectors(&mut self) -> (Vec<Option<DeclaredConnector>>, Option<Vec<ConnectorInfo>>) {
        let mut fed = IndexVec::filled(&false, self.file.streams.len());
        let many = self.file.connectors.len();
        let (mut all, mut infos) = (Vec::with_capacity(many), Vec::with_capacity(many));
        for connector in &self.file.connectors {
            let declared = DeclaredConnector::of(connector).map_err(|reason| self.fault(&connector.id, reason)).ok();
            match declared.as_ref().map(|declared| self.connector(declared, connector, &mut fed)) {
                Some(Ok(info)) => infos.push(info),
                Some(Err(reason)) => self.fault(&connector.id, reason),
                None => {}
            }
            all.push(declared);
        }
        let is_whole = infos.len() == all.len();
        (all, is_whole.then_some(infos))
    }

    fn connector(
        &self,
        declared: &DeclaredConnector,
        connector: &FileConnector,
        fed: &mut IndexVec<StreamIx, bool>,
    ) -> Result<ConnectorInfo, Reason> {
        let inputs = connector.inputs.iter().map(|id| self.stream(id)).collect::<Result<Vec<_>, _>>()?;
        let output = self.stream(&connector.output)?;
        self.check_inputs(declared, connector, &inputs)?;
        self.check_output(declared, output)?;
        if std::mem::replace(&mut fed[output], true) && declared.spec().ends == StreamKind::Ordinary {
            return Err(Reason::SecondInput(connector.output.clone()));
        }
        let (spec, op) = (declared.spec(), declared.kind.op);
        let (word, gives) = (spec.word, spec.gives);
        Ok(ConnectorInfo { id: connector.id.clone(), word, inputs, output, gives, op })
    }

    fn stream(&self, id: &str) -> Result<StreamIx, FlawKind> {
        self.streams.get(id).map(|at| StreamIx::of(*at)).ok_or_else(|| FlawKind::NoStream(id.to_owned()))
    }

    fn check_inputs(
        &self,
        of: &DeclaredConnector,
        connector: &FileConnector,
        inputs: &[StreamIx],
    ) -> Result<(), Reason> {
        if let Some(takes) = of.wants_inputs(inputs.len()) {
            return Err(Reason::Inputs { word: of.spec().word, takes, gets: inputs.len() });
        }
        let mut seen = LookupSet::new();
        for (input, id) in inputs.iter().zip(&connector.inputs) {
            if !seen.insert(id.as_str()) {
                return Err(Reason::InputTwice(id.clone()));
            }
            if self.file.streams[input.index()].kind == StreamKind::Actuator {
                return Err(Reason::OutOfActuator(id.clone()));
            }
        }
        Ok(())
    }

    fn check_output(&self, of: &DeclaredConnector, output: StreamIx) -> Result<(), Reason> {
        let stream = &self.file.streams[output.index()];
        match (stream.kind, of.spec().ends) {
            (StreamKind::Sensor, _) => Err(Reason::IntoSensor(stream.id.clone())),
            (StreamKind::Actuator, StreamKind::Actuator) => Ok(()),
            (StreamKind::Actuator, _) => Err(Reason::OnlySubscribe(stream.id.clone())),
            (StreamKind::Ordinary, StreamKind::Actuator) => Err(Reason::NoActuator(of.spec().word, stream.id.clone())),
            (StreamKind::Ordinary, _) => Ok(()),
        }
    }

    /// The wiring, unless there is a circle.
    fn wired(&mut self, connectors: Vec<ConnectorInfo>) -> Option<RunGraph> {
        let streams = self.file.streams.iter().map(StreamInfo::of).collect();
        let circle = |at: ConnectorIx| {
            self.fault(&self.file.connectors[at.index()].id, Reason::Circle);
        };
        RunGraph::of(streams, connectors).map_err(circle).ok()
    }

    fn procedure(
        &mut self,
        engine: &rhai::Engine,
        helpers: &HelperPrograms,
        declared: &DeclaredConnector,
        of: &FileConnector,
    ) -> Option<ConnectorProcedure> {
        let text = self.text(declared, declared.procedure()?, of);
        let compiled = text.and_then(|(names, body)| Ok(ConnectorProcedure::compile(engine, helpers, &names, &body)?));
        compiled.map_err(|reason| self.fault(&of.id, reason)).ok()
    }

    /// The arguments and body of a connector; a helper counts as a body of its own.
    fn text(
        &self,
        of: &DeclaredConnector,
        procedure: &Written,
        at: &FileConnector,
    ) -> Result<(Vec<String>, String), Reason> {
        let arguments = || of.arguments(at.inputs.iter().map(|id| self.name(id)));
        match procedure {
            Written::Helper(name) => {
                let helper = self.file.helpers.iter().find(|helper| helper.name == *name);
                let helper = helper.ok_or_else(|| Reason::NoHelper(name.clone()))?;
                let (takes, many) = (helper.params.len(), of.spec().argument_count(at.inputs.len()));
                if takes != many {
                    return Err(Reason::HelperInputs { helper: name.clone(), takes, gets: many });
                }
                Ok((helper.params.clone(), helper.body.clone()))
            }
            Written::Body { body, args } => {
                let names = arguments();
                if args.is_some() {
                    check_arguments(&names, of.spec().argument_count(at.inputs.len()), at.inputs.len())?;
                }
                Ok((names, body.clone()))
            }
        }
    }

    /// The name of a stream.
    fn name(&self, id: &str) -> &str {
        self.streams.get(id).map_or("", |at| &self.file.streams[*at].name)
    }
}

/// Checks that arguments which a file names can be those of a procedure with so many of them, for so many inputs.
fn check_arguments(names: &[String], many: usize, inputs: usize) -> Result<(), Reason> {
    if names.len() != many {
        return Err(Reason::Arguments { names: names.len(), inputs });
    }
    if let Some(bad) = names.iter().find(|name| !is_identifier(name)) {
        return Err(BodyFault::Name(bad.clone()).into());
    }
    Ok(check_distinct(names)?)
}

#[cfg(test)]
mod tests {
    use super::Program;
    use crate::cost::Limits;

    #[test]
    fn what_the_thesis_writes_is_compiled() {
        let gold = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/gold");
        let mut compiled = 0;
        for case in std::fs::read_dir(gold).unwrap() {
            let Ok(text) = std::fs::read_to_string(case.unwrap().path().join("behaviour.json")) else { continue };
            let file: behaviour::BehaviourFile = serde_json::from_str(&text).unwrap();
            let program = Program::of(&file, Limits::default()).ok().unwrap();
            for (procedure, connector) in program.procedures.iter().zip(&file.connectors) {
                let Some(procedure) = procedure else { continue };
                assert!(procedure.is_compiled(), "{:?} {:?}", connector.body, connector.helper);
                compiled += 1;
            }
        }
        assert!(compiled > 30, "{compiled}");
    }
}
