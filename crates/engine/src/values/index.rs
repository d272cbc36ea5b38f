//! Streams and connectors by number, in the order of the file, and what there is one of for each of them.

use serde::{Deserialize, Serialize};
use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

/// A number that counts one kind of thing only.
pub trait Ix: Copy {
    /// The one at a place.
    fn of(at: usize) -> Self;

    /// Returns the place.
    fn index(self) -> usize;
}

macro_rules! numbers {
    ($(#[$what:meta] $name:ident)+) => {$(
        #[$what]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
        #[serde(transparent)]
        pub struct $name(u32);

        impl $name {
            /// The first one.
            pub(crate) const FIRST: Self = Self(0);

            /// The one at a place in the file.
            #[must_use]
            pub fn of(at: usize) -> Self {
                Self(place(at))
            }

            /// Returns the place in the file.
            #[must_use]
            #[inline(always)]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl Ix for $name {
            fn of(at: usize) -> Self {
                Self::of(at)
            }

            #[inline(always)]
            fn index(self) -> usize {
                Self::index(self)
            }
        }
    )+};
}

numbers! {
    #[doc = "A stream of a run, by its place in the file."]
    StreamIx
    #[doc = "A connector of a run, by its place in the file."]
    ConnectorIx
}

/// Streams and connectors are far fewer than would fill it.
fn place(at: usize) -> u32 {
    u32::try_from(at).unwrap_or(u32::MAX)
}

/// One thing for each stream, or for each connector.
#[derive(Clone, Debug, PartialEq)]
pub struct IndexVec<I, T> {
    all: Vec<T>,
    counts: PhantomData<I>,
}

impl<I: Ix, T> IndexVec<I, T> {
    /// Returns the number of entries.
    #[must_use]
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// True if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// All of them, in order.
    pub fn iter(&self) -> std::slice::Iter<'_, T> {
        self.all.iter()
    }

    /// All of them to change, in order.
    pub fn iter_mut(&mut self) -> std::slice::IterMut<'_, T> {
        self.all.iter_mut()
    }

    /// All numbers, in order.
    pub fn indices(&self) -> impl DoubleEndedIterator<Item = I> + ExactSizeIterator + use<I, T> {
        (0..self.all.len()).map(I::of)
    }

    /// All of them with their numbers, in order.
    pub fn enumerate(&self) -> impl Iterator<Item = (I, &T)> {
        self.all.iter().enumerate().map(|(at, thing)| (I::of(at), thing))
    }

    /// The one with a number, if there is one.
    #[must_use]
    pub fn get(&self, at: I) -> Option<&T> {
        self.all.get(at.index())
    }

    /// Two different ones to change.
    #[inline(always)]
    pub(crate) fn pair_mut(&mut self, one: I, other: I) -> Option<[&mut T; 2]> {
        self.all.get_disjoint_mut([one.index(), other.index()]).ok()
    }
}

impl<I: Ix, T: Clone> IndexVec<I, T> {
    /// Makes so many that are the same.
    pub(crate) fn filled(with: &T, many: usize) -> Self {
        vec![with.clone(); many].into()
    }

    /// Puts the same in all places.
    pub(crate) fn fill(&mut self, with: &T) {
        self.all.fill(with.clone());
    }
}

impl<I, T> Default for IndexVec<I, T> {
    fn default() -> Self {
        Self { all: Vec::new(), counts: PhantomData }
    }
}

impl<I, T> From<Vec<T>> for IndexVec<I, T> {
    fn from(all: Vec<T>) -> Self {
        Self { all, counts: PhantomData }
    }
}

impl<I, T> FromIterator<T> for IndexVec<I, T> {
    fn from_iter<A: IntoIterator<Item = T>>(all: A) -> Self {
        Vec::from_iter(all).into()
    }
}

impl<'a, I: Ix, T> IntoIterator for &'a IndexVec<I, T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<I: Ix, T> Index<I> for IndexVec<I, T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, at: I) -> &T {
        &self.all[at.index()]
    }
}

impl<I: Ix, T> IndexMut<I> for IndexVec<I, T> {
    #[inline(always)]
    fn index_mut(&mut self, at: I) -> &mut T {
        &mut self.all[at.index()]
    }
}

/// Some numbers, in order, each with the number that stands for it elsewhere.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pairs<I> {
    all: Vec<(I, I)>,
}

impl<I: Ix> Pairs<I> {
    /// Out of pairs in the order of their first numbers.
    pub(crate) fn of(all: Vec<(I, I)>) -> Self {
        Self { all }
    }

    /// The number that stands for this one, if there is one.
    #[must_use]
    pub fn get(&self, at: I) -> Option<I> {
        let place = self.all.binary_search_by_key(&at.index(), |(from, _)| from.index()).ok()?;
        Some(self.all[place].1)
    }

    /// True if there is one for this number.
    #[must_use]
    pub fn contains_key(&self, at: &I) -> bool {
        self.get(*at).is_some()
    }
}

impl<'p, I> IntoIterator for &'p Pairs<I> {
    type Item = (&'p I, &'p I);
    type IntoIter = std::iter::Map<std::slice::Iter<'p, (I, I)>, fn(&(I, I)) -> (&I, &I)>;

    fn into_iter(self) -> Self::IntoIter {
        self.all.iter().map(|(from, to)| (from, to))
    }
}
