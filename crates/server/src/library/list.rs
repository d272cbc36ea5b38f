//! The list of behaviours as the store has it, and names that are free in it.

use crate::support::store_call::{bounded, store_no};
use behaviour::{Id, as_looks, numbered};
use protocol::{LIST_MAX_LINES, ListQuery, Refused, Summary, WORDS_MAX_CHARS, answer};
use std::collections::BTreeSet;
use store::{Damage, ListedBehaviour, Listing, Query, Store, StoreError};

/// A page of the list.
pub(crate) async fn list(store: &dyn Store, query: ListQuery) -> Result<answer::Programs, Refused> {
    let listing = bounded(store.list(&asked(query))).await.map_err(|error| store_no(&error))?;
    let Listing { lines, next, total } = listing;
    Ok(answer::Programs { programs: lines.into_iter().map(summary_of).collect(), next, total })
}

/// The tags of all behaviours outside the bin.
pub(crate) async fn tags(store: &dyn Store) -> Result<answer::Tags, Refused> {
    Ok(answer::Tags { tags: bounded(store.tags()).await.map_err(|error| store_no(&error))? })
}

/// Id and name of every behaviour that is not in the bin, by name.
///
/// # Errors
/// What the store fails with.
pub async fn names(store: &dyn Store) -> Result<Vec<(Id, String)>, StoreError> {
    let (mut names, mut query) = (Vec::new(), Query { sort: store::Sort::Name, ..Query::default() });
    loop {
        let page = store.list(&query).await?;
        names.extend(page.lines.into_iter().map(|line| (line.id, line.name)));
        query.after = page.next;
        if query.after.is_none() {
            return Ok(names);
        }
    }
}

/// The question as the store takes it, within its bounds.
fn asked(query: ListQuery) -> Query {
    Query {
        place: query.place,
        words: query.words.chars().take(WORDS_MAX_CHARS).collect(),
        owner: query.owner,
        tag: query.tag,
        sort: query.sort,
        after: query.after,
        most: query.most.clamp(1, LIST_MAX_LINES),
    }
}

fn summary_of(listed: ListedBehaviour) -> Summary {
    Summary {
        id: listed.id.to_string(),
        name: listed.name,
        revision: listed.revision,
        changed_ms: listed.changed_ms,
        by: listed.by,
        owner: listed.owner,
        streams: listed.streams,
        tags: listed.tags,
        picture: None,
    }
}

/// This name, or with a number if a behaviour outside the bin has it.
///
/// # Errors
/// What the store fails with.
pub async fn free_name(store: &dyn Store, wanted: &str) -> Result<String, StoreError> {
    let taken = names_from(store, wanted).await?;
    let free = numbered(wanted, " ").find(|name| !taken.contains(&*as_looks(name)));
    Ok(free.unwrap_or_else(|| wanted.to_owned()))
}

/// The names that begin like this one in any case: in order of name they stand together.
async fn names_from(store: &dyn Store, wanted: &str) -> Result<BTreeSet<String>, StoreError> {
    let key = as_looks(wanted).to_lowercase();
    let first = Id::new(FIRST_ID).map_err(|reason| StoreError::Damaged(Damage::Id(reason)))?;
    let just_before = store::Cursor { changed_ms: 0, name_key: key.clone(), id: first };
    let mut query = Query { sort: store::Sort::Name, after: Some(just_before), ..Query::default() };
    let mut names = BTreeSet::new();
    while query.after.is_some() {
        let page = store.list(&query).await?;
        let all = page.lines.len();
        names.extend(
            page.lines
                .into_iter()
                .map(|line| as_looks(&line.name).into_owned())
                .take_while(|name| name.to_lowercase().starts_with(&key)),
        );
        query.after = page.next.filter(|next| all > 0 && next.name_key.starts_with(&key));
    }
    Ok(names)
}

/// No other id comes before it.
const FIRST_ID: &str = "-";

#[cfg(test)]
mod tests {
    use super::free_name;
    use behaviour::{Behaviour, Change, Id, Record, RecordId, Settings};
    use store::{MemoryStore, Store};

    async fn keep(store: &MemoryStore, number: usize, name: &str) {
        let id = Id::new(&format!("b{number}")).unwrap();
        let settings = Record::Settings(Settings::named(name));
        let change = Change::of(id.clone(), "Aiko", "Add").put(&Behaviour::default(), RecordId::settings(), settings);
        let first = behaviour::Committed { revision: 1, change };
        let mut after = Behaviour::default();
        after.apply(&first.change);
        store.append(&id, &first, &after).await.unwrap();
    }

    #[tokio::test]
    async fn a_taken_name_gets_the_first_free_number() {
        let store = MemoryStore::new();
        let names = ["Play", "play 2", "Play 3", "Playing", "Add", "Play 2", "Été", "zoo"];
        for (number, name) in names.into_iter().enumerate() {
            keep(&store, number, name).await;
        }
        for (wanted, free) in [("Play", "Play 4"), ("play", "play"), ("Zoo", "Zoo"), ("Été", "Été 2"), ("zoo", "zoo 2")]
        {
            assert_eq!(free_name(&store, wanted).await.unwrap(), free);
        }
    }

    #[tokio::test]
    async fn names_are_looked_for_beyond_a_page() {
        let store = MemoryStore::new();
        for number in 0..1_100 {
            let name = if number == 0 { "New".to_owned() } else { format!("New {}", number + 1) };
            keep(&store, number, &name).await;
        }
        assert_eq!(free_name(&store, "New").await.unwrap(), "New 1101");
    }
}
