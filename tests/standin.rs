//! The stand-in for a NAO on the real libqi, of which other tests believe what it does: `standin/nao.py`.

use house::skip;
use qi::{Event, Keep, Object, Options, QiError, Session, Subscription, Value};
use serde_json::{Value as Json, json};
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// How long anything may take before a test gives up.
const PATIENCE: Duration = Duration::from_secs(60);
/// Of everything that is asked again and again.
const PAUSE: Duration = Duration::from_millis(20);

/// What a NAO has, of what we use.
const SERVICES: [&str; 31] = [
    "ALAnimatedSpeech",
    "ALAnimationPlayer",
    "ALAudioDevice",
    "ALAudioPlayer",
    "ALAutonomousBlinking",
    "ALAutonomousLife",
    "ALBackgroundMovement",
    "ALBasicAwareness",
    "ALBattery",
    "ALBehaviorManager",
    "ALBodyTemperature",
    "ALColorBlobDetection",
    "ALFaceDetection",
    "ALLandMarkDetection",
    "ALLeds",
    "ALListeningMovement",
    "ALMemory",
    "ALMotion",
    "ALPeoplePerception",
    "ALRedBallDetection",
    "ALRobotModel",
    "ALRobotPosture",
    "ALSonar",
    "ALSoundLocalization",
    "ALSpeakingMovement",
    "ALSpeechRecognition",
    "ALSystem",
    "ALTextToSpeech",
    "ALTracker",
    "ALVideoDevice",
    "StandIn",
];

/// A robot that is not one, and a session with it; it ends when this is dropped.
struct Nao {
    child: Child,
    session: Session,
}

impl Nao {
    /// Starts one, unless there is no libqi, which is said by name as `part`.
    async fn start(part: &str, words: &[&str]) -> Option<Self> {
        let python = std::env::var_os("RRP_QI_PYTHON").map(PathBuf::from).filter(|path| path.is_file());
        let missing = "there is no libqi; `cargo xtask qi` makes one, and RRP_QI_PYTHON names it";
        if !skip::possible(part, python.is_none().then(|| missing.to_owned())) {
            return None;
        }
        let mut command = Command::new(python.unwrap());
        command.arg(house::root().join("tests/standin/nao.py")).args(words);
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let address = lines.next().unwrap().unwrap();
        let address = address.strip_prefix("listening ").unwrap();
        let options = Options { stage_within: PATIENCE, call_within: PATIENCE, ..Options::default() };
        let session = Session::connect(&address.parse().unwrap(), options).await.unwrap();
        Some(Self { child, session })
    }

    async fn service(&self, name: &str) -> Object {
        self.session.service(name).await.unwrap().within(PATIENCE)
    }

    /// Calls a method; text, numbers, truths and lists of JSON are its arguments.
    async fn try_call(&self, service: &str, method: &str, arguments: Json) -> Result<Value, QiError> {
        let arguments: Vec<Value> = arguments.as_array().unwrap().iter().map(value).collect();
        self.service(service).await.call(method, &arguments).await
    }

    async fn call(&self, service: &str, method: &str, arguments: Json) -> Value {
        self.try_call(service, method, arguments).await.unwrap()
    }

    /// Asks `StandIn` for something in JSON.
    async fn told(&self, method: &str) -> Json {
        serde_json::from_str(&self.call("StandIn", method, json!([])).await.as_text().unwrap()).unwrap()
    }

    async fn world(&self, change: Json) {
        self.call("StandIn", "world", json!([change.to_string()])).await;
    }

    async fn fault(&self, fault: Json) {
        self.call("StandIn", "fault", json!([fault.to_string()])).await;
    }

    /// Waits until the state is as wanted.
    async fn until(&self, what: &str, wanted: impl Fn(&Json) -> bool) -> Json {
        let waiting = async {
            loop {
                let state = self.told("state").await;
                if wanted(&state) {
                    return state;
                }
                tokio::time::sleep(PAUSE).await;
            }
        };
        tokio::time::timeout(PATIENCE, waiting).await.unwrap_or_else(|_| panic!("never: {what}"))
    }

    /// What is raised under a key from now on.
    async fn listen(&self, key: &str) -> Listening {
        let of = self.service("ALMemory").await.call_object("subscriber", &[key.into()]).await.unwrap();
        let events = of.subscribe("signal", Keep::All(64)).await.unwrap();
        Listening { _of: of, events }
    }

    /// Subscribes to an extractor, and gives the first value that it raises.
    async fn first(&self, service: &str, key: &str) -> Json {
        let mut events = self.listen(key).await;
        self.call(service, "subscribe", json!(["test", 20, 0.0])).await;
        let event = next(&mut events.events).await;
        self.call(service, "unsubscribe", json!(["test"])).await;
        event
    }
}

/// A key of the robot's memory that is listened to, for as long as its object is kept.
struct Listening {
    _of: Object,
    events: Subscription,
}

impl Drop for Nao {
    fn drop(&mut self) {
        let _already_gone = self.child.kill();
        let _ = self.child.wait();
    }
}

fn value(json: &Json) -> Value {
    match json {
        Json::String(text) => Value::from(text.as_str()),
        Json::Bool(truth) => Value::from(*truth),
        Json::Number(number) if number.is_i64() => Value::from(i32::try_from(number.as_i64().unwrap()).unwrap()),
        Json::Number(number) => Value::from(number.as_f64().unwrap()),
        Json::Array(items) => Value::List(items.iter().map(|item| Value::dynamic(value(item))).collect()),
        other => unreachable!("no argument: {other}"),
    }
}

/// A value with its dynamics opened, as JSON.
fn plain(value: &Value) -> Json {
    let value = value.seen();
    if let Some(items) = value.items() {
        return items.iter().map(plain).collect();
    }
    if let Value::F32(_) | Value::F64(_) = value {
        return value.as_f64().map_or(Json::Null, Json::from);
    }
    let number = || value.as_i64().map(Json::from);
    let text = || value.as_text().map(|text| Json::from(text.into_owned()));
    value.as_bool().map(Json::from).or_else(number).or_else(text).unwrap_or(Json::Null)
}

async fn next(events: &mut Subscription) -> Json {
    let event: Event = tokio::time::timeout(PATIENCE, events.next()).await.unwrap().unwrap();
    plain(&event.arguments[0])
}

/// Whether a value has a form: a form is a word for a kind, or a list of forms; a list that ends in `…` may go on.
fn fits(value: &Json, form: &Json) -> bool {
    match form {
        Json::Array(forms) => {
            let Some(values) = value.as_array() else { return false };
            let open = forms.last() == Some(&json!("…"));
            let forms = &forms[..forms.len() - usize::from(open)];
            let enough = if open { values.len() >= forms.len() } else { values.len() == forms.len() };
            enough && values.iter().zip(forms).all(|(value, form)| fits(value, form))
        }
        Json::String(kind) if kind == "number" => value.is_number(),
        Json::String(kind) if kind == "whole" => value.is_i64(),
        Json::String(kind) if kind == "text" => value.is_string(),
        Json::String(kind) if kind == "any" => true,
        exact => value == exact,
    }
}

fn near(one: &Json, other: f64) -> bool {
    (one.as_f64().unwrap() - other).abs() < 0.01
}

#[tokio::test]
async fn every_service_of_a_nao_is_there() {
    let Some(nao) = Nao::start("services of the stand-in", &[]).await else { return };
    let mut names: Vec<String> = nao.session.services().await.unwrap().into_iter().map(|one| one.name).collect();
    names.retain(|name| name != "ServiceDirectory");
    names.sort_unstable();
    assert_eq!(names, SERVICES);
    for name in SERVICES {
        let overloads = |method: &str, service: &Object| service.meta().candidates(method).len();
        let service = nao.service(name).await;
        match name {
            "ALLeds" => assert_eq!(overloads("fadeRGB", &service), 3),
            "ALRedBallDetection" => assert_eq!(overloads("subscribe", &service), 2),
            "ALTextToSpeech" | "ALAnimatedSpeech" => assert_eq!(overloads("say", &service), 2),
            "ALMotion" => assert_eq!((overloads("moveTo", &service), overloads("rest", &service)), (2, 2)),
            _ => assert!(overloads("ping", &service) == 1, "{name}"),
        }
        // What only the stand-in itself may call is not published.
        assert!(service.meta().methods.iter().all(|method| !method.name.starts_with('_')), "{name}");
    }
}

#[tokio::test]
async fn an_extractor_tells_only_while_somebody_subscribed() {
    let Some(nao) = Nao::start("extractors of the stand-in", &[]).await else { return };
    let mut events = nao.listen("redBallDetected").await;
    let (ball, memory) = (nao.service("ALRedBallDetection").await, nao.service("ALMemory").await);
    let before = memory.call("getData", &["redBallDetected".into()]).await.unwrap();
    assert_eq!(plain(&before), json!([]), "nothing was ever told");
    for (name, period_ms) in [("slow", 10_000), ("quick", 20)] {
        ball.call("subscribe", &[name.into(), period_ms.into(), 0.0.into()]).await.unwrap();
    }
    // The shortest period counts, or the second would take ten seconds and the tenth more than there is patience.
    for _ in 0..10 {
        next(&mut events.events).await;
    }
    assert_eq!(nao.told("state").await["subscribers"], json!({"ALRedBallDetection": {"slow": 10_000, "quick": 20}}));
    for name in ["slow", "quick"] {
        ball.call("unsubscribe", &[name.into()]).await.unwrap();
    }
    let last = plain(&memory.call("getData", &["redBallDetected".into()]).await.unwrap());
    // A hundred of its steps later it has told nothing more.
    let then = nao.told("state").await["t_ms"].as_u64().unwrap();
    nao.until("two seconds are over", |state| state["t_ms"].as_u64().unwrap() > then + 2_000).await;
    assert_eq!(plain(&memory.call("getData", &["redBallDetected".into()]).await.unwrap()), last);
    assert_eq!(nao.told("state").await["subscribers"], json!({}));
}

#[tokio::test]
async fn a_text_is_spoken_before_say_answers_and_stop_all_releases_it() {
    let Some(nao) = Nao::start("speech of the stand-in", &[]).await else { return };
    let voice = nao.service("ALTextToSpeech").await;
    let mut interrupted = nao.listen("ALTextToSpeech/TextInterrupted").await;
    nao.call("ALTextToSpeech", "say", json!(["hi"])).await;
    assert_eq!(nao.told("state").await["spoken"], json!(["hi"]));
    // Longer than anybody waits.
    nao.world(json!({"speech_ms_per_char": 60_000})).await;
    let words = ["first".into(), "English".into()];
    let second = ["second".into()];
    let (one, other) = (voice.call("say", &words), voice.call("say", &second));
    let stopping = async {
        nao.until("both wait", |state| state["blocked"].as_array().unwrap().len() == 2).await;
        let state = nao.told("state").await;
        assert_eq!((&state["speaking"], &state["waiting_texts"]), (&json!("first"), &json!(["second"])));
        voice.call("stopAll", &[]).await.unwrap();
    };
    let (one, other, ()) = tokio::join!(one, other, stopping);
    assert!(one.is_ok() && other.is_ok());
    next(&mut interrupted.events).await;
    let state = nao.told("state").await;
    assert_eq!((&state["speaking"], &state["spoken"]), (&Json::Null, &json!(["hi", "first"])));
}

#[tokio::test]
async fn joints_move_inside_their_limits_and_not_without_stiffness() {
    let Some(nao) = Nao::start("joints of the stand-in", &[]).await else { return };
    nao.call("ALMotion", "setAngles", json!(["HeadYaw", 9.0, 0.5])).await;
    nao.until("the head is at its limit", |state| near(&state["joints"]["HeadYaw"], 2.0857)).await;
    nao.call("ALMotion", "setAngles", json!([["HeadYaw", "HeadPitch"], [0.5, 0.5], 1.0])).await;
    // Turned that far there is less room for the pitch, by the table of the body.
    nao.until("it came back", |state| near(&state["joints"]["HeadYaw"], 0.5)).await;
    let state = nao.until("it nods", |state| state["joints"]["HeadPitch"].as_f64().unwrap() > 0.4).await;
    assert!(state["joints"]["HeadPitch"].as_f64().unwrap() < 0.43);
    nao.call("ALMotion", "setStiffnesses", json!(["Head", 0.0])).await;
    nao.call("ALMotion", "setAngles", json!(["HeadYaw", 1.0, 1.0])).await;
    let then = nao.told("state").await["t_ms"].as_u64().unwrap();
    let state = nao.until("time passes", |state| state["t_ms"].as_u64().unwrap() > then + 500).await;
    assert!(near(&state["joints"]["HeadYaw"], 0.5) && state["violations"] == json!([]));
    assert!(nao.try_call("ALMotion", "setAngles", json!(["Nose", 1.0, 1.0])).await.is_err());
    let angles = plain(&nao.call("ALMotion", "getAngles", json!(["Body", true])).await);
    assert_eq!(angles.as_array().unwrap().len(), 26);
}

#[tokio::test]
async fn whoever_lets_go_of_a_standing_robot_is_told_on() {
    let Some(nao) = Nao::start("falls of the stand-in", &[]).await else { return };
    let mut falling = nao.listen("ALMotion/RobotIsFalling").await;
    nao.call("ALMotion", "killMove", json!([])).await;
    nao.call("ALMotion", "setStiffnesses", json!(["Body", 0.0])).await;
    assert_eq!(next(&mut falling.events).await, json!(true));
    let state = nao.until("it lies", |state| state["life"] == "safeguard").await;
    assert_eq!(state["violations"], json!(["killMove while standing", "stiffness off while standing"]));
    assert!(state["fallen"] == json!(true) && state["posture"] == "LyingBelly");
    let up = nao.call("ALRobotPosture", "goToPosture", json!(["StandInit", 1.0])).await;
    assert_eq!(up.as_bool(), Some(true), "it gets up");
    assert_eq!(nao.told("state").await["fallen"], json!(false));
}

#[tokio::test]
async fn calls_are_noted_in_their_order_and_a_fault_happens_once() {
    let Some(nao) = Nao::start("the log of the stand-in", &[]).await else { return };
    let motion = nao.service("ALMotion").await;
    for number in 0..200 {
        let angle = f64::from(number) / 1000.0;
        motion.post("setAngles", &[Value::dynamic("HeadYaw"), Value::dynamic(angle), 0.5.into()]).unwrap();
    }
    nao.fault(json!({"do": "error", "service": "ALLeds", "method": "on", "text": "ALLeds::on\n\tnot today"})).await;
    nao.fault(json!({"do": "answer", "service": "ALSystem", "method": "robotName", "value": "Nobody"})).await;
    let failed = nao.try_call("ALLeds", "on", json!(["FaceLeds"])).await.unwrap_err();
    assert!(failed.to_string().contains("not today"), "{failed}");
    nao.call("ALLeds", "on", json!(["FaceLeds"])).await;
    assert_eq!(nao.call("ALSystem", "robotName", json!([])).await.as_text().unwrap(), "Nobody");
    assert_ne!(nao.call("ALSystem", "robotName", json!([])).await.as_text().unwrap(), "Nobody");
    motion.call("ping", &[]).await.unwrap();
    let calls = nao.told("calls").await;
    let calls = calls.as_array().unwrap();
    let angles =
        calls.iter().filter(|call| call["method"] == "setAngles").map(|call| call["args"][1].as_f64().unwrap());
    assert!(angles.clone().count() == 200 && angles.is_sorted(), "as they were sent");
    assert!(calls.iter().map(|call| call["seq"].as_u64().unwrap()).eq(1..=calls.len() as u64));
    let leds: Vec<_> = calls.iter().filter(|call| call["service"] == "ALLeds").collect();
    assert!(leds.len() == 2 && leds[0]["args"] == json!(["FaceLeds"]));
}

#[tokio::test]
async fn an_answer_may_be_late_or_never_come() {
    let Some(nao) = Nao::start("late answers of the stand-in", &[]).await else { return };
    let (leds, short) = (nao.service("ALLeds").await, Duration::from_millis(300));
    nao.fault(json!([{"do": "never", "service": "ALLeds"}, {"do": "delay", "service": "ALSystem", "ms": 400}])).await;
    let never = leds.call_within("on", &["FaceLeds".into()], short).await;
    assert!(matches!(never, Err(QiError::Timeout { .. })), "{never:?}");
    assert!(leds.call("on", &["FaceLeds".into()]).await.is_ok(), "and the next is answered");
    let asked = std::time::Instant::now();
    nao.call("ALSystem", "robotName", json!([])).await;
    assert!(asked.elapsed() >= Duration::from_millis(400));
}

#[tokio::test]
async fn services_come_and_go_and_events_have_any_form() {
    let Some(nao) = Nao::start("comings and goings of the stand-in", &[]).await else { return };
    let (mut added, mut removed) = (nao.session.added().await.unwrap(), nao.session.removed().await.unwrap());
    let before = nao.service("ALTracker").await.service_id();
    nao.fault(json!({"do": "restart", "service": "ALTracker"})).await;
    next(&mut removed).await;
    next(&mut added).await;
    nao.session.forget("ALTracker");
    assert_ne!(nao.service("ALTracker").await.service_id(), before);
    nao.fault(json!({"do": "unregister", "service": "ALTracker"})).await;
    next(&mut removed).await;
    nao.session.forget("ALTracker");
    assert!(nao.session.service("ALTracker").await.is_err());
    let mut odd = nao.listen("FaceDetected").await;
    nao.fault(json!({"do": "raise", "key": "FaceDetected", "value": [[], {"a": [null, "b"]}, 3]})).await;
    assert!(next(&mut odd.events).await.is_array());
    nao.fault(json!({"do": "burst", "key": "FaceDetected", "count": 60, "hz": 1000})).await;
    let mut came = Vec::new();
    for _ in 0..60 {
        came.push(next(&mut odd.events).await.as_i64().unwrap());
    }
    came.sort_unstable();
    assert!(came.into_iter().eq(0..60), "each once, in whatever order");
}

#[tokio::test]
async fn the_process_freezes_and_goes_on() {
    let Some(nao) = Nao::start("the stand-in frozen", &[]).await else { return };
    nao.service("ALSystem").await;
    nao.fault(json!({"do": "freeze", "seconds": 3})).await;
    let robot = nao.service("ALSystem").await;
    let frozen = async { while robot.call_within("robotName", &[], Duration::from_millis(300)).await.is_ok() {} };
    tokio::time::timeout(PATIENCE, frozen).await.unwrap();
    assert!(robot.call("robotName", &[]).await.is_ok());
}

#[tokio::test]
async fn values_have_the_forms_of_naoqi() {
    let Some(nao) = Nao::start("forms of the stand-in", &[]).await else { return };
    let (stamp, pose) =
        (json!(["whole", "whole"]), json!(["number", "number", "number", "number", "number", "number"]));
    nao.world(json!({"landmarks": {"64": {"present": true}}})).await;
    let ball = nao.first("ALRedBallDetection", "redBallDetected").await;
    let circle = json!(["number", "number", "number", "number"]);
    assert!(fits(&ball, &json!([stamp, circle, pose, pose, 0])), "{ball}");
    let mark = nao.first("ALLandMarkDetection", "LandmarkDetected").await;
    let shape = json!([1, "number", "number", "number", "number", "number"]);
    assert!(fits(&mark, &json!([stamp, [[shape, [64]]], pose, pose, "text"])), "{mark}");
    nao.call("ALColorBlobDetection", "setColor", json!([255, 0, 0, 30])).await;
    nao.call("ALColorBlobDetection", "setObjectProperties", json!([1, 0.06, "Circle"])).await;
    let blob = nao.first("ALColorBlobDetection", "ALTracker/ColorBlobDetected").await;
    assert!(fits(&blob, &json!([pose, pose, stamp, "whole"])), "{blob}");
    // Looking up at somebody a metre ahead.
    nao.world(json!({"joints": {"HeadPitch": -0.4}, "balls": {"red": {"present": false}},
        "people": {"person": {"at": [1.0, 0.0], "present": true}}}))
        .await;
    let face = nao.first("ALFaceDetection", "FaceDetected").await;
    let one = json!([[0, "number", "number", "number", "number"], [1, "number", "", "…"]]);
    assert!(fits(&face, &json!([stamp, [one, []], pose, pose, 0])), "{face}");
    let people = nao.first("ALPeoplePerception", "PeoplePerception/PeopleDetected").await;
    assert!(fits(&people, &json!([stamp, [[1, "number", "number", "number"]], pose, pose, 0])), "{people}");
    let mut sounds = nao.listen("ALSoundLocalization/SoundLocated").await;
    nao.call("ALSoundLocalization", "subscribe", json!(["test"])).await;
    nao.world(json!({"sound": {"at": [0.0, 1.0, 0.5]}})).await;
    let sound = next(&mut sounds.events).await;
    assert!(fits(&sound, &json!([stamp, ["number", "number", "number", "number"], pose, pose])), "{sound}");
    assert!((sound[1][0].as_f64().unwrap() - std::f64::consts::FRAC_PI_2).abs() < 0.02, "from the left");
    let mut touches = nao.listen("HandLeftBackTouched").await;
    nao.world(json!({"touch": {"part": "HandLeftBackTouched", "down": true}})).await;
    assert_eq!(next(&mut touches.events).await, json!(1.0));
}

#[tokio::test]
async fn words_are_heard_only_as_the_vocabulary_allows() {
    let Some(nao) = Nao::start("words of the stand-in", &[]).await else { return };
    nao.call("ALSpeechRecognition", "setVocabulary", json!([["yes", "no"], true])).await;
    nao.call("ALSpeechRecognition", "subscribe", json!(["test"])).await;
    let running = nao.try_call("ALSpeechRecognition", "setVocabulary", json!([["no"], true])).await.unwrap_err();
    assert!(running.to_string().contains("modifiable_grammar"), "{running}");
    let mut words = nao.listen("WordRecognized").await;
    nao.world(json!({"word": {"word": "well, yes"}})).await;
    // Which of the two comes first, libqi does not promise.
    let mut heard = [next(&mut words.events).await, next(&mut words.events).await];
    heard.sort_by_key(|value| value[0].as_str().unwrap().len());
    assert_eq!(heard, [json!(["", -3.0]), json!(["<...> yes <...>", 0.6])]);
    nao.call("ALSpeechRecognition", "pause", json!([true])).await;
    nao.call("ALSpeechRecognition", "setVocabulary", json!([["maybe"], false])).await;
    assert_eq!(nao.told("state").await["vocabulary"], json!(["maybe"]));
}

#[tokio::test]
async fn a_walk_ends_where_it_was_sent_or_when_it_is_stopped() {
    let Some(nao) = Nao::start("walks of the stand-in", &[]).await else { return };
    assert_eq!(nao.call("ALMotion", "moveTo", json!([0.1, 0.0, 0.2])).await.as_bool(), Some(true));
    let state = nao.told("state").await;
    assert!(near(&state["pose"][0], 0.1) && near(&state["pose"][2], 0.2), "{}", state["pose"]);
    let motion = nao.service("ALMotion").await;
    let far = [1.0.into(), 0.0.into(), 0.0.into()];
    let stopping = async {
        nao.until("it walks", |state| state["moving"] == json!(true)).await;
        motion.call("stopMove", &[]).await.unwrap();
    };
    let (walked, ()) = tokio::join!(motion.call("moveTo", &far), stopping);
    assert_eq!(walked.unwrap().as_bool(), Some(false));
    nao.until("it stands", |state| state["moving"] == json!(false)).await;
}

#[tokio::test]
async fn a_smaller_nao_has_no_wrists_and_a_pepper_no_legs() {
    for (body, joints, without) in [("h21", 22, "LWristYaw"), ("pepper", 17, "LKneePitch")] {
        let part = format!("the stand-in as {body}");
        let Some(nao) = Nao::start(&part, &["--body", body, "--without", "ALTracker"]).await else { return };
        let names = plain(&nao.call("ALMotion", "getBodyNames", json!(["Body"])).await);
        let names = names.as_array().unwrap();
        assert!(names.len() == joints && !names.contains(&json!(without)), "{names:?}");
        assert!(nao.session.service("ALTracker").await.is_err());
        assert_eq!(nao.call("ALRobotPosture", "goToPosture", json!(["Crouch", 1.0])).await.as_bool(), Some(true));
    }
}

#[tokio::test]
async fn a_picture_has_twelve_parts_and_a_name_works_six_times() {
    let Some(nao) = Nao::start("pictures of the stand-in", &[]).await else { return };
    for _ in 0..6 {
        nao.call("ALVideoDevice", "subscribeCamera", json!(["test", 0, 0, 11, 5])).await;
    }
    assert!(nao.try_call("ALVideoDevice", "subscribeCamera", json!(["test", 0, 0, 11, 5])).await.is_err());
    let picture = nao.call("ALVideoDevice", "getImageRemote", json!(["test_0"])).await;
    let parts = picture.seen().items().unwrap();
    assert_eq!((parts.len(), parts[0].as_i64(), parts[1].as_i64()), (12, Some(160), Some(120)));
    let pixels = parts[6].as_bytes().unwrap();
    assert_eq!(pixels.len(), 160 * 120 * 3, "{:?}", String::from_utf8_lossy(&pixels[..20]));
    assert!(pixels.chunks(3).any(|pixel| pixel == [255, 0, 0]), "the red ball is in it");
}
