//! The next steps of a person with a stream: what is likely, how it is called on buttons, and what taking it does.

mod known;
mod offer;
mod suggest;
mod take;

pub(crate) use offer::{Offer, actions, after, everything, offers_memo};
pub(crate) use suggest::Step;
pub(crate) use take::{lead_to_action, lead_to_helper, take, takes_one};
