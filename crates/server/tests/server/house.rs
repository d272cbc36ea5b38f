//! A server in this process on a free port, and things to put into behaviours.

use behaviour::{Connector, Id, Kind, Operation, Procedure, Record, RecordId, Stream, StreamKind, connectors};
use protocol::{RecordedSession, request};
use server::{Config, GuestNetwork, ReadyServer, Secured, serve_with};
use shell::{Client, ClientError};
use std::net::SocketAddr;
use std::path::Path;
use std::sync::Arc;
use store::{MemoryStore, Store, StoreError};
use tokio::sync::oneshot;
use tokio::task::JoinHandle;

/// A running server.
pub(crate) struct House {
    pub(crate) address: SocketAddr,
    /// Where others reach it, if they may come in.
    pub(crate) network: Option<SocketAddr>,
    /// The link by which a browser becomes the host's.
    pub(crate) host_link: Option<String>,
    /// The link that was told at the start, if others may come in.
    pub(crate) link: Option<String>,
    stop: oneshot::Sender<()>,
    serving: JoinHandle<()>,
}

impl House {
    /// On a fresh store in memory.
    pub(crate) async fn open() -> Self {
        Self::on(Arc::new(MemoryStore::default())).await
    }

    /// On the files of a folder.
    pub(crate) async fn at(folder: &Path) -> Self {
        loop {
            match store::open(folder).await {
                Ok(store) => return Self::on(Arc::new(store)).await,
                // Whoever had it before may still be putting it away.
                Err(StoreError::Busy(_)) => tokio::time::sleep(std::time::Duration::from_millis(1)).await,
                Err(error) => panic!("{error}"),
            }
        }
    }

    /// On a store, with a data folder beside it.
    pub(crate) async fn beside(store: Arc<dyn Store>, data: &Path) -> Self {
        Self::with(store, None, Some(data)).await
    }

    /// With a data folder, where others come in by invitation.
    pub(crate) async fn for_others(data: &Path) -> Self {
        let network = GuestNetwork { listen: "127.0.0.1:0".parse().unwrap(), secured: Secured::Made };
        Self::with(Arc::new(MemoryStore::default()), Some(network), Some(data)).await
    }

    pub(crate) async fn on(store: Arc<dyn Store>) -> Self {
        Self::with(store, None, None).await
    }

    pub(crate) async fn with(store: Arc<dyn Store>, network: Option<GuestNetwork>, data: Option<&Path>) -> Self {
        let (stop, stopped) = oneshot::channel::<()>();
        let (tell, ready) = oneshot::channel();
        let listen = "127.0.0.1:0".parse().unwrap();
        let data = data.map(Path::to_owned);
        let config = Config { listen, network, store: "unused".into(), data, seed: 1, page: |_| None };
        let serving = tokio::spawn(async move {
            let stopped = async { drop(stopped.await) };
            serve_with(store, config, |now| tell.send(now).unwrap(), stopped).await.unwrap();
        });
        let ReadyServer { address, network, invited, host_link } = ready.await.unwrap();
        Self { address, network, host_link, link: invited.map(|invited| invited.link), stop, serving }
    }

    pub(crate) async fn close(self) {
        self.stop.send(()).unwrap();
        self.serving.await.unwrap();
    }

    pub(crate) fn url(&self) -> String {
        format!("http://{}/", self.address)
    }

    /// What a program of the host shows.
    pub(crate) fn key(&self) -> String {
        host_key::header(&host_key::of_server(self.address).unwrap())
    }

    pub(crate) async fn person(&self, name: &str) -> Client {
        Client::connect(&self.url(), name).await.unwrap()
    }

    /// A person with a new behaviour open.
    pub(crate) async fn maker(&self, name: &str) -> (Client, Id) {
        let client = self.person(name).await;
        let behaviour = make(&client, "Play", None).await;
        client.load(&behaviour).await.unwrap();
        (client, behaviour)
    }
}

/// Makes a behaviour and answers with its id.
pub(crate) async fn make(client: &Client, name: &str, template: Option<&str>) -> Id {
    let wanted = id(&format!("b{}", client.change("", &behaviour::Behaviour::default(), vec![]).op));
    let create = request::Create { behaviour: wanted, name: name.into(), template: template.map(str::to_owned) };
    client.ask(create).await.unwrap().behaviour
}

/// Starts a behaviour on the first robot, without recording it.
pub(crate) fn start(behaviour: &Id) -> request::Start {
    request::Start { behaviour: behaviour.clone(), robot: None, record: false, session: RecordedSession::default() }
}

pub(crate) fn id(text: &str) -> Id {
    Id::new(text).unwrap()
}

pub(crate) fn stream_id(text: &str) -> RecordId {
    RecordId::new(Kind::Stream, &id(text))
}

pub(crate) fn connector_id(text: &str) -> RecordId {
    RecordId::new(Kind::Connector, &id(text))
}

pub(crate) fn stream(name: &str, kind: StreamKind, device: Option<&str>) -> Stream {
    Stream {
        kind,
        name: name.into(),
        device: device.map(str::to_owned),
        params: behaviour::Params::new(),
        order: 0,
        resources: None,
        priority: None,
        hold_ms: None,
    }
}

pub(crate) fn ball(name: &str) -> Record {
    Record::Stream(stream(name, StreamKind::Sensor, Some("RedBall")))
}

pub(crate) fn plain(name: &str) -> Record {
    Record::Stream(stream(name, StreamKind::Ordinary, None))
}

pub(crate) fn printer(name: &str) -> Record {
    Record::Stream(stream(name, StreamKind::Actuator, Some("Print")))
}

pub(crate) fn map(body: &str, from: &str, to: &str) -> Record {
    connect(connectors::map::SPEC.with(Procedure::body(body)), &[from], to)
}

pub(crate) fn connect(operation: Operation, from: &[&str], to: &str) -> Record {
    let inputs = from.iter().map(|from| id(from)).collect();
    Record::Connector(Connector { operation, inputs, output: id(to), order: 0 })
}

/// The sentence of a refusal.
pub(crate) fn sentence<A: std::fmt::Debug>(answer: Result<A, ClientError>) -> String {
    match answer {
        Err(trouble @ ClientError::No(_)) => trouble.to_string(),
        other => panic!("this was not refused: {other:?}"),
    }
}
