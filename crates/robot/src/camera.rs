//! The camera of a robot, as pictures for people. Pictures are made only while somebody looks, and kept nowhere:
//! the newest takes the place of the one before.

/// One picture of a camera.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Grows with every picture of one camera.
    pub number: u64,
    /// Width in pixels, at most [`Picture::SIDE_MAX`].
    pub width: u16,
    /// Height in pixels, at most [`Picture::SIDE_MAX`].
    pub height: u16,
    /// Red, green and blue of each pixel, from 0 to 255: row by row from the top left.
    pub rgb: Vec<u8>,
}

impl Picture {
    /// The longest side of a picture, in pixels.
    pub const SIDE_MAX: u16 = 640;

    /// A picture, if its sides are possible and there are as many bytes as they need.
    #[must_use]
    pub fn new(number: u64, [width, height]: [u16; 2], rgb: Vec<u8>) -> Option<Self> {
        let possible = |side: u16| (1..=Self::SIDE_MAX).contains(&side);
        let bytes = usize::from(width) * usize::from(height) * 3;
        (possible(width) && possible(height) && rgb.len() == bytes).then_some(Self { number, width, height, rgb })
    }
}

/// A robot's camera. It may be asked from any thread, and never makes the robot wait.
pub trait Camera: Send + Sync {
    /// Says that somebody looks from now on, or that nobody does any more. Returns at once.
    fn look(&self, looks: bool);

    /// The newest picture, if its number is greater than `after`; none if nobody looks or if there is none yet. May take some
    /// milliseconds, as a simulated camera paints it now.
    fn picture(&self, after: u64) -> Option<std::sync::Arc<Picture>>;
}

#[cfg(test)]
mod tests {
    use super::Picture;

    #[test]
    fn a_picture_has_as_many_bytes_as_its_sides_say() {
        assert!(Picture::new(1, [2, 3], vec![0; 18]).is_some());
        assert!(Picture::new(1, [2, 3], vec![0; 17]).is_none());
        assert!(Picture::new(1, [0, 3], Vec::new()).is_none());
        assert!(Picture::new(1, [641, 1], vec![0; 641 * 3]).is_none());
    }
}
