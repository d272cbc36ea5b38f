//! The task that reads a link and the one that writes it.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Instant;

use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::sync::mpsc;

use super::mailbox::Letter;
use super::pending::CallAnswer;
use super::{LinkShared, MemberTarget};
use crate::error::LinkEnding;
use crate::signature::ValueSignature;
use crate::value::{Layout, Value, encode};
use crate::wire::{Framer, MessageFrame, MessageHeader, MessageKind};

/// The most bytes that are read at once.
const CHUNK_BYTES: usize = 64 << 10;
/// The most messages that are written at once.
const TOGETHER_MAX_FRAMES: usize = 32;
/// Above this many bytes messages are not put together.
const TOGETHER_MAX_BYTES: usize = 64 << 10;
/// The refusal to a peer that calls something here: this crate is a client only.
const HOSTS_NOTHING: &str = "this client has no services";

pub(super) async fn read(shared: Arc<LinkShared>, from: impl AsyncRead + Unpin) {
    let ending = tokio::select! {
        ending = read_all(&shared, from) => ending,
        ending = shared.ended() => ending,
    };
    shared.end(ending);
}

async fn read_all(shared: &LinkShared, mut from: impl AsyncRead + Unpin) -> LinkEnding {
    let mut framer = Framer::default();
    let mut chunk = vec![0; CHUNK_BYTES];
    loop {
        let read = match from.read(&mut chunk).await {
            Ok(0) => return LinkEnding::Peer,
            Ok(read) => read,
            Err(error) => return LinkEnding::Io(error.kind()),
        };
        shared.heard();
        framer.feed(chunk.get(..read).unwrap_or_default());
        loop {
            match framer.next_frame() {
                Ok(Some(frame)) => shared.take_in(frame),
                Ok(None) => break,
                Err(malformed) => return LinkEnding::Malformed(malformed),
            }
        }
    }
}

impl LinkShared {
    fn take_in(&self, frame: MessageFrame) {
        let MessageFrame { header, payload } = frame;
        match header.kind {
            MessageKind::Reply | MessageKind::Error | MessageKind::Canceled => {
                let answer = CallAnswer { kind: header.kind, flags: header.flags, payload };
                if !self.pending.settle(header.id, answer) {
                    self.late.fetch_add(1, Ordering::Relaxed);
                }
            }
            MessageKind::Event => {
                let signal = MemberTarget { service: header.service, object: header.object, action: header.action };
                let letter = Letter { flags: header.flags, payload: payload.into(), at: Instant::now() };
                self.fan_out.tell(signal, &letter);
            }
            MessageKind::Capability => {
                let _first_counts = self.greeting.set(payload);
            }
            MessageKind::Call => self.refuse(header),
            MessageKind::Post | MessageKind::Cancel => {}
        }
    }

    /// With a full queue nobody hears of it.
    fn refuse(&self, asked: MessageHeader) {
        let said = encode(&Value::dynamic(HOSTS_NOTHING), &ValueSignature::Dynamic, Layout::default());
        let frame = MessageFrame {
            header: MessageHeader { kind: MessageKind::Error, flags: 0, ..asked },
            payload: said.unwrap_or_default(),
        };
        let _too_many = self.send(&frame);
    }
}

pub(super) async fn write(shared: Arc<LinkShared>, to: impl AsyncWrite + Unpin, waiting: mpsc::Receiver<Vec<u8>>) {
    let ending = tokio::select! {
        ending = write_all(&shared, to, waiting) => ending,
        ending = shared.ended() => ending,
    };
    shared.end(ending);
}

async fn write_all(
    shared: &LinkShared,
    mut to: impl AsyncWrite + Unpin,
    mut waiting: mpsc::Receiver<Vec<u8>>,
) -> LinkEnding {
    let mut frames = Vec::with_capacity(TOGETHER_MAX_FRAMES);
    while waiting.recv_many(&mut frames, TOGETHER_MAX_FRAMES).await > 0 {
        let bytes = frames.iter().map(Vec::len).sum();
        let result = write_some(&mut to, &mut frames).await;
        shared.written(bytes);
        if let Err(error) = result {
            return LinkEnding::Io(error.kind());
        }
    }
    LinkEnding::Here
}

/// Small messages go out together: one call of the system, one record of TLS.
async fn write_some(to: &mut (impl AsyncWrite + Unpin), frames: &mut Vec<Vec<u8>>) -> std::io::Result<()> {
    let mut together: Vec<u8> = Vec::new();
    for frame in frames.drain(..) {
        if together.is_empty() {
            together = frame;
        } else if together.len() + frame.len() <= TOGETHER_MAX_BYTES {
            together.extend_from_slice(&frame);
        } else {
            to.write_all(&together).await?;
            together = frame;
        }
    }
    to.write_all(&together).await?;
    to.flush().await
}
