//! The robot that people mean: another body at its address is a question, a new address is given, one body is one robot, and
//! two with the same name are told apart.

use house::{Outcome, Page, StandIn, skip};

use crate::steps::*;

/// Adds a robot by its address and name.
pub(crate) async fn add(page: &Page, address: &str, name: &str) -> Outcome<()> {
    page.press("button", "Robot: *").await?;
    page.press("menuitem", "Add a NAO or Pepper").await?;
    let dialog = page.within("dialog", "Add a NAO or Pepper");
    dialog.fill("textbox", "Address", address).await?;
    dialog.fill("textbox", "Name", name).await?;
    dialog.press("button", "Add").await
}

fn port(robot: &StandIn) -> String {
    robot.address().rsplit(':').next().unwrap_or_default().to_owned()
}

/// Keeps pictures of this moment in `target/looks`, for who looks.
pub(crate) async fn keep(page: &Page, name: &str) -> Outcome<()> {
    if std::env::var("CI").as_deref() == Ok("true") {
        return Ok(());
    }
    for (width, height, mobile, size) in [(1440, 900, false, "desktop"), (390, 844, true, "phone")] {
        for (dark, theme) in [(false, "light"), (true, "dark")] {
            page.size(width, height, mobile).await?;
            page.theme(dark).await?;
            page.frames().await?;
            page.screenshot(&house::target().join(format!("looks/{name}-{size}-{theme}.png"))).await?;
        }
    }
    page.theme(false).await?;
    page.size(1440, 900, false).await
}

#[tokio::test]
async fn another_body_at_its_address_is_a_question() -> Outcome<()> {
    skip::unless!(ready("journey: another body"));
    let Some(momo) = StandIn::start("journey: another body", &["--name", "Momo", "--serial", "ALDR1312N090344"])?
    else {
        return Ok(());
    };
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Ours").await?;
    add_sense(&aiko, "Red ball").await?;
    next(&aiko, "Red ball", "Tracker").await?;
    saved(&aiko).await?;
    add(&aiko, momo.address(), "Blue").await?;
    aiko.find("button", "Robot: Blue").await?;
    says(&aiko, "on “Blue”").await?;
    let port = port(&momo);
    drop(momo);
    says(&aiko, "The robot cannot be reached").await?;

    let words = ["--port", &port, "--body", "pepper", "--name", "Pico", "--serial", "AP990438A02Y51000072"];
    let pico = StandIn::start("journey: another body", &words)?;
    says(&aiko, "Is this “Blue”?").await?;
    says(&aiko, "“Momo”, NAO #0344").await?;
    says(&aiko, "“Pico”, Pepper #0072").await?;
    says(&aiko, "Another robot answers at its address. Say first which one is meant.").await?;
    aiko.until("document.querySelector('.start').disabled", "it cannot be started").await?;
    keep(&aiko, "stranger").await?;
    aiko.press("button", "Make its eyes blink").await?;
    says(&aiko, "The eyes of “Blue” blink for a moment.").await?;

    // Another one of the house reads the same question in Japanese.
    let ben = stage.nobody("ben").await?;
    ben.speaks("ja").await?;
    ben.goto(&aiko.address().await?).await?;
    usable(&ben).await?;
    ben.press("button", "ロボット*").await?;
    ben.press("menuitemradio", "Blue*").await?;
    says(&ben, "これは「Blue」ですか？").await?;
    says(&ben, "「Momo」").await?;
    keep(&ben, "stranger-ja").await?;

    aiko.press("button", "It is this one now").await?;
    silent(&aiko, "Is this “Blue”?").await?;
    says(&aiko, "on “Blue”").await?;
    // From now on the first one is the stranger.
    drop(pico);
    says(&aiko, "The robot cannot be reached").await?;
    let words = ["--port", &port, "--name", "Momo", "--serial", "ALDR1312N090344"];
    let _momo = StandIn::start("journey: another body", &words)?;
    says(&aiko, "Is this “Blue”?").await?;
    calm(&aiko)
}

#[tokio::test]
async fn a_robot_gets_its_new_address_and_is_not_added_twice() -> Outcome<()> {
    skip::unless!(ready("journey: a new address"));
    let me = ["--name", "Momo", "--serial", "ALDR1312N090344"];
    let Some(before) = StandIn::start("journey: a new address", &me)? else { return Ok(()) };
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add_program(&aiko, "Ours").await?;
    add_sense(&aiko, "Red ball").await?;
    next(&aiko, "Red ball", "Tracker").await?;
    saved(&aiko).await?;
    add(&aiko, before.address(), "Blue").await?;
    says(&aiko, "on “Blue”").await?;
    drop(before);
    says(&aiko, "The robot cannot be reached").await?;
    let Some(moved) = StandIn::start("journey: a new address", &me)? else { return Ok(()) };

    // Who adds it again is told that it is here, and gives it the address.
    add(&aiko, moved.address(), "Another").await?;
    says(&aiko, "This robot is here already, as “Blue”.").await?;
    keep(&aiko, "here-already").await?;
    aiko.press("button", "Give “Blue” this address").await?;
    aiko.gone("dialog", "Add a NAO or Pepper").await?;
    says(&aiko, "on “Blue”").await?;
    silent(&aiko, "cannot be reached").await?;
    drop(moved);
    says(&aiko, "The robot cannot be reached").await?;

    // By hand: the same dialog, from the menu.
    let Some(again) = StandIn::start("journey: a new address", &me)? else { return Ok(()) };
    aiko.press("button", "Robot: Blue").await?;
    // By its key: what the list says of a robot that comes back grows and shrinks, and moves what stands below it.
    aiko.on("menuitem", "Change the address", "function () { this.focus(); return true; }").await?;
    aiko.key("Enter").await?;
    let dialog = aiko.within("dialog", "Change the address of “Blue”");
    dialog.fill("textbox", "Address", again.address()).await?;
    keep(&aiko, "change-address").await?;
    dialog.press("button", "Change").await?;
    aiko.gone("dialog", "Change the address of “Blue”").await?;
    says(&aiko, "on “Blue”").await?;
    silent(&aiko, "cannot be reached").await?;
    start(&aiko).await?;
    shows_value(&aiko, "Tracker").await?;
    stop(&aiko).await?;
    at_rest(&aiko).await?;
    calm(&aiko)
}

#[tokio::test]
async fn two_robots_with_one_name_are_told_apart() -> Outcome<()> {
    skip::unless!(ready("journey: one name twice"));
    let start = |serial: &str| StandIn::start("journey: one name twice", &["--name", "nao", "--serial", serial]);
    let (Some(one), Some(two)) = (start("ALDR1312N090344")?, start("ALDR1312N090346")?) else { return Ok(()) };
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    add(&aiko, one.address(), "").await?;
    aiko.find("button", "Robot: nao").await?;
    add(&aiko, two.address(), "").await?;
    aiko.find("button", "Robot: nao 2").await?;
    aiko.press("button", "Robot: nao 2").await?;
    says(&aiko, "calls itself “nao”, NAO #0344").await?;
    says(&aiko, "calls itself “nao”, NAO #0346").await?;
    keep(&aiko, "one-name").await?;
    aiko.press("menuitem", "Make its eyes blink").await?;
    says(&aiko, "The eyes of “nao 2” blink for a moment.").await?;
    calm(&aiko)
}
