//! The page tells the truth: what fails is said, a silent server is not taken for a calm robot, what is old is not shown as
//! new, and nothing that somebody wrote or pressed is lost.

use house::{Outcome, Page, skip};
use std::process::Command;

use crate::steps::*;
use crate::stop::running_ball;
use crate::together::{add_map, write_body};

const FAILS: &str = "throw 1";

/// What the sentence beside a chip covers, and how it is shaped: one that cannot be read is a column of letters.
const BUBBLE: &str = "(() => {
    const bubble = document.querySelector('.fault');
    if (!bubble) return 'there is none';
    const box = bubble.getBoundingClientRect();
    if (box.width < 100 || box.height > 70) return `it is ${box.width} by ${box.height}`;
    for (const other of document.querySelectorAll('.stream, .chip')) {
        const that = other.getBoundingClientRect();
        const across = Math.min(box.right, that.right) - Math.max(box.left, that.left);
        const down = Math.min(box.bottom, that.bottom) - Math.max(box.top, that.top);
        if (across > 1 && down > 1) return 'it covers ' + other.getAttribute('aria-label');
    }
    return '';
})()";

#[tokio::test]
async fn what_fails_is_counted_where_people_look() -> Outcome<()> {
    skip::unless!(ready("journey: what fails"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Failing").await?;
    add_sense(&aiko, "Red ball").await?;
    thunderbolt(&aiko, "Red ball", "map").await?;
    aiko.within("dialog", "Operation").fill("textbox", "Procedure", FAILS).await?;
    save(&aiko, "Operation").await?;
    aiko.find("image", "ready").await?;
    start(&aiko).await?;

    aiko.find("image", "1 fails").await?;
    aiko.until("document.querySelector('.lamp').dataset.health === 'fails'", "the lamp has another shape").await?;
    let counted = "Number(document.querySelector('.badge.fails')?.textContent) >= 2";
    aiko.until(counted, "the chip counts").await?;
    aiko.until(&format!("{BUBBLE} === ''"), "what stands beside the chip can be read and covers nothing").await?;
    let said = "[...document.querySelectorAll('.robot [role=status]')].some(said => \
        said.textContent.startsWith('“map (throw 1)” fails:'))";
    aiko.until(said, "it is announced").await?;
    let once = "[...document.querySelectorAll('[role=status], [role=alert], [aria-live]')]
        .filter(live => live.textContent.includes('“map (throw 1)” fails:')).length === 1";
    aiko.until(once, "by one voice only").await?;
    aiko.press_at((300.0, 700.0)).await?;
    says(&aiko, "“map (throw 1)” failed").await?;
    silent(&aiko, "Nothing is missing").await?;
    aiko.press("button", "1 fails").await?;
    aiko.within("dialog", "Problems").press("button", "Select: “map (throw 1)” failed*").await?;
    aiko.gone("dialog", "Problems").await?;
    aiko.find("toolbar", "Next steps for map").await?;

    stop(&aiko).await?;
    at_rest(&aiko).await?;
    aiko.gone("button", "1 fails").await?;
    calm(&aiko)
}

#[tokio::test]
async fn while_the_server_is_silent_nothing_is_claimed() -> Outcome<()> {
    skip::unless!(ready("journey: a silent server"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    running_ball(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    ben.find("button", "Running").await?;
    signal(&stage, "-STOP")?;
    says(&aiko, "Last heard").await?;
    says(&aiko, "It may still be moving.").await?;
    aiko.find("button", "Was running").await?;
    assert!(aiko.find("button", "Was running").await?.disabled);
    aiko.until("document.querySelector('.lamp').dataset.health === 'unheard'", "the lamp is hollow").await?;
    for claim in ["All changes saved", "The robot runs this version"] {
        silent(&aiko, claim).await?;
    }
    says(&aiko, "as it was").await?;
    says(&aiko, "No connection. You can go on").await?;
    says(&aiko, "The robot goes on by itself. Stop still tries its own way.").await?;
    rename_program(&aiko, "To be stopped", "Renamed").await?;
    says(&aiko, "No connection. 1 change waits here and is sent when it is back.").await?;

    signal(&stage, "-CONT")?;
    says(&aiko, "Connected. 1 change was sent.").await?;
    saved(&aiko).await?;
    aiko.find("button", "Running").await?;
    for gone in ["Last heard", "No connection", "as it was"] {
        silent(&aiko, gone).await?;
    }
    silent(&aiko, "Connected.").await?;
    aiko.find("image", "ready").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    calm_but_lost(&aiko)
}

/// Halts the server's process, or lets it go on.
fn signal(stage: &Stage, signal: &str) -> Outcome<()> {
    let id = stage.server.id().ok_or("the server does not run")?;
    let sent = Command::new("kill").args([signal, &id.to_string()]).status()?;
    assert!(sent.success(), "{signal}");
    Ok(())
}

#[tokio::test]
async fn a_dialog_says_who_removed_its_stream() -> Outcome<()> {
    skip::unless!(ready("journey: who removed it"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let socket = stage.enter_with_switch(&aiko).await?;
    add_map(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    called_alike(&ben, &aiko).await?;
    select(&aiko, "1").await?;
    // Without a link there is no lock, so that it can be removed meanwhile.
    socket.cut().await?;
    says(&aiko, "Offline").await?;
    next(&aiko, "1", "Edit").await?;
    aiko.within("dialog", "Stream settings").fill("textbox", "Name", "Mine").await?;
    select(&ben, "1").await?;
    next(&ben, "1", "Remove").await?;
    ben.gone("button", "1, stream*").await?;
    socket.mend().await?;
    says(&aiko, " removed this. What you wrote is still here: copy it, or close.").await?;
    let sentence = aiko.within("dialog", "Stream settings").text("alert", "").await?;
    assert!(sentence.starts_with("Guest "), "it says who: {sentence}");
    calm(&aiko)
}

#[tokio::test]
async fn a_dialog_whose_connector_somebody_removed_stays_with_what_was_written() -> Outcome<()> {
    skip::unless!(ready("journey: removed under the hand"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let socket = stage.enter_with_switch(&aiko).await?;
    add_map(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    let chip = "map (1), connector*";
    // Without a link there is no lock, so that it can be removed meanwhile.
    socket.cut().await?;
    says(&aiko, "Offline").await?;
    write_body(&aiko, chip, "2 + 2").await?;
    let dialog = aiko.within("dialog", "Operation");
    ben.press("button", chip).await?;
    next(&ben, "map", "Remove").await?;
    ben.gone("button", chip).await?;
    socket.mend().await?;

    says(&aiko, " removed this. What you wrote is still here: copy it, or close.").await?;
    assert!(dialog.find("button", "Save").await?.disabled);
    aiko.key("Control+Enter").await?;
    assert_eq!(dialog.text("textbox", "Procedure").await?, "2 + 2");
    dialog.press("button", "Copy what I wrote").await?;
    says(&aiko, "Copied.").await?;

    ben.press("button", "Undo").await?;
    ben.find("button", chip).await?;
    silent(&aiko, " removed this.").await?;
    save(&aiko, "Operation").await?;
    ben.find("button", "map (2 + 2), connector*").await?;
    calm(&ben)
}

#[tokio::test]
async fn what_one_types_replaces_what_was_only_proposed() -> Outcome<()> {
    skip::unless!(ready("journey: typing"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    aiko.press("button", "Add a program").await?;
    typed_over(&aiko, "Name", "My own").await?;
    aiko.key("Enter").await?;
    aiko.find("button", "My own").await?;
    aiko.find("heading", "Add a sense to begin").await?;
    add_sense(&aiko, "Red ball").await?;
    next(&aiko, "Red ball", "Distance in cm").await?;
    aiko.find("button", "Distance, stream").await?;

    thunderbolt(&aiko, "Distance", "filter").await?;
    has(&aiko, "Procedure", "distance < ").await?;
    aiko.until("document.activeElement.tagName === 'TEXTAREA'", "the body has the keyboard").await?;
    aiko.type_text("distance > 5").await?;
    has(&aiko, "Procedure", "distance > 5").await?;
    aiko.press("textbox", "Output stream name").await?;
    aiko.until("getSelection().toString() === 'Distance > 5'", "the proposed name is selected").await?;
    aiko.type_text("Far").await?;
    has(&aiko, "Output stream name", "Far").await?;
    aiko.press("textbox", "Procedure").await?;
    aiko.key("Enter").await?;
    aiko.gone("dialog", "Operation").await?;
    sees(&aiko, &["filter (distance > 5), connector*", "Far, stream"]).await?;

    aiko.press("button", "Add a helper").await?;
    typed_over(&aiko, "Name", "twice").await?;
    aiko.key("Escape").await?;
    aiko.gone("dialog", "Add a helper").await?;
    select(&aiko, "Red ball").await?;
    next(&aiko, "Red ball", "Say…").await?;
    aiko.find("dialog", "Say a text settings").await?;
    typed_over(&aiko, "Text", "Good morning").await?;
    aiko.key("Enter").await?;
    aiko.gone("dialog", "Say a text settings").await?;
    says(&aiko, "Good morning").await?;
    calm(&aiko)
}

/// Types at once into the dialog that has just opened; that is all the field has then.
async fn typed_over(page: &Page, field: &str, text: &str) -> Outcome<()> {
    page.until_on("textbox", field, "function () { return document.activeElement === this; }", "it has the keyboard")
        .await?;
    page.type_text(text).await?;
    has(page, field, text).await
}

async fn has(page: &Page, field: &str, text: &str) -> Outcome<()> {
    let js = format!("function () {{ return this.value === {}; }}", serde_json::Value::from(text));
    page.until_on("textbox", field, &js, &format!("{field} is “{text}”")).await.map(drop)
}

#[tokio::test]
async fn what_is_old_or_an_example_is_called_so() -> Outcome<()> {
    skip::unless!(ready("journey: old values"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Old and new").await?;
    add_sense(&aiko, "Red ball").await?;
    thunderbolt(&aiko, "Red ball", "map").await?;
    aiko.within("dialog", "Operation").fill("textbox", "Procedure", "redBall.size").await?;
    says(&aiko, "for example x").await?;
    silent(&aiko, "now x").await?;
    save(&aiko, "Operation").await?;
    start(&aiko).await?;
    shows_value(&aiko, "Red ball.size").await?;
    let chip = "map (redBall.size), connector*";
    aiko.press("button", chip).await?;
    says(&aiko, "worked, ").await?;

    next(&aiko, "map", "More…").await?;
    aiko.within("dialog", "Operation").fill("textbox", "Procedure", "redBall.size * 2").await?;
    says(&aiko, "now x").await?;
    save(&aiko, "Operation").await?;
    let ring = "function () { return this.querySelector('.unused') !== null && this.ariaDescription.includes('not used yet'); }";
    let edited = "map (redBall.size * 2), connector*";
    aiko.until_on("button", edited, ring, "the chip says that it is not used yet").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    ben.until_on("button", edited, ring, "who comes later is told too").await?;
    says(&aiko, "The robot still uses redBall.size.").await?;
    silent(&aiko, "worked, ").await?;
    aiko.within("region", "Robot").press("button", "Use my changes").await?;
    let used = "function () { return this.querySelector('.unused') === null; }";
    for page in [&aiko, &ben] {
        page.until_on("button", edited, used, "it is used now").await?;
    }

    stop(&aiko).await?;
    at_rest(&aiko).await?;
    let last = "[...document.querySelectorAll('.value')].length > 0 \
        && [...document.querySelectorAll('.value')].every(value => value.matches('.quiet') && value.textContent.startsWith('last '))";
    aiko.until(last, "every value is called the last one").await?;
    calm(&aiko)
}
