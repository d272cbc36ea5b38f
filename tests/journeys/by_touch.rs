//! The walkthrough of the thesis and the tour with a finger alone: no mouse, on a tablet and on a phone, from the empty
//! library to a robot that follows and stands still again. Whatever is touched is large enough for a finger.

use house::{Outcome, Page, Within, skip};
use std::time::Duration;

use crate::steps::*;

/// The least width and height of what a finger hits, in pixels; one less for edges between two pixels.
const FINGER: f64 = 43.0;
/// How often it is looked at, and so long after each other, until it rests.
const LOOKS: u32 = 100;
const LOOK: Duration = Duration::from_millis(50);

/// Somebody with fingers only. On a phone the graph is a list.
pub(crate) struct Fingers<'a> {
    pub(crate) page: &'a Page,
    pub(crate) on_phone: bool,
}

impl<'a> Fingers<'a> {
    /// Touches something that is large enough for it.
    pub(crate) async fn tap(&self, role: &str, name: &str) -> Outcome<()> {
        large_enough(name, async || self.page.hit_size(role, name).await).await?;
        self.page.tap(role, name).await
    }

    /// The same inside of something.
    pub(crate) async fn tap_in(&self, place: Within<'_>, role: &str, name: &str) -> Outcome<()> {
        large_enough(name, async || place.hit_size(role, name).await).await?;
        place.tap(role, name).await
    }

    /// Takes a step of those under the selected stream.
    async fn takes(&self, stream: &str, step: &str) -> Outcome<()> {
        let strip = format!("Next steps for {stream}");
        let place = if self.on_phone {
            self.page.within("main", "The program as a list")
        } else {
            self.page.within("toolbar", &strip)
        };
        self.tap_in(place, "button", step).await
    }

    /// Makes an empty program, out of the library.
    async fn makes_program(&self, name: &str) -> Outcome<()> {
        self.tap("button", "Start with an empty program").await?;
        let dialog = self.page.within("dialog", "Add a program");
        self.tap_in(dialog, "textbox", "Name").await?;
        self.page.key("Control+a").await?;
        self.page.type_text(name).await?;
        self.tap_in(dialog, "button", "Create").await?;
        self.page.gone("dialog", "Add a program").await?;
        self.page.find("heading", "Add a sense to begin").await.map(drop)
    }

    /// A filter out of what is selected, with this number; answers with what the page calls what comes through.
    async fn filters(&self, stream: &str, number: &str) -> Outcome<String> {
        self.takes(stream, "filter").await?;
        let dialog = self.page.within("dialog", "Operation");
        self.tap_in(dialog, "textbox", "Procedure").await?;
        self.page.key("End").await?;
        self.page.type_text(number).await?;
        let close = dialog.text("textbox", "Output stream name").await?;
        self.tap_in(dialog, "button", "Save").await?;
        self.page.gone("dialog", "Operation").await?;
        saved(self.page).await?;
        Ok(close)
    }

    /// Drags the red ball of the room a little.
    async fn drags_ball(&self) -> Outcome<()> {
        let room = self.page.within("region", "Room");
        large_enough("Red ball", async || room.hit_size("image", "Red ball").await).await?;
        let (x, y) = room.find("image", "Red ball").await?.rect.centre();
        self.page.touch_drag((x, y), (x + 40.0, y), 8).await
    }
}

/// Waits until a finger hits it well: what glides over it is gone after a moment.
async fn large_enough(what: &str, size: impl AsyncFn() -> Outcome<(f64, f64)>) -> Outcome<()> {
    let mut last = (0.0, 0.0);
    for _ in 0..LOOKS {
        last = size().await?;
        if last.0 >= FINGER && last.1 >= FINGER {
            return Ok(());
        }
        tokio::time::sleep(LOOK).await;
    }
    Err(format!("a finger hits “{what}” only on {} by {}", last.0, last.1).into())
}

async fn walkthrough(size: (u32, u32), on_phone: bool) -> Outcome<()> {
    let stage = Stage::set().await?;
    let page = &stage.nobody("aiko").await?;
    page.size(size.0, size.1, true).await?;
    page.goto(&stage.server.url()).await?;
    usable(page).await?;
    let fingers = Fingers { page, on_phone };
    fingers.makes_program("By touch").await?;
    fingers.tap("button", "Add Red ball").await?;
    fingers.takes("Red ball", "Distance in cm").await?;
    let close = fingers.filters("Distance", "60").await?;
    fingers.takes(&close, "Tracker").await?;
    saved(page).await?;
    fingers.takes("Tracker", "Edit").await?;
    let dialog = page.within("dialog", "Tracker settings");
    fingers.tap_in(dialog, "radio", "whole body").await?;
    fingers.tap_in(dialog, "button", "Save").await?;
    page.gone("dialog", "Tracker settings").await?;
    fingers.tap("button", "Start").await?;
    page.find("button", "Running").await?;
    says(page, "follows red ball with whole body").await?;
    fingers.drags_ball().await?;
    fingers.tap("button", "Stop").await?;
    says(page, "Stopped. The robot holds still.").await?;
    at_rest(page).await?;
    calm(page)
}

#[tokio::test]
async fn the_walkthrough_by_touch_on_a_tablet() -> Outcome<()> {
    skip::unless!(ready("journey: by touch on a tablet"));
    walkthrough((1180, 820), false).await
}

#[tokio::test]
async fn the_walkthrough_by_touch_on_a_phone() -> Outcome<()> {
    skip::unless!(ready("journey: by touch on a phone"));
    walkthrough((390, 844), true).await
}

#[tokio::test]
async fn the_walkthrough_by_touch_on_a_phone_held_sideways() -> Outcome<()> {
    skip::unless!(ready("journey: by touch on a phone held sideways"));
    walkthrough((844, 390), false).await
}

/// One sentence says a program: a finger opens the field, takes what is understood and starts it.
async fn says_a_program(name: &str, sentence: &str, follows: &str) -> Outcome<()> {
    let stage = Stage::set().await?;
    let page = &stage.nobody("aiko").await?;
    page.size(1180, 820, true).await?;
    page.goto(&stage.server.url()).await?;
    usable(page).await?;
    let fingers = Fingers { page, on_phone: false };
    fingers.makes_program(name).await?;
    fingers.tap("button", "More senses …").await?;
    let dialog = page.within("dialog", "Add sensor");
    fingers.tap_in(dialog, "searchbox", "Or say what it does").await?;
    page.type_text(sentence).await?;
    page.until(
        "document.querySelector('.stream.ghost') && !document.querySelector('.typed .doubt')",
        "it is understood",
    )
    .await?;
    fingers.tap("button", "Add to the graph").await?;
    page.until(
        "!document.querySelector('.ghost') && document.querySelectorAll('[data-node]').length > 3",
        "it is there",
    )
    .await?;
    saved(page).await?;
    fingers.tap("button", "Start").await?;
    page.find("button", "Running").await?;
    says(page, follows).await?;
    fingers.tap("button", "Stop").await?;
    at_rest(page).await?;
    calm(page)
}

#[tokio::test]
async fn the_walkthrough_is_one_sentence_by_touch() -> Outcome<()> {
    skip::unless!(ready("journey: walkthrough, said by touch"));
    let sentence = "If the red ball is closer than 60 cm, follow it with your head.";
    says_a_program("Said walkthrough", sentence, "follows red ball with head").await
}

/// A browser keeps a tap for itself that comes soon after a flick: Stop does not wait for the click.
#[tokio::test]
async fn stop_is_heard_as_a_finger_comes_down_also_after_a_flick() -> Outcome<()> {
    skip::unless!(ready("journey: a finger on Stop"));
    let stage = Stage::set().await?;
    let page = &stage.nobody("aiko").await?;
    page.size(844, 390, true).await?;
    page.goto(&stage.server.url()).await?;
    usable(page).await?;
    page.tap("button", "Track far and close balls*").await?;
    page.find("button", "Head tracker, *").await?;
    page.tap("button", "Start").await?;
    page.find("button", "Running").await?;
    let stop = page.find("button", "Stop").await?.rect.centre();
    let ball = page.within("region", "Room").find("image", "Red ball").await?.rect.centre();
    page.flick(ball, (ball.0 + 40.0, ball.1), 8).await?;
    page.touch_down(stop).await?;
    says(page, "Stopped. The robot holds still.").await?;
    at_rest(page).await?;
    page.touch_up().await?;
    calm(page)
}

/// Waits until the tour is at this step.
async fn step_is(page: &Page, step: u32) -> Outcome<()> {
    page.find("complementary", "Tour").await?;
    says(page, &format!("Step {step} of 9")).await?;
    card_stands(page).await
}

#[tokio::test]
async fn the_tour_by_touch_on_a_phone() -> Outcome<()> {
    skip::unless!(ready("journey: tour on a phone"));
    let stage = Stage::set().await?;
    let page = &stage.nobody("aiko").await?;
    page.size(390, 844, true).await?;
    page.goto(&stage.server.url()).await?;
    usable(page).await?;
    let fingers = Fingers { page, on_phone: true };
    fingers.tap("button", "Take the tour").await?;
    step_is(page, 1).await?;
    fingers.makes_program("Tour").await?;
    step_is(page, 2).await?;
    fingers.tap("button", "Add Red ball").await?;
    step_is(page, 3).await?;
    fingers.takes("Red ball", "Distance in cm").await?;
    step_is(page, 4).await?;
    let close = fingers.filters("Distance", "40").await?;
    step_is(page, 5).await?;
    fingers.takes(&close, "Tracker").await?;
    step_is(page, 6).await?;
    fingers.tap_in(page.within("main", "The program as a list"), "button", "Change: 40*").await?;
    page.until("!!document.activeElement.closest('.inline.open')", "the number is a field").await?;
    page.key("Control+a").await?;
    page.type_text("60").await?;
    page.key("Enter").await?;
    step_is(page, 7).await?;
    fingers.tap("button", "Start").await?;
    step_is(page, 8).await?;
    fingers.drags_ball().await?;
    step_is(page, 9).await?;
    fingers.tap("button", "Stop").await?;
    says(page, "That was all it takes").await?;
    fingers.tap("button", "Done").await?;
    page.gone("complementary", "Tour").await?;
    calm(page)
}
