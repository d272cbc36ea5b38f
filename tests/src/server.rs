//! A real server process on a folder of data, that can be ended politely or not, and started again.

use std::fs::OpenOptions;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::{Duration, Instant};

use tokio::io::{AsyncBufReadExt, BufReader, Lines};
use tokio::process::{Child, ChildStdout, Command};

use crate::{Outcome, Trouble, paths};

/// The longest time for the server to start or to end.
const PATIENCE: Duration = Duration::from_secs(30);
/// Between two looks at the log.
const LOOK: Duration = Duration::from_millis(25);
/// The words that the server prints once it accepts connections.
const READY: &str = "rrp is ready: ";
/// Lines of the log shown in a failure.
const LOG_LINES: usize = 30;

/// A running server; it is killed when this value is dropped.
pub struct Server {
    child: Option<Child>,
    binary: PathBuf,
    data: PathBuf,
    arguments: Vec<String>,
    url: String,
}

impl Server {
    /// Starts the server on the data folder `dir` and a free port, and waits until it is ready.
    pub async fn start(dir: &Path) -> Outcome<Server> {
        Server::start_with(dir, &[]).await
    }

    /// Starts it as `start` does, with more words for `rrp serve`; with `--store` among them the folder is the one
    /// beside that store.
    pub async fn start_with(dir: &Path, arguments: &[&str]) -> Outcome<Server> {
        Server::start_binary(&paths::server(), dir, arguments).await
    }

    /// Starts it as `start_with` does, with another binary than the one that was built last.
    pub async fn start_binary(binary: &Path, dir: &Path, arguments: &[&str]) -> Outcome<Server> {
        std::fs::create_dir_all(dir)?;
        let (binary, data) = (binary.to_path_buf(), dir.to_path_buf());
        let arguments = arguments.iter().map(|word| (*word).to_owned()).collect();
        let mut server = Server { child: None, binary, data, arguments, url: String::new() };
        server.spawn("127.0.0.1:0").await?;
        Ok(server)
    }

    /// The address of the page, with a slash at the end.
    pub fn url(&self) -> String {
        self.url.clone()
    }

    /// The address and port alone, as in `127.0.0.1:7130`.
    pub fn address(&self) -> &str {
        self.url.trim_start_matches("http://").trim_end_matches('/')
    }

    /// The number of the process, while it runs.
    pub fn id(&self) -> Option<u32> {
        self.child.as_ref().and_then(Child::id)
    }

    /// Everything the server said on standard error, over all its starts.
    pub fn log(&self) -> String {
        std::fs::read_to_string(self.log_path()).unwrap_or_default()
    }

    /// Waits until a line of the log holds `word`, and answers with that line.
    pub async fn said(&self, word: &str) -> Outcome<String> {
        let began = Instant::now();
        loop {
            if let Some(line) = self.log().lines().find(|line| line.contains(word)) {
                return Ok(line.to_owned());
            }
            if began.elapsed() > PATIENCE {
                return Err(self.trouble(&format!("The server did not say `{word}` within {} s", PATIENCE.as_secs())));
            }
            tokio::time::sleep(LOOK).await;
        }
    }

    /// Ends the server as a power cut would (`kill -9`).
    pub async fn kill9(&mut self) -> Outcome<()> {
        let mut child = self.child.take().ok_or("The server is not running.")?;
        Ok(child.kill().await?)
    }

    /// Asks the server to end (SIGTERM); it must do so with the exit code 0.
    pub async fn terminate(&mut self) -> Outcome<()> {
        self.end_by("TERM").await
    }

    /// Asks the server to end by this signal; it must do so with the exit code 0.
    pub async fn end_by(&mut self, name: &str) -> Outcome<()> {
        let mut child = self.child.take().ok_or("The server is not running.")?;
        signal(child.id(), name).await?;
        match tokio::time::timeout(PATIENCE, child.wait()).await {
            Ok(Ok(status)) if status.success() => Ok(()),
            Ok(Ok(status)) => Err(self.trouble(&format!("The server ended with {status}"))),
            Ok(Err(error)) => Err(error.into()),
            Err(_) => Err(self.trouble(&format!("The server did not end within {} s", PATIENCE.as_secs()))),
        }
    }

    /// Starts the server again on the same data and port; one that still runs is killed first.
    pub async fn restart(&mut self) -> Outcome<()> {
        if self.child.is_some() {
            self.kill9().await?;
        }
        let address = self.address().to_owned();
        self.spawn(&address).await
    }

    async fn spawn(&mut self, listen: &str) -> Outcome<()> {
        let log = OpenOptions::new().create(true).append(true).open(self.log_path())?;
        let mut command = Command::new(&self.binary);
        command.args(["serve", "--listen", listen, "--data"]).arg(&self.data);
        command.args(&self.arguments);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(log).kill_on_drop(true);
        let what = format!("{} does not start", self.binary.display());
        let mut child = command.spawn().map_err(|error| Trouble::of(&what, error))?;
        let words = child.stdout.take().ok_or("The server has no standard output.")?;
        let mut lines = BufReader::new(words).lines();
        let ready = tokio::time::timeout(PATIENCE, ready(&mut lines)).await;
        self.url = match ready {
            Ok(Some(url)) => url,
            Ok(None) => return Err(self.trouble("The server ended before it was ready")),
            Err(_) => return Err(self.trouble(&format!("The server was not ready within {} s", PATIENCE.as_secs()))),
        };
        tokio::spawn(async move { while let Ok(Some(_)) = lines.next_line().await {} });
        self.child = Some(child);
        Ok(())
    }

    fn log_path(&self) -> PathBuf {
        self.data.join("server.log")
    }

    /// A trouble with the end of the log.
    fn trouble(&self, sentence: &str) -> Trouble {
        let log = self.log();
        let lines: Vec<&str> = log.lines().collect();
        let last = &lines[lines.len().saturating_sub(LOG_LINES)..];
        Trouble(format!("{sentence}; its log ends with:\n{}", last.join("\n")))
    }
}

/// Sends a signal to a process that runs.
pub async fn signal(process: Option<u32>, name: &str) -> Outcome<()> {
    let process = process.ok_or("The process had ended already.")?;
    Command::new("kill").args([&format!("-{name}"), &process.to_string()]).status().await?;
    Ok(())
}

/// Reads lines up to the one that says where the server is.
async fn ready(lines: &mut Lines<BufReader<ChildStdout>>) -> Option<String> {
    while let Ok(Some(line)) = lines.next_line().await {
        if let Some(url) = line.strip_prefix(READY) {
            return Some(url.trim().to_owned());
        }
    }
    None
}
