//! A way in: this computer's own, where nothing is asked, or that of others, who show the cookie of their invitation.

use super::origin::{NotAllowed, OriginGuard};
use crate::invitations::{Asked, Digest, Entry, Guest, Invitations, Route, Source};
use axum::http::{HeaderMap, HeaderName, header};
use std::net::IpAddr;
use std::sync::Arc;

/// What a proxy says of whom it speaks for, the nearest last.
const FORWARDED: HeaderName = HeaderName::from_static("x-forwarded-for");
/// How long a browser keeps the cookie, in seconds: as long as browsers keep any. The server forgets it earlier.
const COOKIE_SECONDS: u64 = 400 * 24 * 60 * 60;

/// Cookies of our name in one request that are looked at: browsers send one.
const COOKIES_MAX: usize = 4;

/// A way in.
#[derive(Clone)]
pub(crate) struct Door {
    /// Whose pages may ask.
    pub(crate) guard: OriginGuard,
    /// Who may, if that is asked here.
    others: Option<Others>,
}

/// Who comes in by the way of others.
#[derive(Clone)]
struct Others {
    invitations: Arc<Invitations>,
    /// The name of the cookie.
    cookie: Arc<str>,
    /// A proxy says from where they come.
    is_proxied: bool,
    /// Told who shows a cookie that holds.
    noting: Option<Noting>,
}

/// Notes the digest of a cookie that holds, without waiting.
pub(crate) type Noting = Arc<dyn Fn(Digest) + Send + Sync>;

/// By which way a request came, and from where.
#[derive(Clone)]
pub(crate) struct Came {
    /// The way.
    pub(crate) door: Door,
    /// The other end of the connection; of a proxy, that.
    pub(crate) peer: IpAddr,
}

impl Door {
    /// That of this computer, on this port.
    pub(crate) fn local(port: u16) -> Self {
        Self { guard: OriginGuard::Local(port), others: None }
    }

    /// That of others, by TLS on this port. Browsers do not tell ports apart where cookies go, so the name does. With this
    /// prefix they take the cookie by TLS only, and from nobody but this very host.
    pub(crate) fn tls(port: u16, invitations: Arc<Invitations>) -> Self {
        let cookie = format!("__Host-rrp-{port}").into();
        let others = Others { invitations, cookie, is_proxied: false, noting: None };
        Self { guard: OriginGuard::Tls, others: Some(others) }
    }

    /// That of others, through a proxy that serves this origin.
    pub(crate) fn proxied(origin: &str, invitations: Arc<Invitations>) -> Self {
        let others = Others { invitations, cookie: "__Host-rrp".into(), is_proxied: true, noting: None };
        Self { guard: OriginGuard::Proxy(origin.into()), others: Some(others) }
    }

    /// The invitations that are asked for here.
    pub(crate) fn invitations(&self) -> Option<&Arc<Invitations>> {
        self.others.as_ref().map(|others| &others.invitations)
    }

    /// This way, for one connection: who shows a cookie on it is noted.
    pub(crate) fn noting(&self, noting: Noting) -> Self {
        let others = self.others.clone().map(|others| Others { noting: Some(noting), ..others });
        Self { others, ..self.clone() }
    }

    /// As whom somebody with these cookies is in.
    fn entry<'a>(&self, cookies: impl Iterator<Item = &'a str>) -> Entry {
        let Some(others) = &self.others else { return Entry::Local };
        others.guest(cookies).map_or(Entry::Stranger, Entry::Guest)
    }

    /// The digest of the first of these cookies that holds.
    pub(crate) fn pass<'a>(&self, cookies: impl Iterator<Item = &'a str>) -> Option<Digest> {
        Some(self.others.as_ref()?.guest(cookies)?.pass())
    }

    /// Whether a Stop is taken from there: from everybody who is in.
    ///
    /// # Errors
    /// Why not.
    pub(crate) fn may_stop<'a>(
        &self,
        host: Option<&str>,
        origin: Option<&str>,
        cookies: impl Iterator<Item = &'a str>,
    ) -> Result<(), NotAllowed> {
        self.guard.may_stop(host, origin)?;
        self.entry(cookies).may(Asked::Http(Route::Stop)).map_err(|_| NotAllowed::NotInvited)
    }

    /// The header that gives somebody the cookie of this secret. From now on they are known.
    pub(crate) fn give(&self, secret: &str) -> Option<String> {
        let others = self.others.as_ref()?;
        others.invitations.guest(secret).iter().for_each(|guest| others.note(guest));
        let name = &others.cookie;
        Some(format!("{name}={secret}; Path=/; Max-Age={COOKIE_SECONDS}; HttpOnly; Secure; SameSite=Strict"))
    }
}

impl Others {
    /// Who shows one of these cookies.
    fn guest<'a>(&self, cookies: impl Iterator<Item = &'a str>) -> Option<Guest> {
        let all = cookies.flat_map(|line| line.split(';')).filter_map(|pair| pair.trim().split_once('='));
        let own = all.filter(|(name, _)| *name == &*self.cookie).map(|(_, value)| value);
        let guest = own.take(COOKIES_MAX).filter_map(|value| self.invitations.guest(value)).next();
        guest.iter().for_each(|guest| self.note(guest));
        guest
    }

    fn note(&self, guest: &Guest) {
        self.noting.iter().for_each(|note| note(guest.pass()));
    }
}

impl Came {
    /// As whom the sender of a request is in.
    pub(crate) fn entry(&self, headers: &HeaderMap) -> Entry {
        self.door.entry(cookies(headers))
    }

    /// From where a request came: of a proxy, what it says last itself.
    pub(crate) fn source(&self, headers: &HeaderMap) -> Source {
        let is_proxied = self.door.others.as_ref().is_some_and(|others| others.is_proxied);
        let lines = is_proxied.then(|| headers.get_all(FORWARDED));
        let last =
            lines.and_then(|lines| lines.iter().next_back()?.to_str().ok()?.rsplit(',').next()?.trim().parse().ok());
        Source::of(last.unwrap_or(self.peer))
    }
}

/// The cookies of a request.
fn cookies(headers: &HeaderMap) -> impl Iterator<Item = &str> {
    headers.get_all(header::COOKIE).iter().filter_map(|line| line.to_str().ok())
}
