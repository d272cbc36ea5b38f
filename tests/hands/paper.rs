//! What is printed: the name, the sentences and all of the graph, whatever was seen of it and in whatever theme.

use house::{Outcome, Page};

use crate::steps::{picture, rests, stage, view};

/// The streams that lie outside of the box that the graph has on paper, and how many there are.
const OUTSIDE: &str = "(() => {
    const paper = document.querySelector('.world').getBoundingClientRect();
    const height = parseFloat(document.querySelector('.world').style.height);
    const width = parseFloat(document.querySelector('.world').style.width);
    const top = document.querySelector('.stage').getBoundingClientRect();
    const all = [...document.querySelectorAll('.world .stream, .world .chip')].map(e => e.getBoundingClientRect());
    const left = Math.min(...all.map(box => box.left)), right = Math.max(...all.map(box => box.right));
    const upper = Math.min(...all.map(box => box.top)), lower = Math.max(...all.map(box => box.bottom));
    return all.length > 0 && right - left <= width && lower - upper <= height && left >= top.left - 1 && paper.width > 0
        ? '' : JSON.stringify([width, height, left, right, upper, lower]);
})()";

/// What is seen on paper beside the graph, its name and its sentences.
const BESIDE: &str =
    "[...document.querySelectorAll('.bar, .left, .right, #stop-form, .zoom, .strip, .dialog, .veil, .tour, .notice')]
    .filter(element => element.getClientRects().length > 0).map(element => element.className).join()";

async fn prints_whole(page: &Page, streams: usize) -> Outcome<()> {
    page.paper(true).await?;
    let whole = format!("document.querySelectorAll('.world .stream').length === {streams}");
    page.until(&whole, "every stream is on the paper").await?;
    page.until(&format!("{OUTSIDE} === ''"), "all of the graph is in its place on the page").await?;
    page.until(&format!("{BESIDE} === ''"), "nothing else is printed").await.map(drop)
}

#[tokio::test]
async fn all_of_a_graph_is_printed_with_its_name_and_sentences_in_light_colours() -> Outcome<()> {
    let stage = stage!("paper");
    let program = stage.wire.make("Balls on paper", Some("Track far and close balls")).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.theme(true).await?;
    rests(&aiko, "Ball, sensor stream").await?;
    aiko.until("document.querySelectorAll('.told .sentence').length > 0", "the sentences are there").await?;
    aiko.press("button", "Distance, stream").await?;
    aiko.key("Control+k").await?;
    aiko.find("dialog", "Keys and gestures").await?;
    prints_whole(&aiko, 6).await?;
    aiko.until("document.querySelector('.paper-title').innerText === 'Balls on paper'", "the name stands above")
        .await?;
    aiko.until("document.querySelector('.told .sentence').getClientRects().length > 0", "the sentences are printed")
        .await?;
    aiko.until(
        "getComputedStyle(document.querySelector('.paper-title')).color === 'rgb(27, 33, 28)'",
        "the ink is dark",
    )
    .await?;
    picture(&aiko, "paper").await?;
    aiko.paper(false).await?;
    aiko.find("dialog", "Keys and gestures").await?;
    aiko.until("document.querySelector('.paper-title') === null", "the screen is as it was").await?;
    aiko.no_errors()
}

#[tokio::test]
async fn what_is_out_of_view_is_printed_too_and_the_view_stays_as_it_was() -> Outcome<()> {
    let stage = stage!("paper of many");
    let program = stage.wire.make_large("Many", 60).await?;
    let aiko = stage.person("aiko", &program).await?;
    rests(&aiko, "Stream 1, *").await?;
    aiko.eval("document.querySelector('.zoom .percent').click(), 0").await?;
    rests(&aiko, "Stream 1, *").await?;
    let before = view(&aiko).await?;
    prints_whole(&aiko, 60).await?;
    assert!(view(&aiko).await?.2 < before.2, "it is made to fit");
    aiko.paper(false).await?;
    aiko.until("document.querySelector('.world').style.width === ''", "the screen is back").await?;
    assert_eq!(view(&aiko).await?, before);
    aiko.no_errors()
}

#[tokio::test]
async fn the_list_of_a_phone_is_printed_to_its_end() -> Outcome<()> {
    let stage = stage!("paper of a phone");
    let program = stage.wire.make("List", Some("Greeter")).await?;
    let aiko = stage.person("aiko", &program).await?;
    aiko.size(390, 844, true).await?;
    aiko.until("document.querySelectorAll('.twig').length > 4", "the list is there").await?;
    aiko.paper(true).await?;
    aiko.until(&format!("{BESIDE} === ''"), "nothing else is printed").await?;
    let whole = "(() => { const list = document.querySelector('.outline').getBoundingClientRect();
        const stage = document.querySelector('.stage').getBoundingClientRect(); return list.bottom <= stage.bottom + 1; })()";
    aiko.until(whole, "nothing is cut").await?;
    aiko.paper(false).await?;
    aiko.no_errors()
}
