//! Which lines of a long list are drawn.

use std::ops::Range;

/// The height of a line, the same as in the style sheet, in pixels.
pub(super) const LINE_PX: f64 = 72.0;
/// Lines that are drawn beyond both ends of what is seen.
const BEYOND: usize = 6;
/// The next page is asked for when so few lines are left below what is seen.
const AHEAD: usize = 20;

/// The lines to draw, out of `count`, in a box of this height that is scrolled so far, in pixels.
pub(super) fn drawn(scrolled: f64, height: f64, count: usize) -> Range<usize> {
    let first = (scrolled.max(0.0) / LINE_PX) as usize;
    let last = ((scrolled.max(0.0) + height) / LINE_PX).ceil() as usize;
    let end = (last + BEYOND).min(count);
    first.saturating_sub(BEYOND).min(end)..end
}

/// True when the next page should be asked for.
pub(super) fn is_near_end(drawn: &Range<usize>, count: usize) -> bool {
    drawn.end + AHEAD >= count
}

/// How far to scroll so that a line is seen whole, in pixels; none if it is.
pub(super) fn scroll_to(line: usize, scrolled: f64, height: f64) -> Option<f64> {
    let (top, bottom) = (line as f64 * LINE_PX, (line + 1) as f64 * LINE_PX);
    if top < scrolled {
        Some(top)
    } else if bottom > scrolled + height {
        Some(bottom - height)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::{LINE_PX, drawn, is_near_end, scroll_to};

    #[test]
    fn only_what_is_seen_is_drawn_however_long_the_list() {
        assert_eq!(drawn(0.0, 5.0 * LINE_PX, 10_000), 0..11);
        assert_eq!(drawn(100.0 * LINE_PX, 5.0 * LINE_PX, 10_000), 94..111);
        assert_eq!(drawn(1e9, 5.0 * LINE_PX, 40), 40..40);
        assert_eq!(drawn(-50.0, 0.0, 0), 0..0);
        assert!(is_near_end(&(20..35), 50) && !is_near_end(&(0..11), 50));
    }

    #[test]
    fn a_line_is_scrolled_to_the_nearer_edge() {
        assert_eq!(scroll_to(0, 0.0, 5.0 * LINE_PX), None);
        assert_eq!(scroll_to(5, 0.0, 5.0 * LINE_PX), Some(LINE_PX));
        assert_eq!(scroll_to(2, 5.0 * LINE_PX, 5.0 * LINE_PX), Some(2.0 * LINE_PX));
    }
}
