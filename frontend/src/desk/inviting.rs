//! Letting others in: the invitations as the server tells them, making and revoking them.

use super::tab::Tab;
use crate::link::NoAnswer;
use behaviour::Id;
use protocol::{Invitation, Lasts, Reply, Request, Role};

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
        self.look_up(Request::Invite { role, lasts, label }, move |answer| match answer {
            Ok(Reply::Invited { invitation, link, qr, fingerprint }) => then(Ok(NewInvitation {
                invitation: (**invitation).clone(),
                link: link.clone(),
                qr: qr.clone(),
                fingerprint: fingerprint.clone(),
            })),
            Ok(_) => {}
            Err(why) => then(Err(why)),
        });
    }

    /// Asks for the invitations; the answer, and every change of them later, is heard.
    pub(crate) fn list_invitations(&self, on_no: impl FnOnce(NoAnswer) + 'static) {
        self.look_up(Request::Invitations, move |answer| {
            if let Err(why) = answer {
                on_no(why);
            }
        });
    }

    /// Ends an invitation: whoever came by it is out.
    pub(crate) fn revoke(&self, invitation: &Id) {
        self.ask_or_say(Request::Revoke { invitation: invitation.clone() }, |_| {});
    }
}
