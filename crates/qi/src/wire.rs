//! Messages on the wire: a header of 28 bytes and a payload, cut out of a stream of bytes.

use crate::malformed::Malformed;

/// The size of a header in bytes.
pub const HEADER_BYTES: usize = 28;
/// The largest payload of a message in bytes: 16 MiB. An image of 640x480 in RGB is 0.9 MB.
pub const FRAME_MAX_BYTES: usize = 16 << 20;
/// Flag of a message whose payload is a dynamic: its signature goes before the value.
pub const FLAG_DYNAMIC: u8 = 1;
/// Flag of a call whose payload ends with the signature that the result must be converted to.
pub const FLAG_RETURN_SIGNATURE: u8 = 2;

const MAGIC: u32 = 0x42AD_DE42;
/// Above this many bytes a buffer that was needed once is given back.
const KEPT_MAX_BYTES: usize = 1 << 20;

/// The purposes of a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MessageKind {
    /// Asks for a method and wants an answer.
    Call,
    /// The result of a call.
    Reply,
    /// The failure of a call.
    Error,
    /// Asks for a method and wants no answer.
    Post,
    /// A signal was raised.
    Event,
    /// The capabilities of the sender, in the generation of NAOqi 2.1.
    Capability,
    /// Asks for the end of a call.
    Cancel,
    /// A call ended because it was cancelled.
    Canceled,
}

impl MessageKind {
    const ALL: [Self; 8] =
        [Self::Call, Self::Reply, Self::Error, Self::Post, Self::Event, Self::Capability, Self::Cancel, Self::Canceled];

    fn number(self) -> u8 {
        Self::ALL.iter().zip(1..).find(|(kind, _)| **kind == self).map_or(0, |(_, number)| number)
    }

    fn from_number(found: u8) -> Result<Self, Malformed> {
        let at = usize::from(found).checked_sub(1).ok_or(Malformed::Kind { found })?;
        Self::ALL.get(at).copied().ok_or(Malformed::Kind { found })
    }
}

/// Everything about a message but its payload.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MessageHeader {
    /// The purpose of the message.
    pub kind: MessageKind,
    /// [`FLAG_DYNAMIC`] and [`FLAG_RETURN_SIGNATURE`].
    pub flags: u8,
    /// Counted by the sender; an answer carries the one of its call. Events have ids of their own, which may be the same.
    pub id: u32,
    /// 0 for the login, 1 for the service directory.
    pub service: u32,
    /// 1 for the service itself, others for what it gave out.
    pub object: u32,
    /// A method, signal or property of the object.
    pub action: u32,
}

impl MessageHeader {
    /// The 28 bytes of a message with so many bytes of payload. The version is 0, as libqi's is.
    pub fn to_bytes(&self, payload_bytes: u32) -> [u8; HEADER_BYTES] {
        let mut bytes = [0; HEADER_BYTES];
        let kind_and_flags = u32::from(self.kind.number()) << 16 | u32::from(self.flags) << 24;
        let words = [MAGIC, self.id, payload_bytes, kind_and_flags, self.service, self.object, self.action];
        for (to, word) in bytes.chunks_exact_mut(4).zip(words) {
            to.copy_from_slice(&word.to_le_bytes());
        }
        bytes
    }

    /// Reads a header and the size of its payload in bytes. The version is not looked at: libqi does neither.
    ///
    /// # Errors
    /// [`Malformed::Magic`], [`Malformed::Kind`], [`Malformed::TooLarge`].
    pub fn from_bytes(bytes: &[u8; HEADER_BYTES]) -> Result<(Self, usize), Malformed> {
        let mut words = [0u32; HEADER_BYTES / 4];
        for (word, from) in words.iter_mut().zip(bytes.chunks_exact(4)) {
            *word = from.iter().rev().fold(0, |word, byte| word << 8 | u32::from(*byte));
        }
        let [found, id, size, rest, service, object, action] = words;
        if found != MAGIC {
            return Err(Malformed::Magic { found });
        }
        let [_, _, kind, flags] = rest.to_le_bytes();
        let kind = MessageKind::from_number(kind)?;
        let bytes = usize::try_from(size).ok().filter(|bytes| *bytes <= FRAME_MAX_BYTES);
        let bytes = bytes.ok_or(Malformed::TooLarge { size })?;
        Ok((Self { kind, flags, id, service, object, action }, bytes))
    }
}

/// A whole message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MessageFrame {
    /// The kind of message and whom it is for.
    pub header: MessageHeader,
    /// The content, at most [`FRAME_MAX_BYTES`].
    pub payload: Vec<u8>,
}

impl MessageFrame {
    /// The bytes of the whole message, or nothing if its payload is larger than [`FRAME_MAX_BYTES`].
    pub fn to_bytes(&self) -> Option<Vec<u8>> {
        let size = u32::try_from(self.payload.len()).ok().filter(|_| self.payload.len() <= FRAME_MAX_BYTES)?;
        let mut bytes = Vec::with_capacity(HEADER_BYTES + self.payload.len());
        bytes.extend_from_slice(&self.header.to_bytes(size));
        bytes.extend_from_slice(&self.payload);
        Some(bytes)
    }
}

/// Cuts messages out of a stream of bytes, however it was broken up. It holds what was fed and not yet taken; take all
/// messages after each feeding, and it holds at most one and what was fed last.
#[derive(Debug, Default)]
pub struct Framer {
    buffer: Vec<u8>,
    taken: usize,
}

impl Framer {
    /// Takes in bytes as they came.
    pub fn feed(&mut self, bytes: &[u8]) {
        if self.taken > 0 {
            self.buffer.drain(..self.taken);
            self.taken = 0;
        }
        if self.buffer.is_empty() && self.buffer.capacity() > KEPT_MAX_BYTES {
            self.buffer = Vec::new();
        }
        self.buffer.extend_from_slice(bytes);
    }

    /// The next whole message, or nothing until more bytes come.
    ///
    /// # Errors
    /// Fails as [`MessageHeader::from_bytes`] does, as soon as the header is there. The stream cannot be read on after that.
    pub fn next_frame(&mut self) -> Result<Option<MessageFrame>, Malformed> {
        let waiting = self.buffer.get(self.taken..).unwrap_or_default();
        let Some((header, rest)) = waiting.split_first_chunk::<HEADER_BYTES>() else { return Ok(None) };
        let (header, size) = MessageHeader::from_bytes(header)?;
        let Some(payload) = rest.get(..size) else { return Ok(None) };
        let payload = payload.to_vec();
        self.taken += HEADER_BYTES + size;
        Ok(Some(MessageFrame { header, payload }))
    }
}
