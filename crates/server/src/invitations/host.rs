//! Who is host: not who comes from this computer, but who shows a secret of it. A program of the user who runs the server
//! shows the key of this start; a browser shows a cookie, which it was given for a link that works once.

use super::secret;
use crate::support::digest::Digest;
use crate::support::{atomic_file, lock};
use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use protocol::JOIN_PATH;
use ring::hmac::{self, HMAC_SHA256};
use std::collections::VecDeque;
use std::net::SocketAddr;
use std::path::Path;
use std::sync::Mutex;

/// The file with what makes cookies, in the data folder. Without it no cookie of before counts any more.
const FILE: &str = "rrp.host-cookies.json";
/// Links that work at a time; the oldest gives way.
const LINKS_MAX: usize = 16;

/// What shows that somebody is the host.
pub(crate) struct HostAccess {
    /// The key of this start, for programs.
    key: String,
    /// Makes cookies, and knows them again after a restart.
    cookies: hmac::Key,
    /// Links that nobody has used yet, oldest first.
    links: Mutex<VecDeque<Digest>>,
}

impl HostAccess {
    /// With the cookies of a data folder; without one they last as long as the server.
    ///
    /// # Errors
    /// If this computer gives no random numbers.
    pub(crate) fn within(data: Option<&Path>) -> std::io::Result<Self> {
        let random = || secret::random().ok_or_else(|| std::io::Error::other("this computer gives no random numbers"));
        let (key, new) = (random()?, random()?);
        let kept = data.map(|data| kept(&data.join(FILE), &new)).unwrap_or(new);
        Ok(Self { key, cookies: hmac::Key::new(HMAC_SHA256, kept.as_bytes()), links: Mutex::default() })
    }

    /// The key that programs of this user show to the server at this address.
    pub(crate) fn key(&self, address: SocketAddr) -> host_key::HostKey {
        host_key::HostKey { address, key: self.key.clone() }
    }

    /// A link by which one browser becomes the host's; none if this computer gives no random numbers any more.
    pub(crate) fn new_link(&self, address: SocketAddr) -> Option<String> {
        let token = secret::random()?;
        let mut links = lock(&self.links);
        if links.len() >= LINKS_MAX {
            links.pop_front();
        }
        links.push_back(Digest::of(&token));
        Some(format!("http://{address}{JOIN_PATH}#{token}"))
    }

    /// Exchanges the token of such a link for a cookie, once.
    pub(crate) fn join(&self, token: &str) -> Option<String> {
        let wanted = Digest::of(token);
        {
            let mut links = lock(&self.links);
            let at = links.iter().position(|link| *link == wanted)?;
            links.remove(at);
        }
        let nonce = secret::random()?;
        let tag = hmac::sign(&self.cookies, nonce.as_bytes());
        Some(format!("{nonce}.{}", URL_SAFE_NO_PAD.encode(tag)))
    }

    /// Whether this is a cookie that was given for a link.
    pub(crate) fn knows_cookie(&self, cookie: &str) -> bool {
        let Some((nonce, tag)) = cookie.split_once('.') else { return false };
        URL_SAFE_NO_PAD.decode(tag).is_ok_and(|tag| hmac::verify(&self.cookies, nonce.as_bytes(), &tag).is_ok())
    }

    /// Whether this is the key of this start.
    pub(crate) fn knows_key(&self, key: &str) -> bool {
        // Digests are compared, so that how long it takes tells nothing of the key.
        Digest::of(key) == Digest::of(&self.key)
    }
}

/// What makes cookies: as it is kept, else the new one, from now on.
fn kept(file: &Path, new: &str) -> String {
    if let Some(kept) = atomic_file::read::<String>(file).filter(|kept| kept.len() == new.len()) {
        return kept;
    }
    if let Err(error) = atomic_file::put(file, &format!("{new:?}")) {
        tracing::warn!(path = %file.display(), %error, "browsers of the host have to come in again after the next start");
    }
    new.to_owned()
}

#[cfg(test)]
mod tests {
    use super::{FILE, HostAccess, LINKS_MAX};

    fn token(link: &str) -> &str {
        link.split_once('#').unwrap().1
    }

    #[test]
    fn a_link_works_once_and_its_cookie_after_a_restart_too() {
        let folder = tempfile::tempdir().unwrap();
        let host = HostAccess::within(Some(folder.path())).unwrap();
        let link = host.new_link("127.0.0.1:7130".parse().unwrap()).unwrap();
        assert!(link.starts_with("http://127.0.0.1:7130/come-in#"), "{link}");
        let cookie = host.join(token(&link)).unwrap();
        assert_eq!(host.join(token(&link)), None, "a second time");
        assert!(host.knows_cookie(&cookie));
        let again = HostAccess::within(Some(folder.path())).unwrap();
        assert!(again.knows_cookie(&cookie));
        let elsewhere = HostAccess::within(None).unwrap();
        let (nonce, tag) = cookie.split_once('.').unwrap();
        for forged in ["", ".", nonce, &format!("{nonce}."), &format!("x{nonce}.{tag}"), &format!("{nonce}.x{tag}")] {
            assert!(!again.knows_cookie(forged), "{forged}");
        }
        assert!(!elsewhere.knows_cookie(&cookie), "another server has another key");
        let kept = std::fs::read_to_string(folder.path().join(FILE)).unwrap();
        assert!(!kept.contains(nonce) && !kept.contains(tag));
    }

    #[test]
    fn links_that_nobody_uses_are_few() {
        let host = HostAccess::within(None).unwrap();
        let links: Vec<_> = (0..=LINKS_MAX).map(|_| host.new_link("127.0.0.1:1".parse().unwrap()).unwrap()).collect();
        assert_eq!(host.join(token(&links[0])), None, "the oldest gave way");
        assert!(host.join(token(&links[1])).is_some() && host.join(token(&links[LINKS_MAX])).is_some());
    }

    #[test]
    fn a_key_is_that_of_one_start() {
        let folder = tempfile::tempdir().unwrap();
        let [first, second] = [(); 2].map(|()| HostAccess::within(Some(folder.path())).unwrap());
        let key = first.key("127.0.0.1:1".parse().unwrap()).key;
        assert!(first.knows_key(&key) && !second.knows_key(&key) && !first.knows_key(""));
    }
}
