//! Templates that see people or feel hands.

use super::case::{Case, Phase, Wanted, phase};
use super::log::{moved, say};
use super::world::Change::{Hand, Person};
use serde_json::json;

pub(crate) const TEMPLATES: &[&str] = &["count_my_touches", "hello_once", "goodbye", "greeter"];

const FACE: &[(&str, &str)] = &[("ALFaceDetection", "face")];
const COMES: &[super::world::Change] = &[Person("person", true)];
const ANOTHER_COMES: &[super::world::Change] = &[Person("person", false), Person("friend", true)];
const GOES: &[super::world::Change] = &[Person("person", false)];

fn faces(template: &'static str) -> Case {
    Case { subscribed: FACE, heard: &["FaceDetected"], ..Case::of(template) }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn every_touch_is_counted_aloud() {
    let phases = vec![
        phase(&[], 100, Vec::new()),
        phase(&[Hand(true)], 500, say("1")),
        phase(&[Hand(false)], 500, Vec::new()),
        phase(&[Hand(true)], 500, say("2")),
        phase(&[Hand(false)], 500, Vec::new()),
        phase(&[Hand(true)], 500, say("3")),
    ];
    let heard = &["FrontTactilTouched", "MiddleTactilTouched", "RearTactilTouched"];
    Case { phases, heard, ..Case::of("count_my_touches") }.hold().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn hello_is_said_once_to_each() {
    let phases = vec![
        phase(&[], 300, Vec::new()),
        phase(COMES, 1_000, say("Hello")),
        phase(GOES, 2_000, Vec::new()),
        phase(COMES, 2_000, Vec::new()),
        phase(ANOTHER_COMES, 1_000, say("Hello")),
    ];
    // A robot has to look for a while to tell that it does not know a face; the simulation knows at once.
    Case { phases, apart: &["another", "hello"], ..faces("hello_once") }.hold().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn goodbye_is_said_when_nobody_is_there_for_long() {
    let up = || vec![("ALMotion.setAngles", json!([["HeadPitch"], [-0.52], 0.2]))];
    let looks = || vec![moved("head")];
    let both = |changes, for_ms, wanted, perhaps| Phase { changes, for_ms, wanted: Wanted::Parts(wanted, perhaps) };
    let phases = vec![
        both(COMES, 2_000, [looks(), up()].concat(), Vec::new()),
        // It stays where it is.
        both(GOES, 3_000, looks(), Vec::new()),
        both(COMES, 2_000, Vec::new(), looks()),
        both(GOES, 9_000, [say("Goodbye"), up()].concat(), looks()),
        both(COMES, 1_000, Vec::new(), looks()),
    ];
    // Where the head of a real robot is while it looks, and so what it sees, is its own. The clock goes on while it is waited
    // for.
    Case { phases, apart: &["clock", "face"], ..faces("goodbye") }.hold().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_new_face_is_greeted_remembered_and_greeted_again() {
    let learn =
        |face: &str| Wanted::Together([say("Hello"), vec![("ALFaceDetection.learnFace", json!([face]))]].concat());
    let phases = vec![
        Phase { changes: COMES, for_ms: 12_000, wanted: learn("face 1") },
        phase(&[], 10_000, say("Hello Again")),
        Phase { changes: ANOTHER_COMES, for_ms: 10_000, wanted: learn("face 2") },
    ];
    let subscribed = &[("ALFaceDetection", "face-detection")];
    Case { phases, subscribed, again: true, ..faces("greeter") }.hold().await;
}
