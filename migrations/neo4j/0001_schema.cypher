// What a behaviour is made of, named as in the thesis (5.2.4). Ids are unique within a behaviour and a kind.
CREATE CONSTRAINT behaviour_id IF NOT EXISTS FOR (n:Behaviour) REQUIRE n.id IS UNIQUE;
CREATE CONSTRAINT stream_id IF NOT EXISTS FOR (n:Stream) REQUIRE (n.program_id, n.id) IS UNIQUE;
CREATE CONSTRAINT connector_id IF NOT EXISTS FOR (n:Connector) REQUIRE (n.program_id, n.id) IS UNIQUE;
CREATE CONSTRAINT helper_id IF NOT EXISTS FOR (n:Helper) REQUIRE (n.program_id, n.id) IS UNIQUE;
CREATE CONSTRAINT place_id IF NOT EXISTS FOR (n:Place) REQUIRE (n.program_id, n.id) IS UNIQUE;
CREATE CONSTRAINT note_id IF NOT EXISTS FOR (n:Note) REQUIRE (n.program_id, n.id) IS UNIQUE;
CREATE CONSTRAINT device_key IF NOT EXISTS FOR (n:Device) REQUIRE (n.kind, n.name) IS UNIQUE;

// Simple connectors are relationships between two streams.
CREATE CONSTRAINT map_id IF NOT EXISTS FOR ()-[r:map]-() REQUIRE (r.program_id, r.id) IS UNIQUE;
CREATE CONSTRAINT filter_id IF NOT EXISTS FOR ()-[r:filter]-() REQUIRE (r.program_id, r.id) IS UNIQUE;
CREATE CONSTRAINT sample_id IF NOT EXISTS FOR ()-[r:sample]-() REQUIRE (r.program_id, r.id) IS UNIQUE;
CREATE CONSTRAINT timestamp_id IF NOT EXISTS FOR ()-[r:timestamp]-() REQUIRE (r.program_id, r.id) IS UNIQUE;
CREATE CONSTRAINT subscribe_id IF NOT EXISTS FOR ()-[r:subscribe]-() REQUIRE (r.program_id, r.id) IS UNIQUE;

// Every change that led there: one order per behaviour, and each change once.
CREATE CONSTRAINT op_revision IF NOT EXISTS FOR (n:Op) REQUIRE (n.program_id, n.revision) IS UNIQUE;
CREATE CONSTRAINT op_id IF NOT EXISTS FOR (n:Op) REQUIRE (n.program_id, n.id) IS UNIQUE;

// Lists, in their orders; search by parts of words.
CREATE INDEX program_changed IF NOT EXISTS FOR (n:Program) ON (n.changed_ms, n.id);
CREATE INDEX program_name IF NOT EXISTS FOR (n:Program) ON (n.name_key, n.id);
CREATE INDEX binned_removed IF NOT EXISTS FOR (n:Binned) ON (n.removed_ms, n.id);
CREATE TEXT INDEX program_search IF NOT EXISTS FOR (n:Program) ON (n.search);

// Who uses a helper: by name, or among the words of a body.
CREATE INDEX helper_name IF NOT EXISTS FOR (n:Helper) ON (n.program_id, n.name);
CREATE INDEX connector_helper IF NOT EXISTS FOR (n:Connector) ON (n.helper);
CREATE FULLTEXT INDEX words_of_nodes IF NOT EXISTS FOR (n:Connector|Helper) ON EACH [n.words]
  OPTIONS {indexConfig: {`fulltext.analyzer`: 'whitespace'}};
CREATE FULLTEXT INDEX words_of_relationships IF NOT EXISTS FOR ()-[r:map|filter]-() ON EACH [r.words]
  OPTIONS {indexConfig: {`fulltext.analyzer`: 'whitespace'}};

// What all servers of a database share: the number of their starts, and the door to the links of helpers.
CREATE CONSTRAINT shared_name IF NOT EXISTS FOR (n:Shared) REQUIRE n.name IS UNIQUE;
MERGE (n:Shared {name: 'epoch'}) ON CREATE SET n.value = 0;
MERGE (n:Shared {name: 'helpers'});
