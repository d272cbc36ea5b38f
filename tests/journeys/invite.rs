//! Letting others in from the page: a link for somebody, what they may do with it, who came, and their end; and taking over
//! what somebody is editing.

use house::{Outcome, Page, skip};
use serde_json::json;

use crate::steps::*;
use crate::together::{add_map, call_myself};

/// A server that others reach too, and Aiko at its computer with a program that has a map.
async fn open_house() -> Outcome<(Stage, Page)> {
    let stage = Stage::set_with(house::folder()?, &["--listen", "0.0.0.0:0"]).await?;
    let aiko = stage.person("aiko").await?;
    add_map(&aiko).await?;
    call_myself(&aiko, "Aiko").await?;
    Ok((stage, aiko))
}

/// Makes an invitation in the dialog, which stays open; answers with its link.
pub(crate) async fn invite(page: &Page, may: &str, lasts: &str, whom: &str) -> Outcome<String> {
    page.within("toolbar", "Main tools").press("button", "Invite").await?;
    let dialog = page.within("dialog", "Invite somebody");
    dialog.press("radio", may).await?;
    dialog.press("radio", lasts).await?;
    dialog.fill("textbox", "For whom", whom).await?;
    dialog.press("button", "Make a link").await?;
    dialog.text("textbox", "Link").await
}

/// Somebody at another computer who opens the link. Their browser knows the certificate, so to speak.
pub(crate) async fn follow(stage: &Stage, name: &str, link: &str) -> Outcome<Page> {
    let page = stage.nobody(name).await?;
    page.call("Security.setIgnoreCertificateErrors", json!({ "ignore": true })).await?;
    page.goto(link).await?;
    Ok(page)
}

/// Ends the invitation for Ben, in the dialog that is open.
async fn revoke_ben(aiko: &Page) -> Outcome<()> {
    aiko.press("button", "Revoke: Ben").await?;
    aiko.within("group", "Revoke: Ben").press("button", "Revoke").await
}

/// Somebody who opens the link, comes in, and opens what Aiko has open.
async fn join(stage: &Stage, name: &str, link: &str, aiko: &Page) -> Outcome<Page> {
    let page = follow(stage, name, link).await?;
    says(&page, "Aiko invites you to").await?;
    page.press("button", "Come in").await?;
    usable(&page).await?;
    // An operator lands on the operator's page; these look at the graph.
    if page.eval("location.pathname").await? == protocol::OPERATE_PATH {
        let origin = page.eval("location.origin").await?;
        page.goto(&format!("{}/?graph", origin.as_str().unwrap_or_default())).await?;
        usable(&page).await?;
    }
    let hash = aiko.eval("location.hash").await?;
    page.eval(&format!("location.hash = {hash}; 0")).await?;
    page.find("button", "Red ball, sensor stream").await?;
    Ok(page)
}

/// Waits until a button can be pressed, or cannot.
async fn can_press(page: &Page, button: &str, can: bool) -> Outcome<()> {
    let js = format!(
        "function () {{ return (this.matches(':disabled') || this.getAttribute('aria-disabled') === 'true') !== {can}; }}"
    );
    let what = format!("“{button}” can{} be pressed", if can { "" } else { "not" });
    page.until_on("button", button, &js, &what).await.map(drop)
}

/// Opens the editor of the map.
async fn open_map(page: &Page, how: &str) -> Outcome<()> {
    page.press("button", "map (1), connector*").await?;
    next(page, "map", how).await?;
    page.find("dialog", "Operation").await.map(drop)
}

/// Waits until one may only read in the open editor, or may write.
async fn may_write(page: &Page, may: bool) -> Outcome<()> {
    let js = format!("document.querySelector('.dialog textarea')?.matches(':disabled') === {}", !may);
    page.until(&js, if may { "one may write" } else { "one may only read" }).await.map(drop)
}

/// As `calm`; before somebody was in, the browser asked for the sign of the site, which is for those who are.
fn calm_but_uninvited(page: &Page) -> Outcome<()> {
    page.no_errors_but(&["favicon.ico"])
}

#[tokio::test]
async fn a_viewer_comes_by_a_link_looks_and_is_out_when_it_is_revoked() -> Outcome<()> {
    skip::unless!(ready("journey: a viewer"));
    let (stage, aiko) = open_house().await?;
    let link = invite(&aiko, "look", "until you revoke it", "Ben, tablet").await?;
    assert!(link.starts_with("https://") && link.contains("/come-in#"), "{link}");
    aiko.find("image", "The link as a QR code*").await?;
    says(&aiko, "SHA-256 fingerprint:").await?;
    let steps = [
        ("iPad, iPhone", "visit this website"),
        ("Android", "Proceed to"),
        ("Windows", "Continue to"),
        ("Mac", "In Safari"),
    ];
    for (device, step) in steps {
        aiko.press("radio", device).await?;
        says(&aiko, step).await?;
    }
    aiko.press("button", "Copy the link with these steps").await?;
    says(&aiko, "Copied").await?;
    says(&aiko, "Nobody came yet").await?;
    let ben = join(&stage, "ben", &link, &aiko).await?;
    assert!(!ben.address().await?.contains(link.rsplit('#').next().unwrap_or("#")), "the token left the address bar");
    says(&aiko, "here now").await?;

    says(&ben, "You may look. Ask the person who invited you for more.").await?;
    for button in ["Add a program", "Add a helper", "Add Red ball", "Start", "Tidy"] {
        can_press(&ben, button, false).await?;
    }
    ben.gone("button", "Invite").await?;
    open_map(&ben, "Look at it").await?;
    may_write(&ben, false).await?;
    can_press(&ben, "Save", false).await?;
    ben.key("Escape").await?;
    ben.gone("dialog", "Operation").await?;
    // The keyboard gets nobody further.
    ben.press("button", "Red ball, sensor stream").await?;
    ben.key("Delete").await?;
    says(&ben, "Only an editor may do this.").await?;
    ben.find("button", "Red ball, sensor stream").await?;
    stop(&ben).await?;

    aiko.press("button", "Revoke: Ben, tablet").await?;
    says(&aiko, "The person who is here by it is out at once.").await?;
    aiko.within("group", "Revoke: Ben, tablet").press("button", "Revoke").await?;
    says(&ben, "Your invitation has ended").await?;
    ben.find("button", "Stop").await?;
    says(&aiko, "Revoked").await?;
    aiko.gone("button", "Revoke: Ben, tablet").await?;
    aiko.find("button", "map (1), connector*").await?;
    ben.reload().await?;
    says(&ben, "By invitation only").await?;
    calm(&aiko)
}

#[tokio::test]
async fn an_operator_starts_and_stops_and_edits_nothing() -> Outcome<()> {
    skip::unless!(ready("journey: an operator"));
    let (stage, aiko) = open_house().await?;
    let link = invite(&aiko, "start and stop", "for a day", "").await?;
    let ben = join(&stage, "ben", &link, &aiko).await?;
    says(&ben, "You may start and stop, not edit.").await?;
    for button in ["Add a program", "Add Red ball", "Tidy"] {
        can_press(&ben, button, false).await?;
    }
    for button in ["Start", "Touch head"] {
        can_press(&ben, button, true).await?;
    }
    start(&ben).await?;
    stop(&ben).await?;
    at_rest(&ben).await?;
    calm_but_uninvited(&ben)?;
    calm(&aiko)
}

/// The gallery of who may not make programs is that of what they may run.
#[tokio::test]
async fn an_operator_lands_where_programs_are_opened_and_what_runs_stands_first() -> Outcome<()> {
    skip::unless!(ready("journey: an operator lands"));
    let (stage, aiko) = open_house().await?;
    let link = invite(&aiko, "start and stop", "for a day", "Ben").await?;
    aiko.key("Escape").await?;
    let page = follow(&stage, "ben", &link).await?;
    says(&page, "Aiko invites you to run a robot. You start and stop programs; you do not edit them.").await?;
    page.press("button", "Come in").await?;
    usable(&page).await?;
    // An operator lands on the operator's page; this looks at the other one.
    page.until(&format!("location.pathname === '{}'", protocol::OPERATE_PATH), "the operator's page is there").await?;
    let origin = page.eval("location.origin").await?;
    page.goto(&format!("{}/?graph", origin.as_str().unwrap_or_default())).await?;
    usable(&page).await?;
    says(&page, "Which program shall run?").await?;
    for words in ["Templates", "Start with an empty program", "What shall the robot do?"] {
        silent(&page, words).await?;
    }
    start(&aiko).await?;
    says(&page, "runs now").await?;
    page.eval("document.querySelector('.gallery button').click(), 0").await?;
    page.find("button", "Red ball, sensor stream").await?;
    stop(&page).await?;
    at_rest(&aiko).await?;
    page.goto(&link).await?;
    says(&page, "Aiko invites you to").await?;
    aiko.press("button", "Invite").await?;
    revoke_ben(&aiko).await?;
    let other = follow(&stage, "chika", &link).await?;
    says(&other, "This link does not work, or not any more. Ask for another invitation.").await?;
    other.gone("button", "Come in").await
}

#[tokio::test]
async fn who_stopped_is_said_and_what_a_revoked_person_started_can_be_stopped() -> Outcome<()> {
    skip::unless!(ready("journey: who stopped, who started"));
    let (stage, aiko) = open_house().await?;
    let link = invite(&aiko, "start and stop", "until you revoke it", "Ben").await?;
    let ben = join(&stage, "ben", &link, &aiko).await?;
    ben.within("form", "Your name").fill("textbox", "Others see you as", "Ben").await?;
    ben.within("form", "Your name").press("button", "Save").await?;
    says(&aiko, "Ben, here now").await?;
    start(&ben).await?;
    stop(&ben).await?;
    says(&aiko, "Ben pressed Stop. Start runs it again.").await?;

    start(&ben).await?;
    revoke_ben(&aiko).await?;
    says(&ben, "Your invitation has ended").await?;
    aiko.key("Escape").await?;
    aiko.gone("dialog", "Invite somebody").await?;
    says(&aiko, "Ben started this and may not be here any more.").await?;
    aiko.press("button", "Stop it").await?;
    at_rest(&aiko).await?;
    calm(&aiko)
}

#[tokio::test]
async fn an_editor_who_says_a_name_is_listed_by_it() -> Outcome<()> {
    skip::unless!(ready("journey: an invited editor"));
    let (stage, aiko) = open_house().await?;
    let link = invite(&aiko, "edit", "once", "Yuki").await?;
    let yuki = join(&stage, "yuki", &link, &aiko).await?;
    yuki.within("form", "Your name").fill("textbox", "Others see you as", "Yuki").await?;
    yuki.within("form", "Your name").press("button", "Save").await?;
    says(&aiko, "Yuki, here now").await?;
    add_sense(&yuki, "Head touch").await?;
    aiko.find("button", "Head touch, anywhere, sensor stream").await?;
    yuki.gone("button", "Invite").await?;
    calm_but_uninvited(&yuki)?;
    calm(&aiko)
}

#[tokio::test]
async fn where_nobody_else_reaches_the_server_the_dialog_says_how_they_would() -> Outcome<()> {
    skip::unless!(ready("journey: inviting on loopback"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    aiko.within("toolbar", "Main tools").press("button", "Invite").await?;
    says(&aiko, "Only this computer reaches this server").await?;
    says(&aiko, "rrp serve --listen 0.0.0.0:7130").await?;
    aiko.gone("button", "Make a link").await?;
    calm(&aiko)
}

#[tokio::test]
async fn the_person_at_the_servers_computer_takes_over_what_somebody_is_editing() -> Outcome<()> {
    skip::unless!(ready("journey: taking over"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_map(&aiko).await?;
    call_myself(&aiko, "Aiko").await?;
    let ben = stage.beside(&aiko, "ben").await?;
    call_myself(&ben, "Ben").await?;
    open_map(&ben, "More…").await?;
    may_write(&ben, true).await?;
    ben.within("dialog", "Operation").fill("textbox", "Procedure", "2 + 2").await?;
    open_map(&aiko, "More…").await?;
    may_write(&aiko, false).await?;
    aiko.press("button", "Take over").await?;
    says(&aiko, "Ben cannot save it then").await?;
    aiko.press("button", "Leave it").await?;
    may_write(&aiko, false).await?;
    aiko.press("button", "Take over").await?;
    aiko.press("button", "Take it over").await?;
    may_write(&aiko, true).await?;
    may_write(&ben, false).await?;
    says(&ben, "Aiko is editing").await?;
    assert_eq!(ben.within("dialog", "Operation").text("textbox", "Procedure").await?, "2 + 2", "what Ben wrote stays");
    calm(&ben)?;
    calm(&aiko)
}
