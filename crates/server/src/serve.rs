//! Starting and ending the server, each step in its order.

mod others;

pub use others::InvitedFrom;

use crate::connection::Connections;
use crate::http::address::AddressFile;
use crate::http::door::EntryDoor;
use crate::http::network::{GuestNetwork, NoCertificate};
use crate::http::page::PageFiles;
use crate::http::serving::{self, Routed};
use crate::http::{accept, routes};
use crate::invitations::{self, HostAccess, Invitations};
use crate::library::create::first_library;
use crate::library::exercises::{ExerciseStart, exercises};
use crate::library::templates::{Template, templates};
use crate::library::thumbnails::Thumbnails;
use crate::library::{LibraryService, bin};
use crate::recordings::Recordings;
use crate::robots::Robots;
use crate::rooms::knowledge::Knowing;
use crate::rooms::list_news::ListNews;
use crate::rooms::shown::AllShown;
use crate::rooms::snapshot::LibrarySnapshot;
use crate::rooms::{Rooms, Surroundings};
use crate::state::ServerState;
use crate::support::lookups::Lookups;
use crate::support::retry::retry;
use crate::support::store_call::bounded;
use crate::support::store_health::{self, StoreHealth};
use crate::support::tasks::{Tasks, blocking, boxed};
use crate::support::workers::Workers;
use crate::support::{data_folder, now_ms};
use behaviour::{Behaviour, Id};
use std::future::Future;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use store::{Append, Damage, Store, StoreError};
use tokio::runtime::{Handle, Runtime};
use tokio::sync::watch;
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

/// How long rooms may take to finish writing at the end.
const WRITING_MS: u64 = 12_000;
/// Threads that carry messages.
const MESSAGE_THREADS: usize = 2;
/// How long connections may take to end.
const ENDING_MS: u64 = 3_000;

/// What a server needs to know.
#[derive(Clone, Debug)]
pub struct Config {
    /// Where it listens for its host at this computer: only this computer's own addresses, port 0 takes a free
    /// one.
    pub listen: SocketAddr,
    /// Where it listens for others, who come by invitation; none if nobody else comes.
    pub network: Option<GuestNetwork>,
    /// The address of its store: a folder for the embedded one, or what [`store::open_url`] knows.
    pub store: String,
    /// The folder for recordings, the robots and the orders on them; without one nothing can be recorded, and robots that
    /// are added last as long as the server.
    pub data: Option<PathBuf>,
    /// The seed of the first simulated robot's noise.
    pub seed: u64,
    /// The page that it shows.
    pub page: PageFiles,
}

/// Why the server did not start, or ended.
#[derive(Debug)]
pub enum ServeError {
    /// The address is not one of this computer's own.
    NotLoopback(SocketAddr),
    /// The address cannot be listened on.
    Listen(SocketAddr, std::io::Error),
    /// The certificate cannot be used.
    Certificate(NoCertificate),
    /// The store cannot be used.
    Store(StoreError),
    /// The robot's thread, or the one for checking, did not start.
    Thread(std::io::Error),
}

impl std::error::Error for ServeError {}

impl From<StoreError> for ServeError {
    fn from(error: StoreError) -> Self {
        Self::Store(error)
    }
}

/// Where a server is, once it accepts connections.
#[derive(Clone, Debug)]
pub struct ReadyServer {
    /// Where this computer reaches it.
    pub address: SocketAddr,
    /// Where others do, or the proxy through which they come.
    pub network: Option<SocketAddr>,
    /// A link by which one browser of this computer becomes the host's, once; none without random numbers.
    pub host_link: Option<String>,
    /// How the first one comes in from elsewhere, if others may.
    pub invited: Option<InvitedFrom>,
}

/// Serves a store until `stop`; `ready` is told the address once connections are accepted.
///
/// # Errors
/// A sentence, if the server cannot start.
pub async fn serve(
    config: Config,
    ready: impl FnOnce(ReadyServer),
    stop: impl Future<Output = ()>,
) -> Result<(), ServeError> {
    check_listen(config.listen)?;
    let url = &config.store;
    let mut stop = std::pin::pin!(stop);
    let store = tokio::select! {
        store = retry(url, || Box::pin(store::open_url(url))) => store?,
        () = &mut stop => return Ok(()),
    };
    let (url, told) = (config.store.clone(), std::sync::OnceLock::new());
    let ready = |now: ReadyServer| {
        // Before anybody is told, so that whoever waits for the server finds it.
        let _first = told.set(AddressFile::new(&url, now.address));
        ready(now);
    };
    serve_with(store, config, ready, stop).await
}

/// Serves a store that is open already until `stop`; `ready` is told the address once connections are accepted.
///
/// # Errors
/// A sentence, if the server cannot start.
pub async fn serve_with(
    store: Arc<dyn Store>,
    config: Config,
    ready: impl FnOnce(ReadyServer),
    stop: impl Future<Output = ()>,
) -> Result<(), ServeError> {
    check_listen(config.listen)?;
    // Read before anybody can press Stop, whose answer waits for nothing.
    catalogues::all();
    let listening = |error| ServeError::Listen(config.listen, error);
    let listener = accept::listen(config.listen).map_err(listening)?;
    let address = listener.local_addr().map_err(listening)?;
    let _data = data_folder::take(&config.store, config.data.as_deref())?;
    let host = Arc::new(HostAccess::within(config.data.as_deref()).map_err(ServeError::Thread)?);
    let invitations = Invitations::within(config.data.as_deref());
    let network = config.network.as_ref();
    let network = network.map(|network| others::open(network, config.data.as_deref(), &invitations)).transpose()?;
    let reached = network.as_ref().map(|network| network.address);
    let state = open(store, &config, Arc::clone(&invitations), Arc::clone(&host)).await?;
    let served = Connections::of(Arc::clone(&state), config.data.as_deref());
    let (closing, connections) = (CancellationToken::new(), TaskTracker::new());
    let messages = Messages::start().map_err(ServeError::Thread)?;
    let router = routes::routes(served, messages.handle().clone(), config.page, address);
    let routed = Routed { router, on: state.tasks.runtime.clone() };
    let door = EntryDoor::local(address.port(), Arc::clone(&host));
    let local = accept::start(listener, door, state.robots.clone(), closing.clone()).map_err(ServeError::Thread)?;
    let (mut accepting, mut ways) = (vec![local.0], vec![local.1]);
    let mut invited = None;
    if let Some(network) = network {
        invited = others::first_invitation(&invitations).await;
        let started = network.start(&state.robots, &closing).map_err(ServeError::Thread)?;
        accepting.extend(started.threads);
        ways.extend(started.handed);
    }
    for handed in ways {
        messages.handle().spawn(boxed(serving::serve(handed, routed.clone(), connections.clone(), closing.clone())));
    }
    store_health::keep(state.health.clone(), Arc::clone(&state.store), &state.tasks);
    invitations::keep(&invitations, &state.files, &state.tasks);
    bin::keep(&state.library, config.data.as_deref());
    let published = host_key::publish(&host.key(address), config.data.as_deref());
    if !published.is_kept() {
        tracing::warn!("commands cannot show that they are the host's: the key could not be written");
    }
    tracing::info!(%address, epoch = state.epoch, "the server is ready");
    ready(ReadyServer { address, network: reached, host_link: host.new_link(address), invited });
    stop.await;
    end(&state, &closing, &connections).await;
    let threads = move || accepting.into_iter().for_each(|thread| drop(thread.join()));
    drop(blocking(threads).await);
    Ok(())
}

/// The threads that carry messages, and nothing else: they read and write what moves between the clients and the rest.
struct Messages(Option<Runtime>);

impl Messages {
    fn start() -> std::io::Result<Self> {
        let mut threads = tokio::runtime::Builder::new_multi_thread();
        threads.worker_threads(MESSAGE_THREADS).max_blocking_threads(1).thread_name("messages").enable_all();
        Ok(Self(Some(threads.build()?)))
    }

    fn handle(&self) -> &Handle {
        #[expect(clippy::expect_used, reason = "it is there until the end")]
        self.0.as_ref().expect("the runtime is there").handle()
    }
}

impl Drop for Messages {
    fn drop(&mut self) {
        if let Some(runtime) = self.0.take() {
            runtime.shutdown_background();
        }
    }
}

fn check_listen(listen: SocketAddr) -> Result<(), ServeError> {
    if listen.ip().is_loopback() { Ok(()) } else { Err(ServeError::NotLoopback(listen)) }
}

async fn open(
    store: Arc<dyn Store>,
    config: &Config,
    invitations: Arc<Invitations>,
    host: Arc<HostAccess>,
) -> Result<Arc<ServerState>, ServeError> {
    let url = &config.store;
    let library = Id::new(protocol::LIBRARY).map_err(|reason| StoreError::Damaged(Damage::Id(reason)))?;
    retry(url, || Box::pin(bounded(store::check_whole(&*store)))).await?;
    let health = StoreHealth::good();
    let epoch = match retry(url, || Box::pin(bounded(store.next_epoch()))).await {
        // Everything can be looked at and stopped; nothing can be saved, which everyone is told.
        Err(full @ StoreError::Full) => {
            health.failed(&full);
            now_ms()
        }
        epoch => epoch?,
    };
    let snapshot = retry(url, || Box::pin(snapshot(&*store, &library))).await?;
    let recordings = Recordings::within(config.data.as_deref());
    let robots = Robots::within(config.data.as_deref(), (config.seed, epoch), recordings.clone());
    let robots = robots.map_err(ServeError::Thread)?;
    let surroundings = Surroundings {
        store,
        health,
        knowing: Arc::new(Knowing::default()),
        workers: Workers::start().map_err(ServeError::Thread)?,
        lookups: Lookups::default(),
        replays: Lookups::of_replays(),
        shown: AllShown::default(),
        past_shown: AllShown::of_the_past(),
        tasks: Tasks::here(),
        library,
        snapshot: watch::Sender::new(Arc::new(snapshot)),
        news: ListNews::default(),
        epoch,
        templates: templates().iter().map(Template::summary).collect(),
        exercises: exercises().iter().map(ExerciseStart::told).collect(),
        is_running: Box::new({
            let robots = robots.clone();
            move |behaviour| robots.has(behaviour)
        }),
    };
    let files = Workers::for_files().map_err(ServeError::Thread)?;
    let analyses = Workers::for_analyses().map_err(ServeError::Thread)?;
    Ok(Arc::new(put_together(surroundings, (robots, recordings), (invitations, host), (files, analyses))))
}

/// Everything, once its parts are there.
fn put_together(
    surroundings: Surroundings,
    (robots, recordings): (Robots, Recordings),
    (invitations, host): (Arc<Invitations>, Arc<HostAccess>),
    (files, analyses): (Workers, Workers),
) -> ServerState {
    let Surroundings { store, health, knowing, workers, lookups, tasks, epoch, .. } = &surroundings;
    let (store, health, knowing) = (Arc::clone(store), health.clone(), Arc::clone(knowing));
    let (workers, lookups, tasks, epoch) = (workers.clone(), lookups.clone(), tasks.clone(), *epoch);
    let rooms = Rooms::within(surroundings);
    let library = Arc::new(LibraryService {
        store: Arc::clone(&store),
        health: health.clone(),
        knowing: Arc::clone(&knowing),
        workers: workers.clone(),
        rooms: rooms.clone(),
        tasks: tasks.clone(),
        creating: tokio::sync::Mutex::default(),
        renaming: tokio::sync::Mutex::default(),
    });
    let thumbnails = Thumbnails::default();
    ServerState {
        files,
        analyses,
        store,
        health,
        robots,
        recordings,
        knowing,
        workers,
        lookups,
        host,
        invitations,
        rooms,
        library,
        thumbnails,
        epoch,
        tasks,
    }
}

/// The library; a fresh store gets the helpers that come with the robot.
async fn snapshot(store: &dyn Store, library: &Id) -> Result<LibrarySnapshot, StoreError> {
    if bounded(store.load(library)).await?.is_none() {
        let (first, mut after) = (first_library(), Behaviour::default());
        after.apply(&first.change);
        if let Append::Conflict { .. } = bounded(store.append(library, &first, &after)).await? {
            tracing::info!("another server made the library");
        }
    }
    let loaded = bounded(store.load(library)).await?;
    Ok(loaded
        .map(|loaded| LibrarySnapshot { behaviour: loaded.behaviour, revision: loaded.revision })
        .unwrap_or_default())
}

/// The robots first, then writing, then the connections.
async fn end(state: &ServerState, closing: &CancellationToken, connections: &TaskTracker) {
    tracing::info!("the server ends: the robots stop first");
    state.robots.stop_now(None, None, "the server's end");
    let robots = state.robots.clone();
    if let Err(error) = blocking(move || robots.shut_down()).await {
        tracing::error!(%error, "the robots did not end in order");
    }
    state.tasks.stopping.cancel();
    state.tasks.tracker.close();
    if tokio::time::timeout(Duration::from_millis(WRITING_MS), state.tasks.tracker.wait()).await.is_err() {
        tracing::error!("some changes were not saved in time; nobody was told that they were");
    }
    closing.cancel();
    connections.close();
    if tokio::time::timeout(Duration::from_millis(ENDING_MS), connections.wait()).await.is_err() {
        tracing::warn!("some connections did not end in time");
    }
}
