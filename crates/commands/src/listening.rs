//! Where `rrp serve` listens: for its host at this computer, and for others, who come by invitation.

use crate::failure::Failure;
use clap::Args;
use protocol::{Lasts, Role};
use server::{GuestNetwork, InvitedFrom, Secured};
use std::fmt;
use std::io::{self, IsTerminal, Write};
use std::net::{Ipv4Addr, SocketAddr};
use std::path::PathBuf;

/// Where this computer finds the server unless it is said.
const USUAL: SocketAddr = SocketAddr::new(std::net::IpAddr::V4(Ipv4Addr::LOCALHOST), 7130);
/// What is left free around a QR code, in its dots.
const QUIET: usize = 4;

/// Where to listen.
#[derive(Debug, Args)]
pub(crate) struct Listening {
    /// Where to listen; port 0 takes a free one. An address in the network lets others in by invitation, over TLS; this
    /// computer then has 127.0.0.1 with the same port, or with the next one where that is taken by the other. May be said
    /// twice: once for this computer, once for others. localhost:PORT and :PORT mean this computer.
    /// [default: 127.0.0.1:7130]
    #[arg(long, value_name = "ADDR:PORT", value_parser = address)]
    listen: Vec<SocketAddr>,
    /// The certificate that others see, as a PEM file; without it the server makes one and keeps it in its data folder.
    #[arg(long, value_name = "FILE", requires = "key", conflicts_with = "behind_proxy")]
    cert: Option<PathBuf>,
    /// The key of the certificate, as a PEM file.
    #[arg(long, value_name = "FILE", requires = "cert")]
    key: Option<PathBuf>,
    /// Others come through a proxy that does TLS and that browsers reach by this origin. It speaks HTTP to the last address
    /// in --listen, which nobody else may reach; whoever comes there needs an invitation, also from this computer. Only
    /// pages of this origin are answered, and the last address in X-Forwarded-For, which the proxy has to add, is taken for
    /// that of who asks. Host and all other forwarded headers are not looked at.
    #[arg(long, value_name = "ORIGIN")]
    behind_proxy: Option<String>,
}

impl Listening {
    /// The address for this computer, and the way in for others if there is one.
    pub(crate) fn ways(self) -> Result<(SocketAddr, Option<GuestNetwork>), Failure> {
        self.sorted().map_err(Failure::of)
    }

    fn sorted(self) -> Result<(SocketAddr, Option<GuestNetwork>), ListenConflict> {
        let Self { mut listen, cert, key, behind_proxy } = self;
        if let Some(origin) = behind_proxy {
            let network = listen.pop().ok_or(ListenConflict::NoNetwork)?;
            let origin = origin_of(&origin).ok_or(ListenConflict::Origin(origin))?;
            let local = only(listen)?.filter(|local| local.ip().is_loopback());
            let local = local.unwrap_or_else(|| beside(network));
            return Ok((local, Some(GuestNetwork { listen: network, secured: Secured::Proxy { origin } })));
        }
        let (own, others): (Vec<_>, Vec<_>) = listen.into_iter().partition(|address| address.ip().is_loopback());
        let (own, others) = (only(own)?, only(others)?);
        let secured = match cert.zip(key) {
            Some((certificate, key)) if others.is_some() => Secured::Own { certificate, key },
            Some(_) => return Err(ListenConflict::NoNetwork),
            None => Secured::Made,
        };
        let local = own.unwrap_or_else(|| others.map_or(USUAL, beside));
        Ok((local, others.map(|listen| GuestNetwork { listen, secured })))
    }
}

/// A reason for which the addresses do not go together.
#[derive(Clone, Debug, PartialEq, Eq)]
enum ListenConflict {
    /// There are two for this computer, or two for others.
    TwoOfAKind,
    /// There is a certificate and nobody to show it to.
    NoNetwork,
    /// This is no origin.
    Origin(String),
    /// This is no address to listen on.
    Address(String),
}

impl std::error::Error for ListenConflict {}

impl fmt::Display for ListenConflict {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::TwoOfAKind => to.write_str(
                "Say --listen once for this computer and once for others at most: one address of its own, such as \
                 127.0.0.1:7130, and one in the network.",
            ),
            Self::NoNetwork => to.write_str(
                "A certificate is for those who come from elsewhere. Say with --listen where they come in, or leave out \
                 --cert and --key.",
            ),
            Self::Address(said) => write!(
                to,
                "“{said}” is no address with a port. Write localhost:7130 for this computer, or the number of this computer \
                 in the network, such as 192.168.1.5:7130."
            ),
            Self::Origin(said) => {
                write!(to, "“{said}” is not what browsers reach the proxy by. Write it as https://rrp.example, without a path.")
            }
        }
    }
}

/// An address as people write it. Nothing is looked up: what a name means elsewhere may change.
fn address(said: &str) -> Result<SocketAddr, ListenConflict> {
    let own = |port: &str| port.parse().ok().map(|port| SocketAddr::new(Ipv4Addr::LOCALHOST.into(), port));
    let of_this_computer = |said: &str| match said.rsplit_once(':') {
        Some((host, port)) if host.is_empty() || host.eq_ignore_ascii_case("localhost") => own(port),
        _ => None,
    };
    said.parse().ok().or_else(|| of_this_computer(said)).ok_or_else(|| ListenConflict::Address(said.to_owned()))
}

fn only(addresses: Vec<SocketAddr>) -> Result<Option<SocketAddr>, ListenConflict> {
    match addresses[..] {
        [] => Ok(None),
        [one] => Ok(Some(one)),
        _ => Err(ListenConflict::TwoOfAKind),
    }
}

/// Where this computer comes in beside others: at the same port, or the next one where both would be at one address.
fn beside(others: SocketAddr) -> SocketAddr {
    let (ip, port) = (others.ip(), others.port());
    let is_taken = (ip.is_unspecified() || ip.is_loopback()) && port != 0;
    let port = if is_taken { port.checked_add(1).unwrap_or(port - 1) } else { port };
    SocketAddr::new(Ipv4Addr::LOCALHOST.into(), port)
}

/// `https://rrp.example`, as browsers say it.
fn origin_of(said: &str) -> Option<String> {
    let host = said.strip_prefix("https://")?.trim_end_matches('/').to_ascii_lowercase();
    let host = host.strip_suffix(":443").unwrap_or(&host);
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || ".-:[]".contains(letter);
    (!host.is_empty() && host.chars().all(is_plain)).then(|| format!("https://{host}"))
}

/// Says how the first one comes in from elsewhere; on a terminal with a picture for phones.
pub(crate) fn tell_invitation(out: &mut (impl Write + IsTerminal), invited: &InvitedFrom) -> io::Result<()> {
    let (who, lasts) = (may(invited.role), lasting(invited.lasts));
    writeln!(out, "\nTo let somebody in who may {who}, give them this link. It works {lasts}:\n{}", invited.link)?;
    if out.is_terminal() {
        writeln!(out, "\n{}", picture(&invited.qr))?;
    }
    if let Some(fingerprint) = &invited.fingerprint {
        writeln!(
            out,
            "Their browser warns once, because this server made its certificate itself. They look at the certificate and\n\
             compare its SHA-256 fingerprint, which must be all of\n{fingerprint}\n\
             - iPad, iPhone, Mac: Show Details, view the certificate; if it is this one, visit this website.\n\
             - Android, Windows: the sign left of the address, then the certificate; if it is this one, Advanced, Proceed or\n  \
             Continue. The dialog “Invite” in the page has these steps to copy for each of them."
        )?;
    }
    writeln!(out, "The page and `rrp invite` make more invitations, for others and for those who only watch.")
}

fn may(role: Role) -> &'static str {
    match role {
        Role::Viewer => "look on and press Stop",
        Role::Operator => "press Start and Stop",
        Role::Editor => "edit",
        Role::Host => "do everything",
    }
}

fn lasting(lasts: Lasts) -> &'static str {
    match lasts {
        Lasts::Once => "once, within a day",
        Lasts::Day => "for a day",
        Lasts::UntilRevoked => "until you revoke it in the page",
    }
}

/// A QR code in half lines of black on white, whatever the colours of the terminal.
fn picture(rows: &[String]) -> String {
    let side = rows.len() + 2 * QUIET;
    let is_dark = |y: usize, x: usize| {
        let row = y.checked_sub(QUIET).and_then(|y| rows.get(y));
        row.zip(x.checked_sub(QUIET)).is_some_and(|(row, x)| row.as_bytes().get(x) == Some(&b'1'))
    };
    let half = |y: usize, x: usize| match (is_dark(y, x), is_dark(y + 1, x)) {
        (true, true) => '█',
        (true, false) => '▀',
        (false, true) => '▄',
        (false, false) => ' ',
    };
    let line = |y: usize| format!("\x1b[30;107m{}\x1b[0m\n", (0..side).map(|x| half(y, x)).collect::<String>());
    (0..side).step_by(2).map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::{ListenConflict, Listening, address, origin_of, picture};
    use server::Secured;

    fn ways(listen: &[&str], proxy: Option<&str>) -> Result<(String, Option<String>), ListenConflict> {
        let listen = listen.iter().map(|address| address.parse().unwrap()).collect();
        let at = Listening { listen, cert: None, key: None, behind_proxy: proxy.map(str::to_owned) };
        let (local, network) = at.sorted()?;
        Ok((local.to_string(), network.map(|network| network.listen.to_string())))
    }

    #[test]
    fn this_computer_always_has_an_address_of_its_own() {
        let table: [(&[&str], _, &str, Option<&str>); 9] = [
            (&[], None, "127.0.0.1:7130", None),
            (&["127.0.0.1:0"], None, "127.0.0.1:0", None),
            (&["192.168.1.5:7130"], None, "127.0.0.1:7130", Some("192.168.1.5:7130")),
            (&["0.0.0.0:7130"], None, "127.0.0.1:7131", Some("0.0.0.0:7130")),
            (&["0.0.0.0:65535"], None, "127.0.0.1:65534", Some("0.0.0.0:65535")),
            (&["[::]:0"], None, "127.0.0.1:0", Some("[::]:0")),
            (&["10.0.0.1:9", "127.0.0.1:8"], None, "127.0.0.1:8", Some("10.0.0.1:9")),
            (&["127.0.0.1:7131"], Some("https://rrp.example"), "127.0.0.1:7132", Some("127.0.0.1:7131")),
            (&["127.0.0.1:8", "127.0.0.1:9"], Some("https://rrp.example"), "127.0.0.1:8", Some("127.0.0.1:9")),
        ];
        for (listen, proxy, local, network) in table {
            assert_eq!(ways(listen, proxy), Ok((local.to_owned(), network.map(str::to_owned))), "{listen:?}");
        }
        assert_eq!(ways(&["127.0.0.1:1", "127.0.0.1:2"], None), Err(ListenConflict::TwoOfAKind));
        assert_eq!(ways(&["10.0.0.1:1", "10.0.0.2:2"], None), Err(ListenConflict::TwoOfAKind));
    }

    #[test]
    fn an_address_may_be_said_as_people_say_it() {
        let table = [
            ("localhost:7130", Some("127.0.0.1:7130")),
            ("LocalHost:0", Some("127.0.0.1:0")),
            (":7130", Some("127.0.0.1:7130")),
            ("[::1]:7130", Some("[::1]:7130")),
            ("10.0.0.1:9", Some("10.0.0.1:9")),
            ("localhost", None),
            (":70000", None),
            ("nao.local:7130", None),
            ("http://localhost:7130/", None),
        ];
        for (said, wanted) in table {
            let address = address(said).map(|address| address.to_string());
            assert_eq!(address.ok().as_deref(), wanted, "{said}");
        }
        let why = address("nao.local:7130").unwrap_err().to_string();
        assert!(why.contains("“nao.local:7130”") && why.contains("192.168.1.5:7130"), "{why}");
    }

    #[test]
    fn a_certificate_is_for_others() {
        let of = |listen: &str| {
            let (cert, key) = (Some("c.pem".into()), Some("k.pem".into()));
            Listening { listen: vec![listen.parse().unwrap()], cert, key, behind_proxy: None }.sorted()
        };
        assert_eq!(of("127.0.0.1:1").err(), Some(ListenConflict::NoNetwork));
        assert!(matches!(of("10.0.0.1:1").unwrap().1.unwrap().secured, Secured::Own { .. }));
    }

    #[test]
    fn an_origin_is_as_browsers_say_it() {
        let table = [
            ("https://rrp.example", Some("https://rrp.example")),
            ("https://RRP.example:443/", Some("https://rrp.example")),
            ("https://rrp.example:8443", Some("https://rrp.example:8443")),
            ("http://rrp.example", None),
            ("https://rrp.example/page", None),
            ("https://", None),
            ("https://a b", None),
        ];
        for (said, origin) in table {
            assert_eq!(origin_of(said).as_deref(), origin, "{said}");
        }
    }

    #[test]
    fn a_code_is_drawn_with_its_quiet_zone() {
        let drawn = picture(&["10".to_owned(), "01".to_owned()]);
        let lines: Vec<&str> = drawn.lines().collect();
        assert_eq!((lines.len(), lines[2]), (5, "\x1b[30;107m    ▀▄    \x1b[0m"));
    }
}
