//! What is left to do after a Stop was answered: writing down what ended, giving devices back, showing it. On a thread of
//! its own, which looks at all robots when it is rung; so no Stop waits for it, and none is missed.

use super::Fleet;
use crate::support::lock;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Weak};

/// The way to the thread, which ends with the last one.
#[derive(Clone)]
pub(super) struct Settling(SyncSender<()>);

impl Settling {
    /// Starts the thread.
    ///
    /// # Errors
    /// If it cannot be made.
    pub(super) fn start(fleet: &Arc<Fleet>) -> std::io::Result<Self> {
        // One ring that waits is enough for any number of Stops.
        let (bell, rings) = sync_channel(1);
        let fleet = Arc::downgrade(fleet);
        std::thread::Builder::new().name("stops".into()).spawn(move || work(&rings, &fleet))?;
        Ok(Self(bell))
    }

    /// Something was stopped.
    pub(super) fn ring(&self) {
        let _one_waits = self.0.try_send(());
    }
}

fn work(rings: &Receiver<()>, fleet: &Weak<Fleet>) {
    while let (Ok(()), Some(fleet)) = (rings.recv(), fleet.upgrade()) {
        let hosts = lock(&fleet.hosts).clone();
        hosts.iter().for_each(super::Host::settle);
    }
}
