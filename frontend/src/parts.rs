//! The pieces of views that the graph shares with what stands around it: menus, lists of problems, the desk at hand.

mod finder;
mod hold;
mod kinds;
mod may;
mod menu;
mod note_field;
mod page_language;
mod problems;
mod remove;
mod side;
mod usable;

pub(crate) use finder::Finder;
pub(crate) use hold::{DeskHold, Soon, hold};
pub(crate) use kinds::{device_icon, kind_class};
pub(crate) use may::{MayNot, may_edit, may_operate, title_or_why};
pub(crate) use menu::{Menu, MenuItem};
pub(crate) use note_field::{NoteField, author_color, note_name, written_by};
pub(crate) use page_language::{OtherLanguage, language};
pub(crate) use problems::{FailingList, ProblemLine, ProblemList, problem_count};
pub(crate) use remove::RemoveButton;
pub(crate) use side::{OpenPanel, PanelButtons, SidePanel, open_name};
pub(crate) use usable::mark_usable;
