//! The stand-in for a NAO on the real libqi, as a process of its own.

use crate::{Outcome, Trouble, paths, skip};
use qi::{Session, SessionOptions};
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// The longest wait until it is as a test wants, and the pause between two looks.
const PATIENCE: Duration = Duration::from_secs(30);
const PAUSE: Duration = Duration::from_millis(20);

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

    async fn asked(&self, method: &str, words: &[qi::Value]) -> Outcome<String> {
        let failed = |why: qi::QiError| Trouble::from(format!("the stand-in does not answer: {why}"));
        let address = format!("tcp://{}", self.address).parse().map_err(failed)?;
        let session = Session::connect(&address, SessionOptions::default()).await.map_err(failed)?;
        let own = session.service("StandIn").await.map_err(failed)?;
        let said = own.call(method, words).await.map_err(failed)?;
        session.link().close();
        Ok(said.as_text().unwrap_or_default().into_owned())
    }

    /// Changes its world, as JSON.
    ///
    /// # Errors
    /// If it does not do it.
    pub async fn world(&self, change: &str) -> Outcome<()> {
        self.asked("world", &[change.into()]).await.map(drop)
    }

    /// Returns its state, as JSON.
    ///
    /// # Errors
    /// If it does not say it.
    pub async fn state(&self) -> Outcome<String> {
        self.asked("state", &[]).await
    }

    /// Waits until it is so.
    ///
    /// # Errors
    /// If that does not come about.
    pub async fn until(&self, what: &str, is_so: impl Fn(&str) -> bool) -> Outcome<()> {
        self.says("state", what, is_so).await
    }

    /// Waits until a method of it was called.
    ///
    /// # Errors
    /// If nobody calls it.
    pub async fn until_called(&self, service: &str, method: &str) -> Outcome<()> {
        let calls = |said: &str| {
            let calls: serde_json::Value = serde_json::from_str(said).unwrap_or_default();
            let is_it = |call: &serde_json::Value| call["service"] == service && call["method"] == method;
            calls.as_array().is_some_and(|calls| calls.iter().any(is_it))
        };
        self.says("calls", &format!("{service}.{method} is called"), calls).await
    }

    async fn says(&self, asked: &str, what: &str, is_so: impl Fn(&str) -> bool) -> Outcome<()> {
        let end = Instant::now() + PATIENCE;
        while !is_so(&self.asked(asked, &[]).await?) {
            if Instant::now() > end {
                return Err(Trouble::from(format!("never: {what}")));
            }
            tokio::time::sleep(PAUSE).await;
        }
        Ok(())
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
