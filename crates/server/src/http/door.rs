//! A way in: this computer's own, where the host shows a secret of it, or that of others, who show the cookie of their
//! invitation.

use super::known::Known;
use super::origin::{NotAllowed, OriginGuard};
use crate::invitations::{Asked, Entry, HostAccess, Invitations, Route, Source};
use axum::extract::Request;
use axum::http::{HeaderMap, HeaderName, header};
use std::net::IpAddr;
use std::sync::Arc;

/// What a proxy says of whom it speaks for, the nearest last.
const FORWARDED_FOR: HeaderName = HeaderName::from_static("x-forwarded-for");
/// How names of headers begin that proxies and tunnels add: whoever sends one speaks for somebody else.
const FORWARDED: [&str; 8] =
    ["forwarded", "x-forwarded-", "x-real-ip", "x-client-ip", "via", "cf-", "true-client-ip", "x-original-"];
/// How long a browser keeps the cookie, in seconds: as long as browsers keep any. The server forgets it earlier.
const COOKIE_SECONDS: u64 = 400 * 24 * 60 * 60;

/// A way in.
#[derive(Clone)]
pub(crate) struct Door {
    /// Whose pages may ask.
    pub(crate) guard: OriginGuard,
    /// The name of the cookie. Browsers do not tell ports apart where cookies go, so the name does.
    cookie: Arc<str>,
    /// Whose secrets count.
    shown: Shown,
}

/// Whose secrets count at a door.
#[derive(Clone)]
enum Shown {
    /// Those of this computer.
    Host(Arc<HostAccess>),
    /// Those of invitations.
    Guests {
        invitations: Arc<Invitations>,
        /// From where those who are in come; none if a proxy says that.
        known: Option<Arc<Known>>,
    },
}

/// By which way a request came, and from where.
#[derive(Clone)]
pub(crate) struct Came {
    /// The way.
    pub(crate) door: Door,
    /// The other end of the connection; of a proxy, that.
    pub(crate) peer: IpAddr,
}

/// What lets people in at a door.
pub(crate) enum LetsIn<'a> {
    /// A link of this computer.
    Host(&'a Arc<HostAccess>),
    /// An invitation.
    Guests(&'a Arc<Invitations>),
}

impl Door {
    /// That of this computer, on this port.
    pub(crate) fn local(port: u16, host: Arc<HostAccess>) -> Self {
        Self { guard: OriginGuard::Local(port), cookie: format!("rrp-host-{port}").into(), shown: Shown::Host(host) }
    }

    /// That of others, by TLS on this port. With this prefix browsers take the cookie by TLS only, and from nobody but this
    /// very host.
    pub(crate) fn tls(port: u16, invitations: Arc<Invitations>, known: Arc<Known>) -> Self {
        let shown = Shown::Guests { invitations, known: Some(known) };
        Self { guard: OriginGuard::Tls, cookie: format!("__Host-rrp-{port}").into(), shown }
    }

    /// That of others, through a proxy that serves this origin.
    pub(crate) fn proxied(origin: &str, invitations: Arc<Invitations>) -> Self {
        let shown = Shown::Guests { invitations, known: None };
        Self { guard: OriginGuard::Proxy(origin.into()), cookie: "__Host-rrp".into(), shown }
    }

    /// What lets people in here.
    pub(crate) fn lets_in(&self) -> LetsIn<'_> {
        match &self.shown {
            Shown::Host(host) => LetsIn::Host(host),
            Shown::Guests { invitations, .. } => LetsIn::Guests(invitations),
        }
    }

    /// As whom somebody who sends these headers is in.
    fn entry(&self, headers: &HeaderMap) -> Entry {
        let mut cookies = cookies(headers).filter(|(name, _)| *name == &*self.cookie).map(|(_, value)| value);
        match &self.shown {
            Shown::Host(host) => {
                let key = headers.get(host_key::HEADER).and_then(|value| host_key::shown(value.to_str().ok()?));
                let is_host =
                    key.is_some_and(|key| host.knows_key(key)) || cookies.any(|cookie| host.knows_cookie(cookie));
                if is_host { Entry::Local } else { Entry::Unproven }
            }
            Shown::Guests { invitations, .. } => {
                cookies.find_map(|cookie| invitations.guest(cookie)).map_or(Entry::Stranger, Entry::Guest)
            }
        }
    }

    /// Whether a request is answered at all. Behind a proxy or a tunnel that nobody declared, everybody in the world would
    /// come from this computer: what it passes on is refused.
    ///
    /// # Errors
    /// Why not.
    pub(crate) fn may_enter(&self, request: &Request) -> Result<(), NotAllowed> {
        self.guard.may_enter(request)?;
        if self.is_passed_on(request.headers()) { Err(NotAllowed::Forwarded) } else { Ok(()) }
    }

    /// Whether a Stop is taken from there: from everybody who is in, and from everybody at this computer.
    ///
    /// # Errors
    /// Why not.
    pub(crate) fn may_stop(&self, headers: &HeaderMap) -> Result<(), NotAllowed> {
        self.guard.may_stop(headers)?;
        let entry = self.entry(headers);
        if self.is_passed_on(headers) && !matches!(entry, Entry::Local) {
            return Err(NotAllowed::Forwarded);
        }
        entry.may(Asked::Http(Route::Stop)).map_err(|_| NotAllowed::NotInvited)
    }

    /// Whether an undeclared proxy sends this to the door of this computer, for somebody else.
    fn is_passed_on(&self, headers: &HeaderMap) -> bool {
        matches!(self.shown, Shown::Host(_)) && is_forwarded(headers)
    }

    /// The header that gives somebody the cookie of this secret.
    pub(crate) fn give(&self, secret: &str) -> String {
        // Where this computer is spoken to without TLS, browsers would not keep a cookie for TLS only.
        let secure = if matches!(self.shown, Shown::Host(_)) { "" } else { " Secure;" };
        format!("{}={secret}; Path=/; Max-Age={COOKIE_SECONDS}; HttpOnly;{secure} SameSite=Strict", self.cookie)
    }
}

impl Came {
    /// As whom the sender of a request is in.
    pub(crate) fn entry(&self, headers: &HeaderMap) -> Entry {
        let entry = self.door.entry(headers);
        if let (Entry::Guest(_), Shown::Guests { known: Some(known), .. }) = (&entry, &self.door.shown) {
            known.note(Source::of(self.peer));
        }
        entry
    }

    /// From where a request came: of a proxy, what it says last itself.
    pub(crate) fn source(&self, headers: &HeaderMap) -> Source {
        let is_proxied = matches!(&self.door.shown, Shown::Guests { known: None, .. });
        let lines = is_proxied.then(|| headers.get_all(FORWARDED_FOR));
        let last =
            lines.and_then(|lines| lines.iter().next_back()?.to_str().ok()?.rsplit(',').next()?.trim().parse().ok());
        Source::of(last.unwrap_or(self.peer))
    }
}

/// The cookies of a request, by name.
fn cookies(headers: &HeaderMap) -> impl Iterator<Item = (&str, &str)> {
    let lines = headers.get_all(header::COOKIE).iter().filter_map(|line| line.to_str().ok());
    lines.flat_map(|line| line.split(';')).filter_map(|pair| pair.trim().split_once('='))
}

/// Whether a proxy or a tunnel sends this for somebody else.
fn is_forwarded(headers: &HeaderMap) -> bool {
    headers.keys().any(|name| FORWARDED.iter().any(|begin| name.as_str().starts_with(begin)))
}

#[cfg(test)]
mod tests {
    use super::{Door, NotAllowed};
    use crate::invitations::HostAccess;
    use axum::http::{HeaderMap, HeaderName, HeaderValue};
    use std::sync::Arc;

    fn headers(lines: &[(&'static str, &str)]) -> HeaderMap {
        let line = |(name, value): &(&'static str, &str)| {
            (HeaderName::from_static(name), HeaderValue::from_str(value).unwrap())
        };
        lines.iter().map(line).collect()
    }

    #[test]
    fn what_an_undeclared_proxy_passes_on_is_refused_but_for_the_stop_of_a_host() {
        let host = Arc::new(HostAccess::within(None).unwrap());
        let (door, own) = (Door::local(7130, Arc::clone(&host)), ("host", "127.0.0.1:7130"));
        let key = host_key::header(&host.key("127.0.0.1:7130".parse().unwrap()).key);
        for said in ["forwarded", "x-forwarded-for", "x-forwarded-proto", "x-real-ip", "via", "cf-connecting-ip"] {
            let through = headers(&[own, (said, "203.0.113.9")]);
            assert_eq!(door.may_stop(&through), Err(NotAllowed::Forwarded), "{said}");
            let of_host = headers(&[own, (said, "203.0.113.9"), (host_key::HEADER, &key)]);
            assert_eq!(door.may_stop(&of_host), Ok(()), "{said}");
        }
        assert_eq!(door.may_stop(&headers(&[own])), Ok(()), "at this computer everybody may");
    }
}
