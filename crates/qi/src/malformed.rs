//! The reasons why bytes are not what they claim to be, and why a value cannot be written as a type.

use phrase::Phrased;

/// The greatest depth of values, and types, within each other.
pub const DEPTH_MAX: u32 = 32;
/// The most values that one message may hold, types and names of fields included. Some tens of MB when read.
pub const VALUES_MAX: u32 = 1_000_000;

/// The flaws of bytes that came from a peer.
#[derive(Debug, Clone, PartialEq, Eq, Phrased)]
pub enum Malformed {
    /// A message begins with four other bytes than qi messages do.
    #[error("the bytes are no qi message: they begin with {found:#010x}")]
    Magic {
        /// The number that stands there, read as little-endian.
        found: u32,
    },
    /// A message of a type that the protocol does not have.
    #[error("a message has the type {found}, which does not exist")]
    Kind {
        /// The type's number.
        found: u8,
    },
    /// A message announces more than [`crate::FRAME_MAX_BYTES`].
    #[error("a message announces {size} bytes, which is too much")]
    TooLarge {
        /// The number of bytes that it announces.
        size: u32,
    },
    /// A value needs more bytes than there are.
    #[error("a value needs {needed} bytes and {left} are left")]
    Short {
        /// The number of bytes that it needs.
        needed: usize,
        /// The number of bytes that are left.
        left: usize,
    },
    /// Values or types within each other beyond [`crate::DEPTH_MAX`].
    #[error("values are nested too deeply")]
    TooDeep,
    /// A message holds more than [`crate::VALUES_MAX`] values.
    #[error("a message holds too many values")]
    TooMany,
    /// A list or map announces more entries than bytes are left.
    #[error("a list announces {count} entries and {left} bytes are left")]
    Count {
        /// The number of entries that it announces.
        count: u32,
        /// The number of bytes that are left.
        left: usize,
    },
    /// A text that is no signature.
    #[error("{text:?} is no signature of qi (byte {at})")]
    Signature {
        /// The signature, at most 80 bytes of it.
        text: String,
        /// The byte at which reading it ended.
        at: usize,
    },
    /// A value of a type that has no written form: `X`.
    #[error("a value has a type that cannot be read")]
    Unreadable,
}

/// The reasons why a value cannot be written as a type.
#[derive(Debug, Clone, PartialEq, Eq, Phrased)]
pub enum TypeMismatch {
    /// Another kind of value than the type wants.
    #[error("{given} cannot be given as {wanted}")]
    Type {
        /// The signature of the value.
        given: String,
        /// The signature of the type.
        wanted: String,
    },
    /// Values within each other beyond [`crate::DEPTH_MAX`].
    #[error("the value is nested too deeply")]
    TooDeep,
    /// A text, list or message of more than [`crate::FRAME_MAX_BYTES`].
    #[error("the value is too large to be sent")]
    TooLarge,
}
