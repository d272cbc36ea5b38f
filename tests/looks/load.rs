//! The first load: small, few requests, nothing from elsewhere, soon usable. What is fetched after it counts apart, and
//! is bounded too.

use crate::screens::usable;
use house::{Browser, Outcome, Page, Server, skip};
use std::io::Write;

/// All that is fetched from opening the page until well after it is usable, but the second piece of its code.
const BYTES_MAX: u64 = 700_000;
const REQUESTS_MAX: u64 = 8;
/// The second piece of the page's code, which nobody waits for, with what it has in common with the operator's page. A ratchet.
const LATER_BYTES_MAX: u64 = 721_500;
/// The files of that: its own, what it has in common with one of the two other pieces, and with both.
const LATER_FILES_MAX: u64 = 4;
/// The words of the second language, which only those fetch who chose it.
const WORDS_BYTES_MAX: u64 = 50_000;

/// Whether the page's code came compressed, as people get it; `cargo xtask page --dev` leaves that out.
const COMPRESSED: &str = "(() => {
    const code = performance.getEntriesByType('resource').find(entry => entry.name.endsWith('app_bg.wasm'));
    return code.encodedBodySize < code.decodedBodySize;
})()";

/// The operator's page, opened directly, may be so much more than the first load: its code, what that has in common with the
/// second piece, and its sheet. A ratchet; the aim is 60,000. The folder of the checkout alone moves it by 1,000.
const OPERATE_BYTES_MAX: u64 = 122_500;

/// Looking back may fetch so much more than the page with the graph has already: its code, and what that has in common with
/// the operator's page. A ratchet.
const PAST_BYTES_MAX: u64 = 180_000;

/// The number of files that were fetched, and the frames without another one after which none is expected.
const FETCHED: &str = "performance.getEntriesByType('resource').length";
const QUIET_FRAMES: u32 = 120;

/// The names of the pieces of the page's code that are here.
const PIECES: &str = "performance.getEntriesByType('resource').map(entry => new URL(entry.name).pathname)\
    .filter(path => /\\/(past|common|later)-/.test(path))";

/// The second piece of the page's code, with what it has in common with others, once it is here: how many files, how many bytes, and how long after the page was
/// usable the first of them was asked for.
const LATER: &str = "(() => {
    const all = performance.getEntriesByType('resource');
    const files = all.filter(entry => /\\/(later|common)-/.test(entry.name));
    const usable = performance.getEntriesByName('rrp-usable')[0].startTime;
    const bytes = files.reduce((bytes, file) => bytes + file.encodedBodySize, 0);
    const own = files.some(file => file.name.includes('/later-') && file.encodedBodySize > 0);
    return own && { files: files.length, bytes, after: Math.min(...files.map(file => file.startTime)) - usable };
})()";

/// The words of another language: how many bytes, and how long before they were here the page's code was asked for.
const WORDS: &str = "(() => {
    const named = end => performance.getEntriesByType('resource').find(entry => entry.name.endsWith(end));
    const [words, code] = [named('/ja.txt'), named('app_bg.wasm')];
    return words && { bytes: words.encodedBodySize, before: words.responseEnd - code.startTime };
})()";

/// What was fetched, apart: until the page was usable and right after it, and the second piece of its code.
struct Load {
    requests: u64,
    bytes: u64,
    later_bytes: u64,
    /// Whether it is what people get.
    real: bool,
}

#[tokio::test]
async fn the_first_load_is_small() -> Outcome<()> {
    skip::unless!(ready("the first load"));
    let folder = house::folder()?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    let load = load(&page, &server, "First load").await?;
    assert!(load.requests <= REQUESTS_MAX, "{} requests, {REQUESTS_MAX} are the most", load.requests);
    assert!(!load.real || load.bytes <= BYTES_MAX, "{} bytes, {BYTES_MAX} are the most", load.bytes);
    assert!(
        !load.real || load.later_bytes <= LATER_BYTES_MAX,
        "{} bytes come later, {LATER_BYTES_MAX} are the most",
        load.later_bytes
    );
    assert!(page.eval(WORDS).await?.is_null(), "no other language is fetched");
    page.no_errors()
}

#[tokio::test]
async fn another_language_is_one_small_file_that_holds_nothing_up() -> Outcome<()> {
    skip::unless!(ready("the first load in Japanese"));
    let folder = house::folder()?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    page.speaks("ja").await?;
    let load = load(&page, &server, "First load in Japanese").await?;
    let words = page.eval(WORDS).await?;
    let words_bytes = words["bytes"].as_u64().ok_or("the words were not fetched")?;
    writeln!(std::io::stderr(), "The words of it are {words_bytes} bytes of that.")?;
    assert!(load.requests <= REQUESTS_MAX, "{} requests, {REQUESTS_MAX} are the most", load.requests);
    assert!(!load.real || words_bytes <= WORDS_BYTES_MAX, "{words_bytes} bytes of words");
    let others = load.bytes.saturating_sub(words_bytes);
    assert!(!load.real || others <= BYTES_MAX, "{others} bytes without the words, {BYTES_MAX} are the most");
    assert!(words["before"].as_f64().is_some_and(|ms| ms > 0.0), "the code waits for the words");
    page.no_errors()
}

#[tokio::test]
async fn the_operators_page_needs_little_more_and_nothing_of_the_second_piece() -> Outcome<()> {
    skip::unless!(ready("the load of the operator's page"));
    let folder = house::folder()?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    page.size(1180, 820, true).await?;
    page.goto(&format!("{}operate", server.url())).await?;
    usable(&page).await?;
    page.until("document.querySelector('.op:not(.op-bare)')", "the operator's page is there").await?;
    // What else follows the first screen counts as well.
    page.steady(FETCHED, QUIET_FRAMES, "nothing more is fetched").await?;
    let traffic = page.network();
    let later =
        page.eval("performance.getEntriesByType('resource').some(entry => entry.name.includes('/later-'))").await?;
    assert_eq!(later, false, "the second piece is for the page with the graph");
    let compressed = page.eval(COMPRESSED).await? == true;
    writeln!(std::io::stderr(), "The operator's page: {} requests, {} bytes", traffic.requests, traffic.bytes)?;
    assert!(traffic.external.is_empty(), "requests to elsewhere: {:?}", traffic.external);
    let real = compressed || std::env::var_os("RRP_TOOLS_READY").is_some();
    let most = BYTES_MAX + OPERATE_BYTES_MAX;
    assert!(!real || traffic.bytes <= most, "{} bytes, {most} are the most", traffic.bytes);
    page.no_errors()
}

#[tokio::test]
async fn looking_back_fetches_little_more_than_the_page_has() -> Outcome<()> {
    skip::unless!(ready("the load of the panel that looks back"));
    let folder = house::folder()?;
    house::keep_session(folder.path())?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    let before = load(&page, &server, "Before looking back").await?;
    let there = page.eval(PIECES).await?;
    page.goto(&format!("{}?past={}", server.url(), house::SESSION)).await?;
    usable(&page).await?;
    page.until("document.querySelector('.past-label')", "the lanes are there").await?;
    page.until(LATER, "what is fetched after the first load is here").await?;
    let more = format!(
        "(() => {{ const there = {there};
            return performance.getEntriesByType('resource').filter(one => /\\/(past|common|later)-/.test(one.name))
                .filter(one => !there.includes(new URL(one.name).pathname))
                .reduce((bytes, one) => bytes + one.encodedBodySize, 0); }})()"
    );
    let bytes = page.eval(&more).await?.as_u64().unwrap_or(u64::MAX);
    writeln!(std::io::stderr(), "Looking back: {bytes} bytes more")?;
    assert!(bytes > 0, "the panel is a piece of its own");
    assert!(!before.real || bytes <= PAST_BYTES_MAX, "{bytes} bytes, {PAST_BYTES_MAX} are the most");
    page.no_errors()
}

/// Opens the page in an empty browser, waits for all of it, and says what it took.
async fn load(page: &Page, server: &Server, what: &str) -> Outcome<Load> {
    page.size(1440, 900, false).await?;
    page.goto(&server.url()).await?;
    usable(page).await?;
    let usable_ms = page.eval("performance.getEntriesByName('rrp-usable')[0].startTime").await?;
    let usable_ms = usable_ms.as_f64().unwrap_or(f64::INFINITY);
    page.until(LATER, "what is fetched after the first load is here").await?;
    // What else follows the first screen counts as well.
    page.steady(FETCHED, QUIET_FRAMES, "nothing more is fetched").await?;
    let traffic = page.network();
    let later = page.eval(LATER).await?;
    let (later_files, later_bytes) = (later["files"].as_u64().unwrap_or(0), later["bytes"].as_u64().unwrap_or(0));
    let compressed = page.eval(COMPRESSED).await? == true;
    let kind = if compressed { "" } else { " (a quick build, not compressed)" };
    let (requests, bytes) = (traffic.requests - later_files, traffic.bytes - later_bytes);
    writeln!(
        std::io::stderr(),
        "{what}{kind}: {requests} requests, {bytes} bytes, usable after {usable_ms:.0} ms; \
         later: {later_files} more, {later_bytes} bytes; together {} requests, {} bytes",
        traffic.requests,
        traffic.bytes
    )?;
    assert!(traffic.external.is_empty(), "requests to elsewhere: {:?}", traffic.external);
    assert!(
        (1..=LATER_FILES_MAX).contains(&later_files),
        "{later_files} files come later: one, and what it has in common with the other pieces"
    );
    let past = page.eval("performance.getEntriesByType('resource').some(one => one.name.includes('/past'))").await?;
    assert_eq!(past, false, "the panel that looks back is fetched once somebody does");
    assert!(
        later["after"].as_f64().is_some_and(|ms| ms >= 0.0),
        "nothing of it is asked for before the page is usable"
    );
    let real = compressed || std::env::var_os("RRP_TOOLS_READY").is_some();
    Ok(Load { requests, bytes, later_bytes, real })
}
