//! The first load: small, few requests, nothing from elsewhere, soon usable.

use crate::screens::usable;
use house::{Browser, Outcome, Server, skip};
use std::io::Write;

const BYTES_MAX: u64 = 700_000;
const REQUESTS_MAX: u64 = 8;

/// Whether the page's code came compressed, as people get it; `cargo xtask page --dev` leaves that out.
const COMPRESSED: &str = "(() => {
    const code = performance.getEntriesByType('resource').find(entry => entry.name.endsWith('app_bg.wasm'));
    return code.encodedBodySize < code.decodedBodySize;
})()";

#[tokio::test]
async fn the_first_load_is_small() -> Outcome<()> {
    if !skip::ready("the first load") {
        return Ok(());
    }
    let folder = house::folder()?;
    let server = Server::start(folder.path()).await?;
    let browser = Browser::launch().await?;
    let page = browser.person("aiko").await?;
    page.size(1440, 900, false).await?;
    page.goto(&server.url()).await?;
    usable(&page).await?;
    let usable_ms = page.eval("performance.getEntriesByName('rrp-usable')[0].startTime").await?;
    let usable_ms = usable_ms.as_f64().unwrap_or(f64::INFINITY);
    // What follows the first screen counts as well.
    tokio::time::sleep(std::time::Duration::from_secs(3)).await;
    let traffic = page.network();
    let compressed = page.eval(COMPRESSED).await? == true;
    let kind = if compressed { "" } else { " (a quick build, not compressed)" };
    let (requests, bytes) = (traffic.requests, traffic.bytes);
    writeln!(
        std::io::stderr(),
        "First load{kind}: {requests} requests, {bytes} bytes, usable after {usable_ms:.0} ms"
    )?;
    assert!(traffic.external.is_empty(), "requests to elsewhere: {:?}", traffic.external);
    assert!(requests <= REQUESTS_MAX, "{requests} requests, {REQUESTS_MAX} are the most");
    let given_to_people = compressed || std::env::var_os("RRP_TOOLS_READY").is_some();
    assert!(!given_to_people || bytes <= BYTES_MAX, "{bytes} bytes, {BYTES_MAX} are the most");
    page.no_errors()
}
