//! The library of behaviours: listing, making, importing and drawing them, and what they have to do with each other.

pub(crate) mod bin;
pub(crate) mod create;
pub(crate) mod import;
pub(crate) mod insight;
pub(crate) mod list;
pub(crate) mod templates;
pub(crate) mod thumbnails;
pub(crate) mod trial;
