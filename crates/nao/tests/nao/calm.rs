//! Nothing goes on without us: what the robot does ends by itself, whatever became of who began it.

use crate::harm::{ACTIVITIES, HARMS, calm_after, drive_if_told};
use std::io::Write;

/// The arguments with which this program is started to drive a robot until it is killed.
const DRIVES: &[&str] = &["calm::drives_until_it_is_killed", "--exact", "--ignored"];

#[test]
#[ignore = "the process that is killed, started by the tests below"]
fn drives_until_it_is_killed() {
    drive_if_told();
}

/// After every harm; the table is on the standard error.
async fn ends(number: usize) {
    let activity = ACTIVITIES[number];
    let (mut row, mut late) = (format!("{:<22}", activity.name), Vec::new());
    for ((name, harm), late_ms) in HARMS.into_iter().zip([0, 90, 180, 270, 360, 450, 540]) {
        let Some(ms) = calm_after(DRIVES, &activity, harm, late_ms).await else { return };
        row.push_str(&format!("{name} {ms:.0} ms  "));
        if ms > activity.within_ms {
            late.push(format!("{name}: {ms:.0} ms"));
        }
    }
    let _ = writeln!(std::io::stderr(), "{row}");
    assert!(late.is_empty(), "{} goes on for more than {} ms: {late:?}", activity.name, activity.within_ms);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_walk_ends_by_itself() {
    ends(0).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_body_that_turns_after_a_ball_ends_by_itself() {
    ends(1).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_walk_after_a_ball_ends_by_itself() {
    ends(2).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_arm_that_points_ends_by_itself() {
    ends(3).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn speech_ends_by_itself() {
    ends(4).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_sound_ends_by_itself() {
    ends(5).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_gesture_ends_by_itself() {
    ends(6).await;
}
