//! When connectors give something by themselves: by instant, rank and place.

use crate::values::{ConnectorIx, IndexVec};
use robot::Millis;
use std::collections::BTreeSet;

/// The connectors that will give something by themselves; others would be asked in vain.
pub(crate) struct Schedule {
    order: BTreeSet<(Millis, usize, ConnectorIx)>,
    /// For every connector when it is due.
    due: IndexVec<ConnectorIx, Option<Millis>>,
}

impl Schedule {
    pub(crate) fn of(connectors: usize) -> Self {
        Self { order: BTreeSet::new(), due: IndexVec::filled(&None, connectors) }
    }

    /// Says when a connector is due from now on.
    pub(crate) fn set(&mut self, connector: ConnectorIx, rank: usize, due: Option<Millis>) {
        let before = std::mem::replace(&mut self.due[connector], due);
        if before == due {
            return;
        }
        if let Some(before) = before {
            self.order.remove(&(before, rank, connector));
        }
        if let Some(due) = due {
            self.order.insert((due, rank, connector));
        }
    }

    /// The one that is due first.
    pub(crate) fn first(&self) -> Option<(Millis, ConnectorIx)> {
        self.order.first().map(|(at, _, connector)| (*at, *connector))
    }

    /// When a connector is due, if it will be.
    pub(crate) fn due(&self, connector: ConnectorIx) -> Option<Millis> {
        self.due[connector]
    }
}
