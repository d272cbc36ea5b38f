-- Where the store is being filled from, while that has begun and not ended.
CREATE TABLE filling (
  one INTEGER PRIMARY KEY CHECK (one = 1),
  source TEXT NOT NULL,
  again TEXT NOT NULL
) STRICT;
