//! The reasons why a body that is tried makes no value.

use super::{BodyFault, CallFault, GraphFault};

/// The reasons why a body that is tried makes no value. [`std::fmt::Display`] says each in a few English words.
#[derive(Clone, Debug, PartialEq)]
pub enum TrialFault {
    /// It has another number of arguments than of inputs.
    Inputs {
        /// The number of arguments that it has.
        takes: usize,
        /// The number of inputs that it would get.
        gets: usize,
    },
    /// These helpers cannot run.
    Helpers(Vec<GraphFault>),
    /// It is no procedure.
    Body(BodyFault),
    /// It faults on these inputs.
    Call(Box<CallFault>),
}

impl std::error::Error for TrialFault {}

impl From<BodyFault> for TrialFault {
    fn from(fault: BodyFault) -> Self {
        Self::Body(fault)
    }
}
