//! Presses that wait beside a Stop: each counts for the robot that it meant, and none is given up without a word.

use behaviour::Id;
use house::{Outcome, Page, skip};
use protocol::{Message, Refused, Role, request};
use serde_json::json;

use crate::operate::{DOTS, operates, shows};
use crate::robots::{add_robot, look_at};
use crate::steps::*;
use crate::visitor::{Visitor, id};

/// Takes the place of the browser's sockets: what is asked of the kind `holdsOut` waits here, and so does all that comes while
/// `holdsIn`; then the clock of the page stands, so that it does not find the server silent.
const SOURCE: &str = "(() => {
    const Real = WebSocket;
    const clock = performance.now.bind(performance);
    performance.now = () => globalThis.stillMs ?? clock();
    globalThis.heardStops = 0;
    const [out, come] = [[], []];
    globalThis.held = () => out.length;
    globalThis.sendHeld = () => { globalThis.holdsOut = ''; out.splice(0).forEach(one => one.send()); };
    globalThis.refuseHeld = no => out.splice(0).forEach(one => one.refuse(no));
    globalThis.holdIn = () => { globalThis.stillMs = clock(); globalThis.holdsIn = true; };
    globalThis.hearHeld = () => { globalThis.holdsIn = false; globalThis.stillMs = undefined; come.splice(0).forEach(one => one()); };
    globalThis.WebSocket = class extends Real {
        constructor(...of) {
            super(...of);
            const says = data => this.dispatchEvent(new MessageEvent('message', { data }));
            this.addEventListener('message', event => {
                if (globalThis.holdsIn) {
                    event.stopImmediatePropagation();
                    come.push(() => says(event.data));
                } else {
                    globalThis.heardStops = JSON.parse(event.data).event?.runs?.stops ?? globalThis.heardStops;
                }
            });
        }
        send(text) {
            const asked = JSON.parse(text);
            if (asked.request.is !== globalThis.holdsOut) return super.send(text);
            out.push({
                send: () => super.send(text),
                refuse: no => this.dispatchEvent(new MessageEvent('message', { data: JSON.stringify({ no: { ...no.no, ask: asked.ask } }) })),
            });
        }
    };
})();";

async fn holds(page: &Page) -> Outcome<()> {
    page.call("Page.enable", json!({})).await?;
    page.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": SOURCE })).await.map(drop)
}

/// Renames the program, which waits to be saved from then on, and presses Start.
async fn start_while_it_is_saved(page: &Page, from: &str, to: &str) -> Outcome<()> {
    page.eval("globalThis.holdsOut = 'propose', 0").await?;
    page.press("button", from).await?;
    let dialog = page.within("dialog", "Rename the program");
    dialog.fill("textbox", "Name", to).await?;
    dialog.press("button", "Save").await?;
    page.until("held() === 1", "the change waits").await?;
    page.gone("dialog", "Rename the program").await?;
    page.press("button", "Start").await
}

/// Stops a robot from elsewhere, until this page has heard of that.
async fn stopped(page: &Page, visitor: &mut Visitor, robot: &Id) -> Outcome<()> {
    let before = page.eval("heardStops").await?;
    visitor.ask(request::Stop { behaviour: None, robot: Some(robot.clone()) }).await?;
    page.until(&format!("heardStops > {before}"), "the page hears of the Stop").await.map(drop)
}

/// The robot that this page looks at.
async fn looked_at(page: &Page) -> Outcome<Id> {
    let robot = page.until("sessionStorage.getItem('rrp.robot')", "it is kept").await?;
    id(robot.as_str().unwrap_or_default())
}

#[tokio::test]
async fn a_start_that_waits_for_saving_counts_unless_its_own_robot_was_stopped() -> Outcome<()> {
    skip::unless!(ready("journey: Start while another robot is stopped"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    holds(&aiko).await?;
    aiko.goto(&stage.server.url()).await?;
    usable(&aiko).await?;
    add_program(&aiko, "One").await?;
    add_sense(&aiko, "Red ball").await?;
    add_robot(&aiko, "Momo").await?;
    let mut visitor = Visitor::enter(&stage.server).await?;
    let momo = looked_at(&aiko).await?;
    look_at(&aiko, "Simulated NAO*").await?;
    let other = looked_at(&aiko).await?;
    look_at(&aiko, "Momo*").await?;

    start_while_it_is_saved(&aiko, "One", "Two").await?;
    stopped(&aiko, &mut visitor, &other).await?;
    // A press for a robot stays with it.
    look_at(&aiko, "Simulated NAO*").await?;
    aiko.eval("sendHeld(), 0").await?;
    aiko.find("button", "Two").await?;
    aiko.find("button", "Start").await?;
    look_at(&aiko, "Momo*").await?;
    aiko.find("button", "Running").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;

    start_while_it_is_saved(&aiko, "Two", "Three").await?;
    stopped(&aiko, &mut visitor, &momo).await?;
    aiko.eval("sendHeld(), 0").await?;
    says(&aiko, "The robot was stopped before this came.").await?;
    at_rest(&aiko).await?;
    start(&aiko).await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_start_that_cannot_wait_any_more_says_so() -> Outcome<()> {
    skip::unless!(ready("journey: Start that is given up"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    holds(&aiko).await?;
    aiko.goto(&stage.server.url()).await?;
    usable(&aiko).await?;
    add_program(&aiko, "One").await?;
    add_sense(&aiko, "Red ball").await?;
    let given_up = "Start waited for your changes to be saved and was given up. Press Start again once they are saved.";
    let refuse = |no: Refused| {
        let no = serde_json::to_string(&Message::No { ask: None, no })?;
        Outcome::Ok(format!("globalThis.holdsOut = '', refuseHeld({no}), 0"))
    };

    start_while_it_is_saved(&aiko, "One", "Two").await?;
    aiko.eval(&refuse(Refused::Store("it is away".into()))?).await?;
    says(&aiko, given_up).await?;
    // The change is sent again by itself, and the robot does not begin to move with that.
    aiko.find("button", "Two").await?;
    saved(&aiko).await?;
    at_rest(&aiko).await?;

    // A refusal stands beside what follows from it.
    start_while_it_is_saved(&aiko, "Two", "Three").await?;
    aiko.eval(&refuse(Refused::Role(Role::Editor))?).await?;
    says(&aiko, &format!("{} {given_up}", Refused::Role(Role::Editor))).await?;
    at_rest(&aiko).await?;
    start(&aiko).await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_tile_pressed_right_after_ones_own_stop_acts_though_the_link_has_not_told_of_it() -> Outcome<()> {
    skip::unless!(ready("journey: a tile right after Stop"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    holds(&aiko).await?;
    operates(&stage, &aiko).await?;
    aiko.until("heardStops > 0", "the link told of Stops").await?;
    aiko.eval("holdIn(), 0").await?;
    stop(&aiko).await?;
    aiko.press("button", "Waving*").await?;
    aiko.eval("hearHeld(), 0").await?;
    aiko.until(&format!("{DOTS} === 1"), "the answer is here").await?;
    aiko.until(&format!("{} === 'going'", shows("Waving")), "it waves").await?;
    calm(&aiko)
}
