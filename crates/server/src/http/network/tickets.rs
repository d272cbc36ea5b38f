//! What somebody who was here shows in the hello of their next connection: a ticket, sealed with a key of this server that
//! is kept in its data folder, so that it is known after a restart too. It says whose it is: of a device that showed its
//! cookie, or of a connection on which that may be shown later. Who has the key can open nothing that was said on
//! connections, as each agrees on a secret of its own besides; the certificate's key lies beside it.

use crate::support::digest::Digest;
use crate::support::{atomic_file, lock, now_ms};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use ring::aead::{Aad, CHACHA20_POLY1305, LessSafeKey, NONCE_LEN, Nonce, UnboundKey};
use ring::rand::{SecureRandom, SystemRandom};
use serde::{Deserialize, Serialize};
use std::collections::{HashMap, VecDeque};
use std::path::Path;
use std::sync::Mutex;
use uuid::Uuid;

/// The file of the keys.
const FILE: &str = "rrp.tickets.json";
/// A start of the server makes another key when the last one is so old, in milliseconds. What it sealed is opened until the next.
const ANEW_MS: u64 = 30 * 24 * 60 * 60 * 1_000;
/// Keys that open: the one that seals, and the one before.
const KEYS_MAX: usize = 2;
const KEY_BYTES: usize = 32;
const TAG_BYTES: usize = 16;
/// So often one ticket chooses where somebody is heard. Browsers show each once; who listens on the way could show it
/// again and again.
const USES_MAX: u8 = 4;
/// Tickets of which it is remembered how often they were shown; the one that was shown first is forgotten.
const USED_MAX: usize = 4_096;
/// What is sealed with a ticket besides, so that nothing else is taken for one.
const KIND: &[u8] = b"rrp ticket 1";

/// The holder of a ticket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TicketHolder {
    /// Of a device that showed the cookie of this digest.
    Device(Digest),
    /// Of whoever had this connection.
    Connection(Uuid),
}

/// Makes and opens tickets.
pub(super) struct Tickets {
    /// The one that seals first.
    keys: Vec<LessSafeKey>,
    used: Mutex<UsedTickets>,
}

/// A key as it is kept.
#[derive(Clone, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
struct KeptKey {
    made_ms: u64,
    key: String,
}

impl Tickets {
    /// With the keys of a data folder; without one they last as long as the server. None if there is no randomness.
    pub(super) fn within(data: Option<&Path>) -> Option<Self> {
        let file = data.map(|data| data.join(FILE));
        let mut kept: Vec<KeptKey> = file.as_deref().and_then(atomic_file::read).unwrap_or_default();
        kept.retain(|kept| opener(kept).is_some());
        if kept.first().is_none_or(|newest| newest.made_ms.saturating_add(ANEW_MS) < now_ms()) {
            let mut key = [0; KEY_BYTES];
            SystemRandom::new().fill(&mut key).ok()?;
            kept.insert(0, KeptKey { made_ms: now_ms(), key: STANDARD.encode(key) });
            kept.truncate(KEYS_MAX);
            let put =
                |file| serde_json::to_string(&kept).map_err(Into::into).and_then(|text| atomic_file::put(file, &text));
            if let Some(Err(error)) = file.as_deref().map(put) {
                tracing::warn!(%error, "the key of tickets could not be kept: after a restart who was here is asked again");
            }
        }
        Some(Self { keys: kept.iter().filter_map(opener).collect(), used: Mutex::default() })
    }

    /// A ticket of this holder, with what the library wants to find in it again.
    pub(super) fn seal(&self, holder: TicketHolder, said: &[u8]) -> Option<Vec<u8>> {
        let mut nonce = [0; NONCE_LEN];
        SystemRandom::new().fill(&mut nonce).ok()?;
        let mut ticket = nonce.to_vec();
        match holder {
            TicketHolder::Device(pass) => ticket.extend([&[0][..], pass.bytes()].concat()),
            TicketHolder::Connection(id) => ticket.extend([&[1][..], id.as_bytes()].concat()),
        }
        ticket.extend_from_slice(said);
        let sealed = &mut ticket[NONCE_LEN..];
        let nonce = Nonce::assume_unique_for_key(nonce);
        let tag = self.keys.first()?.seal_in_place_separate_tag(nonce, Aad::from(KIND), sealed).ok()?;
        ticket.extend_from_slice(tag.as_ref());
        Some(ticket)
    }

    /// Opens a ticket: its holder, and what the library put into it; none if it was not made here.
    pub(super) fn open(&self, ticket: &[u8]) -> Option<(TicketHolder, Vec<u8>)> {
        let (nonce, sealed) = ticket.split_first_chunk()?;
        self.keys.iter().find_map(|key| {
            let mut sealed = sealed.to_vec();
            let nonce = Nonce::assume_unique_for_key(*nonce);
            let (kind, said) = key.open_in_place(nonce, Aad::from(KIND), &mut sealed).ok()?.split_first()?;
            if *kind == 0 {
                let (pass, said) = said.split_first_chunk()?;
                Some((TicketHolder::Device(Digest::from_bytes(*pass)), said.to_vec()))
            } else {
                let (id, said) = said.split_first_chunk()?;
                Some((TicketHolder::Connection(Uuid::from_bytes(*id)), said.to_vec()))
            }
        })
    }

    /// Counts that a ticket, which was opened, is shown; says whether it was not shown too often.
    pub(super) fn is_fresh(&self, ticket: &[u8]) -> bool {
        ticket.last_chunk().is_some_and(|tag| lock(&self.used).again(*tag) <= USES_MAX)
    }
}

/// What seals and opens with a key.
fn opener(kept: &KeptKey) -> Option<LessSafeKey> {
    let key = STANDARD.decode(&kept.key).ok()?;
    Some(LessSafeKey::new(UnboundKey::new(&CHACHA20_POLY1305, &key).ok()?))
}

/// How often tickets were shown, by the end of each, which no two have in common.
#[derive(Default)]
struct UsedTickets {
    times: HashMap<[u8; TAG_BYTES], u8>,
    order: VecDeque<[u8; TAG_BYTES]>,
}

impl UsedTickets {
    fn again(&mut self, tag: [u8; TAG_BYTES]) -> u8 {
        if let Some(times) = self.times.get_mut(&tag) {
            *times = times.saturating_add(1);
            return *times;
        }
        if self.order.len() >= USED_MAX
            && let Some(first) = self.order.pop_front()
        {
            self.times.remove(&first);
        }
        self.order.push_back(tag);
        self.times.insert(tag, 1);
        1
    }
}

#[cfg(test)]
mod tests {
    use super::{ANEW_MS, Digest, FILE, KeptKey, TicketHolder, Tickets, USED_MAX, USES_MAX, lock};
    use uuid::Uuid;

    #[test]
    fn a_ticket_says_whose_it_is_after_a_restart_too_and_nowhere_else() {
        let folder = tempfile::tempdir().unwrap();
        let tickets = Tickets::within(Some(folder.path())).unwrap();
        for holder in [TicketHolder::Device(Digest::of("a cookie")), TicketHolder::Connection(Uuid::new_v4())] {
            let ticket = tickets.seal(holder, b"what the library says").unwrap();
            let again = Tickets::within(Some(folder.path())).unwrap();
            assert_eq!(again.open(&ticket), Some((holder, b"what the library says".to_vec())));
            assert_eq!(Tickets::within(None).unwrap().open(&ticket), None, "another server has another key");
            for at in 0..ticket.len() {
                let mut forged = ticket.clone();
                forged[at] ^= 1;
                assert_eq!(tickets.open(&forged), None);
                assert_eq!(tickets.open(&ticket[..at]), None);
            }
        }
    }

    #[test]
    fn an_old_key_is_replaced_and_opens_until_the_next() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join(FILE);
        let ticket =
            Tickets::within(Some(folder.path())).unwrap().seal(TicketHolder::Connection(Uuid::nil()), b"").unwrap();
        let grow_old = || {
            let mut kept: Vec<KeptKey> = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
            kept.iter_mut().for_each(|kept| kept.made_ms -= ANEW_MS + 1);
            std::fs::write(&file, serde_json::to_string(&kept).unwrap()).unwrap();
            Tickets::within(Some(folder.path())).unwrap()
        };
        let once = grow_old();
        assert!(once.open(&ticket).is_some());
        assert!(once.open(&once.seal(TicketHolder::Connection(Uuid::nil()), b"").unwrap()).is_some());
        assert!(grow_old().open(&ticket).is_none());
    }

    #[cfg(unix)]
    #[test]
    fn nobody_else_on_this_computer_reads_the_key_and_one_that_cannot_be_read_is_made_anew() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(FILE), "[{\"madeMs\":0,\"key\":\"short\"}]").unwrap();
        let tickets = Tickets::within(Some(folder.path())).unwrap();
        assert!(tickets.seal(TicketHolder::Connection(Uuid::nil()), b"").is_some());
        let mode = std::fs::metadata(folder.path().join(FILE)).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
    }

    #[test]
    fn who_shows_one_ticket_again_and_again_is_not_fresh_and_memory_is_bounded() {
        let tickets = Tickets::within(None).unwrap();
        let fresh = (0..100).filter(|_| tickets.is_fresh(&[7; 60])).count();
        assert_eq!(fresh, usize::from(USES_MAX));
        for number in 0..2 * USED_MAX as u128 {
            assert!(tickets.is_fresh(&number.to_be_bytes()));
        }
        let used = lock(&tickets.used);
        assert!(used.times.len() <= USED_MAX && used.order.len() <= USED_MAX);
    }
}
