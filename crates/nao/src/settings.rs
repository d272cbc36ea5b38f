//! The settings by which a robot is reached.

use qi::{
    ConnectError, ConnectionStage, Credentials, Fingerprint, PeerAddress, QiError, Scheme, SessionOptions, Trust,
};
use robot::Identity;
use std::fmt;
use std::time::Duration;

/// Where NAOqi listens up to 2.8, in the clear.
const PORT: u16 = 9559;
/// Where NAOqi listens from 2.9 on, by TLS, with user and password.
const PORT_TLS: u16 = 9503;
/// The longest that one stage of connecting may take, in milliseconds.
const STAGE_MS: u64 = 4_000;

/// The settings by which a robot is reached, and as whom.
#[derive(Clone, Debug)]
pub struct RobotSettings {
    /// The robot's name or number in the network: `nao.local`, `192.168.1.7:9559`, `tcps://nao.local:9503`. Without a
    /// port both that NAOqi uses are tried: 9559 in the clear, then 9503 by TLS.
    pub address: String,
    /// User and password, for robots that ask for them.
    pub login: Option<Login>,
    /// The beginning of every name under which this server subscribes on the robot, so that what an ended one left
    /// behind is found: always the same for one server and robot.
    pub own_name: String,
    /// Names like that of robots that are here no more, under which something may be left on this one.
    pub former: Vec<String>,
    /// The SHA-256 of the certificate that the robot must show, as `AB:CD:…`; none trusts the first one.
    pub trusted: Option<String>,
    /// Which body must answer; none takes the first one.
    pub expected: Option<Identity>,
}

/// User and password.
#[derive(Clone, PartialEq, Eq)]
pub struct Login {
    /// The user: `nao`.
    pub user: String,
    /// The password. It is in no error and no log.
    pub password: String,
}

impl fmt::Debug for Login {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.debug_struct("Login").field("user", &self.user).finish_non_exhaustive()
    }
}

impl RobotSettings {
    /// The addresses to try, in this order; none if what is written is no address.
    pub(crate) fn addresses(&self) -> Vec<PeerAddress> {
        let said = self.address.trim();
        if said.contains("://") {
            return said.parse().into_iter().collect();
        }
        let with = |scheme: &str, place: &str| format!("{scheme}://{place}").parse::<PeerAddress>().ok();
        let (host, port) = match said.rsplit_once(':') {
            Some((host, port)) if !host.contains(':') || host.ends_with(']') => (host, port.parse::<u16>().ok()),
            _ => (said, None),
        };
        if host.is_empty() || (port.is_none() && host != said) {
            return Vec::new();
        }
        let bare = |port: u16| {
            if host.contains(':') && !host.starts_with('[') {
                format!("[{host}]:{port}")
            } else {
                format!("{host}:{port}")
            }
        };
        match port {
            Some(PORT_TLS) => with("tcps", &bare(PORT_TLS)).into_iter().collect(),
            Some(port) => with("tcp", &bare(port)).into_iter().collect(),
            None => with("tcp", &bare(PORT)).into_iter().chain(with("tcps", &bare(PORT_TLS))).collect(),
        }
    }

    /// Everything that what is left on the robot may begin with.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.own_name.as_str()).chain(self.former.iter().map(String::as_str))
    }

    /// Checks that this address may be tried: a password is said, and a certificate looked at, by TLS only.
    pub(crate) fn check_secret(&self, address: &PeerAddress) -> Result<(), QiError> {
        if is_secure(address) || (self.login.is_none() && self.trusted.is_none()) {
            return Ok(());
        }
        let cause = ConnectError::InTheClear;
        Err(QiError::Connect { stage: ConnectionStage::Tls, cause })
    }

    pub(crate) fn options(&self) -> SessionOptions {
        let login = self.login.as_ref();
        let credentials = login.map(|login| Credentials { user: login.user.clone(), password: login.password.clone() });
        let trusted = self.trusted.as_deref().and_then(|text| text.parse().ok());
        // A fingerprint that cannot be read is that of nobody.
        let nobody = self.trusted.as_ref().map(|_| Fingerprint([0; 32]));
        let trust = trusted.or(nobody).map_or(Trust::First, Trust::Only);
        SessionOptions {
            credentials,
            trust,
            stage_within: Duration::from_millis(STAGE_MS),
            ..SessionOptions::default()
        }
    }
}

/// True if nothing secret is said in the clear.
pub(crate) fn is_secure(address: &PeerAddress) -> bool {
    address.scheme == Scheme::Tcps
}

#[cfg(test)]
impl RobotSettings {
    /// The settings of a robot at an address of which nothing else is known.
    pub(crate) fn at(address: &str) -> Self {
        let (address, own_name) = (address.to_owned(), "rrp".to_owned());
        Self { address, login: None, own_name, trusted: None, expected: None, former: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::{Login, RobotSettings};

    fn tried(address: &str) -> Vec<String> {
        RobotSettings::at(address).addresses().iter().map(ToString::to_string).collect()
    }

    #[test]
    fn both_ports_are_tried_where_none_is_said() {
        assert_eq!(tried(" nao.local "), ["tcp://nao.local:9559", "tcps://nao.local:9503"]);
        assert_eq!(tried("10.0.0.7:9503"), ["tcps://10.0.0.7:9503"]);
        assert_eq!(tried("10.0.0.7:1234"), ["tcp://10.0.0.7:1234"]);
        assert_eq!(tried("tcps://nao:9999"), ["tcps://nao:9999"]);
        assert!(tried("").is_empty() && tried("nao:port").is_empty());
    }

    #[test]
    fn a_password_is_said_in_secret_only() {
        let open = RobotSettings::at("nao");
        let login = Some(Login { user: "nao".into(), password: "hush".into() });
        let secret = RobotSettings { login, ..open.clone() };
        let pinned = RobotSettings { trusted: Some("nonsense".into()), ..open.clone() };
        let [clear, tls] = &open.addresses()[..] else { panic!() };
        assert!(open.check_secret(clear).is_ok() && open.check_secret(tls).is_ok());
        for careful in [&secret, &pinned] {
            assert!(careful.check_secret(clear).is_err() && careful.check_secret(tls).is_ok());
        }
        assert_ne!(pinned.options().trust, qi::Trust::First);
    }

    #[test]
    fn a_password_is_never_shown() {
        let login = Login { user: "nao".into(), password: "hush".into() };
        assert!(!format!("{login:?}").contains("hush"));
    }
}
