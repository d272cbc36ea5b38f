//! Maps and sets that are asked and not gone through, so that no order of hashes can be seen in what is made of them.
//!
//! They also keep the first start short. The compiler makes generic code anew for each pair of types: a `BTreeMap` or
//! `BTreeSet` is some 6,000 lines of LLVM, sorting a row 1,500, a `Lookup` 1,000. So what needs no order is looked up here.

use std::borrow::Borrow;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::fmt;
use std::hash::Hash;
use std::ops::Index;

/// A map that can only be asked by its keys. It has no order, and nothing that would show one: work in rooms that have to
/// do the same in every run may use it. Asking takes the same time however much it holds.
#[derive(Clone, PartialEq, Eq)]
pub struct Lookup<K: Eq + Hash, V>(HashMap<K, V>);

impl<K: Eq + Hash, V> Lookup<K, V> {
    /// An empty one.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns the number of keys.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// True if there are no keys.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the value under a key.
    #[must_use]
    pub fn get<Q: Eq + Hash + ?Sized>(&self, key: &Q) -> Option<&V>
    where
        K: Borrow<Q>,
    {
        self.0.get(key)
    }

    /// Returns the value under a key, to be changed.
    pub fn get_mut<Q: Eq + Hash + ?Sized>(&mut self, key: &Q) -> Option<&mut V>
    where
        K: Borrow<Q>,
    {
        self.0.get_mut(key)
    }

    /// True if there is something under a key.
    #[must_use]
    pub fn contains_key<Q: Eq + Hash + ?Sized>(&self, key: &Q) -> bool
    where
        K: Borrow<Q>,
    {
        self.0.contains_key(key)
    }

    /// Puts something under a key, and gives back what was there.
    pub fn insert(&mut self, key: K, value: V) -> Option<V> {
        self.0.insert(key, value)
    }

    /// Takes away what is under a key.
    pub fn remove<Q: Eq + Hash + ?Sized>(&mut self, key: &Q) -> Option<V>
    where
        K: Borrow<Q>,
    {
        self.0.remove(key)
    }

    /// The place of a key, taken or not.
    pub fn entry(&mut self, key: K) -> Entry<'_, K, V> {
        self.0.entry(key)
    }

    /// Keeps what the question says yes to. It is asked in no order, so nothing but its answer may come of it.
    pub fn retain(&mut self, keeps: impl Fn(&K, &V) -> bool) {
        self.0.retain(|key, value| keeps(key, value));
    }
}

impl<K: Eq + Hash, V> Default for Lookup<K, V> {
    fn default() -> Self {
        Self(HashMap::new())
    }
}

impl<K: Eq + Hash, V> fmt::Debug for Lookup<K, V> {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        write!(to, "Lookup of {}", self.len())
    }
}

impl<K: Eq + Hash, V> Extend<(K, V)> for Lookup<K, V> {
    fn extend<I: IntoIterator<Item = (K, V)>>(&mut self, more: I) {
        self.0.extend(more);
    }
}

impl<K: Eq + Hash, V> FromIterator<(K, V)> for Lookup<K, V> {
    fn from_iter<I: IntoIterator<Item = (K, V)>>(all: I) -> Self {
        Self(HashMap::from_iter(all))
    }
}

impl<K: Eq + Hash + Borrow<Q>, Q: Eq + Hash + ?Sized, V> Index<&Q> for Lookup<K, V> {
    type Output = V;

    fn index(&self, key: &Q) -> &V {
        &self.0[key]
    }
}

/// A set that can only be asked, as [`Lookup`] can.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LookupSet<K: Eq + Hash>(Lookup<K, ()>);

impl<K: Eq + Hash> LookupSet<K> {
    /// An empty one.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// True if something is in it.
    #[must_use]
    pub fn contains<Q: Eq + Hash + ?Sized>(&self, one: &Q) -> bool
    where
        K: Borrow<Q>,
    {
        self.0.contains_key(one)
    }

    /// True if there is nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Puts something in; says whether it was not there.
    pub fn insert(&mut self, one: K) -> bool {
        self.0.insert(one, ()).is_none()
    }

    /// Takes something away; says whether it was there.
    pub fn remove<Q: Eq + Hash + ?Sized>(&mut self, one: &Q) -> bool
    where
        K: Borrow<Q>,
    {
        self.0.remove(one).is_some()
    }
}

impl<K: Eq + Hash> Default for LookupSet<K> {
    fn default() -> Self {
        Self(Lookup::new())
    }
}

impl<K: Eq + Hash> Extend<K> for LookupSet<K> {
    fn extend<I: IntoIterator<Item = K>>(&mut self, more: I) {
        for one in more {
            self.insert(one);
        }
    }
}

impl<K: Eq + Hash> FromIterator<K> for LookupSet<K> {
    fn from_iter<I: IntoIterator<Item = K>>(all: I) -> Self {
        let mut made = Self::new();
        made.extend(all);
        made
    }
}
