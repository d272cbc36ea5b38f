//! The gestures of a person on a page: pressing, typing, dragging, touching, pinching.

use serde_json::{Value, json};
use std::time::Duration;

use crate::keys;
use crate::page::Page;
use crate::{Outcome, Trouble};

/// A place in the window, in CSS pixels.
pub(crate) type Point = (f64, f64);

/// Measures how far around a place the same thing is hit.
const AROUND: &str = "((x, y) => {
    const of = element => element?.closest('button, a, input, select, textarea, label, [role=button], [role=menuitem], [role=img]');
    const own = of(document.elementFromPoint(x, y));
    const far = (dx, dy) => {
        let steps = 0;
        while (steps < 44 && own && of(document.elementFromPoint(x + dx * (steps + 1), y + dy * (steps + 1))) === own)
            steps += 1;
        return steps;
    };
    return [far(1, 0) + far(-1, 0) + 1, far(0, 1) + far(0, -1) + 1];
})";

/// In how many moves two fingers pinch.
const PINCH_STEPS: u32 = 10;
/// The time for which a finger rests before it is lifted, so that nothing goes on gliding.
const RESTS: Duration = Duration::from_millis(120);
/// The time of a finger that is held for a long press.
const LONG_PRESS: Duration = Duration::from_millis(900);

impl Page {
    /// Clicks the one element with this role and accessible name, once it rests in view and nothing covers it.
    pub async fn press(&self, role: &str, name: &str) -> Outcome<()> {
        let at = self.reach(role, name).await?;
        self.click(at, "left", 1).await
    }

    /// Clicks it twice.
    pub async fn press_twice(&self, role: &str, name: &str) -> Outcome<()> {
        let at = self.reach(role, name).await?;
        self.click(at, "left", 1).await?;
        self.click(at, "left", 2).await
    }

    /// Clicks it with the right button.
    pub async fn press_right(&self, role: &str, name: &str) -> Outcome<()> {
        let at = self.reach(role, name).await?;
        self.click(at, "right", 1).await
    }

    /// Moves the mouse over it.
    pub async fn hover(&self, role: &str, name: &str) -> Outcome<()> {
        let at = self.reach(role, name).await?;
        self.move_to(at).await
    }

    /// Touches it with one finger.
    pub async fn tap(&self, role: &str, name: &str) -> Outcome<()> {
        let at = self.reach(role, name).await?;
        self.tap_at(at).await
    }

    /// Returns its width and height where a finger hits it, once it rests in view; 89 CSS pixels are not told from
    /// more.
    pub async fn hit_size(&self, role: &str, name: &str) -> Outcome<(f64, f64)> {
        let at = self.reach(role, name).await?;
        self.hit_size_at(at).await
    }

    pub(crate) async fn hit_size_at(&self, at: Point) -> Outcome<(f64, f64)> {
        let size = self.eval(&format!("{AROUND}({}, {})", at.0, at.1)).await?;
        Ok((size[0].as_f64().unwrap_or_default(), size[1].as_f64().unwrap_or_default()))
    }

    /// Touches a place in the window with one finger, whatever is there.
    pub async fn tap_at(&self, at: Point) -> Outcome<()> {
        self.touch("touchStart", &[at]).await?;
        self.touch("touchEnd", &[]).await
    }

    /// Puts one finger down at a place and leaves it there.
    pub async fn touch_down(&self, at: Point) -> Outcome<()> {
        self.touch("touchStart", &[at]).await
    }

    /// Lifts all fingers.
    pub async fn touch_up(&self) -> Outcome<()> {
        self.touch("touchEnd", &[]).await
    }

    /// Clicks a place in the window, whatever is there.
    pub async fn press_at(&self, at: (f64, f64)) -> Outcome<()> {
        self.click(at, "left", 1).await
    }

    /// Presses and releases a key: `Enter`, `a`, `Control+z`, `Shift+ArrowLeft`.
    pub async fn key(&self, chord: &str) -> Outcome<()> {
        let events = keys::events(chord).ok_or_else(|| Trouble(format!("`{chord}` is not a key.")))?;
        for event in events {
            self.call("Input.dispatchKeyEvent", event).await?;
        }
        Ok(())
    }

    /// Types into whatever has the focus, key by key; letters off the keyboard are inserted.
    pub async fn type_text(&self, text: &str) -> Outcome<()> {
        for letter in text.chars() {
            match letter {
                '\n' => self.key("Enter").await?,
                ' '..='~' => self.key(letter.encode_utf8(&mut [0; 4])).await?,
                _ => self.call("Input.insertText", json!({ "text": letter.to_string() })).await.map(drop)?,
            }
        }
        Ok(())
    }

    /// Replaces what is in the one text field with this role and name.
    pub async fn fill(&self, role: &str, name: &str, text: &str) -> Outcome<()> {
        self.press(role, name).await?;
        self.key("Control+a").await?;
        self.key("Delete").await?;
        self.type_text(text).await
    }

    /// Drags with the left mouse button, in `steps` moves.
    pub async fn drag(&self, from: (f64, f64), to: (f64, f64), steps: u32) -> Outcome<()> {
        self.hold(from).await?;
        for at in between(from, to, steps) {
            self.mouse("mouseMoved", at, json!({ "button": "left", "buttons": 1 })).await?;
        }
        self.release(to).await
    }

    /// Drags with a pen, in `steps` moves.
    pub async fn pen_drag(&self, from: (f64, f64), to: (f64, f64), steps: u32) -> Outcome<()> {
        let pen = |buttons: u32| json!({ "button": "left", "buttons": buttons, "pointerType": "pen", "clickCount": 1 });
        self.mouse("mouseMoved", from, json!({ "pointerType": "pen" })).await?;
        self.mouse("mousePressed", from, pen(1)).await?;
        for at in between(from, to, steps) {
            self.mouse("mouseMoved", at, pen(1)).await?;
        }
        self.mouse("mouseReleased", to, pen(0)).await
    }

    /// Presses the left mouse button at a place and keeps it down.
    pub async fn hold(&self, at: (f64, f64)) -> Outcome<()> {
        self.move_to(at).await?;
        self.mouse("mousePressed", at, json!({ "button": "left", "buttons": 1, "clickCount": 1 })).await
    }

    /// Moves the mouse with the button held.
    pub async fn pull(&self, to: (f64, f64)) -> Outcome<()> {
        self.mouse("mouseMoved", to, json!({ "button": "left", "buttons": 1 })).await
    }

    /// Releases the left mouse button at a place.
    pub async fn release(&self, at: (f64, f64)) -> Outcome<()> {
        self.mouse("mouseReleased", at, json!({ "button": "left", "buttons": 0, "clickCount": 1 })).await
    }

    /// Moves the mouse with no button held.
    pub async fn move_to(&self, at: (f64, f64)) -> Outcome<()> {
        self.mouse("mouseMoved", at, json!({})).await
    }

    /// Turns the wheel at a place, by CSS pixels to the right and down.
    pub async fn wheel(&self, at: (f64, f64), right: f64, down: f64) -> Outcome<()> {
        self.mouse("mouseWheel", at, json!({ "deltaX": right, "deltaY": down })).await
    }

    /// Turns the wheel at a place with Control held, which zooms.
    pub async fn wheel_zoom(&self, at: (f64, f64), down: f64) -> Outcome<()> {
        self.mouse("mouseWheel", at, json!({ "deltaX": 0, "deltaY": down, "modifiers": 2 })).await
    }

    /// Drags with one finger, in `steps` moves, and rests before it is lifted: the browser keeps a tap for itself that comes
    /// soon after a flick.
    pub async fn touch_drag(&self, from: (f64, f64), to: (f64, f64), steps: u32) -> Outcome<()> {
        self.push(from, to, steps).await?;
        tokio::time::sleep(RESTS).await;
        self.touch("touchEnd", &[]).await
    }

    /// Holds one finger still for as long as a browser takes for a long press, and lifts it.
    pub async fn touch_long(&self, at: (f64, f64)) -> Outcome<()> {
        self.touch("touchStart", &[at]).await?;
        tokio::time::sleep(LONG_PRESS).await;
        self.touch("touchEnd", &[]).await
    }

    /// Drags with one finger, and lifts it at full speed.
    pub async fn flick(&self, from: (f64, f64), to: (f64, f64), steps: u32) -> Outcome<()> {
        self.push(from, to, steps).await?;
        self.touch("touchEnd", &[]).await
    }

    async fn push(&self, from: (f64, f64), to: (f64, f64), steps: u32) -> Outcome<()> {
        self.touch("touchStart", &[from]).await?;
        for at in between(from, to, steps) {
            self.touch("touchMove", &[at]).await?;
        }
        Ok(())
    }

    /// Pinches with two fingers left and right of a centre, `from` and `to` CSS pixels apart.
    pub async fn pinch(&self, centre: (f64, f64), from: f64, to: f64) -> Outcome<()> {
        let fingers = |apart: f64| [(centre.0 - apart / 2.0, centre.1), (centre.0 + apart / 2.0, centre.1)];
        self.touch("touchStart", &fingers(from)).await?;
        for (apart, _) in between((from, 0.0), (to, 0.0), PINCH_STEPS) {
            self.touch("touchMove", &fingers(apart)).await?;
        }
        self.touch("touchEnd", &[]).await
    }

    async fn click(&self, at: Point, button: &str, count: u32) -> Outcome<()> {
        let held = if button == "right" { 2 } else { 1 };
        let with = |buttons: u32| json!({ "button": button, "buttons": buttons, "clickCount": count });
        self.move_to(at).await?;
        self.mouse("mousePressed", at, with(held)).await?;
        self.mouse("mouseReleased", at, with(0)).await
    }

    async fn mouse(&self, kind: &str, at: Point, mut event: Value) -> Outcome<()> {
        event["type"] = kind.into();
        event["x"] = at.0.into();
        event["y"] = at.1.into();
        self.call("Input.dispatchMouseEvent", event).await.map(drop)
    }

    async fn touch(&self, kind: &str, fingers: &[Point]) -> Outcome<()> {
        let fingers = fingers.iter().enumerate().map(|(id, (x, y))| json!({ "x": x, "y": y, "id": id }));
        let points: Vec<Value> = fingers.collect();
        self.call("Input.dispatchTouchEvent", json!({ "type": kind, "touchPoints": points })).await.map(drop)
    }
}

/// The places on a straight way, without its beginning and with its end; at least one.
fn between(from: Point, to: Point, steps: u32) -> impl Iterator<Item = Point> {
    let steps = steps.max(1);
    (1..=steps).map(move |step| {
        let part = f64::from(step) / f64::from(steps);
        (from.0 + (to.0 - from.0) * part, from.1 + (to.1 - from.1) * part)
    })
}
