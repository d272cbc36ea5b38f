//! The recordings as a page and the report of one: on a desktop, a tablet and a phone, in both languages, on paper; by keys and
//! by finger.

use crate::axe::check_by;
use crate::look::{DESKTOP, PHONE, TABLET, Window};
use crate::rules::list;
use crate::targets::small;
use house::{Browser, Outcome, Page, Rules, Server, skip};
use serde_json::json;
use std::path::Path;

const RECORDING: &str = include_str!("../../crates/report/tests/data/greet.jsonl");
const MARKS: &str = include_str!("../../crates/report/tests/data/greet.marks.jsonl");
const GREET: &str = "2026-11-21T18-34-06Z-greet.jsonl";

/// The page, if it would have to scroll sideways.
const SIDEWAYS: &str = "(document.documentElement.scrollWidth > innerWidth ? [`${document.documentElement.scrollWidth} wide in ${innerWidth}`] : [])";

/// True if every sheet that something is written on is dark.
const IS_DARK: &str = "['html', 'main', 'input', '.button'].every(part => {
    const element = document.querySelector(part);
    const [red, green, blue] = (element ? getComputedStyle(element).backgroundColor : '').match(/[0-9]+/g).map(Number);
    return red + green + blue < 3 * 128;
})";

/// A data folder with several sessions of one participant.
fn prepare(data: &Path) -> Outcome<()> {
    let folder = data.join("recordings");
    std::fs::create_dir_all(&folder)?;
    for day in ["03", "07", "12", "21"] {
        let name = GREET.replace("11-21", &format!("11-{day}"));
        std::fs::write(folder.join(&name), RECORDING.replace("11-21T", &format!("11-{day}T")))?;
        std::fs::write(folder.join(name.replace(".jsonl", ".marks.jsonl")), MARKS)?;
    }
    Ok(())
}

async fn fits(page: &Page, window: &Window, place: &str) -> Outcome<Vec<String>> {
    let (name, width, height, touch) = window;
    page.size(*width, *height, *touch).await?;
    page.until(
        &format!("innerWidth === {width} && matchMedia('(pointer: coarse)').matches === {touch}"),
        "the window is as large",
    )
    .await?;
    let place = format!("{place}-{name}");
    page.screenshot(&house::target().join(format!("looks/{place}.png"))).await?;
    let mut found = check_by(page, Rules::All, &place).await?;
    found.extend(small(page, *touch, &place).await?);
    found.extend(list(page, SIDEWAYS, &place).await?);
    Ok(found)
}

#[tokio::test]
async fn recordings_and_reports_fit_every_window_in_both_languages() -> Outcome<()> {
    skip::unless!(ready("recordings and reports"));
    let folder = house::folder()?;
    prepare(folder.path())?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    std::fs::create_dir_all(house::target().join("looks"))?;
    let mut found = Vec::new();
    for language in ["en", "ja"] {
        for (place, path) in [
            ("recordings", format!("recordings?language={language}&offset=0&chosen={GREET}")),
            ("report", format!("recordings/{GREET}/report?language={language}&offset=0")),
        ] {
            page.media("prefers-color-scheme", "light").await?;
            page.goto(&format!("{}{path}", server.url())).await?;
            for window in [DESKTOP, TABLET, PHONE] {
                found.extend(fits(&page, &window, &format!("{place}-{language}")).await?);
            }
            // A report is paper; the list is dark where the page is.
            page.media("prefers-color-scheme", "dark").await?;
            let is_dark = page.eval(IS_DARK).await? == true;
            assert_eq!(is_dark, place == "recordings", "{place} in the dark");
            if is_dark {
                found.extend(fits(&page, &DESKTOP, &format!("{place}-{language}-dark")).await?);
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
    page.no_errors()
}

/// The sheets of paper that a page takes.
async fn sheets(page: &Page) -> Outcome<u64> {
    let printed = page.call("Page.printToPDF", json!({ "preferCSSPageSize": true, "printBackground": false })).await?;
    let bytes = page.eval(&format!("atob({}).match(/\\/Type \\/Page[^s]/g).length", printed["data"])).await?;
    Ok(bytes.as_u64().unwrap_or(0))
}

#[tokio::test]
async fn a_report_is_printed_whole_and_without_its_links() -> Outcome<()> {
    skip::unless!(ready("a report on paper"));
    let folder = house::folder()?;
    prepare(folder.path())?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    // The script adds the zone of the reader.
    page.goto(&format!("{}recordings/{GREET}/report", server.url())).await?;
    page.until("new URLSearchParams(location.search).has('offset')", "the zone is known").await?;
    page.until("document.getElementById('print') && !document.getElementById('print').hidden", "it can be printed")
        .await?;
    let sheets = sheets(&page).await?;
    assert!((1..=2).contains(&sheets), "{sheets} sheets");
    // As wide as A4 between its margins.
    page.size(688, 1_000, false).await?;
    page.paper(true).await?;
    page.until("document.querySelector('nav').getClientRects().length === 0", "no links are printed").await?;
    let whole = "[...document.querySelectorAll('section, figure, tr')].every(part => getComputedStyle(part).breakInside === 'avoid')";
    assert_eq!(page.eval(whole).await?, true, "nothing is broken over sheets");
    let drawn = "[...document.querySelectorAll('svg.timeline path, svg.timeline circle')].filter(shape => { const box = shape.getBBox(); \
        return box.width + box.height > 0; }).length >= 10 && document.querySelectorAll('svg rect.bar').length === 4";
    assert_eq!(page.eval(drawn).await?, true, "the timeline and the sessions are drawn");
    page.screenshot(&house::target().join("looks/report-paper.png")).await?;
    page.paper(false).await?;
    page.no_errors()
}

#[tokio::test]
async fn a_recording_is_found_named_and_binned_by_keys_and_brought_back_by_finger() -> Outcome<()> {
    skip::unless!(ready("recordings by keys and finger"));
    let folder = house::folder()?;
    prepare(folder.path())?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    page.goto(&format!("{}recordings?language=en&offset=0", server.url())).await?;
    page.eval("document.querySelector('input[name=find]').focus()").await?;
    page.type_text("12 november").await?;
    page.key("Enter").await?;
    page.until("document.querySelectorAll('tbody tr').length === 1", "one is found").await?;
    page.eval("document.querySelector('tbody a').focus()").await?;
    page.key("Enter").await?;
    page.until("document.querySelector('aside')?.innerText.includes('12 November 2026')", "it is looked at").await?;
    page.eval("document.querySelector('input[name=title]').focus()").await?;
    page.type_text("The third").await?;
    page.key("Enter").await?;
    page.until("document.querySelector('tbody .this b, tbody b')?.innerText === 'The third'", "it has its name")
        .await?;
    page.eval("[...document.querySelectorAll('aside button')].find(one => one.innerText === 'To the bin').focus()")
        .await?;
    page.key("Enter").await?;
    page.until("document.querySelectorAll('tbody tr').length === 3 && document.querySelector('.foot').innerText.includes('Bin · 1')", "it is in the bin").await?;
    let (_, width, height, _) = PHONE;
    page.size(width, height, true).await?;
    page.eval("document.querySelector('.foot').scrollIntoView()").await?;
    page.tap("link", "Bin · 1").await?;
    page.until("document.querySelector('h1').innerText === 'Bin'", "the bin is open").await?;
    page.tap("link", "C-07 12 November 2026 18:34:06").await?;
    page.until("document.querySelector('aside') !== null", "it is looked at").await?;
    page.tap("button", "Bring it back").await?;
    page.until(
        "document.querySelector('h1').innerText === 'Bin' && document.querySelectorAll('tbody tr').length === 0",
        "it is back",
    )
    .await?;
    page.tap("link", "Back to the recordings").await?;
    page.until("document.querySelectorAll('tbody tr').length === 4", "it is in the list").await?;
    page.no_errors()
}
