//! Calls that wait for their answers, at most [`IN_FLIGHT_MAX`].

use std::collections::BTreeMap;
use std::sync::Mutex;

use tokio::sync::oneshot;

use crate::error::QiError;
use crate::locked::locked;
use crate::signature::ValueSignature;
use crate::value::{Layout, Value, decode};
use crate::wire::{FLAG_DYNAMIC, MessageKind};

/// The most calls that may be under way on one link.
pub const IN_FLIGHT_MAX: usize = 64;

/// The answer to a call, as it came.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CallAnswer {
    /// A reply, an error or the end of a cancelled call.
    pub(crate) kind: MessageKind,
    /// [`FLAG_DYNAMIC`] if the value brings its signature.
    pub(crate) flags: u8,
    pub(crate) payload: Vec<u8>,
}

impl CallAnswer {
    /// The value, which the method says is of this type.
    ///
    /// # Errors
    /// Fails if the bytes are malformed.
    pub fn value(&self, signature: &ValueSignature, layout: Layout) -> Result<Value, QiError> {
        if self.flags & FLAG_DYNAMIC == 0 {
            return Ok(decode(&self.payload, signature, layout)?);
        }
        match decode(&self.payload, &ValueSignature::Dynamic, layout)? {
            Value::Dynamic(inner) if *signature != ValueSignature::Dynamic => Ok(*inner),
            value => Ok(value),
        }
    }

    /// The payload as it came.
    pub fn payload(&self) -> &[u8] {
        &self.payload
    }

    /// A failure of the peer's is an error here.
    pub(super) fn settled(self, what: &str) -> Result<Self, QiError> {
        match self.kind {
            MessageKind::Error => Err(self.failure()),
            MessageKind::Canceled => Err(QiError::Canceled { what: what.to_owned() }),
            _ => Ok(self),
        }
    }

    /// Texts of NAOqi's modules are `Module::method` and, on the next lines, what went wrong.
    fn failure(&self) -> QiError {
        let said = decode(&self.payload, &ValueSignature::Dynamic, Layout::default());
        let text = said.ok().and_then(|value| value.as_text().map(std::borrow::Cow::into_owned));
        let text = text.unwrap_or_else(|| "it failed without saying why".to_owned());
        let parts = text.split_once('\n').map(|(module, rest)| (module.trim(), rest.trim()));
        match parts.filter(|(module, rest)| is_method(module) && !rest.is_empty()) {
            Some((module, rest)) => QiError::Remote { module: Some(module.to_owned()), text: rest.to_owned() },
            None => QiError::Remote { module: None, text: text.trim().to_owned() },
        }
    }
}

fn is_method(line: &str) -> bool {
    line.contains("::") && !line.contains(' ')
}

#[derive(Debug, Default)]
pub(super) struct PendingCalls(Mutex<Calls>);

#[derive(Debug, Default)]
struct Calls {
    waiting: BTreeMap<u32, oneshot::Sender<CallAnswer>>,
    last_id: u32,
    closed: bool,
}

impl Calls {
    fn next_id(&mut self) -> u32 {
        loop {
            self.last_id = self.last_id.wrapping_add(1);
            if self.last_id != 0 && !self.waiting.contains_key(&self.last_id) {
                return self.last_id;
            }
        }
    }
}

impl PendingCalls {
    /// A place for one more call, or none. Once closed, the answer of every place is that there is none.
    pub(super) fn begin(&self) -> Option<PendingCall<'_>> {
        let mut calls = locked(&self.0);
        if calls.waiting.len() >= IN_FLIGHT_MAX {
            return None;
        }
        let (sender, answer) = oneshot::channel();
        let id = calls.next_id();
        if !calls.closed {
            calls.waiting.insert(id, sender);
        }
        Some(PendingCall { pending: self, id, answer })
    }

    pub(super) fn next_id(&self) -> u32 {
        locked(&self.0).next_id()
    }

    pub(super) fn len(&self) -> usize {
        locked(&self.0).waiting.len()
    }

    /// Hands the answer to whom it waits for. Returns true if somebody did.
    pub(super) fn settle(&self, id: u32, answer: CallAnswer) -> bool {
        let waiting = locked(&self.0).waiting.remove(&id);
        waiting.is_some_and(|waiting| waiting.send(answer).is_ok())
    }

    pub(super) fn close(&self) {
        let mut calls = locked(&self.0);
        calls.closed = true;
        calls.waiting.clear();
    }
}

/// A call's place; whoever gives up waiting frees it.
pub(super) struct PendingCall<'a> {
    pending: &'a PendingCalls,
    id: u32,
    answer: oneshot::Receiver<CallAnswer>,
}

impl PendingCall<'_> {
    pub(super) fn id(&self) -> u32 {
        self.id
    }

    /// Nothing, if the link ends first.
    pub(super) async fn answer(&mut self) -> Option<CallAnswer> {
        (&mut self.answer).await.ok()
    }
}

impl Drop for PendingCall<'_> {
    fn drop(&mut self) {
        locked(&self.pending.0).waiting.remove(&self.id);
    }
}
