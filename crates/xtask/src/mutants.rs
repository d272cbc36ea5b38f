//! Deliberate faults of the editor, each put alone into a copy of the repository: its tests have to notice every one.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::tools::{ToolResult, Workspace, said};

/// The list of faults.
const LIST: &str = "crates/editor/mutants.txt";
/// The number of seeds that each is tried with, beside the scenes.
const SEEDS: &str = "60";

/// One fault.
#[derive(Debug, Default, PartialEq, Eq)]
struct Mutant {
    name: String,
    file: String,
    before: String,
    after: String,
}

/// Tries all faults whose name contains `filter`, says of each if it was noticed, and fails if one was not.
pub(crate) fn run(workspace: &Workspace, filter: &str) -> ToolResult<()> {
    let list = fs::read_to_string(workspace.root.join(LIST)).map_err(|error| format!("{LIST}: {error}."))?;
    let mutants: Vec<Mutant> = read(&list)?.into_iter().filter(|mutant| mutant.name.contains(filter)).collect();
    let copy = workspace.target.join("mutants");
    copy_into(workspace, &copy)?;
    if !passes(workspace, &copy)? {
        return Err("The tests of the editor fail without any fault.".to_owned());
    }
    let mut missed = Vec::new();
    for mutant in &mutants {
        let path = copy.join("crates/editor").join(&mutant.file);
        let whole = fs::read_to_string(&path).map_err(|error| format!("{}: {error}.", path.display()))?;
        write(&path, &mutant.put_into(&whole)?)?;
        let noticed = compiles(workspace, &copy)? && !passes(workspace, &copy)?;
        write(&path, &whole)?;
        println!("{}: {}", if noticed { "noticed" } else { "MISSED " }, mutant.name);
        if !noticed {
            missed.push(mutant.name.as_str());
        }
    }
    match missed.as_slice() {
        [] => {
            println!("All {} faults were noticed.", mutants.len());
            Ok(())
        }
        missed => Err(format!("Nothing noticed, or nothing compiled: {}.", missed.join("; "))),
    }
}

fn read(list: &str) -> ToolResult<Vec<Mutant>> {
    let mut all: Vec<Mutant> = Vec::new();
    for line in list.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        let (sign, rest) = line.split_once(' ').unwrap_or((line, ""));
        if sign == "==" {
            all.push(Mutant { name: rest.to_owned(), ..Mutant::default() });
            continue;
        }
        let mutant = all.last_mut().ok_or_else(|| format!("{LIST} begins without a name: {line}"))?;
        let into = match sign {
            "@" => {
                rest.clone_into(&mut mutant.file);
                continue;
            }
            "-" => &mut mutant.before,
            "+" => &mut mutant.after,
            _ => return Err(format!("{LIST} has a line that begins with nothing known: {line}")),
        };
        if !into.is_empty() {
            into.push('\n');
        }
        into.push_str(rest);
    }
    Ok(all)
}

impl Mutant {
    /// Returns a file with the fault in it.
    fn put_into(&self, whole: &str) -> ToolResult<String> {
        match whole.matches(&self.before).count() {
            1 => Ok(whole.replacen(&self.before, &self.after, 1)),
            times => Err(format!("What `{}` changes stands {times} times in {}.", self.name, self.file)),
        }
    }
}

/// Copies the files that git knows, as they are now.
fn copy_into(workspace: &Workspace, copy: &Path) -> ToolResult<()> {
    let listed = said(
        Command::new("git")
            .args(["ls-files", "--", "*.rs", "*.toml", "*.txt", "*.json", "Cargo.lock"])
            .current_dir(&workspace.root),
    );
    let listed = listed.ok_or("git does not list the files of the repository.")?;
    for file in listed.lines() {
        let (from, to) = (workspace.root.join(file), copy.join(file));
        let whole = fs::read(&from).map_err(|error| format!("{file}: {error}."))?;
        // What did not change keeps its time, so that it is not compiled again.
        if fs::read(&to).is_ok_and(|there| there == whole) {
            continue;
        }
        let folder = to.parent().ok_or_else(|| format!("{file} is in no folder."))?;
        fs::create_dir_all(folder).map_err(|error| format!("{}: {error}.", folder.display()))?;
        fs::write(&to, whole).map_err(|error| format!("{}: {error}.", to.display()))?;
    }
    Ok(())
}

fn write(path: &Path, text: &str) -> ToolResult<()> {
    fs::write(path, text).map_err(|error| format!("{}: {error}.", path.display()))
}

fn compiles(workspace: &Workspace, copy: &Path) -> ToolResult<bool> {
    test(workspace, copy, &["--no-run"])
}

fn passes(workspace: &Workspace, copy: &Path) -> ToolResult<bool> {
    test(workspace, copy, &[])
}

fn test(workspace: &Workspace, copy: &Path, more: &[&str]) -> ToolResult<bool> {
    let mut cargo = workspace.cargo(&["test", "-p", "editor", "--offline", "--quiet"]);
    cargo.args(more).current_dir(copy).env("CARGO_TARGET_DIR", copy.join("target")).env("RRP_EDITOR_SEEDS", SEEDS);
    cargo.stdout(Stdio::null()).stderr(Stdio::null());
    cargo.status().map(|status| status.success()).map_err(|error| format!("cargo could not be started: {error}."))
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn a_fault_is_put_where_it_is_meant_and_only_there() {
        let list = "# About\n\n== a fault\n@ src/a.rs\n-     one();\n-     two();\n+     one();\n";
        let [mutant] = read(list).unwrap().try_into().unwrap();
        assert_eq!((mutant.name.as_str(), mutant.file.as_str()), ("a fault", "src/a.rs"));
        assert_eq!(mutant.put_into("{\n    one();\n    two();\n}").unwrap(), "{\n    one();\n}");
        assert!(mutant.put_into("{}").is_err() && read("- x").is_err() && read("== a\n* x").is_err());
    }
}
