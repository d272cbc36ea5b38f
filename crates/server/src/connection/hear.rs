//! What one message of a socket is.

use crate::connection::close_signal::CloseReason;
use axum::extract::ws::{Message, Utf8Bytes};
use phrase::{Phrase, phrase};
use protocol::Ask;
use serde::Deserialize;

/// The longest reason that is told, in characters.
const REASON_MAX_CHARS: usize = 200;

/// What is read at once, in bytes; every Stop is smaller.
const SMALL_MAX_BYTES: usize = 4 << 10;

/// What one message is.
pub(super) enum HeardMessage {
    /// A request.
    Ask(Box<Ask>),
    /// Too large to be read here.
    Large(Utf8Bytes),
    /// None of ours; with its number if it has one, and the reason.
    Nonsense(Option<u32>, Phrase),
    /// A sign of life.
    Nothing,
    /// The socket ends.
    End(CloseReason),
}

/// Reads one message.
pub(super) fn hear(message: Option<Result<Message, axum::Error>>) -> HeardMessage {
    match message {
        Some(Ok(Message::Text(text))) if text.len() > SMALL_MAX_BYTES => HeardMessage::Large(text),
        Some(Ok(Message::Text(text))) => read(&text),
        Some(Ok(Message::Binary(_))) => {
            HeardMessage::Nonsense(None, phrase!("server.it_is_not_text", "it is not text"))
        }
        Some(Ok(Message::Ping(_) | Message::Pong(_))) => HeardMessage::Nothing,
        Some(Ok(Message::Close(_))) | None => HeardMessage::End(CloseReason::Left),
        Some(Err(error)) => {
            HeardMessage::End(if is_too_large(&error) { CloseReason::TooLarge } else { CloseReason::Left })
        }
    }
}

/// Reads a text.
pub(super) fn read(text: &str) -> HeardMessage {
    match serde_json::from_str(text) {
        Ok(ask) => HeardMessage::Ask(Box::new(ask)),
        Err(error) => {
            let reason = error.to_string().chars().take(REASON_MAX_CHARS).collect();
            HeardMessage::Nonsense(number(text), Phrase::Text(reason))
        }
    }
}

/// The number of a request that cannot be read otherwise, so that its sender need not wait.
fn number(text: &str) -> Option<u32> {
    #[derive(Deserialize)]
    struct Numbered {
        ask: u32,
    }
    serde_json::from_str::<Numbered>(text).ok().map(|numbered| numbered.ask)
}

/// The number with which a large request begins, as all of ours do: read without the rest of it.
pub(super) fn first_number(text: &str) -> Option<u32> {
    let digits = text.strip_prefix(r#"{"ask":"#)?;
    digits.split_once(',')?.0.parse().ok()
}

/// tungstenite's own error is behind axum's; its words are the only way to it.
fn is_too_large(error: &axum::Error) -> bool {
    let text = error.to_string();
    text.contains("too long") || text.contains("too large") || text.contains("too big")
}

#[cfg(test)]
mod tests {
    use super::first_number;
    use protocol::{Ask, request};

    #[test]
    fn a_large_request_that_is_refused_unread_has_its_number() {
        let name = "x".repeat(10_000);
        for stops in [None, Some(7_000_001)] {
            let text = serde_json::to_string(&Ask { stops, ..Ask::new(41, request::CallMe { name: name.clone() }) });
            assert_eq!(first_number(&text.unwrap()), Some(41));
        }
        assert_eq!(["", "{\"ask\":", "{\"ask\":x,", "{\"request\":{}}"].map(first_number), [None; 4]);
    }
}
