//! Letting others in from the start.

use super::ServeError;
use crate::http::network::{self, BoundNetwork, GuestNetwork, NotOpened};
use crate::invitations::Invitations;
use crate::support::tasks::blocking;
use protocol::{Invitation, Lasts, Role};
use std::path::Path;
use std::sync::Arc;

/// How somebody comes in from elsewhere.
#[derive(Clone, Debug)]
pub struct InvitedFrom {
    /// What who comes may do.
    pub role: Role,
    /// How long the link works.
    pub lasts: Lasts,
    /// The link to give to them.
    pub link: String,
    /// That as a QR code: a row of `0` and `1` each, without the quiet zone.
    pub qr: Vec<String>,
    /// The fingerprint of the certificate that their browser shows, if the server made it.
    pub fingerprint: Option<String>,
}

/// Listens for others.
pub(super) fn open(
    network: &GuestNetwork,
    data: Option<&Path>,
    invitations: &Arc<Invitations>,
) -> Result<BoundNetwork, ServeError> {
    network::open(network, data, invitations).map_err(|why| match why {
        NotOpened::Listen(error) => ServeError::Listen(network.listen, error),
        NotOpened::Certificate(why) => ServeError::Certificate(why),
    })
}

/// The invitation that is told at the start. Where it cannot be made, as on a full disk, those who came before still come.
pub(super) async fn first_invitation(all: &Arc<Invitations>) -> Option<InvitedFrom> {
    let all = Arc::clone(all);
    match blocking(move || all.make_at_start()).await {
        Ok(Ok(made)) => {
            let (Invitation { role, lasts, .. }, link) = (made.invitation, made.link);
            Some(InvitedFrom { role, lasts, link, qr: made.qr, fingerprint: made.fingerprint })
        }
        Ok(Err(why)) => {
            tracing::warn!(%why, "nobody new is invited");
            None
        }
        Err(error) => {
            tracing::error!(%error, "inviting failed inside");
            None
        }
    }
}
