//! From where those who are in came lately.

use crate::invitations::Source;
use crate::support::lock;
use std::collections::{HashSet, VecDeque};
use std::sync::Mutex;

/// Places that are remembered; the one that was first is forgotten.
const PLACES_MAX: usize = 1_024;

/// Places from which somebody showed a cookie that holds.
#[derive(Debug, Default)]
pub(crate) struct Known(Mutex<Places>);

#[derive(Debug, Default)]
struct Places {
    all: HashSet<Source>,
    order: VecDeque<Source>,
}

impl Known {
    /// Somebody who is in comes from there.
    pub(crate) fn note(&self, from: Source) {
        let mut places = lock(&self.0);
        if places.all.insert(from) {
            places.order.push_back(from);
        }
        if places.order.len() > PLACES_MAX
            && let Some(first) = places.order.pop_front()
        {
            places.all.remove(&first);
        }
    }

    /// Whether somebody who is in came from there lately.
    pub(crate) fn has(&self, from: Source) -> bool {
        lock(&self.0).all.contains(&from)
    }
}
