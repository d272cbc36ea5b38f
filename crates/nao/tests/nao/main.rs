//! A NAO over the real libqi: the stand-in of `tests/standin`, moved and harmed by its own service.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod acts;
mod between;
#[cfg(unix)]
mod calm;
mod camera;
mod clinic;
mod driver;
mod gateway;
#[cfg(unix)]
mod harm;
mod identity;
mod late;
mod left;
mod losses;
mod peer;
mod proxy;
mod refused;
mod senses;
mod stops;
mod templates;
mod there;
mod ways;
