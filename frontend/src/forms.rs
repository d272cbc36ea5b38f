//! The panel of the selection, and the forms of connectors, streams and helpers.

mod all_problems;
mod apply;
mod choose;
mod chosen;
mod control;
mod drafting;
mod gone;
mod helper;
mod helpers;
mod insight;
mod inspector;
mod instead;
mod marbles;
mod operation;
mod problems;
mod stream;
pub(crate) mod trials;
mod uses;
mod words;

pub(crate) use all_problems::AllProblems;
pub(crate) use apply::apply;
pub(crate) use choose::Choose;
pub(crate) use chosen::chosen;
pub(crate) use control::control;
pub(crate) use helper::EditHelper;
pub(crate) use helpers::Helpers;
pub(crate) use inspector::{Inspector, selected};
pub(crate) use operation::{Operation, edit_dialog};
pub(crate) use problems::problems;
pub(crate) use stream::EditStream;
