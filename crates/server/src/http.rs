//! HTTP: accepting connections, Stop, the routes and what they answer with.

pub(crate) mod accept;
pub(crate) mod address;
mod camera;
mod catalogue;
mod cut;
pub(crate) mod door;
mod downloads;
#[cfg(test)]
mod german;
mod headers;
mod join;
mod known;
mod line;
pub(crate) mod network;
pub(crate) mod origin;
pub(crate) mod page;
mod readiness;
mod recording_list;
mod recordings;
mod report;
pub(crate) mod routes;
pub(crate) mod serving;
mod stop;
mod transfer;
mod upload;
