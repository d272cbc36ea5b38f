//! Templates that follow a ball with head, body or an arm.

use super::case::{Case, Phase, Wanted, phase};
use super::log::{track, untrack};
use super::world::Change::{self, Ball, HeadAhead};

pub(crate) const TEMPLATES: &[&str] = &["track_far_and_close", "track_nearest_arm", "track_nearest_arm_in_time"];

const FAR: [f32; 3] = [1.60, 0.50, 0.45];
const MEDIUM: [f32; 3] = [0.65, 0.15, 0.45];
const CLOSE_LEFT: [f32; 3] = [0.32, 0.10, 0.42];
const CLOSE_RIGHT: [f32; 3] = [0.32, -0.10, 0.42];
const BEHIND: [f32; 3] = [-1.0, 0.5, 0.45];

/// The head of a real robot follows too when an arm does: where the head is, and what it sees of a close ball, is its own.
const APART: &[&str] = &[
    "ball",
    "distance",
    "seen",
    "close",
    "head-yaw",
    "ball-angle",
    "arm-angle",
    "timed-yaw",
    "timed-angle",
    "angle-and-age",
    "recent",
];

fn ball(template: &'static str) -> Case {
    let subscribed = &[("ALRedBallDetection", "ball")];
    Case { subscribed, heard: &["redBallDetected"], ..Case::of(template) }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_far_ball_turns_the_head_and_a_close_one_the_body() {
    let phases = vec![
        phase(&[Ball("red", [1.20, 0.45, 0.45])], 1_500, track("Head", "None")),
        phase(&[Ball("red", [0.32, 0.28, 0.45])], 3_000, track("WholeBody", "None")),
        phase(&[Ball("red", BEHIND)], 2_000, untrack()),
    ];
    Case { phases, ..ball("track_far_and_close") }.hold().await;
}

/// An arm at last: while the head turns, which is told a moment later, it may be the other one.
fn nearest(changes: &'static [Change], for_ms: u64, arm: &str, other: &str) -> Phase {
    Phase { changes, for_ms, wanted: Wanted::AtLast(track("Head", arm), track("Head", other)) }
}

/// The graph as it was printed: its arm goes on following a ball that went away.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_printed_graph_takes_head_body_or_the_nearest_arm_and_never_forgets() {
    let (head, arm) = (track("Head", "None"), track("Head", "LArm"));
    let phases = vec![
        phase(&[Ball("red", MEDIUM)], 1_500, track("WholeBody", "None")),
        phase(&[Ball("red", FAR)], 1_500, head.clone()),
        nearest(&[Ball("red", CLOSE_LEFT)], 1_500, "LArm", "RArm"),
        Phase { changes: &[Ball("red", FAR)], for_ms: 3_000, wanted: Wanted::All(vec![head, arm]) },
    ];
    Case { phases, apart: APART, step_ms: 5, ending: untrack(), ..ball("track_nearest_arm") }.hold().await;
}

/// The mended graph: after a second its arm forgets.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_graph_with_times_forgets_the_ball_after_a_second() {
    let (head, arm) = (track("Head", "None"), track("Head", "LArm"));
    let phases = vec![
        nearest(&[Ball("red", CLOSE_RIGHT)], 1_000, "RArm", "LArm"),
        phase(&[Ball("red", BEHIND)], 2_000, untrack()),
        nearest(&[HeadAhead, Ball("red", CLOSE_LEFT)], 1_000, "LArm", "RArm"),
        Phase { changes: &[Ball("red", FAR)], for_ms: 2_000, wanted: Wanted::AtLast(head, arm) },
        phase(&[Ball("red", MEDIUM)], 1_000, track("WholeBody", "None")),
    ];
    Case { phases, apart: APART, step_ms: 5, ending: untrack(), ..ball("track_nearest_arm_in_time") }.hold().await;
}
