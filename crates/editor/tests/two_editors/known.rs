//! Programs as files have them, on a server that knows the rules.

#[path = "../../../engine/tests/hints/known.rs"]
mod rules;

use crate::server::id;
use crate::table::{AIKO, Table};
use behaviour::{Behaviour, BehaviourFile, Connector, Operation, Procedure, Stream};
pub(crate) use rules::Known;

/// A far ball is followed by the head, a close one by the whole body.
pub(crate) const BALLS: &str = include_str!("../../../../tests/behaviours/track_far_and_close.json");
/// The nearest arm follows a close ball.
pub(crate) const ARM: &str = include_str!("../../../../tests/behaviours/track_nearest_arm.json");

/// The program of a file.
pub(crate) fn program(file: &str) -> Behaviour {
    let file: BehaviourFile = serde_json::from_str(file).expect("it is a program");
    file.records(|_| None).expect("it has no flaws")
}

impl Table {
    /// Both have opened the program of a file, on a server that knows the rules.
    pub(crate) fn knowing(file: &str) -> Self {
        let mut table = Self::with(program(file));
        table.server.knowledge = &Known;
        table
    }

    /// A saved connector.
    pub(crate) fn connector(&self, of: &str) -> Connector {
        self.program().connector(&id(of)).cloned().unwrap_or_else(|| panic!("there is no connector {of}"))
    }

    /// A saved stream.
    pub(crate) fn stream(&self, of: &str) -> Stream {
        self.program().stream(&id(of)).cloned().unwrap_or_else(|| panic!("there is no stream {of}"))
    }

    /// The body of a saved connector.
    pub(crate) fn body(&self, of: &str) -> String {
        match self.connector(of).operation.procedure() {
            Some(Procedure::Body { body, .. }) => body.clone(),
            other => panic!("{of} has no body: {other:?}"),
        }
    }

    /// Somebody gives a connector another operation.
    pub(crate) fn operates(&mut self, who: usize, of: &str, operation: Operation) {
        let seen = self.connector(of);
        let inputs = seen.inputs.clone();
        self.gesture(who, |editor, op| editor.edit_connector(op, (&id(of), seen), (operation, inputs), None));
    }

    /// Aiko gives a stream other settings.
    pub(crate) fn sets(&mut self, of: &str, other: impl FnOnce(Stream) -> Stream) {
        let seen = self.stream(of);
        let other = other(seen.clone());
        self.gesture(AIKO, |editor, op| editor.edit_stream(op, (&id(of), seen), other));
    }
}
