//! The language of procedures: Rhai, hardened, with a library of our own.

pub(crate) mod conversion;
pub(crate) mod faults;
pub(crate) mod fields;
pub(crate) mod library;
mod lists;
pub(crate) mod maths;
pub(crate) mod sandbox;
mod texts;
