//! A NAO over the real libqi: the stand-in of `tests/standin`, moved and harmed by its own service.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod acts;
mod clinic;
mod driver;
mod gateway;
mod late;
mod losses;
mod peer;
mod proxy;

mod senses;
mod stops;
mod templates;
mod there;
mod ways;
