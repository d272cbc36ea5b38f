//! Templates, and what tests ask of sentences.

use behaviour::{
    Behaviour, BehaviourFile, Connector, Graph, Helper, Id, Kind, Operation, Params, Procedure, Record, RecordId,
    Stream, StreamKind, Value,
};
use robot::with_defaults;
use sentences::{Draft, Language, TextReading, explain, read};
use std::path::Path;

/// A template of the page.
pub(crate) struct Template {
    pub(crate) behaviour: Behaviour,
    pub(crate) helpers: Vec<Helper>,
}

/// All templates by the names of their files.
pub(crate) fn templates() -> Vec<Template> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/behaviours");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let template = |path: &std::path::PathBuf| {
        let file: BehaviourFile = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        Template { behaviour: file.records(|_| None).unwrap(), helpers: file.library() }
    };
    paths.iter().map(template).collect()
}

/// The plain sentences of a behaviour.
pub(crate) fn sentences_of(behaviour: &Behaviour, helpers: &[Helper], language: Language) -> Vec<String> {
    let helpers: Vec<&Helper> = helpers.iter().collect();
    explain(behaviour, &helpers, &|_| None, language).iter().map(ToString::to_string).collect()
}

/// What a text is read as, without a behaviour around it.
pub(crate) fn reading(text: &str, language: Language, helpers: &[Helper]) -> TextReading {
    read(text, language, &helpers.iter().collect::<Vec<_>>(), None)
}

/// A draft as a behaviour of its own.
pub(crate) fn draft_behaviour(draft: &Draft) -> Behaviour {
    let mut made = Made::default();
    let ids: Vec<Id> = (0..draft.streams.len()).map(|at| Id::new(&format!("s{at}")).unwrap()).collect();
    for (stream, id) in draft.streams.iter().zip(&ids) {
        let (name, device, params) = (stream.name.clone(), stream.device.clone(), stream.params.clone());
        made.stream(id, stream.kind, &name, device, params);
    }
    for connector in &draft.connectors {
        let inputs = connector.inputs.iter().map(|input| ids[*input].clone()).collect();
        made.connector(connector.operation.clone(), inputs, &ids[connector.output]);
    }
    made.behaviour
}

/// A behaviour that is being made.
#[derive(Default)]
pub(crate) struct Made {
    pub(crate) behaviour: Behaviour,
    count: i64,
}

impl Made {
    pub(crate) fn stream(&mut self, id: &Id, kind: StreamKind, name: &str, device: Option<String>, params: Params) {
        self.count += 1;
        let (name, order) = (name.to_owned(), self.count);
        let stream = Stream { kind, name, device, params, order, resources: None, priority: None, hold_ms: None };
        self.behaviour.records.insert(RecordId::new(Kind::Stream, id), Record::Stream(stream));
    }

    pub(crate) fn connector(&mut self, operation: Operation, inputs: Vec<Id>, output: &Id) {
        self.count += 1;
        let id = Id::new(&format!("c{}", self.count)).unwrap();
        let connector = Connector { operation, inputs, output: output.clone(), order: self.count };
        self.behaviour.records.insert(RecordId::new(Kind::Connector, &id), Record::Connector(connector));
    }
}

/// Whether two graphs are the same but for ids, names, order and how bodies are written.
pub(crate) fn same_graph(one: &Behaviour, other: &Behaviour) -> Result<(), String> {
    let (mut one, mut other) = (shapes(one), shapes(other));
    one.sort();
    other.sort();
    if one == other { Ok(()) } else { Err(format!("\n{}\n---\n{}", one.join("\n"), other.join("\n"))) }
}

/// Whether two graphs do the same to the same actions, whatever else there is that leads nowhere.
pub(crate) fn same_acting(one: &Behaviour, other: &Behaviour) -> Result<(), String> {
    let acting = |behaviour: &Behaviour| {
        let graph = Graph::of(behaviour);
        let reaching = graph.reaching_action(behaviour);
        let all = behaviour.streams().map(|(id, _)| id).filter(|id| reaching.contains(id));
        let mut shapes: Vec<String> = all.map(|id| shape(behaviour, &graph, id)).collect();
        shapes.sort();
        shapes
    };
    let (one, other) = (acting(one), acting(other));
    if one == other { Ok(()) } else { Err(format!("\n{}\n---\n{}", one.join("\n"), other.join("\n"))) }
}

/// Every stream as all that feeds it: equal texts for equal streams. Actions tell what feeds them, senses what they are.
fn shapes(behaviour: &Behaviour) -> Vec<String> {
    let graph = Graph::of(behaviour);
    behaviour.streams().map(|(id, _)| shape(behaviour, &graph, id)).collect()
}

fn shape(behaviour: &Behaviour, graph: &Graph, id: &Id) -> String {
    let stream = behaviour.stream(id).unwrap();
    let fed = graph.into_stream(id).iter().map(|(_, connector)| {
        let inputs: Vec<String> = connector.inputs.iter().map(|input| shape(behaviour, graph, input)).collect();
        format!("{}({})", operation(behaviour, connector), inputs.join(", "))
    });
    let mut fed: Vec<String> = fed.collect();
    fed.sort();
    let device = stream.device.as_deref().and_then(|name| robot::device(stream.kind, name).ok());
    let params = device.map(|device| with_defaults(device.params, &stream.params)).unwrap_or_default();
    let number = |value: &Value| value.as_number().map_or_else(|| value.to_string(), |number| number.to_string());
    let params: Vec<String> = params.values().map(number).collect();
    format!("{}[{}]{}", stream.device.as_deref().unwrap_or(""), params.join(","), fed.join(" + "))
}

/// A connector without the names of its arguments, and with numbers by value.
fn operation(behaviour: &Behaviour, connector: &Connector) -> String {
    let mut text = format!("{} {:?}", connector.operation.word(), connector.operation.period_ms());
    if let Some(Procedure::Helper(name)) = connector.operation.procedure() {
        text += name;
    }
    if let Some(Procedure::Body { body, .. }) = connector.operation.procedure() {
        let mut body = body.trim().to_owned();
        for (at, arg) in behaviour.arguments(connector).iter().enumerate() {
            body = behaviour::rename_identifier(&body, arg, &format!("v{at}"));
        }
        text += &body.replace(".0 ", " ").replace(".0)", ")");
        text = text.strip_suffix(".0").unwrap_or(&text).to_owned();
    }
    text + &connector.operation.start().map_or(String::new(), ToString::to_string)
}
