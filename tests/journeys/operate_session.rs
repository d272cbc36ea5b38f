//! A whole session on the operator's page, from the invitation to the printed report, on the stand-in for a NAO: by finger and by
//! keys. A tablet that slept, and several people at once.

use base64::Engine;
use house::{Outcome, Page, StandIn, Switch, TILES, WallClock, skip};
use serde_json::json;
use std::time::Instant;

use crate::invite::{follow, invite};
use crate::operate::{DOTS, RUN_MS, of_recording, operates, operates_tiles, shows, starts};
use crate::real_robot::add_at;
use crate::steps::*;

/// The hand of somebody.
#[derive(Clone, Copy, PartialEq)]
enum By {
    Finger,
    Keys,
}

impl By {
    /// Presses a button or follows a link.
    async fn press(self, page: &Page, role: &str, name: &str) -> Outcome<()> {
        match self {
            Self::Finger => page.tap(role, name).await,
            Self::Keys => {
                page.on(role, name, "function () { this.focus(); }").await?;
                page.key("Enter").await
            }
        }
    }

    /// Presses a tile, or something with a key of its own.
    async fn tile(self, page: &Page, key: &str, name: &str) -> Outcome<()> {
        match self {
            Self::Finger => page.tap("button", name).await,
            Self::Keys => page.key(key).await,
        }
    }
}

/// The sheets that the page takes on paper.
async fn printed(page: &Page) -> Outcome<usize> {
    let printed = page.call("Page.printToPDF", json!({ "preferCSSPageSize": true })).await?;
    let bytes = base64::engine::general_purpose::STANDARD.decode(printed["data"].as_str().unwrap_or_default());
    let bytes = bytes.map_err(|error| house::Trouble::from(error.to_string()))?;
    Ok(String::from_utf8_lossy(&bytes).matches("/Type /Page\n").count())
}

/// A session: what takes five minutes beside a child is pressed here one after the other.
async fn session(by: By, part: &str) -> Outcome<()> {
    let Some(robot) = StandIn::start(part, &[])? else { return Ok(()) };
    let stage = Stage::set_with(house::folder()?, &["--listen", "0.0.0.0:0"]).await?;
    let aiko = stage.person("aiko").await?;
    aiko.brings_tiles().await?;
    add_at(&aiko, robot.address()).await?;
    aiko.find("button", "Robot: Blue").await?;
    aiko.press("button", "Robot: Blue").await?;
    aiko.press("menuitem", "Take control").await?;
    says(&aiko, "Awake").await?;
    let link = invite(&aiko, "start and stop", "for a day", "Ben").await?;

    let ben = follow(&stage, "ben", &link).await?;
    ben.size(1180, 820, by == By::Finger).await?;
    by.press(&ben, "button", "Come in").await?;
    usable(&ben).await?;
    let blue = "(() => {
        const select = document.querySelector('select.op-select');
        const blue = [...(select?.options ?? [])].find(option => option.textContent === 'Blue');
        if (!blue) return false;
        select.value = blue.value;
        return select.dispatchEvent(new Event('change', { bubbles: true }));
    })()";
    ben.until(blue, "the robot is chosen").await?;
    by.press(&ben, "button", TILES).await?;
    says(&ben, "Ready to start").await?;
    by.press(&ben, "button", "Start …").await?;
    ben.until("document.activeElement.id === 'op-code'", "the code is asked for").await?;
    ben.type_text("P-07").await?;
    by.press(&ben, "button", "Start").await?;
    ben.find("button", "Running").await?;
    // The card over the tiles is long gone by then.
    ben.until("document.querySelector('.op-clock b').textContent >= '0:02'", "the clock goes").await?;

    by.tile(&ben, "1", "Hello*").await?;
    robot.until_called("ALTextToSpeech", "say").await?;
    by.tile(&ben, "4", "Wave*").await?;
    ben.until(&format!("{} === 'asks'", shows("Wave")), "it asks").await?;
    ben.until(&format!("{} === 'ready'", shows("Wave")), "silence is no").await?;
    by.tile(&ben, "7", "laughs*").await?;
    by.tile(&ben, "9", "looks away*").await?;
    ben.until(&format!("{} === 'on'", shows("looks away")), "the span goes on").await?;
    // A tile rests for a moment after its press.
    says(&ben, "0:01 · again ends it").await?;
    by.tile(&ben, "9", "looks away*").await?;
    ben.until(&format!("{} !== 'on'", shows("looks away")), "the span has ended").await?;
    by.tile(&ben, "m", "Mark").await?;
    by.tile(&ben, "n", "Add a note …").await?;
    ben.until("document.activeElement.id === 'op-note'", "the note has the keyboard").await?;
    ben.type_text("gives the ball").await?;
    ben.key("Enter").await?;
    says(&ben, "“gives the ball”").await?;
    silent(&ben, "waits here").await?;
    match by {
        By::Finger => ben.tap("button", "Stop").await?,
        By::Keys => {
            ben.key("Escape").await?;
            ben.key("Escape").await?;
        }
    }
    says(&ben, "Stopped. The robot holds still.").await?;
    says(&ben, "Ready to start").await?;

    // The way to the report opens beside the page, which stays with the robot.
    let list = ben.on("link", "Recordings", "function () { return this.href; }").await?;
    ben.goto(list.as_str().unwrap_or_default()).await?;
    by.press(&ben, "link", "P-07 *").await?;
    ben.find("link", "Report").await?;
    by.press(&ben, "link", "Report").await?;
    let lines = ["Session report", "P-07", "By hand, 1", "Marks, 3", "looks away", "gives the ball"];
    for line in lines {
        says(&ben, line).await?;
    }
    says(&ben, "Replay: same as recorded").await?;
    assert!(printed(&ben).await? >= 1, "it is printed");
    calm(&aiko)
}

#[tokio::test]
async fn a_session_by_finger_from_the_invitation_to_the_printed_report() -> Outcome<()> {
    skip::unless!(ready("journey: a session by finger"));
    session(By::Finger, "journey: a session by finger").await
}

#[tokio::test]
async fn a_session_by_keys_from_the_invitation_to_the_printed_report() -> Outcome<()> {
    skip::unless!(ready("journey: a session by keys"));
    session(By::Keys, "journey: a session by keys").await
}

#[tokio::test]
async fn a_tablet_that_slept_for_five_minutes_presses_nothing_twice_and_has_the_right_time() -> Outcome<()> {
    skip::unless!(ready("journey: a tablet that slept"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    aiko.size(1180, 820, true).await?;
    let (socket, clock) = (Switch::install(&aiko).await?, WallClock::install(&aiko).await?);
    operates(&stage, &aiko).await?;
    let began = Instant::now();
    starts(&aiko, "P-07").await?;
    aiko.tap("button", "Waving*").await?;
    aiko.until(&format!("{DOTS} === 1"), "a press").await?;
    // The link is cut in the middle of a tile, a moment is marked, and the cover is closed.
    aiko.eval("document.querySelectorAll('.op-tile')[1].click(), globalThis.isCut = true, globalThis.sockets.forEach(socket => socket.close()), 0").await?;
    aiko.tap("button", "Mark").await?;
    let before = of_recording(&stage, "t").await?.len();
    assert_eq!(before, 0, "the mark waits");
    aiko.call("Page.setWebLifecycleState", json!({ "state": "frozen" })).await?;
    clock.forward(300_000).await?;
    aiko.call("Page.setWebLifecycleState", json!({ "state": "active" })).await?;
    socket.mend().await?;
    silent(&aiko, "No connection for").await?;
    aiko.find("button", "Running").await?;
    // The run went on for as long as it did, not for as long as this tablet believes.
    let most = began.elapsed().as_millis() + 2_000;
    aiko.until(&format!("{RUN_MS} > 0 && {RUN_MS} < {most} + 30_000"), "the clock is right").await?;
    silent(&aiko, "waits here").await?;
    says(&aiko, "waited longer than a minute").await?;
    assert_eq!(of_recording(&stage, "t").await?.len(), 1, "the mark is there once");
    // The presses before the sleep are older than the two minutes that are shown.
    aiko.until(&format!("{DOTS} === 0"), "the two minutes went on").await?;
    aiko.tap("button", "“That tickles!”*").await?;
    aiko.until(&format!("{DOTS} === 1"), "the tiles work again").await?;
    calm(&aiko)
}

#[tokio::test]
async fn two_operators_and_an_editor_see_what_each_of_them_does() -> Outcome<()> {
    skip::unless!(ready("journey: two operators and an editor"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    operates_tiles(&stage, &aiko).await?;
    starts(&aiko, "P-07").await?;
    let yuki = stage.nobody("yuki").await?;
    yuki.goto(&format!("{}operate", stage.server.url())).await?;
    yuki.find("button", "Running").await?;
    let hash = aiko.eval("location.hash").await?;
    let ken = stage.nobody("ken").await?;
    ken.goto(&format!("{}?graph{}", stage.server.url(), hash.as_str().unwrap_or_default())).await?;
    usable(&ken).await?;
    ken.find("button", "Running").await?;

    // The editor marks and presses a button; both operators see it.
    ken.fill("textbox", "What happens now?", "points at it").await?;
    ken.press("button", "Mark").await?;
    for operator in [&aiko, &yuki] {
        says(operator, "“points at it”").await?;
    }
    ken.press("button", "Go on*").await?;
    for operator in [&aiko, &yuki] {
        operator.until(&format!("{DOTS} === 1"), "the press of the editor is seen").await?;
    }
    // The other operator sees each press and mark, and the graph shows what comes of it.
    yuki.press("button", "Hello*").await?;
    aiko.until(&format!("{DOTS} === 2 && {} === 'by'", shows("Hello")), "the press of the other one is seen").await?;
    aiko.press("button", "laughs*").await?;
    says(&yuki, "laughs").await?;
    // An edit while it runs changes nothing of the run.
    rename_stream(&ken).await?;
    aiko.find("button", "Running").await?;
    // The Stop of any of them is everybody's.
    ken.press("button", "Stop").await?;
    for operator in [&aiko, &yuki] {
        says(operator, "stopped the robot").await?;
        operator.press("button", "I have read it").await?;
        says(operator, "Ready to start").await?;
    }
    at_rest(&ken).await?;
    assert_eq!(of_recording(&stage, "word").await?, ["", "laughs"]);
    calm(&aiko)?;
    calm(&yuki)?;
    calm(&ken)
}

/// Gives a stream another name on the graph.
async fn rename_stream(page: &Page) -> Outcome<()> {
    page.press("button", "Wave, *").await?;
    page.key("F2").await?;
    page.key("Control+a").await?;
    page.type_text("Big wave").await?;
    page.key("Enter").await?;
    page.find("button", "Big wave, *").await?;
    saved(page).await
}
