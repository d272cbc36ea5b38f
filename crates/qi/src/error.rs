//! The faults between this crate and a peer, as data with one sentence each.

use phrase::{Phrase, Phrased, phrase};
use std::io;
use std::time::Duration;

use crate::fingerprint::Fingerprint;
use crate::malformed::{Malformed, TypeMismatch};

/// The stages of a connection.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ConnectionStage {
    /// Finding the host's address by its name.
    Name,
    /// Opening the connection.
    Tcp,
    /// Agreeing on TLS, and knowing the certificate again.
    Tls,
    /// Logging in, or greeting where there is no login.
    Login,
    /// Asking the service directory what there is.
    Directory,
    /// Reaching the process that offers a service.
    Service,
}

phrase::shown!(ConnectionStage);

impl Phrased for ConnectionStage {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Name => phrase!("ConnectionStage.Name", "finding the host"),
            Self::Tcp => phrase!("ConnectionStage.Tcp", "opening the connection"),
            Self::Tls => phrase!("ConnectionStage.Tls", "agreeing on encryption"),
            Self::Login => phrase!("ConnectionStage.Login", "logging in"),
            Self::Directory => phrase!("ConnectionStage.Directory", "asking the service directory"),
            Self::Service => phrase!("ConnectionStage.Service", "reaching the service"),
        }
    }
}

/// The reasons why a stage of connecting failed.
#[derive(Debug, Clone, PartialEq, Eq, Phrased)]
pub enum ConnectError {
    /// The system says so: refused, unreachable, reset.
    #[error("{0}")]
    Io(io::ErrorKind),
    /// The name has no address.
    #[error("the name {0} is not known")]
    UnknownHost(String),
    /// Nothing came within this time.
    #[error("nothing came within {} ms", .0.as_millis())]
    Timeout(Duration),
    /// The other side speaks no TLS that we do.
    #[error("the encryption could not be agreed on: {0}")]
    Tls(String),
    /// User and password are only said in secret, and the address is not.
    #[error("the encryption could not be agreed on: a password is not said in the clear")]
    InTheClear,
    /// The certificate is not the one that was trusted: another robot, a reset one, or somebody in between.
    #[error("the certificate changed: {found} is not {expected}, which was trusted before")]
    CertificateChanged {
        /// The one that was trusted.
        expected: Fingerprint,
        /// The one that was shown now.
        found: Fingerprint,
    },
    /// User or password are not accepted. In the peer's words.
    #[error("the login is refused: {0}")]
    Refused(String),
    /// The login wants a step that this crate does not know.
    #[error("the login wants more than a user and a password")]
    UnknownLogin,
    /// No endpoint of the service is on the host that was dialled.
    #[error("{service} offers no way to it on this host, only {offered}")]
    NoEndpoint {
        /// The name of the service.
        service: String,
        /// The addresses that the directory offers for it.
        offered: Vec<String>,
    },
    /// Anything that can go wrong with a call.
    #[error("{0}")]
    Call(Box<QiError>),
}

/// The reasons why a link is over.
#[derive(Debug, Clone, PartialEq, Eq, Phrased)]
pub enum LinkEnding {
    /// The peer closed it.
    #[error("the other side closed it")]
    Peer,
    /// Closed by [`crate::QiLink::close`], or by nobody holding it any more.
    #[error("it was closed here")]
    Here,
    /// The system says so.
    #[error("{0}")]
    Io(io::ErrorKind),
    /// The bytes that came are not the qi protocol.
    #[error("{0}")]
    Malformed(Malformed),
}

/// Everything that can go wrong, each with what a caller needs to decide what to do.
#[derive(Debug, Clone, PartialEq, Eq, Phrased)]
pub enum QiError {
    /// A text that is no address of a peer.
    #[error("{0:?} is no address; write it as tcp://HOST:PORT or tcps://HOST:PORT")]
    Address(String),
    /// A connection did not come about.
    #[error("{stage} failed: {cause}")]
    Connect {
        /// The stage that failed.
        stage: ConnectionStage,
        /// The cause of the failure.
        cause: ConnectError,
    },
    /// The link is over; every call that waits ends with this.
    #[error("the connection is gone: {0}")]
    Disconnected(LinkEnding),
    /// No answer in time. The peer may still do what was asked; a late answer is dropped.
    #[error("{what} did not answer within {} ms", .within.as_millis())]
    Timeout {
        /// The method that was called.
        what: String,
        /// The time that was waited.
        within: Duration,
    },
    /// A bound of the link is reached: calls in flight, messages that wait, listeners.
    #[error("too much is under way on this connection: {limit} {what}")]
    Busy {
        /// The thing of which there is too much.
        what: &'static str,
        /// The most that there may be.
        limit: usize,
    },
    /// The directory has no service of this name.
    #[error("there is no service {name}")]
    NoService {
        /// The name that was asked for.
        name: String,
    },
    /// No signal or property of this name.
    #[error("{object} has no {what} {name}")]
    NoMember {
        /// The service or object.
        object: String,
        /// `signal` or `property`.
        what: &'static str,
        /// The name that was asked for.
        name: String,
    },
    /// No method of this name takes these arguments.
    #[error("{object} has no method {name}{given}; there is {known}", known = said(candidates))]
    NoMethod {
        /// The service or object.
        object: String,
        /// The name that was asked for.
        name: String,
        /// The signature of the arguments.
        given: String,
        /// The methods of this name, as `name(parameters)`.
        candidates: Vec<String>,
    },
    /// A value cannot be written as what the peer wants.
    #[error("{0}")]
    Unfit(#[from] TypeMismatch),
    /// The peer's method failed. In the peer's words.
    #[error("{said}", said = remote(module.as_deref(), text))]
    Remote {
        /// `Module::method`, where the peer says it.
        module: Option<String>,
        /// The message that says what went wrong.
        text: String,
    },
    /// The peer gave up a call, as it was asked to.
    #[error("{what} was cancelled")]
    Canceled {
        /// The method that was called.
        what: String,
    },
    /// An answer or event that cannot be read. The link goes on.
    #[error("an answer cannot be read: {0}")]
    Malformed(#[from] Malformed),
    /// An answer of another kind than the method's signature says.
    #[error("{what} answered with something else than {wanted}")]
    Unexpected {
        /// The method that was called.
        what: String,
        /// The kind of value that should have come.
        wanted: &'static str,
    },
}

fn said(candidates: &[String]) -> Phrase {
    if candidates.is_empty() { phrase!("QiError.NoCandidate", "none of this name") } else { candidates.phrase() }
}

/// The words of the peer, behind the name of its method.
fn remote(module: Option<&str>, text: &str) -> String {
    module.map_or_else(|| text.to_owned(), |module| format!("{module}: {text}"))
}

impl QiError {
    /// True if trying again later, unchanged, can help: the network and the peer may come back, a password or a
    /// certificate does not mend itself.
    pub fn retryable(&self) -> bool {
        match self {
            Self::Connect { cause, .. } => cause.retryable(),
            Self::Disconnected(_) | Self::Timeout { .. } | Self::Busy { .. } | Self::NoService { .. } => true,
            Self::Address(_)
            | Self::NoMember { .. }
            | Self::NoMethod { .. }
            | Self::Unfit(_)
            | Self::Remote { .. }
            | Self::Canceled { .. }
            | Self::Malformed(_)
            | Self::Unexpected { .. } => false,
        }
    }

    /// This as the reason why `stage` failed; what names its stage already stays as it is.
    pub(crate) fn at(self, stage: ConnectionStage) -> Self {
        match self {
            named @ Self::Connect { .. } => named,
            Self::Timeout { within, .. } => Self::Connect { stage, cause: ConnectError::Timeout(within) },
            other => Self::Connect { stage, cause: ConnectError::Call(Box::new(other)) },
        }
    }
}

impl ConnectError {
    fn retryable(&self) -> bool {
        match self {
            Self::Io(_) | Self::UnknownHost(_) | Self::Timeout(_) => true,
            Self::Tls(_)
            | Self::InTheClear
            | Self::CertificateChanged { .. }
            | Self::Refused(_)
            | Self::UnknownLogin
            | Self::NoEndpoint { .. } => false,
            Self::Call(error) => error.retryable(),
        }
    }
}
