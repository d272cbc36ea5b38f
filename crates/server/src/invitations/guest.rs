//! Who came by an invitation and is here now.

use super::{Digest, Invitations};
use crate::support::now_ms;
use behaviour::Id;
use protocol::Role;
use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;
use tokio_util::sync::CancellationToken;

/// Somebody who came by an invitation.
#[derive(Clone, Debug)]
pub(crate) struct Guest {
    /// What they may do.
    pub(crate) role: Role,
    /// By which they came.
    pub(super) invitation: Id,
    pub(super) pass: Digest,
    pub(super) ends_ms: Option<u64>,
    pub(super) over: CancellationToken,
}

impl Guest {
    /// The digest of their cookie: one for each device that came in.
    pub(crate) fn pass(&self) -> Digest {
        self.pass
    }

    /// Whether they may not be here any more.
    pub(crate) fn is_over(&self) -> bool {
        self.over.is_cancelled() || self.ends_ms.is_some_and(|ends_ms| ends_ms <= now_ms())
    }

    /// Waits until that is so.
    pub(crate) async fn until_over(&self) {
        let ends = async {
            match self.ends_ms {
                Some(ends_ms) => tokio::time::sleep(Duration::from_millis(ends_ms.saturating_sub(now_ms()))).await,
                None => std::future::pending().await,
            }
        };
        tokio::select! {
            () = self.over.cancelled() => {}
            () = ends => {}
        }
    }
}

/// Who is here, and what tells them to go.
#[derive(Debug, Default)]
pub(super) struct Live {
    over: HashMap<Id, CancellationToken>,
    here: HashMap<Digest, usize>,
}

impl Live {
    /// What is cancelled with the end of an invitation.
    pub(super) fn over(&mut self, invitation: &Id) -> CancellationToken {
        self.over.entry(invitation.clone()).or_default().clone()
    }

    /// Tells everyone by this invitation to go.
    pub(super) fn end(&mut self, invitation: &Id) {
        if let Some(over) = self.over.remove(invitation) {
            over.cancel();
        }
    }

    pub(super) fn arrive(&mut self, pass: &Digest) {
        *self.here.entry(*pass).or_default() += 1;
    }

    pub(super) fn leave(&mut self, pass: &Digest) {
        if let Some(count) = self.here.get_mut(pass) {
            *count -= 1;
            if *count == 0 {
                self.here.remove(pass);
            }
        }
    }

    pub(super) fn is_here(&self, pass: &Digest) -> bool {
        self.here.contains_key(pass)
    }
}

/// As long as this is there, a guest is here.
pub(crate) struct GuestPresence {
    all: Arc<Invitations>,
    pass: Digest,
}

impl GuestPresence {
    pub(super) fn of(all: Arc<Invitations>, pass: Digest) -> Self {
        Self { all, pass }
    }
}

impl Drop for GuestPresence {
    fn drop(&mut self) {
        self.all.leave(&self.pass);
    }
}
