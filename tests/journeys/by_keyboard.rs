//! The walkthrough of the thesis and the tour with the keyboard alone: no mouse, no finger, from the empty library to a
//! robot that follows. Whatever has the keyboard shows that, and nothing ever loses it.

use std::sync::atomic::{AtomicU32, Ordering};

use house::{Outcome, Page, skip};

use crate::steps::*;

/// So many times Tab may be pressed on the way to something.
const TABS_MAX: u32 = 60;
/// Where the keyboard is, by its name; an empty text where it is nowhere or nothing shows it.
const HERE: &str = "(() => {
    const at = document.activeElement;
    if (!at || at === document.body || at === document.documentElement) return '';
    const probe = document.body.appendChild(document.createElement('i'));
    probe.style.color = 'var(--focus)';
    const focus = getComputedStyle(probe).color;
    probe.remove();
    const shows = element => {
        const style = getComputedStyle(element);
        const line = style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2;
        return line || style.boxShadow.includes(focus) || style.borderTopColor === focus || style.borderBottomColor === focus;
    };
    // In the room a halo shows it.
    const drawn = [...at.querySelectorAll('.halo')].some(halo => getComputedStyle(halo).stroke === focus);
    if (drawn) return (at.getAttribute('aria-label') ?? '').trim() || at.tagName;
    for (let element = at, up = 0; element && up < 4; element = element.parentElement, up += 1)
        if (shows(element)) return (at.getAttribute('aria-label') ?? at.labels?.[0]?.innerText ?? at.innerText ?? at.tagName).trim() || at.tagName;
    return '';
})()";

/// Somebody with a keyboard only, whose keys are counted.
pub(crate) struct Hands<'a> {
    page: &'a Page,
    keys: AtomicU32,
}

impl<'a> Hands<'a> {
    pub(crate) fn of(page: &'a Page) -> Self {
        Self { page, keys: AtomicU32::new(0) }
    }

    /// Presses a key; afterwards something has the keyboard and shows it.
    pub(crate) async fn key(&self, chord: &str) -> Outcome<String> {
        self.keys.fetch_add(1, Ordering::Relaxed);
        self.page.key(chord).await?;
        self.here(&format!("after {chord} something has the keyboard and shows it")).await
    }

    /// Presses a key that leads elsewhere: what comes then is looked at afterwards.
    pub(crate) async fn press(&self, chord: &str) -> Outcome<()> {
        self.keys.fetch_add(1, Ordering::Relaxed);
        self.page.key(chord).await
    }

    async fn here(&self, what: &str) -> Outcome<String> {
        let here = self.page.until(HERE, what).await?;
        Ok(here.as_str().unwrap_or_default().to_owned())
    }

    pub(crate) async fn types(&self, text: &str) -> Outcome<()> {
        self.keys.fetch_add(u32::try_from(text.chars().count()).unwrap_or(u32::MAX), Ordering::Relaxed);
        self.page.type_text(text).await
    }

    /// Waits until the keyboard is on something with this name, or one that begins like this.
    pub(crate) async fn comes_to(&self, name: &str) -> Outcome<()> {
        let quoted = serde_json::Value::from(name);
        self.page
            .until(&format!("({HERE}).startsWith({quoted})"), &format!("the keyboard is on {name}"))
            .await
            .map(drop)
    }

    /// Presses a key, again and again, until the keyboard is on something whose name begins like this.
    pub(crate) async fn goes_to(&self, key: &str, name: &str) -> Outcome<()> {
        let mut seen = Vec::new();
        for _ in 0..TABS_MAX {
            let here = self.key(key).await?;
            if here.starts_with(name) {
                return Ok(());
            }
            seen.push(here);
        }
        Err(format!("{key} does not come to {name}, but to {}", seen.join(", ")).into())
    }

    /// Presses a key, again and again, until the keyboard is in a part of the page.
    async fn goes_into(&self, key: &str, selector: &str) -> Outcome<()> {
        let mut seen = Vec::new();
        for _ in 0..TABS_MAX {
            seen.push(self.key(key).await?);
            if self.page.eval(&format!("!!document.activeElement.closest('{selector}')")).await? == true {
                return Ok(());
            }
        }
        Err(format!("{key} does not come into {selector}, but to {}", seen.join(", ")).into())
    }

    /// Takes a step of the strip under the stream that has the keyboard.
    async fn takes(&self, step: &str) -> Outcome<()> {
        self.goes_to("Tab", step).await?;
        self.press("Enter").await
    }

    /// Waits for a dialog, in which the keyboard is then.
    pub(crate) async fn in_dialog(&self, dialog: &str) -> Outcome<()> {
        self.page.find("dialog", dialog).await?;
        let inside = "!!document.activeElement?.closest('[role=dialog] :is(.dialog-body, form)')";
        self.page.until(inside, "the keyboard is in the dialog").await?;
        self.here("a field shows that it has the keyboard").await.map(drop)
    }

    /// Saves what is open with a key.
    async fn saves(&self, dialog: &str) -> Outcome<()> {
        self.press("Control+Enter").await?;
        self.page.gone("dialog", dialog).await?;
        saved(self.page).await
    }

    /// Makes an empty program, out of the library.
    async fn makes_program(&self, name: &str) -> Outcome<()> {
        self.goes_to("Tab", "Start with an empty program").await?;
        self.press("Enter").await?;
        self.in_dialog("Add a program").await?;
        self.types(name).await?;
        self.press("Enter").await?;
        self.page.find("button", name).await?;
        self.comes_to("Add Red ball").await
    }

    /// Red ball, its distance, and a filter that keeps the close ones; answers with what the page calls those.
    async fn close_balls(&self, number: &str) -> Outcome<String> {
        self.takes("Distance in cm").await?;
        self.comes_to("Distance, stream").await?;
        self.takes("filter").await?;
        self.in_dialog("Operation").await?;
        self.types(number).await?;
        let close = self.page.text("textbox", "Output stream name").await?;
        self.saves("Operation").await?;
        self.comes_to(&format!("{close}, stream")).await?;
        Ok(close)
    }

    /// Starts, out of the list of commands.
    async fn starts(&self) -> Outcome<()> {
        self.key("Control+k").await?;
        self.in_dialog("Keys and gestures").await?;
        self.types("start").await?;
        self.press("Enter").await?;
        self.page.find("button", "Running").await.map(drop)
    }
}

#[tokio::test]
async fn the_walkthrough_by_keyboard_alone() -> Outcome<()> {
    skip::unless!(ready("journey: by keyboard"));
    let stage = Stage::set().await?;
    let page = &stage.person("aiko").await?;
    let hands = Hands::of(page);
    hands.makes_program("By keys").await?;
    hands.key("Enter").await?;
    hands.comes_to("Red ball, sensor stream").await?;
    let close = hands.close_balls("60").await?;

    // By a wire: C begins it, Tab offers what fits.
    hands.key("c").await?;
    hands.key("Tab").await?;
    if !hands.here("the offer has the keyboard").await?.starts_with("Tracker") {
        hands.goes_to("ArrowDown", "Tracker").await?;
    }
    hands.press("Enter").await?;
    page.find("button", "Tracker, *").await?;
    hands.comes_to("Tracker, ").await?;
    hands.press("Enter").await?;
    hands.in_dialog("Tracker settings").await?;
    hands.goes_to("Tab", "Arm").await?;
    hands.types("l").await?;
    assert_eq!(page.text("combobox", "Arm").await?, "LArm");
    hands.saves("Tracker settings").await?;
    says(page, "left arm").await?;
    hands.comes_to("Tracker, ").await?;

    hands.starts().await?;
    for stream in ["Red ball", "Distance", &close] {
        shows_value(page, stream).await?;
    }
    hands.here("while it runs, something has the keyboard and shows it").await?;
    hands.press("Escape").await?;
    hands.press("Escape").await?;
    says(page, "Stopped. The robot holds still.").await?;
    at_rest(page).await?;
    let keys = hands.keys.load(Ordering::Relaxed);
    assert!(keys <= 70, "it took {keys} keys");
    calm(page)
}

/// One sentence says a program: Control+F, the sentence and Enter make what runs.
async fn says_a_program(name: &str, sentence: &str, follows: &str, trackers: u32) -> Outcome<()> {
    let stage = Stage::set().await?;
    let page = &stage.person("aiko").await?;
    let hands = Hands::of(page);
    hands.makes_program(name).await?;
    hands.key("Control+f").await?;
    hands.types(sentence).await?;
    page.until(
        "document.querySelector('.stream.ghost') && !document.querySelector('.typed .doubt')",
        "it is understood",
    )
    .await?;
    hands.press("Enter").await?;
    let count = format!(
        "!document.querySelector('.ghost') && [...document.querySelectorAll('[data-node]')].filter(node => \
         (node.getAttribute('aria-label') ?? '').startsWith('Tracker')).length === {trackers}"
    );
    page.until(&count, "the program is there, once").await?;
    saved(page).await?;
    hands.starts().await?;
    says(page, follows).await?;
    hands.press("Escape").await?;
    hands.press("Escape").await?;
    says(page, "Stopped. The robot holds still.").await?;
    at_rest(page).await?;
    calm(page)
}

#[tokio::test]
async fn the_walkthrough_is_one_sentence_by_keyboard() -> Outcome<()> {
    skip::unless!(ready("journey: walkthrough, said by keyboard"));
    let sentence = "If the red ball is closer than 60 cm, follow it with your head.";
    says_a_program("Said walkthrough", sentence, "follows red ball with head", 1).await
}

#[tokio::test]
async fn the_tour_by_keyboard_alone() -> Outcome<()> {
    skip::unless!(ready("journey: tour by keyboard"));
    let stage = Stage::set().await?;
    let page = &stage.person("aiko").await?;
    let hands = Hands::of(page);
    hands.goes_to("Tab", "Take the tour").await?;
    hands.key("Enter").await?;
    step_is(page, 1).await?;
    hands.goes_to("Shift+Tab", "Start with an empty program").await?;
    hands.press("Enter").await?;
    hands.in_dialog("Add a program").await?;
    hands.press("Enter").await?;
    step_is(page, 2).await?;
    hands.comes_to("Add Red ball").await?;
    hands.press("Enter").await?;
    step_is(page, 3).await?;
    hands.comes_to("Red ball, sensor stream").await?;
    hands.takes("Distance in cm").await?;
    step_is(page, 4).await?;
    hands.comes_to("Distance, stream").await?;
    hands.takes("filter").await?;
    hands.in_dialog("Operation").await?;
    hands.types("40").await?;
    hands.press("Enter").await?;
    step_is(page, 5).await?;
    page.gone("dialog", "Operation").await?;
    hands.takes("Tracker").await?;
    step_is(page, 6).await?;
    hands.comes_to("Tracker, ").await?;

    // The number, where the sentence says it.
    hands.goes_into("Tab", ".told").await?;
    if !hands.here("a phrase shows that it has the keyboard").await?.starts_with("Change: 40") {
        hands.goes_to("ArrowRight", "Change: 40").await?;
    }
    hands.key("Enter").await?;
    page.until("!!document.activeElement.closest('.inline.open')", "the number is a field").await?;
    hands.press("Control+a").await?;
    hands.types("60").await?;
    hands.key("Enter").await?;
    step_is(page, 7).await?;
    hands.starts().await?;
    step_is(page, 8).await?;
    hands.goes_into("Tab", ".room .movable:has(.ball-red)").await?;
    for _ in 0..4 {
        hands.key("ArrowRight").await?;
    }
    step_is(page, 9).await?;
    hands.goes_into("Tab", "#stop").await?;
    hands.press("Enter").await?;
    says(page, "That was all it takes").await?;
    hands.goes_to("Shift+Tab", "Done").await?;
    hands.press("Enter").await?;
    page.gone("complementary", "Tour").await?;
    page.until("document.activeElement !== document.body", "the keyboard is not lost with the tour").await?;
    calm(page)
}

/// Waits until the tour is at this step.
async fn step_is(page: &Page, step: u32) -> Outcome<()> {
    page.find("complementary", "Tour").await?;
    says(page, &format!("Step {step} of 9")).await
}
