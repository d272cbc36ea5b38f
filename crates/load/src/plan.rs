//! The plan of a load: who does what, how fast and for how long.

/// The plan of a load.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoadPlan {
    /// Clients that edit, each its own note of one behaviour.
    pub clients: usize,
    /// Behaviours, among which the clients are spread evenly.
    pub behaviours: usize,
    /// Edits of each client in ten seconds.
    pub edits_per_10_s: u32,
    /// Clients besides that open a behaviour and read nothing of what they are told.
    pub stalled: usize,
    /// Links of clients that end without a word, spread over the time.
    pub kills: usize,
    /// For how long edits are made, in seconds.
    pub seconds: u64,
    /// The seed of chance.
    pub seed: u64,
}

impl Default for LoadPlan {
    fn default() -> Self {
        Self { clients: 50, behaviours: 1, edits_per_10_s: 50, stalled: 0, kills: 0, seconds: 30, seed: 1 }
    }
}

impl LoadPlan {
    /// Between two edits of one client, in microseconds.
    pub(crate) fn pause_us(&self) -> u64 {
        10_000_000 / u64::from(self.edits_per_10_s.max(1))
    }

    /// The behaviour of a client.
    pub(crate) fn behaviour_of(&self, client: usize) -> usize {
        client % self.behaviours.max(1)
    }
}
