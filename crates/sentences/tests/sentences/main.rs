//! Sentences of behaviours, there and back.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod back;
mod bounds;
mod dice;
mod golden;
mod graphs;
mod pieces;
mod said;
mod speech;
mod support;
mod typed;
