//! `rrp replay --check`: whether a recording alone gives its own actions again.

use crate::failure::Failure;
use crate::trace::read_trace;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

/// Says on standard output what was found, or on standard error what differs first.
pub(super) fn check(path: &Path) -> ExitCode {
    let text = match read_trace(path) {
        Ok(text) => text,
        Err(reason) => return crate::failed(&[reason], 3),
    };
    match recording::check(&text) {
        Ok(checked) => {
            let _ = writeln!(std::io::stdout(), "{checked}");
            ExitCode::SUCCESS
        }
        Err(different) => crate::failed(&[Failure::of(different)], 1),
    }
}
