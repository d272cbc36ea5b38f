//! The stages from an address to a link that is logged in.

use std::net::{IpAddr, SocketAddr};
use std::time::Duration;

use tokio::net::{TcpStream, lookup_host};
use tokio::time::timeout;

use super::SessionOptions;
use crate::address::{PeerAddress, Scheme};
use crate::auth;
use crate::error::{ConnectError, ConnectionStage, QiError};
use crate::fingerprint::Fingerprint;
use crate::link::QiLink;
use crate::tls;

/// The most addresses of a name that are tried.
const ADDRESSES_MAX: usize = 8;

/// A link that is logged in.
pub(super) struct Dialled {
    pub(super) link: QiLink,
    /// The address to which it leads.
    pub(super) peer: IpAddr,
    pub(super) fingerprint: Option<Fingerprint>,
}

pub(super) async fn dial(address: &PeerAddress, options: &SessionOptions) -> Result<Dialled, QiError> {
    let within = options.stage_within;
    let at = |stage| move |cause| QiError::Connect { stage, cause };
    let addresses = resolve(address, within).await.map_err(at(ConnectionStage::Name))?;
    let (stream, peer) = open(&addresses, within).await.map_err(at(ConnectionStage::Tcp))?;
    let (link, fingerprint) = match address.scheme {
        Scheme::Tcp => (QiLink::over(stream), None),
        Scheme::Tcps => {
            let agreed = tls::agree(stream, &address.host, options.trust, within).await;
            let (stream, fingerprint) = agreed.map_err(at(ConnectionStage::Tls))?;
            (QiLink::over(stream), Some(fingerprint))
        }
    };
    auth::greet(&link, options.credentials.as_ref(), within).await.map_err(at(ConnectionStage::Login))?;
    Ok(Dialled { link, peer, fingerprint })
}

async fn resolve(address: &PeerAddress, within: Duration) -> Result<Vec<SocketAddr>, ConnectError> {
    let unknown = || ConnectError::UnknownHost(address.host.clone());
    let found = timeout(within, lookup_host((address.host.as_str(), address.port))).await;
    let found = found.map_err(|_| ConnectError::Timeout(within))?.map_err(|_| unknown())?;
    let found: Vec<SocketAddr> = found.take(ADDRESSES_MAX).collect();
    if found.is_empty() { Err(unknown()) } else { Ok(found) }
}

/// Opens a connection to the first that answers.
async fn open(addresses: &[SocketAddr], within: Duration) -> Result<(TcpStream, IpAddr), ConnectError> {
    let trying = async {
        let mut failed = ConnectError::Io(std::io::ErrorKind::NotFound);
        for address in addresses {
            match TcpStream::connect(address).await {
                Ok(stream) => return Ok((stream, address.ip())),
                Err(error) => failed = ConnectError::Io(error.kind()),
            }
        }
        Err(failed)
    };
    let (stream, peer) = timeout(within, trying).await.map_err(|_| ConnectError::Timeout(within))??;
    // A call is one small message that nobody adds to.
    stream.set_nodelay(true).map_err(|error| ConnectError::Io(error.kind()))?;
    Ok((stream, peer))
}
