-- Revisions that somebody gave a name.
CREATE TABLE checkpoint (
  behaviour TEXT NOT NULL REFERENCES behaviour ON DELETE CASCADE,
  name TEXT NOT NULL,
  revision INTEGER NOT NULL CHECK (revision > 0),
  by TEXT NOT NULL,
  at_ms INTEGER NOT NULL,
  PRIMARY KEY (behaviour, name)
) STRICT, WITHOUT ROWID;
