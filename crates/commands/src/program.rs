//! The one reader of programs for all commands: what `rrp check` takes, all of them take.

use crate::failure::Failure;
use behaviour::BehaviourFile;
use std::io::Read;
use std::path::Path;
use store::files::{FILE_MAX_BYTES, look, text_of};

/// The bytes of a file, or of standard input for `-`, one more than a program may have at most.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    read_up_to(path, FILE_MAX_BYTES as u64 + 1)
}

/// So many bytes of a file, or of standard input for `-`.
pub(crate) fn read_up_to(path: &Path, most: u64) -> Result<Vec<u8>, Failure> {
    let named = |error: std::io::Error| Failure::unopened(path, &error);
    let source: Box<dyn Read> = if path == Path::new("-") {
        Box::new(std::io::stdin().lock())
    } else {
        Box::new(std::fs::File::open(path).map_err(named)?)
    };
    let mut bytes = Vec::new();
    source.take(most).read_to_end(&mut bytes).map_err(named)?;
    Ok(bytes)
}

/// A program to run: whatever can be imported, and JSON that the engine runs though an import asks for other names.
pub(crate) fn read_program(path: &Path) -> Result<BehaviourFile, Failure> {
    let bytes = read_bytes(path)?;
    let looked = look(&bytes);
    let runs = || (bytes.len() <= FILE_MAX_BYTES).then(|| text_of(&bytes).ok().and_then(plain)).flatten();
    looked.file.or_else(runs).ok_or_else(|| Failure::faults(path, &looked.faults))
}

fn plain(text: &str) -> Option<BehaviourFile> {
    serde_json::from_str(text).ok()
}
