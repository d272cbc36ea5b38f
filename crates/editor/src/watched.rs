//! A value that a view shows, and whether it is another one than the last time somebody asked.

use std::ops::Deref;

/// A shown value. It remembers that it changed until its news are taken.
#[derive(Debug, Default)]
pub struct Watched<T> {
    value: T,
    is_new: bool,
}

impl<T> Deref for Watched<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.value
    }
}

impl<T> Watched<T> {
    /// Returns the value if it changed since this was called last.
    pub fn news(&mut self) -> Option<T>
    where
        T: Clone,
    {
        std::mem::take(&mut self.is_new).then(|| self.value.clone())
    }

    /// Sets the value; the same one again is no news.
    pub(crate) fn set(&mut self, value: T)
    where
        T: PartialEq,
    {
        if self.value != value {
            self.put(value);
        }
    }

    /// Sets the value; it is news even if it is the same one.
    pub(crate) fn put(&mut self, value: T) {
        (self.value, self.is_new) = (value, true);
    }

    /// Changes the value in place, which is news.
    pub(crate) fn update(&mut self, act: impl FnOnce(&mut T)) {
        act(&mut self.value);
        self.is_new = true;
    }
}

#[cfg(test)]
mod tests {
    use super::Watched;

    #[test]
    fn a_value_is_news_once_and_only_if_it_changed() {
        let mut watched = Watched::<u8>::default();
        assert_eq!(watched.news(), None);
        watched.set(0);
        assert_eq!(watched.news(), None, "it was that already");
        watched.set(1);
        assert_eq!([watched.news(), watched.news()], [Some(1), None]);
        watched.put(1);
        assert_eq!(watched.news(), Some(1), "the same one again");
        watched.update(|value| *value += 1);
        assert_eq!((watched.news(), *watched), (Some(2), 2));
    }
}
