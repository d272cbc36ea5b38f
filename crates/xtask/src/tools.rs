//! The places of things, the calls of other programs, and how a missing tool is found or installed.

use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A result whose error is a sentence for the person at the terminal.
pub(crate) type ToolResult<T> = Result<T, String>;

/// The target triple of the page.
pub(crate) const WASM: &str = "wasm32-unknown-unknown";

/// The profile of the server that people start: optimised where values pass, as little as may be elsewhere.
pub(crate) const SERVE_PROFILE: &str = "serve";

/// Names under which Chromium is looked for on PATH, best first. That without windows of its own, which Debian has too, needs
/// a fifth less for the same tests.
const CHROMIUM_NAMES: [&str; 4] = [WITHOUT_WINDOWS, "chromium", "chromium-browser", "google-chrome"];
const WITHOUT_WINDOWS: &str = "chromium-headless-shell";

/// The variables that an outer cargo sets for its child and that would confuse a nested one.
const OUTER_NAMES: [&str; 16] = [
    "CARGO_BUILD_RUSTFLAGS",
    "CARGO_BUILD_TARGET",
    "CARGO_CRATE_NAME",
    "CARGO_ENCODED_RUSTFLAGS",
    "CARGO_MAKEFLAGS",
    "CARGO_PRIMARY_PACKAGE",
    "HOST",
    "MAKEFLAGS",
    "MFLAGS",
    "NUM_JOBS",
    "OPT_LEVEL",
    "OUT_DIR",
    "PROFILE",
    "RUSTC_WORKSPACE_WRAPPER",
    "RUSTFLAGS",
    "TARGET",
];
const OUTER_PREFIXES: [&str; 4] = ["CARGO_CFG_", "CARGO_FEATURE_", "CARGO_MANIFEST_", "CARGO_PKG_"];

/// The folders of this repository.
pub(crate) struct Workspace {
    /// The folder that holds the root `Cargo.toml`.
    pub(crate) root: PathBuf,
    /// Cargo's target folder: `CARGO_TARGET_DIR`, else `target` in the root.
    pub(crate) target: PathBuf,
}

impl Workspace {
    /// Finds the repository that this program was built from.
    pub(crate) fn here() -> ToolResult<Workspace> {
        let manifest = env::var("CARGO_MANIFEST_DIR").unwrap_or_else(|_| env!("CARGO_MANIFEST_DIR").to_owned());
        let root = Path::new(&manifest).ancestors().nth(2).map(Path::to_path_buf);
        let root = root.filter(|root| root.join("Cargo.toml").is_file());
        let root = root.ok_or_else(|| format!("The repository is not where it was built, above {manifest}."))?;
        let target = env::var_os("CARGO_TARGET_DIR").filter(|dir| !dir.is_empty()).unwrap_or("target".into());
        Ok(Workspace { target: root.join(target), root })
    }

    /// The folder that holds the finished page.
    pub(crate) fn page(&self) -> PathBuf {
        self.target.join("page")
    }

    /// The development build of the server.
    pub(crate) fn server(&self) -> PathBuf {
        self.program("debug")
    }

    /// The build of the server that people run first.
    pub(crate) fn served(&self) -> PathBuf {
        self.program(SERVE_PROFILE)
    }

    /// The optimised build of the server, which is measured.
    pub(crate) fn released(&self) -> PathBuf {
        self.program("release")
    }

    /// The server as cargo builds it into the folder of a profile.
    fn program(&self, folder: &str) -> PathBuf {
        self.target.join(folder).join(format!("rrp{}", env::consts::EXE_SUFFIX))
    }

    /// Cargo, called in the root with `words`, free of what our own cargo left in the environment.
    pub(crate) fn cargo(&self, words: &[&str]) -> Command {
        let mut command = Command::new(env::var_os("CARGO").unwrap_or("cargo".into()));
        command.args(words).current_dir(&self.root);
        // What is built once has no use for what would make the next build quicker, and nobody steps through it: a panic says
        // its line without. That is gigabytes, and an eighth of the time to build the tests.
        if in_ci() {
            command.env("CARGO_INCREMENTAL", "0").env("CARGO_PROFILE_DEV_DEBUG", "none");
        }
        for (name, _) in env::vars_os() {
            if name.to_str().is_some_and(is_outer) {
                command.env_remove(name);
            }
        }
        command
    }
}

/// True if this is a run that nobody watches, on a machine of its own.
pub(crate) fn in_ci() -> bool {
    env::var("CI").is_ok_and(|value| value == "true")
}

/// Returns the free gigabytes on the disk that holds `folder`, where `df` can tell.
pub(crate) fn free_gigabytes(folder: &Path) -> Option<f64> {
    let printed = said(Command::new("df").args(["-P", "-k"]).arg(folder))?;
    let kilobytes: f64 = printed.lines().nth(1)?.split_whitespace().nth(3)?.parse().ok()?;
    Some(kilobytes / 1e6)
}

/// True if a nested cargo must not see the variable `name`.
fn is_outer(name: &str) -> bool {
    OUTER_NAMES.contains(&name) || OUTER_PREFIXES.iter().any(|prefix| name.starts_with(prefix))
}

/// Runs `command` with our own input and output; anything but success is an error that names it as `what`.
pub(crate) fn run(command: &mut Command, what: &str) -> ToolResult<()> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{what} failed ({status}); what went wrong is printed above.")),
        Err(error) => Err(format!("{what} could not be started: {error}.")),
    }
}

/// Returns the output of `command`, trimmed, when it succeeds.
pub(crate) fn said(command: &mut Command) -> Option<String> {
    let output = command.stderr(Stdio::null()).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

/// Makes sure that rustc can build for the browser, with rustup when it cannot yet.
pub(crate) fn ensure_wasm(workspace: &Workspace) -> ToolResult<()> {
    if has_wasm(workspace) {
        return Ok(());
    }
    println!("The Rust target {WASM} is missing; installing it with rustup.");
    let added = Command::new("rustup").args(["target", "add", WASM]).current_dir(&workspace.root).status();
    if added.is_ok_and(|status| status.success()) && has_wasm(workspace) {
        return Ok(());
    }
    Err(format!("The Rust target {WASM} is missing and could not be installed; run `rustup target add {WASM}`."))
}

fn has_wasm(workspace: &Workspace) -> bool {
    let mut rustc = Command::new("rustc");
    rustc.args(["--print", "target-libdir", "--target", WASM]).current_dir(&workspace.root);
    said(&mut rustc).is_some_and(|folder| Path::new(&folder).is_dir())
}

/// Finds Chromium: what `RRP_CHROMIUM` names, else the one without windows, installed where that is possible without asking,
/// else another on PATH.
pub(crate) fn ensure_chromium() -> Option<PathBuf> {
    if let Some(named) = env::var_os("RRP_CHROMIUM").filter(|path| !path.is_empty()) {
        return Some(PathBuf::from(named)).filter(|path| path.is_file());
    }
    if on_path(WITHOUT_WINDOWS).is_none() {
        install("A Chromium for tests", &[WITHOUT_WINDOWS]);
    }
    CHROMIUM_NAMES.iter().find_map(|name| on_path(name))
}

/// Finds a program of that name on PATH.
pub(crate) fn on_path(name: &str) -> Option<PathBuf> {
    env::split_paths(&env::var_os("PATH")?).map(|folder| folder.join(name)).find(|path| path.is_file())
}

/// True if there is a font with Japanese letters, as far as `fc-list` knows them.
pub(crate) fn has_japanese_font() -> bool {
    said(Command::new("fc-list").args([":lang=ja", "family"])).is_some_and(|fonts| !fonts.is_empty())
}

/// Installs Debian packages because `what` is missing, where that is possible without asking.
pub(crate) fn install(what: &str, packages: &[&str]) {
    if on_path("apt-get").is_none() {
        return;
    }
    let Some(mut words) = as_root() else { return };
    words.push("apt-get");
    println!("{what} is missing; installing {} with `{}`.", packages.join(" and "), words.join(" "));
    let steps = [vec!["update"], [&["install", "-y", "--no-install-recommends"], packages].concat()];
    for step in steps {
        let mut command = Command::new(words[0]);
        command.args(&words[1..]).args(step).env("DEBIAN_FRONTEND", "noninteractive");
        if let Err(sentence) = run(&mut command, "apt-get") {
            println!("{sentence}");
            return;
        }
    }
}

/// The words that make a command run as root: none for root, `sudo -n` where sudo asks no password.
fn as_root() -> Option<Vec<&'static str>> {
    if said(Command::new("id").arg("-u")).as_deref() == Some("0") {
        return Some(Vec::new());
    }
    said(Command::new("sudo").args(["-n", "true"])).map(|_| vec!["sudo", "-n"])
}

#[cfg(test)]
mod tests {
    use super::*;

    type Tested = Result<(), Box<dyn std::error::Error>>;

    #[test]
    fn a_nested_cargo_keeps_its_home_and_loses_the_flags() -> Tested {
        assert!(is_outer("RUSTFLAGS") && is_outer("CARGO_FEATURE_X") && is_outer("CARGO_MAKEFLAGS"));
        assert!(!is_outer("CARGO_HOME") && !is_outer("PATH") && !is_outer("CARGO_BUILD_JOBS"));
        Ok(())
    }

    #[test]
    fn this_repository_is_found() -> Tested {
        let here = Workspace::here()?;
        assert!(here.root.join("crates/xtask").is_dir());
        Ok(())
    }
}
