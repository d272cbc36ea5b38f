//! Measures how quick a robot is over the link, on loopback against the stand-in, beside the Python client of libqi on
//! the same work.
//!
//! `cargo xtask bench nao` prints calls, passages from events to actions, Stops, and how long a robot goes on whose server was
//! killed or cut off; `calls`, `reactions`, `stops` or `calm` picks one. It says all of them before it fails: beyond a bar, or
//! where something could not be measured. The stand-in is a Python that two cores share with everything else, so its own part
//! of a call is in every figure: ratios of one run mean something.
#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a bench prints, and may give up")]

#[cfg(unix)]
use std::{
    future::Future,
    panic::{AssertUnwindSafe, catch_unwind},
    pin::Pin,
};

#[cfg(unix)]
mod calls;
#[cfg(unix)]
mod calm;
#[cfg(unix)]
mod client;
#[cfg(unix)]
#[path = "../../tests/nao/driver.rs"]
#[expect(dead_code, reason = "tests need more of it")]
mod driver;
#[cfg(unix)]
mod figures;
#[cfg(unix)]
#[path = "../../tests/nao/harm.rs"]
mod harm;
#[cfg(unix)]
#[path = "../../tests/nao/peer.rs"]
#[expect(dead_code, reason = "tests need more of it")]
mod peer;
#[cfg(unix)]
#[path = "../../tests/nao/proxy.rs"]
#[expect(dead_code, reason = "tests need more of it")]
mod proxy;
#[cfg(unix)]
mod reactions;
#[cfg(unix)]
mod stops;

/// One part of the benchmark.
#[cfg(unix)]
type Measures = fn(&mut figures::Verdict) -> Pin<Box<dyn Future<Output = ()> + '_>>;

/// Those that are picked, or all.
#[cfg(unix)]
fn main() -> std::process::ExitCode {
    if harm::drive_if_told() {
        return std::process::ExitCode::SUCCESS;
    }
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build().unwrap();
    let mut verdict = figures::Verdict::default();
    let mut part = |name: &str, measures: Measures| {
        if words.is_empty() || words.iter().any(|word| word == name) {
            // A panic in one part, as of what the robot does not do, keeps nothing of the others from being said.
            let done = catch_unwind(AssertUnwindSafe(|| runtime.block_on(measures(&mut verdict))));
            done.unwrap_or_else(|_| verdict.broke_off(name));
        }
    };
    part("calls", |verdict| Box::pin(calls::measure(verdict)));
    part("reactions", |verdict| Box::pin(reactions::measure(verdict)));
    part("stops", |verdict| Box::pin(stops::measure(verdict)));
    part("calm", |verdict| Box::pin(calm::measure(verdict)));
    verdict.tell()
}

#[cfg(not(unix))]
fn main() {
    println!("SKIPPED by name: the benchmark of the robot (there is no libqi for this system)");
}
