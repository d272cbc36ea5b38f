//! Tasks to learn with: a behaviour to begin with, what it shall become, and what a rehearsal of it expects.

mod goal;
mod rehearsal;

use super::templates::Template;
use goal::ExerciseGoal;
use protocol::{Exercise, ExerciseQuestion};
pub(crate) use rehearsal::rehearse;

/// A template with a goal.
pub(crate) struct ExerciseStart {
    /// What one begins with.
    pub(crate) template: Template,
    goal: &'static str,
}

impl ExerciseStart {
    /// What the rehearsal of it expects.
    pub(crate) fn goal(&self) -> ExerciseGoal {
        #[expect(clippy::expect_used, reason = "the text is part of the program and a test reads every one")]
        serde_json::from_str::<ExerciseGoal>(self.goal).expect("a goal is a goal").keyed(self.template.name)
    }

    /// What people are told about it.
    pub(crate) fn told(&self) -> Exercise {
        let ExerciseGoal { says, asks, .. } = self.goal();
        let asks = asks.into_iter().map(|one| ExerciseQuestion { ask: one.ask, answers: one.answers }).collect();
        Exercise { start: self.template.summary(), goal: says, asks }
    }
}

/// The exercise of this name.
pub(crate) fn exercise(name: &str) -> Option<&'static ExerciseStart> {
    EXERCISES.iter().find(|exercise| exercise.template.name == name)
}

/// All exercises, in the order in which one learns.
pub(crate) fn exercises() -> &'static [ExerciseStart] {
    EXERCISES
}

/// Those of the user study (thesis, chapter 7), to explain, to debug and to create, and one between them.
const EXERCISES: &[ExerciseStart] = &[
    ExerciseStart {
        template: Template::of(
            "Explain the eyes",
            "Read it: what do the eyes do when balls of several colors come?",
            include_str!("../../../../tests/exercises/explain_eyes.json"),
        ),
        goal: include_str!("../../../../tests/exercises/explain_eyes.goal.json"),
    },
    ExerciseStart {
        template: Template::of(
            "Explain the words",
            "Read it: what does the robot say when balls of several colors come, and how often?",
            include_str!("../../../../tests/exercises/explain_words.json"),
        ),
        goal: include_str!("../../../../tests/exercises/explain_words.goal.json"),
    },
    ExerciseStart {
        template: Template::of(
            "Follow only a close ball",
            "Add to it: the head follows every red ball, and shall follow only a close one.",
            include_str!("../../../../tests/exercises/only_close.json"),
        ),
        goal: include_str!("../../../../tests/exercises/only_close.goal.json"),
    },
    ExerciseStart {
        template: Template::of(
            "Brighter when nearer",
            "Find the mistake: the eyes shall shine brighter the nearer the ball is, and do not.",
            include_str!("../../../../tests/exercises/brighter_when_nearer.json"),
        ),
        goal: include_str!("../../../../tests/exercises/brighter_when_nearer.goal.json"),
    },
    ExerciseStart {
        template: Template::of(
            "Follow far and close balls",
            "Make it yourself: far balls are followed with the head, close ones with body and arm.",
            include_str!("../../../../tests/exercises/far_and_close.json"),
        ),
        goal: include_str!("../../../../tests/exercises/far_and_close.goal.json"),
    },
];

#[cfg(test)]
mod tests;
