//! The Neo4j store on a real Neo4j Community: the contract, the graph, crowds, and a server that is killed or hangs.

mod contract;
mod crowd;
mod exact;
mod faults;
mod graph;
mod helpers;
mod migrations;
mod moving;
mod samples;
#[path = "../../../../tests/neo4j/server.rs"]
mod server;
mod shared;
mod started;
mod thesis;
