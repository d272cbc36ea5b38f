//! The tags of a library, counted line by line; few programs have any.

use crate::{Query, Sort, Store, StoreError, Tagged};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// The tags of all behaviours outside the bin.
pub(crate) async fn of_all(store: &(impl Store + ?Sized)) -> Result<Vec<Tagged>, StoreError> {
    let mut counts: BTreeMap<String, u64> = BTreeMap::new();
    let mut query = Query { sort: Sort::Name, ..Query::default() };
    loop {
        let page = store.list(&query).await?;
        for tag in page.lines.into_iter().flat_map(|line| line.tags) {
            *counts.entry(tag).or_default() += 1;
        }
        query.after = page.next;
        if query.after.is_none() {
            return Ok(shown(counts));
        }
    }
}

fn shown(counts: BTreeMap<String, u64>) -> Vec<Tagged> {
    let mut all: Vec<Tagged> = counts.into_iter().map(|(tag, count)| Tagged { tag, count }).collect();
    all.sort_by_key(|tagged| Reverse(tagged.count));
    all.truncate(Tagged::SHOWN_MAX);
    all.sort_by_key(|tagged| (tagged.tag.to_lowercase(), tagged.tag.clone()));
    all
}

#[cfg(test)]
mod tests {
    use super::shown;
    use crate::Tagged;

    #[test]
    fn the_tags_that_most_have_are_told_in_order() {
        let all = (0..300_u64).map(|at| (format!("t{at:03}"), at)).collect();
        let told = shown(all);
        assert_eq!(told.len(), Tagged::SHOWN_MAX);
        assert_eq!(told.first().map(|tagged| tagged.tag.as_str()), Some("t100"));
        let told = shown([("b".to_owned(), 9), ("A".to_owned(), 1)].into());
        assert_eq!(told.into_iter().map(|tagged| tagged.tag).collect::<Vec<_>>(), ["A", "b"]);
    }
}
