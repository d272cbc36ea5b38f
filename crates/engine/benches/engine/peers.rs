//! Others that run the same graphs: RxJS, RxPY and Node-RED, each as a process that takes an order a line.
//!
//! `cargo xtask bench engine` installs them and says where; without that they are left out by name.

use crate::bodies::in_js_and_python;
use crate::graphs::Graph;
use crate::verdict;
use behaviour::{BehaviourFile, argument_names};
use serde_json::{Value as Json, json};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// Name, the variable that says where it is installed, its script, and whether Node runs it.
const PEERS: [(&str, &str, &str, bool); 3] = [
    ("RxJS", "RRP_BENCH_RXJS", "rxjs.mjs", true),
    ("RxPY", "RRP_BENCH_RXPY", "rxpy.py", false),
    ("Node-RED", "RRP_BENCH_NODERED", "nodered.mjs", true),
];

/// One graph in another's hands.
pub(crate) struct Peer {
    pub(crate) name: &'static str,
    process: Child,
    orders: ChildStdin,
    answers: BufReader<ChildStdout>,
}

/// All that are installed, with the graph; says which are not.
pub(crate) fn all(graph: &Graph) -> Vec<Peer> {
    let file = write(graph);
    PEERS.iter().filter_map(|(name, place, script, node)| start(name, place, script, *node, &file)).collect()
}

/// Says once which are left out.
pub(crate) fn tell_missing() {
    for (name, place, ..) in PEERS.iter().filter(|(_, place, ..)| std::env::var_os(place).is_none()) {
        println!("SKIPPED by name: {name} ({place} does not say where it is; `cargo xtask bench engine` installs it)");
    }
}

fn start(name: &'static str, place: &str, script: &str, node: bool, graph: &Path) -> Option<Peer> {
    let place = std::env::var_os(place)?;
    let runs = if node { "node".into() } else { place };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers").join(script);
    let mut command = Command::new(runs);
    command.arg(script).arg(graph).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut process = command.spawn().unwrap();
    let (orders, answers) = (process.stdin.take().unwrap(), BufReader::new(process.stdout.take().unwrap()));
    Some(Peer { name, process, orders, answers })
}

impl Peer {
    /// Returns the answer to an order.
    fn ask(&mut self, order: &str) -> Json {
        writeln!(self.orders, "{order}").unwrap();
        let mut answer = String::new();
        self.answers.read_line(&mut answer).unwrap();
        serde_json::from_str(&answer).unwrap_or_else(|_| panic!("{} answers {answer:?} to {order}", self.name))
    }

    /// CPU time of so many events, in nanoseconds. It must hear as many values at the leaves as we do.
    pub(crate) fn run(&mut self, events: u64, expected: u64) -> u64 {
        let answer = self.ask(&format!("run {events} {expected}"));
        if answer["outputs"].as_u64() != Some(expected) {
            verdict::failed(format!("{} gives other outputs in {events} events", self.name));
        }
        answer["cpu_ns"].as_u64().unwrap().max(1)
    }

    /// Returns the values that each leaf hears of the first events.
    pub(crate) fn check(&mut self, events: u64) -> Json {
        self.ask(&format!("check {events}"))
    }

    /// Returns the time of each of so many events at one a millisecond, in nanoseconds.
    pub(crate) fn paced(&mut self, events: u64) -> Vec<f64> {
        serde_json::from_value(self.ask(&format!("paced {events}"))).unwrap()
    }

    pub(crate) fn id(&self) -> String {
        self.process.id().to_string()
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        // It may have ended by itself; then there is nothing to end.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Writes a graph for them: our file, with every procedure in their languages beside ours, and the readings.
fn write(graph: &Graph) -> PathBuf {
    let mut file = serde_json::to_value(&graph.file).unwrap();
    for helper in file["helpers"].as_array_mut().unwrap() {
        translate(helper);
    }
    for connector in file["connectors"].as_array_mut().unwrap() {
        if connector.get("args").is_none() {
            connector["args"] = arguments(&graph.file, &connector["inputs"]).into();
        }
        translate(connector);
    }
    file["leaves"] = json!(graph.leaves());
    file["readings"] = json!(graph.readings);
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}.json", graph.name));
    std::fs::write(&path, file.to_string()).unwrap();
    path
}

fn translate(of: &mut Json) {
    if let Some(body) = of["body"].as_str().map(str::to_owned) {
        let [js, python] = in_js_and_python(&body);
        of["js"] = js.into();
        of["py"] = python.into();
    }
}

fn arguments(file: &BehaviourFile, inputs: &Json) -> Vec<String> {
    let name = |id: &Json| file.streams.iter().find(|stream| *id == *stream.id).unwrap().name.as_str();
    argument_names(inputs.as_array().unwrap().iter().map(name))
}
