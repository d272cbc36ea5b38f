//! The measurements on the wrong side of their bars; told together at the end, with an exit code for whoever compares.

use std::process::ExitCode;
use std::sync::Mutex;

static MISSED: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// Notes a measurement that must be that much or more.
pub(crate) fn at_least(what: &str, measured: f64, least: f64) {
    note(what, measured, "at least", least, measured >= least);
}

/// Notes a measurement that must be that much or less.
pub(crate) fn at_most(what: &str, measured: f64, most: f64) {
    note(what, measured, "at most", most, measured <= most);
}

/// Notes something that went wrong; everything else is measured all the same.
pub(crate) fn failed(what: String) {
    MISSED.lock().unwrap().push(what);
}

/// Also what could not be measured holds no bar.
fn note(what: &str, measured: f64, side: &str, bar: f64, holds: bool) {
    if !holds {
        MISSED.lock().unwrap().push(format!("{what}: {measured:.3}, {side} {bar}"));
    }
}

/// Tells them.
pub(crate) fn tell() -> ExitCode {
    let missed = MISSED.lock().unwrap();
    if missed.is_empty() {
        println!("Every bar is held.");
        return ExitCode::SUCCESS;
    }
    missed.iter().for_each(|missed| println!("MISSED  {missed}"));
    ExitCode::FAILURE
}
