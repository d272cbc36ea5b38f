//! Pages of behaviours: the statement is put together from fixed pieces, what people write comes as parameters.

use super::link::{Neo4jConnections, StatementParams};
use super::nodes::whole;
use crate::{Cursor, ListedBehaviour, Listing, PAGE_MAX_LINES, Query, SearchPlace, Sort, StoreError};
use behaviour::Id;
use serde::Deserialize;
use serde_json::{Value, json};

/// The shortest text that the index of words can look up.
const TRIGRAM_CHARS: usize = 3;
const NAME_ORDER: &str = "p.name_key, p.id";

#[derive(Deserialize)]
struct ListPage {
    total: u64,
    lines: Vec<ListLine>,
}

#[derive(Deserialize)]
struct ListLine {
    id: Id,
    name: String,
    revision: u64,
    at_ms: u64,
    by: String,
    owner: String,
    streams: u32,
    tags: Option<Vec<String>>,
}

impl From<ListLine> for ListedBehaviour {
    fn from(line: ListLine) -> Self {
        let ListLine { id, name, revision, at_ms: changed_ms, by, owner, streams, tags } = line;
        Self { id, name, revision, changed_ms, by, owner, streams, tags: tags.unwrap_or_default() }
    }
}

/// The label of a place, and its properties for when and by whom.
fn shelf(place: SearchPlace) -> (&'static str, &'static str, &'static str) {
    match place {
        SearchPlace::Here => ("Program", "changed_ms", "by"),
        SearchPlace::Bin => ("Binned", "removed_ms", "removed_by"),
    }
}

/// The index to read; Neo4j would sometimes choose to sort everything.
fn index(query: &Query, needles: &[String]) -> &'static str {
    let selective = needles.iter().any(|word| word.chars().count() >= TRIGRAM_CHARS);
    match (query.place, query.sort) {
        (SearchPlace::Here, _) if selective => "USING TEXT INDEX p:Program(search)",
        (SearchPlace::Here, Sort::Changed) => "USING INDEX p:Program(changed_ms, id)",
        (SearchPlace::Here, Sort::Name) => "USING INDEX p:Program(name_key, id)",
        (SearchPlace::Bin, Sort::Changed) => "USING INDEX p:Binned(removed_ms, id)",
        (SearchPlace::Bin, Sort::Name) => "",
    }
}

/// Returns the beginning of the page and its order, in terms that the index of that order answers.
fn order(query: &Query, at_ms: &str) -> (String, String) {
    let at = format!("p.{at_ms}");
    match (query.sort, query.after.is_some()) {
        (Sort::Changed, false) => (format!("{at} IS NOT NULL"), format!("{at} DESC, p.id DESC")),
        (Sort::Changed, true) => {
            (format!("{at} <= $at_ms AND NOT ({at} = $at_ms AND p.id >= $after)"), format!("{at} DESC, p.id DESC"))
        }
        (Sort::Name, false) => ("p.name_key IS NOT NULL".to_owned(), NAME_ORDER.to_owned()),
        (Sort::Name, true) => (
            "p.name_key >= $name_key AND NOT (p.name_key = $name_key AND p.id <= $after)".to_owned(),
            NAME_ORDER.to_owned(),
        ),
    }
}

/// Returns the query for the number of all. Neo4j keeps a count for every label, and the bin is small.
fn total(place: SearchPlace) -> &'static str {
    match place {
        SearchPlace::Here => "CALL () { MATCH (p:Listed) RETURN count(p) AS total }",
        SearchPlace::Bin => "CALL () { MATCH (p:Binned) WHERE p.name_key IS NOT NULL RETURN count(*) AS total }",
    }
}

fn statement(query: &Query, needles: &[String]) -> String {
    let (label, at_ms, by) = shelf(query.place);
    let (begin, order) = order(query, at_ms);
    let mut wanted = vec![begin, "p.id IS NOT NULL".to_owned()];
    wanted.extend((query.sort == Sort::Changed).then(|| "p.name_key IS NOT NULL".to_owned()));
    wanted.extend((!needles.is_empty()).then(|| "p.search CONTAINS $word".to_owned()));
    wanted.extend((needles.len() > 1).then(|| "all(word IN $words WHERE p.search CONTAINS word)".to_owned()));
    wanted.extend(query.owner.as_ref().map(|_| "p.owner = $owner".to_owned()));
    wanted.extend(query.tag.as_ref().map(|_| "$tag IN p.tags".to_owned()));
    format!(
        "{}\n\
         CALL () {{\n  MATCH (p:{label}) {} WHERE {}\n  WITH p ORDER BY {order} LIMIT $most\n  \
         RETURN collect(p {{.id, .name, .revision, .streams, .owner, .tags, at_ms: coalesce(p.{at_ms}, 0), \
         by: coalesce(p.{by}, '')}}) AS lines\n}}\n\
         RETURN total, lines",
        total(query.place),
        index(query, needles),
        wanted.join(" AND ")
    )
}

fn params(query: &Query, needles: &[String]) -> StatementParams {
    let most = query.most.min(PAGE_MAX_LINES) + 1;
    let mut params: Vec<(&str, Value)> = vec![("most", json!(most)), ("words", json!(needles))];
    // The longest word is the rarest.
    params.push(("word", json!(needles.iter().max_by_key(|word| word.len()))));
    params.push(("owner", json!(query.owner)));
    params.push(("tag", json!(query.tag)));
    if let Some(Cursor { changed_ms, name_key, id }) = &query.after {
        params.extend([("at_ms", whole(*changed_ms)), ("name_key", json!(name_key)), ("after", json!(id))]);
    }
    params.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// A page of the behaviours that a query finds.
pub(super) async fn list(link: &Neo4jConnections, query: &Query) -> Result<Listing, StoreError> {
    let needles = query.needles();
    let page = link.read::<ListPage>(&statement(query, &needles), params(query, &needles)).await?.pop();
    let page = page.unwrap_or(ListPage { total: 0, lines: Vec::new() });
    Ok(Listing::of(page.lines.into_iter().map(ListedBehaviour::from).collect(), query, page.total))
}
