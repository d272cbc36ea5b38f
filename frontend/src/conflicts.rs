//! Changes of one's own that are not saved: refused ones beside what is saved, and those that wait.

mod compare;
mod waiting;
pub(crate) mod words;

pub(crate) use compare::Compare;
pub(crate) use waiting::WaitingList;
