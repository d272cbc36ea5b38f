//! The address of a peer: `tcp://HOST:PORT` or `tcps://HOST:PORT`.

use std::fmt;
use std::str::FromStr;

use crate::error::QiError;

/// The transport on which a peer is spoken to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Scheme {
    /// `tcp`: as it is.
    Tcp,
    /// `tcps`: through TLS.
    Tcps,
}

/// The address of a peer.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct PeerAddress {
    /// The transport on which it is spoken to.
    pub scheme: Scheme,
    /// A name or an address; an IPv6 address without its brackets.
    pub host: String,
    /// The port.
    pub port: u16,
}

impl FromStr for PeerAddress {
    type Err = QiError;

    /// Reads `tcp://HOST:PORT` or `tcps://HOST:PORT`; IPv6 addresses stand in brackets.
    fn from_str(text: &str) -> Result<Self, QiError> {
        read(text).ok_or_else(|| QiError::Address(text.to_owned()))
    }
}

fn read(text: &str) -> Option<PeerAddress> {
    let (scheme, rest) = match text.split_once("://")? {
        ("tcp", rest) => (Scheme::Tcp, rest),
        ("tcps", rest) => (Scheme::Tcps, rest),
        _ => return None,
    };
    let (host, port) = rest.trim_end_matches('/').rsplit_once(':')?;
    let inner = host.strip_prefix('[').and_then(|host| host.strip_suffix(']'));
    let host = inner.or_else(|| (!host.contains(':')).then_some(host))?;
    let is_plain = !host.is_empty() && !host.contains(|c: char| c.is_whitespace() || "/@[]".contains(c));
    let port = port.parse().ok().filter(|port| *port > 0)?;
    is_plain.then(|| PeerAddress { scheme, host: host.to_owned(), port })
}

impl fmt::Display for PeerAddress {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        let scheme = match self.scheme {
            Scheme::Tcp => "tcp",
            Scheme::Tcps => "tcps",
        };
        let (host, port) = (&self.host, self.port);
        if host.contains(':') {
            write!(to, "{scheme}://[{host}]:{port}")
        } else {
            write!(to, "{scheme}://{host}:{port}")
        }
    }
}
