//! The real libqi for the tests of `qi`: a Python environment with the package of its makers, made once.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::tools::{self, ToolResult, Workspace};

/// Built, for each Python that there is one for; by its name, version and sums (Python 3.9 to 3.12 on x86_64 Linux).
const PACKAGE: &str = "qi==3.1.5 \
    --hash=sha256:3bc3902f8cd16a0490d8678be6912104f24f0578a072a8702bb62e3360b1d163 \
    --hash=sha256:6d62108438fac9363200254474990c6d212050fc0721e72ebaf3f157960e3598 \
    --hash=sha256:421d58a6f6a9e038d2dce5a68e293a69645aa50570313d5b96aa1dcf7c1ef259 \
    --hash=sha256:945623a872adbf40da29f848038a4b6015a6016785b37633d2f7e5241650c931\n";
/// The ones that it is built for, most common first.
const PYTHONS: [&str; 5] = ["python3", "python3.11", "python3.12", "python3.10", "python3.9"];

/// Makes `target/qi-python` unless it is up to date; answers with its Python, or with a sentence that says why there is
/// none.
pub(crate) fn ensure(workspace: &Workspace) -> ToolResult<PathBuf> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        return Err("libqi is built for Linux on x86_64 only.".to_owned());
    }
    let folder = workspace.target.join("qi-python");
    let (python, stamp) = (folder.join("bin/python"), folder.join("stamp"));
    if python.is_file() && fs::read_to_string(&stamp).is_ok_and(|found| found == PACKAGE) {
        return Ok(python);
    }
    let outer = outer()?;
    println!("Making a Python with libqi for the tests in {}.", folder.display());
    make(outer, &folder).or_else(|_| {
        tools::install("Python's venv", &["python3-venv"]);
        make(outer, &folder)
    })?;
    fs::write(&stamp, PACKAGE).map_err(|error| format!("{} cannot be written: {error}.", stamp.display()))?;
    Ok(python)
}

/// A Python of a version that there is a built libqi for.
fn outer() -> ToolResult<&'static str> {
    if found().is_none() {
        tools::install("Python", &["python3", "python3-venv"]);
    }
    found().ok_or_else(|| "libqi needs a Python from 3.9 to 3.12; install one.".to_owned())
}

fn found() -> Option<&'static str> {
    let ask = "import sys; sys.exit(not (3, 9) <= sys.version_info[:2] <= (3, 12))";
    PYTHONS.into_iter().find(|name| tools::said(Command::new(name).args(["-c", ask])).is_some())
}

fn make(outer: &str, folder: &Path) -> ToolResult<()> {
    tools::run(Command::new(outer).args(["-m", "venv", "--clear"]).arg(folder), "python3 -m venv")?;
    let wanted = folder.join("requirements.txt");
    fs::write(&wanted, PACKAGE).map_err(|error| format!("{} cannot be written: {error}.", wanted.display()))?;
    let mut pip = Command::new(folder.join("bin/python"));
    pip.args(["-m", "pip", "install", "--quiet", "--no-deps", "--only-binary", ":all:", "--require-hashes", "-r"]);
    tools::run(pip.arg(&wanted), "pip")
}
