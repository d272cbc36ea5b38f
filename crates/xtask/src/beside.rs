//! Long builds beside the other checks: on two cores, what one of them cannot use the other does.

use std::fs::{self, File};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::tools::ToolResult;

/// The time between two looks whether a command has ended.
const LOOK: Duration = Duration::from_millis(100);

/// Commands that run one after the other; what they print goes into a file until they are waited for.
pub(crate) struct CommandsBeside {
    work: Option<JoinHandle<ToolResult<()>>>,
    running: Arc<Mutex<Running>>,
    said: PathBuf,
}

/// The command of the moment, and whether another may begin.
#[derive(Default)]
struct Running {
    child: Option<Child>,
    given_up: bool,
}

impl CommandsBeside {
    /// Begins with the first; the file of what they say is made anew.
    pub(crate) fn begin(commands: Vec<Command>, said: PathBuf) -> ToolResult<Self> {
        let unwritten = |error: std::io::Error| format!("{} cannot be written: {error}.", said.display());
        let file = File::create(&said).map_err(unwritten)?;
        let running = Arc::new(Mutex::new(Running::default()));
        let theirs = Arc::clone(&running);
        let work =
            std::thread::spawn(move || commands.into_iter().try_for_each(|command| run(command, &file, &theirs)));
        Ok(Self { work: Some(work), running, said })
    }

    /// Waits for all of them, and prints what they said.
    pub(crate) fn wait(mut self) -> ToolResult<()> {
        let ended = self.work.take().map(JoinHandle::join);
        print!("{}", fs::read_to_string(&self.said).unwrap_or_default());
        ended.unwrap_or(Ok(Ok(()))).unwrap_or_else(|_| Err("What runs beside failed inside.".to_owned()))
    }
}

/// Whoever gives up leaves nothing running.
impl Drop for CommandsBeside {
    fn drop(&mut self) {
        let mut running = self.running.lock().unwrap_or_else(PoisonError::into_inner);
        running.given_up = true;
        if let Some(child) = &mut running.child {
            let _already_gone = child.kill();
        }
    }
}

fn run(mut command: Command, said: &File, running: &Mutex<Running>) -> ToolResult<()> {
    let what = format!("`{command:?}`");
    let copy = || said.try_clone().map_err(|error| format!("{what} has nowhere to write: {error}."));
    command.stdin(Stdio::null()).stdout(copy()?).stderr(copy()?);
    let lock = || running.lock().unwrap_or_else(PoisonError::into_inner);
    {
        let mut running = lock();
        if running.given_up {
            return Ok(());
        }
        running.child = Some(command.spawn().map_err(|error| format!("{what} could not be started: {error}."))?);
    }
    loop {
        let ended = lock().child.as_mut().map(Child::try_wait).transpose();
        match ended.map(Option::flatten) {
            Ok(None) => std::thread::sleep(LOOK),
            Ok(Some(status)) if status.success() => return Ok(()),
            Ok(Some(status)) => {
                println!("== {what} failed ({status}); what it says is printed when it is waited for.");
                return Err(format!("{what} failed ({status}); what went wrong is printed above."));
            }
            Err(error) => return Err(format!("{what} cannot be waited for: {error}.")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(words: &str) -> Command {
        let mut command = Command::new("sh");
        command.args(["-c", words]);
        command
    }

    #[test]
    fn they_follow_one_another_and_end_at_the_first_that_fails() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let said = folder.path().join("said");
        let commands = vec![shell("echo one"), shell("echo two; exit 3"), shell("echo three")];
        let failed = CommandsBeside::begin(commands, said.clone())?.wait();
        assert!(failed.is_err_and(|sentence| sentence.contains("exit status: 3")));
        assert_eq!(fs::read_to_string(said)?, "one\ntwo\n");
        Ok(())
    }

    #[test]
    fn who_gives_up_leaves_nothing_running() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let said = folder.path().join("said");
        let late = folder.path().join("late");
        let commands = vec![shell("sleep 600"), shell(&format!("touch {}", late.display()))];
        let mut beside = CommandsBeside::begin(commands, said)?;
        let work = beside.work.take();
        drop(beside);
        drop(work.map(JoinHandle::join));
        assert!(!late.exists());
        Ok(())
    }
}
