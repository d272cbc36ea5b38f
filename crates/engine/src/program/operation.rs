//! The operation of a connector of a file: the one place where the engine asks about `behaviour::Operation`.

use crate::connectors::{ConnectorChoice, ConnectorKind, kind};
use behaviour::connectors::{Inputs, Spec};
use behaviour::{FileConnector, FlawKind, Operation, Procedure};

/// A connector of a file, read once.
pub(super) struct DeclaredConnector {
    operation: Operation,
    pub(super) kind: &'static ConnectorKind,
}

impl DeclaredConnector {
    /// Reads a connector.
    ///
    /// # Errors
    /// Returns the flaw if it is none.
    pub(super) fn of(connector: &FileConnector) -> Result<Self, FlawKind> {
        let operation = connector.operation()?;
        if operation.period_ms() == Some(0) {
            return Err(FlawKind::NoPeriod(operation.word()));
        }
        let kind = kind(operation.word()).ok_or_else(|| FlawKind::NoConnector(operation.word().to_owned()))?;
        Ok(Self { operation, kind })
    }

    /// Returns the description of all connectors of its kind.
    pub(super) fn spec(&self) -> &'static Spec {
        self.operation.spec()
    }

    /// Returns the number of streams that it takes from; none if so many are right.
    pub(super) fn wants_inputs(&self, many: usize) -> Option<Inputs> {
        let inputs = self.spec().inputs;
        let fits = many >= inputs.least() && (many == 1 || inputs.are_many());
        (!fits).then_some(inputs)
    }

    /// Returns the procedure, if it has one.
    pub(super) fn procedure(&self) -> Option<&Procedure> {
        self.operation.procedure()
    }

    /// The names of its arguments, as given or from the names of its inputs.
    pub(super) fn arguments<'n>(&self, inputs: impl IntoIterator<Item = &'n str>) -> Vec<String> {
        self.operation.arguments(inputs)
    }

    /// Returns the choices for it, besides its procedure.
    pub(super) fn choice(&self, inputs: usize) -> ConnectorChoice {
        ConnectorChoice {
            inputs,
            period_ms: self.operation.period_ms().unwrap_or_default(),
            start: self.operation.start().cloned().unwrap_or_default(),
            has_procedure: self.operation.procedure().is_some(),
        }
    }
}
