//! Pages of behaviours: the statement is put together from fixed pieces, what people write comes as parameters.

use super::link::{Link, Params};
use super::nodes::whole;
use crate::{Cursor, Listed, Listing, PAGE_MAX_LINES, Place, Query, Sort, StoreError};
use behaviour::Id;
use serde::Deserialize;
use serde_json::{Value, json};

#[derive(Deserialize)]
struct Page {
    total: u64,
    lines: Vec<Line>,
}

#[derive(Deserialize)]
struct Line {
    id: Id,
    name: String,
    revision: u64,
    at_ms: u64,
    by: String,
    owner: String,
    streams: u32,
}

impl From<Line> for Listed {
    fn from(line: Line) -> Self {
        let Line { id, name, revision, at_ms: changed_ms, by, owner, streams } = line;
        Self { id, name, revision, changed_ms, by, owner, streams }
    }
}

/// The label of a place, and its properties for when and by whom.
fn shelf(place: Place) -> (&'static str, &'static str, &'static str) {
    match place {
        Place::Here => ("Program", "changed_ms", "by"),
        Place::Bin => ("Binned", "removed_ms", "removed_by"),
    }
}

fn statement(query: &Query, needles: &[String]) -> String {
    let (label, at_ms, by) = shelf(query.place);
    let mut wanted =
        vec!["p.name_key IS NOT NULL".to_owned(), "p.id IS NOT NULL".to_owned(), format!("p.{at_ms} IS NOT NULL")];
    wanted.extend((!needles.is_empty()).then(|| "p.search CONTAINS $word".to_owned()));
    wanted.extend((needles.len() > 1).then(|| "all(word IN $words WHERE p.search CONTAINS word)".to_owned()));
    wanted.extend(query.owner.as_ref().map(|_| "p.owner = $owner".to_owned()));
    // Each order has an index; the first condition of each begins to read it at the right place.
    let (after, order) = match query.sort {
        Sort::Changed => (
            format!("p.{at_ms} <= $at_ms AND NOT (p.{at_ms} = $at_ms AND p.id >= $after)"),
            format!("p.{at_ms} DESC, p.id DESC"),
        ),
        Sort::Name => (
            "p.name_key >= $name_key AND NOT (p.name_key = $name_key AND p.id <= $after)".to_owned(),
            "p.name_key, p.id".to_owned(),
        ),
    };
    wanted.extend(query.after.as_ref().map(|_| after));
    format!(
        "CALL () {{ MATCH (p:{label}) WHERE p.name_key IS NOT NULL RETURN count(*) AS total }}\n\
         CALL () {{\n  MATCH (p:{label}) WHERE {}\n  WITH p ORDER BY {order} LIMIT $most\n  \
         RETURN collect(p {{.id, .name, .revision, .streams, .owner, at_ms: p.{at_ms}, by: p.{by}}}) AS lines\n}}\n\
         RETURN total, lines",
        wanted.join(" AND ")
    )
}

fn params(query: &Query, needles: &[String]) -> Params {
    let most = query.most.min(PAGE_MAX_LINES) + 1;
    let mut params: Vec<(&str, Value)> = vec![("most", json!(most)), ("words", json!(needles))];
    // The longest word is the rarest.
    params.push(("word", json!(needles.iter().max_by_key(|word| word.len()))));
    params.push(("owner", json!(query.owner)));
    if let Some(Cursor { changed_ms, name_key, id }) = &query.after {
        params.extend([("at_ms", whole(*changed_ms)), ("name_key", json!(name_key)), ("after", json!(id))]);
    }
    params.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// A page of the behaviours that a query finds.
pub(super) async fn list(link: &Link, query: &Query) -> Result<Listing, StoreError> {
    let needles = query.needles();
    let page = link.read::<Page>(&statement(query, &needles), params(query, &needles)).await?.pop();
    let page = page.unwrap_or(Page { total: 0, lines: Vec::new() });
    Ok(Listing::of(page.lines.into_iter().map(Listed::from).collect(), query, page.total))
}
