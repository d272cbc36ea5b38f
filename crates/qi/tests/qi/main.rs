//! The protocol against recorded values, random damage, a peer of our own that lies, and the real libqi.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod choice;
mod fake;
mod fuzz;
mod golden;
mod latency;
mod links;
mod real;
mod real_peer;
mod secure;
mod sessions;
mod wire;
