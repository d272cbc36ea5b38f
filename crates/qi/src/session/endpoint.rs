//! The directory's description of a service, and how far it is believed.

use std::net::IpAddr;

use crate::address::{PeerAddress, Scheme};
use crate::value::Value;

const SAME_AS_DIRECTORY: &str = "qi:ServiceDirectory";

/// The directory's description of a service.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ServiceInfo {
    /// The name of the service.
    pub name: String,
    /// The number of the service; another one when it comes back.
    pub service_id: u32,
    /// The computer that it runs on.
    pub machine_id: String,
    /// The process that it runs in.
    pub process_id: u32,
    /// Ways to it: `tcp://…`, `tcps://…`, or `qi:NAME` for the link of another service.
    pub endpoints: Vec<String>,
}

impl ServiceInfo {
    /// Reads 6 fields, as up to libqi 2.8, or more.
    pub(crate) fn from_value(value: &Value) -> Option<Self> {
        let [name, service_id, machine_id, process_id, endpoints, ..] = value.items()? else { return None };
        let endpoints = endpoints.items()?.iter().filter_map(Value::as_text);
        Some(Self {
            name: name.as_text()?.into_owned(),
            service_id: service_id.as_u32()?,
            machine_id: machine_id.as_text()?.into_owned(),
            process_id: process_id.as_u32()?,
            endpoints: endpoints.map(std::borrow::Cow::into_owned).collect(),
        })
    }
}

/// The way to a service.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum EndpointChoice {
    /// The link by which the directory is reached.
    SameLink,
    /// A link of its own to this address.
    Dial(PeerAddress),
    /// None that is allowed.
    Nowhere,
}

/// The way to `service`, if the `directory` (as it describes itself) was reached at `dialled`, whose address is `peer`.
///
/// Believes the directory only for the host that was dialled: a service that is offered elsewhere, or at the robot's
/// own 127.0.0.1, is not dialled there. A name is not looked up. Behind `tcps` nothing is dialled without TLS, as the
/// password would be sent.
pub fn choose(
    service: &ServiceInfo,
    directory: Option<&ServiceInfo>,
    dialled: &PeerAddress,
    peer: IpAddr,
    relative_endpoints: bool,
) -> EndpointChoice {
    let shares = |directory: &ServiceInfo| {
        let is_there = |endpoint: &String| directory.endpoints.contains(endpoint);
        directory.machine_id == service.machine_id && service.endpoints.iter().any(is_there)
    };
    let is_relative = relative_endpoints && service.endpoints.iter().any(|endpoint| endpoint == SAME_AS_DIRECTORY);
    let here: Vec<PeerAddress> = service
        .endpoints
        .iter()
        .filter_map(|endpoint| endpoint.parse::<PeerAddress>().ok())
        .filter(|address| address.host == dialled.host || address.host.parse() == Ok(peer))
        .collect();
    if is_relative || here.iter().any(|address| address.port == dialled.port) || directory.is_some_and(shares) {
        return EndpointChoice::SameLink;
    }
    let wanted = |address: &&PeerAddress| address.scheme == dialled.scheme || address.scheme == Scheme::Tcps;
    let best = here.iter().filter(wanted).max_by_key(|address| address.scheme == dialled.scheme);
    best.cloned().map_or(EndpointChoice::Nowhere, |mut address| {
        address.host.clone_from(&dialled.host);
        EndpointChoice::Dial(address)
    })
}
