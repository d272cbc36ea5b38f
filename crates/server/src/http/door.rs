//! A way in: this computer's own, where the host shows a secret of it, or that of others, who show the cookie of their
//! invitation.

use super::origin::{NotAllowed, OriginGuard};
use crate::invitations::{AskedOperation, GuessSource, Guest, HostAccess, Identified, Invitations, Route};
use crate::support::digest::Digest;
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

/// Cookies of our name in one request that are looked at: browsers send one.
const COOKIES_MAX: usize = 4;

/// A way in.
#[derive(Clone)]
pub(crate) struct EntryDoor {
    /// Whose pages may ask.
    pub(crate) guard: OriginGuard,
    /// The name of the cookie. Browsers do not tell ports apart where cookies go, so the name does.
    cookie: Arc<str>,
    /// Whose secrets count.
    shown: SecretScope,
}

/// Whose secrets count at a door.
#[derive(Clone)]
enum SecretScope {
    /// Those of this computer, on this port.
    Host(Arc<HostAccess>, u16),
    /// Those of invitations.
    Guests(Guests),
}

/// Who comes in by the way of others.
#[derive(Clone)]
struct Guests {
    invitations: Arc<Invitations>,
    /// A proxy says from where they come.
    is_proxied: bool,
    /// Told who shows a cookie that holds.
    noting: Option<CookieNoting>,
}

/// Notes the digest of a cookie that holds, without waiting.
pub(crate) type CookieNoting = Arc<dyn Fn(Digest) + Send + Sync>;

/// By which way a request came, and from where.
#[derive(Clone)]
pub(crate) struct RequestArrival {
    /// The way.
    pub(crate) door: EntryDoor,
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

impl EntryDoor {
    /// That of this computer, on this port.
    pub(crate) fn local(port: u16, host: Arc<HostAccess>) -> Self {
        Self {
            guard: OriginGuard::Local,
            cookie: format!("rrp-host-{port}").into(),
            shown: SecretScope::Host(host, port),
        }
    }

    /// That of others, by TLS on this port. With this prefix browsers take the cookie by TLS only, and from nobody but this
    /// very host.
    pub(crate) fn tls(port: u16, invitations: Arc<Invitations>) -> Self {
        let shown = SecretScope::Guests(Guests { invitations, is_proxied: false, noting: None });
        Self { guard: OriginGuard::Tls, cookie: format!("__Host-rrp-{port}").into(), shown }
    }

    /// That of others, through a proxy that serves this origin.
    pub(crate) fn proxied(origin: &str, invitations: Arc<Invitations>) -> Self {
        let shown = SecretScope::Guests(Guests { invitations, is_proxied: true, noting: None });
        Self { guard: OriginGuard::Proxy(origin.into()), cookie: "__Host-rrp".into(), shown }
    }

    /// This way, for one connection: which guest shows a cookie on it is noted.
    pub(crate) fn noting(&self, noting: CookieNoting) -> Self {
        let mut this = self.clone();
        if let SecretScope::Guests(guests) = &mut this.shown {
            guests.noting = Some(noting);
        }
        this
    }

    /// What lets people in here.
    pub(crate) fn lets_in(&self) -> LetsIn<'_> {
        match &self.shown {
            SecretScope::Host(host, _) => LetsIn::Host(host),
            SecretScope::Guests(guests) => LetsIn::Guests(&guests.invitations),
        }
    }

    /// As whom somebody who sends these headers is in.
    fn entry(&self, headers: &HeaderMap) -> Identified {
        let lines = headers.get_all(header::COOKIE).iter().filter_map(|line| line.to_str().ok());
        let mut cookies = self.cookies(lines);
        match &self.shown {
            SecretScope::Host(host, _) => {
                let key = headers.get(host_key::HEADER).and_then(|value| host_key::shown(value.to_str().ok()?));
                let is_host =
                    key.is_some_and(|key| host.knows_key(key)) || cookies.any(|cookie| host.knows_cookie(cookie));
                if is_host { Identified::Host } else { Identified::Unproven }
            }
            SecretScope::Guests(guests) => guests.guest(cookies).map_or(Identified::Stranger, Identified::Guest),
        }
    }

    /// The digest of the first guest's cookie in these lines that holds.
    pub(crate) fn pass<'a>(&self, lines: impl Iterator<Item = &'a str>) -> Option<Digest> {
        let SecretScope::Guests(guests) = &self.shown else { return None };
        Some(guests.guest(self.cookies(lines))?.pass())
    }

    /// The cookies of our name in these lines; browsers send one.
    fn cookies<'a>(&self, lines: impl Iterator<Item = &'a str>) -> impl Iterator<Item = &'a str> {
        let pairs = lines.flat_map(|line| line.split(';')).filter_map(|pair| pair.trim().split_once('='));
        pairs.filter(|(name, _)| **name == *self.cookie).map(|(_, value)| value).take(COOKIES_MAX)
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

    /// Whether a Stop is taken from there: from everybody who is in, and from everybody at this computer; and who stops, as
    /// people are told.
    ///
    /// # Errors
    /// Why not.
    pub(crate) fn may_stop(&self, headers: &HeaderMap) -> Result<String, NotAllowed> {
        self.guard.may_stop(headers)?;
        let entry = self.entry(headers);
        if self.is_passed_on(headers) && !matches!(entry, Identified::Host) {
            return Err(NotAllowed::Forwarded);
        }
        entry.may(AskedOperation::Http(Route::Stop)).map_err(|_| NotAllowed::NotInvited)?;
        Ok(self.name_of(&entry))
    }

    /// What who stops by HTTP is called: a guest as they said on their links.
    fn name_of(&self, entry: &Identified) -> String {
        match (entry, &self.shown) {
            (Identified::Guest(guest), SecretScope::Guests(guests)) => guests.invitations.name_of(guest),
            _ => protocol::STOP_BUTTON.to_owned(),
        }
    }

    /// Whether an undeclared proxy sends this to the door of this computer, for somebody else.
    fn is_passed_on(&self, headers: &HeaderMap) -> bool {
        matches!(self.shown, SecretScope::Host(..)) && is_forwarded(headers)
    }

    /// The port that a browser speaks to, where it is another than that of this computer's door: that of a tunnel.
    pub(crate) fn tunnel(&self, headers: &HeaderMap) -> Option<u16> {
        let SecretScope::Host(_, own) = &self.shown else { return None };
        super::origin::port(headers.get(header::HOST)?.to_str().ok()?).filter(|port| port != own)
    }

    /// The header that gives somebody the cookie of this secret. From now on a guest is known.
    pub(crate) fn give(&self, secret: &str) -> String {
        if let SecretScope::Guests(guests) = &self.shown {
            guests.invitations.guest(secret).iter().for_each(|guest| guests.note(guest));
        }
        // Where this computer is spoken to without TLS, browsers would not keep a cookie for TLS only.
        let secure = if matches!(self.shown, SecretScope::Host(..)) { "" } else { " Secure;" };
        format!("{}={secret}; Path=/; Max-Age={COOKIE_SECONDS}; HttpOnly;{secure} SameSite=Strict", self.cookie)
    }
}

impl Guests {
    /// Who shows one of these cookies.
    fn guest<'a>(&self, mut cookies: impl Iterator<Item = &'a str>) -> Option<Guest> {
        let guest = cookies.find_map(|cookie| self.invitations.guest(cookie));
        guest.iter().for_each(|guest| self.note(guest));
        guest
    }

    fn note(&self, guest: &Guest) {
        self.noting.iter().for_each(|note| note(guest.pass()));
    }
}

impl RequestArrival {
    /// As whom the sender of a request is in.
    pub(crate) fn entry(&self, headers: &HeaderMap) -> Identified {
        self.door.entry(headers)
    }

    /// From where a request came: of a proxy, what it says last itself.
    pub(crate) fn source(&self, headers: &HeaderMap) -> GuessSource {
        let is_proxied = matches!(&self.door.shown, SecretScope::Guests(guests) if guests.is_proxied);
        let lines = is_proxied.then(|| headers.get_all(FORWARDED_FOR));
        let last =
            lines.and_then(|lines| lines.iter().next_back()?.to_str().ok()?.rsplit(',').next()?.trim().parse().ok());
        GuessSource::of(last.unwrap_or(self.peer))
    }
}

/// Whether a proxy or a tunnel sends this for somebody else.
fn is_forwarded(headers: &HeaderMap) -> bool {
    headers.keys().any(|name| FORWARDED.iter().any(|begin| name.as_str().starts_with(begin)))
}

#[cfg(test)]
mod tests {
    use super::{EntryDoor, NotAllowed};
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
        let (door, own) = (EntryDoor::local(7130, Arc::clone(&host)), ("host", "127.0.0.1:7130"));
        let key = host_key::header(&host.key("127.0.0.1:7130".parse().unwrap()).key);
        for said in ["forwarded", "x-forwarded-for", "x-forwarded-proto", "x-real-ip", "via", "cf-connecting-ip"] {
            let through = headers(&[own, (said, "203.0.113.9")]);
            assert_eq!(door.may_stop(&through), Err(NotAllowed::Forwarded), "{said}");
            let of_host = headers(&[own, (said, "203.0.113.9"), (host_key::HEADER, &key)]);
            assert_eq!(door.may_stop(&of_host).as_deref(), Ok(protocol::STOP_BUTTON), "{said}");
        }
        assert!(door.may_stop(&headers(&[own])).is_ok(), "at this computer everybody may");
    }
}
