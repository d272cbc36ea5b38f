//! The commands to the thread of the link.

use crate::deed::Action;
use crate::devices::Sense;
use robot::{Control, Use};
use std::sync::atomic::{AtomicUsize, Ordering};
use tokio::sync::mpsc;

/// A command to the link's thread.
pub(crate) enum LinkCommand {
    Open(Use, Box<dyn Sense>),
    Close(Use),
    /// With the stop generation in which it was wanted.
    Do(u64, Use, Action),
    Control(Control),
}

pub(crate) type LinkCommands = mpsc::UnboundedReceiver<LinkCommand>;

/// Drops all orders: what was wanted of a robot that is gone is void.
pub(crate) fn drain(orders: &mut LinkCommands, waiting: &AtomicUsize) {
    while let Ok(order) = orders.try_recv() {
        if matches!(order, LinkCommand::Do(..)) {
            waiting.fetch_sub(1, Ordering::SeqCst);
        }
    }
}
