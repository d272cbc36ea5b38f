//! What a connector of a file is: the one place where the engine asks about `behaviour::Operation`.

use crate::connectors::{Choice, Kind, kind};
use behaviour::connectors::{Inputs, Spec};
use behaviour::{FileConnector, Operation, Procedure};

/// A connector of a file, read once.
pub(super) struct Declared {
    operation: Operation,
    pub(super) kind: &'static Kind,
}

impl Declared {
    /// Reads a connector.
    ///
    /// # Errors
    /// Why it is none, in plain words.
    pub(super) fn of(connector: &FileConnector) -> Result<Self, String> {
        let operation = connector.operation()?;
        if operation.period_ms() == Some(0) {
            return Err(format!("{} needs a periodMs of 1 or more", operation.word()));
        }
        let kind = kind(operation.word()).ok_or_else(|| format!("there is no connector {:?}", operation.word()))?;
        Ok(Self { operation, kind })
    }

    /// What there is to say about all connectors of its kind.
    pub(super) fn spec(&self) -> &'static Spec {
        self.operation.spec()
    }

    /// How many streams it takes from, in words; nothing if so many are right.
    pub(super) fn wants_inputs(&self, many: usize) -> Option<&'static str> {
        let inputs = self.spec().inputs;
        let fits = many >= inputs.least() && (many == 1 || inputs.are_many());
        let words = match inputs {
            Inputs::One => "exactly one input",
            Inputs::OneOrMore => "one input or more",
            Inputs::TwoOrMore => "two inputs or more",
        };
        (!fits).then_some(words)
    }

    /// Its procedure, if it has one.
    pub(super) fn procedure(&self) -> Option<&Procedure> {
        self.operation.procedure()
    }

    /// The names of its arguments, as given or from the names of its inputs.
    pub(super) fn arguments<'n>(&self, inputs: impl IntoIterator<Item = &'n str>) -> Vec<String> {
        self.operation.arguments(inputs)
    }

    /// What was chosen for it, besides its procedure.
    pub(super) fn choice(&self, inputs: usize) -> Choice {
        Choice {
            inputs,
            period_ms: self.operation.period_ms().unwrap_or_default(),
            start: self.operation.start().cloned().unwrap_or_default(),
            has_procedure: self.operation.procedure().is_some(),
        }
    }
}
