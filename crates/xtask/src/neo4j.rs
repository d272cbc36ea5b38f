//! A real Neo4j for the tests: its parts from Maven and one small Java program that starts it, made once.

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::tools::{self, ToolResult, Workspace};

/// The files that it is made of, in `tests/neo4j`.
const SOURCES: [&str; 3] = ["pom.xml", "Neo4jIt.java", "neo4j.conf"];
/// The oldest Java that Neo4j 5 runs on.
const JAVA_MIN: u32 = 17;
/// The Debian packages that bring Java and Maven.
const PACKAGES: [&str; 2] = ["openjdk-17-jdk-headless", "maven"];
/// Raised when this program makes something else of the same sources.
const FORMAT: u32 = 2;
/// The file in which Java keeps the classes of a start, which is half of the work of the next one.
const CLASSES: &str = "classes.jsa";

/// Makes `target/neo4j`, with `lib/` and `neo4j.conf`, unless it is up to date; answers with that folder, or with
/// a sentence that says why there is none.
pub(crate) fn ensure(workspace: &Workspace) -> ToolResult<PathBuf> {
    let sources = workspace.root.join("tests/neo4j");
    let folder = workspace.target.join("neo4j");
    let stamp = folder.join("stamp");
    let wanted = fingerprint(&sources)?;
    if fs::read_to_string(&stamp).is_ok_and(|found| found == wanted) {
        return Ok(folder);
    }
    ensure_java()?;
    println!("Making a Neo4j for the tests in {}.", folder.display());
    make(&sources, &folder)?;
    fs::write(&stamp, wanted).map_err(|error| format!("{} cannot be written: {error}.", stamp.display()))?;
    Ok(folder)
}

/// One number for all that it is made of.
fn fingerprint(sources: &Path) -> ToolResult<String> {
    let mut hasher = DefaultHasher::new();
    FORMAT.hash(&mut hasher);
    for name in SOURCES {
        let path = sources.join(name);
        fs::read(&path).map_err(|error| format!("{} cannot be read: {error}.", path.display()))?.hash(&mut hasher);
    }
    Ok(format!("{:016x}", hasher.finish()))
}

fn make(sources: &Path, folder: &Path) -> ToolResult<()> {
    let failed = |error: std::io::Error| format!("{} cannot be written: {error}.", folder.display());
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(failed)?;
    }
    fs::create_dir_all(folder.join("classes")).map_err(failed)?;
    for name in SOURCES {
        fs::copy(sources.join(name), folder.join(name)).map_err(failed)?;
    }
    let step = |words: &[&str]| tools::run(Command::new(words[0]).args(&words[1..]).current_dir(folder), words[0]);
    step(&["mvn", "-q", "-B", "dependency:copy-dependencies", "-DoutputDirectory=lib", "-DincludeScope=runtime"])?;
    step(&["javac", "-cp", "lib/*", "-d", "classes", "Neo4jIt.java"])?;
    step(&["jar", "cf", "lib/neo4j-it.jar", "-C", "classes", "."])?;
    keep_classes(folder)
}

/// Starts it once, and keeps what Java has read by then of its many classes. It ends by itself: it has no input.
fn keep_classes(folder: &Path) -> ToolResult<()> {
    let archive = format!("-XX:ArchiveClassesAtExit={CLASSES}");
    let mut java = Command::new("java");
    java.args([
        "-XX:+UseSerialGC",
        "-XX:TieredStopAtLevel=1",
        &archive,
        "-cp",
        "lib/*",
        "Neo4jIt",
        "home",
        "neo4j.conf",
    ]);
    java.env("NEO4J_PASSWORD", "only for one start").current_dir(folder).stdin(Stdio::null()).stdout(Stdio::null());
    let ran = tools::run(java.stderr(Stdio::null()), "Neo4j's first start");
    let _ = fs::remove_dir_all(folder.join("home"));
    ran
}

/// Makes sure that Java and Maven are here, from Debian's packages where that is possible without asking.
fn ensure_java() -> ToolResult<()> {
    if missing().is_some() {
        tools::install("Java or Maven", &PACKAGES);
    }
    let why = |what| format!("{what}; install both with `apt-get install {}`.", PACKAGES.join(" "));
    missing().map_or(Ok(()), |what| Err(why(what)))
}

fn missing() -> Option<String> {
    let version = tools::said(Command::new("javac").arg("-version")).and_then(|said| java_version(&said));
    match version {
        None => return Some(format!("there is no Java {JAVA_MIN} with its compiler")),
        Some(old) if old < JAVA_MIN => return Some(format!("Java {old} is too old, Neo4j needs {JAVA_MIN}")),
        Some(_) => {}
    }
    tools::on_path("mvn").is_none().then(|| "there is no Maven".to_owned())
}

/// The number in `javac 17.0.15`.
fn java_version(said: &str) -> Option<u32> {
    said.strip_prefix("javac ")?.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_version_of_java_is_read() {
        assert_eq!(java_version("javac 17.0.15"), Some(17));
        assert_eq!(java_version("javac 21-ea"), Some(21));
        assert_eq!(java_version("bash: javac: not found"), None);
    }

    #[test]
    fn every_source_counts() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let mut seen = Vec::new();
        for name in SOURCES {
            fs::write(folder.path().join(name), "one")?;
        }
        seen.push(fingerprint(folder.path())?);
        for name in SOURCES {
            fs::write(folder.path().join(name), "two")?;
            seen.push(fingerprint(folder.path())?);
        }
        let all = seen.len();
        seen.sort();
        seen.dedup();
        assert_eq!(seen.len(), all);
        Ok(())
    }
}
