//! A chip as a control: its number by keys, field and slider, where the value is now, what others hold, and the panel.

use house::{Outcome, Page};

use crate::steps::{picture, stage};

const BALLS: Option<&str> = Some("Track far and close balls");
const CHIP: &str = "filter (distance < 0.5), connector from Distance to Close ball";
const FIELD: &str = "document.activeElement.closest('.flyout .stepper') !== null";
const TICK: &str = "document.querySelector('.flyout .slider .tick:not(.was)') !== null";
const SAID: &str = "(document.querySelector('.flyout .slider input')?.getAttribute('aria-valuetext') ?? '')";

/// Gives a chip the keyboard, as the arrows do.
async fn focus(page: &Page, chip: &str) -> Outcome<()> {
    page.on("button", chip, "function () { this.focus(); }").await.map(drop)
}

async fn is_chip(page: &Page, words: &str) -> Outcome<()> {
    page.find("button", &format!("{words}, connector from*")).await.map(drop)
}

#[tokio::test]
async fn a_number_is_turned_by_keys_and_each_rest_is_one_change() -> Outcome<()> {
    let stage = stage!("control keys");
    let program = stage.wire.make("Turned", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.press("button", CHIP).await?;
    focus(&aiko, CHIP).await?;
    aiko.key("Enter").await?;
    aiko.until(FIELD, "the keyboard is in the number").await?;
    picture(&aiko, "control").await?;
    aiko.key("ArrowUp").await?;
    is_chip(&aiko, "filter (distance < 0.55)").await?;
    aiko.key("Shift+ArrowUp").await?;
    is_chip(&aiko, "filter (distance < 1.05)").await?;
    aiko.key("Control+a").await?;
    aiko.type_text("0,7").await?;
    aiko.key("Enter").await?;
    is_chip(&aiko, "filter (distance < 0.7)").await?;
    aiko.type_text("9").await?;
    aiko.key("Escape").await?;
    aiko.until("document.activeElement.hasAttribute('data-chip')", "the keyboard is back on the chip").await?;
    is_chip(&aiko, "filter (distance < 0.7)").await?;
    for before in ["1.05", "0.55", "0.5"] {
        aiko.key("Control+z").await?;
        is_chip(&aiko, &format!("filter (distance < {before})")).await?;
    }

    aiko.key("F2").await?;
    aiko.until("document.activeElement.className === 'rename'", "what it makes can be named").await?;
    aiko.type_text("Near ball").await?;
    aiko.key("Enter").await?;
    aiko.find("button", "filter (distance < 0.5), connector from Distance to Near ball").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_slider_turns_it_and_shows_the_value_only_while_it_comes() -> Outcome<()> {
    let stage = stage!("control slider");
    let program = stage.wire.make("Slid", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.press("button", CHIP).await?;
    aiko.until(&format!("{SAID}.startsWith('less than 0.5')"), "the slider says the test").await?;
    assert_eq!(aiko.eval(TICK).await?, false, "without a run no tick");
    aiko.press("button", "Start").await?;
    aiko.until(TICK, "the value now has a tick").await?;
    aiko.until(&format!("/; now .*(passes|left out)$/.test({SAID})"), "and the slider says it").await?;
    aiko.until("/passes|is left out/.test(document.querySelector('.control-foot').innerText)", "and the words below")
        .await?;
    picture(&aiko, "control-runs").await?;

    let slide = "(() => { const slider = document.querySelector('.flyout .slider input');
        slider.value = '0.3'; slider.dispatchEvent(new Event('input', { bubbles: true })); })()";
    aiko.eval(slide).await?;
    is_chip(&aiko, "filter (distance < 0.3)").await?;
    let flyout = aiko.within("group", "filter (distance < 0.5)");
    aiko.until(
        "document.querySelector('.flyout').innerText.includes('The robot still uses 0.5')",
        "it says what the robot has",
    )
    .await?;
    flyout.press("button", "Use my changes").await?;
    aiko.until(
        "document.querySelector('.flyout').innerText.includes('The robot runs this version.')",
        "the robot has it now",
    )
    .await?;

    aiko.press("button", "Stop").await?;
    aiko.until(&format!("!({TICK}) && !{SAID}.includes('now')"), "after Stop nothing is now").await?;
    aiko.until("!document.querySelector('.flyout .slider-ends').innerText.includes('now')", "not in words either")
        .await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_comparison_a_helper_and_a_duration_are_chosen_where_they_stand() -> Outcome<()> {
    let stage = stage!("control choices");
    let program = stage.wire.make("Chosen", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.press("button", CHIP).await?;
    choose(&aiko, ">=").await?;
    // The other chip has the same words: it is told by where it leads.
    aiko.find("button", "filter (distance >= 0.5), connector from Distance to Close ball").await?;
    aiko.key("Control+z").await?;
    is_chip(&aiko, "filter (distance < 0.5)").await?;

    aiko.press("button", "map (Distance in m), connector*").await?;
    choose(&aiko, "distance").await?;
    is_chip(&aiko, "map (Distance in cm)").await?;
    aiko.key("Control+z").await?;
    is_chip(&aiko, "map (Distance in m)").await?;
    aiko.key("Escape").await?;

    let at = aiko.boxed("button", "subscribe, connector from Close ball to Head and body tracker").await?;
    aiko.move_to((at.centre().0, at.y - 8.0)).await?;
    aiko.move_to((at.centre().0, at.y - 6.0)).await?;
    aiko.within("main", "The graph").press("button", "Insert between Close ball and subscribe").await?;
    aiko.press("menuitem", "sample every second").await?;
    aiko.press("button", "sample (every 1 second), connector*").await?;
    aiko.until("document.querySelector('.flyout .stepper input')?.value === '1'", "its duration is in seconds").await?;
    aiko.within("group", "sample (every 1 second)").press("button", "More").await?;
    is_chip(&aiko, "sample (every 1.1 seconds)").await?;
    aiko.no_errors()
}

/// Chooses in the list of the flyout.
async fn choose(page: &Page, value: &str) -> Outcome<()> {
    page.until("document.querySelector('.flyout select') !== null", "there is a list").await?;
    let js = format!(
        "(() => {{ const list = document.querySelector('.flyout select'); list.value = {value:?};
            list.dispatchEvent(new Event('change', {{ bubbles: true }})); return list.value; }})()"
    );
    assert_eq!(page.eval(&js).await?, value);
    Ok(())
}

#[tokio::test]
async fn what_somebody_else_is_editing_is_read_only_until_they_hand_it_over() -> Outcome<()> {
    let stage = stage!("control locked");
    let program = stage.wire.make("Held", BALLS).await?;
    let (aiko, ben) = (stage.person("aiko", &program).await?, stage.person("ben", &program).await?);
    ben.press("button", CHIP).await?;
    ben.within("toolbar", "Next steps for filter").press("button", "More…").await?;
    ben.find("dialog", "Operation").await?;

    let locked = format!("{CHIP},*");
    aiko.press("button", &locked).await?;
    aiko.until("document.querySelector('.flyout .control.held-by') !== null", "it is held").await?;
    let fields = "[...document.querySelectorAll('.flyout :is(.stepper button, select, .slider input)')]";
    aiko.until(&format!("{fields}.every(one => one.disabled)"), "its fields are read only").await?;
    aiko.until("document.querySelector('.flyout').innerText.includes('It is 0.5')", "it says what holds").await?;
    picture(&aiko, "control-locked").await?;
    let flyout = aiko.within("group", "filter (distance < 0.5)");
    flyout.press("button", "Ask *").await?;
    ben.press("button", "Hand over").await?;
    aiko.until(&format!("{fields}.every(one => !one.disabled)"), "it is Aiko's where it is").await?;
    flyout.press("button", "More").await?;
    is_chip(&aiko, "filter (distance < 0.55)").await?;
    aiko.no_errors()?;
    ben.no_errors()
}

#[tokio::test]
async fn the_panel_changes_settings_and_names_in_place() -> Outcome<()> {
    let stage = stage!("panel settings");
    let program = stage.wire.make("Settings", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.press("button", "Head tracker, red ball · head, actuator stream").await?;
    let panel = aiko.within("region", "What is selected");
    panel.press("radio", "whole body").await?;
    aiko.find("button", "Head tracker, red ball · whole body, actuator stream").await?;
    panel.press("radio", "left arm").await?;
    aiko.find("button", "Head tracker, red ball · whole body · left arm, actuator stream").await?;
    picture(&aiko, "panel-settings").await?;
    panel.fill("textbox", "Stream name", "Follow").await?;
    aiko.key("Enter").await?;
    let named = "Follow, red ball · whole body · left arm, actuator stream";
    aiko.find("button", named).await?;
    panel.fill("textbox", "Stream name", "Distance").await?;
    aiko.key("Enter").await?;
    aiko.until("document.querySelector('.panel .refusal')?.innerText.endsWith('.')", "it says why not").await?;
    aiko.key("Escape").await?;
    aiko.until("document.querySelector('.settings input[type=text]').value === 'Follow'", "and takes it back").await?;
    aiko.press("button", named).await?;
    for before in ["Head tracker, red ball · whole body · left arm,*", "Head tracker, red ball · whole body,*"] {
        aiko.key("Control+z").await?;
        aiko.find("button", before).await?;
    }
    aiko.until("document.querySelector('.settings input[type=text]').value === 'Head tracker'", "the panel follows")
        .await?;
    aiko.no_errors()
}
