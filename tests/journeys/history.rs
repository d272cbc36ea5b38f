//! History: each takes back only what is theirs, also after a reload and without a connection; everyone sees who did what,
//! names versions, compares them, goes back and brings back.

use house::{Outcome, Page, skip};

use crate::steps::*;
use crate::together::call_myself;

/// Aiko, who made a program with a ball, and Ben beside her.
async fn two(stage: &Stage) -> Outcome<(Page, Page)> {
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Ours").await?;
    call_myself(&aiko, "Aiko").await?;
    add_sense(&aiko, "Red ball").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    call_myself(&ben, "Ben").await?;
    aiko.find("button", "Follow Ben").await?;
    Ok((aiko, ben))
}

/// Waits until Undo or Redo says that it would do this.
async fn offers(page: &Page, title: &str) -> Outcome<()> {
    let js = format!("[...document.querySelectorAll('.bar button:enabled')].some(b => b.title === '{title}')");
    page.until(&js, &format!("“{title}” is offered")).await.map(drop)
}

async fn open_history(page: &Page) -> Outcome<()> {
    page.press("button", "History").await?;
    page.find("region", "History").await?;
    page.until("!!document.querySelector('.history .gesture')", "the history is there").await.map(drop)
}

#[tokio::test]
async fn undo_survives_a_reload_and_names_who_changed_it_since() -> Outcome<()> {
    skip::unless!(ready("journey: undo after a reload"));
    let stage = Stage::set().await?;
    let (aiko, ben) = two(&stage).await?;
    ben.until("document.querySelector('[aria-label=Undo]').disabled", "Ben has nothing to take back").await?;
    rename_program(&aiko, "Ours", "Aiko's").await?;
    ben.find("button", "Aiko's").await?;
    rename_program(&ben, "Aiko's", "Ben's").await?;
    aiko.find("button", "Ben's").await?;
    aiko.reload().await?;
    usable(&aiko).await?;
    offers(&aiko, "Undo: Rename program").await?;
    aiko.press("button", "Undo").await?;
    says(&aiko, "Ben changed").await?;
    aiko.find("button", "Ben's").await?;
    offers(&aiko, "Undo: Rename program").await?;
    ben.press("button", "Undo").await?;
    aiko.find("button", "Aiko's").await?;
    aiko.press("button", "Undo").await?;
    ben.find("button", "Ours").await?;
    offers(&aiko, "Undo: Add Red ball").await?;
    aiko.reload().await?;
    usable(&aiko).await?;
    offers(&aiko, "Redo: Rename program").await?;
    aiko.press("button", "Redo").await?;
    ben.find("button", "Aiko's").await?;
    aiko.key("Control+z").await?;
    ben.find("button", "Ours").await?;
    aiko.key("Control+Shift+z").await?;
    ben.find("button", "Aiko's").await?;
    calm(&ben)?;
    calm(&aiko)
}

#[tokio::test]
async fn a_version_has_a_name_is_compared_and_gone_back_to() -> Outcome<()> {
    skip::unless!(ready("journey: versions"));
    let stage = Stage::set().await?;
    let (aiko, ben) = two(&stage).await?;
    open_history(&ben).await?;
    ben.find("button", "Aiko added Red ball *").await?;
    open_history(&aiko).await?;
    aiko.find("button", "You added Red ball *").await?;
    aiko.key("n").await?;
    aiko.within("region", "History").fill("textbox", "Name of this version", "Before group B").await?;
    aiko.key("Enter").await?;
    ben.find("button", "Before group B *").await?;

    add_sense(&aiko, "Head touch").await?;
    ben.find("button", "Aiko added Head touch *").await?;
    ben.press("button", "Red ball, sensor stream").await?;
    next(&ben, "Red ball", "Remove").await?;
    aiko.find("button", "Ben removed Red ball *").await?;
    aiko.press("button", "Before group B *").await?;
    says(&aiko, "1 new").await?;
    says(&aiko, "1 removed").await?;
    aiko.find("button", "Head touch, anywhere, sensor stream, new").await?;
    aiko.find("image", "Red ball, removed by Ben").await?;
    aiko.until("!!document.querySelector('.history th[scope=row]')", "the table is there").await?;
    aiko.press("button", "Go back to it …").await?;
    aiko.press("button", "Go back").await?;
    for person in [&aiko, &ben] {
        person.find("button", "Red ball, sensor stream").await?;
        person.gone("button", "Head touch, anywhere, sensor stream").await?;
    }
    ben.find("button", "Aiko went back to “Before group B” *").await?;
    aiko.press("button", "Undo").await?;
    ben.find("button", "Head touch, anywhere, sensor stream").await?;
    calm(&ben)?;
    calm(&aiko)
}

#[tokio::test]
async fn two_versions_are_compared_with_the_keyboard() -> Outcome<()> {
    skip::unless!(ready("journey: two versions"));
    let stage = Stage::set().await?;
    let (aiko, ben) = two(&stage).await?;
    ben.close().await?;
    add_sense(&aiko, "Head touch").await?;
    rename_program(&aiko, "Ours", "Mine").await?;
    open_history(&aiko).await?;
    aiko.until("document.activeElement.innerText.includes('renamed')", "the newest line has the keyboard").await?;
    for _ in 0..2 {
        aiko.key("ArrowDown").await?;
    }
    aiko.until("document.activeElement.innerText.includes('Red ball')", "the keyboard is at the first ball").await?;
    aiko.key("Enter").await?;
    says(&aiko, "1 new").await?;
    says(&aiko, "1 changed").await?;
    let choose = "function () {
        this.value = [...this.options].find(option => option.text.includes('Add Head touch')).value;
        this.dispatchEvent(new Event('change', { bubbles: true }));
    }";
    aiko.on("combobox", "Compare with", choose).await?;
    silent(&aiko, "1 changed").await?;
    says(&aiko, "1 new").await?;
    aiko.key("Escape").await?;
    silent(&aiko, "Compared:").await?;
    aiko.find("button", "Head touch, anywhere, sensor stream").await?;
    aiko.find("region", "History").await?;
    calm(&aiko)
}

#[tokio::test]
async fn what_somebody_removed_is_brought_back() -> Outcome<()> {
    skip::unless!(ready("journey: bring it back"));
    let stage = Stage::set().await?;
    let (aiko, ben) = two(&stage).await?;
    aiko.press("button", "Red ball, sensor stream").await?;
    next(&aiko, "Red ball", "Remove").await?;
    ben.gone("button", "Red ball, sensor stream").await?;
    open_history(&ben).await?;
    ben.press("button", "Bring it back").await?;
    for person in [&aiko, &ben] {
        person.find("button", "Red ball, sensor stream").await?;
    }
    ben.find("button", "You brought back “Red ball” *").await?;
    ben.press("button", "Bring it back").await?;
    says(&ben, "Nothing that was removed there is missing now.").await?;
    calm(&ben)?;
    calm(&aiko)
}

#[tokio::test]
async fn a_program_that_was_removed_comes_back() -> Outcome<()> {
    skip::unless!(ready("journey: a removed program"));
    let stage = Stage::set().await?;
    let (aiko, ben) = two(&stage).await?;
    remove_program(&aiko).await?;
    says(&aiko, "“Ours” is in the bin.").await?;
    says(&ben, "Aiko removed “Ours”.").await?;
    ben.press("button", "Bring it back").await?;
    ben.find("button", "Red ball, sensor stream").await?;
    aiko.key("Control+z").await?;
    aiko.find("button", "Red ball, sensor stream").await?;
    remove_program(&aiko).await?;
    aiko.press("button", "Bring it back").await?;
    aiko.find("button", "Red ball, sensor stream").await?;
    offers(&aiko, "Undo: Add Red ball").await?;
    calm(&aiko)
}

async fn remove_program(page: &Page) -> Outcome<()> {
    page.within("toolbar", "Main tools").press("button", "Remove program").await?;
    page.within("dialog", "Remove “Ours”?").press("button", "Remove").await?;
    page.gone("dialog", "Remove “Ours”?").await
}
