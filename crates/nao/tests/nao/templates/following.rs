//! Templates that follow a ball with head, body or an arm.

use super::case::{Case, follows};
use super::world::Change::{Ball, HeadAhead};

pub(crate) const TEMPLATES: &[&str] = &["track_far_and_close", "track_nearest_arm", "track_nearest_arm_in_time"];

const FAR: [f32; 3] = [1.60, 0.50, 0.45];
const MEDIUM: [f32; 3] = [0.65, 0.15, 0.45];
const CLOSE_LEFT: [f32; 3] = [0.32, 0.10, 0.42];
const CLOSE_RIGHT: [f32; 3] = [0.32, -0.10, 0.42];
const BEHIND: [f32; 3] = [-1.0, 0.5, 0.45];

fn ball(template: &'static str) -> Case {
    let subscribed = &[("ALRedBallDetection", "ball")];
    Case { subscribed, heard: &["redBallDetected"], ..Case::of(template) }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_far_ball_turns_the_head_and_a_close_one_the_body() {
    let phases = vec![
        follows(&[Ball("red", [1.20, 0.45, 0.45])], 1_500, &["head"], &[]),
        follows(&[Ball("red", [0.32, 0.28, 0.45])], 3_000, &["head", "turning", "standing"], &[]),
        // It stays where it is.
        follows(&[Ball("red", BEHIND)], 2_000, &["head"], &[]),
    ];
    Case { phases, ..ball("track_far_and_close") }.hold().await;
}

/// Where an arm points does not hinder the head, and the other way round.
const APART: &[&str] = &["head-yaw", "timed-yaw", "timed-angle", "angle-and-age"];

/// The graph as it was printed: its arm goes on following a ball that went away.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_printed_graph_takes_head_body_or_the_nearest_arm_and_never_forgets() {
    let phases = vec![
        follows(&[Ball("red", MEDIUM)], 1_500, &["head"], &[]),
        follows(&[Ball("red", FAR)], 1_500, &["head"], &[]),
        follows(&[Ball("red", CLOSE_LEFT)], 1_500, &["left arm"], &["head", "right arm"]),
        follows(&[Ball("red", FAR)], 3_000, &["head", "left arm"], &[]),
    ];
    Case { phases, apart: APART, step_ms: 5, ..ball("track_nearest_arm") }.hold().await;
}

/// The mended graph: after a second its arm forgets.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_graph_with_times_forgets_the_ball_after_a_second() {
    let phases = vec![
        follows(&[Ball("red", CLOSE_RIGHT)], 1_000, &["right arm"], &["left arm"]),
        follows(&[Ball("red", BEHIND)], 2_000, &["right arm"], &["left arm"]),
        follows(&[HeadAhead, Ball("red", CLOSE_LEFT)], 1_000, &["left arm"], &["right arm"]),
        follows(&[Ball("red", FAR)], 2_000, &["head"], &["left arm"]),
        follows(&[Ball("red", MEDIUM)], 1_000, &["head"], &["left arm"]),
    ];
    Case { phases, apart: APART, step_ms: 5, ..ball("track_nearest_arm_in_time") }.hold().await;
}
