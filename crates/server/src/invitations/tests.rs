//! Coming in, going, and what is left of it.
