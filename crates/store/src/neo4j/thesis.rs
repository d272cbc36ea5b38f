//! Programs as the thesis's own environment kept them in Neo4j (5.2.4), read as behaviour files.
//!
//! The thesis prints the labels, the relationships and one query, but not the names of properties: those are recognised
//! in their likely spellings. What is not recognised stays empty, and is shown as a problem before Start.

use super::address::Neo4jAddress;
use super::link::{Neo4jConnections, StatementParams};
use crate::StoreError;
use behaviour::{
    BehaviourFile, FORMAT, FileConnector, FileHelper, FileStream, StreamKind, connectors, numbered, shown_spellings,
};
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

/// The longest time of one question.
const ANSWER_MAX: Duration = Duration::from_secs(30);

const PROGRAMS: &str = "MATCH (p:Program) RETURN id(p) AS id, p {.*} AS props ORDER BY id";
const STREAMS: &str = "
MATCH (p:Program)<-[:program]-(s:Stream) WHERE id(p) = $id
RETURN id(s) AS id, labels(s) AS labels, s {.*} AS props ORDER BY id";
const SIMPLE: &str = "
MATCH (p:Program)<-[:program]-(a:Stream)-[r]->(b:Stream)-[:program]->(p) WHERE id(p) = $id
RETURN id(r) AS id, [type(r)] AS labels, r {.*} AS props, [id(a)] AS inputs, id(b) AS output, null AS helper,
  'r' AS form ORDER BY id";
const NODES: &str = "
MATCH (p:Program)<-[:program]-(a:Stream)-[i]->(c)-[]->(b:Stream)-[:program]->(p)
WHERE id(p) = $id AND NOT c:Stream AND NOT c:Program
WITH c, b, a, i ORDER BY coalesce(i.slot, i.index, i.order, i.number, id(i))
WITH c, b, collect(DISTINCT id(a)) AS inputs
OPTIONAL MATCH (c)-[]->(h) WHERE h:Helper OR h:Function OR h:Procedure
RETURN id(c) AS id, labels(c) AS labels, c {.*} AS props, inputs, id(b) AS output, h {.*} AS helper,
  'n' AS form ORDER BY id";

#[derive(Deserialize)]
struct ThesisFound {
    id: i64,
    #[serde(default)]
    labels: Vec<String>,
    props: Map<String, Value>,
}

#[derive(Deserialize)]
struct FoundConnector {
    #[serde(flatten)]
    found: ThesisFound,
    inputs: Vec<i64>,
    output: i64,
    helper: Option<Map<String, Value>>,
    /// `r` for a relationship, `n` for a node: their numbers may be the same.
    form: String,
}

/// Every program of a database that the thesis's environment wrote, in order of age.
///
/// # Errors
/// [`StoreError::Address`] for an address that cannot be understood, [`StoreError::Unavailable`] if the database cannot
/// be read.
pub async fn read_thesis(url: &str) -> Result<Vec<BehaviourFile>, StoreError> {
    let link = Neo4jConnections::new(&Neo4jAddress::read(url, &|name| std::env::var(name).ok())?, ANSWER_MAX)?;
    let programs: Vec<ThesisFound> = link.read(PROGRAMS, StatementParams::new()).await?;
    let mut files = Vec::new();
    for program in programs {
        let id = StatementParams::from_iter([("id".to_owned(), json!(program.id))]);
        let streams = link.read(STREAMS, id.clone()).await?;
        let mut connectors: Vec<FoundConnector> = link.read(SIMPLE, id.clone()).await?;
        connectors.extend(link.read::<FoundConnector>(NODES, id).await?);
        files.push(file(&program, &streams, &connectors));
    }
    Ok(files)
}

fn file(program: &ThesisFound, streams: &[ThesisFound], connectors: &[FoundConnector]) -> BehaviourFile {
    let names = free_names(streams);
    let mut helpers = BTreeMap::new();
    for helper in connectors.iter().filter_map(|connector| connector.helper.as_ref()) {
        let helper = file_helper(helper);
        helpers.insert(helper.name.clone(), helper);
    }
    let connectors = connectors.iter().filter_map(|connector| file_connector(connector, &names));
    BehaviourFile {
        format: FORMAT.to_owned(),
        id: None,
        name: text(&program.props, &["name", "title"]).unwrap_or_else(|| format!("Program {}", program.id)),
        robot: None,
        engine: None,
        exercise: None,
        tags: Vec::new(),
        helpers: helpers.into_values().collect(),
        streams: streams.iter().map(|stream| file_stream(stream, &names)).collect(),
        connectors: connectors.collect(),
        notes: Vec::new(),
        groups: Vec::new(),
        pad: None,
        order: BTreeMap::new(),
        layout: streams.iter().filter_map(place).collect(),
    }
}

/// The name of every stream; one that has none, or another's, gets a number.
fn free_names(streams: &[ThesisFound]) -> BTreeMap<i64, String> {
    let (mut names, mut used) = (BTreeMap::new(), BTreeSet::new());
    for stream in streams {
        let wanted = text(&stream.props, &["name", "title"]).unwrap_or_else(|| "Stream".to_owned());
        let name = numbered(&wanted, " ").find(|name| !used.contains(name));
        let name = name.unwrap_or(wanted);
        used.insert(name.clone());
        names.insert(stream.id, name);
    }
    names
}

fn stream_id(id: i64) -> String {
    format!("s{id}")
}

fn file_stream(stream: &ThesisFound, names: &BTreeMap<i64, String>) -> FileStream {
    let kind = kind(stream);
    let device = text(&stream.props, &["device", "sensor", "actuator", "class", "module"]);
    let name = names.get(&stream.id).cloned().unwrap_or_default();
    FileStream {
        id: stream_id(stream.id),
        kind,
        device: (kind != StreamKind::Ordinary).then(|| device.unwrap_or_else(|| name.clone())),
        name,
        params: None,
        resources: None,
        priority: None,
        hold_ms: None,
    }
}

fn kind(stream: &ThesisFound) -> StreamKind {
    let said = text(&stream.props, &["kind", "type"]);
    let words: Vec<String> = stream.labels.iter().chain(&said).map(|word| word.to_lowercase()).collect();
    let says = |kind: &str| words.iter().any(|word| word.contains(kind));
    match (says("sensor"), says("actuator")) {
        (true, _) => StreamKind::Sensor,
        (false, true) => StreamKind::Actuator,
        (false, false) => StreamKind::Ordinary,
    }
}

fn place(stream: &ThesisFound) -> Option<(String, behaviour::Place)> {
    let number = |names: [&str; 2]| names.iter().find_map(|name| stream.props.get(*name)?.as_f64());
    Some((stream_id(stream.id), behaviour::Place { x: number(["x", "left"])?, y: number(["y", "top"])? }))
}

fn file_connector(connector: &FoundConnector, names: &BTreeMap<i64, String>) -> Option<FileConnector> {
    let props = &connector.found.props;
    let said = text(props, &["type", "kind"]);
    let said = connector.found.labels.iter().chain(&said).find_map(|said| {
        let plain: String = said.chars().filter(char::is_ascii_alphabetic).collect();
        connectors::ALL.iter().find(|spec| spec.word.eq_ignore_ascii_case(&plain))
    })?;
    let takes_procedure = said.takes.procedure.is_some();
    let helper = connector.helper.as_ref().map(|helper| file_helper(helper).name);
    let body = text(props, &["body", "procedure", "code", "expression", "function"]).unwrap_or_default();
    let inputs = connector.inputs.iter().filter_map(|id| names.get(id)).map(String::as_str);
    let body = right_spelling(&body, &said.argument_names(inputs));
    let period = ["rate", "period", "periodMs", "period_ms", "interval", "ms"];
    let period_ms = period.iter().find_map(|name| props.get(*name)?.as_u64()).unwrap_or(connectors::PERIOD_MS);
    Some(FileConnector {
        id: format!("{}{}", connector.form, connector.found.id),
        operation: said.word.to_owned(),
        inputs: connector.inputs.iter().map(|id| stream_id(*id)).collect(),
        output: stream_id(connector.output),
        body: (takes_procedure && helper.is_none()).then_some(body),
        args: None,
        helper: helper.filter(|_| takes_procedure),
        period_ms: said.takes.period.map(|_| period_ms),
        start: None,
    })
}

/// The thesis's figures write `redball` where the argument of *Red ball* is `redBall`.
fn right_spelling(body: &str, arguments: &[String]) -> String {
    let spellings = shown_spellings(body, arguments);
    spellings.iter().fold(body.to_owned(), |body, (written, right)| behaviour::rename_identifier(&body, written, right))
}

fn file_helper(helper: &Map<String, Value>) -> FileHelper {
    let name = text(helper, &["name", "title"]).unwrap_or_else(|| "helper".to_owned());
    let params = ["params", "parameters", "args", "arguments"].iter().find_map(|key| match helper.get(*key)? {
        Value::Array(names) => Some(names.iter().filter_map(|name| name.as_str().map(str::to_owned)).collect()),
        Value::String(names) => Some(names.split(',').map(|name| name.trim().to_owned()).collect()),
        _ => None,
    });
    let params: Vec<String> = params.unwrap_or_default();
    let params = params.into_iter().filter(|name| !name.is_empty()).collect();
    let body = text(helper, &["body", "procedure", "code", "expression", "function"]).unwrap_or_default();
    let says = text(helper, &["description", "says"]).unwrap_or_default();
    FileHelper { name, params, body, says, ..FileHelper::default() }
}

/// The first of these properties that holds a text.
fn text(props: &Map<String, Value>, names: &[&str]) -> Option<String> {
    names.iter().find_map(|name| props.get(*name)?.as_str()).filter(|text| !text.trim().is_empty()).map(str::to_owned)
}
