//! The agreement of the handshake, which holds for as long as the link.

/// The kinds of hello that peers know.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Generation {
    /// NAOqi 2.1 (2014): a message of its own, no login.
    Capabilities,
    /// NAOqi 2.3 and later: a call to service 0.
    Authenticate,
}

/// The result of the handshake, on which both ends agreed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Agreed {
    /// The kind of hello that it was.
    pub generation: Generation,
    /// Objects carry a uid.
    pub object_uid: bool,
    /// Endpoints may be `qi:NAME`: on the same link as that service.
    pub relative_endpoints: bool,
    /// Calls can be cancelled.
    pub cancelable: bool,
    /// A password that the peer made for us, to be used from now on.
    pub new_token: Option<String>,
}
