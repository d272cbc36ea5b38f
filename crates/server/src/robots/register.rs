//! Which robots there are, kept in the data folder before it counts.

use super::refusal::RobotsUnchanged;
use crate::support::atomic_file;
use behaviour::{Id, has_unseen, numbered};
use protocol::ROBOT_NAME_MAX_CHARS;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Its file in the data folder.
const FILE: &str = "robots.json";
/// The robot that is there at first.
const FIRST: (&str, &str) = ("simulated-nao", "Simulated NAO");

/// The robots that are known, oldest first; never empty.
pub(super) struct Register {
    path: Option<PathBuf>,
    known: Vec<Known>,
    seed: u64,
}

/// A simulated NAO.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(super) struct Known {
    /// Its id.
    pub(super) robot: Id,
    /// What people call it.
    pub(super) name: String,
    /// The seed of its noise.
    pub(super) seed: u64,
}

impl Register {
    /// What is kept in a data folder, at first one robot with this seed.
    pub(super) fn within(data: Option<&Path>, seed: u64) -> Self {
        let path = data.map(|data| data.join(FILE));
        let known: Vec<Known> = path.as_deref().and_then(atomic_file::read).unwrap_or_default();
        let mut this = Self { path, known, seed };
        if let (true, Ok(robot)) = (this.known.is_empty(), Id::new(FIRST.0)) {
            this.known.push(Known { robot, name: FIRST.1.to_owned(), seed });
        }
        this
    }

    /// Whether it was ever written: people added or removed a robot.
    pub(super) fn is_kept(&self) -> bool {
        self.path.as_ref().is_some_and(|path| path.is_file())
    }

    /// Others in their place.
    pub(super) fn replace(&mut self, known: Vec<Known>) -> std::io::Result<()> {
        self.keep(known)
    }

    /// All of them.
    pub(super) fn known(&self) -> &[Known] {
        &self.known
    }

    /// A robot to be, with a name and noise that no other has.
    ///
    /// # Errors
    /// What is wrong with the name.
    pub(super) fn newcomer(&self, robot: &Id, name: &str) -> Result<Known, RobotsUnchanged> {
        let name = name.trim();
        if name.is_empty() || has_unseen(name) {
            return Err(RobotsUnchanged::Nameless);
        }
        if name.chars().count() > ROBOT_NAME_MAX_CHARS {
            return Err(RobotsUnchanged::LongName);
        }
        let is_free = |wanted: &String| self.known.iter().all(|known| known.name != *wanted);
        let name = numbered(name, " ").find(is_free).unwrap_or_default();
        let seed = self.known.iter().map(|known| known.seed).fold(self.seed, u64::max).wrapping_add(1);
        Ok(Known { robot: robot.clone(), name, seed })
    }

    /// One more.
    pub(super) fn add(&mut self, known: Known) -> std::io::Result<()> {
        let mut after = self.known.clone();
        after.push(known);
        self.keep(after)
    }

    /// One less.
    pub(super) fn remove(&mut self, robot: &Id) -> std::io::Result<()> {
        let mut after = self.known.clone();
        after.retain(|known| known.robot != *robot);
        self.keep(after)
    }

    fn keep(&mut self, after: Vec<Known>) -> std::io::Result<()> {
        if let Some(path) = &self.path {
            atomic_file::put(path, &serde_json::to_string(&after).map_err(std::io::Error::other)?)?;
        }
        self.known = after;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Register;
    use behaviour::Id;

    #[test]
    fn who_is_there_is_kept_under_names_of_their_own() {
        let folder = tempfile::tempdir().unwrap();
        let id = |text: &str| Id::new(text).unwrap();
        let mut register = Register::within(Some(folder.path()), 7);
        for robot in ["a", "b"] {
            let known = register.newcomer(&id(robot), " Simulated NAO ").unwrap();
            register.add(known).unwrap();
        }
        register.remove(&id("simulated-nao")).unwrap();
        let again = Register::within(Some(folder.path()), 1);
        let known: Vec<_> = again.known().iter().map(|known| (known.name.as_str(), known.seed)).collect();
        assert_eq!(known, [("Simulated NAO 2", 8), ("Simulated NAO 3", 9)]);
    }

    #[test]
    fn a_name_is_needed() {
        let register = Register::within(None, 1);
        let robot = Id::new("a").unwrap();
        assert!(register.newcomer(&robot, " \t ").is_err());
        assert!(register.newcomer(&robot, "a\u{7}").is_err());
        assert!(register.newcomer(&robot, "NAO\u{202e}").is_err());
        assert!(register.newcomer(&robot, &"x".repeat(41)).is_err());
        assert!(register.newcomer(&robot, &"x".repeat(40)).is_ok());
    }
}
