//! Stop needs nothing of the browser: without script, before it, with broken script and without what younger browsers have,
//! a press ends in a Stop at the server.

use behaviour::Id;
use house::{Outcome, Page, Trouble, skip};
use protocol::{Event, RunPhase, request};
use serde_json::json;
use shell::Client;
use std::fmt::Write;
use std::io::Write as _;
use std::time::{Duration, Instant};

use crate::steps::*;

/// A way to press Stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Press {
    Click,
    Finger,
    Escapes,
}

const PRESSES: [Press; 3] = [Press::Click, Press::Finger, Press::Escapes];
/// Every Stop leaves this in the log of the server, whatever it finds to stop.
const HEARD: &str = "Stop over HTTP";
/// How long a press may take to be heard.
const HEARD_WITHIN: Duration = Duration::from_secs(5);
/// How often Escape is pressed twice.
const PRESSES_MAX: usize = 3;
/// Between two looks at the log.
const LOOK: Duration = Duration::from_millis(10);
/// The program and its looks, which Stop needs nothing of.
const PROGRAM: [&str; 3] = ["*app.js*", "*app_bg.wasm*", "*page.css*"];

/// A robot that runs something, and somebody who sees it.
struct Scene {
    stage: Stage,
    aiko: Client,
    program: Id,
}

impl Scene {
    async fn set() -> Outcome<Self> {
        let stage = Stage::set().await?;
        let aiko = Client::connect(&stage.server.url(), "Aiko").await?;
        let program = Id::new("to-be-stopped")?;
        let template = Some("Reflect ball color".to_owned());
        let create = request::Create { behaviour: program.clone(), name: "To be stopped".to_owned(), template };
        drop(aiko.ask(create).await?);
        Ok(Self { stage, aiko, program })
    }

    async fn start(&mut self) -> Outcome<()> {
        let session = protocol::RecordedSession::default();
        let behaviour = self.program.clone();
        self.aiko.ask(request::Start { behaviour, robot: None, record: false, session }).await?;
        self.runs(1).await
    }

    /// Waits until so many programs run.
    async fn runs(&mut self, wanted: usize) -> Outcome<()> {
        let are = |event: &Event| match event {
            Event::Runs { runs, .. } => runs.iter().filter(|run| run.phase == RunPhase::Running).count() == wanted,
            _ => false,
        };
        Ok(self.aiko.until(are).await.map(drop)?)
    }

    fn heard(&self) -> usize {
        self.stage.server.log().matches(HEARD).count()
    }

    /// Presses Stop on the page that is open; whether the server hears one Stop more.
    async fn hears(&self, page: &Page, how: Press) -> Outcome<bool> {
        let before = self.heard();
        // On a busy computer a second Escape may come too late to be one.
        for _ in 0..PRESSES_MAX {
            press(page, how).await?;
            let began = Instant::now();
            while began.elapsed() < HEARD_WITHIN {
                if self.heard() > before {
                    return Ok(true);
                }
                tokio::time::sleep(LOOK).await;
            }
            if how != Press::Escapes {
                break;
            }
        }
        Ok(false)
    }
}

async fn press(page: &Page, how: Press) -> Outcome<()> {
    match how {
        Press::Click => page.press_at(page.boxed("button", "Stop").await?.centre()).await,
        Press::Finger => page.tap_at(page.boxed("button", "Stop").await?.centre()).await,
        Press::Escapes => {
            let (one, two) = tokio::join!(page.key("Escape"), page.key("Escape"));
            one.and(two)
        }
    }
}

#[tokio::test]
async fn a_press_stops_without_any_script() -> Outcome<()> {
    skip::unless!(ready("journey: Stop without script"));
    let mut scene = Scene::set().await?;
    let page = scene.stage.nobody("ben").await?;
    page.call("Emulation.setScriptExecutionDisabled", json!({ "value": true })).await?;
    for how in [Press::Click, Press::Finger] {
        page.goto(&scene.stage.server.url()).await?;
        says(&page, "Stop works without it.").await?;
        scene.start().await?;
        press(&page, how).await?;
        says(&page, "The robot holds still.").await?;
        scene.runs(0).await?;
        // The page after it has Stop as well.
        scene.start().await?;
        press(&page, how).await?;
        scene.runs(0).await?;
        page.press("link", "Back to rrp").await?;
        says(&page, "Stop works without it.").await?;
    }
    Ok(())
}

#[tokio::test]
async fn a_press_stops_while_the_page_is_still_opening() -> Outcome<()> {
    skip::unless!(ready("journey: Stop while it opens"));
    let mut scene = Scene::set().await?;
    for held in [&["boot.js"][..], &["stop.js"], &["boot.js", "stop.js"]] {
        for how in PRESSES {
            // Nobody hears a key where no script has come.
            if how == Press::Escapes && held.len() == 2 {
                continue;
            }
            let page = scene.stage.nobody("ben").await?;
            for file in held {
                page.hold_back(file).await?;
            }
            page.call("Network.setBlockedURLs", json!({ "urls": PROGRAM })).await?;
            page.join(&scene.stage.server.url()).await?;
            page.call("Page.navigate", json!({ "url": scene.stage.server.url() })).await?;
            let came = match held {
                ["boot.js"] => "window.rrpHeard === null",
                ["stop.js"] => "window.rrpBegan",
                _ => "document.getElementById('stop-said')",
            };
            page.until(came, "all but what is held back is here").await?;
            scene.start().await?;
            assert!(scene.hears(&page, how).await?, "{held:?} is held back: {how:?}");
            scene.runs(0).await?;
            assert!(held.iter().all(|file| page.waits_for(file)), "{held:?} is held back: {how:?}");
        }
    }
    Ok(())
}

#[tokio::test]
async fn a_page_that_this_browser_cannot_read_says_so_and_stops() -> Outcome<()> {
    skip::unless!(ready("journey: an old browser"));
    let scene = Scene::set().await?;
    let page = scene.stage.nobody("ben").await?;
    page.instead("boot.js", "let words = form?.?.dataset;").await?;
    page.goto(&scene.stage.server.url()).await?;
    says(&page, "The page does not open.").await?;
    says(&page, "ページが開きません。").await?;
    silent(&page, "Opening …").await?;
    for how in PRESSES {
        assert!(scene.hears(&page, how).await?, "{how:?}");
    }
    says(&page, "Stopped. The robot holds still.").await?;

    let page = scene.stage.nobody("chika").await?;
    page.call("Page.enable", json!({})).await?;
    let source = "delete window.WebAssembly";
    page.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": source })).await?;
    page.goto(&scene.stage.server.url()).await?;
    says(&page, "The page does not open.").await?;
    silent(&page, "Opening …").await
}

/// What browsers have not had for long, or may be kept from having, and what takes it away.
const FEATURES: [(&str, &str); 22] = [
    ("the language", "Object.defineProperty(Navigator.prototype, 'language', { get: () => undefined })"),
    (
        "storage",
        "for (const kind of ['localStorage', 'sessionStorage']) \
        Object.defineProperty(window, kind, { get() { throw new Error('denied'); } })",
    ),
    ("Object.hasOwn", "delete Object.hasOwn"),
    ("structuredClone", "delete window.structuredClone"),
    ("at", "for (const kind of [Array, String, Uint8Array.__proto__]) delete kind.prototype.at"),
    ("findLast", "delete Array.prototype.findLast; delete Array.prototype.findLastIndex"),
    (
        "copies of lists",
        "for (const name of ['toSorted', 'toReversed', 'toSpliced', 'with']) delete Array.prototype[name]",
    ),
    ("groupBy", "delete Object.groupBy; delete Map.groupBy"),
    ("replaceAll", "delete String.prototype.replaceAll"),
    ("randomUUID", "delete Crypto.prototype.randomUUID"),
    ("withResolvers", "delete Promise.withResolvers"),
    ("AbortSignal.timeout", "delete AbortSignal.timeout; delete AbortSignal.any"),
    ("AbortController", "delete window.AbortController; delete window.AbortSignal"),
    ("WebAssembly", "delete window.WebAssembly"),
    ("sockets", "delete window.WebSocket"),
    ("fetch", "delete window.fetch"),
    ("fetch that works", "window.fetch = () => { throw new TypeError('not here'); }"),
    ("fetch that gets through", "window.fetch = () => Promise.reject(new TypeError('not here'))"),
    ("promises", "delete window.fetch; delete window.Promise"),
    ("XMLHttpRequest", "delete window.XMLHttpRequest"),
    ("requests", "delete window.fetch; delete window.XMLHttpRequest"),
    ("pointers", "addEventListener('pointerdown', event => event.stopImmediatePropagation(), true)"),
];

#[tokio::test]
async fn a_press_stops_in_browsers_that_lack_something() -> Outcome<()> {
    skip::unless!(ready("journey: Stop in older browsers"));
    let scene = Scene::set().await?;
    let all: Vec<&str> = FEATURES.iter().map(|(_, source)| *source).collect();
    let all = all.join(";\n");
    let mut wrong = String::new();
    for (name, source) in FEATURES.into_iter().chain([("all of that", all.as_str())]) {
        for how in PRESSES {
            // One of its own: the form of a press before may still be on its way, and would take the place of what is opened.
            let page = scene.stage.nobody("ben").await?;
            page.call("Page.enable", json!({})).await?;
            page.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": source })).await?;
            page.call("Network.setBlockedURLs", json!({ "urls": PROGRAM })).await?;
            page.goto(&scene.stage.server.url()).await?;
            if !scene.hears(&page, how).await? {
                writeln!(wrong, "without {name}: {how:?}")?;
            }
            page.close().await?;
        }
    }
    if wrong.is_empty() { Ok(()) } else { Err(Trouble(wrong)) }
}

/// A script with one fault.
struct Mutant {
    file: &'static str,
    line: usize,
    is_left_out: bool,
    text: String,
}

impl Mutant {
    /// Whether a person may expect this press to be heard: Escape twice needs a script, and where stop.js lacks a line of what
    /// it does for that, it does not notice.
    fn must_hear(&self, how: Press) -> bool {
        how != Press::Escapes || self.file == "boot.js" || !self.is_left_out
    }
}

/// Both scripts, broken at each of their lines: by an exception before it, and without it.
fn mutants() -> Outcome<Vec<Mutant>> {
    let mut all = Vec::new();
    for file in ["stop.js", "boot.js"] {
        let whole = std::fs::read_to_string(house::root().join("static").join(file))?;
        let lines: Vec<&str> = whole.lines().collect();
        for (at, line) in lines.iter().enumerate() {
            if line.trim().is_empty() || line.trim().starts_with("//") {
                continue;
            }
            for is_left_out in [false, true] {
                let mut broken = lines.clone();
                broken[at] = "";
                let thrown = format!("throw new Error('broken'); {line}");
                if !is_left_out {
                    broken[at] = &thrown;
                }
                all.push(Mutant { file, line: at + 1, is_left_out, text: broken.join("\n") });
            }
        }
    }
    Ok(all)
}

/// How many mutants are tried where nobody asks for all.
const TRIED: usize = 24;

/// With RRP_MUTANTS=all every one of them; else a few, chosen by RRP_SEED or by the clock.
#[tokio::test]
async fn a_press_stops_whichever_line_of_the_scripts_is_broken() -> Outcome<()> {
    skip::unless!(ready("journey: Stop with broken scripts"));
    let scene = Scene::set().await?;
    let all = mutants()?;
    let every = if std::env::var("RRP_MUTANTS").is_ok_and(|which| which == "all") { 1 } else { all.len() / TRIED };
    let asked = std::env::var("RRP_SEED").ok().and_then(|seed| seed.parse().ok());
    let clock = std::time::UNIX_EPOCH.elapsed().map_or(0, |now| now.subsec_nanos() as usize);
    let seed: usize = asked.unwrap_or(clock);
    let mut wrong = String::new();
    let mut tried = 0;
    for mutant in all.iter().skip(seed % every).step_by(every) {
        tried += 1;
        for how in PRESSES.into_iter().filter(|how| mutant.must_hear(*how)) {
            // One of its own, as above.
            let page = scene.stage.nobody("ben").await?;
            page.call("Network.setBlockedURLs", json!({ "urls": PROGRAM })).await?;
            page.instead(mutant.file, &mutant.text).await?;
            page.goto(&scene.stage.server.url()).await?;
            if !scene.hears(&page, how).await? {
                let how_broken = if mutant.is_left_out { "left out" } else { "throws" };
                writeln!(wrong, "{}, line {} {how_broken}: {how:?}", mutant.file, mutant.line)?;
            }
            page.close().await?;
        }
    }
    writeln!(std::io::stderr(), "{tried} of {} mutants tried, with RRP_SEED={seed}", all.len())?;
    if wrong.is_empty() { Ok(()) } else { Err(Trouble(wrong)) }
}
