//! A real Neo4j for the rooms.

#[expect(dead_code, reason = "here it is neither held nor killed")]
#[path = "../neo4j/server.rs"]
mod server;

pub(crate) use server::{Neo4j, folder};
