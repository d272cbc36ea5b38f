//! The requests about letting others in, which is kept before it counts.

use crate::connection::start::Starter;
use crate::invitations::{Invited, Terms};
use crate::state::ServerState;
use protocol::{Refused, answer, request};

pub(super) fn invite(state: &ServerState, who: &Starter, of: request::Invite) -> Result<answer::Invited, Refused> {
    let terms = Terms { role: of.role, lasts: of.lasts, label: of.label, made_by: who.name.clone() };
    let Invited { invitation, link, qr, fingerprint } = state.invitations.make(terms)?;
    Ok(answer::Invited { invitation: Box::new(invitation), link, qr, fingerprint })
}

pub(super) fn invitations(
    state: &ServerState,
    _: &Starter,
    _: request::Invitations,
) -> Result<answer::Invitations, Refused> {
    let all = &state.invitations;
    if all.lets_in() { Ok(answer::Invitations { invitations: all.list() }) } else { Err(Refused::NobodyComes) }
}

/// Revokes an invitation. It holds at once, whether or not it could be written.
pub(super) fn revoke(state: &ServerState, _: &Starter, of: request::Revoke) -> Result<(), Refused> {
    let revoked = state.invitations.revoke(&of.invitation);
    state.robots.revoked(&of.invitation);
    revoked
}
