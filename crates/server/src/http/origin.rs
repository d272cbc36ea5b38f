//! Which pages may ask: those that this server served. Another page in the same browser may not, even if a name was bent
//! to point here. Who somebody is, is asked elsewhere (`door.rs`).

use axum::extract::Request;
use axum::http::{HeaderMap, HeaderName, header};
use std::net::IpAddr;
use std::sync::Arc;

/// From where a request comes, as browsers say it themselves: no page can change it.
const SITE: HeaderName = HeaderName::from_static("sec-fetch-site");
/// For which purpose.
const MODE: HeaderName = HeaderName::from_static("sec-fetch-mode");

/// Why somebody may not come in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NotAllowed {
    /// The request cannot be read.
    Unreadable,
    /// It does not say for which host it is.
    NoHost,
    /// It is for another name than those of this computer.
    OtherHost,
    /// It does not say from which page it is.
    NoOrigin,
    /// Another page sends it.
    OtherPage,
    /// Nobody invited who sends it.
    NotInvited,
    /// A proxy that nobody declared passes it on to the way in of this computer.
    Forwarded,
}

/// Tells whose pages may ask.
#[derive(Clone, Debug)]
pub(crate) enum OriginGuard {
    /// Those of this computer. Nothing else is asked there, so the Host has to be one of its own names. Its port may be any:
    /// a tunnel from another computer has one of its own, and a page of another port never says this Host and this Origin.
    Local,
    /// Those that came by TLS. The Host may be any name of ours: under a name that was bent the browser has neither our
    /// certificate nor a cookie.
    Tls,
    /// Those of this origin, which a proxy serves; the Host is what the proxy likes.
    Proxy(Arc<str>),
}

impl OriginGuard {
    /// Whether a Stop is taken from there: never refused to somebody without a browser, nor to a form of our own whose
    /// browser keeps to itself which page it is on (`Origin: null`), as long as it says that this page is ours.
    ///
    /// # Errors
    /// Why not.
    pub(crate) fn may_stop(&self, headers: &HeaderMap) -> Result<(), NotAllowed> {
        let of = |name: HeaderName| headers.get(name).map(|value| value.to_str().unwrap_or("?"));
        let is_own_form = of(header::ORIGIN) == Some("null") && of(SITE) == Some("same-origin");
        let origin = of(header::ORIGIN).filter(|_| !is_own_form);
        self.check(of(header::HOST), origin, OriginRule::Optional)?;
        if is_from_another_page(headers, protocol::STOP_PATH) { Err(NotAllowed::OtherPage) } else { Ok(()) }
    }

    /// Whether a request is answered. What changes something must say where it comes from; another page gets nothing,
    /// neither to change nor to read.
    ///
    /// # Errors
    /// Why not.
    pub(crate) fn may_enter(&self, request: &Request) -> Result<(), NotAllowed> {
        let of = |name: HeaderName| request.headers().get(name).map(|value| value.to_str().unwrap_or("?"));
        let path = request.uri().path();
        let need = if request.method().is_safe() { OriginRule::Optional } else { OriginRule::Required };
        self.check(of(header::HOST), of(header::ORIGIN), need)?;
        if is_from_another_page(request.headers(), path) { Err(NotAllowed::OtherPage) } else { Ok(()) }
    }
}

impl OriginGuard {
    fn check(&self, host: Option<&str>, origin: Option<&str>, need: OriginRule) -> Result<(), NotAllowed> {
        match self {
            Self::Local => check(host, origin, need),
            Self::Tls => {
                let host = host.ok_or(NotAllowed::NoHost)?;
                fits(origin, need, |origin| origin.strip_prefix("https://") == Some(host))
            }
            Self::Proxy(own) => fits(origin, need, |origin| *origin == **own),
        }
    }
}

/// What browsers say of requests without an Origin. Following a link to the page itself is fine; Stop is no page.
fn is_from_another_page(headers: &HeaderMap, path: &str) -> bool {
    let is = |name: HeaderName, words: &[&str]| {
        let said = headers.get(name).and_then(|value| value.to_str().ok());
        said.is_some_and(|said| words.contains(&said))
    };
    let is_page = !path.starts_with("/api/") && path != protocol::STOP_PATH;
    is(SITE, &["cross-site", "same-site"]) && !(is_page && is(MODE, &["navigate"]))
}

/// Whether a missing Origin is fine: browsers always send one where it matters, other programs never do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum OriginRule {
    /// It may be missing.
    Optional,
    /// It must be there.
    Required,
}

/// Whether the Host is this computer, and the Origin the same with its port.
fn check(host: Option<&str>, origin: Option<&str>, need: OriginRule) -> Result<(), NotAllowed> {
    let host = host.ok_or(NotAllowed::NoHost)?;
    if !is_here(host) {
        return Err(NotAllowed::OtherHost);
    }
    fits(origin, need, |origin| origin.strip_prefix("http://") == Some(host))
}

/// Whether the Origin is our own, or fine to be missing.
fn fits(origin: Option<&str>, need: OriginRule, is_own: impl Fn(&str) -> bool) -> Result<(), NotAllowed> {
    match origin {
        Some(origin) if is_own(origin) => Ok(()),
        Some(_) => Err(NotAllowed::OtherPage),
        None if need == OriginRule::Optional => Ok(()),
        None => Err(NotAllowed::NoOrigin),
    }
}

/// A loopback name or address with a port, or without one.
fn is_here(host: &str) -> bool {
    let (name, port) = split_port(host);
    let is_port = |said: &str| said.parse::<u16>().is_ok() && said.bytes().all(|byte| byte.is_ascii_digit());
    port.is_none_or(is_port) && is_loopback(name)
}

/// The port in a Host, which leaves out that of HTTP.
pub(super) fn port(host: &str) -> Option<u16> {
    split_port(host).1.map_or(Some(80), |port| port.parse().ok())
}

/// `[::1]:80` and `localhost:80` into name and port.
fn split_port(host: &str) -> (&str, Option<&str>) {
    match host.rsplit_once(':') {
        Some((name, port)) if !port.contains(']') => (name, Some(port)),
        _ => (host, None),
    }
}

fn is_loopback(name: &str) -> bool {
    let bare = name.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
    let address = match bare {
        Some(v6) => v6.parse().map(IpAddr::V6).ok(),
        None => name.parse().map(IpAddr::V4).ok(),
    };
    name.eq_ignore_ascii_case("localhost") || address.is_some_and(|address| address.is_loopback())
}

#[cfg(test)]
mod tests {
    use super::{OriginGuard, OriginRule, check};
    use axum::body::Body;
    use axum::extract::Request;
    use axum::http::HeaderMap;

    #[test]
    fn another_page_gets_nothing_and_may_only_link_to_the_page() {
        let table = [
            ("/api/backup", vec![("origin", "http://evil.example")], false),
            ("/api/backup", vec![("sec-fetch-site", "cross-site"), ("sec-fetch-mode", "no-cors")], false),
            ("/api/backup", vec![("sec-fetch-site", "cross-site"), ("sec-fetch-mode", "navigate")], false),
            ("/app.js", vec![("sec-fetch-site", "same-site"), ("sec-fetch-mode", "no-cors")], false),
            ("/", vec![("sec-fetch-site", "cross-site"), ("sec-fetch-mode", "navigate")], true),
            ("/api/backup", vec![("sec-fetch-site", "same-origin")], true),
            ("/api/backup", vec![("sec-fetch-site", "none"), ("sec-fetch-mode", "navigate")], true),
            ("/api/backup", vec![], true),
        ];
        for (path, headers, may) in table {
            let mut request = Request::builder().uri(path).header("host", "localhost:7130");
            for (name, value) in &headers {
                request = request.header(*name, *value);
            }
            let request = request.body(Body::empty()).unwrap();
            assert_eq!(OriginGuard::Local.may_enter(&request).is_ok(), may, "{path} {headers:?}");
        }
    }

    #[test]
    fn a_stop_by_a_form_of_ours_counts_whatever_its_browser_tells() {
        let (null, own, evil) =
            (("origin", "null"), ("origin", "http://localhost:7130"), ("origin", "https://evil.example"));
        let navigates = ("sec-fetch-mode", "navigate");
        let site = |site: &'static str| ("sec-fetch-site", site);
        let table = [
            (vec![], true),
            (vec![own], true),
            (vec![own, site("same-origin"), navigates], true),
            (vec![null, site("same-origin"), navigates], true),
            (vec![site("same-origin")], true),
            (vec![null], false),
            (vec![null, site("cross-site"), navigates], false),
            (vec![null, site("same-site"), navigates], false),
            (vec![null, site("none"), navigates], false),
            (vec![site("cross-site"), navigates], false),
            (vec![evil, site("same-origin")], false),
            (vec![own, site("cross-site")], false),
        ];
        for (sent, may) in table {
            let sent = sent.iter().chain([&("host", "localhost:7130")]);
            let headers: HeaderMap =
                sent.map(|(name, value)| (name.parse().unwrap(), value.parse().unwrap())).collect();
            assert_eq!(OriginGuard::Local.may_stop(&headers).is_ok(), may, "{headers:?}");
        }
    }

    #[test]
    fn only_our_own_pages_come_in() {
        let table = [
            (Some("localhost:7130"), Some("http://localhost:7130"), true),
            (Some("LOCALHOST:7130"), Some("http://LOCALHOST:7130"), true),
            (Some("127.0.0.1:7130"), Some("http://127.0.0.1:7130"), true),
            (Some("127.9.9.9:7130"), Some("http://127.9.9.9:7130"), true),
            (Some("[::1]:7130"), Some("http://[::1]:7130"), true),
            (Some("localhost"), Some("http://localhost"), true),
            (Some("[::1]"), Some("http://[::1]"), true),
            (Some("localhost:7130"), None, true),
            (None, None, false),
            (None, Some("http://localhost:7130"), false),
            (Some("localhost:8080"), Some("http://localhost:8080"), true),
            (Some("127.0.0.1:8080"), Some("http://127.0.0.1:8080"), true),
            (Some("localhost:8080"), None, true),
            (Some("localhost:8080"), Some("http://localhost:7130"), false),
            (Some("localhost:8080"), Some("http://localhost"), false),
            (Some("localhost:"), None, false),
            (Some("localhost:65536"), None, false),
            (Some("localhost:07130x"), None, false),
            (Some("localhost:+7130"), None, false),
            (Some("localhost:7130"), Some("https://localhost:7130"), false),
            (Some("localhost:7130"), Some("http://127.0.0.1:7130"), false),
            (Some("localhost:7130"), Some("http://localhost:7131"), false),
            (Some("localhost:7130"), Some("http://localhost:7130.evil.example"), false),
            (Some("localhost:7130"), Some("http://evil.example"), false),
            (Some("localhost:7130"), Some("null"), false),
            (Some("localhost:7130"), Some(""), false),
            (Some("evil.example:7130"), Some("http://evil.example:7130"), false),
            (Some("localhost.evil.example"), None, false),
            (Some("127.0.0.1.nip.io:7130"), None, false),
            (Some("192.168.1.5:7130"), Some("http://192.168.1.5:7130"), false),
            (Some("[::2]:7130"), None, false),
            (Some("user@localhost:7130"), None, false),
        ];
        for (host, origin, may) in table {
            let answer = check(host, origin, OriginRule::Optional);
            assert_eq!(answer.is_ok(), may, "{host:?} {origin:?}: {answer:?}");
        }
        assert!(check(Some("localhost:7130"), None, OriginRule::Required).is_err());
    }
}
