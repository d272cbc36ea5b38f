//! Many people at once on a real server: whatever becomes of their links and of the server, all of them see the same in
//! the end, byte by byte, and nothing that was acknowledged is lost. `cargo xtask bench rooms` measures besides.

#![expect(clippy::print_stdout, reason = "what was measured is for whoever runs it with --nocapture")]

mod chaos;
mod figures;
mod filling;
mod kills;
mod neo4j;
mod process;

use house::Outcome;
use load::{Report, Wrong, compare};

/// Whether all is well in the end, also for who comes to the server after it was started again.
async fn check(report: &Report, server: &mut house::Server) -> Outcome<()> {
    println!("{report}\n");
    server.terminate().await?;
    server.restart().await?;
    let cold = compare(&server.url(), "Who comes to the server that was started again", &report.known).await?;
    let wrong: Vec<String> = report.wrong.iter().chain(&cold).map(Wrong::to_string).collect();
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("\n").into()) }
}
