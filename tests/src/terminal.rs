//! A server in a terminal of its own, which can be closed as a window is.

use std::ffi::CString;
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader};
use std::os::fd::OwnedFd;
use std::path::Path;
use std::process::{ExitStatus, Stdio};
use std::time::Duration;

use rustix::io::Errno;
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use tokio::process::{Child, Command};

use crate::{Outcome, Trouble, paths};

/// The longest time for the server to start or to end.
const PATIENCE: Duration = Duration::from_secs(30);
/// The words that the server prints once it accepts connections.
const READY: &str = "rrp is ready: ";

/// A way in which a terminal belongs to the server.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Terminal {
    /// It is told when that is closed, by SIGHUP.
    Own,
    /// It writes there and is told nothing, as where the shell in between was killed.
    Lent,
    /// It is told, and wants to hear nothing of it, as with `nohup`.
    Outlived,
}

/// A server whose terminal is open.
pub struct InTerminal {
    window: OwnedFd,
    child: Child,
    url: String,
}

impl InTerminal {
    /// Starts the server on the data folder `dir` and a free port, and waits until it is ready.
    pub async fn start(dir: &Path, terminal: Terminal) -> Outcome<InTerminal> {
        let (window, name) = window().map_err(std::io::Error::from)?;
        let mut command = match terminal {
            Terminal::Own => with_terminal(&["setsid", "--ctty"]),
            Terminal::Lent => Command::new(paths::server()),
            Terminal::Outlived => with_terminal(&["setsid", "--ctty", "sh", "-c", "trap '' HUP; exec \"$0\" \"$@\""]),
        };
        let end = || -> Outcome<Stdio> {
            use std::os::unix::fs::OpenOptionsExt;
            let flags = i32::try_from(OpenptFlags::NOCTTY.bits()).unwrap_or_default();
            Ok(OpenOptions::new()
                .read(true)
                .write(true)
                .custom_flags(flags)
                .open(name.to_string_lossy().as_ref())?
                .into())
        };
        command.args(["serve", "--listen", "127.0.0.1:0", "--data"]).arg(dir);
        command.stdin(end()?).stdout(end()?).stderr(end()?).kill_on_drop(true);
        let child = command.spawn().map_err(|error| Trouble::of("The server does not start", error))?;
        let screen = File::from(window.try_clone()?);
        let url = tokio::task::spawn_blocking(move || ready(screen));
        let url = tokio::time::timeout(PATIENCE, url).await;
        let url = url.map_err(|_| "The server was not ready in time.")?;
        let url = url.ok().flatten().ok_or("The server ended before it was ready.")?;
        Ok(InTerminal { window, child, url })
    }

    /// The address of the page, with a slash at the end.
    pub fn url(&self) -> &str {
        &self.url
    }

    /// Closes the terminal.
    pub fn close(self) -> Closed {
        let InTerminal { child, window, .. } = self;
        drop(window);
        Closed(child)
    }
}

/// A server whose terminal has gone.
pub struct Closed(Child);

impl Closed {
    /// The number of the process, while it runs.
    pub fn id(&self) -> Option<u32> {
        self.0.id()
    }

    /// Waits until it has ended.
    pub async fn ended(mut self) -> Outcome<ExitStatus> {
        match tokio::time::timeout(PATIENCE, self.0.wait()).await {
            Ok(status) => Ok(status?),
            Err(_) => Err(format!("The server did not end within {} s.", PATIENCE.as_secs()).into()),
        }
    }
}

/// A new terminal, and the name of its other end.
fn window() -> Result<(OwnedFd, CString), Errno> {
    let window = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC)?;
    grantpt(&window)?;
    unlockpt(&window)?;
    let name = ptsname(&window, Vec::new())?;
    Ok((window, name))
}

/// The server, started by these words.
fn with_terminal(words: &[&str]) -> Command {
    let mut command = Command::new(words[0]);
    command.args(&words[1..]).arg(paths::server());
    command
}

/// Reads the screen up to the line that says where the server is.
fn ready(screen: File) -> Option<String> {
    let lines = BufReader::new(screen).lines().map_while(Result::ok);
    lines.into_iter().find_map(|line| line.split_once(READY).map(|(_, url)| url.trim().to_owned()))
}
