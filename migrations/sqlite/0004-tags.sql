-- The tags of a behaviour, as a list in JSON; what was kept before has none.
ALTER TABLE behaviour ADD COLUMN tags TEXT NOT NULL DEFAULT '[]';
