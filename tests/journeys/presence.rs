//! Who is here: names that tell people apart, what others point at and select, and following somebody's view.

use house::{Outcome, Page, skip};
use serde_json::json;

use crate::steps::*;
use crate::together::{add_map, call_myself};

/// What stands on the signs in the bar.
const LETTERS: &str = "[...document.querySelectorAll('.people .avatar:not(.more)')].map(sign => sign.innerText.trim() || sign.querySelector('[data-letters]').dataset.letters).join(' ')";
/// Where the canvas is.
const VIEW: &str = "document.querySelector('.world').style.transform";
/// Where the pointer of somebody else is.
const POINTER: &str = "document.querySelector('.people-pointer')?.style.transform ?? ''";

/// Says one's name in the field that asks for it.
async fn say_name(page: &Page, name: &str) -> Outcome<()> {
    let card = page.within("form", "Your name");
    card.fill("textbox", "Others see you as", name).await?;
    card.press("button", "Save").await?;
    page.gone("textbox", "Others see you as").await
}

#[tokio::test]
async fn a_name_is_asked_for_once_and_two_with_one_name_are_told_apart() -> Outcome<()> {
    skip::unless!(ready("journey: names"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_map(&aiko).await?;
    aiko.gone("textbox", "Others see you as").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    aiko.find("textbox", "Others see you as").await?;
    let letters = aiko.eval(LETTERS).await?;
    let (one, other) = letters.as_str().and_then(|letters| letters.split_once(' ')).unwrap_or_default();
    assert!(one != other && !one.is_empty() && !other.is_empty(), "two guests are told apart: {letters}");
    say_name(&aiko, "Aiko").await?;
    ben.find("button", "Follow Aiko").await?;
    say_name(&ben, "Aiko").await?;
    aiko.find("button", "Follow Aiko (2)").await?;
    ben.find("button", "Follow Aiko").await?;
    assert_eq!(aiko.eval(LETTERS).await?, json!("A2 AI"));
    ben.reload().await?;
    usable(&ben).await?;
    ben.find("button", "Follow Aiko").await?;
    ben.gone("textbox", "Others see you as").await?;
    ben.within("toolbar", "Main tools").press("button", "A2: *").await?;
    ben.within("dialog", "Your name").fill("textbox", "Name*", "Ben").await?;
    ben.within("dialog", "Your name").press("button", "Save").await?;
    aiko.find("button", "Follow Ben").await?;
    rename_program(&ben, "Ours", "Mine").await?;
    aiko.find("button", "Mine").await?;
    calm(&ben)?;
    calm(&aiko)
}

#[tokio::test]
async fn who_does_not_want_a_name_is_not_asked_again() -> Outcome<()> {
    skip::unless!(ready("journey: no name"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_map(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    ben.within("form", "Your name").press("button", "Not now").await?;
    ben.gone("textbox", "Others see you as").await?;
    ben.reload().await?;
    usable(&ben).await?;
    ben.find("button", "Follow Guest*").await?;
    ben.gone("textbox", "Others see you as").await?;
    calm(&ben)
}

#[tokio::test]
async fn a_new_name_stands_beside_what_one_is_editing_at_once() -> Outcome<()> {
    skip::unless!(ready("journey: a new name"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_map(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    call_myself(&ben, "Ben").await?;
    aiko.find("button", "Follow Ben").await?;
    ben.press("button", "map (1), connector*").await?;
    let ring = "(() => { const ring = document.querySelector('.of-chip .ring'); return ring?.innerText.trim() === 'Ben' \
        && !ring.querySelector('svg'); })()";
    aiko.until(ring, "the map shows that Ben selected it, without a padlock").await?;
    let color = "(() => { const of = at => getComputedStyle(document.querySelector(at)); \
        return of('.ring').borderTopColor === of('.people .avatar[aria-pressed]').backgroundColor \
        && of('.ring').borderTopWidth === '2px'; })()";
    aiko.until(color, "the ring is two pixels of Ben's colour").await?;
    call_myself_anew(&ben, "Benedikt").await?;
    let ring = "document.querySelector('.of-chip .ring')?.innerText.trim() === 'Benedikt'";
    aiko.until(ring, "the ring has the new name").await?;
    calm(&ben)?;
    calm(&aiko)
}

/// Gives oneself another name, once one has one.
async fn call_myself_anew(page: &Page, name: &str) -> Outcome<()> {
    page.within("toolbar", "Main tools").press("button", "BE: Ben (you)").await?;
    page.within("dialog", "Your name").fill("textbox", "Name*", name).await?;
    page.within("dialog", "Your name").press("button", "Save").await?;
    page.gone("dialog", "Your name").await
}

#[tokio::test]
async fn the_pointers_of_others_glide_unless_motion_is_not_wanted() -> Outcome<()> {
    skip::unless!(ready("journey: pointers"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_map(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    ben.move_to((500.0, 600.0)).await?;
    aiko.until(&format!("{POINTER} !== ''"), "Ben's pointer is there").await?;
    let before = aiko.eval(POINTER).await?;
    ben.move_to((600.0, 640.0)).await?;
    aiko.until(&format!("{POINTER} !== {before}"), "Ben's pointer moves").await?;
    let how = "getComputedStyle(document.querySelector('.people-pointer')).transitionProperty";
    assert_eq!(aiko.eval(how).await?, json!("transform, opacity"));
    let still = json!({ "features": [{ "name": "prefers-reduced-motion", "value": "reduce" }] });
    aiko.call("Emulation.setEmulatedMedia", still).await?;
    aiko.until(&format!("{how} === 'none'"), "it jumps").await?;
    ben.move_to((20.0, 500.0)).await?;
    aiko.until(&format!("{POINTER} === ''"), "Ben's pointer left the graph").await?;
    calm(&ben)?;
    calm(&aiko)
}

#[tokio::test]
async fn who_follows_sees_what_the_other_sees_until_a_hand_or_a_key_ends_it() -> Outcome<()> {
    skip::unless!(ready("journey: following"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_map(&aiko).await?;
    call_myself(&aiko, "Aiko").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    call_myself(&ben, "Ben").await?;
    ben.press("button", "Follow Aiko").await?;
    says(&ben, "Following Aiko").await?;
    look_elsewhere(&aiko, -200.0).await?;
    sees_the_same(&ben, &aiko).await?;
    look_elsewhere(&aiko, 300.0).await?;
    sees_the_same(&ben, &aiko).await?;

    ben.key("Escape").await?;
    silent(&ben, "Following Aiko").await?;
    stays(&ben, &aiko).await?;

    ben.press("button", "Follow Aiko").await?;
    sees_the_same(&ben, &aiko).await?;
    ben.wheel((500.0, 600.0), 0.0, 120.0).await?;
    silent(&ben, "Following Aiko").await?;
    stays(&ben, &aiko).await?;

    // Two who follow each other see one thing, and it stays where it is.
    ben.press("button", "Follow Aiko").await?;
    sees_the_same(&ben, &aiko).await?;
    aiko.press("button", "Follow Ben").await?;
    says(&aiko, "Following Ben").await?;
    sees_the_same(&ben, &aiko).await?;
    aiko.press("button", "End").await?;
    silent(&aiko, "Following Ben").await?;

    aiko.close().await?;
    says(&ben, "Aiko left. You look around by yourself again.").await?;
    silent(&ben, "Following Aiko").await?;
    calm(&ben)
}

/// Turns the wheel, so that something else is in view.
async fn look_elsewhere(page: &Page, down: f64) -> Outcome<()> {
    let before = page.eval(VIEW).await?;
    page.wheel_zoom((700.0, 500.0), down).await?;
    page.until(&format!("{VIEW} !== {before}"), "something else is in view").await.map(drop)
}

/// Waits until one sees what the other sees; both windows are as large.
async fn sees_the_same(one: &Page, other: &Page) -> Outcome<()> {
    let view = other.eval(VIEW).await?;
    let js = format!(
        "(() => {{ const numbers = text => text.match(/-?[\\d.]+/g).map(Number); \
         const [here, there] = [numbers({VIEW}), numbers({view})]; \
         return here.every((number, at) => Math.abs(number - there[at]) < 4); }})()"
    );
    one.until(&js, "both see one part of the graph").await.map(drop)
}

/// Whether one goes on seeing what one sees while the other looks elsewhere: by the time their pointer is told, their view
/// was.
async fn stays(one: &Page, other: &Page) -> Outcome<()> {
    let (view, pointer) = (one.eval(VIEW).await?, one.eval(POINTER).await?);
    look_elsewhere(other, 200.0).await?;
    other.move_to((650.0, 560.0)).await?;
    other.move_to((640.0, 440.0)).await?;
    one.until(&format!("{POINTER} !== {pointer}"), "the pointer of the other was told").await?;
    assert_eq!(one.eval(VIEW).await?, view, "nobody else moves one's view");
    Ok(())
}
