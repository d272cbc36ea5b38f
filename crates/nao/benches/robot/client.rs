//! The Python client of libqi, as a process that does what it is told.

use serde_json::{Value as Json, json};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};

/// Ends when this is dropped.
pub(crate) struct Client {
    child: Child,
    said: BufReader<ChildStdout>,
}

impl Client {
    /// Connected to the stand-in at an address.
    pub(crate) fn at(address: &str) -> Self {
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/client.py");
        let mut command = Command::new(std::env::var_os("RRP_QI_PYTHON").unwrap());
        command.arg(script).arg(format!("tcp://{address}")).stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let said = BufReader::new(child.stdout.take().unwrap());
        Self { child, said }
    }

    fn told(&mut self, order: &Json) -> Json {
        writeln!(self.child.stdin.as_mut().unwrap(), "{order}").unwrap();
        let mut line = String::new();
        self.said.read_line(&mut line).unwrap();
        serde_json::from_str(&line).unwrap()
    }

    /// Returns how long each of so many calls took, in microseconds.
    pub(crate) fn calls(&mut self, what: &str, count: usize) -> Vec<f64> {
        let taken = self.told(&json!({"do": "calls", "what": what, "count": count}));
        taken.as_array().unwrap().iter().map(|taken| taken.as_f64().unwrap()).collect()
    }

    /// Calls for every touch from now on.
    pub(crate) fn react(&mut self, with: &str) {
        self.told(&json!({"do": "react", "with": with}));
    }

    pub(crate) fn rest(&mut self) {
        self.told(&json!({"do": "rest"}));
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        let _already_gone = self.child.kill();
        let _ = self.child.wait();
    }
}
