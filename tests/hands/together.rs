//! Two people on one canvas: rings and pointers are allowed by the page's own policy, and edits arrive soon.

use std::time::{Duration, Instant};

use house::{Outcome, Page};

use crate::steps::{Stage, picture, rests, say, stage, view};

const EDITS: usize = 40;

/// Waits for the next move of the ball.
const NEXT_MOVE: &str = "new Promise(done => {
    const eyes = new MutationObserver(() => { eyes.disconnect(); done(true); });
    eyes.observe(document.querySelector('[aria-label^=\"Ball,\"]').parentElement, { attributeFilter: ['style'] });
})";

/// Waits until the pointer of somebody else moves.
const NEXT_POINTER: &str = "new Promise(done => {
    const eyes = new MutationObserver(() => { eyes.disconnect(); done(true); });
    eyes.observe(document.querySelector('.people-pointer'), { attributeFilter: ['style'] });
})";

#[tokio::test]
async fn rings_and_pointers_of_others_are_seen_without_complaints() -> Outcome<()> {
    let stage = stage!("rings");
    let (aiko, ben) = two(&stage, "Rings").await?;
    let (x, y) = rests(&ben, "Distance,*").await?.centre();
    ben.press("button", "Distance,*").await?;
    ben.move_to((x + 150.0, y + 120.0)).await?;
    aiko.until("document.querySelector('.ring') !== null", "the ring is there").await?;
    aiko.until("document.querySelector('.people-pointer') !== null", "the pointer is there").await?;
    let ring = aiko.eval("getComputedStyle(document.querySelector('.ring')).borderTopColor").await?;
    let tag = aiko.eval("getComputedStyle(document.querySelector('.ring .tag')).backgroundColor").await?;
    assert_eq!(ring, tag, "the ring and its tag have the person's colour");
    picture(&aiko, "ring").await?;
    for person in [&aiko, &ben] {
        person.no_errors()?;
    }
    Ok(())
}

#[tokio::test]
async fn an_edit_reaches_the_other_soon() -> Outcome<()> {
    let stage = stage!("an edit reaches the other");
    let (aiko, ben) = two(&stage, "Soon").await?;
    rests(&ben, "Ball,*").await?;
    let mut took = Vec::new();
    for edit in 0..EDITS {
        let (x, y) = rests(&aiko, "Ball,*").await?.centre();
        let zoom = view(&aiko).await?.2;
        let to = x + if edit % 2 == 0 { 40.0 } else { -40.0 } * zoom;
        aiko.hold((x, y)).await?;
        aiko.pull((to, y)).await?;
        aiko.pull((to, y)).await?;
        took.push(until_seen(&ben, NEXT_MOVE, aiko.release((to, y))).await?);
    }
    tell("An edit reaches the other browser", 50, took);
    aiko.no_errors()?;
    ben.no_errors()
}

#[tokio::test]
async fn a_pointer_is_seen_by_the_other_soon() -> Outcome<()> {
    let stage = stage!("a pointer reaches the other");
    let (aiko, ben) = two(&stage, "Soon").await?;
    let (x, y) = rests(&aiko, "Distance,*").await?.centre();
    rests(&ben, "Distance,*").await?;
    aiko.move_to((x + 150.0, y + 120.0)).await?;
    ben.until("document.querySelector('.people-pointer') !== null", "the pointer is there").await?;
    let mut took = Vec::new();
    for edit in 0..EDITS {
        // It glides to where it was told: only after that the next move is a new one.
        ben.settled().await?;
        let side = if edit % 2 == 0 { 40.0 } else { -40.0 };
        took.push(until_seen(&ben, NEXT_POINTER, aiko.move_to((x + 150.0 + side, y + 120.0))).await?);
    }
    tell("A pointer reaches the other browser", 60, took);
    aiko.no_errors()?;
    ben.no_errors()
}

/// Two people in a new program of this name.
async fn two(stage: &Stage, program: &str) -> Outcome<(Page, Page)> {
    let program = stage.wire.make(program, Some("Track far and close balls")).await?;
    Ok((stage.person("aiko", &program).await?, stage.person("ben", &program).await?))
}

/// How long after somebody does something the other page changes.
async fn until_seen(other: &Page, change: &str, act: impl Future<Output = Outcome<()>>) -> Outcome<Duration> {
    // The other page listens before anything is done.
    other.eval(&format!("globalThis.changed = {change}, 0")).await?;
    let seen = async {
        other.eval("globalThis.changed").await?;
        Ok(Instant::now())
    };
    let done = async {
        let began = Instant::now();
        act.await.map(|()| began)
    };
    let (seen, began) = tokio::try_join!(seen, done)?;
    Ok(seen - began)
}

fn tell(what: &str, budget_ms: u32, mut took: Vec<Duration>) {
    took.sort();
    let ms = |part: usize| took[(took.len() * part / 100).min(took.len() - 1)].as_secs_f64() * 1_000.0;
    say(&format!("{what}: p50 {:.1} ms, p95 {:.1} ms (budget p95 {budget_ms} ms, on loopback).", ms(50), ms(95)));
}
