//! As whom somebody is in.

use super::guest::Guest;
use super::permissions::{AskedOperation, Route, least};
use crate::support::identity::PersonIdentity;
use behaviour::Id;
use protocol::{AnyRequest, Refused, Role};

/// The least that somebody must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum MinimumRole {
    /// Nobody in particular.
    Anyone,
    /// Invited, or the host, and may do at least as much.
    In(Role),
}

/// As whom somebody is in.
#[derive(Clone, Debug)]
pub(crate) enum Identified {
    /// The host: who showed a secret of this computer.
    Host,
    /// By an invitation.
    Guest(Guest),
    /// At this computer, but nothing shows that they are its host.
    Unproven,
    /// Not at all.
    Stranger,
}

impl Identified {
    /// What they may do.
    pub(crate) fn role(&self) -> Option<Role> {
        match self {
            Self::Host => Some(Role::Host),
            Self::Guest(guest) => Some(guest.role),
            Self::Unproven | Self::Stranger => None,
        }
    }

    /// Whose share of the server they take: the only way to an identity.
    pub(crate) fn identity(&self) -> PersonIdentity {
        match self {
            Self::Host => PersonIdentity::Host,
            Self::Guest(guest) => PersonIdentity::Guest { invitation: guest.invitation.clone(), pass: guest.pass },
            Self::Unproven | Self::Stranger => PersonIdentity::Stranger,
        }
    }

    /// By which invitation they came.
    pub(crate) fn invitation(&self) -> Option<&Id> {
        match self {
            Self::Guest(guest) => Some(&guest.invitation),
            Self::Host | Self::Unproven | Self::Stranger => None,
        }
    }

    /// Whether the invitation that let them in has ended.
    pub(crate) fn is_over(&self) -> bool {
        matches!(self, Self::Guest(guest) if guest.is_over())
    }

    /// Whether they may ask this: the one place where a role is asked, whatever way the request came.
    ///
    /// # Errors
    /// What they would have to be, or that they may not be here at all.
    pub(crate) fn may(&self, asked: AskedOperation) -> Result<(), Refused> {
        let MinimumRole::In(least) = least(&asked) else { return Ok(()) };
        // Who stands beside the robot's computer may stop the robot.
        if matches!((self, asked), (Self::Unproven, AskedOperation::Http(Route::Stop))) {
            return Ok(());
        }
        // Who is told to go may press Stop until the socket is closed.
        if self.is_over() && !matches!(asked, AskedOperation::Socket(AnyRequest::Stop(_))) {
            return Err(Refused::NotInvited);
        }
        match self.role() {
            Some(role) if role >= least => Ok(()),
            Some(_) => Err(Refused::Role(least)),
            None => Err(Refused::NotInvited),
        }
    }

    /// Waits until they may not be here any more; for ever if no invitation let them in.
    pub(crate) async fn until_over(&self) {
        match self {
            Self::Guest(guest) => guest.until_over().await,
            Self::Host | Self::Unproven | Self::Stranger => std::future::pending().await,
        }
    }
}
