//! The names by which this server subscribes on robots, kept in the data folder. What was left on a robot that was away when
//! it was removed here, or when another body took its place, is under the name of then. So such names are remembered, every
//! robot is asked for what is under them when it comes, and a robot that is another body from now on has another name.

use crate::support::atomic_file;
use behaviour::Id;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The name of the file of names in the data folder.
const FILE: &str = "robot-names.json";
/// The word that all names of this server begin with.
pub(super) const OWN_NAME: &str = "rrp";
/// Most names that are remembered of what is no more; the oldest go first.
const FORMER_MAX: usize = 64;

/// The names, now and before.
pub(super) struct RobotNames {
    path: Option<PathBuf>,
    kept: KeptNames,
}

#[derive(Clone, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields, default)]
struct KeptNames {
    /// The number of other bodies that a robot was before, if it was one.
    bodies: BTreeMap<Id, u32>,
    /// Names that no robot has any more, oldest first.
    former: Vec<String>,
}

impl RobotNames {
    /// Returns the names that are kept in a data folder; none if there is no folder.
    pub(super) fn within(data: Option<&Path>) -> Self {
        let path = data.map(|data| data.join(FILE));
        let kept = path.as_deref().and_then(atomic_file::read).unwrap_or_default();
        Self { path, kept }
    }

    /// Returns the name that a robot's subscriptions begin with.
    pub(super) fn own(&self, robot: &Id) -> String {
        match self.kept.bodies.get(robot) {
            Some(before) => format!("{OWN_NAME}-{robot}-{}", before + 1),
            None => format!("{OWN_NAME}-{robot}"),
        }
    }

    /// Names that none of these robots has.
    pub(super) fn former<'a>(&self, robots: impl Iterator<Item = &'a Id>) -> Vec<String> {
        let now: Vec<String> = robots.map(|robot| self.own(robot)).collect();
        self.kept.former.iter().filter(|name| !now.contains(name)).cloned().collect()
    }

    /// A robot is removed.
    pub(super) fn leave(&mut self, robot: &Id) {
        let name = self.own(robot);
        self.kept.bodies.remove(robot);
        self.outlive(name);
    }

    /// A robot is another body from now on.
    pub(super) fn change(&mut self, robot: &Id) {
        let name = self.own(robot);
        *self.kept.bodies.entry(robot.clone()).or_default() += 1;
        self.outlive(name);
    }

    /// Nobody has this name any more.
    fn outlive(&mut self, name: String) {
        self.kept.former.retain(|known| *known != name);
        self.kept.former.push(name);
        let over = self.kept.former.len().saturating_sub(FORMER_MAX);
        self.kept.former.drain(..over);
        if let Some(path) = &self.path {
            let text = serde_json::to_string(&self.kept).map_err(std::io::Error::other);
            // A subscription that is left under a forgotten name only measures for nobody.
            if let Err(error) = text.and_then(|text| atomic_file::put(path, &text)) {
                tracing::warn!(%error, "a name that no robot has any more could not be kept");
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{FORMER_MAX, RobotNames};
    use behaviour::Id;

    fn id(text: &str) -> Id {
        Id::new(text).unwrap()
    }

    #[test]
    fn a_name_outlives_its_robot_and_its_body() {
        let folder = tempfile::tempdir().unwrap();
        let (blue, green) = (id("blue"), id("green"));
        let mut names = RobotNames::within(Some(folder.path()));
        assert_eq!((names.own(&blue).as_str(), names.former([&blue].into_iter())), ("rrp-blue", Vec::new()));
        names.change(&blue);
        names.change(&blue);
        names.leave(&green);
        let names = RobotNames::within(Some(folder.path()));
        assert_eq!(names.own(&blue), "rrp-blue-3");
        assert_eq!(names.former([&blue].into_iter()), ["rrp-blue", "rrp-blue-2", "rrp-green"]);
        assert_eq!(names.former([&blue, &green].into_iter()), ["rrp-blue", "rrp-blue-2"], "it is here again");
    }

    #[test]
    fn only_so_many_are_remembered() {
        let mut names = RobotNames::within(None);
        (0..FORMER_MAX + 3).for_each(|number| names.leave(&id(&format!("r{number}"))));
        names.leave(&id("r5"));
        let former = names.former(std::iter::empty());
        assert_eq!(
            (former.len(), former[0].as_str(), former.last().unwrap().as_str()),
            (FORMER_MAX, "rrp-r3", "rrp-r5")
        );
    }
}
