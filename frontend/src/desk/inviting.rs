//! Letting others in: the invitations as the server tells them, making and revoking them.

use super::tab::Tab;
use crate::link::NoAnswer;
use behaviour::Id;
use leptos::prelude::*;
use protocol::{Invitation, Lasts, Role, answer, request};

/// An invitation that was just made, with what is told of it only then.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct NewInvitation {
    pub(crate) invitation: Invitation,
    pub(crate) link: String,
    /// The link as a QR code: rows of `0` and `1`.
    pub(crate) qr: Vec<String>,
    /// Of the certificate, if the server made it itself.
    pub(crate) fingerprint: Option<String>,
}

impl Tab {
    /// Makes an invitation.
    pub(crate) fn invite(
        &self,
        (role, lasts, label): (Role, Lasts, String),
        then: impl FnOnce(Result<NewInvitation, NoAnswer>) + 'static,
    ) {
        self.look_up(request::Invite { role, lasts, label }, move |answer| {
            then(answer.map(|answer::Invited { invitation, link, qr, fingerprint }| NewInvitation {
                invitation: *invitation,
                link,
                qr,
                fingerprint,
            }));
        });
    }

    /// Asks for the invitations; every change of them later is told.
    pub(crate) fn list_invitations(&self, on_no: impl FnOnce(NoAnswer) + 'static) {
        let tab = self.clone();
        self.look_up(request::Invitations {}, move |answer| match answer {
            Ok(answer) => tab.invitations.set(answer.invitations),
            Err(why) => on_no(why),
        });
    }

    /// Ends an invitation: whoever came by it is out.
    pub(crate) fn revoke(&self, invitation: &Id) {
        self.ask_or_say_no(request::Revoke { invitation: invitation.clone() });
    }
}
