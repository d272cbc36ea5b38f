// Titled frames around streams.
CREATE CONSTRAINT group_id IF NOT EXISTS FOR (n:Group) REQUIRE (n.program_id, n.id) IS UNIQUE;
