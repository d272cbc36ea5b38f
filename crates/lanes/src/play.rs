//! Playing: the cursor moves by itself, as fast as somebody chose. Time is handed in.

/// The speeds, in turn.
pub const SPEEDS: [f64; 5] = [1.0, 2.0, 4.0, 8.0, 0.5];

/// The cursor's own movement, and its speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Play {
    pub(crate) goes: bool,
    /// True while a hand moves the cursor: playing rests.
    pub(crate) is_held: bool,
    speed: usize,
}

impl Play {
    /// The factor by which it is faster than the robot was.
    pub(crate) fn speed(&self) -> f64 {
        SPEEDS[self.speed % SPEEDS.len()]
    }

    pub(crate) fn faster(&mut self) {
        self.speed = (self.speed + 1) % SPEEDS.len();
    }

    /// The cursor after so many milliseconds of the watching person; playing ends at the end of the whole.
    pub(crate) fn tick(&mut self, cursor: f64, passed: f64, length: f64) -> f64 {
        if !self.goes || self.is_held || !(passed.is_finite() && passed > 0.0) {
            return cursor;
        }
        let next = cursor + passed * self.speed();
        self.goes = next < length;
        next.min(length)
    }
}

#[cfg(test)]
mod tests {
    use super::{Play, SPEEDS};

    #[test]
    fn it_goes_as_fast_as_chosen_rests_under_a_hand_and_ends_at_the_end() {
        let mut play = Play { goes: true, ..Play::default() };
        assert_eq!(play.tick(1_000.0, 16.0, 9_000.0), 1_016.0);
        play.faster();
        assert_eq!(play.tick(1_000.0, 16.0, 9_000.0), 1_032.0);
        play.is_held = true;
        assert_eq!(play.tick(1_000.0, 16.0, 9_000.0), 1_000.0);
        play.is_held = false;
        assert_eq!((play.tick(8_999.0, 16.0, 9_000.0), play.goes), (9_000.0, false));
        assert_eq!(play.tick(5.0, 16.0, 9_000.0), 5.0, "it rests");
        let all: Vec<f64> = (0..SPEEDS.len()).map(|_| (play.faster(), play.speed()).1).collect();
        assert_eq!(all, [4.0, 8.0, 0.5, 1.0, 2.0]);
    }
}
