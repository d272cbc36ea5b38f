//! What a connector takes, in which order, and what kind it is, changed after the fact; and the same ways on a phone.

use house::{Outcome, Page};
use serde_json::json;

use crate::steps::{picture, rests, stage};

const ARM: Option<&str> = Some("Track with nearest arm");
const BALLS: Option<&str> = Some("Track far and close balls");

/// Chooses in a list that drops down, by what it shows.
async fn choose(page: &Page, list: &str, shown: &str) -> Outcome<()> {
    let js = format!(
        "function () {{ const option = [...this.options].find(option => option.text === {});
            this.value = option.value; this.dispatchEvent(new Event('input', {{ bubbles: true }}));
            this.dispatchEvent(new Event('change', {{ bubbles: true }})); }}",
        json!(shown)
    );
    page.on("combobox", list, &js).await.map(drop)
}

#[tokio::test]
async fn a_connector_takes_from_another_stream_and_becomes_another_kind() -> Outcome<()> {
    let stage = stage!("takes from");
    let program = stage.wire.make("Takes", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Distance, stream").await?;
    aiko.press_twice("button", "filter (distance < 0.5), connector from Distance to Close ball").await?;
    let dialog = aiko.within("dialog", "Operation");
    choose(&aiko, "Takes from", "Far ball").await?;
    assert_eq!(dialog.text("textbox", "Procedure").await?, "farBall < 0.5", "its body follows");
    picture(&aiko, "takes-from").await?;
    dialog.press("button", "Save").await?;
    aiko.find("button", "filter (farBall < 0.5), connector from Far ball to Close ball").await?;
    aiko.key("Control+z").await?;
    aiko.find("button", "filter (distance < 0.5), connector from Distance to Close ball").await?;
    aiko.press_twice("button", "filter (distance < 0.5), connector from Distance to Close ball").await?;
    dialog.press("radio", "map").await?;
    dialog.press("button", "Save").await?;
    aiko.find("button", "map (distance < 0.5), connector from Distance to Close ball").await?;
    aiko.key("Control+z").await?;
    aiko.find("button", "filter (distance < 0.5), connector from Distance to Close ball").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn the_inputs_of_a_connector_change_their_order() -> Outcome<()> {
    let stage = stage!("order of inputs");
    let program = stage.wire.make("Order", ARM).await?;
    let aiko = stage.person("aiko", &program).await?;
    let before = "combine (headYaw + ballAngle), connector from Head yaw and Ball angle to Arm angle";
    rests(&aiko, before).await?;
    aiko.press_twice("button", before).await?;
    let dialog = aiko.within("dialog", "Operation");
    dialog.press("button", "Earlier in the order").await?;
    dialog.press("button", "Save").await?;
    aiko.find("button", "combine (headYaw + ballAngle), connector from Ball angle and Head yaw to Arm angle").await?;
    aiko.key("Control+z").await?;
    aiko.find("button", before).await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_phone_connects_inserts_and_lists_what_is_wrong() -> Outcome<()> {
    let stage = stage!("ways on a phone");
    let program = stage.wire.make("Phone", BALLS).await?;
    let aiko = stage.phone("aiko", &program).await?;
    aiko.tap("button", "Far ball*").await?;
    aiko.tap("button", "Connect").await?;
    picture(&aiko, "phone-connect").await?;
    let dialog = aiko.within("dialog", "Connect Far ball");
    dialog.press("button", "Head and body tracker*").await?;
    aiko.gone("dialog", "Connect Far ball").await?;
    let twice = "[...document.querySelectorAll('.outline .twig')].filter(row => row.textContent.includes('Head and body tracker')).length === 2";
    aiko.until(twice, "it leads there too").await?;
    let row =
        "[...document.querySelectorAll('.outline .twig')].find(row => row.textContent.trim().startsWith('subscribe'))";
    aiko.eval(&format!("{row}.click(), 0")).await?;
    aiko.tap("button", "Insert between Far ball and subscribe").await?;
    picture(&aiko, "phone-insert").await?;
    aiko.within("dialog", "Insert here").press("button", "sample*").await?;
    aiko.until("document.querySelector('.outline').textContent.includes('Far ball every second')", "it is put in")
        .await?;
    aiko.no_errors()
}

/// Which of the open menu's items can be pressed, in their order, with a line between those about different things.
const ITEMS: &str = "[...document.querySelectorAll('[role=menu] > *')].map(item =>
    item.matches('[role=separator]') ? '-' : item.innerText.trim() + (item.disabled ? ' (off)' : '')).join(', ')";

#[tokio::test]
async fn the_menus_of_the_bar_are_drawn_from_the_list_of_commands() -> Outcome<()> {
    let stage = stage!("menus of the bar");
    let program = stage.wire.make("Menus", BALLS).await?;
    let aiko = stage.phone("aiko", &program).await?;
    aiko.tap("button", "Menu").await?;
    aiko.find("menuitem", "Load program").await?;
    let all = "Load program, Add a program, Remove program, Open a file …, Save as file, Tiles of the operator’s page, \
               Undo (off), Redo (off), History, -, \
               Add sensor, Add a helper, Edit helper, Problems, -, Over time, Recordings, Operator’s page, 日本語 (Japanese), Keys and gestures, -, Invite";
    assert_eq!(aiko.eval(ITEMS).await?, all);
    picture(&aiko, "phone-menu").await?;
    aiko.tap("menuitem", "Add sensor").await?;
    aiko.find("dialog", "Add sensor").await?;
    aiko.key("Escape").await?;
    aiko.gone("dialog", "Add sensor").await?;
    aiko.size(1180, 820, true).await?;
    aiko.tap("button", "Program").await?;
    aiko.find("menuitem", "Load program").await?;
    assert_eq!(
        aiko.eval(ITEMS).await?,
        "Load program, Add a program, Remove program, Open a file …, Save as file, Tiles of the operator’s page, -, Over time, Recordings"
    );
    aiko.no_errors()
}
