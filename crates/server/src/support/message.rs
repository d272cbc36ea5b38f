//! What clients are sent, as text.

use axum::extract::ws::Utf8Bytes;
use protocol::{Message, Reply};

/// One message as text.
pub(crate) fn encode(ask: Option<u32>, reply: Reply) -> Utf8Bytes {
    let text = serde_json::to_string(&Message { ask, reply });
    text.unwrap_or_else(|error| {
        format!("{{\"reply\":{{\"is\":\"no\",\"no\":{{\"why\":\"unreadable\",\"what\":\"{error}\"}}}}}}")
    })
    .into()
}
