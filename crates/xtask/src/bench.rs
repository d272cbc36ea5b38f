//! Benchmarks that need more than cargo.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::neo4j;
use crate::qi_python;
use crate::tools::{self, ToolResult, Workspace};

/// Others that run the engine's graphs, at the versions that claims are made about.
const RXJS: &str = "rxjs@7.8.2";
const NODE_RED: &str = "node-red@4.1.15";
const RXPY: &str = "reactivex==6.1.0";

/// The test that measures the threads.
const MEASURE_THREADS: &str = "robots::tests::threads::hand_overs";

/// Measures rooms with many people, bad networks, kills, guessed links and floods of strangers on the optimised server, which is
/// built before; fails if a bar is missed or anything is lost. `words` pick a figure.
pub(crate) fn rooms(workspace: &Workspace, words: &[&str]) -> ToolResult<()> {
    tools::run(&mut workspace.cargo(&["build", "--release", "--package", "rrp"]), "Building the optimised server")?;
    let figures = words.first().map_or("figure_".to_owned(), |word| format!("figure_{word}"));
    let tests = ["test", "--release", "--package", "house", "--test", "rooms", "--test", "invitations", "--", &figures];
    let mut cargo = workspace.cargo(&tests);
    match neo4j::ensure(workspace) {
        Ok(folder) => drop(cargo.env("RRP_NEO4J", folder)),
        Err(sentence) => println!("SKIPPED by name: kills of a server on Neo4j ({sentence})"),
    }
    // One after the other: each has the computer to itself.
    cargo.args(["--ignored", "--nocapture", "--test-threads=1"]).env("RRP_OPTIMISED", workspace.released());
    tools::run(&mut cargo, "The benchmark of the rooms")
}

/// Measures the stores.
pub(crate) fn stores(workspace: &Workspace) -> ToolResult<()> {
    let mut cargo = workspace.cargo(&["bench", "--package", "store", "--bench", "stores"]);
    match neo4j::ensure(workspace) {
        Ok(folder) => drop(cargo.env("RRP_NEO4J", folder)),
        Err(sentence) => println!("SKIPPED by name: the benchmark of Neo4j ({sentence})"),
    }
    tools::run(&mut cargo, "The benchmark of stores")
}

/// Measures a robot over the link, against the stand-in and beside the Python client of libqi; `words` pick a part.
pub(crate) fn nao(workspace: &Workspace, words: &[&str]) -> ToolResult<()> {
    let python = match qi_python::ensure(workspace) {
        Ok(python) => python,
        Err(sentence) => {
            println!("SKIPPED by name: the benchmark of the robot ({sentence})");
            return Ok(());
        }
    };
    let mut cargo = workspace.cargo(&["bench", "--package", "nao", "--bench", "robot", "--"]);
    tools::run(cargo.args(words).env("RRP_QI_PYTHON", python), "The benchmark of the robot")
}

/// Measures how long typed sentences take to be read; a number says how many.
pub(crate) fn sentences(workspace: &Workspace, words: &[&str]) -> ToolResult<()> {
    let mut cargo = workspace.cargo(&["bench", "--package", "sentences", "--bench", "reader", "--"]);
    tools::run(cargo.args(words), "The benchmark of typed sentences")
}

/// Measures looking back at an hour.
pub(crate) fn past(workspace: &Workspace) -> ToolResult<()> {
    let mut cargo = workspace.cargo(&["bench", "--package", "past", "--bench", "hour"]);
    tools::run(&mut cargo, "The benchmark of looking back")
}

/// Measures how long a picture of a million values takes in a browser, on the optimised server with the small page.
pub(crate) fn lanes(workspace: &Workspace) -> ToolResult<()> {
    tools::run(&mut workspace.cargo(&["build", "--release", "--package", "rrp"]), "Building the optimised server")?;
    let test = ["test", "--package", "house", "--test", "hands", "--", "figure_lanes", "--ignored", "--nocapture"];
    tools::run(workspace.cargo(&test).env("RRP_OPTIMISED", workspace.released()), "The benchmark of lanes")
}

/// Measures the engine, how long runaway procedures hold it, and the hand-overs between the threads around it; `words`
/// pick a part.
pub(crate) fn engine(workspace: &Workspace, words: &[&str]) -> ToolResult<()> {
    match words {
        // All of them, also after a bar was missed.
        [] => [graphs(workspace, words), stalls(workspace), threads(workspace)].into_iter().collect(),
        ["stalls"] => stalls(workspace),
        ["threads"] => threads(workspace),
        _ => graphs(workspace, words),
    }
}

/// Measures how long runaway procedures hold a thread; fails beyond the bounds.
fn stalls(workspace: &Workspace) -> ToolResult<()> {
    let mut cargo = workspace.cargo(&["bench", "--package", "engine", "--bench", "stalls"]);
    tools::run(&mut cargo, "The benchmark of runaway procedures")
}

/// Measures the engine, beside the others that can be installed here; `words` go to the benchmark.
fn graphs(workspace: &Workspace, words: &[&str]) -> ToolResult<()> {
    let folder = |name: &str| workspace.target.join("bench").join(name);
    let others = [
        ("RxJS", "RRP_BENCH_RXJS", from_npm(RXJS, folder("rxjs"))),
        ("RxPY", "RRP_BENCH_RXPY", from_pypi(RXPY, &folder("rxpy"))),
        ("Node-RED", "RRP_BENCH_NODERED", from_npm(NODE_RED, folder("nodered"))),
    ];
    let mut cargo = workspace.cargo(&["bench", "--package", "engine", "--bench", "engine", "--"]);
    cargo.args(words);
    for (name, variable, place) in others {
        match place {
            Ok(place) => drop(cargo.env(variable, place)),
            Err(sentence) => println!("SKIPPED by name: the comparison with {name} ({sentence})"),
        }
    }
    tools::run(&mut cargo, "The benchmark of the engine")
}

/// Measures how long it takes from a sense over the threads to an action. It stands among the server's tests, since
/// the server shows its threads to nobody else.
fn threads(workspace: &Workspace) -> ToolResult<()> {
    let words = ["test", "--release", "--package", "server", "--lib", "--", "--exact", MEASURE_THREADS];
    let mut cargo = workspace.cargo(&words);
    tools::run(cargo.args(["--ignored", "--nocapture"]), "The benchmark of the threads")
}

/// A folder that has a package of npm, at a version.
fn from_npm(package: &str, folder: PathBuf) -> ToolResult<PathBuf> {
    let (name, version) = package.split_once('@').unwrap_or((package, ""));
    if is_installed(&folder.join("node_modules").join(name).join("package.json"), version) {
        return Ok(folder);
    }
    needs(&["node", "npm"])?;
    println!("Installing {package} in {}.", folder.display());
    let words = ["install", "--no-audit", "--no-fund", "--loglevel=error", "--prefix"];
    tools::run(Command::new("npm").args(words).arg(&folder).arg(package), "npm")?;
    Ok(folder)
}

/// True if a package.json is of that version.
fn is_installed(package: &Path, version: &str) -> bool {
    let said = std::fs::read_to_string(package).unwrap_or_default();
    said.contains(&format!("\"version\": \"{version}\""))
}

/// The Python of a folder of its own that has a package of PyPI, at a version.
fn from_pypi(package: &str, folder: &Path) -> ToolResult<PathBuf> {
    let python = folder.join("bin/python");
    let (name, version) = package.split_once("==").unwrap_or((package, ""));
    let ask = format!("import importlib.metadata as m; assert m.version({name:?}) == {version:?}");
    if tools::said(Command::new(&python).args(["-c", &ask])).is_some() {
        return Ok(python);
    }
    needs(&["python3"])?;
    println!("Installing {package} in {}.", folder.display());
    tools::run(Command::new("python3").args(["-m", "venv"]).arg(folder), "python3 -m venv")?;
    tools::run(Command::new(&python).args(["-m", "pip", "install", "--quiet", package]), "pip")?;
    Ok(python)
}

/// Refuses what needs a program that is not here.
fn needs(programs: &[&str]) -> ToolResult<()> {
    let missing = programs.iter().find(|program| tools::on_path(program).is_none());
    missing.map_or(Ok(()), |program| Err(format!("there is no {program} on PATH; install it")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_version_that_was_asked_for_is_installed() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let package = folder.path().join("package.json");
        assert!(!is_installed(&package, "7.8.2"));
        std::fs::write(&package, "{\n  \"name\": \"rxjs\",\n  \"version\": \"7.8.2\"\n}")?;
        assert!(is_installed(&package, "7.8.2") && !is_installed(&package, "7.8.1"));
        Ok(())
    }

    #[test]
    fn a_missing_program_is_named() {
        assert!(needs(&["no-such-program"]).is_err_and(|sentence| sentence.contains("no-such-program")));
    }
}
