//! Locks: one person edits a connector at a time, everyone else sees who it is, and nothing that was written is lost.

use house::{Outcome, Page, skip};

use crate::steps::*;
use crate::together::{add_map, call_myself, write_body};

/// Whether the chip says who is editing it, with a ring and a padlock.
const IS_LOCKED: &str = "function () {
    const at = this.closest('.at');
    return !!at.querySelector('.ring .tag svg') && at.querySelector('.ring').innerText.trim() === 'Aiko is editing';
}";

/// Aiko, who made a program with a map, and Ben beside her.
async fn two(stage: &Stage) -> Outcome<(Page, Page)> {
    let aiko = stage.person("aiko").await?;
    add_map(&aiko).await?;
    call_myself(&aiko, "Aiko").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    call_myself(&ben, "Ben").await?;
    aiko.find("button", "Follow Ben").await?;
    ben.find("button", "Follow Aiko").await?;
    Ok((aiko, ben))
}

/// Opens the editor of the map.
async fn open_map(page: &Page) -> Outcome<()> {
    page.press("button", "map (1), connector*").await?;
    next(page, "map", "More…").await?;
    page.find("dialog", "Operation").await.map(drop)
}

/// Waits until one may only read in the open editor, or may write.
async fn may_write(page: &Page, may: bool) -> Outcome<()> {
    let js = format!("document.querySelector('.dialog textarea')?.matches(':disabled') === {}", !may);
    page.until(&js, if may { "one may write" } else { "one may only read" }).await.map(drop)
}

async fn body(page: &Page) -> Outcome<String> {
    page.within("dialog", "Operation").text("textbox", "Procedure").await
}

#[tokio::test]
async fn what_one_edits_others_read_until_it_is_handed_over() -> Outcome<()> {
    skip::unless!(ready("journey: handing over"));
    let stage = Stage::set().await?;
    let (aiko, ben) = two(&stage).await?;
    write_body(&aiko, "map (1), connector*", "2 + 2").await?;
    ben.until_on("button", "map (1), connector*", IS_LOCKED, "the map shows that Aiko is editing").await?;
    let name = "document.querySelector('[data-chip]').getAttribute('aria-label').endsWith(', Aiko is editing')";
    ben.until(name, "the map says that Aiko is editing").await?;
    open_map(&ben).await?;
    says(&ben, "It is as Aiko left it until Aiko saves.").await?;
    may_write(&ben, false).await?;
    assert_eq!(body(&ben).await?, "1");
    ben.press("button", "Ask Aiko").await?;
    says(&ben, "Asked. Yours in").await?;
    says(&aiko, "Ben would like to edit this.").await?;
    aiko.find("button", "Stop").await?;
    aiko.press("button", "Hand over").await?;
    may_write(&ben, true).await?;
    may_write(&aiko, false).await?;
    says(&aiko, "Your text stays here until you close.").await?;
    assert_eq!(body(&aiko).await?, "2 + 2");
    ben.within("dialog", "Operation").fill("textbox", "Procedure", "3").await?;
    save(&ben, "Operation").await?;
    aiko.press("button", "Go on editing").await?;
    may_write(&aiko, true).await?;
    assert_eq!(body(&aiko).await?, "2 + 2");
    aiko.within("dialog", "Operation").press("button", "Save").await?;
    aiko.within("dialog", "Ben changed this map too").press("button", "Keep mine").await?;
    aiko.gone("dialog", "Ben changed this map too").await?;
    ben.find("button", "map (2 + 2), connector*").await?;
    calm(&ben)?;
    calm(&aiko)
}

#[tokio::test]
async fn who_keeps_it_is_asked_again_later_and_who_closes_it_frees_it() -> Outcome<()> {
    skip::unless!(ready("journey: keeping a lock"));
    let stage = Stage::set().await?;
    let (aiko, ben) = two(&stage).await?;
    open_map(&aiko).await?;
    open_map(&ben).await?;
    ben.press("button", "Ask Aiko").await?;
    aiko.press("button", "Keep it").await?;
    says(&ben, "Aiko keeps it for now. You can ask again in").await?;
    silent(&aiko, "Ben would like to edit this.").await?;
    aiko.within("dialog", "Operation").fill("textbox", "Procedure", "7").await?;
    save(&aiko, "Operation").await?;
    says(&ben, "Nobody is editing it any more.").await?;
    assert_eq!(body(&ben).await?, "7", "what is saved is shown at once");
    ben.press("button", "Edit it").await?;
    may_write(&ben, true).await?;
    aiko.find("button", "map (7), connector*").await?;
    ben.key("Escape").await?;
    ben.gone("dialog", "Operation").await?;
    aiko.until("!document.querySelector('.ring .tag svg')", "nobody is editing any more").await?;
    calm(&ben)?;
    calm(&aiko)
}

#[tokio::test]
async fn one_persons_two_tabs_cannot_both_edit_one_connector() -> Outcome<()> {
    skip::unless!(ready("journey: two tabs"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_map(&aiko).await?;
    call_myself(&aiko, "Aiko").await?;
    let tab = stage.browser.second_tab(&aiko, "aiko-2").await?;
    tab.size(1440, 900, false).await?;
    tab.goto(&aiko.address().await?).await?;
    usable(&tab).await?;
    open_map(&aiko).await?;
    open_map(&tab).await?;
    says(&tab, "Aiko is editing").await?;
    may_write(&tab, false).await?;
    may_write(&aiko, true).await?;
    calm(&tab)?;
    calm(&aiko)
}
