//! The axis of time: which stretch of a recording is seen, and how moments become places and back.

/// The shortest stretch that can be seen, in milliseconds.
pub const SPAN_LEAST_MS: f64 = 200.0;

/// A stretch of time that is seen, within the whole of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// The length of the whole, in milliseconds.
    length: f64,
    /// The first moment that is seen.
    begin: f64,
    /// The length of what is seen.
    span: f64,
    /// The length of what is to be seen, once there is so much.
    wanted: f64,
}

impl Axis {
    /// Makes the axis of a whole of so many milliseconds, of which the first `span` are seen.
    #[must_use]
    pub fn new(length: f64, span: f64) -> Self {
        let mut axis = Self { length: at_least(length, 0.0), begin: 0.0, span, wanted: span };
        axis.keep_within();
        axis
    }

    /// The length of the whole, in milliseconds.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The first moment that is seen.
    #[must_use]
    pub fn begin(&self) -> f64 {
        self.begin
    }

    /// The last moment that is seen.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.begin + self.span
    }

    /// The length of what is seen.
    #[must_use]
    pub fn span(&self) -> f64 {
        self.span
    }

    /// The place of a moment on a width, from the left; outside of it for a moment that is not seen.
    #[must_use]
    pub fn x(&self, t: f64, width: f64) -> f64 {
        (t - self.begin) / self.span * width
    }

    /// The moment at a place on a width, within the whole.
    #[must_use]
    pub fn t(&self, x: f64, width: f64) -> f64 {
        let share = if width > 0.0 { x / width } else { 0.0 };
        self.within(self.begin + share * self.span)
    }

    /// The nearest moment of the whole.
    #[must_use]
    pub fn within(&self, t: f64) -> f64 {
        if t.is_finite() { t.clamp(0.0, self.length) } else { 0.0 }
    }

    /// The whole grows to this length; it never shrinks.
    pub fn grow(&mut self, length: f64) {
        self.length = at_least(length, self.length);
        self.span = self.wanted;
        self.keep_within();
    }

    /// Moves what is seen by so many milliseconds, as far as there is something.
    pub fn pan(&mut self, by: f64) {
        self.begin += if by.is_finite() { by } else { 0.0 };
        self.keep_within();
    }

    /// Shows more or less around a moment, which stays at its place. A factor above 1 shows more.
    pub fn zoom(&mut self, around: f64, factor: f64) {
        if !(factor.is_finite() && factor > 0.0) {
            return;
        }
        let share = (around - self.begin) / self.span;
        self.span = (self.span * factor).clamp(SPAN_LEAST_MS, self.most());
        self.wanted = self.span;
        self.begin = around - share * self.span;
        self.keep_within();
    }

    /// Shows the stretch between two moments, in either order.
    pub fn show(&mut self, one: f64, other: f64) {
        (self.begin, self.span) = (one.min(other), (one - other).abs());
        self.wanted = self.span;
        self.keep_within();
    }

    /// Brings a moment into view where it is not seen, a tenth of the stretch from the nearer end.
    pub fn reveal(&mut self, t: f64) {
        let margin = self.span / 10.0;
        if t < self.begin {
            self.begin = t - margin;
        } else if t > self.end() {
            self.begin = t + margin - self.span;
        }
        self.keep_within();
    }

    /// Moves what is seen so that it ends with the whole.
    pub fn follow_end(&mut self) {
        self.begin = self.length - self.span;
        self.keep_within();
    }

    fn most(&self) -> f64 {
        at_least(self.length, SPAN_LEAST_MS)
    }

    fn keep_within(&mut self) {
        let span = if self.span.is_finite() { self.span } else { self.most() };
        self.span = span.clamp(SPAN_LEAST_MS, self.most());
        let begin = if self.begin.is_finite() { self.begin } else { 0.0 };
        self.begin = begin.min(self.length - self.span).max(0.0);
    }
}

fn at_least(value: f64, least: f64) -> f64 {
    if value.is_finite() { value.max(least) } else { least }
}

#[cfg(test)]
mod tests {
    use super::{Axis, SPAN_LEAST_MS};

    #[test]
    fn a_zoom_keeps_the_moment_under_the_pointer() {
        let mut axis = Axis::new(600_000.0, 60_000.0);
        axis.pan(100_000.0);
        let under = axis.t(250.0, 1_000.0);
        axis.zoom(under, 0.5);
        assert_eq!((axis.span(), axis.x(under, 1_000.0)), (30_000.0, 250.0));
        axis.zoom(under, 2.0);
        assert_eq!((axis.begin(), axis.span()), (100_000.0, 60_000.0));
    }

    #[test]
    fn nothing_outside_of_the_whole_is_seen() {
        let mut axis = Axis::new(10_000.0, 60_000.0);
        assert_eq!((axis.begin(), axis.end()), (0.0, 10_000.0));
        axis.zoom(5_000.0, 1e-9);
        assert_eq!(axis.span(), SPAN_LEAST_MS);
        axis.pan(1e12);
        assert_eq!(axis.end(), 10_000.0);
        axis.pan(-1e12);
        assert_eq!(axis.begin(), 0.0);
        [f64::NAN, f64::INFINITY, 0.0, -1.0].into_iter().for_each(|odd| {
            axis.zoom(0.0, odd);
            axis.pan(f64::NAN);
        });
        assert_eq!((axis.begin(), axis.span()), (0.0, SPAN_LEAST_MS));
        assert_eq!((axis.t(f64::NAN, 10.0), axis.t(5.0, 0.0)), (0.0, 0.0));
    }

    #[test]
    fn an_empty_whole_has_a_stretch_all_the_same() {
        let axis = Axis::new(0.0, 0.0);
        assert_eq!((axis.begin(), axis.span(), axis.x(0.0, 100.0)), (0.0, SPAN_LEAST_MS, 0.0));
    }

    #[test]
    fn what_goes_on_grows_and_is_followed() {
        let mut axis = Axis::new(0.0, 60_000.0);
        axis.grow(90_000.0);
        axis.grow(10.0);
        assert_eq!(axis.length(), 90_000.0, "it never shrinks");
        axis.show(0.0, 60_000.0);
        axis.grow(100_000.0);
        axis.follow_end();
        assert_eq!((axis.begin(), axis.end()), (40_000.0, 100_000.0));
    }

    #[test]
    fn a_moment_that_is_not_seen_is_revealed_and_one_that_is_stays() {
        let mut axis = Axis::new(100_000.0, 10_000.0);
        axis.reveal(5_000.0);
        assert_eq!(axis.begin(), 0.0);
        axis.reveal(50_000.0);
        assert_eq!(axis.end(), 51_000.0);
        axis.reveal(20_000.0);
        assert_eq!(axis.begin(), 19_000.0);
    }
}
