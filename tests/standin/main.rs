//! The stand-in for a NAO on the real libqi, `nao.py`: that it does what other tests believe of it.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod body;
mod calls;
mod nao;
mod senses;
mod simulated;
