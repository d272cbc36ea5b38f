//! The stand-in for a NAO on the real libqi, as a process of its own.

use crate::{Outcome, Trouble, paths, skip};
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};

/// A robot that is not one; it ends when this is dropped.
#[derive(Debug)]
pub struct StandIn {
    child: Child,
    address: String,
}

impl StandIn {
    /// Starts one with these words, unless there is no libqi, which is said by name as `part`.
    ///
    /// # Errors
    /// If it does not start.
    pub fn start(part: &str, words: &[&str]) -> Outcome<Option<Self>> {
        let python = std::env::var_os("RRP_QI_PYTHON").map(PathBuf::from).filter(|path| path.is_file());
        let missing = "there is no libqi; `cargo xtask qi` makes one, and RRP_QI_PYTHON names it";
        let Some(python) = python else {
            assert!(!skip::possible(part, Some(missing.to_owned())));
            return Ok(None);
        };
        let failed = |why: String| Trouble::from(format!("the stand-in does not start: {why}"));
        let mut command = Command::new(python);
        command.arg(paths::root().join("tests/standin/nao.py")).args(words);
        let child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = child.map_err(|error| failed(error.to_string()))?;
        let said = child.stdout.take().and_then(|out| BufReader::new(out).lines().next()).and_then(Result::ok);
        let address = said.as_deref().and_then(|line| line.strip_prefix("listening tcp://")).map(str::to_owned);
        match address {
            Some(address) => Ok(Some(Self { child, address })),
            None => {
                drop(child.kill());
                Err(failed(format!("it says {said:?}")))
            }
        }
    }

    /// Returns the address: `127.0.0.1:PORT`.
    #[must_use]
    pub fn address(&self) -> &str {
        &self.address
    }
}

impl Drop for StandIn {
    fn drop(&mut self) {
        let _already_gone = self.child.kill();
        let _ = self.child.wait();
    }
}
