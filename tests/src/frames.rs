//! Waiting for frames, which Chromium without a screen sometimes stops to draw: rare, and nothing a page can cause while its
//! scripts run. Its process that draws is then ended once, and Chromium starts another.

use std::process::Command;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::{Outcome, Page, Trouble};

/// The longest time of two frames; many times what a busy machine needs.
const FRAMES: Duration = Duration::from_secs(10);
/// The longest time until something stays as it is.
const STEADY: Duration = Duration::from_secs(30);
/// The time for which a page is looked at that draws nothing.
const LOOK: Duration = Duration::from_secs(5);
const TWO: &str = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))";

/// True while nothing moves on the page that will come to rest.
const STILL: &str = "!document.querySelector('.gliding') && document.getAnimations().every(motion =>
    motion.playState !== 'running' || motion.effect?.getComputedTiming().endTime === Infinity)";

impl Page {
    /// Waits until the page has done what follows on the last input: its frames are drawn, and nothing moves any more.
    pub async fn settled(&self) -> Outcome<()> {
        self.frames().await?;
        self.until(STILL, "the page comes to rest").await?;
        self.frames().await
    }

    /// Waits until a JavaScript expression has had the same value, as text, for `frames` frames in a row.
    ///
    /// # Errors
    /// Fails with what it was at last if it goes on changing.
    pub async fn steady(&self, js: &str, frames: u32, what: &str) -> Outcome<()> {
        let watch = format!(
            "new Promise(done => {{
                let [before, same] = [undefined, 0];
                const look = () => {{
                    const now = String({js});
                    same = now === before ? same + 1 : 0;
                    before = now;
                    if (same >= {frames}) done(true); else requestAnimationFrame(look);
                }};
                look();
            }})"
        );
        match tokio::time::timeout(STEADY, self.eval(&watch)).await {
            Ok(steady) => steady.map(drop),
            Err(_) => Err(self.fail(&format!("{what}: it goes on changing for {} s", STEADY.as_secs())).await),
        }
    }

    /// Waits until the page has drawn two frames, so that everything before is in view.
    ///
    /// # Errors
    /// Fails if nothing is drawn: with whether the page's scripts run, and how busy its process is.
    pub async fn frames(&self) -> Outcome<()> {
        if self.draws().await? {
            return Ok(());
        }
        if self.scripts_run().await && !self.drawn_anew.swap(true, Ordering::Relaxed) {
            eprintln!(
                "NOTE: Chromium draws nothing, though the page's scripts run; its process that draws is started anew."
            );
            self.end_drawing().await?;
            if self.draws().await? {
                return Ok(());
            }
        }
        Err(self.fail(&format!("no two frames are drawn within {} s", FRAMES.as_secs())).await)
    }

    async fn draws(&self) -> Outcome<bool> {
        match tokio::time::timeout(FRAMES, self.eval(TWO)).await {
            Ok(drawn) => drawn.map(|_| true),
            Err(_) => Ok(false),
        }
    }

    /// True if a script of the page runs within a while.
    pub(crate) async fn scripts_run(&self) -> bool {
        tokio::time::timeout(LOOK, self.eval("1")).await.is_ok_and(|answer| answer.is_ok())
    }

    /// Ends the process of Chromium that draws for all pages.
    async fn end_drawing(&self) -> Outcome<()> {
        let id = self.drawing_process().await?;
        Command::new("kill").args(["-9", &id.to_string()]).status()?;
        Ok(())
    }

    /// The id of the process of Chromium that draws for all pages.
    pub async fn drawing_process(&self) -> Outcome<u64> {
        let asked = self.browser("SystemInfo.getProcessInfo", json!({})).await?;
        let all = asked["processInfo"].as_array().into_iter().flatten();
        let found = all.filter(|process| process["type"] == "GPU").find_map(|process| process["id"].as_u64());
        found.ok_or_else(|| Trouble::of("Chromium names no process that draws", &asked))
    }

    /// Describes a page that gives no picture: whether its scripts run, and how busy its process is.
    pub(crate) async fn stuck(&self, scripts: bool) -> String {
        let scripts = if scripts { "its scripts run" } else { "its scripts do not run" };
        let began = Instant::now();
        // Answered between the steps of a running script, too.
        let before = self.process_seconds().await;
        tokio::time::sleep(LOOK).await;
        match (before, self.process_seconds().await) {
            (Ok(before), Ok(after)) => {
                let (worked, of) = (after - before, began.elapsed().as_secs_f64());
                format!("{scripts}, and its process worked {worked:.1} of {of:.1} s")
            }
            (Err(trouble), _) | (_, Err(trouble)) => format!("{scripts}; {trouble}"),
        }
    }

    /// Processor time of the page's whole process so far.
    async fn process_seconds(&self) -> Outcome<f64> {
        let answer = self.call("Performance.getMetrics", json!({})).await?;
        let mut all = answer["metrics"].as_array().into_iter().flatten();
        let found = all.find(|metric| metric["name"] == "ProcessTime").and_then(|metric| metric["value"].as_f64());
        found.ok_or_else(|| Trouble::of("There is no ProcessTime", Value::Null))
    }
}
