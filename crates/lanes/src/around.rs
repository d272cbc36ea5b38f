//! The values of a lane around a moment, for a table beside the drawing.

use crate::dots::Dot;

/// The most values of the table.
pub const AROUND_MAX: usize = 9;
/// The number of them that came before the moment, or at it.
const BEFORE: usize = 5;

/// The values around a moment, the earliest first, and the place of the newest until then.
pub(crate) fn around(dots: &[Dot], cursor: f64) -> (&[Dot], Option<usize>) {
    around_of(dots, cursor, |dot| dot.t)
}

/// Finds the same of anything that has a moment.
pub(crate) fn around_of<T>(all: &[T], cursor: f64, t: impl Fn(&T) -> f64) -> (&[T], Option<usize>) {
    let until = all.partition_point(|one| t(one) <= cursor);
    let last = (until.saturating_sub(BEFORE) + AROUND_MAX).min(all.len());
    let first = last.saturating_sub(AROUND_MAX);
    (&all[first..last], until.checked_sub(first + 1))
}

#[cfg(test)]
mod tests {
    use super::around;
    use crate::dots::Dot;

    #[test]
    fn the_table_holds_what_came_before_and_after() {
        let dots: Vec<Dot> =
            (0..100).map(|at| Dot { t: f64::from(at) * 10.0, number: None, text: "".into() }).collect();
        let table = |cursor| {
            let (all, newest) = around(&dots, cursor);
            (all.first().map(|dot| dot.t), all.len(), newest.map(|newest| all[newest].t))
        };
        assert_eq!(table(505.0), (Some(460.0), 9, Some(500.0)));
        assert_eq!(table(0.0), (Some(0.0), 9, Some(0.0)));
        assert_eq!(table(-1.0), (Some(0.0), 9, None));
        assert_eq!(table(1e9), (Some(910.0), 9, Some(990.0)));
        assert!(around(&[], 5.0).0.is_empty());
    }
}
