//! The order of the behaviours on a robot: if they disagree, the upper one wins. Kept in the data folder, so that it is
//! the same tomorrow.

use crate::support::atomic_file;
use crate::support::lock;
use behaviour::Id;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Behaviours whose place is remembered.
pub(super) const ORDER_MAX: usize = 10_000;
/// Where the orders are in the data folder, a file a robot.
const FOLDER: &str = "robot-orders";

/// The order, from the top. Every use of the list is short; saving waits for the disk outside of it.
#[derive(Debug, Default)]
pub(crate) struct RobotOrder {
    path: Option<PathBuf>,
    list: Mutex<Vec<Id>>,
    saving: Mutex<()>,
}

impl RobotOrder {
    /// The order on a robot that is kept in a data folder; without a folder it lasts as long as the server.
    pub(crate) fn within(data: Option<&Path>, robot: &Id) -> Self {
        let path = data.map(|data| data.join(FOLDER).join(format!("{robot}.json")));
        let list = path.as_deref().and_then(atomic_file::read);
        Self { path, list: Mutex::new(list.unwrap_or_default()), saving: Mutex::default() }
    }

    /// Forgets it for good, as its robot is gone.
    pub(super) fn forget(&self) {
        let gone = self.path.as_ref().map(std::fs::remove_file);
        tracing::debug!(?gone, "the order of a robot that is gone");
    }

    /// All of it, from the top.
    pub(super) fn list(&self) -> Vec<Id> {
        lock(&self.list).clone()
    }

    /// Another order in its place.
    ///
    /// # Errors
    /// If it could not be kept; then nothing changed.
    pub(super) fn replace(&self, order: Vec<Id>) -> std::io::Result<()> {
        self.change(|list| *list = order)
    }

    /// True if the first stands above the second.
    pub(super) fn is_above(&self, one: &Id, other: &Id) -> bool {
        let list = lock(&self.list);
        let place = |id: &Id| list.iter().position(|known| known == id).unwrap_or(usize::MAX);
        place(one) < place(other)
    }

    /// True if it has a place: it ran on this robot.
    pub(super) fn has(&self, behaviour: &Id) -> bool {
        lock(&self.list).contains(behaviour)
    }

    /// How many stand above it.
    pub(super) fn place(&self, behaviour: &Id) -> usize {
        let list = lock(&self.list);
        list.iter().position(|known| known == behaviour).unwrap_or(list.len())
    }

    /// A behaviour that has no place yet gets the lowest.
    ///
    /// # Errors
    /// If it could not be kept; then nothing changed.
    pub(super) fn add(&self, behaviour: &Id) -> std::io::Result<()> {
        self.change(|list| {
            if !list.contains(behaviour) {
                list.truncate(ORDER_MAX - 1);
                list.push(behaviour.clone());
            }
        })
    }

    /// Puts a behaviour just above another one, or at the end.
    ///
    /// # Errors
    /// If it could not be kept; then nothing changed.
    pub(super) fn put(&self, behaviour: &Id, above: Option<&Id>) -> std::io::Result<()> {
        self.change(|list| {
            if above == Some(behaviour) {
                return;
            }
            list.retain(|known| known != behaviour);
            list.truncate(ORDER_MAX - 1);
            let at = above.and_then(|above| list.iter().position(|known| known == above)).unwrap_or(list.len());
            list.insert(at, behaviour.clone());
        })
    }

    /// Kept before it counts.
    fn change(&self, change: impl FnOnce(&mut Vec<Id>)) -> std::io::Result<()> {
        let _saving = lock(&self.saving);
        let before = lock(&self.list).clone();
        let mut after = before.clone();
        change(&mut after);
        if after != before {
            if let Some(path) = &self.path {
                atomic_file::put(path, &serde_json::to_string(&after).map_err(std::io::Error::other)?)?;
            }
            *lock(&self.list) = after;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{ORDER_MAX, RobotOrder};
    use behaviour::Id;

    #[test]
    fn the_order_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let id = |text: &str| Id::new(text).unwrap();
        let (a, b, c) = (id("a"), id("b"), id("c"));
        let (robot, another) = (id("nao"), id("another"));
        let order = RobotOrder::within(Some(folder.path()), &robot);
        for one in [&a, &b, &c, &a] {
            order.add(one).unwrap();
        }
        assert!(order.is_above(&a, &b) && order.is_above(&b, &c) && order.is_above(&c, &id("unknown")));
        order.put(&c, Some(&a)).unwrap();
        order.put(&a, None).unwrap();
        order.put(&b, Some(&b)).unwrap();
        let again = RobotOrder::within(Some(folder.path()), &robot);
        assert_eq!([&c, &b, &a].map(|one| again.place(one)), [0, 1, 2]);
        assert_eq!(RobotOrder::within(Some(folder.path()), &another).place(&c), 0, "every robot has its own");
        again.forget();
        assert_eq!(RobotOrder::within(Some(folder.path()), &robot).place(&a), 0);
    }

    #[test]
    fn however_many_are_placed_the_order_has_its_bound() {
        let order = RobotOrder::default();
        let id = |number: usize| Id::new(&format!("b{number}")).unwrap();
        *order.list.lock().unwrap() = (0..ORDER_MAX).map(id).collect();
        for number in 0..3 {
            order.put(&id(ORDER_MAX + number), Some(&id(1))).unwrap();
        }
        order.put(&id(ORDER_MAX + 9), None).unwrap();
        assert_eq!(order.list.lock().unwrap().len(), ORDER_MAX);
        assert_eq!(order.place(&id(ORDER_MAX)), 1, "who is placed stays, the lowest go");
        assert_eq!(order.place(&id(ORDER_MAX + 9)), ORDER_MAX - 1, "also at the end");
    }
}
