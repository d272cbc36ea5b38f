//! The things beside the open program: programs, templates and their pictures, and the helpers that programs share.

mod exercises;
mod files;
mod helpers;
mod lists;
mod making;
mod pasted;
mod pictures;
mod settings;

pub(crate) use files::{file_address, first_file};
pub(crate) use lists::ProgramPage;
pub(crate) use pasted::Pasted;
pub(crate) use settings::Settle;

use super::document::Document;
use super::tab::{Gone, Tab};
use behaviour::{Behaviour, Helper, Id};
use leptos::prelude::*;
use protocol::{Exercise, Summary};
use std::collections::HashMap;
use std::ops::Deref;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The library. A clone is the same library.
#[derive(Clone)]
pub(crate) struct LibraryPanel(Arc<LibraryFields>);

/// The state of the library that the page shows.
pub(crate) struct LibraryFields {
    tab: Tab,
    document: Document,
    /// The newest programs.
    pub(crate) programs: ArcRwSignal<Vec<Summary>>,
    /// The number of programs.
    pub(crate) programs_total: ArcRwSignal<u64>,
    /// Grows when the list of programs changed somewhere.
    pub(crate) news: ArcRwSignal<u32>,
    pub(crate) pictures: ArcRwSignal<pictures::ProgramPictures>,
    pub(crate) templates: ArcRwSignal<Vec<Summary>>,
    /// The exercises to learn with.
    pub(crate) exercises: ArcRwSignal<Vec<Exercise>>,
    /// The helpers, by name.
    pub(crate) helpers: ArcRwSignal<Vec<(Id, Helper)>>,
    /// The program that was removed here last, as long as nothing else was chosen since.
    pub(crate) gone: ArcRwSignal<Option<Gone>>,
    /// True while a file is dragged over the page.
    pub(crate) dropping: ArcRwSignal<bool>,
    state: Mutex<LibraryState>,
}

/// The state that is not shown itself.
#[derive(Default)]
struct LibraryState {
    /// The helpers as the server has them.
    records: Behaviour,
    revision: u64,
    /// The people who last changed a helper since the page was opened, by its id.
    changed_by: HashMap<Id, String>,
    /// The program that is to be made, until the server has answered.
    making: Option<making::ProgramMaking>,
    wanted_pictures: pictures::WantedPictures,
}

impl Deref for LibraryPanel {
    type Target = LibraryFields;
    fn deref(&self) -> &LibraryFields {
        &self.0
    }
}

impl LibraryPanel {
    /// Nothing known yet.
    pub(super) fn new(tab: Tab, document: Document) -> Self {
        Self(Arc::new(LibraryFields {
            tab,
            document,
            programs: ArcRwSignal::default(),
            programs_total: ArcRwSignal::default(),
            news: ArcRwSignal::default(),
            pictures: ArcRwSignal::default(),
            templates: ArcRwSignal::default(),
            exercises: ArcRwSignal::default(),
            helpers: ArcRwSignal::default(),
            gone: ArcRwSignal::default(),
            dropping: ArcRwSignal::default(),
            state: Mutex::default(),
        }))
    }

    fn state(&self) -> MutexGuard<'_, LibraryState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
