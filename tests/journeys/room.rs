//! A robot that is played with: somebody speaks, a box comes, a part is touched, a button of the program is pressed, and
//! what is told of its body.

use house::{Outcome, Page, skip};

use crate::steps::*;

/// Waits until this stands beside a stream.
async fn shown(page: &Page, stream: &str, text: &str) -> Outcome<()> {
    let text = serde_json::Value::from(text);
    let js = format!(
        "function () {{ return this.closest('.at').querySelector('.value b')?.textContent.includes({text}); }}"
    );
    page.until_on("button", &format!("{stream}, *"), &js, &format!("{stream} shows {text}")).await.map(drop)
}

#[tokio::test]
async fn what_a_sense_would_tell_is_pretended_at_one_press() -> Outcome<()> {
    skip::unless!(ready("journey: pretending"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Pretend").await?;
    add_sense(&aiko, "Word").await?;
    start(&aiko).await?;
    select(&aiko, "Word").await?;
    aiko.press("button", "Send a value").await?;
    let dialog = aiko.within("dialog", "Send a value: Word");
    dialog.press("button", "somebody said “no”").await?;
    says(&aiko, "Sent to Word").await?;
    shown(&aiko, "Word", "no").await?;
    dialog.fill("textbox", "The word as it was chosen", "perhaps").await?;
    dialog.find("slider", "How sure the robot is, from 0 to 1").await?;
    dialog.press("button", "Send").await?;
    shown(&aiko, "Word", "perhaps").await?;
    aiko.until("!document.querySelector('.dialog details').open", "the value as text is put away").await?;
    aiko.key("Escape").await?;
    aiko.gone("dialog", "Send a value: Word").await?;
    stop(&aiko).await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_robot_hears_words_that_are_typed() -> Outcome<()> {
    skip::unless!(ready("journey: words"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Listen").await?;
    add_sense(&aiko, "Word").await?;
    start(&aiko).await?;
    aiko.fill("textbox", "Say something to the robot", "Well, yes").await?;
    aiko.key("Enter").await?;
    shown(&aiko, "Word", "yes").await?;
    stop(&aiko).await?;
    calm(&aiko)
}

#[tokio::test]
async fn an_operator_presses_a_button_of_the_program() -> Outcome<()> {
    skip::unless!(ready("journey: a button of the program"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Press").await?;
    add_sense(&aiko, "Button").await?;
    let buttons = aiko.within("group", "Buttons of the program");
    buttons.find("button", "Go on").await?;
    start(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    ben.within("group", "Buttons of the program").press("button", "Go on").await?;
    shown(&aiko, "Button", "true").await?;
    stop(&aiko).await?;
    calm(&aiko)?;
    calm(&ben)
}

#[tokio::test]
async fn a_number_presses_a_button_of_the_program_but_not_while_somebody_types() -> Outcome<()> {
    skip::unless!(ready("journey: a button by its number"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Press").await?;
    add_sense(&aiko, "Button").await?;
    start(&aiko).await?;
    aiko.fill("textbox", "Say something to the robot", "1").await?;
    aiko.key("1").await?;
    aiko.until("document.activeElement.value === '11'", "what is typed is written").await?;
    let nothing =
        "function () { return !this.closest('.at').querySelector('.value b')?.textContent.includes('true'); }";
    aiko.until_on("button", "Button, *", nothing, "and presses nothing").await?;
    aiko.until("(document.activeElement.blur(), true)", "nothing is typed into").await?;
    aiko.key("1").await?;
    shown(&aiko, "Button", "true").await?;
    stop(&aiko).await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_fall_interrupts_what_runs_until_a_person_lets_it_go_on_or_stops_it() -> Outcome<()> {
    skip::unless!(ready("journey: a fall"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Stand").await?;
    add_sense(&aiko, "Red ball").await?;
    says(&aiko, "Nothing leads to an action yet: the robot only watches.").await?;
    says(&aiko, "Battery 100 %").await?;
    start(&aiko).await?;
    aiko.press("button", "More").await?;
    aiko.press("menuitem", "Push it over").await?;
    aiko.find("button", "Continue").await?;
    says(&aiko, "Has fallen").await?;
    says(&aiko, "Interrupted: it fell; look after the robot first").await?;
    aiko.press("button", "More").await?;
    aiko.press("menuitem", "Help it up").await?;
    silent(&aiko, "Has fallen").await?;
    aiko.press("button", "Continue").await?;
    aiko.find("button", "Running").await?;
    aiko.press("button", "More").await?;
    aiko.press("menuitem", "Push it over").await?;
    aiko.find("button", "Continue").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_robot_rests_and_is_taken_again_and_has_another_name() -> Outcome<()> {
    skip::unless!(ready("journey: rest and another name"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    let ben = stage.person("ben").await?;
    aiko.press("button", "Robot: Simulated NAO").await?;
    aiko.press("menuitem", "Let it rest").await?;
    says(&aiko, "sits down to rest").await?;
    says(&ben, "Asleep").await?;
    aiko.press("button", "Robot: Simulated NAO").await?;
    aiko.press("menuitem", "Take control").await?;
    says(&ben, "Awake").await?;
    aiko.press("button", "Robot: Simulated NAO").await?;
    aiko.press("menuitem", "Rename").await?;
    let dialog = aiko.within("dialog", "Rename the robot");
    dialog.fill("textbox", "Name", "Momo").await?;
    dialog.press("button", "Save").await?;
    ben.find("button", "Robot: Momo").await?;
    calm(&aiko)?;
    calm(&ben)
}

#[tokio::test]
async fn one_looks_through_the_camera_and_everyone_is_told() -> Outcome<()> {
    skip::unless!(ready("journey: the camera"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Look").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    aiko.press("button", "Look through its camera").await?;
    let picture = "document.querySelector('.camera img')";
    aiko.until(&format!("{picture}?.naturalWidth == 160"), "a picture is there").await?;
    // One after the other.
    let sources = format!("(window.seen = (window.seen ?? new Set()).add({picture}.currentSrc)).size > 2");
    aiko.until(&sources, "a third picture comes").await?;
    aiko.find("image", "What the robot's camera sees now").await?;
    let told = "document.body.innerText.includes('Somebody looks through its camera.')";
    ben.until(told, "the other one is told").await?;
    aiko.press("button", "Look through its camera").await?;
    aiko.until(&format!("!{picture}"), "it is away").await?;
    ben.until(&format!("!({told})"), "nobody looks any more").await?;
    calm(&aiko)?;
    calm(&ben)
}

#[tokio::test]
async fn a_robot_sits_and_stands_when_somebody_presses_that_and_nothing_runs() -> Outcome<()> {
    skip::unless!(ready("journey: sit and stand"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Sit").await?;
    add_sense(&aiko, "Face").await?;
    let chosen = async |item: &str| {
        aiko.press("button", "Robot: Simulated NAO").await?;
        aiko.press("menuitem", item).await
    };
    chosen("Sit down").await?;
    says(&aiko, "“Simulated NAO” sits down.").await?;
    chosen("Stand up").await?;
    says(&aiko, "“Simulated NAO” stands up.").await?;
    start(&aiko).await?;
    chosen("Sit down").await?;
    says(&aiko, "a program runs on it; press Stop first").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    calm(&aiko)
}
