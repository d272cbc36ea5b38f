//! Templates that look at balls of three colours, or at how far one is.

use super::case::{Case, phase};
use super::log::{bright, eyes, say};
use super::world::Change::{self, Ball, Hand};

pub(crate) const TEMPLATES: &[&str] = &[
    "reflect_ball_color",
    "say_ball_color",
    "say_ball_color_merge",
    "distance_to_brightness",
    "touch_to_tell_the_color",
];

/// In view of a robot that looks ahead.
const AHEAD: [f32; 3] = [0.60, 0.0, 0.45];
const LEFT_BEHIND: [f32; 3] = [-1.0, 0.5, 0.45];
const RIGHT_BEHIND: [f32; 3] = [-1.0, -0.5, 0.45];
/// The red ball is in view at first; then green and blue come instead.
const GREEN_COMES: &[Change] = &[Ball("red", LEFT_BEHIND), Ball("green", AHEAD)];
const BLUE_COMES: &[Change] = &[Ball("green", RIGHT_BEHIND), Ball("blue", AHEAD)];

/// Three senses of colours on the one detector that there is.
const COLORS: &[(&str, &str)] = &[
    ("ALColorBlobDetection", "red-ball"),
    ("ALColorBlobDetection", "green-ball"),
    ("ALColorBlobDetection", "blue-ball"),
];

/// Red, green and blue as the detector is told them.
const LOOKED_FOR: &[[i32; 4]] = &[[230, 40, 40, 90], [40, 200, 60, 90], [40, 80, 230, 90]];

fn colors(template: &'static str) -> Case {
    Case { again: true, subscribed: COLORS, colors: LOOKED_FOR, ..Case::of(template) }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_eyes_take_the_color_of_the_ball() {
    let phases = vec![
        phase(&[], 1_000, eyes(0xFF_0000)),
        phase(GREEN_COMES, 1_000, eyes(0x00_FF00)),
        phase(BLUE_COMES, 1_000, eyes(0x00_00FF)),
    ];
    Case { phases, ..colors("reflect_ball_color") }.hold().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_color_is_said_each_second() {
    let phases = vec![
        phase(&[], 2_000, say("Red")),
        phase(GREEN_COMES, 2_000, say("Green")),
        phase(BLUE_COMES, 2_000, say("Blue")),
    ];
    Case { phases, ..colors("say_ball_color") }.hold().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn merged_colors_are_said_by_one_action() {
    let phases = vec![
        phase(&[], 2_000, say("red")),
        phase(GREEN_COMES, 2_000, say("green")),
        phase(BLUE_COMES, 2_000, say("blue")),
    ];
    Case { phases, ..colors("say_ball_color_merge") }.hold().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_touch_tells_the_color_that_was_seen_last() {
    let phases = vec![
        phase(&[], 500, Vec::new()),
        phase(&[Hand(true)], 500, say("red")),
        phase(&[Hand(false), Ball("red", LEFT_BEHIND), Ball("green", AHEAD)], 500, Vec::new()),
        phase(&[Hand(true)], 500, say("green")),
        phase(&[Hand(false), Ball("green", RIGHT_BEHIND)], 500, Vec::new()),
        phase(&[Hand(true)], 500, say("green")),
    ];
    let heard = &["FrontTactilTouched", "MiddleTactilTouched", "RearTactilTouched"];
    Case { phases, heard, again: false, ..colors("touch_to_tell_the_color") }.hold().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_eyes_shine_brighter_as_the_ball_comes_nearer() {
    let phases = vec![
        phase(&[Ball("red", [1.05, 0.0, 0.45])], 1_000, bright(0.2)),
        phase(&[Ball("red", AHEAD)], 1_000, bright(0.65)),
        phase(&[Ball("red", [0.35, 0.0, 0.45])], 1_000, bright(0.9)),
    ];
    let subscribed = &[("ALRedBallDetection", "ball")];
    let heard = &["redBallDetected"];
    Case { phases, subscribed, heard, again: true, ..Case::of("distance_to_brightness") }.hold().await;
}
