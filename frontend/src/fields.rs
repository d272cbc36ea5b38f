//! Form fields: each is a label, a control and, where it helps, a unit.

mod choice;
mod code;
mod params;
mod text;
mod unfilled;

pub(crate) use choice::{Choice, ChoiceOptions, Select};
pub(crate) use code::{CodeField, pieces};
pub(crate) use params::{ParamFields, ParamForm};
pub(crate) use text::{NumberField, TextField};
pub(crate) use unfilled::Unfilled;
