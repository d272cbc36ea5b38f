// Revisions that somebody gave a name, once in each behaviour.
CREATE CONSTRAINT checkpoint_name IF NOT EXISTS FOR (n:Checkpoint) REQUIRE (n.program_id, n.name) IS UNIQUE;
