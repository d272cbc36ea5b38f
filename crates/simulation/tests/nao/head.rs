//! The head and the body follow what the camera sees.

use super::bench::Bench;
use robot::Robot;

fn following(mode: &str) -> Bench {
    let mut bench = Bench::new();
    bench.open("tracker", "Tracker", &[("target", "RedBall"), ("mode", mode)]);
    bench
}

#[test]
fn the_head_turns_to_the_ball_and_settles_on_it() {
    let mut bench = following("Head");
    for at in [[0.6, 0.15, 0.45], [0.8, -0.1, 0.40], [0.5, 0.1, 0.55], [1.2, 0.3, 0.35]] {
        bench.ball("red", at);
        bench.keep("tracker", true, 1_500);
        let off = bench.joint("HeadYaw") - bench.bearing(at);
        assert!(off.abs() < 0.02, "{at:?}: {off}");
        let body = bench.nao.scene().body;
        assert_eq!(body.tracking, "red ball with head");
        assert!((body.gaze[3] - body.joints[0]).abs() < 1e-3);
    }
}

#[test]
fn a_step_of_24_degrees_settles_in_a_third_of_a_second() {
    let mut bench = following("Head");
    bench.ball("red", [1.0, 0.0, 0.5]);
    bench.keep("tracker", true, 1_000);
    let aside = 24.0_f32.to_radians();
    let at = [libm::cosf(aside), libm::sinf(aside), 0.5];
    bench.ball("red", at);
    bench.tell("tracker", true);
    let mut settled = 0;
    for ms in (10..1_000).step_by(10) {
        bench.wait(10);
        if (bench.joint("HeadYaw") - aside).abs() > 2.0_f32.to_radians() {
            settled = ms + 10;
        }
    }
    assert!((230..=430).contains(&settled), "{settled} ms");
}

#[test]
fn a_slowly_moving_ball_is_followed() {
    let mut bench = following("Head");
    for beat in 0..60 {
        let aside = 0.6 * libm::sinf(beat as f32 * 0.1);
        let at = [0.8 * libm::cosf(aside), 0.8 * libm::sinf(aside), 0.45];
        bench.ball("red", at);
        bench.keep("tracker", true, 100);
        if beat > 10 {
            let off = bench.joint("HeadYaw") - aside;
            assert!(off.abs() < 0.08, "{beat}: {off}");
        }
    }
}

#[test]
fn without_values_it_stops_following_after_a_second() {
    let mut bench = following("Head");
    bench.keep("tracker", true, 1_000);
    bench.wait(1_100);
    assert_eq!(bench.nao.scene().body.tracking, "");
    let held = bench.joint("HeadYaw");
    bench.ball("red", [0.6, -0.1, 0.45]);
    bench.wait(2_000);
    assert!((bench.joint("HeadYaw") - held).abs() < 1e-4);
}

#[test]
fn a_lost_ball_keeps_the_last_direction() {
    let mut bench = following("Head");
    bench.keep("tracker", true, 1_000);
    let held = bench.joint("HeadYaw");
    bench.ball("red", [-1.0, 0.0, 0.45]);
    bench.keep("tracker", true, 1_000);
    assert!((bench.joint("HeadYaw") - held).abs() < 1e-3);
}

#[test]
fn the_whole_body_turns_to_face_the_ball() {
    let mut bench = following("WholeBody");
    bench.ball("red", [0.8, 0.35, 0.45]);
    bench.keep("tracker", true, 2_000);
    bench.ball("red", [0.6, 0.6, 0.45]);
    bench.keep("tracker", true, 8_000);
    assert!(bench.bearing([0.6, 0.6, 0.45]).abs() < 0.15, "{:?}", bench.nao.scene().body.base);
    assert!((bench.joint("HeadYaw") - bench.bearing([0.6, 0.6, 0.45])).abs() < 0.02);
}

#[test]
fn it_walks_to_the_ball_and_stands_before_it() {
    let mut bench = following("Move");
    let at = [1.5, 0.4, 0.45];
    bench.ball("red", at);
    bench.keep("tracker", true, 5_000);
    let [x, y, _] = bench.nao.scene().body.base;
    assert!(libm::hypotf(x, y) < 0.5, "no faster than 0.1 m/s");
    bench.keep("tracker", true, 20_000);
    let [x, y, _] = bench.nao.scene().body.base;
    let left = libm::hypotf(at[0] - x, at[1] - y);
    assert!((0.30..0.40).contains(&left), "{left}");
}

#[test]
fn it_does_not_walk_into_a_person() {
    let mut bench = Bench::new();
    bench.open("tracker", "Tracker", &[("target", "Face"), ("mode", "Move")]);
    bench.person([1.6, 0.0], true);
    bench.keep("tracker", true, 30_000);
    let x = bench.nao.scene().body.base[0];
    assert!((0.3..1.3).contains(&x), "{x}");
}

#[test]
fn stop_holds_at_once_and_later_values_work_again() {
    let mut bench = following("Move");
    bench.open("voice", "SayInput", &[]);
    bench.ball("red", [1.5, 0.5, 0.45]);
    bench.keep("tracker", true, 500);
    bench.tell("voice", "one two three four five six");
    bench.wait(50);
    bench.nao.stop(robot::Millis(bench.now));
    let before = bench.nao.scene().body;
    bench.wait(2_000);
    let after = bench.nao.scene().body;
    assert_eq!((before.joints, before.base), (after.joints, after.base));
    assert_eq!((after.saying.as_str(), after.tracking.as_str()), ("", ""));
    assert_eq!(bench.nao.health(), robot::Health::Safe);
    bench.keep("tracker", true, 3_000);
    assert!(bench.nao.scene().body.base[0] > 0.05);
    assert_eq!(bench.nao.health(), robot::Health::Ready);
}
