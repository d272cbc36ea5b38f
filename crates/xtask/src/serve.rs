//! Builds the page and the server, and runs the server in the foreground.

use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

use crate::beside::CommandsBeside;
use crate::page::{self, PageMode};
use crate::tools::{self, SERVE_PROFILE, ToolResult, Workspace};

/// The package that people run: the one that carries the page.
const PROGRAM: &str = "rrp";
/// Leaves out what speaks to a Neo4j, a thirtieth of all that is compiled: who starts here keeps programs in a folder.
pub(crate) const WITHOUT_NEO4J: &str = "--no-default-features";

/// `words` are `[--dev] [--] ARGS`; ARGS go to `rrp serve` as they are.
pub(crate) fn run(workspace: &Workspace, words: &[&str]) -> ToolResult<()> {
    let (dev, rest) = match words {
        ["--dev", rest @ ..] => (true, rest),
        rest => (false, rest),
    };
    let arguments = rest.strip_prefix(&["--"]).unwrap_or(rest);
    let server = if dev { develop(workspace)? } else { optimise(workspace, wants_neo4j(arguments))? };
    println!("Starting {} serve {}", server.display(), arguments.join(" "));
    become_server(Command::new(server).arg("serve").args(arguments))
}

/// Becomes rrp as it was built last, as people run it or else for development, with these words.
pub(crate) fn program(workspace: &Workspace, words: &[&str]) -> ToolResult<()> {
    let built = [workspace.served(), workspace.server()].into_iter().find(|program| program.is_file());
    let program = built.ok_or("rrp is not built yet. Run `cargo xtask serve` first.")?;
    become_server(Command::new(program).args(words))
}

/// Builds what is quick to build, for trying an edit.
fn develop(workspace: &Workspace) -> ToolResult<PathBuf> {
    page::build(workspace, PageMode::Quick)?;
    println!("Building the server, not optimised.");
    tools::run(&mut workspace.cargo(&["build", "--package", "rrp"]), "Building the server")?;
    Ok(workspace.server())
}

/// True if the server is to keep its programs in a Neo4j.
fn wants_neo4j(arguments: &[&str]) -> bool {
    let store = std::env::var("RRP_STORE").ok();
    let is_neo4j = |word: &str| ["bolt", "neo4j"].iter().any(|scheme| word.contains(scheme)) && word.contains("://");
    arguments.iter().copied().chain(store.as_deref()).any(is_neo4j)
}

/// Builds what people use: the page beside the server, then the program with both in it. What speaks to a Neo4j is built
/// for those who have one.
fn optimise(workspace: &Workspace, neo4j: bool) -> ToolResult<PathBuf> {
    let began = Instant::now();
    let server = workspace.served();
    if server.is_file() {
        println!("Building what has changed of the page and the server.");
    } else {
        println!("Building the page and the server for the first time: six to twelve minutes on two cores.");
    }
    tools::ensure_wasm(workspace)?;
    let page = CommandsBeside::begin(vec![page::builder()?], workspace.target.join("page.txt"))?;
    let packages = packages(workspace)?;
    let cargo = |what: &[&str]| {
        let mut cargo = workspace.cargo(&["build", "--profile", SERVE_PROFILE]);
        cargo.args(packages.iter().flat_map(|package| ["--package", package])).args(what);
        cargo.args(if neo4j { [].as_slice() } else { &[WITHOUT_NEO4J] });
        cargo
    };
    tools::run(&mut cargo(&["--lib"]), "Building the server")?;
    println!("The server is built; {} s so far. The page follows.", began.elapsed().as_secs());
    page.wait()?;
    tools::run(&mut cargo(&["--bin", "rrp"]), "Building the server")?;
    println!("Built in {} s.", began.elapsed().as_secs());
    Ok(server)
}

/// The program and all it uses directly, selected together, so that everything but the program itself, with the page in it,
/// is built before the page is.
fn packages(workspace: &Workspace) -> ToolResult<Vec<String>> {
    let file = workspace.root.join("crates").join(PROGRAM).join("Cargo.toml");
    let text = fs::read_to_string(&file).map_err(|error| format!("{} cannot be read: {error}.", file.display()))?;
    let lines =
        text.lines().skip_while(|line| *line != "[dependencies]").skip(1).take_while(|line| !line.starts_with('['));
    let names = lines.filter_map(|line| line.split_once(" =")).map(|(name, _)| name.to_owned());
    Ok(names.chain([PROGRAM.to_owned()]).collect())
}

/// Turns this process into the server, so that Ctrl-C, other signals and the exit code are the server's own.
#[cfg(unix)]
fn become_server(server: &mut Command) -> ToolResult<()> {
    use std::os::unix::process::CommandExt;
    Err(format!("The server could not be started: {}.", server.exec()))
}

#[cfg(not(unix))]
fn become_server(server: &mut Command) -> ToolResult<()> {
    tools::run(server, "The server")
}

#[cfg(test)]
mod tests {
    use super::wants_neo4j;

    #[test]
    fn a_neo4j_is_built_for_who_names_one() {
        assert!(wants_neo4j(&["--store", "bolt://neo4j@127.0.0.1:7687"]) && wants_neo4j(&["--store=neo4j+s://h"]));
        assert!(!wants_neo4j(&["--data", "/srv/neo4j"]) && !wants_neo4j(&[]));
    }
}
