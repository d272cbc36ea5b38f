//! The library: searching among hundreds of programs, the bin, files, and what programs have to do with each other.

use std::time::Duration;

use house::{Outcome, Page, Trouble, skip};
use protocol::{Refused, request};

use crate::steps::*;
use crate::visitor::{Visitor, id};

const MANY: usize = 260;
/// Lines that may be drawn at once, however long the list is.
const DRAWN_MAX: u64 = 40;
const SEARCH: &str = "Search in names, streams and procedures";
const ACTIVE: &str = "Number(document.activeElement.closest('li')?.getAttribute('aria-posinset') ?? 0)";

#[tokio::test]
async fn a_program_is_found_among_hundreds_by_keyboard() -> Outcome<()> {
    skip::unless!(ready("journey: hundreds of programs"));
    let stage = Stage::set().await?;
    let mut visitor = Visitor::enter(&stage.server).await?;
    for number in 1..=MANY {
        make(&mut visitor, &format!("Exercise {number:03}"), None).await?;
    }
    make(&mut visitor, "Welcome", Some("Greeter")).await?;
    let aiko = stage.person("aiko").await?;
    open_library(&aiko).await?;
    let dialog = aiko.within("dialog", "Load program");
    dialog.find("button", "Welcome*").await?;
    says(&aiko, &format!("{} programs", MANY + 1)).await?;

    // What a program uses is found as well, and the search box keeps the keyboard.
    dialog.fill("searchbox", SEARCH, "facedetection").await?;
    aiko.until("document.querySelectorAll('.program-line').length === 1", "one program is found").await?;
    dialog.find("button", "Welcome*").await?;
    dialog.fill("searchbox", SEARCH, "nothing like it").await?;
    says(&aiko, "Nothing fits “nothing like it”.").await?;
    dialog.press("button", "Clear the search").await?;
    dialog.find("button", &format!("Exercise {MANY}*")).await?;

    to_the_end(&aiko).await?;
    let drawn = aiko.eval("document.querySelectorAll('.program-line').length").await?;
    assert!(drawn.as_u64().is_some_and(|drawn| drawn <= DRAWN_MAX), "{drawn} lines are drawn");
    aiko.key("ArrowUp").await?;
    aiko.until(&format!("{ACTIVE} === {MANY}"), "the line before the last has the keyboard").await?;
    aiko.key("Enter").await?;
    aiko.gone("dialog", "Load program").await?;
    aiko.find("button", "Exercise 002").await?;
    calm(&aiko)
}

#[tokio::test]
async fn what_was_removed_comes_back_from_the_bin() -> Outcome<()> {
    skip::unless!(ready("journey: bin"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Balls").await?;
    aiko.within("toolbar", "Main tools").press("button", "Remove program").await?;
    aiko.within("dialog", "Remove “Balls”?").press("button", "Remove").await?;
    aiko.find("heading", "What shall the robot do?").await?;
    open_library(&aiko).await?;
    says(&aiko, "There are no programs yet.").await?;
    aiko.press("radio", "Bin").await?;
    says(&aiko, "stays 30 more days").await?;
    aiko.within("dialog", "Load program").press("button", "Restore Balls").await?;
    says(&aiko, "“Balls” is back among the programs.").await?;
    says(&aiko, "The bin is empty.").await?;
    aiko.press("radio", "Programs").await?;
    aiko.within("dialog", "Load program").press("button", "Balls*").await?;
    aiko.find("heading", "Add a sense to begin").await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_program_that_a_namesake_removed_is_told_and_ones_own_is_not() -> Outcome<()> {
    skip::unless!(ready("journey: removed by a namesake"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Balls").await?;
    add_sense(&aiko, "Red ball").await?;
    saved(&aiko).await?;
    let ben = stage.beside(&aiko, "ben").await?;
    called_alike(&ben, &aiko).await?;
    ben.within("toolbar", "Main tools").press("button", "Remove program").await?;
    ben.within("dialog", "Remove “Balls”?").press("button", "Remove").await?;
    says(&ben, "“Balls” is in the bin.").await?;
    says(&aiko, " removed “Balls”. Choose another program.").await?;
    silent(&ben, " removed “Balls”. Choose another program.").await?;
    calm(&aiko)?;
    calm(&ben)
}

#[tokio::test]
async fn links_lead_to_whoever_else_uses_it() -> Outcome<()> {
    skip::unless!(ready("journey: where used"));
    let stage = Stage::set().await?;
    let mut visitor = Visitor::enter(&stage.server).await?;
    make(&mut visitor, "Follow", Some("Track far and close balls")).await?;
    make(&mut visitor, "Follow too", Some("Track far and close balls")).await?;
    make(&mut visitor, "Shine", Some("Distance to brightness")).await?;
    let aiko = stage.person("aiko").await?;
    aiko.press("button", "Shine*").await?;
    aiko.find("button", "Shine").await?;
    aiko.press("button", "Edit helper").await?;
    aiko.press("menuitem", "Distance in m*").await?;
    let dialog = aiko.within("dialog", "Edit helper");
    dialog.find("button", "Follow too").await?;
    dialog.press("button", "Follow").await?;
    aiko.gone("dialog", "Edit helper").await?;
    aiko.find("button", "Follow").await?;

    select(&aiko, "Head tracker").await?;
    says(&aiko, "Other programs with Tracker").await?;
    aiko.press("button", "Follow too").await?;
    aiko.until("document.querySelector('.program-name').textContent.trim() === 'Follow too'", "it is open").await?;
    select(&aiko, "Distance").await?;
    says(&aiko, "What hangs below: 4 streams").await?;

    open_library(&aiko).await?;
    aiko.press("button", "More about Follow").await?;
    says(&aiko, "2 senses and actions in common").await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_file_that_is_dropped_becomes_a_program() -> Outcome<()> {
    skip::unless!(ready("journey: files"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    drop_file(&aiko, include_str!("../behaviours/greeter.json")).await?;
    says(&aiko, "“Greeter” was opened from the file.").await?;
    aiko.find("button", "Greeter").await?;
    drop_file(&aiko, "{ this is no program").await?;
    aiko.until("!!document.querySelector('.notice.bad')", "the page says why not").await?;

    aiko.press("button", "Load program").await?;
    aiko.press("menuitem", "Save as file …").await?;
    let dialog = aiko.within("dialog", "Save as file");
    for kind in ["Program (JSON)*", "Program (XML)*", "Drawing (SVG)*"] {
        dialog.find("link", kind).await?;
    }
    let fetched = aiko
        .eval(
            "Promise.all([...document.querySelectorAll('a[download]')].map(async link => {
                const answer = await fetch(link.href);
                return `${answer.status} ${(await answer.text()).includes('Greeter')}`;
            }))",
        )
        .await?;
    assert_eq!(fetched, serde_json::json!(["200 true", "200 true", "200 true"]));
    aiko.no_errors_but(&["status of 4"])
}

/// Makes a program without a page, as often as the server wants to hear.
pub(crate) async fn make(visitor: &mut Visitor, name: &str, template: Option<&str>) -> Outcome<()> {
    let behaviour = id(&name.to_lowercase().replace(' ', "-"))?;
    loop {
        let (behaviour, template) = (behaviour.clone(), template.map(str::to_owned));
        match visitor.try_to(request::Create { behaviour, name: name.to_owned(), template }).await? {
            Ok(_) => return Ok(()),
            Err(Refused::TooFast) => tokio::time::sleep(Duration::from_millis(50)).await,
            Err(other) => return Err(Trouble(format!("Making {name} was answered with {other:?}."))),
        }
    }
}

/// Opens Load program with everything in it.
pub(crate) async fn open_library(page: &Page) -> Outcome<()> {
    page.press("button", "Load program").await?;
    page.press("menuitem", "All programs and templates …").await?;
    page.find("dialog", "Load program").await.map(drop)
}

/// From the search box through the whole list by keyboard: page after page is fetched on the way.
async fn to_the_end(page: &Page) -> Outcome<()> {
    page.key("ArrowDown").await?;
    page.until(&format!("{ACTIVE} === 1"), "the first line has the keyboard").await?;
    let mut at = 1;
    while at < MANY + 1 {
        let longer = format!("document.querySelector('.program-lines').offsetHeight > {at} * 72");
        page.until(&longer, &format!("there are more lines than {at}")).await?;
        page.key("End").await?;
        let further = page.until(&format!("{ACTIVE} > {at} && {ACTIVE}"), "further down").await;
        match further {
            Ok(now) => at = now.as_u64().and_then(|now| usize::try_from(now).ok()).unwrap_or(at),
            Err(trouble) => return Err(Trouble(format!("{trouble}, after line {at}"))),
        }
    }
    Ok(())
}

/// Drops a file with this text on the page.
async fn drop_file(page: &Page, text: &str) -> Outcome<()> {
    let js = format!(
        "(() => {{
            const dropped = new DataTransfer();
            dropped.items.add(new File([{}], 'program.json'));
            document.body.dispatchEvent(new DragEvent('drop', {{ dataTransfer: dropped, bubbles: true, cancelable: true }}));
        }})()",
        serde_json::Value::from(text)
    );
    page.eval(&js).await.map(drop)
}
