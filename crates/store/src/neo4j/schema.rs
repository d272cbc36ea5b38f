//! The schema of a database: numbered Cypher files, each applied once, in order, and recorded with its checksum.

use super::address::Neo4jAddress;
use super::fault::Neo4jFault;
use super::link::{Broken, Neo4jConnections, StatementParams};
use crate::StoreError;
use neo4rs::{Txn, query};
use serde::Deserialize;
use serde_json::{Value, json};
use std::time::Duration;
use tokio::time::timeout;

/// Every migration, oldest first; its place, counted from 1, is the schema version it makes. Never edit one that
/// was released: add the next.
const MIGRATIONS: [(&str, &str); 4] = [
    ("0001_schema", include_str!("../../../../migrations/neo4j/0001_schema.cypher")),
    ("0002_listed", include_str!("../../../../migrations/neo4j/0002_listed.cypher")),
    ("0003_checkpoints", include_str!("../../../../migrations/neo4j/0003_checkpoints.cypher")),
    ("0004_groups", include_str!("../../../../migrations/neo4j/0004_groups.cypher")),
];

/// The longest time of one statement of a migration; on a large database an index is not made at once.
const STEP_MAX: Duration = Duration::from_secs(120);
/// The longest wait while another program migrates.
const OTHERS_MAX: Duration = Duration::from_secs(300);

const RECORDS: &str = "CREATE CONSTRAINT migration_version IF NOT EXISTS FOR (n:Migration) REQUIRE n.version IS UNIQUE";
const APPLIED: &str = "
MATCH (n:Migration) WHERE n.version > 0
RETURN n.version AS version, n.name AS name, n.checksum AS checksum ORDER BY version";
const RECORD: &str = "
MERGE (n:Migration {version: $version})
SET n.name = $name, n.checksum = $checksum, n.applied_ms = timestamp()
RETURN n.version AS version";
/// Never committed: it only keeps others out for as long as the transaction is open.
const LOCK: &str = "MERGE (n:Migration {version: 0}) SET n.lock = true RETURN n.version AS version";

#[derive(Debug, Deserialize)]
struct Applied {
    version: u32,
    name: String,
    checksum: String,
}

/// Brings the database up to date.
///
/// # Errors
/// [`StoreError::Newer`] for one with steps that this program does not know, [`StoreError::Unavailable`] for one made
/// with a step that was edited since, or if Neo4j cannot be used.
pub(super) async fn migrate(address: &Neo4jAddress) -> Result<(), StoreError> {
    // Its own connections: whatever is left open here ends with them.
    let link = Neo4jConnections::new(address, STEP_MAX)?;
    step(&link, RECORDS, StatementParams::new()).await?;
    if missing(&link).await?.is_empty() {
        return Ok(());
    }
    let lock = lock(&link).await?;
    let done = apply(&link).await;
    if let Err(error) = timeout(STEP_MAX, lock.rollback()).await.unwrap_or(Ok(())) {
        return done.and(Err(link.told(error.into())));
    }
    done
}

async fn lock(link: &Neo4jConnections) -> Result<Txn, StoreError> {
    let locked = async {
        let mut lock = link.graph().start_txn().await?;
        match lock.execute(query(LOCK)).await {
            Ok(mut rows) => while rows.next(lock.handle()).await?.is_some() {},
            Err(error) => {
                lock.rollback().await?;
                return Err(Neo4jFault::from(error));
            }
        }
        Ok(lock)
    };
    let locked = timeout(OTHERS_MAX, locked).await.unwrap_or(Err(Neo4jFault::Silent));
    locked.map_err(|fault| link.told(fault))
}

async fn apply(link: &Neo4jConnections) -> Result<(), StoreError> {
    for (version, name, text) in missing(link).await? {
        for statement in statements(text) {
            step(link, &statement, StatementParams::new()).await?;
        }
        step(link, "CALL db.awaitIndexes(100)", StatementParams::new()).await?;
        let record = [("version", json!(version)), ("name", json!(name)), ("checksum", json!(checksum(text)))];
        step(link, RECORD, record.map(|(name, value)| (name.to_owned(), value)).into_iter().collect()).await?;
    }
    Ok(())
}

async fn step(link: &Neo4jConnections, statement: &str, params: StatementParams) -> Result<(), StoreError> {
    link.ask_for::<Value>(STEP_MAX, statement, params, Broken::Again).await.map(|_| ())
}

/// The steps that the database lacks, after a look at those that it has.
async fn missing(link: &Neo4jConnections) -> Result<Vec<(u32, &'static str, &'static str)>, StoreError> {
    let applied = link.read::<Applied>(APPLIED, StatementParams::new()).await?;
    check(&applied)?;
    let steps = (1..).zip(MIGRATIONS).map(|(version, (name, text))| (version, name, text));
    Ok(steps.filter(|(version, ..)| applied.iter().all(|done| done.version != *version)).collect())
}

fn check(applied: &[Applied]) -> Result<(), StoreError> {
    let known = u32::try_from(MIGRATIONS.len()).unwrap_or(u32::MAX);
    for done in applied {
        let Some((_, text)) = MIGRATIONS.get((done.version as usize).wrapping_sub(1)) else {
            return Err(StoreError::Newer { found: done.version, known });
        };
        if done.checksum != checksum(text) {
            return Err(StoreError::Unavailable(
                format!(
                    "the Neo4j database was made with another text of the migration {}; start the rrp that made it, or \
                 undo the edit of that file",
                    done.name
                )
                .into(),
            ));
        }
    }
    Ok(())
}

/// The statements of a file, without its comments.
fn statements(text: &str) -> Vec<String> {
    let lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let code = lines.collect::<Vec<_>>().join("\n");
    code.split(';').map(|statement| statement.trim().to_owned()).filter(|statement| !statement.is_empty()).collect()
}

/// FNV-1a of the text, whatever the ends of its lines: it tells an edit, not an attack.
fn checksum(text: &str) -> String {
    let bytes = text.bytes().filter(|byte| *byte != b'\r');
    let sum = bytes.fold(0xCBF2_9CE4_8422_2325_u64, |sum, byte| (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3));
    format!("{sum:016x}")
}

#[cfg(test)]
mod tests {
    use super::{Applied, MIGRATIONS, check, checksum, statements};
    use crate::StoreError;

    fn applied(version: u32, checksum: String) -> Applied {
        Applied { version, name: "a_name".to_owned(), checksum }
    }

    #[test]
    fn a_file_is_statements_without_comments() {
        assert_eq!(statements("// a; b\nONE\n  two;\n\n// c\nTHREE;\n"), ["ONE\n  two", "THREE"]);
        for (name, text) in MIGRATIONS {
            assert!(!statements(text).is_empty() && !text.contains('\''.to_string().repeat(2).as_str()), "{name}");
        }
    }

    #[test]
    fn every_relationship_of_a_connector_has_its_constraint_and_its_words_are_found() {
        let all: String = MIGRATIONS.iter().map(|(_, text)| *text).collect();
        for spec in behaviour::connectors::ALL {
            let Some(kind) = spec.graph.relationship else { continue };
            assert!(all.contains(&format!("FOR ()-[r:{kind}]-() REQUIRE (r.program_id, r.id) IS UNIQUE")), "{kind}");
            let indexed = all.lines().filter(|line| line.contains("FULLTEXT") && line.contains("()-[r:"));
            let mut types = indexed.flat_map(|line| line.split([':', '|', ']', ' ']));
            assert!(spec.takes.procedure.is_none() || types.any(|one| one == kind), "{kind} has words");
        }
    }

    #[test]
    fn the_checksum_is_fnv_1a() {
        assert_eq!(checksum(""), "cbf29ce484222325");
        assert_eq!(checksum("a"), "af63dc4c8601ec8c");
        assert_eq!(checksum("a\r\nb"), checksum("a\nb"));
        assert_ne!(checksum("a"), checksum("b"));
    }

    #[test]
    fn an_edited_step_and_an_unknown_one_are_refused() {
        let good = applied(1, checksum(MIGRATIONS[0].1));
        assert_eq!(check(&[good]), Ok(()));
        let edited = check(&[applied(1, checksum("edited"))]).expect_err("a refusal").to_string();
        assert!(edited.contains("a_name") && edited.contains("undo the edit"), "{edited}");
        assert_eq!(check(&[applied(9, checksum("x"))]), Err(StoreError::Newer { found: 9, known: 4 }));
    }
}
