//! Plays of a child, each by its seed: when it comes, from where, how near, how long it stays, when it goes, and when the
//! robot finds no face though it is there.

use house::rehearsal::{Blind, Script};
use robot::{Millis, SceneEdit, Touchable};
use std::ops::Range;

/// Plays that every template is held to.
pub(crate) const PLAYS: u64 = 200;
/// The longest that a child turns its face away so that the robot finds none, in milliseconds.
const BLIND_MAX_MS: u64 = 5_500;

/// How long a hand stays on the head, in milliseconds.
const TOUCH_MS: u64 = 200;

/// What a child does.
pub(crate) struct Play {
    pub(crate) script: Vec<(Millis, SceneEdit)>,
    pub(crate) blind: Vec<Range<u64>>,
    /// From when to when it is there.
    pub(crate) there: Range<u64>,
    /// When it lays its hand on the head.
    pub(crate) touches: Vec<u64>,
}

impl Play {
    pub(crate) fn script(&self) -> &Script {
        &self.script
    }

    pub(crate) fn blind(&self) -> &Blind {
        &self.blind
    }

    /// The play of a seed: the child comes in view of a robot that looks ahead and up, walks on a little now and then, moves
    /// the red ball, touches the head, and goes.
    pub(crate) fn of(seed: u64) -> Self {
        let mut chance = Chance(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        let from = chance.between(2_500, 4_000);
        let to = from + chance.between(6_000, 18_000);
        let mut at = (chance.between(42, 280) as f32 / 100.0, chance.signed(0.40));
        let person = |at: (f32, f32)| {
            let (sin, cos) = at.1.sin_cos();
            SceneEdit::MovePerson { id: "person".into(), at: [at.0 * cos, at.0 * sin] }
        };
        let present = |present| SceneEdit::SetPresent { id: "person".into(), present };
        let mut script = vec![(Millis(from), person(at)), (Millis(from), present(true))];
        let mut now = from + chance.between(1_500, 4_000);
        let blind = chance.blind(from..to);
        while now + 1_000 < to {
            // It stands still while its face is turned away.
            if blind.iter().any(|time| time.contains(&now)) {
                now += 100;
                continue;
            }
            at = ((at.0 + chance.signed(0.5)).clamp(0.4, 2.8), (at.1 + chance.signed(0.25)).clamp(-0.9, 0.9));
            script.push((Millis(now), person(at)));
            now += chance.between(1_500, 4_000);
        }
        script.push((Millis(to), present(false)));
        let touches = chance.touches(from..to);
        let hand = |down| SceneEdit::Touch { part: Touchable::HeadFront, down };
        script.extend(touches.iter().flat_map(|at| [(Millis(*at), hand(true)), (Millis(at + TOUCH_MS), hand(false))]));
        script.extend(chance.ball(from..to));
        Self { script, blind, there: from..to, touches }
    }
}

/// Numbers by a seed, the same everywhere (xorshift).
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn between(&mut self, least: u64, most: u64) -> u64 {
        least + self.next() % (most - least + 1)
    }

    /// From `-most` to `most`.
    fn signed(&mut self, most: f32) -> f32 {
        (self.between(0, 2_000) as f32 / 1_000.0 - 1.0) * most
    }

    /// Two plays of three have times in which no face is found, long and short ones.
    fn blind(&mut self, there: Range<u64>) -> Vec<Range<u64>> {
        let (mut all, mut at) = (Vec::new(), there.start + self.between(500, 3_000));
        if self.next().is_multiple_of(3) {
            return all;
        }
        while at < there.end {
            let long = if self.next().is_multiple_of(4) { BLIND_MAX_MS } else { 600 };
            let end = at + self.between(10, long);
            all.push(at..end);
            at = end + self.between(1_000, 4_000);
        }
        all
    }

    fn touches(&mut self, there: Range<u64>) -> Vec<u64> {
        let (mut all, mut at) = (Vec::new(), there.start + self.between(300, 4_000));
        while at + TOUCH_MS < there.end {
            all.push(at);
            at += self.between(800, 6_000);
        }
        all
    }

    /// The red ball goes here and there: near and far, in view and out of it.
    fn ball(&mut self, there: Range<u64>) -> Vec<(Millis, SceneEdit)> {
        let (mut all, mut at) = (Vec::new(), there.start);
        while at < there.end {
            let far = self.between(30, 160) as f32 / 100.0;
            let (sin, cos) = self.signed(0.9).sin_cos();
            let to = [far * cos, far * sin, 0.40 + self.signed(0.08)];
            all.push((Millis(at), SceneEdit::MoveBall { id: "red".into(), at: to }));
            at += self.between(500, 4_000);
        }
        all
    }
}
