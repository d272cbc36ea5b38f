//! Which store a command works on, and the way to it.

use crate::data_folder::{kept_in, store_url};
use crate::failure::{Failure, few};
use crate::link::{LocalServer, NamedBehaviour};
use crate::patience;
use behaviour::{Id, as_looks, look_same};
use clap::Args;
use std::future::Future;
use std::path::{Path, PathBuf};
use std::pin::Pin;
use std::sync::Arc;
use store::{LIBRARY, Store, StoreError};

/// The store to work on.
#[derive(Debug, Default, Args)]
pub(crate) struct StoreArgs {
    /// The address of the store: sqlite:FOLDER, files:FOLDER or what else this rrp knows.
    #[arg(long, value_name = "URL", env = "RRP_STORE")]
    pub(crate) store: Option<String>,
    /// The folder of the data; $XDG_DATA_HOME/rrp or ~/.local/share/rrp if absent. With --store only of what is beside
    /// that store: robots and their orders.
    #[arg(long, value_name = "DIR")]
    pub(crate) data: Option<PathBuf>,
}

/// The way to a store.
pub(crate) enum StoreWay {
    /// It is ours alone.
    Store(Arc<dyn Store>),
    /// A running server has it.
    Server(LocalServer),
}

impl StoreArgs {
    /// Opens it, or finds the running server that uses it.
    pub(crate) async fn way(&self) -> Result<StoreWay, Failure> {
        let url = self.url()?;
        if let Some(folder) = self.folder() {
            store::check_folder(&folder)?;
        }
        match patience::opened(&url, || store::open_url_to_work(&url)).await {
            Ok(store) => Ok(StoreWay::Store(store)),
            Err(StoreError::Busy(folder)) => match server::address_in(&folder) {
                Some(address) => Ok(StoreWay::Server(LocalServer { address })),
                None => Err(busy(&folder)),
            },
            Err(error) => Err(error.into()),
        }
    }

    /// Opens it to be filled; a store that a server uses is not touched.
    pub(crate) async fn open_to_fill(&self) -> Result<Arc<dyn Store>, Failure> {
        open_to_fill(&self.url()?).await
    }

    /// Its address.
    pub(crate) fn url(&self) -> Result<String, Failure> {
        store_url(self.store.clone(), self.data.clone())
    }

    /// The folder with what is beside it.
    pub(crate) fn folder(&self) -> Option<PathBuf> {
        kept_in(self.store.as_deref(), self.data.as_deref()).ok().flatten()
    }
}

/// Opens a whole store by its address; one that a server uses is not touched.
pub(crate) async fn open(url: &str) -> Result<Arc<dyn Store>, Failure> {
    patience::opened(url, || store::open_url_to_work(url)).await.map_err(unopened)
}

/// Opens a store by its address to be filled; one that a server uses is not touched.
pub(crate) async fn open_to_fill(url: &str) -> Result<Arc<dyn Store>, Failure> {
    patience::opened(url, || store::open_url_to_fill(url)).await.map_err(unopened)
}

fn unopened(error: StoreError) -> Failure {
    match error {
        StoreError::Busy(folder) => busy(&folder),
        other => other.into(),
    }
}

/// A running server uses the store in this folder.
fn busy(folder: &Path) -> Failure {
    Failure::of(format!("A running rrp server uses {}. Stop it, then do this again.", folder.display()))
}

/// The id of the library.
pub(crate) fn library() -> Result<Id, Failure> {
    Id::new(LIBRARY).map_err(Failure::of)
}

/// Runs what waits for a store, to its end.
pub(crate) fn run<T>(work: impl Future<Output = Result<T, Failure>>) -> Result<T, Failure> {
    let runtime = tokio::runtime::Runtime::new();
    let runtime = runtime.map_err(|error| Failure::of(format!("This could not start: {error}.")))?;
    // In a box commands with the same answer look the same, and the runtime is compiled once for all of them.
    let work: Pin<Box<dyn Future<Output = Result<T, Failure>> + '_>> = Box::pin(work);
    runtime.block_on(work)
}

/// Id and name of everything that is not in the bin, by name.
pub(crate) async fn listed(store: &dyn Store) -> Result<Vec<NamedBehaviour>, Failure> {
    let names = server::names(store).await?;
    Ok(names.into_iter().map(|(id, name)| NamedBehaviour { id, name }).collect())
}

/// The one behaviour that has this id or name.
pub(crate) fn find(listed: &[NamedBehaviour], wanted: &str) -> Result<Id, Failure> {
    if let Some(line) = listed.iter().find(|line| line.id.as_str() == wanted) {
        return Ok(line.id.clone());
    }
    let exact: Vec<_> = listed.iter().filter(|line| look_same(&line.name, wanted)).collect();
    let lower = as_looks(wanted).to_lowercase();
    let near: Vec<_> = listed.iter().filter(|line| as_looks(&line.name).to_lowercase() == lower).collect();
    match (exact.as_slice(), near.as_slice()) {
        ([one], _) | ([], [one]) => Ok(one.id.clone()),
        ([], []) => Err(unknown(listed, wanted)),
        ([], many) | (many, _) => Err(several(many, wanted)),
    }
}

/// No behaviour has this id or name.
fn unknown(listed: &[NamedBehaviour], wanted: &str) -> Failure {
    let names: Vec<_> = listed.iter().map(|line| line.name.clone()).collect();
    let there = match names[..] {
        [] => "The store is empty; look whether --store or --data is right.".to_owned(),
        [..] => few(&names),
    };
    Failure::of(format!("There is no behaviour “{wanted}”. {there}"))
}

/// All of these behaviours have this name.
fn several(many: &[&NamedBehaviour], wanted: &str) -> Failure {
    let ids: Vec<_> = many.iter().map(|line| line.id.as_str()).collect();
    Failure::of(format!("Several behaviours are called “{wanted}”. Say which one by its id: {}.", ids.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::{NamedBehaviour, find};
    use behaviour::Id;

    fn line(id: &str, name: &str) -> NamedBehaviour {
        NamedBehaviour { id: Id::new(id).expect("an id"), name: name.to_owned() }
    }

    #[test]
    fn a_behaviour_is_found_by_id_or_name_and_doubt_is_told() {
        let listed = [line("a1", "Greet"), line("b2", "Follow"), line("c3", "follow"), line("d4", "Greet")];
        assert_eq!(find(&listed, "b2").unwrap().as_str(), "b2");
        assert_eq!(find(&listed, "Follow").unwrap().as_str(), "b2");
        let refused = |listed: &[NamedBehaviour], wanted: &str| find(listed, wanted).unwrap_err().to_string();
        assert!(refused(&listed, "FOLLOW").contains("b2, c3"));
        assert!(refused(&listed, "Greet").contains("a1, d4"));
        assert!(refused(&listed, "Dance").contains("There are “Greet”"));
        assert!(refused(&[], "Dance").contains("empty"));
    }
}
