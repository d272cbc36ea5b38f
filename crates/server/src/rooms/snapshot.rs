//! The helper library as it is saved, for everyone who checks or runs behaviours.

use behaviour::{Behaviour, Helper};

/// The helper library at one revision.
#[derive(Clone, Debug, Default)]
pub(crate) struct LibrarySnapshot {
    /// Its records.
    pub(crate) behaviour: Behaviour,
    /// Its revision.
    pub(crate) revision: u64,
}

impl LibrarySnapshot {
    /// All helpers in order of id.
    pub(crate) fn helpers(&self) -> Vec<&Helper> {
        self.behaviour.helpers().map(|(_, helper)| helper).collect()
    }
}
