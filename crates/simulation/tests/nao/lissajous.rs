//! A ball on a Lissajous path is kept in the middle by commands computed from what is seen.

use crate::bench::{Bench, number, user};
use behaviour::Value;

/// The frequencies at which the ball goes to and fro, and up and down, in hertz.
const HZ: [f32; 2] = [0.1, 0.15];
const STEP_MS: u64 = 10;
const UNTIL_MS: u64 = 60_000;

fn path(ms: u64) -> [f32; 3] {
    let swing = |hz: f32| libm::sinf(core::f32::consts::TAU * hz * ms as f32 / 1_000.0);
    let (aside, up) = (0.5 * swing(HZ[0]), 0.08 * swing(HZ[1]));
    [0.8 * libm::cosf(aside), 0.8 * libm::sinf(aside), 0.48 + up]
}

#[test]
fn a_ball_on_a_lissajous_path_is_kept_in_the_middle() {
    let mut bench = Bench::new();
    bench.open("ball", "ColorBall", &[("color", "red")]);
    bench.open("head", "SetJointPosition", &[("joint", "Head")]);
    let (mut off, mut widest) = (Vec::new(), 0.0_f32);
    while bench.now < UNTIL_MS {
        bench.ball("red", path(bench.now));
        bench.wait(STEP_MS);
        for seen in bench.values("ball") {
            let (x, y) = (number(&seen, "x"), number(&seen, "y"));
            let angles = [bench.joint("HeadYaw") + x, bench.joint("HeadPitch") + y];
            bench.tell("head", Value::list(angles.map(|angle| Value::Float(f64::from(angle)))));
            off.push(x.abs());
            widest = widest.max(bench.joint("HeadYaw").abs());
        }
    }
    assert!(off.len() as u64 >= 29 * UNTIL_MS / 1_000, "{} pictures of {:?}", off.len(), user("ball"));
    let mean = off.iter().sum::<f32>() / off.len() as f32;
    assert!(mean < 0.1, "{mean}");
    assert!(widest > 0.4, "the head went with it: {widest}");
}
