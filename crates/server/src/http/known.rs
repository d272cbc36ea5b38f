//! By which marks those who are in are known before they show their cookie: the address that they came from, and the
//! tickets that a connection of theirs left with. It is kept in the data folder, so that they are known after a restart,
//! and written later: nobody waits for that, a Stop least of all.

use crate::invitations::Invitations;
use crate::support::digest::Digest;
use crate::support::tasks::blocking;
use crate::support::{atomic_file, lock};
use serde::{Deserialize, Serialize};
use std::collections::{HashMap, VecDeque};
use std::net::IpAddr;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tokio::sync::Notify;
use tokio_util::sync::CancellationToken;
use uuid::Uuid;

/// The file of the marks.
const FILE: &str = "rrp.known.json";
/// Marks of one device; the oldest is forgotten.
const MARKS_MAX: usize = 32;
/// Devices that are known by marks; the one that was noted longest ago is forgotten.
const DEVICES_MAX: usize = 1_024;
/// How long what is new is gathered before it is written, in milliseconds.
const LATER_MS: u64 = 500;

/// Something that somebody is known by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) enum KnownBy {
    /// A connection comes from there: all of it, as others may be in the same network.
    Address(IpAddr),
    /// It shows a ticket of this earlier connection.
    Tickets(Uuid),
}

/// Everybody who is known.
pub(crate) struct KnownPeople {
    file: Option<PathBuf>,
    invitations: Arc<Invitations>,
    marks: Mutex<KnownMarks>,
    /// There is something to be written.
    is_new: AtomicBool,
    changed: Notify,
}

#[derive(Debug, Default)]
struct KnownMarks {
    now: u64,
    devices: HashMap<Digest, GuestDevice>,
    /// Devices with a mark.
    by: HashMap<KnownBy, Vec<Digest>>,
}

#[derive(Debug, Default)]
struct GuestDevice {
    /// When it was last noted.
    at: u64,
    /// Oldest first.
    marks: VecDeque<KnownBy>,
}

/// A device as it is kept.
#[derive(Serialize, Deserialize)]
struct KeptDevice {
    /// Of its cookie.
    pass: Digest,
    marks: VecDeque<KnownBy>,
}

impl KnownPeople {
    /// Those of a data folder; without one they last as long as the server.
    pub(crate) fn within(data: Option<&Path>, invitations: Arc<Invitations>) -> Arc<Self> {
        let file = data.map(|data| data.join(FILE));
        let kept: Vec<KeptDevice> = file.as_deref().and_then(atomic_file::read).unwrap_or_default();
        let mut marks = KnownMarks::default();
        for KeptDevice { pass, marks: of } in kept {
            for mark in of {
                marks.note(mark, pass, |pass| invitations.holds(pass));
            }
        }
        let (marks, is_new, changed) = (Mutex::new(marks), AtomicBool::default(), Notify::new());
        Arc::new(Self { file, invitations, marks, is_new, changed })
    }

    /// The device with this cookie is known by this from now on.
    pub(crate) fn note(&self, mark: KnownBy, pass: Digest) {
        if lock(&self.marks).note(mark.canonical(), pass, |pass| self.holds(pass)) {
            self.is_new.store(true, Ordering::Release);
            self.changed.notify_one();
        }
    }

    /// The digest of a cookie that still holds, of a device that is known by this.
    pub(crate) fn pass(&self, mark: KnownBy) -> Option<Digest> {
        let marks = lock(&self.marks);
        marks.by.get(&mark.canonical())?.iter().find(|pass| self.holds(pass)).copied()
    }

    /// Whether a cookie of this digest still lets somebody in.
    pub(crate) fn holds(&self, pass: &Digest) -> bool {
        self.invitations.holds(pass)
    }

    /// Writes what is new until `ending`, and once more then.
    pub(crate) async fn keep(&self, ending: CancellationToken) {
        while ending.run_until_cancelled(self.changed.notified()).await.is_some() {
            ending.run_until_cancelled(tokio::time::sleep(Duration::from_millis(LATER_MS))).await;
            self.write().await;
        }
        self.write().await;
    }

    async fn write(&self) {
        let Some(file) = self.file.clone().filter(|_| self.is_new.swap(false, Ordering::AcqRel)) else { return };
        let kept = self.kept();
        let put = move || {
            let text = serde_json::to_string(&kept).map_err(std::io::Error::other)?;
            atomic_file::put(&file, &text)
        };
        if let Ok(Err(error)) = blocking(put).await {
            tracing::warn!(%error, "who is known could not be kept: after a restart some have to show themselves again");
        }
    }

    /// Those who are still in, as they are kept.
    fn kept(&self) -> Vec<KeptDevice> {
        let marks = lock(&self.marks);
        let devices = marks.devices.iter().filter(|(pass, _)| self.holds(pass));
        devices.map(|(pass, device)| KeptDevice { pass: *pass, marks: device.marks.clone() }).collect()
    }
}

impl KnownBy {
    fn canonical(self) -> Self {
        match self {
            Self::Address(address) => Self::Address(address.to_canonical()),
            Self::Tickets(_) => self,
        }
    }
}

impl KnownMarks {
    /// Says whether this is new.
    fn note(&mut self, mark: KnownBy, pass: Digest, holds: impl Fn(&Digest) -> bool) -> bool {
        self.now += 1;
        if !self.devices.contains_key(&pass) && self.devices.len() >= DEVICES_MAX {
            self.make_room(holds);
        }
        let device = self.devices.entry(pass).or_default();
        device.at = self.now;
        if let Some(at) = device.marks.iter().position(|known| *known == mark) {
            device.marks.remove(at);
            device.marks.push_back(mark);
            return false;
        }
        let oldest = if device.marks.len() >= MARKS_MAX { device.marks.pop_front() } else { None };
        device.marks.push_back(mark);
        self.by.entry(mark).or_default().push(pass);
        oldest.into_iter().for_each(|oldest| self.unmark(oldest, pass));
        true
    }

    /// Forgets those who are not in any more, else the one that was noted longest ago.
    fn make_room(&mut self, holds: impl Fn(&Digest) -> bool) {
        let mut gone: Vec<Digest> = self.devices.keys().filter(|pass| !holds(pass)).copied().collect();
        if gone.is_empty() {
            gone.extend(self.devices.iter().min_by_key(|(_, device)| device.at).map(|(pass, _)| *pass));
        }
        gone.into_iter().for_each(|pass| self.forget(pass));
    }

    fn forget(&mut self, pass: Digest) {
        let device = self.devices.remove(&pass).unwrap_or_default();
        device.marks.into_iter().for_each(|mark| self.unmark(mark, pass));
    }

    fn unmark(&mut self, mark: KnownBy, pass: Digest) {
        if let Some(of) = self.by.get_mut(&mark) {
            of.retain(|known| *known != pass);
            if of.is_empty() {
                self.by.remove(&mark);
            }
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::{DEVICES_MAX, Digest, Invitations, KnownBy, KnownPeople, MARKS_MAX, lock};
    use crate::invitations::{GuessSource, LinkTarget, Terms};
    use protocol::{Lasts, Role};
    use std::path::Path;
    use std::sync::Arc;
    use tokio_util::sync::CancellationToken;
    use uuid::Uuid;

    fn address(text: &str) -> KnownBy {
        KnownBy::Address(text.parse().unwrap())
    }

    /// Invitations, one of them with a cookie that came by it.
    pub(in crate::http) fn invited(data: &Path) -> (Arc<Invitations>, behaviour::Id, String) {
        let invitations = Invitations::within(Some(data));
        invitations.open(LinkTarget { origin: "https://10.0.0.1:7130".into(), fingerprint: None });
        let terms = Terms { role: Role::Viewer, lasts: Lasts::Once, label: String::new(), made_by: "Aiko".into() };
        let invited = invitations.make(terms).unwrap();
        let token = invited.link.split_once('#').unwrap().1;
        let cookie = invitations.join(token, GuessSource::of("10.0.0.2".parse().unwrap())).unwrap();
        (invitations, invited.invitation.id, cookie)
    }

    /// As `invited`, with the digest of the cookie.
    fn came(data: &Path) -> (Arc<Invitations>, behaviour::Id, Digest) {
        let (invitations, invitation, cookie) = invited(data);
        (invitations, invitation, Digest::of(&cookie))
    }

    #[tokio::test]
    async fn who_is_in_is_known_after_a_restart_and_who_is_revoked_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let (invitations, invitation, pass) = came(folder.path());
        let known = KnownPeople::within(Some(folder.path()), Arc::clone(&invitations));
        let marks = [address("10.0.0.2"), address("2001:db8::2"), KnownBy::Tickets(Uuid::new_v4())];
        marks.iter().for_each(|mark| known.note(*mark, pass));
        let ending = CancellationToken::new();
        ending.cancel();
        known.keep(ending.clone()).await;
        let known = KnownPeople::within(Some(folder.path()), Arc::clone(&invitations));
        for mark in marks.into_iter().chain([address("::ffff:10.0.0.2")]) {
            assert_eq!(known.pass(mark), Some(pass), "{mark:?}");
        }
        for mark in [address("10.0.0.3"), address("2001:db8::3"), KnownBy::Tickets(Uuid::new_v4())] {
            assert_eq!(known.pass(mark), None, "not the network: {mark:?}");
        }
        invitations.revoke(&invitation).unwrap();
        assert!(marks.into_iter().all(|mark| known.pass(mark).is_none()));
        known.note(address("10.0.0.9"), pass);
        known.keep(ending).await;
        let text = std::fs::read_to_string(folder.path().join(super::FILE)).unwrap();
        assert_eq!(text, "[]", "who is revoked is not kept");
    }

    #[test]
    fn nobody_takes_the_marks_of_others_and_memory_is_bounded() {
        let folder = tempfile::tempdir().unwrap();
        let (invitations, _, pass) = came(folder.path());
        let known = KnownPeople::within(None, invitations);
        known.note(address("10.0.0.2"), pass);
        for number in 0..10 * MARKS_MAX as u128 {
            known.note(KnownBy::Tickets(Uuid::from_u128(number)), Digest::of("one"));
        }
        assert_eq!(known.pass(address("10.0.0.2")), Some(pass), "whatever another one shows");
        for number in 0..2 * DEVICES_MAX {
            known.note(KnownBy::Tickets(Uuid::from_u128(number as u128)), Digest::of(&number.to_string()));
            known.note(address("10.0.0.2"), pass);
        }
        assert_eq!(known.pass(address("10.0.0.2")), Some(pass), "noted lately");
        let marks = lock(&known.marks);
        assert!(marks.devices.len() <= DEVICES_MAX && marks.by.len() <= DEVICES_MAX);
    }
}
