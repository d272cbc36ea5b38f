//! Journeys: people use the page in a real browser, against a real server with the simulated robot.

mod apply;
mod away;
mod conflicts;
mod disk_full;
mod edits;
mod graph_database;
mod help;
mod history;
mod invite;
mod library;
mod link;
mod locks;
mod order;
mod presence;
mod quick;
mod record;
mod robots;
mod room;
mod runaway;
mod steps;
mod stop;
mod templates;
mod together;
mod truth;
mod visitor;
mod walkthrough;
