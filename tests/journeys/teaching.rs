//! Learning: the tour waits for real steps, a task says what is missing until it is reached, a helper is tried on values.

use house::{Outcome, Page, skip};

use crate::steps::*;

/// Waits until the tour is at this step of nine, and says this.
async fn at_step(page: &Page, step: u32, words: &str) -> Outcome<()> {
    page.find("complementary", "Tour").await?;
    says(page, &format!("Step {step} of 9")).await?;
    says(page, words).await?;
    card_stands(page).await
}

/// Finds a command by its words and does it.
async fn command(page: &Page, words: &str) -> Outcome<()> {
    page.key("Control+k").await?;
    let asks = "document.activeElement.type === 'search' && !!document.activeElement.closest('[role=dialog]')";
    page.until(asks, "it asks which").await?;
    page.type_text(words).await?;
    page.key("Enter").await
}

/// Whether the end of what *Try it* says is where people see it.
const VERDICT_SEEN: &str = "(said => {
    const at = said?.getBoundingClientRect();
    return !!at && said.contains(document.elementFromPoint((at.left + at.right) / 2, at.bottom - 3));
})(document.querySelector('.verdict'))";

#[tokio::test]
async fn the_tour_waits_for_real_steps_and_ends_with_a_robot_that_follows() -> Outcome<()> {
    skip::unless!(ready("journey: tour"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    aiko.press("button", "Take the tour").await?;
    at_step(&aiko, 1, "Begin with an empty program").await?;
    aiko.press("button", "Start with an empty program").await?;
    aiko.within("dialog", "Add a program").press("button", "Create").await?;
    at_step(&aiko, 2, "A program begins with a sense").await?;
    aiko.within("navigation", "Find or add").press("button", "Add Red ball").await?;
    at_step(&aiko, 3, "Under the ball stands what can come next").await?;

    // Left and taken up again, on another day.
    aiko.press("button", "Leave the tour").await?;
    aiko.reload().await?;
    usable(&aiko).await?;
    aiko.find("button", "Red ball, sensor stream").await?;
    silent(&aiko, "Step 3 of 9").await?;
    command(&aiko, "take the tour").await?;
    at_step(&aiko, 3, "Under the ball stands what can come next").await?;

    select(&aiko, "Red ball").await?;
    next(&aiko, "Red ball", "Distance in cm").await?;
    at_step(&aiko, 4, "Now keep only the ball that is close").await?;
    next(&aiko, "Distance", "filter").await?;
    let dialog = aiko.within("dialog", "Operation");
    dialog.find("textbox", "Procedure").await?;
    aiko.type_text("40").await?;
    let close = dialog.text("textbox", "Output stream name").await?;
    aiko.key("Control+Enter").await?;
    at_step(&aiko, 5, "Only close balls come through").await?;
    next(&aiko, &close, "Tracker").await?;
    at_step(&aiko, 6, "Every number can be changed").await?;
    aiko.key("Escape").await?;
    aiko.within("main", "The graph").press("button", "Change: 40*").await?;
    aiko.until(NUMBER_IS_TYPED, "the number has the keyboard").await?;
    aiko.type_text("60").await?;
    aiko.key("Enter").await?;
    at_step(&aiko, 7, "The program is ready").await?;
    start(&aiko).await?;
    at_step(&aiko, 8, "Drag the red ball in the room").await?;
    let (x, y) = aiko.boxed("image", "Red ball").await?.centre();
    aiko.drag((x, y), (x + 40.0, y), 8).await?;
    at_step(&aiko, 9, "Stop always stands here").await?;
    says(&aiko, "follows red ball with head").await?;
    aiko.press("button", "Stop").await?;
    says(&aiko, "That was all it takes").await?;
    aiko.press("button", "Done").await?;
    aiko.gone("complementary", "Tour").await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_task_says_what_is_missing_until_it_is_reached() -> Outcome<()> {
    skip::unless!(ready("journey: task"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    aiko.within("list", "Tasks").press("button", "Follow only a close ball*").await?;
    let task = aiko.within("region", "Task: Follow only a close ball");
    says(&aiko, "only while that is nearer than half a metre").await?;
    task.press("button", "Try it").await?;
    says(&aiko, "The head also follows the far ball.").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    ben.find("region", "Task: Follow only a close ball").await?;

    thunderbolt(&aiko, "Distance", "filter").await?;
    let dialog = aiko.within("dialog", "Operation");
    dialog.fill("textbox", "Procedure", "distance < 0.5").await?;
    dialog.fill("textbox", "Output stream name", "Close ball").await?;
    save(&aiko, "Operation").await?;
    silent(&aiko, "The head also follows the far ball.").await?;
    aiko.press("button", "subscribe, connector from Distance to Head tracker").await?;
    aiko.key("Delete").await?;
    aiko.gone("button", "subscribe, connector from Distance to Head tracker").await?;
    saved(&aiko).await?;
    task.press("button", "Try it").await?;
    says(&aiko, "The head does not follow the close ball.").await?;
    thunderbolt(&aiko, "Close ball", "subscribe").await?;
    aiko.on("combobox", "Actuator", "function () { this.focus(); }").await?;
    aiko.type_text("Head").await?;
    save(&aiko, "Operation").await?;
    task.press("button", "Try it").await?;
    says(&aiko, "Reached. The head follows only the close ball.").await?;

    task.press("button", "Put the task away").await?;
    aiko.gone("region", "Task: Follow only a close ball").await?;
    command(&aiko, "show the task").await?;
    aiko.find("region", "Task: Follow only a close ball").await?;
    ben.find("region", "Task: Follow only a close ball").await?;
    calm(&aiko)
}

/// The study's first task: nothing is changed, it is read and said what it does.
#[tokio::test]
async fn what_a_program_does_is_explained_with_a_press_for_each_answer() -> Outcome<()> {
    skip::unless!(ready("journey: explaining"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    // So low that the questions leave no room for what is said below them.
    aiko.size(1440, 560, false).await?;
    aiko.within("list", "Tasks").press("button", "Explain the words*").await?;
    let task = aiko.within("region", "Task: Explain the words");
    task.press("button", "Try it").await?;
    says(&aiko, "Choose an answer to each question first.").await?;
    task.press("radio", "Once.").await?;
    silent(&aiko, "Choose an answer to each question first.").await?;
    task.press("radio", "Only blue.").await?;
    task.press("button", "Try it").await?;
    says(&aiko, "Look at what stands between the ball and the words").await?;
    task.press("radio", "About ten times.").await?;
    // The button is the last thing in view, so that a press on it scrolls nothing.
    aiko.on("button", "Try it", "function () { this.scrollIntoView({ block: 'end' }); }").await?;
    task.press("button", "Try it").await?;
    says(&aiko, "Reached. The robot says the color once a second, as long as it sees the ball.").await?;
    // It is said below the questions, and comes into view by itself.
    aiko.until(VERDICT_SEEN, "the end of what is said is in view").await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_helper_is_tried_on_values_before_it_is_saved() -> Outcome<()> {
    skip::unless!(ready("journey: trying a helper"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    aiko.press("button", "Track far and close balls*").await?;
    aiko.find("button", "Head tracker, *").await?;
    aiko.press("button", "Edit helper").await?;
    aiko.press("menuitem", "Distance in m*").await?;
    let dialog = aiko.within("dialog", "Edit helper");
    dialog.fill("textbox", "Value of ball", r#"{"size": 0.03}, {"size": 0.3}"#).await?;
    says(&aiko, "size 0.03 → 1").await?;
    says(&aiko, "size 0.3 → 0.1").await?;
    aiko.until("document.querySelectorAll('.dialog .marbles').length === 1", "they are marbles too").await?;
    aiko.key("Enter").await?;
    dialog.fill("textbox", "Procedure", "ball.size * 100.0").await?;
    says(&aiko, "size 0.03 → 3").await?;
    says(&aiko, "size 0.3 → 30").await?;
    aiko.key("Escape").await?;
    aiko.gone("dialog", "Edit helper").await?;
    calm(&aiko)
}
