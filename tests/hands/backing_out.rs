//! Escape twice is Stop where there is nothing to back out of, and only there.

use crate::steps::stage;
use house::{Outcome, Page};
use serde_json::json;

const BALLS: Option<&str> = Some("Track far and close balls");
const CHIP: &str = "filter (distance < 0.5), connector from Distance to Close ball";
/// The state of the newest press of Stop, which the page shows at once.
const STATE: &str = "(document.getElementById('stop-form').getAttribute('data-state') || 'none')";
/// So often Escape is pressed twice, wherever somebody is: what is open closes, and two are left.
const TWICE_MAX: usize = 4;

/// Where people press Escape to get out of something: what it is called, and how they get in there.
#[derive(Clone, Copy, Debug)]
enum Place {
    Find,
    Palette,
    Library,
    ControlNumber,
    SentenceNumber,
    Menu,
    Rename,
    Wire,
    Note,
    History,
}

const PLACES: [Place; 10] = [
    Place::Find,
    Place::Palette,
    Place::Library,
    Place::ControlNumber,
    Place::SentenceNumber,
    Place::Menu,
    Place::Rename,
    Place::Wire,
    Place::Note,
    Place::History,
];

impl Place {
    async fn enter(self, page: &Page) -> Outcome<()> {
        match self {
            Place::Find => {
                page.key("Control+f").await?;
                page.until("document.activeElement.id === 'find'", "the field that finds has the keyboard").await?;
                page.type_text("red").await
            }
            Place::Palette => {
                page.key("Control+k").await?;
                page.find("dialog", "Keys and gestures").await?;
                is_typed(page).await?;
                page.type_text("undo").await
            }
            Place::Library => {
                page.press("button", "Load program").await?;
                page.press("menuitem", "All programs and templates …").await?;
                page.find("dialog", "Load program").await?;
                is_typed(page).await?;
                page.type_text("balls").await
            }
            Place::ControlNumber => {
                page.press("button", CHIP).await?;
                page.on("button", CHIP, "function () { this.focus(); }").await?;
                page.key("Enter").await?;
                page.until("!!document.activeElement.closest('.flyout .stepper')", "the keyboard is in the number")
                    .await?;
                page.type_text("9").await
            }
            Place::SentenceNumber => {
                page.press("button", "Change: 0.5 m").await?;
                page.until("!!document.activeElement.closest('.inline.open')", "the number has the keyboard").await?;
                page.type_text("7").await
            }
            Place::Menu => {
                page.press_right("button", "Distance, stream").await?;
                page.until("document.activeElement.getAttribute('role') === 'menuitem'", "it is in the menu")
                    .await
                    .map(drop)
            }
            Place::Rename => {
                page.press("button", "Distance, stream").await?;
                page.key("F2").await?;
                page.until("document.activeElement.className === 'rename'", "the name is a field").await?;
                page.type_text("Far").await
            }
            Place::Wire => {
                page.press("button", "Distance, stream").await?;
                page.key("c").await?;
                page.until("!!document.querySelector('.wiring')", "a wire hangs on the keyboard").await.map(drop)
            }
            Place::Note => {
                page.press("button", "Distance, stream").await?;
                page.key("n").await?;
                page.until("document.activeElement.tagName === 'TEXTAREA'", "the note has the keyboard").await?;
                page.type_text("So").await
            }
            Place::History => {
                page.press("button", "History").await?;
                page.until("!!document.activeElement.closest('.history')", "the history has the keyboard")
                    .await
                    .map(drop)
            }
        }
    }
}

async fn is_typed(page: &Page) -> Outcome<()> {
    page.until("document.activeElement.tagName === 'INPUT'", "a field has the keyboard").await.map(drop)
}

async fn escape_twice(page: &Page) -> Outcome<()> {
    let (one, two) = tokio::join!(page.key("Escape"), page.key("Escape"));
    one.and(two)
}

/// Presses Escape until the robot stops.
async fn stops(page: &Page) -> Outcome<()> {
    for _ in 0..TWICE_MAX {
        escape_twice(page).await?;
        if page.eval(STATE).await? != "none" {
            break;
        }
    }
    page.until(&format!("{STATE} === 'stopped'"), "Escape pressed again and again stops it").await.map(drop)
}

async fn starts(page: &Page) -> Outcome<()> {
    page.press("button", "Start").await?;
    page.find("button", "Running").await?;
    page.until(&format!("{STATE} === 'none'"), "nothing is said of a Stop").await.map(drop)
}

#[tokio::test]
async fn backing_out_of_anything_stops_nothing() -> Outcome<()> {
    let stage = stage!("backing out");
    let program = stage.wire.make("Backed out of", BALLS).await?;
    for place in PLACES {
        let aiko = stage.person("aiko", &program).await?;
        aiko.press("button", "Distance, stream").await?;
        starts(&aiko).await?;
        place.enter(&aiko).await?;
        escape_twice(&aiko).await?;
        assert_eq!(aiko.eval(STATE).await?, "none", "{place:?}");
        aiko.find("button", "Running").await?;
        stops(&aiko).await?;
        aiko.find("button", "Start").await?;
        aiko.no_errors()?;
        aiko.close().await?;
    }
    Ok(())
}

#[tokio::test]
async fn two_escapes_stop_where_there_is_nothing_to_back_out_of() -> Outcome<()> {
    let stage = stage!("Escape twice");
    let program = stage.wire.make("Stopped", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    for place in ["document.body", "document.querySelector('[data-node]')", "document.querySelector('#find')"] {
        starts(&aiko).await?;
        aiko.eval(&format!("document.activeElement.blur(); {place}.focus()")).await?;
        stops(&aiko).await?;
        aiko.find("button", "Start").await?;
        aiko.until(&format!("{STATE} === 'none'"), "which is said for a moment").await?;
    }
    aiko.no_errors()
}

#[tokio::test]
async fn an_escape_that_takes_back_what_is_being_composed_is_none() -> Outcome<()> {
    let stage = stage!("Escape while composing");
    let program = stage.wire.make("Composed", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    starts(&aiko).await?;
    let press = |more: serde_json::Value| {
        let mut how = json!({ "key": "Escape", "keyCode": 27, "bubbles": true, "cancelable": true });
        how.as_object_mut().into_iter().for_each(|how| how.extend(more.as_object().cloned().unwrap_or_default()));
        format!("document.body.dispatchEvent(new KeyboardEvent('keydown', {how}));")
    };
    let (plain, chrome, safari) =
        (press(json!({})), press(json!({ "isComposing": true })), press(json!({ "keyCode": 229 })));
    for composed in [&chrome, &safari] {
        aiko.eval(&format!("{composed} {composed} {plain} {composed} {plain}")).await?;
        assert_eq!(aiko.eval(STATE).await?, "none", "{composed}");
        // An Escape that nothing is in between of is the second.
        aiko.eval(&format!("{composed} 0")).await?;
    }
    aiko.eval(&format!("{plain} {plain} 0")).await?;
    aiko.until(&format!("{STATE} === 'stopped'"), "two plain ones stop").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn what_is_said_beside_escape_is_what_it_does() -> Outcome<()> {
    let stage = stage!("the palette of Stop");
    let program = stage.wire.make("Said", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    starts(&aiko).await?;
    aiko.key("Control+k").await?;
    let dialog = aiko.within("dialog", "Keys and gestures");
    let keys = "[...document.querySelectorAll('.dialog button')].filter(one => one.innerText.includes('Esc'))
        .map(one => one.innerText.replace(/\\s+/g, ' ').trim()).join()";
    aiko.until(&format!("{keys} === 'Stop this robot Esc Esc'"), "Esc Esc stands beside one robot").await?;
    dialog.press("button", "Stop this robot*").await?;
    aiko.until(&format!("{STATE} === 'stopped'"), "and pressing it does the same").await?;
    aiko.no_errors()
}
