//! Whose share of the server something takes. A person may have many links, addresses and requests; every place, queue, limit
//! and turn is keyed by the person, and people who came by one invitation are one group, as one link can give somebody many
//! cookies.

use super::digest::Digest;
use behaviour::Id;

/// As whom somebody asks. Made by `Entry::identity` only, so that nobody takes a share as somebody else.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum PersonIdentity {
    /// The host, by all their links and pages.
    Host,
    /// Who has this cookie of an invitation.
    Guest {
        /// The invitation.
        invitation: Id,
        /// The digest of the cookie.
        pass: Digest,
    },
    /// Nobody in particular: all of them together.
    Stranger,
}

/// People, or work, among whom the server is shared out first.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum ShareGroup {
    /// The host.
    Host,
    /// Who came by an invitation.
    Invitation(Id),
    /// Who did not.
    Strangers,
    /// All open behaviours, for everyone in them.
    Rooms,
    /// The server itself.
    Server,
}

impl PersonIdentity {
    /// The group of this person.
    pub(crate) fn group(&self) -> ShareGroup {
        match self {
            Self::Host => ShareGroup::Host,
            Self::Guest { invitation, .. } => ShareGroup::Invitation(invitation.clone()),
            Self::Stranger => ShareGroup::Strangers,
        }
    }

    /// What this person asks, on this link. A guest's links are one sender. Those of the host are one each, as programs that
    /// the host runs speak for many, such as `rrp load`, and strangers are told apart by where they come from; together they
    /// are one group.
    pub(crate) fn asks(&self, link: u64) -> Sender {
        let link = if let Self::Guest { .. } = self { 0 } else { link };
        Sender::Asks(self.clone(), link)
    }

    /// What this person is told on this link.
    pub(crate) fn told(&self, link: u64) -> Sender {
        Sender::Told(self.clone(), link)
    }
}

/// For whom something is done. Of one sender one thing is under way at a time; groups take turns, and senders in a group.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Sender {
    /// What a person asks.
    Asks(PersonIdentity, u64),
    /// What a person is told on a link.
    Told(PersonIdentity, u64),
    /// What is done for everyone in an open behaviour.
    Room(Id),
    /// The server itself.
    Server,
}

impl Sender {
    /// The group that this is done for.
    pub(crate) fn group(&self) -> ShareGroup {
        match self {
            Self::Asks(identity, _) | Self::Told(identity, _) => identity.group(),
            Self::Room(_) => ShareGroup::Rooms,
            Self::Server => ShareGroup::Server,
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::{Digest, Id, PersonIdentity};

    /// Somebody who came by an invitation, with this cookie.
    pub(crate) fn guest(invitation: &str, cookie: &str) -> PersonIdentity {
        PersonIdentity::Guest { invitation: Id::new(invitation).unwrap(), pass: Digest::of(cookie) }
    }
}
