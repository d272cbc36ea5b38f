//! `cargo xtask`: builds the page, serves the whole house, and runs every test, without any tool to install by hand.
#![expect(clippy::print_stdout, reason = "a command line tool speaks on standard output")]

mod bench;
mod beside;
mod dist;
mod languages;
mod mutants;
mod neo4j;
mod order;
mod page;
mod qi_python;
mod robot;
mod serve;
mod split;
mod styles;
mod supply;
mod test;
mod tools;

use std::process::ExitCode;

use tools::{ToolResult, Workspace};

const HELP: &str = "\
cargo xtask COMMAND

  page [--dev]              build the page into target/page (--dev: quicker to build, not compressed)
  serve [--dev] [-- ARGS]   build the page and the server, then run `rrp serve ARGS` in the foreground (--dev: quicker
                            to build after an edit, slower to use)
  rrp ARGS                  run rrp as it was built last, such as `cargo xtask rrp open`
  neo4j                     make the Neo4j that tests start, and say how to name it to `cargo test`
  qi                        make the Python with libqi that tests use, and say how to name it to `cargo test`
  robot [PORT]              start a NAO that is not one on the real libqi, at port 9559 unless you name one, for trying things
  bench engine [GRAPH]      measure the engine beside RxJS, RxPY and Node-RED, which are installed into target/bench;
                            GRAPH is chain10, tracking, fanout100, merge100 or bars; or threads, from a sense over the
                            robot's and the run's thread to an action; or stalls, how long runaway procedures hold it
  bench lanes               measure in a browser how long a picture of a million values in twelve lanes takes
  bench nao [PART]          measure a robot over the link against the stand-in, beside the Python client of libqi; PART is
                            calls, reactions, stops or calm
  bench past                measure looking back at an hour: opening it, moments, causes, an edited program, memory
  bench rooms [FIGURE]      measure many people, bad networks, kills and guessed links on the optimised server; FIGURE is 1 to 9
  bench sentences           measure how long typed sentences take to be read
  bench stores              measure SQLite and a real Neo4j with ten thousand behaviours
  mutants [WORD]            put each deliberate fault of the editor into a copy, and see that its tests notice it; with WORD
                            only those whose name contains it
  test [FILTER]             run every check of the house; with FILTER only the tests whose name contains it
  help                      show these lines";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match obey(&words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(sentence) => {
            eprintln!("xtask: {sentence}");
            ExitCode::FAILURE
        }
    }
}

/// Runs the command in `words`; a command that is not known is refused with the help.
fn obey(words: &[String]) -> ToolResult<()> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["page"] => page::build(&Workspace::here()?, page::PageMode::Small),
        ["page", "--dev"] => page::build(&Workspace::here()?, page::PageMode::Quick),
        ["serve", rest @ ..] => serve::run(&Workspace::here()?, rest),
        ["rrp", rest @ ..] => serve::program(&Workspace::here()?, rest),
        ["neo4j"] => {
            println!("RRP_NEO4J={}", neo4j::ensure(&Workspace::here()?)?.display());
            Ok(())
        }
        ["qi"] => {
            println!("RRP_QI_PYTHON={}", qi_python::ensure(&Workspace::here()?)?.display());
            Ok(())
        }
        ["robot", rest @ ..] if rest.iter().all(|word| !word.starts_with('-')) => robot::run(&Workspace::here()?, rest),
        ["bench", "engine", rest @ ..] if rest.iter().all(|word| !word.starts_with('-')) => {
            bench::engine(&Workspace::here()?, rest)
        }
        ["bench", "rooms", rest @ ..] if rest.len() < 2 && rest.iter().all(|word| !word.starts_with('-')) => {
            bench::rooms(&Workspace::here()?, rest)
        }
        ["bench", "nao", rest @ ..] if rest.len() < 2 && rest.iter().all(|word| !word.starts_with('-')) => {
            bench::nao(&Workspace::here()?, rest)
        }
        ["bench", "sentences", rest @ ..] => bench::sentences(&Workspace::here()?, rest),
        ["bench", "lanes"] => bench::lanes(&Workspace::here()?),
        ["bench", "past"] => bench::past(&Workspace::here()?),
        ["bench", "stores"] => bench::stores(&Workspace::here()?),
        ["mutants"] => mutants::run(&Workspace::here()?, ""),
        ["mutants", word] if !word.starts_with('-') => mutants::run(&Workspace::here()?, word),
        ["test"] => test::all(&Workspace::here()?),
        ["test", filter] if !filter.starts_with('-') => test::only(&Workspace::here()?, filter),
        [] | ["help" | "--help" | "-h"] | [_, "--help" | "-h"] => {
            println!("{HELP}");
            Ok(())
        }
        other => Err(format!("`{}` is not a command of ours.\n\n{HELP}", other.join(" "))),
    }
}
