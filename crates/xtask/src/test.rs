//! Every check of the house, step by step; the same on a laptop and in CI.

use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::time::{Duration, Instant};

use crate::beside::CommandsBeside;
use crate::neo4j;
use crate::page;
use crate::qi_python;
use crate::serve;
use crate::supply;
use crate::tools::{self, SERVE_PROFILE, ToolResult, Workspace};

/// The packages that are optimised: the server as people run it, which is attacked, and the hostile corpus, as stacks,
/// overflows and comparisons differ between debug and release. Selected together, so that what both use is compiled
/// once.
const OPTIMISED: [&str; 9] =
    ["--profile", SERVE_PROFILE, serve::WITHOUT_NEO4J, "--package", "rrp", "--package", "engine", "--test", "hostile"];
/// The module that one of the last tests compares with the native build: in its own folder, as that test builds it.
const MODULE: [&str; 8] =
    ["build", "--quiet", "--release", "--package", "house-wasm", "--lib", "--target", tools::WASM];
/// All but this program and what it alone uses: cargo chooses the features of libraries for all that is selected together, so
/// that with them many that they were built with just now would be built once more, with features that only others want.
const ALL_BUT_THIS: [&str; 5] = ["--workspace", "--exclude", THIS, "--exclude", ITS_OWN];
/// This program and what it alone uses, as they were built to run this.
const THIS_AND_ITS_OWN: [&str; 6] = ["--package", THIS, "--package", ITS_OWN, "--profile", THIS];
const THIS: &str = "xtask";
const ITS_OWN: &str = "compression";
const HOW_TO_GET_CHROMIUM: &str =
    "install it with `apt-get install chromium-headless-shell`, or name another one in the variable RRP_CHROMIUM";

/// The gigabytes that all of it takes on the disk when nothing was built before.
const WANTED_GIGABYTES: u32 = 9;

/// The number of tests whose times are told.
const SLOWEST: usize = 10;

/// One named check.
type NamedCheck = (&'static str, fn(&mut TestRun) -> ToolResult<()>);

const STEPS: [NamedCheck; 11] = [
    ("tools", find_tools_and_begin),
    ("a Neo4j for the tests", find_neo4j),
    ("libqi for the tests", find_libqi),
    ("cargo fmt", |run| run.cargo(&["fmt", "--all", "--check"])),
    ("what we take from others", check_supply),
    ("the server and the tests", |run| run.cargo(&[&["test", "--no-run"], ALL_BUT_THIS.as_slice()].concat())),
    ("the page, the optimised server and a module", |run| run.beside.take().map_or(Ok(()), CommandsBeside::wait)),
    ("hostile procedures, optimised", |run| run.cargo(&[&["test"], OPTIMISED.as_slice()].concat())),
    ("cargo clippy", |run| run.cargo(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"])),
    ("cargo doc, and the tests of this program", check_documents_and_build_the_rest),
    ("cargo test", |run| run.tests(&[])),
];

/// A run through the checks, and what it found on the way.
struct TestRun<'a> {
    workspace: &'a Workspace,
    chromium: Option<PathBuf>,
    neo4j: Option<PathBuf>,
    /// A Python that has the real libqi.
    libqi: Option<PathBuf>,
    beside: Option<CommandsBeside>,
    skipped: Vec<String>,
}

/// Runs every check and stops at the first that fails.
pub(crate) fn all(workspace: &Workspace) -> ToolResult<()> {
    let started = Instant::now();
    let mut run = TestRun::on(workspace);
    tell_disk(workspace);
    for (number, (name, check)) in STEPS.iter().enumerate() {
        let began = Instant::now();
        println!("\n== {} of {}: {name}", number + 1, STEPS.len());
        let result = check(&mut run);
        println!("-- {name}: {} after {}", if result.is_ok() { "good" } else { "FAILED" }, seconds(began.elapsed()));
        if result.is_err() {
            tell_disk(workspace);
        }
        result.map_err(|sentence| format!("step {} ({name}): {sentence}", number + 1))?;
    }
    println!("\nAll {} steps are good, in {}.", STEPS.len(), seconds(started.elapsed()));
    tell_skipped(&run.skipped);
    Ok(())
}

/// Runs only the tests whose name contains `filter`, with the page and the server as they were last built.
pub(crate) fn only(workspace: &Workspace, filter: &str) -> ToolResult<()> {
    let mut run = TestRun::on(workspace);
    make_ready(workspace)?;
    find_tools(&mut run)?;
    find_neo4j(&mut run)?;
    find_libqi(&mut run)?;
    run.tests(&[filter])?;
    tell_skipped(&run.skipped);
    Ok(())
}

impl<'a> TestRun<'a> {
    fn on(workspace: &'a Workspace) -> Self {
        TestRun { workspace, chromium: None, neo4j: None, libqi: None, beside: None, skipped: Vec::new() }
    }

    /// Returns the place of a part that `tests` need; without it they are skipped by name, but never in CI.
    fn made(&mut self, made: ToolResult<PathBuf>, part: &str, tests: &str) -> ToolResult<Option<PathBuf>> {
        match made {
            Ok(place) => {
                println!("{part} is at {}.", place.display());
                Ok(Some(place))
            }
            Err(why) if tools::in_ci() => Err(format!("CI needs {part} for the {tests}: {why}")),
            Err(why) => {
                self.skip(format!("{tests} ({})", why.trim_end_matches('.')));
                Ok(None)
            }
        }
    }

    fn cargo(&mut self, words: &[&str]) -> ToolResult<()> {
        tools::run(&mut self.workspace.cargo(words), &format!("`cargo {}`", words.join(" ")))
    }

    fn skip(&mut self, part: String) {
        println!("SKIPPED by name: {part}");
        self.skipped.push(part);
    }

    /// Runs the tests and gathers the names of those that skipped themselves.
    fn tests(&mut self, more: &[&str]) -> ToolResult<()> {
        let list = self.workspace.target.join("skipped.txt");
        let times = self.workspace.target.join("times.txt");
        [&list, &times].into_iter().for_each(|file| drop(fs::remove_file(file)));
        let results = [ALL_BUT_THIS.as_slice(), &THIS_AND_ITS_OWN].map(|packages| {
            let words = [&["test", "--no-fail-fast"], packages].concat();
            let mut cargo = self.workspace.cargo(&words);
            cargo.args(more).env("RRP_SKIPPED_LIST", &list).env("RRP_TIMES_LIST", &times);
            self.show_parts(&mut cargo);
            tools::run(&mut cargo, &format!("`cargo {}`", words.join(" ")))
        });
        tell_slowest(&fs::read_to_string(&times).unwrap_or_default());
        self.skipped.extend(fs::read_to_string(&list).unwrap_or_default().lines().map(str::to_owned));
        results.into_iter().collect()
    }

    /// Tells the tests where the browser, the server, Neo4j and libqi are.
    fn show_parts(&self, cargo: &mut Command) {
        let server = self.workspace.server();
        if let Some(chromium) = &self.chromium {
            cargo.env("RRP_CHROMIUM", chromium);
        }
        if let Some(neo4j) = &self.neo4j {
            cargo.env("RRP_NEO4J", neo4j);
        }
        if let Some(libqi) = &self.libqi {
            cargo.env("RRP_QI_PYTHON", libqi);
        }
        if server.is_file() {
            cargo.env("RRP_BIN", server).env("RRP_TOOLS_READY", "1");
        }
        cargo.env("RRP_OPTIMISED", self.workspace.served());
    }
}

/// The page is built beside the other checks, after it the server that carries it, and then what one of the tests would build
/// alone. What is installed comes meanwhile.
fn find_tools_and_begin(run: &mut TestRun) -> ToolResult<()> {
    make_ready(run.workspace)?;
    let workspace = run.workspace;
    let optimised = workspace.cargo(&[&["build", "--bin", "rrp"], OPTIMISED.as_slice()].concat());
    let folder = workspace.target.join("tmp/wasm").display().to_string();
    let module = workspace.cargo(&[MODULE.as_slice(), &["--target-dir", &folder]].concat());
    let commands = vec![page::builder()?, optimised, module];
    run.beside = Some(CommandsBeside::begin(commands, workspace.target.join("beside.txt"))?);
    find_tools(run)
}

/// Makes sure that the page can be compiled, and makes its folder, which the server's code names at compile time.
fn make_ready(workspace: &Workspace) -> ToolResult<()> {
    tools::ensure_wasm(workspace)?;
    let page = workspace.page();
    fs::create_dir_all(&page).map_err(|error| format!("{} cannot be made: {error}.", page.display()))
}

/// Checks what is documented, and builds the tests of this program. Nothing is compiled once tests run: a browser that has to
/// share two cores with a compiler is slower by chance.
fn check_documents_and_build_the_rest(run: &mut TestRun) -> ToolResult<()> {
    let mut documents = run.workspace.cargo(&["doc", "--workspace", "--no-deps"]);
    tools::run(documents.env("RUSTDOCFLAGS", "-D warnings"), "`cargo doc --workspace --no-deps`")?;
    run.cargo(&[&["test", "--no-run"], THIS_AND_ITS_OWN.as_slice()].concat())
}

/// Looks for the browser and for what single tests need.
fn find_tools(run: &mut TestRun) -> ToolResult<()> {
    // The XSD of behaviour files is tried with it; its test says so if it is not to be had.
    if tools::on_path("xmllint").is_none() {
        tools::install("xmllint", &["libxml2-utils"]);
    }
    // What the page looks like in Japanese is looked at with it; those tests say so if it is not to be had.
    if !tools::has_japanese_font() {
        tools::install("A Japanese font", &["fontconfig", "fonts-vlgothic"]);
    }
    run.chromium = tools::ensure_chromium();
    match &run.chromium {
        Some(path) => println!("Chromium is {}.", path.display()),
        None if tools::in_ci() => {
            return Err(format!("CI needs Chromium for the browser journeys; {HOW_TO_GET_CHROMIUM}."));
        }
        None => run.skip(format!("browser journeys (no Chromium; {HOW_TO_GET_CHROMIUM})")),
    }
    Ok(())
}

/// Makes the Neo4j that the tests of its store start.
fn find_neo4j(run: &mut TestRun) -> ToolResult<()> {
    let made = neo4j::ensure(run.workspace);
    run.neo4j = run.made(made, "Neo4j", "tests of the Neo4j store")?;
    Ok(())
}

/// Makes the Python with the real libqi that the tests of `qi` talk to.
fn find_libqi(run: &mut TestRun) -> ToolResult<()> {
    let made = qi_python::ensure(run.workspace);
    run.libqi = run.made(made, "libqi", "tests with the real libqi")?;
    Ok(())
}

fn check_supply(run: &mut TestRun) -> ToolResult<()> {
    match supply::check(run.workspace)? {
        Some(part) => run.skip(part),
        None => println!("Licences, sources, doubles and advisories are as .deny.toml wants them."),
    }
    Ok(())
}

/// Tells the free space, and the space that is wanted where nothing was built yet.
fn tell_disk(workspace: &Workspace) {
    let _ = fs::create_dir_all(&workspace.target);
    if let Some(free) = tools::free_gigabytes(&workspace.target) {
        println!(
            "{free:.1} GB are free for {}; a first run takes about {WANTED_GIGABYTES}.",
            workspace.target.display()
        );
    }
}

/// Tells which of the tests that need a browser or a server took longest.
fn tell_slowest(times: &str) {
    let slowest = slowest(times);
    if !slowest.is_empty() {
        println!("The slowest tests with a browser or a server, in seconds:");
        slowest.iter().for_each(|(seconds, name)| println!("  {seconds:>7.1}  {name}"));
    }
}

/// Returns the slowest of the tests in a list of lines of seconds and a name, the slowest first.
fn slowest(times: &str) -> Vec<(f64, &str)> {
    let read = |line| str::split_once(line, ' ').and_then(|(seconds, name)| Some((seconds.parse().ok()?, name)));
    let mut all: Vec<(f64, &str)> = times.lines().filter_map(read).collect();
    all.sort_by(|one, other| other.0.total_cmp(&one.0));
    all.truncate(SLOWEST);
    all
}

fn tell_skipped(skipped: &[String]) {
    let mut skipped = skipped.to_vec();
    skipped.sort();
    skipped.dedup();
    match skipped.len() {
        0 => println!("Nothing was skipped."),
        _ => println!("SKIPPED by name:\n  {}", skipped.join("\n  ")),
    }
}

fn seconds(time: Duration) -> String {
    format!("{:.1} s", time.as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::{SLOWEST, slowest};

    #[test]
    fn the_slowest_come_first_and_ten_are_enough() {
        let times = "2.5 late\nno time\n10.0 looks::all screens\n".to_owned() + &"1.0 quick\n".repeat(20);
        let told = slowest(&times);
        assert_eq!((told.len(), told[0], told[1]), (SLOWEST, (10.0, "looks::all screens"), (2.5, "late")));
        assert!(slowest("").is_empty());
    }
}
