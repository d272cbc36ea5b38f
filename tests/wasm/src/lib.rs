//! Exports for the determinism test: a scripted story on the simulated robot as a number, runs of behaviours as text.

#[path = "../../../crates/engine/tests/oracle/chance.rs"]
mod chance;
#[path = "../../../crates/engine/tests/oracle/graphs.rs"]
mod graphs;
pub mod runs;

use behaviour::{Id, Params, Value};
use robot::{Millis, Robot, SceneEdit, Touchable, Use};
use simulation::{Noise, SimulatedNao};

/// What happens in the story: every beat is 20 ms.
const BEAT_MS: u64 = 20;
/// The robot's step.
const STEP_MS: u64 = 10;

/// The fingerprint of a robot after `steps` steps of 10 ms of the story.
#[unsafe(no_mangle)]
pub extern "C" fn simulation_hash(seed: u64, steps: u32) -> u64 {
    let mut nao = SimulatedNao::new(seed);
    open_all(&mut nao);
    let (end, mut readings) = (u64::from(steps) * STEP_MS, Vec::new());
    for beat in 0..end.div_ceil(BEAT_MS) {
        happen(&mut nao, beat);
        nao.poll(Millis((beat + 1) * BEAT_MS).min(Millis(end)), &mut readings);
    }
    // What was sensed counts too, not only where everything ended.
    readings.iter().fold(nao.state_hash(), |hash, reading| {
        let words = format!("{} {} {}", reading.to.stream, reading.at.0, reading.value);
        words.bytes().fold(hash, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    })
}

/// What a run of a behaviour says: the address of its bytes and, in the lower half, how many there are.
#[unsafe(no_mangle)]
pub extern "C" fn engine_says(case: u32, frame_ms: u32) -> u64 {
    let said = runs::said(case, frame_ms).leak();
    ((said.as_ptr().addr() as u64) << 32) | said.len() as u64
}

fn user(stream: &str) -> Option<Use> {
    Id::new(stream).ok().map(|stream| Use { run: 1, stream })
}

fn open_all(nao: &mut SimulatedNao) {
    nao.set_noise(Noise { angle: 0.004, size: 0.02, drop: 0.1 });
    open(nao, "walk", "Tracker", &[("mode", "Move"), ("effector", "Nearest")]);
    open(nao, "say", "SayInput", &[]);
    open(nao, "face", "FaceDetection", &[]);
    open(nao, "learn", "RememberFace", &[]);
    open(nao, "ball", "RedBall", &[]);
    open(nao, "touch", "HeadTouch", &[("release", "yes")]);
    open(nao, "yaw", "JointPosition", &[("joint", "HeadYaw")]);
    for device in robot::sensors().chain(robot::actuators()) {
        open(nao, &format!("every_{}", device.name.to_lowercase()), device.name, &[]);
    }
}

fn open(nao: &mut SimulatedNao, stream: &str, device: &str, params: &[(&str, &str)]) {
    let params: Params = params.iter().map(|(name, value)| ((*name).to_owned(), Value::text(value))).collect();
    let _refused = user(stream).map(|user| nao.open(&user, device, &params));
}

fn tell(nao: &mut SimulatedNao, stream: &str, value: &Value) {
    let now = nao.time();
    let _refused = user(stream).map(|user| nao.command(&user, value, now));
}

/// The red ball swings to the sides, the green one is thrown, a child comes and is learned, a hand strokes the head.
fn happen(nao: &mut SimulatedNao, beat: u64) {
    let aside = 0.4 * libm::sinf(beat as f32 * 0.02);
    let _refused = nao.edit(&SceneEdit::MoveBall { id: "red".to_owned(), at: [1.1, aside, 0.45] });
    if !(150..300).contains(&beat) {
        tell(nao, "walk", &Value::Bool(true));
    }
    match beat {
        2 | 15 => tell(nao, "say", &Value::Int(beat.cast_signed())),
        3 => drop(nao.edit(&SceneEdit::SetPresent { id: "person".to_owned(), present: true })),
        5 => drop(nao.throw_ball("green", [-2.0, -1.5, 1.0])),
        12 | 14 => drop(nao.edit(&SceneEdit::Touch { part: Touchable::HeadFront, down: beat == 12 })),
        18 => tell(nao, "learn", &Value::Bool(true)),
        50..60 => happen_in_the_room(nao, beat),
        40 => tell(nao, "every_animation", &Value::Bool(true)),
        130 => tell(nao, "every_sound", &Value::Bool(true)),
        150..200 => tell(nao, "every_walk", &Value::object([("x", 0.05.into()), ("turn", (-0.1).into())])),
        200 => tell(nao, "every_posture", &Value::Bool(true)),
        300 => drop(nao.edit(&SceneEdit::Push)),
        370 => drop(nao.edit(&SceneEdit::HelpUp)),
        _ => {}
    }
}

/// Things and marks come, somebody speaks and claps, the battery is half empty.
fn happen_in_the_room(nao: &mut SimulatedNao, beat: u64) {
    let id = |id: &str| id.to_owned();
    let edit = match beat {
        50 => SceneEdit::MoveObstacle { id: id("box"), at: [0.9, -0.5] },
        51 => SceneEdit::SetPresent { id: id("box"), present: true },
        52 => SceneEdit::SetPresent { id: id("mark64"), present: true },
        53 => SceneEdit::MoveLandmark { id: id("mark64"), at: [1.0, 0.1, 0.5], facing: 3.0 },
        54 => SceneEdit::Speak { words: id("well, yes") },
        55 => SceneEdit::Noise { at: [0.5, 1.0, 0.3] },
        56 => SceneEdit::SetBattery { percent: 50 },
        57 => SceneEdit::SetPresent { id: id("friend"), present: true },
        58 => SceneEdit::Plug { plugged: true },
        _ => return,
    };
    drop(nao.edit(&edit));
}
