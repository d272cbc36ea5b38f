//! What clients are sent, as text.

use axum::extract::ws::Utf8Bytes;
use protocol::Message;
use std::cell::RefCell;
use std::fmt::Display;

/// What a thread keeps to write the next message into, in bytes.
const KEPT_MAX_BYTES: usize = 256 << 10;

thread_local! {
    static DRAFT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// One message as text, which takes no more memory than it is long: many may wait at once.
pub(crate) fn encode(message: impl Into<Message>) -> Utf8Bytes {
    DRAFT.with_borrow_mut(|draft| {
        draft.clear();
        let text = match serde_json::to_writer(&mut *draft, &message.into()) {
            Ok(()) => std::str::from_utf8(draft).map_or_else(|error| failed(&error), Utf8Bytes::from),
            Err(error) => failed(&error),
        };
        draft.shrink_to(KEPT_MAX_BYTES);
        text
    })
}

fn failed(error: &impl Display) -> Utf8Bytes {
    format!("{{\"no\":{{\"no\":{{\"unreadable\":\"{error}\"}}}}}}").into()
}
