//! Reading the pages for engineers roughly, for the tests that hold them to the code: their tables, and what they name.

use std::collections::BTreeSet;

use crate::{Outcome, Trouble};

/// The map of the code.
pub const ARCHITECTURE: &str = "crates/ARCHITECTURE.md";
/// The page about what is tried where.
pub const TESTING: &str = "tests/TESTING.md";
/// The page about the files that a new thing touches.
pub const ADDING: &str = "crates/ADDING.md";

/// Endings of names of files that are taken for paths without a folder before them.
const ENDINGS: [&str; 9] = [".css", ".html", ".js", ".json", ".md", ".py", ".rs", ".toml", ".txt"];
/// The one folder that is named and never in a commit.
const MADE: &str = "target/";

/// One of these pages.
pub struct Guide {
    /// The path below the root.
    pub path: &'static str,
    /// The text as it is.
    pub text: String,
}

/// A row of a table, cell by cell.
pub type Row = Vec<String>;

impl Guide {
    /// Reads one of them.
    pub fn read(path: &'static str) -> Outcome<Self> {
        let text = std::fs::read_to_string(crate::root().join(path))?;
        Ok(Self { path, text })
    }

    /// The rows of the first table below the heading that contains `heading`, without the row of names.
    pub fn table(&self, heading: &str) -> Outcome<Vec<Row>> {
        let mut lines = self.text.lines().skip_while(|line| !(line.starts_with('#') && line.contains(heading)));
        lines.next().ok_or_else(|| Trouble(format!("{} has no heading with {heading}.", self.path)))?;
        let below = lines.take_while(|line| !line.starts_with('#')).skip_while(|line| !line.starts_with('|'));
        let table: Vec<&str> = below.take_while(|line| line.starts_with('|')).collect();
        match table.get(2..) {
            Some(rows) if !rows.is_empty() => Ok(rows.iter().map(|row| cells(row)).collect()),
            _ => Err(Trouble(format!("{} has no table below {heading}.", self.path))),
        }
    }

    /// The headings below which a table stands.
    pub fn headings_of_tables(&self) -> Vec<&str> {
        let (mut found, mut heading) = (Vec::new(), "");
        for line in self.text.lines() {
            if line.starts_with('#') {
                heading = line;
            } else if line.starts_with('|') && found.last() != Some(&heading) {
                found.push(heading);
            }
        }
        found
    }
}

fn cells(row: &str) -> Row {
    row.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect()
}

/// Everything in `text` that is marked as code.
pub fn code(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// Everything in `text` that is marked as code and is a path, or the name of a file.
pub fn paths(text: &str) -> BTreeSet<&str> {
    let is_path = |word: &&str| {
        let named = word.contains('/') || ENDINGS.iter().any(|ending| word.ends_with(ending));
        named && !word.contains([' ', '*', ':']) && !word.starts_with(MADE)
    };
    code(text).into_iter().filter(is_path).collect()
}

/// True if this path exists below the root. A file without a folder before it may be anywhere.
pub fn exists(path: &str, files: &BTreeSet<String>) -> bool {
    crate::root().join(path).exists() || (!path.contains('/') && files.contains(path))
}

#[cfg(test)]
mod tests {
    use super::{Guide, code, paths};

    const TEXT: &str = "# One\n`a b` and `x/y.rs`, `z.rs`, `bolt://h`, `target/x`\n## Two `q`\n\n| n | m |\n|---|---|\n\
        | `a` | `b`, `c` |\n| `d` | none |\n\nafter\n# Three\n";

    #[test]
    fn tables_are_found_below_their_headings() {
        let guide = Guide { path: "x", text: TEXT.to_owned() };
        assert_eq!(guide.table("Two").unwrap(), [["`a`", "`b`, `c`"], ["`d`", "none"]]);
        assert!(guide.table("One").is_err() && guide.table("Three").is_err() && guide.table("Four").is_err());
        assert_eq!(guide.headings_of_tables(), ["## Two `q`"]);
    }

    #[test]
    fn paths_are_told_from_other_code() {
        assert!(paths(TEXT).into_iter().eq(["x/y.rs", "z.rs"]));
        assert_eq!(code("`a b` c `d`"), ["a b", "d"]);
    }
}
