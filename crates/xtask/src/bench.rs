//! Benchmarks that need more than cargo.

use crate::neo4j;
use crate::tools::{self, Outcome, Workspace};

/// Measures the stores.
pub(crate) fn stores(workspace: &Workspace) -> Outcome<()> {
    let mut cargo = workspace.cargo(&["bench", "--package", "store", "--bench", "stores"]);
    match neo4j::ensure(workspace) {
        Ok(folder) => drop(cargo.env("RRP_NEO4J", folder)),
        Err(sentence) => println!("SKIPPED by name: the benchmark of Neo4j ({sentence})"),
    }
    tools::run(&mut cargo, "The benchmark of stores")
}
