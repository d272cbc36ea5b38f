//! Events per CPU second of four graphs: compiled, by Rhai alone, written in Rust, and in the hands of others; then
//! what has a bar of its own.
//!
//! `cargo bench -p engine` prints tables; a name after `--` picks one graph, or `bars`. `cargo xtask bench engine`
//! installs the others first. Passes alternate and medians are shown, so ratios mean something on a busy machine too.
//! It fails if a bar is missed.
#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a bench prints, and may give up")]

mod bars;
mod bodies;
mod clock;
mod graphs;
mod hand;
mod peers;
mod race;
mod streams;
mod verdict;

use std::process::ExitCode;

fn main() -> ExitCode {
    let only = std::env::args().skip(1).find(|name| !name.starts_with('-'));
    let wanted = |name: &str| only.as_ref().is_none_or(|only| only == name);
    peers::tell_missing();
    for graph in graphs::all().into_iter().filter(|graph| wanted(graph.name)) {
        race::race(&graph);
    }
    if wanted("bars") {
        let [_, tracking, ..] = graphs::all();
        bars::bars(&tracking, graphs::long_chain);
    }
    verdict::tell()
}
