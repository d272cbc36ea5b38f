//! Tests that need a browser or a server say by name when they have to skip; in CI they fail instead.

use std::fs::OpenOptions;
use std::io::Write;
use std::process::{Command, Stdio};

use crate::{paths, times};

/// Leaves a test here, which counts as skipped by name, unless what it needs is there: `skip::unless!(ready("journey: Stop"))`. In
/// CI it fails instead.
#[macro_export]
macro_rules! unless {
    ($needed:ident($($part:expr),+)) => {
        if !$crate::skip::$needed($($part),+) {
            return Ok(());
        }
    };
}
pub use crate::unless;

/// True if the browser and the server's binary are here, so that the journey `part` can run.
///
/// # Panics
/// When one is missing and `CI` is `true`, where nothing may be skipped, or when the server is missing
/// although `cargo xtask test` has just built it.
pub fn ready(part: &str) -> bool {
    served(part) && ready_browser(part)
}

/// True if the server's binary alone is here.
///
/// # Panics
/// When it is missing and `CI` is `true`, or although `cargo xtask test` has just built it.
pub fn served(part: &str) -> bool {
    let server = paths::server();
    let missing = (!server.is_file()).then(|| format!("the server is not built at {}", server.display()));
    assert!(missing.is_none() || !is("RRP_TOOLS_READY", "1"), "{part} cannot run: {missing:?}");
    proceed(part, missing)
}

/// True if the server's binary alone is here, for tests without a browser.
///
/// # Panics
/// When it is missing and `CI` is `true`.
pub fn built(part: &str) -> bool {
    let server = paths::server();
    possible(part, (!server.is_file()).then(|| format!("the server is not built at {}", server.display())))
}

/// True if nothing is `missing`, for tests that need something of their own.
///
/// # Panics
/// When something is and `CI` is `true`.
pub fn possible(part: &str, missing: Option<String>) -> bool {
    proceed(part, missing)
}

/// True if the browser alone is here, for tests that bring their own page.
///
/// # Panics
/// When it is missing and `CI` is `true`.
pub fn ready_browser(part: &str) -> bool {
    let missing = paths::chromium().is_none().then(|| "there is no Chromium; name one in RRP_CHROMIUM".to_owned());
    proceed(part, missing)
}

/// True if the browser, the server's binary and a font with Japanese letters are here, to look at the page in Japanese.
///
/// # Panics
/// When one is missing and `CI` is `true`.
pub fn ready_in_japanese(part: &str) -> bool {
    let listed = Command::new("fc-list").args([":lang=ja", "family"]).stderr(Stdio::null()).output();
    let there = listed.is_ok_and(|found| found.status.success() && !found.stdout.trim_ascii().is_empty());
    let missing = (!there).then(|| "there is no Japanese font; install fonts-vlgothic and fontconfig".to_owned());
    ready(part) && proceed(part, missing)
}

/// True if the optimised server is built, and this is Linux, which tells what a process takes of the memory.
///
/// # Panics
/// When it is missing and `CI` is `true`.
pub fn optimised(part: &str) -> bool {
    let missing = !paths::optimised().is_file();
    linux(part)
        && proceed(
            part,
            missing.then(|| "build it with `cargo build --release --no-default-features --package rrp`".to_owned()),
        )
}

/// True if this is Linux, for tests that change what the system answers to the server.
///
/// # Panics
/// When it is not and `CI` is `true`.
pub fn linux(part: &str) -> bool {
    proceed(part, (!cfg!(target_os = "linux")).then(|| "only Linux can pretend it".to_owned()))
}

fn proceed(part: &str, missing: Option<String>) -> bool {
    times::begin();
    let Some(why) = missing else { return true };
    assert!(!is("CI", "true"), "{part} cannot run, and CI skips nothing: {why}");
    tell(&format!("{part} ({why})"));
    false
}

fn is(variable: &str, value: &str) -> bool {
    std::env::var(variable).is_ok_and(|found| found == value)
}

/// Says it past the test runner, which hides what passing tests print, and notes it for `cargo xtask test`.
fn tell(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "SKIPPED: {line}");
    if let Some(list) = std::env::var_os("RRP_SKIPPED_LIST")
        && let Ok(mut file) = OpenOptions::new().create(true).append(true).open(list)
    {
        let _ = writeln!(file, "{line}");
    }
}
