//! Looking back: a recorded session over time, by the keyboard alone and by a finger alone, and what runs now.

use crate::by_keyboard::Hands;
use crate::steps::*;
use house::{Outcome, Page, SESSION, keep_session, skip};

/// The moment that is looked at, in milliseconds since Start.
pub(crate) const CURSOR: &str = "Number(document.querySelector('.past-canvas').dataset.cursor)";
/// True once all lanes are there with their values and styles.
pub(crate) const THERE: &str = "document.querySelectorAll('.past-label').length > 4 && \
    getComputedStyle(document.querySelector('.past')).display === 'flex' && \
    document.querySelectorAll('.past-table tbody tr').length > 2";

async fn cursor(page: &Page) -> Outcome<f64> {
    page.eval(CURSOR).await?.as_f64().ok_or_else(|| "there is no moment".into())
}

/// A person who has come to the session by the list of recordings.
pub(crate) async fn at_session(stage: &Stage, touch: bool) -> Outcome<Page> {
    let page = stage.nobody("aiko").await?;
    if touch {
        page.size(390, 844, true).await?;
    }
    page.goto(&format!("{}recordings?language=en&chosen={SESSION}", stage.server.url())).await?;
    Ok(page)
}

#[tokio::test]
async fn a_recorded_session_is_looked_at_by_the_keyboard_alone() -> Outcome<()> {
    skip::unless!(ready("journey: look back by keyboard"));
    let folder = house::folder()?;
    keep_session(folder.path())?;
    let stage = Stage::set_with(folder, &[]).await?;
    let aiko = at_session(&stage, false).await?;
    aiko.on("link", "Look back", "function () { this.focus(); return true; }").await?;
    aiko.key("Enter").await?;
    usable(&aiko).await?;
    aiko.until(THERE, "the lanes are there").await?;
    aiko.until("document.activeElement.matches('.past')", "the keyboard is in the panel").await?;
    assert_eq!(cursor(&aiko).await?, 600_000.0, "it begins at the end");

    // From mark to mark, from value to value, by seconds, and to both ends.
    aiko.key("[").await?;
    aiko.until(&format!("{CURSOR} === 580000"), "the mark before").await?;
    aiko.key("[").await?;
    aiko.until(&format!("{CURSOR} === 420000"), "the mark before that").await?;
    aiko.key("]").await?;
    aiko.until(&format!("{CURSOR} === 580000"), "the next mark").await?;
    aiko.key("Shift+ArrowLeft").await?;
    aiko.until(&format!("{CURSOR} === 579000"), "a second earlier").await?;
    let near = "document.querySelector('.past-table [aria-current] .link')";
    aiko.until(&format!("{near} != null"), "the values around the moment are there").await?;
    aiko.key("ArrowLeft").await?;
    aiko.until(&format!("{CURSOR} === 578800"), "the value before").await?;
    aiko.key("ArrowRight").await?;
    aiko.until(&format!("{CURSOR} === 579000"), "the next value").await?;
    let chosen = "document.querySelector('.past-row.chosen .past-label span').textContent";
    let first = aiko.eval(chosen).await?;
    aiko.key("ArrowDown").await?;
    aiko.until(&format!("{chosen} !== {first}"), "the next lane").await?;
    aiko.until("document.querySelector('.past-table caption').textContent === 'Ball · size'", "its values").await?;
    aiko.until(
        "document.querySelector('[role=slider]').getAttribute('aria-valuetext').includes('Ball · size: ')",
        "it is said",
    )
    .await?;
    aiko.key("Home").await?;
    aiko.until(&format!("{CURSOR} === 0"), "the beginning").await?;

    // Playing goes on by itself until somebody lets it rest.
    aiko.key("Space").await?;
    aiko.until(&format!("{CURSOR} > 300"), "it plays").await?;
    aiko.key("Space").await?;
    aiko.find("button", "Play").await?;

    // L leads to more lanes; what is added is chosen.
    aiko.key("l").await?;
    aiko.until("document.activeElement.id === 'past-add'", "the keyboard is where lanes are added").await?;
    // The list itself is the browser's own.
    let choose = "(() => { const list = document.activeElement; list.value = 'ball x'; \
        list.dispatchEvent(new Event('change', { bubbles: true })); return true; })()";
    aiko.eval(choose).await?;
    aiko.until(&format!("{chosen} === 'Ball · x'"), "the new lane is chosen").await?;

    // Back to now: the panel is gone, and the address does not ask for it any more.
    aiko.press("button", "Back to now").await?;
    aiko.until("!document.querySelector('.past') && location.search === ''", "it is closed").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn a_recorded_session_is_looked_at_by_a_finger_alone() -> Outcome<()> {
    skip::unless!(ready("journey: look back by finger"));
    let folder = house::folder()?;
    keep_session(folder.path())?;
    let stage = Stage::set_with(folder, &[]).await?;
    let aiko = at_session(&stage, true).await?;
    aiko.tap("link", "Look back").await?;
    usable(&aiko).await?;
    aiko.until(THERE, "the lanes are there").await?;
    let place = |selector: &str, x: f64, y: f64| {
        format!(
            "(() => {{ const box = document.querySelector('{selector}').getBoundingClientRect(); \
             return [box.left + box.width * {x}, box.top + Math.min(box.height * {y}, innerHeight)]; }})()"
        )
    };
    let at = async |selector: &str, x: f64, y: f64| -> Outcome<(f64, f64)> {
        let place = aiko.eval(&place(selector, x, y)).await?;
        Ok((place[0].as_f64().unwrap_or_default(), place[1].as_f64().unwrap_or_default()))
    };

    // A tap on the overview goes there.
    aiko.tap_at(at(".past-over canvas", 0.5, 0.3).await?).await?;
    aiko.until(&format!("Math.abs({CURSOR} - 300000) < 5000"), "the middle of all of it").await?;
    // A drag over the lanes pans: the moment stays, what is seen moves.
    let ruler = "document.querySelector('.past-canvas').dataset.begin";
    let before = aiko.eval(ruler).await?;
    let (x, y) = at(".past-canvas", 0.3, 0.15).await?;
    aiko.touch_drag((x, y), (x + 120.0, y), 6).await?;
    aiko.until(&format!("{ruler} !== {before}"), "what is seen has moved").await?;
    aiko.until(&format!("Math.abs({CURSOR} - 300000) < 5000"), "the moment is the same").await?;
    // Two fingers show less time.
    let span = "document.querySelector('.past-zoom span').textContent";
    let before = aiko.eval(span).await?;
    aiko.pinch((x + 40.0, y), 40.0, 160.0).await?;
    aiko.until(&format!("{span} !== {before}"), "less time is shown").await?;
    // A tap on a label chooses its lane, a tap in the table goes to its value.
    aiko.tap("button", "Values").await?;
    aiko.tap("button", "Ball · size*").await?;
    aiko.until("document.querySelector('.past-table caption').textContent === 'Ball · size'", "its values").await?;
    aiko.until("document.querySelectorAll('.past-table tbody tr').length > 2", "they are there").await?;
    let value = "document.querySelector('.past-table tbody tr .link').textContent";
    aiko.eval("document.querySelector('.past-table tbody tr .link').id = 'first-value', 0").await?;
    assert!(aiko.eval(value).await?.as_str().is_some_and(|time| time.len() == 10), "times have tenths");
    let (x, y) = at(".past-table tbody tr .link", 0.5, 0.5).await?;
    aiko.tap_at((x, y)).await?;
    aiko.until("document.querySelector('.past-table [aria-current]') != null", "it is the moment").await?;
    // Start and Stop stay where they are.
    aiko.find("button", "Stop*").await?;
    aiko.tap("button", "Back to now").await?;
    aiko.until("!document.querySelector('.past')", "it is closed").await?;
    aiko.no_errors()
}

/// The rows of the marks.
const MARKS: &str = "document.querySelectorAll('.mark-row').length";
/// The words of the mark at which the cursor is.
const MARK_HERE: &str = "(document.querySelector('.mark-row[aria-current]')?.textContent ?? '')";

#[tokio::test]
async fn the_marks_lead_to_their_moments_by_the_keyboard_alone() -> Outcome<()> {
    skip::unless!(ready("journey: marks by keyboard"));
    let folder = house::folder()?;
    keep_session(folder.path())?;
    let stage = Stage::set_with(folder, &[]).await?;
    let aiko = at_session(&stage, false).await?;
    aiko.on("link", "Look back", "function () { this.focus(); return true; }").await?;
    aiko.key("Enter").await?;
    usable(&aiko).await?;
    aiko.until(THERE, "the lanes are there").await?;
    aiko.until(&format!("{MARKS} === 4 && !!document.querySelector('.then-left')"), "the marks stand at the left")
        .await?;
    aiko.until(&format!("{MARK_HERE} === ''"), "the cursor is at none of them").await?;
    aiko.until("document.activeElement.matches('.past')", "the keyboard is in the panel").await?;
    let hands = Hands::of(&aiko);
    hands.goes_to("Tab", "Find a moment …").await?;
    hands.press("ArrowDown").await?;
    aiko.until("document.activeElement.matches('.mark-row')", "the first mark has the keyboard").await?;
    hands.press("Enter").await?;
    aiko.until(&format!("{CURSOR} === 150000 && {MARK_HERE}.includes('laughs')"), "its moment").await?;
    aiko.until(&format!("{MARK_HERE}.includes('Yuki')"), "and who set it").await?;
    hands.press("]").await?;
    aiko.until(&format!("{CURSOR} === 300000 && {MARK_HERE}.includes('looks away')"), "the next one").await?;
    aiko.until("document.activeElement.getAttribute('aria-current') === 'true'", "the keyboard goes along").await?;
    hands.press("[").await?;
    aiko.until(&format!("{CURSOR} === 150000"), "the one before").await?;
    hands.press("ArrowUp").await?;
    aiko.until("document.activeElement.matches('.marks input')", "the field has the keyboard").await?;
    hands.types("asks").await?;
    aiko.until(&format!("{MARKS} === 1"), "only what has these words").await?;
    hands.press("Enter").await?;
    aiko.until(&format!("{CURSOR} === 420000"), "Enter goes to the first").await?;
    hands.types(" for nothing").await?;
    aiko.until("!!document.querySelector('.marks-none')", "it says that there is none").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn the_marks_lead_to_their_moments_by_a_finger_alone() -> Outcome<()> {
    skip::unless!(ready("journey: marks by finger"));
    let folder = house::folder()?;
    keep_session(folder.path())?;
    let stage = Stage::set_with(folder, &[]).await?;
    let aiko = at_session(&stage, true).await?;
    aiko.tap("link", "Look back").await?;
    usable(&aiko).await?;
    aiko.until(THERE, "the lanes are there").await?;
    aiko.tap("button", "Marks").await?;
    aiko.until(&format!("{MARKS} === 4 && !!document.querySelector('.past-marks')"), "the marks are below the lanes")
        .await?;
    aiko.settled().await?;
    let row = "(() => { const box = document.querySelectorAll('.mark-row')[1].getBoundingClientRect(); \
        return [box.left + 60, box.top + box.height / 2, box.height]; })()";
    let row = aiko.eval(row).await?;
    assert!(row[2].as_f64().is_some_and(|high| high >= 44.0), "a finger finds it: {row}");
    aiko.tap_at((row[0].as_f64().unwrap_or_default(), row[1].as_f64().unwrap_or_default())).await?;
    aiko.until(&format!("{CURSOR} === 300000 && {MARK_HERE}.includes('looks away')"), "its moment").await?;
    aiko.find("button", "Stop*").await?;
    aiko.tap("button", "Marks").await?;
    aiko.until(&format!("{MARKS} === 0"), "they are folded away").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn what_runs_is_seen_over_time_and_its_sparkline_leads_there() -> Outcome<()> {
    skip::unless!(ready("journey: over time while it runs"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Watcher").await?;
    add_sense(&aiko, "Red ball").await?;
    saved(&aiko).await?;
    start(&aiko).await?;
    shows_value(&aiko, "Red ball").await?;
    aiko.eval("document.querySelector('.stream').focus(), 0").await?;
    aiko.key("l").await?;
    aiko.until("document.querySelectorAll('.past-label').length > 1", "the lanes are there").await?;
    let length = "document.querySelector('[role=slider]').getAttribute('aria-valuemax')";
    aiko.find("button", "Now").await?;
    aiko.until("document.querySelector('.past-now').getAttribute('aria-pressed') === 'true'", "it follows").await?;
    let before = aiko.eval(length).await?;
    aiko.until(&format!("{length} !== {before}"), "it goes on").await?;
    // Whoever goes back does not follow, and *Now* returns.
    aiko.key("Home").await?;
    aiko.until("document.querySelector('.past-now').getAttribute('aria-pressed') === 'false'", "it stays").await?;
    aiko.until("document.querySelector('.past h2').textContent.endsWith(', earlier')", "it says that it is earlier")
        .await?;
    aiko.press("button", "Now").await?;
    aiko.until("document.querySelector('.past-now').getAttribute('aria-pressed') === 'true'", "it follows again")
        .await?;
    // The robot is where it always is.
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    aiko.press("button", "Back to now").await?;
    aiko.until("!document.querySelector('.past')", "it is closed").await?;
    aiko.no_errors()
}
