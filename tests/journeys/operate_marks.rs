//! Marks that wait while the link is away, over a reload of the page and a new start of the server; and what is read aloud meanwhile.

use house::{Outcome, Page, Switch, skip};

use crate::operate::{of_recording, operates, starts};
use crate::steps::*;

#[tokio::test]
async fn marks_that_wait_come_once_after_the_page_was_loaded_again() -> Outcome<()> {
    skip::unless!(ready("journey: marks that wait over a reload"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let socket = Switch::install(&aiko).await?;
    operates(&stage, &aiko).await?;
    starts(&aiko, "P-07").await?;
    // The server hears the first one, and its answer is lost; it never hears of the second one.
    aiko.eval("globalThis.isCut = true, 0").await?;
    aiko.key("m").await?;
    says(&aiko, "Add a note …").await?;
    aiko.eval("globalThis.sockets.forEach(socket => socket.close()), 0").await?;
    says(&aiko, "No connection for").await?;
    aiko.key("m").await?;
    aiko.key("n").await?;
    aiko.until("document.activeElement.id === 'op-note'", "the note has the keyboard").await?;
    aiko.type_text("laughs").await?;
    aiko.key("Enter").await?;
    says(&aiko, "waits here").await?;
    aiko.reload().await?;
    usable(&aiko).await?;
    says(&aiko, "“laughs”").await?;
    aiko.until("document.querySelectorAll('.op-flag').length === 2", "both are there").await?;
    silent(&aiko, "waits here").await?;
    aiko.until("sessionStorage.getItem('rrp.marks') === null", "nothing waits").await?;
    assert_eq!(of_recording(&stage, "note").await?, ["", "laughs"]);
    aiko.reload().await?;
    usable(&aiko).await?;
    aiko.until("document.querySelectorAll('.op-flag').length === 2", "they are there again").await?;
    assert_eq!(of_recording(&stage, "note").await?, ["", "laughs"], "nothing is doubled");
    socket.mend().await?;
    calm(&aiko)
}

/// Gathers what is read aloud from now on: the words of every live region whenever they change.
const LISTENS: &str = "(() => {
    const live = '[role=status], [role=alert], [aria-live]:not([aria-live=off])';
    const words = region => {
        const copy = region.cloneNode(true);
        copy.querySelectorAll('[aria-hidden=true], [hidden]').forEach(hidden => hidden.remove());
        return copy.textContent.trim();
    };
    const known = new Map();
    globalThis.aloud = [];
    const look = () => document.querySelectorAll(live).forEach(region => {
        const said = region.closest('[hidden], [aria-hidden=true]') ? '' : words(region);
        if (said && known.get(region) !== said) globalThis.aloud.push(said);
        known.set(region, said);
    });
    look();
    globalThis.aloud = [];
    new MutationObserver(look).observe(document.body, { subtree: true, childList: true, characterData: true, attributes: true });
    return 0;
})()";

/// The texts that were read aloud again with nothing but another number in them.
const COUNTED: &str = "(() => {
    const plain = globalThis.aloud.map(said => said.replace(/[0-9]+/g, '#'));
    return globalThis.aloud.filter((said, at) => plain.indexOf(plain[at]) !== at);
})()";

/// Says nothing for nine seconds by the page's clock, and sees the seconds on the page.
async fn is_silent(page: &Page, socket: &Switch<'_>) -> Outcome<()> {
    page.eval(LISTENS).await?;
    for seconds in 2..=9 {
        socket.silent_for(seconds * 1_000).await?;
        let seen = format!(
            "document.body.innerText.includes('{seconds} s')||document.body.innerText.includes('{seconds} seconds')"
        );
        page.until(&seen, "the seconds are seen").await?;
    }
    let aloud = page.eval("globalThis.aloud.length").await?;
    assert!(aloud.as_u64().is_some_and(|aloud| aloud > 0), "that the link is lost is read aloud");
    assert_eq!(page.eval(COUNTED).await?, serde_json::json!([]), "no clock is read aloud");
    Ok(())
}

#[tokio::test]
async fn the_seconds_of_a_silence_are_seen_and_never_read_aloud() -> Outcome<()> {
    skip::unless!(ready("journey: what is read aloud"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let socket = Switch::install(&aiko).await?;
    operates(&stage, &aiko).await?;
    starts(&aiko, "P-07").await?;
    is_silent(&aiko, &socket).await?;
    socket.mend().await?;
    silent(&aiko, "No connection for").await?;
    let root = stage.server.url();
    aiko.goto(&format!("{root}?graph")).await?;
    usable(&aiko).await?;
    is_silent(&aiko, &socket).await?;
    socket.mend().await
}
