//! A library of thousands of programs: opening it, searching in it and going through it is no more work for the page than
//! with a hundred.

use std::path::Path;
use std::sync::Arc;

use behaviour::{Behaviour, Change, Committed, Id, Record, RecordId, Settings};
use house::{Browser, Outcome, Page, Server};
use store::Store;

use crate::steps::{picture, say};

const FEW: usize = 100;
/// RRP_LIBRARY names another number.
const MANY: usize = 3_000;
/// Programs saved at the same time while filling.
const AT_ONCE: usize = 64;
/// The work with many may be so many times the work with few, and so much more for what does not depend on it.
const WORK_MAX: f64 = 2.0;
const SLACK_MS: f64 = 40.0;
const STEPS: u32 = 20;
const LINES: &str = "document.querySelectorAll('.program-line').length";

/// What the page's main thread worked, in milliseconds.
struct Work {
    opening: f64,
    searching: f64,
    step: f64,
}

async fn fill(folder: &Path, many: usize) -> Outcome<()> {
    let store = store::open_url(&folder.display().to_string()).await.map_err(|error| error.to_string())?;
    let mut tasks = tokio::task::JoinSet::new();
    for number in 0..many {
        if tasks.len() >= AT_ONCE {
            tasks.join_next().await;
        }
        tasks.spawn(keep(Arc::clone(&store), number));
    }
    tasks.join_all().await;
    Ok(())
}

async fn keep(store: Arc<dyn Store>, number: usize) {
    let id = Id::new(&format!("b{number}")).expect("an id");
    let settings = Record::Settings(Settings::named(&format!("Exercise {number:05}")));
    let start = Change { at_ms: number as u64, ..Change::of(id.clone(), "Aiko", "Add") };
    let change = start.put(&Behaviour::default(), RecordId::settings(), settings);
    let mut after = Behaviour::default();
    after.apply(&change);
    store.append(&id, &Committed { revision: 1, change }, &after).await.expect("it is kept");
}

async fn worked(page: &Page, act: impl AsyncFnOnce(&Page) -> Outcome<()>) -> Outcome<f64> {
    let before = page.cpu_ms().await?;
    act(page).await?;
    Ok(page.cpu_ms().await? - before)
}

async fn work_with(many: usize) -> Outcome<Work> {
    let folder = house::folder()?;
    fill(folder.path(), many).await?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    page.size(1440, 900, false).await?;
    page.goto(&server.url()).await?;
    page.until("performance.getEntriesByName('rrp-usable').length > 0", "the page is usable").await?;
    let opening = worked(&page, open).await?;
    picture(&page, &format!("library-{many}")).await?;
    let step = worked(&page, go_through).await? / f64::from(STEPS);
    let searching = worked(&page, search).await?;
    page.no_errors()?;
    Ok(Work { opening, searching, step })
}

async fn open(page: &Page) -> Outcome<()> {
    page.press("button", "Load program").await?;
    page.press("menuitem", "All programs and templates …").await?;
    page.until(&format!("{LINES} > 5"), "the list is there").await.map(drop)
}

async fn go_through(page: &Page) -> Outcome<()> {
    for _ in 0..STEPS {
        page.key("PageDown").await?;
        page.eval("new Promise(done => requestAnimationFrame(() => setTimeout(done)))").await?;
    }
    Ok(())
}

async fn search(page: &Page) -> Outcome<()> {
    let dialog = page.within("dialog", "Load program");
    dialog.fill("searchbox", "Search in names, streams and procedures", "exercise 00077").await?;
    page.until(&format!("{LINES} === 1"), "one program is found").await.map(drop)
}

#[tokio::test]
async fn a_library_of_thousands_is_as_light_as_one_of_a_hundred() -> Outcome<()> {
    house::skip::unless!(ready("hands: a library of thousands"));
    let many = std::env::var("RRP_LIBRARY").ok().and_then(|number| number.parse().ok()).unwrap_or(MANY);
    let (few, all) = (work_with(FEW).await?, work_with(many).await?);
    say(&format!(
        "The list of {FEW} and of {many} programs: opening {:.0} and {:.0} ms of work, a step down {:.1} and {:.1} ms, a \
         search {:.0} and {:.0} ms.",
        few.opening, all.opening, few.step, all.step, few.searching, all.searching
    ));
    let pairs = [(few.opening, all.opening), (few.step, all.step), (few.searching, all.searching)];
    for (few, all) in pairs {
        assert!(all < few * WORK_MAX + SLACK_MS, "{all:.1} ms of work with {many} programs, {few:.1} ms with {FEW}");
    }
    Ok(())
}
