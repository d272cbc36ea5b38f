//! Subscribing to signals.

use std::sync::Arc;
use std::time::Duration;

use super::fan_out::{Joined, SUBSCRIBERS_MAX};
use super::mailbox::{EventChoice, EventMailbox, Letter, SignalEvent};
use super::{MemberTarget, QiLink};
use crate::error::QiError;
use crate::signature::ValueSignature;
use crate::value::decode_arguments;
use crate::wire::FLAG_DYNAMIC;

/// Methods that every object has.
const REGISTER: u32 = 0;
const UNREGISTER: u32 = 1;

/// Events of one signal for one listener. Dropping it ends it; the peer is told when it was the last on the link.
#[derive(Debug)]
pub struct Subscription {
    link: QiLink,
    signal: MemberTarget,
    signature: ValueSignature,
    mailbox: Arc<EventMailbox>,
}

impl QiLink {
    /// Listens to a signal whose events carry what `signature` says. The first listener of a signal on this link tells
    /// the peer, all others share its registration.
    ///
    /// # Errors
    /// Fails as any call can, or if the peer refuses; with [`QiError::Busy`] beyond [`SUBSCRIBERS_MAX`].
    pub async fn subscribe(
        &self,
        signal: MemberTarget,
        signature: ValueSignature,
        keep: EventChoice,
        within: Duration,
    ) -> Result<Subscription, QiError> {
        // One after another: whoever comes second must know whether the first succeeded.
        let turn = tokio::time::timeout(within, self.shared().registering.lock());
        let timeout = |_| QiError::Timeout { what: "subscribing".to_owned(), within };
        let _turn = turn.await.map_err(timeout)?;
        let mailbox = Arc::new(EventMailbox::new(keep));
        let joined = self.shared().fan_out.join(signal, Arc::clone(&mailbox));
        // From here on, giving up leaves again.
        let subscription = Subscription { link: self.clone(), signal, signature, mailbox };
        match joined {
            Joined::Others => {}
            Joined::Full => return Err(QiError::Busy { what: "listeners to a signal", limit: SUBSCRIBERS_MAX }),
            Joined::First(registration) => {
                let target = MemberTarget { action: REGISTER, ..signal };
                self.call(target, 0, registering(signal, registration), within, "registerEvent").await?;
            }
        }
        Ok(subscription)
    }
}

/// Both methods take the service, the signal and a number that we choose; what registering answers is another one.
fn registering(signal: MemberTarget, registration: u64) -> Vec<u8> {
    let mut payload = Vec::with_capacity(16);
    payload.extend_from_slice(&signal.service.to_le_bytes());
    payload.extend_from_slice(&signal.action.to_le_bytes());
    payload.extend_from_slice(&registration.to_le_bytes());
    payload
}

impl Subscription {
    /// Waits for the next event. May be given up and asked again without losing one.
    ///
    /// # Errors
    /// [`QiError::Disconnected`] once the link is over and everything that came was taken; [`QiError::Malformed`] for an
    /// event that cannot be read, after which others come.
    pub async fn next(&mut self) -> Result<SignalEvent, QiError> {
        let letter = self.mailbox.take().await.ok_or_else(|| self.link.disconnected())?;
        self.read(&letter)
    }

    /// Returns the number of events that were lost since the beginning because newer ones came before they were taken.
    pub fn lost(&self) -> u64 {
        self.mailbox.lost()
    }

    fn read(&self, letter: &Letter) -> Result<SignalEvent, QiError> {
        let is_dynamic = letter.flags & FLAG_DYNAMIC != 0;
        let signature = if is_dynamic { &ValueSignature::Dynamic } else { &self.signature };
        let arguments = decode_arguments(&letter.payload, signature, self.link.layout())?;
        Ok(SignalEvent { arguments, at: letter.at })
    }
}

impl Drop for Subscription {
    fn drop(&mut self) {
        let (link, signal) = (&self.link, self.signal);
        self.link.shared().fan_out.leave(signal, &self.mailbox, |registration| {
            // A queue that is full forgets this: the peer goes on telling what nobody listens to.
            let target = MemberTarget { action: UNREGISTER, ..signal };
            let _too_late = link.tell(target, registering(signal, registration));
        });
    }
}
