//! Programs: the empty stage with the library, the dialog of all programs, their files and names.

mod empty;
mod files;
mod names;
mod pasted;
mod programs;
mod save_file;
mod words;

use crate::desk::Desk;
use behaviour::Id;
pub(crate) use empty::EmptyStage;
pub(crate) use files::Files;
pub(crate) use names::{AddProgram, RemoveProgram, RenameProgram};
pub(crate) use pasted::OpenPasted;
pub(crate) use programs::Programs;
pub(crate) use save_file::SaveFile;

/// Opens a program of the list.
pub(crate) fn open_program(desk: &Desk, id: &str) {
    if let Ok(id) = Id::new(id) {
        desk.document.open_program(&id);
    }
}
