//! The walkthrough and the study's Create task with what the page suggests: few presses, fewer keys.

use std::sync::atomic::{AtomicU32, Ordering};

use house::{Outcome, Page, Within, skip};

use crate::steps::*;

/// The test that the filter is to have in the end.
const BODY: &str = "distance < 60";

/// A person whose presses and keys are counted.
struct Counted<'a> {
    page: &'a Page,
    presses: AtomicU32,
    keys: AtomicU32,
}

impl<'a> Counted<'a> {
    fn new(page: &'a Page) -> Self {
        Self { page, presses: AtomicU32::new(0), keys: AtomicU32::new(0) }
    }

    async fn press(&self, place: Within<'_>, button: &str) -> Outcome<()> {
        self.presses.fetch_add(1, Ordering::Relaxed);
        place.press("button", button).await
    }

    async fn suggested(&self, stream: &str, step: &str) -> Outcome<()> {
        self.press(self.page.within("toolbar", &format!("Next steps for {stream}")), step).await
    }

    async fn presses_radio(&self, place: Within<'_>, radio: &str) -> Outcome<()> {
        self.presses.fetch_add(1, Ordering::Relaxed);
        place.press("radio", radio).await
    }

    async fn key(&self, chord: &str) -> Outcome<()> {
        self.keys.fetch_add(1, Ordering::Relaxed);
        self.page.key(chord).await
    }

    /// RedBall, its distance, and a filter that keeps the close ones; answers with the name the page gives those.
    async fn close_balls(&self) -> Outcome<String> {
        self.press(self.page.within("navigation", "Find or add"), "Add RedBall").await?;
        self.suggested("RedBall", "distance").await?;
        self.suggested("Distance", "filter").await?;
        let dialog = self.page.within("dialog", "Operation");
        let there = dialog.text("textbox", "Body").await?;
        let missing = BODY.strip_prefix(there.as_str()).ok_or(format!("the box begins with “{there}”"))?;
        self.types(missing).await?;
        let made = dialog.text("textbox", "Output stream name").await?;
        self.key("Control+Enter").await?;
        self.page.gone("dialog", "Operation").await?;
        Ok(made)
    }

    /// The budget of the specification.
    fn within_budget(self, presses_max: u32, keys_max: u32) {
        let (presses, keys) = (self.presses.into_inner(), self.keys.into_inner());
        assert!(presses <= presses_max && keys <= keys_max, "it took {presses} presses and {keys} keys");
    }

    async fn types(&self, text: &str) -> Outcome<()> {
        self.keys.fetch_add(u32::try_from(text.chars().count()).unwrap_or(u32::MAX), Ordering::Relaxed);
        self.page.type_text(text).await
    }
}

#[tokio::test]
async fn the_walkthrough_in_few_presses() -> Outcome<()> {
    if !skip::ready("journey: quick") {
        return Ok(());
    }
    let stage = Stage::set().await?;
    let page = &stage.person("aiko").await?;
    add_program(page, "Quick").await?;
    let aiko = Counted::new(page);
    let close = aiko.close_balls().await?;
    aiko.suggested(&close, "Tracker").await?;
    page.find("button", "Tracker, *").await?;
    aiko.press(page.within("region", "Robot"), "Start").await?;
    page.find("button", "Running").await?;
    says(page, "follows red ball with head").await?;
    for stream in ["RedBall", "Distance", &close] {
        shows_value(page, stream).await?;
    }
    calm(page)?;
    aiko.within_budget(8, 4);
    Ok(())
}

#[tokio::test]
async fn the_create_task_in_few_presses() -> Outcome<()> {
    if !skip::ready("journey: create task") {
        return Ok(());
    }
    let stage = Stage::set().await?;
    let page = &stage.person("aiko").await?;
    add_program(page, "Create").await?;
    let aiko = Counted::new(page);
    let close = aiko.close_balls().await?;
    aiko.suggested(&close, "Tracker").await?;
    aiko.suggested("Tracker", "Edit").await?;
    let dialog = page.within("dialog", "Edit stream actuator");
    aiko.presses_radio(dialog, "whole body").await?;
    aiko.key("Tab").await?;
    aiko.types("l").await?;
    assert_eq!(dialog.text("combobox", "Effector").await?, "LArm");
    aiko.key("Control+Enter").await?;
    page.gone("dialog", "Edit stream actuator").await?;
    aiko.presses.fetch_add(1, Ordering::Relaxed);
    select(page, "Distance").await?;
    aiko.suggested("Distance", "otherwise").await?;
    aiko.suggested("Otherwise", "Tracker").await?;
    page.find("button", "Tracker 2, *").await?;
    aiko.press(page.within("region", "Robot"), "Start").await?;
    page.find("button", "Running").await?;
    says(page, "follows red ball with whole body").await?;
    shows_value(page, &close).await?;
    calm(page)?;
    aiko.within_budget(12, 6);
    Ok(())
}
