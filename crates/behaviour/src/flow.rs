//! The number of values that one value becomes: where ways of the same stream come together again and again, they
//! multiply.

use crate::walk::{Ends, in_order};

/// The most times that values made of one reading may be handed to connectors, all in all.
pub const HANDED_MAX: u64 = 100_000;

/// A connector, as far as it matters for the number of values. Streams are numbers here.
#[derive(Clone, Copy, Debug)]
pub struct FlowConnector<'a> {
    /// The streams it takes from.
    pub inputs: &'a [usize],
    /// The stream it gives to.
    pub output: usize,
    /// The values that the connector gives for one that it takes.
    pub gives: Gives,
}

/// The number of values that a connector gives for each one that it takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gives {
    /// One value.
    Each,
    /// One value, or none.
    Some,
    /// Nothing now. What it gives later begins anew.
    Later,
}

/// A graph without circles, in an order in which values flow.
#[derive(Clone, Debug)]
pub struct Flow<'a> {
    streams: usize,
    /// The connectors in the order of their values, without those in a circle or behind one.
    links: Vec<FlowConnector<'a>>,
}

impl<'a> Flow<'a> {
    /// Brings connectors between so many streams into the order of their values.
    #[must_use]
    pub fn of(streams: usize, links: &[FlowConnector<'a>]) -> Self {
        let ends: Vec<Ends> = links.iter().map(|link| (link.inputs, link.output)).collect();
        let sorted = in_order(streams, &ends).into_iter().map(|at| links[at]).collect();
        Self { streams, links: sorted }
    }

    /// For every stream how many times connectors are handed a value because of one value on it, in one instant.
    /// A connector that may give a value counts as if it always did; if `certain`, only those count that surely give
    /// one.
    #[must_use]
    pub fn handed(&self, certain: bool) -> Vec<u64> {
        let mut handed = vec![0_u64; self.streams];
        for link in self.links.iter().rev() {
            let behind = if link.passes(certain) { handed[link.output] } else { 0 };
            for &input in link.inputs {
                handed[input] = handed[input].saturating_add(1).saturating_add(behind);
            }
        }
        handed
    }

    /// The stream at which the values of one value on `start` have become too many: the last one before that where
    /// ways come together. None if they do not.
    #[must_use]
    pub fn multiplies_at(&self, start: usize, certain: bool, handed_max: u64) -> Option<usize> {
        let (mut values, mut joint, mut handed) = (vec![0_u64; self.streams], vec![start; self.streams], 0_u64);
        values[start] = 1;
        for link in &self.links {
            let reached = || link.inputs.iter().filter(|input| values[**input] > 0);
            let Some(&first) = reached().next() else { continue };
            let taken = reached().fold(0_u64, |sum, input| sum.saturating_add(values[*input]));
            handed = handed.saturating_add(taken);
            let place = if reached().count() > 1 { link.output } else { joint[first] };
            if handed > handed_max {
                return Some(place);
            }
            if link.passes(certain) {
                values[link.output] = values[link.output].saturating_add(taken);
                joint[link.output] = place;
            }
        }
        None
    }
}

impl FlowConnector<'_> {
    fn passes(&self, certain: bool) -> bool {
        match self.gives {
            Gives::Each => true,
            Gives::Some => !certain,
            Gives::Later => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Flow, FlowConnector, Gives, HANDED_MAX};

    /// Diamonds in a row, each of two ways that lead to a merge: stream 3n is where the nth begins.
    fn diamonds(many: usize, ways: Gives) -> Vec<(Vec<usize>, usize, Gives)> {
        let diamond = |at: usize| {
            let from = at * 3;
            let way = |to| (vec![from], to, ways);
            [way(from + 1), way(from + 2), (vec![from + 1, from + 2], from + 3, Gives::Each)]
        };
        (0..many).flat_map(diamond).collect()
    }

    fn links(of: &[(Vec<usize>, usize, Gives)]) -> Vec<FlowConnector<'_>> {
        of.iter().map(|(inputs, output, gives)| FlowConnector { inputs, output: *output, gives: *gives }).collect()
    }

    #[test]
    fn every_diamond_doubles_the_values() {
        let of = diamonds(60, Gives::Each);
        let flow = Flow::of(181, &links(&of));
        let handed = flow.handed(true);
        assert_eq!([handed[180], handed[177], handed[174]], [0, 4, 12]);
        assert_eq!(handed[0], 4 * ((1 << 60) - 1));
        assert_eq!(flow.multiplies_at(0, true, 4 + 8 + 16), Some(9), "the fourth is too much");
        assert_eq!(flow.multiplies_at(180, true, HANDED_MAX), None);
    }

    #[test]
    fn ways_that_filters_choose_are_not_certain_and_a_sample_begins_anew() {
        let of = diamonds(30, Gives::Some);
        let flow = Flow::of(91, &links(&of));
        assert_eq!((flow.handed(true)[0], flow.multiplies_at(0, true, HANDED_MAX)), (2, None));
        assert!(flow.handed(false)[0] > HANDED_MAX && flow.multiplies_at(0, false, HANDED_MAX).is_some());
        let mut cut = diamonds(30, Gives::Each);
        (2..90).step_by(6).for_each(|at| cut[at].2 = Gives::Later);
        assert!(Flow::of(91, &links(&cut)).handed(false).iter().all(|handed| *handed < 20));
    }

    #[test]
    fn the_largest_fan_out_and_the_largest_merge_are_no_multiplication() {
        let mut of: Vec<_> = (1..2_000).map(|to| (vec![0], to, Gives::Each)).collect();
        of.push(((1..2_000).collect(), 2_000, Gives::Each));
        assert_eq!(Flow::of(2_001, &links(&of)).handed(true)[0], 2 * 1_999);
    }

    #[test]
    fn a_circle_ends_the_count() {
        let of = vec![(vec![0], 1, Gives::Each), (vec![1, 2], 2, Gives::Each)];
        assert_eq!(Flow::of(3, &links(&of)).handed(true), [1, 0, 0]);
    }
}
