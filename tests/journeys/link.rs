//! The truth about the link: what is not known is not claimed, what waits is counted and shown, and Stop has its own way.

use house::{Outcome, Page, skip};

use crate::steps::*;
use crate::stop::running_ball;
use crate::visitor::Visitor;

/// Whether anything claims to know what the robot does now.
const CLAIMS: &str = "(() => {
    const found = [];
    if (document.querySelector('.lamp').dataset.health !== 'unheard') found.push('the lamp');
    if (document.querySelector('.start').ariaPressed === 'true') found.push('Start');
    if (!document.querySelector('.start').disabled) found.push('Start can be pressed');
    if (document.querySelector('.edge.fired, .chip.fired')) found.push('a pulse');
    if ([...document.querySelectorAll('.value')].some(value => !value.matches('.quiet'))) found.push('a value');
    const other = document.querySelector('.people .avatar[aria-pressed]');
    if (getComputedStyle(other).borderStyle !== 'dashed') found.push('an avatar');
    const lines = ['All changes saved', 'The robot runs this version'].filter(line => document.body.innerText.includes(line));
    return [...found, ...lines].join(', ');
})()";

/// Where the stage and what is under Stop are.
const PLACES: &str = "(() => {
    const stage = document.getElementById('stage').getBoundingClientRect();
    const stop = document.getElementById('stop').getBoundingClientRect();
    const top = document.elementFromPoint(stop.x + stop.width / 2, stop.y + stop.height / 2);
    return JSON.stringify([stage.x, stage.y, stage.width, stage.height, !!top.closest('#stop')]);
})()";

#[tokio::test]
async fn within_two_seconds_nothing_is_claimed_and_within_six_a_banner_says_what_is_known() -> Outcome<()> {
    skip::unless!(ready("journey: the link is cut"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let socket = stage.enter_with_switch(&aiko).await?;
    running_ball(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    aiko.find("button", "Follow Guest*").await?;
    let before = aiko.eval(PLACES).await?;

    socket.silent_for(2_000).await?;
    aiko.until(&format!("{CLAIMS} === ''"), "nothing is claimed any more").await?;
    aiko.find("button", "Was running").await?;
    for known in ["Last heard 2 s ago.", "It may still be moving.", "as it was 2 s ago"] {
        says(&aiko, known).await?;
    }
    assert!(!has(&aiko, "No connection").await?, "a short silence needs no banner");

    socket.silent_for(6_000).await?;
    says(&aiko, "No connection. You can go on; it is sent when the connection is back.").await?;
    says(&aiko, "The robot goes on by itself. Stop still tries its own way.").await?;
    assert_eq!(aiko.eval(PLACES).await?, before, "the banner moves nothing and is not over Stop");
    let width = "document.querySelector('.offline').getBoundingClientRect().width";
    assert!(aiko.eval(width).await?.as_f64().is_some_and(|width| width <= 648.0));

    rename_program(&aiko, "To be stopped", "Renamed").await?;
    says(&aiko, "No connection. 1 change waits here and is sent when it is back.").await?;
    aiko.press("button", "Show them").await?;
    aiko.find("dialog", "What waits here").await?;
    says(&aiko, "Rename program").await?;
    aiko.key("Escape").await?;
    aiko.gone("dialog", "What waits here").await?;

    let mut visitor = Visitor::enter(&stage.server).await?;
    visitor.runs("the program runs on", 1).await?;
    stop(&aiko).await?;
    visitor.runs("the robot was stopped", 0).await?;

    socket.mend().await?;
    says(&aiko, "Connected. 1 change was sent.").await?;
    saved(&aiko).await?;
    ben.find("button", "Renamed").await?;
    for gone in ["Last heard", "No connection", "as it was"] {
        silent(&aiko, gone).await?;
    }
    at_rest(&aiko).await?;
    calm(&ben)
}

async fn has(page: &Page, words: &str) -> Outcome<bool> {
    let found = page.eval(&format!("document.body.innerText.includes('{words}')")).await?;
    Ok(found.as_bool().unwrap_or_default())
}
