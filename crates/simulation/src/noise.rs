//! Disturbances of the senses, seeded. All are off unless somebody turns them on.

use crate::hash::RunningHash;
use crate::sight::Sighting;

/// The errors of the camera's measurements.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// Standard deviation of angles in radians.
    pub angle: f32,
    /// Standard deviation of sizes as a fraction.
    pub size: f32,
    /// Part of the pictures in which nothing is found, 0 to 1.
    pub drop: f32,
}

/// A seeded stream of random numbers: PCG-XSH-RR 64/32 (O'Neill 2014).
pub(crate) struct Random(u64);

impl Random {
    /// A stream that only depends on the seed.
    pub(crate) fn new(seed: u64) -> Self {
        let mut random = Self(seed.wrapping_add(INCREMENT));
        random.next();
        random
    }

    fn next(&mut self) -> u32 {
        let old = self.0;
        self.0 = old.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(INCREMENT);
        let mixed = (((old >> 18) ^ old) >> 27) as u32;
        mixed.rotate_right((old >> 59) as u32)
    }

    /// 0 to below 1.
    fn part(&mut self) -> f32 {
        (self.next() >> 8) as f32 / 16_777_216.0
    }

    /// About normal with deviation 1: twelve parts added (Irwin-Hall).
    fn normal(&mut self) -> f32 {
        (0..12).map(|_| self.part()).sum::<f32>() - 6.0
    }

    /// A sighting as a disturbed camera reports it. Without noise no number is drawn.
    pub(crate) fn disturb(&mut self, noise: Noise, seen: Sighting) -> Option<Sighting> {
        if noise == Noise::default() {
            return Some(seen);
        }
        let dropped = self.part() < noise.drop;
        let (x, y) = (seen.x + noise.angle * self.normal(), seen.y + noise.angle * self.normal());
        let size = (seen.size * (1.0 + noise.size * self.normal())).clamp(0.001, 1.5);
        (!dropped).then_some(Sighting { x, y, size })
    }

    /// Adds the state.
    pub(crate) fn digest(&self, digest: &mut RunningHash) {
        digest.whole(self.0);
    }
}

const INCREMENT: u64 = 1_442_695_040_888_963_407;
