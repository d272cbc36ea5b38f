//! Form fields: each is a label, a control and, where it helps, a unit.

mod choice;
mod code;
mod params;
mod sentence;
mod text;

pub(crate) use choice::{Choice, ChoiceOptions, Select};
pub(crate) use code::{CodeField, pieces};
pub(crate) use params::{ParamFields, ParamForm};
pub(crate) use sentence::SentenceField;
pub(crate) use text::{NumberField, TextField, read_one_way};
