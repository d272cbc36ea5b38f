//! What who may invite asks about that.

use super::ClientSession;
use crate::invitations::{Invited, Terms};
use protocol::{Refused, Reply, Request};
use std::sync::Arc;

impl ClientSession {
    /// Does what is asked about letting others in, which is kept before it counts.
    pub(super) fn invitations(&self, ask: u32, request: Request) {
        let (all, made_by) = (Arc::clone(&self.state().invitations), self.me.name.clone());
        let robots = self.state().robots.clone();
        let work = move || match request {
            Request::Invite { role, lasts, label } => {
                let Invited { invitation, link, qr, fingerprint } = all.make(Terms { role, lasts, label, made_by })?;
                Ok(Reply::Invited { invitation: Box::new(invitation), link, qr, fingerprint })
            }
            Request::Revoke { invitation } => {
                let revoked = all.revoke(&invitation);
                // It holds at once, whether or not it could be written.
                robots.revoked(&invitation);
                revoked.map(|()| Reply::Done)
            }
            _ if !all.lets_in() => Err(Refused::NobodyComes),
            _ => Ok(Reply::Invitations { invitations: all.list() }),
        };
        self.on_files(ask, work);
    }
}
