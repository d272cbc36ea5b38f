//! The places of the repository, its built parts and the browser.

use std::env;
use std::path::{Path, PathBuf};

use crate::Outcome;

/// Names under which Chromium is looked for on PATH, best first.
const CHROMIUM_NAMES: [&str; 4] = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"];

/// The folder that holds the root `Cargo.toml`.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Cargo's target folder: `CARGO_TARGET_DIR`, else `target` in the root.
pub fn target() -> PathBuf {
    root().join(named("CARGO_TARGET_DIR").unwrap_or("target".into()))
}

/// A fresh folder that is removed when the value is dropped.
pub fn folder() -> Outcome<tempfile::TempDir> {
    Ok(tempfile::Builder::new().prefix("rrp-").tempdir()?)
}

/// The server's binary: `RRP_BIN`, else the development build.
pub fn server() -> PathBuf {
    named("RRP_BIN").unwrap_or_else(|| target().join("debug").join(format!("rrp{}", env::consts::EXE_SUFFIX)))
}

/// The optimised server: `RRP_OPTIMISED`, else the release build.
pub fn optimised() -> PathBuf {
    named("RRP_OPTIMISED").unwrap_or_else(|| target().join("release").join(format!("rrp{}", env::consts::EXE_SUFFIX)))
}

/// Chromium: `RRP_CHROMIUM`, else the first on PATH under a usual name.
pub(crate) fn chromium() -> Option<PathBuf> {
    if let Some(path) = named("RRP_CHROMIUM") {
        return Some(path).filter(|path| path.is_file());
    }
    let path = env::var_os("PATH")?;
    let folders: Vec<PathBuf> = env::split_paths(&path).collect();
    let places = CHROMIUM_NAMES.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    places.into_iter().find(|place| place.is_file())
}

/// The path in the environment variable `name`, unless it is empty.
fn named(name: &str) -> Option<PathBuf> {
    env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from)
}
