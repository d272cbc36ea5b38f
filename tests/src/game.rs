//! A program for who operates: with a button, something to say, a gesture, senses that pretend, and an action that goes on.

use crate::{Outcome, Page, Trouble};

/// The program's name.
pub const GAME: &str = "Ball game";

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
        let file = serde_json::Value::from(FILE);
        let asks = format!(
            "fetch('/api/import', {{ method: 'POST', body: {file} }}).then(answer => answer.text().then(text => answer.ok || text))"
        );
        match self.eval(&asks).await? {
            serde_json::Value::Bool(true) => Ok(()),
            why => Err(Trouble(format!("The program was not brought in: {why}."))),
        }
    }
}
