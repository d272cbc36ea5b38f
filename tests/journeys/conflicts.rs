//! A change that comes too late: it is kept, shown beside what somebody else saved, and its author decides.

use house::{Outcome, Page, Switch, skip};

use crate::steps::*;
use crate::together::{add_map, call_myself, write_body};

const CHIP: &str = "map (1), connector*";
const BOTH: &str = "Ben changed this map too";
const REMOVED: &str = "Ben removed this map";
/// Whether the chip says that one has still to decide.
const IS_UNDECIDED: &str = "function () {
    return !!this.closest('.at').querySelector('.badge.undecided') && this.ariaDescription.includes('not saved');
}";

/// Aiko, who made a program with a map, behind a switch, and Ben beside her.
async fn two<'a>(stage: &Stage, aiko: &'a Page) -> Outcome<(Switch<'a>, Page)> {
    let socket = stage.enter_with_switch(aiko).await?;
    add_map(aiko).await?;
    call_myself(aiko, "Aiko").await?;
    let ben = stage.beside(aiko, "ben").await?;
    call_myself(&ben, "Ben").await?;
    aiko.find("button", "Follow Ben").await?;
    Ok((socket, ben))
}

async fn cut(aiko: &Page, socket: &Switch<'_>) -> Outcome<()> {
    socket.cut().await?;
    says(aiko, "Offline").await
}

async fn mend(aiko: &Page, socket: &Switch<'_>) -> Outcome<()> {
    socket.mend().await?;
    silent(aiko, "Offline").await
}

/// Writes another body and saves it, with or without a connection.
async fn save_body(page: &Page, chip: &str, body: &str) -> Outcome<()> {
    write_body(page, chip, body).await?;
    page.within("dialog", "Operation").press("button", "Save").await?;
    page.gone("dialog", "Operation").await
}

/// Waits until exactly this is pointed out in both columns.
async fn differs(page: &Page, mine: &str, theirs: &str) -> Outcome<()> {
    let wanted = serde_json::json!([mine, theirs]);
    let js = format!(
        "JSON.stringify([...document.querySelectorAll('.compare mark')].map(mark => mark.textContent)) === '{wanted}'"
    );
    page.until(&js, &format!("{mine} and {theirs} are pointed out")).await.map(drop)
}

#[tokio::test]
async fn the_second_to_save_sees_both_decides_later_and_goes_on_top() -> Outcome<()> {
    skip::unless!(ready("journey: both side by side"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let (socket, ben) = two(&stage, &aiko).await?;
    cut(&aiko, &socket).await?;
    write_body(&aiko, CHIP, "2 + 2").await?;
    save_body(&ben, CHIP, "3").await?;
    ben.find("button", "map (3), connector*").await?;
    mend(&aiko, &socket).await?;
    aiko.find("button", "map (3), connector*").await?;
    aiko.within("dialog", "Operation").press("button", "Save").await?;
    aiko.find("dialog", BOTH).await?;
    says(&aiko, "While you were editing, Ben saved another procedure for 1. Yours waits here.").await?;
    differs(&aiko, "2 + 2", "3").await?;
    aiko.until("document.activeElement.id === 'dialog-title'", "no answer is likelier than another").await?;
    aiko.find("button", "Stop").await?;
    aiko.key("Escape").await?;
    aiko.gone("dialog", BOTH).await?;
    let theirs = "map (3), connector*";
    aiko.until_on("button", theirs, IS_UNDECIDED, "the chip is marked").await?;
    says(&aiko, "All other changes saved").await?;

    aiko.reload().await?;
    usable(&aiko).await?;
    aiko.until_on("button", theirs, IS_UNDECIDED, "the chip is marked after a reload").await?;
    aiko.press("button", theirs).await?;
    next(&aiko, "map", "More…").await?;
    aiko.find("dialog", BOTH).await?;
    differs(&aiko, "2 + 2", "3").await?;
    save_body(&ben, theirs, "4").await?;
    differs(&aiko, "2 + 2", "4").await?;
    aiko.press("button", "Keep mine").await?;
    aiko.gone("dialog", BOTH).await?;
    ben.find("button", "map (2 + 2), connector*").await?;
    saved(&aiko).await?;
    aiko.press("button", "Undo").await?;
    ben.find("button", "map (4), connector*").await?;
    calm(&ben)
}

#[tokio::test]
async fn an_edit_without_connection_that_comes_too_late_asks_by_itself() -> Outcome<()> {
    skip::unless!(ready("journey: a late edit"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let (socket, ben) = two(&stage, &aiko).await?;
    cut(&aiko, &socket).await?;
    save_body(&aiko, CHIP, "2 + 2").await?;
    let waits = "function () { return !!this.closest('.at').querySelector('.waits-ring'); }";
    aiko.until_on("button", "map (2 + 2), connector*", waits, "what waits is marked").await?;
    save_body(&ben, CHIP, "3").await?;
    ben.find("button", "map (3), connector*").await?;
    mend(&aiko, &socket).await?;
    aiko.find("dialog", BOTH).await?;
    says(&aiko, "While you were offline, Ben saved another procedure for 1.").await?;
    differs(&aiko, "2 + 2", "3").await?;
    aiko.press("button", "Copy mine").await?;
    says(&aiko, "Copied.").await?;
    aiko.press("button", "Take Ben’s").await?;
    aiko.gone("dialog", BOTH).await?;
    saved(&aiko).await?;
    aiko.press("button", "map (3), connector*").await?;
    next(&aiko, "map", "More…").await?;
    assert_eq!(aiko.within("dialog", "Operation").text("textbox", "Procedure").await?, "3", "no draft is left");
    calm(&ben)
}

#[tokio::test]
async fn several_come_one_after_the_other() -> Outcome<()> {
    skip::unless!(ready("journey: several late edits"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let (socket, ben) = two(&stage, &aiko).await?;
    cut(&aiko, &socket).await?;
    save_body(&aiko, CHIP, "2 + 2").await?;
    rename(&aiko, "Red ball", "Mine").await?;
    save_body(&ben, CHIP, "3").await?;
    rename(&ben, "Red ball", "Theirs").await?;
    ben.find("button", "Theirs, sensor stream").await?;
    mend(&aiko, &socket).await?;
    aiko.find("dialog", BOTH).await?;
    says(&aiko, "1 more change of yours comes after this one.").await?;
    aiko.press("button", "Keep mine").await?;
    let second = "Ben changed this stream too";
    aiko.find("dialog", second).await?;
    differs(&aiko, "Mine", "Theirs").await?;
    aiko.press("button", "Keep mine").await?;
    aiko.gone("dialog", second).await?;
    sees(&ben, &["map (2 + 2), connector*", "Mine, sensor stream"]).await?;
    saved(&aiko).await?;
    calm(&ben)
}

/// Gives a sense another name, with or without a connection.
async fn rename(page: &Page, from: &str, to: &str) -> Outcome<()> {
    select(page, from).await?;
    next(page, from, "Edit").await?;
    page.within("dialog", "Red ball settings").fill("textbox", "Name", to).await?;
    page.within("dialog", "Red ball settings").press("button", "Save").await?;
    page.gone("dialog", "Red ball settings").await
}

#[tokio::test]
async fn what_was_removed_under_a_change_comes_back_with_it() -> Outcome<()> {
    skip::unless!(ready("journey: bring it back"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let (socket, ben) = two(&stage, &aiko).await?;
    cut(&aiko, &socket).await?;
    save_body(&aiko, CHIP, "2 + 2").await?;
    select(&ben, "1").await?;
    next(&ben, "1", "Remove").await?;
    ben.gone("button", CHIP).await?;
    mend(&aiko, &socket).await?;
    aiko.find("dialog", REMOVED).await?;
    aiko.find("button", "Leave it removed").await?;
    aiko.press("button", "Bring it back").await?;
    aiko.gone("dialog", REMOVED).await?;
    sees(&ben, &["map (2 + 2), connector*", "1, stream"]).await?;
    saved(&aiko).await?;
    calm(&ben)
}

#[tokio::test]
async fn what_is_removed_under_an_open_editor_is_brought_back_from_there() -> Outcome<()> {
    skip::unless!(ready("journey: bring it back from an editor"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let (socket, ben) = two(&stage, &aiko).await?;
    cut(&aiko, &socket).await?;
    write_body(&aiko, CHIP, "2 + 2").await?;
    select(&ben, "1").await?;
    next(&ben, "1", "Remove").await?;
    ben.gone("button", CHIP).await?;
    mend(&aiko, &socket).await?;
    says(&aiko, "Ben removed this. What you wrote is still here").await?;
    aiko.within("dialog", "Operation").press("button", "Bring it back").await?;
    aiko.gone("dialog", "Operation").await?;
    sees(&ben, &["map (2 + 2), connector*", "1, stream"]).await?;
    saved(&aiko).await?;
    calm(&ben)
}

#[tokio::test]
async fn who_is_editing_it_keeps_mine_from_going_on_top() -> Outcome<()> {
    skip::unless!(ready("journey: a lock on what is compared"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let (socket, ben) = two(&stage, &aiko).await?;
    cut(&aiko, &socket).await?;
    save_body(&aiko, CHIP, "2 + 2").await?;
    save_body(&ben, CHIP, "3").await?;
    mend(&aiko, &socket).await?;
    aiko.find("dialog", BOTH).await?;
    ben.press("button", "map (3), connector*").await?;
    next(&ben, "map", "More…").await?;
    ben.find("dialog", "Operation").await?;
    aiko.until("!!document.querySelector('.ring .tag svg')", "Ben is editing it").await?;
    aiko.press("button", "Keep mine").await?;
    says(&aiko, "Ben is editing this map.").await?;
    ben.find("button", "map (3), connector*").await?;
    ben.key("Escape").await?;
    ben.gone("dialog", "Operation").await?;
    aiko.until("!document.querySelector('.ring .tag svg')", "nobody is editing it").await?;
    aiko.press("button", "Keep mine").await?;
    aiko.gone("dialog", BOTH).await?;
    ben.find("button", "map (2 + 2), connector*").await?;
    calm(&ben)
}
