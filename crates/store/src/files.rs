//! Behaviours as files to carry: reading with the line of every fault, writing so that it can be compared, and what
//! an import changes. Texts in, values out; no file is opened here.

mod import;
mod json;
mod kind;
mod place;
mod shape;
mod svg;
mod text;
mod tree;
mod xml;

#[cfg(test)]
mod samples;
#[cfg(test)]
mod schemas;
#[cfg(test)]
mod tests;

pub use import::{Import, ImportError, ImportMode, import};
pub use json::write::write_json;
pub use kind::{BinaryKind, FileKind};
pub use svg::write_svg;
pub use text::text_of;
pub use xml::write::{NoXml, write_xml};

use behaviour::{BEHAVIOUR_MAX_BYTES, BehaviourFile, LIBRARY_MAX_BYTES};
use phrase::{Phrase, Phrased, phrase};
use place::LineStarts;
use std::collections::BTreeMap;

/// The largest file that is read, in bytes: a behaviour within the rules and the whole library fit.
pub const FILE_MAX_BYTES: usize = BEHAVIOUR_MAX_BYTES + LIBRARY_MAX_BYTES;
/// The longest body, note or other text in a file, in bytes.
pub const TEXT_MAX_BYTES: usize = 64 << 10;

/// A fault of a file, with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileFault {
    /// The line, from 1.
    pub line: u32,
    /// The character in the line, from 1.
    pub column: u32,
    /// The sentence that says what is wrong and what to do.
    pub reason: Phrase,
}

phrase::shown!(FileFault);

impl Phrased for FileFault {
    fn phrase(&self) -> Phrase {
        phrase!(
            "FileFault",
            "Line {line}, column {column}: {reason}",
            line = self.line,
            column = self.column,
            reason = self.reason
        )
    }
}

impl std::error::Error for FileFault {}

/// A file that was looked at.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadFile {
    /// The behaviour, if its form is right.
    pub file: Option<BehaviourFile>,
    /// The faults of its form, from top to bottom; of very many only the first.
    pub faults: Vec<FileFault>,
    /// Line and column of each stream, connector and note by id, and of each helper by name.
    pub places: BTreeMap<String, (u32, u32)>,
}

impl ReadFile {
    /// Gives the faults of a graph their place, where they say the id of what they are about.
    #[must_use]
    pub fn place(&self, faults: &[impl Phrased]) -> Vec<FileFault> {
        let place = |fault: Phrase| {
            let known = fault.hole("id").and_then(|id| self.places.get(&id.to_string())).copied();
            let reason = known.and_then(|_| fault.hole("reason").cloned()).unwrap_or(fault);
            let (line, column) = known.unwrap_or((1, 1));
            FileFault { line, column, reason: phrase!("FileFault.Reason", "{^.reason}.") }
        };
        let mut placed: Vec<_> = faults.iter().map(|fault| place(fault.phrase())).collect();
        placed.sort_by_cached_key(|fault| (fault.line, fault.column, fault.reason.to_string()));
        placed.dedup();
        placed
    }
}

/// Reads a behaviour, as JSON or XML.
///
/// # Errors
/// The first fault.
pub fn read(bytes: &[u8]) -> Result<BehaviourFile, FileFault> {
    let looked = look(bytes);
    let unknown = || FileFault { line: 1, column: 1, reason: phrase!("FileFault.NoProgram", "This is no program.") };
    looked.file.ok_or_else(|| looked.faults.into_iter().next().unwrap_or_else(unknown))
}

/// Looks at a whole file and tells every fault of its form.
#[must_use]
pub fn look(bytes: &[u8]) -> ReadFile {
    match looked(bytes) {
        Ok(looked) => looked,
        Err(fault) => ReadFile { faults: vec![fault], ..ReadFile::default() },
    }
}

fn looked(bytes: &[u8]) -> Result<ReadFile, FileFault> {
    let at_start = |reason: Phrase| FileFault { line: 1, column: 1, reason };
    if bytes.len() > FILE_MAX_BYTES {
        let reason = phrase!(
            "FileFault.TooLarge",
            "The file has {bytes} bytes, and a program may have {FILE_MAX_BYTES}. Split it into several.",
            bytes = bytes.len()
        );
        return Err(at_start(reason));
    }
    if let Some(kind) = FileKind::of(bytes) {
        return Err(at_start(kind.no_program()));
    }
    let text = text_of(bytes)?;
    let lines = LineStarts::of(text);
    let start = text.len() - text.trim_start().len();
    let tree = match text.as_bytes().get(start) {
        Some(b'{') => json::tree(text, &lines)?,
        Some(b'<') => {
            xml::check_root(text, &lines)?;
            xml::tree(text, &lines)?
        }
        Some(_) => return Err(lines.fault(start, "This is no program: a file begins with { (JSON) or < (XML).")),
        None => return Err(lines.fault(start, "The file is empty. Choose another one.")),
    };
    Ok(shape::behaviour(&tree, &lines))
}
