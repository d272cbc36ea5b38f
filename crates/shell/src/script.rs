//! Commands from a file or a pipe, one a line, up to the first that is refused.

use crate::console::Console;
use std::io::BufRead;
use std::time::Instant;

/// Lines that may wait.
const LINES_MAX: usize = 64;

/// Obeys the commands of the standard input. Returns true if every one was obeyed.
pub(crate) async fn run(console: &mut Console) -> bool {
    let (lines, mut next) = tokio::sync::mpsc::channel(LINES_MAX);
    // Reading may wait for ever, so it has a thread that ends with the process.
    std::thread::spawn(move || {
        for line in std::io::stdin().lock().lines().map_while(Result::ok) {
            if lines.blocking_send((line, Instant::now())).is_err() {
                break;
            }
        }
    });
    while let Some((line, entered)) = next.recv().await {
        if !console.obey_entered(&line, entered).await {
            return false;
        }
        if console.is_done() {
            break;
        }
    }
    true
}
