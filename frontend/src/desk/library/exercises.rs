//! The exercise that the open program is of, and whether its goal is reached.

use super::LibraryPanel;
use crate::link::NoAnswer;
use leptos::prelude::*;
use protocol::{Exercise, RehearsalResult, request};

impl LibraryPanel {
    /// The exercise that the open program is of: its settings say so, in programs made before a note. Reactive.
    pub(crate) fn exercise(&self) -> Option<Exercise> {
        let (begun, notes) = (self.document.exercise.get(), self.document.notes.read());
        let is_it = |exercise: &&Exercise| {
            begun.as_ref().map_or_else(|| notes.contains(&exercise.note()), |begun| *begun == exercise.start.id)
        };
        self.exercises.read().iter().find(is_it).cloned()
    }

    /// Asks the server to rehearse the open program, as it is saved, with what is answered to the questions.
    pub(crate) fn try_exercise(
        &self,
        exercise: &Exercise,
        answers: Vec<u8>,
        then: impl FnOnce(Result<RehearsalResult, NoAnswer>) + 'static,
    ) {
        let Some(behaviour) = self.document.open.get_untracked() else { return };
        let request = request::TryExercise { behaviour, exercise: exercise.start.id.clone(), answers };
        self.tab.look_up(request, move |answer| then(answer.map(|answer| answer.tried)));
    }
}
