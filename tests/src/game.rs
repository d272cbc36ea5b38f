//! A program for who operates: with a button, something to say, a gesture, senses that pretend, and an action that goes on.

use crate::{Outcome, Page, Trouble};

/// The program's name.
pub const GAME: &str = "Ball game";
/// The name of the same program with tiles of its own: 1 says hello, 4 asks first and waves, 7 marks a moment, 9 a span.
pub const TILES: &str = "Game with tiles";

const PAD: &str = r#"[
  {"key": 1, "label": "Hello", "device": "SayParameter", "params": {"text": "Hello"}},
  {"key": 4, "label": "Wave", "device": "Animation", "params": {"animation": "Hey"}, "asks": true},
  {"key": 7, "label": "laughs", "word": "laughs"},
  {"key": 9, "label": "looks away", "word": "looks away", "span": true}
]"#;

const FILE: &str = r#"{
  "format": "rrp-behaviour/1",
  "name": "Ball game",
  "helpers": [],
  "streams": [
    {"id": "ball", "kind": "sensor", "name": "Red ball", "device": "RedBall"},
    {"id": "touch", "kind": "sensor", "name": "Head", "device": "HeadTouch"},
    {"id": "go", "kind": "sensor", "name": "Button", "device": "Button", "params": {"label": "Go on"}},
    {"id": "say", "kind": "actuator", "name": "Well done", "device": "SayParameter", "params": {"text": "Well done!"}},
    {"id": "tickle", "kind": "actuator", "name": "Tickles", "device": "SayParameter", "params": {"text": "That tickles!"}},
    {"id": "wave", "kind": "actuator", "name": "Wave", "device": "Animation", "params": {"animation": "Hey"}},
    {"id": "head", "kind": "actuator", "name": "Head tracker", "device": "Tracker",
     "params": {"effector": "None", "mode": "Head", "target": "RedBall"}}
  ],
  "connectors": [
    {"id": "c1", "type": "subscribe", "inputs": ["ball"], "output": "head"},
    {"id": "c2", "type": "subscribe", "inputs": ["go"], "output": "say"},
    {"id": "c3", "type": "subscribe", "inputs": ["touch"], "output": "tickle"}
  ]
}"#;

impl Page {
    /// Brings the program in, through the server that this page comes from.
    ///
    /// # Errors
    /// If the server does not take it.
    pub async fn brings_game(&self) -> Outcome<()> {
        self.brings(FILE).await
    }

    /// Brings the program with tiles of its own in.
    ///
    /// # Errors
    /// If the server does not take it.
    pub async fn brings_tiles(&self) -> Outcome<()> {
        let mut file: serde_json::Value = serde_json::from_str(FILE)?;
        file["name"] = TILES.into();
        file["pad"] = serde_json::from_str(PAD)?;
        self.brings(&file.to_string()).await
    }

    async fn brings(&self, file: &str) -> Outcome<()> {
        let file = serde_json::Value::from(file);
        let asks = format!(
            "fetch('/api/import', {{ method: 'POST', body: {file} }}).then(answer => answer.text().then(text => answer.ok || text))"
        );
        match self.eval(&asks).await? {
            serde_json::Value::Bool(true) => Ok(()),
            why => Err(Trouble(format!("The program was not brought in: {why}."))),
        }
    }
}
