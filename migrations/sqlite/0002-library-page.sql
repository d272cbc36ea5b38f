-- What the library page asks: owners, order by name, words, devices.
ALTER TABLE behaviour ADD COLUMN owner TEXT NOT NULL DEFAULT '';
ALTER TABLE behaviour ADD COLUMN name_key TEXT NOT NULL DEFAULT '';
CREATE INDEX behaviour_changed ON behaviour (changed_ms, id) WHERE removed_ms IS NULL AND name IS NOT NULL;
CREATE INDEX behaviour_named ON behaviour (name_key, id) WHERE removed_ms IS NULL AND name IS NOT NULL;
CREATE INDEX behaviour_removed ON behaviour (removed_ms, id) WHERE removed_ms IS NOT NULL;

-- The text of a behaviour in which words are searched, and the index of every three letters in a row.
CREATE TABLE searched (
  number INTEGER PRIMARY KEY,
  behaviour TEXT NOT NULL UNIQUE REFERENCES behaviour ON DELETE CASCADE,
  text TEXT NOT NULL
) STRICT;
CREATE VIRTUAL TABLE search USING fts5 (text, content = 'searched', content_rowid = 'number', tokenize = 'trigram case_sensitive 1', detail = 'none');
CREATE TRIGGER searched_added AFTER INSERT ON searched BEGIN
  INSERT INTO search (rowid, text) VALUES (new.number, new.text);
END;
CREATE TRIGGER searched_gone AFTER DELETE ON searched BEGIN
  INSERT INTO search (search, rowid, text) VALUES ('delete', old.number, old.text);
END;
CREATE TRIGGER searched_changed AFTER UPDATE ON searched BEGIN
  INSERT INTO search (search, rowid, text) VALUES ('delete', old.number, old.text);
  INSERT INTO search (rowid, text) VALUES (new.number, new.text);
END;

-- Which behaviour uses which sense or action of the robot.
CREATE TABLE device (
  behaviour TEXT NOT NULL REFERENCES behaviour ON DELETE CASCADE,
  kind TEXT NOT NULL,
  name TEXT NOT NULL,
  stream TEXT NOT NULL,
  PRIMARY KEY (kind, name, behaviour, stream)
) STRICT, WITHOUT ROWID;
CREATE INDEX device_of ON device (behaviour, stream);

-- How many behaviours are listed, and how many lie in the bin: counted as they come and go.
CREATE TABLE tally (place TEXT NOT NULL PRIMARY KEY, count INTEGER NOT NULL) STRICT, WITHOUT ROWID;
INSERT INTO tally SELECT 'here', count(*) FROM behaviour WHERE name IS NOT NULL AND removed_ms IS NULL;
INSERT INTO tally SELECT 'bin', count(*) FROM behaviour WHERE name IS NOT NULL AND removed_ms IS NOT NULL;
CREATE TRIGGER tally_added AFTER INSERT ON behaviour WHEN new.name IS NOT NULL BEGIN
  UPDATE tally SET count = count + 1 WHERE place = iif(new.removed_ms IS NULL, 'here', 'bin');
END;
CREATE TRIGGER tally_gone AFTER DELETE ON behaviour WHEN old.name IS NOT NULL BEGIN
  UPDATE tally SET count = count - 1 WHERE place = iif(old.removed_ms IS NULL, 'here', 'bin');
END;
CREATE TRIGGER tally_moved AFTER UPDATE OF name, removed_ms ON behaviour
WHEN (old.name IS NULL) <> (new.name IS NULL) OR (old.removed_ms IS NULL) <> (new.removed_ms IS NULL) BEGIN
  UPDATE tally SET count = count - 1 WHERE old.name IS NOT NULL AND place = iif(old.removed_ms IS NULL, 'here', 'bin');
  UPDATE tally SET count = count + 1 WHERE new.name IS NOT NULL AND place = iif(new.removed_ms IS NULL, 'here', 'bin');
END;
