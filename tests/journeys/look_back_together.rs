//! Looking back together: one looks at the past while the robot runs, another one follows there and back, by the keyboard, by a
//! finger and with little motion.

use crate::look_back::{CURSOR, THERE};
use crate::look_back_why::IS_THEN;
use crate::steps::*;
use crate::together::call_myself;
use house::{Outcome, Page, SESSION, keep_session_of, skip};

/// The words of the line of those who look back.
const OTHERS: &str = "(document.querySelector('.past-others')?.innerText ?? '')";
/// The moment that is looked at, in the words of the head.
const MOMENT: &str = "document.querySelector('.past h2').textContent";

/// Waits until both look at the same moment.
async fn same_moment(one: &Page, other: &Page) -> Outcome<()> {
    let at = one.eval(CURSOR).await?;
    other.until(&format!("{CURSOR} === {at} && {IS_THEN}"), "the other one looks at the same moment").await.map(drop)
}

/// Aiko, who looks at a moment of a program that runs, and Ben beside her, at now.
async fn one_looks_back(stage: &Stage) -> Outcome<(Page, Page)> {
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Watcher").await?;
    add_sense(&aiko, "Red ball").await?;
    saved(&aiko).await?;
    call_myself(&aiko, "Aiko").await?;
    start(&aiko).await?;
    shows_value(&aiko, "Red ball").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    call_myself(&ben, "Ben").await?;
    shows_value(&ben, "Red ball").await?;
    ben.find("button", "Follow Aiko").await?;
    aiko.eval("document.querySelector('.stream').focus(), 0").await?;
    aiko.key("l").await?;
    aiko.until("document.querySelectorAll('.past-label').length > 1", "the lanes are there").await?;
    let length = "Number(document.querySelector('[role=slider]').getAttribute('aria-valuemax'))";
    aiko.until(&format!("{length} > 4"), "there is something to look back on").await?;
    aiko.key("Shift+ArrowLeft").await?;
    aiko.until(IS_THEN, "the graph shows a moment").await?;
    Ok((aiko, ben))
}

/// Goes on with Tab until the keyboard is at a button of this name.
async fn tab_to(page: &Page, name: &str) -> Outcome<()> {
    let is_there = format!("document.activeElement.getAttribute('aria-label') === '{name}'");
    for _ in 0..40 {
        if page.eval(&is_there).await? == true {
            return Ok(());
        }
        page.key("Tab").await?;
    }
    Err(format!("the keyboard does not come to “{name}”").into())
}

#[tokio::test]
async fn one_follows_another_into_the_past_and_back_by_the_keyboard_alone() -> Outcome<()> {
    skip::unless!(ready("journey: look back together, by keyboard"));
    let stage = Stage::set().await?;
    let (aiko, ben) = one_looks_back(&stage).await?;
    // Ben sees that she looks back; his own graph shows now, and he edits while the robot runs.
    ben.find("button", "Follow Aiko, who looks back").await?;
    assert_eq!(ben.eval(IS_THEN).await?, false, "nothing changes before he wants it");
    add_sense(&ben, "Face").await?;
    saved(&ben).await?;
    assert_eq!(aiko.eval("document.querySelectorAll('#stage .stream').length").await?, 1, "then there was one stream");

    // He goes to the lanes, and from there to her.
    ben.eval("document.querySelector('.stream').focus(), 0").await?;
    ben.key("l").await?;
    ben.until(&format!("/Aiko\\s+at \\d\\d:\\d\\d:\\d\\d/.test({OTHERS})"), "her moment is told").await?;
    tab_to(&ben, "Follow Aiko").await?;
    ben.key("Enter").await?;
    same_moment(&aiko, &ben).await?;
    says(&ben, "You look back with Aiko. Move the cursor to look by yourself.").await?;
    ben.until("document.activeElement.getAttribute('aria-label') === 'End following Aiko'", "the way out is there")
        .await?;
    aiko.until(&format!("{OTHERS}.includes('looks with you')"), "Aiko sees it").await?;
    assert_eq!(ben.eval("document.querySelectorAll('#stage .stream').length").await?, 1, "the program of then");
    aiko.key("Shift+ArrowLeft").await?;
    same_moment(&aiko, &ben).await?;
    assert_eq!(aiko.eval(MOMENT).await?, ben.eval(MOMENT).await?);

    // Whoever moves the cursor looks by themselves.
    ben.eval("document.querySelector('.past').focus(), 0").await?;
    ben.key("Shift+ArrowLeft").await?;
    says(&ben, "You look by yourself now.").await?;
    let own = ben.eval(CURSOR).await?;
    aiko.key("Shift+ArrowLeft").await?;
    aiko.key("ArrowLeft").await?;
    let there = aiko.eval(&format!("({MOMENT}.match(/[\\d:]+/) ?? [''])[0]")).await?;
    ben.until(&format!("{OTHERS}.includes({there})"), "he hears of hers").await?;
    assert_eq!(ben.eval(CURSOR).await?, own, "and stays at his");

    // Once more; she goes back to now, and he stays where he is.
    tab_to(&ben, "Follow Aiko").await?;
    ben.key("Enter").await?;
    same_moment(&aiko, &ben).await?;
    let last = ben.eval(CURSOR).await?;
    aiko.within("region", "The past on the graph").press("button", "Back to now").await?;
    says(&ben, "Aiko looks at now again. You stay at this moment.").await?;
    assert_eq!(ben.eval(CURSOR).await?, last);
    assert_eq!(ben.eval(IS_THEN).await?, true);
    aiko.until(&format!("!{IS_THEN}"), "she sees now").await?;
    aiko.until("document.querySelectorAll('#stage .stream').length === 2", "with what Ben added").await?;

    // Stop works from then, and from then he comes back to now.
    stop(&ben).await?;
    ben.within("region", "The past on the graph").press("button", "Back to now").await?;
    ben.until(&format!("!{IS_THEN}"), "now again").await?;
    at_rest(&aiko).await?;
    aiko.no_errors()?;
    ben.no_errors()
}

#[tokio::test]
async fn who_is_followed_and_leaves_lets_the_other_stay() -> Outcome<()> {
    skip::unless!(ready("journey: look back together, and one leaves"));
    let stage = Stage::set().await?;
    let (aiko, ben) = one_looks_back(&stage).await?;
    ben.media("prefers-reduced-motion", "reduce").await?;
    // The sign in the bar leads there too, without the lanes being open.
    ben.press("button", "Follow Aiko, who looks back").await?;
    ben.until("document.querySelectorAll('.past-label').length > 1", "the lanes are there").await?;
    same_moment(&aiko, &ben).await?;

    // With little motion the cursor goes along once a second at most, and comes to the newest moment.
    ben.eval(
        "globalThis.went = [], new MutationObserver(() => { const at = document.querySelector('.past-canvas').dataset.cursor; \
            if (went.at(-1)?.at !== at) went.push({ at, ms: performance.now() }); })\
            .observe(document.querySelector('.past-canvas'), { attributes: true, attributeFilter: ['data-cursor'] }), 0",
    )
    .await?;
    for _ in 0..12 {
        aiko.key("Shift+ArrowLeft").await?;
        aiko.key("Shift+ArrowRight").await?;
    }
    aiko.key("Shift+ArrowLeft").await?;
    same_moment(&aiko, &ben).await?;
    let hurried = "went.some((one, at) => at > 0 && one.ms - went[at - 1].ms < 950)";
    assert_eq!(ben.eval(hurried).await?, false, "{}", ben.eval("JSON.stringify(went)").await?);

    // She leaves: it is said, and he stays at the moment.
    let last = ben.eval(CURSOR).await?;
    aiko.goto("about:blank").await?;
    says(&ben, "Aiko left. You stay at this moment.").await?;
    assert_eq!((ben.eval(CURSOR).await?, ben.eval(IS_THEN).await?), (last, true.into()));
    stop(&ben).await?;
    ben.no_errors()
}

#[tokio::test]
async fn a_recording_is_looked_at_together_by_a_finger_alone() -> Outcome<()> {
    skip::unless!(ready("journey: a recording together, by finger"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    aiko.press("button", "Track far and close balls*").await?;
    aiko.find("button", "Track far and close balls").await?;
    saved(&aiko).await?;
    let id = aiko.eval("location.hash.match(/[0-9a-f-]{8,}/)[0]").await?;
    let id = id.as_str().unwrap_or_default();
    let file = aiko.eval(&format!("fetch('/api/behaviours/{id}.json').then(file => file.text())")).await?;
    keep_session_of(stage.folder(), id, file.as_str().unwrap_or_default())?;
    let hash = aiko.eval("location.hash").await?;
    let ben = stage.nobody("ben").await?;
    ben.size(390, 844, true).await?;
    ben.goto(&format!("{}{}", stage.server.url(), hash.as_str().unwrap_or_default())).await?;
    usable(&ben).await?;
    ben.find("button", "1 more person").await?;
    aiko.goto(&format!("{}?past={SESSION}{}", stage.server.url(), hash.as_str().unwrap_or_default())).await?;
    usable(&aiko).await?;
    aiko.until(THERE, "the lanes are there").await?;
    aiko.key("[").await?;
    aiko.until(&format!("{CURSOR} === 580000 && {IS_THEN}"), "a mark").await?;

    // The list of people tells of it, and leads to the same recording at the same moment.
    ben.tap("button", "1 more person").await?;
    ben.until("/at \\d\\d:\\d\\d:\\d\\d/.test(document.querySelector('.people-list').innerText)", "her moment").await?;
    ben.tap("button", "Follow *").await?;
    ben.until(&format!("{CURSOR} === 580000"), "the same moment of the same recording").await?;
    aiko.key("[").await?;
    aiko.until(&format!("{CURSOR} === 420000"), "the mark before").await?;
    ben.until(&format!("{CURSOR} === 420000"), "along with her").await?;
    ben.tap("button", "End following *").await?;
    aiko.key("[").await?;
    aiko.until(&format!("{CURSOR} !== 420000"), "another moment").await?;
    ben.until(&format!("!{OTHERS}.includes('looks with')"), "he is alone").await?;
    assert_eq!(ben.eval(CURSOR).await?, 420_000.0);

    // Both follow each other: nobody moves until one does.
    ben.tap("button", "Follow *").await?;
    same_moment(&aiko, &ben).await?;
    aiko.find("button", "Stop").await?;
    aiko.no_errors()?;
    ben.no_errors()
}
