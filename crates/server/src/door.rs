//! Who may come in: pages that this server served, on this computer. Another page in the same browser may not, even
//! if a name was bent to point here.

use std::net::IpAddr;

/// Whether a missing Origin is fine: browsers always send one where it matters, other programs never do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Origin {
    /// It may be missing.
    Optional,
    /// It must be there.
    Required,
}

/// Whether the Host is this computer and this port, and the Origin the same.
pub(crate) fn check(port: u16, host: Option<&str>, origin: Option<&str>, need: Origin) -> Result<(), &'static str> {
    let host = host.ok_or("the request does not say for which host it is")?;
    if !is_here(host, port) {
        return Err("this server answers under localhost only");
    }
    match origin {
        Some(origin) if origin.strip_prefix("http://") == Some(host) => Ok(()),
        Some(_) => Err("another page may not use this server"),
        None if need == Origin::Optional => Ok(()),
        None => Err("the request does not say from which page it is"),
    }
}

/// A loopback name or address with our port, or without one.
fn is_here(host: &str, port: u16) -> bool {
    let (name, said) = split_port(host);
    let fits = said.is_none_or(|said| said.parse() == Ok(port) && said.bytes().all(|byte| byte.is_ascii_digit()));
    fits && is_loopback(name)
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
    use super::{Origin, check};

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
            (Some("localhost:7131"), Some("http://localhost:7131"), false),
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
            let answer = check(7130, host, origin, Origin::Optional);
            assert_eq!(answer.is_ok(), may, "{host:?} {origin:?}: {answer:?}");
        }
        assert!(check(7130, Some("localhost:7130"), None, Origin::Required).is_err());
    }
}
