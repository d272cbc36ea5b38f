//! A peer with its service directory: connecting in named stages, finding services, knowing when they come and go.

mod cache;
mod dial;
mod endpoint;

use std::collections::BTreeMap;
use std::net::IpAddr;
use std::sync::Arc;
use std::time::Duration;

use tokio::task::AbortHandle;

pub use endpoint::{EndpointChoice, ServiceInfo, choose as choose_endpoint};

use crate::address::PeerAddress;
use crate::auth::Credentials;
use crate::error::{ConnectError, ConnectionStage, QiError};
use crate::fingerprint::Fingerprint;
use crate::link::{EventChoice, QiLink, Subscription};
use crate::object::{CALL_WITHIN, Object};
use crate::tls::Trust;
use crate::value::Value;
use cache::Cache;

const DIRECTORY: u32 = 1;
const DIRECTORY_NAME: &str = "ServiceDirectory";
const MAIN_OBJECT: u32 = 1;
/// The most services that may come or go while nobody looks, before all are asked for anew.
const CHANGES_MAX: usize = 256;
/// The most processes of one host that may be linked to at once.
const LINKS_MAX: usize = 16;

/// The options of a connection.
#[derive(Debug, Clone)]
pub struct SessionOptions {
    /// User and password, where the peer wants them.
    pub credentials: Option<Credentials>,
    /// The certificates that are accepted behind `tcps`.
    pub trust: Trust,
    /// The longest time of each stage of connecting.
    pub stage_within: Duration,
    /// The longest time of a call unless something else is said.
    pub call_within: Duration,
}

impl Default for SessionOptions {
    /// No password, any certificate, 5 s a stage, 2 s a call.
    fn default() -> Self {
        Self { credentials: None, trust: Trust::First, stage_within: Duration::from_secs(5), call_within: CALL_WITHIN }
    }
}

/// A peer that we are logged in at; clones are the same session. Its link ends when nobody holds it or its objects.
#[derive(Debug, Clone)]
pub struct Session(Arc<SessionInner>);

#[derive(Debug)]
struct SessionInner {
    link: QiLink,
    address: PeerAddress,
    peer: IpAddr,
    fingerprint: Option<Fingerprint>,
    options: SessionOptions,
    directory: Object,
    /// The directory's description of itself.
    itself: Option<ServiceInfo>,
    cache: Arc<Cache>,
    /// To other processes of the same host.
    links: tokio::sync::Mutex<BTreeMap<PeerAddress, QiLink>>,
    watcher: AbortHandle,
}

impl Drop for SessionInner {
    fn drop(&mut self) {
        self.watcher.abort();
    }
}

impl Session {
    /// Connects and logs in.
    ///
    /// # Errors
    /// [`QiError::Connect`], which names the stage that failed.
    pub async fn connect(address: &PeerAddress, options: SessionOptions) -> Result<Self, QiError> {
        let dialled = dial::dial(address, &options).await?;
        let (link, within) = (dialled.link, options.stage_within);
        let directory = async {
            let directory = Object::at(link.clone(), DIRECTORY, MAIN_OBJECT, DIRECTORY_NAME, within).await?;
            let itself = directory.call("service", &[DIRECTORY_NAME.into()]).await;
            let itself = itself.ok().and_then(|value| ServiceInfo::from_value(&value));
            let added = directory.subscribe("serviceAdded", EventChoice::All(CHANGES_MAX)).await?;
            let removed = directory.subscribe("serviceRemoved", EventChoice::All(CHANGES_MAX)).await?;
            Ok((directory.within(options.call_within), itself, added, removed))
        };
        let (directory, itself, added, removed) =
            directory.await.map_err(|error: QiError| error.at(ConnectionStage::Directory))?;
        let cache = Arc::new(Cache::default());
        let watcher = tokio::spawn(cache::watch(Arc::clone(&cache), added, removed)).abort_handle();
        let (address, peer, fingerprint) = (address.clone(), dialled.peer, dialled.fingerprint);
        let links = tokio::sync::Mutex::default();
        let inner =
            SessionInner { link, address, peer, fingerprint, options, directory, itself, cache, links, watcher };
        Ok(Self(Arc::new(inner)))
    }

    /// The link to the directory, with everything that is offered by the same process.
    pub fn link(&self) -> &QiLink {
        &self.0.link
    }

    /// The certificate that was shown behind `tcps`: keep it, and trust only it next time.
    pub fn fingerprint(&self) -> Option<Fingerprint> {
        self.0.fingerprint
    }

    /// The service directory itself, with its signals `serviceAdded` and `serviceRemoved`.
    pub fn directory(&self) -> &Object {
        &self.0.directory
    }

    /// All services that there are now.
    ///
    /// # Errors
    /// Fails as any call can.
    pub async fn services(&self) -> Result<Vec<ServiceInfo>, QiError> {
        let value = self.0.directory.call("services", &[]).await?;
        let wrong = || QiError::Unexpected { what: "services".to_owned(), wanted: "a list of services" };
        value.items().ok_or_else(wrong)?.iter().map(|item| ServiceInfo::from_value(item).ok_or_else(wrong)).collect()
    }

    /// The service of this name. Asked for once, until it goes or comes anew.
    ///
    /// # Errors
    /// [`QiError::NoService`]; [`QiError::Connect`] if it is offered by another process that cannot be reached, or only by
    /// another host; and what can go wrong with a call.
    pub async fn service(&self, name: &str) -> Result<Object, QiError> {
        let (known, seen) = self.0.cache.get(name);
        if let Some(object) = known {
            return Ok(object);
        }
        let info = self.find(name).await?;
        let link = self.link_to(&info).await?;
        let object = Object::at(link, info.service_id, MAIN_OBJECT, name, self.0.options.call_within).await?;
        self.0.cache.put(name, &object, seen);
        Ok(object)
    }

    /// Asks for a service anew next time; for one that answers as if it were another.
    pub fn forget(&self, name: &str) {
        self.0.cache.forget(name);
    }

    /// Listens to services that come: their number and name.
    ///
    /// # Errors
    /// Fails as [`Object::subscribe`] does.
    pub async fn added(&self) -> Result<Subscription, QiError> {
        self.0.directory.subscribe("serviceAdded", EventChoice::All(CHANGES_MAX)).await
    }

    /// Listens to services that go: their number and name.
    ///
    /// # Errors
    /// Fails as [`Object::subscribe`] does.
    pub async fn removed(&self) -> Result<Subscription, QiError> {
        self.0.directory.subscribe("serviceRemoved", EventChoice::All(CHANGES_MAX)).await
    }

    async fn find(&self, name: &str) -> Result<ServiceInfo, QiError> {
        let value = match self.0.directory.call("service", &[Value::from(name)]).await {
            Err(QiError::Remote { .. }) => return Err(QiError::NoService { name: name.to_owned() }),
            other => other?,
        };
        let wrong = QiError::Unexpected { what: "service".to_owned(), wanted: "a service" };
        ServiceInfo::from_value(&value).ok_or(wrong)
    }

    async fn link_to(&self, info: &ServiceInfo) -> Result<QiLink, QiError> {
        let inner = &self.0;
        let relative = inner.link.agreed().is_some_and(|agreed| agreed.relative_endpoints);
        match endpoint::choose(info, inner.itself.as_ref(), &inner.address, inner.peer, relative) {
            EndpointChoice::SameLink => Ok(inner.link.clone()),
            EndpointChoice::Dial(address) => {
                self.other_link(&address).await.map_err(|error| error.at(ConnectionStage::Service))
            }
            EndpointChoice::Nowhere => {
                let cause = ConnectError::NoEndpoint { service: info.name.clone(), offered: info.endpoints.clone() };
                Err(QiError::Connect { stage: ConnectionStage::Service, cause })
            }
        }
    }

    async fn other_link(&self, address: &PeerAddress) -> Result<QiLink, QiError> {
        let mut links = self.0.links.lock().await;
        links.retain(|_, link| link.ending().is_none());
        if let Some(link) = links.get(address) {
            return Ok(link.clone());
        }
        if links.len() >= LINKS_MAX {
            return Err(QiError::Busy { what: "links", limit: LINKS_MAX });
        }
        let mut options = self.0.options.clone();
        // One robot, one certificate.
        options.trust = self.0.fingerprint.map_or(options.trust, Trust::Only);
        let link = dial::dial(address, &options).await?.link;
        links.insert(address.clone(), link.clone());
        Ok(link)
    }
}
