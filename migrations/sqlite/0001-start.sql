-- Behaviours as they are now, every change that led there, and the index of helpers.
CREATE TABLE meta (
  one INTEGER PRIMARY KEY CHECK (one = 1),
  schema_version INTEGER NOT NULL,
  epoch INTEGER NOT NULL
) STRICT;
INSERT INTO meta VALUES (1, 0, 0);

-- The name is null where there is no settings record, as in the helper library.
CREATE TABLE behaviour (
  id TEXT NOT NULL PRIMARY KEY,
  name TEXT,
  revision INTEGER NOT NULL CHECK (revision > 0),
  changed_ms INTEGER NOT NULL,
  by TEXT NOT NULL,
  streams INTEGER NOT NULL,
  removed_ms INTEGER,
  removed_by TEXT,
  CHECK ((removed_ms IS NULL) = (removed_by IS NULL))
) STRICT, WITHOUT ROWID;

CREATE TABLE record (
  behaviour TEXT NOT NULL REFERENCES behaviour ON DELETE CASCADE,
  id TEXT NOT NULL,
  version INTEGER NOT NULL,
  json TEXT NOT NULL,
  PRIMARY KEY (behaviour, id)
) STRICT;

CREATE TABLE op (
  behaviour TEXT NOT NULL REFERENCES behaviour ON DELETE CASCADE,
  revision INTEGER NOT NULL,
  op_id TEXT NOT NULL,
  author TEXT NOT NULL,
  label TEXT NOT NULL,
  at_ms INTEGER NOT NULL,
  json TEXT NOT NULL,
  PRIMARY KEY (behaviour, revision),
  UNIQUE (behaviour, op_id)
) STRICT;

-- Words in procedures that may be helpers; the record itself says whether they are.
CREATE TABLE used (
  word TEXT NOT NULL,
  behaviour TEXT NOT NULL,
  record TEXT NOT NULL,
  PRIMARY KEY (word, behaviour, record),
  FOREIGN KEY (behaviour, record) REFERENCES record (behaviour, id) ON DELETE CASCADE
) STRICT, WITHOUT ROWID;
CREATE INDEX used_by ON used (behaviour, record);
