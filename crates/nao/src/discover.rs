//! Robots that announce themselves in the network (`_naoqi._tcp` by mDNS).

use mdns_sd::{ServiceDaemon, ServiceEvent};
use std::collections::BTreeMap;
use std::fmt;
use std::time::Duration;

/// The kind of service that NAOqi announces.
const KIND: &str = "_naoqi._tcp.local.";
/// The most robots that are told.
const FOUND_MAX: usize = 32;

/// A robot that announces itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AnnouncedRobot {
    /// The name that the robot gives itself.
    pub name: String,
    /// The address at which it is reached: a number in the network, with its port.
    pub address: String,
}

/// Why nothing can be heard; with what the system says.
#[derive(Clone, Debug)]
pub struct Unheard(String);

impl std::error::Error for Unheard {}

impl fmt::Display for Unheard {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.write_str(&self.0)
    }
}

/// Listens for so long, and gives what was heard by name.
///
/// # Errors
/// If the network cannot be listened to.
pub async fn discover(listen: Duration) -> Result<Vec<AnnouncedRobot>, Unheard> {
    let unheard = |error: mdns_sd::Error| Unheard(error.to_string());
    let daemon = ServiceDaemon::new().map_err(unheard)?;
    let heard = daemon.browse(KIND).map_err(unheard)?;
    let mut found = BTreeMap::new();
    let listening = async {
        while let Ok(event) = heard.recv_async().await {
            if let ServiceEvent::ServiceResolved(service) = event
                && found.len() < FOUND_MAX
                && let Some(number) = service.get_addresses_v4().into_iter().next()
            {
                let name = service.get_fullname().split("._naoqi").next().unwrap_or_default().to_owned();
                found.insert(name, format!("{number}:{}", service.get_port()));
            }
        }
    };
    let _its_time = tokio::time::timeout(listen, listening).await;
    drop(daemon.shutdown());
    Ok(found.into_iter().map(|(name, address)| AnnouncedRobot { name, address }).collect())
}
