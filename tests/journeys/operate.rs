//! The operator's page: with fingers and with keys, two operators at once, with a link that is cut, and for who may only look.

use house::{GAME, Outcome, Page, Switch, TILES, skip};
use protocol::request;

use crate::invite::{follow, invite};
use crate::steps::*;
use crate::visitor::Visitor;

/// Puts the program in, and leads this page to the operator's page with it.
pub(crate) async fn operates(stage: &Stage, page: &Page) -> Outcome<()> {
    page.goto(&stage.server.url()).await?;
    usable(page).await?;
    page.brings_game().await?;
    opens(stage, page, GAME).await
}

/// Puts the program with tiles of its own in, and leads this page to the operator's page with it.
pub(crate) async fn operates_tiles(stage: &Stage, page: &Page) -> Outcome<()> {
    page.goto(&stage.server.url()).await?;
    usable(page).await?;
    page.brings_tiles().await?;
    opens(stage, page, TILES).await
}

async fn opens(stage: &Stage, page: &Page, name: &str) -> Outcome<()> {
    page.goto(&format!("{}operate", stage.server.url())).await?;
    usable(page).await?;
    page.press("button", name).await?;
    says(page, "Ready to start").await
}

/// Starts it with this code.
pub(crate) async fn starts(page: &Page, code: &str) -> Outcome<()> {
    page.press("button", "Start …").await?;
    let card = page.within("dialog", "Start *");
    card.fill("textbox", "Participant code*", code).await?;
    card.press("button", "Start").await?;
    page.find("button", "Running").await?;
    // The card over the tiles is long gone by then.
    page.until("document.querySelector('.op-clock b').textContent >= '0:02'", "the clock goes").await.map(drop)
}

/// The words that a tile shows.
pub(crate) fn shows(label: &str) -> String {
    format!(
        "[...document.querySelectorAll('.op-tile')].find(tile => tile.querySelector('b').textContent === '{label}')?.dataset.state"
    )
}

/// The presses that the page has heard of.
pub(crate) const DOTS: &str = "document.querySelectorAll('.dots i').length";

#[tokio::test]
async fn a_session_is_run_with_fingers_from_start_to_stop() -> Outcome<()> {
    skip::unless!(ready("journey: the operator's page with fingers"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    aiko.size(1180, 820, true).await?;
    operates(&stage, &aiko).await?;
    // A double tap on Start starts nothing: what is asked stands elsewhere.
    aiko.tap("button", "Start …").await?;
    aiko.find("dialog", "Start Ball game").await?;
    aiko.tap("button", "Start …").await?;
    aiko.gone("dialog", "Start Ball game").await?;
    starts(&aiko, "P-07").await?;
    says(&aiko, "Recorded").await?;
    says(&aiko, "P-07").await?;
    aiko.until("document.querySelector('.op-clock b').textContent >= '0:02'", "the clock goes").await?;
    let labels =
        aiko.eval("[...document.querySelectorAll('.op-tile b')].map(label => label.textContent).join('|')").await?;
    let labels = labels.as_str().unwrap_or_default().to_owned();
    assert!(labels.starts_with("Go on|“Well done!”|“That tickles!”|Waving|As if: "), "{labels}");

    aiko.tap("button", "“Well done!”*").await?;
    aiko.until(&format!("{} === 'going'", shows("“Well done!”")), "it is being said").await?;
    aiko.tap("button", "“That tickles!”*").await?;
    aiko.until(&format!("{} === 'next'", shows("“That tickles!”")), "it comes next").await?;
    aiko.until(&format!("{DOTS} === 2"), "both presses are seen").await?;

    aiko.tap("button", "Mark").await?;
    says(&aiko, "Add a note …").await?;
    aiko.tap("button", "Add a note …").await?;
    aiko.fill("textbox", "Note, if you like …", "gives the ball").await?;
    aiko.key("Enter").await?;
    says(&aiko, "“gives the ball”").await?;
    aiko.tap("button", "Mark").await?;
    aiko.tap("button", "Undo*").await?;
    aiko.until("document.querySelectorAll('.op-flag').length === 1", "the second mark is gone").await?;

    stop(&aiko).await?;
    says(&aiko, "Ready to start").await?;
    assert_eq!(of_recording(&stage, "note").await?, ["gives the ball"]);
    calm(&aiko)
}

/// The field of that name of the newest recording's marks, from the server.
pub(crate) async fn of_recording(stage: &Stage, field: &str) -> Outcome<Vec<String>> {
    let mut visitor = Visitor::enter(&stage.server).await?;
    let recordings = visitor.ask(request::Recordings {}).await?.recordings;
    let file = recordings.first().ok_or("no recording")?.file.clone();
    let marks = visitor.ask(request::Marks { file }).await?.marks;
    let value = |mark| {
        serde_json::to_value(&mark)
            .ok()?
            .get(field)
            .map(|value| value.as_str().map_or_else(|| value.to_string(), str::to_owned))
    };
    Ok(marks.into_iter().filter_map(value).collect())
}

#[tokio::test]
async fn the_keys_press_tiles_mark_and_write_notes_and_a_held_key_counts_once() -> Outcome<()> {
    skip::unless!(ready("journey: the operator's page with keys"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    operates(&stage, &aiko).await?;
    starts(&aiko, "").await?;
    aiko.key("4").await?;
    aiko.until(&format!("{} === 'going'", shows("Waving")), "it waves").await?;
    aiko.until(&format!("{DOTS} === 1"), "one press").await?;
    let held = "[1, 2, 3].forEach(() => dispatchEvent(new KeyboardEvent('keydown', { key: '1', code: 'Digit1', repeat: true, cancelable: true })))";
    aiko.eval(held).await?;
    aiko.key("1").await?;
    aiko.key("1").await?;
    aiko.until(&format!("{} !== 'ready'", shows("Go on")), "the button was pressed").await?;
    aiko.until(&format!("{DOTS} === 2"), "held, and twice at once, it counts once").await?;
    aiko.key("m").await?;
    says(&aiko, "Add a note …").await?;
    aiko.key("n").await?;
    aiko.until("document.activeElement.id === 'op-note'", "the note has the keyboard").await?;
    // In a field 1 and m are letters.
    aiko.type_text("m1").await?;
    aiko.key("Enter").await?;
    says(&aiko, "“m1”").await?;
    assert_eq!(aiko.eval(DOTS).await?, 2);
    aiko.key("Escape").await?;
    aiko.key("Escape").await?;
    says(&aiko, "Stopped. The robot holds still.").await?;
    says(&aiko, "Ready to start").await?;
    calm(&aiko)
}

#[tokio::test]
async fn two_operators_see_each_others_presses_marks_and_stops() -> Outcome<()> {
    skip::unless!(ready("journey: two operators"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    aiko.goto(&stage.server.url()).await?;
    aiko.eval("localStorage.setItem('rrp.name', 'Aiko'), 0").await?;
    operates(&stage, &aiko).await?;
    starts(&aiko, "P-07").await?;
    let yuki = stage.nobody("yuki").await?;
    yuki.goto(&stage.server.url()).await?;
    yuki.eval("localStorage.setItem('rrp.name', 'Yuki'), 0").await?;
    // A person who comes while something runs lands on it, whatever was open here before.
    yuki.goto(&format!("{}operate", stage.server.url())).await?;
    yuki.find("button", "Running").await?;
    yuki.until(
        "/^0:[0-9]{2}$/.test(document.querySelector('.op-clock b').textContent)",
        "the clock of the run goes there too",
    )
    .await?;

    yuki.press("button", "Waving*").await?;
    aiko.until(&format!("{} === 'by'", shows("Waving")), "it is said who waves").await?;
    says(&aiko, "Yuki, just now").await?;
    aiko.until(&format!("{DOTS} === 1"), "and where it was pressed").await?;
    yuki.press("button", "Mark with a word").await?;
    yuki.fill("textbox", "Word, as: laughs", "laughs").await?;
    yuki.key("Enter").await?;
    says(&aiko, "laughs").await?;

    yuki.press("button", "Stop").await?;
    // A host who presses Stop does not say who they are.
    says(&aiko, "Somebody stopped the robot").await?;
    says(&aiko, "Press Start to begin again.").await?;
    silent(&yuki, "stopped the robot").await?;
    aiko.press("button", "I have read it").await?;
    says(&aiko, "Ready to start").await?;
    calm(&aiko)?;
    calm(&yuki)
}

#[tokio::test]
async fn a_link_that_is_cut_presses_nothing_later_and_a_mark_keeps_its_moment() -> Outcome<()> {
    skip::unless!(ready("journey: the operator's link is cut"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let socket = Switch::install(&aiko).await?;
    operates(&stage, &aiko).await?;
    starts(&aiko, "P-07").await?;
    aiko.key("4").await?;
    aiko.until(&format!("{DOTS} === 1"), "a press").await?;
    aiko.until(&format!("{} === 'ready'", shows("Waving")), "it waved").await?;
    // In the middle of a press.
    aiko.eval("document.querySelectorAll('.op-tile')[0].click(), globalThis.isCut = true, globalThis.sockets.forEach(socket => socket.close()), 0").await?;
    says(&aiko, "No connection for").await?;
    for words in [
        "The robot goes on by itself.",
        "Press Stop. It is tried on its own way.",
        "hold it and press its chest button for 3 seconds",
        "nothing is done later",
    ] {
        says(&aiko, words).await?;
    }
    aiko.find("button", "Was running").await?;
    for key in ["1", "2", "4"] {
        aiko.key(key).await?;
    }
    assert_eq!(aiko.eval("[...document.querySelectorAll('.op-tile')].every(tile => tile.disabled)").await?, true);
    aiko.key("m").await?;
    says(&aiko, "waits here").await?;
    let marked = aiko.eval("document.querySelector('.op-newest .op-at').textContent").await?;
    aiko.until("Number(document.querySelector('.op-undo').textContent.match(/[0-9]+/)[0]) < 8", "two seconds pass")
        .await?;
    socket.mend().await?;
    silent(&aiko, "No connection for").await?;
    silent(&aiko, "waits here").await?;
    assert_eq!(aiko.eval("document.querySelector('.op-newest .op-at').textContent").await?, marked, "its moment stays");
    // Whatever was on its way when it was cut came once or not at all; nothing that was pressed meanwhile came.
    assert!(aiko.eval(DOTS).await?.as_u64().is_some_and(|dots| dots <= 2));
    aiko.key("3").await?;
    aiko.until(&format!("{} === 'going'", shows("“That tickles!”")), "the tiles work again").await?;
    let (now, moments) = (aiko.eval(RUN_MS).await?, of_recording(&stage, "t").await?);
    let (now, moment) =
        (now.as_f64().unwrap_or(0.0), moments.first().and_then(|t| t.parse::<f64>().ok()).unwrap_or(f64::MAX));
    assert_eq!(moments.len(), 1, "the mark is there once");
    assert!(moment < now - 1_000.0, "marked at {moment} ms, not when it was sent, {now} ms");
    let mut visitor = Visitor::enter(&stage.server).await?;
    socket.cut().await?;
    says(&aiko, "No connection for").await?;
    stop(&aiko).await?;
    visitor.runs("Stop went its own way", 0).await?;
    socket.mend().await
}

/// The moment of the mark in the list of marks, in seconds of the day.
const MARKED_S: &str = "(() => { const at = document.querySelector('.op-list .op-at')?.textContent.split(':').map(Number); return at ? (at[0] * 60 + at[1]) * 60 + at[2] : null; })()";

#[tokio::test]
async fn a_mark_is_where_it_was_after_a_reload_and_when_the_clock_is_set() -> Outcome<()> {
    skip::unless!(ready("journey: the moments of marks"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    operates(&stage, &aiko).await?;
    starts(&aiko, "").await?;
    aiko.key("m").await?;
    says(&aiko, "Add a note …").await?;
    let pressed = format!(
        "(() => {{ const list = document.querySelector('.op-newest .op-at').textContent; return {SECONDS}(list); }})()"
    );
    let pressed = aiko.eval(&pressed).await?.as_f64().ok_or("no mark")?;
    aiko.until("Number(document.querySelector('.op-undo').textContent.match(/[0-9]+/)[0]) < 7", "three seconds pass")
        .await?;
    aiko.reload().await?;
    usable(&aiko).await?;
    let again = aiko.until(MARKED_S, "the mark is told again").await?.as_f64().ok_or("no mark")?;
    assert!(
        (again - pressed + 1.0).rem_euclid(86_400.0) <= 2.0,
        "marked at {pressed} s, and at {again} s after a reload"
    );
    // The tablet's clock is set forty seconds ahead: the clock of the run stays right, and the mark stays in its run.
    let before = aiko.eval(RUN_MS).await?.as_f64().ok_or("no clock")?;
    aiko.eval("(() => { const was = Date.now; Date.now = () => was() + 40000; })(), 0").await?;
    let moved = format!("({MARKED_S} - {again} - 39 + 86400) % 86400 <= 2");
    aiko.until(&moved, "the mark moves with the clock").await?;
    let right = format!("{RUN_MS} >= {before} && {RUN_MS} < {before} + 40000");
    aiko.until(&right, "the clock of the run is right").await?;
    stop(&aiko).await?;
    calm(&aiko)
}

/// The seconds of the day of a text.
const SECONDS: &str = "(text => { const at = text.split(':').map(Number); return (at[0] * 60 + at[1]) * 60 + at[2]; })";

/// The time of the run, in milliseconds.
pub(crate) const RUN_MS: &str = "(() => { const [m, s] = document.querySelector('.op-clock b').textContent.split(':').map(Number); return (m * 60 + s) * 1000; })()";

#[tokio::test]
async fn who_may_only_look_presses_none() -> Outcome<()> {
    skip::unless!(ready("journey: a viewer on the operator's page"));
    let stage = Stage::set_with(house::folder()?, &["--listen", "0.0.0.0:0"]).await?;
    let aiko = stage.nobody("aiko").await?;
    operates(&stage, &aiko).await?;
    starts(&aiko, "P-07").await?;
    let host = stage.person("host").await?;
    let link = invite(&host, "look", "for a day", "Ben").await?;
    let ben = follow(&stage, "ben", &link).await?;
    ben.press("button", "Come in").await?;
    usable(&ben).await?;
    let root = ben.eval("location.origin").await?;
    ben.goto(&format!("{}/operate", root.as_str().unwrap_or_default())).await?;
    ben.find("button", "Running").await?;
    let free = "[...document.querySelectorAll('.op button')].filter(button => !button.disabled && !button.matches('.op-pill, .op-tab')).length";
    ben.until(&format!("document.querySelectorAll('.op-tile').length > 3 && {free} === 0"), "nothing can be pressed")
        .await?;
    for key in ["1", "2", "3", "4", "m"] {
        ben.key(key).await?;
    }
    // Stop is everybody's.
    stop(&ben).await?;
    aiko.find("button", "Start …").await?;
    assert_eq!(aiko.eval(DOTS).await?, 0, "nothing was pressed");
    assert_eq!(of_recording(&stage, "t").await?, [""; 0]);
    calm(&aiko)
}

#[tokio::test]
async fn who_came_to_operate_lands_there_and_finds_the_way_out() -> Outcome<()> {
    skip::unless!(ready("journey: an operator lands on the operator's page"));
    let stage = Stage::set_with(house::folder()?, &["--listen", "0.0.0.0:0"]).await?;
    let aiko = stage.person("aiko").await?;
    aiko.brings_game().await?;
    let link = invite(&aiko, "start and stop", "for a day", "Ben").await?;
    let ben = follow(&stage, "ben", &link).await?;
    ben.press("button", "Come in").await?;
    usable(&ben).await?;
    assert_eq!(ben.eval("location.pathname").await?, protocol::OPERATE_PATH);
    ben.press("button", GAME).await?;
    starts(&ben, "P-01").await?;
    ben.key("1").await?;
    ben.until(&format!("{DOTS} === 1"), "and may press").await?;
    stop(&ben).await?;
    ben.press("link", "Leave the operator’s page").await?;
    ben.until("location.pathname === '/' && !!document.querySelector('#stage')", "the graph is there").await?;
    ben.find("button", "Head tracker, *").await?;
    // The host has a switch.
    aiko.goto(&ben_hash(&stage, &ben).await?).await?;
    usable(&aiko).await?;
    aiko.find("button", "Head tracker, *").await?;
    aiko.key("Control+k").await?;
    aiko.press("button", "Operator’s page*").await?;
    aiko.until(
        "location.pathname.startsWith('/operate/') && document.title.includes('Ball game')",
        "with robot and program",
    )
    .await?;
    says(&aiko, "Ready to start").await
}

/// The page of the host with what Ben has open.
async fn ben_hash(stage: &Stage, ben: &Page) -> Outcome<String> {
    let hash = ben.eval("location.hash").await?;
    Ok(format!("{}{}", stage.server.url(), hash.as_str().unwrap_or_default()))
}
