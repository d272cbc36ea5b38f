//! The simulated NAO senses alike in a room that is alike.

use crate::nao::Nao;
use behaviour::{Id, Params, Value};
use robot::{Millis, Robot, SceneEdit, Use};
use serde_json::{Value as Json, json};
use simulation::SimulatedNao;

/// How far their angles may be apart, in radians.
const ANGLE: f64 = 0.02;

/// What the simulated NAO senses of a device after a second in which somebody did all that.
fn simulated(device: &str, params: &[(&str, Value)], edits: &[SceneEdit]) -> Value {
    let mut nao = SimulatedNao::new(7);
    let user = Use { run: 1, stream: Id::new("sense").unwrap() };
    let params: Params = params.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
    nao.open(&user, device, &params).unwrap();
    for edit in edits {
        nao.edit(edit).unwrap();
    }
    let mut readings = Vec::new();
    nao.poll(Millis(1_000), &mut readings);
    readings.pop().unwrap().value
}

fn alike(simulated: &Value, field: &str, told: &Json, within: f64) {
    let simulated = simulated.field(field).and_then(Value::as_number).unwrap();
    let told = told.as_f64().unwrap();
    assert!((simulated - told).abs() < within, "{field}: simulated {simulated}, told {told}");
}

#[tokio::test]
async fn balls_and_marks_are_seen_where_the_simulation_sees_them() {
    let Some(nao) = Nao::start("the stand-in beside the simulation", &[]).await else { return };
    for at in [[0.60_f32, 0.15, 0.45], [1.2, -0.3, 0.6], [0.5, 0.1, 0.4]] {
        let ball = simulated("RedBall", &[], &[SceneEdit::MoveBall { id: "red".into(), at }]);
        nao.world(json!({"balls": {"red": {"at": at}}})).await;
        let told = nao.first("ALRedBallDetection", "redBallDetected").await;
        for (part, field) in ["x", "y", "size"].into_iter().enumerate() {
            alike(&ball, field, &told[1][part], ANGLE);
        }
    }
    nao.world(json!({"balls": {"red": {"present": false}}, "landmarks": {"64": {"present": true}}})).await;
    let hung = SceneEdit::SetPresent { id: "mark64".into(), present: true };
    let mark = simulated("Landmark", &[("number", Value::Float(64.0))], &[hung]);
    let told = nao.first("ALLandMarkDetection", "LandmarkDetected").await;
    let [_, x, y, width, ..] = told[1][0][0].as_array().unwrap().as_slice() else { unreachable!("{told}") };
    alike(&mark, "x", x, ANGLE);
    alike(&mark, "y", y, ANGLE);
    alike(&mark, "size", &json!(width.as_f64().unwrap() / 2.0), ANGLE);
}

#[tokio::test]
async fn sonars_measure_what_the_simulation_measures() {
    let Some(nao) = Nao::start("sonars of the stand-in beside the simulation", &[]).await else { return };
    let moved = |at| SceneEdit::MoveObstacle { id: "box".into(), at };
    for (side, at) in [("Left", [0.6_f32, 0.2]), ("Right", [0.7, -0.3])] {
        let there = [moved(at), SceneEdit::SetPresent { id: "box".into(), present: true }];
        let side_of = Value::text(side.to_lowercase());
        let measured = simulated("Sonar", &[("side", side_of)], &there).as_number().unwrap();
        assert!(measured < 1.0, "the box is near enough to send an echo: {measured}");
        nao.world(json!({"obstacles": {"box": {"at": at, "present": true}}})).await;
        nao.call("ALSonar", "subscribe", json!(["test"])).await;
        let key = format!("Device/SubDeviceList/US/{side}/Sensor/Value");
        loop {
            let told = nao.call("ALMemory", "getData", json!([key])).await.as_f64().unwrap();
            if (told - measured).abs() < 0.02 {
                break;
            }
            assert!(told > 2.0, "{side}: simulated {measured}, told {told}");
        }
        nao.call("ALSonar", "unsubscribe", json!(["test"])).await;
    }
}
