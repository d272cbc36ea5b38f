//! The pieces of every dialog: its frame, who may write in it, and one that asks for a name.

mod frame;
mod held;
mod one_name;
mod words;

pub(crate) use frame::{Feet, Frame, Refused, close, focus_again};
pub(crate) use held::{DialogLock, Holding};
pub(crate) use one_name::{OneName, RemoveQuestion};
