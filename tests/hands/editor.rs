//! What every editor does: cut, duplicate, paste, rename by a double click, the menu key, the wheel, the list as one stop of
//! the Tab key, and where the keyboard is after a program was opened.

use house::{Outcome, Page};

use crate::steps::{rests, stage, text, view};

const BALLS: Option<&str> = Some("Track far and close balls");

async fn are(page: &Page, count: u64) -> Outcome<()> {
    let js = format!("document.querySelectorAll('[data-node]').length === {count}");
    page.until(&js, &format!("there are {count} streams")).await.map(drop)
}

async fn comes_to(page: &Page, name: &str) -> Outcome<()> {
    let js = format!("document.activeElement.getAttribute('aria-label') === {name:?}");
    page.until(&js, &format!("the keyboard is on {name}")).await.map(drop)
}

#[tokio::test]
async fn one_stream_is_duplicated_cut_and_pasted_in_its_program() -> Outcome<()> {
    let stage = stage!("cut and paste");
    let program = stage.wire.make("Cut", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Far ball, stream").await?;
    aiko.press("button", "Far ball, stream").await?;
    aiko.key("Control+d").await?;
    are(&aiko, 7).await?;
    aiko.find("button", "Far ball 2, stream").await?;
    aiko.key("Control+z").await?;
    are(&aiko, 6).await?;
    aiko.eval(
        "globalThis.was = ''; document.execCommand = () => { was = document.activeElement.value; return true; }; 0",
    )
    .await?;
    aiko.press("button", "Close ball, stream").await?;
    aiko.key("Control+x").await?;
    are(&aiko, 5).await?;
    let cut = text(&aiko.until("was", "what is cut is a text").await?).to_owned();
    assert!(cut.contains("Close ball"), "{cut}");
    let paste = format!(
        "(() => {{ const data = new DataTransfer(); data.setData('text/plain', {});
        document.querySelector('#stage').dispatchEvent(new ClipboardEvent('paste', {{ clipboardData: data, bubbles: true, cancelable: true }}));
        return 0; }})()",
        serde_json::json!(cut)
    );
    aiko.eval(&paste).await?;
    are(&aiko, 6).await?;
    aiko.find("button", "Close ball, stream").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_whole_program_that_is_pasted_is_offered_to_be_opened() -> Outcome<()> {
    let stage = stage!("paste a whole program");
    let whole = stage.wire.make("Pasted", BALLS).await?;
    let program = stage.wire.make("Seen", None).await?;
    let aiko = stage.person("aiko", &program).await?;
    let paste = format!(
        "(async () => {{ const file = await (await fetch('/api/behaviours/{whole}.xml')).text();
        const data = new DataTransfer(); data.setData('text/plain', file);
        document.querySelector('#stage').dispatchEvent(new ClipboardEvent('paste', {{ clipboardData: data, bubbles: true, cancelable: true }}));
        }})(), 0"
    );
    aiko.find("heading", "Add a sense to begin").await?;
    // A person who leaves it goes on with what is there. One who opens it has it as a program of its own.
    for (button, name, count) in [("Leave it", "Seen", 0), ("Open it", "Pasted 2", 6)] {
        aiko.eval(&paste).await?;
        aiko.within("dialog", "Open what you pasted?").press("button", button).await?;
        aiko.gone("dialog", "Open what you pasted?").await?;
        are(&aiko, count).await?;
        aiko.until(&format!("document.querySelector('header').innerText.includes({name:?})"), "its name").await?;
    }
    aiko.find("button", "Far ball, stream").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_double_click_renames_and_the_menu_key_opens_the_menu() -> Outcome<()> {
    let stage = stage!("double click");
    let program = stage.wire.make("Double", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Distance, stream").await?;
    aiko.press("button", "Close ball, stream").await?;
    aiko.key("ContextMenu").await?;
    aiko.eval(
        "document.querySelector('.context') || document.activeElement.dispatchEvent(new MouseEvent('contextmenu',
            { bubbles: true, cancelable: true, button: 0, clientX: 0, clientY: 0 })), 0",
    )
    .await?;
    aiko.find("menu", "What can be done with Close ball").await?;
    aiko.key("Escape").await?;
    aiko.gone("menu", "What can be done with Close ball").await?;
    aiko.press_twice("button", "Distance, stream").await?;
    aiko.until("document.activeElement.className === 'rename'", "the name can be typed").await?;
    aiko.type_text("How far").await?;
    aiko.key("Enter").await?;
    comes_to(&aiko, "How far, stream").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn the_wheel_scrolls_and_with_control_it_zooms_at_the_pointer() -> Outcome<()> {
    let stage = stage!("wheel");
    let program = stage.wire.make("Wheel", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    let at = rests(&aiko, "Distance, stream").await?.centre();
    let before = view(&aiko).await?;
    aiko.wheel(at, 0.0, 60.0).await?;
    aiko.until(
        &format!("new DOMMatrix(getComputedStyle(document.querySelector('.world')).transform).f < {}", before.1 - 30.0),
        "it scrolls down",
    )
    .await?;
    let scrolled = view(&aiko).await?;
    assert!((scrolled.2 - before.2).abs() < 1e-6 && (scrolled.0 - before.0).abs() < 1.0, "{before:?} {scrolled:?}");
    let at = rests(&aiko, "Distance, stream").await?.centre();
    aiko.wheel_zoom(at, 120.0).await?;
    aiko.until(
        &format!("new DOMMatrix(getComputedStyle(document.querySelector('.world')).transform).a < {}", before.2),
        "it zooms out",
    )
    .await?;
    let after = rests(&aiko, "Distance, stream").await?.centre();
    assert!((after.0 - at.0).abs() < 6.0 && (after.1 - at.1).abs() < 6.0, "{at:?} {after:?}");
    aiko.no_errors()
}

#[tokio::test]
async fn the_list_is_one_stop_of_tab_and_arrows_walk_in_it() -> Outcome<()> {
    let stage = stage!("the list by keys");
    let program = stage.wire.make("List", BALLS).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Ball, sensor stream").await?;
    aiko.key("Control+f").await?;
    aiko.until("document.activeElement.id === 'find'", "the field has the keyboard").await?;
    let stops =
        aiko.eval("[...document.querySelectorAll('.left [data-stop]')].filter(e => e.tabIndex === 0).length").await?;
    assert_eq!(stops, 1);
    aiko.key("ArrowDown").await?;
    aiko.until("document.activeElement.matches('.left .item')", "the first thing of the list has it").await?;
    aiko.key("End").await?;
    aiko.until(
        "[...document.querySelectorAll('.left .item')].at(-1) === document.activeElement",
        "the last one has it",
    )
    .await?;
    aiko.key("Tab").await?;
    aiko.until("document.activeElement.closest('.left') === null", "Tab leaves the list").await?;
    aiko.key("Shift+Tab").await?;
    aiko.until(
        "[...document.querySelectorAll('.left .item')].at(-1) === document.activeElement",
        "and comes back to it",
    )
    .await?;
    aiko.no_errors()
}

#[tokio::test]
async fn after_opening_from_the_gallery_the_keyboard_is_on_the_graph() -> Outcome<()> {
    let stage = stage!("focus after opening");
    stage.wire.make("From the gallery", BALLS).await?;
    let other = stage.wire.make("Other", Some("Greeter")).await?;
    let aiko = stage.person("aiko", &other).await?;
    rests(&aiko, "Face,*").await?;
    aiko.eval("location.hash = '#/', 0").await?;
    aiko.press("button", "From the gallery*").await?;
    comes_to(&aiko, "Ball, sensor stream").await?;
    aiko.press("button", "Load program").await?;
    aiko.press("menuitem", "Other").await?;
    aiko.until("document.activeElement.closest('#stage') !== null", "the keyboard is on the other graph").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn the_title_of_the_tab_tells_the_program_and_how_it_is() -> Outcome<()> {
    let stage = stage!("title");
    let program = stage.wire.make("Titled", BALLS).await?;
    let aiko = stage.browser.person("aiko").await?;
    aiko.size(1440, 900, false).await?;
    let link = house::Switch::install(&aiko).await?;
    aiko.goto(&format!("{}#/b/{program}", stage.server.url())).await?;
    aiko.until("document.title === 'Titled – rrp'", "its name").await?;
    aiko.press("button", "Start").await?;
    aiko.until("document.title === '▶ Titled – rrp'", "it runs").await?;
    link.cut().await?;
    aiko.until("document.title === '▶ Titled · offline – rrp'", "nothing is heard").await?;
    rests(&aiko, "Distance, stream").await?;
    aiko.press("button", "Distance, stream").await?;
    aiko.key("F2").await?;
    aiko.until("document.activeElement.className === 'rename'", "the name can be typed").await?;
    aiko.type_text("How far").await?;
    aiko.key("Enter").await?;
    aiko.until("document.title === '▶ Titled · not saved yet – rrp'", "a change waits").await?;
    link.mend().await?;
    aiko.until("document.title === '▶ Titled – rrp'", "all is saved").await?;
    Ok(())
}

#[tokio::test]
async fn where_no_list_is_shown_finding_opens_as_a_dialog() -> Outcome<()> {
    let stage = stage!("find on a tablet");
    let program = stage.wire.make("Tablet", BALLS).await?;
    let aiko = stage.fingers("aiko", &program).await?;
    rests(&aiko, "Ball, sensor stream").await?;
    aiko.key("Control+f").await?;
    let dialog = aiko.within("dialog", "Find or add");
    dialog.fill("searchbox", "Or say what it does", "far").await?;
    dialog.press("button", "Go to Far ball").await?;
    aiko.gone("dialog", "Find or add").await?;
    aiko.find("toolbar", "Next steps for Far ball").await?;
    aiko.key("Control+f").await?;
    let dialog = aiko.within("dialog", "Find or add");
    dialog.fill("searchbox", "Or say what it does", "face").await?;
    aiko.key("Escape").await?;
    aiko.until("document.querySelector('.dialog input').value === ''", "Escape clears the field first").await?;
    dialog
        .fill("searchbox", "Or say what it does", "When the red ball is nearer than 40 cm, the head follows it.")
        .await?;
    aiko.key("Enter").await?;
    aiko.gone("dialog", "Find or add").await?;
    aiko.until("document.querySelectorAll('[data-node]').length > 6", "the sentence is in the graph").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn on_a_phone_commands_work_on_the_list_and_what_is_opened_begins_at_its_top() -> Outcome<()> {
    let stage = stage!("commands on a phone");
    let program = stage.wire.make("Phone", Some("Greeter")).await?;
    stage.wire.make("Phone two", BALLS).await?;
    let aiko = stage.browser.person("aiko").await?;
    aiko.size(390, 844, true).await?;
    aiko.goto(&format!("{}#/", stage.server.url())).await?;
    aiko.until("document.querySelectorAll('.template').length > 5", "the gallery is there").await?;
    aiko.eval("scrollTo(0, 1e6), 0").await?;
    aiko.eval(&format!("location.hash = '#/b/{program}', 0")).await?;
    aiko.until("document.querySelectorAll('.twig').length > 4 && scrollY === 0", "it begins at its top").await?;
    let rows = aiko.eval("document.querySelectorAll('.twig').length").await?.as_u64().unwrap_or_default();
    aiko.eval("document.querySelector('.twig').click(), 0").await?;
    aiko.until("document.querySelector('.strip-inline .more') !== null", "what can be done is there").await?;
    aiko.key("Control+d").await?;
    aiko.until(&format!("document.querySelectorAll('.twig').length === {}", rows + 1), "it is there twice").await?;
    aiko.key("Control+z").await?;
    aiko.until(&format!("document.querySelectorAll('.twig').length === {rows}"), "once again").await?;
    // What was selected went with the undo: a name is for what is selected.
    aiko.eval("document.querySelector('.twig').click(), 0").await?;
    aiko.until("document.querySelector('.strip-inline .more') !== null", "it is selected again").await?;
    aiko.key("Control+k").await?;
    let dialog = aiko.within("dialog", "Keys and gestures");
    dialog.find("button", "Duplicate*").await?;
    assert!(dialog.find_all("button", "Zoom in*").await?.is_empty(), "there is nothing to zoom");
    dialog.press("button", "Rename F2").await?;
    aiko.until("document.querySelector('.dialog [data-first], .dialog input') !== null", "its name can be typed")
        .await?;
    aiko.no_errors()
}
