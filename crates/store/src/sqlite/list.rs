//! A page of the list, read with the index that has its order.

use super::fault::SqliteFault;
use super::read::id;
use super::write::{kept, read};
use crate::{ListedBehaviour, Listing, PAGE_MAX_LINES, Query, SearchPlace, Sort, json};
use rusqlite::types::Value;
use rusqlite::{Connection, Row, params_from_iter};

/// Letters that the index of the searched text keeps together.
const LETTERS: usize = 3;

/// A page.
pub(super) fn list(at: &Connection, query: &Query) -> Result<Listing, SqliteFault> {
    let mut asked = ListStatement::new(query.place);
    asked.words(query);
    asked.owner(query);
    asked.tag(query);
    asked.after(query);
    let sql = asked.sql(query);
    let mut statement = at.prepare_cached(&sql)?;
    let mut rows = statement.query(params_from_iter(asked.values))?;
    let mut lines = Vec::new();
    while let Some(row) = rows.next()? {
        lines.push(line(row)?);
    }
    Ok(Listing::of(lines, query, total(at, query.place)?))
}

fn total(at: &Connection, place: SearchPlace) -> Result<u64, SqliteFault> {
    let place = match place {
        SearchPlace::Here => "here",
        SearchPlace::Bin => "bin",
    };
    let mut query = at.prepare_cached("SELECT count FROM tally WHERE place = ?1")?;
    Ok(read(query.query_row([place], |row| row.get(0))?))
}

fn there(place: SearchPlace) -> &'static str {
    match place {
        SearchPlace::Here => "removed_ms IS NULL AND name IS NOT NULL",
        SearchPlace::Bin => "removed_ms IS NOT NULL AND name IS NOT NULL",
    }
}

fn line(row: &Row) -> Result<ListedBehaviour, SqliteFault> {
    Ok(ListedBehaviour {
        id: id(row, 0)?,
        name: row.get(1)?,
        revision: read(row.get(2)?),
        streams: row.get(3)?,
        changed_ms: read(row.get(4)?),
        by: row.get(5)?,
        owner: row.get(6)?,
        tags: json::decode(&row.get::<_, String>(7)?).map_err(|reason| SqliteFault::content(&reason))?,
    })
}

/// A statement on its way: conditions and their values.
struct ListStatement {
    time: &'static str,
    by: &'static str,
    conditions: String,
    values: Vec<Value>,
}

impl ListStatement {
    fn new(place: SearchPlace) -> Self {
        let (time, by) = match place {
            SearchPlace::Here => ("changed_ms", "by"),
            SearchPlace::Bin => ("removed_ms", "removed_by"),
        };
        Self { time, by, conditions: there(place).to_owned(), values: Vec::new() }
    }

    fn value(&mut self, value: impl Into<Value>) -> String {
        self.values.push(value.into());
        format!("?{}", self.values.len())
    }

    fn and(&mut self, condition: &str) {
        self.conditions.push_str(" AND ");
        self.conditions.push_str(condition);
    }

    /// The index finds who has all the letters, the text decides.
    fn words(&mut self, query: &Query) {
        let needles = query.needles();
        if needles.is_empty() {
            return;
        }
        let mut inner = "SELECT behaviour FROM searched WHERE true".to_owned();
        let letters = letters(&needles);
        if !letters.is_empty() {
            let place = self.value(letters);
            inner.push_str(&format!(" AND number IN (SELECT rowid FROM search WHERE search MATCH {place})"));
        }
        for needle in needles {
            let place = self.value(needle);
            inner.push_str(&format!(" AND instr(text, {place}) > 0"));
        }
        self.and(&format!("id IN ({inner})"));
    }

    fn owner(&mut self, query: &Query) {
        if let Some(owner) = &query.owner {
            let place = self.value(owner.clone());
            self.and(&format!("owner = {place}"));
        }
    }

    fn tag(&mut self, query: &Query) {
        if let Some(tag) = &query.tag {
            let place = self.value(tag.clone());
            self.and(&format!("EXISTS (SELECT 1 FROM json_each(behaviour.tags) AS tag WHERE tag.value = {place})"));
        }
    }

    fn after(&mut self, query: &Query) {
        let Some(after) = &query.after else { return };
        let first = match query.sort {
            Sort::Changed => self.value(kept(after.changed_ms)),
            Sort::Name => self.value(after.name_key.clone()),
        };
        let id = self.value(after.id.as_str().to_owned());
        let condition = match query.sort {
            Sort::Changed => format!("({}, id) < ({first}, {id})", self.time),
            Sort::Name => format!("(name_key, id) > ({first}, {id})"),
        };
        self.and(&condition);
    }

    fn sql(&mut self, query: &Query) -> String {
        let most = self.value(i64::from(query.most.min(PAGE_MAX_LINES)) + 1);
        let Self { time, by, conditions, .. } = self;
        let order = match query.sort {
            Sort::Changed => format!("{time} DESC, id DESC"),
            Sort::Name => "name_key, id".to_owned(),
        };
        format!(
            "SELECT id, name, revision, streams, {time}, {by}, owner, tags FROM behaviour \
             WHERE {conditions} ORDER BY {order} LIMIT {most}"
        )
    }
}

/// Every three letters in a row of every word, as a question to the index; empty if no word is long enough.
fn letters(needles: &[String]) -> String {
    let mut letters = Vec::new();
    for needle in needles.iter().filter(|needle| !needle.contains('\0')) {
        let chars: Vec<char> = needle.chars().collect();
        let quoted = |three: &[char]| format!("\"{}\"", three.iter().collect::<String>().replace('"', "\"\""));
        letters.extend(chars.windows(LETTERS).map(quoted));
    }
    letters.join(" AND ")
}
