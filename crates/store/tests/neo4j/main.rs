//! The Neo4j store on a real Neo4j Community, and against a server that misbehaves on purpose.

mod contract;
mod samples;
#[path = "../../../../tests/neo4j/server.rs"]
mod server;
mod shared;
