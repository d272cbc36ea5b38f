//! Collecting one by one.

/// Puts what an iterator gives into a collection one by one, in its order.
///
/// The maps and sets of the standard library sort what they are `collect`ed from, and the page would carry a sort for every
/// type: 4 KB each.
pub trait FillFrom: Iterator + Sized {
    /// The collection with all of it.
    fn filled<C: Default + Extend<Self::Item>>(self) -> C {
        let mut all = C::default();
        all.extend(self);
        all
    }

    /// All of it in order, each once.
    fn distinct(self) -> Vec<Self::Item>
    where
        Self::Item: Ord,
    {
        let mut all: Vec<Self::Item> = self.collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}

impl<I: Iterator> FillFrom for I {}

#[cfg(test)]
mod tests {
    use super::FillFrom;
    use std::collections::{BTreeMap, BTreeSet};

    #[test]
    fn what_is_filled_is_what_is_collected() {
        let pairs = [(2, 'b'), (1, 'a'), (2, 'c')];
        assert_eq!(pairs.into_iter().filled::<BTreeMap<_, _>>(), BTreeMap::from(pairs));
        assert_eq!([3, 1, 3].into_iter().filled::<BTreeSet<_>>(), BTreeSet::from([1, 3]));
        assert_eq!([3, 1, 3].into_iter().distinct(), [1, 3]);
    }
}
