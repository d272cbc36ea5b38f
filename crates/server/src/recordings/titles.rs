//! The names that people give recordings: a small file beside each, as a recording itself never changes.

use super::ENDING;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The ending of the name of the file with the name that people gave a recording.
const TITLE_ENDING: &str = ".title.txt";
/// The most of such a name that is read, in bytes.
const TITLE_MAX_BYTES: u64 = 1_024;

/// The name that people gave a recording, if they did.
pub(super) fn title(path: &Path) -> Option<String> {
    let mut text = Vec::new();
    File::open(title_of(path)).ok()?.take(TITLE_MAX_BYTES).read_to_end(&mut text).ok()?;
    Some(String::from_utf8_lossy(&text).trim().to_owned()).filter(|title| !title.is_empty())
}

/// Returns the path of the name that people gave a recording.
pub(super) fn title_of(path: &Path) -> PathBuf {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    path.with_file_name(format!("{}{TITLE_ENDING}", name.trim_end_matches(ENDING)))
}
