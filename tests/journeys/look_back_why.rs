//! The past on the graph: why the robot did something and why it did not, by the keyboard alone and by a finger alone; and two
//! people, of whom one looks back while the other edits and the robot runs.

use crate::by_keyboard::Hands;
use crate::look_back::{CURSOR, THERE, at_session};
use crate::steps::*;
use house::{Outcome, Page, SESSION, keep_session, keep_session_of, skip};

/// True while the graph shows a moment of the past.
pub(crate) const IS_THEN: &str = "document.documentElement.hasAttribute('data-then')";
/// The label of the chosen lane.
const CHOSEN: &str = "document.querySelector('.past-row.chosen .past-label span').textContent";
/// The number of steps of the answer.
const STEPS: &str = "document.querySelectorAll('.why .why-steps > li').length";

/// Goes down through the lanes until one is chosen.
async fn to_lane(page: &Page, lane: &str) -> Outcome<()> {
    for _ in 0..12 {
        if page.eval(CHOSEN).await? == lane {
            return Ok(());
        }
        page.key("ArrowDown").await?;
    }
    Err(format!("there is no lane {lane}").into())
}

/// The words beside a stream on the graph.
fn value_of(stream: &str) -> String {
    format!(
        "(document.querySelector('[data-node={stream}]')?.parentElement.querySelector('.value')?.textContent ?? '')"
    )
}

#[tokio::test]
async fn why_the_robot_did_something_is_found_by_the_keyboard_alone() -> Outcome<()> {
    skip::unless!(ready("journey: why, by keyboard"));
    let folder = house::folder()?;
    keep_session(folder.path())?;
    let stage = Stage::set_with(folder, &[]).await?;
    let aiko = at_session(&stage, false).await?;
    aiko.on("link", "Look back", "function () { this.focus(); return true; }").await?;
    aiko.key("Enter").await?;
    usable(&aiko).await?;
    aiko.until(THERE, "the lanes are there").await?;
    aiko.key("[").await?;
    aiko.until(&format!("{CURSOR} === 580000"), "a mark").await?;

    // The graph of what ran, with its values of then, only to look at.
    aiko.until(IS_THEN, "the graph shows the moment").await?;
    aiko.until(&format!("{}.includes('0.334')", value_of("distance")), "the distance of then").await?;
    aiko.until(&format!("{}.endsWith(' s earlier')", value_of("head")), "what came before says so").await?;
    aiko.until("document.querySelectorAll('.stage .edge.fired').length > 2", "what fired then is lit").await?;
    aiko.until(
        "document.querySelector('.then-tag h2').textContent.endsWith(', recorded')",
        "it says that it is recorded",
    )
    .await?;
    aiko.find("button", "Start now").await?;

    // W asks why, and the answer has the keyboard.
    to_lane(&aiko, "Head and body tracker").await?;
    aiko.key("w").await?;
    aiko.until(&format!("{STEPS} === 4"), "four steps from the action to the reading").await?;
    aiko.until("document.activeElement.id === 'why-answer'", "the keyboard is at the answer").await?;
    aiko.until("document.querySelector('.why h2').textContent === 'Why “Head and body tracker”?'", "what was asked")
        .await?;
    aiko.until("document.querySelectorAll('.why-number').length === 4", "the numbers are on the graph").await?;
    aiko.until("!!document.querySelector('.lit-region')", "the way is lit").await?;
    aiko.until("!document.querySelector('.why').textContent.includes('9:40.000')", "times are those of the day")
        .await?;

    // A step goes to its moment.
    aiko.key("Tab").await?;
    aiko.key("Tab").await?;
    aiko.until("document.activeElement.matches('.why-step')", "the first step").await?;
    aiko.key("Enter").await?;
    aiko.until("document.activeElement.getAttribute('aria-current') === 'true'", "it is there").await?;

    // The way back to now leaves nothing of then.
    aiko.press("button", "Back to now").await?;
    aiko.until(&format!("!document.querySelector('.past') && !{IS_THEN}"), "it is closed").await?;
    aiko.until("!document.querySelector('.why-number, .then-tag, .then-aside')", "nothing of it is left").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn why_the_robot_did_not_do_something_is_found_by_a_finger_alone() -> Outcome<()> {
    skip::unless!(ready("journey: why not, by finger"));
    let folder = house::folder()?;
    keep_session(folder.path())?;
    let stage = Stage::set_with(folder, &[]).await?;
    let aiko = at_session(&stage, true).await?;
    aiko.tap("link", "Look back").await?;
    usable(&aiko).await?;
    aiko.until(THERE, "the lanes are there").await?;
    // At the mark the ball is close: the head alone does not follow it.
    aiko.tap("button", "To the mark before").await?;
    aiko.until(&format!("{CURSOR} === 580000"), "a mark").await?;
    aiko.until(IS_THEN, "the moment is there").await?;
    aiko.tap("button", "Why not …").await?;
    aiko.tap("button", "Why not “Head tracker”?").await?;
    aiko.until(
        "document.querySelector('.why-not .nearest')?.textContent.includes('0.5')",
        "the nearest miss is the test that kept it back",
    )
    .await?;
    aiko.until(
        "document.querySelector('.why-not .nearest').textContent.includes('0.49')",
        "by the value that was nearest",
    )
    .await?;
    aiko.until("document.querySelector('.why-not .why-note').textContent.includes('looked at')", "and since when")
        .await?;
    // A step goes to its moment, and Stop is where it is.
    aiko.find("button", "Stop*").await?;
    // The lanes fold, and the list of the program shows the values of then.
    aiko.tap("button", "Show the graph").await?;
    aiko.until("document.querySelector('[data-row=distance]')?.textContent.includes('0.334')", "the values of then")
        .await?;
    aiko.tap("button", "Show the lanes").await?;
    aiko.tap("button", "Back to now").await?;
    aiko.until(&format!("!document.querySelector('.past') && !{IS_THEN}"), "it is closed").await?;
    aiko.no_errors()
}

/// The test of the program on the graph that is about far balls.
const TEST: &str = "(([...document.querySelectorAll('.chip .detail')].map(chip => chip.textContent).find(text => text.includes('>='))) ?? '')";
/// The words beside a fix.
const FIXED: &str = "(document.querySelector('.why-fix')?.textContent ?? '')";

/// Somebody with the program open who looks at a mark of its session: the study's task to find out why the head alone does not
/// follow a ball that is close, and to mend it.
async fn at_the_task(stage: &Stage) -> Outcome<Page> {
    let aiko = stage.person("aiko").await?;
    aiko.press("button", "Track far and close balls*").await?;
    aiko.find("button", "Track far and close balls").await?;
    saved(&aiko).await?;
    let id = aiko.eval("location.hash.match(/[0-9a-f-]{8,}/)[0]").await?;
    let id = id.as_str().unwrap_or_default();
    let file = aiko.eval(&format!("fetch('/api/behaviours/{id}.json').then(file => file.text())")).await?;
    keep_session_of(stage.folder(), id, file.as_str().unwrap_or_default())?;
    let hash = aiko.eval("location.hash").await?;
    aiko.goto(&format!("{}?past={SESSION}{}", stage.server.url(), hash.as_str().unwrap_or_default())).await?;
    usable(&aiko).await?;
    aiko.until(THERE, "the lanes are there").await?;
    Ok(aiko)
}

/// The value of the nearest miss that is told, in metres, and the new number.
async fn miss_and_fix(aiko: &Page) -> Outcome<(f64, f64)> {
    let told = "document.querySelector('.why-not .nearest .why-step span').textContent.match(/0\\.[0-9]+/)[0]";
    let number = "document.querySelector('.why-fix .link').textContent.match(/0\\.[0-9]+/)[0]";
    let read = async |js: &str| -> Outcome<f64> {
        Ok(aiko.eval(js).await?.as_str().and_then(|number| number.parse().ok()).ok_or("it has no number")?)
    };
    Ok((read(told).await?, read(number).await?))
}

#[tokio::test]
async fn the_number_that_kept_an_action_back_is_found_and_changed_by_the_keyboard_alone() -> Outcome<()> {
    skip::unless!(ready("journey: debug from the past, by keyboard"));
    let stage = Stage::set().await?;
    let aiko = at_the_task(&stage).await?;
    aiko.until("document.activeElement.matches('.past')", "the keyboard is in the panel").await?;
    aiko.key("[").await?;
    aiko.until(&format!("{CURSOR} === 580000 && {IS_THEN}"), "a mark").await?;
    let hands = Hands::of(&aiko);
    // What is asked about the moment stands before the lanes.
    hands.goes_to("Shift+Tab", "Why not …").await?;
    hands.press("Enter").await?;
    hands.goes_to("Tab", "Why not “Head tracker”?").await?;
    hands.press("Enter").await?;
    aiko.until("document.activeElement.id === 'why-answer'", "the keyboard is at the answer").await?;
    let (miss, number) = miss_and_fix(&aiko).await?;
    assert!(miss > 0.45 && miss < 0.5, "the nearest miss since it came last is told, not the last value: {miss}");
    assert!(number <= miss && number > 0.4, "with a number that lets it pass: {number}");
    // Its line goes to the moment of the miss, which was before the mark.
    hands.press("Tab").await?;
    hands.press("Tab").await?;
    aiko.until("document.activeElement.matches('.why-step')", "the first line").await?;
    hands.press("Enter").await?;
    aiko.until(&format!("{CURSOR} < 580000 && {CURSOR} > 520000"), "its moment").await?;
    aiko.until("document.activeElement.getAttribute('aria-current') === 'true'", "it is there").await?;
    let make = aiko.eval("document.querySelector('.why-fix .link').textContent").await?;
    hands.goes_to("Tab", make.as_str().unwrap_or_default()).await?;
    hands.press("Enter").await?;
    aiko.until(&format!("{FIXED}.includes('In the program of today')"), "it is done").await?;
    // The graph still shows then; now it is the other number, and undo takes it back.
    assert!(aiko.eval(TEST).await?.as_str().is_some_and(|test| test.contains("0.5")), "the past stays as it was");
    aiko.until(&format!("{FIXED}.includes('Undo')"), "it can be taken back").await?;
    hands.goes_to("Tab", "Back to now").await?;
    hands.press("Enter").await?;
    aiko.until(&format!("!{IS_THEN} && {TEST}.includes('0.4') && !{TEST}.includes('0.5')"), "the number of now")
        .await?;
    aiko.key("Control+z").await?;
    aiko.until(&format!("{TEST}.includes('0.5')"), "it is as it was").await?;
    aiko.no_errors()
}

/// Goes to the mark before and asks in the same moment why not, so that the graph cannot show the mark yet.
const ASKED_AT_ONCE: &str = "(() => {
    const panel = document.querySelector('.past');
    panel.dispatchEvent(new KeyboardEvent('keydown', { key: '[', code: 'BracketLeft', bubbles: true, cancelable: true }));
    [...document.querySelectorAll('.then-offers button')].find(one => one.textContent.includes('Head tracker')).click();
    return true;
})()";

#[tokio::test]
async fn a_question_asked_on_the_way_to_a_moment_is_about_that_moment() -> Outcome<()> {
    skip::unless!(ready("journey: why not, on the way to a moment"));
    let stage = Stage::set().await?;
    let aiko = at_the_task(&stage).await?;
    aiko.until(IS_THEN, "the first moment is on the graph").await?;
    aiko.press("button", "Why not …").await?;
    aiko.find("button", "Why not “Head tracker”?").await?;
    aiko.eval(ASKED_AT_ONCE).await?;
    aiko.until("document.activeElement.id === 'why-answer'", "there is an answer").await?;
    assert_eq!(aiko.eval(CURSOR).await?, 580_000, "the cursor is at the mark");
    let (miss, _) = miss_and_fix(&aiko).await?;
    assert!(miss > 0.45 && miss < 0.5, "what came nearest before the mark is told: {miss}");
    aiko.no_errors()
}

#[tokio::test]
async fn the_number_that_kept_an_action_back_is_found_and_changed_by_a_finger_alone() -> Outcome<()> {
    skip::unless!(ready("journey: debug from the past, by finger"));
    let stage = Stage::set().await?;
    let aiko = at_the_task(&stage).await?;
    aiko.size(1180, 820, true).await?;
    aiko.settled().await?;
    aiko.tap("button", "To the mark before").await?;
    aiko.until(&format!("{CURSOR} === 580000 && {IS_THEN}"), "a mark").await?;
    aiko.tap("button", "Why not …").await?;
    aiko.tap("button", "Why not “Head tracker”?").await?;
    aiko.tap("button", "Make it *").await?;
    aiko.until(&format!("{FIXED}.includes('In the program of today') && {FIXED}.includes('Undo')"), "it is done")
        .await?;
    // Undo beside it takes back this and nothing else, and offers itself no more.
    aiko.tap("button", "Undo this change").await?;
    aiko.until(&format!("{FIXED}.includes('Make it')"), "it can be done again").await?;
    aiko.within("region", "The past on the graph").tap("button", "Back to now").await?;
    aiko.until(&format!("!{IS_THEN} && {TEST}.includes('0.5')"), "the number is the one of before").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn why_the_robot_did_something_is_found_by_a_finger_alone() -> Outcome<()> {
    skip::unless!(ready("journey: why, by finger"));
    let folder = house::folder()?;
    keep_session(folder.path())?;
    let stage = Stage::set_with(folder, &[]).await?;
    let aiko = at_session(&stage, true).await?;
    aiko.size(1180, 820, true).await?;
    aiko.tap("link", "Look back").await?;
    usable(&aiko).await?;
    aiko.until(THERE, "the lanes are there").await?;
    aiko.tap("button", "To the mark before").await?;
    aiko.until(&format!("{CURSOR} === 580000 && {IS_THEN}"), "a mark").await?;
    aiko.tap("button", "Head and body tracker*").await?;
    aiko.tap("button", "Why?").await?;
    aiko.until(&format!("{STEPS} === 4"), "four steps from the action to the reading").await?;
    aiko.tap("button", "Show the graph").await?;
    aiko.until("document.querySelectorAll('.why-number').length === 4", "the numbers are on the graph").await?;
    let beside =
        "[...document.querySelectorAll('#stage [data-node][data-beside]')].map(one => one.dataset.node).sort().join()";
    aiko.until(&format!("{beside} === 'far,head'"), "what it is not about steps back").await?;
    aiko.tap("button", "Close the answer").await?;
    aiko.until("!document.querySelector('[data-beside]')", "all is as it was").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn one_looks_back_while_another_edits_and_the_robot_runs() -> Outcome<()> {
    skip::unless!(ready("journey: look back while another edits"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Watcher").await?;
    add_sense(&aiko, "Red ball").await?;
    saved(&aiko).await?;
    start(&aiko).await?;
    shows_value(&aiko, "Red ball").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    shows_value(&ben, "Red ball").await?;
    aiko.eval("document.querySelector('.stream').focus(), 0").await?;
    aiko.key("l").await?;
    aiko.until("document.querySelectorAll('.past-label').length > 1", "the lanes are there").await?;
    let length = "Number(document.querySelector('[role=slider]').getAttribute('aria-valuemax'))";
    aiko.until(&format!("{length} > 2"), "there is something to look back on").await?;
    aiko.key("Shift+ArrowLeft").await?;
    aiko.until(IS_THEN, "the graph shows a moment").await?;
    aiko.until("document.querySelector('.then-tag h2').textContent.endsWith(', earlier')", "it says so").await?;
    aiko.until("document.querySelector('.then-only').textContent === 'paused for you'", "the robot goes on").await?;
    aiko.find("button", "Running").await?;
    aiko.until(
        "document.querySelector('.then-left .marks-none')?.textContent.includes('press Mark')",
        "how marks come",
    )
    .await?;

    // Edits and values of meanwhile do not get into what is shown of then.
    let streams = "document.querySelectorAll('#stage .stream').length";
    let value = "document.querySelector('#stage .value').textContent";
    aiko.until("!!document.querySelector('#stage .value b')", "its value of then").await?;
    let before = aiko.eval(value).await?;
    let until = aiko.eval(length).await?.as_f64().unwrap_or_default() + 2.0;
    add_sense(&ben, "Face").await?;
    saved(&ben).await?;
    aiko.until(&format!("{length} >= {until}"), "the run goes on").await?;
    assert_eq!(aiko.eval(streams).await?, 1, "the program of then has one stream");
    assert_eq!(aiko.eval(value).await?, before, "its value is that of then");
    assert_eq!(ben.eval(&format!("{IS_THEN} ? 'then' : 'now'")).await?, "now", "ben sees now");

    // Nothing can be edited, and Stop works at once.
    aiko.until("document.querySelector('.left').textContent.includes('only to look at')", "the list says why it rests")
        .await?;
    stop(&aiko).await?;
    aiko.find("button", "Start now").await?;

    // Now again: the newest program.
    aiko.within("region", "The past on the graph").press("button", "Back to now").await?;
    aiko.until(&format!("!{IS_THEN}"), "the graph shows now").await?;
    aiko.until(&format!("{streams} === 2"), "with what ben added").await?;
    at_rest(&aiko).await?;
    aiko.no_errors()?;
    ben.no_errors()
}
