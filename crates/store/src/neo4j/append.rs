//! Saving a change: one statement, with the parts that this change needs, which does all of it or nothing.

use super::delta::Delta;
use super::link::{Broken, Neo4jConnections, StatementParams};
use super::nodes::relationships;
use crate::{Append, Damage, LIBRARY, StoreError};
use behaviour::{Behaviour, Change, Committed, Id};
use serde::Deserialize;
use serde_json::{Value, json};
use std::time::Duration;

/// One part of the statement: the lists it works through, the Cypher, and what must be true of its counts.
struct StatementPart {
    lists: &'static [&'static str],
    cypher: &'static str,
    /// More Cypher, once for every type of relationship that a connector may be.
    each_type: &'static str,
    counts: Option<&'static str>,
}

const fn part(lists: &'static [&'static str], cypher: &'static str) -> StatementPart {
    StatementPart { lists, cypher, each_type: "", counts: None }
}

impl StatementPart {
    fn text(&self) -> String {
        let more = relationships().map(|kind| self.each_type.replace("$TYPE", kind));
        std::iter::once(self.cypher.to_owned()).chain(more).collect()
    }
}

/// The parts of a save, in this order. Touched connectors go, whatever they were, and come back as what they are now;
/// nodes that behaviours share are made in one order and linked only where that changes, or else they would deadlock.
const PARTS: [StatementPart; 12] = [
    StatementPart { each_type: RELATIONSHIP_GOES, ..part(&["connectors"], CONNECTORS_GO) },
    part(&["gone_streams"], STREAMS_GO),
    part(&["streams", "devices"], STREAMS),
    StatementPart { counts: Some("simple = size($does.simple)"), ..part(&["simple"], SIMPLE_CONNECTORS) },
    StatementPart {
        counts: Some("nodes = size($does.nodes) AND inputs = $does.inputs"),
        ..part(&["nodes"], CONNECTOR_NODES)
    },
    part(&["places", "gone_places"], PLACES),
    part(&["notes", "gone_notes"], NOTES),
    part(&["groups", "gone_groups"], GROUPS),
    part(&["helpers", "gone_helpers"], HELPERS),
    // One at a time: a helper that appears and a connector that names it must not miss each other.
    part(&["doors"], "CALL () { UNWIND $does.doors AS x MATCH (n:Shared {name: x}) SET n.lock = true REMOVE n.lock }"),
    part(&["named"], NAMED),
    part(&["linked", "calls"], LINKED),
];

const CONNECTORS_GO: &str = "
  CALL () { UNWIND $does.connectors AS x MATCH (n:Connector {program_id: $does.id, id: x}) DETACH DELETE n }";

/// One by one, so that each is found by the constraint of its type.
const RELATIONSHIP_GOES: &str = "
  CALL () { UNWIND $does.connectors AS x MATCH ()-[r:$TYPE {program_id: $does.id, id: x}]->() DELETE r }";

/// Not detached: a connector left behind makes the whole change fail.
const STREAMS_GO: &str = "
  CALL () {
    UNWIND $does.gone_streams AS x MATCH (n:Stream {program_id: $does.id, id: x})
    OPTIONAL MATCH (n)-[own:program|device]->() DELETE own, n
  }";

const STREAMS: &str = "
  CALL () { UNWIND $does.devices AS d MERGE (:Device {kind: d.kind, name: d.name}) }
  CALL (p) {
    UNWIND $does.streams AS s
    MERGE (n:Stream {program_id: $does.id, id: s.id})
    SET n = s.properties
    REMOVE n:Sensor:Ordinary:Actuator
    SET n:$(s.label)
    MERGE (n)-[:program]->(p)
    WITH n, s
    CALL (n, s) {
      MATCH (n)-[old:device]->(d:Device)
      WHERE s.device IS NULL OR d.kind <> s.device.kind OR d.name <> s.device.name DELETE old
    }
    CALL (n, s) {
      MATCH (d:Device {kind: s.device.kind, name: s.device.name}) WHERE NOT EXISTS { (n)-[:device]->(d) }
      CREATE (n)-[:device]->(d)
    }
  }";

const SIMPLE_CONNECTORS: &str = "
  CALL () {
    UNWIND $does.simple AS c
    MATCH (a:Stream {program_id: $does.id, id: c.input})
    MATCH (b:Stream {program_id: $does.id, id: c.output})
    CREATE (a)-[r:$(c.type)]->(b)
    SET r = c.properties
    RETURN count(*) AS simple
  }";

const CONNECTOR_NODES: &str = "
  CALL (p) {
    UNWIND $does.nodes AS c
    MATCH (b:Stream {program_id: $does.id, id: c.output})
    CREATE (n:Connector)-[:program]->(p)
    CREATE (n)-[:output]->(b)
    SET n = c.properties, n:$(c.label)
    WITH n, c
    CALL (n, c) {
      UNWIND range(0, size(c.inputs) - 1) AS slot
      MATCH (a:Stream {program_id: $does.id, id: c.inputs[slot]})
      CREATE (a)-[:input {slot: slot}]->(n)
      RETURN count(*) AS found
    }
    RETURN count(*) AS nodes, sum(found) AS inputs
  }";

const PLACES: &str = "
  CALL () { UNWIND $does.gone_places AS x MATCH (n:Place {program_id: $does.id, id: x}) DETACH DELETE n }
  CALL (p) {
    UNWIND $does.places AS x
    MERGE (n:Place {program_id: $does.id, id: x.id}) SET n.x = x.x, n.y = x.y
    MERGE (n)-[:program]->(p)
  }";

const NOTES: &str = "
  CALL () { UNWIND $does.gone_notes AS x MATCH (n:Note {program_id: $does.id, id: x}) DETACH DELETE n }
  CALL (p) {
    UNWIND $does.notes AS x
    MERGE (n:Note {program_id: $does.id, id: x.id}) SET n.text = x.text, n.by = x.by, n.at_ms = x.at_ms
    MERGE (n)-[:program]->(p)
  }";

/// The streams of a group are a list of ids, as some may be gone.
const GROUPS: &str = "
  CALL () { UNWIND $does.gone_groups AS x MATCH (n:Group {program_id: $does.id, id: x}) DETACH DELETE n }
  CALL (p) {
    UNWIND $does.groups AS x
    MERGE (n:Group {program_id: $does.id, id: x.id}) SET n.title = x.title, n.streams = x.streams, n.folded = x.folded
    MERGE (n)-[:program]->(p)
  }";

const HELPERS: &str = "
  CALL () { UNWIND $does.gone_helpers AS x MATCH (n:Helper {program_id: $does.id, id: x}) DETACH DELETE n }
  CALL (p) {
    UNWIND $does.helpers AS x MERGE (n:Helper {program_id: $does.id, id: x.id}) SET n = x.properties MERGE (n)-[:program]->(p)
  }";

const NAMED: &str = "
  CALL () {
    UNWIND $does.named AS c
    MATCH (n:Connector {program_id: $does.id, id: c.id})
    MATCH (h:Helper {program_id: 'library', name: c.helper})
    CREATE (n)-[:helper]->(h)
  }";

const LINKED: &str = "
  CALL () {
    UNWIND $does.linked AS x
    MATCH (h:Helper {program_id: 'library', id: x})
    CALL (h) { MATCH (c:Connector)-[old:helper]->(h) WHERE c.helper <> h.name DELETE old }
    CALL (h) { MATCH (c:Connector {helper: h.name}) WHERE NOT EXISTS { (c)-[:helper]->(h) } CREATE (c)-[:helper]->(h) }
    CALL (h) { MATCH (h)-[old:calls]-(:Helper) DELETE old }
  }
  CALL () {
    UNWIND $does.calls AS c
    MATCH (h:Helper {program_id: 'library', id: c.from})
    MATCH (other:Helper {program_id: 'library', id: c.to})
    MERGE (h)-[:calls]->(other)
  }";

/// The first change makes the behaviour.
const START: &str = "
FOREACH (_ IN CASE WHEN $base = 0 THEN [1] ELSE [] END |
  MERGE (new:Behaviour {id: $does.id}) ON CREATE SET new.revision = 0, new:$($does.shelf))
WITH 1 AS started
MATCH (p:Behaviour {id: $does.id})";

/// The lock comes before anything of p is read, so that writers of one behaviour follow one another.
const GUARD: &str = "
SET p.lock = true REMOVE p.lock
WITH p OPTIONAL MATCH (done:Op {program_id: $does.id, id: $op.id})
WITH p, done, p.revision AS head, p:Binned AS binned
CALL (p, done, head, binned) {
  WITH p WHERE done IS NULL AND NOT binned AND head = $base";

const COMMIT: &str = "
  CREATE (:Op {program_id: $does.id, id: $op.id, revision: $base + one, author: $op.author, label: $op.label,
    at_ms: $op.at_ms, change: $op.change})
  SET p += $does.summary, p.revision = $base + one
  FOREACH (_ IN CASE WHEN p:Program AND p.name_key IS NOT NULL THEN [1] ELSE [] END | SET p:Listed)
  FOREACH (_ IN CASE WHEN p.name_key IS NULL THEN [1] ELSE [] END | REMOVE p:Listed)
  RETURN count(*) AS applied
}
RETURN head, binned, applied, done.revision AS duplicate, done.change AS saved";

/// The longest time to plan the usual statements when we start.
const WARM_UP_MAX: Duration = Duration::from_secs(60);

#[derive(Deserialize)]
struct AppendOutcome {
    head: u64,
    binned: bool,
    applied: u64,
    duplicate: Option<u64>,
    /// The change that was saved under the op id before.
    saved: Option<String>,
}

/// The statement with the parts that these lists need.
fn statement(needed: impl Fn(&str) -> bool) -> String {
    let parts: Vec<&StatementPart> = PARTS.iter().filter(|part| part.lists.iter().any(|list| needed(list))).collect();
    let cypher: Vec<String> = parts.iter().map(|part| part.text()).collect();
    let counts: Vec<&str> = parts.iter().filter_map(|part| part.counts).collect();
    let one = match counts.as_slice() {
        [] => "WITH p, 1 AS one".to_owned(),
        // Dividing by zero undoes everything.
        counts => format!("WITH p, 1 / CASE WHEN {} THEN 1 ELSE 0 END AS one", counts.join(" AND ")),
    };
    format!("{START}{GUARD}\n{}\n{one}{COMMIT}", cypher.join("\n"))
}

/// Saves a change, whose JSON is given, unless it was saved before or is not the next one.
pub(super) async fn append(
    link: &Neo4jConnections,
    id: &Id,
    committed: &Committed,
    json: String,
    after: &Behaviour,
) -> Result<Append, StoreError> {
    let delta = Delta::of(id, committed, after)?;
    let text = statement(|list| delta.has(list));
    let found = link.ask(&text, params_of(id, committed, json, delta), Broken::Again).await?;
    let Some(outcome) = found.rows.into_iter().next() else { return Ok(Append::Conflict { head: 0 }) };
    outcome_of(&outcome, committed, found.open_before)
}

fn outcome_of(outcome: &AppendOutcome, committed: &Committed, open_before: bool) -> Result<Append, StoreError> {
    match outcome.duplicate {
        Some(revision) => match again(outcome, committed, revision)? {
            // Saved by an attempt of this very call, whose answer was lost.
            Append::Duplicate { revision } if open_before && revision == committed.revision => Ok(Append::Applied),
            answer => Ok(answer),
        },
        None if outcome.applied > 0 => Ok(Append::Applied),
        None if outcome.binned => Err(StoreError::Gone),
        None => Ok(Append::Conflict { head: outcome.head }),
    }
}

fn again(outcome: &AppendOutcome, committed: &Committed, revision: u64) -> Result<Append, StoreError> {
    let text = outcome.saved.as_deref().ok_or(StoreError::Damaged(Damage::LostChange(revision)))?;
    let damaged = |error: serde_json::Error| Damage::Neo4jChange { revision, why: error.to_string().into() };
    let saved: Change = crate::json::decode(text).map_err(|error| StoreError::Damaged(damaged(error)))?;
    Ok(Append::again(&committed.change, &saved, revision))
}

fn params_of(id: &Id, committed: &Committed, json: String, delta: Delta) -> StatementParams {
    let change = &committed.change;
    let op = json!({
        "id": change.op, "author": change.author, "label": change.label.to_string(), "at_ms": change.at_ms, "change": json,
    });
    let base = committed.revision.checked_sub(1).and_then(|base| i64::try_from(base).ok()).unwrap_or(-1);
    let mut does = nothing(id.as_str());
    does.extend(delta.params());
    params(does, op, base)
}

/// The parts that the usual gestures touch: move, add a stream, add or edit a connector, rename, delete, write a note;
/// a new name of the behaviour is on its own node.
const USUAL: [&[&str]; 8] = [
    &["places"],
    &["streams", "places"],
    &["connectors", "streams", "simple", "places"],
    &["connectors", "simple"],
    &["connectors", "streams", "simple"],
    &["connectors", "gone_streams", "places"],
    &["notes", "places"],
    &[],
];

/// A text as long as the ids that behaviours get.
const AS_LONG_AS_AN_ID: &str = "00000000000000000000000000000000";

/// Has the plans of the usual statements made: the first of each takes longer than people should wait. They are found again by
/// parameters of the same kinds and sizes only, such as an id that is as long as all are.
pub(super) async fn warm_up(link: &Neo4jConnections) -> Result<(), StoreError> {
    let usual = USUAL.iter().map(|lists| statement(|list| lists.contains(&list)));
    let usual = usual.map(|text| (text, params(nothing(AS_LONG_AS_AN_ID), json!({}), -1)));
    for (text, params) in usual.chain([(super::load::LOAD.clone(), super::load::params(AS_LONG_AS_AN_ID))]) {
        let explained = format!("EXPLAIN {text}");
        link.ask_for::<Value>(WARM_UP_MAX, &explained, params, Broken::Again).await?;
    }
    Ok(())
}

/// Returns the parameters of a change that does nothing to the behaviour with this id.
fn nothing(id: &str) -> StatementParams {
    let lists = PARTS.iter().flat_map(|part| part.lists).map(|list| ((*list).to_owned(), json!([])));
    let shelf = if id == LIBRARY { "Library" } else { "Program" };
    let others = [("id", json!(id)), ("shelf", json!(shelf)), ("inputs", json!(0)), ("summary", json!({}))];
    lists.chain(others.map(|(name, value)| (name.to_owned(), value))).collect()
}

/// The parameters of a statement. What the change does is one of them, a map: Neo4j plans a statement anew for other sizes of
/// texts and lists among its parameters (none, one, up to ten, up to a hundred), and does not look into maps.
fn params(does: StatementParams, op: Value, base: i64) -> StatementParams {
    let all = [("does", does.into()), ("op", op), ("base", json!(base))];
    all.map(|(name, value)| (name.to_owned(), value)).into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::{AS_LONG_AS_AN_ID, Delta, nothing, params, params_of};
    use behaviour::{Behaviour, Change, Committed, Id, Kind, Place, Record, RecordId};
    use serde_json::json;

    #[test]
    fn no_parameter_has_a_size_that_a_plan_is_made_for() {
        let id = Id::new("b").unwrap();
        let warm = params(nothing(AS_LONG_AS_AN_ID), json!({}), -1);
        for places in [0, 1, 12] {
            let put = |change: Change, at: usize| {
                let key = RecordId::new(Kind::Place, &Id::new(&format!("s{at}")).unwrap());
                change.put(&Behaviour::default(), key, Record::Place(Place { x: 1.0, y: 2.0 }))
            };
            let change = (0..places).fold(Change::of(id.clone(), "Aiko", "Move"), put);
            let committed = Committed { revision: 2, change };
            let delta = Delta::of(&id, &committed, &Behaviour::default()).unwrap();
            let params = params_of(&id, &committed, "{}".to_owned(), delta);
            assert!(params.values().all(|value| value.is_object() || value.is_i64()), "{params:?}");
            assert!(params.keys().eq(warm.keys()), "what is planned at the start has the same parameters");
        }
    }
}
