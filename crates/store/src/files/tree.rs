//! A file as a tree of named things, each with its place: what JSON and XML have in common.

use behaviour::Value;
use phrase::{Phrased, Word, word};

/// The greatest depth to which things may lie in each other.
pub(super) const DEPTH_MAX: usize = 32;

/// The most things that a file may have; the rules allow fewer.
pub(super) const NODES_MAX: usize = 250_000;

/// The sentence about a file that has more.
pub(super) const TOO_MANY: Word =
    word!("file.too_many", "The file has more things in it than a program may have. Split it into several.");

/// The reasons why a text is no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Phrased)]
pub(super) enum NoNumber {
    /// It is none at all.
    #[error("This must be a number, such as 12 or 0.5.")]
    Other,
    /// It is larger than any that is kept.
    #[error("This number is too large. Use a smaller one.")]
    TooLarge,
    /// It is no length of time.
    #[error("This must be a whole number of milliseconds, such as 500ms.")]
    NoMillis,
}

/// A thing in the file.
#[derive(Debug)]
pub(super) struct FileNode {
    /// The byte where it begins.
    pub(super) at: usize,
    pub(super) what: NodeKind,
}

#[derive(Debug)]
pub(super) enum NodeKind {
    /// Named things, in the order of the file.
    Object(Vec<(String, FileNode)>),
    /// Things in a row.
    Array(Vec<FileNode>),
    /// A text, a number, true, false or nothing.
    Plain(Value),
}

impl FileNode {
    pub(super) fn text(at: usize, text: impl AsRef<str>) -> Self {
        Self { at, what: NodeKind::Plain(Value::text(text)) }
    }

    pub(super) fn array(at: usize, items: Vec<FileNode>) -> Self {
        Self { at, what: NodeKind::Array(items) }
    }

    pub(super) fn object(at: usize, fields: Vec<(String, FileNode)>) -> Self {
        Self { at, what: NodeKind::Object(fields) }
    }

    /// Returns the value without its places; of a name that is there twice the last one.
    pub(super) fn value(&self) -> Value {
        match &self.what {
            NodeKind::Plain(value) => value.clone(),
            NodeKind::Array(items) => Value::list(items.iter().map(FileNode::value)),
            NodeKind::Object(fields) => Value::object(fields.iter().map(|(name, node)| (name.as_str(), node.value()))),
        }
    }
}
