//! Exports for the determinism test.
