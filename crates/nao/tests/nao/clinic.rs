//! Tests of what a clinic's robot brings along: installed behaviours, gestures and sounds of its own, its voice, its
//! lights, the faces it remembers, and what a person has it do with its body.

use crate::driver::{Driver, user};
use crate::peer::Peer;
use behaviour::Value;
use robot::{Control, Millis, Network, Robot};
use serde_json::json;

fn text(text: &str) -> Value {
    Value::text(text)
}

/// A robot whose lists are known.
async fn known(peer: &Peer) -> Driver {
    let mut driver = Driver::at(&peer.address).await;
    driver.until("what is installed is known", |driver| !driver.nao.installed().languages.is_empty()).await;
    driver
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn installed_behaviours_start_by_name_one_at_a_time_and_end_with_their_program() {
    let Some(peer) = Peer::start("nao: behaviours", &[]).await else { return };
    let mut driver = known(&peer).await;
    let installed = driver.nao.installed();
    assert_eq!(installed.behaviors, ["boot-config", "games/hide_and_seek", "run_dialog_dev/.", "standard/taichi"]);
    let missing = "the behaviour “standard/chess” is not installed on this robot; choose one from its list";
    let params = [("name".to_owned(), text("standard/chess"))].into();
    let refused = driver.nao.open(&user("chess"), "Behavior", &params).unwrap_err();
    assert_eq!(refused.to_string(), missing);

    let (taichi, told) =
        (driver.open("taichi", "Behavior", &[("name", text("standard/taichi"))]), driver.open("told", "Behavior", &[]));
    driver.tell(&taichi, true);
    driver.tell(&taichi, true);
    driver.sees(&peer, "it runs", |state| state["behaviors"] == json!(["standard/taichi"])).await;
    assert_eq!(peer.calls("ALBehaviorManager.runBehavior").await, [json!(["standard/taichi"])]);
    assert_eq!(driver.nao.scene().body.playing, "behaviour standard/taichi");
    driver.tell(&told, text("games/hide_and_seek"));
    driver.sees(&peer, "the other takes its place", |state| state["behaviors"] == json!(["games/hide_and_seek"])).await;
    assert_eq!(driver.nao.command(&told, &text("standard/chess"), Millis(0)).unwrap_err().to_string(), missing);
    let nameless = driver.nao.command(&told, &Value::Bool(true), Millis(0)).unwrap_err().to_string();
    assert_eq!(nameless, "choose a behaviour for it, or let the value name one");
    driver.nao.close(&taichi);
    driver.nao.close(&told);
    driver.sees(&peer, "it ends with its program", |state| state["behaviors"] == json!([])).await;
    let stopped = peer.calls("ALBehaviorManager.stopBehavior").await;
    assert!(stopped.contains(&json!(["standard/taichi"])) && stopped.contains(&json!(["games/hide_and_seek"])));

    let again = driver.open("again", "Behavior", &[("name", text("standard/taichi"))]);
    driver.tell(&again, true);
    driver.sees(&peer, "it runs again", |state| state["behaviors"] == json!(["standard/taichi"])).await;
    driver.nao.stop(Millis(0));
    driver.sees(&peer, "Stop ends it", |state| state["behaviors"] == json!([])).await;
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn gestures_and_sounds_of_the_robot_are_played_by_their_names() {
    let Some(peer) = Peer::start("nao: own gestures", &[]).await else { return };
    let mut driver = known(&peer).await;
    let installed = driver.nao.installed();
    assert!(installed.gestures.contains(&"animations/Stand/Gestures/Thinking_1".to_owned()));
    assert_eq!(installed.sounds[1], "Aldebaran/sfx_validation_1");
    let own = [("animation", text("robot")), ("gesture", text("animations/Stand/Gestures/Thinking_1"))];
    let gesture = driver.open("think", "Animation", &own);
    driver.tell(&gesture, true);
    driver.sees(&peer, "it plays", |state| !state["played"].as_array().unwrap().is_empty()).await;
    assert_eq!(peer.calls("ALAnimationPlayer.run").await, [json!(["animations/Stand/Gestures/Thinking_1"])]);
    let sound = |file: &str| [("sound", text("file")), ("file", text(file)), ("volume", 50.0.into())];
    let (set, file) = (
        driver.open("set", "Sound", &sound("Aldebaran/sfx_validation_1")),
        driver.open("file", "Sound", &sound("/home/nao/sounds/bell.wav")),
    );
    driver.tell(&set, true);
    driver.tell(&file, true);
    driver.sees(&peer, "both sound", |state| state["sounded"].as_array().unwrap().len() == 2).await;
    let played = peer.calls("ALAudioPlayer.playSoundSetFile").await;
    assert_eq!(played, [json!(["Aldebaran", "sfx_validation_1", 0.0, 0.5, 0.0, false])]);
    assert_eq!(peer.calls("ALAudioPlayer.playFile").await, [json!(["/home/nao/sounds/bell.wav", 0.5, 0.0])]);
    let params = sound("Aldebaran/none").map(|(name, value)| (name.to_owned(), value));
    assert!(driver.nao.open(&user("none"), "Sound", &params.into()).is_err());
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_voice_is_as_before_at_the_end_and_after_a_stop() {
    let Some(peer) = Peer::start("nao: voice", &[]).await else { return };
    let mut driver = known(&peer).await;
    assert_eq!(driver.nao.installed().languages, ["English", "French", "German", "Japanese"]);
    let chosen =
        [("volume", 50.0.into()), ("speed", 80.0.into()), ("gestures", text("yes")), ("language", text("Japanese"))];
    let params = [("language".to_owned(), text("Klingon"))].into();
    assert!(driver.nao.open(&user("klingon"), "Voice", &params).is_err(), "only what is installed");
    let (voice, say) = (driver.open("voice", "Voice", &chosen), driver.open("say", "SayInput", &[]));
    let is_usual = |state: &serde_json::Value| {
        let volume = state["voice_volume"].as_f64().unwrap();
        state["language"] == "English" && (volume - 0.7).abs() < 1e-6 && state["voice"]["speed"] == 100.0
    };
    let is_changed = |state: &serde_json::Value| {
        state["language"] == "Japanese" && state["voice_volume"] == 0.5 && state["voice"]["speed"] == 80.0
    };
    driver.tell(&say, text("as usual"));
    driver.sees(&peer, "it speaks", |state| state["spoken"] == json!(["as usual"])).await;
    assert!(is_usual(&peer.state().await), "nothing changes before a value comes");
    driver.tell(&voice, true);
    driver.sees(&peer, "it speaks in another way", is_changed).await;
    driver.tell(&say, text("softly"));
    driver.sees(&peer, "it says it", |state| state["spoken"] == json!(["as usual", "softly"])).await;
    assert_eq!(peer.calls("ALAnimatedSpeech.say").await, [json!(["softly"])], "with gestures");
    driver.nao.close(&voice);
    driver.sees(&peer, "its voice is as before", is_usual).await;
    let voice = driver.open("voice", "Voice", &chosen);
    driver.tell(&voice, true);
    driver.sees(&peer, "it speaks in another way", is_changed).await;
    driver.nao.stop(Millis(0));
    driver.sees(&peer, "its voice is as before after Stop", is_usual).await;
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn lights_shine_as_they_can_and_are_the_robots_own_again() {
    let Some(peer) = Peer::start("nao: lights", &[]).await else { return };
    let mut driver = known(&peer).await;
    let chosen = |part: &str, color: &str| [("part", text(part)), ("color", text(color))];
    let (ears, chest) = (
        driver.open("ears", "Lights", &chosen("ears", "off")),
        driver.open("chest", "Lights", &chosen("chest", "red")),
    );
    driver.tell(&ears, true);
    driver.tell(&chest, true);
    driver
        .sees(&peer, "both shine", |state| {
            state["leds"]["ChestLeds"] == json!([1.0, 0.0, 0.0]) && state["leds"]["EarLeds"] == json!([0.0, 0.0, 0.0])
        })
        .await;
    assert_eq!(peer.calls("ALLeds.fade").await, [json!(["EarLeds", 0.0, 0.1])], "ears have no colour but theirs");
    driver.nao.close(&chest);
    driver.sees(&peer, "the chest is its own", |state| state["leds"]["ChestLeds"] == json!([1.0, 1.0, 1.0])).await;
    assert_eq!(peer.calls("ALLeds.reset").await, [json!(["ChestLeds"])]);
    driver.nao.stop(Millis(0));
    driver.sees(&peer, "the ears are its own", |state| state["leds"]["EarLeds"] == json!([1.0, 1.0, 1.0])).await;
    let params = chosen("shoulders", "red").map(|(name, value)| (name.to_owned(), value)).into();
    let refused = driver.nao.open(&user("shoulders"), "Lights", &params).unwrap_err();
    assert!(refused.to_string().contains("only a Pepper has"), "{refused}");
    let chest = driver.open("chest", "Lights", &chosen("chest", "red"));
    peer.world(json!({"battery": 10})).await;
    driver.until("it is low", |driver| driver.nao.condition().battery == Some(10)).await;
    let refused = driver.nao.command(&chest, &Value::Bool(true), Millis(0)).unwrap_err();
    assert!(refused.to_string().contains("its chest light shows"), "{refused}");
    peer.was_safe().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_pepper_says_which_lights_it_does_not_have() {
    let Some(peer) = Peer::start("nao: lights of a Pepper", &["--body", "pepper"]).await else { return };
    let mut driver = known(&peer).await;
    let params = [("part".to_owned(), text("head"))].into();
    let refused = driver.nao.open(&user("head"), "Lights", &params).unwrap_err();
    assert!(refused.to_string().contains("a Pepper has no lights on its head"), "{refused}");
    let shoulders = driver.open("shoulders", "Lights", &[("part", text("shoulders")), ("color", text("blue"))]);
    driver.tell(&shoulders, true);
    driver.sees(&peer, "blue shoulders", |state| state["leds"]["ShoulderLeds"] == json!([0.0, 0.0, 1.0])).await;
    assert!(driver.nao.control(Control::Sit, Millis(0)).unwrap_err().to_string().contains("a Pepper cannot sit"));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_tablet_of_a_pepper_shows_texts_and_pictures_until_the_end() {
    let Some(peer) = Peer::start("nao: tablet", &["--body", "pepper"]).await else { return };
    let mut driver = known(&peer).await;
    let (value, cat) = (
        driver.open("value", "Tablet", &[("shows", text("value"))]),
        driver.open("cat", "Tablet", &[("shows", text("picture")), ("picture", text("ours/cat.png"))]),
    );
    driver.tell(&value, text("<b>Bravo</b>"));
    let shows_text = |state: &serde_json::Value| state["tablet"].as_str().is_some_and(|shown| shown.contains("Bravo"));
    let state = driver.sees(&peer, "it shows the text", shows_text).await;
    assert!(state["tablet"].as_str().unwrap().contains("%26lt%3Bb%26gt%3BBravo"), "as a text: {state}");
    driver.tell(&cat, true);
    let address = "http://198.18.0.1/apps/ours/cat.png";
    driver.sees(&peer, "it shows the picture", |state| state["tablet"] == address).await;
    driver.nao.close(&value);
    driver.wait(20).await;
    assert_eq!(peer.state().await["tablet"], address, "it is another's");
    driver.nao.close(&cat);
    driver.sees(&peer, "it is hidden", |state| state["tablet"].is_null()).await;
    let value = driver.open("value", "Tablet", &[]);
    driver.tell(&value, true);
    driver.sees(&peer, "it shows its own text", |state| state["tablet"].is_string()).await;
    driver.nao.stop(Millis(0));
    driver.sees(&peer, "Stop hides it", |state| state["tablet"].is_null()).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn faces_are_counted_and_forgotten_when_a_person_wants_that() {
    let Some(peer) = Peer::start("nao: faces", &[]).await else { return };
    peer.world(json!({"learned": {"1": "A", "2": "B"}, "network": {"wifi": 35}})).await;
    let mut driver = known(&peer).await;
    driver.until("they are counted", |driver| driver.nao.condition().faces == Some(2)).await;
    assert_eq!(driver.nao.condition().network, Some(Network::Wifi(35)));
    assert_eq!(*driver.nao.faces(), ["A".to_owned(), "B".to_owned()]);
    let refused = driver.nao.control(Control::ForgetFace("C".to_owned()), Millis(0)).unwrap_err().to_string();
    assert_eq!(refused, "the robot cannot do this now: it remembers nobody of that name");
    driver.nao.control(Control::ForgetFace("A".to_owned()), Millis(0)).unwrap();
    driver.until("one is gone", |driver| *driver.nao.faces() == ["B".to_owned()]).await;
    assert_eq!(driver.nao.condition().faces, Some(1));
    assert_eq!(peer.calls("ALFaceDetection.forgetPerson").await, [json!(["A"])]);
    assert!(peer.calls("ALFaceDetection.clearDatabase").await.is_empty());
    driver.nao.control(Control::ForgetFaces, Millis(0)).unwrap();
    driver.until("they are gone", |driver| driver.nao.condition().faces == Some(0)).await;
    assert_eq!(peer.calls("ALFaceDetection.clearDatabase").await, [json!([])]);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn it_wakes_up_stands_and_sits_when_a_person_wants_that_and_stop_ends_it() {
    let Some(peer) = Peer::start("nao: stands and sits", &[]).await else { return };
    let mut driver = known(&peer).await;
    driver.nao.control(Control::Sit, Millis(0)).unwrap();
    driver.sees(&peer, "it sits", |state| state["family"] == "Sitting").await;
    driver.nao.control(Control::Stand, Millis(0)).unwrap();
    driver.sees(&peer, "it is on its way", |state| state["blocked"] == json!(["ALRobotPosture.goToPosture"])).await;
    driver.nao.stop(Millis(0));
    driver.sees(&peer, "Stop ends that", |state| state["blocked"] == json!([])).await;
    driver.nao.control(Control::Rest, Millis(0)).unwrap();
    driver.until("it rests", |driver| driver.nao.condition().awake == Some(false)).await;
    for wish in [Control::Stand, Control::Sit] {
        let refused = driver.nao.control(wish, Millis(0)).unwrap_err().to_string();
        assert_eq!(refused, "the robot cannot do this now: it rests; wake it up first");
    }
    driver.nao.control(Control::WakeUp, Millis(0)).unwrap();
    driver.until("it is awake", |driver| driver.nao.condition().awake == Some(true)).await;
    peer.world(json!({"push": "belly"})).await;
    driver.until("it fell", |driver| driver.nao.condition().fallen == Some(true)).await;
    for wish in [Control::WakeUp, Control::Stand, Control::Sit] {
        let refused = driver.nao.control(wish.clone(), Millis(0)).unwrap_err().to_string();
        assert!(refused.contains("it lies on the floor") || refused.contains("it rests"), "{wish:?}: {refused}");
    }
}
