//! Comparing: a number is turned over a recorded session by the keyboard and by a finger, and its counts are there; before it is
//! saved, and while somebody else edits.

use crate::steps::*;
use behaviour::{Id, Kind, Operation, Procedure, Record, RecordId, connectors};
use house::{Outcome, Page, SESSION, Trouble, keep_session, keep_session_program, skip};
use shell::Client;

/// The chip of the condition that keeps close balls.
const CHIP: &str = "filter (distance < 0.5), connector from Distance to Close ball";
/// The sum of what changes, in words.
const COUNTS: &str = "(document.querySelector('.past-counts')?.innerText ?? '')";
/// The moment at which what is nearer than 0.5 m, and not than 0.4 m, is seen first.
const FIRST_MS: u64 = 5_200;
/// The words that say that something is not as it was.
const CHANGED: &str = "/only (now|before)|moved/";
/// True once nothing changes.
const ALL_SAME: &str = "document.querySelector('.past-sum')?.textContent === 'Nothing would be different.'";
/// True while what is compared is not saved yet.
const UNSAVED: &str = "document.querySelector('.past-unsaved')?.hidden === false";
/// True if the thumb of the slider has the keyboard.
const THUMB: &str = "document.activeElement.type === 'range'";

/// A server with a recorded session and its program, which somebody else has open too.
async fn recorded() -> Outcome<(Stage, Client)> {
    let folder = house::folder()?;
    keep_session(folder.path())?;
    let stage = Stage::set_with(folder, &[]).await?;
    let yuki = keep_session_program(&stage.server.url()).await?;
    Ok((stage, yuki))
}

/// Opens the session; its program is there too.
async fn looks_back(stage: &Stage, page: &Page) -> Outcome<()> {
    page.goto(&format!("{}?past={SESSION}", stage.server.url())).await?;
    usable(page).await?;
    page.until("document.querySelectorAll('.past-label').length > 4", "the lanes are there").await?;
    page.until("document.querySelectorAll('.stream').length === 6", "the program is open").await.map(drop)
}

/// Turns the slider again and again, so that it does not rest and nothing is saved, until something is so.
async fn held(page: &Page, until: &str, what: &str) -> Outcome<()> {
    let hold = "(() => {
        const slider = document.querySelector('.flyout .slider input');
        let at = 0;
        window.held = setInterval(() => {
            slider.value = ++at % 2 ? '0.4' : '0.35';
            slider.dispatchEvent(new Event('input', { bubbles: true }));
        }, 50);
    })(), 0";
    page.eval(hold).await?;
    page.until(until, what).await?;
    page.eval("clearInterval(window.held), 0").await.map(drop)
}

#[tokio::test]
async fn a_number_is_turned_by_keys_and_shows_what_would_change() -> Outcome<()> {
    skip::unless!(ready("journey: compare by keyboard"));
    let (stage, yuki) = recorded().await?;
    let aiko = stage.nobody("aiko").await?;
    looks_back(&stage, &aiko).await?;
    aiko.eval("document.querySelector('.past').focus(), 0").await?;
    aiko.key("b").await?;
    aiko.until(ALL_SAME, "it is the program that ran").await?;
    aiko.until(&format!("/^\\d+ same$/.test({COUNTS}.trim())"), "all are the same").await?;

    // A sentence's number is typed and not saved: its counts are there, in words and for who hears them.
    aiko.on("button", "Change: 0.5", "function () { this.focus(); return true; }").await?;
    aiko.key("ArrowDown").await?;
    aiko.until(NUMBER_IS_TYPED, "the number is a field").await?;
    aiko.until(&format!("{CHANGED}.test({COUNTS})"), "the counts are there").await?;
    aiko.until(UNSAVED, "it says that it is not saved yet").await?;
    aiko.until(&format!("{CHANGED}.test(document.querySelector('.past-said').textContent)"), "it is said").await?;
    aiko.key("Escape").await?;
    aiko.until(ALL_SAME, "what was not saved leaves nothing behind").await?;
    aiko.until(&format!("!({UNSAVED})"), "and nothing waits").await?;

    // The slider of the condition: what it would change is there while it is held.
    aiko.on("button", CHIP, "function () { this.focus(); return true; }").await?;
    aiko.key("Enter").await?;
    aiko.until("document.activeElement.matches('.flyout .stepper input')", "the keyboard is in the number").await?;
    aiko.key("Tab").await?;
    aiko.key("Tab").await?;
    aiko.until(THUMB, "the keyboard is on the slider").await?;
    held(&aiko, &format!("{UNSAVED} && {CHANGED}.test({COUNTS})"), "the counts are there before it is saved").await?;
    saved(&aiko).await?;
    aiko.until(&format!("!({UNSAVED}) && {CHANGED}.test({COUNTS})"), "and once it is saved").await?;
    let label = |part: &str| {
        let of = format!("one.querySelector('.past-label {part}')?.textContent ?? ''");
        format!("[...document.querySelectorAll('.past-row')].map(one => {of})")
    };
    aiko.until(&format!("{}[0] === 'Distance'", label("span")), "whose number is another one is first").await?;
    let changed = format!("['Close ball', 'Far ball', 'Head and body tracker'].includes({}[1])", label("span"));
    aiko.until(&changed, "what changed is next").await?;
    aiko.until(&format!("{}.some(counts => /→/.test(counts))", label("b")), "with its counts").await?;
    says(&aiko, "What the participant would have done otherwise is not known.").await?;
    says(&aiko, "The head would have looked elsewhere.").await?;

    // The table has a column for it.
    aiko.eval("document.querySelector('.past-canvas').focus(), 0").await?;
    aiko.until(
        "[...document.querySelectorAll('.past-table th')].some(one => one.textContent === 'What is different')",
        "the table says what is different",
    )
    .await?;
    aiko.key("Control+z").await?;
    aiko.until(ALL_SAME, "undone, all are the same again").await?;

    // Somebody else edits: the counts follow.
    yuki_edits(&yuki).await?;
    aiko.until(&format!("{CHANGED}.test({COUNTS})"), "the other's edit counts").await?;

    // The version before and the one now, from the history.
    let choose = "(() => { const list = document.querySelector('.past-form'); list.value = 'revisions'; \
        list.dispatchEvent(new Event('change', { bubbles: true })); return true; })()";
    aiko.eval(choose).await?;
    aiko.find("combobox", "Version before").await?;
    aiko.until(&format!("{CHANGED}.test({COUNTS})"), "two versions differ").await?;
    let same = "(() => { const lists = [...document.querySelectorAll('.past-compare .past-select')].slice(1); \
        if (lists.length < 2) return false; lists[1].value = lists[0].value; \
        lists[1].dispatchEvent(new Event('change', { bubbles: true })); return true; })()";
    aiko.until(same, "both lists are there").await?;
    aiko.until(ALL_SAME, "a version does what it did").await?;

    aiko.eval("document.querySelector('.past').focus(), 0").await?;
    aiko.key("b").await?;
    aiko.until("!document.querySelector('.past-compare')", "it is over").await?;
    aiko.until(
        "document.querySelector('.past-row .past-label span').textContent === 'Ball'",
        "the lanes are as before",
    )
    .await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_number_is_turned_by_a_finger_and_shows_what_would_change() -> Outcome<()> {
    skip::unless!(ready("journey: compare by finger"));
    let (stage, _yuki) = recorded().await?;
    let aiko = stage.nobody("aiko").await?;
    aiko.size(1180, 820, true).await?;
    looks_back(&stage, &aiko).await?;
    aiko.tap("button", "Compare").await?;
    aiko.until(ALL_SAME, "it is the program that ran").await?;
    // The number stands in the sentence: each press counts at once, and what is elsewhere pressed saves it.
    aiko.tap("button", "Change: 0.5").await?;
    aiko.until(NUMBER_IS_TYPED, "the number is a field").await?;
    aiko.tap("button", "Less").await?;
    aiko.until(&format!("{UNSAVED} && {CHANGED}.test({COUNTS})"), "the counts are there before it is saved").await?;
    aiko.tap("button", "To the mark before").await?;
    aiko.until(&format!("{CHANGED}.test({COUNTS})"), "the counts are there").await?;
    saved(&aiko).await?;
    aiko.find("button", "Stop*").await?;
    aiko.tap("button", "Undo*").await?;
    aiko.until(ALL_SAME, "undone, all are the same again").await?;
    aiko.no_errors()
}

/// The words in an open dialog of what would come of it.
const PREVIEW: &str = "(document.querySelector('.dialog .dialog-preview:not(.old)')?.innerText ?? '')";
/// The words in an open dialog that nothing comes of what is typed.
const NO_PREVIEW: &str = "(document.querySelector('.dialog .dialog-preview.old')?.innerText ?? '')";
/// True while all that is shown is marked as of before.
const IS_OLD: &str = "!!document.querySelector('.past-old') && !!document.querySelector('.past-changes.old table')";
/// The moment of the cursor, in milliseconds since Start.
const CURSOR: &str = "Number(document.querySelector('.past-canvas').dataset.cursor)";
/// The name of the chosen lane.
const CHOSEN: &str = "document.querySelector('.past-row.chosen .past-label span').textContent";
/// Selects what is written in the field of a procedure.
const SELECT_ALL: &str = "function () { this.focus(); this.select(); return true; }";

/// Waits until a row of the table beside the graph has led to its lane and its first difference.
async fn led_to(page: &Page, lane: &str, first_ms: u64) -> Outcome<()> {
    page.until(&format!("{CHOSEN} === '{lane}' && {CURSOR} === {first_ms}"), "its first difference is chosen")
        .await
        .map(drop)
}

#[tokio::test]
async fn what_is_typed_in_a_dialog_shows_by_keys_what_would_change_before_it_is_saved() -> Outcome<()> {
    skip::unless!(ready("journey: a draft is compared by keyboard"));
    let (stage, yuki) = recorded().await?;
    let aiko = stage.nobody("aiko").await?;
    looks_back(&stage, &aiko).await?;
    aiko.eval("document.querySelector('.past').focus(), 0").await?;
    aiko.key("b").await?;
    aiko.until(ALL_SAME, "it is the program that ran").await?;
    open_dialog(&aiko).await?;
    aiko.on("textbox", "Procedure", SELECT_ALL).await?;
    aiko.type_text("distance < 0.4").await?;
    aiko.until(&format!("{CHANGED}.test({PREVIEW})"), "the dialog says what would come of it").await?;
    aiko.until(&format!("{UNSAVED} && {CHANGED}.test({COUNTS})"), "and so do the lanes").await?;
    aiko.until("document.querySelectorAll('.past-limit').length === 2", "both numbers are beside their lane").await?;

    // What cannot run says so, and what was shown stays, marked.
    aiko.key("Backspace").await?;
    aiko.key("Backspace").await?;
    aiko.key("Backspace").await?;
    aiko.until(&format!("/cannot run yet/.test({NO_PREVIEW}) && {IS_OLD}"), "it says that it cannot run").await?;
    aiko.until(&format!("{CHANGED}.test({COUNTS})"), "what came of it before is still there").await?;
    aiko.until("document.querySelectorAll('.past-trouble').length === 1", "it is said once").await?;
    aiko.type_text("0.45").await?;
    aiko.until(&format!("{CHANGED}.test({PREVIEW}) && !({IS_OLD})"), "mended, it counts again").await?;

    // Left as it was, nothing of it stays.
    aiko.key("Escape").await?;
    aiko.gone("dialog", "Operation").await?;
    aiko.until(ALL_SAME, "what was not saved leaves nothing behind").await?;
    aiko.until(&format!("!({UNSAVED})"), "and nothing waits").await?;
    open_dialog(&aiko).await?;
    aiko.on("textbox", "Procedure", SELECT_ALL).await?;
    aiko.type_text("distance < 0.4").await?;
    aiko.key("Control+Enter").await?;
    aiko.gone("dialog", "Operation").await?;
    saved(&aiko).await?;
    aiko.until(&format!("!({UNSAVED}) && {CHANGED}.test({COUNTS})"), "saved, it counts").await?;
    aiko.until("document.querySelector('.past-changes h2').textContent === 'With 0.4 instead of 0.5'", "in words")
        .await?;

    // Each row of the table leads to its lane and its first difference.
    let row = "function () { this.focus(); return !!this.closest('.right .past-changes'); }";
    aiko.until_on("button", "Head and body tracker", row, "the table stands beside the graph").await?;
    aiko.key("Enter").await?;
    led_to(&aiko, "Head and body tracker", FIRST_MS).await?;
    drop(yuki);
    aiko.no_errors()
}

#[tokio::test]
async fn what_is_typed_in_a_dialog_shows_by_fingers_what_would_change_before_it_is_saved() -> Outcome<()> {
    skip::unless!(ready("journey: a draft is compared by finger"));
    let (stage, _yuki) = recorded().await?;
    let aiko = stage.nobody("aiko").await?;
    aiko.size(1180, 820, true).await?;
    looks_back(&stage, &aiko).await?;
    aiko.tap("button", "Compare").await?;
    aiko.until(ALL_SAME, "it is the program that ran").await?;
    to_chip(&aiko).await?;
    aiko.tap("button", CHIP).await?;
    let seen = "(() => { const [flyout, stage] = ['.flyout', '.stage'].map(one => document.querySelector(one)?.getBoundingClientRect()); \
        return flyout && flyout.top >= stage.top - 1 && flyout.bottom <= stage.bottom + 1 && flyout.right <= stage.right + 1; })()";
    aiko.until(seen, "all of the control is on the stage").await?;
    aiko.tap("button", "More…").await?;
    aiko.within("dialog", "Operation").tap("textbox", "Procedure").await?;
    aiko.on("textbox", "Procedure", SELECT_ALL).await?;
    aiko.type_text("distance < 0.4").await?;
    aiko.until(&format!("{CHANGED}.test({PREVIEW})"), "the dialog says what would come of it").await?;
    aiko.within("dialog", "Operation").tap("button", "Save").await?;
    aiko.gone("dialog", "Operation").await?;
    saved(&aiko).await?;
    aiko.until(&format!("!({UNSAVED}) && {CHANGED}.test({COUNTS})"), "saved, it counts").await?;
    aiko.tap("button", "Head and body tracker").await?;
    led_to(&aiko, "Head and body tracker", FIRST_MS).await?;
    aiko.find("button", "Stop*").await?;
    aiko.no_errors()
}

/// Drags the graph on the low stage of a tablet until the condition is in the middle of what is free of it.
async fn to_chip(page: &Page) -> Outcome<()> {
    page.settled().await?;
    let place = "(() => { const box = selector => document.querySelector(selector).getBoundingClientRect(); \
        const [chip, stage, past] = [box('[data-chip=c4]'), box('#stage'), box('.past')]; \
        return [stage.left + 24, past.top - 16, past.top - 80 - (chip.top + chip.bottom) / 2]; })()";
    let place = page.eval(place).await?;
    let at = |index: usize| place[index].as_f64().unwrap_or_default();
    page.touch_drag((at(0), at(1)), (at(0), at(1) + at(2)), 6).await?;
    page.settled().await
}

/// Opens the dialog of the condition by keys.
async fn open_dialog(page: &Page) -> Outcome<()> {
    page.on("button", CHIP, "function () { this.focus(); return true; }").await?;
    page.key("Enter").await?;
    page.until("document.activeElement.matches('.flyout .stepper input')", "the keyboard is in the number").await?;
    page.on("button", "More…", "function () { this.focus(); return true; }").await?;
    page.key("Enter").await?;
    page.find("dialog", "Operation").await.map(drop)
}

/// Somebody else keeps only balls that are closer.
async fn yuki_edits(yuki: &Client) -> Outcome<()> {
    let said = |why: shell::ClientError| Trouble(why.to_string());
    let id = RecordId::new(Kind::Connector, &Id::new("c4").map_err(|why| Trouble(format!("{why:?}")))?);
    let open = yuki.open().ok_or("nothing is open")?;
    let Some(Record::Connector(mut filter)) = open.records.records.get(&id).cloned() else {
        return Err("there is no such connector".into());
    };
    let operation: Operation = connectors::filter::SPEC.with(Procedure::body("distance < 0.4"));
    filter.operation = operation;
    yuki.put("Nearer", id, Some(Record::Connector(filter))).await.map_err(said)?;
    Ok(())
}
