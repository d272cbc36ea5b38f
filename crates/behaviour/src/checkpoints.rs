//! Named checkpoints: revisions of a behaviour that somebody gave a name, to find and compare them later.

use crate::{Refusal, has_unseen, without_unseen};
use phrase::phrase;
use serde::{Deserialize, Serialize};

/// The longest name of a checkpoint, in characters.
pub const CHECKPOINT_NAME_MAX_CHARS: usize = 80;
/// Checkpoints of one behaviour: so many that all of them, with the longest names, fit into one message.
pub const CHECKPOINTS_MAX: usize = 400;

/// A revision with a name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Checkpoint {
    /// The behaviour as it was after so many changes.
    pub revision: u64,
    /// Unique among the checkpoints of the behaviour.
    pub name: String,
    /// The name of the person who named the revision.
    pub by: String,
    /// The time when it was named, in milliseconds since 1970.
    pub at_ms: u64,
}

/// The checkpoints of one behaviour, by revision and then in the order in which they were named.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct Checkpoints(Vec<Checkpoint>);

impl Checkpoints {
    /// The checkpoints that were kept, in any order.
    #[must_use]
    pub fn of(mut kept: Vec<Checkpoint>) -> Self {
        kept.sort_by_key(|one| (one.revision, one.at_ms));
        Self(kept)
    }

    /// All of them.
    #[must_use]
    pub fn all(&self) -> &[Checkpoint] {
        &self.0
    }

    /// Names a revision, of `newest` that there are. Spaces around the name are left out. Gives what is to be kept.
    ///
    /// # Errors
    /// Refuses an unfit name, a revision that is not there yet, and names beyond the most that are kept.
    pub fn add(&mut self, newest: u64, wanted: Checkpoint) -> Result<Checkpoint, Refusal> {
        if wanted.revision > newest {
            return Err(Refusal::Malformed(phrase!(
                "checkpoints.later",
                "there is no revision {revision} yet",
                revision = wanted.revision
            )));
        }
        if self.0.len() >= CHECKPOINTS_MAX {
            return Err(Refusal::TooMany(phrase!("many.named_versions", "named versions"), CHECKPOINTS_MAX));
        }
        let (name, by) = (self.check_name(&wanted.name)?, without_unseen(&wanted.by));
        let made = Checkpoint { name, by, ..wanted };
        let at = self.0.partition_point(|one| (one.revision, one.at_ms) <= (made.revision, made.at_ms));
        self.0.insert(at, made.clone());
        Ok(made)
    }

    /// Takes a name away; the revision stays. Gives what is not to be kept any more.
    pub fn remove(&mut self, name: &str) -> Option<Checkpoint> {
        let at = self.0.iter().position(|one| one.name == name)?;
        Some(self.0.remove(at))
    }

    fn check_name(&self, name: &str) -> Result<String, Refusal> {
        let name = name.trim();
        if name.chars().count() > CHECKPOINT_NAME_MAX_CHARS {
            return Err(Refusal::TooLong(phrase!("limited.name", "this name"), CHECKPOINT_NAME_MAX_CHARS));
        }
        if name.is_empty() || name.chars().any(char::is_control) {
            return Err(Refusal::Name(without_unseen(name)));
        }
        if has_unseen(name) {
            return Err(Refusal::Unseen(without_unseen(name)));
        }
        let is_taken = self.0.iter().any(|one| crate::look_same(&one.name, name));
        if is_taken { Err(Refusal::NameTaken(name.to_owned())) } else { Ok(name.to_owned()) }
    }
}

#[cfg(test)]
mod tests {
    use super::{CHECKPOINT_NAME_MAX_CHARS, CHECKPOINTS_MAX, Checkpoint, Checkpoints};
    use crate::Refusal;

    fn named(revision: u64, name: &str) -> Checkpoint {
        Checkpoint { revision, name: name.into(), by: "Aiko".into(), at_ms: 0 }
    }

    #[test]
    fn checkpoints_stand_in_the_order_of_revisions() {
        let mut all = Checkpoints::default();
        for (revision, name) in [(5, "Works with the ball"), (2, " First try "), (5, "Shown to Mr Ito")] {
            all.add(9, named(revision, name)).unwrap();
        }
        let names: Vec<&str> = all.all().iter().map(|one| one.name.as_str()).collect();
        assert_eq!(names, ["First try", "Works with the ball", "Shown to Mr Ito"]);
        assert_eq!(Checkpoints::of(all.all().iter().rev().cloned().collect()).all()[0], named(2, "First try"));
        assert_eq!(all.remove("First try"), Some(named(2, "First try")));
        assert_eq!(all.remove("First try"), None);
    }

    #[test]
    fn a_name_is_seen_unique_and_short() {
        let mut all = Checkpoints::default();
        all.add(9, named(1, "Good")).unwrap();
        let mut no = |name: &str| all.add(9, named(1, name)).unwrap_err();
        assert_eq!(no("Good "), Refusal::NameTaken("Good".into()));
        assert_eq!(no("  "), Refusal::Name(String::new()));
        assert_eq!(no("Go\u{200b}od"), Refusal::Unseen("Good".into()));
        assert!(matches!(no(&"x".repeat(CHECKPOINT_NAME_MAX_CHARS + 1)), Refusal::TooLong(_, 80)));
        assert!(matches!(all.add(9, named(10, "Later")), Err(Refusal::Malformed(_))));
    }

    #[test]
    fn there_are_so_many_at_most() {
        let mut all = Checkpoints::default();
        (0..CHECKPOINTS_MAX).for_each(|number| drop(all.add(1, named(1, &format!("n{number}"))).unwrap()));
        let no = all.add(1, named(1, "one more")).unwrap_err();
        assert_eq!(no.to_string(), "A program holds at most 400 named versions. Remove some first.");
    }
}
