//! Sorting what is short: what people see as a list, not what may fill a graph.

/// Sorts a few things so that none is `before` the one in front of it; what is equal stays in its order.
///
/// The sort of the standard library is 4 KB of the page for every type that is sorted; this one is a few dozen bytes, and as fast
/// for some hundred things.
pub fn sort_few<T>(few: &mut [T], before: impl Fn(&T, &T) -> bool) {
    for end in 1..few.len() {
        let mut at = end;
        while at > 0 && before(&few[at], &few[at - 1]) {
            few.swap(at, at - 1);
            at -= 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::sort_few;

    #[test]
    fn what_is_equal_stays_in_its_order() {
        let mut few = [(3, 'a'), (1, 'b'), (3, 'c'), (2, 'd'), (1, 'e')];
        sort_few(&mut few, |one, other| one.0 < other.0);
        assert_eq!(few, [(1, 'b'), (1, 'e'), (2, 'd'), (3, 'a'), (3, 'c')]);
        sort_few::<u8>(&mut [], |_, _| true);
    }
}
