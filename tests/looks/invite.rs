//! How it looks to let others in, to be one who may only look, and to be out.

use crate::look::{colours, look};
use crate::screens::{Stage, nothing, run_template, usable};
use crate::words::Words;
use house::{Browser, Outcome, Page, Server, skip};
use serde_json::json;

#[tokio::test]
async fn axe_finds_nothing_about_inviting_and_who_may_only_look() -> Outcome<()> {
    skip::unless!(ready("axe on inviting"));
    let folder = house::folder()?;
    let server = Server::start_with(folder.path(), &["--listen", "0.0.0.0:0"]).await?;
    let browser = Browser::launch().await?;
    let aiko = browser.person("aiko").await?;
    aiko.size(1440, 900, false).await?;
    aiko.goto(&server.url()).await?;
    usable(&aiko).await?;
    run_template(&aiko, &Words::english()).await?;
    let mut found = Vec::new();
    aiko.press("button", "Invite").await?;
    let dialog = aiko.within("dialog", "Invite somebody");
    dialog.press("radio", "look").await?;
    dialog.fill("textbox", "For whom", "Ben, tablet").await?;
    found.extend(look(&aiko, "inviting").await?);
    dialog.press("button", "Make a link").await?;
    let link = dialog.text("textbox", "Link").await?;
    let ben = join(&browser, &link, &aiko, &mut found).await?;
    aiko.until("document.body.innerText.includes('here now')", "Ben is there").await?;
    found.extend(look(&aiko, "invited").await?);

    ben.press("button", "filter (distance < 0.5), connector*").await?;
    found.extend(look(&ben, "may-look").await?);
    ben.within("toolbar", "Next steps for filter").press("button", "Look at it").await?;
    ben.find("dialog", "Operation").await?;
    found.extend(look(&ben, "reads").await?);

    aiko.press("button", "Revoke: Ben, tablet").await?;
    aiko.find("button", "Keep it").await?;
    found.extend(look(&aiko, "revoking").await?);
    aiko.within("group", "Revoke: Ben, tablet").press("button", "Revoke").await?;
    ben.until("document.body.innerText.includes('Your invitation has ended')", "Ben is out").await?;
    found.extend(look(&ben, "out").await?);
    nothing("findings about inviting", &found)
}

#[tokio::test]
async fn axe_finds_nothing_where_nobody_else_reaches_the_server() -> Outcome<()> {
    skip::unless!(ready("axe on inviting nobody"));
    let stage = Stage::set().await?;
    stage.page.press("button", "Invite").await?;
    stage.page.find("dialog", "Invite somebody").await?;
    stage.page.until("document.body.innerText.includes('rrp serve --listen')", "it says how").await?;
    nothing("findings about inviting nobody", &look(&stage.page, "invite-alone").await?)
}

/// Somebody who comes by a link and opens what is open, looking at what they meet on the way.
async fn join(browser: &Browser, link: &str, aiko: &Page, found: &mut Vec<String>) -> Outcome<Page> {
    let page = browser.person("ben").await?;
    page.size(1440, 900, false).await?;
    page.call("Security.setIgnoreCertificateErrors", json!({ "ignore": true })).await?;
    page.goto(link).await?;
    page.until("document.body.innerText.includes('invites you to watch')", "who invites").await?;
    // Who is not in yet has no Stop, which the other rules ask for.
    found.extend(colours(&page, "come-in").await?);
    page.theme(false).await?;
    page.press("button", "Come in").await?;
    usable(&page).await?;
    page.until("document.body.innerText.includes('What do you want to watch?')", "what there is to watch").await?;
    found.extend(look(&page, "lands").await?);
    let hash = aiko.eval("location.hash").await?;
    page.eval(&format!("location.hash = {hash}; 0")).await?;
    page.find("button", "Distance, *").await?;
    Ok(page)
}
