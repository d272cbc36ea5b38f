//! The fields of an object. Objects of one shape share their names, so that whoever looks for a field twice finds it at
//! once the second time: it is at the same place in every object of that [`Fields::shape`].

use crate::Value;
use std::cell::RefCell;
use std::cmp::Ordering;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// Objects with more fields than this keep their values in a place of their own.
const FEW: usize = 3;
/// Shapes that one thread remembers, to give objects that are made apart the same names.
const SHAPES_MAX: usize = 256;
/// Shapes whose names, each with one byte more, have more than this together are not remembered.
const SHAPE_MAX_BYTES: usize = 256;

/// The fields of an object, in the order of their names. A clone is cheap: it shares.
#[derive(Clone)]
pub struct Fields(Arc<FieldsObject>);

#[derive(Clone)]
struct FieldsObject {
    names: FieldNames,
    values: FieldValues,
}

/// The names of the fields of an object, in order, each once. A clone is cheap: it shares.
#[derive(Clone)]
pub struct FieldNames {
    shape: u64,
    names: Arc<[Arc<str>]>,
}

#[derive(Clone)]
enum FieldValues {
    Few(usize, [Value; FEW]),
    Many(Vec<Value>),
}

thread_local! {
    /// All sets of names, in the order of the names.
    static SHAPES: RefCell<Vec<FieldNames>> = const { RefCell::new(Vec::new()) };
}

impl Fields {
    /// The fields with these names; of a name that is there twice the last one counts.
    #[must_use]
    pub fn of<N: AsRef<str>>(mut fields: Vec<(N, Value)>) -> Self {
        let is_sorted = fields.windows(2).all(|pair| pair[0].0.as_ref() < pair[1].0.as_ref());
        if !is_sorted {
            fields.sort_by(|one, other| one.0.as_ref().cmp(other.0.as_ref()));
            fields.reverse();
            fields.dedup_by(|later, kept| later.0.as_ref() == kept.0.as_ref());
            fields.reverse();
        }
        let names = FieldNames::sorted(&fields.iter().map(|(name, _)| name.as_ref()).collect::<Vec<_>>());
        Self::with(&names, fields.into_iter().map(|(_, value)| value))
    }

    /// The fields with `names` and as many values.
    #[must_use]
    pub fn with(names: &FieldNames, values: impl ExactSizeIterator<Item = Value>) -> Self {
        debug_assert_eq!(names.names.len(), values.len(), "every field has a value");
        Self(Arc::new(FieldsObject { names: names.clone(), values: FieldValues::of(values) }))
    }

    /// The field `name`.
    #[must_use]
    #[inline]
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.0.names.place(name).and_then(|at| self.values().get(at))
    }

    /// True if there is a field `name`.
    #[must_use]
    #[inline]
    pub fn contains_key(&self, name: &str) -> bool {
        self.0.names.place(name).is_some()
    }

    /// Returns the number of fields.
    #[must_use]
    #[inline]
    pub fn len(&self) -> usize {
        self.0.names.names.len()
    }

    /// True if there is none.
    #[must_use]
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Names and values, in the order of the names.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&Arc<str>, &Value)> {
        self.0.names.names.iter().zip(self.values())
    }

    /// The values, in the order of the names.
    #[must_use]
    #[inline]
    pub fn values(&self) -> &[Value] {
        self.0.values.all()
    }

    /// The names, in order.
    #[must_use]
    #[inline]
    pub fn names(&self) -> &FieldNames {
        &self.0.names
    }

    /// A number of its names: objects with equal numbers have the same names. The opposite need not hold.
    #[must_use]
    #[inline]
    pub fn shape(&self) -> u64 {
        self.0.names.shape
    }

    /// The values to be changed, if nobody else has this object.
    #[inline]
    pub fn own_values(&mut self) -> Option<&mut [Value]> {
        Arc::get_mut(&mut self.0).map(|object| object.values.all_mut())
    }
}

impl FieldValues {
    fn of(mut values: impl ExactSizeIterator<Item = Value>) -> Self {
        let many = values.len();
        if many > FEW {
            return Self::Many(values.collect());
        }
        Self::Few(many, std::array::from_fn(|_| values.next().unwrap_or_default()))
    }

    #[inline]
    fn all(&self) -> &[Value] {
        match self {
            Self::Few(many, values) => values.get(..*many).unwrap_or_default(),
            Self::Many(values) => values,
        }
    }

    #[inline]
    fn all_mut(&mut self) -> &mut [Value] {
        match self {
            Self::Few(many, values) => values.get_mut(..*many).unwrap_or_default(),
            Self::Many(values) => values,
        }
    }
}

impl FieldNames {
    /// Names in order, each once.
    #[must_use]
    pub fn of<N: AsRef<str>>(names: &[N]) -> Self {
        let mut names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
        names.sort_unstable();
        names.dedup();
        Self::sorted(&names)
    }

    /// The place of a name.
    #[must_use]
    #[inline]
    pub fn place(&self, name: &str) -> Option<usize> {
        self.names.binary_search_by(|known| known.as_ref().cmp(name)).ok()
    }

    /// Returns the number of names.
    #[must_use]
    #[inline]
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// True if there is none.
    #[must_use]
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// A number of the fields and their order: equal to that of [`Fields::shape`] for equal names.
    #[must_use]
    #[inline]
    pub fn shape(&self) -> u64 {
        self.shape
    }

    /// The names that this thread remembers, or new ones.
    #[inline]
    fn sorted(names: &[&str]) -> Self {
        if names.iter().map(|name| name.len() + 1).sum::<usize>() > SHAPE_MAX_BYTES {
            return Self::new(names);
        }
        SHAPES.with_borrow_mut(|shapes| {
            let known = shapes.binary_search_by(|known| known.order(names));
            match known {
                Ok(at) => shapes[at].clone(),
                Err(_) if shapes.len() >= SHAPES_MAX => {
                    shapes.clear();
                    Self::new(names)
                }
                Err(at) => {
                    shapes.insert(at, Self::new(names));
                    shapes[at].clone()
                }
            }
        })
    }

    #[inline]
    fn new(names: &[&str]) -> Self {
        static SHAPE: AtomicU64 = AtomicU64::new(0);
        Self { shape: SHAPE.fetch_add(1, Relaxed), names: names.iter().map(|name| Arc::from(*name)).collect() }
    }

    #[inline]
    fn order(&self, names: &[&str]) -> Ordering {
        self.names.iter().map(AsRef::as_ref).cmp(names.iter().copied())
    }
}

impl PartialEq for Fields {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        let same_names = self.shape() == other.shape() || self.0.names.names == other.0.names.names;
        same_names && self.values() == other.values()
    }
}

impl fmt::Debug for Fields {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.debug_map().entries(self.iter()).finish()
    }
}

impl<N: AsRef<str>> FromIterator<(N, Value)> for Fields {
    fn from_iter<I: IntoIterator<Item = (N, Value)>>(fields: I) -> Self {
        Self::of(fields.into_iter().collect())
    }
}

#[cfg(test)]
mod tests {
    use super::{FieldNames, Fields, SHAPES_MAX};
    use crate::Value;

    fn fields(names: &[&str]) -> Fields {
        (0..).zip(names).map(|(at, name)| (*name, Value::Int(at))).collect()
    }

    #[test]
    fn fields_are_in_order_and_of_two_the_last_counts() {
        let made = fields(&["c", "a", "b", "a", "d"]);
        let all: Vec<_> = made.iter().map(|(name, value)| format!("{name}{value}")).collect();
        assert_eq!(all, ["a3", "b2", "c0", "d4"]);
        assert_eq!((made.get("c"), made.get("e"), made.len()), (Some(&Value::Int(0)), None, 4));
        assert_eq!(format!("{:?}", fields(&["x"])), r#"{"x": Int(0)}"#);
    }

    #[test]
    fn objects_made_apart_have_one_shape() {
        assert_eq!(fields(&["x", "y"]).shape(), fields(&["y", "x"]).shape());
        assert_eq!(fields(&["y", "x"]).shape(), FieldNames::of(&["x", "y"]).shape());
        assert_ne!(fields(&["x", "y"]).shape(), fields(&["x"]).shape());
    }

    #[test]
    fn shapes_that_were_forgotten_or_are_of_another_thread_are_equal_still() {
        let before = fields(&["x", "y"]);
        for at in 0..=SHAPES_MAX {
            fields(&[&format!("field{at}")]);
        }
        let after = fields(&["x", "y"]);
        assert_ne!(before.shape(), after.shape(), "the test must make it forget");
        assert_eq!(before, after);
        assert_eq!(std::thread::spawn(|| fields(&["x", "y"])).join().unwrap(), after);
    }

    #[test]
    fn shapes_with_long_names_are_not_remembered() {
        let long = "x".repeat(super::SHAPE_MAX_BYTES);
        let (one, other) = (fields(&[&long]), fields(&[&long]));
        assert_ne!(one.shape(), other.shape());
        assert_eq!(one, other);
    }

    #[test]
    fn only_the_one_owner_may_change_values() {
        let mut made = fields(&["x"]);
        let other = made.clone();
        assert!(made.own_values().is_none());
        drop(other);
        made.own_values().unwrap()[0] = Value::Null;
        assert_eq!(made.get("x"), Some(&Value::Null));
    }
}
